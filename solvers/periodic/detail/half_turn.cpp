#include "solvers/periodic/detail/half_turn.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/linear/coleman.hpp"
#include "solvers/periodic/periodic_system.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

}  // namespace

std::optional<HalfTurn> HalfTurn::make(const RotorMap& rotor, const RotorEquations& equations, int harmonics) {
    if (equations.size() == 0 || rotor.blades.size() != 2 || !rotor.evenly_spaced) return {};
    if (!ColemanTransform::exists(rotor, equations.unknowns())) return {};
    const BladeSymmetry symmetry =
        blade_symmetry(rotor, equations.unknowns(), equations.rotor_speed(), rotor.odd_coordinates, equations.states());
    const Index n = equations.states_from(), m = equations.states().size();
    Matrix P = Matrix::Zero(n + m, n + m);
    P.topLeftCorner(n, n) = symmetry.P;
    if (m > 0) P.bottomRightCorner(m, m) = symmetry.P_beside;
    return HalfTurn(P, harmonics);
}

// P has 1 or -1 once in every row: on the diagonal for what stays or changes its sign, else for two blades.
HalfTurn::HalfTurn(const Matrix& P, int harmonics) : columns_(2 * harmonics + 1) {
    for (Index i = 0; i < P.rows(); ++i) {
        Index j = 0;
        P.row(i).cwiseAbs().maxCoeff(&j);
        if (j > i) pairs_.emplace_back(i, j);
        const bool odd = j < i || (j == i && P(i, i) < 0);
        rows_[odd ? 1 : 0].push_back(i);
    }
    for (const std::vector<Index>& rows : rows_) order_.insert(order_.end(), rows.begin(), rows.end());
    offset_.push_back(0);
    for (Index l = 0; l < columns_; ++l) offset_.push_back(offset_.back() + std::ssize(entry(rows_, parity(l))));
}

// Sum and difference of the blades, over root two, in their places; its own inverse.
template <class Rows>
void HalfTurn::mix(Rows&& rows) const {
    for (const auto& [a, b] : pairs_) {
        const auto sum = ((rows.row(a) + rows.row(b)) * std::sqrt(0.5)).eval();
        rows.row(b) = ((rows.row(a) - rows.row(b)) * std::sqrt(0.5)).eval();
        rows.row(a) = sum;
    }
}

double HalfTurn::outside(const Matrix& coefficients) const {
    return (coefficients - expanded(reduced(coefficients))).cwiseAbs().maxCoeff();
}

Vector HalfTurn::reduced(const Matrix& coefficients) const {
    Matrix mixed = coefficients;
    mix(mixed);
    Vector out(size());
    for (Index l = 0; l < columns_; ++l) {
        const std::vector<Index>& rows = entry(rows_, parity(l));
        out.segment(entry(offset_, l), std::ssize(rows)) = mixed(rows, l);
    }
    return out;
}

Matrix HalfTurn::expanded(const Vector& reduced) const {
    Matrix out = Matrix::Zero(std::ssize(order_), columns_);
    for (Index l = 0; l < columns_; ++l) {
        const std::vector<Index>& rows = entry(rows_, parity(l));
        out(rows, l) = reduced.segment(entry(offset_, l), std::ssize(rows));
    }
    mix(out);
    return out;
}

Index HalfTurn::place(Index reduced) const {
    const auto column = std::upper_bound(offset_.begin(), offset_.end(), reduced) - offset_.begin() - 1;
    Index row = entry(entry(rows_, parity(column)), reduced - entry(offset_, column));
    for (const auto& [a, b] : pairs_)
        if (row == b) row = a;
    return column * std::ssize(order_) + row;
}

Index HalfTurn::mean_of(Index row) const {
    for (const auto& [a, b] : pairs_)
        if (row == a || row == b) return -1;
    const auto at = std::find(rows_[0].begin(), rows_[0].end(), row);
    return at == rows_[0].end() ? -1 : at - rows_[0].begin();
}

// With mixed rows and columns, even before odd.
Matrix HalfTurn::ordered(const Matrix& A) const {
    Matrix mixed = A;
    mix(mixed);
    mixed.transposeInPlace();
    mix(mixed);
    return mixed.transpose()(order_, order_);
}

void HalfTurn::add(SecondOrderSystem& at, const std::array<Vector, 3>& basis, const Vector& weights, Matrix& J) {
    const std::array<Index, 2> first{0, std::ssize(rows_[0])}, count{std::ssize(rows_[0]), std::ssize(rows_[1])};
    for (Matrix* A : {&at.M, &at.C, &at.K}) *A = ordered(*A);
    for (Index l = 0; l < columns_; ++l) {
        const Index from = entry(first, parity(l)), columns = entry(count, parity(l));
        block_ = basis[2](l) * at.M.middleCols(from, columns) + basis[1](l) * at.C.middleCols(from, columns) +
                 basis[0](l) * at.K.middleCols(from, columns);
        for (Index k = 0; k < columns_; ++k)
            J.block(entry(offset_, k), entry(offset_, l), entry(count, parity(k)), columns) +=
                weights(k) * block_.middleRows(entry(first, parity(k)), entry(count, parity(k)));
    }
}

}  // namespace cardan::solvers
