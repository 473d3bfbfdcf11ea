// The NREL 5 MW blade by assumed modes: the tables of the paper of 2018 by its own functions,
// converged frequencies, response to gravity and platform motion, and the joint chain beside it.
#include "examples/studies/machines/nrel5mw_assumed_modes.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/periodic/forced_response.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/oracles/rotating_blade.hpp"
#include "tests/support/catch.hpp"
#include "turbines/reference_turbines/nrel5mw_platform.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

namespace cardan::testing::nrel5mw_assumed_modes {

using namespace turbines;

namespace {

using units::degree;
using units::rpm;
constexpr double rated = 12.1 * rpm, revolution = 2 * pi / rated;

// Modes as they come at this blade, without velocity terms: flap, edge, flap, edge; then the one that twists most.
struct Named {
    std::array<double, 4> bending;
    double torsion;
};
Named named(const AssumedModesBlade& blade, double speed) {
    const AssumedModesMatrices m = blade.at(nrel5mw_spinning_hub(speed));
    const auto modes = natural_modes(m);
    Named found{};
    std::array<std::size_t, 4> count{};
    for (const AssumedMode& mode : modes) {
        const auto share = energy_shares(blade, m, mode.shape);
        const auto kind = static_cast<std::size_t>(std::max_element(share.begin(), share.end()) - share.begin());
        const std::size_t order = count.at(kind)++;
        if (kind < 2 && order < 2) found.bending.at(2 * order + (kind == 0 ? 1 : 0)) = mode.hz;
        if (kind == 2 && order == 0) found.torsion = mode.hz;
    }
    return found;
}

// 1st flap, 1st edge, 2nd flap, 2nd edge at 0, 3 ... 15 rpm: Tables 1 and 2 of the paper. [docs/nrel5mw_paper2018.md]
constexpr std::array<std::array<double, 4>, 6> printed{{{0.6824, 1.0925, 1.9921, 4.0464},
                                                        {0.7005, 1.0967, 2.0304, 4.0584},
                                                        {0.7442, 1.1088, 2.1328, 4.0933},
                                                        {0.7965, 1.1273, 2.2732, 4.1484},
                                                        {0.8486, 1.1504, 2.4300, 4.2207},
                                                        {0.8983, 1.1763, 2.5923, 4.3072}}};

const AssumedModesBlade& converged() {
    static const AssumedModesBlade blade = nrel5mw_blade_converged();
    return blade;
}

struct Motions {
    double surge = 0, sway = 0, heave = 0, roll = 0, pitch = 0, yaw = 0, nacelle = 0;  // amplitudes, m and rad
    double period = 2 * revolution, heave_rate = 0;
    bool derivatives = true;

