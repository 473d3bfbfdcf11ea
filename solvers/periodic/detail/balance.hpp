/// @file
/// Harmonic balance (harmonic_balance()). Internal to solvers: not installed.
#pragma once

#include "solvers/periodic/detail/half_turn.hpp"
#include "solvers/periodic/detail/harmonic_samples.hpp"
#include "solvers/periodic/detail/mean_jacobian.hpp"
#include "solvers/periodic/detail/rotor_equations.hpp"
#include "solvers/periodic/detail/undetermined.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cardan::solvers {

/// Coefficients of the periodic motion, column after column: entry l n + i is coefficient l of unknown i, and the
/// harmonics of the residual, which become zero.
class Balance {
public:
    /// Thrown out of solve().
    struct Cancelled {};

    Balance(const System& system, int spin, const PeriodicOptions& options);
    PeriodicSteadyState solve();

private:
    void hold();
    void set_harmonics(int harmonics);
    void add_harmonics();
    bool more_are_allowed() const { return options_.more_harmonics && at_->harmonics < 4 * options_.harmonics; }
    void set_units();
    void set_at(int sample, const Matrix& x);
    bool evaluate(const Matrix& x, Matrix& R);
    Matrix jacobian();
    Matrix half_jacobian();
    bool half_holds();
    double largest(const Matrix& R) const;
    bool converges(double tolerance);
    void set_remainders(PeriodicSteadyState& result);
    double norm(const Matrix& R) const;
    double small() const;
    bool step(Matrix& dx);
    bool solve(Matrix& J, Vector& right, const Vector& unit, const std::vector<Eigen::Index>& held);
    Vector shortest_solution(const Matrix& J, const Vector& right);
    void describe(const Vector& null_vector);
    bool search(const Matrix& dx);
    bool advance();
    void set_mean();
    bool mean_step();
    bool accelerated_steps();
    bool mean_steps();
    void finish(PeriodicSteadyState& result, bool small);

    PeriodicOptions options_;
    RotorEquations equations_;
    std::optional<HarmonicSamples> at_;
    std::vector<Eigen::Index> held_;
    std::optional<MeanJacobian> mean_;  // none: Newton's steps only
    std::optional<HalfTurn> half_;      // of two alike blades, as long as the residual has no other harmonics
    bool stale_ = true;                 // it has never been set
    bool slow_ = false;                 // its single steps are of little use
    Vector scale_, unit_;               // of residuals, per unknown; of entries for the linear system
    Matrix x_, R_;
    std::string why_ = "the limit of iterations was reached";
    int iterations_ = 0;
    double left_before_ = std::numeric_limits<double>::infinity();  // of the states, by half as many harmonics
    bool leaves_much_ = false;
    Undetermined open_;
};

}  // namespace cardan::solvers
