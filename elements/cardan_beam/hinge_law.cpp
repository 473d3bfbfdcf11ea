#include "elements/cardan_beam/hinge_law.hpp"

#include "mbs/base/dual.hpp"
#include "mbs/base/entry.hpp"

#include <algorithm>

namespace cardan {

namespace {

// A function of the element's coordinates (u, phi, ay1, ay2, az1, az2) with its first and second derivatives.
using Jet = Dual<6, 2>;

// Theta / sin Theta as a function of c = cos Theta; with w = 1 - c it is the sum of n! / (2n + 1)!! w^n.
Jet angle_over_sine(const Jet& c) {
    const double w = 1 - c.value;
    double f = 0, df = 0, ddf = 0;
    if (w < 0.02) {
        double coefficient = 1;
        for (int n = 0; n < 12; ++n) {
            if (n > 0) coefficient *= n / (2.0 * n + 1);
            f += coefficient * std::pow(w, n);
            if (n > 0) df -= n * coefficient * std::pow(w, n - 1);
            if (n > 1) ddf += n * (n - 1) * coefficient * std::pow(w, n - 2);
        }
    } else {
        const double s2 = (1 - c.value) * (1 + c.value);
        f = std::acos(c.value) / std::sqrt(s2);
        df = (c.value * f - 1) / s2;
        ddf = (f + 3 * c.value * df) / s2;
    }
    return c.chain(f, df, ddf);
}

struct Bend {
    Jet y, z;
};

// Swing vector of a cardan joint with angles a about y and b about z, the z joint on the side of the middle of the
// element.
Bend swing(const Jet& a, const Jet& b) {
    const Jet f = angle_over_sine(cos(a) * cos(b));
    return {f * sin(a) * cos(b), f * sin(b)};
}

Bend turned(const Bend& bend, const Jet& angle) {
    const Jet c = cos(angle), s = sin(angle);
    return {c * bend.y + s * bend.z, c * bend.z - s * bend.y};
}

// The arguments of the springs in the order of ElementCoordinate.
std::array<Jet, 6> arguments(const HingeLaw& law, const Vec6& q) {
    using enum ElementCoordinate;
    const auto at = [&](ElementCoordinate kind) {
        const auto i = static_cast<int>(kind);
        return Jet::variable(q(i), i);
    };
    Bend first{at(ay1), at(az1)}, second{at(ay2), at(az2)};
    if (law.isotropic) {
        first = swing(first.y, first.z);
        second = swing(second.y, second.z);
    }
    if (law.section_frame) {
        // Hinges at the Gauss points see this share of the element's torsion, each from its own end.
        const Jet share = delta_gauss * at(phi);
        first = turned(first, share);
        second = turned(second, -share);
    }
    return {at(u), at(phi), first.y, second.y, first.z, second.z};
}

// Over the free coordinates of an element, at most six: no allocation while forces are evaluated.
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

struct Response {
    double energy;
    Coordinates force;  // dV/dq
    Square stiffness;   // d2V/dq2
};

// The springs by their arguments y: V = z^T K z / 2 with z of hinge_forces(), its gradient D^T p and second derivatives
// D^T K D + p . d2z/dy2, D = dz/dy and p = K z.
Response springs(const HingeLawElement& element, const Coordinates& y) {
    const Matrix& K = element.stiffness;
    const Eigen::Index n = y.size();
    const ShearTilt& tilt = element.tilt;
    if (tilt.products.empty()) {
        const Coordinates moment = K.lazyProduct(y);
        return {y.dot(moment) / 2, moment, K};
    }
    // In six dimensions whatever their number, with zeros.
    Mat6 stiffness = Mat6::Zero(), D = Mat6::Identity();
    Vec6 all = Vec6::Zero();
    stiffness.topLeftCorner(n, n) = K;
    all.head(n) = y;
    Vec6 z = all;
    for (const ShearTilt::Product& x : tilt.products) {
        const double a = x.factor * x.a.dot(all), b = x.factor * x.b.dot(all);
        z(x.spring) += a * x.b.dot(all);
        D.row(x.spring) += (a * x.b + b * x.a).transpose();
    }
    // The one term of third order, -u |psi|^2 / 2.
    const Eigen::Index u = tilt.extension;
    const Eigen::Vector2d psi = tilt.rotation * all;
    const Vec6 along = tilt.rotation.transpose() * psi;
    z(u) -= all(u) * psi.squaredNorm() / 2;
    D.row(u) -= all(u) * along.transpose();
    D(u, u) -= psi.squaredNorm() / 2;

    const Vec6 p = stiffness * z, gradient = D.transpose() * p;
    Mat6 tangent = D.transpose() * stiffness * D - p(u) * all(u) * tilt.rotation.transpose() * tilt.rotation;
    tangent.col(u) -= p(u) * along;
    tangent.row(u) -= p(u) * along.transpose();
    for (const ShearTilt::Product& x : tilt.products)
        tangent += p(x.spring) * x.factor * (x.a * x.b.transpose() + x.b * x.a.transpose());
    return {z.dot(p) / 2, gradient.head(n), tangent.topLeftCorner(n, n)};
}

Response respond(const HingeLaw& law, const HingeLawElement& element, const Coordinates& q) {
    if (law.is_linear()) return springs(element, q);
    const auto kind = [&](Eigen::Index i) { return static_cast<Eigen::Index>(entry(element.kinds, i)); };
    const auto n = q.size();
    Vec6 all = Vec6::Zero();
    for (Eigen::Index i = 0; i < n; ++i) all(kind(i)) = q(i);
    const std::array<Jet, 6> y = arguments(law, all);
    Coordinates values(n);
    Square Y(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Jet& jet = entry(y, kind(i));
        values(i) = jet.value;
        for (Eigen::Index j = 0; j < n; ++j) Y(i, j) = jet.slopes(kind(j));
    }
    const Response spring = springs(element, values);
    Response r{spring.energy, Y.transpose().lazyProduct(spring.force),
               Y.transpose().lazyProduct(Square(spring.stiffness.lazyProduct(Y)))};
    for (Eigen::Index k = 0; k < n; ++k) {
        const Jet& jet = entry(y, kind(k));
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j) r.stiffness(i, j) += spring.force(k) * jet.hessian(kind(i), kind(j));
    }
    return r;
}

}  // namespace

