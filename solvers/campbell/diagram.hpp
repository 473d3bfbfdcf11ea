/// @file
/// Campbell diagrams are made here: modes over rotor speed or another parameter, named and tracked.
#pragma once

#include "solvers/campbell_data/diagram.hpp"

#include <functional>
#include <initializer_list>
#include <optional>
#include <span>

namespace cardan::solvers {

/// Rotor speeds first, first + step, ... up to last (kept if reached within 1e-9 step), rev/min -> rad/s.
/// @throws InputError: NaN, step not positive, last below first, more than 100000 speeds.
std::vector<double> rpm_range(double first, double last, double step);

/// Method by which modes are computed, and in which frame.
enum class CampbellMethod : std::uint8_t {
    automatic,  ///< `coleman` where the equations are constant in multi-blade coordinates, else `floquet`: two blades,
                ///< blades that differ, gravity on coned or bent blades; Campbell::method says which and why
    coleman,    ///< fixed frame, by multi-blade transformation; three or more blades
    frozen_azimuth,  ///< equations linearised at azimuth 0 with the rotor frozen there: not true motions of the machine
    floquet,  ///< motions about the periodic steady state by Floquet theory, in multi-blade rows: any number of blades,
              ///< gravity, unequal blades. The frequencies are principal ones: in the fixed frame, except those of
              ///< blade modes of rotors with two blades or without multi-blade coordinates, and of modes that are named
              ///< after one blade, which are in the rotating frame
    averaged  ///< as `floquet`, but eigenvalues of the multi-blade system averaged over the azimuth: an approximation,
              ///< for comparison; three or more blades
};

/// For CampbellMethod::floquet (and, apart from the accuracy settings, averaged).
struct CampbellFloquetOptions {
    /// Harmonics of the revolution in the periodic steady state. Their number is raised by half at a time, to at most 4
    /// times as many, while the neglected harmonics have a residual / stiffness above 1e-5.
    int harmonics = 8;
    std::vector<int> fixed_means = {};  ///< as PeriodicOptions::fixed_means
    double per_period =
        0;  ///< modes up to this frequency, in multiples of the rotor speed, are accurate; 0: up to `max_frequency_hz`
    double tolerance = 1e-9;  ///< of exponents, relative to them or to the rotor speed, whichever is larger
    int max_steps = 0;        ///< per revolution; 0: 4096 or 64 times the largest frequency per revolution
};

struct CampbellOptions {
    RotorSpin spin = RotorSpin::free;
    /// The rotor turns as fast as torques and controllers make it (SteadyTrim): the given speeds are starts, and points
    /// have the speed that is found. For the closed loop of a machine with its loads, one CampbellCase for each wind;
    /// methods that end in constant equations only.
    bool balanced = false;
    CampbellMethod method = CampbellMethod::automatic;
    double max_frequency_hz = 10;  ///< branches that stay above are left out
    /// Constant systems: all modes at every rotor speed take part in tracking, naming and stability margin. Otherwise
    /// all at the first one; at the others the lowest 24 at least, those up to one and a half times the largest
    /// frequency, and as many more as move into these by two per revolution: a small part of the cost for large
    /// machines. What is faster is not known to be stable there.
    bool all_modes = false;
    /// Constant systems with many states of first order (has_many_states()), as with the air on sections: all motions
    /// of states, by a dense solver. Otherwise, unless `all_modes`, modes of the motion only (ModeSolver::solve()),
    /// also at the first speed; the stability margin is theirs, and that nothing else grows is known.
    bool all_state_motions = false;
    bool keep_shapes = true;  ///< motions of the frames on the machine's lines, for pictures and files
    CampbellFloquetOptions floquet = {};
    /// Diagram of a similar variant of the machine, with the same method and number of blades: branches take over the
    /// names they have there, matched at the rotor speeds common to both by the complex energy MAC, or, where the rows
    /// differ (another mesh) or the neighbour is from a file, by how the lines of blades and tower move. A name is
    /// doubtful where the MAC is below `min_reliable_mac` or two candidates compete, and everywhere if the neighbour
    /// has no such branch (it should have at least as many: use the same `max_frequency_hz`). Motions named after a
    /// coordinate are not matched. Null: names from the elastic energy alone. Must outlive the call. Not for a diagram
    /// over another parameter, which is tracked from one machine to the next anyway.
    const Campbell* neighbour = nullptr;
    /// Called after every rotor speed with the numbers done and to do.
    std::function<void(int done, int total)> progress = {};
    /// Asked before every rotor speed and in the search of its periodic steady state: true ends the sweep; what was
    /// computed is kept and `complete` is false.
    std::function<bool()> cancelled = {};
};

/// Modes at every rotor speed: steady state, linearisation, Coleman transformation (or Floquet theory where that
/// does not make the equations constant), eigenvalues; then identification
/// and tracking by optimal assignment on the complex energy MAC. A rotor with one blade is taken in its rotating
/// frame (an isolated blade with prescribed spin, RotorMap::hub_is_driven); a rotor without blades, a disc on a shaft,
/// in the fixed frame, where it whirls.
///
/// With Floquet theory the steady state is periodic and its iteration starts from that of the previous speed; modes are
/// named after the elastic energy of all harmonics, and the MAC compares all harmonics, allowing for shifts by
/// multiples of the rotor speed. Motions without elastic energy (free yaw, teeter) are branches too. At standstill the
/// machine is linearised at azimuth 0.
/// @throws InputError for an empty list of speeds, speeds that are not finite, not increasing or negative, two blades
/// with `coleman` or `averaged`, no rotor for `floquet` and `averaged`, a neighbour of another kind or without a
/// common speed, and options out of range; NumericalError where no (constant or periodic) steady state exists or is
/// found.
Campbell campbell(const System& system, const RotorMap& rotor, std::span<const double> rotor_speed,
                  const CampbellOptions& options = {});
/// Takes the speeds as they are written in the call: campbell(system, rotor, {0.0, 1.5, 3.0}).
inline Campbell campbell(const System& system, const RotorMap& rotor, std::initializer_list<double> rotor_speed,
                         const CampbellOptions& options = {}) {
    return campbell(system, rotor, std::span<const double>(rotor_speed.begin(), rotor_speed.size()), options);
}

/// One point of a diagram of machines that differ.
struct CampbellCase {
    const System* system = nullptr;
    const RotorMap* rotor = nullptr;
    double rotor_speed = 0;  ///< rad/s
    double parameter = 0;    ///< its place on the axis
    /// Start of the search for its steady state, and the motion of driven coordinates, such as a pitch that is
    /// prescribed, as PeriodicOptions::start and state_start: columns are harmonics, a single one is constant. Empty:
    /// zero, and the states as their table says; in stability_limits() as they are at the nearest point that it has.
    Matrix start = {}, state_start = {};
};

/// Modes over a parameter other than rotor speed, such as the rigidity of the tower, or over the rotor speed where the
/// machine changes with it, as its pitch and the wind do: modes are tracked from one machine to the next; all must have
/// the same coordinates. Data of the machine in the diagram are those of the first.
/// @param parameter  what the parameter is, with its unit, for axes and tables (and no crossings); empty: the rotor
/// speed
/// @throws InputError also for parameters that are not finite or not increasing, and machines whose rows or component
/// modes have other names than those of the first, or a neighbour in the options
Campbell campbell(std::span<const CampbellCase> cases, const std::string& parameter,
                  const CampbellOptions& options = {});

/// Makes the next machine of a diagram, or says that there are no more. What it points to lives until the diagram is
/// there.
using NextCampbellCase = std::function<std::optional<CampbellCase>()>;
/// Modes of machines that are made one by one, each after the modes of the one before: what is cancelled has all
/// that belongs to its points. Without any machine the diagram is empty and not complete.
/// @param count  of machines, for CampbellOptions::progress
/// @throws InputError also for CampbellMethod::automatic, which asks for all machines at once
Campbell campbell(const NextCampbellCase& next, std::size_t count, const std::string& parameter,
                  const CampbellOptions& options);

}  // namespace cardan::solvers
