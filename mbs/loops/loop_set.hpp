/// @file
/// Loops: what ties bodies of a tree together besides its joints.
#pragma once

#include "mbs/model/tree.hpp"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cardan {

/// Joints at which a loop may be cut; z is the axis of the frames a and b that they join, in numbers of equations:
enum class CutKind : std::uint8_t {
    revolute,     ///< origins together, z along z: 5
    prismatic,    ///< origin of b on the axis z of a, axes parallel: 5
    cylindrical,  ///< origin of b on the axis z of a, z along z: 4
    cardan,       ///< origins together, x of a (its axis) square to y of b (the other axis): 4
    spherical,    ///< origins together: 3
    planar,       ///< origin of b in the plane x, y of a, z along z: 3
    weld          ///< frames together: 6
};

/// A joint between two frames that closes a loop. Frames on the base count: a loop may be closed through the ground.
struct CutJoint {
    std::string name = {};
    CutKind kind = CutKind::spherical;
    FrameId a = {}, b = {};
};

/// A massless rod with spherical ends between the origins of two frames.
struct FixedDistance {
    std::string name = {};
    FrameId a = {}, b = {};
    double length = 0;  ///< m, > 0
};

/// The origin of a frame stays on the surface value(x) = 0, x in the axes of another. On two of them: on a curve.
struct PointOnSurface {
    std::string name = {};
    FrameId surface = {}, point = {};
    std::function<double(const Vec3& x)> value = {};   ///< m: of about the size of the distance
    std::function<Vec3(const Vec3& x)> gradient = {};  ///< d value / d x
    std::function<Mat3(const Vec3& x)> second = {};    ///< its second derivatives, 1/m
};

/// sum of factor q over some coordinates = offset: gear wheels, rack and pinion, joints that mimic others.
struct Coupling {
    std::string name = {};
    std::vector<std::pair<BodyId, double>> factors = {};
    double offset = 0;
    std::string unit = "rad";  ///< of the equation
};

/// State of a lock: the coordinate is held at position + rate (t - since) while it is engaged. Whoever engages it, such
/// as an event of a time integration, shares this; one motion at a time.
struct LockState {
    bool engaged = false;
    double position = 0, rate = 0;  ///< rad, rad/s or m, m/s
    double since = 0;               ///< s
};

/// A brake, a latch or dry friction that sticks: holds a coordinate while it is engaged, and does nothing otherwise.
/// The multiplier is the force that holds it.
struct Lock {
    std::string name = {};
    BodyId coordinate = {};
    std::shared_ptr<const LockState> state = {};
};

/// A function phi(q, t) with its derivatives. All are zero before a user function is called.
struct ConstraintTerms {
    double value = 0, rate = 0, rate_rate = 0;  ///< phi, phi_t, phi_tt
    Vector gradient = {}, gradient_rate = {};   ///< phi_a, phi_at; size n
    Matrix second = {};                         ///< phi_ab, n x n, symmetric
};

/// phi(q, t) = 0 of one's own. Evaluating it allocates.
struct UserConstraint {
    std::string name = {};
    std::string unit = "m";  ///< of phi
    std::function<void(double time, const Vector& q, ConstraintTerms& out)> terms = {};
};

/// Editable list of loops on the bodies of a Tree. Bad values throw InputError.
class LoopSet {
public:
    void add_joint(CutJoint joint);
    void add_distance(FixedDistance rod);
    void add_surface(PointOnSurface contact);
    void add_coupling(Coupling coupling);
    void add_user(UserConstraint constraint);
    void add_lock(Lock lock);

    const std::vector<CutJoint>& joints() const { return joints_; }
    const std::vector<FixedDistance>& distances() const { return distances_; }
    const std::vector<PointOnSurface>& surfaces() const { return surfaces_; }
    const std::vector<Coupling>& couplings() const { return couplings_; }
    const std::vector<UserConstraint>& users() const { return users_; }
    const std::vector<Lock>& locks() const { return locks_; }
    bool empty() const {
        return joints_.empty() && distances_.empty() && surfaces_.empty() && couplings_.empty() && users_.empty() &&
               locks_.empty();
    }

private:
    void require_new(const std::string& name) const;

    std::vector<CutJoint> joints_;
    std::vector<FixedDistance> distances_;
    std::vector<PointOnSurface> surfaces_;
    std::vector<Coupling> couplings_;
    std::vector<UserConstraint> users_;
    std::vector<Lock> locks_;
};

}  // namespace cardan
