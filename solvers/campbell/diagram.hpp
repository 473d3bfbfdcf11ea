/// @file
/// Campbell diagram: modes over rotor speed, named and tracked.
#pragma once

#include "solvers/campbell/energy_shares.hpp"
#include "solvers/linear/rotor_spin.hpp"
#include "solvers/periodic/floquet_mode.hpp"

#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>

namespace cardan::solvers {

/// Rotor speeds first, first + step, ... up to last (kept if reached within 1e-9 step), rev/min -> rad/s.
/// @throws InputError: NaN, step not positive, last below first, more than 100000 speeds.
std::vector<double> rpm_range(double first, double last, double step);

/// How modes are computed, and in which frame.
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

struct Campbell;

/// MAC between consecutive points below which the identity of a mode is doubtful. The MAC values of one mode with
/// others that are orthogonal to each other add up to at most one: above 0.5 only one of them can be the same mode.
inline constexpr double min_reliable_mac = 0.6;

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

/// A mode at one rotor speed.
struct CampbellMode {
    /// For Floquet modes, the principal exponent and the shape of the principal harmonic, scaled to unit energy by
    /// itself; for a rigid motion, to 1 J of kinetic energy at unit rate.
    Mode mode;
    std::vector<Share> shares;  ///< of the elastic energy, by component (sum over the harmonics)
    Vector row_shares;          ///< of the elastic energy, by row (see Campbell::rows)
    /// Each blade's part of the elastic energy of all blades, averaged over the revolution; empty unless the blades
    /// differ or are not evenly spaced, and the method is Floquet's or nothing turns.
    Vector blade_shares = {};
    /// Floquet, with `blade_shares`: the harmonic, counted from the principal one, that holds most of the blades'
    /// elastic energy in their own, turning coordinates.
    int own_harmonic = 0;
    /// For a motion (almost) without elastic energy, the row with most kinetic energy, after which it is named: yaw,
    /// teeter. -1: named after its elastic energy.
    int row = -1;
    /// The full Floquet mode, in multi-blade rows; empty for the other methods and at standstill. Outer harmonics with
    /// less than 1e-12 of the energy are left out.
    std::optional<FloquetMode> floquet = {};

