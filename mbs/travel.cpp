#include "mbs/travel.hpp"

#include "mbs/error.hpp"

#include <algorithm>
#include <limits>

namespace cardan {

namespace {

constexpr const char* place = "travel of a drive";
// Greatest slope of 3 x^2 - 2 x^3.
constexpr double steepest = 1.5;

void require_finite(const char* quantity, double value) {
    if (!std::isfinite(value)) throw InputError(place, quantity, value, "finite");
}

}  // namespace

Travel::Travel(double position) : target_(position), from_(position) {
    require_finite("position", position);
}

Travel::Travel(double time, const State& from, double to, const TravelLimits& limits)
    : target_(to), start_(time), from_(from.position), rate_before_(from.rate), moves_(true) {
    require_finite("time [s]", time);
    require_finite("position at the start", from.position);
    require_finite("rate at the start", from.rate);
    require_finite("target", to);
    require_positive(place, "largest rate", limits.rate);
    require_positive(place, "largest acceleration", limits.acceleration);

    // To change the rate by dv takes the time c |dv|, so to stop takes the way c v |v| / 2.
    const double c = steepest / limits.acceleration, v0 = from.rate, way = to - from.position;
    const double sense = way >= c * v0 * std::abs(v0) / 2 ? 1 : -1;
    // Up to v and down to rest: the way c (2 v^2 - v0^2) / 2, whether v0 leads there or away.
    const double v = sense * std::min(limits.rate, std::sqrt(std::max(0.0, (2 * sense * way / c + v0 * v0) / 2)));
    const double up = c * std::abs(v - v0), down = c * std::abs(v);
    const double left = way - (v0 + v) / 2 * up - v / 2 * down;
    const double cruise = v != 0 ? std::max(0.0, left / v) : 0.0;

    phases_[0] = {time, up, from.position, v0, v - v0};
    phases_[1] = {time + up, cruise, from.position + (v0 + v) / 2 * up, v, 0};
    phases_[2] = {time + up + cruise, down, to - v / 2 * down, v, -v};
}

double Travel::arrival() const {
    return moves_ ? phases_[2].start + phases_[2].length : -std::numeric_limits<double>::infinity();
}

Travel::State Travel::at(double time, double inside) const {
    if (!moves_) return {target_, 0, 0};
    if (inside < start_) return {from_ + rate_before_ * (time - start_), rate_before_, 0};
    for (const Phase& phase : phases_) {
        if (!(inside < phase.start + phase.length)) continue;
        const double t = time - phase.start, x = t / phase.length, dv = phase.change;
        return {phase.position + phase.rate * t + dv * t * x * x * (1 - x / 2), phase.rate + dv * x * x * (3 - 2 * x),
                dv / phase.length * 6 * x * (1 - x)};
    }
    return {target_, 0, 0};
}

std::vector<double> Travel::breaks() const {
    if (!moves_) return {};
    std::vector<double> times{start_};
    for (const Phase& phase : phases_) times.push_back(phase.start + phase.length);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

}  // namespace cardan
