// A beam in equilibrium under load, with its section loads.
#pragma once

#include "elements/cardan_beam/section_loads.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/support/catch.hpp"

#include <optional>

namespace cardan::testing {

/// A beam with its system in a state, and both kinds of section loads.
struct Loaded {
    Tree tree;
    ForceSet forces;
    CardanBeam beam;
    std::optional<System> system;
    DynamicState at;

    void settle(int spin = -1, double rotor_speed = 0, const Vector& initial = {}) {
        system.emplace(tree, forces);
        solvers::SteadyOptions options;
        options.rotor_speed = rotor_speed;
        options.initial = initial;
        const solvers::SteadyState state = solvers::steady_state(*system, spin, options);
        REQUIRE(state.converged);
        at = state.at;
    }
    Vec6 equilibrium(double s) const {
        Workspace workspace(system->model);
        const Kinematics kin = kinematics(system->model, at.q, workspace);
        const JointLoads loads = joint_loads({at, kin}, system->forces, at.qdd);
        return equilibrium_loads(beam, kin, system->forces, loads, s).values;
    }
    SectionLoads constitutive(double s) const { return constitutive_loads(beam, system->model, at.q, at.qd, s); }
};

inline Loaded clamped(const BeamLine& line, const CardanBeamOptions& options) {
    Loaded loaded;
    loaded.beam = add_cardan_beam(loaded.tree, loaded.forces, Tree::base(), line, "beam", {"beam"}, options);
    return loaded;
}

}  // namespace cardan::testing
