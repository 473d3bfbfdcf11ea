/// @file
/// Interface that the integrator requires of an integration method.
#pragma once

#include "solvers/time/integrate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

namespace cardan::solvers {

/// No state at a time within a step: a loop that cannot be closed, forces that are not finite. Integrator::advance()
/// returns it as a failure.
class NoState : public NumericalError {
public:
    using NumericalError::NumericalError;
};

/// Less than this on average over a thousand steps is not progress, s: the clock cannot tell it, or a trillion such
/// steps would not get there.
/// @param left  to the time asked for; infinity: that is not known
inline double shortest_step(double time, double left) {
    return std::max(std::isfinite(left) ? 1e-12 * left : 0,
                    64 * std::numeric_limits<double>::epsilon() * std::abs(time));
}

/// Two times closer than this are one, s.
inline double resolution(double time) {
    return 64 * std::numeric_limits<double>::epsilon() * std::abs(time);
}

/// Weights of the error norm, one per entry of x = (q_f, qd_f, s).
class ErrorWeights {
public:
    ErrorWeights(const EquationsOfMotion& equations, const Tolerances& tolerances);
    /// w = 1 / (absolute + relative |x|)
    void set(const double* x, double* w) const;
    Eigen::Index size() const { return absolute_.size(); }

private:
    double relative_;
    Vector absolute_, largest_;
};

/// The entry of x with the largest weighted error.
struct LimitingEntry {
    int entry = -1;
    double error = 0;  ///< weighted; 1 is the allowed RMS value
};
LimitingEntry limiting_entry(const double* errors, const double* weights, int size);

/// Counters added, or subtracted (sign -1); order and step size of the later one.
IntegrationStatistics sum(const IntegrationStatistics& earlier, const IntegrationStatistics& later, int sign = 1);

/// An integration method for the unknowns x.
///
/// Even a one-step method depends on more than the state: on matrices kept from step to step, on estimates, on the next
/// step size. Every 100 steps it drops all of these but the last, so that from there on its steps are determined by a
/// few numbers, in any process: origin().
class Stepper {
public:
    virtual ~Stepper() = default;
    /// Starts without history. Steps will not go beyond `stop` (infinity: no limit).
    void start(double time, const double* x, double stop);
    /// Goes on from a state at which inputs, forces or motions have a kink or a jump: a one-step method with the step
    /// that it has, a multistep method from the start.
    /// @return false: it begins anew
    bool go_on(double time, const double* x, double stop);
    /// One accepted step. @param horizon  the next output time: a scale for the first step, not a limit
    /// @return false: no step was possible, failure() says why. Exceptions of user functions propagate.
    bool step(double horizon);
    /// Data from which the present state has been computed; for a multistep method: nothing to repeat.
    const MethodState& origin() const { return origin_; }
    /// The state at which go_on() is about to be called; for a multistep method: nothing to repeat.
    MethodState present(double time, const Vector& x) const;
    /// Repeats those steps. @return false if they belong to another method, or if one fails
    bool repeat(const MethodState& from, double stop);
    /// End of the last step.
    virtual double time() const = 0;
    /// State within the last step.
    virtual void state_at(double time, double* x) = 0;
    virtual IntegrationStatistics statistics() const = 0;
    const std::string& failure() const { return failure_; }

protected:
    /// @param memory  step_memory(); 0: a multistep method
    Stepper(int unknowns, int memory);
    virtual void do_start(double time, const double* x, double stop) = 0;
    virtual bool do_step(double horizon) = 0;
    /// The state stays, its rates may have changed.
    virtual void renew(double /*time*/, const double* /*x*/) {}
    /// Writes the next step size, s, leaves the second number alone, and writes whatever else determines the next
    /// steps.
    virtual void remember(double* /*memory*/) const {}
    /// Drops everything except that.
    virtual void do_resume(double /*time*/, const double* /*x*/, double /*stop*/, const double* /*memory*/) {}

    /// True if the time has not advanced, or only in its last few digits.
    static bool stands_still(double from, double to);
    /// Weighted errors below this do not indicate what limits a step.
    static constexpr double informative = 1e-3;
    static constexpr std::string_view standstill = "the step became as short as the clock can tell";

    std::string failure_;

private:
    static constexpr long longest_memory = 100;  ///< steps
    double stop_at_ = 0;
    MethodState origin_;
};

/// Number of values that one-step methods remember: the same for all, so that a file written by one has room for
/// another. The second one is 0, or one of the following.
int step_memory(const EquationsOfMotion& equations);
inline constexpr double to_go_on = 1;     ///< go_on() is to come
inline constexpr double has_gone_on = 2;  ///< and no step since

/// @throws InputError for options the method does not support; NumericalError if SUNDIALS cannot be set up
std::unique_ptr<Stepper> make_cvode_stepper(EquationsOfMotion& equations, const IntegrationOptions& options);
std::unique_ptr<Stepper> make_arkode_stepper(EquationsOfMotion& equations, const IntegrationOptions& options);
std::unique_ptr<Stepper> make_alpha_stepper(EquationsOfMotion& equations, const IntegrationOptions& options);

}  // namespace cardan::solvers
