#include "examples/studies/beams/mixed_beam.hpp"

#include "elements/sections/quadrature.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/spatial.hpp"

#include <cassert>

namespace cardan {

template <class S>
Mat3T<S> rodrigues_rotation(const Vec3T<S>& theta) {
    const S quarter = dot<S>(theta, theta) / S(4);
    const Mat3T<S> numerator =
        (S(1) - quarter) * Mat3T<S>::Identity() + skew<S>(theta) + theta * theta.transpose() / S(2);
    return numerator / (S(1) + quarter);
}

Mat3 rodrigues_inverse_tangent(const Vec3& theta) {
    return (Mat3::Identity() - skew<double>(theta) / 2) / (1 + theta.squaredNorm() / 4);
}

Mat6 momentum_matrix(double mass, const Vec3& centre, const Mat3& J) {
    const Mat3 c = skew<double>(centre);
    Mat6 inertia;
    inertia << mass * Mat3::Identity(), -mass * c, mass * c, J - mass * c * c;
    return inertia;
}

template <class S>
Vec6T<S> inertial_load(const Mat6& inertia, const Vec6T<S>& velocity, const Vec6T<S>& rate, const Vec3T<S>& g) {
    const Vec3T<S> V = velocity.template head<3>(), Omega = velocity.template tail<3>();
    const Vec6T<S> momentum = inertia.cast<S>() * velocity;
    const Vec3T<S> P = momentum.template head<3>(), H = momentum.template tail<3>();
    Vec6T<S> load = inertia.cast<S>() * rate;
    load.template head<3>() += cross<S>(Omega, P) - S(inertia(0, 0)) * g;
    load.template tail<3>() += cross<S>(Omega, H) + cross<S>(V, P) - inertia.bottomLeftCorner<3, 3>().cast<S>() * g;
    return load;
}

Mat6 inertial_load_by_velocity(const Mat6& inertia, const Vec6& velocity) {
    const Vec6 momentum = inertia * velocity;
    const Mat3 V = skew<double>(velocity.head<3>()), Omega = skew<double>(velocity.tail<3>());
    const Mat3 P = skew<double>(momentum.head<3>()), H = skew<double>(momentum.tail<3>());
    Mat6 by;
    by << Omega * inertia.topRows<3>(), Omega * inertia.bottomRows<3>() + V * inertia.topRows<3>();
    by.topRightCorner<3, 3>() -= P;
    by.bottomLeftCorner<3, 3>() -= P;
    by.bottomRightCorner<3, 3>() -= H;
    return by;
}

namespace {

using Field = MixedField;
using Eigen::Index;

// T(theta) with dtheta = T dphi, dphi a rotation in section axes.
template <class S>
Mat3T<S> tangent(const Vec3T<S>& theta) {
    return Mat3T<S>::Identity() + skew<S>(theta) / S(2) + theta * theta.transpose() / S(4);
}

// d(T b)/dtheta at constant b.
Mat3 tangent_times(const Vec3& theta, const Vec3& b) {
    return -skew<double>(b) / 2 + (theta.dot(b) * Mat3::Identity() + theta * b.transpose()) / 4;
}

template <class S>
struct Station {
    Vec3T<S> u, theta, F, M, V, Omega;
    Mat3T<S> R, T;

