// Sections given by 6 x 6 matrices: conversion, other axes and reference points, engineering constants, the beam made
// from them, and matrices that must be refused.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "elements/sections/beam_line.hpp"
#include "mbs/base/decompositions.hpp"
#include "solvers/linear/linearise.hpp"
#include "tests/oracles/quadrature.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// Roots of the diagonal of a blade's stiffness: N beside N m^2, nine decades apart.
Vec6 blade_scale() {
    return (Vec6() << 2e10, 8e8, 3e8, 9e7, 4e7, 2e9).finished().cwiseSqrt();
}

// Symmetric positive definite with every coupling, condition about 50 when scaled to unit diagonal.
Mat6 random_stiffness(Random& random) {
    const Mat6 A = Mat6::NullaryExpr([&] { return uniform(random, -1, 1); });
    const Vec6 d = blade_scale();
    return d.asDiagonal() * Mat6(A * A.transpose() + 0.2 * Mat6::Identity()) * d.asDiagonal();
}

// The stiffness changed by factors 0.5 ... 2 along six random directions: the sections in between stay analytic in x
// over a wide strip, so that Gauss quadrature resolves their compliance to the last digits.
Mat6 tapered(Random& random, const Mat6& stiffness) {
    const Mat6 root = Matrix(stiffness).llt().matrixL();
    const Mat6 A = Mat6::NullaryExpr([&] { return uniform(random, -1, 1); });
    const Mat6 Q = orthogonal_factor(A);
    const Vec6 factor = Vec6::NullaryExpr([&] { return std::exp2(uniform(random, -1, 1)); });
    return root * Q * factor.asDiagonal() * Q.transpose() * root.transpose();
}

// p = m (v + omega x c), h = J omega + c x p of a plane section; written entry by entry.
Mat6 mass_matrix(double m, double y, double z, double Jyy, double Jzz, double Jyz) {
    const double iy = Jyy + m * z * z, iz = Jzz + m * y * y, iyz = Jyz - m * y * z;
    Mat6 M;
    M << m, 0, 0, 0, m * z, -m * y,  //
        0, m, 0, -m * z, 0, 0,       //
        0, 0, m, m * y, 0, 0,        //
        0, -m * z, m * y, iy + iz, 0, 0, m * z, 0, 0, 0, iy, iyz, -m * y, 0, 0, 0, iyz, iz;
    return M;
}

SectionMatrices random_matrices(Random& random) {
    const double Jyy = uniform(random, 5, 20), Jzz = uniform(random, 50, 200),
                 Jyz = uniform(random, -0.9, 0.9) * std::sqrt(Jyy * Jzz);
    return {random_stiffness(random), mass_matrix(uniform(random, 100, 900), uniform(random, -0.6, 0.6),
                                                  uniform(random, -0.3, 0.3), Jyy, Jzz, Jyz)};
}

EngineeringSection random_engineering(Random& random) {
    EngineeringSection e;
    e.mass = uniform(random, 100, 900);
    e.EA = uniform(random, 1, 9) * 1e9, e.GJ = uniform(random, 1, 9) * 1e7;
    e.EI_flap = uniform(random, 1, 4) * 1e8, e.EI_edge = uniform(random, 5, 9) * 1e8;
    e.GA_y = uniform(random, 1, 9) * 1e8, e.GA_z = uniform(random, 1, 9) * 1e7;
    e.beta = uniform(random, -1.5, 1.5);
    for (SectionOffset* offset : {&e.mass_centre, &e.shear_centre, &e.tension_centre})
        *offset = {uniform(random, -0.5, 0.5), uniform(random, -0.2, 0.2)};
    e.j_flap = uniform(random, 5, 20), e.j_edge = uniform(random, 50, 200);
    return e;
}

void check_same(const BeamSection& a, const BeamSection& b, double tolerance) {
    CHECK(scaled_difference(a.compliance, b.compliance) < tolerance);
    CHECK(std::abs(a.mass - b.mass) <= tolerance * b.mass);
    CHECK((a.centre - b.centre).norm() < tolerance);
    CHECK((a.J - b.J).norm() <= tolerance * b.J.norm());
}