    /// The kind of `floquet` if there is one, else oscillation or aperiodic.
    FloquetKind kind() const;
    /// "oscillation", "aperiodic", "rigid", "locked at 1 per rev", "locked at 1/2 per rev"
    std::string kind_name() const;
};

/// Motion of states of first order rather than of the machine (Mode::is_state_motion()): a lag, a current, an inflow;
/// no vibration, even if it oscillates.
struct StateMotion {
    Mode mode;
    int state = 0;  ///< of Campbell::states: the one that moves most, by its scale
};

struct CampbellPoint {
    double rotor_speed = 0;           ///< rad/s
    DynamicState at;                  ///< steady state, at azimuth 0
    std::vector<CampbellMode> modes;  ///< by natural frequency
    /// Oscillating ones first, each by |eigenvalue|. Of many, few or none: CampbellOptions::all_state_motions.
    std::vector<StateMotion> state_motions = {};
    /// Smallest decay rate of both, except rigid ones, 1/s; negative: unstable. NaN where eigenvalues do not
    /// describe motions (frozen azimuth).
    double stability_margin = std::numeric_limits<double>::quiet_NaN();
    std::optional<PeriodicSteadyState> periodic = {};  ///< where the method is `floquet` or `averaged`
};

/// Damping ratio from which on a frequency says little, whatever the name. There the natural frequency is 9 % from the
/// damped one and the band of half power as wide as four fifths of it; a period leaves 6 % of the motion. More than
/// that lies between models of the air for the flap modes of a blade, which have such damping.
inline constexpr double heavy_damping = 0.4;

/// A mode tracked over rotor speed, along its curve; where two curves exchange their characters in a veering, from one
/// to the other (not in stability_limits()): a mode with three quarters of its energy under a name is in the branch of
/// that name, whatever the rotor speeds asked for, and where there is no doubt the name is the same in every diagram.
struct Branch {
    std::string name;    ///< "1st blade flap (backward)", "1st blade flap (symmetric)", "yaw (rigid)"
    std::string family;  ///< "blade flap", "yaw"
    int component = -1;  ///< of Campbell::components; -1: named after a coordinate
    int row = -1;        ///< of Campbell::rows, for motions without elastic energy
    RotorPattern pattern = RotorPattern::none;
    int harmonic = 1;         ///< of the azimuth, for whirling patterns (2 and more with five and more blades); of
                              ///< RotorPattern::single the place of the blade in RotorMap::blades, from 1
    std::vector<int> mode;    ///< at every point the index in CampbellPoint::modes, -1: none
    std::vector<double> mac;  ///< complex energy MAC with the point before, 1 at the first
    /// True where the mode was tracked with a MAC below `min_reliable_mac`, the component that names it holds less than
    /// half of the elastic energy, another component or pattern has four fifths as much or more, the blades do not move
    /// in the named pattern (or do not whirl), another branch has the name ("another"), the neighbouring variant of the
    /// machine does not confirm it (CampbellOptions::neighbour), or an oscillation has `heavy_damping`.
    std::vector<bool> doubtful;
    std::vector<std::string> doubt;   ///< why, in a few words; empty where it is not
    std::vector<std::string> mostly;  ///< the name with most elastic energy at the point; empty without a mode
    /// At most of its points it is a motion of states rather than of the machine, which stability_limits() follows
    /// too. Its family is the part of the states that move most, "wake", "airfoil lag", and its name has a number.
    bool of_states = false;
};

/// A branch crosses a multiple of the rotor speed.
struct Crossing {
    int branch;
    int multiple;        ///< n of nP
    double rotor_speed;  ///< rad/s
    double frequency_hz;
};

/// Complex motion of a frame in a mode: [rotation; displacement of the origin], base axes, azimuth 0, rad and m at unit
/// modal energy (1 J). For Floquet modes the sum of all harmonics at azimuth 0.
struct FrameMotion {
    Vec6T<Complex> motion;
};

struct Campbell {
    std::string machine, source, method, warning;
    /// For whoever makes a diagram to fill in: what else it holds for ("platform held"), and how accurate its
    /// frequencies are. One line each: before and after the table, in files and titles.
    std::string remark, accuracy;
    /// Why CampbellMethod::automatic took Floquet theory: "the blades differ", "blade 2 of 3 is missing", "two blades",
    /// "the equations are not constant in multi-blade coordinates", "there is no constant steady state" ...; and which
    /// azimuth the modes at standstill belong to, where it matters. Empty: multi-blade coordinates make the equations
    /// constant, or the method was asked for.
    std::string method_reason;
    RotorSpin spin = RotorSpin::free;
    int blades = 0;
    CoordinateTable coordinates;           ///< all coordinates of the model
    std::vector<int> unknowns;             ///< model index of every row of the modes' shapes
    std::vector<std::string> rows;         ///< their names; blade coordinates with their rotor pattern
    std::vector<std::string> states = {};  ///< of the states of first order, likewise
    std::vector<Component> components;
    std::vector<std::string> frames;    ///< names of the frames whose motions are kept
    std::vector<Vec3> frame_positions;  ///< undeformed, azimuth 0, m
    std::vector<Polyline> lines;        ///< FrameId counts in `frames`
    std::vector<CampbellPoint> points;
    std::string parameter;           ///< the parameter that varies from point to point; empty: the rotor speed
    std::vector<double> parameters;  ///< its values, by point; empty: the rotor speeds
    std::vector<Branch> branches;    ///< by frequency at the first point
    std::vector<Crossing> crossings;
    bool complete = true;  ///< false: the sweep was cancelled

    std::vector<double> rotor_speeds() const;
    /// NaN where the branch has no mode.
    double natural_hz(const Branch& branch, std::size_t point) const;
    double damped_hz(const Branch& branch, std::size_t point) const;
    /// Also NaN for rigid motions.
    double damping_ratio(const Branch& branch, std::size_t point) const;
    /// Null where the branch has no mode.
    const CampbellMode* mode(const Branch& branch, std::size_t point) const;
    /// @throws InputError with the names there are.
    const Branch& branch(std::string_view name) const;
    /// Like branch(), but null if there is none.
    const Branch* find_branch(std::string_view name) const;
    /// Motions of all `frames` in a mode of a branch.
    std::vector<FrameMotion> motion(const Branch& branch, std::size_t point) const;

    std::vector<std::vector<std::vector<FrameMotion>>> motions;  ///< [point][mode][frame], empty without shapes
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
/// Likewise, with the speeds written in the call: campbell(system, rotor, {0.0, 1.5, 3.0}).
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
    /// Where its steady state is looked for, and the motion of driven coordinates, such as a pitch that is prescribed,
    /// as PeriodicOptions::start and state_start: columns are harmonics, a single one is constant. Empty: zero, and the
    /// states as their table says; in stability_limits() as they are at the nearest point that it has.
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
/// Likewise, of machines that are made one by one, each after the modes of the one before: what is cancelled has all
/// that belongs to its points. Without any machine the diagram is empty and not complete.
/// @param count  of machines, for CampbellOptions::progress
/// @throws InputError also for CampbellMethod::automatic, which asks for all machines at once
Campbell campbell(const NextCampbellCase& next, std::size_t count, const std::string& parameter,
                  const CampbellOptions& options);

/// "Coleman (fixed frame)", "Floquet (principal frequencies, fixed frame); chosen: the blades differ"
std::string method_in_words(const Campbell& diagram);

/// Table of names, frequencies and damping at the first, middle and last rotor speed, and of the crossings in the upper
/// half of the range, for a terminal. Branches of states are counted in its foot.
/// @param states  these as well
std::string table(const Campbell& diagram, bool states = false);

}  // namespace cardan::solvers
