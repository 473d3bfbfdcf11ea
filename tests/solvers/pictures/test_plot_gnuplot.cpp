#include "mbs/base/error.hpp"
#include "solvers/pictures/gnuplot.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <unistd.h>
#include <vector>

namespace {

namespace fs = std::filesystem;
using cardan::FileError;
using cardan::InputError;
using cardan::solvers::Gnuplot;
using cardan::solvers::gnuplot_data;
using cardan::solvers::gnuplot_text;
using cardan::test::bytes_of;
using cardan::test::Folder;
using cardan::test::message_of;
using cardan::test::SizeLimit;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

std::string columns(std::string_view name, const std::vector<std::vector<double>>& values) {
    const std::vector<std::span<const double>> spans(values.begin(), values.end());
    return gnuplot_data(name, spans);
}

std::string two_lines() {
    std::vector<std::vector<double>> values(3);
    for (int k = 0; k <= 50; ++k) {
        const double x = 0.2 * k;
        values[0].push_back(x);
        values[1].push_back(k > 20 && k < 25 ? std::numeric_limits<double>::quiet_NaN() : std::sin(x));
        values[2].push_back(std::cos(x));
    }
    return columns("d", values) +
           "set xlabel 'Rotor speed (rpm)'\nset ylabel 'Frequency (Hz)'\n"
           "plot $d using 1:2 with lines lt 1 title " +
           gnuplot_text("first_flap") + ", $d using 1:3 with lines lt 2 dt 2 title 'ζ, Ω'";
}

}  // namespace

TEST_CASE("gnuplot: a picture is a complete SVG, PNG or PDF by the ending of its name", "[property]") {
    const Folder folder;
    const Gnuplot gnuplot;
    for (const char* name : {"a.svg", "a.png", "A.PNG", "a.pdf"}) {
        CHECK(gnuplot.write_picture(folder / name, two_lines()).empty());
        CHECK(fs::file_size(folder / name) > 5000);
    }
    CHECK_THAT(bytes_of(folder / "a.png"), StartsWith("\x89PNG\r\n\x1a\n"));
    CHECK_THAT(bytes_of(folder / "A.PNG"), StartsWith("\x89PNG\r\n\x1a\n"));
    CHECK_THAT(bytes_of(folder / "a.pdf"), StartsWith("%PDF-"));
    const std::string svg = bytes_of(folder / "a.svg");
    CHECK_THAT(svg, StartsWith("<?xml"));
    CHECK_THAT(svg, Contains("DejaVu Sans") && Contains("first_flap") && Contains("ζ, Ω"));
    CHECK_THAT(svg, Contains("width=\"1000\" height=\"700\"") && Contains("fill=\"#ffffff\""));
    CHECK_THAT(svg, Contains("rgb(  0, 114, 178)") && Contains("rgb(213,  94,   0)"));  // blue, vermilion
    CHECK(folder.files() == 4);                                                         // nothing else is left
}

TEST_CASE("gnuplot: a picture has the size asked for", "[property]") {
    const Folder folder;
    (void)Gnuplot().write_picture(folder / "a.png", two_lines(), {640, 480});
    const std::string png = bytes_of(folder / "a.png");
    REQUIRE(png.size() > 24);
    const auto number = [&](std::size_t at) {  // big-endian, in the header chunk
        int value = 0;
        for (std::size_t k = at; k < at + 4; ++k) value = 256 * value + static_cast<unsigned char>(png[k]);
        return value;
    };
    CHECK(number(16) == 640);
    CHECK(number(20) == 480);
    CHECK_THROWS_WITH(Gnuplot().write_picture(folder / "a.png", two_lines(), {0, 480}),
                      Contains("size = 0 x 480; allowed: 50 to 20000 pixels"));
}

TEST_CASE("gnuplot: any text is shown as it is and runs nothing", "[property]") {
    const Folder folder;
    const std::string trap = folder / "trap";
    const std::string nasty = "it's a_b^{c} & @d ~e \\n `touch " + trap + "` \"\nsystem 'touch " + trap + "'\n";
    (void)Gnuplot().write_picture(folder / "a.svg", "plot x title " + gnuplot_text(nasty));
    CHECK_FALSE(fs::exists(trap));
    CHECK_THAT(bytes_of(folder / "a.svg"), Contains("it's a_b^{c} &amp; @d ~e \\n `touch "));
    CHECK(gnuplot_text("a_'\n") == "'a\\_'' '");
}

