#include "solvers/linear/loop_reduction.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

constexpr double dependent_below = 1e-9;

// By all coordinates: the identity but for `coordinates`, which follow `independent`.
Matrix spread_shape(const Linearisation& lin, const std::vector<int>& coordinates,
                    const std::vector<int>& independent) {
    const Matrix shape = following(lin.constraints, coordinates, independent);
    Matrix all = Matrix::Identity(lin.mass.rows(), lin.mass.rows());
    for (const int a : coordinates) all(a, a) = 0;
    for (Eigen::Index i = 0; i < shape.rows(); ++i)
        for (Eigen::Index j = 0; j < shape.cols(); ++j) all(entry(coordinates, i), entry(independent, j)) = shape(i, j);
    return all;
}

}  // namespace

std::vector<int> independent_coordinates(const Linearisation& lin, const std::vector<int>& coordinates) {
    for (const int a : coordinates) require_index("reduction of loops", "coordinate", a, lin.mass.rows());
    if (lin.constraints.rows() == 0) return coordinates;
    const auto n = std::ssize(coordinates);
    Matrix G(lin.constraints.rows(), n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const int a = entry(coordinates, i);
        G.col(i) = lin.constraints.col(a) / std::sqrt(lin.mass(a, a));
    }
    Eigen::ColPivHouseholderQR<Matrix> qr(G);
    qr.setThreshold(dependent_below);
    std::vector<int> independent;
    for (Eigen::Index i = qr.rank(); i < n; ++i)
        independent.push_back(entry(coordinates, qr.colsPermutation().indices()(i)));
    // In the order in which they were given.
    std::vector<int> sorted;
    for (const int a : coordinates)
        if (std::ranges::find(independent, a) != independent.end()) sorted.push_back(a);
    return sorted;
}

Matrix following(const Matrix& constraints, const std::vector<int>& coordinates, const std::vector<int>& independent) {
    const auto n = std::ssize(coordinates), m = std::ssize(independent);
    Matrix shape = Matrix::Zero(n, m);
    std::vector<int> dependent;
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto at = std::ranges::find(independent, entry(coordinates, i));
        if (at == independent.end())
            dependent.push_back(entry(coordinates, i));
        else
            shape(i, at - independent.begin()) = 1;
    }
    if (dependent.empty()) return shape;
    Eigen::ColPivHouseholderQR<Matrix> qr(Matrix(constraints(Eigen::all, dependent)));
    qr.setThreshold(dependent_below);
    if (qr.rank() < std::ssize(dependent))
        throw NumericalError(text("reduction of loops: ", std::ssize(dependent), " coordinates should follow ", m,
                                  " others, but ", std::ssize(dependent) - qr.rank(),
                                  " of them do not: the loops are at a dead point"));
    const Matrix follow = -qr.solve(Matrix(constraints(Eigen::all, independent)));
    for (Eigen::Index i = 0, k = 0; i < n; ++i)
        if (std::ranges::find(dependent, entry(coordinates, i)) != dependent.end()) shape.row(i) = follow.row(k++);
    return shape;
}

void condense_loops(Linearisation& lin, const std::vector<int>& coordinates, const std::vector<int>& independent) {
    if (lin.constraints.rows() == 0) return;
    const Matrix Z = spread_shape(lin, coordinates, independent);
    for (Matrix* m : {&lin.mass, &lin.damping, &lin.gyroscopic, &lin.elastic, &lin.gravity, &lin.loads, &lin.inertial,
                      &lin.reactions})
        *m = (Z.transpose() * *m * Z).eval();
    if (!lin.states.empty()) {
        StateDerivatives& states = lin.state_derivatives;
        states.Q_s = (Z.transpose() * states.Q_s).eval();
        if (states.Q_u.size() > 0) states.Q_u = (Z.transpose() * states.Q_u).eval();
        states.f_q = (states.f_q * Z).eval();
        states.f_qd = (states.f_qd * Z).eval();
    }
    lin.constraints.resize(0, 0);
}

ReducedSystem reduce_loops(const Linearisation& lin, const std::vector<int>& coordinates, int spin) {
    const Eigen::Index n = std::ssize(coordinates);
    if (lin.constraints.rows() == 0) return {restrict_to(lin, coordinates, spin), Matrix::Identity(n, n)};
    const std::vector<int> independent = independent_coordinates(lin, coordinates);
    ReducedSystem out{{}, following(lin.constraints, coordinates, independent)};
    Linearisation tree = lin;
    condense_loops(tree, coordinates, independent);
    out.system = restrict_to(tree, independent, spin);
    return out;
}

}  // namespace cardan::solvers
