#include "tests/oracles/rotating_blade.hpp"

#include "mbs/base/decompositions.hpp"
#include "tests/oracles/jet.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace cardan::oracles {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The local variables at a point: phi, b, c and their derivatives with respect to x.
constexpr int locals = 6;
using SectionJet = Jet<locals>;
using SectionVector = std::array<SectionJet, 3>;

/// What the section at one point contributes, as functions of the six local variables.
struct Section {
    SectionJet energy;      // elastic, per length
    SectionVector tangent;  // r' of the pitch axis
    SectionVector offset;   // mass centre minus pitch axis
    SectionVector e2, e3;   // axes of the section
};

Section section(const BladeStation& s, const Eigen::Matrix<double, locals, 1>& at) {
    std::array<SectionJet, locals> v;
    for (int i = 0; i < locals; ++i) v[static_cast<std::size_t>(i)] = SectionJet::variable(at[i], i);
    const auto& [phi, b, c, dphi, db, dc] = v;
    const SectionJet f = phi + SectionJet(-s.twist);
    const SectionJet sf = sin(f), cf = cos(f), sb = sin(b), cb = cos(b), sc = sin(c), cc = cos(c);

    const SectionJet kx = dphi - dc * sb;
    const SectionJet ky = db * cf + dc * cb * sf;
    const SectionJet kz = dc * cb * cf - db * sf;

    const SectionVector e1{cb * cc, cb * sc, -sb};
    Section y;
    y.e2 = {cc * sb * sf - sc * cf, sc * sb * sf + cc * cf, cb * sf};
    y.e3 = {cc * sb * cf + sc * sf, sc * sb * cf - cc * sf, cb * cf};
    y.energy = 0.5 * (s.torsion_stiffness * kx * kx + s.flap_stiffness * ky * ky + s.edge_stiffness * kz * kz);
    // Shear and mass centre at y' = -offset (offsets count toward the trailing edge), z' = 0.
    for (std::size_t i = 0; i < 3; ++i) {
        y.tangent[i] = e1[i] + s.shear_centre_offset * kx * y.e3[i];
        y.offset[i] = -s.mass_centre_offset * y.e2[i];
    }
    return y;
}

/// Undamped gyroscopic system M q'' + G q' + K q = 0 with K, M positive definite: with K = Lk Lk^T, M = Lm Lm^T and the
/// state (Lk^T q, Lm^T q') the state matrix is skew, i times it Hermitian with the eigenvalues +-omega.
/// [Meirovitch, AIAA J. 12 (1974) 1337-1342]
VectorXd gyroscopic_frequencies(const MatrixXd& m, const MatrixXd& g, const MatrixXd& k, Index count) {
    const Eigen::LLT<MatrixXd> k_factor(k);
    const Eigen::LLT<MatrixXd> m_factor(m);
    if (k_factor.info() != Eigen::Success) throw std::runtime_error("RotatingBlade: steady state is not stable");
    if (m_factor.info() != Eigen::Success) throw std::runtime_error("RotatingBlade: mass matrix is not definite");
    const Index n = m.rows();
    const MatrixXd coupling = m_factor.matrixL().solve(MatrixXd(k_factor.matrixL()));
    const MatrixXd half = m_factor.matrixL().solve(g);
    const MatrixXd gyro = m_factor.matrixL().solve(half.transpose()).transpose();
    MatrixXd skew = MatrixXd::Zero(2 * n, 2 * n);
    skew.topRightCorner(n, n) = coupling.transpose();
    skew.bottomLeftCorner(n, n) = -coupling;
    skew.bottomRightCorner(n, n) = -0.5 * (gyro - gyro.transpose());
    const Eigen::EigenSolver<MatrixXd> solver(skew, false);
    if (solver.info() != Eigen::Success) throw std::runtime_error("RotatingBlade: eigenvalues not found");
    VectorXd frequencies = solver.eigenvalues().imag();  // accurate to rounding: the matrix is normal
    std::sort(frequencies.begin(), frequencies.end());
    return frequencies.segment(n, count);
}

}  // namespace

RotatingBlade::RotatingBlade(const BladeStations& blade, double hub_radius, int degree)
    : blade_(blade), hub_radius_(hub_radius), grid_(blade.positions(), degree + 5) {
    const HierarchicalBasis basis(grid_, degree);
    angle_ = basis.value.rightCols(basis.size() - 1);
    slope_ = basis.derivative.rightCols(basis.size() - 1);
}

