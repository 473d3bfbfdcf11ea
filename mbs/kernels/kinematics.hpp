/// @file
/// Poses of all bodies at q and the kinematic basis functions u, Omega.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/kernels/workspace.hpp"

#include <cassert>

namespace cardan {

/// View of a workspace after kinematics(): proof that this stage has been computed. It goes stale when the workspace is
/// used for another q (checked in debug builds).
template <class S>
class KinematicsT {
public:
    const Model& model() const { return *model_; }
    WorkspaceT<S>& workspace() const {
        assert_fresh();
        return *workspace_;
    }
    /// Rotation of body k -> base.  @throws InputError for a body index out of range, as do the other accessors
    Mat3T<S> rotation(int k) const {
        return Eigen::Map<const Mat3T<S>, Eigen::Unaligned, Eigen::OuterStride<4>>(frame(k));
    }
    /// Origin of the joint frame of body k, m; the joint axis; the centre of mass, m. Base axes.
    Vec3T<S> origin(int k) const { return vector(k, 3); }
    Vec3T<S> axis(int k) const { return vector(k, 2); }
    Vec3T<S> centre_of_mass(int k) const { return vector(k, 4); }

    /// The sources of the library compute with these arrays; the type is complete there only.
    KernelArraysT<S>& arrays() const {
        assert_fresh();
        return *arrays_;
    }

private:
    friend struct KernelArraysT<S>;
    /// A body has five vectors of four numbers each, of which the last has no meaning: the columns of its rotation, its
    /// origin and its centre of mass.
    static constexpr int numbers_of_frame = 20;

    KinematicsT(const Model& model, WorkspaceT<S>& workspace, const S* frames)
        : model_(&model),
          workspace_(&workspace),
          arrays_(workspace.arrays_.get()),
          frames_(frames),
          generation_(workspace.generation()) {}
    void assert_fresh() const {
        assert(generation_ == workspace_->generation() && "stale kinematics: the workspace was used for another q");
    }
    const S* frame(int k) const {
        require_index("kinematics", "body", k, model_->size());
        assert_fresh();
        return frames_ + std::ptrdiff_t{numbers_of_frame} * k;
    }
    Vec3T<S> vector(int k, int i) const {
        const S* x = frame(k) + 4 * i;
        return {x[0], x[1], x[2]};
    }
    template <class T>
    friend KinematicsT<T> kinematics(const Model& model, VectorInT<T> q, WorkspaceT<T>& workspace);

    const Model* model_;
    WorkspaceT<S>* workspace_;
    KernelArraysT<S>* arrays_;
    const S* frames_;
    std::uint64_t generation_;
};

using Kinematics = KinematicsT<double>;

/// Poses of all bodies.
/// @param q  coordinates, size n, rad or m
///
/// Cost O(n), no allocation.
/// @throws InputError if q has the wrong size or the workspace belongs to another model
template <class S>
KinematicsT<S> kinematics(const Model& model, VectorInT<S> q, WorkspaceT<S>& workspace);

/// Kinematic basis functions of body k for coordinate a, in components of body k; both zero unless a precedes k.
///
///     velocity of the centre of mass  v_k = u_ka qd^a,  angular velocity  omega_k = Omega_ka qd^a.
///                                                                                [Zhao et al. 2007, eq. 6]
///
/// @throws InputError for body indices out of range
template <class S>
struct BasisFunctions {
    Vec3T<S> u;      ///< m/rad or 1
    Vec3T<S> Omega;  ///< 1 or 0
};
template <class S>
BasisFunctions<S> basis_functions(const KinematicsT<S>& kin, int k, int a);

/// Twist of coordinate a at a point C of a body distal to it: angular part w, velocity v (base axes).
template <class S>
struct PointTwist {
    Vec3T<S> w, v;
};
template <class S>
PointTwist<S> twist_at(const KinematicsT<S>& kin, int a, const Vec3T<S>& C) {
    const Vec3T<S> e = kin.axis(a);
    if (entry(kin.model().bodies(), a).revolute) return {e, cross<S>(e, C - kin.origin(a))};
    return {Vec3T<S>::Zero(), e};
}

/// Position and rotation (frame -> base) of a frame.
template <class S>
struct Pose {
    Mat3T<S> R;
    Vec3T<S> p;
};
template <class S>
Pose<S> pose(const KinematicsT<S>& kin, FrameId frame);

/// Jacobian of a frame: [angular velocity; velocity of its origin] = J qd, base axes.
/// @param J  out, 6 x n, overwritten
/// @throws InputError for a wrong size or a frame that does not exist
template <class S>
void frame_jacobian(const KinematicsT<S>& kin, FrameId frame, MatrixOutT<S> J);

}  // namespace cardan
