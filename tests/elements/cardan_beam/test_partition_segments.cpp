// Partitions of mass: each body of its own, the momentum of the static shapes, and where the static moments fail.
#include "mbs/base/decompositions.hpp"
#include "solvers/campbell/diagram.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/oracles/quadrature.hpp"
#include "tests/support/catch.hpp"
#include "turbines/reference_turbines/wt600.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// A smooth taper with shear; bending about y and z alike.
BeamLine tapered() {
    return {2.0,
            {},
            [](double x) {
                EngineeringSection s = slender(5 * std::pow(1 - 0.2 * x, 3), 3 * (1 - 0.2 * x));
                s.GA_y = s.GA_z = 40 * (1 - 0.2 * x);
                return s.section();
            },
            "tapered"};
}

// Second flap frequency of the isolated 600 kW blade at rest, Hz: the lowest three are flap 1, flap 2 or lag 1, ...
double second_flap(int elements, double delta, Partition partition, std::size_t* warnings = nullptr) {
    turbines::AssemblyOptions options = turbines::wt600_paper_assembly(elements);
    options.delta = delta;
    options.partition = partition;
    const turbines::Turbine blade = turbines::isolated_blade(turbines::wt600_description(), options);
    if (warnings) *warnings = blade.warnings().size();
    const double at_rest[] = {0};
    const auto diagram = solvers::campbell(blade.system(), blade.rotor(), at_rest);
    return diagram.natural_hz(diagram.branch("2nd blade flap"), 0);
}

}  // namespace

TEST_CASE("segment masses: every body is its own piece of a uniform beam", "[analytic]") {
    // A slender rod of mass m and length l has m l^2 / 12 about its centre, none about its axis.
    const double L = 1.5, mu = 2;
    for (double delta : {0.1, delta_gauss, 0.4}) {
        const ElementInertia e =
            partition_element(uniform_beam(L, slender(1, mu)), 0, L, delta, Partition::segment_masses);
        const double ends[] = {0, delta * L, L / 2, (1 - delta) * L, L};
        for (std::size_t k = 0; k < 4; ++k) {
            const double l = ends[k + 1] - ends[k];
            CHECK(e.body[k].mass == Approx(mu * l).epsilon(1e-13));
            CHECK(e.body[k].com(0) == Approx((ends[k] + ends[k + 1]) / 2).epsilon(1e-13));
            CHECK(e.body[k].J(1, 1) == Approx(mu * l * l * l / 12).epsilon(1e-11));
            CHECK(e.body[k].J(2, 2) == Approx(mu * l * l * l / 12).epsilon(1e-11));
            CHECK(std::abs(e.body[k].J(0, 0)) < 1e-15);
        }
    }
}

TEST_CASE("partitions: the sectional inertia of the left half goes to the first body, of the right half to the last",
          "[analytic]") {
    EngineeringSection s = slender(1, 2);
    BeamLine line{1.5, {}, [s](double x) {
                      EngineeringSection own = s;
                      own.j_flap = 0.2 + 0.1 * x;
                      own.j_edge = 0.5;
                      return own.section();
                  }};
    const double left_flap = 0.2 * 0.75 + 0.05 * 0.75 * 0.75, right_flap = 0.2 * 0.75 + 0.05 * (2.25 - 0.75 * 0.75);
    for (const Partition partition : {Partition::segment_masses, Partition::static_moment}) {
        const ElementInertia with = partition_element(line, 0, 1.5, 1. / 6, partition);
        const ElementInertia without = partition_element(uniform_beam(1.5, s), 0, 1.5, 1. / 6, partition);
        const auto added = [&](std::size_t k) { return Mat3(with.body[k].J - without.body[k].J); };
        CHECK((added(0) - Mat3(Vec3(left_flap + 0.375, left_flap, 0.375).asDiagonal())).norm() < 1e-12);
        CHECK((added(3) - Mat3(Vec3(right_flap + 0.375, right_flap, 0.375).asDiagonal())).norm() < 1e-12);
        CHECK(added(1).norm() + added(2).norm() < 1e-12);
        CHECK(with.polar_inertia == Approx(left_flap + right_flap + 0.75).epsilon(1e-12));
    }
}

