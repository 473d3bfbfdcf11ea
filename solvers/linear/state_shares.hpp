/// @file
/// Whether a mode is a motion of the machine or of states beside it, for all modes at once.
#pragma once

#include "solvers/algebra/dense.hpp"
#include "solvers/algebra/real_eigen.hpp"

#include <vector>

namespace cardan::solvers {

/// Mode::state_share from the eigenvectors v of S = (A - sigma)^-1, in the order displacements, states, rates: of y^H v
/// = 1, y the left vector, the part |y_s^H v_s| of the states over |y_s^H v_s| + |1 - y_s^H v_s|. The left vectors are
/// the rows of the inverse of all v side by side. A state is n + m + n numbers.
class StateShares {
public:
    /// @param rows    displacements, n;  @param states  m; without states there is no memory
    StateShares(Eigen::Index rows, Eigen::Index states);

    /// @param eigen    of S, its vectors' first n + m rows, of which the balanced ones are D^-1 v
    /// @param balance  the diagonal of D
    /// @param shift    sigma
    /// @return by RealEigen::values(); NaN where the vectors are too close to dependent to tell. Valid until the next
    /// call. Cost 8/3 (2n + m)^3; nothing is allocated.
    const std::vector<double>& compute(const RealEigen& eigen, const Vector& balance, double shift);

private:
    void assemble(const RealEigen& eigen, const Vector& balance, double shift);

    Eigen::Index rows_, states_;
    LuFactors all_;     // vectors side by side, balanced and of length 1
    Matrix of_states_;  // rows of the states of these
    Matrix left_;       // the inverse
    std::vector<double> shares_;
};

}  // namespace cardan::solvers
