#include "solvers/buckling.hpp"

#include "mbs/decompositions.hpp"
#include "mbs/error.hpp"
#include "solvers/load_path.hpp"
#include "solvers/modes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cardan::solvers {

namespace {

void check_potential(const Matrix& loads) {
    const double skew = (loads - loads.transpose()).norm(), size = loads.norm();
    if (skew > 1e-7 * size)
        throw InputError("linear buckling", "skew part of the load stiffness over the whole", skew / size,
                         "below 1e-7; the loads have no potential (follower forces, moments about fixed axes, user "
                         "forces), so a dynamic criterion is needed: use load_stability()");
}

Instability kind_of(const Complex& eigenvalue, double growth) {
    if (eigenvalue.real() <= growth * std::abs(eigenvalue)) return Instability::none;
    return eigenvalue.imag() > 0 ? Instability::flutter : Instability::divergence;
}

void check(const LoadStabilityOptions& options) {
    const std::string where = "load stability";
    if (!std::isfinite(options.from) || !std::isfinite(options.to) || !(options.from < options.to))
        throw InputError(where, "load factors from, to", text(options.from, ", ", options.to), "finite and rising");
    if (options.steps < 1) throw InputError(where, "number of steps", options.steps, ">= 1");
    require_positive(where, "tolerance of the load factor", options.tolerance);
    require_positive(where, "growth", options.growth);
}

// The least stable mode about the equilibrium at a load factor.
class Scan {
public:
    Scan(const System& system, const LoadStabilityOptions& options)
        : system_(system), options_(options), unknowns_(system.model.coordinates().free_without(options.spin)) {}

    // None if there is no equilibrium; then `message` says why. `q` is the start and becomes the equilibrium.
    std::optional<LoadStabilityPoint> at(double factor, Vector& q) {
        const System loaded = under_load(system_, factor, options_.gravity);
        SteadyOptions state = options_.state;
        state.initial = q;
        const SteadyState found = steady_state(loaded, options_.spin, state);
        if (!found.converged) {
            message = text("load stability: no equilibrium at load factor ", factor, ": ", found.message);
            return std::nullopt;
        }
        q = found.at.q;
        LoadStabilityPoint point{factor, Instability::none, {}};
        double worst = -2;  // Re / |.| lies between -1 and 1
        for (const Mode& mode : modes(restrict_to(linearise(loaded, found.at), unknowns_))) {
            const double growth = mode.eigenvalue.real() / std::abs(mode.eigenvalue);
            if (growth <= worst) continue;
            worst = growth;
            point.eigenvalue = mode.eigenvalue;
        }
        point.kind = kind_of(point.eigenvalue, options_.growth);
        return point;
    }

    std::string message;

private:
    const System& system_;
    const LoadStabilityOptions& options_;
    std::vector<int> unknowns_;
};

}  // namespace

std::vector<BucklingMode> linear_buckling(const System& system, const BucklingOptions& options) {
    const Eigen::Index n = system.model.size();
    if (options.count < 1) throw InputError("linear buckling", "number of factors", options.count, ">= 1");
    if (options.at.size() != 0 && (options.at.size() != n || !options.at.allFinite()))
        throw InputError("linear buckling", "size of the state", options.at.size(),
                         text(n, " finite values, one per coordinate, or empty"));
    const std::vector<int> free = system.model.coordinates().free();
    if (free.empty()) return {};
    const Vector zero = Vector::Zero(n);
    const Linearisation lin = linearise(system, {options.at.size() > 0 ? options.at : zero, zero, zero, 0});
    Matrix structure = lin.elastic(free, free), loads = lin.loads(free, free);
    (options.gravity ? loads : structure) += lin.gravity(free, free);
    check_potential(loads);
    if (Eigen::LLT<Matrix>(structure).info() != Eigen::Success)
        throw NumericalError(
            "linear buckling: the stiffness without the loads is not positive definite (a mechanism, or gravity has "
            "buckled the structure already); lock or support the free coordinates");

    // (-K_loads) x = mu K x with mu = 1 / factor: the largest mu first.
    const Matrix destabilising = -(loads + loads.transpose()) / 2;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(destabilising, structure);
    if (solver.info() != Eigen::Success)
        throw NumericalError("linear buckling: the eigenvalue iteration did not converge");
    const Vector& mu = solver.eigenvalues();
    const double rounding = 1e-12 * mu.cwiseAbs().maxCoeff();
    std::vector<BucklingMode> result;
    for (Eigen::Index i = mu.size() - 1; i >= 0 && mu(i) > rounding; --i) {
        if (result.size() == static_cast<std::size_t>(options.count)) break;
        const Vector x = solver.eigenvectors().col(i);
        Eigen::Index largest = 0;
        x.cwiseAbs().maxCoeff(&largest);
        BucklingMode mode{1 / mu(i), zero};
        mode.shape(free) = x / x(largest);
        result.push_back(std::move(mode));
    }
    return result;
}

LoadStability load_stability(const System& system, const LoadStabilityOptions& options) {
    check(options);
    Scan scan(system, options);
    LoadStability result;
    Vector q = options.state.initial;
    for (int i = 0; i <= options.steps; ++i) {
        const double factor = i == options.steps
                                  ? options.to
                                  : options.from + (options.to - options.from) * static_cast<double>(i) / options.steps;
        const Vector before = q;
        const auto point = scan.at(factor, q);
        if (!point) {
            result.message = scan.message;
            return result;
        }
        result.points.push_back(*point);
        result.factor = factor;
        result.eigenvalue = point->eigenvalue;
        result.kind = point->kind;
        if (point->kind == Instability::none) {
            result.stable_factor = factor;
            continue;
        }
        result.complete = true;
        if (i == 0) {
            result.stable_factor = factor;
            result.message = text("unstable already at the first load factor ", factor);
            return result;
        }
        q = before;
        while (result.factor - result.stable_factor > options.tolerance) {
            const double middle = (result.factor + result.stable_factor) / 2;
            if (middle <= result.stable_factor || middle >= result.factor) break;
            Vector q_middle = q;
            const auto refined = scan.at(middle, q_middle);
            if (!refined) {
                result.message = scan.message;
                return result;
            }
            if (refined->kind == Instability::none) {
                result.stable_factor = middle;
                q = q_middle;
            } else {
                result.factor = middle;
                result.eigenvalue = refined->eigenvalue;
                result.kind = refined->kind;
            }
        }
        return result;
    }
    result.complete = true;
    return result;
}

}  // namespace cardan::solvers
