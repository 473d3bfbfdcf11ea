// Curved beams of cardanic elements: each straight along its chord, fixed kinks between them.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/elements/cardan_beam/rods.hpp"
#include "tests/oracles/quadrature.hpp"
#include "tests/oracles/tilted_rod.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// The 45-degree bend.                        [Bathe and Bolourchi, Int. J. Numer. Meth. Eng. 14 (1979) 961-986]
struct Bend {
    double GA = 5. / 6 * 5e6, GJ = 5e6 / 6;
    static constexpr double radius = 100, angle = pi / 4, EA = 1e7, EI = 1e7 / 12;

    oracles::TwistedRod twisted() const {
        const oracles::RodSection section{.mass = 1,
                                          .EA = EA,
                                          .GA_y = GA,
                                          .GA_z = GA,
                                          .GJ = GJ,
                                          .EI_y = EI,
                                          .EI_z = EI,
                                          .j_y = 1. / 12,
                                          .j_z = 1. / 12};
        return {.length = radius * angle,
                .section = [section](double) { return section; },
                .curvature = {0, 1 / radius},
                .steps = 256};
    }
    BeamLine line() const { return line_of(twisted()); }
    oracles::CosseratRod rod() const { return twisted().rod(); }
};

CardanBeamOptions chords(int elements, CurvedFlexibility rule = CurvedFlexibility::chord, double delta = sixth) {
    CardanBeamOptions options = all_free(elements, delta);
    options.curved_flexibility = rule;
    return options;
}

// The springs of the paper, which measure the joint coordinates whether or not shear tilts the bodies between them.
CardanBeamOptions plain_springs(int elements, double delta = sixth) {
    CardanBeamOptions options = chords(elements, CurvedFlexibility::chord, delta);
    options.hinge_law.rod_strains = false;
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
        Pose<double> reached;
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
            Workspace workspace(system.model);
            reached = pose(kinematics(system.model, q, workspace), tip);
        }
        return reached;
    }
    // [rotation; displacement] of the tip by [moment; force] there, base axes: J K^-1 J^T.
    Mat6 compliance() const {
        const System system(tree, forces);
        const auto n = system.model.size();
        const Vector zero = Vector::Zero(n);
        Workspace workspace(system.model);
        Matrix J(6, n);
        frame_jacobian(kinematics(system.model, zero, workspace), tip, J);
        const Matrix K = solvers::linearise(system, at_rest(zero)).elastic;
        return J * K.partialPivLu().solve(Matrix(J.transpose()));
    }
};

Vec3 loaded_tip(const Bend& bend, const CardanBeamOptions& options, const Vec3& force = {0, 0, 600}) {
    return Chain(bend.line(), options).loaded(force).p;
}
Vec3 exact_tip(const oracles::CosseratRod& rod, const Vec3& force = {0, 0, 600}) {
    oracles::RodLoad load;
    load.force = force;
    return oracles::RodSolution(rod, load).tip().position;
}

// [rotation; displacement] of the tip of the bend by [moment; force] there, fixed axes: Castigliano, 20 Gauss points.
Mat6 arc_compliance(const Bend& bend) {
    const auto place = [](double s) {
        const double t = s / Bend::radius;
        return Vec3(Bend::radius * std::sin(t), Bend::radius * (1 - std::cos(t)), 0);
    };
    const oracles::GaussRule rule = oracles::gauss_legendre(20);
    const double L = Bend::radius * Bend::angle;
    const Vec6 flexibility =
        (Vec6() << Bend::EA, bend.GA, bend.GA, bend.GJ, Bend::EI, Bend::EI).finished().cwiseInverse();
    Mat6 C = Mat6::Zero();
    for (Eigen::Index i = 0; i < rule.point.size(); ++i) {
        const double s = L / 2 * (1 + rule.point[i]);
        const Mat3 turn = rot_z(s / Bend::radius).transpose();
        Mat6 B = Mat6::Zero();  // section forces [force; moment] by [moment; force]
        B.topRightCorner<3, 3>() = B.bottomLeftCorner<3, 3>() = turn;
        B.bottomRightCorner<3, 3>() = turn * skew<double>(place(L) - place(s));
        C += L / 2 * rule.weight[i] * B.transpose() * flexibility.asDiagonal() * B;
    }
    return C;
}

