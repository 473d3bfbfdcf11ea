// How mass is given to the bodies of an element.
#include "elements/cardan_beam.hpp"
#include "elements/quadrature.hpp"
#include "tests/elements/cantilever.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

BeamLine tapered_with_offsets() {
    return {3.0,
            {1.1},
            [](double x) {
                BeamSection s;
                s.mass = x < 1.1 ? 5 - x : 3 - 0.5 * x;
                s.centre = {0, 0.1 * x, -0.05 + 0.02 * x * x};
                s.J = Vec3(0.5, 0.2, 0.3).asDiagonal();
                s.compliance = Mat6::Identity();
                return s;
            },
            "tapered"};
}

}  // namespace

TEST_CASE("segment masses: total mass, first moment and inertia tensor of the continuum are kept", "[analytic]") {
    const BeamLine line = tapered_with_offsets();
    const double x0 = 0.4, L = 2.1;
    const ElementInertia element = partition_element(line, x0, L, 0.23, Partition::segment_masses);
    RigidInertia sum;
    for (const RigidInertia& body : element.body) sum = sum + body;
    const auto integral = [&](auto f) { return integrate(x0, x0 + L, line.breaks, decltype(f(0.0))(f(0.0) * 0), f); };
    const auto at = [&](double x) { return Vec3(x - x0, line.section(x).centre(1), line.section(x).centre(2)); };
    const double M = integral([&](double x) { return line.section(x).mass; });
    const Vec3 S = integral([&](double x) { return Vec3(line.section(x).mass * at(x)); });
    const Mat3 J = integral([&](double x) {
        const Vec3 r = at(x) - S / M;
        return Mat3(line.section(x).J +
                    line.section(x).mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose()));
    });
    CHECK(sum.mass == Approx(M).epsilon(1e-13));
    CHECK(element.mass == Approx(M).epsilon(1e-13));
    CHECK((sum.com - S / M).norm() < 1e-13);
    CHECK((sum.J - J).norm() < 1e-12 * J.norm());
    for (const RigidInertia& body : element.body) CHECK_NOTHROW(body.check("segment"));
    // the sectional inertia stands on the terminal bodies
    CHECK(element.body[0].J(0, 0) > 0.5 * L / 2);
    CHECK(element.body[1].J(0, 0) < 0.05);
}

TEST_CASE("static moments: closed form of the uniform element with delta = 1/6", "[analytic]") {
    const double M = 2, L = 0.9;
    const ElementInertia e =
        partition_element(uniform_beam(L, slender(1, M / L)), 0, L, 1. / 6, Partition::static_moment);
    const std::array<double, 4> mass{1. / 6, 1. / 3, 1. / 3, 1. / 6}, centre{1. / 6, 1. / 3, 2. / 3, 5. / 6},
        J{1. / 120, 1. / 180, 1. / 180, 1. / 120};
    for (std::size_t k = 0; k < 4; ++k) {
        CHECK(e.body[k].mass == Approx(mass[k] * M));
        CHECK(e.body[k].com(0) == Approx(centre[k] * L));
        CHECK(e.body[k].J(1, 1) == Approx(J[k] * M * L * L));
        CHECK(e.body[k].J(2, 2) == Approx(J[k] * M * L * L));
    }
    CHECK(e.warning.empty());
}

TEST_CASE("static moments: total mass and first two moments of a tapered beam are kept", "[analytic]") {
    BeamLine line{1, {}, [](double x) { return slender(1 - 0.6 * x, 2 - x).section(); }, "tapered"};
    const ElementInertia e = partition_element(line, 0, 1, 1. / 6, Partition::static_moment);
    double M = 0, S = 0, I = 0;
    for (const RigidInertia& b : e.body) {
        M += b.mass;
        S += b.mass * b.com(0);
        I += b.mass * b.com(0) * b.com(0) + b.J(1, 1);
    }
    CHECK(M == Approx(1.5));
    CHECK(S == Approx(1 - 1. / 3));
    CHECK(I == Approx(2. / 3 - 1. / 4));
}

