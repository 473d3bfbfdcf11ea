#include "solvers/signals/harmonics.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/types.hpp"
#include "solvers/signals/sampling.hpp"

#include <cmath>
#include <complex>

namespace cardan::solvers {

namespace {

constexpr const char* in_harmonics = "harmonics";

// 1, cos(phi), sin(phi), cos(2 phi), sin(2 phi) ...
void fill_basis(double phi, Vector& basis) {
    basis(0) = 1;
    const std::complex<double> turn = std::polar(1.0, phi);
    std::complex<double> z = 1;
    for (Eigen::Index k = 1; k + 1 < basis.size(); k += 2) {
        z *= turn;
        basis(k) = z.real();
        basis(k + 1) = z.imag();
    }
}

// 2 pi t/T without its whole turns.
double angle(double time, double frequency) {
    const double turns = time * frequency;
    return 2 * pi * (turns - std::floor(turns));
}

struct Periods {
    std::size_t first;
    int count;
};

Periods whole_periods(std::span<const double> time, double frequency, int harmonics) {
    const TimeSteps steps = time_steps(time);
    const double period = 1 / frequency;
    // n equal steps are a period with n samples: the last one closes it.
    const double covered = (time.back() - time.front() + steps.mean) / period;
    const double count = std::floor(covered * (1 + 1e-12) + 1e-9);
    if (!(count >= 1 && count < 1e9))
        throw InputError(in_harmonics, "periods in the history", covered, text("at least one of ", period, " s"));
    if (!(steps.largest < period / (2 * harmonics)))
        throw InputError(in_harmonics, "longest step between samples [s]", steps.largest,
                         text("< ", period / (2 * harmonics), ", half a period of harmonic ", harmonics));
    const double begin = time.back() - count * period + 1e-6 * steps.mean;
    std::size_t first = 0;
    while (time[first] < begin) ++first;
    return {first, static_cast<int>(count)};
}

}  // namespace

double Harmonics::operator()(double time) const {
    double sum = mean;
    const double phi = angle(time, base_frequency);
    for (std::size_t k = 0; k < amplitude.size(); ++k)
        sum += amplitude[k] * std::cos(static_cast<double>(k + 1) * phi + phase[k]);
    return sum;
}

Harmonics harmonics(std::span<const double> time, std::span<const double> values, double base_frequency, int count) {
    require_positive(in_harmonics, "base frequency [Hz]", base_frequency);
    if (count < 1 || count > 1000) throw InputError(in_harmonics, "number of harmonics", count, "1 to 1000");
    if (values.size() != time.size())
        throw InputError(in_harmonics, "number of values", values.size(), text(time.size(), ", that of the times"));
    const Periods periods = whole_periods(time, base_frequency, count);
    const auto samples = static_cast<double>(time.size() - periods.first);
    if (samples < 2 * count + 1)
        throw InputError(in_harmonics, "samples in whole periods", samples, text("at least ", 2 * count + 1));

    // Normal equations: the basis is orthogonal except for uneven sampling, so nothing is lost by squaring.
    const Eigen::Index unknowns = 2 * count + 1;
    Vector basis(unknowns), right = Vector::Zero(unknowns);
    Matrix left = Matrix::Zero(unknowns, unknowns);
    for (std::size_t i = periods.first; i < time.size(); ++i) {
        if (!std::isfinite(values[i]))
            throw InputError(in_harmonics, text("value at ", time[i], " s"), values[i], "finite");
        fill_basis(angle(time[i], base_frequency), basis);
        left.selfadjointView<Eigen::Lower>().rankUpdate(basis);
        right += values[i] * basis;
    }
    const Vector c = left.selfadjointView<Eigen::Lower>().ldlt().solve(right);

    Harmonics h;
    h.base_frequency = base_frequency;
    h.mean = c(0);
    for (Eigen::Index k = 1; k < unknowns; k += 2) {
        h.amplitude.push_back(std::hypot(c(k), c(k + 1)));
        h.phase.push_back(std::atan2(-c(k + 1), c(k)));  // A cos(phi + ph) = A cos ph cos phi - A sin ph sin phi
    }
    h.from = time[periods.first];
    h.to = time.back();
    h.periods = periods.count;
    double squares = 0;
    for (std::size_t i = periods.first; i < time.size(); ++i) squares += std::pow(values[i] - h(time[i]), 2);
    h.rest = std::sqrt(squares / samples);
    return h;
}

}  // namespace cardan::solvers
