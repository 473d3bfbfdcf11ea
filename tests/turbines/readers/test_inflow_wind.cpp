// InflowWind's files and tables of winds over time.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "turbines/readers/inflow_wind.hpp"

#include <fstream>

namespace cardan::testing::inflow_wind_tests {

namespace {

using namespace turbines;

class WindFiles {
public:
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
    std::string operator/(const std::string& name) const { return folder_ / name; }

private:
    test::Folder folder_;
};

template <class Call>
void check_wind_error(Call&& call, std::initializer_list<std::string> parts) {
    const std::string message = test::message_of(call);
    for (const std::string& part : parts) {
        CAPTURE(message, part);
        CHECK(message.find(part) != std::string::npos);
    }
}

std::string main_file(const std::string& kind, const std::string& more = "") {
    return "------- InflowWind INPUT FILE ---\ntitle\n-----\n" + kind + " WindType - kind\n30 PropagationDir - deg\n" +
           more +
           "===== steady =====\n12 HWindSpeed - m/s\n42.672 RefHt - m\n0.2 PLexp - exponent\n===== uniform =====\n"
           "\"a.wnd\" Filename - name\n90 RefHt - m\n60 RefLength - m\n===== TurbSim =====\n\"b.bts\" Filename - name\n"
           "===== HAWC =====\n10 RefHt - m\n0.1 PLExp - exponent\n";
}

}  // namespace

TEST_CASE("inflow wind: steady winds; what has their keywords again; others are refused", "[analytic]") {
    const WindFiles files;
    files.write("wind.dat", main_file("1"));
    const SteadyWind wind = read_inflow_wind(files / "wind.dat").wind.rows().front();
    CHECK(wind.speed == 12);
    CHECK(wind.reference_height == 42.672);
    CHECK(wind.shear == Shear::power);
    CHECK(wind.exponent == 0.2);
    CHECK(wind.direction == Approx(-30 * units::degree));
    CHECK(wind.at({0, 0, 42.672}).y() == Approx(-6));  // a positive angle turns toward -y
    files.write("wind.dat", main_file("6"));
    check_wind_error([&] { static_cast<void>(read_inflow_wind(files / "wind.dat")); },
                     {"wind.dat:4", "WindType = 6; allowed: 1 ... 5 and 7", "user-defined"});
    files.write("wind.dat", main_file("8"));
    check_wind_error([&] { static_cast<void>(read_inflow_wind(files / "wind.dat")); },
                     {"wind.dat:4", "WindType = 8; allowed: 1, steady"});
    files.write("wind.dat", main_file("1", "8 VFlowAng - deg\n"));
    CHECK(read_inflow_wind(files / "wind.dat").wind.axes()->upflow == Approx(8 * units::degree));
    files.write("wind.dat", main_file("1", "1e9 VFlowAng - deg\n"));
    check_wind_error([&] { static_cast<void>(read_inflow_wind(files / "wind.dat")); },
                     {"wind.dat:5", "upflow [rad] = 17453292.5"});
}

TEST_CASE("inflow wind: uniform wind over time", "[analytic]") {
    const WindFiles files;
    files.write("wind.dat", main_file("2"));
    files.write("a.wnd",
                "! time speed dir vert. horiz. shear exp. lin. gust\n0.0 10.0 0 0.5 0.3 0.2 0.06 1\n"
                "10.0, 12.0, 10, 0.5, 0.3, 0.2, 0.06, 1  ! end\n");
    const Wind wind = read_inflow_wind(files / "wind.dat").wind;
    CHECK(wind.breaks() == std::vector<double>{0, 10});
    // As AeroDyn's users know it [InflowWind, uniform wind]: V ((z/RefHt)^exponent + linear (z - RefHt)/RefLength +
    // horizontal y'/RefLength) + gust, toward -y by PropagationDir and the row's direction.
    const double angle = (30 + 5) * units::degree, y = 12;
    const Vec3 place(y * std::sin(angle), y * std::cos(angle), 60);
    const double speed = 11 * (std::pow(60.0 / 90, 0.2) - 0.06 * 30 / 60 + 0.3 * y / 60) + 1;
    const Vec3 expected(speed * std::cos(angle), -speed * std::sin(angle), 0.5);
    CHECK((wind.at(5).at(place) - expected).norm() < 1e-12 * speed);

    // Fortran takes commas, tabs and blanks alike, numbers without the letter of their exponent, and leaves the rest.
    files.write("a.wnd", "0,10.0,0,0.5,0.3,0.2,0.06,1\n1.0+01\t12.0,\t10,5.D-1 ,.3,0.2,0.06,1,0 and a remark\r\n");
    CHECK((read_inflow_wind(files / "wind.dat").wind.at(5).at(place) - expected).norm() < 1e-12 * speed);

    files.write("a.wnd", "0 10 0 0 0 0 0 0\n-1 12 0 0 0 0 0 0\n");
    check_wind_error([&] { static_cast<void>(read_inflow_wind(files / "wind.dat")); }, {"a.wnd:2", "time = -1 s"});
    files.write("a.wnd", "0 10 0 0 0\n");
    check_wind_error([&] { static_cast<void>(read_inflow_wind(files / "wind.dat")); }, {"a.wnd:1", "8 numbers", "5"});
    files.write("a.wnd", "0 10 0 0 0 0 0 x\n");
    check_wind_error([&] { static_cast<void>(read_inflow_wind(files / "wind.dat")); }, {"a.wnd:1", "'x'"});
    files.write("a.wnd", "! nothing\n");
    check_wind_error([&] { static_cast<void>(read_inflow_wind(files / "wind.dat")); }, {"a.wnd:1", "no rows"});
    files.write("wind.dat", main_file("2") + "\n");
    std::filesystem::remove(files / "a.wnd");
    check_wind_error([&] { static_cast<void>(read_inflow_wind(files / "wind.dat")); }, {"wind.dat:", "a.wnd"});
}

TEST_CASE("winds over time as a table: what it has, the rest from a steady wind", "[analytic]") {
    const WindFiles files;
    files.write("wind.csv", "time[s],speed[m/s],direction[deg],gust[m/s]\n0,8,0,0\n4,10,20,1\n4,12,20,1\n");
    const Wind wind = read_wind_table(files / "wind.csv", {.reference_height = 70, .density = 1.1});
    CHECK(wind.without_box(2).speed == Approx(9));
    CHECK(wind.without_box(2).direction == Approx(10 * units::degree));
    CHECK(wind.without_box(2).gust == Approx(0.5));
    CHECK(wind.without_box(4).speed == 12);
    CHECK(wind.without_box(1).reference_height == 70);
    CHECK(wind.without_box(1).density == 1.1);
    files.write("wind.csv", "time[s],speed[m/s]\n1,8\n0,9\n");
    check_wind_error([&] { static_cast<void>(read_wind_table(files / "wind.csv", {})); },
                     {"wind.csv", "row 2", "time [s] = 0"});
}

}  // namespace cardan::testing::inflow_wind_tests
