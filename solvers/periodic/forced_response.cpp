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
        const Vector rest = at.M * q.at(time, 2) + at.C * q.at(time, 1) + at.K * q.at(time) - f;
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

ForcedResponse forced_response(const PeriodicSystem& system, const std::function<Vector(double)>& load, int harmonics,
                               int samples) {
    check(system, harmonics, samples);
    if (!load) throw InputError(text(in_forced_response, ": the function of the load is empty"));
    if (samples == 0) samples = 4 * (harmonics + 1);
    const Index n = system.rows(), terms = Index{2} * harmonics + 1;
    const double omega = system.frequency();
    // Block (j, k): what column k of the coefficients gives in the equation of column j.
    Matrix A = Matrix::Zero(n * terms, n * terms);
    Vector b = Vector::Zero(n * terms), size = Vector::Zero(n);
    SecondOrderSystem at;
    for (int s = 0; s < samples; ++s) {
        const double psi = 2 * pi * s / samples, time = psi / omega;
        system.at(time, at);
        const Vector f = load_at(load, time, n), weights = fourier_weights(psi, harmonics, samples);
        const Vector q = fourier_basis(psi, harmonics), qd = omega * fourier_basis(psi, harmonics, 1),
                     qdd = omega * omega * fourier_basis(psi, harmonics, 2);
        for (Index k = 0; k < terms; ++k) {
            const Matrix column = qdd(k) * at.M + qd(k) * at.C + q(k) * at.K;
            for (Index j = 0; j < terms; ++j) A.block(j * n, k * n, n, n) += weights(j) * column;
        }
        for (Index j = 0; j < terms; ++j) b.segment(j * n, n) += weights(j) * f;
        size += (at.K.diagonal().cwiseAbs() + omega * omega * at.M.diagonal().cwiseAbs()) / samples;
    }
    // Coordinates of different units: rows and columns to unit size.
    const Vector scale = size.cwiseSqrt().cwiseInverse().replicate(terms, 1);
    const Eigen::PartialPivLU<Matrix> lu(scale.asDiagonal() * A * scale.asDiagonal());
    if (!(lu.rcond() > 1e-15))
        throw NumericalError(text(in_forced_response, ": the equations are singular (reciprocal condition ", lu.rcond(),
                                  "): an undamped natural frequency coincides with a harmonic of ", 1 / system.period(),
                                  " Hz, or nothing holds a coordinate"));
    const Vector x = scale.cwiseProduct(lu.solve(scale.cwiseProduct(b)));
    ForcedResponse response{system.period(), x.reshaped(n, terms), 0};
    response.remainder = remainder(system, load, response, samples);
    return response;
}

}  // namespace cardan::solvers
