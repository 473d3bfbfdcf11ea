// Spectra, coherence and rotational sampling of boxes, against closed forms and numbers of another implementation.
#include "elements/turbulence/box_spectra.hpp"
#include "elements/turbulence/kaimal.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/tables/csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>

namespace cardan::testing::box_spectra_tests {

namespace {

TimeSeries series_of(int count, double step, const std::function<double(double)>& at, bool periodic = true) {
    TimeSeries out{.values = {}, .step = step, .periodic = periodic};
    for (int j = 0; j < count; ++j) out.values.push_back(at(j * step));
    return out;
}

TimeSeries noise(std::uint32_t seed, int count, bool periodic = true) {
    Random random(seed);
    return series_of(
        count, 0.1, [&](double) { return uniform(random, -1, 1); }, periodic);
}

double variance_of(const std::vector<double>& values) {
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    double sum = 0;
    for (const double value : values) sum += (value - mean) * (value - mean);
    return sum / static_cast<double>(values.size());
}

// u of a time, a height, a place across; v and w are twice and three times it.
WindBox box_of(const BoxGrid& grid, double speed, const std::function<double(double t, double z, double y)>& u) {
    const auto numbers = std::make_shared<std::vector<float>>();
    for (int t = 0; t < grid.steps; ++t)
        for (int k = 0; k < grid.rows; ++k)
            for (int j = 0; j < grid.columns; ++j) {
                const double value = u(t * grid.time_step, grid.lowest + k * grid.row_spacing,
                                       j * grid.column_spacing - grid.width() / 2);
                for (int c = 0; c < 3; ++c) numbers->push_back(static_cast<float>((c + 1) * value));
            }
    WindBoxData box{.grid = grid, .components = {}, .speed = speed, .periodic = true, .memory = numbers};
    for (int c = 0; c < 3; ++c)
        box.components.at(static_cast<std::size_t>(c)) = {.data = numbers->data() + c,
                                                          .type = BoxNumbers::Type::float32,
                                                          .step = 3 * std::ptrdiff_t{grid.rows} * grid.columns,
                                                          .row = 3 * std::ptrdiff_t{grid.columns},
                                                          .column = 3};
    return WindBox(std::move(box));
}

// What turns at 0.2 Hz on 45 m, by the trapezoidal rule around the circle, harmonics up to 16.
double turning_by_sums(const std::function<double(double)>& spectrum,
                       const std::function<double(double, double)>& gamma, double f, int angles) {
    double sum = 0;
    for (int n = -16; n <= 16; ++n) {
        const double shifted = std::abs(f - n * 0.2);
        double harmonic = 0;
        for (int a = 0; a < angles; ++a) {
            const double theta = 2 * pi * a / angles;
            harmonic += gamma(shifted, 45 * std::sqrt(2 - 2 * std::cos(theta))) * std::cos(n * theta);
        }
        sum += spectrum(shifted) * harmonic / angles;
    }
    return sum;
}

constexpr BoxGrid grid{
    .steps = 240, .rows = 5, .columns = 7, .time_step = 0.25, .row_spacing = 30, .column_spacing = 20, .lowest = 30};

}  // namespace

TEST_CASE("spectrum lines: a sine of a whole number of periods is one line that holds A^2/2", "[analytic]") {
    const PowerSpectrum found = power_spectrum(
        spectrum_lines(series_of(240, 0.25, [](double t) { return 7 + 3 * std::sin(2 * pi * 0.2 * t + 0.4); })));
    REQUIRE(found.frequency.size() == 120);
    for (std::size_t k = 0; k < found.frequency.size(); ++k) {
        CHECK(found.frequency[k] == Approx(static_cast<double>(k + 1) / 60).epsilon(1e-14));
        CHECK(found.density[k] * found.step == Approx(k == 11 ? 4.5 : 0).margin(1e-13));  // 0.2 Hz
    }
    CHECK(found.variance() == Approx(4.5).epsilon(1e-13));
}

TEST_CASE("spectrum lines: the sum of a periodic series is its variance, of even and odd lengths", "[property]") {
    for (const int count : {8, 9, 240, 243, 1000, 1001}) {
        const TimeSeries series = noise(static_cast<std::uint32_t>(count), count);
        const PowerSpectrum lines = power_spectrum(spectrum_lines(series));
        CHECK(lines.variance() == Approx(variance_of(series.values)).epsilon(1e-12));
        CHECK(in_bands(lines, 8).variance() == Approx(variance_of(series.values)).epsilon(1e-12));
    }
}

TEST_CASE("spectrum lines: the Hann window keeps the density of noise and the variance of a sine", "[analytic]") {
    // White noise of variance 1/3 has the one-sided density 1/3 over half the sampling rate, 5 Hz.
    const PowerSpectrum white = power_spectrum(spectrum_lines(noise(3, 60000, false)));
    const double mean =
        std::accumulate(white.density.begin(), white.density.end(), 0.0) / static_cast<double>(white.density.size());
    CHECK(mean == Approx(1.0 / 15).epsilon(3 / std::sqrt(30000.0)));  // three standard errors
    // 10.3 periods: the window's lines hold all of the sine but for what is beyond its side lobes.
    const auto sine = [](double t) { return 2 * std::sin(2 * pi * 0.103 * t); };
    CHECK(power_spectrum(spectrum_lines(series_of(1000, 0.1, sine, false))).variance() == Approx(2).epsilon(5e-3));
    // A prime number of values is cut: 1009 to 1008.
    CHECK(spectrum_lines(noise(1, 1009)).amplitudes.size() == 504);
}

TEST_CASE("coherence: 1 of equal series, about 1/sqrt(n) of independent ones, a phase of a delay", "[analytic]") {
    const TimeSeries first = noise(1, 12000);
    // The second one leads by 0.3 s.
    TimeSeries second = first;
    std::rotate(second.values.begin(), second.values.begin() + 3, second.values.end());
    const std::vector<SpectrumLines> lines{spectrum_lines(first), spectrum_lines(first),
                                           spectrum_lines(noise(2, 12000)), spectrum_lines(second)};
    const auto between = [&](std::size_t i, std::size_t j) {
        const SeriesPair pair{i, j};
        return coherence(lines, {&pair, 1}, 8);
    };
    const Coherence equal = between(0, 1), independent = between(0, 2);
    for (const Complex& value : equal.value) CHECK(std::abs(value - 1.0) < 1e-14);
    double squares = 0, count = 0;
    for (std::size_t b = 0; b < independent.value.size(); ++b) {
        if (independent.lines[b] < 20) continue;
        squares += std::norm(independent.value[b]) * independent.lines[b];
        count += 1;
        CHECK(std::norm(independent.value[b]) < 8.0 / independent.lines[b]);  // one in 3000
    }
    CHECK(squares / count == Approx(1).epsilon(3 / std::sqrt(count)));

    // Single lines, as within a band the phase changes.
    const Coherence delayed = [&] {
        const SeriesPair pair{0, 3};
        return coherence(lines, {&pair, 1}, 100000);
    }();
    for (std::size_t b = 0; b < 1000; b += 50)
        CHECK(std::abs(delayed.value[b] - std::polar(1.0, 2 * pi * delayed.frequency[b] * 0.3)) < 1e-9);
}

TEST_CASE("box spectra: points, rows and columns, and the coherence of what is the same across", "[analytic]") {
    const WindBox box =
        box_of(grid, 12, [](double t, double z, double) { return std::sin(2 * pi * t / 10 + z) + 0.1 * z; });
    const TimeSeries v = series_at(box, 1, 2, 5);
    CHECK(v.periodic);
    CHECK(v.values.size() == 240);
    CHECK(v.values[8] == Approx(2 * (std::sin(2 * pi * 0.2 + 90) + 9)).epsilon(1e-6));
    CHECK(grid.row_near(90) == 2);
    CHECK(grid.row_near(1000) == 4);
    CHECK(grid.column_near(0) == 3);
    CHECK(grid.column_near(-49) == 1);
    CHECK(power_spectrum(spectrum_lines(v)).variance() ==
          Approx(box.statistics(2, 5).deviation[1] * box.statistics(2, 5).deviation[1]));

    // Columns that are the same, and of independent noise.
    Random random(1);
    const WindBox alike = box_of(grid, 12, [&, last = 0.0](double, double, double y) mutable {
        if (y < -59) last = uniform(random, -1, 1);
        return last;
    });
    const WindBox apart = box_of(grid, 12, [&](double, double, double) { return uniform(random, -1, 1); });
    for (const Complex& value : coherence_across(alike, 0, 3).value) CHECK(std::abs(value - 1.0) < 1e-6);
    const Coherence none = coherence_across(apart, 2, 3, {.per_decade = 2});
    for (std::size_t b = 0; b < none.value.size(); ++b) {
        CHECK(none.lines[b] % (5 * 4) == 0);                     // pairs
        CHECK(std::norm(none.value[b]) < 10.0 / none.lines[b]);  // of 20 lines or more
    }
    const std::array distances{1, 2};
    CHECK(coherences_across(apart, 0, distances, {.cancelled = [] { return true; }}).empty());
}

TEST_CASE("turning point: a linear shear is 1P exactly, a steady uniform wind nothing", "[analytic]") {
    // 0.02 1/s over the height, 0.01 1/s to the left; P divides the 60 s of the box, steps divide the revolution.
    const WindBox box = box_of(grid, 12, [](double, double z, double y) { return 12 + 0.02 * (z - 90) + 0.01 * y; });
    const TurningPoint point{.hub_height = 90, .radius = 45, .rotor_speed = 2 * pi / 6, .azimuth = 0.3};
    TimeSeries seen = series_at(box, 0, point);
    REQUIRE(seen.values.size() == 240);
    const std::vector<double> expected = series_of(240, 0.25, [](double t) {
                                             const double psi = 0.3 + 2 * pi * t / 6;  // clockwise: right is -y
                                             return 12 + 0.9 * std::cos(psi) - 0.45 * std::sin(psi);
                                         }).values;
    for (std::size_t i = 0; i < 240; ++i) CHECK(seen.values[i] == Approx(expected[i]).epsilon(1e-6));  // float
    seen.periodic = true;
    const PowerSpectrum lines = power_spectrum(spectrum_lines(seen));
    for (std::size_t k = 0; k < lines.density.size(); ++k)
        CHECK(lines.density[k] * lines.step == Approx(k == 9 ? (0.81 + 0.2025) / 2 : 0).margin(1e-6));
    // All azimuths see the same; the window spreads the line over three.
    const PowerSpectrum mean = turning_spectrum(box, 0, point);
    CHECK(mean.variance() == Approx(0.50625).epsilon(1e-5));
    CHECK(mean.density[9] > 1.9 * mean.density[8]);
    CHECK((point.place(0) - Vec3(0, -45 * std::sin(0.3), 90 + 45 * std::cos(0.3))).norm() < 1e-13);
}

TEST_CASE("turning point: without a radius it is the fixed point", "[property]") {
    Random random(4);
    const WindBox box = box_of(grid, 12, [&](double, double, double) { return uniform(random, -1, 1); });
    const TimeSeries fixed = series_at(box, 2, 2, 3), seen = series_at(box, 2, {90, 0, 1.3, 0});
    for (std::size_t i = 0; i < fixed.values.size(); ++i)
        CHECK(seen.values[i] == Approx(fixed.values[i]).margin(1e-12));
}

TEST_CASE("turning spectrum: another implementation's numbers, and limits in closed form", "[discrete]") {
    const Kaimal model{.speed = 12,
                       .deviation = Vec3(2, 1, 1),
                       .length = Vec3(340.2, 340.2, 340.2),
                       .coherence_length = 340.2,
                       .decay = 12};
    const auto spectrum = [&](double f) { return f > 2 ? 0 : model.spectrum(0, f); };
    const auto gamma = [&](double f, double d) { return model.coherence(f, d); };
    const turbines::CsvTable rows =
        turbines::CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/data/wind/turning_spectrum.csv");
    REQUIRE(rows.rows() == 21);
    for (std::size_t i = 0; i < rows.rows(); ++i) {
        const double f = rows.column("frequency")[i];
        CAPTURE(f);
        CHECK(spectrum(f) == Approx(rows.column("fixed")[i]).epsilon(1e-6));
        // The table's sum over the circle had 128 angles, by which it aliases.
        CHECK(turning_by_sums(spectrum, gamma, f, 128) == Approx(rows.column("turning")[i]).epsilon(1e-6));
        CHECK(turning_spectrum(spectrum, gamma, 45, 2 * pi * 0.2, f, 16) ==
              Approx(turning_by_sums(spectrum, gamma, f, 1 << 13)).epsilon(1e-4));
    }
    // Fully coherent: the fixed point's. A coherence cos^2(theta/2): half stays, a quarter moves by P to both sides.
    const auto all = [](double, double) { return 1.0; };
    CHECK(turning_spectrum(spectrum, all, 45, 1.3, 0.37) == Approx(spectrum(0.37)).epsilon(1e-12));
    const auto half = [](double, double d) { return 1 - d * d / (4 * 45 * 45); };
    CHECK(turning_spectrum(spectrum, half, 45, 2 * pi * 0.2, 0.37) ==
          Approx(spectrum(0.37) / 2 + spectrum(0.17) / 4 + spectrum(0.57) / 4).epsilon(1e-12));
}

TEST_CASE("box spectra: bad input is refused with place and limit", "[property]") {
    const WindBox box = box_of(grid, 12, [](double t, double, double) { return t; });
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<SpectrumLines> lines{spectrum_lines(noise(1, 20)), spectrum_lines(noise(1, 30))};
    const auto with = [&](std::size_t i, std::size_t j) {
        const SeriesPair pair{i, j};
        return coherence(lines, {&pair, 1}, 8);
    };
    check_refused([&] { spectrum_lines({{1, 2, 3}, 0.1}); }, {"number of values = 3", "at least 8"});
    check_refused([&] { spectrum_lines({std::vector<double>(9), 0}); }, {"step [s] = 0", "> 0"});
    check_refused([&] { spectrum_lines({std::vector<double>(9, nan), 1}); }, {"value = nan", "finite"});
    check_refused([&] { in_bands(power_spectrum(lines[0]), 0); }, {"number per decade = 0"});
    check_refused([&] { mean_spectrum({}); }, {"number of spectra = 0"});
    check_refused([&] { with(0, 1); }, {"number of lines = 15", "10, as the others"});
    check_refused([&] { with(0, 2); }, {"number of a series = 2", "below 2"});
    check_refused([&] { coherence(lines, {}, 8); }, {"number of pairs = 0"});
    check_refused([&] { series_at(box, 3, 0, 0); }, {"component = 3", "0 ... 2"});
    check_refused([&] { series_at(box, 0, 5, 0); }, {"row = 5", "0 ... 4"});
    check_refused([&] { series_at(box, 0, 0, -1); }, {"column = -1", "0 ... 6"});
    check_refused([&] { coherence_across(box, 0, 7); }, {"columns apart = 7", "1 ... 6"});
    check_refused([&] { coherence_across(box, 0, 1, {.rows = 0}); }, {"number of rows = 0"});
    check_refused([&] { series_at(box, 0, {90, 70, 1, 0}); }, {"height [m] = 160", "30 ... 150"});
    check_refused([&] { series_at(box, 0, {90, -1, 1, 0}); }, {"radius [m] = -1"});
    check_refused([&] { series_at(box, 0, {90, 1, nan, 0}); }, {"rotor speed [rad/s] = nan"});
    check_refused([&] { turning_spectrum(box, 0, {90, 1, 1, 0}, 0); }, {"number of azimuths = 0"});
    const auto one = [](double) { return 1.0; };
    const auto all = [](double, double) { return 1.0; };
    check_refused([&] { turning_spectrum(one, all, 0, 1, 1); }, {"radius [m] = 0"});
    check_refused([&] { turning_spectrum(one, all, 1, 0, 1); }, {"rotor speed [rad/s] = 0"});
    check_refused([&] { turning_spectrum(one, all, 1, 1, 0); }, {"frequency [Hz] = 0"});
    check_refused([&] { turning_spectrum(one, all, 1, 1, 1, 121); }, {"harmonics = 121", "0 ... 120"});
}

}  // namespace cardan::testing::box_spectra_tests
