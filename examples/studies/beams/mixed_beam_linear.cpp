// Boundary equations, steady state and small vibrations of the mixed beam.
#include "examples/studies/beams/mixed_beam.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/spatial.hpp"

#include <Eigen/Geometry>

#include <algorithm>

namespace cardan {

namespace {

using Field = MixedField;
using Eigen::Index;

// Columns: hinge axis and two directions across it.
Mat3 hinge_axes(const MixedPin& pin) {
    Mat3 axes;
    axes.col(0) = pin.axis.normalized();
    axes.col(1) = axes.col(0).unitOrthogonal();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
}

Mat6 momentum_matrix(const RigidInertia& body) {
    return cardan::momentum_matrix(body.mass, body.com, body.J);
}

template <class S>
Eigen::Matrix<S, 12, 1> boundary_residual(const MixedBeam& beam, const MixedSetting& setting, const VectorT<S>& x,
                                          const VectorT<S>& xdot) {
    const Vec3T<S> g = setting.g.cast<S>();
    const auto at = [&](Index station, Index field) { return Vec3T<S>(x.template segment<3>(station + field)); };
    const auto load = [&](const RigidInertia& body, Index station, const Mat3T<S>& R) {
        return inertial_load<S>(momentum_matrix(body), x.template segment<6>(station + Field::V),
                                xdot.template segment<6>(station + Field::V), R.transpose() * g);
    };
    Eigen::Matrix<S, 12, 1> r;
    const Index root = MixedBeam::root(), tip = beam.tip();
    if (setting.pin) {
        const Mat3T<S> axes = hinge_axes(*setting.pin).cast<S>(), R = rodrigues_rotation<S>(at(root, Field::theta));
        const Vec3T<S> point = setting.pin->point.cast<S>(), axis = axes.col(0);
        const Vec6T<S> section_less_body = x.template segment<6>(root + Field::F) - load(setting.pin->body, root, R);
        const Vec3T<S> force = section_less_body.template head<3>(), moment = section_less_body.template tail<3>();
        r.template head<3>() = at(root, Field::u) - point + R * point;
        r(3) = dot<S>(axes.col(1), at(root, Field::theta));
        r(4) = dot<S>(axes.col(2), at(root, Field::theta));
        r(5) = dot<S>(axis, moment - cross<S>(point, force));
    } else {
        r.template head<6>() = x.template segment<6>(root + Field::u);
    }
    const Mat3T<S> R = rodrigues_rotation<S>(at(tip, Field::theta));
    Vec6T<S> applied;
    applied << R.transpose() * setting.force.cast<S>() + setting.follower_force.cast<S>(),
        R.transpose() * setting.moment.cast<S>() + setting.follower_moment.cast<S>();
    r.template tail<6>() = x.template segment<6>(tip + Field::F) - applied + load(setting.tip_body, tip, R);
    return r;
}

DescriptorPencil boundary_pencil(const MixedBeam& beam, const MixedSetting& setting, const Vector& x) {
    using Row6 = Eigen::Matrix<double, 1, 6>;
    using Mat63 = Eigen::Matrix<double, 6, 3>;
    DescriptorPencil rows{Matrix::Zero(12, beam.unknowns()), Matrix::Zero(12, beam.unknowns())};
    auto& [E, A] = rows;
    const auto turned = [&](Index station, const Vec3& a) {  // C a by theta
        const Vec3 theta = x.segment<3>(station + Field::theta);
        return Mat3(skew<double>(rodrigues_rotation<double>(theta).transpose() * a) * rodrigues_inverse_tangent(theta));
    };
    const Index root = MixedBeam::root(), tip = beam.tip();
    A.block<3, 3>(0, root + Field::u).setIdentity();
    if (setting.pin) {
        const Mat3 axes = hinge_axes(*setting.pin);
        const Vec3 &point = setting.pin->point, theta = x.segment<3>(root + Field::theta);
        const Mat6 inertia = momentum_matrix(setting.pin->body);
        Row6 balance;  // moment about the hinge by force and moment at the root
        balance << -axes.col(0).transpose() * skew<double>(point), axes.col(0).transpose();
        A.block<3, 3>(0, root + Field::theta) =
            -rodrigues_rotation<double>(theta) * skew<double>(point) * rodrigues_inverse_tangent(theta);
        A.block<2, 3>(3, root + Field::theta) = axes.rightCols<2>().transpose();
        A.block<1, 3>(5, root + Field::theta) = balance * Mat63(inertia.leftCols<3>() * turned(root, setting.g));
        A.block<1, 6>(5, root + Field::F) = balance;
        A.block<1, 6>(5, root + Field::V) =
            -balance * inertial_load_by_velocity(inertia, x.segment<6>(root + Field::V));
        E.block<1, 6>(5, root + Field::V) = -balance * inertia;
    } else {
        A.block<3, 3>(3, root + Field::theta).setIdentity();
    }
    const Mat6 inertia = momentum_matrix(setting.tip_body);
    Mat63 applied;
    applied << turned(tip, setting.force), turned(tip, setting.moment);
    A.block<6, 3>(6, tip + Field::theta) = -applied - inertia.leftCols<3>() * turned(tip, setting.g);
    A.block<6, 6>(6, tip + Field::F).setIdentity();
    A.block<6, 6>(6, tip + Field::V) = inertial_load_by_velocity(inertia, x.segment<6>(tip + Field::V));
    E.block<6, 6>(6, tip + Field::V) = inertia;
    return rows;
}

// Scales of beam and boundary equations.
Vector all_equation_scales(const MixedBeam& beam, const MixedSetting& setting) {
    const auto& [length, force, time] = beam.scales();
    Vector scales(beam.unknowns());
    scales.head(beam.equations()) = beam.equation_scales();
    scales.tail<12>() << Vec3::Constant(length), Vec3::Ones(), Vec3::Constant(force), Vec3::Constant(force * length);
    if (setting.pin) scales(beam.equations() + 5) = force * length;
    return scales;
}

void check(const MixedBeam& beam, const MixedSetting& setting) {
    const auto finite = [&](const char* quantity, const Vec3& value) {
        if (!value.allFinite()) throw InputError(beam.name(), quantity, value.transpose(), "finite");
    };
    finite("angular velocity of the root [rad/s]", setting.omega);
    finite("position of the root [m]", setting.root_position);
    finite("acceleration field [m/s^2]", setting.g);
    const Vec3 &omega = setting.omega, &g = setting.g;
    if (omega.cross(g).norm() > 1e-9 * omega.norm() * g.norm())
        throw InputError(beam.name(), "angular velocity and acceleration field",
                         text(omega.transpose(), "; ", g.transpose()), "parallel, or one of them zero");
    finite("tip force [N]", setting.force);
    finite("tip moment [N m]", setting.moment);
    finite("follower force [N]", setting.follower_force);
    finite("follower moment [N m]", setting.follower_moment);
    setting.tip_body.check(text(beam.name(), ": tip body"));
    if (!setting.pin) return;
    setting.pin->body.check(text(beam.name(), ": body at the hinge"));
    finite("hinge axis", setting.pin->axis);
    finite("hinge point [m]", setting.pin->point);
    if (!(setting.pin->axis.norm() > 0)) throw InputError(beam.name(), "length of the hinge axis", 0, "> 0");
}

MixedSetting scaled(MixedSetting setting, double factor) {
    for (Vec3* load : {&setting.omega, &setting.g, &setting.force, &setting.moment, &setting.follower_force,
                       &setting.follower_moment})
        *load *= factor;
    return setting;
}

// The shortest solution if A is singular: a hinged beam has no stiffness about the hinge before it feels its tension.
Vector solve(const Matrix& A, const Vector& r) {
    const Eigen::PartialPivLU<Matrix> lu(A);
    const Vector pivots = lu.matrixLU().diagonal().cwiseAbs();
    if (pivots.minCoeff() > 1e-13 * pivots.maxCoeff()) return lu.solve(r);
    Eigen::CompleteOrthogonalDecomposition<Matrix> orthogonal(A.rows(), A.cols());
    orthogonal.setThreshold(1e-13);
    return orthogonal.compute(A).solve(r);
}

struct NewtonResult {
    bool converged;
    int iterations;
    double residual;
};

// Improves x, all in the scales of the beam.
NewtonResult newton(const MixedBeam& beam, const MixedSetting& setting, Vector& x) {
    constexpr int max = 30;
    const Vector columns = beam.unknown_scales(), rows = all_equation_scales(beam, setting);
    const Vector rest = Vector::Zero(beam.unknowns());
    for (int i = 0;; ++i) {
        const Vector r = mixed_residual<double>(beam, setting, x, rest).cwiseQuotient(rows);
        const double residual = r.lpNorm<Eigen::Infinity>();
        // Rounding leaves a few units of the largest unknown.
        if (residual <= 1e-13 * (1 + x.cwiseQuotient(columns).lpNorm<Eigen::Infinity>())) return {true, i, residual};
        if (i == max || !std::isfinite(residual)) return {false, i, residual};
        const Matrix A = rows.cwiseInverse().asDiagonal() * mixed_pencil(beam, setting, x).A * columns.asDiagonal();
        x -= columns.cwiseProduct(solve(A, r));
    }
}

}  // namespace

template <class S>
VectorT<S> mixed_residual(const MixedBeam& beam, const MixedSetting& setting, const VectorT<S>& x,
                          const VectorT<S>& xdot) {
    const MixedRootMotion motion = setting.motion();
    VectorT<S> r(beam.unknowns());
    r.head(beam.equations()) = beam.residual<S>(
        x, xdot, {motion.v.template cast<S>(), motion.omega.template cast<S>(), motion.g.template cast<S>()});
    r.template tail<12>() = boundary_residual<S>(beam, setting, x, xdot);
    return r;
}

DescriptorPencil mixed_pencil(const MixedBeam& beam, const MixedSetting& setting, const Vector& x) {
    const MixedJacobian jacobian = beam.jacobian(x, setting.motion());
    DescriptorPencil pencil{Matrix::Zero(beam.unknowns(), beam.unknowns()),
                            Matrix::Zero(beam.unknowns(), beam.unknowns())};
    pencil.E.topRows(beam.equations()) = jacobian.rate;
    pencil.A.topRows(beam.equations()) = jacobian.state;
    const DescriptorPencil boundary = boundary_pencil(beam, setting, x);
    pencil.E.bottomRows<12>() = boundary.E;
    pencil.A.bottomRows<12>() = boundary.A;
    return pencil;
}

MixedSteadyState mixed_steady_state(const MixedBeam& beam, const MixedSetting& setting) {
    check(beam, setting);
    MixedSteadyState steady{Vector::Zero(beam.unknowns()), 0, 0};
    double reached = 0, step = 1;
    while (reached < 1) {
        const double factor = std::min(1.0, reached + step);
        Vector x = steady.x;
        const NewtonResult result = newton(beam, scaled(setting, factor), x);
        steady.iterations += result.iterations;
        if (result.converged) {
            steady.x = x;
            steady.residual = result.residual;
            reached = factor;
        } else if ((step /= 2) < 1. / 128) {
            throw NumericalError(text(beam.name(), ": no steady state of the mixed beam; Newton stopped at ",
                                      100 * factor, " % of load and spin after ", steady.iterations,
                                      " iterations, residual ", result.residual,
                                      " (beam scales). Buckled, turned by half a turn, or free to move?"));
        }
    }
    return steady;
}

std::vector<DescriptorMode> finite_modes(const DescriptorPencil& pencil) {
    constexpr double rank_tolerance = 1e-12;
    const Index size = pencil.E.rows();
    if (pencil.E.cols() != size || pencil.A.rows() != size || pencil.A.cols() != size)
        throw InputError("pencil", "size of E or A", size, "both square, of one size");
    Matrix E = pencil.E, A = pencil.A, basis = Matrix::Identity(size, size);
    for (;;) {
        Eigen::ColPivHouseholderQR<Matrix> range(E.rows(), E.cols());
        range.setThreshold(rank_tolerance);
        range.compute(E);
        const Index rank = range.rank(), constraints = E.rows() - rank;
        if (constraints == 0) break;
        const Matrix Q_range = orthogonal_factor(range);
        E = Q_range.transpose() * E;
        A = Q_range.transpose() * A;
        const Matrix constraint = A.bottomRows(constraints).rowwise().normalized().transpose();
        Eigen::ColPivHouseholderQR<Matrix> normal(constraint.rows(), constraint.cols());
        normal.setThreshold(rank_tolerance);
        normal.compute(constraint);
        if (normal.rank() < constraints)
            throw NumericalError(text("singular pencil: ", constraints - normal.rank(), " of ", constraints,
                                      " constraints depend on the others"));
        const Matrix free = orthogonal_factor(normal).rightCols(rank);
        E = (E.topRows(rank) * free).eval();
        A = (A.topRows(rank) * free).eval();
        basis = (basis * free).eval();
    }
    std::vector<DescriptorMode> modes;
    if (E.rows() == 0) return modes;
    // (A + s E)^-1 E has the eigenvalues mu = 1/(s - lambda): slow motions come out to full precision.
    constexpr double s = 0.73;
    const Eigen::PartialPivLU<Matrix> lu(A + s * E);
    const Eigen::EigenSolver<Matrix> solver(Matrix(lu.solve(E)));
    if (solver.info() != Eigen::Success) throw NumericalError("eigenvalues of the pencil: iteration failed");
    for (Index i = 0; i < E.rows(); ++i) {
        const Complex eigenvalue = s - 1.0 / solver.eigenvalues()(i);
        if (eigenvalue.imag() < 0) continue;
        modes.push_back({eigenvalue, (basis * solver.eigenvectors().col(i)).normalized()});
    }
    std::stable_sort(modes.begin(), modes.end(), [](const DescriptorMode& a, const DescriptorMode& b) {
        const bool a_real = a.eigenvalue.imag() == 0, b_real = b.eigenvalue.imag() == 0;
        return a_real != b_real ? b_real : std::abs(a.eigenvalue) < std::abs(b.eigenvalue);
    });
    return modes;
}

std::vector<DescriptorMode> mixed_modes(const MixedBeam& beam, const MixedSetting& setting, const Vector& x) {
    const Vector columns = beam.unknown_scales(), rows = all_equation_scales(beam, setting);
    const auto& [length, force, time] = beam.scales();
    DescriptorPencil pencil = mixed_pencil(beam, setting, x);
    pencil.E = rows.cwiseInverse().asDiagonal() * pencil.E * (columns / time).asDiagonal();
    pencil.A = rows.cwiseInverse().asDiagonal() * pencil.A * columns.asDiagonal();
    std::vector<DescriptorMode> modes = finite_modes(pencil);
    for (DescriptorMode& mode : modes) {
        mode.eigenvalue /= time;
        Complex largest = 0;
        const auto look = [&](Index first) {
            for (Index i = first; i < first + 6; ++i)
                if (std::abs(mode.shape(i)) > std::abs(largest)) largest = mode.shape(i);
        };
        for (int k = 0; k < beam.elements() + 2; ++k) look(MixedBeam::station(k));
        mode.shape = mode.shape.cwiseProduct(columns);
        if (largest != 0.0) mode.shape /= largest;
    }
    return modes;
}

template Vector mixed_residual(const MixedBeam&, const MixedSetting&, const Vector&, const Vector&);
template ComplexVector mixed_residual(const MixedBeam&, const MixedSetting&, const ComplexVector&,
                                      const ComplexVector&);

}  // namespace cardan
