// The elastic law of the element against the continuum that it stands for, and against the printed spring constants.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "elements/sections/quadrature.hpp"
#include "mbs/base/decompositions.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// Section compliances with every kind of coupling: taper, pre-twist, offsets of shear and tension centre.
BeamLine coupled_line(double length) {
    return {length,
            {},
            [length](double x) {
                const double s = x / length;
                EngineeringSection e;
                e.mass = 1, e.j_flap = e.j_edge = 0.05;
                e.EA = 50 - 20 * s, e.GJ = 3 - s, e.EI_flap = 2 - s, e.EI_edge = 7 - 3 * s;
                e.GA_y = 30 - 5 * s, e.GA_z = 20 - 6 * s;
                e.beta = 0.3 + 0.8 * s;
                e.shear_centre = {0.11, -0.07 * s};
                e.tension_centre = {-0.05, 0.09};
                return e.section();
            },
            "coupled"};
}

// Any positive definite section, linear in x.
BeamLine random_line(Random& random) {
    const auto definite = [&] {
        const Mat6 A = Mat6::NullaryExpr([&] { return uniform(random, -1, 1); });
        return Mat6(A * A.transpose() + 0.1 * Mat6::Identity());
    };
    const Mat6 root = definite(), tip = definite();
    return {1,
            {},
            [root, tip](double x) {
                BeamSection s;
                s.compliance = (1 - x) * root + x * tip;
                s.mass = 1;
                return s;
            },
            "random"};
}

// Displacement and rotation of the tip of a clamped continuum by a force and a moment there:
// int X^T S X dx, X the section forces at x by tip force (N, Vy, Vz) and tip moment (T, My, Mz).
Mat6 continuum_compliance(const BeamLine& line) {
    return integrate(0, line.length, line.breaks, Mat6(Mat6::Zero()), [&](double x) {
        const double arm = line.length - x;
        Mat6 X = Mat6::Identity();
        X(4, 2) = -arm;  // M = r x F with r = (arm, 0, 0)
        X(5, 1) = arm;
        return Mat6(X.transpose() * line.section(x).compliance * X);
    });
}

// Likewise for the chain of joints: J K^-1 J^T with the Jacobian of the tip.
Mat6 element_compliance(const BeamLine& line, const CardanBeamOptions& options) {
    Tree tree;
    ForceSet forces;
    BeamLine heavy = line;  // mass makes a model; the compliance does not depend on it
    const auto section = line.section;
    heavy.section = [section](double x) {
        BeamSection s = section(x);
        s.mass = 1;
        s.J = Mat3::Identity();
        s.J(0, 0) = 2;
        return s;
    };
    const CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), heavy, "beam", {"beam"}, options);
    const System system(tree, forces);
    const Eigen::Index n = system.model.size();
    Workspace workspace(system.model);
    const Vector zero = Vector::Zero(n);
    const Kinematics kin = kinematics(system.model, zero, workspace);
    Matrix J(6, n);
    frame_jacobian(kin, beam.tip(), J);  // [rotation; displacement]
    ForceDerivatives d;
    system.forces.derivatives({{.q = zero, .qd = zero}, kin}, d);
    const Matrix C = J * d.elastic.ldlt().solve(J.transpose());
    Mat6 ordered;  // displacement first, as forces come first in the section
    ordered << C.bottomRightCorner<3, 3>(), C.bottomLeftCorner<3, 3>(), C.topRightCorner<3, 3>(),
        C.topLeftCorner<3, 3>();
    return ordered;
}

}  // namespace

TEST_CASE("element: the tip compliance of any section is that of the continuum, for every delta", "[analytic]") {
    for (const double delta : {0.1, delta_gauss, 1. / 6, 0.3})
        for (const int elements : {1, 2, 3}) {
            CardanBeamOptions options;
            options.elements = elements;
            options.delta = delta;
            options.extension = true;
            const BeamLine line = coupled_line(2.5);
            const Mat6 exact = continuum_compliance(line);
            CHECK((element_compliance(line, options) - exact).norm() < 1e-12 * exact.norm());
        }
    Random random(7);
    for (int trial = 0; trial < 20; ++trial) {
        const BeamLine line = random_line(random);
        CardanBeamOptions options;
        options.elements = 1 + trial % 3;
        options.extension = true;
        const Mat6 exact = continuum_compliance(line);
        CHECK((element_compliance(line, options) - exact).norm() < 1e-12 * exact.norm());
    }
}

