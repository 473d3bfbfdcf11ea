/// @file
/// Unknowns of a periodic steady state that two alike blades leave.
#pragma once

#include "solvers/periodic/detail/rotor_equations.hpp"

#include <optional>

namespace cardan::solvers {

/// Half a revolution puts each of two alike blades in the other's place, and the steady state goes on as it was: the
/// sum of the blades and what carries them have even harmonics only, their difference and teeter odd ones. Half of the
/// coefficients remain, and Newton's matrix has a quarter of the entries.
///
/// Coefficients are matrices with a row per unknown and the columns h0, hc_1, hs_1, ...
class HalfTurn {
public:
    /// None where there are no two blades at opposite places, all with the same unknowns.
    static std::optional<HalfTurn> make(const RotorMap& rotor, const RotorEquations& equations, int harmonics);

    /// Number of the coefficients that remain.
    Eigen::Index size() const { return offset_.back(); }
    /// The largest part of coefficients that is none of those.
    double outside(const Matrix& coefficients) const;
    Vector reduced(const Matrix& coefficients) const;
    Matrix expanded(const Vector& reduced) const;
    /// Place among all coefficients, column after column, of a reduced one. (Of a sum or difference: that of the first
    /// blade.)
    Eigen::Index place(Eigen::Index reduced) const;
    /// Place of the mean of an unknown among the reduced ones; -1: it has none of its own.
    Eigen::Index mean_of(Eigen::Index row) const;

    /// J += the part of an azimuth in the derivative of the reduced residual, weight_k (b''_l M + b'_l C + b_l K).
    /// @param at  at the azimuth; overwritten
    /// @param basis  by derivative, and the weights: at the azimuth
    void add(SecondOrderSystem& at, const std::array<Vector, 3>& basis, const Vector& weights, Matrix& J);

private:
    HalfTurn(const Matrix& P, int harmonics);
    Eigen::Index parity(Eigen::Index column) const { return (column + 1) / 2 % 2; }
    Matrix ordered(const Matrix& A) const;
    template <class Rows>
    void mix(Rows&& rows) const;

    Eigen::Index columns_;
    std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs_;  ///< of the two blades
    std::array<std::vector<Eigen::Index>, 2> rows_;             ///< even and odd ones, once the pairs are mixed
    std::vector<Eigen::Index> order_, offset_;                  ///< even before odd; first reduced one of every column
    Matrix block_;
};

}  // namespace cardan::solvers