TEST_CASE("gnuplot: a path may contain quotes, blanks, bars and line ends and runs nothing", "[property]") {
    const Folder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder.path);
    for (const char* name :
         {"it's.svg", "a b.png", "| touch trap; cat > x.svg", "`touch trap`.svg", "~.svg", "a\nplot x.svg"}) {
        CHECK_NOTHROW(Gnuplot().write_picture(name, "plot x"));
        CHECK(fs::is_regular_file(name));
    }
    CHECK_FALSE(fs::exists("trap"));
    CHECK(folder.files() == 6);
    fs::current_path(before);
}

TEST_CASE("gnuplot: data keep every digit, and gaps are NaN", "[property]") {
    const double third = 1.0 / 3.0;
    const double infinity = std::numeric_limits<double>::infinity();
    CHECK(columns("a_1", {{1.0, -2.5e-300}, {third, -infinity}}) ==
          "$a_1 << EOD\n1 0.3333333333333333\n-2.5e-300 NaN\nEOD\n");
    CHECK(columns("none", {}) == "$none << EOD\nEOD\n");
    for (const char* name : {"", "1a", "a b", "a\nplot"}) CHECK_THROWS_AS(columns(name, {{1.0}}), InputError);
    CHECK_THROWS_WITH(columns("a", {{1.0, 2.0}, {1.0}}), Contains("gnuplot data a: length = 1; allowed: 2"));
    CHECK(Gnuplot().run(columns("d", {{third}}) + "stats $d using 1 nooutput\nprint STATS_max - 1.0/3.0 == 0") == "1");
}