// Tapered, principal axes that turn, centres off the line.
BeamLine twisted_sections(double length) {
    BeamLine line{length, {}, {}, "blade"};
    line.section = [length](double x) {
        const double t = 1 - 0.6 * x / length;
        EngineeringSection s;
        s.mass = 3 * t, s.j_flap = 0.02 * t, s.j_edge = 0.1 * t;
        s.EA = 900 * t, s.GJ = 8 * t, s.EI_flap = 6 * t, s.EI_edge = 30 * t, s.GA_y = 300 * t, s.GA_z = 200 * t;
        s.beta = 0.2 * t;
        s.mass_centre = {0.1 * t, 0.03}, s.shear_centre = {0.05, -0.02 * t}, s.tension_centre = {-0.04 * t, 0.03};
        return s.section();
    };
    return line;
}

}  // namespace

TEST_CASE("curved beam: the 45-degree bend with few elements has the discrete values", "[discrete]") {
    // Discrete values of chord elements with plain springs, delta = 1/6, another implementation.
    CHECK(max_abs(loaded_tip(Bend{}, plain_springs(4)) - Vec3(47.14833, 15.65716, 53.36164)) < 1e-5);
    CHECK(max_abs(loaded_tip(Bend{}, plain_springs(8)) - Vec3(47.14997, 15.66789, 53.44817)) < 1e-5);
}

TEST_CASE("curved beam: without shear flexibility the bend converges to the Cosserat rod with order 2", "[analytic]") {
    // Distance of the tip from the Cosserat rod's. Elements that know their curve are far better at small deflections;
    // where the tip moves by half the length and more, those along the chord are.
    using enum CurvedFlexibility;
    const Bend bend{.GA = shear_rigid};
    const auto errors = [&](double force, CurvedFlexibility rule, double delta) {
        const Vec3 exact = exact_tip(bend.rod(), {0, 0, force});
        std::vector<double> e;
        for (int n : {4, 8, 16}) e.push_back((loaded_tip(bend, chords(n, rule, delta), {0, 0, force}) - exact).norm());
        return e;
    };
    struct Row {
        double force, delta, on_chord, on_curve;  // N = 8
    };
    for (const Row& row : {Row{6, sixth, 1.348e-3, 2.70e-5}, Row{60, sixth, 1.267e-2, 2.62e-3},
                           Row{300, sixth, 2.823e-2, 3.84e-2}, Row{600, sixth, 3.149e-2, 6.96e-2},
                           Row{6, delta_gauss, 1.348e-3, 3.10e-5}, Row{600, delta_gauss, 5.39e-2, 7.82e-2}}) {
        const auto on_chord = errors(row.force, chord, row.delta), on_curve = errors(row.force, curve, row.delta);
        CAPTURE(row.force, row.delta, on_chord, on_curve);
        CHECK(on_chord[1] < 1.01 * row.on_chord);
        CHECK(on_curve[1] < 1.01 * row.on_curve);
        CHECK((on_curve[1] < on_chord[1]) == (row.force < 100));
        CHECK(std::log2(on_chord[1] / on_chord[2]) == Approx(2).margin(0.06));
        CHECK(std::log2(on_curve[1] / on_curve[2]) == Approx(2).margin(0.06));
    }
}

