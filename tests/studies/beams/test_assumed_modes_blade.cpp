// A general blade by assumed modes: the geometrically exact rod in rotation, loads of moving frames, structure of the
// matrices, bad input.
#include "elements/sections/quadrature.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/oracles/rotating_blade.hpp"
#include "tests/studies/beams/assumed_modes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// Tapered, twisted, mass centres off the axis: nothing about it is symmetric.
std::vector<oracles::BladeStation> general_stations(double offset = 1) {
    return {{0.0, 200.0, 4e8, 5e8, 2e8, 0.25, 0.02 * offset, 0.0, 40.0},
            {5.0, 140.0, 9e7, 3e8, 4e7, 0.18, 0.08 * offset, 0.0, 30.0},
            {12.0, 80.0, 1.2e7, 9e7, 6e6, 0.05, 0.06 * offset, 0.0, 10.0},
            {20.0, 20.0, 4e5, 6e6, 3e5, -0.02, 0.02 * offset, 0.0, 1.0}};
}

// The oracle's continuum: log-linear stiffnesses, polar inertia shared out as the bending stiffnesses are.
BeamLine general_blade_line() {
    std::vector<double> x;
    std::vector<EngineeringSection> sections;
    for (const oracles::BladeStation& station : general_stations()) {
        EngineeringSection s;
        s.mass = station.mass_per_length;
        s.EI_flap = station.flap_stiffness, s.EI_edge = station.edge_stiffness, s.GJ = station.torsion_stiffness;
        s.beta = -station.twist;
        s.mass_centre.y = -station.mass_centre_offset;
        s.j_edge = station.polar_inertia;
        x.push_back(station.x);
        sections.push_back(s);
    }
    const BeamTable table{"general blade", x, sections, Interpolation::log_linear_stiffness};
    BeamLine line = beam_line(table);
    line.section = [table](double at) {
        EngineeringSection s = table.constants(at);
        const double polar = s.j_edge;
        s.j_edge = polar * s.EI_edge / (s.EI_edge + s.EI_flap);
        s.j_flap = polar - s.j_edge;
        return s.section();
    };
    return line;
}

AssumedModesBlade general_blade(int terms = 2) {
    return AssumedModesBlade(general_blade_line(), {.basis = {.bending = terms, .torsion = terms, .extension = 0}});
}

HubMotion any_motion(unsigned seed) {
    Random random(seed);
    HubMotion motion;
    for (Vec3* v : {&motion.A, &motion.B, &motion.A_dot, &motion.B_dot, &motion.gravity}) *v = random_vector(random, 3);
    return motion;
}

}  // namespace

TEST_CASE("assumed modes: a tapered, twisted blade with offsets rotates like the geometrically exact rod",
          "[analytic]") {
    // Both linearised about the undeflected blade, with Coriolis forces; their unknowns agree to second order.
    const oracles::RotatingBlade rod(oracles::BladeStations(general_stations()), 1.5, 8);
    const AssumedModesBlade blade = general_blade(8);
    for (double speed : {0.0, 2.0, 6.0}) {
        const auto exact = rod.modes(speed, 6, oracles::RotatingBlade::About::undeflected).frequency;
        const AssumedModesMatrices m = blade.at(spinning(speed, 1.5));
        const auto modes = solvers::modes({m.M, m.G, m.K, m.K_elastic, {}, -1});
        for (Eigen::Index k = 0; k < 6; ++k) {
            CAPTURE(speed, k);
            CHECK(entry(modes, k).natural_hz() == Approx(exact(k)).epsilon(1e-6));
        }
    }
}

