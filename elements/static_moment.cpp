#include "elements/static_moment.hpp"

#include "mbs/decompositions.hpp"
#include "mbs/error.hpp"

namespace cardan {

namespace {

std::string where(const ElementLine& on) {
    return text(on.line().name, ", element at ", on.start(), " m");
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

}  // namespace

void move_to_static_moment(const ElementLine& on, double delta, ElementInertia& element) {
    for (std::size_t k = 0; k < 4; ++k)
        if (!(element.body[k].mass > 0))
            throw InputError(where(on), text("mass of segment ", k + 1, " [kg]"), element.body[k].mass,
                             "> 0 with the static-moment partition");
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
    if (own < 0)  // so it is if D < 0
        throw InputError(where(on), "moment of inertia left for the middle bodies [kg m^2]", own,
                         ">= 0: the element is too tapered for static moments; take another partition, or end an "
                         "element where the stiffness begins to fall");
    for (int k : {1, 2}) {
        RigidInertia& body = b[static_cast<std::size_t>(k)];
        body.J = slender(own * body.mass / mb);
    }
    const double limit = 0.1 * L, x1 = delta * L, x2 = (1 - delta) * L;
    if (std::abs(s.X1 - x1) > limit || std::abs(s.X4 - x2) > limit)
        element.warning = text(where(on),
                               ": the static-moment partition puts the terminal "
                               "centres of mass at ",
                               s.X1, " and ", s.X4, " m, more than 0.1 L from the hinges at ", x1, " and ", x2,
                               " m (element length L = ", L,
                               " m): frequencies of this beam are unreliable; use segment masses or more elements");
}

}  // namespace cardan
