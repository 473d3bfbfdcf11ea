// Campbell diagrams by Floquet's theory on small rotors: against Coleman's, closed forms, floquet() in blade
// coordinates, the multi-blade linear model; input that is refused.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>
#include <cmath>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

CampbellOptions by(CampbellMethod method, double max_frequency_hz = 15) {
    CampbellOptions options;
    options.method = method;
    options.max_frequency_hz = max_frequency_hz;
    return options;
}

// Lags and flaps on a nacelle that tilts and yaws, with damping.
SmallRotor whirling(int blades, const Vec3& gravity = Vec3::Zero()) {
    SmallRotorSpec spec;
    spec.stiffness = std::vector<double>(static_cast<std::size_t>(blades), 2000.0);
    spec.damping = 40;
    spec.hinges = BladeHinges::flap_and_lag;
    spec.lag_damping = 60;
    spec.elastic_support = true;
    spec.gravity = gravity;
    return small_rotor(spec);
}

}  // namespace

TEST_CASE("campbell by Floquet: an isotropic rotor without gravity has the diagram of the multi-blade transformation",
          "[crosscheck]") {
    const std::vector<double> speeds{0, 1, 2, 3, 4};
    for (const int blades : {3, 4}) {
        const SmallRotor rotor = whirling(blades);
        const Campbell coleman = diagram_of(rotor, speeds, by(CampbellMethod::coleman)),
                       floquet = diagram_of(rotor, speeds, by(CampbellMethod::floquet)),
                       averaged = diagram_of(rotor, speeds, by(CampbellMethod::averaged));
        CHECK(floquet.warning.empty());
        CHECK(floquet.rows == coleman.rows);
        // Lag and flap of the blades, and two of the support, which has no component modes of its own.
        REQUIRE(coleman.branches.size() == 2 * static_cast<std::size_t>(blades) + 2);
        for (const Branch& expected : coleman.branches)
            for (const Campbell* other : {&floquet, &averaged}) {
                CAPTURE(blades, expected.name);
                const Branch& found = other->branch(expected.name);
                CHECK(found.family == expected.family);
                // Collective and differential flap of four blades have the same frequency: any mixture is a mode.
                const bool single = blades == 3;
                if (single) CHECK(found.doubtful == expected.doubtful);
                if (single) CHECK(found.mostly == expected.mostly);
                for (std::size_t i = 0; i < speeds.size(); ++i) {
                    const CampbellMode &a = *coleman.mode(expected, i), &b = *other->mode(found, i);
                    CHECK(std::abs(a.mode.eigenvalue - b.mode.eigenvalue) < 1e-9);
                    if (!single) continue;
                    CHECK((a.row_shares - b.row_shares).cwiseAbs().maxCoeff() < 1e-7);
                    // Equal shapes but for a phase.
                    const Complex product = a.mode.shape.dot(b.mode.shape);
                    CHECK((a.mode.shape * (product / std::abs(product)) - b.mode.shape).norm() <
                          1e-7 * a.mode.shape.norm());
                }
            }
        // Beside them the free spin: an angle and a steady rate that nothing holds.
        CHECK(floquet.branches.size() == coleman.branches.size() + 2);
        CHECK(floquet.branch("spin (rigid)").family == "spin");
        CHECK(floquet.branch("spin (2nd rigid)").family == "spin");
        CHECK(std::isnan(floquet.damping_ratio(floquet.branch("spin (rigid)"), 2)));
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            CHECK(floquet.points[i].stability_margin == Approx(coleman.points[i].stability_margin).epsilon(1e-7));
            CHECK(floquet.points[i].stability_margin > 0);
            CHECK(floquet.points[i].periodic.has_value() == (speeds[i] != 0));
        }
        // Crossings are those of the vibrations.
        REQUIRE(floquet.crossings.size() == coleman.crossings.size());
        for (std::size_t i = 0; i < coleman.crossings.size(); ++i)
            CHECK(floquet.crossings[i].rotor_speed == Approx(coleman.crossings[i].rotor_speed).epsilon(1e-6));
    }
}

