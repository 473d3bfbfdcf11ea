#include "tests/oracles/cosserat_rod.hpp"
#include "tests/oracles/root_finding.hpp"
#include "tests/support/catch.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace cardan::oracles;
using Eigen::Vector3d;

namespace {

using std::numbers::pi;
constexpr double rigid = std::numeric_limits<double>::infinity();

RodVector6 stiffness(double EA, double GA, double GJ, double EI_y, double EI_z) {
    RodVector6 K;
    K << EA, GA, GA, GJ, EI_y, EI_z;
    return K;
}

CosseratRod elastica() {
    CosseratRod rod;
    rod.strain = linear_strain(stiffness(rigid, rigid, 1, 1, 1));
    return rod;
}

// The 45-degree bend: an eighth of a circle of radius 100 that starts along x and turns to +y.
CosseratRod bend(double GA) {
    CosseratRod rod;
    rod.length = 100 * pi / 4;
    rod.initial_curvature = [](double) { return Vector3d(0, 0, 0.01); };
    rod.strain = linear_strain(stiffness(1e7, GA, 5e6 / 6, 1e7 / 12, 1e7 / 12));
    return rod;
}

RodLoad tip_force(const Vector3d& force) {
    RodLoad load;
    load.force = force;
    return load;
}

// Curved, twisted, everything coupled.
CosseratRod general_rod() {
    CosseratRod rod;
    rod.length = 1.3;
    rod.initial_curvature = [](double s) { return Vector3d(0.4 + s, 0.3 * std::cos(s), -0.5); };
    RodMatrix6 A;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) A(i, j) = std::sin(3.0 * i + 1.7 * j * j + 0.3);
    RodMatrix6 C = 0.02 * A * A.transpose() + 0.2 * RodMatrix6::Identity();
    C.topRows<3>() *= 0.2, C.leftCols<3>() *= 0.2;
    rod.strain = linear_strain(C);
    return rod;
}

// Rotation of the free end of an elastica under its own weight q across its clamped end, EI = L = 1, from the free
// end: theta'' = -q t cos theta, t counted from the free end, as a power series.   [Rohde, Q. Appl. Math. 11 (1953)]
double self_weight_rotation(double q) {
    constexpr std::size_t terms = 60;
    const auto at_clamp = [q](double alpha) {
        std::vector<double> a(terms), c(terms), s(terms);  // theta, cos theta, sin theta
        a[0] = alpha, c[0] = std::cos(alpha), s[0] = std::sin(alpha);
        for (std::size_t n = 1; n < terms; ++n) {
            if (n >= 3) a[n] = -q * c[n - 3] / static_cast<double>(n * (n - 1));
            for (std::size_t k = 1; k <= n; ++k) {
                c[n] -= static_cast<double>(k) * a[k] * s[n - k] / static_cast<double>(n);
                s[n] += static_cast<double>(k) * a[k] * c[n - k] / static_cast<double>(n);
            }
        }
        double theta = 0;
        for (double term : a) theta += term;
        return theta;
    };
    return bisect(at_clamp, 0.0, 1.5);
}

}  // namespace

TEST_CASE("cosserat rod: a tip force P L^2 / EI = 5 bends it like the elastica", "[oracles][analytic]") {
    // Elliptic integrals: Bisshopp and Drucker, Q. Appl. Math. 3 (1945) 272-275; digits by a separate computation.
    for (const bool vertical : {false, true}) {
        const RodSolution rod(elastica(), tip_force(vertical ? Vector3d(0, 0, 5) : Vector3d(0, 5, 0)));
        const RodState tip = rod.tip();
        CHECK(1 - tip.position.x() == Approx(0.387628361).margin(1e-9));
        CHECK(tip.position(vertical ? 2 : 1) == Approx(0.713791524).margin(1e-9));
        CHECK(std::acos(tip.rotation(0, 0)) == Approx(1.215368118).margin(1e-9));
        CHECK(rod.residual() < 1e-12);
    }
}