void check_same(const SectionMatrices& a, const SectionMatrices& b) {
    CHECK(scaled_difference(a.stiffness, b.stiffness) < 1e-12);
    CHECK(scaled_difference(a.mass, b.mass) < 1e-12);
}

double energy(const Mat6& A, const Vec6& v) {
    return (v.transpose() * A * v)(0) / 2;
}

// Compliance of the tip, displacement before rotation, of a clamped beam by (N, Vy, Vz, T, My, Mz) there.
Mat6 chain_tip_compliance(const BeamLine& line, int elements, double delta) {
    CardanBeamOptions options;
    options.elements = elements, options.delta = delta, options.extension = true;
    Tree tree;
    ForceSet forces;
    const CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), line, "beam", {"beam"}, options);
    const System system(tree, forces);
    const auto n = system.model.size();
    REQUIRE(n == 6 * elements);
    const Vector zero = Vector::Zero(n);
    Workspace workspace(system.model);
    Matrix J(6, n);
    frame_jacobian(kinematics(system.model, zero, workspace), beam.tip(), J);
    const std::vector<int> linear_first{3, 4, 5, 0, 1, 2};
    J = Matrix(J(linear_first, Eigen::all));
    const Matrix K = solvers::linearise(system, at_rest(zero)).stiffness();
    const Vector d = K.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix scaled = J * d.asDiagonal();
    return scaled * Matrix(d.asDiagonal() * K * d.asDiagonal()).llt().solve(Matrix(scaled.transpose()));
}

}  // namespace

TEST_CASE("section matrices: to a section and back they are the same, and so is a section to matrices and back",
          "[property]") {
    Random random(11);
    for (int i = 0; i < 30; ++i) {
        const SectionMatrices m = random_matrices(random);
        check_same(section_matrices(beam_section(m, "blade")), m);
        const BeamSection s = random_engineering(random).section();
        check_same(beam_section(section_matrices(s), "blade"), s, 1e-12);
    }
}

TEST_CASE("section matrices: mass, centre and inertia are read from entries written by hand", "[analytic]") {
    Random random(10);
    const BeamSection s = beam_section({random_stiffness(random), mass_matrix(250, -0.28, 0.03, 2, 26, 0.7)}, "blade");
    CHECK(s.mass == 250);
    CHECK((s.centre - Vec3(0, -0.28, 0.03)).norm() < 1e-15);
    CHECK((s.J - (Mat3() << 28, 0, 0, 0, 2, 0.7, 0, 0.7, 26).finished()).norm() < 1e-13);
}

TEST_CASE("section matrices: other axes and another reference point leave strain and kinetic energy as they are",
          "[property]") {
    // Strains and velocities alike: a vector pair (linear; angular); at another point linear + angular x r.
    Random random(12);
    for (int i = 0; i < 20; ++i) {
        const SectionMatrices m = random_matrices(random);
        const Mat3 R = random_rotation(random);
        const Vec3 r = random_vector(random), a = random_vector(random), b = random_vector(random);
        const Vec6 v = (Vec6() << a, b).finished();
        const Vec6 turned = (Vec6() << R * a, R * b).finished();
        const Vec6 elsewhere = (Vec6() << a + cross<double>(b, r), b).finished();
        const SectionMatrices other_axes = rotated(m, R), other_point = moved(m, r);
        CHECK(energy(other_axes.stiffness, turned) == Approx(energy(m.stiffness, v)).epsilon(1e-12));
        CHECK(energy(other_axes.mass, turned) == Approx(energy(m.mass, v)).epsilon(1e-12));
        CHECK(energy(other_point.stiffness, elsewhere) == Approx(energy(m.stiffness, v)).epsilon(1e-11));
        CHECK(energy(other_point.mass, elsewhere) == Approx(energy(m.mass, v)).epsilon(1e-12));
    }
}

