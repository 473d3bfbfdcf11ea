#include "solvers/periodic/transition.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/finite.hpp"
#include "solvers/algebra/radau.hpp"
#include "solvers/periodic/detail/transition_step.hpp"

#include <memory>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

class RadauSecondOrder : public TransitionStep {
public:
    RadauSecondOrder(const PeriodicSystem& system, int stages)
        : system_(system),
          method_(stages),
          algebra_(method_, system.rows() + system.states_beside(), system.states_beside()) {}

    void set(double t, double h, Matrix& Phi) override {
        for (Index i = 0; i < method_.stages(); ++i) {
            system_.at(t + method_.c(i) * h, at_);
            append_states(at_);
            algebra_.set(i, h, at_.M, at_.C, at_.K);
        }
        algebra_.factorise();
        algebra_.transition(h, Phi);
    }

private:
    const PeriodicSystem& system_;
    RadauIIA method_;
    RadauStage algebra_;
    SecondOrderSystem at_;
};

// Unknowns are the rates at the stages: E_i k_i = A_i (x + h sum_j a_ij k_j), for all unit vectors x. For algebraic
// rows, where E is zero, the last stage makes them hold at the end of the step.
class RadauFirstOrder : public TransitionStep {
public:
    RadauFirstOrder(const PeriodicSystem& system, int stages) : system_(system), method_(stages) {}

    void set(double t, double h, Matrix& Phi) override {
        const Index n = system_.rows(), s = method_.stages();
        Matrix left(s * n, s * n), right(s * n, n);
        for (Index i = 0; i < s; ++i) {
            system_.at(t + method_.c(i) * h, E_, A_);
            for (Index j = 0; j < s; ++j) left.block(i * n, j * n, n, n) = -h * method_.A(i, j) * A_;
            left.block(i * n, i * n, n, n) += E_;
            right.middleRows(i * n, n) = A_;
        }
        solve_in_place(left, right);
        Phi.setIdentity(n, n);
        for (Index j = 0; j < s; ++j) Phi += h * method_.A(s - 1, j) * right.middleRows(j * n, n);
    }

private:
    const PeriodicSystem& system_;
    RadauIIA method_;
    Matrix E_, A_;
};

// x_m = (x_i + x_f) / 2 from E (x_m - x_i) = h/2 A x_m. What E does not touch is algebraic: constant over the step.
class Midpoint : public TransitionStep {
public:
    explicit Midpoint(const PeriodicSystem& system) : system_(system) {}

    void set(double t, double h, Matrix& Phi) override {
        system_.at(t + h / 2, E_, A_);
        Matrix left = E_ - h / 2 * A_;
        Phi = E_;
        solve_in_place(left, Phi);
        for (Index i = 0; i < Phi.rows(); ++i) {
            if (E_.col(i).isZero(0)) continue;
            Phi.row(i) *= 2;
            Phi(i, i) -= 1;
        }
    }

private:
    const PeriodicSystem& system_;
    Matrix E_, A_;
};

std::unique_ptr<TransitionStep> make_step(const PeriodicSystem& system, const TransitionOptions& options) {
    if (options.method == TransitionMethod::midpoint) return std::make_unique<Midpoint>(system);
    if (system.is_second_order()) return std::make_unique<RadauSecondOrder>(system, options.stages);
    return std::make_unique<RadauFirstOrder>(system, options.stages);
}

}  // namespace

std::vector<Matrix> transitions(TransitionStep& step, Index states, double t0, double t1, int intervals, int steps) {
    if (intervals < 1) throw InputError("transition matrix", "number of intervals", intervals, ">= 1");
    if (steps < 1) throw InputError("transition matrix", "number of steps", steps, ">= 1");
    const double h = (t1 - t0) / intervals / steps;
    std::vector<Matrix> all;
    Matrix Phi(states, states), product(states, states);
    for (int i = 0; i < intervals; ++i) {
        Matrix X;
        for (int j = 0; j < steps; ++j) {
            const double t = t0 + h * (static_cast<double>(i) * steps + j);
            // From unit vectors, whose right-hand sides are the matrices themselves.
            step.set(t, h, Phi);
            if (j == 0) {
                X = Phi;
            } else {
                product.setZero();
                add_product(product, Phi, X);
                X.swap(product);
            }
            if (!all_finite(X))
                throw NumericalError(text("transition matrix: no solution of the step at ", t,
                                          " s (singular matrices, or the step is too long)"));
        }
        all.push_back(std::move(X));
    }
    return all;
}

std::vector<Matrix> transitions(const PeriodicSystem& system, double t0, double t1, int intervals, int steps,
                                const TransitionOptions& options) {
    return transitions(*make_step(system, options), system.states(), t0, t1, intervals, steps);
}

Matrix monodromy(const PeriodicSystem& system, int steps, const TransitionOptions& options) {
    return transitions(system, 0, system.period(), 1, steps, options).front();
}

}  // namespace cardan::solvers
