// Blades that crank and push rod pitch: geometry in closed form, stiffness at the blade, files.
#include "mbs/base/units.hpp"
#include "mbs/loops/closure.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/equilibrium/natural_modes.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"
#include "turbines/yaml/description.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;
using namespace cardan::turbines;

namespace pitch_linkage_tests {

// Crank of 0.9 m at 20 degrees, actuator at 6 degrees to the blade's normal.
PitchLinkage linkage(const JointSupport& actuator) {
    const double a0 = 20 * units::degree, t = 6 * units::degree;
    return {.crank_pin = {0.15, 0.9 * std::cos(a0), 0.9 * std::sin(a0)},
            .actuator_pin = {0, 0.75, -1.6},
            .direction = {std::sin(t), 0, std::cos(t)},
            .actuator = actuator,
            .mass = 1e-3};
}

constexpr double actuator_stiffness = 6e7, angle_by_stroke = 1.2077151796;

TurbineDescription machine(const std::optional<PitchLinkage>& linkage, const JointSupport& pitch) {
    TurbineDescription d = nrel5mw_description();
    d.blade.linkage = linkage;
    d.blade.pitch = pitch;
    return d;
}

AssemblyOptions coarse() {
    AssemblyOptions options = nrel5mw_assembly(Nrel5mwVariant::fast, 2, 1);
    options.spin = CoordinateRole::prescribed;
    return options;
}

}  // namespace pitch_linkage_tests

using namespace pitch_linkage_tests;

TEST_CASE("pitch linkage: the stroke turns all blades as geometry has it", "[analytic]") {
    const Turbine turbine = assemble(machine(linkage(prescribed_joint), free_joint), coarse());
    const Model& model = turbine.system().model;
    CHECK(turbine.layout().pitch_actuators.size() == 3);
    CHECK(turbine.loops().distances().at(0).length == Approx(1.9160983729226821).epsilon(1e-14));
    struct Row {
        double stroke, angle;
    };
    for (const Row& row : {Row{0, 0}, Row{0.1, 0.123647690355}, Row{0.3, 0.393845812648}, Row{0.5, 0.711753552035},
                           Row{0.7, 1.116506009053}}) {
        CAPTURE(row.stroke);
        Vector q = Vector::Zero(model.size());
        for (const BodyId actuator : turbine.layout().pitch_actuators) q(model.index(actuator)) = row.stroke;
        const Closure closed = close_loops(model, turbine.system().loops, q);
        REQUIRE(closed.converged);
        for (const BodyId pitch : turbine.layout().pitch)
            CHECK(closed.q(model.index(pitch)) == Approx(row.angle).margin(1e-10));
    }
}

TEST_CASE("pitch linkage: an actuator that yields is a spring at the blade", "[analytic]") {
    const double k = actuator_stiffness / (angle_by_stroke * angle_by_stroke);
    const Turbine with = assemble(machine(linkage({actuator_stiffness, 0}), free_joint), coarse()),
                  without = assemble(machine(std::nullopt, {k, 0}), coarse());
    const std::vector<double> speeds = {0};
    const Campbell a = campbell(with.system(), with.rotor(), speeds),
                   b = campbell(without.system(), without.rotor(), speeds);
    REQUIRE(a.points.at(0).modes.size() == b.points.at(0).modes.size());
    for (std::size_t i = 0; i < a.points[0].modes.size(); ++i) {
        CAPTURE(i, b.points[0].modes[i].mode.natural_hz());
        CHECK(a.points[0].modes[i].mode.natural_hz() ==
              Approx(b.points[0].modes[i].mode.natural_hz()).epsilon(1e-6).margin(1e-9));
    }
    // In rotation the blades' pull turns them against the actuators, by little.
    const std::vector<double> rated = {12.1 * units::rpm};
    const Campbell turning = campbell(with.system(), with.rotor(), rated),
                   sprung = campbell(without.system(), without.rotor(), rated);
    for (std::size_t i = 0; i < 10; ++i)
        CHECK(turning.points.at(0).modes[i].mode.natural_hz() ==
              Approx(sprung.points.at(0).modes[i].mode.natural_hz()).epsilon(2e-4).margin(1e-9));
}