TEST_CASE("assumed modes: M symmetric and definite, G skew, the skew part of K is that of the angular acceleration",
          "[property]") {
    const AssumedModesBlade blade = general_blade(3);
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const HubMotion motion = any_motion(seed);
        const AssumedModesMatrices m = blade.at(motion);
        CHECK(max_abs(m.M - m.M.transpose()) < 1e-14 * max_abs(m.M));
        CHECK(max_abs(m.G + m.G.transpose()) < 1e-14 * max_abs(m.G));
        CHECK(natural_modes(blade.at({})).at(0).hz > 0);
        const Matrix inertial = m.K - m.K_elastic, skew_part = (m.K - m.K.transpose()) / 2;
        // d/dt (G q') / 2 of a frame that turns faster and faster: power of the loads is that of the energy.
        const Matrix faster = blade.at(HubMotion{.A = motion.A_dot}).G / 2;
        CHECK(max_abs(skew_part - faster) < 1e-11 * max_abs(inertial));
        CHECK(max_abs(blade.at(motion.without_derivatives()).K - blade.at(motion.without_derivatives()).K.transpose()) <
              1e-12 * max_abs(m.K));
    }
}

TEST_CASE("assumed modes: in a frame that falls freely there is neither load nor stiffening", "[property]") {
    const AssumedModesBlade blade = general_blade();
    const Vec3 g(3, -4, 8);
    const AssumedModesMatrices m = blade.at({.B_dot = g, .gravity = g});
    CHECK(max_abs(m.f) == 0.0);
    CHECK(m.K == m.K_elastic);
}

TEST_CASE("assumed modes: a steady velocity of the rotating frame has no effect, unless dB/dt is left out",
          "[property]") {
    const AssumedModesBlade blade = general_blade();
    const auto at = [&](double heave) {
        return HubMotion{}.moved({heave * 3, 0, 0}, {heave, 0, 0}).turned({0, 0, 1}, {0.7, 2, 0}).moved({1.5, 0, 0});
    };
    const AssumedModesMatrices still = blade.at(at(0)), moving = blade.at(at(10));
    CHECK(max_abs(still.f - moving.f) < 1e-12 * max_abs(still.f));
    CHECK(max_abs(still.K - moving.K) < 1e-12 * max_abs(still.K));
    // What Annex A of the paper keeps of it is A x B.
    const AssumedModesMatrices without = blade.at(at(10).without_derivatives());
    CHECK(max_abs(still.f - without.f) > 0.1 * max_abs(still.f));
}

TEST_CASE("assumed modes: loads at the root of the undeflected blade are those of a rigid one", "[analytic]") {
    const BeamLine line = general_blade_line();
    const AssumedModesBlade blade = general_blade();
    const Vector rest = Vector::Zero(blade.size());
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const HubMotion m = any_motion(seed);
        const Vec3 a = m.B_dot + m.A.cross(m.B) - m.gravity;
        const Vec6 exact = integrate(0, line.length, line.breaks, Vec6(Vec6::Zero()), [&](double x) {
            const BeamSection s = line.section(x);
            const Vec3 c(x, s.centre.y(), s.centre.z());
            const Vec3 force = s.mass * (a + m.A_dot.cross(c) + m.A.cross(m.A.cross(c)));
            const Vec3 spin = s.J * m.A_dot + m.A.cross(Vec3(s.J * m.A));
            return Vec6((Vec6() << force, c.cross(force) + spin).finished());
        });
        const RootLoad load = blade.root_load(m, rest, rest, rest);
        CHECK((load.force - exact.head<3>()).norm() < 1e-12 * exact.head<3>().norm());
        CHECK((load.moment - exact.tail<3>()).norm() < 1e-12 * exact.tail<3>().norm());
    }
}

