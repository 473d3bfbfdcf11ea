// Cross sections: compliance and inertia in beam axes, tables of stations, tubes.
#include "elements/sections/tube.hpp"
#include "mbs/base/decompositions.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

EngineeringSection some_section() {
    EngineeringSection s;
    s.mass = 120;
    s.EA = 2e9, s.GJ = 3e7, s.EI_flap = 5e7, s.EI_edge = 2e8, s.GA_y = 4e8, s.GA_z = 3e8;
    s.j_flap = 4, s.j_edge = 11;
    return s;
}

}  // namespace

TEST_CASE("section: principal axes turned by beta couple bending about y and z", "[analytic]") {
    // M_y' = c My + s Mz, M_z' = -s My + c Mz; kappa by the transposed rotation.
    EngineeringSection e = some_section();
    e.beta = 0.3;
    const double c = std::cos(0.3), s = std::sin(0.3);
    const Mat6 S = e.section().compliance;
    CHECK(S(4, 4) == Approx(c * c / 5e7 + s * s / 2e8).epsilon(1e-14));
    CHECK(S(5, 5) == Approx(s * s / 5e7 + c * c / 2e8).epsilon(1e-14));
    CHECK(S(4, 5) == Approx(c * s * (1 / 5e7 - 1 / 2e8)).epsilon(1e-14));
    CHECK(S(1, 1) == Approx(c * c / 4e8 + s * s / 3e8).epsilon(1e-14));
    CHECK(S(1, 2) == Approx(c * s * (1 / 4e8 - 1 / 3e8)).epsilon(1e-14));
    CHECK(S(0, 0) == Approx(1 / 2e9).epsilon(1e-14));
    CHECK(S(3, 3) == Approx(1 / 3e7).epsilon(1e-14));
    CHECK(S.row(0).tail<5>().norm() == 0);
}

TEST_CASE("section: bending and extension are those of a bundle of stringers", "[analytic]") {
    // Plane sections: eps = eps0 + kappa_y z - kappa_z y; N, My, Mz summed over the stringers. The bundle's tension
    // centre and principal axes are then told to the section.
    Random random(3);
    Eigen::Matrix3d K = Eigen::Matrix3d::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
    Eigen::Vector2d first = Eigen::Vector2d::Zero();
    double EA = 0;
    for (int i = 0; i < 5; ++i) {
        const double stiffness = uniform(random, 1e6, 1e7), y = uniform(random, -0.4, 0.9),
                     z = uniform(random, -0.2, 0.3);
        const Vec3 strain(1, z, -y);  // by (eps0, kappa_y, kappa_z)
        K += stiffness * strain * strain.transpose();
        EA += stiffness;
        first += stiffness * Eigen::Vector2d(y, z);
        second += stiffness * Eigen::Vector2d(y, z) * Eigen::Vector2d(y, z).transpose();
    }
    const Eigen::Vector2d centre = first / EA;
    const Eigen::Matrix2d about_centre = second - EA * centre * centre.transpose();
    const Eigen::SelfAdjointEigenSolver<Matrix> principal{Matrix(about_centre)};
    const Eigen::Vector2d edge = principal.eigenvectors().col(1);  // y' along the greater extent
    EngineeringSection e;
    e.EA = EA;
    e.beta = std::atan2(edge(1), edge(0));
    e.EI_flap = principal.eigenvalues()(0);
    e.EI_edge = principal.eigenvalues()(1);
    const double c = std::cos(e.beta), s = std::sin(e.beta);
    e.tension_centre = {c * centre(0) + s * centre(1), -s * centre(0) + c * centre(1)};
    const Mat6 S = e.section().compliance;
    const std::vector<int> stretched{0, 4, 5};
    const Matrix own = S(stretched, stretched);
    CHECK((own * K - Eigen::Matrix3d::Identity()).norm() < 1e-12);
    CHECK(std::abs(own(0, 1)) > 1e-9);  // the offset couples
}

TEST_CASE("section: mass centre and inertia are those of four point masses", "[analytic]") {
    const double m = 30, a = 0.5, b = 0.2, beta = -0.4;
    const SectionOffset centre{-0.1, 0.03};
    EngineeringSection e;
    e.mass = 4 * m;
    e.beta = beta;
    e.mass_centre = centre;
    e.EI_flap = e.EI_edge = 1;
    e.j_edge = 2 * m * a * a;  // two masses at y' = +-a, two at z' = +-b
    e.j_flap = 2 * m * b * b;
    const BeamSection s = e.section();
    const Vec3 ey(0, std::cos(beta), std::sin(beta)), ez(0, -std::sin(beta), std::cos(beta));
    const Vec3 com = centre.y * ey + centre.z * ez;
    Mat3 J = Mat3::Zero();
    for (const Vec3& r : {Vec3(a * ey), Vec3(-a * ey), Vec3(b * ez), Vec3(-b * ez)})
        J += m * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
    CHECK((s.centre - com).norm() < 1e-15);
    CHECK((s.J - J).norm() < 1e-12 * J.norm());
    CHECK(s.mass == 120);
}

