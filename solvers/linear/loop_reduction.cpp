#include "solvers/linear/loop_reduction.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace cardan::solvers {

namespace {

constexpr double dependent_below = 1e-9;

// Factors that make the rows of a matrix, and then its columns, of length 1, so that ranks do not depend on units: some
// rows are in m and some are directions, some columns per m and some per rad. Zero remains zero.
struct Scales {
    Vector rows, columns;

    explicit Scales(const Matrix& G) {
        const auto over = [](double length) { return length > 0 ? 1 / length : 1.0; };
        rows = G.rowwise().norm().unaryExpr(over);
        columns = (rows.asDiagonal() * G).colwise().norm().transpose().unaryExpr(over);
    }
    Matrix of(const Matrix& G) const { return rows.asDiagonal() * G * columns.asDiagonal(); }
};

// The coordinates among some that follow the independent ones, by the gradients of loops.
class Dependence {
public:
    Dependence(const Matrix& constraints, const std::vector<int>& coordinates, const std::vector<int>& independent)
        : rows_(std::ssize(coordinates)) {
        for (Eigen::Index i = 0; i < rows_; ++i) {
            const auto at = std::ranges::find(independent, entry(coordinates, i));
            if (at == independent.end()) {
                own_.push_back(entry(coordinates, i));
                dependent_.push_back(i);
            } else {
                independent_.emplace_back(i, at - independent.begin());
            }
        }
        if (own_.empty()) return;
        const Matrix own = constraints(Eigen::all, own_);
        scales_.emplace(own);
        qr_.setThreshold(dependent_below);
        qr_.compute(scales_->of(own));
        if (qr_.rank() < std::ssize(own_))
            throw NumericalError(text("reduction of loops: ", std::ssize(own_), " coordinates should follow ",
                                      std::ssize(independent), " others, but ", std::ssize(own_) - qr_.rank(),
                                      " of them do not: the loops are at a dead point"));
    }
    // What independent coordinates move of themselves, 1 or 0, and what follows: G x = -right.
    Matrix move(double own, const Matrix& right) const {
        Matrix x = Matrix::Zero(rows_, right.cols());
        for (const auto& [row, column] : independent_) x(row, column) = own;
        if (own_.empty()) return x;
        const Matrix follow = -(scales_->columns.asDiagonal() * qr_.solve(scales_->rows.asDiagonal() * right));
        for (Eigen::Index k = 0; k < follow.rows(); ++k) x.row(entry(dependent_, k)) = follow.row(k);
        return x;
    }

private:
    Eigen::Index rows_;
    std::vector<int> own_;                                            // those that follow
    std::vector<Eigen::Index> dependent_;                             // their rows
    std::vector<std::pair<Eigen::Index, Eigen::Index>> independent_;  // rows and columns of the others
    std::optional<Scales> scales_;
    Eigen::ColPivHouseholderQR<Matrix> qr_;
};

// By all coordinates: `own` on the diagonal but for `coordinates`, whose rows are given.
Matrix spread(const Matrix& rows, double own, Eigen::Index size, const std::vector<int>& coordinates,
              const std::vector<int>& independent) {
    Matrix all = own * Matrix::Identity(size, size);
    for (const int a : coordinates) all(a, a) = 0;
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        for (Eigen::Index j = 0; j < rows.cols(); ++j) all(entry(coordinates, i), entry(independent, j)) = rows(i, j);
    return all;
}

}  // namespace

std::vector<int> independent_coordinates(const Linearisation& lin, const std::vector<int>& coordinates, int preferred) {
    for (const int a : coordinates) require_index("reduction of loops", "coordinate", a, lin.mass.rows());
    if (lin.constraints.rows() == 0) return coordinates;
    const auto n = std::ssize(coordinates);
    Matrix G(lin.constraints.rows(), n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const int a = entry(coordinates, i);
        // What is preferred counts as heavy: it becomes a pivot last.
        G.col(i) = lin.constraints.col(a) / std::sqrt(lin.mass(a, a)) * (a == preferred ? 1e-6 : 1.0);
    }
    const Vector rows = Scales(G).rows;
    Eigen::ColPivHouseholderQR<Matrix> qr(Matrix(rows.asDiagonal() * G));
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
    return Dependence(constraints, coordinates, independent).move(1, constraints(Eigen::all, independent));
}

