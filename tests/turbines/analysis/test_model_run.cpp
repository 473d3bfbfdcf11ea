// A run in time from a model alone: what the main file of OpenFAST names is what runs.
//
// Reference: the same run with everything given; equal means bit for bit.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/analysis/simulation.hpp"
#include "turbines/machine/machine_text.hpp"
#include "turbines/machine/read_machine.hpp"

#include <algorithm>

namespace cardan::testing::model_run_tests {

namespace {

using namespace turbines;

// small.fst in the wind of a file of its own, with a nacelle that starts yawed.
struct Model {
    test::ModelFolder folder{"openfast"};
    Model() {
        for (const auto& entry : std::filesystem::directory_iterator(test::data_file("aerodyn")))
            std::filesystem::copy_file(entry.path(), folder / entry.path().filename().string());
        folder.replace("small.fst", "\"unused\"    AeroFile",
                       "\"small_AeroDyn.dat\"    AeroFile - air\n\"small_Inflow.dat\" InflowFile - wind");
        folder.replace("small.fst", "0   CompAero", "2   CompAero");
        folder.replace("small.fst", "0   CompInflow", "1   CompInflow");
        folder.replace("small.fst", "10   TMax", "0.3   TMax");
        folder.replace("small_ElastoDyn.dat", "0   NacYaw", "3   NacYaw");
        folder.write("small_Inflow.dat",
                     "InflowWind\ntitle\n---\n1 WindType - kind\n0 PropagationDir - deg\n0 VFlowAng - deg\n---\n"
                     "8.5 HWindSpeed - m/s\n24 RefHt - m\n0.1 PLExp - exponent\n");
    }
    Machine read() const { return read_machine(folder / "small.fst"); }
};

SimulationSettings coarse() {
    return {.machine = {.blade_elements = 1, .tower_elements = 1}, .tolerance = 1e-5};
}

bool says(const Simulation& run, const std::string& part) {
    return std::ranges::any_of(run.remarks(),
                               [&](const Remark& one) { return one.text.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("model run: duration, wind and start are the model's", "[property]") {
    const Model model;
    const Machine machine = model.read();
    REQUIRE(machine.run);
    Simulation own(machine, coarse());
    CHECK(own.duration() == 0.3);
    CHECK(own.duration({.duration = 2.0}) == 2);
    model.folder.replace("small.fst", "0.3   TMax", "0.3 0   TMax");
    CHECK_FALSE(model.read().run->duration);
    CHECK(own.settings().rotor_speed == Approx(45 * units::rpm));
    CHECK(own.settings().machine.pitch == Approx(1.5 * units::degree));
    CHECK(own.settings().azimuth == Approx(30 * units::degree));
    CHECK(own.settings().q.at("yaw") == Approx(3 * units::degree));
    CHECK(says(own, "wind: small_Inflow.dat (small.fst)"));

    SimulationSettings given = coarse();
    given.wind = model.folder / "small_Inflow.dat";
    given.rotor_speed = own.settings().rotor_speed;
    given.machine.pitch = own.settings().machine.pitch;
    given.azimuth = own.settings().azimuth;
    given.q = own.settings().q;
    Simulation told(machine, given);
    const solvers::History a = own.record().history, b = told.record({.duration = 0.3}).history;
    REQUIRE(a.time == b.time);
    for (std::size_t i = 0; i < a.values.size(); ++i) {
        CAPTURE(a.channels[i].name);
        CHECK(a.values[i] == b.values[i]);
    }
}

TEST_CASE("model run: what is given goes before the model, and there may be no air", "[property]") {
    const Model model;
    SimulationSettings calm = coarse();
    calm.wind = WindSource::none();
    const Simulation still(model.read(), calm);
    CHECK(std::ranges::none_of(still.channels(), [](const Channel& one) { return one.name == "wind speed"; }));
    CHECK(still.settings().azimuth == 0.0);

    model.folder.replace("small.fst", "2   CompAero", "0   CompAero");
    CHECK(Simulation(model.read(), coarse()).settings().wind->is_none());
}

TEST_CASE("model run: it survives our own YAML, and one that cannot be had says what to do", "[property]") {
    const Model model;
    const Machine machine = model.read(), again = parse_machine(to_yaml(machine), "m.yaml");
    REQUIRE(again.run);
    CHECK(again.run->wind == machine.run->wind);
    CHECK(again.run->duration == machine.run->duration);
    CHECK(again.run->yaw == machine.run->yaw);
    CHECK(to_yaml(again) == to_yaml(machine));

    model.folder.replace("small_Inflow.dat", "1 WindType", "6 WindType");
    check_refused([&] { Simulation(model.read(), coarse()); },
                  {"SimulationSettings::wind", "wind of small.fst", "WindType = 6", "or none"});
    model.folder.replace("small_AeroDyn.dat", "NumAFfiles", "NumAFs");
    check_refused([&] { Simulation(model.read(), coarse()); }, {"SimulationSettings::wind", "NumAFfiles", "or none"});
}

TEST_CASE("model run: where the model's library cannot be loaded the baseline controller stands in", "[property]") {
    const Model model;
    const std::string servo = test::bytes_of(model.folder / "small_ServoDyn.dat");
    model.folder.write("small_ServoDyn.dat", servo + "\n\"broken.so\" DLL_FileName - library\n");
    model.folder.replace("small_ServoDyn.dat", "0   PCMode", "5   PCMode");
    for (const char* const content : {"no library",
                                      "\x7f"
                                      "ELF but broken"}) {
        model.folder.write("broken.so", content);
        SimulationSettings settings = coarse();
        std::string said;
        settings.report = [&](const Remark& remark) { said += remark.text; };
        const Simulation run(model.read(), settings);
        CHECK(run.settings().controller.kind == Controller::Kind::baseline);
        CHECK_THAT(said, Catch::Contains("the model's controller, broken.so, ") &&
                             Catch::Contains("the baseline controller stands in"));
    }
}

// SIG_: no torque at 1200 rpm, 500 N m at 2 % slip. TEC_: the slope at no load of Thevenin's circuit, by differences of
//     T(s) = 3 V^2 (R2 / s) / (w ((R1' + R2 / s)^2 + (X1' + X2)^2))
// with V, R1', X1' behind the magnetising reactance.
TEST_CASE("model run: without a controller the induction generator of ServoDyn brakes", "[analytic]") {
    const Model model;
    model.folder.replace("small_ServoDyn.dat", "1   VSContrl", "0   VSContrl");
    const std::string servo = test::bytes_of(model.folder / "small_ServoDyn.dat");
    model.folder.write("small_ServoDyn.dat",
                       servo + "\n1 GenModel - kind\n1200 SIG_SySp - rpm\n2 SIG_SlPc - %\n500 SIG_RtTq - N m\n");
    const Simulation simple(model.read(), coarse());
    const double ratio = simple.turbine().layout().gear_ratio;
    const double slope = 500 / (0.02 * 1200 * units::rpm);
    CHECK(simple.settings().generator_slope == Approx(slope));
    CHECK(*simple.settings().generator_torque == Approx(slope * (45 * ratio - 1200) * units::rpm));

    model.folder.write("small_ServoDyn.dat",
                       servo +
                           "\n2 GenModel - kind\n60 TEC_Freq - Hz\n6 TEC_NPol - poles\n0.02 TEC_SRes - ohm\n"
                           "0.03 TEC_RRes - ohm\n480 TEC_VLL - V\n0.1 TEC_SLR - ohm\n0.12 TEC_RLR - ohm\n"
                           "4 TEC_MR - ohm\n");
    const Simulation thevenin(model.read(), coarse());
    const double w = 4 * pi * 60 / 6, X = 0.1 + 4.0, Z = 0.02 * 0.02 + X * X;
    const double V = 480 / std::sqrt(3) * 4 / std::sqrt(Z), R1 = 0.02 * 4 * 4 / Z, X1 = 4 * (0.02 * 0.02 + 0.1 * X) / Z;
    const auto torque = [&](double s) {
        const double R = R1 + 0.03 / s;
        return 3 * V * V * (0.03 / s) / (w * (R * R + (X1 + 0.12) * (X1 + 0.12)));
    };
    CHECK(thevenin.settings().generator_slope == Approx(torque(1e-7) / (1e-7 * w)).epsilon(1e-5));
}

// At 1125 rpm on the line of 5 % slip, which begins at 1150 / 1.05 rpm and reaches 800 N m at 1150 rpm.
TEST_CASE("model run: without a controller the law of variable speed of ServoDyn brakes", "[analytic]") {
    const Model model;
    const std::string servo = test::bytes_of(model.folder / "small_ServoDyn.dat");
    const auto with = [&](const std::string& gain) {
        model.folder.write("small_ServoDyn.dat", servo + "\n" + gain + " VS_Rgn2K - N m/rpm^2\n5 VS_SlPc - %\n");
        return model.read();
    };
    const Machine machine = with("2e-4"), again = parse_machine(to_yaml(machine), "m.yaml");
    CHECK(again.controller.torque_law.slip == 0.05);
    Simulation run(again, coarse());
    CHECK(says(run, "law of variable speed of ServoDyn, 800 N m from 1150 rpm on"));
    const double speed = 45 * run.turbine().layout().gear_ratio;  // rpm
    REQUIRE(speed == 1125);
    const solvers::History history = run.record({.duration = 0.02, .step = 0.01}).history;
    const auto at_start = [&](const char* channel) { return history.values[history.index(channel)][0]; };
    CHECK(at_start("generator torque") == Approx(800 * (1125 - 1150 / 1.05) / (1150 - 1150 / 1.05)).epsilon(1e-9));
    CHECK(at_start("generator power") == Approx(at_start("generator torque") * speed * units::rpm).epsilon(1e-9));
    // A torque of one's own goes before it, a law that is none is left out with its reason.
    CHECK_FALSE(says(Simulation(again,
                                [] {
                                    SimulationSettings own = coarse();
                                    own.generator_torque = 100;
                                    return own;
                                }()),
                     "law of variable speed"));
    const Machine none = with("1");
    CHECK_FALSE(none.controller.torque_law.acts());
    CHECK(test::has_note(none.notes, "VSContrl", "optimal gain"));
}

}  // namespace cardan::testing::model_run_tests
