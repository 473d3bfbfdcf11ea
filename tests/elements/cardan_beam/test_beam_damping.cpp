// Structural damping of beams: complex modes of clamped beams, and the damping matrix itself.
#include "elements/cardan_beam/single_beam.hpp"
#include "elements/sections/beam_line.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/oracles/quadrature.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

enum Direction : std::size_t { extension, torsion, bending_y, bending_z };

// Four families of frequencies well apart from each other.
EngineeringSection plain_section() {
    EngineeringSection s;
    s.mass = 20, s.j_flap = 0.3, s.j_edge = 0.9;
    s.EA = 4e8, s.GJ = 3e5, s.EI_flap = 1e6, s.EI_edge = 5e6;
    return s;
}

// Taper, twist inside the element, offsets, shear.
BeamLine general_line(double length) {
    return {length,
            {},
            [length](double x) {
                const double t = 1 - 0.6 * x / length;
                EngineeringSection s = plain_section();
                s.mass *= t, s.j_flap *= t, s.j_edge *= t;
                s.EA *= t, s.GJ *= t * t, s.EI_flap *= t * t * t, s.EI_edge *= t * t;
                s.GA_y = 3e7 * t, s.GA_z = 2e7 * t;
                s.beta = 0.2 + 0.5 * x / length;
                s.mass_centre = {-0.05, 0.02}, s.shear_centre = {0.07 * t, -0.02}, s.tension_centre = {-0.05, 0.03};
                return s.section();
            },
            "general"};
}

// Every coupling: random positive definite, scaled like a blade.
BeamLine coupled_line(Random& random, double length) {
    const auto any = [&] {
        const Mat6 A = Mat6::NullaryExpr([&] { return uniform(random, -1, 1); });
        const Vec6 d = (Vec6() << 4e8, 3e7, 2e7, 3e5, 1e6, 5e6).finished().cwiseSqrt();
        return Mat6(d.asDiagonal() * Mat6(A * A.transpose() / 3 + 0.5 * Mat6::Identity()) * d.asDiagonal());
    };
    const Mat6 K = any();
    EngineeringSection inertia = plain_section();
    inertia.mass_centre = {-0.1, 0.05}, inertia.GA_y = inertia.GA_z = 1;
    const Mat6 M = section_matrices(inertia.section()).mass;
    return matrix_line("coupled", {0, length}, {{K, M}, {K + 0.3 * any(), M}});
}

CardanBeamOptions damped(int elements, const BeamDamping& damping, bool with_extension = true) {
    CardanBeamOptions options = all_free(elements);
    options.extension = with_extension, options.damping = damping;
    return options;
}

struct Clamped {
    solvers::Linearisation lin;
    std::vector<solvers::Mode> modes;
    std::vector<Direction> direction;  // of every mode: where most of its elastic energy is
    Matrix J;                          // of the tip, displacement first

    double omega(std::size_t i) const { return std::abs(modes[i].eigenvalue); }
    double ratio(std::size_t i) const { return modes[i].damping_ratio(); }
    // Frequency and ratio of the nth mode (from 0) of a direction.
    std::pair<double, double> family(Direction wanted, int n) const {
        for (std::size_t i = 0; i < modes.size(); ++i)
            if (direction[i] == wanted && n-- == 0) return {omega(i), ratio(i)};
        throw std::runtime_error("no such mode");
    }
};

Clamped clamp(const BeamLine& line, const CardanBeamOptions& options, const RigidInertia& at_tip = {}) {
    Tree tree;
    ForceSet forces;
    const CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), line, "beam", {"beam"}, options);
    if (!at_tip.is_massless()) tree.weld(beam.tip(), at_tip);
    const System system(tree, forces);
    const auto n = system.model.size();
    const Vector zero = Vector::Zero(n);
    Clamped result{solvers::linearise(system, at_rest(zero)), {}, {}, Matrix(6, n)};
    const auto second_order = solvers::restrict_to(result.lin, system.model.coordinates().free());
    result.modes = solvers::modes(second_order);
    for (const solvers::Mode& mode : result.modes) {
        const Vector share = solvers::energy_by_row(second_order, mode);
        std::array<double, 4> energy{};
        for (const CardanBeam::Element& element : beam.elements)
            for (std::size_t i = 0; i < element.bodies.size(); ++i) {
                const auto kind = static_cast<std::size_t>(element.kinds[i]);  // u, phi, ay1, ay2, az1, az2
                energy[kind < 2 ? kind : 1 + kind / 2] += share(system.model.index(element.bodies[i]));
            }
        const auto most = std::max_element(energy.begin(), energy.end()) - energy.begin();
        result.direction.push_back(static_cast<Direction>(most));
    }
    Workspace workspace(system.model);
    Matrix J(6, n);
    frame_jacobian(kinematics(system.model, zero, workspace), beam.tip(), J);
    result.J << J.bottomRows(3), J.topRows(3);
    return result;
}

