// Response of the NREL 5 MW blade to gravity and to a pitching platform, by integration in time. Reference: converged
// response of the same blade by a method that shares nothing with the joint chain [docs/nrel5mw_platform.md].
#include "mbs/base/units.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/support/catch.hpp"
#include "turbines/reference_turbines/nrel5mw_platform.hpp"

#include <algorithm>
#include <numeric>

namespace cardan::testing::platform_response {

using namespace solvers;
using turbines::Turbine;

namespace {

using units::degree;
constexpr double rotor_speed = 12.1 * units::rpm, revolution = units::minute / 12.1;

Turbine machine(int elements, double gravity = units::standard_gravity) {
    turbines::Nrel5mwPlatformOptions options;
    options.gravity = Vec3(0, 0, -gravity);
    options.elements = turbines::nrel5mw_platform_elements(elements);
    return turbines::nrel5mw_on_platform(turbines::nrel5mw_platform_blade(), options);
}

struct Harmonic {
    int k;
    double amplitude, phase;  // m or N m; deg, of the cosine
};
struct Signal {
    const char* channel;
    double mean, max, min;
    std::vector<Harmonic> harmonics;
};

// Phases of -360 are not known.
const std::vector<Signal> signals_at_rest{
    {"blade 1 tip flap deflection", 0.4004, 0.4892, 0.3101, {{1, 0.08952, -112.9}, {2, 0.00158, -360}}},
    {"blade 1 tip edge deflection", 0.05080, 0.4951, -0.3934, {{1, 0.4443, -91.21}, {2, 0.00190, -360}}},
    {"blade 1 root My", 1084e3, 1217e3, 950.6e3, {{1, 133.2e3, 179.9}}},
    {"blade 1 root Mz", -5.71e3, 3614e3, -3626e3, {{1, 3620e3, 89.56}}}};
const std::vector<Signal> pitching{
    {"blade 1 tip flap deflection",
     0.3985,
     1.309,
     -0.5369,
     {{1, 0.6380, 89.69}, {2, 0.08881, -114.3}, {3, 0.4941, 89.85}, {5, 0.0112, -360}}},
    {"blade 1 tip edge deflection",
     0.05100,
     0.5349,
     -0.4676,
     {{1, 0.05079, 74.65}, {2, 0.4369, -91.22}, {3, 0.04199, 106.1}}},
    {"blade 1 root My", 1078e3, 3348e3, -1257e3, {{1, 1987e3, 89.93}, {2, 138.1e3, 179.9}, {3, 1180e3, 89.76}}},
    {"blade 1 root Mz", -5.89e3, 3721e3, -3714e3, {{1, 107.7e3, -179.8}, {2, 3559e3, 89.56}, {3, 100.9e3, -9.3}}}};

// Motion from the undeformed blade; the rotor turns, and more coordinates may be driven.
struct Run {
    Turbine machine;
    Integrator integrator;
    Recorder recorder;
    Run(Turbine on, const std::vector<std::pair<BaseCoordinate, Motion>>& motions, double tolerance)
        : machine(std::move(on)),
          integrator(machine.system(), drives(motions), 0, Vector::Zero(machine.system().model.size()),
                     Vector::Zero(machine.system().model.size()), options(tolerance)),
          recorder(integrator, {turbines::blade_channels(machine)}, channels_only()) {}

