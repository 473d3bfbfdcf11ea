#include "solvers/linearise.hpp"

#include "mbs/derivatives.hpp"

#include <algorithm>

namespace cardan::solvers {

Linearisation linearise(const System& system, const OperatingPoint& at) {
    const Eigen::Index n = system.model.size();
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, at.q, workspace);
    Linearisation lin;
    lin.at = at;
    lin.coordinates = system.model.coordinates();
    lin.mass.resize(n, n);
    lin.gyroscopic.resize(n, n);
    lin.inertial.resize(n, n);
    metric(kin, lin.mass);
    inverse_dynamics_derivatives<double>(kin, at.qd, at.qdd, lin.inertial, lin.gyroscopic);
    ForceDerivatives forces;
    system.forces.derivatives(kin, at.time, at.q, at.qd, forces);
    lin.elastic = std::move(forces.elastic);
    lin.gravity = std::move(forces.gravity);
    lin.loads = std::move(forces.loads);
    lin.damping = std::move(forces.damping);
    return lin;
}

SecondOrderSystem restrict_to(const Linearisation& lin, std::vector<int> coordinates, int spin) {
    const Matrix C = lin.velocity(), K = lin.stiffness();
    SecondOrderSystem s{lin.mass(coordinates, coordinates),
                        C(coordinates, coordinates),
                        K(coordinates, coordinates),
                        lin.elastic(coordinates, coordinates),
                        coordinates,
                        -1};
    const auto row = std::find(coordinates.begin(), coordinates.end(), spin);
    if (row != coordinates.end()) {
        const auto at = row - coordinates.begin();
        if (s.K.col(at).norm() < 1e-9 * s.K.norm()) {
            s.cyclic = static_cast<int>(at);
            s.K.col(at).setZero();
        }
    }
    return s;
}

}  // namespace cardan::solvers