TEST_CASE("gnuplot: a script returns what it prints, however much that is", "[property]") {
    CHECK(Gnuplot().run("print 6*7").ends_with("42"));
    CHECK(Gnuplot().run("").empty());
    CHECK(Gnuplot().run("do for [k=1:20000] { print 'a line to fill a pipe' }").size() > 400'000);
    const std::string many(1'000'000, '#');
    CHECK(Gnuplot().run(many + "\nprint 1") == "1");
}

TEST_CASE("gnuplot: a script that fails stops there and is an error with gnuplot's message", "[property]") {
    const std::string message = message_of([] { (void)Gnuplot().run("x = 1\nbogus x\nprint 'still running'"); });
    CHECK_THAT(message, StartsWith("gnuplot: failed:\n"));
    CHECK_THAT(message, Contains("bogus x") && Contains("\"script\" line 2: invalid command"));
    CHECK_THAT(message, !Contains("still running"));

    const Folder folder;
    std::ofstream(folder / "a.svg") << "older picture";
    CHECK_THROWS_WITH(Gnuplot().write_picture(folder / "a.svg", "plot 'no such file'"), Contains("no such file"));
    CHECK(bytes_of(folder / "a.svg") == "older picture");
    CHECK_THROWS_WITH(Gnuplot().write_picture(folder / "a.svg", "x = 1"), Contains("the picture is not complete"));
    CHECK(bytes_of(folder / "a.svg") == "older picture");
    CHECK(folder.files() == 1);
}

TEST_CASE("gnuplot: one process draws many pictures, each as if it were the first", "[property]") {
    const Folder folder;
    const Gnuplot one;
    const std::string asked = "print system('echo $PPID')", process = one.run(asked);
    CHECK(one.run("y = 3\nset logscale x\nset xlabel 'other'\n" + columns("d", {{1.0}}) + "print y") == "3");
    CHECK(one.run("print exists('y'), ' ', exists('$d')") == "0   0");
    for (const char* name : {"a.svg", "b.svg", "a.png", "b.png"})
        CHECK(one.write_picture(folder / name, two_lines()).empty());
    CHECK(one.run(asked) == process);
    (void)Gnuplot().write_picture(folder / "c.svg", two_lines());
    (void)Gnuplot().write_picture(folder / "c.png", two_lines());
    for (const char* name : {"b", "c"}) {
        CHECK(bytes_of(folder / (std::string(name) + ".svg")) == bytes_of(folder / "a.svg"));
        CHECK(bytes_of(folder / (std::string(name) + ".png")) == bytes_of(folder / "a.png"));
    }
    // After an error nothing is left of the script: another process.
    CHECK_THROWS_WITH(one.run("set multiplot\nbogus"), Contains("line 2: invalid command"));
    CHECK(one.run(asked) != process);
}

TEST_CASE("gnuplot: a process that was killed is started again", "[property]") {
    const Gnuplot one;
    CHECK(one.run("print 1") == "1");
    CHECK_THROWS_WITH(one.run("system('kill -9 ' . system('echo $PPID'))"), Contains("ended by signal 9"));
    CHECK(one.run("print 2") == "2");
}

TEST_CASE("gnuplot: a missing or broken program is an error that says what to do", "[property]") {
    CHECK(message_of([] { (void)Gnuplot("no-such-gnuplot").run("plot x"); }) ==
          "no-such-gnuplot: not found; pictures need gnuplot (Debian: apt install gnuplot-nox)");
    CHECK_THROWS_AS(Gnuplot("no-such-gnuplot").run("plot x"), FileError);
    CHECK_THROWS_WITH(Gnuplot("/dev/null").run("plot x"), Contains("/dev/null: cannot be run: "));
    CHECK_THROWS_WITH(Gnuplot("false").run("plot x"), Contains("false: failed:"));
    const Folder folder;
    {
        std::ofstream script(folder / "dies");
        script << "#!/bin/sh\nkill -9 $$\n";
    }
    fs::permissions(folder / "dies", fs::perms::owner_all);
    CHECK_THROWS_WITH(Gnuplot(folder / "dies").run("plot x"), Contains("dies: ended by signal 9"));
}

TEST_CASE("gnuplot: a missing folder for temporary files is an error", "[property]") {
    const char* const set = std::getenv("TMPDIR");
    const std::string before = set == nullptr ? "" : set;
    ::setenv("TMPDIR", "/no/such/folder", 1);
    const std::string message = message_of([] { (void)Gnuplot().run("print 1"); });
    set == nullptr ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", before.c_str(), 1);
    CHECK_THAT(message, Contains("TMPDIR"));
}

TEST_CASE("gnuplot: a path that cannot be written is an error before anything runs", "[property]") {
    const Folder folder;
    const Gnuplot never("no-such-gnuplot");
    const auto reason = [&](const std::string& path) {
        CHECK_THROWS_AS(never.write_picture(path, "plot x"), FileError);
        return message_of([&] { (void)never.write_picture(path, "plot x"); });
    };
    CHECK_THAT(reason(folder / "a.gif"), EndsWith("a.gif: a picture ends in .svg, .png or .pdf"));
    CHECK_THAT(reason(folder / "svg"), EndsWith("a picture ends in .svg, .png or .pdf"));
    CHECK_THAT(reason(""), Contains("a picture ends in"));
    CHECK_THAT(reason(folder / "none/a.svg"), Contains("none/a.svg: the folder ") && EndsWith("does not exist"));
    fs::create_directory(folder / "b.svg");
    CHECK_THAT(reason(folder / "b.svg"), Contains("b.svg: is a folder, not a file"));
    fs::create_directory(folder / "c.svg.partial");
    CHECK_THAT(reason(folder / "c.svg"), Contains("c.svg: cannot be written: Is a directory"));
    fs::create_symlink("/dev/null", folder / "null.svg");
    CHECK_THAT(reason(folder / "null.svg"), Contains("exists and is not an ordinary file"));
    if (::geteuid() != 0) {  // root may write anywhere
        fs::create_directory(folder / "locked");
        fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
        CHECK_THAT(reason(folder / "locked/a.svg"), Contains("cannot be written: Permission denied"));
    }
}

TEST_CASE("gnuplot: a full disk is an error although gnuplot does not notice", "[property]") {
    const Folder folder;
    for (const char* name : {"a.svg", "a.png", "a.pdf"}) {
        {
            const SizeLimit limit(8192);
            CHECK_THROWS_WITH(Gnuplot().write_picture(folder / name, two_lines()),
                              Contains("the picture is not complete: is the size of files limited"));
        }
        fs::create_symlink("/dev/full", folder / (std::string(name) + ".partial"));
        CHECK_THROWS_AS(Gnuplot().write_picture(folder / name, two_lines()), FileError);
    }
    CHECK(folder.files() == 0);
    const SizeLimit limit(10);
    CHECK_THROWS_WITH(Gnuplot().run(two_lines()), Contains("cannot be written: File too large"));
}

TEST_CASE("gnuplot: the palette has distinct names and colours and begins again after the last", "[property]") {
    using cardan::solvers::colour;
    using cardan::solvers::palette;
    std::set<std::string_view> seen;
    for (const auto& c : palette) {
        CHECK(c.hex.size() == 7);
        CHECK(c.hex.front() == '#');
        CHECK(c.hex.find_first_not_of("0123456789abcdef", 1) == std::string_view::npos);
        seen.insert(c.name);
        seen.insert(c.hex);
    }
    CHECK(seen.size() == 2 * palette.size());
    CHECK(colour(0).name == "blue");
    CHECK(colour(palette.size() + 1).name == colour(1).name);
}
