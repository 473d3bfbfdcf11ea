#include "tests/oracles/teetered_head.hpp"

#include <Eigen/Geometry>

#include <array>
#include <cmath>

namespace cardan::oracles {

namespace {

using Complex = std::complex<double>;
using Vec = Eigen::Matrix<Complex, 3, 1>;
using Mat = Eigen::Matrix<Complex, 3, 3>;

// Without conjugation.
Complex dot(const Vec& a, const Vec& b) {
    return (a.transpose() * b).value();
}
Vec cross(const Vec& a, const Vec& b) {
    return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

// Turning by an angle about axis 0, 1 or 2.
Mat turn(int axis, Complex angle) {
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    Mat R = Mat::Identity();
    R(j, j) = R(k, k) = std::cos(angle);
    R(k, j) = std::sin(angle);
    R(j, k) = -R(k, j);
    return R;
}

// Angular velocity and acceleration, velocity and acceleration of a point, and their partial derivatives by the speeds.
struct Motion {
    Vec w, alpha, a;
    std::array<Vec, 8> w_by, v_by;

    // Motion of the point at r, carried along.
    Motion at(const Vec& r) const {
        Motion moved = *this;
        moved.a += cross(alpha, r) + cross(w, cross(w, r));
        for (std::size_t i = 0; i < 8; ++i) moved.v_by[i] += cross(w_by[i], r);
        return moved;
    }
};

// Generalised forces on the speeds.
struct Sum {
    Eigen::Matrix<Complex, 8, 1> of = Eigen::Matrix<Complex, 8, 1>::Zero();

    void load(const Motion& body, const Vec& force, const Vec& moment) {
        for (std::size_t i = 0; i < 8; ++i)
            of(static_cast<Eigen::Index>(i)) += dot(force, body.v_by[i]) + dot(moment, body.w_by[i]);
    }
    // Inertia of a body with mass centre at the point of the motion and principal axes R.
    void inertia(const Motion& body, double mass, const Mat& R, const Eigen::Vector3d& I) {
        const Mat tensor = R * Mat(I.cast<Complex>().asDiagonal()) * R.transpose();
        load(body, -mass * body.a, -(tensor * body.alpha) - cross(body.w, tensor * body.w));
    }
};

}  // namespace

Eigen::Matrix<Complex, 8, 1> TeeteredHead::kane(const Eigen::Matrix<Complex, columns, 1>& x, double psi) const {
    const auto u = [&](int i) { return x(U + i - 1); };
    const auto ud = [&](int i) { return x(Ud + i - 1); };
    const Vec t1 = Vec::UnitX(), t2 = Vec::UnitY(), t3 = Vec::UnitZ();
    const Mat y = turn(2, x(q_y)), s = y * turn(1, psi), h = s * turn(0, -x(q_h));
    const Vec y2 = y.col(1), h1 = h.col(0), h2 = h.col(1), h3 = h.col(2);

    const Vec w_tower(u(3), u(4), u(5)), v_tower(u(6), u(7), u(8));
    Motion nacelle;  // at the tower top; rates of components along t, which turn with w_tower
    nacelle.w = Vec(u(3), u(4), u(1));
    nacelle.alpha = Vec(ud(3), ud(4), ud(1)) + cross(w_tower, nacelle.w);
    nacelle.a = Vec(ud(6), ud(7), ud(8)) + cross(w_tower, v_tower);
    nacelle.w_by = {t3, Vec::Zero(), t1, t2, Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero()};
    nacelle.v_by = {Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero(), Vec::Zero(), t1, t2, t3};
    Motion shaft = nacelle;
    shaft.w += Omega * y2;
    shaft.alpha += cross(nacelle.w, Omega * y2);
    // The hub has U2 along h1 = s1, the rest from the shaft.
    const Complex rate = u(2) - dot(shaft.w, h1);
    Motion hub = nacelle.at(d_n2 * y2);
    hub.w = shaft.w + rate * h1;
    hub.alpha = shaft.alpha + (ud(2) - dot(shaft.alpha, h1)) * h1 + cross(shaft.w, rate * h1);
    for (Vec& by : hub.w_by) by -= dot(by, h1) * h1;
    hub.w_by[1] = h1;

    Sum sum;
    sum.inertia(nacelle.at(-c_n * y2), m_y, y, I_y);
    sum.inertia(shaft.at(-c_s * y2), m_s, s, {I_s_lat, I_s_long, I_s_lat});
    sum.inertia(hub.at(-c_h * h2), m_h, h, I_h);
    const auto blade = [&](int side, double steady) {
        const int first = side > 0 ? 0 : 3;
        Mat axes;
        axes << side * h3, side * h1, h2;
        const Vec force = axes * (Vec(x.segment<3>(F_hat + first)) + Vec(steady, 0, 0)),
                  moment = axes * Vec(x.segment<3>(M_hat + first));
        sum.load(hub.at(-d_h1 * h2 + side * d_h2 * h3), force, moment);
    };
    blade(+1, F_u);
    blade(-1, F_d);
    // The teeter angle as a turn about h1 is -q_h.
    const Vec teeter = (K_h * x(q_h) - C_h * rate) * h1, yaw = (-K_y * x(q_y) - C_y * (u(1) - u(5))) * t3;
    sum.load(hub, Vec::Zero(), teeter);
    sum.load(shaft, Vec::Zero(), -teeter);
    sum.load(nacelle, Vec::Zero(), yaw);
    Motion tower = nacelle;
    tower.w_by = {Vec::Zero(), Vec::Zero(), t1, t2, t3, Vec::Zero(), Vec::Zero(), Vec::Zero()};
    sum.load(tower, x.segment<3>(F_t), Vec(x.segment<3>(M_t)) - yaw);
    return sum.of;
}

Eigen::Matrix<double, 8, TeeteredHead::columns> TeeteredHead::linearised(double psi) const {
    constexpr double step = 1e-30;
    Eigen::Matrix<double, 8, columns> terms;
    for (int i = 0; i < columns; ++i) {
        Eigen::Matrix<Complex, columns, 1> x = Eigen::Matrix<Complex, columns, 1>::Zero();
        x(i) = Complex(0, step);
        terms.col(i) = kane(x, psi).imag() / step;
    }
    return terms;
}

Eigen::Matrix<double, 8, 1> TeeteredHead::at_rest(double psi) const {
    return kane(Eigen::Matrix<Complex, columns, 1>::Zero(), psi).real();
}

// Line by line from the paper.
TeeteredHead::Printed TeeteredHead::printed(double psi) const {
    const double s = std::sin(psi), c = std::cos(psi), W = Omega, m = m_y + m_s + m_h;
    const double I_h1 = I_h(0), I_h2 = I_h(1), I_h3 = I_h(2), axial = F_d - F_u;
    enum { F1u = F_hat, F2u, F3u, F1d, F2d, F3d, M1u = M_hat, M2u, M3u, M1d, M2d, M3d, U1 = U, U2, U3 };
    enum { Ud1 = Ud, Ud2, Ud3, Ud4, Ud6 = Ud + 5, Ud7, Ud8 };
    Printed p{Eigen::Matrix<double, 8, columns>::Zero(), Eigen::Matrix<double, 8, 1>::Zero()};
    const auto equation = [&](int i) { return p.terms.row(i - 1); };

    auto yaw = equation(1);
    yaw(F2u) = (d_h1 - d_n2) * c;
    yaw(q_h) = (K_h - c_h * d_n2 * m_h * W * W) * s;
    yaw(U2) = (C_h * s - W * (I_h2 - I_h1 - I_h3 - 2 * c_h * m_h * (c_h - d_n2))) * c;
    yaw(Ud8) = c_h * m_h * s * c;
    yaw(q_y) = -K_y;
    yaw(M1d) = -c;
    yaw(F1u) = -d_n2 * s;
    yaw(F2d) = -(d_h1 - d_n2) * c;
    yaw(U1) = -(C_y - 2 * W * (I_h3 * c_h * m_h * (c_h - 1.5 * d_n2))) * s * c;
    yaw(U3) = -W * (I_s_long + 2 * I_h3 * c * c + 2 * c_h * m_h * (c_h - d_n2 - (c_h - 1.5 * d_n2) * s * s));
    yaw(Ud2) = -c_h * d_n2 * m_h * s;
    yaw(Ud3) = -(I_h3 + c_h * m_h * (c_h - 2 * d_n2)) * s * c;
    yaw(Ud6) = -(c_n * m_y + c_s * m_s - m_h * (d_n2 - c_h * c * c));
    yaw(F1d) = d_n2 * s;
    yaw(Ud1) = -(I_s_lat + I_y(2) * m_s * c_s * c_s + m_y * c_n * c_n + I_h3 * c * c + d_n2 * axial * s -
                 m_h * (2 * c_h * d_n2 * c * c - d_n2 * d_n2 - c_h * c_h * c * c));
    yaw(M1u) = c;

    auto teeter = equation(2);
    p.at_rest(1) = d_h1 * axial;
    teeter(M2u) = 1;
    teeter(U2) = C_h;
    teeter(F1d) = d_h1;
    teeter(F3d) = d_h2;
    teeter(q_h) = K_h + W * W * (I_h2 - I_h3 - m_h * c_h * c_h);
    teeter(U3) = W * (I_h2 - I_h3 - m_h * c_h * c_h) * s;
    teeter(U1) = W * (I_h2 - I_h3 - m_h * c_h * c_h) * c;
    teeter(Ud6) = c_h * m_h * s;
    teeter(Ud8) = c_h * m_h * c;  // the sign between the two is missing
    teeter(Ud3) = c_h * d_n2 * m_h * c;
    teeter(M2d) = -1;
    teeter(F1u) = -d_h1;
    teeter(F3u) = -d_h2;
    teeter(Ud2) = -(I_h1 + m_h * c_h * c_h);
    teeter(Ud1) = -c_h * d_n2 * m_h * s;

    auto nod = equation(3);
    nod(M_t) = 1;
    nod(M1u) = s;
    nod(F1u) = d_n2 * c;
    nod(F2u) = (d_h1 - d_n2) * s;
    nod(F1d) = -d_n2 * c;
    nod(U1) = W * (I_s_long + 2 * I_h3 * s * s + c_h * m_h * (d_n2 + 2 * (c_h - 1.5 * d_n2) * s * s));
    nod(Ud2) = c_h * d_n2 * m_h * c;
    nod(Ud8) = c_n * m_y + c_s * m_s - m_h * (d_n2 - c_h * s * s);
    p.at_rest(2) = -d_n2 * axial * c - (I_s_lat + I_y(0) + m_s * c_s * c_s + m_y * c_n * c_n + I_h3 * s * s) - C_h * c;
    nod(F2d) = -(d_h1 - d_n2) * s;
    nod(q_h) = -(K_h - c_h * d_n2 * m_h * W * W) * c;
    nod(M1d) = -s;
    nod(U3) = -2 * W * (I_h3 + c_h * m_h * (c_h - 1.5 * d_n2)) * s * c;
    nod(U2) = W * (I_h2 - I_h1 - I_h3 - 2 * c_h * m_h * (c_h - d_n2)) * s;
    nod(Ud6) = -c_h * m_h * s * c;
    nod(Ud3) = m_h * (d_n2 * d_n2 + c_h * (c_h - 2 * d_n2) * s * s);
    nod(Ud1) = -(I_h3 + c_h * m_h * (c_h - 2 * d_n2)) * s * c;

    auto roll = equation(4);
    roll(M3d) = roll(M_t + 1) = roll(M3u) = 1;
    roll(F2d) = roll(F2u) = d_h2;
    roll(q_y) = -d_n2 * axial * c;
    roll(Ud4) = -(I_h2 + I_s_long + I_y(1));

    equation(5)(M_t + 2) = 1;
    equation(5)(q_y) = K_y;

    auto lateral = equation(6);
    lateral(F_t) = 1;
    lateral(F1u) = s;
    lateral(F2u) = c;
    lateral(U2) = 2 * c_h * m_h * W * c;
    lateral(q_h) = c_h * m_h * W * W * s;
    lateral(U1) = 3 * c_h * m_h * W * s * c;
    lateral(Ud2) = c_h * m_h * s;
    p.at_rest(5) = -axial * s;
    lateral(F1d) = -s;
    lateral(F2d) = -c;
    lateral(U3) = -2 * c_h * m_h * W * (1 - 1.5 * s * s);
    lateral(Ud6) = -m;
    lateral(Ud3) = -c_h * m_h * s * c;
    lateral(Ud1) = -(c_n * m_y + c_s * m_s - m_h * (d_n2 - c_h * c * c));

    auto fore_aft = equation(7);
    fore_aft(F3d) = fore_aft(F_t + 1) = fore_aft(F3u) = 1;
    fore_aft(q_h) = -axial;
    fore_aft(q_y) = -axial * s;
    fore_aft(Ud7) = -m;

    auto vertical = equation(8);
    vertical(F_t + 2) = 1;
    vertical(F2d) = s;
    vertical(F1u) = c;
    vertical(q_h) = c_h * m_h * W * W * c;
    vertical(Ud8) = -m;
    vertical(U3) = 3 * c_h * m_h * W * s * c;
    vertical(Ud2) = c_h * m_h * c;
    vertical(Ud1) = c_h * m_h * s * c;
    vertical(Ud3) = c_n * m_y + c_s * m_s - m_h * (d_n2 - c_h * s * s);
    p.at_rest(7) = -axial * c;
    vertical(F2u) = -s;
    vertical(F1d) = -c;
    vertical(U2) = -2 * c_h * m_h * W * s;
    vertical(U1) = -c_h * m_h * W * (-1 + 3 * s * s);
    return p;
}

}  // namespace cardan::oracles
