// How mass is given to the bodies of an element.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "elements/cardan_beam/detail/tilted_masses.hpp"
#include "elements/sections/quadrature.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
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
                s.compliance.block<2, 2>(1, 1).setZero();
                return s;
            },
            "tapered"};
}

BeamLine flexible_in_shear(BeamLine line, double offset, double shear_compliance) {
    line.section = [section = line.section, offset, shear_compliance](double x) {
        BeamSection s = section(x);
        s.centre *= offset;
        s.compliance(1, 1) = s.compliance(2, 2) = shear_compliance;
        return s;
    };
    return line;
}

RigidInertia sum_of(const ElementInertia& element) {
    RigidInertia sum;
    for (const RigidInertia& body : element.body) sum = sum + body;
    return sum;
}

}  // namespace

TEST_CASE("segment masses: total mass, first moment and inertia tensor of the continuum are kept", "[analytic]") {
    const BeamLine line = tapered_with_offsets();
    const double x0 = 0.4, L = 2.1;
    const ElementInertia element = partition_element(line, x0, L, 0.23, Partition::segment_masses);
    const RigidInertia sum = sum_of(element);
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

TEST_CASE("shear flexibility: of the turn of the middle bodies 1 / (1 + GA h^2 / 12 EI) is shear, in each direction",
          "[analytic]") {
    EngineeringSection s = slender(1, 2);
    s.EI_flap = 3, s.EI_edge = 70, s.GA_y = 40, s.GA_z = 5;
    for (const double beta : {0.0, 0.4})
        for (const double h : {0.1, 1.0, 8.0}) {
            s.beta = beta;
            const BeamLine line = uniform_beam(h, s);
            const Eigen::Matrix2d R = Eigen::Rotation2Dd(beta).toRotationMatrix(),
                                  part = shear_fraction(ElementLine(line, 0, h), Hinges::symmetric(delta_gauss));
            const auto share = [h](double GA, double EI) { return 1 / (1 + GA * h * h / (12 * EI)); };
            const Eigen::Matrix2d exact = R * Eigen::Vector2d(share(40, 70), share(5, 3)).asDiagonal() * R.transpose();
            CHECK((part - exact).norm() < 1e-12);
        }
    s.GA_y = s.GA_z = std::numeric_limits<double>::infinity();
    const BeamLine rigid = uniform_beam(1, s);
    CHECK(shear_fraction(ElementLine(rigid, 0, 1), Hinges::symmetric(0.2)).isZero(0));
}

TEST_CASE(
    "shear flexibility: that share of the first moments across the axis stands on the end bodies, "
    "what the element has stays",
    "[property]") {
    const BeamLine rigid = tapered_with_offsets();
    for (const Partition partition : {Partition::segment_masses, Partition::compliance_gauss})
        for (const double offset : {0.5, 2.0}) {  // the larger one asks for more rotary inertia than there is
            CAPTURE(partition_name(partition), offset);
            const BeamLine flexible = flexible_in_shear(rigid, offset, 10),
                           stiffened = flexible_in_shear(rigid, offset, 0);
            const ElementLine line(flexible, 0.4, 2.5), stiff(stiffened, 0.4, 2.5);
            const ElementInertia moved = partition_element(line, 0.23, partition),
                                 segments = partition_element(stiff, 0.23, partition);
            const Eigen::Matrix2d part = shear_fraction(line, moved.hinges).transpose();
            CHECK(part(0, 0) > 0.9);
            CHECK(segments.tilted_moment == 0);
            CHECK((offset < 1 ? moved.tilted_moment == 0 : moved.tilted_moment > 0.1 && moved.tilted_moment < 0.7));
            const RigidInertia a = sum_of(moved), b = sum_of(segments);
            CHECK(a.mass == Approx(b.mass).epsilon(1e-14));
            CHECK((a.com - b.com).norm() < 1e-14);
            const Mat3 change = binet_tensor<double>(a.J) - binet_tensor<double>(b.J);
            CHECK(std::abs(change(0, 0)) < 1e-13);
            CHECK(change.bottomRightCorner<2, 2>().norm() < 1e-13 * binet_tensor<double>(b.J).norm());
            for (std::size_t k = 0; k < 4; ++k) {
                CHECK_NOTHROW(moved.body[k].check("segment"));
                CHECK(moved.body[k].mass == segments.body[k].mass);
                CHECK(moved.body[k].com(0) == segments.body[k].com(0));
            }
            if (offset > 1) continue;
            for (const std::size_t k : {1u, 2u}) {
                const Eigen::Vector2d was = segments.body[k].com.tail<2>(), is = moved.body[k].com.tail<2>();
                CHECK((was - part * was - is).norm() < 1e-14);
            }
        }
}

TEST_CASE(
    "shear flexibility: products of inertia with the axis change by what the halves of elements do not cancel, "
    "h^2 in a beam",
    "[property]") {
    const BeamLine rigid = tapered_with_offsets(), flexible = flexible_in_shear(rigid, 1, 10);
    const auto change = [&](int elements) {
        double xy = 0;
        for (int e = 0; e < elements; ++e) {
            const double L = 1.1 / elements;
            const RigidInertia a = sum_of(partition_element(flexible, e * L, L, 0.23, Partition::segment_masses)),
                               b = sum_of(partition_element(rigid, e * L, L, 0.23, Partition::segment_masses));
            xy += (binet_tensor<double>(a.J) - binet_tensor<double>(b.J))(0, 1);
        }
        return xy;
    };
    CHECK(std::abs(change(4)) > 1e-6);
    CHECK(std::log2(change(4) / change(8)) == Approx(2).margin(0.1));
    CHECK(std::log2(change(8) / change(16)) == Approx(2).margin(0.05));
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

TEST_CASE("static moments: strong taper gives a warning with place and centres, stronger taper is refused",
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
        solvers::restrict_to(solvers::linearise(system, at_rest(zero)), system.model.coordinates().free()));
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
    "partition: the place of the hinges follows from it unless asked otherwise, and another place gives a warning",
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
