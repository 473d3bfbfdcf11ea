#include "mbs/geometry/curvature.hpp"

#include <limits>

namespace cardan {

Curvature::Curvature(const Model& model) : Curvature(model, model.coordinates().driven()) {}

Curvature::Curvature(const Model& model, std::vector<bool> driven)
    : model_(&model), factor_(model, std::move(driven)), embedding_(model) {
    const int n = model.size();
    for (Direction* d : {&x_, &y_, &z_, &w_}) *d = {Vector::Zero(n), embedding_.velocity_field()};
    for (AccelerationField* f : {&first_, &second_}) *f = embedding_.acceleration_field();
    for (Vector* v : {&zero_, &beta_, &other_}) v->setZero(n);
    C_.setZero(n, n);
    composites_.resize(static_cast<std::size_t>(n));
}

namespace {

constexpr const char* in_curvature = "curvature";

}  // namespace

PivotStatus Curvature::update(const Kinematics& kin) {
    embedding_.update(kin);
    return factor_.factorise(kin);
}

template <class X>
void Curvature::zero_driven(X& x) const {
    for (int a = 0; a < model_->size(); ++a)
        if (factor_.is_driven(a)) x(a) = 0;
}

void Curvature::load(VectorIn x, Direction& direction) const {
    require_size(in_curvature, "vector", x, model_->size());
    direction.x = x;
    zero_driven(direction.x);
    embedding_.first(direction.x, direction.field);
}

// II_ab x^a y^b = r_ab x^a y^b - r_e beta^e, beta^e = Gamma^e_ab x^a y^b
void Curvature::normal(const Direction& x, const Direction& y, AccelerationField& II) {
    embedding_.second(x.x, x.field, y.x, y.field, zero_, II);
    embedding_.pull(II, beta_);
    zero_driven(beta_);
    factor_.solve(beta_);
    embedding_.second(x.x, x.field, y.x, y.field, beta_, II);
}

void Curvature::christoffel(VectorIn x, VectorIn y, VectorOut h) {
    load(x, x_);
    load(y, y_);
    embedding_.second(x_.x, x_.field, y_.x, y_.field, zero_, first_);
    embedding_.pull(first_, h);
    zero_driven(h);
}

void Curvature::covariant_derivative(VectorIn qd, VectorIn V, VectorIn Vdot, VectorOut DV) {
    require_size(in_curvature, "Vdot", Vdot, model_->size());
    require_size(in_curvature, "DV", DV, model_->size());
    christoffel(qd, V, beta_);
    factor_.solve(beta_);
    DV = Vdot;
    DV += beta_;
    zero_driven(DV);
}

void Curvature::geodesic(VectorIn qd, VectorOut qdd) {
    require_size(in_curvature, "qdd", qdd, model_->size());
    christoffel(qd, qd, beta_);
    factor_.solve(beta_);
    qdd = -beta_;
}

// <r_ac z^c, II_bd y^b w^d> - <r_ad w^d, II_bc y^b z^c>: II is normal, so r_ac may stand for II_ac.
void Curvature::gauss(VectorIn y, VectorIn z, VectorIn w, VectorOut& out) {
    load(y, y_);
    load(z, z_);
    load(w, w_);
    normal(y_, w_, first_);
    normal(y_, z_, second_);
    embedding_.pull_second(z_.field, first_, out);
    embedding_.pull_second(w_.field, second_, other_);
    out -= other_;
    zero_driven(out);
}

void Curvature::deviation(VectorIn qd, VectorIn xi, VectorOut acceleration) {
    force(qd, xi, acceleration);
    factor_.solve(acceleration);
    acceleration = -acceleration;
}

double Curvature::riemann(VectorIn x, VectorIn y, VectorIn z, VectorIn w) {
    load(x, x_);
    load(y, y_);
    load(z, z_);
    load(w, w_);
    normal(x_, z_, first_);
    normal(y_, w_, second_);
    const double direct = embedding_.inner(first_, second_);
    normal(x_, w_, first_);
    normal(y_, z_, second_);
    return direct - embedding_.inner(first_, second_);
}

double Curvature::sectional(VectorIn x, VectorIn y) {
    // y less its part along x, by coordinates of an orthonormal frame.
    require_size(in_curvature, "x", x, model_->size());
    require_size(in_curvature, "y", y, model_->size());
    beta_ = x;
    other_ = y;
    zero_driven(beta_);
    zero_driven(other_);
    factor_.multiply_L(beta_);
    factor_.multiply_L(other_);
    const double x2 = beta_.squaredNorm();
    const double along = beta_.dot(other_) / x2, whole = other_.squaredNorm();
    other_ -= along * beta_;
    const double y2 = other_.squaredNorm();
    const double rounding = 8 * static_cast<double>(x.size()) * std::numeric_limits<double>::epsilon();
    if (!(y2 > rounding * rounding * whole)) return std::numeric_limits<double>::quiet_NaN();  // parallel
    load(x, x_);
    load(y, y_);
    w_.x = y_.x - along * x_.x;
    load(w_.x, y_);
    normal(x_, x_, first_);
    normal(y_, y_, second_);
    const double direct = embedding_.inner(first_, second_);
    normal(x_, y_, first_);
    return (direct - embedding_.inner(first_, first_)) / (x2 * y2);
}

}  // namespace cardan
