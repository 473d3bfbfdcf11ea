/// @file
/// What the integrator needs of a method of integration.
#pragma once

#include "solvers/integrate.hpp"

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

/// Counters added; order and step of the later one.
IntegrationStatistics sum(const IntegrationStatistics& earlier, const IntegrationStatistics& later);

/// One method of integration of the unknowns x.
class Stepper {
public:
    virtual ~Stepper() = default;
    /// Starts without history. Steps will end at `stop` (infinity: nowhere) or before.
    virtual void start(double time, const double* x, double stop) = 0;
    /// One accepted step. @param horizon  the time the user wants next: a scale for the first step, no limit
    /// @return false: no step was possible, failure() says why. Exceptions of user functions pass through.
    virtual bool step(double horizon) = 0;
    /// End of the last step.
    virtual double time() const = 0;
    /// State within the last step.
    virtual void state_at(double time, double* x) = 0;
    virtual IntegrationStatistics statistics() const = 0;
    const std::string& failure() const { return failure_; }

protected:
    /// A step from one time to the other is no step: the clock has not moved, or by a few of its last digits only.
    static bool stands_still(double from, double to);
    /// Weighted errors below this do not tell what limits a step.
    static constexpr double informative = 1e-3;
    static constexpr std::string_view standstill = "the step became as short as the clock can tell";

    std::string failure_;
};

/// @throws InputError for options that the method does not have; NumericalError if SUNDIALS cannot be set up
std::unique_ptr<Stepper> make_cvode_stepper(EquationsOfMotion& equations, const IntegrationOptions& options);
std::unique_ptr<Stepper> make_arkode_stepper(EquationsOfMotion& equations, const IntegrationOptions& options);
std::unique_ptr<Stepper> make_alpha_stepper(EquationsOfMotion& equations, const IntegrationOptions& options);

}  // namespace cardan::solvers
