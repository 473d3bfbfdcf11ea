#include "elements/electric/detail/circuit_equations.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <array>

namespace cardan::detail {

namespace {

using Gradient = std::array<double, ControlSignal::max_sources>;

}  // namespace

CircuitEquations::Square CircuitEquations::inductance(const Column& q) const {
    Square L = constant;
    for (const Term& term : terms) L += term.factor(q(term.coordinate)).value * term.shape;
    return L;
}

void CircuitEquations::refuse(const Column& q) const {
    std::string at;
    for (Eigen::Index c = 0; c < q.size(); ++c) at += text(c ? ", " : " at coordinates ", q(c));
    throw InputError(text("circuit '", name, "': the inductance matrix of its loops is not positive definite", at,
                          "; every loop of windings needs an inductance, and couplings must not exceed it"));
}

Eigen::LLT<CircuitEquations::Square> CircuitEquations::factorised(const Column& q) const {
    const Square L = inductance(q);
    Eigen::LLT<Square> factors(L);
    if (factors.info() != Eigen::Success || !L.allFinite()) refuse(q);
    return factors;
}

CircuitEquations::Column CircuitEquations::link_currents(const ElementView& in) const {
    return factorised(in.q.head(coordinates)).solve(Column(in.s.head(links())));
}

CircuitEquations::Column CircuitEquations::source_voltages(const ElementView& in) const {
    Column v(std::ssize(sources));
    Gradient gradient;
    for (Eigen::Index k = 0; k < v.size(); ++k) {
        const Source& source = entry(sources, k);
        v(k) = source.signal.value(in, gradient);
        if (source.over_time) v(k) += source.over_time(in.time);
    }
    return v;
}

CircuitEquations::Column CircuitEquations::forces(const ElementView& in) const {
    return forces(in, link_currents(in));
}

CircuitEquations::Column CircuitEquations::forces(const ElementView& in, const Column& j) const {
    Column Q = Column::Zero(coordinates);
    for (const Term& term : terms)
        Q(term.coordinate) += term.factor(in.q(term.coordinate)).slope / 2 * j.dot(term.shape.lazyProduct(j));
    for (const Magnet& magnet : magnets)
        Q(magnet.coordinate) += magnet.flux(in.q(magnet.coordinate)).slope * magnet.shape.dot(j);
    return Q;
}

void CircuitEquations::rates(const ElementView& in, VectorOut& Q, VectorOut& f) const {
    const Column j = link_currents(in), v = source_voltages(in), u = in.s.tail(capacitance.size());
    Q.head(coordinates) += forces(in, j);
    auto flux = f.head(links());
    flux += F_j.lazyProduct(j) + F_s.lazyProduct(v) - F_c.lazyProduct(u);
    for (const Magnet& magnet : magnets)
        flux -= magnet.flux(in.q(magnet.coordinate)).slope * in.qd(magnet.coordinate) * magnet.shape;
    for (Eigen::Index k = 0; k < u.size(); ++k) {
        const Eigen::Index row = entry(capacitors, k);
        f(links() + k) += (A_j.row(row).dot(j) + A_s.row(row).dot(v) - A_c.row(row).dot(u)) / capacitance(k);
    }
}

void CircuitEquations::jacobian(const ElementView& in, ElementJacobian& d) const {
    const Eigen::Index n = links(), capacitor_count = capacitance.size();
    const Column q = in.q.head(coordinates);
    const Eigen::LLT<Square> factors = factorised(q);
    const Column j = factors.solve(Column(in.s.head(n)));
    const Square inverse = factors.solve(Square(Square::Identity(n, n)));  // dj/dlambda
    Square force_by_j = Square::Zero(coordinates, n), j_q = Square::Zero(n, coordinates);
    for (const Term& term : terms) {
        const Curve at = term.factor(q(term.coordinate));
        const Column flux = term.shape.lazyProduct(j);
        force_by_j.row(term.coordinate) += at.slope * flux.transpose();
        j_q.col(term.coordinate) -= at.slope * flux;  // times the inverse, below
        d.Q_q(term.coordinate, term.coordinate) += at.curvature / 2 * j.dot(flux);
    }
    j_q = inverse.lazyProduct(j_q).eval();
    for (const Magnet& magnet : magnets) {
        const Eigen::Index c = magnet.coordinate;
        const Curve at = magnet.flux(q(c));
        force_by_j.row(c) += at.slope * magnet.shape.transpose();
        d.Q_q(c, c) += at.curvature * magnet.shape.dot(j);
        d.f_q.col(c).head(n) -= at.curvature * in.qd(c) * magnet.shape;
        d.f_qd.col(c).head(n) -= at.slope * magnet.shape;
    }
    d.Q_s.topLeftCorner(coordinates, n) += force_by_j.lazyProduct(inverse);
    d.Q_q.topLeftCorner(coordinates, coordinates) += force_by_j.lazyProduct(j_q);
    d.f_q.topLeftCorner(n, coordinates) += F_j.lazyProduct(j_q);
    d.f_s.topLeftCorner(n, n) += F_j.lazyProduct(inverse);
    d.f_s.topRightCorner(n, capacitor_count) -= F_c;
    for (Eigen::Index k = 0; k < capacitor_count; ++k) {
        const Eigen::Index row = entry(capacitors, k);
        const double C = capacitance(k);
        d.f_q.row(n + k).head(coordinates) += A_j.row(row).lazyProduct(j_q) / C;
        d.f_s.row(n + k).head(n) += A_j.row(row).lazyProduct(inverse) / C;
        d.f_s.row(n + k).tail(capacitor_count) -= A_c.row(row) / C;
    }
    Gradient gradient;
    for (Eigen::Index k = 0; k < std::ssize(sources); ++k) {
        const ControlWire& signal = entry(sources, k).signal;
        static_cast<void>(signal.value(in, gradient));
        for (Eigen::Index row = 0; row < n; ++row) signal.add_to_f(d, row, F_s(row, k), gradient);
        for (Eigen::Index c = 0; c < capacitor_count; ++c)
            signal.add_to_f(d, n + c, A_s(entry(capacitors, c), k) / capacitance(c), gradient);
    }
}

Vector CircuitEquations::branch_currents(const ElementView& in) const {
    return A_j * link_currents(in) + A_s * source_voltages(in) - A_c * in.s.tail(capacitance.size());
}

ElementPower CircuitEquations::power(const ElementView& in) const {
    const Column j = link_currents(in), v = source_voltages(in), u = in.s.tail(capacitance.size());
    ElementPower power;
    power.stored = j.dot(in.s.head(links())) / 2 + u.dot(capacitance.cwiseProduct(u)) / 2;
    for (Eigen::Index row = 0; row < resistance.size(); ++row) {
        const double i = A_j.row(row).dot(j) + A_s.row(row).dot(v) - A_c.row(row).dot(u);
        power.dissipated += resistance(row) * i * i;
    }
    for (Eigen::Index k = 0; k < v.size(); ++k) {
        const Eigen::Index row = entry(source_branches, k);
        power.supplied += v(k) * (A_j.row(row).dot(j) + A_s.row(row).dot(v) - A_c.row(row).dot(u));
    }
    return power;
}

}  // namespace cardan::detail
