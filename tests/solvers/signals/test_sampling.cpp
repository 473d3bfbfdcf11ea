#include "mbs/base/entry.hpp"
#include "mbs/base/types.hpp"
#include "solvers/signals/envelope.hpp"
#include "solvers/signals/sampling.hpp"
#include "tests/solvers/signals/signals.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>
#include <cmath>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// Times from 0 to 1; every second step is `ratio` times as long as the others.
std::vector<double> uneven(int pairs, double ratio) {
    std::vector<double> time{0};
    for (int i = 0; i < pairs; ++i) {
        time.push_back((i + 1 / (1 + ratio)) / pairs);
        time.push_back((i + 1.0) / pairs);
    }
    return time;
}

// Largest error between `from` and `to` of a sine on such times.
double sine_error(int pairs, double ratio, double from, double to) {
    const auto sine = [](double t) { return std::sin(5 * t + 0.3); };
    const std::vector<double> time = uneven(pairs, ratio), values = values_at(time, sine);
    std::vector<double> at;
    for (int i = 0; i <= 2000; ++i) at.push_back(from + (to - from) * i / 2000);
    const std::vector<double> found = resample(time, values, at);
    double error = 0;
    for (std::size_t i = 0; i < at.size(); ++i) error = std::max(error, std::abs(found[i] - sine(at[i])));
    return error;
}

}  // namespace

TEST_CASE("time steps: equal ones are recognised despite rounding and printed digits", "[property]") {
    std::vector<double> time;
    for (int i = 0; i <= 10000; ++i) time.push_back(100 + 0.01 * i);
    TimeSteps steps = time_steps(time);
    CHECK(steps.uniform());
    CHECK(steps.mean == Approx(0.01).epsilon(1e-12));
    CHECK(steps.median == Approx(0.01).epsilon(1e-9));
    CHECK(steps.largest_deviation < 1e-8);
    time.push_back(200.003);  // where an event stopped
    steps = time_steps(time);
    CHECK_FALSE(steps.uniform());
    CHECK(steps.median == Approx(0.01).epsilon(1e-9));
    CHECK(steps.largest == Approx(0.01).epsilon(1e-9));
    time = {0, 0.333, 0.667, 1};  // thirds with three digits
    CHECK_FALSE(time_steps(time).uniform());
    CHECK(time_steps(time).largest_deviation == Approx(0.001).epsilon(1e-9));
    CHECK(time_steps(std::vector<double>{0, 0.3333, 0.6667, 1}).uniform());
    check_refused([] { (void)time_steps(std::vector<double>{1}); }, {"number of samples = 1", "at least 2"});
    check_refused([] { (void)time_steps(std::vector<double>{0, 1, 1}); }, {"time of sample 2 = 1", "> 1"});
    check_refused([] { (void)time_steps(std::vector<double>{0, not_a_number}); }, {"time of sample 1 = nan", "finite"});
}

TEST_CASE("samples between: both ends belong to the part, also when they are rounded", "[property]") {
    std::vector<double> time;
    for (int i = 0; i <= 100; ++i) time.push_back(0.1 * i);
    const SampleRange all = samples_between(time, -infinite, infinite);
    CHECK((all.first == 0 && all.count == 101));
    const SampleRange part = samples_between(time, 0.3, 0.7);  // 0.1*3 > 0.3 and 0.1*7 > 0.7 as doubles
    CHECK((part.first == 3 && part.count == 5));
    check_refused([&] { (void)samples_between(time, 3.01, 3.15); }, {"3.01, 3.15", "two samples", "0 and 10"});
    check_refused([&] { (void)samples_between(time, 5, 4); }, {"from, to [s] = 5, 4"});
    check_refused([&] { (void)samples_between(time, not_a_number, 4); }, {"from [s] = nan", "no limit"});
    check_refused([&] { (void)samples_between(time, 1, not_a_number); }, {"to [s] = nan", "no limit"});
    check_refused([] { (void)samples_between({}, 0, 4); }, {"a history with samples"});
}

TEST_CASE("resampling: parabolas are exact on any times, samples stay as they are", "[analytic]") {
    const std::vector<double> time{0, 0.1, 0.15, 0.9, 1.0, 2.5, 2.6};
    const auto parabola = [](double t) { return 3 - 2 * t + 0.7 * t * t; };
    const std::vector<double> values = values_at(time, parabola);
    std::vector<double> at = time;
    for (int i = 0; i <= 260; ++i) at.push_back(0.01 * i);
    std::sort(at.begin(), at.end());
    at.back() = 2.6;
    const std::vector<double> found = resample(time, values, at);
    for (std::size_t i = 0; i < at.size(); ++i) CHECK(found[i] == Approx(parabola(at[i])).epsilon(1e-13));
    CHECK(resample(time, values, time) == values);
    CHECK(resample(std::vector<double>{1, 3}, std::vector<double>{5, 9}, std::vector<double>{1.5})[0] == Approx(6));
}

// In equal steps slopes are off by h^2 y'''/6, so values by s (1 - s) (1 - 2 s) h^3 y'''/6, at most sqrt(3)/108 h^3
// y'''.
TEST_CASE("resampling: the error is of the third order in the steps, in equal ones with the known factor",
          "[analytic]") {
    const double coarse = sine_error(40, 3, 0, 1), fine = sine_error(80, 3, 0, 1);
    CHECK(std::log2(coarse / fine) == Approx(3).margin(0.1));
    const double h = 1.0 / 160;
    const double largest_third_derivative = 125;  // at 5 t + 0.3 = pi
    CHECK(sine_error(80, 1, 0.2, 0.8) ==
          Approx(std::sqrt(3) / 108 * h * h * h * largest_third_derivative).epsilon(0.01));
}