TEST_CASE("section: the compliance of any section is symmetric and positive", "[property]") {
    Random random(5);
    for (int i = 0; i < 20; ++i) {
        EngineeringSection e = some_section();
        e.beta = uniform(random, -2, 2);
        for (SectionOffset* offset : {&e.shear_centre, &e.tension_centre})
            *offset = {uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5)};
        const Mat6 S = e.section().compliance;
        CHECK((S - S.transpose()).norm() < 1e-15 * S.norm());
        const Vec6 d = S.diagonal().cwiseSqrt().cwiseInverse();
        const Mat6 scaled = d.asDiagonal() * S * d.asDiagonal();
        CHECK(Eigen::SelfAdjointEigenSolver<Matrix>(Matrix(scaled)).eigenvalues().minCoeff() > 0);
    }
}

TEST_CASE("section table: every column is kept at the stations and linear between them; infinite stays infinite",
          "[analytic]") {
    EngineeringSection a = some_section(), b = some_section();
    b.mass = 60, b.mass_centre = {-0.4, 0.2}, b.shear_centre.y = 0.1, b.tension_centre.z = 0.3, b.j_edge = 1,
    b.j_flap = 2;
    a.GA_y = b.GA_y = infinite;
    for (const Interpolation kind : {Interpolation::linear, Interpolation::log_linear_stiffness}) {
        const BeamTable table{"blade", {1, 3, 7}, {a, b, a}, kind};
        for (const auto& [x, part] : {std::pair{1.0, 0.0}, {2.0, 0.5}, {3.0, 1.0}, {6.0, 0.25}, {7.0, 0.0}}) {
            const EngineeringSection s = table.constants(x);
            CHECK(s.mass == Approx(120 - 60 * part).epsilon(1e-14));
            CHECK(s.mass_centre.y == Approx(-0.4 * part).epsilon(1e-14));
            CHECK(s.mass_centre.z == Approx(0.2 * part).epsilon(1e-14));
            CHECK(s.shear_centre.y == Approx(0.1 * part).epsilon(1e-14));
            CHECK(s.tension_centre.z == Approx(0.3 * part).epsilon(1e-14));
            CHECK(s.j_edge == Approx(11 - 10 * part).epsilon(1e-14));
            CHECK(s.j_flap == Approx(4 - 2 * part).epsilon(1e-14));
            CHECK(std::isinf(s.GA_y));
            CHECK(s.GA_z == Approx(3e8).epsilon(1e-14));
        }
    }
}

TEST_CASE("section table: its beam line counts from the first station", "[property]") {
    EngineeringSection a = some_section(), b = some_section();
    b.mass = 60;
    const BeamLine line = beam_line({"blade", {1, 3, 7}, {a, b, b}});
    CHECK(line.length == 6);
    CHECK(line.breaks == std::vector<double>{0, 2, 6});
    CHECK(line.name == "blade");
    CHECK(line.section(1).mass == Approx(90).epsilon(1e-14));
    CHECK(line.section(0).mass == 120);
    CHECK(line.section(6).mass == 60);
}

TEST_CASE("tube: an exact annulus of linear outer diameter, the wall in steps", "[analytic]") {
    TubeSpec spec;
    spec.length = 30, spec.diameter_base = 3, spec.diameter_top = 2;
    spec.wall_thickness = {0.03, 0.02, 0.01};
    spec.E = 2.1e11, spec.G = 8.1e10, spec.density = 7850, spec.shear_factor = 0.5;
    const BeamLine line = tube(spec, "tower");
    CHECK(line.breaks == std::vector<double>{0, 10, 20, 30});
    for (const auto& [x, wall] : {std::pair{0.0, 0.03}, {9.99, 0.03}, {10.01, 0.02}, {25.0, 0.01}, {30.0, 0.01}}) {
        const double R = 1.5 - 0.5 * x / 30, r = R - wall;
        const double A = pi * (R * R - r * r), I = pi / 4 * (std::pow(R, 4) - std::pow(r, 4));
        const BeamSection s = line.section(x);
        CHECK(s.mass == Approx(7850 * A).epsilon(1e-12));
        CHECK(s.compliance(0, 0) == Approx(1 / (2.1e11 * A)).epsilon(1e-12));
        CHECK(s.compliance(1, 1) == Approx(1 / (0.5 * 8.1e10 * A)).epsilon(1e-12));
        CHECK(s.compliance(3, 3) == Approx(1 / (8.1e10 * 2 * I)).epsilon(1e-12));
        CHECK(s.compliance(4, 4) == Approx(1 / (2.1e11 * I)).epsilon(1e-12));
        CHECK(s.J(2, 2) == Approx(7850 * I).epsilon(1e-12));
        CHECK(s.J(0, 0) == Approx(2 * 7850 * I).epsilon(1e-12));
    }
}
