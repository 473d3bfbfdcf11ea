/// @file
/// Linear equations of one harmonic, in which states are eliminated group by group. Internal: not for users of the
/// library.
#pragma once

#include "mbs/base/decompositions.hpp"
#include "solvers/algebra/coupled_groups.hpp"

#include <vector>

namespace cardan::solvers {

/// (A + i B) z = r, for z = c - i s the coefficients of cosine and sine; without B a mean, A c = r. States z_s follow
/// from the coordinates z_q,
///
///     z_s = P_ss^-1 (r_s - P_sq z_q),      (P_qq - P_qs P_ss^-1 P_sq) z_q = r_q - P_qs P_ss^-1 r_s,
///
/// with P_ss^-1 group by group: for n coordinates and m states as much as 2/3 n^3 + n^2 m instead of 2/3 (n + m)^3, in
/// complex numbers, which are computed as [A, B; -B, A] (c; s).
class HarmonicFactors {
public:
    /// @param A, B    coordinates first; B may be empty
    /// @param groups  coupled_groups() of both
    HarmonicFactors(const Matrix& A, const Matrix& B, const std::vector<std::vector<Eigen::Index>>& groups);

    /// Estimate of the inverse of the condition number of the equations in z_q; 0: a group of states is singular. Not a
    /// number where a pivot is zero.
    double rcond() const { return rcond_; }
    /// @param r  one column, or c and s side by side with B; becomes the solution
    void solve(Matrix& r) const;

private:
    using Factors = Eigen::PartialPivLU<Matrix>;
    struct Group {
        std::vector<Eigen::Index> rows;
        Factors factors;
    };

    Matrix embedded(const Matrix& A, const Matrix& B) const;
    Matrix solved_states(const Matrix& r) const;
    void subtract_product(const Matrix& A, const Matrix& B, const Matrix& z, Matrix& r) const;

    Eigen::Index coordinates_;
    bool complex_;
    std::vector<Group> groups_;
    Matrix A_qs_, B_qs_;  // P_qs
    Matrix A_X_, B_X_;    // P_ss^-1 P_sq
    Factors of_coordinates_;
    double rcond_ = 0;
};

}  // namespace cardan::solvers