TEST_CASE("section matrices: moved twice is moved once by the sum", "[property]") {
    Random random(13);
    for (int i = 0; i < 20; ++i) {
        const SectionMatrices m = random_matrices(random);
        const Vec3 a = random_vector(random), b = random_vector(random);
        check_same(moved(moved(m, a), b), moved(m, a + b));
    }
}

TEST_CASE("section matrices: from another point centres shift, inertia about the centre and stiffness stay",
          "[analytic]") {
    Random random(14);
    for (int i = 0; i < 20; ++i) {
        EngineeringSection e = random_engineering(random);
        e.beta = 0;
        const SectionOffset to{uniform(random, -1, 1), uniform(random, -1, 1)};
        EngineeringSection expected = e;
        for (SectionOffset* centre : {&expected.mass_centre, &expected.shear_centre, &expected.tension_centre})
            centre->y -= to.y, centre->z -= to.z;
        const SectionMatrices m = moved(section_matrices(e.section()), {0, to.y, to.z});
        check_same(beam_section(m, "blade"), expected.section(), 1e-11);
    }
}

TEST_CASE("section matrices: the mass centre as reference point, or no inertia about it, is accepted", "[property]") {
    // What is zero comes out as rounding.
    Random random(15);
    for (int i = 0; i < 20; ++i) {
        SectionMatrices m = random_matrices(random);
        const Vec3 centre = beam_section(m, "blade").centre;
        const BeamSection s = beam_section(moved(m, centre), "blade");
        CHECK(s.centre.norm() < 1e-14);
        const double mass = uniform(random, 1, 900), y = uniform(random, -1, 1), z = uniform(random, -1, 1);
        m.mass = mass_matrix(mass, y, z, 0, 0, 0);  // a line of mass points
        const BeamSection points = beam_section(m, "blade");
        CHECK(points.J.norm() < 1e-14 * mass);
        m.mass = moved(m, points.centre).mass;
        CHECK(beam_section(m, "blade").J.norm() < 1e-14 * mass);
    }
}

TEST_CASE("matrix line: the tip compliance of the tree is that of the continuum, for any stations", "[analytic]") {
    // Section forces of a tip load integrated over the beam: int X^T S X dx, 30 Gauss points; S by LU of the stiffness
    // between the stations.
    const oracles::GaussRule rule = oracles::gauss_legendre(30);
    Random random(16);
    for (int trial = 0; trial < 6; ++trial) {
        SectionMatrices root = random_matrices(random), tip = root;
        tip.stiffness = tapered(random, root.stiffness);
        const double start = 1.5, L = uniform(random, 5, 40);
        const BeamLine line = matrix_line("blade", {start, start + L}, {root, tip});
        REQUIRE(line.length == Approx(L).epsilon(1e-14));
        const Vec6 d = blade_scale().cwiseInverse();
        Mat6 exact = Mat6::Zero();
        for (Eigen::Index i = 0; i < rule.point.size(); ++i) {
            const double t = (1 + rule.point[i]) / 2, arm = L * (1 - t);
            const Mat6 K = d.asDiagonal() * Mat6((1 - t) * root.stiffness + t * tip.stiffness) * d.asDiagonal();
            Mat6 X = Mat6::Identity();  // moments at x of the tip's forces: arm x F
            X(4, 2) = -arm, X(5, 1) = arm;
            const Mat6 dX = d.asDiagonal() * X;
            exact += L / 2 * rule.weight[i] * dX.transpose() * K.partialPivLu().solve(dX);
        }
        for (const auto& [elements, delta] : {std::pair{1, 0.1}, {2, delta_gauss}, {3, 0.17}, {5, 0.3}}) {
            CAPTURE(trial, elements, delta);
            CHECK(scaled_difference(chain_tip_compliance(line, elements, delta), exact) < 1e-12);
        }
    }
}

