#include "solvers/equilibrium/load_stability.hpp"

#include "mbs/base/error.hpp"
#include "solvers/equilibrium/equilibrium_path.hpp"
#include "solvers/linear/loop_reduction.hpp"
#include "solvers/linear/modes.hpp"

#include <cmath>
#include <optional>

namespace cardan::solvers {

namespace {

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
        for (const Mode& mode : modes(reduce_loops(linearise(loaded, found.at), unknowns_).system)) {
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
        if (i == 0) {
            result.stable_factor = factor;
            result.note = text("unstable already at the first load factor ", factor);
            break;
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
        break;
    }
    result.converged = true;
    return result;
}

}  // namespace cardan::solvers
