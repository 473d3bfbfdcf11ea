// Curved beams of cardanic elements: each straight along its chord, fixed kinks between them.
#include "elements/cardan_beam.hpp"
#include "elements/reference_line.hpp"
#include "solvers/modes.hpp"
#include "tests/oracles/cosserat_rod.hpp"
#include "tests/oracles/quadrature.hpp"
#include "tests/oracles/root_finding.hpp"
#include "tests/support/catch.hpp"

#include <Eigen/LU>

using namespace cardan;

namespace {

constexpr double rigid = std::numeric_limits<double>::infinity();

// Starts along x and turns to +y.
ReferenceLine arc(double radius, double angle) {
    return ReferenceLine::curve(
        [radius](double t) { return Vec3(radius * std::sin(t), radius * (1 - std::cos(t)), 0); },
        [radius](double t) { return Vec3(radius * std::cos(t), radius * std::sin(t), 0); }, 0, angle);
}

// The 45-degree bend.                        [Bathe and Bolourchi, Int. J. Numer. Meth. Eng. 14 (1979) 961-986]
struct Bend {
    double GA = 5. / 6 * 5e6, GJ = 5e6 / 6;
    static constexpr double radius = 100, angle = pi / 4, EA = 1e7, EI = 1e7 / 12;

    BeamLine line() const {
        EngineeringSection s;
        s.mass = 1, s.EA = EA, s.GA_y = s.GA_z = GA, s.GJ = GJ, s.EI_flap = s.EI_edge = EI;
        s.j_flap = s.j_edge = 1. / 12;
        return along(uniform_beam(radius * angle, s), arc(radius, angle));
    }
    oracles::CosseratRod rod() const {
        oracles::CosseratRod rod;
        rod.length = radius * angle;
        rod.initial_curvature = [](double) { return Vec3(0, 0, 1 / radius); };
        rod.strain = oracles::linear_strain(Vec6((Vec6() << EA, GA, GA, GJ, EI, EI).finished()));
        return rod;
    }
};

CardanBeamOptions chords(int elements, CurvedFlexibility rule = CurvedFlexibility::chord, double delta = 1. / 6) {
    CardanBeamOptions options;
    options.elements = elements;
    options.delta = delta;
    options.extension = true;
    options.curved_flexibility = rule;
    return options;
}

struct Chain {
    Tree tree;
    ForceSet forces;
    FrameId tip;

    Chain(const BeamLine& line, const CardanBeamOptions& options)
        : tip(add_cardan_beam(tree, forces, Tree::base(), line, "beam", {"beam"}, options).tip()) {}
    Chain() = default;

    Pose<double> loaded(const Vec3& force) const {
        Vector q;
        for (double share : {0.5, 1.0}) {
            ForceSet loads = forces;
            loads.add_wrench({"tip force", tip, {share * force, Vec3::Zero()}, WrenchAxes::base});
            solvers::SteadyOptions options;
            options.initial = q;
            const System system(tree, loads);
            const solvers::SteadyState state = solvers::steady_state(system, -1, options);
            INFO(state.message);
            REQUIRE(state.converged);
            q = state.at.q;
            if (share == 1) {
                Workspace workspace(system.model);
                return pose(kinematics(system.model, q, workspace), tip);
            }
        }
        return {};
    }
    // [rotation; displacement] of the tip by [moment; force] there, base axes: J K^-1 J^T.
    Mat6 compliance() const {
        const System system(tree, forces);
        const auto n = system.model.size();
        const Vector zero = Vector::Zero(n);
        Workspace workspace(system.model);
        Matrix J(6, n);
        frame_jacobian(kinematics(system.model, zero, workspace), tip, J);
        const Matrix K = solvers::linearise(system, {zero, zero, zero, 0}).elastic;
        return J * K.fullPivLu().solve(Matrix(J.transpose()));
    }
};

Vec3 loaded_tip(const Bend& bend, const CardanBeamOptions& options, double force = 600) {
    return Chain(bend.line(), options).loaded({0, 0, force}).p;
}
Vec3 exact_tip(const oracles::CosseratRod& rod, double force = 600) {
    oracles::RodLoad load;
    load.force = Vec3(0, 0, force);
    return oracles::RodSolution(rod, load).tip().position;
}

double largest(const Vec3& v) {
    return v.cwiseAbs().maxCoeff();
}

// What becomes of a chain of cardanic elements of vanishing length. A shear strain tilts the middle body against the
// terminal ones, which carry the section axes, by a = gamma / (1 - 2 delta); the torsion turns about the tilted axis d
// and the bending about z about an axis that has followed the tilt about y:
//     1 + Gamma = 2 delta e1 + (1 - 2 delta + eps) d,   d = Ry(ay) Rz(az) e1,
//     kappa = kappa_x d + kappa_y e2 + kappa_z Ry(ay) e3,   ay = -gamma_z / (1 - 2 delta), az = gamma_y / (1 - 2
//     delta).
// The law is C^-1 g = (dGamma/dg)^T n + (dkappa/dg)^T m over g = (eps, gamma_y, gamma_z, kappa_x, kappa_y, kappa_z).
oracles::CosseratRod limit_of_elements(oracles::CosseratRod rod, double delta) {
    const auto law = rod.strain;
    rod.strain = [law, c = 1 / (1 - 2 * delta)](double s, const Vec6& forces) {
        const auto strains = [c](const Vec6& g, Mat6& D) {
            const double ay = -c * g(2), az = c * g(1), cy = std::cos(ay), sy = std::sin(ay);
            const double cz = std::cos(az), sz = std::sin(az);
            const Vec3 d(cy * cz, sz, -sy * cz), d_ay(-sy * cz, 0, -cy * cz), d_az(-cy * sz, cz, sy * sz);
            const Vec3 e3(sy, 0, cy), e3_ay(cy, 0, -sy);
            const double arm = 1 / c + g(0);
            D.setZero();
            D.col(0).head<3>() = d;
            D.col(1).head<3>() = arm * c * d_az;
            D.col(2).head<3>() = -arm * c * d_ay;
            D.col(1).tail<3>() = c * g(3) * d_az;
            D.col(2).tail<3>() = -c * (g(3) * d_ay + g(5) * e3_ay);
            D.col(3).tail<3>() = d;
            D(4, 4) = 1;
            D.col(5).tail<3>() = e3;
            Vec6 strain;
            strain << (1 - 1 / c) * Vec3::UnitX() + arm * d - Vec3::UnitX(),
                g(3) * d + g(4) * Vec3::UnitY() + g(5) * e3;
            return strain;
        };
        Vec6 g = law(s, forces), strain;
        Mat6 D;
        for (int i = 0; i < 40; ++i) {
            strain = strains(g, D);
            const Vec6 next = law(s, Vec6(D.transpose() * forces));
            const double change = (next - g).norm();
            g = next;
            if (change < 1e-16) break;
        }
        return strains(g, D);
    };
    return rod;
}

}  // namespace

