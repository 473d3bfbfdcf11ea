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
    // Power on the generator's shaft: torque times speed.
    CHECK(torque_law.operation.rated_power == Approx(800 * 1150 * units::rpm).epsilon(1e-15));
    CHECK(torque_law.operation.source == "small_ServoDyn.dat");
    CHECK(torque_law.min_generator_speed == 0);
    const ServoDyn rated = with("0", "1 GenModel\n2.0 SIG_SlPc\n1800 SIG_SySp\n500 SIG_RtTq\n2 SIG_PORt\n");
    CHECK(rated.operation.rated_power == Approx(500 * 1836 * units::rpm).epsilon(1e-15));
    CHECK(rated.min_generator_speed == Approx(1800 * units::rpm).epsilon(1e-15));
    CHECK(thevenin.operation.rated_power == 0);
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
    for (const std::string& other :
         {std::string("\0\1binary", 8), std::string("; begin init\nconstant 1 15000.0 ; Rated power [kW]\n"),
          std::string("! PC_RefSpd is not given\n10 ! Other - x\n5 VS_RtPwr\n")}) {
        model.write("sub/DISCON.IN", other);
        CHECK(read().rated_generator_speed == 0);
        CHECK(test::has_note(read().notes, "DLL_InFile", "not a file of ROSCO"));
    }
}

TEST_CASE("servodyn: entries that are not used have one number that means nothing", "[property]") {
    const std::string sizes = "9999.9 SIG_SlPc\n9999.9 SIG_SySp\n9999.9 SIG_RtTq\n9999.9 SIG_PORt\n";
    const ServoDyn simple = with("0", "1 GenModel\n" + sizes);
    CHECK(simple.rated_generator_speed == 0);
    CHECK(simple.operation.rated_power == 0);
    CHECK(test::has_note(simple.notes, "SIG_SySp", "a placeholder: 4 entries"));
    // Whatever the number is; but not where it is two times by chance.
    CHECK(with("0", "1 GenModel\n777 SIG_SlPc\n777 SIG_SySp\n777 SIG_RtTq\n").rated_generator_speed == 0);
    CHECK(with("0", "1 GenModel\n2 SIG_SlPc\n1500 SIG_SySp\n1500 SIG_RtTq\n2 SIG_PORt\n").rated_generator_speed ==
          Approx(1530 * units::rpm));
    CHECK(with("0", "2 GenModel\n9998 TEC_NPol\n99999.0 TEC_Freq\n99999. TEC_SRes\n9.9999E4 TEC_VLL\n")
              .rated_generator_speed == 0);
    CHECK(with("1", sizes).rated_generator_speed == Approx(1150 * units::rpm));
}

TEST_CASE("openfast: a rated speed at which the tips were faster than sound is none", "[property]") {
    const test::ModelFolder model("openfast");
    model.replace("small_ServoDyn.dat", "          1150   VS_RtGnSp", "          9999   VS_RtGnSp");
    const TurbineFile file = read_openfast(model / "small.fst");  // 400 rpm of a rotor of 10.5 m: 440 m/s
    CHECK(file.rotor_speed == Approx(45 * units::rpm));
    CHECK(file.operation.rated_power == 0);
    CHECK(test::has_note(file.notes, "rated speed", "faster than sound"));
}

namespace {

// A ROSCO controller at work in the test's model, with a schedule of the pitch.
struct WithController {
    test::ModelFolder model{"openfast"};
    WithController() {
        model.replace("small_ServoDyn.dat", "             0   PCMode ",
                      "\"DISCON.IN\" DLL_InFile\n             5   PCMode ");
        model.replace("small_ServoDyn.dat", "             1   VSContrl ", "             5   VSContrl ");
    }
    [[nodiscard]] ServoDyn read(const std::string& schedule) const {
        model.write("DISCON.IN",
                    "1 ! PS_Mode\n100.0 ! PC_RefSpd\n0.02 ! PC_FinePit\n60.0 ! VS_MinOMSpd\n8.0 ! VS_TSRopt\n"
                    "16.0 ! WE_BladeRadius\n20.0 ! WE_GearboxRatio\n" +
                        schedule);
        return read_servodyn(model / "small_ServoDyn.dat");
    }
    [[nodiscard]] std::string message(const std::string& schedule) const {
        return test::message_of([&] { (void)read(schedule); });
    }
};

}  // namespace

TEST_CASE("servodyn: a ROSCO controller's file as Fortran reads it, with commas, tabs, any case and remarks",
          "[property]") {
    const WithController file;
    const ServoDyn plain = file.read("3 ! PS_BldPitchMin_N\n7 9 11 ! PS_WindSpeeds\n0.05 0.03 0.04 ! PS_BldPitchMin\n");
    REQUIRE(plain.pitch_schedule.size() == 3);
    for (const char* same :
         {"3 ! PS_BldPitchMin_N\n7, 9, 11 ! PS_WindSpeeds\n0.05,0.03,0.04 ! PS_BldPitchMin\n",
          "3,!\tps_bldpitchmin_n\r\n7\t9\t11 !PS_WINDSPEEDS - m/s\r\n5.D-2 3.0-02 .04 ! PS_BldPitchMin",
          "! PS_WindSpeeds, from 7 m/s\n3 ! PS_BldPitchMin_N\n7 9 11 m/s ! PS_WindSpeeds\n"
          "0.05 0.03 0.04 and so on ! PS_BldPitchMin: rad\n",
          "7 9 11 ! PS_WindSpeeds\n0.05 0.03 0.04 ! PS_BldPitchMin\n"}) {
        CAPTURE(same);
        const ServoDyn read = file.read(same);
        REQUIRE(read.pitch_schedule.size() == 3);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(read.pitch_schedule[i].rotor_speed == plain.pitch_schedule[i].rotor_speed);
            CHECK(read.pitch_schedule[i].pitch == plain.pitch_schedule[i].pitch);
        }
    }
}

