// Rated speeds of ServoDyn's files and of the controllers they name.
#include "mbs/base/error.hpp"
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

TEST_CASE("servodyn: library, input, period and efficiency are kept; what no library reads is not its input",
          "[property]") {
    const test::ModelFolder model("openfast");
    model.replace("small_ServoDyn.dat", "             1   VSContrl ",
                  "\"lib/libdiscon.so\" DLL_FileName\n\"DISCON.IN\" DLL_InFile\n0.02 DLL_DT\n1 Ptch_Cntrl\n"
                  "             5   VSContrl ");
    const auto read = [&] { return read_servodyn(model / "small_ServoDyn.dat").controller; };
    CHECK(read().library == model / "lib/libdiscon.so");
    CHECK(read().input == model / "DISCON.IN");
    CHECK(read().period == 0.02);
    CHECK(read().generator_efficiency == Approx(0.95).epsilon(1e-15));
    CHECK(read().individual_pitch);
    model.replace("small_ServoDyn.dat", "0.02 DLL_DT", "\"default\" DLL_DT");
    CHECK(read().period == 0);
    model.replace("small_ServoDyn.dat", "5   VSContrl ", "1   VSContrl ");
    CHECK(read().library.empty());
    CHECK(read().input.empty());
    CHECK(read().generator_efficiency == Approx(0.95).epsilon(1e-15));
}

TEST_CASE("servodyn: the pitch below rated power is that of the controller", "[analytic]") {
    const test::ModelFolder model("openfast");
    model.replace("small_ServoDyn.dat", "             0   PCMode ",
                  "\"DISCON.IN\" DLL_InFile\n             5   PCMode ");
    model.replace("small_ServoDyn.dat", "             1   VSContrl ", "             5   VSContrl ");
    const auto read = [&](const std::string& mode) {
        // Tip speed ratio 8 and a radius of 16 m: at a wind of v the rotor turns at v / 2, geared 20 to 1 between 60
        // and 100 rad/s of the generator, 3 and 5 of the rotor, at 6 and 10 m/s.
        model.write("DISCON.IN", mode +
                                     " ! PS_Mode - schedule\n100.0 ! PC_RefSpd\n0.02 ! PC_FinePit\n60.0 ! VS_MinOMSpd\n"
                                     "8.0 ! VS_TSRopt\n16.0 ! WE_BladeRadius\n20.0 ! WE_GearboxRatio\n"
                                     "3 5 7 9 11 13 ! PS_WindSpeeds\n0.09 0.08 0.05 0.03 0.04 0.2 ! PS_BldPitchMin\n");
        return read_servodyn(model / "small_ServoDyn.dat");
    };
    const ServoDyn scheduled = read("1");
    CHECK(scheduled.fine_pitch == 0.02);
    CHECK(scheduled.pitch_source == "PS_BldPitchMin of DISCON.IN");
    REQUIRE(scheduled.pitch_schedule.size() == 4);
    const double speeds[] = {3, 3.5, 4.5, 5}, pitch[] = {0.08, 0.05, 0.03, 0.04};
    for (std::size_t i = 0; i < 4; ++i) {
        CHECK(scheduled.pitch_schedule[i].rotor_speed == Approx(speeds[i]).epsilon(1e-14));
        CHECK(scheduled.pitch_schedule[i].pitch == pitch[i]);
    }
    CHECK(pitch_at(scheduled.pitch_schedule, 4) == Approx(0.04).epsilon(1e-12));
    CHECK(pitch_at(scheduled.pitch_schedule, 0) == 0.08);
    CHECK(pitch_at(scheduled.pitch_schedule, 9) == 0.04);
    // The same over the wind, with what else the controller knows of the machine in it.
    CHECK(scheduled.operation.least_speed == Approx(3).epsilon(1e-14));
    CHECK(scheduled.operation.tip_speed_ratio == 8);
    CHECK(scheduled.operation.rated_power == 0);
    CHECK(scheduled.operation.source == "DISCON.IN");
    CHECK(pitch_at(scheduled.operation.least_pitch, 10) == Approx(0.035).epsilon(1e-14));
    CHECK(pitch_at(scheduled.operation.least_pitch, 20) == 0.2);
    CHECK(pitch_at(scheduled.operation.least_pitch, 1) == 0.09);
    CHECK_THROWS_AS(pitch_at(std::vector<PitchAtWind>(), 1), InputError);
    CHECK_THROWS_AS(pitch_at(std::vector<PitchAtWind>{{2, 0}, {2, 0}}, 1), InputError);
    const ServoDyn constant = read("0");
    CHECK(constant.operation.least_pitch.empty());
    CHECK(constant.pitch_schedule.empty());
    CHECK(constant.pitch_source == "PC_FinePit of DISCON.IN");
    CHECK_THROWS_AS(pitch_at(std::vector<PitchAt>(), 1), InputError);
}

TEST_CASE("servodyn: gains of a ROSCO controller are kept, those of the pitch positive", "[analytic]") {
    const test::ModelFolder model("openfast");
    model.replace("small_ServoDyn.dat", "             1   VSContrl ",
                  "\"DISCON.IN\" DLL_InFile\n             5   VSContrl ");
    model.write("DISCON.IN",
                "0.05 0.2 ! PC_GS_angles - rad\n-0.02 0.004 ! PC_GS_KP - s\n-0.003 -0.001 ! PC_GS_KI\n"
                "1.5 ! PC_MaxPit\n-0.02 ! PC_MinPit\n0.1 ! PC_MaxRat\n122.9 ! PC_RefSpd\n70 ! VS_MinOMSpd\n"
                "2.3 ! VS_Rgn2K\n43000 ! VS_RtTq\n47000 ! VS_MaxTq\n15000 ! VS_MaxRat\n0 ! VS_ConstPower\n"
                "1.57 ! F_LPFCornerFreq\n");
    const ControllerGains gains = read_servodyn(model / "small_ServoDyn.dat").controller.gains;
    REQUIRE(gains.pitch_gains.size() == 2);
    CHECK(gains.pitch_gains[0].pitch == 0.05);
    CHECK(gains.pitch_gains[0].proportional == 0.02);
    CHECK(gains.pitch_gains[1].proportional == -0.004);
    CHECK(gains.pitch_gains[1].integral == 0.001);
    CHECK(gains.rated_speed == 122.9);
    CHECK(gains.min_speed == 70);
    CHECK(gains.optimal_gain == 2.3);
    CHECK(gains.rated_torque == 43000);
    CHECK(gains.max_torque == 47000);
    CHECK(gains.max_torque_rate == 15000);
    CHECK(gains.min_pitch == -0.02);
    CHECK(gains.max_pitch == 1.5);
    CHECK(gains.max_pitch_rate == 0.1);
    CHECK(gains.corner_frequency == 1.57);
    CHECK_FALSE(gains.constant_power);
    CHECK(gains.source == "DISCON.IN");
}
