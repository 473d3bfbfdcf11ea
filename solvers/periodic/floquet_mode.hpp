/// @file
/// One motion exp(lambda t) p(t), p periodic, of a linear periodic system.
#pragma once

#include "solvers/periodic/periodic_system.hpp"

#include <string>

namespace cardan::solvers {

enum class FloquetKind : std::uint8_t {
    oscillation,  ///< a pair of complex multipliers
    aperiodic,    ///< real exponent, no oscillation prevails
    synchronous,  ///< real multiplier: the motion is locked at a multiple of 2 pi / T while it grows or decays
    subharmonic,  ///< negative multiplier: locked at an odd multiple of pi / T (period doubling)
    rigid  ///< exponent zero: a cyclic coordinate; such exponents come in pairs, and a defective pair (with only one
           ///< eigenvector) is split by rounding into +-sqrt
};

/// x(t) = Re(p(t) exp(exponent t)), p(t) = sum_j c_j exp(i j 2 pi t / T). Of the exponents lambda + i j 2 pi / T, which
/// all describe the same motion, it is the one whose harmonic (then the one with j = 0) holds most energy; of a complex
/// conjugate pair the member with positive frequency.                               [Lee et al. 2002, eqs. 20 and 21]
struct FloquetMode {
    Complex exponent;   ///< growth rate + i principal frequency, 1/s; imaginary part >= 0
    double period = 0;  ///< T, s
    FloquetKind kind = FloquetKind::oscillation;
    /// c_j by column, j = first_harmonic, first_harmonic + 1, ...; rows: coordinates (states in a system of first
    /// order). Energy 1 J as for Mode: sum_j c_j^H K_e c_j + |lambda_j|^2 c_j^H M c_j = 2.
    ComplexMatrix harmonics;
    int first_harmonic = 0;
    /// EnergyFraction of every column in sum_j |lambda_j|^2 c_j^H M c_j + c_j^H K_e c_j, lambda_j = exponent + i j 2 pi
    /// / T; M and K_e averaged over the period. Sums to one.
    Vector participation;
    /// Harmonics of the states beside the coordinates; empty: there are none.
    ComplexMatrix state_harmonics = {};
    /// EnergyFraction of these states in the motion, 0 ... 1: as Mode::state_share, over the period. From 1/2 on it is
    /// their motion and no vibration; then `participation` is that of the harmonics in the states, in units of their
    /// scales, instead of the energy, and the largest state is 1.
    double state_share = 0;
    double condition = 0;  ///< of the exponent: 1 well conditioned, above 1e6 nearly defective (0: not known)
    double error = 0;      ///< estimated, of the exponent, 1/s (NaN: not known)

    bool is_state_motion() const { return state_share >= 0.5; }
    /// exp(lambda T)
    Complex multiplier() const { return std::exp(exponent * period); }
    double growth() const { return exponent.real(); }
    double frequency_hz() const { return exponent.imag() / (2 * pi); }
    /// Principal frequency in multiples of 2 pi / T: per revolution.
    double per_period() const { return exponent.imag() * period / (2 * pi); }
    /// -Re(lambda) / |lambda|
    double damping_ratio() const { return -exponent.real() / std::abs(exponent); }
    /// Participation of harmonic j relative to the principal one (j = 0); 0 outside the range.
    double share(int j) const;
    /// p(t)
    ComplexVector shape(double time) const;
};

/// "oscillation", "locked at 1 per period", "locked at 1/2 per period", "rigid" ...
std::string kind_name(const FloquetMode& mode);

/// Turns it into the other member of a complex conjugate pair.
void conjugate(FloquetMode& mode);

/// x^H A x of a symmetric matrix, a real number.
double hermitian_form(const Matrix& A, const ComplexVector& x);

/// Raw result of a method: a solution exp(lambda t) sum_j c_j exp(i j omega t), with lambda modulo i omega.
struct FloquetSolution {
    Complex exponent;
    bool real_multiplier = false;        ///< over the integrated part of the period
    ComplexMatrix harmonics;             ///< c_j from j = -J to J
    ComplexMatrix state_harmonics = {};  ///< of the states beside the coordinates
    double state_share = 0;
    double condition = 0, error = 0;  ///< in the units of FloquetMode, which takes them over
    bool resolved = true;             ///< by the samples over the period
};

/// Weights of the energies of harmonics.
struct EnergyWeights {
    Matrix M, K;
    Vector scales;  ///< of the states beside the coordinates
    /// Mean over the period of M and K_elastic from `samples` times; for first order K is `weight`.
    /// @throws InputError if the weight has the wrong size
    EnergyWeights(const PeriodicSystem& system, int samples, const Matrix& weight);
};

/// Determines principal frequency, participation, kind and scale.
FloquetMode make_mode(const FloquetSolution& solution, const EnergyWeights& weights, double period);

/// The member with positive imaginary part of each complex conjugate pair among the logarithms (imaginary parts modulo
/// 2 pi), and every real one (imaginary part 0 or pi).
struct Representative {
    std::size_t index;
    bool real;
};
std::vector<Representative> representatives(const std::vector<Complex>& logarithms);

/// Sorts by frequency, then by growth; a rigid complex pair becomes two modes.
void sort_modes(std::vector<FloquetMode>& modes);

}  // namespace cardan::solvers
