/// @file
/// Another multibody engine, asked for the same quantities. Plain numbers only, C++17: Simbody's headers do not compile
/// as C++20.
#pragma once

#include <stdexcept>
#include <vector>

namespace cardan::peers {

/// How a link moves on its parent: about or along the z axis of its joint frame, or not at all.
enum class PeerJoint { revolute, prismatic, weld };

/// One rigid body with the joint that carries it.
struct PeerLink {
    int parent = -1;  ///< a link earlier in the list, -1: ground
    PeerJoint joint = PeerJoint::revolute;
    double R[9] = {}, p[3] = {};   ///< joint frame at q = 0 in the parent's frame: rotation row by row, origin, m
    double mass = 0, com[3] = {};  ///< kg; centre of mass in the joint frame, m
    double J[6] = {};              ///< about the centre of mass, joint frame: xx, yy, zz, xy, xz, yz, kg m^2

    bool is_massless() const {
        for (const double entry : J)
            if (entry != 0) return false;
        return mass == 0;
    }
};

/// Points of two links that are held together: a loop.
struct PeerPin {
    int a = -1, b = -1;                 ///< links, -1: ground
    double at_a[3] = {}, at_b[3] = {};  ///< in their joint frames, m
};

/// A tree that an engine cannot represent.
class PeerRefusal : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// An engine with one tree and a gravity vector. The coordinates are those of the links that are not welded, in their
/// order. Every call sets the state and computes from it; no result of an earlier call is used again.
class Peer {
public:
    virtual ~Peer() = default;

    /// Mass matrix, n x n.
    virtual void metric(const double* q, double* g) = 0;
    /// Forces for given accelerations: g qdd + Gamma qd qd less the forces of gravity.
    virtual void inverse_dynamics(const double* q, const double* qd, const double* qdd, double* tau) = 0;
    /// Accelerations under the forces Q and gravity.
    virtual void forward_dynamics(const double* q, const double* qd, const double* Q, double* qdd) = 0;
};

}  // namespace cardan::peers
