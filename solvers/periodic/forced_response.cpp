#include "solvers/periodic/forced_response.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/azimuth_series.hpp"

#include <cmath>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;
constexpr const char* in_forced_response = "forced response";

Vector load_at(const std::function<Vector(double)>& load, double time, Index rows) {
    Vector f = load(time);
    if (f.size() != rows)
        throw NumericalError(
            text(in_forced_response, ": load at ", time, " s has ", f.size(), " rows; wanted: ", rows));
    if (!f.allFinite()) throw NumericalError(text(in_forced_response, ": load at ", time, " s is not finite"));
    return f;
}

void check(const PeriodicSystem& system, int harmonics, int samples) {
    if (!system.is_second_order()) throw InputError(in_forced_response, "order of the system", 1, "2");
    if (harmonics < 1) throw InputError(in_forced_response, "harmonics", harmonics, ">= 1");
    if (samples != 0 && samples <= 2 * harmonics)
        throw InputError(in_forced_response, "samples", samples, "0, or more than twice the harmonics");
}

double remainder(const PeriodicSystem& system, const std::function<Vector(double)>& load, const ForcedResponse& q,
                 int samples) {
    SecondOrderSystem at;
    double largest = 0, size = 0;
    for (int s = 0; s < samples; ++s) {
        const double time = (s + 0.5) / samples * system.period();
        system.at(time, at);
        const Vector f = load_at(load, time, system.rows());
        Vector rest = at.M * q.at(time, 2) + at.C * q.at(time, 1) + at.K * q.at(time) - f;
        if (system.states_beside() > 0) rest -= at.states.Q_s * q.states_at(time);
        largest = std::max(largest, rest.cwiseAbs().maxCoeff());
        size = std::max(size, f.cwiseAbs().maxCoeff());
    }
    return size > 0 ? largest / size : 0;
}

}  // namespace

Vector ForcedResponse::at(double time, int derivative) const {
    const double omega = 2 * pi / period;
    return coefficients * (std::pow(omega, derivative) * fourier_basis(omega * time, harmonics(), derivative));
}

Vector ForcedResponse::states_at(double time) const {
    return state_coefficients * fourier_basis(2 * pi / period * time, harmonics());
}

ForcedResponse forced_response(const PeriodicSystem& system, const std::function<Vector(double)>& load, int harmonics,
                               int samples) {
    check(system, harmonics, samples);
    if (!load) throw InputError(text(in_forced_response, ": the function of the load is empty"));
    if (samples == 0) samples = 4 * (harmonics + 1);
    const Index own = system.rows(), n = own + system.states_beside(), terms = Index{2} * harmonics + 1;
    const double omega = system.frequency();
    // Block (j, k): what column k of the coefficients gives in the equation of column j.
    Matrix A = Matrix::Zero(n * terms, n * terms);
    Vector b = Vector::Zero(n * terms), size = Vector::Zero(n), scales;
    SecondOrderSystem at;
    for (int s = 0; s < samples; ++s) {
        const double psi = 2 * pi * s / samples, time = psi / omega;
        system.at(time, at);
        if (s == 0) scales = at.states.scales;
        append_states(at);
        Vector f = Vector::Zero(n);
        f.head(own) = load_at(load, time, own);
        const Vector weights = fourier_weights(psi, harmonics, samples);
        const Vector q = fourier_basis(psi, harmonics), qd = omega * fourier_basis(psi, harmonics, 1),
                     qdd = omega * omega * fourier_basis(psi, harmonics, 2);
        for (Index k = 0; k < terms; ++k) {
            const Matrix column = qdd(k) * at.M + qd(k) * at.C + q(k) * at.K;
            for (Index j = 0; j < terms; ++j) A.block(j * n, k * n, n, n) += weights(j) * column;
        }
        for (Index j = 0; j < terms; ++j) b.segment(j * n, n) += weights(j) * f;
        size += (at.K.diagonal().cwiseAbs() + omega * omega * at.M.diagonal().cwiseAbs()) / samples;
        if (n > own) size.tail(n - own).array() += omega / samples;
    }
    // Coordinates and states of different units: rows and columns to unit size.
    Vector rows = size.cwiseSqrt().cwiseInverse(), columns = rows;
    if (n > own) {
        rows.tail(n - own).array() /= scales.array();
        columns.tail(n - own).array() *= scales.array();
    }
    rows = rows.replicate(terms, 1).eval();
    columns = columns.replicate(terms, 1).eval();
    const Eigen::PartialPivLU<Matrix> lu(rows.asDiagonal() * A * columns.asDiagonal());
    const double condition = reciprocal_condition(lu);
    if (!(condition > 1e-15))
        throw NumericalError(text(in_forced_response, ": the equations are singular (reciprocal condition ", condition,
                                  "): an undamped natural frequency coincides with a harmonic of ", 1 / system.period(),
                                  " Hz, or nothing holds a coordinate"));
    const Vector x = columns.cwiseProduct(lu.solve(rows.cwiseProduct(b)));
    const Matrix all = x.reshaped(n, terms);
    ForcedResponse response{
        .period = system.period(), .coefficients = all.topRows(own), .state_coefficients = all.bottomRows(n - own)};
    response.remainder = remainder(system, load, response, samples);
    return response;
}

}  // namespace cardan::solvers