    Station(const VectorT<S>& x, Index first)
        : u(x.template segment<3>(first + Field::u)),
          theta(x.template segment<3>(first + Field::theta)),
          F(x.template segment<3>(first + Field::F)),
          M(x.template segment<3>(first + Field::M)),
          V(x.template segment<3>(first + Field::V)),
          Omega(x.template segment<3>(first + Field::Omega)),
          R(rodrigues_rotation<S>(theta)),
          T(tangent<S>(theta)) {}
};

using Vec12 = Eigen::Matrix<double, 12, 1>;

// Scales of (u, theta, F, M).
Vec12 end_scales(const MixedBeam::Scales& scales) {
    Vec12 units;
    units << Vec3::Constant(scales.length), Vec3::Ones(), Vec3::Constant(scales.force),
        Vec3::Constant(scales.force * scales.length);
    return units;
}

// Scales of (V, Omega) and of the velocity equations.
Vec6 velocity_scales(const MixedBeam::Scales& scales) {
    Vec6 units;
    units << Vec3::Constant(scales.length / scales.time), Vec3::Constant(1 / scales.time);
    return units;
}

}  // namespace

MixedBeam::MixedBeam(const BeamLine& line, int elements) : name_(line.name), length_(line.length), scales_{} {
    line.check();
    if (!line.is_straight()) throw InputError(name_, "reference line", "curved", "straight with mixed elements");
    if (elements < 1) throw InputError(name_, "number of elements", elements, ">= 1");
    const double h = length_ / elements;
    double flexibility = 0;
    for (int i = 0; i < elements; ++i) {
        const auto average = [&](const auto& of_section) {
            const Mat6 zero = Mat6::Zero();
            const auto f = [&](double x) -> Mat6 { return of_section(line.section(x)); };
            return Mat6(integrate(i * h, (i + 1) * h, line.breaks, zero, f) / h);
        };
        Element e;
        e.compliance = average([](const BeamSection& s) -> Mat6 { return s.compliance; });
        e.inertia = average([](const BeamSection& s) { return momentum_matrix(s.mass, s.centre, s.J); });
        const std::string where = text(name_, " element ", i + 1);
        if (!e.compliance.allFinite()) throw InputError(where, "compliance", e.compliance.sum(), "finite");
        if (!e.inertia.allFinite()) throw InputError(where, "inertia", e.inertia.sum(), "finite");
        if (!(e.inertia.diagonal().minCoeff() >= 0))
            throw InputError(where, "mass or inertia per length", e.inertia.diagonal().minCoeff(), ">= 0");
        if (!(e.compliance.diagonal().minCoeff() >= 0))
            throw InputError(where, "compliance", e.compliance.diagonal().minCoeff(), ">= 0 on the diagonal");
        flexibility = std::max({flexibility, e.compliance.diagonal().head<3>().maxCoeff(),
                                length_ * length_ * e.compliance.diagonal().tail<3>().maxCoeff()});
        elements_.push_back(e);
    }
    if (!(flexibility > 0)) throw InputError(name_, "largest compliance", flexibility, "> 0");
    const double force = 1 / flexibility, time = std::sqrt(mass() * length_ / force);
    scales_ = {length_, force, time > 0 ? time : 1};  // without mass there is no motion to scale
}

double MixedBeam::mass() const {
    double sum = 0;
    for (const Element& e : elements_) sum += e.inertia(0, 0) * length_ / elements();
    return sum;
}

double MixedBeam::position(int k) const {
    if (k == 0) return 0;
    return k > elements() ? length_ : (k - 0.5) * length_ / elements();
}

Vector MixedBeam::unknown_scales() const {
    Vector scales(unknowns());
    for (int k = 0; k < elements() + 2; ++k)
        scales.segment<18>(station(k)) << end_scales(scales_), velocity_scales(scales_);
    return scales;
}

Vector MixedBeam::equation_scales() const {
    Vector scales(equations());
    for (int j = 0; j <= elements(); ++j) scales.segment<12>(node_rows(j)) = end_scales(scales_);
    for (int k = 0; k < elements() + 2; ++k) scales.segment<6>(velocity_rows(k)) = velocity_scales(scales_);
    return scales;
}

// With slopes s = (u', theta', F', M') of an element, centre values y and half length h/2, the element contributes
// y - h/2 s to the node before it and -y - h/2 s to the one behind.
template <class S>
VectorT<S> MixedBeam::residual(const VectorT<S>& x, const VectorT<S>& xdot, const MixedRootMotionT<S>& motion) const {
    assert(x.size() == unknowns() && xdot.size() == unknowns());
    VectorT<S> r = VectorT<S>::Zero(equations());
    const Vec3T<S> e = Vec3T<S>::UnitX();
    r.template head<12>() -= x.template head<12>();
    r.template segment<12>(node_rows(elements())) += x.template segment<12>(tip());
    for (int i = 0; i < elements(); ++i) {
        const Element& section = entry(elements_, i);
        const Index first = station(i + 1);
        const Station<S> a(x, first);
        const Vec6T<S> strain = section.compliance.cast<S>() * x.template segment<6>(first + Field::F);
        const Vec3T<S> e_gamma = strain.template head<3>() + e, kappa = strain.template tail<3>();
        const Vec6T<S> load = inertial_load<S>(section.inertia, x.template segment<6>(first + Field::V),
                                               xdot.template segment<6>(first + Field::V), a.R.transpose() * motion.g);
        Eigen::Matrix<S, 12, 1> slope;
        slope << a.R * e_gamma - e, a.T * kappa, load.template head<3>() - cross<S>(kappa, a.F),
            load.template tail<3>() - cross<S>(kappa, a.M) - cross<S>(e_gamma, a.F);
        const Eigen::Matrix<S, 12, 1> half = slope * S(length_ / elements() / 2);
        r.template segment<12>(node_rows(i)) += x.template segment<12>(first) - half;
        r.template segment<12>(node_rows(i + 1)) -= x.template segment<12>(first) + half;
    }
    for (int k = 0; k < elements() + 2; ++k) {
        const Station<S> a(x, station(k));
        const Vec3T<S> arm = S(position(k)) * e + a.u, relative = a.Omega - a.R.transpose() * motion.omega;
        r.template segment<6>(velocity_rows(k)) = xdot.template segment<6>(station(k) + Field::u);
        r.template segment<3>(velocity_rows(k)) += motion.v + cross<S>(motion.omega, arm) - a.R * a.V;
        r.template segment<3>(velocity_rows(k) + 3) -= a.T * relative;
    }
    return r;
}

// With dphi = T^-1 dtheta in section axes: d(R a) = -R a^ dphi, d(C a) = (C a)^ dphi.
MixedJacobian MixedBeam::jacobian(const Vector& x, const MixedRootMotion& motion) const {
    assert(x.size() == unknowns());
    const double half = length_ / elements() / 2;
    MixedJacobian jacobian{Matrix::Zero(equations(), unknowns()), Matrix::Zero(equations(), unknowns()),
                           Matrix::Zero(equations(), 9)};
    Matrix &E = jacobian.rate, &A = jacobian.state, &B = jacobian.motion;
    A.topLeftCorner<12, 12>().diagonal().setConstant(-1);
    A.block<12, 12>(node_rows(elements()), tip()).diagonal().setOnes();
    for (int i = 0; i < elements(); ++i) {
        const Element& section = entry(elements_, i);
        const Index first = station(i + 1);
        const Station<double> a(x, first);
        const Vec6 strain = section.compliance * x.segment<6>(first + Field::F);
        const Vec3 e_gamma = strain.head<3>() + Vec3::UnitX(), kappa = strain.tail<3>();
        const auto gamma_by = section.compliance.topRows<3>(), kappa_by = section.compliance.bottomRows<3>();
        const Mat3 inverse_T = rodrigues_inverse_tangent(a.theta), C = a.R.transpose();
        const Eigen::Matrix<double, 6, 3> gravity_by = -section.inertia.leftCols<3>();

        Eigen::Matrix<double, 12, 18> slope = Eigen::Matrix<double, 12, 18>::Zero();
        slope.block<3, 3>(Field::u, Field::theta) = -a.R * skew<double>(e_gamma) * inverse_T;
        slope.block<3, 6>(Field::u, Field::F) = a.R * gamma_by;
        slope.block<3, 3>(Field::theta, Field::theta) = tangent_times(a.theta, kappa);
        slope.block<3, 6>(Field::theta, Field::F) = a.T * kappa_by;
        slope.block<3, 6>(Field::F, Field::F) = skew<double>(a.F) * kappa_by;
        slope.block<3, 3>(Field::F, Field::F) -= skew<double>(kappa);
        slope.block<3, 6>(Field::M, Field::F) = skew<double>(a.M) * kappa_by + skew<double>(a.F) * gamma_by;
        slope.block<3, 3>(Field::M, Field::F) -= skew<double>(e_gamma);
        slope.block<3, 3>(Field::M, Field::M) -= skew<double>(kappa);
        slope.block<6, 3>(Field::F, Field::theta) = gravity_by * skew<double>(C * motion.g) * inverse_T;
        slope.block<6, 6>(Field::F, Field::V) =
            inertial_load_by_velocity(section.inertia, x.segment<6>(first + Field::V));

        for (int side : {0, 1}) {
            const Index row = node_rows(i + side);
            A.block<12, 18>(row, first) -= half * slope;
            A.block<12, 12>(row, first).diagonal().array() += side == 0 ? 1 : -1;
            E.block<6, 6>(row + Field::F, first + Field::V) -= half * section.inertia;
            B.block<6, 3>(row + Field::F, 6) -= half * gravity_by * C;
        }
    }
    for (int k = 0; k < elements() + 2; ++k) {
        const Station<double> a(x, station(k));
        const Index row = velocity_rows(k), column = station(k);
        const Mat3 inverse_T = rodrigues_inverse_tangent(a.theta), C = a.R.transpose();
        const Vec3 turned_omega = C * motion.omega;
        E.block<6, 6>(row, column).setIdentity();
        A.block<3, 3>(row, column + Field::u) = skew<double>(motion.omega);
        A.block<3, 3>(row, column + Field::theta) = a.R * skew<double>(a.V) * inverse_T;
        A.block<3, 3>(row, column + Field::V) = -a.R;
        A.block<3, 3>(row + 3, column + Field::theta) =
            -tangent_times(a.theta, a.Omega - turned_omega) + a.T * skew<double>(turned_omega) * inverse_T;
        A.block<3, 3>(row + 3, column + Field::Omega) = -a.T;
        B.block<3, 3>(row, 0).setIdentity();
        B.block<3, 3>(row, 3) = -skew<double>(position(k) * Vec3::UnitX() + a.u);
        B.block<3, 3>(row + 3, 3) = a.T * C;
    }
    return jacobian;
}

template Mat3 rodrigues_rotation(const Vec3&);
template Mat3T<Complex> rodrigues_rotation(const Vec3T<Complex>&);
template Vec6 inertial_load(const Mat6&, const Vec6&, const Vec6&, const Vec3&);
template Vec6T<Complex> inertial_load(const Mat6&, const Vec6T<Complex>&, const Vec6T<Complex>&, const Vec3T<Complex>&);
template Vector MixedBeam::residual(const Vector&, const Vector&, const MixedRootMotion&) const;
template ComplexVector MixedBeam::residual(const ComplexVector&, const ComplexVector&,
                                           const MixedRootMotionT<Complex>&) const;

}  // namespace cardan
