#include "elements/turbulence/mann_spectra.hpp"

#include "elements/turbulence/detail/panels.hpp"
#include "elements/turbulence/detail/sheared_wave.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace cardan {

namespace {

using detail::at_nodes;

// Sums over the half k_2 > 0 of Phi exp(i phase), with L and alpha epsilon^(2/3) one: what is odd in k_2 has the sine.
struct HalfPlane {
    Mat3T<Complex> sum = Mat3T<Complex>::Zero();

    void add(const detail::ShearedWave& wave, double weight, double phase_y, double phase_z) {
        const Mat3 Phi = weight * detail::sheared_energy(wave.k0_square) * wave.tensor();
        const Complex turn = std::polar(2.0, phase_z), even = turn * std::cos(phase_y),
                      odd = turn * Complex(0, std::sin(phase_y));
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) sum(i, j) += Phi(i, j) * ((i == 1) == (j == 1) ? even : odd);
    }
};

// Of L = alpha epsilon^(2/3) = 1. Polar in the plane, k_2 = r sin(angle), k_3 = r cos(angle), over ln r. Within k_2 of
// the size of k_1 the tensor changes fast, hence panels of angles that become narrower towards k_2 = 0 on both sides.
// What has many waves over the distance adds up to nothing: it is faded out smoothly.
Mat3T<Complex> unit_spectrum(double k1, double gamma, double dy, double dz) {
    constexpr double inner = 1e-4, outer = 1e5, waves = 50, of_panel = 6;  // the latter as phases, rad
    const double distance = std::hypot(dy, dz);
    const double end = std::min(outer * std::max(k1, 1.0), 1.6 * waves / distance);
    const double low = std::log(std::min(inner * std::min(k1, 1.0), end / 2)), high = std::log(end);
    HalfPlane plane;
    const auto ring = [&](double ln_r, double radial) {
        const double r = std::exp(ln_r), beta = mann_shear(std::hypot(k1, r), gamma);
        const double share = radial * r * r * std::exp(-std::pow(r * distance / waves, 8));
        const int split = 1 + static_cast<int>(r * distance / of_panel);
        const auto add = [&](double angle, double weight) {
            const double k2 = r * std::sin(angle), k3 = r * std::cos(angle);
            for (const double side : {1.0, -1.0})
                plane.add(detail::ShearedWave({k1, k2, side * k3}, beta), weight * share, k2 * dy, side * k3 * dz);
        };
        detail::at_nodes_towards_zero(pi / 2, std::min(k1 / r, 1.0), split, add);
    };
    const int panels = static_cast<int>(std::ceil(high - low));
    const double width = (high - low) / panels;
    for (int i = 0; i < panels; ++i) {
        const double from = low + i * width, to = from + width;
        at_nodes(from, to, 1 + static_cast<int>((std::exp(to) - std::exp(from)) * distance / of_panel), ring);
    }
    return plane.sum;
}

}  // namespace

Mat3T<Complex> mann_cross_spectrum(const MannParameters& parameters, double k1, double dy, double dz) {
    parameters.check();
    require_positive("Mann's spectra", "wave number k1", k1);
    if (!std::isfinite(dy) || !std::isfinite(dz))
        throw InputError("Mann's spectra", "distance", std::isfinite(dy) ? dz : dy, "finite");
    const double L = parameters.length_scale;
    return parameters.dissipation * std::pow(L, 5.0 / 3) * unit_spectrum(k1 * L, parameters.gamma, dy / L, dz / L);
}

Mat3 mann_spectrum(const MannParameters& parameters, double k1) {
    return mann_cross_spectrum(parameters, k1, 0, 0).real();
}

Mat3 mann_spectrum_over_time(const MannParameters& parameters, double frequency, double speed) {
    require_positive("Mann's spectra", "frequency", frequency);
    require_positive("Mann's spectra", "speed", speed);
    const double per_frequency = 2 * pi / speed;
    return 2 * per_frequency * mann_spectrum(parameters, per_frequency * frequency);
}

// Spherical, k_3 = k cos(polar), k_1 = k sin(polar) sin(azimuth) > 0; panels become narrower towards k_1 = 0, where the
// tensor of large eddies changes fast. Beyond the outermost k turbulence is isotropic.
Mat3 mann_covariance(const MannParameters& parameters) {
    parameters.check();
    constexpr double inner = 1e-6, outer = 1e6, narrow = 1e-3;
    HalfPlane space;
    at_nodes(std::log(inner), std::log(outer), 14, [&](double ln_k, double radial) {
        const double k = std::exp(ln_k), beta = mann_shear(k, parameters.gamma);
        at_nodes(0, pi, 4, [&](double polar, double weight) {
            const double across = k * std::sin(polar), k3 = k * std::cos(polar);
            const double share = 2 * weight * radial * k * k * across;
            const auto add = [&](double azimuth, double part) {
                space.add(detail::ShearedWave({across * std::sin(azimuth), across * std::cos(azimuth), k3}, beta),
                          share * part, 0, 0);
            };
            detail::at_nodes_towards_zero(pi / 2, narrow, 1, add);
        });
    });
    Mat3 sum = space.sum.real();
    sum.diagonal().array() += std::pow(outer, -2.0 / 3);  // a third of twice the integral of k^(-5/3)
    return parameters.dissipation * std::cbrt(parameters.length_scale * parameters.length_scale) * sum;
}

}  // namespace cardan
