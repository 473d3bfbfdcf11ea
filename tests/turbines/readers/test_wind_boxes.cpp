// Wind boxes from files against InflowWind's own evaluation of them, and what their headers say.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/wind_box_files.hpp"
#include "turbines/readers/bladed_box.hpp"
#include "turbines/readers/turbsim_box.hpp"

#include <cstring>

namespace cardan::testing::wind_box_file_tests {

namespace {

using namespace turbines;
using test::wind_file;

// The wind as InflowWind's manual has it: places turned about the reference height above the origin, the velocity in
// the box and the mean wind there, turned back. @param clockwise  PropagationDir, seen from above, rad
Vec3 turned_wind(const WindBoxFile& file, double clockwise, double upflow, const Vec3& place, double time) {
    const double a = -clockwise, b = -upflow, ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b);
    Mat3 M;
    M << cb * ca, cb * sa, -sb, -sa, ca, 0, sb * ca, sb * sa, cb;
    const Vec3 pivot(0, 0, file.mean.reference_height), own = M * (place - pivot) + pivot;
    Vec3 velocity = file.box->at(own, time);
    if (own.z() > 0 && file.mean.speed > 0) velocity += file.mean.at(own);
    return M.transpose() * velocity;
}

bool agrees(const Vec3& is, const Vec3& printed) {
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(is(c) - printed(c)) <= test::digits_of(printed(c)))) return false;
    return true;
}

// By the formulas above, and as class Wind.
void check_values(const std::string& name, std::size_t rows, const WindBoxFile& file, double clockwise = 0,
                  double upflow = 0) {
    const std::vector<test::WindValue> values = test::wind_values(name);
    CHECK(values.size() == rows);
    clockwise -= file.direction;
    upflow += file.upflow;
    const Wind wind = Wind(file.box, file.mean).turned(-clockwise, upflow);
    for (const test::WindValue& one : values) {
        CAPTURE(name, one.place.transpose(), one.time, one.velocity.transpose());
        const Vec3 by_hand = turned_wind(file, clockwise, upflow, one.place, one.time);
        CAPTURE(by_hand.transpose());
        CHECK(agrees(by_hand, one.velocity));
        // Not above the ground a mean has a wind.
        if (one.place.z() > 0) CHECK(agrees(wind.at(one.time).at(one.place), one.velocity));
    }
}

}  // namespace

TEST_CASE("wind boxes: TurbSim's files, aperiodic and periodic, with points of the tower", "[discrete]") {
    check_values("bts7", 100, read_turbsim_box(wind_file("box7.bts")));
    check_values("bts8", 160, read_turbsim_box(wind_file("box8.bts")));
    check_values("bts8 PropagationDir -20 VFlowAng 8", 40, read_turbsim_box(wind_file("box8.bts")), -20 * units::degree,
                 8 * units::degree);
}

TEST_CASE("wind boxes: files of Bladed's kind, with a summary and native", "[discrete]") {
    check_values("wnd type 4 nrel", 60, read_bladed_box(wind_file("nrel.wnd")));
    check_values("wnd native", 100, read_native_bladed_box(wind_file("native.ipt")));
    check_values("wnd native WDIR 0.15 FLINC 0.05", 40, read_native_bladed_box(wind_file("native_turned.ipt")));
}

TEST_CASE("wind boxes: HAWC2's files as they are, and scaled under a logarithmic mean", "[discrete]") {
    Hawc2Box box = test::hawc2_box_in(wind_file("."));
    check_values("hawc", 160, read_hawc2_box(box));
    box.start = 0;
    box.scaling = BoxScaling::deviations;
    box.deviations = {1.7, 1.3, 0.9};
    box.mean.shear = Shear::logarithmic;
    box.mean.roughness = 0.03;
    check_values("hawc scaled log", 100, read_hawc2_box(box));
}

TEST_CASE("wind boxes: by what a file begins with", "[property]") {
    CHECK(read_wind_box(wind_file("box8.bts")).box->data().origin.format == "TurbSim .bts");
    CHECK(read_wind_box(wind_file("nrel.wnd")).box->data().origin.format == "Bladed .wnd with .sum");
    CHECK(read_wind_box(wind_file("native.ipt")).box->data().origin.format == "Bladed .wnd");
    CHECK(read_wind_box(wind_file("box8.bts")).box->data().origin.note == "own box, random");
}

TEST_CASE("wind boxes: origins have all files and the checksum of their bytes", "[property]") {
    const auto check = [](const WindBoxFile& file, const std::vector<std::string>& names) {
        std::vector<std::string> paths;
        std::uint64_t sum = checksum_of({});
        for (const std::string& name : names) {
            paths.push_back(wind_file(name));
            const std::string bytes = test::bytes_of(paths.back());
            sum = checksum_of(std::as_bytes(std::span(bytes)), sum);
        }
        const WindBoxData& data = file.box->data();
        CHECK(data.origin.files == paths);
        CHECK(data.origin.checksum == checksum_text(sum));
        for (const BoxNumbers& of : data.components) {  // the numbers are in the file where it is said
            const std::string bytes = test::bytes_of(paths[static_cast<std::size_t>(of.file)]);
            const std::size_t size = of.type == BoxNumbers::Type::int16 ? 2 : 4;
            CHECK(std::memcmp(bytes.data() + of.place, of.data, size) == 0);
        }
    };
    check(read_turbsim_box(wind_file("box7.bts")), {"box7.bts"});
    check(read_bladed_box(wind_file("nrel.wnd")), {"nrel.wnd", "nrel.sum"});
    check(read_native_bladed_box(wind_file("native.ipt")), {"native.wnd", "native.ipt"});
    check(read_hawc2_box(test::hawc2_box_in(test::wind_file("."))), {"./hawc_u.bin", "./hawc_v.bin", "./hawc_w.bin"});
}

}  // namespace cardan::testing::wind_box_file_tests
