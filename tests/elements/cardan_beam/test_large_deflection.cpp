// Large deflections of a cantilever of cardanic elements, L = 1, EI = 1, by load stepping. "Discrete" values were
// computed by an independent implementation of the same formulas (docs/verification.md), exact ones are elastica.
#include "mbs/kernels/kinematics.hpp"
#include "solvers/equilibrium/equilibrium_path.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/oracles/elastica.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <tuple>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;
namespace elastica = cardan::oracles::elastica;

namespace {

// Place of the tip and direction of its section.
Pose<double> bent_tip(const Wrench& load, WrenchAxes axes, const CardanBeamOptions& options, int steps = 10) {
    Tree tree;
    ForceSet forces;
    const CardanBeam beam =
        add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, slender(1, 1)), "beam", {"beam"}, options);
    forces.add_wrench({"load", beam.tip(), load, axes});
    const System system(tree, forces);
    EquilibriumPathOptions path_options;
    path_options.steps = steps;
    const EquilibriumPath path = equilibrium_path(system, path_options);
    INFO(path.message);
    REQUIRE(path.converged);
    if (axes == WrenchAxes::base) CHECK(path.points.back().negative_pivots == 0);
    Workspace workspace(system.model);
    return pose(kinematics(system.model, path.points.back().at.q, workspace), beam.tip());
}

// Angle from x toward z.
double slope(const Pose<double>& tip) {
    return std::atan2(tip.R(2, 0), tip.R(0, 0));
}

}  // namespace

TEST_CASE("cantilever bent to a half circle by a tip moment: discrete values and orders", "[analytic][discrete]") {
    const auto height = [](int elements, double delta) {
        const Pose<double> tip = bent_tip({Vec3::Zero(), {0, -pi, 0}}, WrenchAxes::base, bending_only(elements, delta));
        CHECK(tip.p.y() == Approx(0).margin(1e-12));
        return tip.p.z();
    };
    for (const auto& [elements, s, g] : std::vector<std::tuple<int, double, double>>{{1, .666667, .577350},
                                                                                     {2, .638071, .619573},
                                                                                     {3, .636895, .628917},
                                                                                     {4, .636705, .632264},
                                                                                     {8, .636625, .635525}}) {
        CAPTURE(elements);
        CHECK(height(elements, sixth) == Approx(s).margin(1e-6).epsilon(0));
        CHECK(height(elements, delta_gauss) == Approx(g).margin(1e-6).epsilon(0));
    }
    const double exact = elastica::under_moment(pi).y;
    CHECK(order(height(8, sixth), height(16, sixth), exact) == Approx(4).margin(0.05));
    CHECK(order(height(8, delta_gauss), height(16, delta_gauss), exact) == Approx(2).margin(0.05));
}

TEST_CASE("cantilever under a dead transverse tip force: discrete values, fourth and second order",
          "[analytic][discrete]") {
    const auto tip = [](double P, int elements, double delta) {
        return bent_tip({{0, 0, P}, Vec3::Zero()}, WrenchAxes::base, bending_only(elements, delta));
    };
    for (const auto& [elements, w] :
         std::vector<std::pair<int, double>>{{1, .705958}, {2, .714680}, {3, .714091}, {4, .713899}, {8, .713799}})
        CHECK(tip(5, elements, sixth).p.z() == Approx(w).margin(1e-6).epsilon(0));
    for (const auto& [P, u, w, theta] :
         std::vector<std::tuple<double, double, double, double>>{{1, .056433236, .301720774, .461351950},
                                                                 {5, .387628361, .713791524, 1.215368118},
                                                                 {10, .554995598, .810609025, 1.430285539}}) {
        CAPTURE(P);
        const auto exact = elastica::under_transverse_force(P);
        CHECK(1 - exact.x == Approx(u).margin(1e-9).epsilon(0));
        CHECK(exact.y == Approx(w).margin(1e-9).epsilon(0));
        CHECK(exact.theta == Approx(theta).margin(1e-9).epsilon(0));
        for (const auto& [delta, expected] : {std::pair(sixth, 4.0), std::pair(delta_gauss, 2.0)}) {
            CAPTURE(delta);
            const auto coarse = tip(P, 16, delta), fine = tip(P, 32, delta);
            const auto error = [&](const Vec3& p) { return std::hypot(p.x() - exact.x, p.z() - exact.y); };
            CHECK(std::log2(error(coarse.p) / error(fine.p)) == Approx(expected).margin(0.1));
            CHECK(order(slope(coarse), slope(fine), exact.theta) == Approx(expected).margin(0.1));
        }
        const auto fine = tip(P, 32, sixth);
        CHECK(fine.p.z() == Approx(exact.y).margin(1e-7).epsilon(0));
        CHECK(slope(fine) == Approx(exact.theta).margin(1e-7).epsilon(0));
    }
}