TEST_CASE("curved beam: with shear flexibility the bend converges to the Cosserat rod, not to one with tilted joints",
          "[analytic]") {
    // Ten and a hundred times softer in shear than steel. The shear that an element is told by its hinge moments is
    // that of M', without what the torque adds to the moments along a bent axis: an error that goes as the elements
    // become shorter than sqrt(12 EI / GA), 5 m and 16 m here (64 elements: 1.2 m). What is of second order in the tilt
    // stays: a hundredth of its effect in the softer beam.
    for (const double softer : {10., 100.})
        for (const double delta : {sixth, delta_gauss}) {
            const Bend bend{.GA = Bend{}.GA / softer};
            const Vec3 exact = exact_tip(bend.rod());
            const auto error = [&](const CardanBeamOptions& options) {
                return (loaded_tip(bend, options) - exact).norm();
            };
            const double tilted = (exact_tip(oracles::limit_of_elements(bend.rod(), delta)) - exact).norm();
            const double n32 = error(chords(32, CurvedFlexibility::chord, delta)),
                         n64 = error(chords(64, CurvedFlexibility::chord, delta));
            CAPTURE(softer, delta, tilted, n32, n64, error(plain_springs(64, delta)));
            if (softer == 10) CHECK(std::log2(n32 / n64) > 1.5);
            CHECK(n64 < (softer == 10 ? 0.06 : 0.015) * tilted);
            CHECK(error(plain_springs(64, delta)) == Approx(tilted).epsilon(0.05));
        }
}

TEST_CASE("curved beam: plain springs converge to a rod whose joints are tilted by the shear", "[analytic][discrete]") {
    const Bend bend;
    for (const double delta : {sixth, delta_gauss}) {
        const Vec3 limit = exact_tip(oracles::limit_of_elements(bend.rod(), delta));
        std::vector<Vec3> tip;
        for (int n : {16, 32, 64}) tip.push_back(loaded_tip(bend, plain_springs(n, delta)));
        CAPTURE(delta, limit);
        CHECK(std::log2((tip[0] - limit).norm() / (tip[1] - limit).norm()) == Approx(2).margin(0.03));
        CHECK(std::log2((tip[1] - limit).norm() / (tip[2] - limit).norm()) == Approx(2).margin(0.01));
        // Extrapolated with that order they agree far closer than the limit lies off the Cosserat rod.
        CHECK(max_abs((4 * tip[2] - tip[1]) / 3 - limit) < 5e-6);
    }
    // 256 elements, another implementation: as far from the limit as order 2 says. The Cosserat rod ends 2e-3 away.
    const Vec3 many(47.14961, 15.68269, 53.47594), limit = exact_tip(oracles::limit_of_elements(bend.rod(), sixth));
    CHECK(max_abs(many - limit) < 4e-5);
    CHECK((exact_tip(bend.rod()) - limit).norm() == Approx(2.1e-3).epsilon(0.02));
}

TEST_CASE("curved beam: the distance of that rod from the Cosserat rod is proportional to the shear strain",
          "[analytic]") {
    // Elements: taken between shear flexible and shear rigid ones, so that most of the discretisation error cancels.
    const auto of_elements = [](double GA, double GJ) {
        const Bend soft{.GA = GA, .GJ = GJ}, stiff{.GA = shear_rigid, .GJ = GJ};
        return Vec3(loaded_tip(soft, plain_springs(8)) - loaded_tip(stiff, plain_springs(8)) - exact_tip(soft.rod()) +
                    exact_tip(stiff.rod()));
    };
    const auto of_limit = [](double GA, double GJ, const Vec3& force) {
        const Bend soft{.GA = GA, .GJ = GJ};
        return Vec3(exact_tip(oracles::limit_of_elements(soft.rod(), sixth), force) - exact_tip(soft.rod(), force));
    };
    // Not a matter of torsion alone: a torsionally rigid rod has it too, from bending about z.
    const double GA = Bend{}.GA;
    for (const double GJ : {Bend{}.GJ, 1e4 * Bend{}.GJ}) {
        const Vec3 gap = of_elements(GA, GJ), limit = of_limit(GA, GJ, {0, 0, 600});
        CAPTURE(GJ, gap, limit);
        CHECK((gap - limit).norm() < 0.06 * limit.norm());
        CHECK((of_elements(GA / 4, GJ) / 4 - gap).norm() < 0.01 * gap.norm());
        CHECK((of_limit(GA / 10, GJ, {0, 0, 600}) / 10 - limit).norm() < 0.01 * limit.norm());
    }
    // Bent in its plane it turns about neither of the tilted axes: nothing to first order.
    for (const Vec3& force : {Vec3(0, -600, 0), Vec3(600, 0, 0)}) {
        CHECK(of_limit(GA, Bend{}.GJ, force).norm() < 1e-6);
        CHECK(of_limit(GA / 10, Bend{}.GJ, force).norm() > 50 * of_limit(GA, Bend{}.GJ, force).norm());
    }
}

