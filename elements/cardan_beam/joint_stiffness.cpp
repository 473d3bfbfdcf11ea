#include "elements/cardan_beam/joint_stiffness.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

namespace cardan {

Mat6 section_forces_by_joint_forces(double x, double L, const Hinges& hinges) {
    const double x1 = hinges.first * L, x2 = hinges.second * L, d = x2 - x1;
    const double N1 = (x2 - x) / d, N2 = (x - x1) / d;
    Mat6 H = Mat6::Zero();
    H(0, 0) = 1;                        // N
    H(1, 4) = 1 / d, H(1, 5) = -1 / d;  // Vy = (pz1 - pz2) / d
    H(2, 2) = -1 / d, H(2, 3) = 1 / d;  // Vz = (py2 - py1) / d
    H(3, 1) = 1;                        // T
    H(4, 2) = N1, H(4, 3) = N2;         // My
    H(5, 4) = N1, H(5, 5) = N2;         // Mz
    return H;
}

Mat6 joint_flexibility(const BeamLine& line, double x0, double L, double delta) {
    return joint_flexibility(ElementLine(line, x0, x0 + L), Hinges::symmetric(delta));
}

namespace {

// Section forces at the pose (in element axes) from those at the chord point below it, in element axes.
Mat6 to_section(const Placement& pose) {
    Mat6 X = Mat6::Zero();
    const Mat3 R = pose.R.transpose();
    X.topLeftCorner<3, 3>() = X.bottomRightCorner<3, 3>() = R;
    X.bottomLeftCorner<3, 3>() = -R * skew<double>(Vec3(0, pose.p(1), pose.p(2)));
    return X;
}

}  // namespace

Vec3 shear_centre(const ElementLine& element) {
    // kappa_x = S_TT (T + e_z Vy - e_y Vz)
    const Vec3 twist = element.integral(0, 1, Vec3(Vec3::Zero()), [&](double s) {
        const Mat6 S = element.line().section(s).compliance;
        const Mat3 R = element.pose(s).R;
        return Vec3((R * Vec3(S(3, 0), S(3, 1), S(3, 2))).cwiseProduct(Vec3(0, 1, 1)) + S(3, 3) * Vec3::UnitX());
    });
    if (!(twist(0) > 0)) return Vec3::Zero();
    const Vec3 centre(0, -twist(2) / twist(0), twist(1) / twist(0));
    return centre.norm() > 1e-12 * element.chord() ? centre : Vec3::Zero();  // rounding is no offset
}

namespace {

// Integral over the element of f(strains of the hinge line by joint forces, section forces by joint forces at the hinge
// line), both 6 x 6.
template <class T, class F>
T over_sections(const ElementLine& element, const Hinges& hinges, CurvedFlexibility rule, const T& zero, const F& f) {
    const double L = element.chord(), straight = L / (element.end() - element.start());
    const bool on_chord = rule == CurvedFlexibility::chord;
    const T sum = element.integral(0, 1, zero, [&](double s) {
        const Placement at =
            on_chord ? Placement::translation(Vec3((s - element.start()) * straight, 0, 0) - element.hinge_line())
                     : element.pose(s);
        const Mat6 X = to_section(at), H = section_forces_by_joint_forces(at.p(0), L, hinges);
        return f(Mat6(X.transpose() * element.line().section(s).compliance * X * H), H);
    });
    return on_chord ? T(sum * straight) : sum;
}

}  // namespace

Mat6 joint_flexibility(const ElementLine& element, const Hinges& hinges, CurvedFlexibility rule) {
    return over_sections(element, hinges, rule, Mat6(Mat6::Zero()),
                         [](const Mat6& strain, const Mat6& H) { return Mat6(H.transpose() * strain); });
}

Eigen::Matrix2d shear_at_zero_twist(const Mat6& compliance) {
    const Eigen::Matrix2d all = compliance.block<2, 2>(1, 1);
    const Eigen::Vector2d by_twist = compliance.block<2, 1>(1, 3);
    const double twist = compliance(3, 3);
    return twist > 0 ? Eigen::Matrix2d(all - by_twist * by_twist.transpose() / twist) : all;
}

bool is_flexible_in_shear(const ElementLine& element) {
    const Eigen::Vector2d shear = element.integral(0, 1, Eigen::Vector2d(Eigen::Vector2d::Zero()), [&](double s) {
        const Mat6 S = element.line().section(s).compliance;
        return Eigen::Vector2d(S(1, 1) + S(2, 2), shear_at_zero_twist(S).trace());
    });
    return shear(1) > 1e-9 * shear(0);
}

Eigen::Matrix<double, 2, 6> shear_rotation(const ElementLine& element, const Hinges& hinges, CurvedFlexibility rule) {
    using Rows = Eigen::Matrix<double, 2, 6>;
    const double d = (hinges.second - hinges.first) * element.chord();
    return over_sections(element, hinges, rule, Rows(Rows::Zero()),
                         [d](const Mat6& strain, const Mat6&) { return Rows(strain.middleRows<2>(1) / d); });
}

namespace {

// A coordinate without flexibility, and what to do about it.
void refuse_rigid(const Mat6& flexibility, ElementCoordinate kind, const std::string& where) {
    const auto i = static_cast<Eigen::Index>(kind);
    if (flexibility(i, i) > 0) return;
    constexpr std::array<const char*, 6> name{"extension (u)",    "torsion (phi)",    "bending y1 (ay1)",
                                              "bending y2 (ay2)", "bending z1 (az1)", "bending z2 (az2)"};
    constexpr std::array<const char*, 3> remedy{
        "> 0: a rigid direction must be locked, with `extension = false` in the options of the beam, or EA given",
        "> 0: a rigid direction must be locked, with `torsion = false` in the options of the beam, or GJ given",
        "> 0: bending cannot be locked, EI must be finite"};
    throw InputError(where, text("flexibility of ", entry(name, kind)), flexibility(i, i),
                     entry(remedy, std::min<Eigen::Index>(i, 2)));
}

}  // namespace

Matrix joint_stiffness(const Mat6& flexibility, const std::vector<ElementCoordinate>& coordinates,
                       const std::string& where) {
    const auto n = std::ssize(coordinates);
    const auto at = [&](Eigen::Index i) { return static_cast<Eigen::Index>(entry(coordinates, i)); };
    Matrix f(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j) f(i, j) = flexibility(at(i), at(j));
    for (ElementCoordinate kind : coordinates) refuse_rigid(flexibility, kind, where);
    // Scaled to unit diagonal: metres and radians differ by decades.
    const Vector scale = f.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::LLT<Matrix> cholesky(Matrix(scale.asDiagonal() * f * scale.asDiagonal()));
    if (cholesky.info() != Eigen::Success)
        throw InputError(where, "flexibility of the free joint coordinates (diagonal)", f.diagonal().transpose(),
                         "positive definite: the section's compliance is indefinite or singular");
    Matrix K = scale.asDiagonal() * cholesky.solve(Matrix(scale.asDiagonal()));
    return (K + K.transpose()) / 2;
}

SpringConstants spring_constants(double EI, double GA, double GJ, double EA, double L, double delta) {
    const double lambda = GA * L * L / EI;
    // Euler-Bernoulli limit lambda -> infinity of eq. (15) and (16).
    const double c21 = std::isinf(lambda) ? 6 * (1 - 2 * delta) * (1 - 2 * delta) * EI / L
                                          : 6 * (1 - 2 * delta) * (1 - 2 * delta) / (12 + lambda) * GA * L;
    const double c22 = std::isinf(lambda)
                           ? (12 * (delta - delta * delta) - 2) * EI / L
                           : (12 * (lambda * delta - lambda * delta * delta + 1) - 2 * lambda) / (12 + lambda) * EI / L;
    return {c21, c22, c21, GJ / L, EA / L};
}

}  // namespace cardan
