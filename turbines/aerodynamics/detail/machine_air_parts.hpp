/// @file
/// Parts that a MachineAir consists of. Internal to the air on machines: not installed.
#pragma once

#include "turbines/aerodynamics/detail/air_evaluation.hpp"
#include "turbines/aerodynamics/machine_air.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cardan::turbines {

inline constexpr const char* name_of_air = "air";  ///< MachineAir::element()

struct MachineAir::Parts : AirParts {
    TowerAir support;
    std::vector<int> blade_numbers;
    std::vector<BodyId> body_ids;  ///< by index in the model

    explicit Parts(TowerAir drag) : support(std::move(drag)) {}
};

/// Names and kinds of the states of an unsteady air, in their order.
std::vector<StateInfo> states_of(const AirParts& parts, const std::vector<int>& blade_numbers);
std::vector<ElementGroup> groups_of(const AirParts& parts, const std::vector<BodyId>& body_ids);

}  // namespace cardan::turbines
