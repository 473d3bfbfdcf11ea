#include "solvers/linear/loop_reduction.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/linear/coordinate_rows.hpp"

#include <algorithm>

namespace cardan::solvers {

namespace {

// The gradients over some coordinates, which are to be multiplied by `scale`.
struct Gradients {
    Matrix G;
    Vector scale;
};

Gradients gradients(const Linearisation& lin, const std::vector<int>& coordinates) {
    const auto n = std::ssize(coordinates);
    Gradients out{Matrix(lin.constraints.rows(), n), Vector(n)};
    for (Eigen::Index i = 0; i < n; ++i) {
        const int at = entry(coordinates, i);
        out.scale(i) = 1 / std::sqrt(lin.mass(at, at));
        out.G.col(i) = out.scale(i) * lin.constraints.col(at);
    }
    return out;
}

// How all of n coordinates follow from those that are independent, which are left in ascending order.
Matrix dependence(const Gradients& gradients, std::vector<Eigen::Index>& independent) {
    constexpr double dependent_below = 1e-9;
    const Eigen::Index n = gradients.scale.size();
    Eigen::ColPivHouseholderQR<Matrix> qr(gradients.G);
    qr.setThreshold(dependent_below);
    const Eigen::Index r = qr.rank();
    const auto& order = qr.colsPermutation().indices();
    independent.clear();
    for (Eigen::Index i = r; i < n; ++i) independent.push_back(order(i));
    const Matrix R = qr.matrixR().topRows(r);
    const Matrix follow = -R.leftCols(r).triangularView<Eigen::Upper>().solve(R.rightCols(n - r));
    std::ranges::sort(independent);
    Matrix shape = Matrix::Zero(n, n - r);
    for (Eigen::Index j = 0; j < n - r; ++j) {
        const Eigen::Index at = order(r + j);
        const Eigen::Index to = std::ranges::lower_bound(independent, at) - independent.begin();
        shape(at, to) = 1;
        for (Eigen::Index i = 0; i < r; ++i)
            shape(order(i), to) = gradients.scale(order(i)) * follow(i, j) / gradients.scale(at);
    }
    return shape;
}

}  // namespace

ReducedSystem reduce_loops(const Linearisation& lin, const std::vector<int>& coordinates, int spin) {
    const Eigen::Index n = std::ssize(coordinates);
    if (lin.constraints.rows() == 0) return {restrict_to(lin, coordinates, spin), Matrix::Identity(n, n)};
    Linearisation tree = lin;
    tree.constraints.resize(0, 0);
    SecondOrderSystem all = restrict_to(tree, coordinates, spin);
    std::vector<Eigen::Index> independent;
    ReducedSystem out{{}, dependence(gradients(lin, coordinates), independent)};
    const Matrix& Z = out.shape;
    for (const Eigen::Index i : independent) out.system.coordinates.push_back(entry(coordinates, i));
    out.system.M = Z.transpose() * all.M * Z;
    out.system.C = Z.transpose() * all.C * Z;
    out.system.K = Z.transpose() * all.K * Z;
    out.system.K_elastic = Z.transpose() * all.K_elastic * Z;
    out.system.states = std::move(all.states);
    if (out.system.states.size() > 0) {
        StateTerms& states = out.system.states;
        states.Q_s = (Z.transpose() * states.Q_s).eval();
        states.f_q = (states.f_q * Z).eval();
        states.f_qd = (states.f_qd * Z).eval();
    }
    // A spin on which nothing depends does so in any coordinates, as long as the loops do not move with it.
    if (all.cyclic >= 0) {
        const int row = row_of(out.system.coordinates, spin);
        if (row >= 0 && lin.constraints.col(spin).isZero(0)) out.system.cyclic = row;
    }
    return out;
}

}  // namespace cardan::solvers
