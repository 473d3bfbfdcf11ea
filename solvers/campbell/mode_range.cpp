#include "solvers/campbell/mode_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::solvers {

namespace {

constexpr std::size_t least = 24;  // two families of three blades with two modes each, tower, shaft, yaw

}  // namespace

double ModeRange::largest(const CampbellOptions& options, double rotor_speed) const {
    if (options.all_modes || usual_ < 0) return std::numeric_limits<double>::infinity();
    return std::max(1.5 * 2 * pi * options.max_frequency_hz, usual_) + 2 * std::abs(rotor_speed);
}

void ModeRange::set(const std::vector<CampbellMode>& modes, double rotor_speed) {
    if (usual_ >= 0) return;
    const bool few = modes.size() < least || !modes[least - 1].mode.oscillates();
    usual_ = few ? std::numeric_limits<double>::infinity()
                 : std::abs(modes[least - 1].mode.eigenvalue) + 2 * std::abs(rotor_speed);
}

}  // namespace cardan::solvers
