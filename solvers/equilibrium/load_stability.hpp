/// @file
/// Critical loads: flutter and divergence under any loads.
#pragma once

#include "solvers/equilibrium/steady_state.hpp"

#include <string>
#include <vector>

namespace cardan::solvers {

/// Kind of growth of the vibrations about an equilibrium: oscillating (complex eigenvalue) or not (real eigenvalue).
enum class Instability : std::uint8_t { none, flutter, divergence };

struct LoadStabilityOptions {
    double from = 0, to = 1;  ///< range of load factors searched
    int steps = 50;  ///< equal steps of the scan; an instability that appears and disappears within one step is missed
    double tolerance = 1e-9;  ///< width in load factor to which the critical one is narrowed by bisection
    bool gravity = true;      ///< gravity is one of the loads that are scaled; otherwise it acts in full
    /// A mode is unstable if Re(lambda) > growth |lambda|. Choose it above rounding, which makes undamped systems look
    /// unstable, and well below the actual damping ratios. Rounding grows with the frequency range: about 1e-9 for a
    /// beam of 24 elements, 5e-8 for 64.
    double growth = 1e-7;
    int spin = -1;             ///< index of the spin coordinate, which keeps its speed; -1: none
    SteadyOptions state = {};  ///< for the equilibrium at every load factor, which starts from the previous one
};

/// The least stable mode at one load factor of the scan.
struct LoadStabilityPoint {
    double factor;
    Instability kind;    ///< none: stable
    Complex eigenvalue;  ///< the one with the largest Re(lambda) / |lambda|, 1/s
};

/// Result of load_stability(). It converged if an instability was found and narrowed, or if the scan reached `to`
/// without one; otherwise there is no equilibrium at some load factor.
struct [[nodiscard]] LoadStability : Outcome {
    Instability kind = Instability::none;  ///< none: stable as far as the scan went
    double factor = 0;         ///< lowest unstable load factor (within `tolerance`); without instability the last one
    double stable_factor = 0;  ///< largest stable load factor below it; equal to `factor` if the first one is unstable
    Complex eigenvalue;        ///< of the unstable mode at `factor`, 1/s
    std::vector<LoadStabilityPoint> points;  ///< of the scan, in its order
    std::string note;                        ///< that the first load factor is unstable already; usually empty

    double frequency_hz() const { return eigenvalue.imag() / (2 * pi); }
};

/// The dynamic criterion: scans the load factor, finds the equilibrium at each, and reports the lowest factor at which
/// a complex mode of the linearisation grows: flutter if it oscillates, divergence if its eigenvalue is real. The mass
/// matters for flutter. An undamped system is only marginally stable below the critical load (all Re(lambda) = 0), and
/// arbitrarily small damping may lower a flutter load (Ziegler's paradox): include the actual damping.
///
/// With rotation the linearisation is taken at one azimuth, without a multi-blade transformation: use it for systems
/// that do not depend on the azimuth.
///
/// With loops the modes are those of the closed machine, the forces of the loops being part of its stiffness; the first
/// equilibrium starts from the closed position next to `state.initial`. In rotation no loop may turn with the spin:
/// linearise() says so.
/// @throws InputError: from, to not finite or not from < to, steps < 1, tolerance or growth not positive.
/// @throws NumericalError: as steady_state() (periodic states in rotation) and modes().
LoadStability load_stability(const System& system, const LoadStabilityOptions& options = {});

}  // namespace cardan::solvers
