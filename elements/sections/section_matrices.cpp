#include "elements/sections/section_matrices.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "mbs/model/spatial.hpp"

namespace cardan {

namespace {

Mat6 both(const Mat3& R) {
    Mat6 m = Mat6::Zero();
    m.topLeftCorner<3, 3>() = m.bottomRightCorner<3, 3>() = R;
    return m;
}

// Wrench at the new point from that at the old one; it moves momenta alike.
Mat6 to_point(const Vec3& to) {
    Mat6 m = Mat6::Identity();
    m.bottomLeftCorner<3, 3>() = -skew<double>(to);
    return m;
}

double unit_scale(double diagonal) {
    return diagonal > 0 ? 1 / std::sqrt(diagonal) : 1.0;
}

// K with a number in the place of infinite stiffnesses.
Mat6 finite_part(Mat6 K, double instead = 1) {
    for (Eigen::Index i = 0; i < 6; ++i)
        if (std::isinf(K(i, i))) K(i, i) = instead;
    return K;
}

// 1 / sqrt(K_ii), and 0 for an infinite stiffness. Newtons and N m^2 differ by decades: symmetry and eigenvalues are
// those of the matrix scaled to unit diagonal.
Vec6 unit_scales(const Mat6& K) {
    return K.diagonal().cwiseSqrt().cwiseInverse();
}

// K scaled to unit diagonal. Rigid directions do not couple with others.
Mat6 unit_stiffness(const Mat6& K) {
    const Vec6 d = unit_scales(K);
    Mat6 unit = d.asDiagonal() * finite_part(K) * d.asDiagonal();
    unit.diagonal().setOnes();
    return unit;
}

void check_stiffness(const Mat6& K, const std::string& where) {
    if (!finite_part(K).allFinite())
        throw InputError(where, "6 x 6 stiffness", text("\n", K, "\n"), "finite, but for rigid directions");
    for (Eigen::Index i = 0; i < 6; ++i) {
        if (!(K(i, i) > 0)) throw InputError(where, text("6 x 6 stiffness, diagonal entry ", i + 1), K(i, i), "> 0");
        if (std::isinf(K(i, i)) && (finite_part(K).row(i).cwiseAbs().sum() != 1))
            throw InputError(where, "6 x 6 stiffness", text("\n", K, "\n"),
                             text("no coupling with direction ", i + 1, ", which is rigid"));
    }
    const Vec6 d = unit_scales(K);
    const Mat6 unit = unit_stiffness(K);
    if ((unit - unit.transpose()).cwiseAbs().maxCoeff() > 1e-6)
        throw InputError(where, "6 x 6 stiffness", text("\n", K, "\n"), "symmetric");
    const Eigen::SelfAdjointEigenSolver<Matrix> solver{Matrix(unit)};
    if (!(solver.eigenvalues()(0) > 1e-12)) {
        const Vec6 direction = d.asDiagonal() * solver.eigenvectors().col(0);
        throw InputError(where, "smallest eigenvalue of the 6 x 6 stiffness (scaled to unit diagonal)",
                         text(solver.eigenvalues()(0), " (strains ", (direction / direction.norm()).transpose(), ")"),
                         "> 0 (positive definite)");
    }
}

void check_mass(const Mat6& M, const std::string& where) {
    if (!M.allFinite()) throw InputError(where, "6 x 6 mass", text("\n", M, "\n"), "finite");
    const double scale = M.cwiseAbs().maxCoeff();
    if ((M - M.transpose()).cwiseAbs().maxCoeff() > 1e-6 * scale)
        throw InputError(where, "6 x 6 mass", text("\n", M, "\n"), "symmetric");
    const double mass = M(0, 0);
    if (!(mass >= 0)) throw InputError(where, "mass per length [kg/m]", mass, ">= 0");
    if (mass == 0 && scale > 0) throw InputError(where, "mass per length [kg/m]", mass, "> 0 with inertias or moments");
    const Mat3 linear = M.topLeftCorner<3, 3>() - mass * Mat3::Identity();
    const Mat3 offset = M.topRightCorner<3, 3>();
    if (linear.cwiseAbs().maxCoeff() > 1e-6 * std::max(mass, 1e-12 * scale))
        throw InputError(where, "6 x 6 mass, upper left block", text("\n", M.topLeftCorner<3, 3>(), "\n"),
                         "mass per length times the identity");
    // 1e-6 of mass times a radius of gyration: an offset that is zero comes as rounding.
    const double gyration = std::sqrt(mass * std::max(0.0, M.bottomRightCorner<3, 3>().trace()));
    if ((offset + offset.transpose()).norm() > 1e-6 * gyration + 1e-12 * scale)
        throw InputError(where, "6 x 6 mass, upper right block", text("\n", offset, "\n"), "skew (a mass centre)");
    if (std::abs(M(1, 5)) > 1e-6 * scale)
        throw InputError(where, "6 x 6 mass, entry (2, 6) [kg]", M(1, 5), "0: the mass centre lies in the section");
}

// Polar inertia of a plane section: the sum of the two others. What is not larger than `rounding` is zero.
Mat3 plane_inertia(Mat3 J, double rounding, const std::string& where) {
    if (J.cwiseAbs().maxCoeff() <= rounding) return Mat3::Zero();
    const double sum = J(1, 1) + J(2, 2);
    if (std::abs(J(0, 0) - sum) > 1e-2 * std::max(std::abs(J(0, 0)), std::abs(sum)) + rounding)
        throw InputError(where, "polar inertia per length about the mass centre [kg m]", J(0, 0),
                         text(sum, ", the sum of the two others (within 1 %)"));
    if (std::hypot(J(0, 1), J(0, 2)) > 1e-2 * std::abs(sum) + rounding)
        throw InputError(where, "products of inertia with the beam axis per length [kg m]",
                         text(J(0, 1), ", ", J(0, 2)), "0 for a plane section");
    J(0, 0) = sum;
    J(0, 1) = J(1, 0) = J(0, 2) = J(2, 0) = 0;
    const double lowest = Eigen::SelfAdjointEigenSolver<Matrix>(Matrix(J.bottomRightCorner<2, 2>())).eigenvalues()(0);
    if (lowest < -1e-9 * std::abs(sum) - rounding)
        throw InputError(where, "smallest eigenvalue of the inertia per length about the mass centre [kg m]", lowest,
                         ">= 0");
    return J;
}

}  // namespace

SectionMatrices interpolated(const std::vector<SectionMatrices>& matrices, const StationPlace& place) {
    const SectionMatrices &a = matrices[place.left], &b = matrices[place.right];
    const double t = place.t;
    SectionMatrices out{(1 - t) * finite_part(a.stiffness) + t * finite_part(b.stiffness),
                        (1 - t) * a.mass + t * b.mass};
    for (Eigen::Index i = 0; i < 6; ++i)
        if (std::isinf(a.stiffness(i, i)) || std::isinf(b.stiffness(i, i)))
            out.stiffness(i, i) = std::numeric_limits<double>::infinity();
    return out;
}

Mat3 vabs_axes() {
    return Mat3::Identity();
}
Mat3 beamdyn_axes() {
    return (Mat3() << Vec3::UnitZ(), -Vec3::UnitY(), Vec3::UnitX()).finished();
}
Mat3 hawc2_axes() {
    return (Mat3() << Vec3::UnitY(), Vec3::UnitZ(), Vec3::UnitX()).finished();
}

namespace {

// X K X^T. A rigid direction stays one: it has to be an axis before and after.
Mat6 congruent(const Mat6& X, const Mat6& K, const char* what) {
    Mat6 out = X * finite_part(K, 0) * X.transpose();
    for (Eigen::Index i = 0; i < 6; ++i) {
        if (!std::isinf(K(i, i))) continue;
        Eigen::Index axis = 0;
        if (X.col(i).cwiseAbs().maxCoeff(&axis) != 1 || X.col(i).cwiseAbs().sum() != 1 ||
            X.row(axis).cwiseAbs().sum() != 1)
            throw InputError("section matrices", what, text("\n", X.topLeftCorner<3, 3>(), "\n"),
                             text("axes to axes: direction ", i + 1, " is rigid"));
        out(axis, axis) = std::numeric_limits<double>::infinity();
    }
    return out;
}

}  // namespace

SectionMatrices rotated(const SectionMatrices& section, const Mat3& R) {
    const Mat6 X = both(R);
    return {congruent(X, section.stiffness, "rotation"), X * section.mass * X.transpose()};
}

SectionMatrices moved(const SectionMatrices& section, const Vec3& to) {
    const Mat6 X = to_point(to);
    return {congruent(X, section.stiffness, "displacement"), X * section.mass * X.transpose()};
}

BeamSection turned(const BeamSection& section, double beta) {
    const Mat3 R = rot_x(beta);
    const Mat6 X = both(R);
    BeamSection out = section;
    out.compliance = X * section.compliance * X.transpose();
    out.compliance = Mat6((out.compliance + out.compliance.transpose()) / 2);
    out.centre = R * section.centre;
    out.J = R * section.J * R.transpose();
    out.beta = section.beta + beta;
    return out;
}

BeamSection beam_section(const SectionMatrices& section, const std::string& where) {
    check_stiffness(section.stiffness, where);
    check_mass(section.mass, where);
    BeamSection s;
    const Mat6 K = (section.stiffness + section.stiffness.transpose()) / 2;
    const Vec6 d = unit_scales(K);
    const Mat6 unit = unit_stiffness(K);
    const Mat6 inverse = Matrix(unit).llt().solve(Matrix::Identity(6, 6));
    s.compliance = d.asDiagonal() * Mat6((inverse + inverse.transpose()) / 2) * d.asDiagonal();
    const Mat6& M = section.mass;
    s.mass = M(0, 0);
    // p = m (v + omega x c): the upper right block is -m c~.
    if (s.mass > 0) s.centre = Vec3(M(1, 5) - M(2, 4), M(2, 3) - M(0, 5), M(0, 4) - M(1, 3)) / (2 * s.mass);
    const Mat3 c = skew<double>(s.centre);
    // The inertia about the centre is a difference; a radius of gyration below 1e-7 m is none.
    const Mat3 about_reference = M.bottomRightCorner<3, 3>();
    s.J = plane_inertia(about_reference + s.mass * c * c, 1e-12 * about_reference.norm() + 1e-14 * s.mass, where);
    return s;
}

SectionMatrices section_matrices(const BeamSection& section) {
    const auto is_rigid = [&](Eigen::Index i) { return section.compliance(i, i) == 0; };
    Vec6 d;
    for (Eigen::Index i = 0; i < 6; ++i) d(i) = unit_scale(section.compliance(i, i));
    Mat6 unit = d.asDiagonal() * section.compliance * d.asDiagonal();
    unit.diagonal().setOnes();
    const Eigen::SelfAdjointEigenSolver<Matrix> solver{Matrix(unit)};
    if (!(solver.eigenvalues()(0) > 1e-13))
        throw InputError("section matrices", "smallest eigenvalue of the compliance (scaled)", solver.eigenvalues()(0),
                         "> 0: a rigid direction that is not an axis has no stiffness matrix");
    SectionMatrices m;
    m.stiffness = d.asDiagonal() * Mat6(Matrix(unit).partialPivLu().inverse()) * d.asDiagonal();
    m.stiffness = Mat6((m.stiffness + m.stiffness.transpose()) / 2);
    for (Eigen::Index i = 0; i < 6; ++i)
        if (is_rigid(i)) m.stiffness(i, i) = std::numeric_limits<double>::infinity();
    const Mat3 c = skew<double>(section.centre);
    m.mass.topLeftCorner<3, 3>() = section.mass * Mat3::Identity();
    m.mass.topRightCorner<3, 3>() = -section.mass * c;
    m.mass.bottomLeftCorner<3, 3>() = section.mass * c;
    m.mass.bottomRightCorner<3, 3>() = section.J - section.mass * c * c;
    return m;
}

namespace {

double inverse_of(double flexibility, double scale) {
    return flexibility > 1e-14 * scale ? 1 / flexibility : std::numeric_limits<double>::infinity();
}

double largest_difference(const BeamSection& a, const BeamSection& b) {
    double largest = 0;
    const Vec6 d = b.compliance.diagonal().cwiseSqrt();
    for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = 0; j < 6; ++j)
            if (d(i) > 0 && d(j) > 0)
                largest = std::max(largest, std::abs(a.compliance(i, j) - b.compliance(i, j)) / (d(i) * d(j)));
    const double inertia = b.J.cwiseAbs().maxCoeff();
    return inertia > 0 ? std::max(largest, (a.J - b.J).cwiseAbs().maxCoeff() / inertia) : largest;
}

}  // namespace

