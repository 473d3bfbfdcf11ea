#include "examples/studies/nrel5mw_platform/reference.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <utility>

namespace cardan::platform {

namespace {

constexpr int highest = 5;  // harmonic of the references

// What the reference is good for, and the goal: 0.5 % and 1 deg of every harmonic above 0.01 m. Smaller ones, and the
// harmonics of moments below 1 % of the largest one, are shown only.
constexpr double goal = 0.005, goal_phase = 1, resolution = 5e-5;  // relative, deg, m

bool is_length(std::size_t signal) {
    return signal < 2;
}

bool counts(const ReferenceSignal& r, const ReferenceHarmonic& h, bool length) {
    return h.amplitude >= (length ? 0.01 : 0.01 * r.largest_amplitude());
}

// Error over what is allowed.
double used_up(double computed, double reference, bool length) {
    return std::abs(computed - reference) / (goal * std::abs(reference) + (length ? resolution : 0));
}

double difference(double degrees, double from) {
    return std::remainder(degrees - from, 360);
}

class Table {
public:
    explicit Table(int count) : count_(count) {}

    void heading() const {
        std::cout << std::left << std::setw(22) << "" << std::right << std::setw(10) << "mean" << std::setw(10) << "max"
                  << std::setw(10) << "min";
        for (int k = 1; k <= count_; ++k) std::cout << std::setw(10) << text("A", k) << std::setw(11) << "(phase)";
        std::cout << "\n";
    }
    void computed(const char* name, const Harmonics& h, double unit) const {
        row(name);
        for (double value : {h.mean, h.max, h.min}) number(value / unit, 10);
        for (int k = 0; k < count_; ++k) {
            number(entry(h.amplitude, k) / unit, 10);
            angle(entry(h.phase, k) * units::to_degrees);
        }
        std::cout << "\n";
    }
    void reference(const ReferenceSignal& r) const {
        row("  reference");
        for (double value : {r.mean, r.max, r.min}) number(value, 10);
        each(r, [&](const ReferenceHarmonic& h) {
            number(h.amplitude, 10);
            angle(h.phase);
        });
    }
    void errors(const ReferenceSignal& r, const Harmonics& h, double unit) const {
        row("  error, % (deg)");
        for (auto [value, exact] : {std::pair(h.mean, r.mean), std::pair(h.max, r.max), std::pair(h.min, r.min)})
            percent(value / unit / exact - 1, 10);
        each(r, [&](const ReferenceHarmonic& exact) {
            percent(entry(h.amplitude, exact.k - 1) / unit / exact.amplitude - 1, 10);
            angle(difference(entry(h.phase, exact.k - 1) * units::to_degrees, exact.phase));
        });
    }

private:
    static void row(const char* name) { std::cout << std::left << std::setw(22) << name << std::right; }
    static void number(double value, int width) {
        std::cout << std::defaultfloat << std::setprecision(4) << std::setw(width) << value;
    }
    static void percent(double value, int width) {
        std::cout << std::fixed << std::setprecision(2) << std::showpos << std::setw(width) << 100 * value
                  << std::noshowpos;
    }
    static void angle(double degrees) {
        std::ostringstream out = text_stream();
        if (std::isfinite(degrees)) out << "(" << std::fixed << std::setprecision(2) << degrees << ")";
        std::cout << std::setw(11) << out.str();
    }
    template <class Show>
    void each(const ReferenceSignal& r, Show&& show) const {
        for (int k = 1; k <= count_; ++k) {
            if (const ReferenceHarmonic* known = r.harmonic(k))
                show(*known);
            else
                std::cout << std::setw(21) << "";
        }
        std::cout << "\n";
    }
    int count_;
};

// The worst of what counts.
double worst(const ReferenceSignal& r, const Harmonics& h, double unit, bool length) {
    double used = 0;
    for (auto [value, exact] : {std::pair(h.mean, r.mean), std::pair(h.max, r.max), std::pair(h.min, r.min)})
        used = std::max(used, used_up(value / unit, exact, length));
    for (const ReferenceHarmonic& exact : r.harmonics) {
        if (!counts(r, exact, length)) continue;
        used = std::max(used, used_up(entry(h.amplitude, exact.k - 1) / unit, exact.amplitude, length));
        if (std::isfinite(exact.phase))
            used = std::max(
                used, std::abs(difference(entry(h.phase, exact.k - 1) * units::to_degrees, exact.phase)) / goal_phase);
    }
    return used;
}

}  // namespace

double print_signals(const solvers::History& period, int count, const ReferenceCase* reference) {
    const Table table(count);
    table.heading();
    double used = 0;
    for (std::size_t i = 0; i < signals; ++i) {
        const SignalName& signal = signal_names.at(i);
        const Harmonics h = harmonics(period[signal.channel], std::max(count, highest));
        table.computed(signal.name, h, signal.unit);
        if (!reference) continue;
        const ReferenceSignal& exact = reference->by_signal.at(i);
        table.reference(exact);
        table.errors(exact, h, signal.unit);
        used = std::max(used, worst(exact, h, signal.unit, is_length(i)));
    }
    return used;
}

}  // namespace cardan::platform
