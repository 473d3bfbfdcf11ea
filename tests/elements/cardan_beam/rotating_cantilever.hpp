/// @file
/// A rotating uniform cantilever through the whole chain: tree, steady state, linearisation, modes.
#pragma once

#include "mbs/base/entry.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/support/catch.hpp"

namespace cardan::testing {

/// A beam clamped to a hub that spins about z, along x from the hub radius on.
struct RotatingBeam {
    CardanBeam beam;
    std::optional<System> system;

    RotatingBeam(const BeamLine& line, const CardanBeamOptions& options, double hub_radius) {
        Tree tree;
        ForceSet forces;
        const JointedFrame hub = add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "spin", {"hub"});
        const FrameId root = tree.add_frame(hub.frame, Placement::translation({hub_radius, 0, 0}), "root");
        beam = add_cardan_beam(tree, forces, root, line, "beam", {"beam"}, options);
        system.emplace(tree, forces);
    }
    /// Linearised about the straight beam, which must be an equilibrium.
    solvers::SecondOrderSystem at(double rotor_speed) const {
        const int spin = system->model.index("spin");
        const auto n = system->model.size();
        solvers::OperatingPoint point{Vector::Zero(n), Vector::Zero(n), Vector::Zero(n), 0};
        point.qd(spin) = rotor_speed;
        std::vector<int> blade;
        for (int i = 0; i < n; ++i)
            if (i != spin) blade.push_back(i);
        return solvers::restrict_to(solvers::linearise(*system, point), blade);
    }
};

struct FlapLag {
    double lag1, flap1, flap2, flap3;
};

/// m = EI = L = 1, spinning at eta. Flap turns about y, lag about z: told apart by the coordinates that take part.
inline FlapLag rotating(double eta, const CardanBeamOptions& options, double hub_radius = 0) {
    const RotatingBeam rotor(uniform_beam(1, slender(1, 1)), options, hub_radius);
    const solvers::SecondOrderSystem blade = rotor.at(eta);
    const CoordinateTable& coordinates = rotor.system->model.coordinates();
    std::vector<double> flap, lag;
    for (const auto& mode : solvers::modes(blade)) {
        double about_y = 0, about_z = 0;
        for (Eigen::Index i = 0; i < mode.shape.size(); ++i) {
            const bool y = coordinates[entry(blade.coordinates, i)].name.find("bending y") != std::string::npos;
            (y ? about_y : about_z) += std::norm(mode.shape(i));
        }
        (about_y > about_z ? flap : lag).push_back(std::abs(mode.eigenvalue));
    }
    return {lag.at(0), flap.at(0), flap.at(1), flap.size() > 2 ? flap[2] : 0};
}

}  // namespace cardan::testing
