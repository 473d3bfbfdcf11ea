// Frequencies of the mixed beam of Lee, Hodges and Patil (2002) against printed digits, closed forms and oracles.
#include "examples/studies/beams/mixed_beam.hpp"
#include "mbs/base/entry.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/oracles/root_finding.hpp"
#include "tests/oracles/rotating_beam_series.hpp"
#include "tests/oracles/rotating_blade.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// The blade of the two-bladed teetered machine: Lee, Hodges and Patil (2002), Table I.
constexpr double rotor_speed = 6.02, blade_length = 8.42, root_radius = 1.8;

BeamLine teetered_blade() {
    EngineeringSection s;
    s.mass = 67.5772;
    s.GJ = s.EI_flap = s.EI_edge = 1e7;
    s.j_flap = 1e-4;
    s.j_edge = 4.9999;
    return uniform_beam(blade_length, s, "blade");
}

MixedSetting turning(double omega, double hub_radius) {
    MixedSetting setting;
    setting.omega = {0, 0, omega};
    setting.root_position = {hub_radius, 0, 0};
    return setting;
}

// Antisymmetric flapping: each blade turns about the teeter axis with half of the hub (50, 50, 5 kg m^2 lateral,
// spanwise, about the shaft).
MixedSetting teetering() {
    MixedSetting setting = turning(rotor_speed, root_radius);
    setting.pin = MixedPin{{0, 1, 0}, {-root_radius, 0, 0}, {}};
    setting.pin->body.J = Vec3(25, 25, 2.5).asDiagonal();
    return setting;
}

struct Frequencies {
    std::vector<double> torsion, lag, flap;  // rad/s, ascending
    std::size_t all = 0;
};

// Told apart by the larger of rotation about x, displacement along y and along z over the whole shape.
Frequencies frequencies(const BeamLine& line, int elements, const MixedSetting& setting) {
    const MixedBeam beam(line, elements);
    const MixedSteadyState steady = mixed_steady_state(beam, setting);
    Frequencies result;
    for (const DescriptorMode& mode : mixed_modes(beam, setting, steady.x)) {
        double torsion = 0, lag = 0, flap = 0;
        for (int k = 0; k < elements + 2; ++k) {
            torsion += std::norm(mode.shape(MixedBeam::station(k) + MixedField::theta) * beam.length());
            lag += std::norm(mode.shape(MixedBeam::station(k) + MixedField::u + 1));
            flap += std::norm(mode.shape(MixedBeam::station(k) + MixedField::u + 2));
        }
        const double largest = std::max({torsion, lag, flap});
        auto& kind = largest == torsion ? result.torsion : largest == lag ? result.lag : result.flap;
        kind.push_back(mode.eigenvalue.imag());
        CHECK(std::abs(mode.eigenvalue.real()) < 1e-6 * std::abs(mode.eigenvalue));  // nothing damps
        ++result.all;
    }
    return result;
}

}  // namespace

TEST_CASE("mixed beam: the blade of Lee, Hodges and Patil (2002), Table I, per rev", "[elements][mixed][discrete]") {
    // Digits of a separate implementation of eq. 7 with the data of Table I (the frequencies of the paper's Table II do
    // not follow from them); one unit of the last digit.
    struct Row {
        int elements;
        double flap, lag, teetered_flap, torsion;
    };
    for (const Row& row : {Row{2, 3.5930, 3.4420, 15.513, 46.237},
                           {3, 3.4919, 3.3373, 12.148, 44.866},
                           {4, 3.4532, 3.2971, 11.217, 44.409},
                           {8, 3.4146, 3.2570, 10.415, 43.978},
                           {16, 3.4048, 3.2468, 10.228, 43.872}}) {
        CAPTURE(row.elements);
        const auto clamped = frequencies(teetered_blade(), row.elements, turning(rotor_speed, root_radius));
        const auto teetered = frequencies(teetered_blade(), row.elements, teetering());
        CHECK(clamped.flap[0] / rotor_speed == Approx(row.flap).epsilon(0).margin(1e-4));
        CHECK(clamped.lag[0] / rotor_speed == Approx(row.lag).epsilon(0).margin(1e-4));
        CHECK(clamped.torsion[0] / rotor_speed == Approx(row.torsion).epsilon(0).margin(1e-3));
        CHECK(teetered.flap[1] / rotor_speed == Approx(row.teetered_flap).epsilon(0).margin(1e-3));
    }
}

