// Kaimal's spectra and coherence as functions: closed forms, and tables of an independent program.
#include "elements/turbulence/kaimal.hpp"
#include "elements/wind/iec_class.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>

using namespace cardan;
using namespace cardan::testing;

namespace {

// Class B at 14 m/s: sigma_1 = 0.14 (0.75 V + 5.6).
const Kaimal at_14 = kaimal_turbulence(14, 2.254, 90);

// Of lines `first` to `last` of 200 s.
double mean_coherence(double distance, int first, int last) {
    double sum = 0;
    for (int line = first; line <= last; ++line) sum += at_14.coherence(line / 200.0, distance);
    return sum / (last - first + 1);
}

}  // namespace

TEST_CASE("Kaimal: parameters of the standard follow from the hub height", "[published]") {
    // IEC 61400-1 ed. 3: Lambda_1 = 42 m from 60 m on, 0.7 z below; table B.1.
    CHECK(iec_turbulence_scale(90) == Approx(42).epsilon(1e-15));
    CHECK(iec_turbulence_scale(30) == Approx(21).epsilon(1e-15));
    CHECK(max_abs(at_14.deviation - Vec3(2.254, 1.8032, 1.127)) < 1e-14);
    CHECK(max_abs(at_14.length - Vec3(340.2, 113.4, 27.72)) < 1e-12);
    CHECK(at_14.coherence_length == Approx(340.2).epsilon(1e-15));
}

TEST_CASE("Kaimal: the integral of a spectrum is its closed form, and the variance in the limit", "[analytic]") {
    // Of 4 a/(1 + 6 f a)^(5/3) from 0 to f: 1 - (1 + 6 f a)^(-2/3).
    for (int k = 0; k < 3; ++k) {
        const double a = at_14.length[k] / at_14.speed, variance = at_14.deviation[k] * at_14.deviation[k];
        constexpr double top = 2;
        constexpr int count = 2000;  // midpoints of ln(1 + 6 f a)
        const double range = std::log(1 + 6 * top * a);
        double sum = 0;
        for (int i = 0; i < count; ++i) {
            const double x = std::exp((i + 0.5) / count * range);
            sum += at_14.spectrum(k, (x - 1) / (6 * a)) * x / (6 * a) * range / count;
        }
        CHECK(sum == Approx(variance * (1 - std::pow(1 + 6 * top * a, -2.0 / 3))).epsilon(1e-6));
        CHECK(at_14.spectrum(k, 0) == Approx(4 * variance * a).epsilon(1e-14));
    }
}

TEST_CASE("Kaimal: a series holds the variance of its lines", "[discrete]") {
    // 120 s, 0.2 s: sums by a program of its own. TurbSim's v and w have 1.6519 and 1.0487: nothing at the line of half
    // the sampling rate.
    const Vec3 expected(1.8754, 1.6520, 1.0488);
    for (int k = 0; k < 3; ++k)
        CHECK(std::sqrt(at_14.variance_of_lines(k, 600, 0.2)) == Approx(expected[k]).margin(5e-5));
    const Vec3 turbsim(0, 1.6519, 1.0487);
    for (int k = 1; k < 3; ++k)
        CHECK(std::sqrt(at_14.variance_of_lines(k, 600, 0.2) - at_14.spectrum(k, 2.5) / 120) ==
              Approx(turbsim[k]).margin(5e-5));
    CHECK(at_14.variance_of_lines(0, 3, 0.5) == Approx(at_14.spectrum(0, 1 / 1.5) / 1.5).epsilon(1e-14));
}

TEST_CASE("Kaimal: coherence over frequency and distance", "[discrete]") {
    // Means over the lines of 0.005-0.015, 0.02-0.045 and 0.05-0.095 Hz, by a program of its own.
    CHECK(mean_coherence(20, 1, 3) == Approx(0.825).margin(5e-4));
    CHECK(mean_coherence(20, 4, 9) == Approx(0.575).margin(5e-4));
    CHECK(mean_coherence(20, 10, 19) == Approx(0.296).margin(5e-4));
    CHECK(mean_coherence(80, 1, 3) == Approx(0.474).margin(5e-4));
    CHECK(mean_coherence(80, 4, 9) == Approx(0.123).margin(5e-4));
    CHECK(mean_coherence(80, 10, 19) == Approx(0.011).margin(5e-4));
    CHECK(at_14.coherence(0, 340.2 / 0.12) == Approx(std::exp(-12)).epsilon(1e-12));
    CHECK(at_14.coherence(0.5, 0) == 1);
}

TEST_CASE("Kaimal: what is out of range is refused with its limit", "[property]") {
    check_refused([] { kaimal_turbulence(0, 2, 90); }, {"mean speed [m/s]", "> 0"});
    check_refused([] { kaimal_turbulence(10, -1, 90); }, {"standard deviation of u", "-1"});
    check_refused([] { kaimal_turbulence(10, 1, not_a_number); }, {"hub height", "nan"});
    Kaimal model = at_14;
    model.decay = infinite;
    check_refused([&] { model.check(); }, {"decay", "inf"});
    model = at_14;
    model.offset = -0.1;
    check_refused([&] { model.check(); }, {"offset", "-0.1"});
    check_refused([] { static_cast<void>(at_14.spectrum(3, 1)); }, {"component", "3"});
    check_refused([] { static_cast<void>(at_14.variance_of_lines(0, 1, 0.1)); }, {"steps = 1"});
}
