#include "solvers/periodic/detail/normalised_system.hpp"

#include "mbs/base/error.hpp"

#include <cmath>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Of two effects of the states' unit, one proportional to it and one to its inverse, neither large where one is
// missing.
double balance(double of_states, double on_states) {
    if (of_states > 0 && on_states > 0) return std::sqrt(on_states / of_states);
    if (of_states > 0) return 1 / of_states;
    return on_states > 0 ? on_states : 1;
}

Vector units_beside(const StateTerms& t, const Vector& d, double omega) {
    const Vector inverse = t.scales.cwiseInverse();
    const auto unit = d.asDiagonal(), scale = t.scales.asDiagonal(), per_scale = inverse.asDiagonal();
    const double of_states = (unit * t.Q_s * scale).norm() / (omega * omega);
    const double on_states = (per_scale * t.f_q * unit).norm() / omega + (per_scale * t.f_qd * unit).norm();
    return balance(of_states, on_states) * t.scales;
}

// Also in the time omega t.
void normalise(StateTerms& t, const Vector& d, const Vector& u, double omega) {
    rescale(t, d, u);
    t.Q_s /= omega * omega;
    t.f_q /= omega;
    t.f_s /= omega;
}

PeriodicSystem normalised(const PeriodicSystem& raw, const Vector& unit) {
    const double omega = raw.frequency();
    if (!raw.is_second_order())
        return PeriodicSystem::first_order(2 * pi, raw.rows(), [raw, omega](double angle, Matrix& E, Matrix& A) {
            raw.at(angle / omega, E, A);
            E *= omega;
        });
    const Vector d = unit.head(raw.rows()), u = unit.tail(raw.states_beside());
    const auto at = [raw, omega, d, u](double angle, SecondOrderSystem& out) {
        raw.at(angle / omega, out);
        const auto scale = d.asDiagonal();
        out.M = (scale * out.M * scale).eval();
        out.C = (scale * out.C * scale / omega).eval();
        out.K = (scale * out.K * scale / (omega * omega)).eval();
        if (u.size() > 0) normalise(out.states, d, u, omega);
    };
    return PeriodicSystem::second_order(2 * pi, raw.rows(), at, u.size());
}

}  // namespace

Vector units_of_states(const PeriodicSystem& system, const char* place) {
    Vector unit = Vector::Ones(system.states());
    if (!system.is_second_order()) return unit;
    SecondOrderSystem at;
    system.at(0, at);
    const Index n = system.rows(), m = system.states_beside();
    for (Index i = 0; i < n; ++i) {
        if (!(at.M(i, i) > 0))
            throw InputError(place, text("inertia of row ", i), at.M(i, i), "> 0 in a system of second order");
        unit(i) = 1 / std::sqrt(at.M(i, i));
    }
    unit.segment(n, n) = system.frequency() * unit.head(n);
    if (m > 0) unit.tail(m) = units_beside(at.states, unit.head(n), system.frequency());
    return unit;
}

NormalisedSystem::NormalisedSystem(const PeriodicSystem& raw, const char* place)
    : system(normalised(raw, units_of_states(raw, place))), unit(units_of_states(raw, place)) {}

}  // namespace cardan::solvers
