// Rated speeds of ServoDyn's files and of the controllers they name.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/readers/servodyn.hpp"

using namespace cardan;
using namespace cardan::turbines;
using Catch::Matchers::Contains;

namespace {

// Another control mode, with further entries.
ServoDyn with(const std::string& mode, const std::string& entries = "") {
    const test::ModelFolder model("openfast");
    model.replace("small_ServoDyn.dat", "             1   VSContrl ",
                  entries + "             " + mode + "   VSContrl ");
    return read_servodyn(model / "small_ServoDyn.dat");
}

}  // namespace

TEST_CASE("servodyn: the rated speed comes from what drives the generator", "[analytic]") {
    const ServoDyn torque_law = with("1");
    CHECK(torque_law.rated_generator_speed == Approx(1150 * units::rpm).epsilon(1e-15));
    CHECK(torque_law.speed_source == "VS_RtGnSp of small_ServoDyn.dat");
    // 1800 rpm and 2 % of slip; 60 Hz on two pairs of poles turn at 30 Hz.
    const ServoDyn simple = with("0", "1 GenModel\n2.0 SIG_SlPc\n1800 SIG_SySp\n");
    CHECK(simple.rated_generator_speed == Approx(1836 * units::rpm).epsilon(1e-15));
    const ServoDyn thevenin = with("0", "2 GenModel\n60 TEC_Freq\n4 TEC_NPol\n");
    CHECK(thevenin.rated_generator_speed == Approx(2 * pi * 30).epsilon(1e-15));
    CHECK(thevenin.speed_source == "TEC_Freq and TEC_NPol of small_ServoDyn.dat");
    // A routine of the user's says nothing.
    CHECK(with("3").rated_generator_speed == 0);
    CHECK_THAT(test::message_of([] { (void)with("7"); }), Contains("VSContrl = 7; allowed: 0 ... 5"));
}

TEST_CASE("servodyn: a ROSCO controller's file has the rated speed; others, and none, are no error", "[analytic]") {
    const test::ModelFolder model("openfast");
    model.replace("small_ServoDyn.dat", "             1   VSContrl ",
                  "\"sub\\DISCON.IN\" DLL_InFile\n             5   VSContrl ");
    const auto read = [&] { return read_servodyn(model / "small_ServoDyn.dat"); };
    CHECK(read().rated_generator_speed == 0);
    CHECK(test::has_note(read().notes, "DLL_InFile", "it may have the rated speed"));
    std::filesystem::create_directory(model / "sub");
    model.write("sub/DISCON.IN",
                "! a table\n 0.1 0.2 ! PC_GS_angles - deg\n122.9096      ! PC_RefSpd - HSS speed, [rad/s].\n");
    CHECK(read().rated_generator_speed == 122.9096);
    CHECK(read().speed_source == "PC_RefSpd of DISCON.IN");
    model.write("sub/DISCON.IN", std::string("\0\1binary", 8));
    CHECK(read().rated_generator_speed == 0);
}