TEST_CASE("matrix line: bend-twist and extension-twist coupling turn the tip by the formula", "[analytic]") {
    // Two coupled entries of a stiffness, all else diagonal: kappa_x = -K_ab / (K_aa K_bb - K_ab^2) times the load.
    const double L = 12;
    const Mat6 M = mass_matrix(100, 0, 0, 5, 20, 0);
    for (const int load : {0, 4, 5}) {  // N, My, Mz
        Mat6 K = Mat6(blade_scale().cwiseAbs2().asDiagonal());
        const double coupling = 0.3 * std::sqrt(K(3, 3) * K(load, load));
        K(3, load) = K(load, 3) = coupling;
        const Mat6 C = chain_tip_compliance(matrix_line("blade", {0, L}, {{K, M}, {K, M}}), 3, delta_gauss);
        const double det = K(3, 3) * K(load, load) - coupling * coupling;
        CHECK(C(3, load) == Approx(-L * coupling / det).epsilon(1e-12));
        CHECK(C(3, 3) == Approx(L * K(load, load) / det).epsilon(1e-12));
        CHECK(C(load, load) == Approx(L * K(3, 3) / det).epsilon(1e-12));
        CHECK(std::abs(C(3, load == 4 ? 5 : 4)) < 1e-14 * std::abs(C(3, load)));
    }
}

TEST_CASE("matrix line: a bend-twist entry in BeamDyn's axes turns the tip the other way in ours", "[analytic]") {
    // BeamDyn's y is minus ours: K(5, 6) couples the moment about its y with the twist about z.
    Mat6 K = Mat6((Vec6() << 3e8, 8e8, 2e10, 2e9, 4e7, 9e7).finished().asDiagonal());
    K(4, 5) = K(5, 4) = 1e7;
    const Mat6 M = rotated({K, mass_matrix(100, 0, 0, 5, 20, 0)}, beamdyn_axes().transpose()).mass;
    const Mat6 C = chain_tip_compliance(matrix_line("blade", {0, 1}, {{K, M}, {K, M}}, beamdyn_axes()), 2, 0.2);
    CHECK(C(3, 4) == Approx(+1e7 / (4e7 * 9e7 - 1e14)).epsilon(1e-12));
}

TEST_CASE("engineering form: a section of engineering constants is recovered, rigid directions too", "[property]") {
    Random random(17);
    for (int i = 0; i < 60; ++i) {
        EngineeringSection e = random_engineering(random);
        double* const stiffness[] = {&e.EA, &e.GA_y, &e.GA_z, &e.GJ, &e.EI_edge};
        for (int bit = 0; bit < 5; ++bit)
            if (i >> bit & 1) *stiffness[bit] = infinite;
        if (i % 7 == 6) e.EI_edge = e.EI_flap;  // axes of shear and inertia only
        CAPTURE(i, e.beta);
        const EngineeringForm form = engineering_form(e.section());
        CHECK_NOTHROW(form.section.check("form"));
        CHECK(std::abs(form.section.beta) <= pi / 4 + 1e-12);
        CHECK(form.coupling < 1e-10);
        check_same(form.section.section(), e.section(), 1e-12);
        CHECK(std::isinf(form.section.GJ) == std::isinf(e.GJ));
        if (std::isfinite(e.EI_edge)) CHECK(std::isinf(form.section.EA) == std::isinf(e.EA));
    }
}

TEST_CASE("engineering form: what engineering constants cannot express is measured", "[analytic]") {
    Random random(18);
    for (const double added : {0.02, -0.3, 0.6}) {
        EngineeringSection e = random_engineering(random);
        e.beta = 0;
        BeamSection s = e.section();
        for (const int bending : {4, 5}) {  // bend-twist: the scaled entry of the compliance itself
            BeamSection coupled = s;
            coupled.compliance(3, bending) = coupled.compliance(bending, 3) =
                added * std::sqrt(s.compliance(3, 3) * s.compliance(bending, bending));
            CHECK(engineering_form(coupled).coupling == Approx(std::abs(added)).epsilon(1e-12));
        }
        // Axes of inertia turned by an angle: product (j_edge - j_flap) / 2 sin 2a over the polar inertia.
        s.J = rot_x(added) * s.J * rot_x(added).transpose();
        CHECK(engineering_form(s).coupling ==
              Approx((e.j_edge - e.j_flap) / 2 * std::abs(std::sin(2 * added)) / (e.j_edge + e.j_flap)).epsilon(1e-10));
    }
}

