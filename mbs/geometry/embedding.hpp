/// @file
/// The configuration space as a surface in the flat space of the positions of all mass points.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/kernels/metric.hpp"

namespace cardan {

/// First derivative of all positions along x: r_a x^a, on every body a twist (base axes).
struct VelocityField {
    std::vector<Vec3> w;  ///< angular velocity
    std::vector<Vec3> v;  ///< velocity of the joint origin
};

/// A field that is affine on every body, such as a second derivative of all positions: a + A (x - o) at the point x of
/// body k, o its joint origin, base axes; and the component -(s . beta) sqrt(J) of every armature.
struct AccelerationField {
    std::vector<Vec3> a;
    std::vector<Mat3> A;
    Vector beta;
};

/// The positions r(q) of all mass points are a point of the flat space with the product <F, G> = int rho F . G dV
/// (every armature adds one more axis, sqrt(J) s . q). In it the metric is g_ab = <r_a, r_b> and the Christoffel
/// symbols are Gamma_abc = <r_a, r_bc>, indices of r being derivatives. What the intrinsic geometry needs of the second
/// derivatives r_ab is evaluated here body by body, with Binet's tensor P_k about the centre of mass: on a body the
/// product of two affine fields is m F . G + tr(A_F P A_G^T), with F and G at the centre of mass.
///
/// All functions cost O(n) and allocate nothing. The object is bound to the q of the last update().
class Embedding {
public:
    /// Joint axes, origins of the joint frames and centres of mass, base axes.
    struct Places {
        std::vector<Vec3> e, o, r;
    };

    explicit Embedding(const Model& model);
    explicit Embedding(Model&&) = delete;  // the model must live longer
    VelocityField velocity_field() const;
    AccelerationField acceleration_field() const;

    void update(const Kinematics& kin);

    /// r_a x^a
    void first(VectorIn x, VelocityField& out) const;
    /// r_ab x^a y^b - r_a beta^a with the first derivatives dx, dy of the same x, y. With x = y = qd and beta = -qdd
    /// it is the acceleration of all points.
    void second(VectorIn x, const VelocityField& dx, VectorIn y, const VelocityField& dy, VectorIn beta,
                AccelerationField& out);
    /// <F, G>
    double inner(const AccelerationField& F, const AccelerationField& G) const;
    /// out_a = <r_a, F>, the part of the bodies (armatures left out)
    void pull(const AccelerationField& F, VectorOut out);
    /// out_a = <r_ab z^b, F> with the first derivative dz along z
    void pull_second(const VelocityField& dz, const AccelerationField& F, VectorOut out);

    const Model& model() const { return *model_; }
    /// Binet's tensor of body k about its centre of mass, base axes.
    const Mat3& binet(int k) const {
        require_index("embedding", "body", k, std::ssize(binet_));
        return entry(binet_, k);
    }
    const Places& places() const { return places_; }

private:
    void loads(const AccelerationField& F);

    const Model* model_;
    Places places_;
    std::vector<Mat3> binet_;
    std::vector<Vec3> alpha_, F_, N_, X_;
};

}  // namespace cardan
