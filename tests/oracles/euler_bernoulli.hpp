#pragma once

namespace cardan::oracles {

/// Uniform Euler-Bernoulli beam of length L: bending frequencies and shapes in closed form.
/// Natural frequency: omega = beta^2 sqrt(EI / (mu L^4)) in rad/s, beta the dimensionless wave number below.
/// [Meirovitch, Analytical Methods in Vibrations, 1967, section 5-10; Blevins 1979, table 8-1]
namespace euler_bernoulli {

/// beta of mode i = 1, 2, ... clamped at x = 0, free at x = L: cos(beta) cosh(beta) = -1.
double cantilever_wave_number(int mode);

/// omega / sqrt(EI / (mu L^4)) = beta^2 of the cantilever, dimensionless.
double cantilever_frequency(int mode);

/// Shape of the cantilever at xi = x / L in [0, 1], 1 at the tip.
double cantilever_shape(int mode, double xi);

/// beta of elastic mode i = 1, 2, ... of the free-free beam: cos(beta) cosh(beta) = 1 (rigid-body modes left out).
double free_free_wave_number(int mode);

/// omega / sqrt(EI / (mu L^4)) = beta^2 of the free-free beam, dimensionless.
double free_free_frequency(int mode);

/// Shape of the free-free beam at xi = x / L in [0, 1], 1 at x = L.
double free_free_shape(int mode, double xi);

}  // namespace euler_bernoulli
}  // namespace cardan::oracles
