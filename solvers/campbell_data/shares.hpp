/// @file
/// Parts of a mode's elastic energy, by component mode and rotor pattern.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cardan::solvers {

/// Participation of the blades: a rotor mode is collective or whirls; at standstill (and at a frozen azimuth) nothing
/// whirls, and the pair is cosine (blade 1 against the others, couples with tilt) and sine (couples with yaw). Two
/// blades deflect alike, each seen from its own root (symmetric), or opposite to each other (antisymmetric): in a
/// symmetric mode both flap out of plane in the same direction, or both lag behind the rotor [Lee et al. 2002,
/// results]. Other parts have no pattern.
enum class RotorPattern : std::uint8_t {
    none,
    collective,
    backward,
    forward,
    cosine,
    sine,
    differential,
    symmetric,
    antisymmetric,
    single  ///< one blade moves, of several that differ
};

/// "none", "collective", "backward" ...
const char* pattern_name(RotorPattern pattern);

/// One mode of a part with everything else clamped.
struct Component {
    std::string part;
    std::string family;     ///< "tower fore-aft", "blade flap", ...
    int ordinal = 1;        ///< within its family, by frequency
    double clamped_hz = 0;  ///< where blades differ, of the first blade that has it
    bool of_blades = false;
    bool whirls = false;  ///< isotropic in two planes, like a shaft with a disc: only backward and forward patterns
};

/// Energy of a whirling pair of one harmonic n of the azimuth.
struct WhirlShare {
    double cosine = 0, sine = 0;
    double whirl = 0;  ///< (forward - backward) / (forward + backward) in -1 ... 1
    double of(RotorPattern pattern) const;
};

/// The elastic energy of a mode in one component.
struct EnergyFraction {
    int component = -1;
    /// Fractions of the total elastic energy; everything is in `collective` if there is no pattern. Of blades without
    /// multi-blade coordinates that of the mean motion is in `collective`, the rest in `differential`.
    double collective = 0, cosine = 0, sine = 0, differential = 0;
    double whirl = 0;  ///< (forward - backward) / (forward + backward) in -1 ... 1 of the cosine and sine energy
    std::vector<WhirlShare> higher = {};  ///< harmonics 2, 3, ... (five and more blades)
    double total() const;
    double of(RotorPattern pattern, int harmonic = 1) const;
};

}  // namespace cardan::solvers
