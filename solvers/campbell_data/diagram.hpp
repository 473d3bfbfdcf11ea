/// @file
/// A Campbell diagram as data: modes at every point, and the branches that they make.
#pragma once

#include "solvers/campbell_data/shares.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/linear/rotor_spin.hpp"
#include "solvers/periodic/floquet_mode.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cardan::solvers {

/// MAC between consecutive points below which the identity of a mode is doubtful. The MAC values of one mode with
/// others that are orthogonal to each other add up to at most one: above 0.5 only one of them can be the same mode.
inline constexpr double min_reliable_mac = 0.6;

/// A mode at one rotor speed.
struct CampbellMode {
    /// For Floquet modes, the principal exponent and the shape of the principal harmonic, scaled to unit energy by
    /// itself; for a rigid motion, to 1 J of kinetic energy at unit rate.
    Mode mode;
    std::vector<EnergyFraction> shares;  ///< of the elastic energy, by component (sum over the harmonics)
    Vector row_shares;                   ///< of the elastic energy, by row (see Campbell::rows)
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
    /// Reason why CampbellMethod::automatic took Floquet theory: "the blades differ", "blade 2 of 3 is missing", "two
    /// blades", "the equations are not constant in multi-blade coordinates", "there is no constant steady state" ...;
    /// and which azimuth the modes at standstill belong to, where it matters. Empty: multi-blade coordinates make the
    /// equations constant, or the method was asked for.
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

/// "Coleman (fixed frame)", "Floquet (principal frequencies, fixed frame); chosen: the blades differ"
std::string method_in_words(const Campbell& diagram);

/// Table of names, frequencies and damping at the first, middle and last rotor speed, and of the crossings in the upper
/// half of the range, for a terminal. Branches of states are counted in its foot.
/// @param states  these as well
std::string table(const Campbell& diagram, bool states = false);

}  // namespace cardan::solvers
