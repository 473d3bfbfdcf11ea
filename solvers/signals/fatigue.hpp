/// @file
/// Cycles of a load by rainflow counting, and the sinusoidal load that damages as much.
///
///     const std::vector<double> moment = history.values("RootMyc1");
///     const double one_hertz = solvers::equivalent_load(solvers::rainflow(moment), 10, duration);
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cardan::solvers {

/// Half cycles that are left when all closed ones are counted.
enum class Residue : std::uint8_t {
    half,    ///< each range counts as half a cycle [ASTM E1049-85, 5.4.4]
    full,    ///< as a whole one
    repeat,  ///< the signal begins anew at its end: cycles are counted that close then
    dropped
};

struct LoadCycle {
    double range = 0;  ///< from trough to peak, in units of the signal
    double mean = 0;   ///< of trough and peak
    double count = 1;  ///< 1/2: half a cycle
};

/// Rainflow counting of the turning points, without classes. Values that follow their equals are left out, the first
/// and the last value are turning points. A NaN is refused, so that a gap is not counted over.
/// @return in the order in which the cycles close, the residue last; empty: the signal is constant
/// @throws InputError for a value that is not finite
std::vector<LoadCycle> rainflow(std::span<const double> signal, Residue residue = Residue::half);

/// Correction of ranges for their means, after Goodman: S (u - |fixed_mean|) / (u - |mean|).
struct MeanCorrection {
    double ultimate = 0;    ///< u, the ultimate load, in units of the signal
    double fixed_mean = 0;  ///< that of the corrected cycles
};

/// Range of the sinusoidal load with `cycles` cycles that damages as much as these: (sum n S^m / cycles)^(1/m), with
/// the whole ranges S from trough to peak.
/// @param exponent  m, of the material's S-N curve, > 0: about 4 for welded steel, 10 for laminates of glass fibre
/// @param cycles    > 0; for one at 1 Hz the duration of the signal, s
/// @throws InputError also for a mean beyond the ultimate load
double equivalent_load(std::span<const LoadCycle> counted, double exponent, double cycles,
                       const std::optional<MeanCorrection>& correction = {});

}  // namespace cardan::solvers
