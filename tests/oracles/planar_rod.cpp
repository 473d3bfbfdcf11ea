#include "tests/oracles/planar_rod.hpp"

#include "mbs/base/decompositions.hpp"
#include "tests/oracles/quadrature.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace cardan::oracles {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// At the Gauss points.
struct PlanarRodMotion::Fields {
    Eigen::ArrayXd cosine, sine, g, g_rate, omega;
    VectorXd x, y, vx, vy;
};

PlanarRodMotion::PlanarRodMotion(const PlanarRod& rod, std::function<Hub(double)> hub)
    : rod_(rod), hub_(std::move(hub)) {
    if (!hub_) throw std::invalid_argument("PlanarRodMotion: no motion of the hub");
    prepare();
}

PlanarRodMotion::PlanarRodMotion(const PlanarRod& rod, const Vector2d& start, double angle,
                                 std::function<Load(double)> load)
    : rod_(rod), load_(std::move(load)) {
    prepare();
    y_.head<2>() = start;
    y_(2) = angle;
}

void PlanarRodMotion::prepare() {
    const int points = 2 * (rod_.degree + rod_.stretch_degree) + 4;
    const PiecewiseGaussGrid grid(Vector2d(0.0, rod_.length), points);
    s_ = grid.points();
    w_ = grid.weights();
    running_ = grid.running_integral();
    phi_.resize(points, basis(0.0).size());
    dphi_.resizeLike(phi_);
    chi_.resize(points, stretch_basis(0.0).size());
    // The derivative of a polynomial from its values, by the inverse of the running integral: B p' = p - p(0).
    const VectorXd at_root = basis(0.0);
    for (Index i = 0; i < points; ++i) {
        phi_.row(i) = basis(s_[i]).transpose();
        if (chi_.cols() > 0) chi_.row(i) = stretch_basis(s_[i]).transpose();
    }
    dphi_ = running_.partialPivLu().solve(phi_ - VectorXd::Ones(points) * at_root.transpose());
    y_.setZero(2 * (translations() + phi_.cols() + chi_.cols()));
}

VectorXd PlanarRodMotion::basis(double s) const {
    const double x = 2.0 * s / rod_.length - 1.0;
    if (!hub_) return legendre(rod_.degree, x);
    return s / rod_.length * legendre(rod_.degree - 1, x);
}

VectorXd PlanarRodMotion::stretch_basis(double s) const {
    if (std::isinf(rod_.EA)) return {};
    return legendre(rod_.stretch_degree, 2.0 * s / rod_.length - 1.0);
}

PlanarRodMotion::Fields PlanarRodMotion::fields(double time, const VectorXd& y) const {
    const Index m = y.size() / 2, t = translations(), p = phi_.cols(), e = chi_.cols();
    const Hub hub = hub_at(time);
    Fields f;
    const Eigen::ArrayXd theta = (phi_ * y.segment(t, p)).array() + hub.angle;
    f.cosine = theta.cos();
    f.sine = theta.sin();
    f.omega = (phi_ * y.segment(m + t, p)).array() + hub.rate;
    f.g = 1.0 + (chi_ * y.segment(t + p, e)).array();
    f.g_rate = (chi_ * y.segment(m + t + p, e)).array();
    f.x = running_ * (f.g * f.cosine).matrix();
    f.y = running_ * (f.g * f.sine).matrix();
    f.vx = running_ * (f.g_rate * f.cosine - f.g * f.omega * f.sine).matrix();
    f.vy = running_ * (f.g_rate * f.sine + f.g * f.omega * f.cosine).matrix();
    if (t > 0) {
        f.x.array() += y[0];
        f.y.array() += y[1];
        f.vx.array() += y[m];
        f.vy.array() += y[m + 1];
    }
    return f;
}

