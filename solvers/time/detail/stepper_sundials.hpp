/// @file
/// Common base of the steppers of CVODE and ARKODE. For sources only: it includes SUNDIALS.
#pragma once

#include "solvers/algebra/detail/sundials_memory.hpp"
#include "solvers/time/detail/newton_matrix.hpp"
#include "solvers/time/detail/stepper.hpp"

#include <exception>
#include <optional>

namespace cardan::solvers {

/// Vectors, error weights, Newton's matrix and the callbacks of the library; `user` there is this class.
class SundialsStepper : public Stepper {
public:
    IntegrationStatistics statistics() const final { return sum(before_, since_start()); }

protected:
    SundialsStepper(const char* library, EquationsOfMotion& equations, const IntegrationOptions& options, int memory);

    // Exceptions must not cross the C library: they are stored and rethrown outside. If only a trial state is affected,
    // a shorter step may be tried.
    static int rates(realtype t, N_Vector x, N_Vector xd, void* user);
    static int weights(N_Vector x, N_Vector w, void* user);
    static int project(realtype t, N_Vector x, void* user);
    int form_matrix(realtype t, N_Vector x, realtype c, booleantype old_will_do, booleantype* is_new);
    void rethrow();

    void use_newton() { newton_.emplace(equations_, context_.get()); }
    /// Counters restart; earlier counts are kept.
    void begin(double time, const double* x, double stop);
    /// The time to pass to the library, which uses it as a scale for its first step.
    double towards(double horizon) const;
    virtual IntegrationStatistics since_start() const = 0;

    /// Estimated local errors and their weights, into errors() and error_weights().
    virtual bool local_errors() = 0;
    /// Reason for which no step was possible, and what limits the step.
    /// @param flag  of the library; not negative: the clock stood still
    std::string explain(int flag, std::string_view advice);

    double* data() { return N_VGetArrayPointer(x_.get()); }
    N_Vector vector() { return x_.get(); }
    N_Vector errors() { return errors_.get(); }
    N_Vector error_weights() { return error_weights_.get(); }
    SUNContext context() { return context_.get(); }

    EquationsOfMotion& equations_;
    ErrorWeights weights_;
    double time_ = 0, stop_ = 0, first_step_;

private:
    std::string reason(int flag) const;

    const char* library_;
    std::exception_ptr thrown_;
    IntegrationStatistics before_;  ///< up to the last start
    // Order of destruction matters: what a derived class owns first, the context last.
    SundialsContext context_;
    SundialsVector x_, errors_, error_weights_;

protected:
    std::optional<NewtonMatrix> newton_;  ///< of the implicit methods
};

}  // namespace cardan::solvers
