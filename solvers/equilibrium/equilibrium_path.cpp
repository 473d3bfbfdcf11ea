#include "solvers/equilibrium/equilibrium_path.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear/loop_reduction.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

void check(const EquilibriumPathOptions& options) {
    const std::string where = "load path";
    if (options.factors.empty() && options.steps < 1) throw InputError(where, "number of steps", options.steps, ">= 1");
    for (std::size_t i = 0; i < options.factors.size(); ++i) {
        const double factor = options.factors[i];
        if (!std::isfinite(factor)) throw InputError(where, text("load factor ", i + 1), factor, "finite");
        if (i > 0 && !(factor > options.factors[i - 1]))
            throw InputError(where, text("load factor ", i + 1), factor,
                             text("> ", options.factors[i - 1], ", the one before it (strictly increasing)"));
    }
    require_positive(where, "smallest step of the load factor", options.smallest_step);
    if (!(options.largest_change > 0))
        throw InputError(where, "largest change of a coordinate", options.largest_change, "> 0");
    require_not_negative(where, "tolerance of the loss of stability", options.stability_tolerance);
}

std::vector<double> targets(const EquilibriumPathOptions& options) {
    if (!options.factors.empty()) return options.factors;
    std::vector<double> factors;
    for (int i = 0; i <= options.steps; ++i) factors.push_back(static_cast<double>(i) / options.steps);
    return factors;
}

// Result of one attempt: a point, or the reason why there is none.
struct Attempt {
    std::optional<EquilibriumPathPoint> point;
    std::string reason;
    bool finer_may_help = true;
};

class Path {
public:
    Path(const System& system, const EquilibriumPathOptions& options)
        : system_(system), options_(options), unknowns_(system.model.coordinates().free_without(options.spin)) {}

    Attempt solve(double factor, const Vector& start) const {
        const System loaded = under_load(system_, factor, options_.gravity);
        SteadyOptions state = options_.state;
        state.initial = start;
        Attempt attempt;
        try {
            const SteadyState found = steady_state(loaded, options_.spin, state);
            if (!found.converged) {
                attempt.reason = found.message;
                return attempt;
            }
            const Matrix K = static_stiffness(reduce_loops(linearise(loaded, found.at), unknowns_).system);
            attempt.point = {factor, found.at, found.iterations, found.residual, negative_pivots(K)};
        } catch (const NumericalError& error) {  // no constant state at all
            attempt.reason = error.what();
            attempt.finer_may_help = false;
        }
        return attempt;
    }

    // From the last point of the path; the start is extrapolated along the secant of the last two.
    Attempt step_to(double factor, const std::vector<EquilibriumPathPoint>& points) const {
        const EquilibriumPathPoint& last = points.back();
        Vector start = last.at.q;
        if (points.size() > 1) {
            const EquilibriumPathPoint& other = points[points.size() - 2];
            start += (factor - last.factor) / (last.factor - other.factor) * (last.at.q - other.at.q);
        }
        Attempt attempt = solve(factor, start);
        if (!attempt.point) return attempt;
        const Vector change = (attempt.point->at.q - last.at.q)(unknowns_);
        const double largest = change.size() > 0 ? change.cwiseAbs().maxCoeff() : 0;
        if (!(largest <= options_.largest_change)) {
            attempt.point.reset();
            attempt.reason = text("the equilibrium found there is ", largest,
                                  " rad or m away from the last one (allowed: ", options_.largest_change,
                                  "), perhaps behind a snap-through");
        }
        return attempt;
    }

    // Bisection between two neighbouring points with different numbers of negative pivots.
    StabilityChange narrow(EquilibriumPathPoint a, EquilibriumPathPoint b) const {
        while (options_.stability_tolerance > 0 && b.factor - a.factor > options_.stability_tolerance) {
            // Exactly at the load where the stiffness is singular there may be no solution: then try next to it.
            Attempt attempt;
            for (const double part : {0.5, 0.4, 0.6}) {
                const double factor = a.factor + part * (b.factor - a.factor);
                if (factor <= a.factor || factor >= b.factor) break;
                attempt = solve(factor, a.at.q + part * (b.at.q - a.at.q));
                if (attempt.point) break;
            }
            if (!attempt.point) break;
            (attempt.point->negative_pivots == a.negative_pivots ? a : b) = *attempt.point;
        }
        return {a.factor, b.factor, a.negative_pivots, b.negative_pivots};
    }

private:
    const System& system_;
    const EquilibriumPathOptions& options_;
    std::vector<int> unknowns_;
};

std::string early_end(const EquilibriumPath& path, double tried, const EquilibriumPathOptions& options,
                      const Attempt& attempt) {
    const EquilibriumPathPoint& last = path.points.back();
    std::string message =
        text("load path ended at load factor ", last.factor, ", the step to ", tried, " failed: ", attempt.reason);
    if (!attempt.finer_may_help) return message;
    message +=
        text(". The last converged state is kept. The next step would be smaller than ", options.smallest_step,
             ": allow smaller steps (smallest_step) or more of them; if that does not help, the load has a limit "
             "here (buckling or snap-through; negative pivots in the last state: ",
             last.negative_pivots, ")");
    return message;
}

}  // namespace

System under_load(const System& system, double factor, bool gravity) {
    System loaded = system;
    loaded.forces = system.forces.with_load_factor(factor, gravity);
    return loaded;
}

int negative_pivots(const Matrix& stiffness) {
    if (stiffness.rows() == 0) return 0;
    Matrix K = (stiffness + stiffness.transpose()) / 2;
    for (Eigen::Index i = 0; i < K.rows(); ++i) {
        const double k = std::abs(K(i, i)), scale = k > 0 ? 1 / std::sqrt(k) : 1.0;
        K.row(i) *= scale;
        K.col(i) *= scale;
    }
    const Vector eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix>(K, Eigen::EigenvaluesOnly).eigenvalues();
    const double limit = -1e-12 * eigenvalues.cwiseAbs().maxCoeff();
    return static_cast<int>((eigenvalues.array() < limit).count());
}

EquilibriumPath equilibrium_path(const System& system, const EquilibriumPathOptions& options) {
    check(options);
    const Path solver(system, options);
    const std::vector<double> factors = targets(options);
    EquilibriumPath path;

    const Attempt first = solver.solve(factors.front(), options.state.initial);
    if (!first.point) {
        path.message = text("load path: no state at the first load factor ", factors.front(), ": ", first.reason);
        return path;
    }
    path.points.push_back(*first.point);
    for (std::size_t i = 1; i < factors.size(); ++i) {
        double step = factors[i] - path.points.back().factor;
        while (path.points.back().factor < factors[i]) {
            const double last = path.points.back().factor;
            const double factor = last + step < factors[i] - 1e-9 * step ? last + step : factors[i];
            const Attempt attempt = solver.step_to(factor, path.points);
            if (attempt.point) {
                if (!path.stability_change && attempt.point->negative_pivots != path.points.front().negative_pivots)
                    path.stability_change = solver.narrow(path.points.back(), *attempt.point);
                path.points.push_back(*attempt.point);
                step *= 2;
                continue;
            }
            ++path.failed_steps;
            step = (factor - last) / 2;
            if (!attempt.finer_may_help || step < options.smallest_step || last + step <= last) {
                path.message = early_end(path, factor, options, attempt);
                return path;
            }
        }
    }
    path.converged = true;
    return path;
}

}  // namespace cardan::solvers
