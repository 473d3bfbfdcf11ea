#include "mbs/base/types.hpp"
#include "solvers/algebra/fft.hpp"
#include "solvers/signals/spectrum.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>
#include <complex>
#include <numeric>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

using Complex = std::complex<double>;
constexpr Complex i1{0, 1};

struct Samples {
    std::vector<double> time, values;
};

template <class Value>
Samples sampled(std::size_t n, double step, const Value& value, double start = 0) {
    Samples s;
    for (std::size_t j = 0; j < n; ++j) {
        s.time.push_back(start + static_cast<double>(j) * step);
        s.values.push_back(value(s.time.back()));
    }
    return s;
}

SpectrumOptions with(Window window, Detrend detrend = Detrend::none) {
    SpectrumOptions options;
    options.window = window;
    options.detrend = detrend;
    return options;
}

// sum_j exp(2 pi i j x/n) in closed form.
Complex dirichlet(double x, double n) {
    if (std::abs(x - n * std::round(x / n)) < 1e-12) return n;
    return std::exp(i1 * pi * x * (n - 1) / n) * std::sin(pi * x) / std::sin(pi * x / n);
}

// Transform of the Hann window 1/2 - 1/4 exp(i a) - 1/4 exp(-i a) at -x.
Complex hann(double x, double n) {
    return dirichlet(x, n) / 2.0 - dirichlet(x - 1, n) / 4.0 - dirichlet(x + 1, n) / 4.0;
}

