// Campbell diagrams and linear models of a machine by a few lines: what is refused and how, names, limits.
//
// Reference: the solvers called by hand for the same machine; modes of the linear model beside those of the diagram,
// which a second algorithm finds.
#include "mbs/base/units.hpp"
#include "solvers/campbell_data/csv.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/analysis/campbell.hpp"
#include "turbines/analysis/linear_model.hpp"
#include "turbines/analysis/prepared_machine.hpp"
#include "turbines/analysis/rising.hpp"
#include "turbines/machine/machine_text.hpp"
#include "turbines/machine/read_machine.hpp"

#include <algorithm>
#include <limits>

namespace cardan::testing::campbell_of_machine {

namespace {

using namespace turbines;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
const MachineSettings coarse{.blade_elements = 2, .tower_elements = 1};

const Machine& wt600() {
    static const Machine machine = read_machine("wt600");
    return machine;
}

// The mode of a model with constant matrices whose frequency is nearest, rad/s.
Complex nearest_pole(const solvers::ConstantModel& model, const Complex& wanted) {
    const auto poles = model.poles();
    return *std::ranges::min_element(poles, {}, [&](const Complex& pole) { return std::abs(pole - wanted); });
}

}  // namespace

TEST_CASE("campbell of a machine: modes are those of the solver for the assembled machine", "[crosscheck]") {
    const CampbellDiagram diagram = campbell(wt600(), {.rotor_speeds = {0, 1, 2}, .machine = coarse});
    MachineSettings settings = coarse;
    settings.pitch = 0;
    const Turbine turbine = assemble(wt600().description, assembly_options(wt600(), settings, false));
    const solvers::Campbell by_hand = solvers::campbell(turbine.system(), turbine.rotor(), {0.0, 1.0, 2.0},
                                                        {.max_frequency_hz = *diagram.settings.max_frequency_hz});
    REQUIRE(diagram.branches.size() == by_hand.branches.size());
    for (std::size_t b = 0; b < by_hand.branches.size(); ++b) {
        CHECK(diagram.branches[b].name == by_hand.branches[b].name);
        CHECK(diagram.natural_hz(diagram.branches[b], 2) == Approx(by_hand.natural_hz(by_hand.branches[b], 2)));
    }
    CHECK(diagram.mesh.blade_elements == 2);
    CHECK(diagram.complete);
    // The file of a result is a machine again.
    const std::size_t at = diagram.source.rfind("cardan_turbine:");
    REQUIRE(at != std::string::npos);
    CHECK(parse_machine(diagram.source.substr(at), "diagram").description.name == wt600().description.name);
}

TEST_CASE("campbell of a machine: speeds and winds are taken in rising order, each once", "[property]") {
    const CampbellDiagram in_order = campbell(wt600(), {.rotor_speeds = {0, 1, 2}, .machine = coarse});
    const CampbellDiagram diagram = campbell(wt600(), {.rotor_speeds = {2, 0, 1 + 1e-12, 1}, .machine = coarse});
    CHECK(diagram.rotor_speeds() == in_order.rotor_speeds());
    CHECK(diagram.settings.rotor_speeds == std::vector<double>{0, 1, 2});
    CHECK(solvers::table(diagram) == solvers::table(in_order));
    CHECK(std::ranges::any_of(diagram.remarks, [](const Remark& remark) {
        return remark.text.find("rotor speeds: in rising order, each once: 0, 9.5493, 19.0986 rpm") !=
               std::string::npos;
    }));
    CHECK(std::ranges::none_of(in_order.remarks,
                               [](const Remark& remark) { return remark.text.find("rising") != std::string::npos; }));
    const Report nobody;
    CHECK(rising({10, 8, 10, 9}, "winds", "wind speeds", 1, "m/s", nobody) == std::vector<double>{8, 9, 10});
    CHECK(rising({}, "winds", "wind speeds", 1, "m/s", nobody).empty());
    check_refused(
        [] {
            rising({3, -units::rpm}, "--rpm", "rotor speeds", units::rpm, "rpm", {});
        },
        {"--rpm: value [rpm] = -1", ">= 0"});
    check_refused([] { rising({not_a_number}, "--rpm", "rotor speeds", units::rpm, "rpm", {}); }, {"--rpm", "nan"});
}

// Reference: the diagram that was not cancelled.
TEST_CASE("campbell of a machine in the wind: what is cancelled has the modes of its points", "[property]") {
    const Machine machine = read_machine("nrel5mw");
    CampbellSettings settings{.winds = {8, 9, 10},
                              .machine = coarse,
                              .max_frequency_hz = 2,
                              .air = {.wake = Wake::frozen, .airfoils = Airfoils::steady},
                              .harmonics = 1};
    const CampbellDiagram whole = campbell(machine, settings);
    REQUIRE(whole.complete);
    REQUIRE(whole.points.size() == 3);
    // After the second point; within its search, at the first azimuth of all; at once.
    int done = 0, asked = 0;
    settings.progress = [&](const char* what, int now, int total) {
        CHECK(std::string(what) == "wind speed");
        CHECK(total == 3);
        done = now;
    };
    for (const int wanted : {2, 1, 0}) {
        CAPTURE(wanted);
        done = asked = 0;
        settings.cancelled = [&] {
            asked += done == wanted;
            return wanted == 1 ? asked > 20 : asked > 0;
        };
        const CampbellDiagram part = campbell(machine, settings);
        CHECK_FALSE(part.complete);
        CHECK(part.not_converged.empty());
        REQUIRE(part.points.size() == static_cast<std::size_t>(wanted));
        CHECK(part.parameters == std::vector<double>(whole.parameters.begin(), whole.parameters.begin() + wanted));
        for (std::size_t i = 0; i < part.points.size(); ++i) {
            // Of modes about the largest frequency more or fewer are kept, as branches go on.
            const auto &some = part.points[i].modes, &all = whole.points[i].modes;
            CHECK(some.size() + 2 >= all.size());
            for (const auto& one : some)
                CHECK(std::ranges::any_of(
                    all, [&](const auto& other) { return other.mode.eigenvalue == one.mode.eigenvalue; }));
        }
    }
}

// Reference: D = tau K gives every mode of an undamped beam the ratio tau omega / 2, so that the second flap mode has
// that of the first times the ratio of their frequencies.
TEST_CASE("machine settings: damping of blades and tower is that of the first mode, and grows with the frequency",
          "[analytic]") {
    const MachineSettings settings{
        .blade_damping = 0.02, .tower_damping = 0.03, .blade_elements = 12, .tower_elements = 12};
    const Machine machine = with_settings(read_machine("nrel5mw"), settings);
    const AssemblyOptions options = assembly_options(machine, settings, false);
    const Turbine blade = isolated_blade(machine.description, options, 1);
    const solvers::Campbell diagram = solvers::campbell(blade.system(), blade.rotor(), {0.0}, {.max_frequency_hz = 5});
    const solvers::Branch &first = diagram.branch("1st blade flap"), &second = diagram.branch("2nd blade flap");
    CHECK(diagram.damping_ratio(first, 0) == Approx(0.02).epsilon(0.01));
    CHECK(diagram.damping_ratio(second, 0) / diagram.damping_ratio(first, 0) ==
          Approx(diagram.natural_hz(second, 0) / diagram.natural_hz(first, 0)).epsilon(1e-6));
    CHECK(machine.description.tower.first_mode_damping == 0.03);
    CHECK(machine.description.tower.damping.modal.empty());
}

TEST_CASE("machine settings: springs of the pitch bearings", "[property]") {
    const Machine machine = read_machine("nrel5mw");
    const Machine soft = with_settings(machine, {.pitch_stiffness = 2e7, .pitch_damping = 1e5});
    CHECK(soft.description.blade.pitch.kind == JointSupport::Kind::spring);
    CHECK(soft.description.blade.pitch.stiffness == 2e7);
    CHECK(soft.description.blade.pitch.damping == 1e5);
    Machine rigid = machine;
    rigid.description.blade.pitch = rigid_joint;
    check_refused([&] { with_settings(rigid, {.pitch_damping = 1e5}); },
                  {"MachineSettings::pitch_damping", "pitch_stiffness gives them one"});
    check_refused([&] { with_settings(machine, {.pitch_stiffness = 0}); }, {"MachineSettings::pitch_stiffness", "> 0"});
    check_refused([&] { with_settings(machine, {.blade_damping = -1}); }, {"MachineSettings::blade_damping", ">= 0"});
    check_refused([&] { with_settings(machine, {.tower_damping = -1}); }, {"MachineSettings::tower_damping", ">= 0"});
}

TEST_CASE("campbell of a machine: a pitch that changes with the speed is that of each speed", "[crosscheck]") {
    const double pitch = 0.1;
    const CampbellDiagram scheduled =
        campbell(wt600(), {.rotor_speeds = {1, 2}, .pitch_schedule = {{1, 0}, {2, pitch}}, .machine = coarse});
    MachineSettings pitched = coarse;
    pitched.pitch = pitch;
    const CampbellDiagram second = campbell(wt600(), {.rotor_speeds = {2}, .machine = pitched});
    for (const char* name : {"1st tower fore-aft", "1st tower side-side"}) {
        CAPTURE(name);
        CHECK(scheduled.natural_hz(scheduled.branch(name), 1) ==
              Approx(second.natural_hz(second.branch(name), 0)).epsilon(1e-9));
    }
    CHECK(scheduled.settings.pitch_schedule.size() == 2);
    CHECK_FALSE(scheduled.settings.machine.pitch);
}

TEST_CASE("linear model of a machine: its poles are modes of the Campbell diagram", "[crosscheck]") {
    const double speed = 2;
    const MachineLinearModel linear = linear_model(wt600(), {.rotor_speed = speed, .machine = coarse, .azimuths = 8});
    CHECK(linear.form == LinearForm::multi_blade);
    const CampbellDiagram diagram = campbell(wt600(), {.rotor_speeds = {speed}, .machine = coarse});
    const solvers::ConstantModel& fixed = linear.constant_model("multi_blade");
    for (const solvers::Branch& branch : diagram.branches) {
        CAPTURE(branch.name);
        const Complex wanted = diagram.mode(branch, 0)->mode.eigenvalue;
        CHECK(std::abs(nearest_pole(fixed, wanted) - wanted) < 1e-5 * std::abs(wanted) + 1e-5);
    }
    CHECK(linear.balanced);
    check_refused([&] { (void)linear.constant_model("frozen"); }, {"name = frozen", "multi_blade, balanced"});
}

TEST_CASE("linear model of a machine: inputs and outputs are those that are named", "[property]") {
    const LinearModelSettings all{.rotor_speed = 2, .machine = coarse, .azimuths = 8};
    LinearModelSettings some = all;
    some.inputs = {"thrust", "generator torque"};
    some.outputs = {"TTDspFA", "RotSpeed"};
    const solvers::LinearModel chosen = linear_model(wt600(), some).model, whole = linear_model(wt600(), all).model;
    REQUIRE(chosen.inputs.size() == 2);
    CHECK(chosen.inputs[0].name == "thrust");
    CHECK(chosen.inputs[1].name == "generator torque");
    REQUIRE(chosen.outputs.size() == 2);
    CHECK(chosen.outputs[0].alias == "TTDspFA");
    const auto column = std::ranges::find(whole.inputs, "thrust", &solvers::Signal::name) - whole.inputs.begin();
    CHECK(chosen.samples[1].B.col(0).isApprox(whole.samples[1].B.col(column), 1e-12));
    some.inputs = {"trust"};
    check_refused([&] { linear_model(wt600(), some); },
                  {"LinearModelSettings::inputs: name = trust", "generator torque, yaw moment, thrust"});
    some.inputs = {};
    some.outputs = {"TTDspXY"};
    check_refused([&] { linear_model(wt600(), some); }, {"TTDspXY"});
}

TEST_CASE("campbell and linear model of a machine: errors name the field", "[property]") {
    const auto diagram_refused = [](const CampbellSettings& settings, std::initializer_list<std::string> parts) {
        check_refused([&] { campbell(wt600(), settings); }, parts);
    };
    diagram_refused({.rotor_speeds = {1}, .winds = {8}}, {"CampbellSettings::rotor_speeds", "none beside winds"});
    diagram_refused({.winds = {8}, .pitch_schedule = {{1, 0}}}, {"CampbellSettings::pitch_schedule", "none beside"});
    diagram_refused({.winds = {8}, .like = "base.h5"}, {"CampbellSettings::like", "base.h5", "none beside winds"});
    diagram_refused({.rotor_speeds = {-1}}, {"CampbellSettings::rotor_speeds", "rpm", ">= 0"});
    diagram_refused({.winds = {not_a_number}}, {"CampbellSettings::winds", "nan"});
    diagram_refused({.pitch_schedule = {{2, 0}, {1, 0}}}, {"CampbellSettings::pitch_schedule", "rising"});
    diagram_refused({.max_frequency_hz = 0}, {"CampbellSettings::max_frequency_hz", "= 0"});
    diagram_refused({.harmonics = 0}, {"CampbellSettings::harmonics", "1 ... 200"});
    diagram_refused({.winds = {8}}, {"air = none"});
    Machine without_power = read_machine("nrel5mw");
    without_power.operation.rated_power = 0;
    check_refused([&] { campbell(without_power, {.winds = {8}, .machine = coarse}); },
                  {"OperationSettings::rated_power", "none"});
    const auto model_refused = [](const LinearModelSettings& settings, std::initializer_list<std::string> parts) {
        check_refused([&] { linear_model(wt600(), settings); }, parts);
    };
    model_refused({.rotor_speed = -1}, {"LinearModelSettings::rotor_speed", "-1"});
    model_refused({.rotor_speed = not_a_number}, {"LinearModelSettings::rotor_speed", "nan"});
    model_refused({.wind = -8}, {"LinearModelSettings::wind", "-8"});
    model_refused({.rotor_speed = 1, .wind = 8}, {"LinearModelSettings::rotor_speed", "none beside a wind"});
    model_refused({.azimuths = 721}, {"LinearModelSettings::azimuths", "720"});
    model_refused({.error = 0}, {"LinearModelSettings::error", "= 0"});
    model_refused({.wind = 8}, {"air = none"});
}

}  // namespace cardan::testing::campbell_of_machine
