#include "elements/cardan_beam/detail/static_moment.hpp"

#include "elements/cardan_beam/detail/static_shapes.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

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

StaticMoment static_moment(const ElementLine& on, double delta, const std::array<double, 4>& m) {
    const PlanarElement plane(on, PlaneMean::arithmetic);
    const double L = plane.length(), x1 = delta * L, x2 = (1 - delta) * L;
    const StaticShapes shapes = static_shapes(plane, {x1, x2});
    // First moments of B4 and B1 about their hinges.
    const double last = plane.integral(plane.mass() * shapes.last), first = plane.integral(plane.mass() * shapes.first);
    const Vec3 moments = plane.mass_moments(0, L);
    const double M = moments(0), S1 = moments(1), I = moments(2), m1 = m[0], mb = m[1] + m[2], m4 = m[3];
    StaticMoment r{};
    r.X4 = x2 + last / m4;
    r.X1 = x1 - first / m1;
    r.Xb = x1 + (first + S1 - M * x1 - m4 * (r.X4 - x1)) / mb;
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
    StaticMoment s = static_moment(on, delta, {b[0].mass, b[1].mass, b[2].mass, b[3].mass});
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
        RigidInertia& body = entry(b, k);
        body.com(0) += shift;
        own -= body.mass * std::pow(body.com(0) - s.Xb, 2);
    }
    if (own < 0)  // so it is if D < 0
        throw InputError(where(on), "moment of inertia left for the middle bodies [kg m^2]", own,
                         std::abs(delta - recommended_delta(Partition::static_moment)) < 1e-4
                             ? text(">= 0: the element is too tapered for static moments; take another partition, or "
                                    "end an element where the stiffness begins to fall")
                             : text(">= 0: delta = ", delta, " leaves them none; static moments are made for 1/6, ",
                                    "which they take if delta is left out"));
    for (int k : {1, 2}) {
        RigidInertia& body = entry(b, k);
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