TEST_CASE("pitch linkage: blades pitch in time as their actuators move", "[analytic]") {
    const Turbine turbine = assemble(machine(linkage(prescribed_joint), free_joint), coarse());
    const System& system = turbine.system();
    const Model& model = system.model;
    std::vector<Drive> drives;
    for (const BodyId actuator : turbine.layout().pitch_actuators)
        drives.push_back({model.index(actuator), Motion::constant_rate(0, 0.3, 0)});
    Vector qd = Vector::Zero(model.size());
    for (const Drive& drive : drives) qd(drive.coordinate) = 0.3;
    qd = close_rates(model, system.loops, Vector::Zero(model.size()), qd);
    Integrator run(system, drives, 0, Vector::Zero(model.size()), qd);
    REQUIRE(run.advance(1).reached());
    for (const BodyId pitch : turbine.layout().pitch)
        CHECK(run.state().q(model.index(pitch)) == Approx(0.393845812648).margin(1e-9));
}

TEST_CASE("pitch linkage: gravity on blades that actuators of any mass hold", "[crosscheck]") {
    // Of the same stiffness at the blade, without loops; what the actuators weigh turns the blades by as little as they
    // are light.
    const double k = actuator_stiffness / (angle_by_stroke * angle_by_stroke);
    AssemblyOptions options = coarse();
    options.gravity = Vec3(0, 0, -units::standard_gravity);
    const Turbine without = assemble(machine(std::nullopt, {k, 0}), options);
    const SteadyState reference = steady_state(without.system(), without.rotor().spin);
    REQUIRE(reference.converged);
    for (const double mass : {PitchLinkage().mass, 1e-3, 1e-9}) {
        CAPTURE(mass);
        PitchLinkage light = linkage({actuator_stiffness, 0});
        light.mass = mass;
        const Turbine turbine = assemble(machine(light, free_joint), options);
        const SteadyState state = steady_state(turbine.system(), turbine.rotor().spin);
        REQUIRE(state.converged);
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(state.at.q(turbine.system().model.index(turbine.layout().pitch.at(i))) ==
                  Approx(reference.at.q(without.system().model.index(without.layout().pitch.at(i)))).margin(2e-6));
    }
}

TEST_CASE("pitch linkage: in files, and what cannot be is refused", "[property][bad-input]") {
    TurbineDescription d = read_openfast(test::data_file("openfast/small.fst")).description;
    d.blade.linkage = linkage({actuator_stiffness, 2e5});
    d.blade.pitch = {3e6, 0};
    const TurbineDescription read = parse_description(to_yaml(d), "machine.yaml");
    CHECK(to_yaml(read) == to_yaml(d));
    REQUIRE(read.blade.linkage);
    CHECK(read.blade.linkage->crank_pin == d.blade.linkage->crank_pin);
    CHECK(read.blade.linkage->actuator.damping == 2e5);

    const auto refuse = [](TurbineDescription bad, std::initializer_list<std::string> words) {
        check_refused([&] { bad.check(); }, words);
    };
    refuse(machine(linkage(prescribed_joint), rigid_joint), {"blade.pitch", "rigid", "linkage"});
    refuse(machine(linkage(free_joint), free_joint), {"linkage.actuator", "free"});
    PitchLinkage dead = linkage(prescribed_joint);
    dead.actuator_pin = -dead.crank_pin;
    refuse(machine(dead, free_joint), {"lever", "dead point"});
    PitchLinkage still = linkage(prescribed_joint);
    still.direction.setZero();
    refuse(machine(still, free_joint), {"direction"});
    PitchLinkage light = linkage(prescribed_joint);
    light.mass = 0;
    refuse(machine(light, free_joint), {"linkage.mass"});
    TurbineDescription mixed = machine(linkage(prescribed_joint), free_joint);
    mixed.individual_blades[2] = mixed.blade;
    mixed.individual_blades[2]->linkage.reset();
    refuse(mixed, {"own_blades[2].linkage"});
}
