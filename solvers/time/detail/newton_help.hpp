/// @file
/// Savings of iterations and Jacobians in implicit Runge-Kutta methods. For sources only.
#pragma once

#include "mbs/base/types.hpp"

#include <array>

namespace cardan::solvers {

/// Whether a Jacobian has served its time: when a step with it takes more iterations than the average one since it was
/// taken, its own cost among them. That is the moment at which the average is least.
class Renewal {
public:
    static constexpr int memory = 3;  ///< numbers

    /// @param iterations  of a step
    /// @param renewed     a Jacobian was taken in that step
    void add(long iterations, bool renewed);
    bool due() const { return steps_ > 0 && recent_ * steps_ > cost + iterations_; }

    void remember(double* out) const;
    void recall(const double* values);

private:
    static constexpr double cost = 10;    ///< of a Jacobian, in iterations
    static constexpr double share = 0.3;  ///< of the last step in the recent ones
    double steps_ = 0, iterations_ = 0;   ///< with it
    double recent_ = 0;                   ///< iterations of a step
};

/// Guesses of the stages of a step: the polynomial through the start of the step, with the slope there, and the stages
/// so far.
class StageGuess {
public:
    void resize(Eigen::Index size);
    /// A step begins. Pointers to as many numbers as resize() says.
    void begin(double time, const double* x, const double* slope);
    /// @param last   the stage before, at the time of the last guess, or the start of the step
    /// @param guess  out; left as it is where no step has begun
    void predict(double time, const double* last, double* guess);
    void end() { begun_ = false; }

private:
    static constexpr int max = 4;  ///< stages, the latest: beyond, what the iteration left of them is amplified
    bool begun_ = false;
    double start_ = 0, last_ = 0;
    Vector x_, slope_;
    int count_ = 0;  ///< stages so far
    std::array<double, max> times_ = {};
    std::array<Vector, max> stages_ = {};
};

}  // namespace cardan::solvers
