#include "elements/turbulence/mann_tensor.hpp"

#include "elements/turbulence/detail/sheared_wave.hpp"
#include "elements/wind/iec_class.hpp"
#include "mbs/base/error.hpp"

#include <boost/math/special_functions/beta.hpp>
#include <cmath>

namespace cardan {

void MannParameters::check() const {
    constexpr double largest = 100;  // eddies of 1/L would be turned by more than 89 degrees
    if (!(gamma >= 0 && gamma <= largest))
        throw InputError("Mann's tensor", "gamma", gamma, text("0 (isotropic) to ", largest, "; IEC 61400-1: 3.9"));
    require_positive("Mann's tensor", "length scale L", length_scale);
    require_positive("Mann's tensor", "dissipation alpha epsilon^(2/3)", dissipation);
}

MannParameters iec_mann(double hub_height, double sigma_1) {
    require_positive("Mann's tensor of IEC 61400-1", "height of the hub", hub_height);
    require_positive("Mann's tensor of IEC 61400-1", "sigma_1", sigma_1);
    MannParameters out;
    out.length_scale = 0.8 * iec_turbulence_scale(hub_height);
    out.dissipation = dissipation_of_isotropic(0.55 * sigma_1, out.length_scale);
    return out;
}

double dissipation_of_isotropic(double sigma, double length_scale) {
    return 3 * sigma * sigma / (boost::math::beta(5.0 / 2, 1.0 / 3) * std::cbrt(length_scale * length_scale));
}

double mann_shear(double kL, double gamma) {
    return gamma * std::sqrt(3 / boost::math::beta(1.0 / 3, 5.0 / 2, 1 / (1 + kL * kL))) / kL;
}

namespace {

double mann_energy(const MannParameters& parameters, double k0_square) {
    const double L = parameters.length_scale;
    return parameters.dissipation * std::pow(L, 17.0 / 3) * detail::sheared_energy(k0_square * L * L);
}

}  // namespace

Mat3 mann_tensor(const MannParameters& parameters, const Vec3& k) {
    if (k.squaredNorm() == 0) return Mat3::Zero();
    const detail::ShearedWave wave(k, mann_shear(k.norm() * parameters.length_scale, parameters.gamma));
    return mann_energy(parameters, wave.k0_square) * wave.tensor();
}

Mat3 mann_root(const MannParameters& parameters, const Vec3& k) {
    if (k.squaredNorm() == 0) return Mat3::Zero();
    const detail::ShearedWave wave(k, mann_shear(k.norm() * parameters.length_scale, parameters.gamma));
    return std::sqrt(mann_energy(parameters, wave.k0_square)) * wave.root();
}

}  // namespace cardan