TEST_CASE("cosserat rod: a tip moment 2 pi EI / L closes the circle", "[oracles][analytic]") {
    for (const bool follower : {false, true}) {
        RodLoad load;
        load.moment = Vector3d(0, 0, 2 * pi);
        load.follower = follower;
        const RodSolution rod(elastica(), load);
        CHECK(rod.tip().position.norm() < 1e-10);
        CHECK((rod.tip().rotation - Eigen::Matrix3d::Identity()).norm() < 1e-10);
        for (double s : {0.2, 0.77})
            CHECK((rod.at(s).position - Vector3d(std::sin(2 * pi * s), 1 - std::cos(2 * pi * s), 0) / (2 * pi)).norm() <
                  1e-10);
    }
}

TEST_CASE("cosserat rod: the 45-degree bend has the known tip positions", "[oracles][analytic]") {
    // The problem of Bathe and Bolourchi, Int. J. Numer. Meth. Eng. 14 (1979) 961-986; digits by a separate
    // computation. Shear factor 5/6.
    const auto tip = [](double GA, double force) {
        return RodSolution(bend(GA), tip_force({0, 0, force})).tip().position;
    };
    const double GA = 5. / 6 * 5e6;
    CHECK((tip(GA, 300) - Vector3d(58.77890, 22.24468, 40.19239)).cwiseAbs().maxCoeff() < 1e-5);
    CHECK((tip(GA, 600) - Vector3d(47.15010, 15.68469, 53.47548)).cwiseAbs().maxCoeff() < 1e-5);
    CHECK((tip(rigid, 600) - Vector3d(47.15215, 15.68536, 53.47176)).cwiseAbs().maxCoeff() < 1e-5);
}

TEST_CASE("cosserat rod: unloaded, constant curvature and torsion make a helix", "[oracles][analytic]") {
    CosseratRod rod = elastica();
    rod.length = 3;
    const double k = 1.1, t = 0.7, w = std::hypot(k, t);
    rod.initial_curvature = [=](double) { return Vector3d(t, 0, k); };
    const RodSolution free(rod, {});
    for (double s : {0.4, 1.9, 3.0}) {
        // Turn by w s about the fixed axis (t, 0, k) / w: Rodrigues.
        const Eigen::AngleAxisd turn(w * s, Vector3d(t, 0, k) / w);
        const Vector3d axis(t / w, 0, k / w), across = Vector3d::UnitX() - axis * (t / w);
        const Vector3d x =
            axis * (t / w) * s + across * std::sin(w * s) / w + axis.cross(across) * (1 - std::cos(w * s)) / w;
        CHECK((free.at(s).position - x).norm() < 1e-10);
        CHECK((free.at(s).rotation - turn.toRotationMatrix()).norm() < 1e-10);
    }
}

TEST_CASE("cosserat rod: under its own weight it is Rohde's series", "[oracles][analytic]") {
    for (double q : {1.0, 5.0}) {
        RodLoad load;
        load.distributed = Vector3d(0, q, 0);
        const RodSolution rod(elastica(), load);
        CHECK(std::acos(rod.tip().rotation(0, 0)) == Approx(self_weight_rotation(q)).margin(1e-9));
        CHECK(rod.at(0).forces(1) == Approx(q).margin(1e-12));
    }
}

TEST_CASE("cosserat rod: the section forces balance the load at every place", "[oracles][property]") {
    RodLoad load;
    load.force = Vector3d(0.3, -0.5, 0.7), load.moment = Vector3d(-0.2, 0.4, 0.1);
    for (const bool follower : {false, true}) {
        load.follower = follower;
        const RodSolution rod(general_rod(), load);
        const RodState tip = rod.tip();
        const Eigen::Matrix3d turn = follower ? tip.rotation : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
        const Vector3d F = turn * load.force, M = turn * load.moment;
        for (double s : {0.0, 0.31, 0.9}) {
            const RodState at = rod.at(s);
            CHECK((at.rotation * at.forces.head<3>() - F).norm() < 1e-10);
            CHECK((at.rotation * at.forces.tail<3>() - M - (tip.position - at.position).cross(F)).norm() < 1e-10);
        }
    }
}

