// The elastic law of the cardanic joint element.
#include "elements/cardan_beam.hpp"
#include "solvers/linearise.hpp"
#include "tests/oracles/quadrature.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

using namespace cardan;
using namespace cardan::testing;

namespace {

using enum ElementCoordinate;
constexpr double infinite = std::numeric_limits<double>::infinity();

// Taper, principal axes that turn along the beam, shear flexible, every centre somewhere else.
BeamLine general_line(bool shear = true) {
    BeamLine line{2.5, {}, {}, "general"};
    line.section = [shear](double x) {
        const double t = 1 - 0.25 * x;
        EngineeringSection s;
        s.mass = 5 * t;
        s.EA = 8e4 * t, s.GJ = 3e2 * t * t * t, s.EI_flap = 4e2 * t * t * t, s.EI_edge = 3e3 * t * t;
        if (shear) s.GA_y = 1e4 * t, s.GA_z = 7e3 * t;
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
        Mat6 B = Mat6::Zero();                 // (N, Vy, Vz, T, My, Mz) by [moment; force]
        B(0, 3) = B(1, 4) = B(2, 5) = 1;       // N = Fx, Vy = Fy, Vz = Fz
        B(3, 0) = B(4, 1) = B(5, 2) = 1;       // T = Mx ...
        B(4, 5) = -arm, B(5, 4) = arm;         // arm x F
        C += line.length / 2 * rule.weight[i] * B.transpose() * line.section(x).compliance * B;
    }
    return C;
}

CardanBeamOptions with(int elements, double delta, bool extension) {
    CardanBeamOptions options;
    options.elements = elements;
    options.delta = delta;
    options.extension = extension;
    return options;
}

// The same of a cantilever of cardanic elements: J K^-1 J^T with the tip's Jacobian in the tree.
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
    const Matrix K = solvers::linearise(system, {zero, zero, zero, 0}).elastic;
    const Vector d = K.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix scaled = J * d.asDiagonal();
    return scaled * (d.asDiagonal() * K * d.asDiagonal()).llt().solve(scaled.transpose());
}

// Entry by entry, scaled by the diagonal: rotations and displacements alike.
double difference(const Mat6& A, const Mat6& B) {
    const Vec6 d = B.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
    return (d.asDiagonal() * (A - B) * d.asDiagonal()).cwiseAbs().maxCoeff();
}

EngineeringSection uniform_section(double lambda) {
    // EI = 3, L = 2: GA = lambda EI / L^2.
    EngineeringSection s;
    s.EI_flap = s.EI_edge = 3;
    s.GA_y = s.GA_z = lambda * 3 / 4;
    s.GJ = 5, s.EA = 7;
    return s;
}

}  // namespace

TEST_CASE("stiffness: the section integrals of a uniform element give the spring constants of the paper for every delta",
          "[published]") {
    // Zhao, Maisser and Wu (2007), eq. (15) and (16); (17) and (18) as torsion GJ / L and extension EA / L, which are
    // interchanged in print.
    constexpr double EI = 3, L = 2;
    for (double lambda : {0.5, 6.0, 20.0, 1e3, 1e6})
        for (double delta : {0.05, 0.1, 1. / 6, delta_gauss, 0.3, 0.45}) {
            const BeamLine line = uniform_beam(L, uniform_section(lambda));
            const Matrix K = joint_stiffness(joint_flexibility(line, 0, L, delta), {u, phi, ay1, ay2, az1, az2}, "");
            const double GA = lambda * EI / (L * L);
            const double c21 = 6 * (1 - 2 * delta) * (1 - 2 * delta) / (12 + lambda) * GA * L;
            const double c22 =
                (12 * (lambda * delta - lambda * delta * delta + 1) - 2 * lambda) / (12 + lambda) * EI / L;
            Mat6 expected = Mat6::Zero();
            expected(0, 0) = 7. / L, expected(1, 1) = 5. / L;
            for (Eigen::Index plane : {2, 4}) {
                expected(plane, plane) = expected(plane + 1, plane + 1) = c21 + c22;
                expected(plane, plane + 1) = expected(plane + 1, plane) = c22;
            }
            INFO("lambda " << lambda << ", delta " << delta);
            CHECK((K - expected).norm() < 1e-11 * expected.norm());
            const SpringConstants c = spring_constants(EI, GA, 5, 7, L, delta);
            CHECK(c.c21 == Approx(c21).epsilon(1e-14));
            CHECK(c.c22 == Approx(c22).epsilon(1e-12).margin(1e-12));
            CHECK(c.c23 == c.c21);
            CHECK(c.c11 == 2.5);
            CHECK(c.c12 == 3.5);
        }
}