TEST_CASE("mixed beam: flap of the spinning blade converges with order 2 to the power series",
          "[elements][mixed][analytic]") {
    // Wright, Smith, Thresher and Wang (1982); the rotary inertia in flap (1e-4 kg m) is worth 1e-7.
    const double unit = std::sqrt(1e7 / 67.5772) / (blade_length * blade_length);
    const oracles::RotatingBeamSeries series{.eta = rotor_speed / unit, .hub_radius = root_radius / blade_length};
    const auto exact = series.flap(2);
    const auto n8 = frequencies(teetered_blade(), 8, turning(rotor_speed, root_radius));
    const auto n16 = frequencies(teetered_blade(), 16, turning(rotor_speed, root_radius));
    CHECK(exact[0] * unit / rotor_speed == Approx(3.4015).epsilon(0).margin(1e-4));
    CHECK(order(n8.flap[0], n16.flap[0], exact[0] * unit) == Approx(2).margin(0.05));
    CHECK(order(n8.flap[1], n16.flap[1], exact[1] * unit) == Approx(2).margin(0.1));
    // Converged lag with its rotary inertia is 3.2434 per rev.
    CHECK(order(n8.lag[0], n16.lag[0], 3.2434 * rotor_speed) == Approx(2).margin(0.05));
}

TEST_CASE("mixed beam: torsion has the box scheme's own closed form", "[elements][mixed][analytic]") {
    // Clamped-free rod by the box scheme: sin becomes tan, omega_k = (2/h) c tan((2k - 1) pi/(4n)), c^2 = GJ/I1. Spin
    // adds the flattening (I3 - I2)/I1 Omega^2.
    for (int n : {2, 3, 5}) {
        const auto result = frequencies(teetered_blade(), n, turning(rotor_speed, root_radius));
        const double h = blade_length / n, c = std::sqrt(1e7 / 5);
        for (int k = 1; k <= n; ++k) {
            const double still = 2 / h * c * std::tan((2 * k - 1) * pi / (4 * n));
            const double spun = std::sqrt(still * still + (4.9999 - 1e-4) / 5 * rotor_speed * rotor_speed);
            CHECK(entry(result.torsion, k - 1) == Approx(spun).epsilon(1e-9));
        }
    }
}

TEST_CASE("mixed beam: a rotor plane tilted about its teeter axis stays tilted, once per rev",
          "[elements][mixed][property]") {
    // Tilting a rigid beam at r against its spin: w^2 = Omega^2 (Iz - Ix)/Iy, Iy = m r^2 + j_flap, Iz = m r^2 + j_edge.
    const double end = root_radius + blade_length;
    const double arm = 67.5772 * (std::pow(end, 3) - std::pow(root_radius, 3)) / 3, j = 1e-4 * blade_length;
    MixedSetting setting = teetering();
    setting.pin->body = {};
    const auto flap = frequencies(teetered_blade(), 4, setting).flap;
    CHECK(flap[0] == Approx(rotor_speed * std::sqrt((arm - j) / (arm + j))).epsilon(1e-9));
}

TEST_CASE("mixed beam: a cantilever at rest converges with order 2 to Euler and Bernoulli",
          "[elements][mixed][analytic]") {
    // Roots of 1 + cos b cosh b = 0, frequencies b^2.
    const std::array<double, 2> exact = {3.5160152685, 22.0344915647};
    EngineeringSection s = slender(1, 1);
    s.EI_edge = 2.25;
    const BeamLine line = uniform_beam(1, s);
    const auto n8 = frequencies(line, 8, {}), n16 = frequencies(line, 16, {});
    for (std::size_t k : {0u, 1u}) {
        CHECK(order(n8.flap[k], n16.flap[k], exact[k]) == Approx(2).margin(0.1));
        CHECK(n16.lag[k] == Approx(1.5 * n16.flap[k]).epsilon(1e-9));
    }
    CHECK(n16.flap[0] == Approx(exact[0]).epsilon(2e-3));
}

