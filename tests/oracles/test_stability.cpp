// Oracles of large deflections and of stability.
#include "tests/oracles/beck_column.hpp"
#include "tests/oracles/elastica.hpp"
#include "tests/oracles/euler_bernoulli.hpp"
#include "tests/oracles/lateral_buckling.hpp"
#include "tests/support/catch.hpp"

#include <Eigen/Geometry>

#include <numbers>
#include <tuple>
#include <vector>

using namespace cardan::oracles;
using Eigen::Vector2d;

TEST_CASE("elastica: elliptic integrals and shooting give the same tip under a dead transverse force", "[oracles]") {
    for (const double P : {0.1, 1.0, 3.0, 5.0, 10.0}) {
        CAPTURE(P);
        const auto exact = elastica::under_transverse_force(P), shot = elastica::under_dead_force({0, P});
        CHECK(shot.x == Approx(exact.x).margin(1e-11).epsilon(0));
        CHECK(shot.y == Approx(exact.y).margin(1e-11).epsilon(0));
        CHECK(shot.theta == Approx(exact.theta).margin(1e-11).epsilon(0));
    }
}

TEST_CASE("elastica: published tip displacements under a dead transverse force", "[oracles][published]") {
    // Mattiasson, Int. J. Numer. Meth. Eng. 17, 1981, 145-153, table 1: (1 - x, y, theta), five decimals.
    for (const auto& [P, u, w, theta] : std::vector<std::tuple<double, double, double, double>>{
             {1, 0.05643, 0.30172, 0.46135}, {5, 0.38763, 0.71379, 1.21537}, {10, 0.55500, 0.81061, 1.43029}}) {
        const auto tip = elastica::under_transverse_force(P);
        CHECK(1 - tip.x == Approx(u).margin(5.1e-6).epsilon(0));
        CHECK(tip.y == Approx(w).margin(5.1e-6).epsilon(0));
        CHECK(tip.theta == Approx(theta).margin(5.1e-6).epsilon(0));
    }
}

TEST_CASE("elastica: limits of small forces, and the first integral of the curve", "[oracles]") {
    // P / 3 and P / 2; a follower force differs in second order only.
    for (const auto& tip : {elastica::under_transverse_force(1e-4), elastica::under_follower_force({0, 1e-4})}) {
        CHECK(tip.y == Approx(1e-4 / 3).epsilon(1e-7));
        CHECK(tip.theta == Approx(1e-4 / 2).epsilon(1e-7));
    }
    // M^2 / 2 + F . t is constant along the curve; M(0) = x F_y - y F_x.
    for (const Vector2d& F : {Vector2d(0, 4), Vector2d(-1, 3), Vector2d(2, 5)}) {
        const auto tip = elastica::under_dead_force(F);
        const double M0 = tip.x * F.y() - tip.y * F.x();
        const double at_tip = F.x() * std::cos(tip.theta) + F.y() * std::sin(tip.theta);
        CHECK(M0 * M0 / 2 + F.x() == Approx(at_tip).epsilon(1e-10));
    }
    for (const double f : {1.0, 5.0, 20.0}) {
        const auto tip = elastica::under_follower_force({0, f});
        const Vector2d F(-f * std::sin(tip.theta), f * std::cos(tip.theta));
        const double M0 = tip.x * F.y() - tip.y * F.x();
        CHECK(M0 * M0 / 2 + F.x() == Approx(0).margin(1e-9));  // the force is normal to the tip
    }
    const auto arc = elastica::under_moment(std::numbers::pi);
    CHECK(arc.x == Approx(0).margin(1e-15));
    CHECK(arc.y == Approx(2 / std::numbers::pi).epsilon(1e-15));
}

TEST_CASE("lateral buckling: zero of the Bessel function, published 4.0126, limit of the bent beam",
          "[oracles][published]") {
    // Timoshenko and Gere 1961, eq. 6-24: 4.013; Bazant and Cedolin 1991, section 6.3: 4.0126.
    const double stiff = lateral_buckling::tip_force();
    CHECK(stiff == Approx(4.0126).margin(5.1e-5).epsilon(0));
    // The deflection raises the force by a term of first order in EI_z / EI_y.
    const double rise4 = lateral_buckling::tip_force_with_deflection(1e4, 1) - stiff;
    const double rise5 = lateral_buckling::tip_force_with_deflection(1e5, 1) - stiff;
    CHECK(rise4 > 0);
    CHECK(rise4 / rise5 == Approx(10).epsilon(1e-3));
    CHECK(lateral_buckling::tip_force_with_deflection(1e6, 4) == Approx(2 * stiff).epsilon(1e-5));
}

TEST_CASE("Beck's column: published flutter load, beam frequencies without load, both forms of the equation",
          "[oracles][published]") {
    const auto flutter = beck_column::flutter();
    CHECK(flutter.force == Approx(20.05).margin(5.1e-3).epsilon(0));   // Beck 1952, Bolotin 1963
    CHECK(flutter.omega == Approx(11.016).margin(5.1e-4).epsilon(0));  // Bolotin 1963
    CHECK(beck_column::flutter_with_vanishing_damping().force == Approx(10.94).margin(5.1e-3).epsilon(0));
    const auto free = beck_column::frequencies(0);
    CHECK(free.first == Approx(3.516015268532).epsilon(1e-10));
    CHECK(free.second == Approx(22.03449156467).epsilon(1e-10));
    for (const double force : {0.0, 5.0, 15.0, 20.0}) {
        CAPTURE(force);
        const auto omega = beck_column::frequencies(force);
        for (const double w : {omega.first, omega.second}) {
            const double scale = std::abs(beck_column::boundary_determinant(force, 0.5));
            CHECK(beck_column::boundary_determinant(force, w) / scale == Approx(0).margin(1e-7));
        }
    }
}