RotatingBlade::Assembly RotatingBlade::assemble(const VectorXd& q, double rotor_speed) const {
    const Index points = grid_.size();
    const Index n = angle_.cols();
    const MatrixXd& integral = grid_.running_integral();
    const VectorXd& w = grid_.weights();
    const double omega2 = rotor_speed * rotor_speed;

    // Local variables of every point, then the sections as jets.
    MatrixXd at_points(points, locals);
    for (Index a = 0; a < 3; ++a) {
        at_points.col(a) = angle_ * q.segment(a * n, n);
        at_points.col(a + 3) = slope_ * q.segment(a * n, n);
    }
    std::vector<Section> sections;
    std::vector<BladeStation> properties;
    for (Index i = 0; i < points; ++i) {
        properties.push_back(blade_.at(grid_.points()[i]));
        sections.push_back(section(properties.back(), at_points.row(i).transpose()));
    }
    const auto point = [](Index i) { return static_cast<std::size_t>(i); };

    // Derivative of a local quantity, given as jets, with respect to all unknowns: one row per point.
    const auto spread = [&](auto&& jet_of) {
        MatrixXd derivative = MatrixXd::Zero(points, 3 * n);
        for (Index i = 0; i < points; ++i) {
            const auto& gradient = jet_of(sections[point(i)]).gradient;
            for (Index a = 0; a < 3; ++a) {
                derivative.row(i).segment(a * n, n) = gradient[a] * angle_.row(i) + gradient[a + 3] * slope_.row(i);
            }
        }
        return derivative;
    };
    const auto values = [&](auto&& jet_of) {
        VectorXd value(points);
        for (Index i = 0; i < points; ++i) value[i] = jet_of(sections[point(i)]).value;
        return value;
    };

    // Weights (times quadrature weight) of mass centre and Binet moments.
    std::array<VectorXd, 3> weight{w, w, w};
    for (Index i = 0; i < points; ++i) {
        const BladeStation& s = properties[point(i)];
        const double sum = s.edge_stiffness + s.flap_stiffness;
        weight[0][i] *= s.mass_per_length;
        weight[1][i] *= s.polar_inertia * s.edge_stiffness / sum;
        weight[2][i] *= s.polar_inertia * s.flap_stiffness / sum;
    }

    Assembly out{};
    out.mass = MatrixXd::Zero(3 * n, 3 * n);
    out.coriolis = out.mass;
    out.stiffness = out.mass;
    VectorXd pull = VectorXd::Zero(3 * n);  // generalised centrifugal force
    std::vector<Eigen::Matrix<double, locals, locals>> hessian(point(points));
    VectorXd elastic = spread([](const Section& s) { return s.energy; }).transpose() * w;
    for (Index i = 0; i < points; ++i) hessian[point(i)] = w[i] * sections[point(i)].energy.hessian;

    for (std::size_t vector = 0; vector < 3; ++vector) {
        std::array<MatrixXd, 3> dx;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto own = [&](const Section& s) -> const SectionJet& {
                return vector == 0 ? s.offset[axis] : vector == 1 ? s.e2[axis] : s.e3[axis];
            };
            const auto tangent = [&](const Section& s) -> const SectionJet& { return s.tangent[axis]; };
            VectorXd x = values(own);
            dx[axis] = spread(own);
            if (vector == 0) {
                x += integral * values(tangent);
                if (axis == 0) x.array() += hub_radius_;
                dx[axis] += integral * spread(tangent);
                out.tip[static_cast<Index>(axis)] = w.dot(values(tangent)) - (axis == 0 ? blade_.length() : 0.0);
            }
            const auto weighted = weight[vector].asDiagonal();
            const MatrixXd square = dx[axis].transpose() * (weighted * dx[axis]);
            out.mass += square;
            if (axis == 2) continue;  // no centrifugal force along the axis of rotation
            // - Omega^2 [ dx dx + x d2x ]; d2x of the integrated tangent sits at the point where it turns.
            const VectorXd force = omega2 * weight[vector].cwiseProduct(x);
            out.load += force.cwiseAbs().sum() * (vector == 0 ? blade_.length() : 1.0);
            out.stiffness -= omega2 * square;
            pull += dx[axis].transpose() * force;
            const VectorXd tension = vector == 0 ? VectorXd(integral.transpose() * force) : VectorXd::Zero(points);
            for (Index i = 0; i < points; ++i) {
                const Section& s = sections[point(i)];
                hessian[point(i)] -= force[i] * own(s).hessian + tension[i] * tangent(s).hessian;
            }
        }
        const MatrixXd swirl = dx[1].transpose() * (weight[vector].asDiagonal() * dx[0]);
        out.coriolis += 2.0 * rotor_speed * (swirl - swirl.transpose());
    }

    for (Index i = 0; i < points; ++i) {
        MatrixXd rows = MatrixXd::Zero(locals, 3 * n);
        for (Index a = 0; a < 3; ++a) {
            rows.row(a).segment(a * n, n) = angle_.row(i);
            rows.row(a + 3).segment(a * n, n) = slope_.row(i);
        }
        out.stiffness += rows.transpose() * (hessian[point(i)] * rows);
    }
    out.residual = elastic - pull;
    return out;
}

RotatingBlade::Modes RotatingBlade::modes(double rotor_speed, int count, About about) const {
    constexpr int max_steps = 30;
    VectorXd q = VectorXd::Zero(unknowns());
    Assembly a = assemble(q, rotor_speed);
    Modes out{};
    const auto relative = [&] { return a.load > 0.0 ? a.residual.cwiseAbs().maxCoeff() / a.load : 0.0; };
    if (about == About::deflected) {
        while (relative() > 1e-13) {
            if (++out.newton_steps > max_steps) throw std::runtime_error("RotatingBlade: no steady state found");
            q -= a.stiffness.ldlt().solve(a.residual);
            a = assemble(q, rotor_speed);
        }
    }
    out.residual = relative();
    out.steady_tip = a.tip;
    out.steady_tip_twist = q[angle_.cols() - 1];  // the hat function of the tip
    out.frequency = gyroscopic_frequencies(a.mass, a.coriolis, a.stiffness, count) / (2.0 * std::numbers::pi);
    return out;
}

}  // namespace cardan::oracles