TEST_CASE("mixed beam: a body at the tip lowers the frequency as in the characteristic equation",
          "[elements][mixed][analytic]") {
    // Tip mass equal to the beam's: 1 + cos b cosh b + b (cos b sinh b - sin b cosh b) = 0.
    const double b = oracles::bisect(
        [](double z) {
            return 1 + std::cos(z) * std::cosh(z) + z * (std::cos(z) * std::sinh(z) - std::sin(z) * std::cosh(z));
        },
        1.0, 1.5);
    MixedSetting setting;
    setting.tip_body.mass = 1;
    EngineeringSection s = slender(1, 1);
    s.EI_edge = 4;
    const double n8 = frequencies(uniform_beam(1, s), 8, setting).flap[0];
    const double n16 = frequencies(uniform_beam(1, s), 16, setting).flap[0];
    CHECK(order(n8, n16, b * b) == Approx(2).margin(0.05));
    CHECK(n16 == Approx(b * b).epsilon(2e-3));
}

TEST_CASE("mixed beam: a tapered, twisted, spinning blade with offsets converges to the Ritz rod",
          "[elements][mixed][crosscheck]") {
    const std::vector<oracles::BladeStation> stations = {{0.0, 200.0, 4e8, 5e8, 2e8, 0.25, 0.02, 0.0, 40.0},
                                                         {5.0, 140.0, 9e7, 3e8, 4e7, 0.18, 0.08, 0.03, 30.0},
                                                         {10.0, 80.0, 1.2e7, 9e7, 6e6, 0.05, 0.06, 0.02, 10.0},
                                                         {20.0, 20.0, 4e5, 6e6, 3e5, -0.02, 0.02, 0.01, 1.0}};
    const oracles::BladeStations blade(stations);
    BeamLine line;
    line.length = blade.length();
    line.breaks = {0, 5, 10, 20};
    line.section = [&](double x) {
        const oracles::BladeStation station = blade.at(x);
        EngineeringSection s;
        s.mass = station.mass_per_length;
        s.GJ = station.torsion_stiffness, s.EI_flap = station.flap_stiffness, s.EI_edge = station.edge_stiffness;
        s.beta = -station.twist;
        s.mass_centre.y = -station.mass_centre_offset;
        s.shear_centre.y = -station.shear_centre_offset;
        s.j_edge = station.polar_inertia * s.EI_edge / (s.EI_edge + s.EI_flap);
        s.j_flap = station.polar_inertia - s.j_edge;
        return s.section();
    };
    const MixedSetting setting = turning(2.5, 1.5);
    const auto exact = oracles::RotatingBlade(blade, 1.5, 8).modes(2.5, 4);
    const auto solve = [&](int n) {
        const MixedBeam beam(line, n);
        const Vector steady = mixed_steady_state(beam, setting).x;
        Vector result(8);
        result.head<3>() = steady.segment<3>(beam.tip() + MixedField::u);
        result(3) = steady(beam.tip() + MixedField::theta);
        const auto modes = mixed_modes(beam, setting, steady);
        for (Eigen::Index k = 0; k < 4; ++k) {
            const Complex lambda = entry(modes, k).eigenvalue;
            result(4 + k) = std::abs(lambda) / (2 * pi);
            CHECK(std::abs(lambda.real()) < 1e-5 * std::abs(lambda));  // of the order of the scheme's error
        }
        return result;
    };
    Vector limit(8);
    limit << exact.steady_tip, exact.steady_tip_twist, exact.frequency;
    const Vector n16 = solve(16), n32 = solve(32), extrapolated = n32 + (n32 - n16) / 3;
    for (Eigen::Index k = 0; k < 8; ++k) {
        CAPTURE(k);
        CHECK(order(n16(k), n32(k), limit(k)) == Approx(2).margin(0.15));
        CHECK(extrapolated(k) == Approx(limit(k)).epsilon(1e-3));
    }
}