    History record(double from, double to, int samples) {
        History history;
        REQUIRE(
            solvers::record(integrator, recorder, sample_times(from, to, (to - from) / samples), history).reached());
        return history;
    }

private:
    std::vector<Drive> drives(const std::vector<std::pair<BaseCoordinate, Motion>>& motions) const {
        const Model& model = machine.system().model;
        std::vector<Drive> all{{model.index(*machine.layout().generator), Motion::constant_rate(0, rotor_speed)}};
        for (const auto& [which, motion] : motions)
            all.push_back({model.index(machine.layout().platform->coordinate(which)), motion});
        return all;
    }
    // BDF of second order: higher ones keep weakly damped modes ringing.
    static IntegrationOptions options(double t) {
        IntegrationOptions options;
        options.method = Method::bdf;
        options.max_order = 2;
        options.tolerances = {t, t / 100, t / 100, t / 10, t / 10};
        options.integrate_work = false;
        return options;
    }
    static RecorderOptions channels_only() {
        RecorderOptions options;
        options.coordinates = options.rates = options.actuators = options.energies = options.statistics = false;
        return options;
    }
};

double mean(const std::vector<double>& y) {
    return std::accumulate(y.begin(), y.end() - 1, 0.0) / static_cast<double>(y.size() - 1);
}

// Fourier coefficient of a period.
Harmonic harmonic(const std::vector<double>& y, int k) {
    const std::size_t n = y.size() - 1;
    Complex sum = 0;
    for (std::size_t i = 0; i < n; ++i)
        sum += y[i] *
               std::polar(2.0 / static_cast<double>(n), -2 * pi * k * static_cast<double>(i) / static_cast<double>(n));
    return {k, std::abs(sum), std::arg(sum) / degree};
}

// What is asked of the errors: relative, and 0.05 mm more for the tip; of phases in degrees; of which harmonics.
struct Allowed {
    double tip, root, phase;
    double smallest = 0;  // harmonic of the tip that counts, m
};

void check_signals(const History& period, const std::vector<Signal>& reference, const Allowed& allowed) {
    for (const Signal& exact : reference) {
        const std::vector<double>& y = period[exact.channel];
        const bool tip = period.channels[period.index(exact.channel)].units == "m";
        const auto check = [&](const char* what, double value, double expected) {
            CAPTURE(exact.channel, what, value, expected, value / expected - 1);
            CHECK(std::abs(value - expected) <
                  (tip ? allowed.tip : allowed.root) * std::abs(expected) + (tip ? 5e-5 : 0));
        };
        check("mean", mean(y), exact.mean);
        check("max", *std::max_element(y.begin(), y.end()), exact.max);
        check("min", *std::min_element(y.begin(), y.end()), exact.min);
        for (const Harmonic& h : exact.harmonics) {
            if (tip && h.amplitude < allowed.smallest) continue;
            const Harmonic found = harmonic(y, h.k);
            CAPTURE(h.k);
            check("amplitude", found.amplitude, h.amplitude);
            if (h.phase == -360) continue;
            CAPTURE(exact.channel, found.phase, h.phase);
            CHECK(std::abs(std::remainder(found.phase - h.phase, 360)) < allowed.phase);
        }
    }
}

History last_period(int elements, bool pitch, int periods, double tolerance) {
    std::vector<std::pair<BaseCoordinate, Motion>> motions;
    const double T = pitch ? 2 * revolution : revolution;
    if (pitch) motions.emplace_back(BaseCoordinate::pitch, Motion::harmonic(0, 5 * degree, T));
    Run run(machine(elements), motions, tolerance);
    REQUIRE(run.integrator.advance((periods - 1) * T).reached());
    return run.record((periods - 1) * T, periods * T, 720);
}

}  // namespace

TEST_CASE("platform: with 4 elements the response is the reference to 1.5 % at the tip, 0.2 % at the root",
          "[analytic]") {
    // The second flap frequency is 9 % low with 4 elements: the fifth harmonic, 0.0112 m, is 5 % high.
    check_signals(last_period(4, true, 40, 1e-6), pitching, {0.015, 0.002, 0.35, 0.02});
}

TEST_CASE("platform: with 16 elements the response is the reference to its own accuracy, 0.05 % or 0.05 mm",
          "[analytic][slow]") {
    check_signals(last_period(16, false, 130, 3e-7), signals_at_rest, {5e-4, 5e-4, 0.06});
    check_signals(last_period(16, true, 70, 3e-7), pitching, {5e-4, 5e-4, 0.06});
}

TEST_CASE("platform: a steady velocity of surge, sway or heave leaves the response as it is", "[property]") {
    const double T = revolution / 2;
    Run still(machine(3), {}, 1e-8);
    const History without = still.record(0, T, 20);
    for (const BaseCoordinate which : {BaseCoordinate::surge, BaseCoordinate::sway, BaseCoordinate::heave}) {
        Run moving(machine(3), {{which, Motion::constant_rate(5, 1)}}, 1e-8);
        const History with = moving.record(0, T, 20);
        REQUIRE(with.channels.size() == without.channels.size());
        for (std::size_t c = 0; c < with.channels.size(); ++c) {
            double difference = 0, size = 0;
            for (std::size_t i = 0; i < with.time.size(); ++i) {
                difference = std::max(difference, std::abs(with.values[c][i] - without.values[c][i]));
                size = std::max(size, std::abs(without.values[c][i]));
            }
            CAPTURE(with.channels[c].name, difference, size);
            CHECK(difference < 1e-9 * size);
        }
    }
}

TEST_CASE("platform: on a base that falls freely the blade does not feel its weight", "[property]") {
    const double T = revolution / 2, g = units::standard_gravity;
    const Motion fall = Motion::function([=](double t) { return MotionState{-g * t * t / 2, -g * t, -g}; });
    Run falling(machine(3), {{BaseCoordinate::heave, fall}}, 1e-8), weightless(machine(3, 0), {}, 1e-8);
    const History a = falling.record(0, T, 20), b = weightless.record(0, T, 20);
    for (const char* channel : {"blade 1 tip flap deflection", "blade 1 tip edge deflection"})
        for (std::size_t i = 0; i < a.time.size(); ++i) CHECK(std::abs(a[channel][i] - b[channel][i]) < 1e-9);
}

}  // namespace cardan::testing::platform_response
