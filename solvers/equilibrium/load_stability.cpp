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

    struct Found {
        LoadStabilityPoint point;
        Vector q;  // the equilibrium
    };

    // None if there is no equilibrium; then `message` says why.
    std::optional<Found> at(double factor, const Vector& start) {
        const System loaded = under_load(system_, factor, options_.gravity);
        SteadyOptions state = options_.state;
        state.initial = start;
        const SteadyState found = steady_state(loaded, options_.spin, state);
        if (!found.converged) {
            message = text("load stability: no equilibrium at load factor ", factor, ": ", found.message);
            return std::nullopt;
        }
        LoadStabilityPoint point{factor, Instability::none, {}};
        double worst = -2;  // Re / |.| lies between -1 and 1
        for (const Mode& mode : modes(reduce_loops(linearise(loaded, found.at), unknowns_).system)) {
            const double growth = mode.eigenvalue.real() / std::abs(mode.eigenvalue);
            if (growth <= worst) continue;
            worst = growth;
            point.eigenvalue = mode.eigenvalue;
        }
        point.kind = kind_of(point.eigenvalue, options_.growth);
        return Found{point, found.at.q};
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
    Scan::Found stable{{options.from, Instability::none, {}}, options.state.initial};
    std::optional<Scan::Found> unstable;
    // False: there is no equilibrium.
    const auto step_to = [&](double factor) {
        std::optional<Scan::Found> found = scan.at(factor, stable.q);
        if (!found) {
            result.message = scan.message;
            return false;
        }
        if (found->point.kind == Instability::none)
            stable = std::move(*found);
        else
            unstable = std::move(found);
        const LoadStabilityPoint& last = unstable ? unstable->point : stable.point;
        result.factor = last.factor;
        result.eigenvalue = last.eigenvalue;
        result.kind = last.kind;
        result.stable_factor = stable.point.factor;
        return true;
    };
    for (int i = 0; i <= options.steps && !unstable; ++i) {
        const double factor = i == options.steps
                                  ? options.to
                                  : options.from + (options.to - options.from) * static_cast<double>(i) / options.steps;
        if (!step_to(factor)) return result;
        result.points.push_back({result.factor, result.kind, result.eigenvalue});
    }
    if (result.points.size() == 1 && unstable)
        result.note = text("unstable already at the first load factor ", result.factor);
    while (unstable && result.factor - result.stable_factor > options.tolerance) {
        const double middle = (result.factor + result.stable_factor) / 2;
        if (middle <= result.stable_factor || middle >= result.factor) break;
        if (!step_to(middle)) return result;
    }
    result.converged = true;
    return result;
}

}  // namespace cardan::solvers
