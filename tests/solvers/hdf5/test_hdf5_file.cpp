#include "mbs/base/error.hpp"
#include "solvers/hdf5/file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using cardan::FileError;
using cardan::InputError;
using cardan::solvers::Hdf5File;
using cardan::solvers::Shape;
using cardan::test::bytes_of;
using cardan::test::Folder;
using cardan::test::message_of;
using cardan::test::SizeLimit;
using Catch::Matchers::Contains;
using Complex = std::complex<double>;

std::vector<double> ramp(std::size_t n) {
    std::vector<double> values(n);
    for (std::size_t k = 0; k < n; ++k) values[k] = 0.37 * static_cast<double>((k * k) % 7919);
    return values;
}

}  // namespace

TEST_CASE("hdf5: numbers, complex numbers and texts come back as they were written", "[property]") {
    const Folder folder;
    const std::vector<double> x{1.5, -2.0, 1e-300, 4.0, 5.0, 6.0};
    const std::vector<int> counts{-1, 2, 3};
    const std::vector<std::int64_t> large{std::int64_t{1} << 60, -7};
    const std::vector<Complex> z{{1.0, -2.0}, {0.0, 3.5}};
    const std::vector<std::string> names{"first flap", "", "G\xC3\xA4ngigkeit"};
    {
        Hdf5File file = Hdf5File::create(folder / "a.h5");
        file.write("x", x, {2, 3}, {"m", "deflection"});
        file.write("group/counts", counts, {3}, {"1", "iterations"});
        file.write("/group/sub/large", large, {2}, {"1", "large numbers"});
        file.write("z", z, {1, 2}, {"rad/s", "eigenvalue"});
        file.write("names", names, {3}, "names of modes");
        file.write("one", std::vector<double>{42.0}, {}, {"kg", "mass"});
        file.finish();
    }
    const Hdf5File file = Hdf5File::open(folder / "a.h5");
    CHECK(file.read_doubles("x") == x);
    CHECK(file.shape("x") == Shape{2, 3});
    CHECK(file.read_ints("group/counts") == std::vector<std::int64_t>{-1, 2, 3});
    CHECK(file.read_doubles("group/counts") == std::vector<double>{-1.0, 2.0, 3.0});
    CHECK(file.read_ints("group/sub/large") == large);
    CHECK(file.read_complex("/z") == z);
    CHECK(file.read_strings("names") == names);
    CHECK(file.read_doubles("one") == std::vector<double>{42.0});
    CHECK(file.shape("one").empty());
    CHECK(file.string_attribute("x", "units") == "m");
    CHECK(file.string_attribute("names", "long_name") == "names of modes");
    CHECK_FALSE(file.has_attribute("names", "units"));
}

TEST_CASE("hdf5: arrays may be empty", "[property]") {
    const Folder folder;
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("x", std::vector<double>{}, {0, 4}, {"m", "nothing"});
    file.write("s", std::vector<std::string>{}, {0}, "no names");
    file.finish();
    const Hdf5File back = Hdf5File::open(folder / "a.h5");
    CHECK(back.read_doubles("x").empty());
    CHECK(back.shape("x") == Shape{0, 4});
    CHECK(back.read_strings("s").empty());
}

TEST_CASE("hdf5: texts of all lengths come back, with more axes and as one", "[property]") {
    const Folder folder;
    const std::string long_text = std::string(100'000, 'x') + "\xC3\xA4", longest_attribute(70'000, 'y');
    const std::vector<std::string> table{"a", "", "\xE2\x82\xAC", " b ", "\n", "cc"};
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("g/string3", std::vector<double>{1}, {1}, {"1", "a name like that of a scale"});
    file.write("g/long", std::vector<std::string>{long_text}, {}, "one text");
    file.write("g/table", table, {3, 2}, "table");
    file.write("g/again", table, {6}, "table", {{"note", longest_attribute}});
    file.write("empty", std::vector<std::string>{"", ""}, {2}, "empty");
    file.set_attribute("empty", {"nothing", ""});
    CHECK(file.read_strings("g/table") == table);
    file.finish();
    const Hdf5File back = Hdf5File::open(folder / "a.h5");
    CHECK(back.read_strings("g/long") == std::vector<std::string>{long_text});
    CHECK(back.shape("g/long").empty());
    CHECK(back.read_strings("g/table") == table);
    CHECK(back.shape("g/table") == Shape{3, 2});
    CHECK(back.dimension("g/table", 2) == back.dimension("g/again", 1));
    CHECK(back.read_strings("empty") == std::vector<std::string>{"", ""});
    CHECK(back.string_attribute("empty", "nothing").empty());
    CHECK(back.string_attribute("g/again", "note") == longest_attribute);
    CHECK_FALSE(back.has_attribute("g/again", "_Encoding"));
    CHECK(back.string_attribute("g/long", "_Encoding") == "utf-8");
}