double following_quality(const Matrix& constraints, const std::vector<int>& coordinates,
                         const std::vector<int>& independent) {
    std::vector<int> dependent;
    for (const int a : coordinates)
        if (std::ranges::find(independent, a) == independent.end()) dependent.push_back(a);
    if (dependent.empty()) return 1;
    if (constraints.rows() < std::ssize(dependent)) return 0;
    const Matrix own = constraints(Eigen::all, dependent);
    const Eigen::ColPivHouseholderQR<Matrix> qr(Scales(own).of(own));
    const Vector pivots = qr.matrixR().diagonal().head(std::ssize(dependent)).cwiseAbs();
    return pivots(0) > 0 ? pivots.minCoeff() / pivots(0) : 0;
}

std::vector<int> independent_on_the_way(const std::vector<Linearisation>& way, const std::vector<int>& coordinates,
                                        int preferred) {
    constexpr double dead = 1e-6;
    std::vector<std::vector<int>> choices;
    for (const Linearisation& at : way)
        if (std::vector<int> choice = independent_coordinates(at, coordinates, preferred);
            std::ranges::find(choices, choice) == choices.end())
            choices.push_back(std::move(choice));
    double max = 0;
    std::vector<int> best;
    for (std::vector<int>& choice : choices) {
        double min = 1;
        for (const Linearisation& other : way)
            min = std::min(min, following_quality(other.constraints, coordinates, choice));
        if (min <= max) continue;
        max = min;
        best = std::move(choice);
    }
    if (max < dead)
        throw NumericalError(
            "reduction of loops: no choice of independent coordinates passes the dead points of the loops on the way");
    return best;
}

Followers followers(const Linearisation& lin, const std::vector<int>& coordinates,
                    const std::vector<int>& independent) {
    const Dependence dependence(lin.constraints, coordinates, independent);
    Followers out{dependence.move(1, lin.constraints(Eigen::all, independent)), {}, {}};
    if (lin.constraint_rates.rows() == 0) return out;
    const Matrix first = lin.constraint_rates(Eigen::all, coordinates),
                 second = lin.constraint_accelerations(Eigen::all, coordinates);
    out.rate = dependence.move(0, first * out.shape);
    out.acceleration = dependence.move(0, 2 * first * out.rate + second * out.shape);
    return out;
}

Matrix follow(const Matrix& constraints, const std::vector<int>& dependent, const Matrix& right) {
    const Matrix own = constraints(Eigen::all, dependent);
    const Scales scales(own);
    const Eigen::ColPivHouseholderQR<Matrix> qr(scales.of(own));
    return -(scales.columns.asDiagonal() * qr.solve(scales.rows.asDiagonal() * right));
}

Matrix multipliers_on(const Matrix& constraints, const std::vector<int>& coordinates, const Matrix& load) {
    const Matrix own = constraints(Eigen::all, coordinates);
    const Scales scales(own);
    const Eigen::CompleteOrthogonalDecomposition<Matrix> factor(scales.of(own).transpose());
    return scales.rows.asDiagonal() * factor.solve(scales.columns.asDiagonal() * load);
}

void condense_loops(Linearisation& lin, const std::vector<int>& coordinates, const std::vector<int>& independent) {
    if (lin.constraints.rows() == 0) return;
    const Followers move = followers(lin, coordinates, independent);
    const Eigen::Index n = lin.mass.rows();
    const Matrix Z = spread(move.shape, 1, n, coordinates, independent);
    const bool moving = move.rate.size() > 0;
    // Of the motion, from the left still by all coordinates: M (2 Z' dy' + Z'' dy) and so on.
    Matrix Z1, by_rate, by_position, damped;
    if (moving) {
        Z1 = spread(move.rate, 0, n, coordinates, independent);
        by_rate = 2 * lin.mass * Z1;
        by_position = lin.gyroscopic * Z1 + lin.mass * spread(move.acceleration, 0, n, coordinates, independent);
        damped = lin.damping * Z1;
    }
    for (Matrix* m : {&lin.mass, &lin.damping, &lin.gyroscopic, &lin.elastic, &lin.gravity, &lin.loads, &lin.inertial,
                      &lin.reactions})
        *m = (Z.transpose() * *m * Z).eval();
    if (moving) {
        lin.gyroscopic += Z.transpose() * by_rate;
        lin.inertial += Z.transpose() * by_position;
        lin.loads += Z.transpose() * damped;
    }
    if (!lin.states.empty()) {
        StateDerivatives& states = lin.state_derivatives;
        states.Q_s = (Z.transpose() * states.Q_s).eval();
        if (states.Q_u.size() > 0) states.Q_u = (Z.transpose() * states.Q_u).eval();
        states.f_q = (states.f_q * Z).eval();
        if (moving) states.f_q += states.f_qd * Z1;
        states.f_qd = (states.f_qd * Z).eval();
    }
    for (Matrix* m : {&lin.constraints, &lin.constraint_rates, &lin.constraint_accelerations}) m->resize(0, 0);
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
