#include "tests/oracles/euler_bernoulli.hpp"
#include "tests/oracles/planar_rod.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace cardan::oracles;

namespace {

using std::numbers::pi;
using Hub = PlanarRodMotion::Hub;

// Slope of a shape of the beam, differenced.
template <class Shape>
auto slope(Shape shape, double length, double amplitude) {
    return [=](double s) {
        const double h = 1e-6, x = s / length, a = std::max(0.0, x - h), b = std::min(1.0, x + h);
        return amplitude * (shape(b) - shape(a)) / ((b - a) * length);
    };
}

}  // namespace

TEST_CASE("planar rod: small vibrations have the frequencies of Euler and Bernoulli's beam", "[oracles][analytic]") {
    const PlanarRod rod{.length = 2, .mass = 3, .EI = 40, .degree = 8};
    const double unit = std::sqrt(rod.EI / (rod.mass * std::pow(rod.length, 4)));
    for (int mode : {1, 2}) {
        PlanarRodMotion clamped(rod, [](double) { return Hub{0, 0, 0}; });
        clamped.bend(slope([=](double x) { return euler_bernoulli::cantilever_shape(mode, x); }, rod.length, 1e-5));
        const double turned = clamped.angle(rod.length), tip = clamped.position(rod.length).y();
        const double omega = euler_bernoulli::cantilever_frequency(mode) * unit;
        for (double phase : {pi / 2, 3.0}) {
            clamped.advance(phase / omega, 1500);
            const double allowed = mode == 1 ? 1e-6 : 2e-4;  // what the polynomials miss of the shape
            CHECK(std::abs(clamped.angle(rod.length) - turned * std::cos(phase)) < allowed * std::abs(turned));
            CHECK(std::abs(clamped.position(rod.length).y() - tip * std::cos(phase)) < allowed * std::abs(tip));
        }
    }
    PlanarRodMotion free(rod, {0, 0}, 0, {});
    free.bend(slope([](double x) { return euler_bernoulli::free_free_shape(1, x); }, rod.length, 1e-5));
    const double turned = free.angle(0), omega = euler_bernoulli::free_free_frequency(1) * unit;
    free.advance(2.5 / omega, 2000);
    CHECK(std::abs(free.angle(0) - turned * std::cos(2.5)) < 2e-4 * std::abs(turned));
    CHECK(free.momentum().norm() < 1e-12);
}

TEST_CASE("planar rod: with one coordinate it vibrates on the spinning hub as computed by hand",
          "[oracles][analytic]") {
    // theta = psi + a s / L: y = a s^2 / 2 L, x = s - a^2 s^3 / 6 L^2, so that
    // omega^2 = (EI / L + m Omega^2 L^3 / 60) / (m L^3 / 20).
    const double Omega = 7;
    const PlanarRod rod{.length = 2, .mass = 3, .EI = 40, .degree = 1};
    PlanarRodMotion motion(rod, [=](double t) { return Hub{Omega * t, Omega, 0}; });
    motion.bend([](double s) { return 1e-5 * s / 2; });
    const double omega = std::sqrt(20 * rod.EI / (rod.mass * 16) + Omega * Omega / 3);
    motion.advance(2.5 / omega, 500);
    CHECK(std::abs(motion.angle(rod.length) - Omega * motion.time() - 1e-5 * std::cos(2.5)) < 1e-10);
}

TEST_CASE("planar rod: spun up slowly it stretches as u = sin(k s) / (k cos(k L)) - s", "[oracles][analytic]") {
    // EA u'' + m Omega^2 (s + u) = 0, k = Omega sqrt(m / EA); here u(L) = 0.034.
    const PlanarRod rod{.length = 2, .mass = 3, .EA = 2000, .EI = 400, .degree = 4, .stretch_degree = 6};
    const double Omega = 2, T = 40;
    PlanarRodMotion motion(rod, [=](double t) {
        const double k = 2 * pi / T;  // smooth, and at rest in the axes of the hub from T on
        if (t >= T) return Hub{Omega * (t - T / 2), Omega, 0};
        return Hub{Omega / T * (t * t / 2 + (std::cos(k * t) - 1) / (k * k)), Omega / T * (t - std::sin(k * t) / k),
                   Omega / T * (1 - std::cos(k * t))};
    });
    motion.advance(T, 12000);
    motion.advance(T + 1, 300);
    const double k = Omega * std::sqrt(rod.mass / rod.EA), kL = k * rod.length;
    CHECK(std::abs(motion.position(rod.length).norm() - std::tan(kL) / k) < 1e-6);
    CHECK(std::abs(motion.stretch(0) - (1 / std::cos(kL) - 1)) < 1e-6);
    CHECK(std::abs(motion.stretch(rod.length)) < 1e-6);
}

TEST_CASE("planar rod: flung by a load it has the momentum of the impulse, then its energy stays, and it converges",
          "[oracles][analytic]") {
    const auto load = [](double t) {
        const double m = t < 1 ? 80 * t : t < 2 ? 80 * (2 - t) : 0;
        return PlanarRodMotion::Load{m / 10, -m / 20, -m};
    };
    std::vector<Eigen::Vector2d> tips;
    for (int degree : {6, 9, 12}) {
        const PlanarRod rod{
            .length = 10, .mass = 1, .rotary_inertia = 10, .EA = 1e4, .EI = 500, .degree = degree, .stretch_degree = 4};
        PlanarRodMotion motion(rod, {6, 0}, 2.2, load);
        const Eigen::Vector2d centre = motion.centre_of_mass();
        motion.advance(1, 500);
        motion.advance(2, 500);
        const double energy = motion.kinetic_energy() + motion.strain_energy(), turn = motion.angular_momentum();
        CHECK((motion.momentum() - Eigen::Vector2d(8, -4)).norm() < 1e-9);
        const Eigen::Vector2d released = motion.centre_of_mass();
        CHECK((released - centre - Eigen::Vector2d(0.8, -0.4)).norm() < 1e-9);  // twice integrated
        motion.advance(5, 1500);
        CHECK(motion.kinetic_energy() + motion.strain_energy() == Approx(energy).epsilon(1e-7));
        CHECK(motion.angular_momentum() == Approx(turn).epsilon(1e-8));
        CHECK((motion.centre_of_mass() - released - Eigen::Vector2d(2.4, -1.2)).norm() < 1e-9);
        tips.push_back(motion.position(10));
    }
    const double first = (tips[1] - tips[0]).norm(), second = (tips[2] - tips[1]).norm();
    CAPTURE(first, second);
    CHECK(second < first / 4);
    CHECK(second < 2e-4);
}
