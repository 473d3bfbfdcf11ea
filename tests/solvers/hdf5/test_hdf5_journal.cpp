#include "solvers/hdf5/detail/journal.hpp"
#include "tests/solvers/hdf5/write_hook.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <optional>
#include <random>
#include <sys/stat.h>

namespace cardan::testing::hdf5_journal {

namespace {

using cardan::solvers::detail::JournaledFile;
using cardan::test::bytes_of;
using cardan::test::Folder;
using cardan::test::WriteCall;
using cardan::test::WriteHook;
using Mode = JournaledFile::Mode;

/// What lies in the open file before the call, and after it was broken off at the place.
std::string contents(int fd) {
    struct stat status {};
    REQUIRE(::fstat(fd, &status) == 0);
    std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
    REQUIRE(::pread(fd, bytes.data(), bytes.size(), 0) == status.st_size);
    return bytes;
}

std::string broken_off(std::string bytes, const WriteCall& call, std::size_t done) {
    const auto at = static_cast<std::size_t>(call.at);
    bytes.resize(std::max(bytes.size(), at + done));
    std::copy_n(call.bytes.begin(), done, bytes.begin() + static_cast<std::ptrdiff_t>(at));
    return bytes;
}

void save(const std::string& path, const std::string& bytes) {
    std::filesystem::remove(path);  // a new file is faster than a shortened one
    std::ofstream(path, std::ios::binary) << bytes;
}

std::string read_as(const std::string& path, Mode mode) {
    JournaledFile file;
    REQUIRE(file.open(path.c_str(), mode) == 0);
    std::string bytes(file.size(), '\0');
    REQUIRE(file.read(0, bytes) == 0);
    return bytes;
}

/// What stands in the place of a signature while blocks are written to their places.
const std::string mark =
    "\x89"
    "CRDNBSY";

/// A file and what it must hold, changed at random.
struct Model {
    std::mt19937 random;
    std::string wanted, committed;

    std::size_t number(std::size_t below) { return std::uniform_int_distribution<std::size_t>(0, below - 1)(random); }

