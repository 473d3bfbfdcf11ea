#include "elements/electric/grid.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/types.hpp"

#include <algorithm>
#include <cmath>

namespace cardan {

double Grid::omega() const {
    return 2 * pi * frequency;
}

double Grid::peak() const {
    return line_voltage * std::sqrt(2.0 / 3.0);
}

std::array<double, 2> Grid::voltage(double time) const {
    const double size = peak() * (amplitude ? amplitude(time) : 1.0), at = angle_at(time).value;
    return {size * std::cos(at), size * std::sin(at)};
}

bool Grid::connected(double time) const {
    return std::ranges::none_of(interruptions,
                                [time](const Interruption& off) { return time >= off.from && time < off.to; });
}

std::vector<double> Grid::all_breaks() const {
    std::vector<double> all = breaks;
    for (const Interruption& off : interruptions) all.insert(all.end(), {off.from, off.to});
    std::ranges::sort(all);
    return all;
}

Grid Grid::with_sag(double depth, double start, double duration) const {
    if (!(depth >= 0 && depth <= 1)) throw InputError("grid", "depth of a sag", depth, "0 to 1");
    require_positive("grid", "duration of a sag [s]", duration);
    Grid other = *this;
    other.amplitude = [before = amplitude, depth, start, end = start + duration](double time) {
        return (before ? before(time) : 1.0) * (time >= start && time < end ? 1 - depth : 1.0);
    };
    other.breaks.insert(other.breaks.end(), {start, start + duration});
    return other;
}

Grid Grid::with_phase_jump(double jump, double at) const {
    Grid other = *this;
    other.angle = [before = angle, jump, at](double time) {
        Angle sum = before ? before(time) : Angle{};
        if (time >= at) sum.value += jump;
        return sum;
    };
    other.breaks.push_back(at);
    return other;
}

Grid Grid::with_frequency_change(double hertz, double start, double duration) const {
    require_positive("grid", "duration of a change of frequency [s]", duration);
    Grid other = *this;
    other.angle = [before = angle, rate = 2 * pi * hertz, start, end = start + duration](double time) {
        Angle sum = before ? before(time) : Angle{};
        sum.value += rate * (std::clamp(time, start, end) - start);
        if (time >= start && time < end) sum.rate += rate;
        return sum;
    };
    other.breaks.insert(other.breaks.end(), {start, start + duration});
    return other;
}

Grid Grid::with_interruption(double start, double duration) const {
    require_positive("grid", "duration of an interruption [s]", duration);
    Grid other = *this;
    other.interruptions.push_back({start, start + duration});
    return other;
}

void Grid::check(const std::string& where) const {
    require_positive(where, "voltage between lines [V]", line_voltage);
    require_positive(where, "frequency of the grid [Hz]", frequency);
    for (const Interruption& off : interruptions)
        if (!(off.to > off.from)) throw InputError(where, "end of an interruption [s]", off.to, text("> ", off.from));
}

}  // namespace cardan