double relative(const Matrix& A, const Matrix& B) {
    const Vector d = B.diagonal().cwiseSqrt().cwiseInverse();
    return (d.asDiagonal() * (A - B) * d.asDiagonal()).cwiseAbs().maxCoeff();
}

BeamDamping by_direction(const std::array<double, 6>& time_constants) {
    BeamDamping damping;
    damping.time_constants = time_constants;
    return damping;
}

}  // namespace

TEST_CASE("beam damping: a ratio at a frequency holds there and is proportional to the frequency elsewhere",
          "[analytic]") {
    // D = tau K: zeta = tau omega / 2 in every mode.
    Random random(31);
    for (const BeamLine& line : {general_line(10), coupled_line(random, 10)}) {
        const double f = clamp(line, damped(3, {})).omega(1) / (2 * pi);
        const Clamped beam = clamp(line, damped(3, BeamDamping::ratio_at(0.004, f)));
        CHECK(beam.ratio(1) == Approx(0.004).epsilon(1e-8));
        for (std::size_t i = 0; i < 10; ++i)
            CHECK(beam.ratio(i) == Approx(0.004 * beam.modes[i].natural_hz() / f).epsilon(1e-8));
    }
}

TEST_CASE("beam damping: Rayleigh's is zeta = alpha / (2 omega) + beta omega / 2", "[analytic]") {
    Random random(32);
    const double alpha = 0.7, beta = 2e-5;
    for (const BeamLine& line : {general_line(10), coupled_line(random, 10)})
        for (const bool with_extension : {true, false}) {
            const Clamped beam = clamp(line, damped(3, BeamDamping::rayleigh(alpha, beta), with_extension));
            const Clamped undamped = clamp(line, damped(3, {}, with_extension));
            for (std::size_t i = 0; i < 10; ++i) {
                const double omega = undamped.omega(i);
                CHECK(beam.ratio(i) == Approx(alpha / (2 * omega) + beta * omega / 2).epsilon(1e-8));
                CHECK(beam.omega(i) == Approx(omega).epsilon(1e-9));
            }
        }
}

TEST_CASE("beam damping: every direction has its own coefficient, zeta = tau omega / 2, extension free or condensed",
          "[analytic]") {
    const std::array<double, 6> tau{3e-6, 0.1, 0.2, 1e-5, 4e-5, 7e-5};  // shear rigid: the second and third do nothing
    for (const bool with_extension : {true, false}) {
        const Clamped beam = clamp(uniform_beam(10, plain_section()), damped(4, by_direction(tau), with_extension));
        const std::array<double, 4> own{tau[0], tau[3], tau[4], tau[5]};
        for (const Direction direction : {extension, torsion, bending_y, bending_z}) {
            if (direction == extension && !with_extension) continue;
            for (const int n : {0, 1, 2}) {
                const auto [omega, ratio] = beam.family(direction, n);
                CHECK(ratio == Approx(own[direction] * omega / 2).epsilon(1e-8));
            }
        }
    }
    // The families are what they are called: first torsion near pi / (2 L) sqrt(GJ / j).
    const Clamped beam = clamp(uniform_beam(10, plain_section()), damped(4, {}));
    CHECK(beam.family(torsion, 0).first == Approx(pi / 20 * std::sqrt(3e5 / 1.2)).epsilon(0.02));
    CHECK(beam.family(extension, 0).first == Approx(pi / 20 * std::sqrt(4e8 / 20)).epsilon(0.02));
}

TEST_CASE("beam damping: coefficients go with the section's own axes: a turned beam has the same eigenvalues",
          "[property]") {
    const BeamDamping damping = by_direction({3e-6, 2e-5, 8e-5, 1e-5, 4e-5, 7e-5});
    EngineeringSection s = plain_section();
    s.GA_y = 3e6, s.GA_z = 1e6;
    s.mass_centre = {-0.1, 0.05}, s.shear_centre = {0.1, 0.02}, s.tension_centre = {-0.03, 0.04};
    const Clamped straight = clamp(uniform_beam(10, s), damped(3, damping));
    for (const double beta : {0.4, -1.1, pi / 2}) {
        s.beta = beta;
        const Clamped turned = clamp(uniform_beam(10, s), damped(3, damping));
        for (std::size_t i = 0; i < 12; ++i) {
            CHECK(turned.omega(i) == Approx(straight.omega(i)).epsilon(1e-9));
            CHECK(turned.ratio(i) == Approx(straight.ratio(i)).epsilon(1e-8));
        }
    }
}