EngineeringForm engineering_form(const BeamSection& section) {
    const Mat6& S = section.compliance;
    EngineeringSection e;
    e.mass = section.mass;
    // Principal axes of bending: S_kk in axes turned by beta is diagonal.
    const Eigen::Matrix2d S_kk = S.block<2, 2>(4, 4);
    const double sine = 2 * S_kk(0, 1), cosine = S_kk(0, 0) - S_kk(1, 1), bending = S_kk.trace();
    const bool alike = std::hypot(sine, cosine) <= 1e-12 * bending;  // any axes will do: the section's own
    e.beta = std::remainder(alike ? section.beta : std::atan2(sine, cosine) / 2, pi / 2);
    const Mat6 X = both(rot_x(e.beta).transpose());
    const Mat6 P = X * S * X.transpose();
    e.EI_flap = inverse_of(P(4, 4), bending);
    e.EI_edge = inverse_of(P(5, 5), bending);
    // A force N at the tension centre leaves no curvature: (My, Mz) = (cz, -cy) N. Rigid in bending: no such centre.
    if (std::isfinite(e.EI_flap)) e.tension_centre.z = -P(4, 0) / P(4, 4);
    if (std::isfinite(e.EI_edge)) e.tension_centre.y = P(5, 0) / P(5, 5);
    e.EA = inverse_of(P(0, 0) + P(0, 4) * e.tension_centre.z - P(0, 5) * e.tension_centre.y, P(0, 0));
    // Shear at the shear centre leaves no twist: T = ey Vz - ez Vy.
    e.GJ = inverse_of(P(3, 3), 1 / std::numeric_limits<double>::max());
    if (P(3, 3) > 0) e.shear_centre = {-P(3, 2) / P(3, 3), P(3, 1) / P(3, 3)};
    const Eigen::Matrix2d shear =
        P.block<2, 2>(1, 1) -
        (P(3, 3) > 0 ? Eigen::Matrix2d(P.block<2, 1>(1, 3) * P.block<1, 2>(3, 1) / P(3, 3)) : Eigen::Matrix2d::Zero());
    e.GA_y = inverse_of(shear(0, 0), P(1, 1));
    e.GA_z = inverse_of(shear(1, 1), P(2, 2));
    const Vec3 centre = X.topLeftCorner<3, 3>() * section.centre;
    e.mass_centre = {centre(1), centre(2)};
    const Mat3 J = X.topLeftCorner<3, 3>() * section.J * X.topLeftCorner<3, 3>().transpose();
    e.j_flap = J(1, 1);
    e.j_edge = J(2, 2);
    return {e, largest_difference(e.section(), section)};
}

}  // namespace cardan
