// Flutter and divergence of the wing of M. Goland, J. Appl. Mech. 12 (1945) A197: a uniform cantilever in strip theory,
// here the blade of a parked machine with one blade, feathered into the wind.
#include "mbs/base/entry.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/stability/stability_limits.hpp"
#include "tests/oracles/strip_flutter.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/turbines/aerodynamics/flat_plate.hpp"
#include "turbines/aerodynamics/machine_air.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cardan::testing::goland_wing_tests {

namespace {

using namespace solvers;
using namespace turbines;

constexpr double span = 6.096, chord = 1.8288, b = chord / 2, density = 1.225;
constexpr double mass = 35.71, inertia = 8.64;  // kg/m; kg m about the elastic axis
constexpr double EI = 9.77e6, GJ = 0.987e6;     // N m^2
// Behind the leading edge, over the chord.
constexpr double elastic_axis = 0.33, mass_axis = 0.43, quarter = 0.25;
constexpr double a = 2 * elastic_axis - 1, aft = (mass_axis - elastic_axis) * chord;

oracles::StripFlutter theory() {
    return {{b, a, density, mass, mass * aft, inertia}, oracles::cantilever_shapes(span, EI, GJ, 6)};
}

// y towards the leading edge.
EngineeringSection wing_section(bool with_air) {
    const AirMass air = with_air ? AirMass(density, b) : AirMass(0, b);
    const double behind = -a * b;  // the middle of the chord
    EngineeringSection section;
    section.GJ = GJ;
    section.EI_flap = EI;
    section.EI_edge = 100 * EI;  // held
    section.mass = mass + air.mass;
    section.mass_centre.y = -(mass * aft + air.mass * behind) / section.mass;
    // Of torsion only: neither the wing nor the air has an inertia against the slope of bending.
    section.j_edge = inertia + air.inertia + air.mass * behind * behind -
                     section.mass * section.mass_centre.y * section.mass_centre.y;
    return section;
}

// The air's mass belongs to the structure here: chordwise bending is held, so that it acts across the chord only.
Turbine wing(int elements, bool with_air = true) {
    TurbineDescription d;
    d.name = "Goland's wing";
    d.blades = 1;
    d.hub.radius = 1;
    d.blade.line = uniform_beam(span, wing_section(with_air), "wing");
    AssemblyOptions options;
    options.pitch = pi / 2;
    options.blade_beam = {.elements = elements, .locked_z = true};
    return isolated_blade(d, options);
}

// Sections at the ends of the elements, where a wing of joints twists as it is.
AeroBlade strips(int elements) {
    AeroBlade blade;
    blade.polars = {flat_plate_polar()};
    for (int i = 0; i <= elements; ++i) {
        blade.position.push_back(1 + span * i / elements);
        blade.chord.push_back(chord);
        blade.twist.push_back(0);
        blade.airfoil.push_back(0);
        blade.prebend.push_back(0);
        blade.sweep.push_back((quarter - elastic_axis) * chord);
    }
    return blade;
}

class WingInWind {
public:
    WingInWind(int elements, const std::optional<UnsteadyAirfoil>& airfoil, bool with_air = true)
        : wing_(wing(elements, with_air)), air_(wing_, strips(elements), SteadyWind{}, without_wake()) {
        if (airfoil) air_ = air_.lagging({.airfoils = {*airfoil}});
    }
    // Valid until the next call.
    CampbellCase in(double wind) {
        windy_ = air_.in(SteadyWind{.speed = wind, .density = density}).on(wing_);
        return {.system = &windy_->system(), .rotor = &windy_->rotor()};
    }
    // Without damping: the air's force is that of the angle of attack.
    SecondOrderSystem undamped(double wind) {
        const CampbellCase one = in(wind);
        const Vector zero = Vector::Zero(one.system->model.size());
        std::vector<int> free = one.system->model.coordinates().free_without(one.rotor->spin);
        SecondOrderSystem system = restrict_to(linearise(*one.system, at_rest(zero)), free);
        system.C.setZero();
        return system;
    }

private:
    static RotorAirOptions without_wake() {
        RotorAirOptions options;
        options.skew = Skew::none;
        options.induction = false;
        return options;
    }
    Turbine wing_;
    MachineAir air_;
    std::optional<Turbine> windy_;
};

// The first bending and torsion modes: the third one is beyond.
StabilityOptions two_modes(int steps) {
    StabilityOptions options;
    options.modes.max_frequency_hz = 24;
    options.steps = steps;
    return options;
}

StabilityLimits wing_limits(int elements, const UnsteadyAirfoil& airfoil, double from, double to, int steps) {
    WingInWind wing(elements, airfoil);
    return stability_limits([&](double wind) { return wing.in(wind); }, "wind speed, m/s", from, to, two_modes(steps));
}

StabilityLimit wing_flutter(int elements, const UnsteadyAirfoil& airfoil, double from, double to) {
    const StabilityLimits found = wing_limits(elements, airfoil, from, to, 2);
    CAPTURE(elements, found.note);
    REQUIRE(found.first(Instability::flutter) != nullptr);
    return *found.first(Instability::flutter);
}

}  // namespace

