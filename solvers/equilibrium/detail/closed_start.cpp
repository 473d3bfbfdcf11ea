#include "solvers/equilibrium/detail/closed_start.hpp"

#include "mbs/base/error.hpp"
#include "mbs/loops/closure.hpp"
#include "mbs/loops/constraint_factor.hpp"

#include <algorithm>

namespace cardan::solvers {

Vector closed_position(const System& system, int spin, double time, const Vector& q) {
    ClosureOptions options;
    options.time = time;
    if (spin >= 0) options.fixed = {spin};
    Closure closure = close_loops(system.model, system.loops, q, options);
    require_result(closure, "steady state");
    return std::move(closure.q);
}

// With the load r, the multipliers of G g^-1 (r - G^T lambda) = 0.
LoopStart loop_start(const System& system, int spin, double time, const Vector& q, const Vector& load) {
    constexpr double dependent_below = 1e-9;
    const Model& model = system.model;
    const int m = system.loops.size();
    std::vector<bool> driven = model.coordinates().driven();
    if (spin >= 0) driven[static_cast<std::size_t>(spin)] = true;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, q, workspace);
    Matrix G(m, model.size()), magnitudes(m, model.size());
    system.loops.gradient(kin, time, q, G, magnitudes);
    MetricFactor metric(model, driven);
    if (const PivotStatus status = metric.factorise(kin); !status)
        throw NumericalError(text("steady state: ", status.message()));
    ConstraintFactor factor(model, m);
    factor.factorise(metric, G, magnitudes, dependent_below);
    Vector accelerations = load;
    for (int i = 0; i < model.size(); ++i)
        if (metric.is_driven(i)) accelerations(i) = 0;
    metric.solve(accelerations);
    LoopStart start{{factor.independent().begin(), factor.independent().end()}, Vector::Zero(m)};
    std::ranges::sort(start.equations);
    // Multipliers of the independent equations alone.
    const auto r = std::ssize(start.equations);
    Matrix G_r(r, model.size()), magnitudes_r(r, model.size());
    for (Eigen::Index k = 0; k < r; ++k) {
        G_r.row(k) = G.row(entry(start.equations, k));
        magnitudes_r.row(k) = magnitudes.row(entry(start.equations, k));
    }
    ConstraintFactor own(model, static_cast<int>(r));
    own.factorise(metric, G_r, magnitudes_r, 0);
    Vector lambda(r);
    own.multipliers(G_r * accelerations, lambda);
    for (Eigen::Index k = 0; k < r; ++k) start.lambda(entry(start.equations, k)) = lambda(k);
    return start;
}

}  // namespace cardan::solvers