VectorXd PlanarRodMotion::accelerations(double time, const VectorXd& y) const {
    const Index m = y.size() / 2, t = translations(), p = phi_.cols(), e = chi_.cols();
    const Hub hub = hub_at(time);
    const Fields f = fields(time, y);
    // Derivatives of the positions by the unknowns, and their acceleration when these have none.
    MatrixXd Dx(s_.size(), m), Dy(s_.size(), m);
    if (t > 0) {
        Dx.leftCols<2>().rowwise() = Eigen::RowVector2d(1.0, 0.0);
        Dy.leftCols<2>().rowwise() = Eigen::RowVector2d(0.0, 1.0);
    }
    Dx.middleCols(t, p) = running_ * (-f.g * f.sine).matrix().asDiagonal() * phi_;
    Dy.middleCols(t, p) = running_ * (f.g * f.cosine).matrix().asDiagonal() * phi_;
    Dx.rightCols(e) = running_ * f.cosine.matrix().asDiagonal() * chi_;
    Dy.rightCols(e) = running_ * f.sine.matrix().asDiagonal() * chi_;
    const Eigen::ArrayXd across = 2.0 * f.g_rate * f.omega + f.g * hub.acceleration, along = f.g * f.omega * f.omega;
    const VectorXd ax = running_ * (-across * f.sine - along * f.cosine).matrix();
    const VectorXd ay = running_ * (across * f.cosine - along * f.sine).matrix();

    const auto W = w_.asDiagonal();
    MatrixXd M = rod_.mass * (Dx.transpose() * W * Dx + Dy.transpose() * W * Dy);
    M.block(t, t, p, p) += rod_.rotary_inertia * phi_.transpose() * W * phi_;
    VectorXd Q = -rod_.mass * (Dx.transpose() * W * ax + Dy.transpose() * W * ay);
    Q.segment(t, p) -= rod_.rotary_inertia * hub.acceleration * (phi_.transpose() * w_) +
                       rod_.EI * (dphi_.transpose() * W * (dphi_ * y.segment(t, p)));
    if (e > 0) Q.tail(e) -= rod_.EA * (chi_.transpose() * W * (chi_ * y.segment(t + p, e)));
    if (load_) {
        const Load load = load_(time);
        Q[0] += load.fx;
        Q[1] += load.fy;
        Q.segment(t, p) += load.moment * basis(0.0);
    }
    return M.llt().solve(Q);
}

void PlanarRodMotion::advance(double time, int steps) {
    const double h = (time - time_) / steps;
    const Index m = y_.size() / 2;
    const auto rate = [&](double t, const VectorXd& y) {
        VectorXd r(2 * m);
        r << y.tail(m), accelerations(t, y);
        return r;
    };
    const double start = time_;
    for (int i = 0; i < steps; ++i) {
        const double t = start + i * h;
        const VectorXd k1 = rate(t, y_);
        const VectorXd k2 = rate(t + h / 2.0, y_ + h / 2.0 * k1);
        const VectorXd k3 = rate(t + h / 2.0, y_ + h / 2.0 * k2);
        const VectorXd k4 = rate(t + h, y_ + h * k3);
        y_ += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    time_ = time;
}

double PlanarRodMotion::angle(double s) const {
    return hub_at(time_).angle + basis(s).dot(y_.segment(translations(), phi_.cols()));
}

double PlanarRodMotion::stretch(double s) const {
    return chi_.cols() > 0 ? stretch_basis(s).dot(y_.segment(translations() + phi_.cols(), chi_.cols())) : 0.0;
}

Vector2d PlanarRodMotion::position(double s) const {
    Vector2d r = hub_ ? Vector2d(0.0, 0.0) : Vector2d(y_.head<2>());
    const GaussRule rule = gauss_legendre(static_cast<int>(s_.size()));
    for (Index i = 0; i < rule.point.size(); ++i) {
        const double at = s / 2.0 * (1.0 + rule.point[i]), theta = angle(at);
        r += s / 2.0 * rule.weight[i] * (1.0 + stretch(at)) * Vector2d(std::cos(theta), std::sin(theta));
    }
    return r;
}

double PlanarRodMotion::kinetic_energy() const {
    const Fields f = fields(time_, y_);
    return 0.5 *
           w_.dot((rod_.mass * (f.vx.array().square() + f.vy.array().square()) + rod_.rotary_inertia * f.omega.square())
                      .matrix());
}

double PlanarRodMotion::strain_energy() const {
    const Index t = translations(), p = phi_.cols(), e = chi_.cols();
    double twice = rod_.EI * w_.dot((dphi_ * y_.segment(t, p)).array().square().matrix());
    if (e > 0) twice += rod_.EA * w_.dot((chi_ * y_.segment(t + p, e)).array().square().matrix());
    return 0.5 * twice;
}

Vector2d PlanarRodMotion::momentum() const {
    const Fields f = fields(time_, y_);
    return rod_.mass * Vector2d(w_.dot(f.vx), w_.dot(f.vy));
}

double PlanarRodMotion::angular_momentum() const {
    const Fields f = fields(time_, y_);
    return w_.dot(
        (rod_.mass * (f.x.array() * f.vy.array() - f.y.array() * f.vx.array()) + rod_.rotary_inertia * f.omega)
            .matrix());
}

Vector2d PlanarRodMotion::centre_of_mass() const {
    const Fields f = fields(time_, y_);
    return Vector2d(w_.dot(f.x), w_.dot(f.y)) / rod_.length;
}

void PlanarRodMotion::bend(const std::function<double(double)>& theta) {
    VectorXd values(s_.size());
    for (Index i = 0; i < s_.size(); ++i) values[i] = theta(s_[i]);
    y_.segment(translations(), phi_.cols()) =
        MatrixXd(phi_.transpose() * w_.asDiagonal() * phi_).llt().solve(phi_.transpose() * w_.asDiagonal() * values);
}

}  // namespace cardan::oracles