TEST_CASE("Goland's wing: flutter and divergence in one search over the wind speed", "[analytic]") {
    const StabilityLimits found = wing_limits(8, flat_plate_by_jones(), 20, 300, 14);
    CAPTURE(found.note);
    REQUIRE(found.limits.size() == 2);
    const StabilityLimit &flutter = found.limits[0], &divergence = found.limits[1];
    const oracles::FlutterPoint expected = theory().flutter(oracles::jones_lags, 150);
    CHECK(expected.speed == Approx(137.335).margin(5e-4).epsilon(0));
    CHECK(flutter.kind == Instability::flutter);
    CHECK(flutter.begins);
    CHECK(flutter.parameter == Approx(expected.speed).epsilon(0.01));
    CHECK(flutter.eigenvalue.imag() == Approx(expected.frequency).epsilon(0.01));
    CHECK(flutter.rotor_speed == 0);
    // Twist of a cantilever under a moment in proportion to it: its first torsion shape.
    const double exact =
        std::sqrt(pi * pi * GJ / (4 * span * span) / (pi * density * chord * (elastic_axis - quarter) * chord));
    CHECK(exact == Approx(252.278).margin(5e-4).epsilon(0));
    CHECK(divergence.kind == Instability::divergence);
    CHECK(divergence.begins);
    CHECK(divergence.parameter == Approx(exact).epsilon(0.01));
    CHECK(divergence.name == "1st blade torsion");
    CHECK(found.diagram.complete);
}

// Two static roots are complex below 250 m/s and negative next to the divergence, where one of them becomes positive.
TEST_CASE("Goland's wing: divergence begins as the wind rises and ceases as it falls, beside flutter", "[analytic]") {
    constexpr double exact = 252.278, low = 100, high = 300;
    for (const bool rises : {true, false}) {
        WingInWind wing(8, flat_plate_by_jones());
        const auto at = [&](double parameter) { return wing.in(rises ? parameter : low + high - parameter); };
        const StabilityLimits found = stability_limits(at, "wind speed, m/s", low, high, two_modes(20));
        CAPTURE(rises, found.note);
        const auto divergence = std::ranges::find(found.limits, Instability::divergence, &StabilityLimit::kind);
        const auto flutter = std::ranges::find(found.limits, Instability::flutter, &StabilityLimit::kind);
        REQUIRE(found.limits.size() == 2);
        REQUIRE((divergence != found.limits.end() && flutter != found.limits.end()));
        CHECK(divergence->begins == rises);
        CHECK(flutter->begins == rises);
        CHECK((rises ? divergence->parameter : low + high - divergence->parameter) == Approx(exact).epsilon(0.01));
        CHECK((found.note.find("diverges at") != std::string::npos) == !rises);
    }
    const StabilityLimits inside = wing_limits(8, flat_plate_by_jones(), 260, high, 4);
    CHECK(inside.first(Instability::divergence) == nullptr);
    CHECK_THAT(inside.note, Catch::Contains("the machine diverges at wind speed, m/s 260 already"));
}