TEST_CASE("assumed modes: in its own natural modes a blade is the same", "[property]") {
    const AssumedModesBlade blade = general_blade();
    const auto modes = natural_modes(blade.at({}));
    Matrix columns(blade.size(), blade.size());
    for (Eigen::Index k = 0; k < columns.cols(); ++k) columns.col(k) = entry(modes, k).shape;
    const AssumedModesBlade same = blade.reduced(columns);
    CHECK(max_abs(same.at({}).M - Matrix::Identity(blade.size(), blade.size())) < 1e-9);
    CHECK(same.deflection(0) == Deflection::mixed);
    const HubMotion motion = any_motion(3);
    Random random(5);
    const Vector q = random_state(random, static_cast<int>(blade.size()));
    const AssumedModesMatrices full = blade.at(motion), less = same.at(motion);
    CHECK(max_abs(less.f - columns.transpose() * full.f) < 1e-11 * max_abs(less.f));
    CHECK(max_abs(less.G - columns.transpose() * full.G * columns) < 1e-11 * max_abs(less.G));
    CHECK(max_abs(less.K - columns.transpose() * full.K * columns) < 1e-11 * max_abs(less.K));
    CHECK(max_abs(same.shapes(13) * q - blade.shapes(13) * columns * q) < 1e-11 * max_abs(same.shapes(13) * q));
    const RootLoad a = same.root_load(motion, q, q, q),
                   b = blade.root_load(motion, columns * q, columns * q, columns * q);
    CHECK((a.force - b.force).norm() < 1e-11 * a.force.norm());
    CHECK((a.moment - b.moment).norm() < 1e-11 * a.moment.norm());
}

TEST_CASE("assumed modes: what the theory does not cover is refused", "[property]") {
    const auto with = [](auto change) {
        EngineeringSection s = slender();
        s.GJ = s.EA = 1, s.j_flap = s.j_edge = 0.1;
        AssumedModesOptions options;
        options.basis = one_piece(3, 2, 1);
        change(s, options);
        return [s, options] { (void)AssumedModesBlade(uniform_beam(1, s, "mast"), options); };
    };
    CHECK(refusal(with([](auto&, auto&) {})) == "(accepted)");
    check_refused(with([](auto& s, auto&) { s.tension_centre.y = 0.1; }),
                  {"mast at x = ", "extension coupled with bending", "tension centres on the axis"});
    check_refused(with([](auto& s, auto&) {
                      s.shear_centre.z = 0.1;
                      s.GA_y = s.GA_z = 1;
                  }),
                  {"mast at x = ", "shear coupled with bending"});
    check_refused(with([](auto& s, auto&) { s.EA = std::numeric_limits<double>::infinity(); }),
                  {"mast at x = ", "1/EA", "no functions of extension"});
    check_refused(with([](auto& s, auto&) { s.GJ = std::numeric_limits<double>::infinity(); }),
                  {"mast at x = ", "1/GJ", "no functions of torsion"});
    check_refused(with([](auto&, auto& o) { o.basis.bending = 1; }), {"mast", "functions of bending = 1", "2 ... 9"});
    check_refused(with([](auto&, auto& o) { o.basis.torsion = 10; }), {"mast", "functions of torsion = 10", "0 ... 9"});
    check_refused(with([](auto&, auto& o) { o.basis.extension = -1; }), {"mast", "functions of extension = -1"});
    check_refused(with([](auto&, auto& o) { o.basis.breaks = {0}; }), {"mast", "ends of the pieces = 1", ">= 2"});
    check_refused(with([](auto&, auto& o) { o.basis.breaks = {0, 0.7, 0.7, 1}; }), {"mast", "end 3", "= 0.7"});
    check_refused(with([](auto&, auto& o) { o.basis.breaks = {0, 0.9}; }), {"mast", "end 2", "= 0.9", "length, 1"});
    BeamLine curved = uniform_beam(1, slender(), "mast");
    curved.axis = ReferenceLine::through({{0, 0, 0}, {0.5, 0.1, 0}, {1, 0.3, 0}}, LineShape::polyline);
    check_refused([&] { (void)AssumedModesBlade(curved); }, {"mast", "straight"});

    const AssumedModesBlade beam(uniform_beam(1, slender()), {.basis = one_piece(3)});
    check_refused([&] { (void)beam.reduced(Matrix::Identity(5, 5)); }, {"reduced", "5, 5", "6, >= 1"});
    EngineeringSection s = slender();
    s.GJ = 1;
    const AssumedModesBlade massless(uniform_beam(1, s), {.basis = one_piece(3, 2)});
    CHECK_THROWS_AS(natural_modes(massless.at({})), NumericalError);
}