TEST_CASE("static moments: the chain has the linear momentum of the static shape of either hinge", "[analytic]") {
    // The deflection of the beam when hinge j turns by one and the other not, integrated twice by Simpson's rule on a
    // fine grid from the moments that do it; its int mu w dx against sum m v of the four bodies.
    const BeamLine line = tapered();
    const double L = 2, delta = 1. / 6, x1 = delta * L, x2 = L - x1, d = x2 - x1;
    const oracles::PiecewiseGaussGrid grid(Eigen::Vector2d(0, L), 40);
    const Eigen::VectorXd x = grid.points();
    const auto at_points = [&](auto f) { return Eigen::VectorXd(x.unaryExpr(f)); };
    const Eigen::VectorXd bending = at_points([&](double s) { return line.section(s).compliance(5, 5); }),
                          shear = at_points([&](double s) { return line.section(s).compliance(1, 1); }),
                          mu = at_points([&](double s) { return line.section(s).mass; });
    Eigen::Matrix2d flexibility;  // hinge angles by hinge moments
    Eigen::Vector2d momentum;     // of the shapes by hinge moments
    Eigen::VectorXd moment[2], force[2];
    for (int j : {0, 1}) {
        moment[j] = at_points([&](double s) { return j == 0 ? (x2 - s) / d : (s - x1) / d; });
        force[j] = Eigen::VectorXd::Constant(x.size(), j == 0 ? 1 / d : -1 / d);
    }
    for (int i : {0, 1}) {
        for (int j : {0, 1})
            flexibility(i, j) =
                grid.weights().dot(Eigen::VectorXd((moment[i].array() * moment[j].array() * bending.array()) +
                                                   force[i].array() * force[j].array() * shear.array()));
        const Eigen::VectorXd slope = grid.running_integral() * Eigen::VectorXd(moment[i].array() * bending.array());
        const Eigen::VectorXd strain = force[i].array() * shear.array();
        const Eigen::VectorXd w = grid.running_integral() * (slope + strain);
        momentum(i) = grid.weights().dot(Eigen::VectorXd(mu.array() * w.array()));
    }
    const Eigen::Vector2d exact = flexibility.inverse() * momentum;
    const ElementInertia e = partition_element(line, 0, L, delta, Partition::static_moment);
    Eigen::Vector2d chain = Eigen::Vector2d::Zero();
    for (std::size_t k = 1; k < 4; ++k) chain(0) += e.body[k].mass * (e.body[k].com(0) - x1);
    chain(1) = e.body[3].mass * (e.body[3].com(0) - x2);
    CHECK(chain(0) == Approx(exact(0)).epsilon(1e-9));
    CHECK(chain(1) == Approx(exact(1)).epsilon(1e-9));
}

TEST_CASE("static moments: a segment without mass is refused", "[property]") {
    BeamLine line{1, {0.9}, [](double x) { return slender(1, x < 0.9 ? 1 : 0).section(); }, "half a beam"};
    line.section = [](double x) { return slender(1, x < 0.8 ? 1 : 0).section(); };
    line.breaks = {0.8};
    CHECK_THROWS_WITH(partition_element(line, 0, 1, 1. / 6, Partition::static_moment),
                      Catch::Contains("half a beam") && Catch::Contains("mass of segment 4 [kg] = 0"));
    CHECK_NOTHROW(partition_element(line, 0, 1, 1. / 6, Partition::segment_masses));
}

TEST_CASE("600 kW blade: static moments are far off with few elements and say so, segment masses are not",
          "[discrete]") {
    // EI falls 3000 to 1 from root to tip. Numbers of an independent implementation of both partitions; 5.539 Hz exact.
    for (const auto& [elements, moments, segments] :
         {std::tuple{2, 2.708, 5.318}, {3, 4.486, 5.233}, {4, 5.261, 5.404}, {6, 5.498, 5.512}}) {
        std::size_t warnings = 0;
        CHECK(second_flap(elements, 1. / 6, Partition::static_moment, &warnings) ==
              Approx(moments).margin(1e-3).epsilon(0));
        CHECK(warnings > 0);
        CHECK(second_flap(elements, delta_gauss, Partition::segment_masses, &warnings) ==
              Approx(segments).margin(1e-3).epsilon(0));
        CHECK(warnings == 0);
    }
}
