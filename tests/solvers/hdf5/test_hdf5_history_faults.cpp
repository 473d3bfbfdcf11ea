// Histories whose writer is killed, whose disk fails, or that are read while they are written.
#include "mbs/base/error.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5/history.hpp"
#include "tests/solvers/hdf5/write_hook.hpp"
#include "tests/solvers/signals/history_rows.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iostream>
#include <poll.h>
#include <random>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::test;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

constexpr HistoryStorage small_chunks{.chunk = 8, .flush_interval = 1e9};

/// Takes checkpoints, flushes within chunks too.
void write_all(HistoryWriter& writer, std::size_t from, std::size_t to) {
    writer.take_checkpoints([&] { return checkpoint_of(writer.rows() - 1); });
    for (std::size_t row = from; row < to; ++row) {
        append_rows(writer, row, row + 1);
        if (row % 5 == 2) writer.flush();
    }
}

/// Can programs that know nothing of journals read all rows rightly?
bool readable_by_others(const std::string& path) {
    try {
        const Hdf5File file = Hdf5File::open(path);
        const std::vector<double> time = file.read_doubles("time");
        for (std::size_t c = 0; c < 3; ++c) {
            const std::vector<double> values = file.read_doubles(text("channel ", c));
            if (values.size() != time.size()) return false;
            for (std::size_t row = 0; row < values.size(); ++row)
                if (!same(values[row], value_of(c, row)) || time[row] != time_of(row)) return false;
        }
        return true;
    } catch (const FileError&) {
        return false;
    }
}

/// Does a program that knows nothing of journals take the file for healthy and read what is wrong, in rows or
/// checkpoint?
bool misread_by_others(const std::string& path) {
    try {
        const Hdf5File file = Hdf5File::open(path);
        const std::size_t rows = file.read_doubles("time").size();
        if (!readable_by_others(path)) return true;
        if (!file.has("run/checkpoint/rows")) return rows > 0;
        const auto safe = static_cast<std::size_t>(file.read_ints("run/checkpoint/rows").at(0));
        const Checkpoint expected = checkpoint_of(safe - 1);
        return safe != rows || file.read_doubles("run/checkpoint/checkpoint_time").at(0) != expected.time ||
               file.read_doubles("run/checkpoint/q").at(0) != expected.q(0) ||
               file.read_ints("run/statistics/steps").at(0) != expected.statistics.steps;
    } catch (const FileError&) {
        return false;
    }
}

/// Everything that must hold of a history that was broken off after `flushed` rows were safe.
void check_broken_off(const std::string& path, std::size_t flushed, std::size_t appended) {
    const HistoryInfo info = read_history_info(path);
    const History history = read_history(path);
    CHECK(wrong_values(history) == 0);
    CHECK(info.rows == history.time.size());
    CHECK(info.rows >= flushed);
    CHECK(info.rows <= appended);
    if (info.rows > 0) CHECK(whole(info));
    if (info.rows > 0) CHECK(info.checkpoint_rows == info.rows);
    if (!info.needs_repair) CHECK(readable_by_others(path));
    CHECK_FALSE(misread_by_others(path));
    CHECK(repair_history(path).changed() == info.needs_repair);
    CHECK_FALSE(repair_history(path).changed());
    CHECK(readable_by_others(path));
    CHECK(read_history_info(path).rows == info.rows);
}

/// A copy of what lies in an open file, with a part of what is being written to it.
void save_broken_off(const std::string& path, const WriteCall& call, std::size_t done) {
    struct stat status {};
    REQUIRE(::fstat(call.fd, &status) == 0);
    std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
    REQUIRE(::pread(call.fd, bytes.data(), bytes.size(), 0) == status.st_size);
    const auto at = static_cast<std::size_t>(call.at);
    if (done > 0) bytes.resize(std::max(bytes.size(), at + done));
    std::copy_n(call.bytes.begin(), done, bytes.begin() + static_cast<std::ptrdiff_t>(at));
    fs::remove(path);  // a new file is faster than a shortened one
    std::ofstream(path, std::ios::binary) << bytes;
}

