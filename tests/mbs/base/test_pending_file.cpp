// Files that get their name when they are complete, and who may write them.
#include "mbs/base/pending_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <fcntl.h>
#include <fstream>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace cardan;
using namespace cardan::test;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

/// Runs a function in another process, which lives until this object goes away.
class Other {
public:
    template <class Function>
    explicit Other(Function&& function) {
        int ready[2], end[2];
        REQUIRE(::pipe(ready) == 0);
        REQUIRE(::pipe(end) == 0);
        id = ::fork();
        if (id == 0) {
            ::close(end[1]);
            function([&] {
                char byte = 0;
                (void)!::write(ready[1], &byte, 1);
                (void)!::read(end[0], &byte, 1);
            });
            ::_exit(0);
        }
        ::close(end[0]);
        char byte = 0;
        REQUIRE(::read(ready[0], &byte, 1) == 1);
        ::close(ready[0]);
        ::close(ready[1]);
        end_ = end[1];
    }
    ~Other() {
        ::close(end_);
        ::waitpid(id, nullptr, 0);
    }
    Other(const Other&) = delete;
    Other& operator=(const Other&) = delete;
    pid_t id = 0;

private:
    int end_ = -1;
};

}  // namespace

TEST_CASE("pending file: what another program writes is refused, with its number, and left alone", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.csv";
    {
        const Other other([&](const auto& wait) {
            const PendingFile file(path);
            std::ofstream(file.partial()) << "of the other";
            wait();
            file.commit();
        });
        const std::string message = message_of([&] { PendingFile mine(path); });
        CHECK_THAT(message, Contains(path) && Contains("has it open") && Contains(text("(process ", other.id, ")")));
        CHECK_THAT(message_of([&] { write_file(path, "mine"); }), Contains("has it open"));
        CHECK(bytes_of(path + ".partial") == "of the other");
    }
    CHECK(bytes_of(path) == "of the other");
    CHECK(folder.files() == 1);
    write_file(path, "mine");
    CHECK(bytes_of(path) == "mine");
}

TEST_CASE("pending file: a file under its name that somebody is writing is not replaced", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    const PendingFile early(path);
    {
        const Other other([&](const auto& wait) {
            std::ofstream(path) << "growing";
            const int fd = ::open(path.c_str(), O_RDWR);
            if (::flock(fd, LOCK_EX) == 0) wait();
        });
        CHECK_THAT(message_of([&] { early.commit(); }),
                   Contains("cannot be replaced") && Contains(text("(process ", other.id, ")")));
        CHECK_THAT(message_of([&] { PendingFile late(folder / "a.h5"); }), Contains("cannot be replaced"));
        CHECK(bytes_of(path) == "growing");
    }
    CHECK_THAT(message_of([&] { early.commit(false); }), Contains("is there already"));
    CHECK(bytes_of(path) == "growing");
    early.commit();
    CHECK(bytes_of(path).empty());
    CHECK(folder.files() == 1);
}

TEST_CASE("pending file: what a killed program has left behind is known and can be written", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.csv";
    {
        const PendingFile fresh(path);
        CHECK_FALSE(fresh.left_over());
    }
    const PendingFile next(path);
    CHECK(next.left_over());
    next.discard();
    CHECK(folder.files() == 0);
}

TEST_CASE("pending file: a symbolic link stays, and what it leads to is written", "[property]") {
    const Folder folder;
    fs::create_directory(folder / "sub");
    fs::create_symlink("sub/far.csv", folder / "near.csv");
    fs::create_symlink("near.csv", folder / "nearer.csv");
    for (const char* contents : {"not there yet", "there already"}) {
        write_file(folder / "nearer.csv", contents);
        CHECK(bytes_of(folder / "sub/far.csv") == contents);
        CHECK(fs::is_symlink(folder / "near.csv"));
        CHECK(fs::is_symlink(folder / "nearer.csv"));
        CHECK(folder.files() == 3);
    }
    CHECK(PendingFile(folder / "nearer.csv").partial() == folder / "sub/far.csv.partial");
    fs::create_symlink(fs::path(folder / "sub/far.csv"), folder / "absolute.csv");
    write_file(folder / "absolute.csv", "by the whole path");
    CHECK(bytes_of(folder / "near.csv") == "by the whole path");
    fs::create_symlink("no/such/folder.csv", folder / "nowhere.csv");
    CHECK_THROWS_WITH(write_file(folder / "nowhere.csv", ""), Contains("no/such' does not exist"));
    fs::create_symlink("circle.csv", folder / "circle.csv");
    CHECK_THROWS_WITH(write_file(folder / "circle.csv", ""), Contains("too many symbolic links"));
    fs::create_symlink("/dev/null", folder / "null.csv");
    CHECK_THROWS_WITH(write_file(folder / "null.csv", ""), Contains("not an ordinary file"));
}

TEST_CASE("pending file: a lock that was handed over protects the file from being discarded by others", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    const PendingFile mine(path);
    mine.hand_over();
    {
        const Other other([&](const auto& wait) {
            const int fd = ::open((path + ".partial").c_str(), O_RDWR);
            if (::flock(fd, LOCK_EX) == 0) wait();
        });
        mine.discard();
        CHECK(folder.files() == 1);
    }
    mine.discard();
    CHECK(folder.files() == 0);
}