TEST_CASE("cantilever under a dead tip force: the two planes of bending are alike, and mirror images too",
          "[property]") {
    for (const double delta : {sixth, delta_gauss}) {
        const auto tip = [&](const Vec3& force) {
            return bent_tip({force, Vec3::Zero()}, WrenchAxes::base, bending_only(3, delta)).p;
        };
        const Vec3 z = tip({0, 0, 5}), y = tip({0, 5, 0}), minus_z = tip({0, 0, -5}), both = tip({0, 3, 4});
        CHECK((y - Vec3(z.x(), z.z(), 0)).norm() < 1e-10);
        CHECK((minus_z - Vec3(z.x(), 0, -z.z())).norm() < 1e-10);
        CHECK((tip({0, 3, -4}) - Vec3(both.x(), both.y(), -both.z())).norm() < 1e-10);
    }
}

TEST_CASE(
    "cantilever under a diagonal tip force: second order for every delta, as a cardan joint of finite angle is no "
    "ball joint",
    "[analytic]") {
    // R_y(a) R_z(a) turns by sqrt(2) a (1 + O(a^2)) only, and a ~ 1/N.
    const double P = 5, side = P / std::sqrt(2.0);
    const auto exact = elastica::under_transverse_force(P);
    for (const double delta : {sixth, delta_gauss}) {
        CAPTURE(delta);
        const auto tip = [&](int elements) {
            return bent_tip({{0, side, side}, Vec3::Zero()}, WrenchAxes::base, bending_only(elements, delta)).p;
        };
        const Vec3 coarse = tip(16), fine = tip(32);
        const auto along = [](const Vec3& p) { return (p.y() + p.z()) / std::sqrt(2.0); };
        CHECK(order(coarse.x(), fine.x(), exact.x) == Approx(2).margin(0.05));
        CHECK(order(along(coarse), along(fine), exact.y) == Approx(2).margin(0.05));
        CHECK(along(fine) == Approx(exact.y).margin(7e-5).epsilon(0));
        // Out of the plane of the load it is of fourth order.
        CHECK(order(coarse.y() - coarse.z(), fine.y() - fine.z(), 0) == Approx(4).margin(0.1));
    }
}

TEST_CASE("cantilever under a follower tip force, transverse and inclined: fourth and second order", "[analytic]") {
    for (const Eigen::Vector2d& f : {Eigen::Vector2d(0, 2), Eigen::Vector2d(0, 10), Eigen::Vector2d(0, 20),
                                     Eigen::Vector2d(-2, 4), Eigen::Vector2d(5, 5)}) {
        CAPTURE(f.transpose());
        const auto exact = elastica::under_follower_force(f);
        for (const double delta : {sixth, delta_gauss}) {
            const double expected = delta == sixth ? 4 : 2;
            CAPTURE(delta);
            const auto error = [&](int elements) {
                const Vec3 tip =
                    bent_tip({{f.x(), 0, f.y()}, Vec3::Zero()}, WrenchAxes::frame, bending_only(elements, delta)).p;
                return std::hypot(tip.x() - exact.x, tip.z() - exact.y);
            };
            const double fine = error(32);
            CHECK(std::log2(error(16) / fine) == Approx(expected).margin(0.1));
            CHECK(fine < (delta == sixth ? 5e-7 : 4e-4));
        }
    }
}

TEST_CASE("large deflections do not depend on the number of load steps", "[property]") {
    for (const WrenchAxes axes : {WrenchAxes::base, WrenchAxes::frame}) {
        const auto tip = [&](int steps) {
            return bent_tip({{0, 2, 4}, {0, 0, 1}}, axes, bending_only(4, sixth), steps).p;
        };
        const Vec3 one = tip(1);
        for (const int steps : {3, 10, 40}) CHECK((tip(steps) - one).norm() < 1e-9);
    }
}
