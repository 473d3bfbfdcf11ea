#pragma once

namespace cardan::oracles {

/// Beck's column: a uniform cantilever with a compressive tip force that follows the tip's tangent, undamped, slender.
/// Force in EI / L^2, frequency in sqrt(EI / mu L^4).   [Beck, Z. angew. Math. Phys. 3, 1952, 225-228 and 476-477;
/// Bolotin, Nonconservative Problems of the Theory of Elastic Stability, 1963, section 2.3]
namespace beck_column {

/// P^2 + 2 omega^2 (1 + cos a cosh b) + P omega sin a sinh b with a^2, b^2 = sqrt(P^2/4 + omega^2) +- P/2: zero at the
/// natural frequencies.
double frequency_equation(double force, double omega);

/// Determinant of the boundary conditions y(0) = y'(0) = y''(1) = y'''(1) = 0 over the four exponential solutions of
/// y'''' + P y'' - omega^2 y = 0: has the same zeros.
double boundary_determinant(double force, double omega);

/// First two natural frequencies below the flutter load.
struct Frequencies {
    double first, second;
};
Frequencies frequencies(double force);

/// The force at which the first two frequencies merge, and their common value: 20.0509, 11.0156.
struct Flutter {
    double force, omega;
};
Flutter flutter();

/// The force at which the first mode begins to grow with a vanishingly small internal damping, EI (1 + eta d/dt) with
/// eta -> 0: 10.94. With F the frequency equation, growth / eta = -omega^2 / 2 - P F_P / (2 F_W), W = omega^2.
/// [Bolotin and Zhinzher, Int. J. Solids Structures 5, 1969, 965-989]
Flutter flutter_with_vanishing_damping();

}  // namespace beck_column
}  // namespace cardan::oracles
