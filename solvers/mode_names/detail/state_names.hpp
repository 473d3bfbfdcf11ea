/// @file
/// Names of the motions of states of first order. Internal to solvers/mode_names: not installed.
#pragma once

#include "solvers/campbell_data/diagram.hpp"

#include <string>
#include <vector>

namespace cardan::solvers {

/// A state of first order, for names.
struct NamedState {
    std::string family;  ///< StateInfo::part, or the state's name
    double scale = 1;
};

/// Takes those out whose modes are motions of states at more than half of their points (Mode::is_state_motion()), and
/// names them after the family that moves most, by the scales of its states: "wake 1", "airfoil lag 2".
/// @param states    in the order of Mode::states
/// @param branches  with their modes, without names
std::vector<Branch> take_branches_of_states(const std::vector<CampbellPoint>& points,
                                            const std::vector<NamedState>& states, std::vector<Branch>& branches);

}  // namespace cardan::solvers