TEST_CASE("static moments: a strongly tapered element is warned about, with its place and centres; one more so refused",
          "[property]") {
    const auto thin = [](double taper) {
        return BeamLine{
            1, {}, [taper](double x) { return slender(std::exp(-taper * x), 1 - 0.9 * x).section(); }, "thin tip"};
    };
    // EI falls by 20 within the element: the terminal centre of mass leaves its hinge far behind.
    const ElementInertia e = partition_element(thin(3), 0, 1, 1. / 6, Partition::static_moment);
    CHECK_THAT(e.warning, Catch::Contains("thin tip") && Catch::Contains("0.1 L from the hinges"));
    CHECK(partition_element(thin(3), 0, 1, delta_gauss, Partition::segment_masses).warning.empty());
    // By 1000: nothing is left for the middle bodies.
    check_refused([&] { (void)partition_element(thin(7), 0, 1, 1. / 6, Partition::static_moment); },
                  {"thin tip, element at 0 m: moment of inertia left for the middle bodies [kg m^2] = -0.000291543",
                   "allowed: >= 0", "another partition"});
    for (const Partition p : {Partition::segment_masses, Partition::compliance_gauss, Partition::mean_difference})
        CHECK_NOTHROW(partition_element(thin(7), 0, 1, 1. / 6, p));
}

TEST_CASE("structural damping: the ratio comes out at the given frequency and grows in proportion", "[analytic]") {
    CardanBeamOptions options = bending_only(6);
    options.damping = BeamDamping::ratio_at(0.01, 3.516015 / (2 * pi));
    Tree tree;
    ForceSet forces;
    add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, slender(1, 1)), "beam", {"beam"}, options);
    const System system(tree, forces);
    const Vector zero = Vector::Zero(system.model.size());
    const auto modes = solvers::modes(
        solvers::restrict_to(solvers::linearise(system, {zero, zero, zero, 0}), system.model.coordinates().free()));
    CHECK(modes[0].damping_ratio() == Approx(0.01).epsilon(1e-4));
    CHECK(modes[2].damping_ratio() == Approx(0.01 * modes[2].natural_hz() / modes[0].natural_hz()).epsilon(1e-6));
}

TEST_CASE("cardan order: mirrored joints do not twist a beam that is bent diagonally, equal joints do", "[property]") {
    // The parasitic twist of equal order, (a1 b1 + a2 b2) / 2 per element, is of first order in the element length.
    const auto twist = [](CardanOrder order, int elements) {
        Tree tree;
        ForceSet forces;
        CardanBeamOptions options = bending_only(elements);
        options.order = order;
        const CardanBeam beam =
            add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, slender(1, 1)), "beam", {"beam"}, options);
        // A moment of the same size about y and z: an isotropic beam bends in the diagonal plane, without twist.
        forces.add_wrench({"moment", beam.tip(), {Vec3::Zero(), Vec3(0, 0.4, 0.4)}, WrenchAxes::base});
        const System system(tree, forces);
        const auto steady = solvers::steady_state(system, -1);
        REQUIRE(steady.converged);
        Workspace workspace(system.model);
        const Mat3 R = pose(kinematics(system.model, steady.at.q, workspace), beam.tip()).R;
        // rotation about the diagonal axis only: no component of the rotation vector along x
        return std::abs(R(2, 1) - R(1, 2)) / 2;
    };
    const double mirrored = twist(CardanOrder::mirrored, 4), same = twist(CardanOrder::same, 4);
    CHECK(mirrored < 0.05 * same);
    CHECK(same / twist(CardanOrder::same, 8) == Approx(2).margin(0.2));
}

TEST_CASE(
    "partition: the place of the hinges follows from it unless asked otherwise, and another place is warned about",
    "[property]") {
    const auto made = [](Partition partition, std::optional<double> delta) {
        CardanBeamOptions options = bending_only(2);
        options.partition = partition;
        options.delta = delta;
        Tree tree;
        ForceSet forces;
        return add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, slender(1, 1)), "spar", {"b"}, options);
    };
    const auto hinge = [&](Partition partition, std::optional<double> delta) {
        const CardanBeam beam = made(partition, delta);
        CHECK(beam.warnings.empty());
        return beam.elements[0].hinges.first;
    };
    CHECK(hinge(Partition::segment_masses, {}) == delta_gauss);
    CHECK(hinge(Partition::static_moment, {}) == sixth);
    CHECK(hinge(Partition::segment_masses, 0.2113) == 0.2113);
    CHECK(hinge(Partition::mean_difference, {}) == Approx(sixth).epsilon(1e-12));
    CHECK(hinge(Partition::compliance_gauss, {}) == Approx(delta_gauss).epsilon(1e-12));
    const auto warning = [&](Partition partition, double delta) {
        const auto warnings = made(partition, delta).warnings;
        REQUIRE(warnings.size() == 1);
        return warnings[0];
    };
    CHECK(warning(Partition::segment_masses, sixth).find("bending converge with the square") != std::string::npos);
    CHECK(warning(Partition::static_moment, 0.15).find("rotating beams and buckling") != std::string::npos);
    // Not "too tapered": the element is uniform.
    check_refused([&] { (void)made(Partition::static_moment, delta_gauss); },
                  {"delta = 0.2113248654 leaves them none", "if delta is left out"});
}
