/// @file
/// A rotating uniform cantilever through the whole chain: tree, steady state, linearisation, modes.
#pragma once

#include "mbs/base/entry.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/support/catch.hpp"

namespace cardan::testing {

/// A beam clamped to a hub that spins about z, along x from the hub radius on.
struct RotatingBeam : SingleBeam {
    RotatingBeam(const BeamLine& line, const CardanBeamOptions& options, double hub_radius)
        : SingleBeam(spinning_beam(line, options, hub_radius)) {}
    /// Linearised about the straight beam, which must be an equilibrium.
    solvers::SecondOrderSystem at(double rotor_speed) const {
        const Vector zero = Vector::Zero(system.model.size());
        DynamicState point = at_rest(zero);
        point.qd(spin) = rotor_speed;
        return solvers::restrict_to(solvers::linearise(system, point), system.model.coordinates().free_without(spin));
    }
};

struct FlapLag {
    double lag1, flap1, flap2, flap3;
};

/// m = EI = L = 1, spinning at eta. Flap turns about y, lag about z: told apart by the coordinates that take part.
inline FlapLag rotating(double eta, const CardanBeamOptions& options, double hub_radius = 0) {
    const RotatingBeam rotor(uniform_beam(1, slender(1, 1)), options, hub_radius);
    const solvers::SecondOrderSystem blade = rotor.at(eta);
    const CoordinateTable& coordinates = rotor.system.model.coordinates();
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