int wait_for(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

/// Writes rows until it is killed and tells through the pipe how many are safe.
[[noreturn]] void write_until_killed(const std::string& path, int pipe) {
    HistoryWriter writer = HistoryWriter::create(path, some_channels(), {}, small_chunks);
    writer.take_checkpoints([&] { return checkpoint_of(writer.rows() - 1); });
    for (std::size_t row = 0; row < 1'000'000; ++row) {
        append_rows(writer, row, row + 1);
        if (row % 5 == 2) writer.flush();
        const std::size_t safe = writer.flushed_rows();
        if (safe == row + 1 && ::write(pipe, &safe, sizeof safe) != sizeof safe) break;
    }
    ::_exit(1);
}

/// Last number that came through the pipe.
std::size_t last_of(int pipe) {
    std::size_t last = 0;
    for (std::size_t next = 0; ::read(pipe, &next, sizeof next) == sizeof next;) last = next;
    ::close(pipe);
    return last;
}

/// Every second writer has told of rows when the time until its end starts to run, however slow the machine is.
void kill_at_random(int runs, unsigned seed) {
    const Folder folder;
    std::mt19937 random(seed);
    std::size_t with_rows = 0;
    for (int run = 0; run < runs; ++run) {
        const std::string path = folder / text("run", run, ".h5");
        const auto pause = std::chrono::microseconds(std::uniform_int_distribution<long>(0, 20'000)(random));
        int ends[2];
        REQUIRE(::pipe(ends) == 0);
        const pid_t child = ::fork();
        if (child == 0) write_until_killed(path, ends[1]);
        ::close(ends[1]);
        pollfd told{ends[0], POLLIN, 0};
        if (run % 2 == 1) REQUIRE(::poll(&told, 1, -1) == 1);
        std::this_thread::sleep_for(pause);
        ::kill(child, SIGKILL);
        CHECK(WIFSIGNALED(wait_for(child)));
        const std::size_t flushed = last_of(ends[0]);
        CAPTURE(run, flushed);
        if (!fs::exists(path)) CHECK(flushed == 0);
        if (fs::exists(path)) check_broken_off(path, flushed, flushed + 8);
        if (flushed > 0) ++with_rows;
    }
    CHECK(with_rows >= static_cast<std::size_t>(runs) / 2);
}

}  // namespace

TEST_CASE("history: killed at any write, in the middle of it too, all flushed rows are there", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5", copy = folder / "b.h5";
    std::size_t calls = 0, journals = 0;
    {
        HistoryWriter writer = HistoryWriter::create(path, some_channels(), {}, small_chunks);
        const WriteHook hook([&](const WriteCall& call) {
            for (const std::size_t done : {std::size_t{0}, call.bytes.size() / 2}) {
                if (done == 0 && !call.bytes.empty() && ++calls % 3 != 0) continue;
                save_broken_off(copy, call, done);
                if (read_history_info(copy).needs_repair) ++journals;
                check_broken_off(copy, writer.flushed_rows(), writer.rows());
            }
            return 0;
        });
        write_all(writer, 0, 21);
    }
    CAPTURE(calls, journals);
    CHECK(calls > 30);
    CHECK(journals > 3);
}

TEST_CASE("history: of programs that begin one file at once the first gets it, the others say who", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    for (int round = 0; round < 10; ++round) {
        const bool replace = round % 2 == 1;
        if (!replace) fs::remove(path);
        int told[2], go[2];
        REQUIRE(::pipe(told) == 0);
        REQUIRE(::pipe(go) == 0);
        std::vector<pid_t> children;
        for (int k = 0; k < 6; ++k) {
            children.push_back(::fork());
            if (children.back() != 0) continue;
            ::close(go[1]);
            char answer = 'f', end = 0;
            try {
                HistoryWriter writer =
                    HistoryWriter::create(path, some_channels(), {}, {.replace = replace, .chunk = 8});
                answer = 'w';
                (void)!::write(told[1], &answer, 1);
                (void)!::read(go[0], &end, 1);  // until all have tried
                write_all(writer, 0, 20);
                writer.finish();
            } catch (const FileError& error) {
                const std::string message = error.what();
                if (message.find("has it open (process ") == std::string::npos &&
                    message.find("is there already") == std::string::npos) {
                    answer = 'x';
                    std::cerr << message << "\n";
                }
                (void)!::write(told[1], &answer, 1);
            }
            ::_exit(answer == 'w' ? 0 : 1);
        }
        ::close(go[0]);
        std::string answers(children.size(), ' ');
        for (char& answer : answers) REQUIRE(::read(told[0], &answer, 1) == 1);
        ::close(go[1]);
        for (const pid_t child : children) wait_for(child);
        ::close(told[0]);
        ::close(told[1]);
        CAPTURE(round, answers);
        CHECK(std::ranges::count(answers, 'w') == 1);
        CHECK(std::ranges::count(answers, 'f') == 5);
        CHECK(read_history(path).time.size() == 20);
        CHECK(read_history_info(path).finished);
        CHECK(folder.files() == 1);
    }
}

TEST_CASE("history: a writer killed by SIGKILL loses what came after the last flush only", "[property]") {
    kill_at_random(30, 1);
}

TEST_CASE("history: a writer killed by SIGKILL hundreds of times", "[property][slow]") {
    kill_at_random(500, 2);
}

TEST_CASE("history: a disk that is full at any write is an error, and all flushed rows are there", "[property]") {
    const Folder folder;
    bool done = false;
    for (int failing = 0; !done; failing += 2) {
        CAPTURE(failing);
        const std::string path = folder / text("run", failing, ".h5");
        std::size_t flushed = 0, appended = 0;
        {
            HistoryWriter writer = HistoryWriter::create(path, some_channels(), {}, small_chunks);
            int calls = 0;
            const WriteHook hook(
                [&](const WriteCall& call) { return !call.bytes.empty() && calls++ >= failing ? ENOSPC : 0; });
            const std::string message = message_of([&] { write_all(writer, 0, 13); });
            done = message == "nothing was thrown";
            if (done) break;
            CHECK_THAT(message, Contains(path) && Contains("No space left on device"));
            flushed = writer.flushed_rows();
            appended = writer.rows();
            CHECK_THROWS_WITH(writer.append(1e3, values_of(3, 0)), Contains("an earlier write failed"));
            CHECK_THROWS_WITH(writer.flush(), Contains(text(flushed, " rows are in the file")));
            CHECK_THROWS_WITH(writer.finish(), Contains("an earlier write failed"));
            CHECK_THROWS_WITH(writer.finish(), Contains("closed"));
        }
        check_broken_off(path, flushed, appended);
        // There is room again: it goes on.
        HistoryWriter writer = HistoryWriter::append_to(path, some_channels(), small_chunks);
        CHECK(writer.rows() >= flushed);
        write_all(writer, writer.rows(), 30);
        writer.finish();
        const History history = read_history(path);
        CHECK(history.time.size() == 30);
        CHECK(wrong_values(history) == 0);
        CHECK(read_history_info(path).finished);
    }
}

TEST_CASE("history: a disk that is full when a history begins or ends", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    SECTION("begins") {
        const SizeLimit limit(1000);
        CHECK_THROWS_WITH(HistoryWriter::create(path, some_channels()),
                          Contains("a.h5: ") && Contains("File too large"));
        CHECK(folder.files() == 0);
    }
    SECTION("ends") {
        HistoryWriter writer = HistoryWriter::create(path, some_channels(), {}, small_chunks);
        write_all(writer, 0, 8);
        append_rows(writer, 8, 12);
        const SizeLimit limit(fs::file_size(path));
        CHECK_THROWS_WITH(writer.finish(), Contains("a.h5: cannot be written: File too large"));
        CHECK_THROWS_WITH(writer.rows(), Contains("closed"));
        CHECK(read_history_info(path).rows == 8);
        CHECK_FALSE(read_history_info(path).finished);
    }
    SECTION("is given up") {
        HistoryWriter writer = HistoryWriter::create(path, some_channels(), {}, small_chunks);
        write_all(writer, 0, 8);
        append_rows(writer, 8, 12);
        const SizeLimit limit(fs::file_size(path));
        { const HistoryWriter last = std::move(writer); }
        CHECK(read_history_info(path).rows == 8);
    }
    if (fs::exists(path)) CHECK(readable_by_others(path));
}

TEST_CASE("history: a small file system that fills up", "[property]") {
    const Folder folder;
    const std::string disk = folder / "disk";
    fs::create_directory(disk);
    if (::mount("none", disk.c_str(), "tmpfs", 0, "size=200k") != 0) {
        WARN("not tested: no file system can be mounted here");
        return;
    }
    struct Mounted {
        std::string at;
        ~Mounted() { ::umount(at.c_str()); }
    };
    const Mounted mounted{disk};
    const std::string path = disk + "/a.h5";
    std::size_t flushed = 0;
    {
        HistoryWriter writer = HistoryWriter::create(path, some_channels(), {}, {.chunk = 64});
        CHECK_THROWS_WITH(append_rows(writer, 0, 100'000), Contains("No space left on device"));
        flushed = writer.flushed_rows();
    }
    CHECK(flushed > 1000);
    const History history = read_history(path);
    CHECK(history.time.size() == flushed);
    CHECK(wrong_values(history) == 0);
    CHECK(readable_by_others(path));
}

TEST_CASE("history: what was flushed can be read while it is written, and nothing changes by that", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    HistoryWriter writer = HistoryWriter::create(path, some_channels(), {}, small_chunks);
    write_all(writer, 0, 10);
    append_rows(writer, 10, 12);
    const std::string before = bytes_of(path);
    const HistoryInfo info = read_history_info(path);
    CHECK(info.being_written);
    CHECK_FALSE(info.needs_repair);
    CHECK(info.rows == writer.flushed_rows());
    CHECK(wrong_values(read_history(path)) == 0);
    CHECK(bytes_of(path) == before);
    CHECK_THROWS_WITH(repair_history(path), Contains("another program, or another object of this one, has it open"));
    CHECK_THROWS_WITH(HistoryWriter::append_to(path, some_channels()), Contains("has it open"));
    CHECK_THROWS_WITH(HistoryWriter::create(path, some_channels(), {}, {.replace = true}), Contains("has it open"));
    append_rows(writer, 12, 20);
    writer.finish();
    CHECK_FALSE(read_history_info(path).being_written);
    CHECK(read_history(path).time.size() == 20);
}

TEST_CASE("history: readers and a writer in two programs do not disturb each other", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const pid_t child = ::fork();
    if (child == 0) write_until_killed(path, ends[1]);
    ::close(ends[1]);
    std::size_t safe = 0;
    REQUIRE(::read(ends[0], &safe, sizeof safe) == sizeof safe);
    std::size_t before = 0, grown = 0;
    for (int i = 0; i < 30; ++i) {
        const History history = read_history(path);
        CHECK(wrong_values(history) == 0);
        CHECK(history.time.size() >= before);
        if (history.time.size() > before) ++grown;
        before = history.time.size();
        CHECK(read_history_info(path).being_written);
    }
    ::kill(child, SIGKILL);
    CHECK(WIFSIGNALED(wait_for(child)));
    const std::size_t flushed = last_of(ends[0]);
    CHECK(grown > 3);
    CHECK(flushed + 8 >= before);  // it may be killed between a flush and the report of it
    check_broken_off(path, flushed, flushed + 8);
}