TEST_CASE("element: without extension the other five compliances stay those at zero axial force", "[analytic]") {
    const BeamLine line = coupled_line(1);
    CardanBeamOptions options;
    options.elements = 1;
    const Mat6 exact = continuum_compliance(line), condensed = element_compliance(line, options);
    CHECK((condensed - exact).bottomRightCorner<5, 5>().norm() < 1e-12 * exact.norm());
    CHECK(condensed(0, 0) < 1e-12);
}

TEST_CASE("element: a condensed extension with an offset tension centre gives a warning", "[property]") {
    Tree tree;
    ForceSet forces;
    CardanBeamOptions options;
    options.elements = 2;
    const auto warnings = add_cardan_beam(tree, forces, Tree::base(), coupled_line(1), "a", {"a"}, options).warnings;
    CHECK(std::count_if(warnings.begin(), warnings.end(), [](const std::string& warning) {
              return warning.find("tension centre lies off the reference line") != std::string::npos;
          }) == 2);
    options.extension = true;
    CHECK(add_cardan_beam(tree, forces, Tree::base(), coupled_line(1), "b", {"b"}, options).warnings.empty());
}

TEST_CASE("element: a condensed extension with an offset shear centre gives one warning per beam", "[property]") {
    const auto warnings = [](const SectionOffset& shear_centre, bool extension) {
        EngineeringSection section = slender(2, 3);
        section.GJ = 1, section.j_flap = section.j_edge = 0.01, section.EA = 100;
        section.shear_centre = shear_centre;
        CardanBeamOptions options;
        options.extension = extension;
        Tree tree;
        ForceSet forces;
        return add_cardan_beam(tree, forces, Tree::base(), uniform_beam(10, section), "a", {"a"}, options).warnings;
    };
    CHECK(warnings({}, false).empty());
    CHECK(warnings({0.03, -0.04}, true).empty());
    const auto found = warnings({0.03, -0.04}, false);
    REQUIRE(found.size() == 1);
    CHECK(found[0].find("the shear centre lies up to 0.05 m off the reference line") != std::string::npos);
    CHECK(found[0].find("keep the extension free") != std::string::npos);
}

TEST_CASE("spring constants: eq. (15), (16) and the interchanged (17), (18) are the uniform element's law",
          "[published]") {
    // Zhao, Maisser and Wu 2007; in print c11 = EA/L and c12 = GI_t/L.
    const double EI = 3.7, GJ = 1.9, EA = 41, L = 0.8;
    for (const double delta : {0.1, delta_gauss, 0.25, 0.4})
        for (const double GA : {2.0, 37.0, 1e4, std::numeric_limits<double>::infinity()}) {
            EngineeringSection s;
            s.mass = 1, s.EA = EA, s.GJ = GJ, s.EI_flap = s.EI_edge = EI, s.GA_y = s.GA_z = GA;
            const Mat6 F = joint_flexibility(uniform_beam(L, s), 0, L, delta);
            using C = ElementCoordinate;
            const Matrix K = joint_stiffness(F, {C::u, C::phi, C::ay1, C::ay2, C::az1, C::az2}, "test");
            const SpringConstants c = spring_constants(EI, GA, GJ, EA, L, delta);
            CHECK(K(0, 0) == Approx(c.c12));
            CHECK(K(1, 1) == Approx(c.c11));
            for (const int i : {2, 4}) {
                CHECK(K(i, i + 1) == Approx(c.c22).margin(1e-10 * EI / L));
                CHECK(K(i, i) - K(i, i + 1) == Approx(c.c21));
                CHECK(K(i + 1, i + 1) - K(i, i + 1) == Approx(c.c23));
            }
            CHECK(K.topLeftCorner(2, 2).norm() == Approx(std::hypot(c.c11, c.c12)));
            // 2 EI / L for (1, 1), and positive definite whatever the sign of c22
            const Matrix bending = K.block(2, 2, 2, 2);
            CHECK(bending.sum() / 2 == Approx(2 * EI / L));
            CHECK(Eigen::SelfAdjointEigenSolver<Matrix>(K).eigenvalues()(0) > 0);
        }
}

