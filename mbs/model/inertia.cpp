#include "mbs/model/inertia.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"

namespace cardan {

RigidInertia RigidInertia::in(const Placement& frame_in_a) const {
    return {mass, frame_in_a * com, frame_in_a.R * J * frame_in_a.R.transpose(), reduced};
}

RigidInertia RigidInertia::operator+(const RigidInertia& other) const {
    const double total = mass + other.mass;
    // Reduced mass of the pair times the squared distance (parallel-axis theorem); zero if one of them is massless.
    const double mu = total > 0 ? mass * other.mass / total : 0.0;
    const Vec3 d = other.com - com;
    RigidInertia sum;
    sum.mass = total;
    sum.com = total > 0 ? Vec3((mass * com + other.mass * other.com) / total) : com;
    sum.J = J + other.J + mu * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
    sum.reduced = reduced || other.reduced;
    return sum;
}

void RigidInertia::check(std::string_view where) const {
    require_not_negative(where, "mass [kg]", mass);
    if (!com.allFinite()) throw InputError(where, "centre of mass [m]", com.transpose(), "finite");
    if (!J.allFinite()) throw InputError(where, "inertia tensor [kg m^2]", J, "finite");
    if (mass != 0 && !(mass >= 1e-60 && mass <= 1e60))
        throw InputError(where, "mass [kg]", mass, "0, or 1e-60 ... 1e60");
    if (!(com.cwiseAbs().maxCoeff() <= 1e30))
        throw InputError(where, "centre of mass [m]", com.transpose(), "within 1e30 of the origin");
    const double largest = J.cwiseAbs().maxCoeff();
    if (largest != 0 && !(largest >= 1e-100 && largest <= 1e100))
        throw InputError(where, "largest entry of the inertia tensor [kg m^2]", largest, "0, or 1e-100 ... 1e100");
    const double size = J.norm();
    if ((J - J.transpose()).norm() > 1e-12 * size) throw InputError(where, "inertia tensor [kg m^2]", J, "symmetric");
    const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(J, Eigen::EigenvaluesOnly).eigenvalues();
    if (principal(0) < -1e-9 * size)
        throw InputError(where, "smallest principal moment of inertia [kg m^2]", principal(0), ">= 0");
    if (!reduced && principal(2) - principal(0) - principal(1) > 1e-9 * size)
        throw InputError(where, "principal moments of inertia [kg m^2]", principal.transpose(),
                         "triangle inequality A + B >= C (or mark the inertia as reduced)");
}

}  // namespace cardan