TEST_CASE("section axes: unit vectors of BeamDyn and HAWC2 lie as the conventions say", "[property]") {
    const Vec3 outward = Vec3::UnitX(), leading_edge = Vec3::UnitY(), downwind = Vec3::UnitZ();
    CHECK(beamdyn_axes() == (Mat3() << downwind, -leading_edge, outward).finished());
    CHECK(hawc2_axes() == (Mat3() << leading_edge, downwind, outward).finished());
    CHECK(vabs_axes() == Mat3::Identity());
    for (const Mat3& R : {vabs_axes(), beamdyn_axes(), hawc2_axes()}) CHECK(Placement::rotation(R).is_valid());
}

TEST_CASE("section axes: the matrices printed in BeamDyn's manual are a section of the named constants",
          "[published]") {
    // OpenFAST documentation, BeamDyn, "Distributed Properties": diag(K_ShrFlp, K_ShrEdg, EA, EI_Edg, EI_Flp, GJ), and
    // the mass matrix of m, X_cm, Y_cm, i_Edg, i_Flp, i_cp about the reference axis.
    const double m = 250, X = 0.06, Y = 0.4, i_edg = 60, i_flp = 5, i_cp = 7;
    Mat6 M;
    M << m, 0, 0, 0, 0, -m * Y, 0, m, 0, 0, 0, m * X, 0, 0, m, m * Y, -m * X, 0, 0, 0, m * Y, i_edg, -i_cp, 0,  //
        0, 0, -m * X, -i_cp, i_flp, 0, -m * Y, m * X, 0, 0, 0, i_edg + i_flp;
    const Mat6 K = Mat6((Vec6() << 3e8, 8e8, 2e10, 2e9, 4e7, 9e7).finished().asDiagonal());
    const BeamSection s = matrix_line("blade", {0, 1}, {{K, M}, {K, M}}, beamdyn_axes()).section(0.5);
    const EngineeringSection e = engineering_form(s).section;
    const Vec6 own = (Vec6() << e.GA_z, e.GA_y, e.EA, e.EI_edge, e.EI_flap, e.GJ).finished();
    CHECK((own.cwiseQuotient(Vec6(K.diagonal())) - Vec6::Ones()).norm() < 1e-14);
    CHECK((s.centre - Vec3(0, -Y, X)).norm() < 1e-15);  // toward the trailing edge is negative y
    CHECK(s.J(2, 2) == Approx(i_edg - m * Y * Y).epsilon(1e-13));
    CHECK(s.J(1, 1) == Approx(i_flp - m * X * X).epsilon(1e-13));
    CHECK(s.J(1, 2) == Approx(i_cp - m * X * Y).epsilon(1e-12));
}

TEST_CASE("section matrices: those printed for a composite blade are accepted", "[published]") {
    // GXBeam 0.5, example "Time-Domain Simulation of a Wind Turbine Blade": axes as here, four digits.
    Mat6 K, M = mass_matrix(258.053, 71.6871 / 258.053, 7.07839 / 258.053, 2.172 - 7.07839 * 7.07839 / 258.053,
                            46.418 - 71.6871 * 71.6871 / 258.053, 71.6871 * 7.07839 / 258.053);
    K << 2.389e9, 1.524e6, 6.734e6, -3.382e7, -2.627e7, -4.736e8,  //
        1.524e6, 4.334e8, -3.741e6, -2.935e5, 1.527e7, 3.835e5,    //
        6.734e6, -3.741e6, 2.743e7, -4.592e5, -6.869e5, -4.742e6,  //
        -3.382e7, -2.935e5, -4.592e5, 2.167e7, -6.279e5, 1.430e6,  //
        -2.627e7, 1.527e7, -6.869e5, -6.279e5, 1.970e7, 1.209e7,   //
        -4.736e8, 3.835e5, -4.742e6, 1.430e6, 1.209e7, 4.406e8;
    CHECK(M(3, 3) == Approx(48.59).epsilon(1e-12));  // as printed: a plane section
    CHECK(std::abs(M(4, 5)) < 1e-14);
    const BeamSection s = beam_section({K, M}, "blade");
    CHECK(scaled_difference(section_matrices(s).stiffness, K) < 1e-12);
    CHECK(engineering_form(s).coupling > 0.1);  // of this blade: bend-twist
}

