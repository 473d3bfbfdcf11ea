// The work that is done within the steps of a method.
#include "solvers/time/detail/stepper.hpp"
#include "solvers/time/integrate.hpp"

#include <array>
#include <span>

namespace cardan::solvers {

// Gauss' formula, as exact as the interpolation within a step: of order 6 beside the long steps of Runge-Kutta methods,
// of order 4 beside the short ones of the others.
bool Integrator::accumulate(double to) {
    if (!options_.integrate_work) return true;
    struct Node {
        double at, weight;  // on -1 ... 1
    };
    static constexpr std::array<Node, 3> three{
        {{-0.77459666924148338, 5.0 / 9}, {0, 8.0 / 9}, {0.77459666924148338, 5.0 / 9}}};
    static constexpr std::array<Node, 2> two{{{-0.57735026918962576, 1}, {0.57735026918962576, 1}}};
    const bool long_steps = options_.method == Method::dirk || options_.method == Method::erk;
    const double half = (to - state_.time) / 2, middle = state_.time + half;
    Work sum = work_;  // kept as it was if a force element throws
    for (const Node& node : long_steps ? std::span<const Node>(three) : std::span<const Node>(two)) {
        const double time = middle + node.at * half, weight = node.weight * half;
        state_at(time, x_between_);
        Powers power;
        if (!equations_.powers(time, x_between_.data(), power)) return false;
        sum.forces += weight * power.forces;
        sum.dissipation += weight * power.dissipation;
        sum.drives += weight * power.drives;
        sum.state_supply += weight * power.states.supplied;
        sum.state_dissipation += weight * power.states.dissipated;
        sum.state_work += weight * power.states.work;
    }
    work_ = sum;
    return true;
}

}  // namespace cardan::solvers