TEST_CASE("campbell by Floquet: two hinged blades on a rigid hub flap together and against each other at one frequency",
          "[analytic]") {
    // w^2 = k / (m l^2) + Omega^2 (1 + e / l) in the rotating frame, decay c / (2 m l^2).
    const double m = 3, l = 4, e = 0.5, k = 2000, c = 6, decay = c / (2 * m * l * l);
    const SmallRotor rotor = small_rotor({.stiffness = {k, k}, .damping = c});
    const std::vector<double> speeds{0, 1, 2.5, 4};
    const Campbell d = diagram_of(rotor, speeds, by(CampbellMethod::floquet));
    CHECK(d.blades == 2);
    CHECK(d.rows == std::vector<std::string>{"spin", "flap 1 (collective)", "flap 1 (differential)"});
    CHECK_THAT(d.method, Catch::Contains("Floquet") && Catch::Contains("rotating frame"));
    REQUIRE(d.branches.size() == 4);
    for (const auto& [name, pattern] : {std::pair{"blade flap (symmetric)", RotorPattern::symmetric},
                                        std::pair{"blade flap (antisymmetric)", RotorPattern::antisymmetric}}) {
        const Branch& branch = d.branch(name);
        CHECK(branch.pattern == pattern);
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            CAPTURE(name, speeds[i]);
            const double w = std::sqrt(k / (m * l * l) + speeds[i] * speeds[i] * (1 + e / l));
            CHECK(d.natural_hz(branch, i) == Approx(w / (2 * pi)).epsilon(1e-9));
            CHECK(d.damping_ratio(branch, i) == Approx(decay / w).epsilon(1e-8));
            CHECK(d.points[i].stability_margin == Approx(decay).epsilon(1e-8));
            CHECK_FALSE(branch.doubtful[i]);
            CHECK(branch.mostly[i] == name);
        }
    }
    CHECK(rotor_multiples(2) == std::vector<int>{1, 2, 4, 6});
}

TEST_CASE("campbell by Floquet: in gravity the exponents are those of the machine in blade coordinates",
          "[crosscheck]") {
    for (const int blades : {1, 2, 3}) {
        const SmallRotor rotor = whirling(blades, {0, -units::standard_gravity, -1});
        CampbellOptions options = by(CampbellMethod::floquet);
        options.spin = RotorSpin::prescribed;
        options.floquet.harmonics = 12;
        const std::vector<double> speeds{2, 2.5};
        const Campbell d = diagram_of(rotor, speeds, options);
        CHECK(d.warning.empty());
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            PeriodicOptions periodic;
            periodic.rotor_speed = speeds[i];
            periodic.harmonics = 12;
            const PeriodicSteadyState state = harmonic_balance(rotor.system, rotor.map.spin, periodic);
            REQUIRE(state.converged);
            CHECK(state.amplitude(1) > 1e-2);
            REQUIRE(d.points[i].periodic.has_value());
            CHECK((d.points[i].periodic->coefficients - state.coefficients).cwiseAbs().maxCoeff() < 1e-9);
            CHECK((d.points[i].at.q - state.at(0).q).norm() < 1e-9);
            const Floquet expected = floquet(linearised(rotor.system, state));
            std::vector<Complex> found;
            for (const CampbellMode& m : d.points[i].modes) {
                found.push_back(m.mode.eigenvalue);
                if (m.kind() == FloquetKind::oscillation) found.push_back(std::conj(m.mode.eigenvalue));
            }
            CAPTURE(blades, speeds[i]);
            CHECK(found.size() == static_cast<std::size_t>(2 * (2 * blades + 2)));
            CHECK(distance(exponents(expected), found, speeds[i]) < 1e-8);
            CHECK(d.points[i].stability_margin == Approx(expected.stability_margin()).epsilon(1e-7));
        }
    }
}

