#include "examples/studies/beam_accuracy/hermite_beam.hpp"

#include "mbs/base/decompositions.hpp"

#include <Eigen/SparseCholesky>

#include <cmath>

namespace cardan::accuracy {

namespace {

using Dense = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Sparse = Eigen::SparseMatrix<Real>;
using Block = Eigen::Matrix<Real, 8, 8>;

struct ElementMatrices {
    Block stiffness = Block::Zero(), mass = Block::Zero(), tension = Block::Zero(), unit_load = Block::Zero();
};

class Assembly {
public:
    Assembly(const Beam& beam, const std::vector<double>& ends, Shapes shapes)
        : beam_(beam), ends_(ends), shapes_(shapes) {}

    // Stiffness and mass; `unit_load`: instead of the mass the geometric stiffness of a tip load of 1.
    void assemble(bool unit_load, Sparse& K, Sparse& M) const {
        std::vector<Eigen::Triplet<Real>> k, m;
        Real outboard = 0;  // centrifugal force of all elements further out
        for (std::size_t e = ends_.size() - 1; e-- > 0;) {
            const ElementMatrices element = matrices(ends_[e], ends_[e + 1], outboard);
            add(e, element.stiffness + element.tension, k);
            add(e, unit_load ? element.unit_load : element.mass, m);
            outboard += pull(ends_[e], ends_[e + 1]);
        }
        const Eigen::Index n = size();
        K.resize(n, n), M.resize(n, n);
        K.setFromTriplets(k.begin(), k.end());
        M.setFromTriplets(m.begin(), m.end());
    }
    Eigen::Index size() const { return (std::ssize(ends_) - 1) * per_node(); }
    Eigen::Index per_node() const { return beam_.plane == Plane::both ? 4 : 2; }

private:
    Real pull(double a, double b) const {
        Real sum = 0;
        for (const GaussPoint& p : gauss_points(a, b, beam_.line.breaks))
            sum += Real(p.weight * beam_.line.section(p.x).mass) * Real(beam_.hub_radius + p.x);
        return sum * Real(beam_.speed) * Real(beam_.speed);
    }

    ElementMatrices matrices(double a, double b, Real outboard) const {
        const ElementShapes shapes(beam_.line, beam_.plane, shapes_, a, b);
        const Real spin2 = Real(beam_.speed) * Real(beam_.speed);
        ElementMatrices m;
        for (const GaussPoint& p : gauss_points(a, b, beam_.line.breaks)) {
            const BeamSection section = beam_.line.section(p.x);
            const ElementField f = shapes.at(p.x);
            const Real weight = p.weight, mu = section.mass;
            const Real tension = beam_.speed > 0 ? outboard + pull(p.x, b) : 0;
            m.stiffness += weight * f.ds.transpose() * bending_stiffness(section, beam_.plane) * f.ds;
            m.mass += weight * mu * f.w.transpose() * f.w;
            m.tension += weight * tension * f.dw.transpose() * f.dw;
            m.unit_load += weight * f.dw.transpose() * f.dw;
            for (int i = 0; i < 2; ++i) {
                m.mass += weight * Real(section.J(1 + i, 1 + i)) * f.s.row(i).transpose() * f.s.row(i);
                if (const double shear = section.compliance(2 - i, 2 - i); shear > 0) {
                    const auto gamma = (f.dw.row(i) - f.s.row(i)).eval();
                    m.stiffness += weight / Real(shear) * gamma.transpose() * gamma;
                }
            }
            // In the plane of rotation the centrifugal force turns along.
            m.tension -= weight * spin2 * mu * f.w.row(1).transpose() * f.w.row(1);
        }
        return m;
    }

    // Unknown of plane i (0 flap, 1 edge), node and kind (0 displacement, 1 rotation); -1: clamped or ignored.
    Eigen::Index unknown(std::size_t node, int i, int kind) const {
        const bool active = beam_.plane == Plane::both || (beam_.plane == Plane::edge) == (i == 1);
        if (!active || node == 0) return -1;
        return static_cast<Eigen::Index>(node - 1) * per_node() + (beam_.plane == Plane::both ? 2 * i : 0) + kind;
    }
    void add(std::size_t e, const Block& block, std::vector<Eigen::Triplet<Real>>& into) const {
        const auto place = [&](int k) { return unknown(e + static_cast<std::size_t>(k % 4 / 2), k / 4, k % 2); };
        for (int r = 0; r < 8; ++r)
            for (int c = 0; c < 8; ++c)
                if (place(r) >= 0 && place(c) >= 0) into.emplace_back(place(r), place(c), block(r, c));
    }

