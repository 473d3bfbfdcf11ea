/// @file
/// One step of the integration of a transition matrix.
#pragma once

#include "mbs/base/types.hpp"

#include <vector>

namespace cardan::solvers {

class TransitionStep {
public:
    virtual ~TransitionStep() = default;
    /// Phi from t to t + h, overwritten.
    virtual void set(double t, double h, Matrix& Phi) = 0;
};

/// Transition matrices, as transitions() of a system, by these steps.
/// @param states  of Phi
std::vector<Matrix> transitions(TransitionStep& step, Eigen::Index states, double t0, double t1, int intervals,
                                int steps);

}  // namespace cardan::solvers
