/// @file
/// What the integrator needs of a method of integration.
#pragma once

#include "solvers/time/integrate.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace cardan::solvers {

/// Weights of the error norm, one per entry of x = (q_f, qd_f).
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

/// The entry of x whose error is largest beside its weight.
struct LimitingEntry {
    int entry = -1;
    double error = 0;  ///< weighted; 1 is what is allowed in the mean
};
LimitingEntry limiting_entry(const double* errors, const double* weights, int size);

/// Counters added, or taken away (sign -1); order and step of the later one.
IntegrationStatistics sum(const IntegrationStatistics& earlier, const IntegrationStatistics& later, int sign = 1);

/// One method of integration of the unknowns x.
///
/// A method of one step depends on more than the state: on matrices that are kept from step to step, on estimates, on
/// the step that it would take next. Every 100 steps it drops all but the last of these, so that from there on its
/// steps follow from a few numbers, in any process: origin().
class Stepper {
public:
    virtual ~Stepper() = default;
    /// Starts without history. Steps will end at `stop` (infinity: nowhere) or before.
    void start(double time, const double* x, double stop);
    /// One accepted step. @param horizon  the time the user wants next: a scale for the first step, no limit
    /// @return false: no step was possible, failure() says why. Exceptions of user functions pass through.
    bool step(double horizon);
    /// Of what the present state has come; of a method of several steps: nothing to repeat.
    const MethodState& origin() const { return origin_; }
    /// Takes those steps (again).  @return false if they are not of this method, or if one fails
    bool repeat(const MethodState& from, double stop);
    /// End of the last step.
    virtual double time() const = 0;
    /// State within the last step.
    virtual void state_at(double time, double* x) = 0;
    virtual IntegrationStatistics statistics() const = 0;
    const std::string& failure() const { return failure_; }

protected:
    /// @param memory  numbers that do_resume() needs, one at least; 0: a method of several steps
    Stepper(int unknowns, int memory);
    virtual void do_start(double time, const double* x, double stop) = 0;
    virtual bool do_step(double horizon) = 0;
    /// The step to come, s, and what else the next steps follow from.
    virtual void remember(double* /*memory*/) const {}
    /// Drops everything but that.
    virtual void do_resume(double /*time*/, const double* /*x*/, double /*stop*/, const double* /*memory*/) {}

    /// A step from one time to the other is no step: the clock has not moved, or by a few of its last digits only.
    static bool stands_still(double from, double to);
    /// Weighted errors below this do not tell what limits a step.
    static constexpr double informative = 1e-3;
    static constexpr std::string_view standstill = "the step became as short as the clock can tell";

    std::string failure_;

private:
    static constexpr long longest_memory = 100;  ///< steps
    double stop_at_ = 0;
    MethodState origin_;
};

/// Numbers that methods of one step remember: as many for each, so that a file of one has room for another.
inline int step_memory(const EquationsOfMotion& equations) {
    return 3 + 3 * equations.size();
}

/// @throws InputError for options that the method does not have; NumericalError if SUNDIALS cannot be set up
std::unique_ptr<Stepper> make_cvode_stepper(EquationsOfMotion& equations, const IntegrationOptions& options);
std::unique_ptr<Stepper> make_arkode_stepper(EquationsOfMotion& equations, const IntegrationOptions& options);
std::unique_ptr<Stepper> make_alpha_stepper(EquationsOfMotion& equations, const IntegrationOptions& options);

}  // namespace cardan::solvers
