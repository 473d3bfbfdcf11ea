// Arrays with axes: scales and labels in every group that has arrays over them.
#include "mbs/base/error.hpp"
#include "solvers/hdf5/axis.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

using namespace cardan;
using namespace cardan::solvers;
using cardan::test::Folder;

namespace {

struct TwoAxes {
    Hdf5Axis speed{"speed", std::vector<double>{1, 2.5}, {"rad s-1", "rotor speed"}};
    Hdf5Axis mode = counting_axis("mode", 3, "index of the mode", {text_label("name", {"a", "b", "c"}, "its name")});
};

}  // namespace

TEST_CASE("hdf5 axes: every group has the scales and labels of its own arrays, once", "[property]") {
    const TwoAxes e;
    const Folder folder;
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    const std::vector<double> values{1, 2, 3, 4, 5, 6};
    write_array(file, "g/x", values, {e.speed, e.mode}, {"m", "x", {{"note", "kept"}}});
    write_array(file, "g/y", std::vector<int>{7, 8, 9}, {e.mode}, {"1", "y"});
    write_array(file, "z", std::vector<std::complex<double>>{{1, 2}, {3, 4}}, {e.speed}, {"s-1", "z"});
    write_array(file, "kind", std::vector<std::string>{"p", "q"}, {e.speed}, "kind");
    file.finish();
    const Hdf5File back = Hdf5File::open(folder / "a.h5");
    CHECK(back.children("g") == std::vector<std::string>{"speed", "mode", "name", "string1", "x", "y"});
    CHECK(back.read_doubles("g/x") == values);
    CHECK(back.shape("g/x") == Shape{2, 3});
    CHECK(back.dimension("g/x", 0) == "/g/speed");
    CHECK(back.dimension("g/x", 1) == "/g/mode");
    CHECK(back.dimension("g/name", 0) == "/g/mode");
    CHECK(back.read_doubles("g/speed") == std::vector<double>{1, 2.5});
    CHECK(back.read_ints("g/mode") == std::vector<std::int64_t>{0, 1, 2});
    CHECK(back.read_strings("g/name") == std::vector<std::string>{"a", "b", "c"});
    CHECK(back.string_attribute("g/x", "coordinates") == "name");
    CHECK(back.string_attribute("g/x", "note") == "kept");
    CHECK_FALSE(back.has_attribute("g/name", "coordinates"));
    for (const char* name : {"z_real", "z_imag", "kind"}) CHECK(back.dimension(name, 0) == "/speed");
    CHECK_FALSE(back.has_attribute("kind", "coordinates"));
    CHECK_FALSE(back.has("mode"));
}

TEST_CASE("hdf5 axes: labels may be numbers, and an axis may have others elsewhere", "[property]") {
    const Folder folder;
    const Hdf5Axis azimuth{"azimuth",
                           std::vector<double>{0, 3},
                           {"rad", "azimuth"},
                           {{"time", std::vector<double>{0, 0.5}, {"s", "time"}},
                            {"part", std::vector<int>{1, 2}, {"1", "part of the revolution"}}}};
    const Hdf5Axis named = azimuth.with({text_label("name", {"up", "down"}, "where blade 1 is")});
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    const std::vector<double> values{1, 2};
    write_array(file, "a/x", values, {azimuth}, {"m", "x"});
    write_array(file, "b/x", values, {named}, {"m", "x"});
    CHECK(file.read_doubles("a/time") == std::vector<double>{0, 0.5});
    CHECK(file.read_ints("a/part") == std::vector<std::int64_t>{1, 2});
    CHECK(file.string_attribute("a/time", "units") == "s");
    CHECK(file.string_attribute("a/x", "coordinates") == "time part");
    CHECK(file.string_attribute("b/x", "coordinates") == "name");
    CHECK_FALSE(file.has("b/time"));
}

TEST_CASE("hdf5 axes: values that do not fill the axes, and labels that do not fit theirs, are refused", "[property]") {
    const TwoAxes e;
    const Folder folder;
    Hdf5File file = Hdf5File::create(folder / "a.h5");
    const std::vector<double> values{1, 2};
    CHECK_THROWS_WITH(write_array(file, "x", values, {e.mode}, {"m", "x"}),
                      Catch::Contains("x: 2 values do not fill a shape of 3"));
    const Hdf5Axis wrong = e.mode.with({text_label("short", {"a"}, "too few")});
    CHECK_THROWS_WITH(write_axis(file, "g/", wrong), Catch::Contains("axis 0 has 1 values, g/mode has 3"));
}