    HubMotion at(double time) const {
        const double w = 2 * pi / period, s = std::sin(w * time), c = std::cos(w * time);
        const auto sine = [&](double a) { return PrescribedCoordinate{a * s, a * w * c, -a * w * w * s}; };
        Nrel5mwMotion m{sine(surge), sine(sway), sine(heave), sine(roll), sine(pitch), sine(yaw), sine(nacelle), {}};
        m.heave.q += heave_rate * time, m.heave.qd += heave_rate;
        m.azimuth = {rated * time, rated, 0};
        const HubMotion root = nrel5mw_blade_root(m);
        return derivatives ? root : root.without_derivatives();
    }
};

AssumedModesBlade in_natural_modes(const AssumedModesBlade& blade, Eigen::Index count) {
    const auto modes = natural_modes(blade.at(nrel5mw_spinning_hub(rated)));
    Matrix shapes(blade.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) shapes.col(k) = entry(modes, k).shape;
    return blade.reduced(shapes);
}

const AssumedModesBlade& on_platform() {
    static const AssumedModesBlade blade = in_natural_modes(nrel5mw_blade_converged(nrel5mw_platform_blade().line), 16);
    return blade;
}

solvers::ForcedResponse response(const Motions& motions) {
    const AssumedModesBlade& blade = on_platform();
    const auto system = solvers::PeriodicSystem::second_order(
        motions.period, blade.size(), [&](double time, solvers::SecondOrderSystem& out) {
            const AssumedModesMatrices m = blade.at(motions.at(time));
            out.M = m.M, out.C = m.G + nrel5mw_platform_damping * m.K_elastic, out.K = m.K;
        });
    return solvers::forced_response(
        system, [&](double time) { return blade.at(motions.at(time)).f; }, 7);
}

// Deflection of the tip, m: amplitude and phase (of the cosine, deg) of harmonic k.
struct Harmonic {
    double amplitude, phase;
};
enum Direction : std::uint8_t { edge = 1, flap = 2 };
Harmonic tip(const solvers::ForcedResponse& q, Direction direction, Eigen::Index k) {
    const Vector y = (on_platform().shapes(on_platform().length()).row(direction) * q.coefficients).transpose();
    if (k == 0) return {y(0), 0};
    return {std::hypot(y(2 * k - 1), y(2 * k)), std::atan2(-y(2 * k), y(2 * k - 1)) / degree};
}

}  // namespace

TEST_CASE("paper of 2018: its functions give its Table 1, bending, to 0.052 %", "[published][discrete]") {
    const AssumedModesBlade blade = nrel5mw_blade_of_2018();
    CHECK(blade.mass() == Approx(17608.83).margin(0.005));
    CHECK(blade.size() == 13);
    const Named found = named(blade, 0);
    // Another program with the same functions: 0.6822 1.0924 1.9911 4.0452 Hz.
    constexpr std::array<double, 4> recomputed{0.6822, 1.0924, 1.9911, 4.0452};
    for (std::size_t k = 0; k < 4; ++k) {
        CAPTURE(k, found.bending.at(k));
        CHECK(found.bending.at(k) == Approx(printed[0].at(k)).epsilon(5.2e-4));
        CHECK(found.bending.at(k) == Approx(recomputed.at(k)).margin(6e-5));
    }
}

TEST_CASE("paper of 2018: its functions give its Table 2 to 0.052 % if the tension is integrated from the wrong end",
          "[published][discrete]") {
    const AssumedModesBlade blade = nrel5mw_blade_of_2018(TensionIntegral::wrong_end);
    for (std::size_t i = 1; i < printed.size(); ++i) {
        const Named found = named(blade, 3.0 * static_cast<double>(i) * rpm);
        for (std::size_t k = 0; k < 4; ++k) {
            CAPTURE(i, k, found.bending.at(k));
            CHECK(found.bending.at(k) == Approx(printed.at(i).at(k)).epsilon(5.2e-4));
        }
    }
    // Another program with the same functions: 0.8979 and, with the right tension, 0.7591 Hz.
    CHECK(named(blade, 15 * rpm).bending[0] == Approx(0.8979).margin(6e-5));
    CHECK(named(nrel5mw_blade_of_2018(), 15 * rpm).bending[0] == Approx(0.7591).margin(6e-5));
}

TEST_CASE("paper of 2018: more of its functions, and pieces of them, bring its frequencies down to the converged ones",
          "[property]") {
    // Converged without rotary inertia, as the paper's model.
    const Named exact = named(nrel5mw_blade_of_2018({.extension = 0}, TensionIntegral::from_free_tip), 0);
    const double length = converged().length();
    AssumedModesBasis basis = AssumedModesBasis::paper2018(length);
    Named last = named(nrel5mw_blade_of_2018(), 0);
    CHECK(named(nrel5mw_blade_of_2018(basis, TensionIntegral::from_free_tip), 0).bending == last.bending);
    const auto falls = [&] {
        const Named next = named(nrel5mw_blade_of_2018(basis, TensionIntegral::from_free_tip), 0);
        for (std::size_t k = 0; k < 4; ++k) {
            CAPTURE(k);
            CHECK(next.bending.at(k) < last.bending.at(k));
            CHECK(next.bending.at(k) > exact.bending.at(k) - 1e-5);
        }
        last = next;
    };
    basis.bending = 7;
    falls();
    basis.bending = 9;
    falls();
    basis.breaks = {0, length / 2, length};
    falls();
    for (std::size_t k = 0; k < 4; ++k) CHECK(last.bending.at(k) == Approx(exact.bending.at(k)).epsilon(2e-3));
    basis.bending = 10;
    CHECK_THROWS_AS(nrel5mw_blade_of_2018(basis, TensionIntegral::from_free_tip), InputError);
}

TEST_CASE("NREL 5 MW assumed modes: converged functions give the exact frequencies at rest", "[analytic]") {
    const Named found = named(converged(), 0);
    CHECK(converged().mass() == Approx(17608.83).margin(0.005));
    CHECK(found.bending[0] == Approx(0.6772).margin(1e-4));
    CHECK(found.bending[1] == Approx(1.0855).margin(1e-4));
    CHECK(found.bending[2] == Approx(1.9516).margin(1e-4));
    CHECK(found.bending[3] == Approx(3.9962).margin(1e-4));
    CHECK(found.torsion == Approx(5.4709).margin(1e-4));
}

namespace {

// The table as the geometrically exact rod has it, log-linear stiffnesses and polar inertia shared out as the bending
// stiffnesses are, and the same as a beam line.
struct Variant {
    std::vector<oracles::BladeStation> stations;
    BeamLine line;
};
Variant log_linear_variant() {
    const auto t = CsvTable::parse(embedded_data("nrel5mw_blade.csv"), "nrel5mw_blade.csv");
    const auto radius = t.column("radius_from_rotor_apex", "m"), twist = t.column("structural_twist", "deg"),
               mass = t.column("mass_per_length", "kg/m"), flap_wise = t.column("flap_stiffness", "N m^2"),
               edge_wise = t.column("edge_stiffness", "N m^2"), GJ = t.column("torsion_stiffness_GJ", "N m^2"),
               j_flap = t.column("flap_mass_inertia_per_length", "kg m"),
               j_edge = t.column("edge_mass_inertia_per_length", "kg m"), cg = t.column("edge_cg_offset", "m");
    Variant v;
    std::vector<double> x;
    std::vector<EngineeringSection> sections;
    for (std::size_t i = 0; i < t.rows(); ++i) {
        const double factor = 1.04536, polar = factor * (j_flap[i] + j_edge[i]), angle = twist[i] * degree;
        x.push_back(radius[i] - 1.5);
        v.stations.push_back({x.back(), factor * mass[i], flap_wise[i], edge_wise[i], GJ[i], angle, cg[i], 0, polar});
        EngineeringSection s;
        s.mass = factor * mass[i];
        s.EI_flap = flap_wise[i], s.EI_edge = edge_wise[i], s.GJ = GJ[i];
        s.beta = -angle;
        s.mass_centre.y = -cg[i];
        s.j_edge = polar;
        sections.push_back(s);
    }
    const BeamTable table{"NREL 5 MW blade, log-linear", x, sections, Interpolation::log_linear_stiffness};
    v.line = beam_line(table);
    v.line.section = [table](double at) {
        EngineeringSection s = table.constants(at);
        const double polar = s.j_edge;
        s.j_edge = polar * s.EI_edge / (s.EI_edge + s.EI_flap);
        s.j_flap = polar - s.j_edge;
        return s.section();
    };
    return v;
}

// Frequencies with Coriolis forces, Hz.
Vector gyroscopic(const AssumedModesBlade& full, double speed, Eigen::Index count) {
    const HubMotion motion = nrel5mw_spinning_hub(speed);
    const AssumedModesMatrices m = in_natural_modes(full, 60).at(motion);
    const auto modes = solvers::modes({m.M, m.G, m.K, m.K_elastic, {}, -1});
    Vector hz(count);
    for (Eigen::Index k = 0; k < count; ++k) hz(k) = entry(modes, k).natural_hz();
    return hz;
}

// What the steady deflection changes of the first six frequencies, Hz, by the geometrically exact rod.
Vector by_deflection(const oracles::RotatingBlade& rod, double speed) {
    using About = oracles::RotatingBlade::About;
    return rod.modes(speed, 6, About::deflected).frequency - rod.modes(speed, 6, About::undeflected).frequency;
}

}  // namespace

TEST_CASE("NREL 5 MW assumed modes: in rotation the modes of the geometrically exact rod about the undeflected blade",
          "[analytic]") {
    const Variant variant = log_linear_variant();
    AssumedModesOptions inextensible;
    inextensible.basis.extension = 0;
    const Vector found = gyroscopic(AssumedModesBlade(variant.line, inextensible), rated, 6);
    const oracles::RotatingBlade rod(oracles::BladeStations(variant.stations), 1.5, 2);
    const Vector exact = rod.modes(rated, 6, oracles::RotatingBlade::About::undeflected).frequency;
    for (Eigen::Index k = 0; k < 6; ++k) CHECK(found(k) == Approx(exact(k)).epsilon(2e-6));
}

TEST_CASE("NREL 5 MW assumed modes: in rotation the exact frequencies, with steady stretch and deflection added",
          "[analytic][slow]") {
    const std::array<Vector, 2> exact{(Vector(6) << 0.6904, 1.0875, 1.9663, 4.0015, 4.5287, 5.4719).finished(),
                                      (Vector(6) << 0.7288, 1.0936, 2.0105, 4.0173, 4.5676, 5.4753).finished()};
    const BeamLine line = nrel5mw_blade().line;
    const oracles::RotatingBlade rod(oracles::BladeStations(log_linear_variant().stations), 1.5, 2);
    for (std::size_t i = 0; i < 2; ++i) {
        const double speed = i == 0 ? 6 * rpm : rated;
        const Vector found =
            gyroscopic(nrel5mw_blade_converged(stretched(line, nrel5mw_spinning_hub(speed))), speed, 6);
        const Vector sum = found + by_deflection(rod, speed);
        for (Eigen::Index k = 0; k < 6; ++k) {
            CAPTURE(i, k, found(k), sum(k));
            // The bending modes do not need the deflection, but for 2e-4 Hz of the 2nd flap.
            if (k < 4) CHECK(found(k) == Approx(exact.at(i)(k)).margin(k == 2 ? 2.5e-4 : 1e-4));
            CHECK(sum(k) == Approx(exact.at(i)(k)).margin(1e-4));
        }
    }
    // Inextensible, without Coriolis forces: flap 0.7290, edge 1.0943 Hz.
    AssumedModesOptions inextensible;
    inextensible.basis.extension = 0;
    const Named without = named(AssumedModesBlade(line, inextensible), rated);
    CHECK(without.bending[0] == Approx(0.7290).margin(6e-5));
    CHECK(without.bending[1] == Approx(1.0943).margin(6e-5));
}

TEST_CASE("NREL 5 MW assumed modes: under its weight alone the blade answers as the reference", "[analytic]") {
    Motions none;
    none.period = revolution;
    const solvers::ForcedResponse q = response(none);
    CHECK(tip(q, flap, 0).amplitude == Approx(0.4004).epsilon(1.5e-3));
    CHECK(tip(q, flap, 1).amplitude == Approx(0.08952).epsilon(7e-3));
    CHECK(tip(q, flap, 1).phase == Approx(-112.9).margin(0.5));
    CHECK(tip(q, edge, 0).amplitude == Approx(0.05080).epsilon(6e-3));
    CHECK(tip(q, edge, 1).amplitude == Approx(0.4443).epsilon(2.5e-3));
    CHECK(tip(q, edge, 1).phase == Approx(-91.21).margin(0.05));
}

TEST_CASE("NREL 5 MW assumed modes: on a pitching platform 0.640 m, without dA/dt and dB/dt 0.245 m", "[analytic]") {
    Motions pitching;
    pitching.pitch = 5 * degree;
    const solvers::ForcedResponse q = response(pitching);
    CHECK(tip(q, flap, 0).amplitude == Approx(0.3985).epsilon(1e-3));
    CHECK(tip(q, flap, 1).amplitude == Approx(0.6380).epsilon(1e-3));
    CHECK(tip(q, flap, 1).phase == Approx(89.69).margin(0.1));
    CHECK(tip(q, flap, 2).amplitude == Approx(0.08881).epsilon(7e-3));
    CHECK(tip(q, flap, 3).amplitude == Approx(0.4941).epsilon(1.5e-3));
    CHECK(tip(q, flap, 3).phase == Approx(89.85).margin(0.1));
    CHECK(tip(q, edge, 1).amplitude == Approx(0.05079).epsilon(8e-3));
    CHECK(tip(q, edge, 2).amplitude == Approx(0.4369).epsilon(2.5e-3));
    CHECK(tip(q, edge, 3).amplitude == Approx(0.04199).epsilon(1e-2));
    pitching.derivatives = false;
    CHECK(tip(response(pitching), flap, 1).amplitude == Approx(0.245).margin(1e-3));
}

TEST_CASE("NREL 5 MW assumed modes: a steady heave changes nothing, unless dB/dt is left out", "[property]") {
    Motions none, heaving;
    none.period = heaving.period = revolution;
    heaving.heave_rate = 10;
    const Matrix still = response(none).coefficients, moving = response(heaving).coefficients;
    CHECK((moving - still).cwiseAbs().maxCoeff() < 1e-10 * still.cwiseAbs().maxCoeff());
    heaving.derivatives = none.derivatives = false;
    const double change = tip(response(heaving), edge, 1).amplitude / tip(response(none), edge, 1).amplitude;
    CHECK(std::abs(change - 1) > 0.1);
}

TEST_CASE("NREL 5 MW assumed modes: from rest under all motions of the platform as the joint chain", "[crosscheck]") {
    Motions m;
    m.surge = 0.4, m.sway = -0.3, m.heave = 0.3, m.roll = 0.8 * degree, m.pitch = -0.6 * degree;
    m.yaw = 0.4 * degree, m.nacelle = -0.8 * degree, m.period = 0.8 * revolution;

    Nrel5mwPlatformOptions options;
    options.elements = nrel5mw_platform_elements(16);
    const Turbine machine = nrel5mw_on_platform(nrel5mw_platform_blade(), options);
    const Model& model = machine.system().model;
    std::vector<solvers::Drive> drives{
        {model.index(*machine.layout().generator), solvers::Motion::constant_rate(0, rated)},
        {model.index(*machine.layout().yaw), solvers::Motion::harmonic(0, m.nacelle, m.period)}};
    const std::array<double, 6> amplitudes{m.surge, m.sway, m.heave, m.roll, m.pitch, m.yaw};
    for (std::size_t i = 0; i < 6; ++i)
        drives.push_back({model.index(machine.layout().platform->coordinates.at(i)),
                          solvers::Motion::harmonic(0, amplitudes.at(i), m.period)});
    const Vector rest = Vector::Zero(model.size());
    solvers::IntegrationOptions integration;
    integration.tolerances = {1e-6, 1e-8, 1e-8, 1e-7, 1e-7};
    solvers::Integrator integrator(machine.system(), drives, 0, rest, rest, integration);
    solvers::Recorder recorder(integrator, {blade_channels(machine)});
    solvers::History chain;
    constexpr int rows = 100;
    REQUIRE(solvers::record(integrator, recorder, solvers::sample_times(0, revolution, revolution / rows), chain)
                .reached());

    // Runge and Kutta's method of order 4 for the assumed modes. M is the unit matrix in natural modes.
    const AssumedModesBlade& blade = on_platform();
    const Eigen::Index n = blade.size();
    const auto f = [&](double time, const Vector& y) {
        const AssumedModesMatrices a = blade.at(m.at(time));
        Vector yd(2 * n);
        yd << y.tail(n), a.f - a.K * y.head(n) - (a.G + nrel5mw_platform_damping * a.K_elastic) * y.tail(n);
        return yd;
    };
    constexpr int steps = 40;
    const double h = revolution / rows / steps;
    const Matrix shapes = blade.shapes(blade.length());
    Vector y = Vector::Zero(2 * n);
    double largest = 0, difference = 0;
    for (int row = 1; row <= rows; ++row) {
        for (int step = 0; step < steps; ++step) {
            const double t = ((row - 1) * steps + step) * h;
            const Vector k1 = f(t, y), k2 = f(t + h / 2, y + h / 2 * k1), k3 = f(t + h / 2, y + h / 2 * k2),
                         k4 = f(t + h, y + h * k3);
            y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        const Vector at_tip = shapes * y.head(n);
        const auto i = static_cast<std::size_t>(row);
        const double w = chain["blade 1 tip flap deflection"][i], v = chain["blade 1 tip edge deflection"][i];
        largest = std::max({largest, std::abs(w), std::abs(v)});
        difference = std::max({difference, std::abs(w - at_tip(2)), std::abs(v - at_tip(1))});
    }
    CAPTURE(largest, difference);
    CHECK(largest > 0.5);
    CHECK(difference < 0.01 * largest);
}

}  // namespace cardan::testing::nrel5mw_assumed_modes
