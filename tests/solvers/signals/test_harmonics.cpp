#include "mbs/base/types.hpp"
#include "solvers/signals/harmonics.hpp"
#include "tests/solvers/signals/signals.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

constexpr double frequency = 0.2;  // Hz

// mean 2.5; amplitudes 0.8, 0, 0.3; phases 0.4, -, -2.5
double periodic(double t) {
    return 2.5 + 0.8 * std::cos(2 * pi * frequency * t + 0.4) + 0.3 * std::cos(3 * 2 * pi * frequency * t - 2.5);
}

std::vector<double> steps(double from, double step, int count) {
    std::vector<double> time;
    for (int i = 0; i < count; ++i) time.push_back(from + step * i);
    return time;
}

void check_periodic(const Harmonics& h, double tolerance) {
    CHECK(h.mean == Approx(2.5).margin(tolerance));
    CHECK(h.amplitude[0] == Approx(0.8).margin(tolerance));
    CHECK(h.amplitude[1] == Approx(0).margin(tolerance));
    CHECK(h.amplitude[2] == Approx(0.3).margin(tolerance));
    CHECK(h.phase[0] == Approx(0.4).margin(2 * tolerance));
    CHECK(h.phase[2] == Approx(-2.5).margin(4 * tolerance));
    CHECK(h.rest < tolerance);
}

}  // namespace

TEST_CASE("harmonics: mean, amplitudes and phases of a periodic channel come out, late in time as well", "[analytic]") {
    for (double start : {-7.0, 0.0, 1000.0}) {
        const std::vector<double> time = steps(start, 0.037, 400);  // no whole number of steps in a period
        const Harmonics h = harmonics(time, values_at(time, periodic), frequency, 4);
        check_periodic(h, 1e-11);
        CHECK(h.periods == 2);
        CHECK(h.to == time.back());
        CHECK(h.from == Approx(time.back() - 10).margin(0.037));
        CHECK(h(start + 3.3) == Approx(periodic(start + 3.3)).epsilon(1e-10));
    }
}

TEST_CASE("harmonics: uneven samples give the same", "[analytic]") {
    Random random(8);
    std::vector<double> time{0};
    while (time.back() < 22) time.push_back(time.back() + uniform(random, 0.01, 0.3));
    check_periodic(harmonics(time, values_at(time, periodic), frequency, 5), 1e-12);
}

TEST_CASE("harmonics: a period of equal steps is whole with the sample before its end", "[analytic]") {
    const std::vector<double> time = steps(0, 0.05, 100);  // 0 ... 4.95 s of 5 s
    const Harmonics h = harmonics(time, values_at(time, periodic), frequency, 3);
    CHECK(h.periods == 1);
    CHECK(h.from == 0);
    check_periodic(h, 1e-13);
    const std::vector<double> closed = steps(0, 0.05, 101);
    CHECK(harmonics(closed, values_at(closed, periodic), frequency, 3).from == 0.05);
}

// Over whole periods of both, other frequencies are orthogonal to the harmonics.
TEST_CASE("harmonics: other frequencies and an earlier transient have no part in them", "[analytic]") {
    const auto disturbed = [](double t) {
        return periodic(t) + 0.5 * std::sin(2 * pi * 0.25 * frequency * t) + (t < 10 ? 40.0 : 0.0);
    };
    const std::vector<double> time = steps(0, 0.1, 300);
    std::vector<double> values = values_at(time, disturbed);
    const Harmonics all = harmonics(time, values, frequency, 3);
    CHECK(all.periods == 6);
    CHECK(all.mean > 10);
    const std::vector<double> late(time.begin() + 100, time.end());
    values.erase(values.begin(), values.begin() + 100);
    const Harmonics h = harmonics(late, values, frequency, 3);
    CHECK(h.periods == 4);
    CHECK(h.mean == Approx(2.5).epsilon(1e-12));
    CHECK(h.amplitude[0] == Approx(0.8).epsilon(1e-12));
    CHECK(h.amplitude[2] == Approx(0.3).epsilon(1e-12));
    CHECK(h.rest == Approx(0.5 / std::sqrt(2)).epsilon(1e-12));
}

TEST_CASE("harmonics: bad input is refused with place, value and limit", "[property]") {
    std::vector<double> time = steps(0, 0.1, 100), values = values_at(time, periodic);
    const auto refused = [&](double base, int count, std::initializer_list<std::string> parts) {
        check_refused([&] { (void)harmonics(time, values, base, count); }, parts);
    };
    refused(0, 3, {"base frequency [Hz] = 0", "> 0"});
    refused(0.2, 0, {"number of harmonics = 0", "1 to 1000"});
    refused(0.09, 3, {"periods in the history = 0.9", "at least one of 11.1"});
    refused(0.2, 25, {"longest step between samples [s] = 0.1", "< 0.1, half a period of harmonic 25"});
    values[70] = std::numeric_limits<double>::infinity();
    refused(0.2, 3, {"value at 7 s = inf", "finite"});
    values.pop_back();
    refused(0.2, 3, {"number of values = 99", "100"});
    time[3] = 0;
    values.push_back(0);
    refused(0.2, 3, {"time of sample 3 = 0"});
}
