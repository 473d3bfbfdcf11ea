// The elastic law of the element: what test_flexibility.cpp leaves out.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "elements/sections/beam_line.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/model/summary.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/oracles/quadrature.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

using enum ElementCoordinate;

// Taper, principal axes that turn along the beam, shear flexible, every centre somewhere else.
BeamLine general_line() {
    BeamLine line{2.5, {}, {}, "general"};
    line.section = [](double x) {
        const double t = 1 - 0.25 * x;
        EngineeringSection s;
        s.mass = 5 * t, s.j_flap = 0.1, s.j_edge = 0.2;
        s.EA = 8e4 * t, s.GJ = 3e2 * t * t * t, s.EI_flap = 4e2 * t * t * t, s.EI_edge = 3e3 * t * t;
        s.GA_y = 1e4 * t, s.GA_z = 7e3 * t;
        s.beta = 0.3 + 0.4 * x;
        s.shear_centre = {0.07 * t, -0.02};
        s.tension_centre = {-0.05, 0.03 * t};
        return s.section();
    };
    return line;
}

// Displacement and rotation of the tip, [rotation; displacement], by [moment; force] there: the section forces of the
// tip load integrated over the beam, 20 Gauss points.
Mat6 continuum_tip_compliance(const BeamLine& line) {
    const oracles::GaussRule rule = oracles::gauss_legendre(20);
    Mat6 C = Mat6::Zero();
    for (Eigen::Index i = 0; i < rule.point.size(); ++i) {
        const double x = line.length / 2 * (1 + rule.point[i]), arm = line.length - x;
        Mat6 B = Mat6::Zero();            // (N, Vy, Vz, T, My, Mz) by [moment; force]
        B(0, 3) = B(1, 4) = B(2, 5) = 1;  // N = Fx, Vy = Fy, Vz = Fz
        B(3, 0) = B(4, 1) = B(5, 2) = 1;  // T = Mx ...
        B(4, 5) = -arm, B(5, 4) = arm;    // arm x F
        C += line.length / 2 * rule.weight[i] * B.transpose() * line.section(x).compliance * B;
    }
    return C;
}

CardanBeamOptions with(int elements, double delta, bool extension) {
    CardanBeamOptions options = all_free(elements, delta);
    options.extension = extension;
    return options;
}

// Likewise for a cantilever of cardanic elements: J K^-1 J^T with the tip's Jacobian in the tree.
Mat6 chain_tip_compliance(const BeamLine& line, const CardanBeamOptions& options) {
    Tree tree;
    ForceSet forces;
    const CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), line, "beam", {"beam"}, options);
    const System system(tree, forces);
    const auto n = system.model.size();
    const Vector zero = Vector::Zero(n);
    Workspace workspace(system.model);
    Matrix J(6, n);
    frame_jacobian(kinematics(system.model, zero, workspace), beam.tip(), J);
    const Matrix K = solvers::linearise(system, at_rest(zero)).elastic;
    const Vector d = K.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix scaled = J * d.asDiagonal();
    return scaled * Matrix(d.asDiagonal() * K * d.asDiagonal()).llt().solve(Matrix(scaled.transpose()));
}

}  // namespace

TEST_CASE("stiffness: section forces by joint forces are in equilibrium along the element", "[analytic]") {
    constexpr double L = 1.7, delta = 0.23, h = 0.25;
    const Mat6 at = section_forces_by_joint_forces(0.4, L, Hinges::symmetric(delta)),
               next = section_forces_by_joint_forces(0.4 + h, L, Hinges::symmetric(delta));
    const auto N = [](const Mat6& H) { return H.row(0); };
    const auto Vy = [](const Mat6& H) { return H.row(1); };
    const auto Vz = [](const Mat6& H) { return H.row(2); };
    const auto T = [](const Mat6& H) { return H.row(3); };
    CHECK((N(next) - N(at)).norm() + (T(next) - T(at)).norm() == 0);
    CHECK((Vy(next) - Vy(at)).norm() + (Vz(next) - Vz(at)).norm() == 0);
    CHECK(((next.row(4) - at.row(4)) / h - Vz(at)).norm() < 1e-14);  // My' = Vz
    CHECK(((next.row(5) - at.row(5)) / h + Vy(at)).norm() < 1e-14);  // Mz' = -Vy
    // At the hinges the bending moments are the joint moments themselves.
    const Mat6 hinge1 = section_forces_by_joint_forces(delta * L, L, Hinges::symmetric(delta));
    const Mat6 hinge2 = section_forces_by_joint_forces((1 - delta) * L, L, Hinges::symmetric(delta));
    CHECK((hinge1.row(4) - Vec6::Unit(2).transpose()).norm() < 1e-14);
    CHECK((hinge2.row(4) - Vec6::Unit(3).transpose()).norm() < 1e-14);
    CHECK((hinge1.row(5) - Vec6::Unit(4).transpose()).norm() < 1e-14);
    CHECK((hinge2.row(5) - Vec6::Unit(5).transpose()).norm() < 1e-14);
}

