/// @file
/// Equilibrium at standstill and in steady rotation.
#pragma once

#include "mbs/base/outcome.hpp"
#include "mbs/model/rotor_map.hpp"
#include "mbs/system/system.hpp"

#include <memory>
#include <optional>
#include <string>

namespace cardan::solvers {

/// The rotor turns by itself: the torque on the spin coordinate balances as well, and one quantity more is found. With
/// the rotor speed, that is the speed at which controllers and loads leave the machine; with an input of the system,
/// the demand of pitch or torque that a speed needs. The integral of a controller of the speed has a value then.
struct SteadyTrim {
    std::string input = {};  ///< the one that is found; empty: the rotor speed
};

struct SteadyOptions {
    double rotor_speed = 0;  ///< rate of the spin coordinate, rad/s; where it is trimmed, the start
    double azimuth = 0;      ///< its position, rad
    Vector initial = {};     ///< starting point of the iteration; empty: zero
    Vector states = {};      ///< of the states; empty: as their table says. Those of kind `angle` stay there
    Vector inputs = {};      ///< of the system; empty: as their table says
    std::optional<SteadyTrim> trim = {};
    /// Largest entry of the residual over the stiffness, in rad, or as a fraction of the extent of the tree; of states
    /// over their scale.
    double tolerance = 1e-11;
    int iterations = 60;
};

/// Result of steady_state(); `at` is the last iterate also if it did not converge.
struct [[nodiscard]] SteadyState : Outcome {
    DynamicState at;
    double residual = 0;  ///< as SteadyOptions::tolerance
    int iterations = 0;
};

/// Constant free coordinates and states while only the spin coordinate moves: r(q) = Gamma_abc qd^b qd^c - Q_a = 0 on
/// the free coordinates, the spin being prescribed, and f = 0 of the states; with a trim, r = 0 on the spin too.
/// KINSOL's Newton iteration with line search and the exact Jacobian. Angles count as they are, lengths by the extent
/// of the tree (of a tree without any, by where it starts and how far its springs give), so that units do not matter.
///
/// With loops, their multipliers are unknowns as well, DynamicState::lambda, and phi = 0 their equations; the start
/// is closed first, the spin held. Redundant equations are left out, their multipliers zero.
///
/// With rotation the result is checked at another azimuth: where gravity, an unbalance or two blades make the steady
/// state periodic, there is no constant solution and a NumericalError says so.
///
/// Made once for a system and its spin: only the memory of KINSOL and of the kernels is kept from one state to the
/// next. Keeps a reference to the system; one per thread.
class SteadySolver {
public:
    /// @param spin  index of the spin coordinate, -1: none (then rotor_speed must be zero)
    /// @throws InputError if there is no such coordinate
    SteadySolver(const System& system, int spin);
    SteadySolver(System&&, int) = delete;  // the system must live longer
    ~SteadySolver();
    SteadySolver(const SteadySolver&) = delete;
    SteadySolver& operator=(const SteadySolver&) = delete;

    /// @param result  overwritten, even if it does not converge. From the second call on with the same `result` nothing
    ///                is allocated, unless the solution fails or a force element allocates.  Cost O(n^3) per iteration.
    /// @throws InputError, NumericalError; the solver can be used again
    void solve(const SteadyOptions& options, SteadyState& result);

private:
    class Memory;
    void solve_closed(const SteadyOptions& options, SteadyState& result);
    const System& system_;
    int spin_;
    std::unique_ptr<Memory> memory_;  ///< of systems with, or without, a trim; with loops, of these equations
};

/// A single solution with a temporary SteadySolver.
SteadyState steady_state(const System& system, int spin, const SteadyOptions& options = {});

}  // namespace cardan::solvers