double mean_square(const std::vector<double>& values) {
    return std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

TEST_CASE("fourier: transforms of any length are the sums they stand for", "[analytic]") {
    Random random(11);
    for (std::size_t n : {1, 2, 3, 4, 5, 8, 30, 31, 97, 101, 127, 202, 211, 360, 509, 1009, 2 * 1009, 1024}) {
        std::vector<double> x(n);
        for (double& value : x) value = uniform(random, -1, 1);
        RealFourier fourier(n);
        std::vector<Complex> X(fourier.frequencies());
        for (int repeat = 0; repeat < 2; ++repeat) fourier.transform(x, X);  // nothing is left over from the first
        double error = 0;
        for (std::size_t k = 0; k < X.size(); ++k) {
            Complex sum = 0;
            for (std::size_t j = 0; j < n; ++j)
                sum += x[j] * std::polar(1.0, -2 * pi * static_cast<double>(j * k % n) / static_cast<double>(n));
            error = std::max(error, std::abs(X[k] - sum));
        }
        CAPTURE(n, error);
        CHECK(X.size() == n / 2 + 1);
        CHECK(error < 1e-14 * static_cast<double>(n) + 1e-15);
    }
    check_refused([] { RealFourier(0); }, {"Fourier transform", "length = 0", "1 to 268435456"});
}

TEST_CASE("fourier: a prime number of samples takes no n^2 operations and loses no digits", "[analytic]") {
    constexpr std::size_t n = 100003;  // with n^2 operations this would take half a minute
    RealFourier fourier(n);
    std::vector<double> x(n);
    for (std::size_t j = 0; j < n; ++j)
        x[j] = std::cos(2 * pi * static_cast<double>(j * 12347 % n) / static_cast<double>(n) + 0.5);
    std::vector<Complex> X(fourier.frequencies());
    fourier.transform(x, X);
    CHECK(std::abs(X[12347] - std::polar(0.5 * n, 0.5)) < 1e-12 * n);
    X[12347] = 0;
    double rest = 0;
    for (const Complex& value : X) rest = std::max(rest, std::abs(value));
    CHECK(rest < 1e-12 * n);
}

TEST_CASE("spectrum: a sinusoid of whole periods reads its amplitude, whatever the window and the phase",
          "[analytic]") {
    for (Window window : {Window::rectangular, Window::hann, Window::flat_top})
        for (double phase : {0.0, 0.7, 2.5}) {
            const auto s = sampled(
                500, 0.02, [&](double t) { return 3.5 * std::cos(2 * pi * 2.0 * t + phase); }, -3.0);
            const Spectrum result = spectrum(s.time, s.values, with(window));
            CHECK(result.step == Approx(0.1).epsilon(1e-12));
            CHECK(result.segments == 1);
            REQUIRE(result.frequency.size() == 251);
            CHECK(result.frequency[20] == Approx(2.0).epsilon(1e-12));
            CHECK(result.frequency.back() == Approx(25.0).epsilon(1e-12));
            CHECK(result.amplitude[20] == Approx(3.5).epsilon(1e-12));
            const std::size_t reach = window == Window::rectangular ? 1 : window == Window::hann ? 2 : 5;
            for (std::size_t k = 0; k < result.amplitude.size(); ++k)
                if (k + reach <= 20 || k >= 20 + reach) CHECK(result.amplitude[k] < 1e-12);
            const double power = result.variance();
            CHECK(power == Approx(3.5 * 3.5 / 2).epsilon(1e-12));
            CHECK(std::pow(result.amplitude[20], 2) / 2 ==
                  Approx(result.density[20] * result.noise_bandwidth).epsilon(1e-12));
        }
}

TEST_CASE("spectrum: frequency zero and half the sampling frequency have no partner to be added", "[analytic]") {
    for (Window window : {Window::rectangular, Window::hann, Window::flat_top}) {
        const auto s = sampled(64, 0.5, [](double t) { return 2.0 + 0.25 * std::cos(2 * pi * t); });
        const Spectrum result = spectrum(s.time, s.values, with(window));
        CHECK(result.amplitude.front() == Approx(2.0).epsilon(1e-12));
        CHECK(result.amplitude.back() == Approx(0.25).epsilon(1e-12));
    }
}

TEST_CASE("spectrum: between its frequencies a sinusoid reads as the transform of the window says", "[analytic]") {
    constexpr double n = 240, amplitude = 1.7, phase = 0.4;
    for (double cycles : {20.5, 31.25, 77.9}) {
        const auto s =
            sampled(240, 0.1, [&](double t) { return amplitude * std::cos(2 * pi * cycles / (n * 0.1) * t + phase); });
        const Spectrum plain = spectrum(s.time, s.values, with(Window::rectangular));
        const Spectrum smooth = spectrum(s.time, s.values, with(Window::hann));
        for (std::size_t k = 1; k < 120; ++k) {
            const auto x = static_cast<double>(k);
            const Complex plus = std::polar(amplitude / 2, phase), minus = std::conj(plus);
            const Complex rectangular = plus * dirichlet(cycles - x, n) + minus * dirichlet(-cycles - x, n);
            const Complex windowed = plus * hann(cycles - x, n) + minus * hann(-cycles - x, n);
            CHECK(plain.amplitude[k] == Approx(2 * std::abs(rectangular) / n).margin(1e-12));
            CHECK(smooth.amplitude[k] == Approx(2 * std::abs(windowed) / (n / 2)).margin(1e-12));
        }
    }
}

TEST_CASE("spectrum: the density integrates to the mean square of the windowed samples", "[property]") {
    Random random(5);
    for (std::size_t n : {499, 500}) {
        const auto s = sampled(n, 0.01, [&](double) { return uniform(random, -1, 1); });
        CHECK(spectrum(s.time, s.values, with(Window::rectangular)).variance() ==
              Approx(mean_square(s.values)).epsilon(1e-12));
        std::vector<double> centred = s.values;
        const double mean = std::accumulate(centred.begin(), centred.end(), 0.0) / static_cast<double>(n);
        for (double& value : centred) value -= mean;
        CHECK(spectrum(s.time, s.values, with(Window::rectangular, Detrend::mean)).variance() ==
              Approx(mean_square(centred)).epsilon(1e-12));
        double weighted = 0, weights = 0;
        for (std::size_t j = 0; j < n; ++j) {
            const double w = std::pow(std::sin(pi * static_cast<double>(j) / static_cast<double>(n)), 2);
            weighted += std::pow(w * s.values[j], 2);
            weights += w * w;
        }
        CHECK(spectrum(s.time, s.values, with(Window::hann)).variance() == Approx(weighted / weights).epsilon(1e-12));
    }
}

// Uniform numbers of variance 1: density 2/(sampling frequency). Scatter of the estimate with K segments that overlap
// by half, Hann window: (1 + 2/36 (K - 1)/K)/K of the density squared [Welch 1967]; neighbouring frequencies correlate
// by 4/9 and 1/36 in power, from the transform of the window. The variance of squares of these numbers is 0.8. Limits:
// four standard deviations, with a fixed seed.
TEST_CASE("spectrum: white noise has the density of its variance, with the scatter that Welch gives", "[analytic]") {
    Random random(2024);
    const auto s = sampled(65536, 0.01, [&](double) { return uniform(random, -std::sqrt(3), std::sqrt(3)); });
    SpectrumOptions options;
    options.segment = 2.56;
    const Spectrum noise = spectrum(s.time, s.values, options);
    CHECK(noise.segments == 511);
    // Less the mean of 256 samples; the overlapping squares of the window weigh the samples unevenly by 1 + 1/18.
    CHECK(noise.variance() == Approx(1 - 1.0 / 256).margin(4 * std::sqrt(0.8 / 65536 * (1 + 1.0 / 18))));
    const std::size_t first = 2, last = 128;  // without those that the mean and the end change
    double mean = 0, square = 0;
    for (std::size_t k = first; k < last; ++k) mean += noise.density[k] / (last - first);
    for (std::size_t k = first; k < last; ++k) square += std::pow(noise.density[k] / mean - 1, 2) / (last - first - 1);
    const double scatter = (1 + 2.0 / 36) / 511, neighbours = 1 + 2 * (4.0 / 9 + 1.0 / 36);
    CAPTURE(mean, square, scatter);
    CHECK(mean == Approx(0.02).epsilon(4 * std::sqrt(scatter * neighbours / (last - first))));
    const double squared_neighbours = 1 + 2 * (16.0 / 81 + 1.0 / 1296);
    CHECK(square == Approx(scatter).epsilon(4 * std::sqrt(2 * squared_neighbours / (last - first))));
    CHECK(noise.variance(10, 30) == Approx(51 * noise.step * 0.02).epsilon(4 * std::sqrt(scatter * neighbours / 51)));
}

// sum w^2 n/(sum w)^2 = (a_0^2 + sum a_m^2/2)/a_0^2 from the coefficients of the windows.
TEST_CASE("spectrum: the noise bandwidth is that of the window", "[analytic]") {
    const auto s = sampled(400, 0.25, [](double t) { return std::sin(t); });
    const auto steps = [&](Window window) {
        const Spectrum result = spectrum(s.time, s.values, with(window));
        return result.noise_bandwidth / result.step;
    };
    CHECK(steps(Window::rectangular) == Approx(1).epsilon(1e-12));
    CHECK(steps(Window::hann) == Approx(1.5).epsilon(1e-12));
    const double a0 = 0.21557895, a1 = 0.41663158, a2 = 0.277263158, a3 = 0.083578947, a4 = 0.006947368;
    CHECK(steps(Window::flat_top) ==
          Approx(1 + (a1 * a1 + a2 * a2 + a3 * a3 + a4 * a4) / (2 * a0 * a0)).epsilon(1e-12));
}

TEST_CASE("spectrum: means and lines are taken out where asked for", "[analytic]") {
    const auto line = sampled(128, 0.125, [](double t) { return 5.0 - 0.75 * t; });
    const Spectrum left = spectrum(line.time, line.values, with(Window::hann, Detrend::linear));
    CHECK(std::sqrt(left.variance()) < 1e-13);
    const auto constant = sampled(128, 0.125, [](double) { return 5.0; });
    CHECK(spectrum(constant.time, constant.values, with(Window::hann, Detrend::mean)).variance() == 0);
    CHECK(spectrum(constant.time, constant.values, with(Window::hann)).amplitude[0] == Approx(5).epsilon(1e-12));
    CHECK(spectrum(line.time, line.values, with(Window::hann, Detrend::mean)).variance() > 1);
}

TEST_CASE("spectrum: segments overlap, average and keep to the part of the history asked for", "[property]") {
    // 4 Hz until 30 s, 6 Hz after; both have whole periods in each segment of 5 s.
    const auto s = sampled(6001, 0.01, [](double t) { return std::sin(2 * pi * (t < 29.995 ? 4 : 6) * t); });
    SpectrumOptions options;
    options.segment = 5;
    CHECK(spectrum(s.time, s.values, options).segments == 23);
    options.overlap = 0;
    const Spectrum both = spectrum(s.time, s.values, options);
    CHECK(both.segments == 12);
    CHECK(both.amplitude[20] == Approx(std::sqrt(0.5)).epsilon(1e-9));  // quadratic mean
    CHECK(both.amplitude[30] == Approx(std::sqrt(0.5)).epsilon(1e-9));
    options.overlap = 0.75;
    options.from = 30;
    const Spectrum late = spectrum(s.time, s.values, options);
    CHECK(late.segments == 21);
    CHECK(late.amplitude[20] < 1e-12);
    CHECK(late.amplitude[30] == Approx(1).epsilon(1e-9));
    options.to = 36;
    CHECK(spectrum(s.time, s.values, options).segments == 1);
}

// The Hann window leaves sinc(d)/(1 - d^2) of the amplitude of a long sinusoid, d steps away from its frequency.
TEST_CASE("peaks: parabolas find frequency and amplitude with the known bias of the Hann window", "[analytic]") {
    const auto lobe = [](double d) {
        if (std::abs(d) < 1e-12) return 1.0;
        if (std::abs(std::abs(d) - 1) < 1e-12) return 0.5;
        return std::abs(std::sin(pi * d) / (pi * d) / (1 - d * d));
    };
    double frequency_bias = 0, amplitude_bias = 0;
    for (int i = -25; i < 25; ++i) {
        const double d = 0.02 * i;
        const double cycles = 2000 + d;
        const auto s = sampled(8192, 1.0 / 64, [&](double t) { return 2 * std::sin(2 * pi * cycles / 128 * t); });
        const std::vector<Peak> found = peaks(spectrum(s.time, s.values));
        REQUIRE(!found.empty());
        const double a = std::log(lobe(d + 1)), b = std::log(lobe(d)), c = std::log(lobe(d - 1));
        const double offset = (a - c) / (2 * (a - 2 * b + c));
        CHECK(found[0].frequency * 128 - 2000 == Approx(offset).margin(2e-6));
        CHECK(found[0].amplitude == Approx(2 * std::exp(b - (a - c) * offset / 4)).epsilon(2e-6));
        frequency_bias = std::max(frequency_bias, std::abs(offset - d));
        amplitude_bias = std::max(amplitude_bias, std::abs(found[0].amplitude / 2 - 1));
        CHECK(found[0].amplitude / 2 > 1 - 1e-6);
    }
    CAPTURE(frequency_bias, amplitude_bias);
    CHECK(frequency_bias == Approx(0.0155).margin(0.0005));
    CHECK(amplitude_bias == Approx(0.038).margin(0.001));
}

TEST_CASE("peaks: with the flat-top window amplitudes hold within 0.2 percent anywhere", "[analytic]") {
    for (int i = -10; i <= 10; ++i) {
        const double d = 0.05 * i;
        const auto s = sampled(4096, 1.0 / 64, [&](double t) { return 2 * std::sin(2 * pi * (1000 + d) / 64 * t); });
        SpectrumOptions options;
        options.window = Window::flat_top;
        CHECK(spectrum(s.time, s.values, options).amplitude[1000] == Approx(2).epsilon(0.002));
    }
}

TEST_CASE("peaks: the largest come first, side lobes and rounding do not come", "[analytic]") {
    const auto s = sampled(4000, 0.01, [](double t) {
        return 0.4 * std::sin(2 * pi * 3 * t) + 1.5 * std::cos(2 * pi * 7.5 * t) + 0.1 * std::sin(2 * pi * 20.012 * t);
    });
    const Spectrum result = spectrum(s.time, s.values);
    std::vector<Peak> found = peaks(result);
    REQUIRE(found.size() == 3);
    CHECK(found[0].frequency == Approx(7.5).epsilon(1e-9));
    CHECK(found[0].amplitude == Approx(1.5).epsilon(1e-9));
    CHECK(found[1].frequency == Approx(3).epsilon(1e-9));
    CHECK(found[2].frequency == Approx(20.012).margin(0.016 * result.step));
    CHECK(peaks(result, 2).size() == 2);
    CHECK(peaks(result, 10, 0.5).size() == 1);
    CHECK(peaks(result, 0).empty());
    const std::vector<Peak> plain = peaks(spectrum(s.time, s.values, with(Window::rectangular)), 1);
    CHECK(plain[0].frequency == Approx(7.5).epsilon(1e-5));
    const auto silence = sampled(64, 1, [](double) { return 0.0; });
    CHECK(peaks(spectrum(silence.time, silence.values)).empty());
    check_refused([&] { (void)peaks(result, 3, -0.1); }, {"threshold = -0.1", "0 <= threshold <= 1"});
}

TEST_CASE("spectrum: bad input is refused with place, value and limit", "[property]") {
    auto s = sampled(101, 0.1, [](double t) { return t; });
    const auto refused = [&](const SpectrumOptions& options, std::initializer_list<std::string> parts) {
        check_refused([&] { (void)spectrum(s.time, s.values, options); }, parts);
    };
    SpectrumOptions options;
    options.overlap = 1;
    refused(options, {"overlap = 1", "0 <= overlap < 1"});
    options.overlap = 0.5;
    options.segment = -1;
    refused(options, {"segment [s] = -1", ">= 0"});
    options.segment = 0.7;
    refused(options, {"segment [s] = 0.7", "0.8 (8 samples) to 10.1 (all samples)"});
    options.segment = 11;
    refused(options, {"segment [s] = 11"});
    options.segment = 0;
    options.from = 9.95;
    refused(options, {"from, to [s] = 9.95, inf", "two samples at least between 0 and 10"});
    options.from = std::numeric_limits<double>::quiet_NaN();
    refused(options, {"time history: from [s] = nan", "infinite: no limit"});
    options.from = 0;
    options.to = std::numeric_limits<double>::quiet_NaN();
    refused(options, {"time history: to [s] = nan", "infinite: no limit"});
    s.values[50] = std::numeric_limits<double>::quiet_NaN();
    refused({}, {"value at 5 s = nan", "finite"});
    s.values.pop_back();
    refused({}, {"number of values = 100", "101"});
    s = sampled(101, 0.1, [](double t) { return t; });
    s.time[40] += 0.0005;
    refused({}, {"equal steps at 4.0005 s = 0.005 of a step", "resample()"});
    s.time[40] = s.time[39];
    refused({}, {"time of sample 40 = 3.9", "> 3.9"});

    History history{"run", {{"a", "m", "a"}}, {0, 1}, {{1, 2}}};
    check_refused([&] { (void)spectrum(history, "b"); }, {"history 'run'", "'b'", "'a'"});
    check_refused([&] { (void)spectrum(history, "a"); }, {"channel 'a': spectrum: number of samples"});
}