TEST_CASE("curved beam: one element on the curve has the exact tip compliance of an arc, along the chord order 2",
          "[analytic]") {
    Bend bend{.GA = 2e3};  // as much from shear as from bending
    const BeamLine line = bend.line();
    const Mat6 exact = arc_compliance(bend);
    for (const double delta : {0.1, sixth, delta_gauss})
        for (int n : {1, 2, 5})
            CHECK(scaled_difference(Chain(line, chords(n, CurvedFlexibility::curve, delta)).compliance(), exact) <
                  1e-10);
    const auto error = [&](int n) { return scaled_difference(Chain(line, chords(n)).compliance(), exact); };
    CHECK(error(1) > 0.3);
    CHECK(std::log2(error(8) / error(16)) == Approx(2).margin(0.05));
}

TEST_CASE("curved beam: a polyline with element ends at its kinks is a chain of straight beams welded at angles",
          "[crosscheck]") {
    const std::vector<Vec3> points{{0, 0, 0}, {1.5, 0, 0}, {2.2, 0.6, 0.3}, {3, 0.5, 1.1}};
    const ReferenceLine axis = ReferenceLine::through(points, LineShape::polyline);
    const BeamLine sections = twisted_sections(axis.length());
    CardanBeamOptions options = chords(1, CurvedFlexibility::curve, delta_gauss);
    options.boundaries = axis.stations();
    const Chain one(along(sections, axis), options);

    Chain welded;
    options.boundaries = {};
    FrameId at = Tree::base();
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double start = axis.stations()[i], length = axis.stations()[i + 1] - start;
        const Mat3 inboard = i == 0 ? Mat3(Mat3::Identity()) : axis.pose(start - 0.1).R;
        const std::string name = "piece " + std::to_string(i);
        at = welded.tree.add_frame(at, Placement::rotation(inboard.transpose() * axis.pose(start).R), name + " root");
        BeamLine piece = sections;
        piece.length = length;
        piece.section = [sections, start](double x) { return sections.section(start + x); };
        at = add_cardan_beam(welded.tree, welded.forces, at, piece, name, {name}, options).tip();
    }
    welded.tip = at;
    CHECK(scaled_difference(one.compliance(), welded.compliance()) < 1e-12);
    const Pose<double> a = one.loaded({1, -2, 3}), b = welded.loaded({1, -2, 3});
    CHECK((a.p - b.p).norm() < 1e-12);
    CHECK((a.R - b.R).norm() < 1e-12);
    CHECK((a.p - points.back()).norm() > 0.3);
}

TEST_CASE("curved beam: on a straight reference line it has the frequencies of the straight beam", "[crosscheck]") {
    const BeamLine plain = twisted_sections(3);
    const std::vector<double> expected = clamped_frequencies(plain, chords(3));
    for (const LineShape shape : {LineShape::polyline, LineShape::spline}) {
        const auto line = ReferenceLine::through({{0, 0, 0}, {0.5, 0, 0}, {1.6, 0, 0}, {2, 0, 0}, {3, 0, 0}}, shape);
        for (const CurvedFlexibility rule : {CurvedFlexibility::curve, CurvedFlexibility::chord}) {
            const std::vector<double> omega = clamped_frequencies(along(plain, line), chords(3, rule));
            for (std::size_t i = 0; i < omega.size(); ++i) CHECK(omega[i] == Approx(expected[i]).epsilon(1e-10));
        }
    }
}