namespace {

template <class Change>
void check_matrices_refused(Change change, std::initializer_list<std::string> parts) {
    Random random(19);
    SectionMatrices good = random_matrices(random), bad = good;
    good.stiffness = bad.stiffness = Mat6(blade_scale().cwiseAbs2().asDiagonal());
    change(bad.stiffness, bad.mass);
    const std::vector<double> x{1, 4.5, 9};
    const std::vector<SectionMatrices> sections{good, bad, good};
    check_refused([&] { (void)matrix_line("blade", x, sections); }, {"blade, station 2 (x = 4.5 m)"});
    check_refused([&] { (void)matrix_line("blade", x, sections); }, parts);
}
using M6 = Mat6;

}  // namespace

TEST_CASE("section matrices: a bad stiffness is refused with station, place and value", "[property]") {
    check_matrices_refused([](M6& K, M6&) { K(3, 4) = K(4, 3) = 1.5 * std::sqrt(K(3, 3) * K(4, 4)); },
                           {"smallest eigenvalue of the 6 x 6 stiffness", "= -0.5 (strains", "positive definite"});
    check_matrices_refused([](M6& K, M6&) { K(0, 5) = 1e5; }, {"6 x 6 stiffness", "allowed: symmetric"});
    // A wrong sign in a small entry: 2e-4 when scaled, 1e-6 of the largest.
    check_matrices_refused([](M6& K, M6&) { K(3, 4) = -(K(4, 3) = 6e3); }, {"allowed: symmetric"});
    check_matrices_refused([](M6& K, M6&) { K(2, 2) = not_a_number; }, {"6 x 6 stiffness", "nan", "finite"});
    check_matrices_refused([](M6& K, M6&) { K(3, 3) = -8; }, {"diagonal entry 4 = -8; allowed: > 0"});
    check_matrices_refused([](M6& K, M6&) { K(1, 1) = 0; }, {"diagonal entry 2 = 0; allowed: > 0"});
}

TEST_CASE("section matrices: a mass matrix that is not that of a plane section is refused", "[property]") {
    check_matrices_refused([](M6&, M6& M) { M(3, 5) = infinite; }, {"6 x 6 mass", "inf", "finite"});
    check_matrices_refused([](M6&, M6& M) { M(0, 4) += 1; }, {"6 x 6 mass", "symmetric"});
    check_matrices_refused([](M6&, M6& M) { M = -M; }, {"mass per length [kg/m] = -", "allowed: >= 0"});
    check_matrices_refused([](M6&, M6& M) { M(1, 1) *= 1.01; }, {"upper left block", "times the identity"});
    check_matrices_refused([](M6&, M6& M) { M(0, 4) = M(4, 0) = M(0, 4) + 1; }, {"upper right block", "skew"});
    check_matrices_refused([](M6&, M6& M) { M(3, 3) *= 1.5; }, {"polar inertia", "sum of the two others"});
    check_matrices_refused([](M6&, M6& M) { M(3, 4) = M(4, 3) = 0.2 * M(3, 3); }, {"products of inertia"});
    check_matrices_refused([](M6&, M6& M) { M(4, 5) = M(5, 4) = 2 * M(5, 5); },
                           {"smallest eigenvalue of the inertia per length"});
    check_matrices_refused(
        [](M6& K, M6& M) {
            M = moved(SectionMatrices{K, M}, Vec3(0.1, 0, 0)).mass;
        },
        {"entry (2, 6) [kg]", "the mass centre lies in the section"});
}

