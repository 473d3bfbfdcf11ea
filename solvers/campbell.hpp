/// @file
/// Campbell diagram: modes over rotor speed, named and tracked.
#pragma once

#include "solvers/identify.hpp"

#include <functional>
#include <span>

namespace cardan::solvers {

/// Rotor speeds first, first + step, ... up to last (kept if reached within 1e-9 step), rev/min -> rad/s.
/// @throws InputError: NaN, step not positive, last below first, more than 100000 speeds.
std::vector<double> rpm_range(double first, double last, double step);

/// The spin coordinate of the rotor: free in the linearised system (its zero pair is left out), or prescribed.
enum class RotorSpin : std::uint8_t { free, prescribed };

/// Frequencies in which frame.
enum class CampbellMethod : std::uint8_t {
    coleman,        ///< fixed frame, by multi-blade transformation: motions of the machine
    frozen_azimuth  ///< equations linearised at azimuth 0 with the rotor frozen there: as published in 2007, no motions
                    ///< of the machine
};

struct CampbellOptions {
    RotorSpin spin = RotorSpin::free;
    CampbellMethod method = CampbellMethod::coleman;
    double max_frequency_hz =
        10;                   ///< branches that stay above are left out (all modes take part in tracking and naming)
    bool keep_shapes = true;  ///< motions of the frames on the machine's lines, for pictures and files
    /// Called after every rotor speed with the numbers done and to do.
    std::function<void(int done, int total)> progress = {};
    /// Asked before every rotor speed: true ends the sweep; what was computed is kept and `complete` is false.
    std::function<bool()> cancelled = {};
};

/// A mode at one rotor speed.
struct CampbellMode {
    Mode mode;
    std::vector<Share> shares;  ///< of the elastic energy, by component
    Vector row_shares;          ///< of the elastic energy, by row (see Campbell::rows)
};

struct CampbellPoint {
    double rotor_speed = 0;  ///< rad/s
    OperatingPoint at;
    std::vector<CampbellMode> modes;  ///< by natural frequency
};

/// A mode followed over rotor speed.
struct Branch {
    std::string name;    ///< "1st blade flap (backward)"
    std::string family;  ///< "blade flap"
    int component = -1;  ///< of Campbell::components
    RotorPattern pattern = RotorPattern::none;
    int harmonic = 1;                 ///< of the azimuth, for whirling patterns (2 and more with five and more blades)
    std::vector<int> mode;            ///< at every point the index in CampbellPoint::modes, -1: none
    std::vector<double> mac;          ///< complex energy MAC with the point before, 1 at the first
    std::vector<bool> doubtful;       ///< tracked with MAC below 0.6, or another name holds clearly more energy there
    std::vector<std::string> mostly;  ///< the name that holds most elastic energy at the point; empty without a mode
};

/// A branch meets a multiple of the rotor speed.
struct Crossing {
    int branch;
    int multiple;        ///< n of nP
    double rotor_speed;  ///< rad/s
    double frequency_hz;
};

/// Complex motion of a frame in a mode: [rotation; displacement of the origin], base axes, azimuth 0, rad and m at unit
/// modal energy (1 J).
struct FrameMotion {
    Vec6T<Complex> motion;
};

struct Campbell {
    std::string machine, source, method, warning;
    RotorSpin spin = RotorSpin::free;
    int blades = 0;
    CoordinateTable coordinates;    ///< all coordinates of the model
    std::vector<int> unknowns;      ///< model index of every row of the modes' shapes
    std::vector<std::string> rows;  ///< their names; blade coordinates with their rotor pattern
    std::vector<Component> components;
    std::vector<std::string> frames;    ///< names of the frames whose motions are kept
    std::vector<Vec3> frame_positions;  ///< undeformed, azimuth 0, m
    std::vector<Polyline> lines;        ///< FrameId counts in `frames`
    std::vector<CampbellPoint> points;
    std::vector<Branch> branches;  ///< by frequency at the first point
    std::vector<Crossing> crossings;
    bool complete = true;  ///< false: the sweep was cancelled

    std::vector<double> rotor_speeds() const;
    /// NaN where the branch has no mode.
    double natural_hz(const Branch& branch, std::size_t point) const;
    double damped_hz(const Branch& branch, std::size_t point) const;
    double damping_ratio(const Branch& branch, std::size_t point) const;
    /// @throws InputError with the names there are.
    const Branch& branch(std::string_view name) const;
    /// Motions of all `frames` in a mode of a branch.
    std::vector<FrameMotion> motion(const Branch& branch, std::size_t point) const;

    std::vector<std::vector<std::vector<FrameMotion>>> motions;  ///< [point][mode][frame], empty without shapes
};

/// Modes at every rotor speed: steady state, linearisation, Coleman transformation, eigenvalues; then identification
/// and tracking by optimal assignment on the complex energy MAC.
/// @throws InputError for an empty list of speeds, speeds that are not finite, not increasing or negative, or fewer
/// than three blades (a rotor with one blade, the isolated blade, is taken in its rotating frame); NumericalError where
/// no constant steady state exists or is found.
Campbell campbell(const System& system, const RotorMap& rotor, std::span<const double> rotor_speed,
                  const CampbellOptions& options = {});

/// Multiples n of the rotor speed that are drawn and looked for crossings: 1, 2, 3 and B, 2B, 3B, 4B.
std::vector<int> rotor_multiples(int blades);

/// Table of names, frequencies and damping at the first, middle and last rotor speed, and of the crossings, for a
/// terminal.
std::string table(const Campbell& diagram);

}  // namespace cardan::solvers
