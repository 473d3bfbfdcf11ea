#include "elements/cardan_beam/detail/tilted_masses.hpp"

#include "elements/cardan_beam/joint_stiffness.hpp"
#include "mbs/base/decompositions.hpp"

namespace cardan {

namespace {

// Bending compliance in the directions of deflection, w_y'' = kappa_z and w_z'' = -kappa_y.
Eigen::Matrix2d bending(const Mat6& S) {
    return (Eigen::Matrix2d() << S(5, 5), -S(5, 4), -S(4, 5), S(4, 4)).finished();
}

// Second moments across the axis, about the axis: of the mass at its centre, and of the whole body.
Eigen::Matrix2d of_centre(const RigidInertia& body) {
    return body.mass * body.com.tail<2>() * body.com.tail<2>().transpose();
}
Eigen::Matrix2d across(const RigidInertia& body) {
    return binet_tensor<double>(body.J).bottomRightCorner<2, 2>() + of_centre(body);
}

// An end body and the one beside it when the end has taken over a first moment across the axis.
struct Pair {
    RigidInertia end, between;

    Pair moved(const Eigen::Vector2d& moment) const {
        Pair p = *this;
        p.between.com.tail<2>() -= moment / between.mass;
        p.end.com.tail<2>() += moment / end.mass;
        Mat3 P = binet_tensor<double>(end.J);
        P.bottomRightCorner<2, 2>() = across(end) + across(between) - across(p.between) - of_centre(p.end);
        p.end.J = ordinary_tensor<double>(P);
        return p;
    }
    // True if the end body is physically possible: Binet's tensor is positive semi-definite.
    bool is_possible() const {
        const Mat3 P = binet_tensor<double>(end.J);
        return P(1, 1) >= 0 && P(2, 2) >= 0 && P.bottomRightCorner<2, 2>().determinant() >= 0 && P.determinant() >= 0;
    }
};

// Returns the share of the moment that could be moved.
double move(RigidInertia& end, RigidInertia& between, const Eigen::Vector2d& moment) {
    if (!(end.mass > 0) || moment.isZero(0)) return 1;
    const Pair before{end, between};
    double share = 1;
    if (!before.moved(moment).is_possible()) {
        double impossible = 1;
        share = 0;
        for (int i = 0; i < 40; ++i) {
            const double middle = (share + impossible) / 2;
            (before.moved(middle * moment).is_possible() ? share : impossible) = middle;
        }
    }
    const Pair after = before.moved(share * moment);
    end = after.end, between = after.between;
    return share;
}

}  // namespace

Eigen::Matrix2d shear_fraction(const ElementLine& on, const Hinges& hinges) {
    if (!is_flexible_in_shear(on)) return Eigen::Matrix2d::Zero();
    // Opposite moments m and -m at the hinges bend by M = m (x1 + x2 - 2 x) / d and shear by V = 2 m / d.
    const double d = hinges.second - hinges.first, sum = hinges.first + hinges.second, arc = on.end() - on.start();
    using Both = Eigen::Matrix<double, 2, 4>;
    const Both turn = on.integral(0, 1, Both(Both::Zero()), [&](double s) {
        const Mat6 S = on.line().section(s).compliance;
        const double M = (sum - 2 * (s - on.start()) / arc) / d, V = 2 / (d * arc);
        return Both((Both() << V * V * shear_at_zero_twist(S), M * M * bending(S)).finished());
    });
    const Eigen::Matrix2d sheared = turn.leftCols<2>(), all = sheared + turn.rightCols<2>();
    const double trace = all.trace();
    // Rigid in one direction, the other alone counts.
    if (!(all.determinant() > 1e-12 * trace * trace)) return sheared / trace;
    return sheared * all.inverse();
}

double shift_tilted_masses(const ElementLine& on, ElementInertia& element) {
    const Eigen::Matrix2d share = shear_fraction(on, element.hinges).transpose();
    if (share.isZero(0)) return 0;
    std::array<RigidInertia, 4>& B = element.body;
    const auto moment = [&](const RigidInertia& body) {
        return Eigen::Vector2d(share * body.com.tail<2>() * body.mass);
    };
    const double moved = std::min(move(B[0], B[1], moment(B[1])), move(B[3], B[2], moment(B[2])));
    return (1 - moved) * std::min(1.0, share.norm());
}

}  // namespace cardan
