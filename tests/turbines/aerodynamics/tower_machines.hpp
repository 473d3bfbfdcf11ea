// The NREL 5 MW machine and its tower in the air, for tests.
#pragma once

#include "tests/support/random_tree.hpp"
#include "tests/turbines/reference_turbines/sampled_channels.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"

#include <cstdint>

namespace cardan::testing::tower_machines {

inline const SteadyWind twisted{.speed = 10,
                                .shear = Shear::power,
                                .exponent = 0.2,
                                .direction = 0.25,
                                .veer = 0.001,
                                .upflow = 0.08,
                                .lateral = 0.001};

/// Tower of the NREL 5 MW machine: straight taper.
inline constexpr double top = 87.6, thick = 6, thin = 3.87, coefficient = 0.6;
inline double taper(double z) {
    return thick + (thin - thick) * z / top;
}
inline AeroTower table(int intervals, TowerInfluence influence = TowerInfluence::none, double lowest = 0) {
    AeroTower out;
    for (int i = 0; i <= intervals; ++i) {
        out.height.push_back(lowest + (top - lowest) * i / intervals);
        out.diameter.push_back(taper(out.height.back()));
        out.drag.push_back(coefficient);
    }
    out.influence = influence;
    return out;
}

/// Two elements per blade; a tower that bends, or one that stands on a platform which moves.
enum class Stand : std::uint8_t { elastic, rigid, platform };
inline turbines::Turbine machine_on(Stand stand, double tilt = 0.087, double cone = -0.044) {
    turbines::TurbineDescription description = turbines::nrel5mw_description({.pitch_actuator = true});
    description.tower.rigid = stand != Stand::elastic;
    description.nacelle.tilt = tilt;
    description.blade.cone = cone;
    if (stand == Stand::platform) description.platform = turbines::PlatformDescription{};
    return turbines::assemble(description, turbines::nrel5mw_assembly(turbines::Nrel5mwVariant::report, 2, 2));
}

/// A rotor behind the tower, a blade in its wake.
inline turbines::Turbine downwind_machine(Stand stand) {
    turbines::TurbineDescription description = turbines::nrel5mw_description({.pitch_actuator = true});
    description.tower.rigid = stand != Stand::elastic;
    description.nacelle.overhang *= -1;
    description.nacelle.tilt *= -1;
    description.blade.cone *= -1;
    if (stand == Stand::platform) description.platform = turbines::PlatformDescription{};
    return turbines::assemble(description, turbines::nrel5mw_assembly(turbines::Nrel5mwVariant::report, 2, 2));
}
inline AeroTower with_shadow(AeroTower tower, TowerShadow shadow) {
    tower.shadow = shadow;
    for (std::size_t i = 0; i < tower.height.size(); ++i)
        tower.turbulence.push_back(0.2 + 0.02 * static_cast<double>(i));
    return tower;
}

/// Turning, a blade before the tower, everything moving and out of place.
inline MachineState passing(const turbines::Turbine& machine, unsigned seed) {
    MachineState state(machine);
    Random random(seed);
    for (Eigen::Index i = 0; i < state.q.size(); ++i) {
        state.q(i) += uniform(random, -0.02, 0.02);
        state.qd(i) += uniform(random, -0.1, 0.1);
    }
    state.q(machine.rotor().spin) = pi + 0.02;
    state.qd(machine.rotor().spin) = 1.1;
    return state;
}

}  // namespace cardan::testing::tower_machines
