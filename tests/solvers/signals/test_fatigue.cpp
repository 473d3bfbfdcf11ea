#include "mbs/base/types.hpp"
#include "solvers/signals/fatigue.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/tables/csv.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <string>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;
using Catch::Matchers::Contains;

namespace {

std::vector<double> column(const std::string& file, const std::string& name) {
    const auto table = turbines::CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/data/fatigue/" + file);
    const auto values = table.column(name);
    return {values.begin(), values.end()};
}

// Counts by range, to three digits.
std::map<long, double> by_range(const std::vector<LoadCycle>& cycles) {
    std::map<long, double> out;
    for (const LoadCycle& one : cycles) out[std::lround(1e3 * one.range)] += one.count;
    return out;
}

// The standard's own rule, with a start that half cycles take away.
std::map<long, double> by_the_rule(const std::vector<double>& signal) {
    std::vector<double> points;
    std::map<long, double> out;
    const auto count = [&](double range, double size) { out[std::lround(1e3 * range)] += size; };
    std::vector<double> turning;
    for (std::size_t i = 0; i < signal.size(); ++i) {
        const bool inside = i > 0 && i + 1 < signal.size();
        if (!inside || (signal[i] - signal[i - 1]) * (signal[i + 1] - signal[i]) < 0) turning.push_back(signal[i]);
    }
    for (const double point : turning) {
        points.push_back(point);
        while (points.size() >= 3) {
            const std::size_t n = points.size();
            const double X = std::abs(points[n - 1] - points[n - 2]), Y = std::abs(points[n - 2] - points[n - 3]);
            if (X < Y) break;
            if (n == 3) {
                count(Y, 0.5);
                points.erase(points.begin());
            } else {
                count(Y, 1);
                points.erase(points.end() - 3, points.end() - 1);
            }
        }
    }
    for (std::size_t i = 1; i < points.size(); ++i) count(std::abs(points[i] - points[i - 1]), 0.5);
    return out;
}

std::vector<double> random_signal(Random& random, int size) {
    std::vector<double> out;
    while (std::ssize(out) < size) out.push_back(uniform(random, -1, 1));
    return out;
}

}  // namespace

TEST_CASE("fatigue: the example of ASTM E1049-85, with each way to count its residue", "[paper]") {
    const std::vector<double> signal{-2, 1, -3, 5, -1, 3, -4, 4, -2};
    using Counts = std::map<long, double>;
    CHECK(by_range(rainflow(signal)) == Counts{{3000, 0.5}, {4000, 1.5}, {6000, 0.5}, {8000, 1}, {9000, 0.5}});
    CHECK(by_range(rainflow(signal, Residue::repeat)) == Counts{{3000, 1}, {4000, 1}, {7000, 1}, {9000, 1}});
    CHECK(by_range(rainflow(signal, Residue::full)) == Counts{{3000, 1}, {4000, 2}, {6000, 1}, {8000, 2}, {9000, 1}});
    const std::vector<LoadCycle> closed = rainflow(signal, Residue::dropped);
    REQUIRE(closed.size() == 1);
    CHECK(closed[0].range == 4);
    CHECK(closed[0].mean == 1);
}

TEST_CASE("fatigue: counts and equivalent loads of a random signal of 2000 values", "[crosscheck]") {
    const std::vector<double> signal = column("signal.csv", "load"), range = column("astm_counts.csv", "range"),
                              count = column("astm_counts.csv", "count");
    const std::map<long, double> own = by_range(rainflow(signal));
    std::map<long, double> expected;
    for (std::size_t i = 0; i < range.size(); ++i) expected[std::lround(1e3 * range[i])] += count[i];
    CHECK(own == expected);
    constexpr double duration = 200;
    struct Row {
        Residue residue;
        double m4, m10;
    };
    for (const Row& row : {Row{Residue::half, 8.517241, 19.146905}, Row{Residue::repeat, 9.665851, 20.519036},
                           Row{Residue::full, 9.802008, 20.520802}, Row{Residue::dropped, 5.997505, 8.599669}}) {
        const std::vector<LoadCycle> cycles = rainflow(signal, row.residue);
        CHECK(equivalent_load(cycles, 4, duration) == Approx(row.m4).epsilon(1e-7));
        CHECK(equivalent_load(cycles, 10, duration) == Approx(row.m10).epsilon(1e-7));
    }
    const MeanCorrection goodman{.ultimate = 100};
    CHECK(equivalent_load(rainflow(signal), 4, duration, goodman) == Approx(9.690874).epsilon(1e-7));
    CHECK(equivalent_load(rainflow(signal), 10, duration, goodman) == Approx(21.621989).epsilon(1e-7));
}