TEST_CASE("curved beam: a pre-bent and swept blade has the mass, centre and inertia tensor of its curve",
          "[analytic]") {
    std::vector<Vec3> points;
    for (double x : {0., 3., 8., 14., 19., 24., 27., 30.})
        points.emplace_back(x, -0.002 * x * x, -0.02 * x + 1e-4 * x * x * x);
    const auto axis = ReferenceLine::through(points, LineShape::spline);
    const BeamLine line = along(twisted_sections(axis.length()), axis);
    RigidInertia exact;
    const oracles::GaussRule rule = oracles::gauss_legendre(10);
    for (std::size_t i = 0; i + 1 < axis.stations().size(); ++i) {
        const double a = axis.stations()[i], b = axis.stations()[i + 1];
        for (Eigen::Index k = 0; k < rule.point.size(); ++k) {
            const double s = (a + b) / 2 + (b - a) / 2 * rule.point[k], ds = (b - a) / 2 * rule.weight[k];
            const BeamSection section = line.section(s);
            exact = exact + RigidInertia{ds * section.mass, section.centre, ds * section.J}.in(line.pose(s));
        }
    }
    BeamLine rigid = line;
    rigid.section = [&line](double s) {
        BeamSection section = line.section(s);
        section.compliance.middleRows<2>(1).setZero();
        section.compliance.middleCols<2>(1).setZero();
        return section;
    };
    for (int n : {1, 4}) {
        for (const bool shear : {false, true}) {
            const Chain chain(shear ? line : rigid, chords(n));
            const Model model(chain.tree);
            Workspace workspace(model);
            const auto kin = kinematics(model, Vector::Zero(model.size()), workspace);
            RigidInertia total;
            for (const Tree::Piece& piece : chain.tree.pieces()) {
                const auto at = pose(kin, piece.body < 0 ? Tree::base() : entry(chain.tree.bodies(), piece.body).frame);
                total = total + piece.inertia.in({at.R, at.p});
            }
            CAPTURE(n, shear);
            CHECK(total.mass == Approx(exact.mass).epsilon(1e-13));
            CHECK((total.com - exact.com).norm() < 1e-13 * line.length);
            // Flexible in shear, first moments across stand on the end bodies: products x y are good to order h^2.
            CHECK((total.J - exact.J).norm() < (shear ? 0.01 / (n * n) : 1e-13) * exact.J.norm());
            CHECK((pose(kin, chain.tip).p - points.back()).norm() < 1e-10);
        }
    }
}

TEST_CASE("curved beam: a clamped quarter circle vibrates like the arc, in and out of its plane", "[analytic]") {
    const oracles::VibratingArc oracle{.radius = 1,
                                       .angle = pi / 2,
                                       .mass = 1,
                                       .EA = 1e4,
                                       .GJ = 0.7,
                                       .EI_y = 1,
                                       .EI_z = 1.5,
                                       .J_y = 2e-3,
                                       .J_z = 3e-3};
    EngineeringSection s;
    s.mass = 1, s.EA = 1e4, s.GJ = 0.7, s.EI_flap = 1, s.EI_edge = 1.5, s.j_flap = 2e-3, s.j_edge = 3e-3;
    const std::vector<double> exact = oracle.frequencies(6);
    const BeamLine line = along(uniform_beam(pi / 2, s), arc(1, pi / 2));
    const auto errors = [&](CurvedFlexibility rule, int n) {
        const std::vector<double> omega = clamped_frequencies(line, chords(n, rule, delta_gauss));
        std::vector<double> e;
        for (std::size_t i = 0; i < 6; ++i) e.push_back(omega[i] / exact[i] - 1);
        return e;
    };
    const auto on_curve = errors(CurvedFlexibility::curve, 4), on_chord = errors(CurvedFlexibility::chord, 4);
    CAPTURE(exact, on_curve, on_chord);
    const std::array<double, 3> curve_bound{2e-5, 5e-5, 1e-3}, chord_bound{0.017, 0.0085, 0.0185};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(std::abs(on_curve[i]) < curve_bound[i]);
        CHECK(std::abs(on_chord[i]) < chord_bound[i]);
    }
    const auto chord_8 = errors(CurvedFlexibility::chord, 8), chord_16 = errors(CurvedFlexibility::chord, 16);
    const auto curve_8 = errors(CurvedFlexibility::curve, 8), curve_16 = errors(CurvedFlexibility::curve, 16);
    for (std::size_t i = 0; i < 6; ++i) {
        CHECK(std::abs(curve_16[i]) < 5e-4);
        CHECK(std::log2(chord_8[i] / chord_16[i]) == Approx(2).margin(0.1));
        CHECK(std::abs(curve_8[i]) < std::abs(chord_8[i]));
    }
}