TEST_CASE("beam damping: equal coefficients are the scalar law D = tau K, also of a coupled section", "[property]") {
    Random random(33);
    for (int trial = 0; trial < 5; ++trial) {
        const BeamLine line = coupled_line(random, 10);
        const double tau = 2e-5;
        const Mat6 S = line.section(3).compliance;
        CHECK(relative(dissipation(line.section(3), {tau, tau, tau, tau, tau, tau}), tau * S) < 1e-12);
        // Almost equal: the integral of the dissipation, not the shortcut.
        const Clamped beam = clamp(line, damped(2, by_direction({tau, tau, tau, tau, tau * (1 + 1e-14), tau})));
        CHECK(relative(beam.lin.damping, tau * beam.lin.elastic) < 1e-10);
    }
}

TEST_CASE("beam damping: a tip load that changes is dissipated as by the sections of the continuum", "[analytic]") {
    // Power Fdot^T C Fdot by section force rates X Fdot: C = int X^T S tau^1/2 S^-1 tau^1/2 S X dx in the section's
    // axes, 30 Gauss points; in the tree (J K^-1) D (J K^-1)^T. Without extension the loads but N.
    const oracles::GaussRule rule = oracles::gauss_legendre(30);
    const std::array<double, 6> tau{3e-6, 2e-5, 8e-5, 1e-5, 4e-5, 7e-5};
    const Vec6 root = Eigen::Map<const Vec6>(tau.data()).cwiseSqrt();
    const double L = 10;
    Random random(34);
    for (const BeamLine& line : {general_line(L), coupled_line(random, L)}) {
        Mat6 exact = Mat6::Zero();
        for (Eigen::Index i = 0; i < rule.point.size(); ++i) {
            const double x = L / 2 * (1 + rule.point[i]), arm = L - x;
            const BeamSection section = line.section(x);
            Mat6 X = Mat6::Identity(), turn = Mat6::Zero();
            X(4, 2) = -arm, X(5, 1) = arm;
            turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = rot_x(section.beta);
            const Mat6 S = turn.transpose() * section.compliance * turn;
            const Vec6 d = S.diagonal().cwiseSqrt();
            const Mat6 unit = d.cwiseInverse().asDiagonal() * S * d.cwiseInverse().asDiagonal();
            const Mat6 strain = unit * d.asDiagonal() * turn.transpose() * X;  // scaled, by tip load
            const Mat6 loss = root.asDiagonal() * strain;
            exact += L / 2 * rule.weight[i] * loss.transpose() * unit.partialPivLu().solve(loss);
        }
        for (const int elements : {1, 3}) {
            const Clamped full = clamp(line, damped(elements, by_direction(tau)));
            const Matrix flex = full.J * full.lin.elastic.inverse();
            CHECK(relative(flex * full.lin.damping * flex.transpose(), exact) < 1e-10);
            const Clamped condensed = clamp(line, damped(elements, by_direction(tau), false));
            const Matrix five = condensed.J.bottomRows(5) * condensed.lin.elastic.inverse();
            CHECK(relative(five * condensed.lin.damping * five.transpose(), exact.bottomRightCorner<5, 5>()) < 1e-10);
        }
    }
}

TEST_CASE("beam damping: it never adds energy, whatever the coefficients", "[property]") {
    Random random(35);
    for (int trial = 0; trial < 12; ++trial) {
        std::array<double, 6> tau{};
        for (double& t : tau) t = uniform(random, 0, 1) < 0.4 ? 0 : std::pow(10, uniform(random, -6, -3));
        const BeamLine line = trial % 2 ? general_line(10) : coupled_line(random, 10);
        const Clamped beam = clamp(line, damped(2, by_direction(tau), trial % 3 != 0));
        const Matrix& D = beam.lin.damping;
        CHECK((D - D.transpose()).norm() <= 1e-15 * D.norm());
        const Vector d = beam.lin.elastic.diagonal().cwiseSqrt().cwiseInverse();
        const Vector loss =
            Eigen::SelfAdjointEigenSolver<Matrix>(Matrix(d.asDiagonal() * D * d.asDiagonal())).eigenvalues();
        CHECK(loss(0) >= -1e-12 * loss(loss.size() - 1));
        for (const solvers::Mode& mode : beam.modes) CHECK(mode.damping_ratio() > -1e-10);
    }
}

