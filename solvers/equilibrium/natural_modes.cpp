#include "solvers/equilibrium/natural_modes.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "solvers/linear/problem_size.hpp"

namespace cardan::solvers {

NaturalModes natural_modes(const System& system, int spin, double rotor_speed) {
    SteadyState state = steady_state(system, spin, {.rotor_speed = rotor_speed});
    require_result(state);
    NaturalModes result{std::move(state.at), system.model.coordinates().free_without(spin), {}};
    check_number_of_unknowns("natural modes", result.unknowns.size());
    result.modes = modes(restrict_to(linearise(system, result.at), result.unknowns));
    return result;
}

}  // namespace cardan::solvers