TEST_CASE("spring constants: c22 changes sign at delta = 1/2 - sqrt(1/12 + 1/lambda)", "[analytic]") {
    const double EI = 2, L = 1.5, lambda = 40, GA = lambda * EI / (L * L);
    const double zero = 0.5 - std::sqrt(1. / 12 + 1 / lambda);
    CHECK(spring_constants(EI, GA, 1, 1, L, zero).c22 == Approx(0).margin(1e-12));
    CHECK(spring_constants(EI, GA, 1, 1, L, zero - 0.02).c22 < 0);
    CHECK(spring_constants(EI, GA, 1, 1, L, zero + 0.02).c22 > 0);
}

TEST_CASE(
    "shear centre: forces through it do not twist an element, and the hinge line through it is not sheared by torsion",
    "[analytic]") {
    EngineeringSection section;
    section.mass = 1, section.EI_flap = 2, section.EI_edge = 3, section.GJ = 0.7, section.EA = 40;
    section.beta = 0.3;
    section.shear_centre = {0.05, -0.02};
    const double c = std::cos(0.3), s = std::sin(0.3);
    const Vec3 expected(0, 0.05 * c + 0.02 * s, 0.05 * s - 0.02 * c);
    const BeamLine line = uniform_beam(2, section);
    const ElementLine element(line, 0.5, 1.25);
    CHECK((shear_centre(element) - expected).norm() < 1e-15);
    const Mat6 F = joint_flexibility(ElementLine(line, 0.5, 1.25, expected), Hinges::symmetric(delta_gauss));
    for (Eigen::Index bending : {2, 3, 4, 5}) CHECK(std::abs(F(1, bending)) < 1e-15);
    // Linear along the element: its mean. A section that cannot be twisted has none.
    BeamLine falling = line;
    falling.section = [section](double x) {
        EngineeringSection at = section;
        at.beta = 0;
        at.shear_centre = {0.1 * x, 0};
        return at.section();
    };
    CHECK((shear_centre(ElementLine(falling, 0, 1)) - Vec3(0, 0.05, 0)).norm() < 1e-15);
    section.GJ = std::numeric_limits<double>::infinity();
    const BeamLine stiff = uniform_beam(2, section);
    CHECK(shear_centre(ElementLine(stiff, 0, 2)).isZero(0));
}

TEST_CASE("section: principal axes, shear and tension centre give the compliance written out by hand", "[analytic]") {
    EngineeringSection s;
    s.mass = 1, s.EA = 10, s.GJ = 4, s.EI_flap = 2, s.EI_edge = 5, s.GA_y = 7, s.GA_z = 8;
    s.shear_centre = {0.2, 0.1};
    s.tension_centre = {0.3, -0.4};
    const Mat6 S = s.section().compliance;
    // An axial force at the reference line bends by its moment about the tension centre.
    CHECK(S(0, 0) == Approx(1. / 10 + 0.4 * 0.4 / 2 + 0.3 * 0.3 / 5));
    CHECK(S(0, 4) == Approx(0.4 / 2));
    CHECK(S(0, 5) == Approx(0.3 / 5));
    // A shear force twists by its moment about the shear centre.
    CHECK(S(1, 3) == Approx(0.1 / 4));
    CHECK(S(2, 3) == Approx(-0.2 / 4));
    CHECK((S - S.transpose()).norm() < 1e-15);
    // A quarter turn exchanges the bending planes.
    s = {};
    s.mass = 1, s.EI_flap = 2, s.EI_edge = 5, s.beta = pi / 2, s.mass_centre = {0.6, 0}, s.j_flap = 0.1, s.j_edge = 0.7;
    const BeamSection turned = s.section();
    CHECK(turned.compliance(4, 4) == Approx(1. / 5));
    CHECK(turned.compliance(5, 5) == Approx(1. / 2));
    CHECK((turned.centre - Vec3(0, 0, 0.6)).norm() < 1e-15);
    CHECK((turned.J - Mat3(Vec3(0.8, 0.7, 0.1).asDiagonal())).norm() < 1e-15);
}