ShearTilt shear_tilt(const ElementLine& element, const Hinges& hinges, CurvedFlexibility rule,
                     const std::vector<ElementCoordinate>& kinds, const Matrix& stiffness, bool mirrored) {
    using enum ElementCoordinate;
    const auto place = [&](ElementCoordinate kind) -> Eigen::Index {
        return std::find(kinds.begin(), kinds.end(), kind) - kinds.begin();
    };
    const auto unit = [&](ElementCoordinate kind) { return Vec6(Vec6::Unit(place(kind))); };
    const auto is_free = [&](ElementCoordinate kind) { return place(kind) < std::ssize(kinds); };
    if (!is_free(u) || !is_flexible_in_shear(element)) return {};
    std::vector<int> free;
    free.reserve(kinds.size());
    for (ElementCoordinate kind : kinds) free.push_back(static_cast<int>(kind));

    ShearTilt tilt;
    tilt.rotation.setZero();
    tilt.rotation.leftCols(std::ssize(kinds)) = shear_rotation(element, hinges, rule)(Eigen::all, free) * stiffness;
    tilt.extension = place(u);
    const double d = (hinges.second - hinges.first) * element.chord();
    const Vec6 psi_y = tilt.rotation.row(0), psi_z = tilt.rotation.row(1);
    const auto add = [&](ElementCoordinate spring, double factor, const Vec6& a, const Vec6& b) {
        if (is_free(spring)) tilt.products.push_back({place(spring), factor, a, b});
    };
    for (const Vec6& psi : {psi_y, psi_z}) add(u, -d / 2, psi, psi);
    add(az1, 1 / d, unit(u), psi_y);
    add(az2, -1 / d, unit(u), psi_y);
    add(ay1, -1 / d, unit(u), psi_z);
    add(ay2, 1 / d, unit(u), psi_z);
    if (!mirrored || !is_free(phi)) return tilt;
    for (ElementCoordinate spring : {ay1, ay2}) add(spring, 0.5, unit(phi), psi_y);
    for (ElementCoordinate spring : {az1, az2}) add(spring, 0.5, unit(phi), psi_z);
    for (ElementCoordinate angle : {az1, az2})
        if (is_free(angle)) add(phi, -1, psi_z, unit(angle));
    return tilt;
}

Vector hinge_forces(const HingeLaw& law, const HingeLawElement& element, const Vector& q) {
    return respond(law, element, q).force;
}

ForceElement hinge_law_force(const std::string& name, const HingeLaw& law, std::vector<HingeLawElement> elements) {
    ForceElement force{.name = name, .elastic = true};
    std::vector<std::vector<int>> places;  // of the coordinates of each element among those of the force
    for (const HingeLawElement& element : elements) {
        std::vector<int>& own = places.emplace_back();
        for (const BodyId body : element.bodies) {
            const auto known = std::ranges::find(force.coordinates, body.index, &BodyId::index);
            own.push_back(static_cast<int>(known - force.coordinates.begin()));
            if (known == force.coordinates.end()) force.coordinates.push_back(body);
        }
    }
    // Calls f(places, response) for every element.
    const auto each = [law, elements = std::move(elements), places = std::move(places)](const ElementView& at,
                                                                                        const auto& f) {
        for (std::size_t k = 0; k < elements.size(); ++k) {
            Coordinates q(std::ssize(places[k]));
            for (Eigen::Index i = 0; i < q.size(); ++i) q(i) = at.q(entry(places[k], i));
            f(places[k], respond(law, elements[k], q));
        }
    };
    force.evaluate = [each](const ElementView& at, ElementForces& out) {
        each(at, [&](const std::vector<int>& own, const Response& r) {
            for (Eigen::Index i = 0; i < r.force.size(); ++i) out.Q(entry(own, i)) -= r.force(i);
        });
    };
    force.jacobian = [each](const ElementView& at, ElementJacobian& d) {
        each(at, [&](const std::vector<int>& own, const Response& r) {
            for (Eigen::Index i = 0; i < r.force.size(); ++i)
                for (Eigen::Index j = 0; j < r.force.size(); ++j)
                    d.Q_q(entry(own, i), entry(own, j)) -= r.stiffness(i, j);
        });
    };
    force.potential = [each](const ElementView& at) {
        double sum = 0;
        each(at, [&](const std::vector<int>&, const Response& r) { sum += r.energy; });
        return sum;
    };
    return force;
}

}  // namespace cardan
