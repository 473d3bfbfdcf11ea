#include "solvers/campbell/mode_range.hpp"

#include "solvers/linear/modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::solvers {

namespace {

constexpr std::size_t least = 24;  // two families of three blades with two modes each, tower, shaft, yaw

}  // namespace

double ModeRange::largest(const CampbellOptions& options, double rotor_speed, const SecondOrderSystem& system) {
    const bool many = has_many_states(system);
    if (options.all_modes || (many && options.all_state_motions)) return std::numeric_limits<double>::infinity();
    if (usual_ < 0 && many) {
        SecondOrderSystem held = system;
        held.states = {};
        std::vector<Complex> eigenvalues;
        for (const Mode& mode : modes(held)) eigenvalues.push_back(mode.eigenvalue);
        set_usual(eigenvalues, rotor_speed);
    }
    if (usual_ < 0) return std::numeric_limits<double>::infinity();
    return std::max(1.5 * 2 * pi * options.max_frequency_hz, usual_) + 2 * std::abs(rotor_speed);
}

void ModeRange::set(const std::vector<CampbellMode>& modes, double rotor_speed) {
    if (usual_ >= 0) return;
    std::vector<Complex> eigenvalues;
    eigenvalues.reserve(modes.size());
    for (const CampbellMode& mode : modes) eigenvalues.push_back(mode.mode.eigenvalue);
    set_usual(eigenvalues, rotor_speed);
}

void ModeRange::set_usual(const std::vector<Complex>& eigenvalues, double rotor_speed) {
    const bool few = eigenvalues.size() < least || !(eigenvalues[least - 1].imag() > 0);
    usual_ =
        few ? std::numeric_limits<double>::infinity() : std::abs(eigenvalues[least - 1]) + 2 * std::abs(rotor_speed);
}

}  // namespace cardan::solvers