TEST_CASE("campbell: the mean over the azimuth has the poles of the multi-blade linear model", "[crosscheck]") {
    const SmallRotor rotor = whirling(3, {0, -units::standard_gravity, -1});
    CampbellOptions options = by(CampbellMethod::averaged);
    options.spin = RotorSpin::prescribed;
    const double speed[] = {2.0};
    const Campbell d = campbell(rotor.system, rotor.map, speed, options);
    StateSpaceOptions space;
    space.spin = RotorSpin::prescribed;
    space.azimuths = 48;
    const LinearInput input = LinearInput::generalised_force("moment", {{rotor.map.blades[0][0], 1.0}});
    const MultiBladeModel mean =
        multi_blade(state_space(rotor.system, rotor.map, *d.points[0].periodic, {input}, {}, space), rotor.map);
    CHECK(mean.A_remainder > 1e-3);
    // The mean of M^-1 K is not that of M times that of K: of second order in the remainder.
    const std::vector<Complex> poles = mean.poles();
    REQUIRE(d.points[0].modes.size() == 8);
    for (const CampbellMode& m : d.points[0].modes) {
        const double nearest = distance(m.mode.eigenvalue, poles, 1e9);
        CAPTURE(m.mode.eigenvalue, nearest, mean.A_remainder);
        CHECK(nearest < 2 * mean.A_remainder * mean.A_remainder * std::abs(m.mode.eigenvalue));
    }
}

TEST_CASE("campbell by Floquet: blades that differ are integrated over the whole revolution", "[crosscheck]") {
    const SmallRotor rotor = small_rotor({.stiffness = {1700, 2300, 2600}});
    CampbellOptions options = by(CampbellMethod::floquet);
    options.spin = RotorSpin::prescribed;
    const Campbell d = diagram_of(rotor, {3.0}, options);
    // On a rigid hub with prescribed spin every blade has its own frequency in the rotating frame.
    const double m = 3, l = 4, e = 0.5;
    std::vector<Complex> expected;
    for (const double k : {1700.0, 2300.0, 2600.0})
        for (const double sign : {1.0, -1.0})
            expected.emplace_back(0, sign * std::sqrt(k / (m * l * l) + 9 * (1 + e / l)));
    REQUIRE(d.points[0].modes.size() == 3);
    for (const CampbellMode& mode : d.points[0].modes) CHECK(distance(mode.mode.eigenvalue, expected, 3) < 1e-8);
}

TEST_CASE("campbell by Floquet: the tips move as the sum of all harmonics says", "[analytic]") {
    const SmallRotor rotor = whirling(2);
    const double l = 4;
    const Campbell d = diagram_of(rotor, {2.0}, by(CampbellMethod::floquet));
    for (const Branch& branch : d.branches) {
        if (branch.row >= 0) continue;
        const CampbellMode& mode = *d.mode(branch, 0);
        REQUIRE(mode.floquet.has_value());
        const ComplexVector shape = mode.floquet->shape(0);
        const std::vector<FrameMotion> motion = d.motion(branch, 0);
        // Rotation of the lag body of blade 1 about z: tilt and yaw do not turn it about z; spin and lag do.
        const auto row = [&](const char* name) {
            return std::find(d.rows.begin(), d.rows.end(), name) - d.rows.begin();
        };
        const auto frame = std::find(d.frames.begin(), d.frames.end(), "lag 1") - d.frames.begin();
        REQUIRE(frame < std::ssize(d.frames));
        const Complex lag = (shape(row("lag 1 (collective)")) + shape(row("lag 1 (differential)"))) / std::sqrt(2.0);
        const Complex turned = entry(motion, frame).motion(2);
        CAPTURE(branch.name, l);
        CHECK(std::abs(turned - (lag + shape(row("spin")))) < 1e-9 * shape.norm());
    }
}

