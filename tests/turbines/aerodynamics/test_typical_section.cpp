// Flutter and divergence of a section on two springs in the air of a lagging profile, against Theodorsen's equations.
#include "elements/aerodynamics/lagging_air.hpp"
#include "solvers/stability/stability_limits.hpp"
#include "tests/oracles/strip_flutter.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"
#include "tests/turbines/aerodynamics/flat_plate.hpp"

#include <cmath>
#include <optional>

namespace cardan::testing::typical_section_tests {

namespace {

using namespace solvers;

// The section of D. H. Hodges and G. A. Pierce, Introduction to Structural Dynamics and Aeroelasticity, chapter 5: mass
// ratio 20, a = -1/5, mass centre at e = -1/10, r^2 = 6/25, frequency ratio 2/5; here with b = 1 m, rho = 1 kg/m^3 and
// 1 rad/s of pitch alone.
constexpr double b = 1, a = -0.2, density = 1, mass = 20 * pi, offset = 0.1, inertia = 4.8 * pi;
constexpr double plunge_stiffness = 3.2 * pi, pitch_stiffness = 4.8 * pi;

oracles::StripFlutter theory() {
    return {{b, a, density, mass, mass * offset, inertia}, oracles::section_shapes(plunge_stiffness, pitch_stiffness)};
}

// Wind along x, span along z: the lift of a positive angle of attack acts along -y, and plunge is y.
class Section {
public:
    explicit Section(const UnsteadyAirfoil& airfoil) : airfoil_(airfoil) {
        const Link plunge = add_joint(tree_, {.name = "plunge", .kind = JointKind::prismatic, .axis = Vec3::UnitY()});
        const AirMass air(density, b);
        const RigidInertia own{mass, {offset, 0, 0}, Vec3(0, 0, inertia - mass * offset * offset).asDiagonal(), true},
            moved{air.mass, {-a * b, 0, 0}, Vec3(0, 0, air.inertia).asDiagonal(), true};
        const Link pitch = add_joint(tree_, {.name = "pitch", .inboard = plunge.axes, .inertia = own + moved});
        forces_.add_spring("plunge", plunge.body, plunge_stiffness);
        forces_.add_spring("pitch", pitch.body, pitch_stiffness);
        centre_ = tree_.add_frame(pitch.axes, Placement::translation({lever, 0, 0}), "aerodynamic centre");
        const Model model(tree_);
        plunge_ = model.index(plunge.body);
        pitch_ = model.index(pitch.body);
    }
    Section(const Section&) = delete;
    Section& operator=(const Section&) = delete;

    // Valid until the next call.
    CampbellCase in(double wind) {
        ForceSet forces = forces_;
        forces.add_element(air(wind));
        system_.emplace(tree_, forces);
        map_.machine = "typical section";
        map_.parts = {{"", Tree::base(), {"", "plunge", ""}, {"", "", "pitch"}}};
        return {.system = &*system_, .rotor = &map_};
    }

private:
    static constexpr double lever = -(a + 0.5) * b;  // of the aerodynamic centre

    ForceElement air(double wind) const {
        ForceElement field{.name = "air", .points = {{.frame = centre_}}};
        for (const char* name : {"fast wake", "slow wake", "lagging lift", "separation"})
            field.states.push_back({.name = name, .unit = "1", .scale = 0.1});
        field.evaluate = [this, wind](const ElementView& at, ElementForces& out) {
            const double angle = at.q(pitch_), rate = at.qd(pitch_);
            const Vec3 along(std::cos(angle), std::sin(angle), 0);
            const Vec3 relative = Vec3(wind, -at.qd(plunge_), 0) - rate * lever * Vec3(-along.y(), along.x(), 0);
            const Annulus annulus{.blades = 1, .radius = 1, .chord = 2 * b, .angle = std::atan2(along.x(), along.y())};
            const SectionMotion motion{.V_x = relative.x(), .V_y = relative.y(), .rate = rate, .wake = {}};
            const UnsteadySection lags{.airfoil = &airfoil_};
            SectionStates states = SectionStates::Zero();
            states.head<UnsteadyAirfoil::states>() = at.s;
            RotorAirOptions options;
            options.induction = false;
            const LaggingAir air = lagging_air(annulus, motion, states, options, density, lags);
            out.wrenches[0] = {Vec3(air.air.force.normal, -air.air.force.driving, 0), Vec3(0, 0, air.air.force.moment)};
            out.f = air.rates.head<UnsteadyAirfoil::states>();
        };
        return field;
    }