TEST_CASE("fatigue: the standard's rule, with a start, counts the same", "[crosscheck]") {
    Random random(3);
    for (int i = 0; i < 300; ++i) {
        const std::vector<double> signal = random_signal(random, 3 + i);
        CHECK(by_range(rainflow(signal)) == by_the_rule(signal));
    }
}

TEST_CASE("fatigue: cycles of a signal, of its mirror image, backwards and moved", "[invariant]") {
    Random random(8);
    for (int i = 0; i < 100; ++i) {
        const std::vector<double> signal = random_signal(random, 400);
        std::vector<double> mirrored, moved;
        for (const double one : signal) {
            mirrored.push_back(-one);
            moved.push_back(one + 1024);
        }
        const std::vector<double> backwards(signal.rbegin(), signal.rend());
        for (const Residue residue : {Residue::half, Residue::full, Residue::repeat, Residue::dropped}) {
            const auto own = by_range(rainflow(signal, residue));
            CHECK(by_range(rainflow(mirrored, residue)) == own);
            CHECK(by_range(rainflow(backwards, residue)) == own);
            CHECK(by_range(rainflow(moved, residue)) == own);
        }
        // Every rise and fall belongs to one cycle, half of a whole one each.
        double path = 0, counted = 0;
        for (std::size_t k = 1; k < signal.size(); ++k) path += std::abs(signal[k] - signal[k - 1]);
        for (const LoadCycle& one : rainflow(signal)) counted += 2 * one.count * one.range;
        CHECK(counted == Approx(path).epsilon(1e-12));
    }
}

TEST_CASE("fatigue: a sinusoidal load is equivalent to itself", "[analytic]") {
    for (const double exponent : {0.5, 4.0, 10.0, 300.0}) {
        std::vector<double> signal;
        for (int i = 0; i <= 40 * 64; ++i) signal.push_back(1e6 + 1e5 * std::sin(2 * pi * i / 64));
        const std::vector<LoadCycle> cycles = rainflow(signal, Residue::repeat);
        CHECK(equivalent_load(cycles, exponent, 40) == Approx(2e5).epsilon(1e-9));
        const double by_frequency = 2e5 * std::pow(40.0 / 20, 1 / exponent);
        CHECK(equivalent_load(cycles, exponent, 20) == Approx(by_frequency).epsilon(1e-9));
    }
}

TEST_CASE("fatigue: nothing, one value and a constant have no cycles", "[property]") {
    CHECK(rainflow({}).empty());
    CHECK(rainflow(std::vector{3.0}).empty());
    CHECK(rainflow(std::vector{3.0, 3.0, 3.0}).empty());
    CHECK(equivalent_load({}, 4, 600) == 0);
    const std::vector<LoadCycle> rise = rainflow(std::vector{1.0, 2.0, 2.0, 4.0});
    REQUIRE(rise.size() == 1);
    CHECK(rise[0].range == 3);
    CHECK(rise[0].count == 0.5);
}

TEST_CASE("fatigue: values that are not finite and numbers out of range are refused", "[errors]") {
    check_refused([] { rainflow(std::vector{1.0, std::numeric_limits<double>::quiet_NaN()}); }, {"rainflow", "nan"});
    const std::vector<LoadCycle> one{{.range = 2, .mean = 5}};
    check_refused([&] { equivalent_load(one, 0, 1); }, {"equivalent load", "exponent"});
    check_refused([&] { equivalent_load(one, 4, 0); }, {"equivalent load", "number of cycles"});
    check_refused([&] { equivalent_load(one, 4, 1, MeanCorrection{.ultimate = 5}); }, {"mean of a cycle", "ultimate"});
    check_refused([&] { equivalent_load(one, 4, 1, MeanCorrection{.ultimate = 0}); }, {"ultimate load"});
}