TEST_CASE("stiffness: elements of unequal lengths and either order of the cardan axes have the continuum's compliance",
          "[analytic]") {
    const BeamLine line = general_line();
    const Mat6 exact = continuum_tip_compliance(line);
    CardanBeamOptions options = with(1, 0.21, true);
    options.boundaries = {0, 0.3, 1.9, 2.5};
    options.order = CardanOrder::same;
    CHECK(scaled_difference(chain_tip_compliance(line, options), exact) < 1e-12);
}

TEST_CASE("stiffness: clamping the extension instead of condensing it would stiffen bending", "[analytic]") {
    // The tension centre lies beside the line: bending at zero axial force stretches it.
    const Mat6 f = joint_flexibility(general_line(), 0, 2.5, 0.21);
    const Matrix condensed = joint_stiffness(f, {phi, ay1, ay2, az1, az2}, ""),
                 clamped = joint_stiffness(f, {u, phi, ay1, ay2, az1, az2}, "").bottomRightCorner(5, 5);
    const Eigen::SelfAdjointEigenSolver<Matrix> stiffer(Matrix(clamped - condensed));
    CHECK(stiffer.eigenvalues()(4) > 0.01 * condensed(1, 1));  // one load path more: rank one
    CHECK(stiffer.eigenvalues().head(4).cwiseAbs().maxCoeff() < 1e-12 * clamped.norm());
}

TEST_CASE("stiffness: torsion locked leaves bending as it is where the shear centre lies on the line", "[analytic]") {
    BeamLine line = general_line();
    const auto own = line.section;
    line.section = [own](double x) {
        BeamSection s = own(x);
        const double torsion = s.compliance(3, 3);
        s.compliance.row(3).setZero(), s.compliance.col(3).setZero();
        s.compliance(3, 3) = torsion;
        return s;
    };
    CardanBeamOptions options = with(2, 0.21, true);
    options.torsion = false;
    const Mat6 exact = continuum_tip_compliance(line), chain = chain_tip_compliance(line, options);
    const std::vector<int> bending{1, 2, 4, 5};
    const Matrix A = chain(bending, bending), B = exact(bending, bending);
    CHECK((A - B).norm() < 1e-12 * B.norm());
    CHECK(chain.row(0).norm() < 1e-14 * chain.norm());
}

TEST_CASE("stiffness: a beam like another is the one that its line and options would give", "[property]") {
    CardanBeamOptions options = with(3, 0.2, false);
    options.bending_armature = 1e-3, options.torsion_armature = 0.1;
    options.damping = BeamDamping::of_modes({.all = {0.01, 0.02}});
    options.damping.time_constants = {1e-3, 1e-3, 1e-3, 2e-3, 1e-3, 1e-3};
    for (const bool curved : {false, true}) {
        const BeamLine straight = general_line(),
                       line = curved ? along(straight, ReferenceLine::through({{0, 0, 0}, {1.5, 0, 0}, {2.3, 0.6, 0}},
                                                                              LineShape::polyline))
                                     : straight;
        Tree fresh, again;
        ForceSet fresh_forces, again_forces;
        const CardanBeam first = add_cardan_beam(again, again_forces, Tree::base(), line, "a", {"blade", 1}, options);
        const CardanBeam like = add_cardan_beam(again, again_forces, first.tip(), first, "b", {"blade", 2});
        const CardanBeam below = add_cardan_beam(fresh, fresh_forces, Tree::base(), line, "a", {"blade", 1}, options);
        const CardanBeam anew = add_cardan_beam(fresh, fresh_forces, below.tip(), line, "b", {"blade", 2}, options);
        CHECK(summary(again) == summary(fresh));
        CHECK_FALSE(anew.warnings.empty());
        CHECK(like.warnings == anew.warnings);
        CHECK(like.mass == anew.mass);
        const System one(again, again_forces), other(fresh, fresh_forces);
        const Vector q = Vector::LinSpaced(one.model.size(), -0.1, 0.2), zero = Vector::Zero(one.model.size());
        const solvers::Linearisation a = solvers::linearise(one, at_rest(q)), b = solvers::linearise(other, at_rest(q));
        CHECK(a.mass == b.mass);
        CHECK(a.elastic == b.elastic);
        CHECK(a.damping == b.damping);
        CHECK(a.damping.norm() > 0);
    }
}

TEST_CASE("stiffness: a beam cannot be like one that was not made", "[property]") {
    Tree tree;
    ForceSet forces;
    check_refused([&] { (void)add_cardan_beam(tree, forces, Tree::base(), CardanBeam{}, "b", {"beam"}); },
                  {"b: number of elements of the beam to be like", "add_cardan_beam()"});
}
