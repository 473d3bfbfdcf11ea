// The curvature along a motion as a matrix, from composite bodies.
#include "mbs/base/registers/vectorised.hpp"
#include "mbs/geometry/curvature.hpp"

namespace cardan {

namespace {

// T with int (a x y) . (b x z) = a . T b, from the moments B = int y z^T.
Mat3 product_tensor(const Mat3& B) {
    return B.trace() * Mat3::Identity() - B.transpose();
}

// r_a (w, v at a point) and its rate d/dt r_a = p + w x (v - V) + w' x (x - C) on the bodies that joint a carries.
struct BasisMotion {
    Vec3 w, v;
    Vec3 w_rate, p;
};

BasisMotion basis_motion(const Embedding::Places& places, const Model::Body& body, std::size_t i,
                         const VelocityField& field, const Vec3& C, const Vec3& V) {
    const Vec3& e = places.e[i];
    const Vec3 turned = cross<double>(field.w[i], e), arm = C - places.o[i];
    if (!body.revolute) return {Vec3::Zero(), e, Vec3::Zero(), turned};
    return {e, cross<double>(e, arm), turned, cross<double>(turned, arm) + cross<double>(e, V - field.v[i])};
}

// Upper triangle of R plus Y Y^T, both n x n by columns: C^T g^-1 C with Y^T = L^-T C, whose zeros off the branches are
// left out.
CARDAN_VECTORISED void add_gram(std::ptrdiff_t n, const double* __restrict Y, double* __restrict R,
                                std::ptrdiff_t stride) {
    for (std::ptrdiff_t e = 0; e < n; ++e, Y += n)
        for (std::ptrdiff_t b = 0; b < n; ++b) {
            const double factor = Y[b];
            if (factor == 0) continue;
            double* __restrict column = R + b * stride;
            for (std::ptrdiff_t a = 0; a <= b; ++a) column[a] += factor * Y[a];
        }
}

}  // namespace

// Merged from the tips to the base like masses and Binet's tensors: central moments of (v, x), both measured from the
// means.
void Curvature::gather_composites(const VelocityField& velocity, const AccelerationField& a) {
    const Embedding::Places& places = embedding_.places();
    for (int k = 0; k < model_->size(); ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        Composite& own = composites_[i];
        const Vec3 c = places.r[i] - places.o[i];
        const Mat3 w = skew<double>(velocity.w[i]);
        own.M = model_->body(k).inertia.mass;
        own.C = places.r[i];
        own.V = velocity.v[i] + cross<double>(velocity.w[i], c);
        own.xx = embedding_.binet(k);
        own.vx = w * own.xx;
        own.vv = own.vx * w.transpose();
        own.F = own.M * (a.a[i] + a.A[i] * c);
        own.virial = own.xx * a.A[i].transpose();
        own.virial += c * own.F.transpose();
    }
    for (int k = model_->size() - 1; k >= 0; --k) {
        if (model_->body(k).parent < 0) continue;
        const std::size_t i = static_cast<std::size_t>(k), p = static_cast<std::size_t>(model_->body(k).parent);
        const Composite& child = composites_[i];
        Composite& sum = composites_[p];
        sum.F += child.F;
        sum.virial += child.virial + (places.o[i] - places.o[p]) * child.F.transpose();
        sum.xx += child.xx;
        sum.vx += child.vx;
        sum.vv += child.vv;
        if (child.M == 0) continue;
        const double M = sum.M + child.M, reduced = sum.M * child.M / M, part = child.M / M;
        const Vec3 dx = child.C - sum.C, dv = child.V - sum.V;
        sum.xx += reduced * dx * dx.transpose();
        sum.vx += reduced * dv * dx.transpose();
        sum.vv += reduced * dv * dv.transpose();
        sum.C += part * dx;
        sum.V += part * dv;
        sum.M = M;
    }
}

// R_am = <r_am, II> - <d/dt r_a, d/dt r_m> and C_am, C_ma for all a on the path of m.
void Curvature::fill_row(int m, const VelocityField& velocity, MatrixOut R) {
    const Embedding::Places& places = embedding_.places();
    const std::size_t i = static_cast<std::size_t>(m);
    const Composite& body = composites_[i];
    const Mat3 vv = product_tensor(body.vv), vx = product_tensor(body.vx), xx = product_tensor(body.xx);
    const BasisMotion own = basis_motion(places, model_->body(m), i, velocity, body.C, body.V);
    const Vec3 momentum = body.M * own.v, force = body.M * own.p;
    const Vec3 by_w = vv * own.w + vx * own.w_rate, by_rate = vx.transpose() * own.w + xx * own.w_rate;
    const Vec3 spin_w = vx * own.w, spin_rate = xx * own.w;
    // r_am = w_a x r_m: its product with the field is w_a . int rho r_m x II dV.
    const Vec3& e = places.e[i];
    const Vec3 bending =
        model_->body(m).revolute ? Vec3(body.virial * e - body.virial.trace() * e) : cross<double>(e, body.F);
    for (const int a : factor_.path(m)) {
        const BasisMotion at =
            basis_motion(places, model_->body(a), static_cast<std::size_t>(a), velocity, body.C, body.V);
        R(a, m) = R(m, a) = dot<double>(at.w, bending) - dot<double>(at.p, force) - dot<double>(at.w, by_w) -
                            dot<double>(at.w_rate, by_rate);
        C_(a, m) = dot<double>(at.v, force) + dot<double>(at.w, by_rate);
        C_(m, a) = dot<double>(at.p, momentum) + dot<double>(at.w, spin_w) + dot<double>(at.w_rate, spin_rate);
    }
}

void Curvature::matrix(VectorIn qd, MatrixOut R) {
    require_size("curvature", "R", R, model_->size(), model_->size());
    load(qd, x_);
    normal(x_, x_, first_);
    gather_composites(x_.field, first_);
    R.setZero();
    C_.setZero();
    for (int m = 0; m < model_->size(); ++m) fill_row(m, x_.field, R);
    factor_.solve_LT(C_);
    C_.transposeInPlace();
    add_gram(R.cols(), C_.data(), R.data(), R.outerStride());
    for (Eigen::Index b = 0; b < R.cols(); ++b)
        for (Eigen::Index a = 0; a < b; ++a) R(b, a) = R(a, b);
}

}  // namespace cardan