TEST_CASE("Goland's wing: flutter converges to that of the continuous wing, of second order", "[analytic]") {
    const oracles::FlutterPoint expected = theory().flutter(oracles::jones_lags, 150);
    const auto error = [&](int elements) {
        const StabilityLimit found = wing_flutter(elements, flat_plate_by_jones(), 125, 150);
        return std::pair(found.parameter / expected.speed - 1, found.eigenvalue.imag() / expected.frequency - 1);
    };
    const auto n3 = error(3), n6 = error(6), n12 = error(12);
    CAPTURE(n3, n6, n12);
    CHECK(observed_order(n6.first, n12.first) == Approx(2).margin(0.1));
    CHECK(observed_order(n6.second, n12.second) == Approx(2).margin(0.1));
    // Extrapolated.
    CHECK(std::abs(n12.first + (n12.first - n6.first) / 3) < 1e-4);
    CHECK(std::abs(n12.second + (n12.second - n6.second) / 3) < 1e-4);
}

TEST_CASE("Goland's wing: other lags, and none", "[analytic]") {
    const StabilityLimit other = wing_flutter(8, flat_plate(0.3, 0.7, 0.14, 0.53), 110, 135);
    const oracles::FlutterPoint slower = theory().flutter(oracles::TwoLags{{0.3, 0.7}, {0.14, 0.53}}, 150);
    CHECK(other.parameter == Approx(slower.speed).epsilon(0.01));
    CHECK(other.eigenvalue.imag() == Approx(slower.frequency).epsilon(0.01));
    const StabilityLimit quasi_steady = wing_flutter(8, quasi_steady_plate(), 50, 80);
    const oracles::FlutterPoint at_once = theory().flutter([](double) { return 1; }, 150);
    CHECK(quasi_steady.parameter == Approx(at_once.speed).epsilon(0.01));
    CHECK(quasi_steady.eigenvalue.imag() == Approx(at_once.frequency).epsilon(0.01));
}

TEST_CASE("Goland's wing: eigenvalues below and above flutter", "[analytic]") {
    WingInWind wing(8, flat_plate_by_jones());
    for (const double wind : {40.0, 80.0, 120.0, 137.0, 160.0}) {
        CampbellCase one = wing.in(wind);
        one.parameter = wind;
        CampbellOptions options;
        options.max_frequency_hz = 24;
        const Campbell diagram = campbell(std::span(&one, 1), "wind speed, m/s", options);
        std::vector<Complex> own;
        for (const CampbellMode& mode : diagram.points[0].modes)
            if (mode.mode.oscillates()) own.push_back(mode.mode.eigenvalue);
        for (const StateMotion& motion : diagram.points[0].state_motions)
            if (motion.mode.oscillates()) own.push_back(motion.mode.eigenvalue);
        const Eigen::VectorXcd expected = theory().eigenvalues(oracles::jones_lags, wind);
        for (Eigen::Index i = 0; i < 2; ++i) {
            double nearest = 1e9;
            for (const Complex value : own) nearest = std::min(nearest, std::abs(value - expected(i)));
            CAPTURE(wind, expected(i), nearest);
            CHECK(nearest < 0.01 * std::abs(expected(i)));
        }
    }
}

TEST_CASE("Goland's wing: in vacuo, and frequencies that meet without damping", "[analytic]") {
    WingInWind wing(8, std::nullopt, false);
    const Eigen::VectorXd expected = theory().frequencies();
    const std::vector<Mode> own = modes(wing.undamped(0));
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(std::abs(own[i].eigenvalue) == Approx(expected(static_cast<Eigen::Index>(i))).epsilon(0.01));
    const auto growth = [&](double wind) {
        double most = 0;
        for (const Mode& mode : modes(wing.undamped(wind)))
            if (mode.damped_hz() < 24) most = std::max(most, mode.eigenvalue.real() / std::abs(mode.eigenvalue));
        return most;
    };
    double low = 80, high = 120;
    while (high - low > 1e-6) (growth((low + high) / 2) > 1e-5 ? high : low) = (low + high) / 2;
    CHECK(high == Approx(theory().steady_flutter(200).speed).epsilon(0.01));
}

}  // namespace cardan::testing::goland_wing_tests