    UnsteadyAirfoil airfoil_;
    Tree tree_;
    ForceSet forces_;
    FrameId centre_;
    int plunge_ = 0, pitch_ = 0;
    RotorMap map_;
    std::optional<System> system_;
};

StabilityLimits limits_of(const UnsteadyAirfoil& airfoil, double from, double to) {
    Section section(airfoil);
    StabilityOptions options;
    options.growth = 1e-12;  // of a system this small no more is rounding
    return stability_limits([&](double wind) { return section.in(wind); }, "wind speed, m/s", from, to, options);
}

}  // namespace

TEST_CASE("typical section: flutter as in Theodorsen's equations with the same lags, divergence in closed form",
          "[analytic]") {
    const StabilityLimits found = limits_of(flat_plate_by_jones(), 0.5, 3);
    CHECK(found.note == "");
    REQUIRE(found.limits.size() == 2);
    const StabilityLimit &flutter = found.limits[0], &divergence = found.limits[1];
    const oracles::FlutterPoint expected = theory().flutter(oracles::jones_lags, 10);
    CHECK(flutter.kind == Instability::flutter);
    CHECK(flutter.begins);
    CHECK(flutter.parameter == Approx(expected.speed).epsilon(1e-7));
    CHECK(flutter.eigenvalue.imag() == Approx(expected.frequency).epsilon(1e-7));
    CHECK(std::abs(flutter.eigenvalue.real()) < 1e-7);
    // Moment of the lift about the elastic axis = spring: U^2 = k / (2 pi rho b (a + 1/2) b).
    CHECK(divergence.kind == Instability::divergence);
    CHECK(divergence.begins);
    CHECK(divergence.parameter ==
          Approx(std::sqrt(pitch_stiffness / (2 * pi * density * b * b * (a + 0.5)))).epsilon(1e-8));
    CHECK(divergence.eigenvalue == 0.0);
    CHECK(divergence.name == "pitch");
    CHECK(found.first(Instability::flutter) == &flutter);
}

TEST_CASE("typical section: quasi-steady lift flutters at less than half the speed", "[analytic]") {
    const oracles::FlutterPoint expected = theory().flutter([](double) { return 1; }, 10);
    const StabilityLimits found = limits_of(quasi_steady_plate(), 0.3, 1.5);
    REQUIRE(found.first(Instability::flutter) != nullptr);
    CHECK(found.first(Instability::flutter)->parameter == Approx(expected.speed).epsilon(1e-7));
    CHECK(found.first(Instability::flutter)->eigenvalue.imag() == Approx(expected.frequency).epsilon(1e-7));
}

TEST_CASE("typical section: what the two exponentials are off Theodorsen's function", "[analytic]") {
    const oracles::FlutterPoint exact = theory().flutter(oracles::theodorsen, 10);
    const StabilityLimits found = limits_of(flat_plate_by_jones(), 2, 2.4);
    REQUIRE(found.first(Instability::flutter) != nullptr);
    // 0.6 and 0.7 %: a property of the approximation, not of the solution.
    CHECK(found.first(Instability::flutter)->parameter / exact.speed - 1 == Approx(-0.0062).margin(2e-4));
    CHECK(found.first(Instability::flutter)->eigenvalue.imag() / exact.frequency - 1 == Approx(-0.0072).margin(2e-4));
}

TEST_CASE("typical section: eigenvalues on both sides of flutter", "[analytic]") {
    Section section(flat_plate_by_jones());
    for (const double wind : {0.5, 1.5, 2.1, 2.3, 2.6}) {
        CampbellCase one = section.in(wind);
        one.parameter = wind;
        const Campbell diagram = campbell(std::span(&one, 1), "wind speed, m/s");
        const Eigen::VectorXcd expected = theory().eigenvalues(oracles::jones_lags, wind);
        for (const CampbellMode& mode : diagram.points[0].modes) {
            if (!mode.mode.oscillates()) continue;
            CAPTURE(wind, mode.mode.eigenvalue);
            CHECK((expected.array() - mode.mode.eigenvalue).abs().minCoeff() < 1e-7);
        }
    }
}

}  // namespace cardan::testing::typical_section_tests