    void write_piece(JournaledFile& file) {
        const std::size_t at = number(wanted.size() + 2000);
        const std::size_t length = 1 + number(1500);
        std::string piece(length, '\0');
        for (char& c : piece) c = static_cast<char>(number(256));
        file.write(at, piece);
        if (wanted.size() < at + length) wanted.resize(at + length, '\0');
        wanted.replace(at, length, piece);
    }
};

/// Longer files may hold more behind the contents, where nobody looks.
bool begins_with(const std::string& file, const std::string& contents) {
    return file.compare(0, contents.size(), contents) == 0 && file.size() >= contents.size();
}

}  // namespace

TEST_CASE("journal: broken off anywhere, a file has its last commit or the one before", "[property]") {
    const Folder folder;
    const std::string path = folder / "a", copy = folder / "b";
    Model model{std::mt19937(7), "", ""};
    bool committing = false;
    std::size_t looked = 0, plain = 0, completed = 0;
    std::vector<std::string> states;
    const auto look = [&](const std::string& bytes) {
        save(copy, bytes);
        const std::string found = read_as(copy, Mode::read);
        CHECK(bytes_of(copy) == bytes);  // a reader changes nothing
        const bool old = begins_with(found, model.committed), fresh = committing && found == model.wanted;
        if (!old && !fresh) FAIL("neither the last commit nor the one before");
        // A program that knows nothing of journals finds the one commit or the other, or no signature.
        if (begins_with(bytes, model.committed) || (committing && begins_with(bytes, model.wanted)))
            ++plain;
        else
            CHECK((bytes.compare(0, 2, mark, 0, 2) == 0 || bytes.compare(4, 4, mark, 4, 4) == 0));
        if (!old) ++completed;
        CHECK(read_as(copy, Mode::change) == found);
        if (fresh) CHECK(bytes_of(copy) == model.wanted);
        ++looked;
    };
    {
        const WriteHook hook([&](const WriteCall& call) {
            const std::string now = contents(call.fd);
            look(now);
            for (const std::size_t part : {2, 3})
                if (call.bytes.size() >= 2) look(broken_off(now, call, call.bytes.size() / part));
            return 0;
        });
        JournaledFile file;
        REQUIRE(file.open(path.c_str(), Mode::create) == 0);
        for (int commit = 0; commit < 12; ++commit) {
            const std::size_t pieces = 1 + model.number(6);
            for (std::size_t i = 0; i < pieces; ++i) model.write_piece(file);
            std::string back(model.wanted.size() + 10, 'x');
            REQUIRE(file.read(0, back) == 0);
            CHECK(begins_with(back, model.wanted));
            if (commit % 5 == 4) model.wanted.resize(model.wanted.size() - model.number(model.wanted.size() / 2));
            committing = true;
            REQUIRE(file.commit(model.wanted.size()) == 0);
            committing = false;
            model.committed = model.wanted;
            CHECK(bytes_of(path) == model.wanted);
        }
    }
    INFO(looked << " states, " << plain << " of them readable by anybody, " << completed << " as of the new commit");
    CHECK(looked > 150);
    CHECK(plain > 50);
    CHECK(completed > 10);
    CHECK(completed < looked);
}

TEST_CASE("journal: a disk that fails at any call leaves the last commit or the one before", "[property]") {
    const Folder folder;
    const std::string path = folder / "a";
    for (int failing = 0;; ++failing) {
        Model model{std::mt19937(3), "", ""};
        int calls = 0, error = 0;
        JournaledFile file;
        REQUIRE(file.open(path.c_str(), Mode::create) == 0);
        {
            const WriteHook hook(
                [&](const WriteCall& call) { return calls++ >= failing && !call.bytes.empty() ? ENOSPC : 0; });
            for (int commit = 0; commit < 6 && error == 0; ++commit) {
                for (int i = 0; i < 3; ++i) model.write_piece(file);
                std::string back(model.wanted.size(), 'x');
                REQUIRE(file.read(0, back) == 0);
                CHECK(back == model.wanted);  // also what the disk did not take
                error = file.commit(model.wanted.size());
                if (error == 0) model.committed = model.wanted;
            }
        }
        CHECK(file.commit(model.wanted.size()) == error);
        CHECK(file.close() == 0);
        if (error == 0) {
            CHECK(failing > 20);
            break;
        }
        CHECK(error == ENOSPC);
        const std::string found = read_as(path, Mode::read);
        CHECK((begins_with(found, model.committed) || found == model.wanted));
    }
}

TEST_CASE("journal: one writer; a reader without a writer keeps writers out", "[property]") {
    const Folder folder;
    const std::string path = folder / "a";
    JournaledFile writer, other, reader;
    REQUIRE(writer.open(path.c_str(), Mode::create) == 0);
    CHECK(other.open(path.c_str(), Mode::change) == EWOULDBLOCK);
    REQUIRE(reader.open(path.c_str(), Mode::read) == 0);
    CHECK(reader.live());
    CHECK(reader.close() == 0);
    CHECK(writer.close() == 0);
    JournaledFile alone, late;
    REQUIRE(alone.open(path.c_str(), Mode::read) == 0);
    CHECK_FALSE(alone.live());
    CHECK(late.open(path.c_str(), Mode::change) == EWOULDBLOCK);
    JournaledFile nothing;
    CHECK(nothing.open((folder / "none").c_str(), Mode::read) == ENOENT);
}

TEST_CASE("journal: a file that was removed or cut off is no place to commit to", "[property]") {
    const Folder folder;
    const std::string path = folder / "a";
    for (const bool removed : {true, false}) {
        JournaledFile file;
        REQUIRE(file.open(path.c_str(), Mode::create) == 0);
        file.write(0, std::string(2000, 'a'));
        CHECK(file.commit(2000) == 0);
        if (removed)
            std::filesystem::remove(path);
        else
            std::filesystem::resize_file(path, 100);
        file.write(0, std::string(2000, 'b'));
        CHECK(file.commit(2000) == (removed ? ENOENT : EIO));
        CHECK(file.commit(2000) == (removed ? ENOENT : EIO));
        CHECK(file.close() == 0);
    }
}

TEST_CASE("journal: a writer waits for a reader, but not for ever", "[property][slow]") {
    const Folder folder;
    const std::string path = folder / "a";
    JournaledFile writer, reader;
    REQUIRE(writer.open(path.c_str(), Mode::create) == 0);
    writer.write(0, std::string(1000, 'a'));
    REQUIRE(writer.commit(1000) == 0);
    REQUIRE(reader.open(path.c_str(), Mode::read) == 0);
    writer.write(0, std::string(1000, 'b'));
    const auto start = JournaledFile::Clock::now();
    CHECK_FALSE(reader.expired());
    CHECK(writer.commit(1000) == 0);
    CHECK(JournaledFile::Clock::now() - start >= JournaledFile::lease);
    CHECK(reader.expired());
    std::string bytes(1000, ' ');
    CHECK(reader.read(0, bytes) == 0);
    CHECK(bytes == std::string(1000, 'b'));  // of the new commit: what an expired reader reads counts for nothing
}

TEST_CASE("journal: a damaged or foreign end of a file is no journal", "[property]") {
    const Folder folder;
    const std::string path = folder / "a";
    std::string state;
    {
        JournaledFile file;
        REQUIRE(file.open(path.c_str(), Mode::create) == 0);
        file.write(0, std::string(5000, 'a'));
        REQUIRE(file.commit(5000) == 0);
        file.write(700, std::string(900, 'b'));
        const WriteHook hook([&](const WriteCall& call) {
            const std::string now = contents(call.fd);
            if (state.empty() && now.size() > 6000) state = now;  // the journal is there, nothing is in its place
            return 0;
        });
        REQUIRE(file.commit(5000) == 0);
    }
    REQUIRE(state.size() > 6000);
    const std::string old(5000, 'a'), fresh = std::string(700, 'a') + std::string(900, 'b') + std::string(3400, 'a');
    save(path, state);
    CHECK(read_as(path, Mode::read) == fresh);
    for (std::size_t at = 5120; at < state.size(); at += 17) {
        std::string damaged = state;
        damaged[at] = static_cast<char>(damaged[at] + 1);
        save(path, damaged);
        if (!begins_with(read_as(path, Mode::read), old)) FAIL("damaged at " << at);
    }
    for (std::size_t size = 0; size < state.size(); size += 29) {
        save(path, state.substr(0, size));
        if (read_as(path, Mode::read) != state.substr(0, size)) FAIL("cut off at " << size);
    }
}

}  // namespace cardan::testing::hdf5_journal