TEST_CASE("stiffness: the spring constants of a shear-rigid element are the limit of large shear stiffness",
          "[analytic]") {
    for (double delta : {0.1, delta_gauss, 0.4}) {
        const SpringConstants rigid = spring_constants(3, infinite, 5, 7, 2, delta),
                              stiff = spring_constants(3, 1e12, 5, 7, 2, delta);
        CHECK(rigid.c21 == Approx(stiff.c21).epsilon(1e-10));
        CHECK(rigid.c22 == Approx(stiff.c22).epsilon(1e-10).margin(1e-10));
        const BeamLine line = uniform_beam(2, uniform_section(infinite));
        const Mat6 f = joint_flexibility(line, 0, 2, delta);
        const Matrix K = joint_stiffness(f, {ay1, ay2}, "");
        CHECK(K(0, 0) == Approx(rigid.c21 + rigid.c22).epsilon(1e-12));
        CHECK(K(0, 1) == Approx(rigid.c22).epsilon(1e-12).margin(1e-12));
    }
}

TEST_CASE("stiffness: c22 vanishes at delta = 1/2 - sqrt(1/12 + 1/lambda), is negative below and positive above",
          "[analytic]") {
    for (double lambda : {8.0, 20.0, 1e3, infinite}) {
        const double zero = 0.5 - std::sqrt(1. / 12 + 1 / lambda), GA = lambda * 3 / 4;
        const auto c22 = [&](double delta) { return spring_constants(3, GA, 5, 7, 2, delta).c22; };
        CHECK(std::abs(c22(zero)) < 1e-12);
        CHECK(c22(0.9 * zero) < 0);
        CHECK(c22(1.1 * zero) > 0);
    }
    CHECK(0.5 - std::sqrt(1. / 12) == Approx(delta_gauss).epsilon(1e-15));
    // lambda < 6: positive everywhere.
    for (double delta : {0.001, 0.2, 0.49}) CHECK(spring_constants(3, 5.9 * 3 / 4, 5, 7, 2, delta).c22 > 0);
}

TEST_CASE("stiffness: negative c22 does no harm: the eigenvalues are 2 EI / L and c21, whatever delta and lambda",
          "[analytic]") {
    for (double lambda : {2.0, 50.0, 1e5})
        for (double delta : {0.02, 0.1, 1. / 6, 0.4}) {
            const BeamLine line = uniform_beam(2, uniform_section(lambda));
            const Matrix K = joint_stiffness(joint_flexibility(line, 0, 2, delta), {ay1, ay2}, "");
            const double c21 = spring_constants(3, lambda * 3 / 4, 5, 7, 2, delta).c21;
            const Eigen::Vector2d both(1, 1), against(1, -1);
            CHECK((K * both - 2 * 3 / 2. * both).norm() < 1e-10 * K.norm());
            CHECK((K * against - c21 * against).norm() < 1e-10 * K.norm());
            CHECK(Eigen::SelfAdjointEigenSolver<Matrix>(K).eigenvalues().minCoeff() > 0);
        }
    CHECK(spring_constants(3, 1e5, 5, 7, 2, 0.1).c22 < -1);
}

