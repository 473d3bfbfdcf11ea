// Systems linearised about their periodic steady states.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear/loop_reduction.hpp"
#include "solvers/periodic/periodic_system.hpp"

#include <memory>
#include <utility>

namespace cardan::solvers {

namespace {

void check_steady_state(const System& system, const PeriodicSteadyState& about, const std::vector<int>& unknowns) {
    const char* here = "linearised system";
    const int size = system.model.size();
    if (!about.converged) throw InputError(here, "periodic steady state", "not converged", "converged");
    if (about.coefficients.rows() != size)
        throw InputError(here, "rows of the periodic steady state", about.coefficients.rows(),
                         text(size, ", one per coordinate"));
    if (about.state_coefficients.rows() != system.forces.states().size())
        throw InputError(here, "states of the periodic steady state", about.state_coefficients.rows(),
                         text("those of the system, ", system.forces.states().size()));
    for (int i : unknowns)
        if (i < 0 || i >= size) throw InputError(here, "index of a coordinate", i, text("0 ... ", size - 1));
}

}  // namespace

std::vector<int> independent_coordinates(const System& system, const PeriodicSteadyState& about,
                                         const std::vector<int>& unknowns) {
    check_steady_state(system, about, unknowns);
    if (system.loops.empty()) return unknowns;
    constexpr int azimuths = 16;
    Lineariser lineariser(system, LoopState::in_motion);
    std::vector<Linearisation> way(azimuths);
    for (int s = 0; s < azimuths; ++s) lineariser.linearise(about.at(2 * pi * s / azimuths), entry(way, s));
    return independent_on_the_way(way, unknowns, about.spin);
}

PeriodicSystem linearised(const System& system, const PeriodicSteadyState& about, std::vector<int> unknowns,
                          std::vector<int> independent) {
    check_steady_state(system, about, unknowns);
    if (independent.empty()) independent = independent_coordinates(system, about, unknowns);
    struct Memory {
        Lineariser lineariser;
        Linearisation lin;
        PeriodicSteadyState about;
        std::vector<int> unknowns, independent;
    };
    const auto n = std::ssize(independent);
    const auto memory = std::make_shared<Memory>(Memory{Lineariser(system, LoopState::in_motion), Linearisation{},
                                                        about, std::move(unknowns), std::move(independent)});
    return PeriodicSystem::second_order(
        2 * pi / std::abs(about.rotor_speed), n,
        [memory](double time, SecondOrderSystem& out) {
            const PeriodicSteadyState& state = memory->about;
            memory->lineariser.linearise(state.at(state.rotor_speed * time), memory->lin);
            condense_loops(memory->lin, memory->unknowns, memory->independent);
            restrict_to(memory->lin, memory->independent, state.spin, out);
        },
        system.forces.states().size());
}

PeriodicSystem linearised(const System& system, const PeriodicSteadyState& about) {
    return linearised(system, about, system.model.coordinates().free_without(about.spin));
}

}  // namespace cardan::solvers
