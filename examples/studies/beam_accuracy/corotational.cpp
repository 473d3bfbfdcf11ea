#include "examples/studies/beam_accuracy/corotational.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"

#include <cmath>

namespace cardan::accuracy {

namespace {

constexpr double stiff = 1e9;  // EA over EI / L^2: stands for inextensible

struct Element {
    Vec6 force;  ///< of (x, z, angle) of both ends
    Mat6 tangent;
};

// Angles count from x to z.
Element element(double L, double EI, double EA, const Vec3& first, const Vec3& second) {
    const double dx = L + second(0) - first(0), dz = second(1) - first(1), l = std::hypot(dx, dz);
    const double c = dx / l, s = dz / l, chord = std::atan2(dz, dx);
    const auto local = [&](double angle) { return std::remainder(angle - chord, 2 * pi); };
    const double a = local(first(2)), b = local(second(2));
    const double N = EA * ((l - L) / L + (2 * a * a - a * b + 2 * b * b) / 30);
    const Vec3 dN(1 / L, (4 * a - b) / 30, (4 * b - a) / 30);  // of N / EA by l, a, b
    const Vec3 f = N * L * dN + EI / L * Vec3(0, 4 * a + 2 * b, 2 * a + 4 * b);
    Mat3 k = EA * L * dN * dN.transpose();
    k.bottomRightCorner<2, 2>() += N * L / 30 * (Eigen::Matrix2d() << 4, -1, -1, 4).finished() +
                                   EI / L * (Eigen::Matrix2d() << 4, 2, 2, 4).finished();
    Vec6 r, z;  // changes of l and, over l, of the chord's direction
    r << -c, -s, 0, c, s, 0;
    z << s, -c, 0, -s, c, 0;
    Eigen::Matrix<double, 3, 6> B;
    B.row(0) = r.transpose();
    B.row(1) = B.row(2) = -z.transpose() / l;
    B(1, 2) += 1, B(2, 5) += 1;
    return {B.transpose() * f, B.transpose() * k * B + f(0) / l * z * z.transpose() +
                                   (f(1) + f(2)) / (l * l) * (r * z.transpose() + z * r.transpose())};
}

}  // namespace

Vec3 corotational_tip(const BeamLine& line, int elements, const Vec3& force, const Vec3& moment) {
    const double L = line.length / elements, EI = 1 / line.section(0).compliance(4, 4);
    const Eigen::Index n = 3 * Eigen::Index{elements};
    Vector q = Vector::Zero(n);
    constexpr int steps = 10;
    for (int step = 1; step <= steps; ++step) {
        double change = 1;
        for (int i = 0; i < 40 && change > 1e-11; ++i) {
            Vector R = Vector::Zero(n);
            Matrix K = Matrix::Zero(n, n);
            R.tail<3>() = Vec3(force.x(), force.z(), -moment.y()) * step / steps;
            for (Eigen::Index e = 0; e < elements; ++e) {
                const Vec3 first = e > 0 ? Vec3(q.segment<3>(3 * e - 3)) : Vec3(Vec3::Zero());
                const Element part =
                    element(L, EI, stiff * EI / (line.length * line.length), first, q.segment<3>(3 * e));
                R.segment<3>(3 * e) -= part.force.tail<3>();
                if (e == 0) {
                    K.topLeftCorner<3, 3>() += part.tangent.bottomRightCorner<3, 3>();
                } else {
                    R.segment<3>(3 * e - 3) -= part.force.head<3>();
                    K.block<6, 6>(3 * e - 3, 3 * e - 3) += part.tangent;
                }
            }
            Vector dq = K.partialPivLu().solve(R);
            change = dq.cwiseAbs().maxCoeff();
            if (change > 0.3) dq *= 0.3 / change;  // of a radian or of the length: far from the solution
            q += dq;
        }
        if (change > 1e-8) throw NumericalError("corotational beam: Newton's method does not converge");
    }
    return {line.length + q(n - 3), 0, q(n - 2)};
}

}  // namespace cardan::accuracy