TEST_CASE("servodyn: what of a ROSCO controller's file is not whole is refused with file and line", "[property]") {
    const WithController file;
    const std::string winds = "7 9 11 ! PS_WindSpeeds\n", pitch = "0.05 0.03 0.04 ! PS_BldPitchMin\n",
                      count = "3 ! PS_BldPitchMin_N\n";
    CHECK_THAT(file.message(count + winds + "0.05 x 0.04 ! PS_BldPitchMin\n"),
               Contains("DISCON.IN:10: PS_BldPitchMin: 'x' is not a finite number"));
    CHECK_THAT(file.message(count + "7 9.1.5 11 ! PS_WindSpeeds\n" + pitch),
               Contains("DISCON.IN:9: PS_WindSpeeds: '9.1.5' is not"));
    CHECK_THAT(file.message(count + winds + "0.05 0.03 ! PS_BldPitchMin\n"),
               Contains("DISCON.IN:10: PS_BldPitchMin: 3 numbers expected, found 2"));
    CHECK_THAT(file.message(winds + "0.05 0.03 ! PS_BldPitchMin\n"), Contains("2 numbers for 3 wind speeds"));
    CHECK_THAT(file.message("7 9 8 ! PS_WindSpeeds\n" + pitch),
               Contains("PS_WindSpeeds: 8 m/s after 9; allowed: ascending"));
    CHECK_THAT(file.message(count + pitch), Contains("DISCON.IN:9: no line with the keyword PS_WindSpeeds"));
    CHECK_THAT(file.message(count + winds + pitch + "4.5.6 ! VS_RtPwr\n"), Contains("DISCON.IN:11: VS_RtPwr: '4.5.6'"));
    CHECK_THAT(file.message(count + winds + pitch + "90 ! pc_refspd\n"),
               Contains("DISCON.IN:11: pc_refspd is there already, in line 2"));
    // A comma is no decimal point and parts no thousands; lists are as long as they say.
    CHECK_THAT(file.message(count + winds + pitch + "90,000 ! VS_RtPwr\n"),
               Contains("DISCON.IN:11: VS_RtPwr: 1 number expected, then '000'"));
    CHECK_THAT(file.message("2 ! PS_BldPitchMin_N\n" + winds + pitch),
               Contains("DISCON.IN:9: PS_WindSpeeds: 2 numbers expected, then '11'"));
    CHECK_THAT(file.message("2.5 ! PS_BldPitchMin_N\n" + winds + pitch), Contains("2.5; allowed: whole numbers"));
    CHECK(file.read(winds + pitch + "5e6 W ! VS_RtPwr: electrical\n80 ! VS_GenEff(%)\n").operation.rated_power ==
          6.25e6);
    // Per cent and radians.
    for (const char* efficiency : {"0.95", "-95", "9500"})
        CHECK_THAT(file.message(winds + pitch + efficiency + " ! VS_GenEff\n"),
                   Contains("DISCON.IN:10: VS_GenEff: ") && Contains(" per cent; allowed: above 1 and at most 100"));
    CHECK_THAT(file.message(winds + pitch + "90 ! PC_MaxPit\n"),
               Contains("DISCON.IN:10: PC_MaxPit: 90 rad; allowed: at most a turn either way"));
    // Power: electrical over the efficiency, else torque at the rated speed.
    CHECK(file.read(winds + pitch + "5e6 ! VS_RtPwr\n80 ! VS_GenEff\n7 ! VS_RtTq\n").operation.rated_power == 6.25e6);
    CHECK(file.read(winds + pitch + "5e6 ! VS_RtPwr\n70 ! VS_RtTq\n").operation.rated_power == 7000);
}

TEST_CASE("openfast: a controller that reckons with another gear ratio than the machine's is noted", "[property]") {
    const WithController file;
    file.model.write("DISCON.IN", "100 ! PC_RefSpd\n20 ! WE_GearboxRatio\n");  // the machine has 25
    const TurbineFile machine = read_openfast(file.model / "small.fst");
    CHECK(test::has_note(machine.notes, "WE_GearboxRatio", "GBRatio of the machine is 25"));
    CHECK(machine.rotor_speed == Approx(4));
    file.model.write("DISCON.IN", "100 ! PC_RefSpd\n24.9 ! WE_GearboxRatio\n");
    CHECK(!test::has_note(read_openfast(file.model / "small.fst").notes, "WE_GearboxRatio", ""));
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
    CHECK(scheduled.operation.min_rotor_speed == Approx(3).epsilon(1e-14));
    CHECK(scheduled.operation.tip_speed_ratio == 8);
    CHECK(scheduled.operation.rated_power == 0);
    CHECK(scheduled.operation.source == "DISCON.IN");
    CHECK(pitch_at(scheduled.operation.min_pitch, 10) == Approx(0.035).epsilon(1e-14));
    CHECK(pitch_at(scheduled.operation.min_pitch, 20) == 0.2);
    CHECK(pitch_at(scheduled.operation.min_pitch, 1) == 0.09);
    CHECK_THROWS_AS(pitch_at(std::vector<PitchAtWind>(), 1), InputError);
    CHECK_THROWS_AS(pitch_at(std::vector<PitchAtWind>{{2, 0}, {2, 0}}, 1), InputError);
    const ServoDyn constant = read("0");
    CHECK(constant.operation.min_pitch.empty());
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
