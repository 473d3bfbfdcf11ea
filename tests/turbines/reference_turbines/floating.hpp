// Platforms for tests, and the rigid machine on them by hand.
#pragma once

#include "mbs/base/decompositions.hpp"
#include "mbs/base/units.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "turbines/model/assembly.hpp"

#include <Eigen/Geometry>

#include <complex>

namespace cardan::testing {

inline const Vec3 earth_gravity(0, 0, -units::standard_gravity);  ///< ground axes, m/s^2

inline Mat3 skew(const Vec3& v) {
    return (Mat3() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

/// A tree's bodies as one rigid body at q = 0, from the inertias as they were given: mass matrix about the origin of
/// the base, rows force then moment (Steiner's theorem), and first moment.
struct RigidWhole {
    Mat6 M = Mat6::Zero();
    Vec3 first = Vec3::Zero();  ///< kg m
    double mass = 0;

    explicit RigidWhole(const turbines::Turbine& turbine) {
        const Model& model = turbine.system().model;
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
        for (const Tree::Piece& piece : turbine.tree().pieces()) {
            const FrameId frame = piece.body < 0 ? Tree::base() : turbine.tree().frame_of(BodyId{piece.body});
            const Pose<double> own = pose(kin, frame);
            add(piece.inertia.mass, own.p + own.R * piece.inertia.com, own.R * piece.inertia.J * own.R.transpose());
        }
    }
    void add(double m, const Vec3& c, const Mat3& J) {
        const Mat3 C = skew(c);
        M.topLeftCorner<3, 3>() += m * Mat3::Identity();
        M.topRightCorner<3, 3>() -= m * C;
        M.bottomLeftCorner<3, 3>() += m * C;
        M.bottomRightCorner<3, 3>() += J - m * C * C;
        first += m * c;
        mass += m;
    }
};

/// Eigenvalues with positive imaginary part of M x'' + B x' + K x = 0, by imaginary part.
inline std::vector<std::complex<double>> oscillations(const Eigen::MatrixXd& M, const Eigen::MatrixXd& B,
                                                      const Eigen::MatrixXd& K) {
    const Eigen::Index n = M.rows();
    // Over the diagonal of M, or rotations and translations differ by four decades.
    const Eigen::VectorXd d = M.diagonal().cwiseSqrt().cwiseInverse();
    const auto D = d.asDiagonal();
    const Eigen::MatrixXd inverse = (D * M * D).inverse();
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n).setIdentity();
    A.bottomLeftCorner(n, n) = -inverse * (D * K * D);
    A.bottomRightCorner(n, n) = -inverse * (D * B * D);
    std::vector<std::complex<double>> found;
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(A, false);
    for (Eigen::Index i = 0; i < 2 * n; ++i)
        if (solver.eigenvalues()(i).imag() > 0) found.push_back(solver.eigenvalues()(i));
    std::sort(found.begin(), found.end(), [](auto a, auto b) { return a.imag() < b.imag(); });
    return found;
}

/// Under the 600 kW machine: a spar of 1500 t, no two of its numbers alike, couplings everywhere that A and K may have
/// them.
inline turbines::PlatformDescription some_platform() {
    turbines::PlatformDescription p;
    p.name = "test spar";
    p.inertia = {1.5e6, Vec3(0.2, -0.1, -40), Vec3(4.8e8, 5e8, 3e7).asDiagonal()};
    p.tower_base = Vec3(0, 0, 5);
    p.added_mass.diagonal() << 1.4e6, 1.3e6, 1e5, 2e9, 2.1e9, 1e6;
    p.added_mass(0, 4) = p.added_mass(4, 0) = -4e7;
    p.added_mass(1, 3) = p.added_mass(3, 1) = 3.8e7;
    p.added_mass(2, 5) = p.added_mass(5, 2) = 2e4;
    p.hydrostatic_stiffness.diagonal() << 0, 0, 2e5, 1e7, 1.2e7, 0;
    p.mooring_stiffness.diagonal() << 2e4, 2.5e4, 3e3, 4e7, 4e7, 2e7;
    p.mooring_stiffness(0, 4) = p.mooring_stiffness(4, 0) = -5e5;
    p.mooring_stiffness(1, 3) = p.mooring_stiffness(3, 1) = 6e5;
    p.damping.diagonal() << 2e4, 2.2e4, 3e4, 1e7, 1.1e7, 3e6;
    p.damping(0, 4) = p.damping(4, 0) = -1e5;
    p.buoyancy_centre = Vec3(0, 0, -25);
    return p;
}

inline turbines::PlatformDescription floating_freely(turbines::PlatformDescription platform) {
    platform.coordinates.role = CoordinateRole::free;
    return platform;
}

/// Buoyancy such that it carries platform and machine.
inline turbines::PlatformDescription in_balance(turbines::PlatformDescription platform,
                                                turbines::TurbineDescription machine,
                                                const turbines::AssemblyOptions& options) {
    platform.buoyancy = 0;
    machine.platform = platform;
    machine.platform->coordinates.role = CoordinateRole::prescribed;
    platform.buoyancy =
        -options.gravity.z() * RigidWhole(assemble(machine, options)).mass - platform.mooring_preload.z();
    return platform;
}

}  // namespace cardan::testing
