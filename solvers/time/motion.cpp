#include "solvers/time/motion.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/monotone_cubic.hpp"

#include <algorithm>
#include <utility>

namespace cardan::solvers {

namespace {

void require_finite(std::string_view where, std::string_view quantity, double value) {
    if (!std::isfinite(value)) throw InputError(where, quantity, value, "finite");
}

void require_rising(std::string_view where, const std::vector<double>& times) {
    for (std::size_t i = 0; i < times.size(); ++i) {
        require_finite(where, text("time ", i + 1, " [s]"), times[i]);
        if (i > 0 && !(times[i] > times[i - 1]))
            throw InputError(where, text("time ", i + 1, " [s]"), times[i],
                             text("> ", times[i - 1], ", the one before"));
    }
}

void check_ramp(std::string_view where, double from, double to, double t0, double t1) {
    require_finite(where, "first value", from);
    require_finite(where, "last value", to);
    require_rising(where, {t0, t1});
}

// The quintic of a ramp from 0 to 1 over x = 0 ... 1: integral from 0, value, first and second derivative.
struct Quintic {
    double integral, value, first, second;
};
Quintic quintic(double x) {
    const double x2 = x * x, x3 = x2 * x;
    return {x3 * x * (2.5 - 3 * x + x2), x3 * (10 - 15 * x + 6 * x2), 30 * x2 * (1 - 2 * x + x2),
            60 * x * (1 - 3 * x + 2 * x2)};
}

}  // namespace

Motion::Motion(std::string kind, Law law, std::vector<double> breaks)
    : kind_(std::move(kind)), law_(std::move(law)), breaks_(std::move(breaks)) {}

Motion Motion::constant(double position) {
    require_finite("constant motion", "position", position);
    return {"constant", [=](double, double) { return MotionState{position, 0, 0}; }};
}

Motion Motion::constant_rate(double position, double rate, double since) {
    for (double value : {position, rate, since})
        require_finite("motion of constant rate", "position, rate or time", value);
    return {"constant rate", [=](double t, double) { return MotionState{position + rate * (t - since), rate, 0}; }};
}

Motion Motion::constant_acceleration(double position, double rate, double acceleration, double since) {
    for (double value : {position, rate, acceleration, since})
        require_finite("motion of constant acceleration", "position, rate, acceleration or time", value);
    return {"constant acceleration", [=](double t, double) {
                const double x = t - since;
                return MotionState{position + x * (rate + acceleration * x / 2), rate + acceleration * x, acceleration};
            }};
}

Motion Motion::ramp(double from, double to, double t0, double t1) {
    check_ramp("ramp", from, to, t0, t1);
    const double T = t1 - t0, rise = to - from;
    const auto law = [=](double t, double inside) {
        if (inside < t0) return MotionState{from, 0, 0};
        if (inside >= t1) return MotionState{to, 0, 0};
        const Quintic s = quintic((t - t0) / T);
        return MotionState{from + rise * s.value, rise / T * s.first, rise / (T * T) * s.second};
    };
    return {"ramp", law, {t0, t1}};
}

Motion Motion::rate_ramp(double position, double rate_from, double rate_to, double t0, double t1) {
    check_ramp("ramp of the rate", rate_from, rate_to, t0, t1);
    require_finite("ramp of the rate", "position", position);
    const double T = t1 - t0, rise = rate_to - rate_from;
    const double end = position + T * (rate_from + rise / 2);
    const auto law = [=](double t, double inside) {
        if (inside < t0) return MotionState{position + rate_from * (t - t0), rate_from, 0};
        if (inside >= t1) return MotionState{end + rate_to * (t - t1), rate_to, 0};
        const Quintic s = quintic((t - t0) / T);
        return MotionState{position + rate_from * (t - t0) + rise * T * s.integral, rate_from + rise * s.value,
                           rise / T * s.first};
    };
    return {"ramp of the rate", law, {t0, t1}};
}

Motion Motion::trajectory(const Trajectory& trajectory) {
    const auto law = [=](double t, double inside) {
        const Trajectory::State s = trajectory.at(t, inside);
        return MotionState{s.position, s.rate, s.acceleration};
    };
    return {"trajectory", law, trajectory.breaks()};
}

Motion Motion::harmonic(double mean, double amplitude, double period, double phase) {
    for (double value : {mean, amplitude, phase}) require_finite("harmonic motion", "mean, amplitude or phase", value);
    require_positive("harmonic motion", "period [s]", period);
    const double omega = 2 * pi / period;
    if (!std::isfinite(omega * omega) || !std::isfinite(omega * omega * amplitude))
        throw InputError("harmonic motion", "period [s]", period,
                         "one whose accelerations, (2 pi / period)^2 amplitude, are numbers");
    const auto law = [=](double t, double) {
        const double s = amplitude * std::sin(omega * t + phase), c = amplitude * std::cos(omega * t + phase);
        return MotionState{mean + s, omega * c, -omega * omega * s};
    };
    return {"harmonic", law};
}

Motion Motion::table(std::vector<double> times, std::vector<double> values) {
    const MonotoneCubic curve(times, std::move(values), MonotoneCubic::Ends::parabola,
                              {.table = "table of a motion", .x = "time", .x_unit = " [s]"});
    const auto law = [curve](double t, double inside) {
        const MonotoneCubic::Value at = curve.at(t, inside);
        return MotionState{at.value, at.slope, at.second};
    };
    return {"table", law, std::move(times)};
}

Motion Motion::function(std::function<MotionState(double)> own, std::vector<double> breaks) {
    if (!own) throw InputError("motion of the user's own", "function", "none", "a callable one");
    require_rising("motion of the user's own", breaks);
    return {"function", [own = std::move(own)](double t, double) { return own(t); }, std::move(breaks)};
}

}  // namespace cardan::solvers