TEST_CASE("curved beam: the 45-degree bend with few elements has the discrete values", "[published]") {
    // Discrete values of chord elements, delta = 1/6, another implementation.
    CHECK(largest(loaded_tip(Bend{}, chords(4)) - Vec3(47.14833, 15.65716, 53.36164)) < 1e-5);
    CHECK(largest(loaded_tip(Bend{}, chords(8)) - Vec3(47.14997, 15.66789, 53.44817)) < 1e-5);
}

TEST_CASE("curved beam: without shear flexibility the bend converges to the Cosserat rod with order 2", "[analytic]") {
    const Bend bend{.GA = rigid};
    const Vec3 exact = exact_tip(bend.rod());
    for (const CurvedFlexibility rule : {CurvedFlexibility::chord, CurvedFlexibility::curve}) {
        std::vector<double> error;
        for (int n : {4, 8, 16, 32}) error.push_back((loaded_tip(bend, chords(n, rule)) - exact).norm());
        CAPTURE(error);
        WARN("rule " << int(rule) << " " << error[0] << " " << error[1] << " " << error[2] << " " << error[3]);
        CHECK(std::log2(error[2] / error[3]) == Approx(2).margin(0.1));
    }
}

TEST_CASE("curved beam: with shear flexibility the bend converges to a rod whose twist axis is tilted by the shear",
          "[analytic]") {
    for (const double delta : {1. / 6, delta_gauss}) {
        const Bend bend{.GA = 5. / 6 * 5e6};
        const Vec3 limit = exact_tip(limit_of_elements(bend.rod(), delta)), exact = exact_tip(bend.rod());
        std::vector<double> error, to_exact;
        for (int n : {8, 16, 32, 64}) {
            const Vec3 tip = loaded_tip(bend, chords(n, CurvedFlexibility::chord, delta));
            error.push_back((tip - limit).norm());
            to_exact.push_back((tip - exact).norm());
        }
        WARN("limit - exact " << (limit - exact).transpose() << " limit " << limit.transpose());
        WARN("error " << error[0] << " " << error[1] << " " << error[2] << " " << error[3]);
        WARN("to exact " << to_exact[0] << " " << to_exact[1] << " " << to_exact[2] << " " << to_exact[3]);
        CHECK(std::log2(error[2] / error[3]) == Approx(2).margin(0.1));
    }
}

TEST_CASE("curved beam: the gap is proportional to the shear strain", "[analytic]") {
    // Taken between shear flexible and shear rigid elements, so that most of the discretisation error cancels.
    const auto gap = [](double GA, double GJ) {
        const Bend soft{.GA = GA, .GJ = GJ}, stiff{.GA = rigid, .GJ = GJ};
        return Vec3(loaded_tip(soft, chords(32)) - loaded_tip(stiff, chords(32)) - exact_tip(soft.rod()) +
                    exact_tip(stiff.rod()));
    };
    const auto limit_gap = [](double GA, double GJ) {
        const Bend soft{.GA = GA, .GJ = GJ};
        return Vec3(exact_tip(limit_of_elements(soft.rod(), 1. / 6)) - exact_tip(soft.rod()));
    };
    const double GA = 5. / 6 * 5e6;
    for (double GJ : {5e6 / 6, 5e7 / 6, 5e10 / 6})
        for (double f : {1., 0.5, 0.25, 0.1}) {
            WARN("GJ " << GJ << " GA x " << f << " gap " << gap(f * GA, GJ).transpose() << " limit "
                       << limit_gap(f * GA, GJ).transpose() << " norm*f " << gap(f * GA, GJ).norm() * f);
        }
}
