/// @file
/// Spectra of a box of wind, at its points, between them, and from a turning blade.
///
///     const WindBox& box = ...;
///     const PowerSpectrum u = in_bands(power_spectrum(spectrum_lines(series_at(box, 0, 15, 15))), 10);
///     const Coherence apart = coherence_across(box, 0, 4);  // of points four columns apart
#pragma once

#include "elements/turbulence/spectrum_lines.hpp"
#include "elements/wind/wind_box.hpp"

#include <functional>

namespace cardan {

/// A component of the velocity at a point of the grid over all planes, m/s.
/// @param component  0, 1, 2: u, v, w
/// @throws InputError for a component, a row, a column that there is not
TimeSeries series_at(const WindBox& box, int component, int row, int column);

/// Choices of the points whose coherence is averaged.
struct CoherenceOptions {
    int per_decade = 8;  ///< bands
    int rows = 8;        ///< at most so many rows are taken, evenly spaced over the grid
    /// Called now and then; true ends the work.
    std::function<bool()> cancelled = {};
};

/// The coherence of a component between all points of the same row that are so many columns apart, as one.
/// @param columns_apart  1 ... columns - 1
/// @return empty if it was cancelled
/// @throws InputError for a component, a distance, options out of range
Coherence coherence_across(const WindBox& box, int component, int columns_apart, const CoherenceOptions& options = {});
/// Computes the coherence for several distances, whose points are transformed once.
std::vector<Coherence> coherences_across(const WindBox& box, int component, std::span<const int> columns_apart,
                                         const CoherenceOptions& options = {});

/// A point of a blade that turns steadily in the plane x = 0, clockwise as seen along the wind.
struct TurningPoint {
    double hub_height = 0;   ///< m
    double radius = 0;       ///< m
    double rotor_speed = 0;  ///< rad/s
    double azimuth = 0;      ///< at t = 0, rad; 0: upward

    /// (0, -radius sin(psi), hub_height + radius cos(psi)), psi = azimuth + rotor_speed t.
    Vec3 place(double time) const;
};

/// The series that a turning point sees of a component in axes that do not turn (rotational sampling), m/s, from t = 0
/// over the length of the box.
/// @param step  s; 0: that of the box
/// @throws InputError for a circle that leaves the grid, unless OutsideBox says what is there, and for numbers out of
/// range
TimeSeries series_at(const WindBox& box, int component, const TurningPoint& point, double step = 0);

/// The spectrum that a turning point sees: the mean over so many azimuths at t = 0, evenly spaced, with a Hann window,
/// as the circle does not close with the box.
/// @throws InputError as series_at(), and for a number of azimuths below 1
PowerSpectrum turning_spectrum(const WindBox& box, int component, const TurningPoint& point, int azimuths = 12);

/// The one-sided spectrum, (m/s)^2/Hz, that a turning point sees of a homogeneous wind:
///
///     S_r(f) = sum_n S(|f - nP|) c_n(|f - nP|),      P = Omega/2 pi,
///     c_n(f) = 1/2pi integral gamma(f, 2 r sin(theta/2)) cos(n theta) dtheta
///
/// with the one-sided spectrum S of a fixed point and the coherence gamma at a distance: what is coherent around the
/// circle comes back at multiples of P [J. R. Connell, Solar Energy 29 (1982) 363; L. Kristensen, S. Frandsen, J. Wind
/// Eng. Ind. Aerodyn. 10 (1982) 249]. The circle's integral is Simpson's rule over 1024 steps from 0 to pi: an error of
/// 1e-4 for an exponential coherence of decay 12 up to f r/V = 10. Coarse circles alias: the trapezoidal rule over 128
/// angles is wrong by 1 % at f r/V = 3.
/// @param spectrum   S(f), (m/s)^2/Hz; is not asked for f = 0, at which nothing is
/// @param coherence  gamma(f, d), d in m
/// @param radius     r, m
/// @param rotor_speed  Omega, rad/s
/// @param frequency    f, Hz
/// @param harmonics    |n| up to here; 0: f/P + 24, at most 120
/// @throws InputError for a radius, a speed or a frequency that is not positive, harmonics outside 0 ... 120
double turning_spectrum(const std::function<double(double f)>& spectrum,
                        const std::function<double(double f, double distance)>& coherence, double radius,
                        double rotor_speed, double frequency, int harmonics = 0);

}  // namespace cardan