TEST_CASE("hdf5: big arrays are compressed and come back exactly", "[property]") {
    const Folder folder;
    const std::vector<double> values = ramp(300'000);
    std::vector<Complex> z(values.begin(), values.end());
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("tall", values, {30'000, 10}, {"m", "tall"});
    file.write("wide", values, {2, 150'000}, {"m", "wide"});
    file.write("z", z, {3, 100, 1000}, {"1", "complex"});
    file.finish();
    CHECK(fs::file_size(folder / "a.h5") < 16 * values.size());
    const Hdf5File back = Hdf5File::open(folder / "a.h5");
    CHECK(back.read_doubles("tall") == values);
    CHECK(back.read_doubles("wide") == values);
    CHECK(back.read_complex("z") == z);
}

TEST_CASE("hdf5: groups and data sets are listed in the order of creation", "[property]") {
    const Folder folder;
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    for (const char* name : {"z", "b/y", "a", "b/x"}) file.write(name, ramp(1), {1}, {"1", name});
    file.make_group("c/d", {{"kind", "tower"}});
    CHECK(file.children() == std::vector<std::string>{"z", "b", "a", "c"});
    CHECK(file.children("b") == std::vector<std::string>{"y", "x"});
    CHECK(file.children("/c/d").empty());
    CHECK(file.has("c/d"));
    CHECK(file.has("/"));
    CHECK_FALSE(file.has("z/deeper"));
}

TEST_CASE("hdf5: attributes hold texts, numbers and integers, and can be replaced", "[property]") {
    const Folder folder;
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.set_attribute("/", {"Conventions", "CF-1.8"});
    file.write("x", ramp(2), {2}, {"m", "x", {{"frame", "blade root"}, {"radius", 1.5}, {"blade", 3}}});
    file.make_group("g", {{"speed", 1.0}});
    file.make_group("g", {{"speed", 2.0}, {"note", ""}});
    file.finish();
    const Hdf5File back = Hdf5File::open(folder / "a.h5");
    CHECK(back.string_attribute("/", "Conventions") == "CF-1.8");
    CHECK(back.string_attribute("x", "frame") == "blade root");
    CHECK(back.double_attribute("x", "radius") == 1.5);
    CHECK(back.int_attribute("x", "blade") == 3);
    CHECK(back.double_attribute("x", "blade") == 3.0);
    CHECK(back.double_attribute("g", "speed") == 2.0);
    CHECK(back.string_attribute("g", "note").empty());
    CHECK_THROWS_WITH(back.string_attribute("x", "radius"), Contains("x, attribute radius: holds no texts"));
    CHECK_THROWS_WITH(back.int_attribute("x", "radius"), Contains("holds no integers"));
    CHECK_THROWS_AS(back.string_attribute("x", "absent"), FileError);
}

TEST_CASE("hdf5: an axis knows the dimension it runs over", "[property]") {
    const Folder folder;
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("time", ramp(4), {4}, {"s", "time"});
    file.write("mode", std::vector<int>{0, 1}, {2}, {"1", "mode"});
    file.make_dimension("time");
    file.make_dimension("mode");
    file.write("g/x", ramp(8), {4, 2}, {"m", "x"});
    file.attach("g/x", 0, "time");
    file.attach("g/x", 1, "mode");
    file.write("plain", ramp(4), {4}, {"m", "no dimension attached"});
    file.finish();
    const Hdf5File back = Hdf5File::open(folder / "a.h5");
    CHECK(back.dimension("g/x", 0) == "/time");
    CHECK(back.dimension("g/x", 1) == "/mode");
    CHECK(back.dimension("plain", 0).empty());
    CHECK(back.string_attribute("time", "CLASS") == "DIMENSION_SCALE");
    CHECK_THROWS_AS(back.dimension("g/x", 2), InputError);
}

TEST_CASE("hdf5: the same data give the same bytes", "[property]") {
    const Folder folder;
    for (const char* name : {"a.h5", "b.h5"}) {
        Hdf5File file = Hdf5File::create(folder / name);
        file.write("g/x", ramp(20'000), {20'000}, {"m", "x"});
        file.write("names", std::vector<std::string>{"p", "q"}, {2}, "names");
        file.finish();
        if (name[0] == 'a') ::sleep(1);
    }
    CHECK(bytes_of(folder / "a.h5") == bytes_of(folder / "b.h5"));
}

TEST_CASE("hdf5: the file has its name only after finish", "[property]") {
    const Folder folder;
    std::ofstream(folder / "a.h5") << "older file";
    {
        Hdf5File file = Hdf5File::create(folder / "a.h5");
        file.write("x", ramp(3), {3}, {"m", "x"});
    }
    CHECK(bytes_of(folder / "a.h5") == "older file");
    CHECK(Hdf5File::open(folder / "a.h5.partial").read_doubles("x") == ramp(3));

    Hdf5File file = Hdf5File::create(folder / "a.h5");
    CHECK_FALSE(file.has("x"));
    file.finish();
    CHECK(Hdf5File::open(folder / "a.h5").children().empty());
    CHECK_FALSE(fs::exists(folder / "a.h5.partial"));
    CHECK_THROWS_WITH(file.finish(), Contains("the file is closed"));
    CHECK_THROWS_WITH(file.write("x", ramp(1), {1}, {"m", "x"}), Contains("the file is closed"));
    CHECK(file.path() == folder / "a.h5");
}

TEST_CASE("hdf5: what was flushed can be read although the writer is killed", "[property]") {
    const Folder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        Hdf5File file = Hdf5File::create(folder / "a.h5");
        file.write("x", ramp(50'000), {50'000}, {"m", "x"});
        file.flush();
        file.write("y", ramp(3), {3}, {"m", "lost"});
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    CHECK(WIFSIGNALED(status));
    CHECK(Hdf5File::open(folder / "a.h5.partial").read_doubles("x") == ramp(50'000));
}

TEST_CASE("hdf5: a path that cannot be written is an error that says why", "[property]") {
    const Folder folder;
    const auto reason = [](const std::string& path) { return message_of([&] { (void)Hdf5File::create(path); }); };
    CHECK(reason(folder / "none/a.h5") ==
          (folder / "none/a.h5") + ": the folder '" + (folder / "none") + "' does not exist");
    CHECK(reason(folder.path.string()) == folder.path.string() + ": is a folder, not a file");
    CHECK_THAT(reason(folder / ""), Contains("is a folder"));
    CHECK_THAT(reason(""), Contains("a file name is needed"));
    CHECK_THAT(reason("/dev/null"), Contains("/dev/null: exists and is not an ordinary file"));
    fs::create_directory(folder / "b.h5.partial");
    CHECK_THAT(reason(folder / "b.h5"), Contains("b.h5: cannot be written: Is a directory"));
    if (::geteuid() != 0) {  // root may write anywhere
        fs::create_directory(folder / "locked");
        fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
        CHECK_THAT(reason(folder / "locked/a.h5"), Contains("locked/a.h5: cannot be written: Permission denied"));
    }
}

TEST_CASE("hdf5: a file that cannot be read is an error that says why", "[property]") {
    const Folder folder;
    const auto reason = [](const std::string& path) { return message_of([&] { (void)Hdf5File::open(path); }); };
    CHECK(reason(folder / "a.h5") == (folder / "a.h5") + ": cannot be opened: No such file or directory");
    CHECK_THAT(reason(folder.path.string()), Contains("is a folder, not a file"));
    CHECK_THAT(reason("/dev/null"), Contains("/dev/null: is not an ordinary file"));
    std::ofstream(folder / "text.h5") << "this is not HDF5, but long enough to hold a signature";
    CHECK(reason(folder / "text.h5") ==
          (folder / "text.h5") + ": cannot be opened as an HDF5 file: file signature not found");
    const Hdf5File writing = Hdf5File::create(folder / "b.h5");
    CHECK_THAT(reason(folder / "b.h5.partial"), Contains("unable to lock file"));
}

TEST_CASE("hdf5: a second writer of a file is refused", "[property]") {
    const Folder folder;
    Hdf5File first = Hdf5File::create(folder / "a.h5");
    first.write("x", ramp(2), {2}, {"m", "x"});
    CHECK_THROWS_WITH(Hdf5File::create(folder / "a.h5"), Contains("another object of this one, has it open"));
    first.finish();
    CHECK(Hdf5File::open(folder / "a.h5").read_doubles("x") == ramp(2));
}

TEST_CASE("hdf5: damage is noticed when reading", "[property]") {
    const Folder folder;
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("x", ramp(100'000), {100'000}, {"m", "x"});
    file.finish();
    const auto size = fs::file_size(folder / "a.h5");
    {
        std::fstream damage(folder / "a.h5", std::ios::in | std::ios::out | std::ios::binary);
        damage.seekp(static_cast<std::streamoff>(size / 2));
        damage << "xxxxxxxxxxxxxxxx";
    }
    CHECK_THROWS_WITH(Hdf5File::open(folder / "a.h5").read_doubles("x"), Contains("a.h5: x: cannot be read: "));
    fs::resize_file(folder / "a.h5", size / 2);
    CHECK_THROWS_AS(Hdf5File::open(folder / "a.h5"), FileError);
}

TEST_CASE("hdf5: reading what is not there, or is something else, names the file and the data set", "[property]") {
    const Folder folder;
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("x", ramp(2), {2}, {"m", "x"});
    file.write("g/names", std::vector<std::string>{"p"}, {1}, "names");
    const std::string path = folder / "a.h5";
    CHECK(message_of([&] { (void)file.read_doubles("y"); }) == path + ": there is no 'y' in it");
    CHECK(message_of([&] { (void)file.read_doubles("g"); }) == path + ": g: is not a data set");
    CHECK(message_of([&] { (void)file.read_doubles("g/names"); }) == path + ": g/names: holds no real numbers");
    CHECK(message_of([&] { (void)file.read_ints("x"); }) == path + ": x: holds no integers");
    CHECK(message_of([&] { (void)file.read_strings("x"); }) == path + ": x: holds no texts");
    CHECK(message_of([&] { (void)file.read_complex("x"); }) == path + ": x: holds no complex numbers {r, i}");
    CHECK(message_of([&] { (void)file.children("x"); }) == path + ": x: is not a group");
    CHECK_NOTHROW(file.finish());  // a failed query does no harm to what is being written
}

TEST_CASE("hdf5: misuse is refused and leaves the file as it was", "[property]") {
    const Folder folder;
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    file.write("x", ramp(4), {4}, {"m", "x"});
    file.write("t", ramp(2), {2}, {"s", "t"});
    const auto refused = [](auto action) {
        CHECK_THROWS_AS(action(), InputError);
        return message_of(action);
    };
    using V = std::vector<double>;
    CHECK_THAT(refused([&] { file.write("y", V{1.0}, {1}, {"", "y"}); }), Contains("a.h5: y: units are missing"));
    CHECK_THAT(refused([&] { file.write("y", V{1.0}, {1}, {"m", ""}); }), Contains("y: long_name is missing"));
    CHECK_THAT(refused([&] { file.write("y", std::vector<std::string>{"p"}, {1}, ""); }),
               Contains("y: long_name is missing"));
    CHECK_THAT(refused([&] {
                   file.write("y", V{1.0}, {2, 3}, {"m", "y"});
               }),
               Contains("y: 1 values do not fill a shape of 6"));
    CHECK_THAT(refused([&] { file.write("y", std::vector<std::string>{"p"}, {2}, "y"); }),
               Contains("y: 1 values do not fill a shape of 2"));
    constexpr std::size_t large = std::size_t{1} << 32;  // large * large = 0 in 64 bits
    CHECK_THAT(refused([&] {
                   file.write("y", V{}, {large, large}, {"m", "y"});
               }),
               Contains("y: 0 values do not fill a shape of more than 2^64"));
    CHECK_THAT(refused([&] { file.write("x", V{1.0}, {1}, {"m", "y"}); }), Contains("x: exists already"));
    CHECK_THAT(refused([&] { file.write("x/y", V{1.0}, {1}, {"m", "y"}); }), Contains("x is a data set, not a group"));
    CHECK_THAT(refused([&] { file.make_group("x"); }), Contains("x is a data set, not a group"));
    for (const char* name : {"", "/", "a//b", "a/", "./a", "a/../b"}) {
        CHECK_THAT(refused([&] { file.write(name, V{1.0}, {1}, {"m", "y"}); }), Contains("is not a name"));
    }
    CHECK_THAT(refused([&] {
                   file.write("y", V{1.0}, {1}, {"m", "y", {{"", 1.0}}});
               }),
               Contains("an attribute has no name"));
    const std::string nul("a\0b", 3);
    CHECK_THAT(refused([&] { file.write("y", std::vector<std::string>{nul}, {1}, "y"); }), Contains("NUL"));
    CHECK_THAT(refused([&] { file.set_attribute("x", {"note", nul}); }), Contains("attribute note contains a NUL"));
    CHECK_THAT(refused([&] { file.set_attribute("x", {"note", "\xFF"}); }), Contains("attribute note is not UTF-8"));
    CHECK_THAT(refused([&] {
                   file.write("y", std::vector<std::string>{"a", "\xC3"}, {2}, "y");
               }),
               Contains("y: text 1 is not UTF-8"));
    CHECK_THAT(refused([&] { file.write("\xE4", V{1.0}, {1}, {"m", "y"}); }), Contains("is not a name"));
    CHECK_THAT(refused([&] { file.attach("x", 0, "t"); }), Contains("t: is not a dimension"));
    file.make_dimension("t");
    CHECK_THAT(refused([&] { file.make_dimension("t"); }), Contains("is a dimension already"));
    CHECK_THAT(refused([&] { file.attach("x", 0, "t"); }), Contains("x: axis 0 has 4 values, t has 2"));
    CHECK_THAT(refused([&] { file.attach("x", 1, "t"); }), Contains("x: axis 1 of 1"));
    CHECK_THAT(refused([&] { file.attach("t", 0, "t"); }), Contains("is itself a dimension"));
    CHECK_THROWS_AS(file.attach("x", 0, "absent"), FileError);
    CHECK_THROWS_AS(file.set_attribute("absent", {"a", 1.0}), FileError);
    file.finish();

    Hdf5File back = Hdf5File::open(folder / "a.h5");
    CHECK(back.children() == std::vector<std::string>{"x", "t"});
    CHECK_THAT(refused([&] { back.write("y", V{1.0}, {1}, {"m", "y"}); }), Contains("open for reading"));
    CHECK_THAT(refused([&] { back.finish(); }), Contains("open for reading"));
    const Hdf5File moved = std::move(back);
    CHECK_THROWS_AS(back.children(), InputError);  // NOLINT(bugprone-use-after-move): the point of the test
    CHECK(moved.children().size() == 2);
}

TEST_CASE("hdf5: a full disk is an error, the program goes on, and no broken file gets the name", "[property]") {
    const Folder folder;
    const std::string path = folder / "a.h5";
    SECTION("from the first byte on") {
        fs::create_symlink("/dev/full", path + ".partial");
        Hdf5File file = Hdf5File::create(path);
        CHECK_THROWS_WITH(file.write("x", ramp(100'000), {100'000}, {"m", "x"}),
                          Contains("a.h5: x: cannot be written: No space left on device") ||
                              Contains("a.h5: x: cannot be created: No space left on device"));
        CHECK_THROWS_WITH(file.finish(), Contains("an earlier write failed"));
    }
    SECTION("while a data set is written") {
        Hdf5File file = Hdf5File::create(path);
        const std::vector<std::string> names(100, "a name that takes some room");
        file.write("names", names, {100}, "names");
        {
            const SizeLimit limit(65536);
            CHECK_THROWS_WITH(file.write("big", ramp(100'000), {100'000}, {"m", "x"}),
                              Contains("a.h5: big: cannot be written: File too large"));
        }
        CHECK_THROWS_WITH(file.write("y", ramp(1), {1}, {"m", "y"}), Contains("an earlier write failed"));
        CHECK_THROWS_WITH(file.finish(), Contains("an earlier write failed"));
    }
    SECTION("only when the file is completed") {
        Hdf5File file = Hdf5File::create(path);
        file.write("x", ramp(10), {10}, {"m", "x"});
        file.write("names", std::vector<std::string>{"p"}, {1}, "names");
        const SizeLimit limit(100);
        CHECK_THROWS_WITH(file.finish(), Contains("a.h5: cannot be completed: File too large"));
    }
    SECTION("when the file is given up") {
        const SizeLimit limit(100);
        Hdf5File file = Hdf5File::create(path);
        file.make_group("g", {{"note", "kept in memory until the file is closed"}});
    }
    CHECK_FALSE(fs::exists(path));
    fs::remove(path + ".partial");
    Hdf5File next = Hdf5File::create(path);
    next.write("x", ramp(10), {10}, {"m", "x"});
    next.finish();
    CHECK(Hdf5File::open(path).read_doubles("x") == ramp(10));
}
