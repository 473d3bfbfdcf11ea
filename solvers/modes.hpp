/// @file
/// Complex modes of a second-order system.
#pragma once

#include "solvers/linearise.hpp"

namespace cardan::solvers {

/// x(t) = Re(shape exp(eigenvalue t)); for oscillations the member of the conjugate pair with Im(eigenvalue) > 0.
struct Mode {
    Complex eigenvalue;   ///< 1/s
    ComplexVector shape;  ///< over the rows of the system, unit modal energy x^H K_e x + |lambda|^2 x^H M x = 2 (J)

    bool oscillates() const { return eigenvalue.imag() > 0; }
    double natural_hz() const { return std::abs(eigenvalue) / (2 * pi); }
    double damped_hz() const { return eigenvalue.imag() / (2 * pi); }
    /// Fraction of critical damping, -Re(lambda) / |lambda|.
    double damping_ratio() const { return -eigenvalue.real() / std::abs(eigenvalue); }
};

/// All oscillating modes by natural frequency, then the aperiodic ones (real eigenvalues). Rigid-body modes (|lambda|
/// below 1e-4 of the lowest single-coordinate frequency, as the zero pair of a free rotor) are left out.
/// @throws NumericalError if the mass matrix is not positive definite or the eigenvalue iteration fails.
std::vector<Mode> modes(const SecondOrderSystem& system);

/// Energy product x^H K_e y + conj(lambda_x) lambda_y x^H M y of two modes; complex MAC = |xy|^2 / (xx yy).
Complex energy_product(const SecondOrderSystem& system, const Mode& x, const Mode& y);

/// Share of every row in the elastic energy of a mode, Re conj(x_i) (K_e x)_i over the total: sums to one. Entries of
/// coupled rows (the six coordinates of a beam element) may be negative.
Vector energy_by_row(const SecondOrderSystem& system, const Mode& mode);

}  // namespace cardan::solvers
