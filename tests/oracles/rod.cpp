#include "tests/oracles/rod.hpp"

#include "tests/oracles/root_finding.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cardan::oracles::rod {
namespace {

constexpr double pi = std::numbers::pi;

void require_mode(int mode) {
    if (mode < 1) throw std::invalid_argument("rod: modes are counted from 1");
}

}  // namespace

double clamped_free_wave_number(int mode) {
    require_mode(mode);
    return (mode - 0.5) * pi;
}

double free_free_wave_number(int mode) {
    require_mode(mode);
    return mode * pi;
}

double clamped_with_tip_body_wave_number(int mode, double ratio) {
    require_mode(mode);
    if (!(ratio > 0.0)) throw std::invalid_argument("rod: ratio of inertias must be positive");
    return bisect([ratio](double b) { return b * std::sin(b) - ratio * std::cos(b); }, (mode - 1) * pi,
                  (mode - 0.5) * pi);
}

double clamped_free_shape(int mode, double xi) {
    return std::sin(clamped_free_wave_number(mode) * xi);
}

}  // namespace cardan::oracles::rod
