// How a machine runs, of windIO's blocks `control` and `assembly`.
//
// Reference: what the reports of the machines say, from files with the figures of the public ones.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/machine/machine.hpp"
#include "turbines/yaml/windio.hpp"

using namespace cardan;
using namespace cardan::turbines;
using Catch::Matchers::Contains;
using test::message_of;

namespace cardan::testing::windio_operation {

namespace {

// With other entries.
TurbineFile with(const std::string& entries, const char* file = "bare_v2.yaml") {
    return read_windio(test::data_file(text("windio/", file)), {{entries, "entries.yaml"}});
}

double rpm(const TurbineFile& file) {
    return file.rotor_speed * units::to_rpm;
}

}  // namespace

TEST_CASE("windio: rated power, speeds, ratio and pitch of the control of version 2.0", "[analytic]") {
    const TurbineFile file = with("{}");
    // 80 m/s at 1.5 + 38.5 m, which is less than 60 rpm.
    CHECK(file.rotor_speed == Approx(2).epsilon(1e-14));
    CHECK(file.rotor_speed_source == "control.supervisory.maxTS over the radius, 40 m");
    CHECK(
        test::has_note(file.notes, "control.torque.VS_maxspd", "makes the tips faster than control.supervisory.maxTS"));
    CHECK(file.operation.rated_power == Approx(2e6 / (0.97 * 0.95)).epsilon(1e-14));
    CHECK(file.controller.generator_efficiency == 0.95);
    CHECK(file.operation.min_rotor_speed == Approx(8 * units::rpm).epsilon(1e-14));
    CHECK(file.operation.tip_speed_ratio == 8);
    CHECK(file.pitch == Approx(-1 * units::degree).epsilon(1e-14));
    CHECK(file.pitch_source == "control.pitch.min_pitch");
    CHECK(file.operation.source == "bare_v2.yaml");
    const VariableSpeed law = variable_speed(machine_of(file).operation);
    CHECK_NOTHROW(law.check());
}

TEST_CASE("windio: version 1 counts in rad/s and rad", "[crosscheck]") {
    const TurbineFile one = with("control: {pitch: {min_pitch: -0.1}}", "small_v1.yaml");
    CHECK(one.rotor_speed == 4.7);
    CHECK(one.operation.min_rotor_speed == 2);
    CHECK(one.operation.tip_speed_ratio == 7);
    CHECK(one.pitch == -0.1);
    // 100 kW, electrical, and nothing of the losses.
    CHECK(one.operation.rated_power == 1e5);
    CHECK(test::has_note(one.notes, "assembly.rated_power", "no efficiency of the generator"));
}

TEST_CASE("windio: names of version 2.1, with the minimum pitch over the wind", "[analytic]") {
    const TurbineFile file = with(
        "control: {rated_rotor_speed: 18, max_rotor_speed: 21, min_rotor_speed: 6, rated_power: 1.9e6, fine_pitch: "
        "-2,\n"
        "  optimal_tsr: 8.4, min_pitch_table: {wind_speed: [3, 6, 9, 15], min_pitch: [3, 2, 0, 1]}}");
    CHECK(rpm(file) == Approx(18).epsilon(1e-14));
    CHECK(file.rotor_speed_source == "control.rated_rotor_speed");
    CHECK(file.operation.min_rotor_speed == Approx(6 * units::rpm).epsilon(1e-14));
    CHECK(file.operation.tip_speed_ratio == 8.4);
    CHECK(file.operation.rated_power == Approx(1.9e6 / (0.97 * 0.95)).epsilon(1e-14));
    CHECK(file.pitch == Approx(-2 * units::degree).epsilon(1e-14));
    CHECK(pitch_at(file.operation.min_pitch, 7.5) == Approx(1 * units::degree).epsilon(1e-14));
    // At 6 m/s the rotor of 40 m turns at 8.4 x 6 / 40 rad/s, beyond 9 m/s at its rated speed.
    CHECK(pitch_at(file.pitch_schedule, 1.26) == Approx(2 * units::degree).epsilon(1e-12));
    CHECK(file.pitch_schedule.back().rotor_speed == Approx(18 * units::rpm).epsilon(1e-14));
    CHECK(file.pitch_schedule.back().pitch == Approx(0).margin(1e-14));
    CHECK(file.pitch_source == "control.min_pitch_table");
}

// IEA 15 MW: E. Gaertner and others, NREL/TP-5000-75698, 2020; IEA 22 MW: F. Zahle and others, DTU Wind report E-0243,
// 2024; IEA 10 MW and 3.4 MW: P. Bortolotti and others, NREL/TP-5000-73492, 2019; NREL 5 MW: J. Jonkman and others,
// NREL/TP-500-38060, 2009. Their files say 95, 105, 90, 80, 80 m/s and these speeds at most, of which one is a default.
TEST_CASE("windio: rated speeds of the reference machines are those of their reports", "[published]") {
    struct Reference {
        const char* name;
        double hub, blade, cone, tip_speed, most, report;  // m, m, deg, m/s, rpm, rpm
    };
    const std::vector<Reference> machines{{"IEA 15 MW", 7.94, 117.2, 4, 95, 7.56, 7.56},
                                          {"IEA 22 MW", 8.4, 137.8, 4, 105, 7.162, 7.06},
                                          {"IEA 10 MW", 5.0, 96.2, 4, 90, 8.684, 8.68},
                                          {"IEA 3.4 MW", 4.0, 63.0, 3, 80, 19.098593, 11.75},
                                          {"NREL 5 MW", 3.0, 61.5, 2.5, 80, 12.1, 12.1}};
    for (const Reference& m : machines) {
        CAPTURE(m.name);
        const TurbineFile file =
            with(text("components: {hub: {diameter: ", m.hub, ", cone_angle: ", m.cone,
                      "}, blade: {reference_axis: {z: {values: [0, ", m.blade, "]}}}}\n",
                      "control: {supervisory: {maxTS: ", m.tip_speed, "}, torque: {VS_maxspd: ", m.most, "}}"));
        CHECK(rpm(file) == Approx(m.report).margin(0.01 * m.report));
        // Where the file says the report's figure it is taken, to the last digit.
        if (m.most - m.report < 0.005) CHECK(rpm(file) == Approx(m.most).epsilon(1e-12));
    }
}

TEST_CASE("windio: the slowest of several limits of the speed counts", "[analytic]") {
    const auto limited = [](const char* control) { return with(text("control: ", control)); };
    // maxOmega is a key of the first files, in rad/s, which converted ones keep.
    CHECK(limited("{supervisory: {maxOmega: 1.9}}").rotor_speed == 1.9);
    CHECK(limited("{supervisory: {maxOmega: 1.9}}").rotor_speed_source == "control.supervisory.maxOmega");
    CHECK(limited("{supervisory: {maxOmega: 2.1}}").rotor_speed == Approx(2).epsilon(1e-14));
    CHECK(rpm(limited("{torque: {VS_maxspd: 15}}")) == Approx(15).epsilon(1e-14));
    // Within 1 % of the tip speed, which is that of a nominal radius.
    CHECK(rpm(limited("{torque: {VS_maxspd: 19.2}}")) == Approx(19.2).epsilon(1e-14));
    CHECK(limited("{torque: {VS_maxspd: 0}}").rotor_speed == Approx(2).epsilon(1e-14));
    CHECK(limited("{supervisory: {minOmega: 0.5}, torque: {VS_minspd: 0}}").operation.min_rotor_speed == 0.5);
}

TEST_CASE("windio: the efficiency of the generator is that of rated speed", "[analytic]") {
    const auto power = [](const char* curve) {
        return with(text("components: {drivetrain: {gearbox: {efficiency: 1}, generator: {rpm_efficiency: ", curve,
                         "}}}"))
            .operation.rated_power;
    };
    // 19.0986 rpm
    const double share = 2 * units::to_rpm - 19;
    CHECK(power("{grid: [10, 19, 20, 30], values: [0.8, 0.9, 0.96, 0.96]}") ==
          Approx(2e6 / (0.9 + 0.06 * share)).epsilon(1e-12));
    CHECK(power("{grid: [5, 10], values: [0.8, 0.9]}") == Approx(2e6 / 0.9).epsilon(1e-14));
    CHECK(power("{grid: [0.0], values: [0.0]}") == 2e6);  // windIO's default
    CHECK_THAT(message_of([&] { (void)power("{grid: [0, 1], values: [95, 95]}"); }),
               Contains("an efficiency of 95; allowed: 0 ... 1, not 0"));
    CHECK_THAT(message_of([&] { (void)with("control: {torque: {tsr: -1}}"); }),
               Contains("control.torque.tsr: -1; allowed: >= 0"));
}

}  // namespace cardan::testing::windio_operation
