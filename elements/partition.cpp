#include "elements/partition.hpp"

#include "mbs/error.hpp"

#include <Eigen/LU>

namespace cardan {

namespace {

// Mass, first moment and second moments (Binet tensor about the origin of the element) of a line of point masses.
using Moments = Eigen::Matrix<double, 4, 4>;  // int mu (1, r)(1, r)^T dx

RigidInertia line_mass(const ElementLine& element, double from, double to) {
    const Moments m = element.integral(from, to, Moments(Moments::Zero()), [&](double x) {
        const BeamSection s = element.line().section(x);
        Eigen::Vector4d r;
        r << 1.0, element.pose(x) * s.centre;
        return Moments(s.mass * r * r.transpose());
    });
    RigidInertia body;
    body.mass = m(0, 0);
    if (!(body.mass > 0)) return body;
    body.com = m.block<3, 1>(1, 0) / body.mass;
    const Mat3 P = m.bottomRightCorner<3, 3>() - body.mass * body.com * body.com.transpose();
    body.J = ordinary_tensor<double>((P + P.transpose()) / 2);
    return body;
}

Mat3 rotary_inertia(const ElementLine& element, double from, double to) {
    return element.integral(from, to, Mat3(Mat3::Zero()), [&](double x) {
        const Mat3 R = element.pose(x).R;
        return Mat3(R * element.line().section(x).J * R.transpose());
    });
}

// Axial centres and slender inertias of the static-moment partition, one bending plane with the mean compliance of
// both.
struct StaticMoment {
    double X1, Xb, X4, D;
};

StaticMoment static_moment(const BeamLine& line, double x0, double L, double delta, const std::array<double, 4>& m) {
    const double x1 = delta * L, x2 = (1 - delta) * L, d = x2 - x1;
    const auto N = [&](int j, double s) { return j == 0 ? (x2 - s) / d : (s - x1) / d; };
    const auto sigma = [](int j) { return j == 0 ? 1.0 : -1.0; };
    const auto bending = [](const BeamSection& s) { return (s.compliance(4, 4) + s.compliance(5, 5)) / 2; };
    const auto shear = [](const BeamSection& s) { return (s.compliance(1, 1) + s.compliance(2, 2)) / 2; };

    // f_ij and int mu psi_j dx, psi_j(x) = int_0^x (x - s) N_j / EI ds + sigma_j / d int_0^x ds / GA.
    Eigen::Matrix2d f = Eigen::Matrix2d::Zero();
    Eigen::Vector2d mass_psi = Eigen::Vector2d::Zero();
    using Pair = Eigen::Matrix<double, 2, 3>;
    const Pair sums = integrate(x0, x0 + L, line.breaks, Pair(Pair::Zero()), [&](double x) {
        const BeamSection section = line.section(x);
        const double s = x - x0, EI_inverse = bending(section), GA_inverse = shear(section);
        // Mass outboard of s and its first moment about s.
        const Eigen::Vector2d outboard =
            integrate(x, x0 + L, line.breaks, Eigen::Vector2d(Eigen::Vector2d::Zero()), [&](double y) {
                const double mu = line.section(y).mass;
                return Eigen::Vector2d(mu, mu * (y - x));
            });
        Pair p;
        for (int i = 0; i < 2; ++i) {
            for (int j = 0; j < 2; ++j)
                p(i, j) = N(i, s) * N(j, s) * EI_inverse + sigma(i) * sigma(j) / (d * d) * GA_inverse;
            p(i, 2) = N(i, s) * EI_inverse * outboard(1) + sigma(i) / d * GA_inverse * outboard(0);
        }
        return p;
    });
    f = sums.leftCols<2>();
    mass_psi = sums.col(2);
    const Eigen::Vector2d P = f.inverse() * mass_psi;  // linear momentum of each hinge's static shape

    const Eigen::Vector3d moments =
        integrate(x0, x0 + L, line.breaks, Eigen::Vector3d(Eigen::Vector3d::Zero()), [&](double x) {
            const double mu = line.section(x).mass, s = x - x0;
            return Eigen::Vector3d(mu, mu * s, mu * s * s);
        });
    const double M = moments(0), S1 = moments(1), I = moments(2), m1 = m[0], mb = m[1] + m[2], m4 = m[3];
    StaticMoment r{};
    r.X4 = x2 + P(1) / m4;
    r.X1 = x1 + (S1 - M * x1 - P(0)) / m1;
    r.Xb = x1 + (P(0) - m4 * (r.X4 - x1)) / mb;
    r.D = I - m1 * r.X1 * r.X1 - mb * r.Xb * r.Xb - m4 * r.X4 * r.X4;
    return r;
}

void move_to_static_moment(const ElementLine& on, double delta, ElementInertia& element) {
    auto& b = element.body;
    const double L = on.chord(), arc = on.end() - on.start(), straight = L / arc;
    StaticMoment s = static_moment(on.line(), on.start(), arc, delta, {b[0].mass, b[1].mass, b[2].mass, b[3].mass});
    for (double* x : {&s.X1, &s.Xb, &s.X4}) *x *= straight;
    s.D *= straight * straight;
    const auto slender = [](double J) { return Mat3(Vec3(0, J, J).asDiagonal()); };
    b[0].com(0) = s.X1;
    b[3].com(0) = s.X4;
    b[0].J = b[3].J = slender(0.18 * s.D);
    // B2 and B3 keep their distance; together they have centre Xb and inertia 0.64 D.
    const double mb = b[1].mass + b[2].mass;
    const double shift = s.Xb - (b[1].mass * b[1].com(0) + b[2].mass * b[2].com(0)) / mb;
    double own = 0.64 * s.D;
    for (int k : {1, 2}) {
        RigidInertia& body = b[static_cast<std::size_t>(k)];
        body.com(0) += shift;
        own -= body.mass * std::pow(body.com(0) - s.Xb, 2);
    }
    for (int k : {1, 2}) {
        RigidInertia& body = b[static_cast<std::size_t>(k)];
        body.J = slender(own * body.mass / mb);
    }
    const double limit = 0.1 * L, x1 = delta * L, x2 = (1 - delta) * L;
    if (std::abs(s.X1 - x1) > limit || std::abs(s.X4 - x2) > limit || s.D <= 0 || own <= 0)
        element.warning = text(on.line().name, ", element at ", on.start(),
                               " m: the static-moment partition puts the terminal "
                               "centres of mass at ",
                               s.X1, " and ", s.X4, " m, more than 0.1 L from the hinges at ", x1, " and ", x2,
                               " m (element length L = ", L,
                               " m): frequencies of this beam are unreliable; use segment masses or more elements");
}

}  // namespace

ElementInertia partition_element(const BeamLine& line, double x0, double L, double delta, Partition partition) {
    return partition_element(ElementLine(line, x0, x0 + L), delta, partition);
}

ElementInertia partition_element(const ElementLine& on, double delta, Partition partition) {
    const std::array<double, 5> ends{0, delta, 0.5, 1 - delta, 1};
    ElementInertia element;
    element.hinges = Hinges::symmetric(delta);
    for (std::size_t k = 0; k < 4; ++k) {
        element.body[k] = line_mass(on, ends[k], ends[k + 1]);
        element.mass += element.body[k].mass;
        element.polar_inertia +=
            element.body[k].J(0, 0) + element.body[k].mass * element.body[k].com.tail<2>().squaredNorm();
    }
    if (partition == Partition::static_moment && element.mass > 0) {
        for (std::size_t k = 0; k < 4; ++k)
            if (!(element.body[k].mass > 0))
                throw InputError(text(on.line().name, ", element at ", on.start(), " m"),
                                 text("mass of segment ", k + 1, " [kg]"), element.body[k].mass,
                                 "> 0 with the static-moment partition");
        move_to_static_moment(on, delta, element);
    }
    const Mat3 left = rotary_inertia(on, 0, 0.5), right = rotary_inertia(on, 0.5, 1);
    element.body[0].J += left;
    element.body[3].J += right;
    element.polar_inertia += left(0, 0) + right(0, 0);
    return element;
}

}  // namespace cardan