TEST_CASE("cosserat rod: small loads obey Castigliano, and the work of a dead load does not depend on its path",
          "[oracles][property]") {
    // Displacements are the gradient of the complementary energy: the tip compliance is symmetric at zero load and,
    // for forces, at any load.
    const auto moved = [](const Vector3d& force) {
        return RodSolution(general_rod(), tip_force(force)).tip().position;
    };
    for (const Vector3d& at : {Vector3d(0, 0, 0), Vector3d(0.9, -0.6, 0.8)}) {
        Eigen::Matrix3d C;
        constexpr double h = 1e-4;
        for (Eigen::Index i = 0; i < 3; ++i) {
            const Vector3d step = h * Vector3d::Unit(i);
            C.col(i) = (moved(at + step) - moved(at - step)) / (2 * h);
        }
        CHECK((C - C.transpose()).norm() < 1e-7 * C.norm());
    }
}

TEST_CASE("cosserat rod: the error of the integrator falls with order 5", "[oracles][analytic]") {
    const auto error = [](int steps) {
        CosseratRod rod = general_rod();
        rod.steps = 512;
        const Vector3d reference = RodSolution(rod, tip_force({0.9, -0.6, 0.8})).tip().position;
        rod.steps = steps;
        return (RodSolution(rod, tip_force({0.9, -0.6, 0.8})).tip().position - reference).norm();
    };
    const double order = std::log2(error(8) / error(16));
    CAPTURE(order);
    CHECK(order > 4.5);
    CHECK(order < 6.5);
}

TEST_CASE("vibrating arc: nearly straight it has the frequencies of a cantilever", "[oracles][analytic]") {
    VibratingArc arc{.radius = 1e4, .angle = 1e-4, .mass = 1, .EA = 1e4, .GJ = 0.7, .EI_y = 1, .EI_z = 1.5};
    arc.J_y = 2e-7, arc.J_z = 3e-7;
    const std::vector<double> omega = arc.frequencies(4);
    CHECK(omega[0] == Approx(3.5160152685).epsilon(1e-6));
    CHECK(omega[1] == Approx(3.5160152685 * std::sqrt(1.5)).epsilon(1e-6));
    CHECK(omega[2] == Approx(22.0344915647).epsilon(1e-5));
    CHECK(omega[3] == Approx(22.0344915647 * std::sqrt(1.5)).epsilon(1e-5));
    // Torsion (2 n - 1) pi / 2 sqrt(GJ / J_x), here below bending; extension likewise with EA / mass.
    arc = {.radius = 1e4,
           .angle = 1e-4,
           .mass = 1,
           .EA = 0.5,
           .GJ = 0.02,
           .EI_y = 1,
           .EI_z = 1.5,
           .J_y = 0.02,
           .J_z = 0.03};
    const std::vector<double> low = arc.frequencies(2);
    CHECK(low[0] == Approx(pi / 2 * std::sqrt(0.02 / 0.05)).epsilon(1e-6));
    CHECK(low[1] == Approx(pi / 2 * std::sqrt(0.5)).epsilon(1e-6));
}

TEST_CASE("vibrating arc: the quotient of the deflection under a uniform load bounds its lowest frequency closely",
          "[oracles][crosscheck]") {
    // Rayleigh's quotient; without rotary inertia.
    const VibratingArc arc{.radius = 1, .angle = pi / 2, .mass = 1, .EA = 1e4, .GJ = 0.7, .EI_y = 1, .EI_z = 1.5};
    CosseratRod rod;
    rod.length = pi / 2;
    rod.initial_curvature = [](double) { return Vector3d(0, 0, 1); };
    RodVector6 K;
    K << 1e4, rigid, rigid, 0.7, 1, 1.5;
    rod.strain = linear_strain(K);
    RodLoad load;
    load.distributed = Vector3d(0, 0, 1e-4);
    const RodSolution bent(rod, load), rest(rod, {});
    double work = 0, square = 0;
    constexpr int n = 2000;
    for (int i = 0; i < n; ++i) {
        const double s = rod.length * (i + 0.5) / n;
        const double w = (bent.at(s).position - rest.at(s).position).z();
        work += 1e-4 * w, square += w * w;
    }
    const double bound = std::sqrt(work / square), lowest = arc.frequencies(1)[0];
    CAPTURE(bound, lowest);
    CHECK(lowest < bound);
    CHECK(lowest > 0.99 * bound);
}