    const Beam& beam_;
    const std::vector<double>& ends_;
    Shapes shapes_;
};

struct Pairs {
    Eigen::Matrix<Real, Eigen::Dynamic, 1> values;
    Dense vectors;
};

// Lowest eigenpairs of K x = lambda M x by subspace iteration. [Bathe 1996, section 11.6]
Pairs lowest(const Sparse& K, const Sparse& M, Eigen::Index count) {
    const Eigen::Index n = K.rows(), width = std::min(n, 2 * count + 8);
    const Eigen::SimplicialLDLT<Sparse> factor(K);
    Dense X(n, width);
    for (Eigen::Index j = 0; j < width; ++j)  // any independent start
        for (Eigen::Index i = 0; i < n; ++i) X(i, j) = std::sin(Real(1 + i) * Real(1 + j) * Real(0.7) + Real(j * j));
    Pairs pairs;
    for (int step = 0; step < 200; ++step) {
        const Dense Y = factor.solve(Dense(M * X));
        const Eigen::GeneralizedSelfAdjointEigenSolver<Dense> ritz(Dense(Y.transpose() * K * Y),
                                                                   Dense(Y.transpose() * M * Y));
        X = Y * ritz.eigenvectors();
        const bool done = pairs.values.size() > 0 &&
                          ((ritz.eigenvalues() - pairs.values).head(std::min(count, width)).cwiseAbs().array() <
                           Real(1e-15) * ritz.eigenvalues().head(std::min(count, width)).array())
                              .all();
        pairs = {ritz.eigenvalues(), X};
        if (done) break;
    }
    return pairs;
}

}  // namespace

BendingModes hermite_modes(const Beam& beam, const std::vector<double>& ends, Shapes shapes, int count) {
    const Assembly assembly(beam, ends, shapes);
    Sparse K, M;
    assembly.assemble(false, K, M);
    const Pairs pairs = lowest(K, M, count);
    BendingModes modes;
    for (Eigen::Index k = 0; k < std::min<Eigen::Index>(count, pairs.values.size()); ++k) {
        const auto omega = static_cast<double>(std::sqrt(pairs.values(k)));
        bool flap = beam.plane == Plane::flap;
        if (beam.plane == Plane::both) {
            const Eigen::Matrix<Real, Eigen::Dynamic, 1> x = pairs.vectors.col(k), Mx = M * x;
            Real share = 0;
            for (Eigen::Index i = 0; i < x.size(); ++i) share += (i % 4 < 2 ? 1 : -1) * x(i) * Mx(i);
            flap = share > 0;
        }
        (flap ? modes.flap : modes.edge).push_back(omega);
    }
    return modes;
}

double hermite_buckling(const Beam& beam, const std::vector<double>& ends) {
    const Assembly assembly(beam, ends, Shapes::cubic);
    Sparse K, G;
    assembly.assemble(true, K, G);
    return static_cast<double>(lowest(K, G, 1).values(0));
}

BendingModes hermite_limit(const Beam& beam, int elements) {
    std::vector<double> pieces{0};
    for (double x : beam.line.breaks)
        if (x > 0 && x < beam.line.length) pieces.push_back(x);
    pieces.push_back(beam.line.length);
    const auto divided = [&](int n) {
        std::vector<double> ends{0};
        for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
            const double length = pieces[i + 1] - pieces[i];
            const int parts = std::max(1, static_cast<int>(std::lround(n * length / beam.line.length)));
            for (int k = 1; k <= parts; ++k) ends.push_back(pieces[i] + length * k / parts);
        }
        return ends;
    };
    // Halved element by element, so that the error falls by 16.
    const std::vector<double> coarse_ends = divided(elements);
    std::vector<double> fine_ends{0};
    for (std::size_t i = 0; i + 1 < coarse_ends.size(); ++i) {
        fine_ends.push_back((coarse_ends[i] + coarse_ends[i + 1]) / 2);
        fine_ends.push_back(coarse_ends[i + 1]);
    }
    const BendingModes coarse = hermite_modes(beam, coarse_ends), fine = hermite_modes(beam, fine_ends);
    const auto extrapolated = [](const std::vector<double>& a, const std::vector<double>& b) {
        std::vector<double> limit;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) limit.push_back(b[i] + (b[i] - a[i]) / 15);
        return limit;
    };
    return {extrapolated(coarse.flap, fine.flap), extrapolated(coarse.edge, fine.edge)};
}

}  // namespace cardan::accuracy