TEST_CASE("section matrices: rigid directions are infinite on the diagonal", "[property]") {
    Random random(24);
    EngineeringSection s = random_engineering(random);
    s.beta = 0;
    s.shear_centre = {};
    s.GA_y = s.GA_z = infinite;
    const BeamSection section = s.section();
    const SectionMatrices m = section_matrices(section);
    CHECK(m.stiffness(1, 1) == infinite);
    CHECK(m.stiffness(2, 2) == infinite);
    const BeamSection again = beam_section(m, "section");
    CHECK((again.compliance - section.compliance).norm() < 1e-13 * section.compliance.norm());
    // Shear stiffness without end: the limit of stiffer and stiffer sections.
    s.GA_y = s.GA_z = 1e9 * s.EA;
    const BeamSection stiff = beam_section(section_matrices(s.section()), "section");
    CHECK((stiff.compliance - section.compliance).norm() < 1e-8 * section.compliance.norm());
    // Axes to axes, and as a section by any angle.
    const SectionMatrices other = rotated(m, beamdyn_axes());
    CHECK(other.stiffness(0, 0) == m.stiffness(2, 2));
    CHECK(other.stiffness(1, 1) == infinite);
    CHECK(other.stiffness(2, 2) == Approx(m.stiffness(0, 0)));
    EngineeringSection by_angle = s;
    by_angle.GA_y = by_angle.GA_z = infinite;
    by_angle.beta = 0.4;
    const BeamSection a = turned(section, 0.4), b = by_angle.section();
    CHECK((a.compliance - b.compliance).norm() < 1e-13 * b.compliance.norm());
    CHECK((a.centre - b.centre).norm() < 1e-13);
    CHECK((a.J - b.J).norm() < 1e-13 * b.J.norm());
    CHECK(a.beta == Approx(0.4));
    const SectionMatrices half = interpolated({m, m}, {0, 1, 0.0});
    CHECK(half.stiffness == m.stiffness);
    check_refused([&] { (void)rotated(m, rot_z(0.3)); }, {"rotation", "direction 2 is rigid"});
    check_refused([&] { (void)moved(m, Vec3(0, 0.1, 0)); }, {"displacement", "is rigid"});
    SectionMatrices coupled = m;
    coupled.stiffness(1, 3) = coupled.stiffness(3, 1) = 1;
    check_refused([&] { (void)beam_section(coupled, "section"); }, {"no coupling with direction 2, which is rigid"});
}

TEST_CASE("matrix line: bad stations and axes are refused; a rigid section has no matrices", "[property]") {
    Random random(20);
    const SectionMatrices m = random_matrices(random);
    const auto make = [](std::vector<double> x, std::vector<SectionMatrices> sections, Mat3 axes = vabs_axes()) {
        return [=] { (void)matrix_line("blade", x, sections, axes); };
    };
    check_refused(make({0}, {m}), {"blade: number of stations = 1", "at least 2"});
    check_refused(make({0, 2, 2}, {m, m, m}), {"blade: station 3 [m] = 2", "the same station twice"});
    check_refused(make({0, 1}, {m}), {"blade: number of sections = 1"});
    check_refused(make({0, 1}, {m, m}, -vabs_axes()), {"blade: axes", "a rotation"});
    EngineeringSection s = random_engineering(random);
    s.GA_y = infinite;
    s.beta = 0.3;
    check_refused([&] { (void)section_matrices(s.section()); }, {"a rigid direction that is not an axis"});
    s.beta = 13.3;
    check_refused([&] { (void)uniform_beam(1, s, "blade"); }, {"blade: twist [rad] = 13.3", "given in degrees?"});
}
