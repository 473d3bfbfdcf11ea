// The main shaft as one beam element in place of the torsion spring.
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

turbines::Turbine with_shaft(double EI, double mass, bool damped = false) {
    turbines::AssemblyOptions options = undamped();
    options.structural_damping = options.joint_damping = damped;
    options.shaft_beam = turbines::ShaftBeam{EI, mass};
    return turbines::wt600(options);
}

double relative_change(double from, double to) {
    return (to - from) / from;
}

}  // namespace

TEST_CASE("shaft beam: one that is stiff in bending is the torsion spring, at 0 and 27 rpm", "[analytic]") {
    const turbines::Turbine spring = turbines::wt600(undamped()), beam = with_shaft(1e14, 1e-3);
    for (double speed : {0.0, 27 * rpm}) {
        const std::vector<double> expected = frequencies(spring, speed), f = frequencies(beam, speed);
        REQUIRE(f.size() == expected.size());
        for (std::size_t i = 0; i < f.size(); ++i) CHECK(f[i] == Approx(expected[i]).epsilon(1e-6));
    }
}

TEST_CASE("shaft beam: a stiff one keeps the damping of the torsion spring", "[analytic]") {
    const double speed[] = {27 * rpm};
    const turbines::Turbine spring = turbines::wt600(turbines::wt600_paper_assembly()),
                            beam = with_shaft(1e14, 1e-3, true);
    const auto expected = solvers::campbell(spring.system(), spring.rotor(), speed),
               d = solvers::campbell(beam.system(), beam.rotor(), speed);
    for (std::size_t i = 0; i < 16; ++i)
        CHECK(d.points[0].modes.at(i).mode.damping_ratio() ==
              Approx(expected.points[0].modes.at(i).mode.damping_ratio()).epsilon(1e-5));
}

TEST_CASE("shaft beam: bending lowers every frequency, tilt and yaw most, in proportion to 1 / EI", "[analytic]") {
    const std::vector<double> rigid = frequencies(turbines::wt600(undamped()), 0),
                              stiff = frequencies(with_shaft(1e11, 1e-3), 0),
                              soft = frequencies(with_shaft(1e10, 1e-3), 0);
    for (std::size_t i = 0; i < rigid.size(); ++i) {
        CHECK(soft.at(i) < rigid[i]);
        CHECK(stiff.at(i) < rigid[i]);
    }
    const auto tilt = [](const std::vector<double>& f) { return f.at(2); };
    const auto yaw = [](const std::vector<double>& f) { return f.at(3); };
    CHECK(relative_change(tilt(rigid), tilt(soft)) == Approx(-2.57e-3).epsilon(0.01));
    CHECK(relative_change(tilt(rigid), tilt(soft)) / relative_change(tilt(rigid), tilt(stiff)) ==
          Approx(10).epsilon(0.01));
    CHECK(relative_change(yaw(rigid), yaw(soft)) / relative_change(yaw(rigid), yaw(stiff)) == Approx(10).epsilon(0.01));
}

TEST_CASE("shaft beam: the transformed matrices are the same at every azimuth, shaft bending turned with the rotor",
          "[property]") {
    const turbines::Turbine machine = with_shaft(1e9, 500, true);
    const RotorMap& rotor = machine.rotor();
    CHECK(rotor.rotating_pairs.size() == 2);
    const std::vector<int> free = machine.system().model.coordinates().free();
    solvers::SteadyOptions options;
    options.rotor_speed = 27 * rpm;
    const auto steady = solvers::steady_state(machine.system(), rotor.spin, options);
    REQUIRE(steady.converged);
    const auto transformed = [&](const RotorMap& map, double azimuth) {
        DynamicState at = steady.at;
        at.q(rotor.spin) = azimuth;
        const solvers::ColemanTransform coleman(map, free);
        return coleman.transform(solvers::restrict_to(solvers::linearise(machine.system(), at), free), azimuth,
                                 options.rotor_speed);
    };
    const auto a = transformed(rotor, 0.3), b = transformed(rotor, 1.7);
    CHECK((a.M - b.M).norm() < 1e-9 * a.M.norm());
    CHECK((a.C - b.C).norm() < 1e-9 * a.C.norm());
    CHECK((a.K - b.K).norm() < 1e-9 * a.K.norm());
    // With the pairs left as they are, or turned the wrong way, it is not so.
    RotorMap without = rotor, wrong = rotor;
    without.rotating_pairs.clear();
    for (RotatingPair& pair : wrong.rotating_pairs) pair.sense = -pair.sense;
    for (const RotorMap& map : {without, wrong})
        CHECK((transformed(map, 0.3).M - transformed(map, 1.7).M).norm() > 1e-3 * a.M.norm());
}

TEST_CASE("shaft beam: its mass counts in the summary, and the modes keep their names", "[property]") {
    const turbines::Turbine machine = with_shaft(3e9, 1000);
    CHECK(machine.system().model.mass() + 0.0 ==
          Approx(turbines::wt600(turbines::wt600_paper_assembly()).system().model.mass() + 2.8 * 1000).epsilon(1e-9));
    const double speed[] = {0};
    const auto d = solvers::campbell(machine.system(), machine.rotor(), speed);
    for (const char* name : {"1st tower fore-aft", "rotor tilt", "rotor yaw", "1st drive-train torsion"})
        CHECK_NOTHROW(d.branch(name));
}

TEST_CASE("shaft beam: one without mass leaves the tilt joint without inertia and is refused", "[property]") {
    check_refused([] { with_shaft(1e9, 0); }, {"singular metric", "main shaft element 1 bending", "armature"});
    check_refused([] { with_shaft(0, 100); }, {"main shaft", "EI flap", "0", "> 0"});
    check_refused([] { with_shaft(1e9, -1); }, {"main shaft", "mass per length", "-1"});
}
