#include "tests/oracles/pendulum.hpp"

#include "tests/oracles/jacobi_elliptic.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cardan::oracles {

SwingingPendulum::SwingingPendulum(double omega0, double amplitude) : omega0_(omega0), k_(std::sin(0.5 * amplitude)) {
    if (!(omega0 > 0.0)) throw std::invalid_argument("SwingingPendulum: omega0 must be positive");
    if (!(amplitude >= 0.0 && amplitude < std::numbers::pi)) {
        throw std::invalid_argument("SwingingPendulum: amplitude must lie in [0, pi)");
    }
    quarter_ = complete_elliptic_k(k_);
}

double SwingingPendulum::period() const {
    return 4.0 * quarter_ / omega0_;
}

double SwingingPendulum::angle(double time) const {
    return 2.0 * std::asin(k_ * jacobi_elliptic(omega0_ * time + quarter_, k_).sn);
}

double SwingingPendulum::rate(double time) const {
    return 2.0 * k_ * omega0_ * jacobi_elliptic(omega0_ * time + quarter_, k_).cn;
}

double SwingingPendulum::energy(double time) const {
    const double w = rate(time);
    return 0.5 * w * w - omega0_ * omega0_ * std::cos(angle(time));
}

RevolvingPendulum::RevolvingPendulum(double omega0, double rate_at_bottom)
    : rate_at_bottom_(rate_at_bottom), k_(2.0 * omega0 / rate_at_bottom) {
    if (!(omega0 > 0.0) || !(rate_at_bottom > 2.0 * omega0)) {
        throw std::invalid_argument("RevolvingPendulum: needs rate_at_bottom > 2 omega0 > 0");
    }
}

double RevolvingPendulum::period() const {
    return 4.0 * complete_elliptic_k(k_) / rate_at_bottom_;
}

double RevolvingPendulum::angle(double time) const {
    return 2.0 * jacobi_elliptic(0.5 * rate_at_bottom_ * time, k_).am;
}

double RevolvingPendulum::rate(double time) const {
    return rate_at_bottom_ * jacobi_elliptic(0.5 * rate_at_bottom_ * time, k_).dn;
}

}  // namespace cardan::oracles