TEST_CASE("resampling: a history gets equal steps in all channels, from the first time on", "[property]") {
    History history{"run", {{"a", "m", "a"}, {"b", "1", "b"}}, {1, 1.25, 2, 2.1, 3.2}, {}};
    history.values = {history.time, {1, 1, 1, 1, 1}};
    const History even = resample(history, 0.5);
    CHECK(even.title == "run");
    CHECK(even.channels.size() == 2);
    REQUIRE(even.time == std::vector<double>{1, 1.5, 2, 2.5, 3});
    for (std::size_t i = 0; i < even.time.size(); ++i) {
        CHECK(even["a"][i] == Approx(even.time[i]).epsilon(1e-14));
        CHECK(even["b"][i] == Approx(1).epsilon(1e-14));
    }
    CHECK(time_steps(resample(history, 1.1).time).uniform());
    CHECK(resample(history, 1.1).time.size() == 3);  // 2.2/1.1 is a whole number only but for rounding
    check_refused([&] { (void)resample(history, 0); }, {"time between samples [s] = 0", "> 0"});
    check_refused([&] { (void)resample(history, not_a_number); }, {"time between samples [s] = nan"});
    check_refused([&] { (void)resample(history, 1e-9); }, {"number of samples = 2", "at most 1e8"});
    const std::vector<double> time{0, 1}, outside{1.5};
    check_refused([&] { (void)resample(time, time, outside); }, {"resample at [s] = 1.5", "between 0 and 1"});
    check_refused([&] { (void)resample(time, outside, time); }, {"number of values = 1", "2"});
    check_refused([&] { (void)resample(time, time, std::vector<double>{0.5, 0.4}); }, {"0.4", "rising"});
}

TEST_CASE("envelope: every column keeps its first, smallest, largest and last value", "[property]") {
    Random random(3);
    for (std::size_t columns : {1, 7, 100}) {
        std::vector<double> x, y;
        double t = 5;
        for (int i = 0; i < 20000; ++i) {
            x.push_back(t += uniform(random, 0, 1e-3));
            y.push_back(uniform(random, -1, 1));
        }
        const ThinnedCurve curve = min_max_envelope(x, y, columns);
        CHECK(curve.x.size() <= 4 * (columns + 1));
        CHECK(std::is_sorted(curve.x.begin(), curve.x.end()));
        CHECK(curve.x.front() == x.front());
        CHECK(curve.x.back() == x.back());
        // Against the whole curve, column by column.
        const auto extremes = [&](const std::vector<double>& xs, const std::vector<double>& ys) {
            std::vector<std::pair<double, double>> found(columns + 1, {2, -2});
            for (std::size_t i = 0; i < xs.size(); ++i) {
                const double place = (xs[i] - x.front()) * (static_cast<double>(columns) / (x.back() - x.front()));
                auto& [low, high] = found[static_cast<std::size_t>(place)];
                low = std::min(low, ys[i]);
                high = std::max(high, ys[i]);
            }
            return found;
        };
        CHECK(extremes(x, y) == extremes(curve.x, curve.y));
    }
}

TEST_CASE("envelope: of a million values the one peak survives exactly, gaps stay open, short curves stay whole",
          "[property]") {
    std::vector<double> x, y;
    for (int i = 0; i < 1000000; ++i) {
        x.push_back(1e-3 * i);
        y.push_back(i == 654321 ? 17.25 : i == 123456 ? -3.5 : std::sin(0.01 * i));
    }
    for (std::size_t i = 300000; i < 400000; ++i) y[i] = i % 2 == 0 ? not_a_number : infinite;
    const ThinnedCurve curve = min_max_envelope(x, y, 1000);
    CHECK(curve.x.size() < 4010);
    const auto peak = std::find(curve.y.begin(), curve.y.end(), 17.25);
    REQUIRE(peak != curve.y.end());
    CHECK(entry(curve.x, peak - curve.y.begin()) == x[654321]);
    CHECK(std::count(curve.y.begin(), curve.y.end(), -3.5) == 1);
    CHECK(std::count_if(curve.y.begin(), curve.y.end(), [](double v) { return !std::isfinite(v); }) == 1);
    for (std::size_t i = 0; i < curve.x.size(); ++i)
        if (curve.x[i] >= x[300000] && curve.x[i] < x[400000]) CHECK(std::isnan(curve.y[i]));
    const std::vector<double> few{1, 2, 3, 4};
    CHECK(min_max_envelope(few, few, 1).y == few);
    CHECK(min_max_envelope({}, {}, 5).x.empty());
    check_refused([&] { (void)min_max_envelope(few, few, 0); }, {"number of columns = 0", ">= 1"});
    check_refused([&] { (void)min_max_envelope(few, x, 3); }, {"number of values = 1000000", "4"});
    const std::vector<double> falling{1, 2, 1.5, 4};
    check_refused([&] { (void)min_max_envelope(falling, few, 3); }, {"x of point 2 = 1.5", "rising"});
}