TEST_CASE("campbell by Floquet: what cannot be computed is refused", "[property]") {
    const SmallRotor two = small_rotor({.stiffness = {2000, 2000}});
    for (const CampbellMethod method :
         {CampbellMethod::coleman, CampbellMethod::frozen_azimuth, CampbellMethod::averaged})
        check_refused([&, method] { (void)diagram_of(two, {1.0}, by(method)); },
                      {"small rotor", "number of blades = 2", "two blades", "floquet"});
    SmallRotor spinless = small_rotor();
    spinless.map.spin = -1;
    check_refused([&] { (void)diagram_of(spinless, {1.0}, by(CampbellMethod::floquet)); }, {"rotor = none"});
    CampbellOptions options = by(CampbellMethod::floquet);
    options.floquet.per_period = -1;
    check_refused([&] { (void)diagram_of(two, {1.0}, options); }, {"per revolution", "-1", ">= 0"});
    options = by(CampbellMethod::floquet);
    options.floquet.max_steps = -2;
    check_refused([&] { (void)diagram_of(two, {1.0}, options); }, {"limit of steps", "-2"});
    options = by(CampbellMethod::floquet);
    options.floquet.harmonics = -1;
    check_refused([&] { (void)diagram_of(two, {1.0}, options); }, {"number of harmonics = -1"});
    options = by(CampbellMethod::floquet);
    options.floquet.tolerance = 0;
    check_refused([&] { (void)diagram_of(two, {1.0}, options); }, {"tolerance", "> 0"});
    options = by(CampbellMethod::floquet);
    options.floquet.fixed_means = {99};
    check_refused([&] { (void)diagram_of(two, {1.0}, options); }, {"mean is fixed = 99"});
}

TEST_CASE("campbell by Floquet: too few steps give a warning", "[property]") {
    double highest = 0;
    const Campbell usual = diagram_of(whirling(2), {0.5}, by(CampbellMethod::floquet));
    for (const CampbellMode& m : usual.points[0].modes) highest = std::max(highest, m.mode.natural_hz());
    // The fastest motion is just below the largest frequency.
    CampbellOptions options = by(CampbellMethod::floquet, 1.05 * highest);
    options.floquet.max_steps = 1;
    options.floquet.tolerance = 1e-14;
    const Campbell d = diagram_of(whirling(2), {0.5}, options);
    CHECK_THAT(d.warning, Catch::Contains("rpm") && Catch::Contains("less accurate than wanted"));
}

TEST_CASE("campbell by Floquet: a steady state that is missing at the last speed is found out before any modes",
          "[property]") {
    SmallRotorSpec spec{.stiffness = {2000, 2000}};
    spec.more = [](ForceSet& forces, const std::vector<std::vector<BodyId>>&) {
        // Coordinates: spin, flaps. T (1 + q^2) = K q has no solution for a large T.
        const auto torque = [](const ElementView& at) { return 10 * std::pow(at.qd(0), 5); };
        forces.add_element({.name = "lift",
                            .points = {{Tree::base()}},
                            .evaluate =
                                [torque](const ElementView& at, ElementForces& out) {
                                    for (const int i : {1, 2}) out.Q(i) += torque(at) * (1 + at.q(i) * at.q(i));
                                },
                            .jacobian =
                                [torque](const ElementView& at, ElementJacobian& d) {
                                    for (const int i : {1, 2}) {
                                        d.Q_q(i, i) += 2 * torque(at) * at.q(i);
                                        d.Q_qd(i, 0) += 5 * torque(at) / at.qd(0) * (1 + at.q(i) * at.q(i));
                                    }
                                }});
    };
    const SmallRotor rotor = small_rotor(spec);
    CampbellOptions options = by(CampbellMethod::floquet);
    options.spin = RotorSpin::prescribed;
    int points = 0;
    options.progress = [&points](int, int) { ++points; };
    CHECK(diagram_of(rotor, {1.0, 1.5}, options).complete);
    CHECK(points == 2);
    points = 0;
    CHECK_THROWS_AS(diagram_of(rotor, {1.0, 1.5, 6.0}, options), NumericalError);
    CHECK(points == 0);
}
