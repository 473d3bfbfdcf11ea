#include "solvers/equilibrium/natural_modes.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "solvers/linear/loop_reduction.hpp"
#include "solvers/linear/problem_size.hpp"

namespace cardan::solvers {

NaturalModes natural_modes(const System& system, int spin, double rotor_speed, const Vector& start) {
    SteadyState state = steady_state(system, spin, {.rotor_speed = rotor_speed, .initial = start});
    require_result(state);
    NaturalModes result{std::move(state.at), system.model.coordinates().free_without(spin), {}};
    check_number_of_unknowns("natural modes", result.unknowns.size());
    const ReducedSystem reduced = reduce_loops(linearise(system, result.at), result.unknowns);
    result.modes = modes(reduced.system);
    if (!system.loops.empty())
        for (Mode& mode : result.modes) mode.shape = (reduced.shape * mode.shape).eval();
    return result;
}

}  // namespace cardan::solvers
