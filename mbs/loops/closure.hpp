/// @file
/// A start that fits: positions and rates that close the loops.
#pragma once

#include "mbs/base/outcome.hpp"
#include "mbs/loops/loops.hpp"

#include <vector>

namespace cardan {

struct ClosureOptions {
    double time = 0;              ///< s
    std::vector<int> fixed = {};  ///< coordinates that stay, by index; driven ones stay anyway
    int iterations = 200;
    /// Largest residual that is left, over the size of what an equation compares: Loops::tolerances().
    double tolerance = 1e-13;
    /// Whether to go on, once the loops are closed, to the closed position nearest to the start in the metric.
    bool nearest = true;
};

/// Outcome of close_loops(); q is the last iterate also where it did not converge.
struct [[nodiscard]] Closure : Outcome {
    Vector q;
    double gap = 0;       ///< largest residual, in the unit of its equation
    double distance = 0;  ///< from the start in the metric there, kg^(1/2) m
    int rank = 0;         ///< of the gradients at q: equations less this number are redundant
    int iterations = 0;
};

/// Closes the loops from a position nearby: Newton's method along the shortest corrections in the metric, then along
/// the closed positions to the one that is nearest to the start.
/// @param q  where to start; fixed and driven coordinates stay
/// @return not converged, with a message that names the joint, where they cannot be closed or only turned over
/// @throws InputError for sizes, indices and values that are not finite
Closure close_loops(const Model& model, const Loops& loops, const Vector& q, const ClosureOptions& options = {});

/// The rates nearest to qd in the metric that keep the loops closed, phi_a qd^a + phi_t = 0.
/// @param q  closed
/// @throws InputError where no rates of the free coordinates do: prescribed ones contradict each other
Vector close_rates(const Model& model, const Loops& loops, const Vector& q, const Vector& qd,
                   const ClosureOptions& options = {});

}  // namespace cardan