TEST_CASE("stiffness: section forces by joint forces are in equilibrium along the element", "[analytic]") {
    constexpr double L = 1.7, delta = 0.23, h = 0.25;
    const Mat6 at = section_forces_by_joint_forces(0.4, L, delta), next = section_forces_by_joint_forces(0.4 + h, L, delta);
    const auto N = [](const Mat6& H) { return H.row(0); };
    const auto Vy = [](const Mat6& H) { return H.row(1); };
    const auto Vz = [](const Mat6& H) { return H.row(2); };
    const auto T = [](const Mat6& H) { return H.row(3); };
    CHECK((N(next) - N(at)).norm() + (T(next) - T(at)).norm() == 0);
    CHECK((Vy(next) - Vy(at)).norm() + (Vz(next) - Vz(at)).norm() == 0);
    CHECK(((next.row(4) - at.row(4)) / h - Vz(at)).norm() < 1e-14);  // My' = Vz
    CHECK(((next.row(5) - at.row(5)) / h + Vy(at)).norm() < 1e-14);  // Mz' = -Vy
    // At the hinges the bending moments are the joint moments themselves.
    const Mat6 hinge1 = section_forces_by_joint_forces(delta * L, L, delta);
    const Mat6 hinge2 = section_forces_by_joint_forces((1 - delta) * L, L, delta);
    CHECK((hinge1.row(4) - Vec6::Unit(2).transpose()).norm() < 1e-14);
    CHECK((hinge2.row(4) - Vec6::Unit(3).transpose()).norm() < 1e-14);
    CHECK((hinge1.row(5) - Vec6::Unit(4).transpose()).norm() < 1e-14);
    CHECK((hinge2.row(5) - Vec6::Unit(5).transpose()).norm() < 1e-14);
}

TEST_CASE("stiffness: one element has the tip compliance of the continuum, all 36 entries, for any section and delta",
          "[analytic]") {
    const BeamLine line = general_line();
    const Mat6 exact = continuum_tip_compliance(line);
    CHECK((exact - exact.transpose()).norm() < 1e-14 * exact.norm());
    for (double delta : {0.1, 1. / 6, delta_gauss, 0.3, 0.45})
        CHECK(difference(chain_tip_compliance(line, with(1, delta, true)), exact) < 1e-12);
}

TEST_CASE("stiffness: so have several elements, of equal or chosen lengths, in either order of the cardan axes",
          "[analytic]") {
    const BeamLine line = general_line();
    const Mat6 exact = continuum_tip_compliance(line);
    for (int elements : {2, 3, 7})
        CHECK(difference(chain_tip_compliance(line, with(elements, 0.17, true)), exact) < 1e-12);
    CardanBeamOptions options = with(1, 0.21, true);
    options.boundaries = {0, 0.3, 1.9, 2.5};
    options.order = CardanOrder::same;
    CHECK(difference(chain_tip_compliance(line, options), exact) < 1e-12);
}

TEST_CASE("stiffness: extension condensed at zero axial force leaves bending and torsion as they are", "[analytic]") {
    // Clamping u instead would stiffen bending: the tension centre lies beside the line.
    const BeamLine line = general_line();
    Mat6 exact = continuum_tip_compliance(line), chain = chain_tip_compliance(line, with(2, 0.21, false));
    CHECK(chain.row(3).norm() < 1e-14 * chain.norm());  // no axial displacement
    exact.row(3).setZero(), exact.col(3).setZero();
    exact(3, 3) = chain(3, 3) = 1;
    CHECK(difference(chain, exact) < 1e-12);
    const Matrix free = joint_stiffness(joint_flexibility(line, 0, 2.5, 0.21), {u, phi, ay1, ay2, az1, az2}, "");
    const Matrix condensed = joint_stiffness(joint_flexibility(line, 0, 2.5, 0.21), {phi, ay1, ay2, az1, az2}, "");
    const Matrix clamped = free.bottomRightCorner(5, 5);
    CHECK(clamped(1, 1) > 1.01 * condensed(1, 1));
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

TEST_CASE("stiffness: a rigid direction must be locked, which is said; locked it does no harm", "[property]") {
    const BeamLine line = uniform_beam(2, [] {
        EngineeringSection s = uniform_section(20);
        s.EA = infinite;
        return s;
    }());
    const Mat6 f = joint_flexibility(line, 0, 2, 0.21);
    CHECK(f.row(0).norm() == 0);
    check_refused([&] { (void)joint_stiffness(f, {u, phi, ay1, ay2, az1, az2}, "beam element 3"); },
                  {"beam element 3", "a rigid direction must be locked"});
    const Matrix K = joint_stiffness(f, {phi, ay1, ay2, az1, az2}, "");
    CHECK(K(0, 0) == Approx(2.5).epsilon(1e-12));
}
