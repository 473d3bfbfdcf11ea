/// @file
/// Critical loads: linear buckling under conservative loads, flutter and divergence under any loads.
#pragma once

#include "solvers/equilibrium/steady_state.hpp"

#include <string>
#include <vector>

namespace cardan::solvers {

struct BucklingOptions {
    int count = 1;        ///< number of factors wanted
    bool gravity = true;  ///< gravity is one of the loads that are multiplied, else it belongs to the structure
    Vector at = {};       ///< state q at which the stiffnesses are taken; empty: zero
};

struct BucklingMode {
    double factor;  ///< on the loads
    Vector shape;   ///< over all coordinates, rad or m; largest entry 1
};

/// Linear buckling at standstill: (K_elastic + factor K_loads) shape = 0 with both stiffnesses at one state, so that
/// K_loads is the change of stiffness per unit load: that of the loads themselves and, to first order, that of the
/// elastic stiffness by the deflection under them. The elastic stiffness is constant in joint coordinates for beams
/// that are rigid in shear; those that are not, with extension free, feel their axial force in it. What is neglected is
/// the change of the loads' stiffness through the deflection before buckling, of second order in the load. Dense
/// symmetric eigenproblem over the free coordinates.
///
/// What is rounding of the terms from which the stiffness of wrenches and gravity is summed up (1e-13 of their
/// magnitude) counts as zero: loads that cannot buckle the structure have no factor, not one of 1e16. User forces do
/// not tell their terms; of them a Jacobian that is zero should be an exact zero.
/// @return the lowest positive factors in rising order; fewer than `count` (or none) if the loads have no more
/// @throws InputError if count < 1, if `at` has a wrong size or is not finite, or if K_loads is not symmetric (1e-7 of
/// its norm): follower forces and moments about fixed axes have no potential, may destabilise by flutter without any
/// neighbouring equilibrium, and need load_stability().
/// @throws NumericalError if the structure without these loads is not stable.
[[nodiscard]] std::vector<BucklingMode> linear_buckling(const System& system, const BucklingOptions& options = {});

/// How the vibrations about an equilibrium grow: oscillating (complex eigenvalue) or not (real eigenvalue).
enum class Instability : std::uint8_t { none, flutter, divergence };

struct LoadStabilityOptions {
    double from = 0, to = 1;  ///< load factors between which is searched
    int steps = 50;           ///< equal steps of the scan; an instability that comes and goes within one is overlooked
    double tolerance = 1e-9;  ///< width in load factor to which the critical one is narrowed by bisection
    bool gravity = true;      ///< gravity is one of the loads that are multiplied, else it acts in full
    /// A mode is unstable if Re(lambda) > growth |lambda|: above rounding, which makes undamped systems look unstable,
    /// and well below the damping ratios there are. Rounding grows with the range of frequencies: about 1e-9 for 24
    /// elements of a beam, 5e-8 for 64.
    double growth = 1e-7;
    int spin = -1;             ///< index of the spin coordinate, which keeps its speed; -1: none
    SteadyOptions state = {};  ///< of the equilibrium at every load factor, which starts from the one before it
};

/// The least stable mode at one load factor of the scan.
struct LoadStabilityPoint {
    double factor;
    Instability kind;    ///< none: stable
    Complex eigenvalue;  ///< that with the largest Re(lambda) / |lambda|, 1/s
};

/// Result of load_stability().
struct [[nodiscard]] LoadStability {
    bool complete = false;                 ///< an instability was found, or the scan reached `to` without one
    Instability kind = Instability::none;  ///< none: stable as far as the scan went
    double factor = 0;         ///< lowest unstable load factor (within `tolerance`); without instability the last one
    double stable_factor = 0;  ///< largest stable load factor below it; equal to `factor` if the first one is unstable
    Complex eigenvalue;        ///< of the unstable mode at `factor`, 1/s
    std::vector<LoadStabilityPoint> points;  ///< of the scan, in its order
    std::string message;                     ///< why the scan ended early, empty if it did not

    double frequency_hz() const { return eigenvalue.imag() / (2 * pi); }
};

/// The dynamic criterion: scans the load factor, finds the equilibrium at each, and reports the lowest factor at which
/// a complex mode of the linearisation grows: flutter if it oscillates, divergence if its eigenvalue is real. The mass
/// matters for flutter. An undamped system is on the edge below the critical load (all Re(lambda) = 0), and the
/// smallest damping may lower a flutter load (Ziegler's paradox): include the damping there is.
///
/// With rotation the linearisation is taken at one azimuth, without a multi-blade transformation: use it for systems
/// that do not depend on the azimuth.
/// @throws InputError: from, to not finite or not from < to, steps < 1, tolerance or growth not positive.
/// @throws NumericalError: as steady_state() (periodic states in rotation) and modes().
LoadStability load_stability(const System& system, const LoadStabilityOptions& options = {});

}  // namespace cardan::solvers