TEST_CASE("beam damping: directions without a coefficient beside offsets and couplings dissipate nothing",
          "[property]") {
    EngineeringSection section = plain_section();
    section.tension_centre = {0.02, 0.01}, section.shear_centre = {-0.01, 0.03}, section.beta = 0.2;
    for (const std::array<double, 6>& tau :
         {std::array<double, 6>{0, 0, 0, 1e-3, 1e-3, 1e-3}, {0, 0, 0, 0, 1e-3, 0}, {1e-3, 0, 0, 0, 0, 0}})
        CHECK_NOTHROW(clamped_beam(uniform_beam(2, section), damped(2, by_direction(tau))));
}

TEST_CASE("beam damping: shear coefficients damp by the share of shear in the energy of the mode", "[crosscheck]") {
    // First order in tau: zeta = tau omega / 2 times the share, which is d ln omega^2 / d ln GA (differenced).
    EngineeringSection s = plain_section();
    s.GA_y = 3e5, s.GA_z = 1e5;
    const auto omega_with = [&](double factor, Direction direction) {
        EngineeringSection changed = s;
        (direction == bending_z ? changed.GA_y : changed.GA_z) *= factor;
        return clamp(uniform_beam(10, changed), damped(4, {})).family(direction, 0).first;
    };
    for (const auto& [direction, shear] : {std::pair{bending_z, 1}, {bending_y, 2}}) {
        const double share = std::log(omega_with(1 + 1e-3, direction) / omega_with(1 - 1e-3, direction)) / 1e-3;
        CHECK(share > 0.1);
        double last = 0;
        for (const double tau : {1e-5, 2e-5, 4e-5, 1e-4, 3e-4}) {
            std::array<double, 6> constants{};
            entry(constants, shear) = tau;
            const Clamped beam = clamp(uniform_beam(10, s), damped(4, by_direction(constants)));
            const auto [omega, ratio] = beam.family(direction, 0);
            CHECK(ratio > last);
            CHECK(ratio == Approx(tau * omega / 2 * share).epsilon(1e-3));
            CHECK(std::abs(beam.family(direction == bending_z ? bending_y : bending_z, 0).second) < 1e-10);
            last = ratio;
        }
    }
}

TEST_CASE("beam damping: a rigid direction beside the reference line leaves the others their own coefficient",
          "[analytic]") {
    // Inextensible about an offset tension centre, shear rigid about an offset shear centre: only bending and torsion
    // have flexibility of their own: S = sum of s_i s_i^T / S_ii over the rows of torsion and bending, G the same with
    // tau_i. With a small offset the modes are those without: zeta = tau omega / 2.
    const std::array<double, 6> tau{0, 0, 0, 1e-5, 4e-5, 7e-5};
    for (const double offset : {0.0, 1e-6, 0.2}) {
        EngineeringSection s = plain_section();
        s.EA = infinite;
        s.tension_centre = {offset, -offset / 2}, s.shear_centre = {-offset / 3, offset};
        const Mat6 S = s.section().compliance;
        Mat6 G = Mat6::Zero();
        for (const int i : {3, 4, 5}) G += entry(tau, i) * S.col(i) * S.row(i) / S(i, i);
        CHECK((dissipation(s.section(), tau) - G).norm() < 1e-12 * G.norm());
        if (offset > 0.1) continue;
        const Clamped beam = clamp(uniform_beam(10, s), damped(3, by_direction(tau), false));
        for (const Direction direction : {bending_y, bending_z}) {
            const auto [omega, ratio] = beam.family(direction, 0);
            CHECK(ratio == Approx(tau[2 + direction] * omega / 2).epsilon(1e-8));
        }
    }
}

TEST_CASE("beam damping: the modes have the ratios listed, beyond the list in proportion to the frequency",
          "[analytic]") {
    // D is diagonal over the undamped modes.
    Random random(36);
    const std::vector<double> listed{0.01, 0.02, 0.005, 0.03};
    for (const BeamLine& line : {general_line(10), coupled_line(random, 10)})
        for (const int elements : {2, 4}) {
            BeamDamping damping = BeamDamping::of_modes({.all = listed});
            const Clamped beam = clamp(line, damped(elements, damping));
            for (std::size_t i = 0; i < 8; ++i) {
                const double expected = i < 4 ? listed[i] : listed[3] * beam.omega(i) / beam.omega(3);
                CHECK(beam.ratio(i) == Approx(expected).epsilon(1e-8));
            }
            damping.time_constants.fill(1e-5);  // contributions add up
            const Clamped more = clamp(line, damped(elements, damping));
            for (std::size_t i = 0; i < 4; ++i)
                CHECK(more.ratio(i) == Approx(listed[i] + 1e-5 * beam.omega(i) / 2).epsilon(1e-8));
        }
}

TEST_CASE("beam damping: ratios listed by direction go to the modes of that direction", "[analytic]") {
    ModalRatios ratios;
    ratios.bending_y = {0.01, 0.02}, ratios.bending_z = {0.004}, ratios.torsion = {0.03, 0.02};
    Random random(37);
    for (const BeamLine& line : {uniform_beam(10, plain_section()), general_line(10), coupled_line(random, 10)}) {
        const Clamped undamped = clamp(line, damped(3, {}));
        const Clamped beam = clamp(line, damped(3, BeamDamping::of_modes(ratios)));
        const std::vector<double> none, *lists[] = {&none, &ratios.torsion, &ratios.bending_y, &ratios.bending_z};
        std::array<std::size_t, 4> count{};
        std::array<double, 4> last{};
        for (std::size_t i = 0; i < 10; ++i) {
            const Direction direction = undamped.direction[i];
            const std::vector<double>& list = *lists[direction];
            const std::size_t n = count[direction]++;
            if (n < list.size()) last[direction] = undamped.omega(i);
            const double expected = list.empty()      ? 0
                                    : n < list.size() ? list[n]
                                                      : list.back() * undamped.omega(i) / last[direction];
            CAPTURE(line.name, i, direction, n);
            CHECK(beam.ratio(i) == Approx(expected).epsilon(1e-8).margin(1e-12));
        }
        CHECK(count[bending_y] > 2);
    }
}

TEST_CASE("beam damping: a mass at the tip leaves the damping matrix of a beam's modes as it is", "[property]") {
    // One ratio for all is D = 2 zeta / omega_1 K: with the mass the ratios are in proportion to the lower frequencies.
    RigidInertia mass;
    mass.mass = 80, mass.com = {0.3, 0.1, -0.2}, mass.J = Vec3(5, 6, 7).asDiagonal();
    const BeamLine line = general_line(10);
    const CardanBeamOptions one = damped(3, BeamDamping::of_modes({.all = {0.02}})),
                            several = damped(3, BeamDamping::of_modes({.all = {0.01, 0.02, 0.005, 0.03}}));
    const Clamped alone = clamp(line, one), loaded = clamp(line, one, mass);
    CHECK(relative(loaded.lin.damping, alone.lin.damping) < 1e-14);
    CHECK(relative(alone.lin.damping, 0.04 / alone.omega(0) * alone.lin.elastic) < 1e-9);
    CHECK(loaded.ratio(0) < 0.015);
    for (std::size_t i = 0; i < 8; ++i)
        CHECK(loaded.ratio(i) == Approx(0.02 * loaded.omega(i) / alone.omega(0)).epsilon(1e-7));
    for (const solvers::Mode& mode : clamp(line, several, mass).modes) CHECK(mode.damping_ratio() > 0);
}

TEST_CASE("beam damping: the damping of a beam on a hinge resists its deformation only", "[property]") {
    // Modal and mass-proportional damping are of the clamped beam: the rigid rotation is free of them.
    Tree tree;
    ForceSet forces;
    const JointedFrame hinge =
        add_joint(tree, Tree::base(), JointKind::revolute, Axis::y, "hinge", {"hinge"}, Vec3::Zero());
    BeamDamping damping = BeamDamping::of_modes({.bending_y = {0.01}, .torsion = {0.02}});
    damping.mass_proportional = 0.3;
    add_cardan_beam(tree, forces, hinge.frame, general_line(10), "beam", {"beam"}, damped(2, damping));
    const System system(tree, forces);
    const Vector zero = Vector::Zero(system.model.size());
    const Matrix D = solvers::linearise(system, at_rest(zero)).damping;
    const int at = system.model.index(hinge.body);
    CHECK(D.row(at).isZero(0));
    CHECK(D.col(at).isZero(0));
    Matrix rest = D;
    rest(at, at) = D.norm();
    CHECK(rest.llt().info() == Eigen::Success);
}

TEST_CASE("beam damping: modal ratios of a beam with a massless coordinate are refused, not guessed", "[property]") {
    EngineeringSection s = plain_section();
    s.j_flap = s.j_edge = 0;
    Tree tree;
    ForceSet forces;
    const CardanBeamOptions by_modes = damped(2, BeamDamping::of_modes({.all = {0.01}}));
    const BeamLine line = uniform_beam(10, s);
    check_refused([&] { add_cardan_beam(tree, forces, Tree::base(), line, "spar", {"beam"}, by_modes); },
                  {"singular metric: coordinate 'spar element 2 torsion'"});
}
