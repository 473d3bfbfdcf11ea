#include "elements/aerodynamics/attached_flow.hpp"

#include "mbs/base/units.hpp"

#include <algorithm>
#include <cmath>

namespace cardan {

namespace {

constexpr double reach = 20 * units::degree;  // of the angles among which the flow is attached, to both sides of zero
constexpr double window = 2 * units::degree;  // of the smoothing, likewise
constexpr double still_linear = 0.9;          // of the largest slope
constexpr double margin = 0.2;                // of the range, at both its ends, beside which the line is fitted
constexpr double no_lift = 0.01;
constexpr double rounding = 1e-9;  // rad

// Points of a table, from the first to before the last one.
struct PointRange {
    std::size_t first, last;
    std::size_t size() const { return last - first; }
};

PointRange points_between(const std::vector<double>& angles, double from, double to) {
    const auto first = std::lower_bound(angles.begin(), angles.end(), from - rounding),
               last = std::upper_bound(first, angles.end(), to + rounding);
    return {static_cast<std::size_t>(first - angles.begin()), static_cast<std::size_t>(last - angles.begin())};
}

std::size_t point_of_min_drag(const Polar::Table& table, const PointRange& near) {
    std::size_t min = near.first;
    for (std::size_t i = near.first; i < near.last; ++i)
        if (table.drag[i] < table.drag[min]) min = i;
    return min;
}

bool is_cylinder(const Polar::Table& table, const PointRange& near) {
    bool constant_drag = true, lifts = false;
    for (std::size_t i = near.first; i < near.last; ++i) {
        constant_drag = constant_drag && table.drag[i] == table.drag[near.first];
        lifts = lifts || table.lift[i] >= no_lift;
    }
    return constant_drag || !lifts;
}

// Slope of the normal force in the intervals of a table, each at its middle.
class NormalSlopes {
public:
    NormalSlopes(const Polar::Table& table, double zero_lift_drag) {
        const auto normal = [&](std::size_t i) {
            return table.lift[i] * std::cos(table.angles[i]) +
                   (table.drag[i] - zero_lift_drag) * std::sin(table.angles[i]);
        };
        middles_.reserve(table.angles.size());
        slopes_.reserve(table.angles.size());
        for (std::size_t i = 0; i + 1 < table.angles.size(); ++i) {
            const double a = table.angles[i], b = table.angles[i + 1];
            middles_.push_back((a + b) / 2);
            slopes_.push_back((normal(i + 1) - normal(i)) / (b - a));
        }
    }
    std::size_t size() const { return middles_.size(); }
    double middle(std::size_t i) const { return middles_[i]; }
    double smooth(std::size_t i) const {
        const PointRange around = points_between(middles_, middles_[i] - window, middles_[i] + window);
        double sum = 0, weights = 0;
        for (std::size_t k = around.first; k < around.last; ++k) {
            const double u = (middles_[k] - middles_[i]) / window, weight = std::pow(std::max(0.0, 1 - u * u), 3);
            sum += weight * slopes_[k];
            weights += weight;
        }
        return sum / weights;
    }

private:
    std::vector<double> middles_, slopes_;
};

struct AngleRange {
    double lower, upper;
};

// From the interval above the minimum drag (below it if that one lies beyond reach), the point `min`, as far as the
// slope is the same.
AngleRange linear_range(const NormalSlopes& slopes, double angle, std::size_t min) {
    const double below = slopes.middle(min - 1), above = slopes.middle(min), share = (angle - below) / (above - below),
                 at_least = (1 - share) * slopes.smooth(min - 1) + share * slopes.smooth(min);
    const std::size_t begin = above > reach ? min - 1 : min;
    const auto end_towards = [&](bool up) {
        double largest = std::max(at_least, slopes.smooth(begin)), end = slopes.middle(begin);
        const auto next = [up](std::size_t i) { return up ? i + 1 : i - 1; };  // the one below 0 is no interval either
        for (std::size_t i = next(begin); i < slopes.size() && std::abs(slopes.middle(i)) <= reach; i = next(i)) {
            const double slope = slopes.smooth(i);
            if (slope < still_linear * largest) break;
            largest = std::max(largest, slope);
            end = slopes.middle(i);
        }
        return end;
    };
    return {end_towards(false), end_towards(true)};
}

struct LiftLine {
    double slope, zero;
    bool rises() const { return slope > 0 && std::isfinite(slope) && std::isfinite(zero); }
};

// Of least squares through at least two points.
LiftLine line_through(const Polar::Table& table, PointRange points) {
    if (points.size() < 2) points.last = std::min(points.first + 2, table.angles.size());
    const auto n = static_cast<double>(points.size());
    double angle = 0, lift = 0, squares = 0, products = 0;
    for (std::size_t i = points.first; i < points.last; ++i) {
        angle += table.angles[i] / n;
        lift += table.lift[i] / n;
    }
    for (std::size_t i = points.first; i < points.last; ++i) {
        squares += (table.angles[i] - angle) * (table.angles[i] - angle);
        products += (table.angles[i] - angle) * (table.lift[i] - lift);
    }
    const double slope = products / squares;
    return {slope, angle - lift / slope};
}

// Of the rising zeros of the lift the one next to `angle`, which it is itself if there is none.
double zero_next_to(double angle, const Polar::Table& table, const PointRange& near) {
    double best = angle, distance = reach;
    for (std::size_t i = near.first; i + 1 < near.last; ++i) {
        const double a = table.lift[i], b = table.lift[i + 1];
        if (!(a <= 0 && b > 0)) continue;
        const double zero = table.angles[i] - a * (table.angles[i + 1] - table.angles[i]) / (b - a);
        if (std::abs(zero - angle) >= distance) continue;
        best = zero;
        distance = std::abs(zero - angle);
    }
    return best;
}

AttachedFlow flow_without_slope(const KnownFlow& known, double zero_lift_drag) {
    return {.slope = known.slope.value_or(0),
            .zero_lift = known.zero_lift.value_or(0),
            .upper = known.upper.value_or(std::max(0.0, known.lower.value_or(0))),
            .lower = known.lower.value_or(std::min(0.0, known.upper.value_or(0))),
            .zero_lift_drag = known.zero_lift_drag.value_or(zero_lift_drag)};
}

}  // namespace

AttachedFlow attached_flow(const Polar& polar, const KnownFlow& known) {
    const Polar::Table& table = polar.table();
    const PointRange near = points_between(table.angles, -reach, reach);
    if (near.size() == 0) return flow_without_slope(known, polar.at(0).drag);
    const std::size_t min = point_of_min_drag(table, near);
    if (near.size() < 3 || is_cylinder(table, near)) return flow_without_slope(known, table.drag[min]);

    AttachedFlow out;
    out.zero_lift_drag = known.zero_lift_drag.value_or(table.drag[min]);
    const AngleRange found = linear_range(NormalSlopes(table, out.zero_lift_drag), table.angles[min], min);
    out.upper = known.upper.value_or(std::max(found.upper, known.lower.value_or(found.upper)));
    out.lower = known.lower.value_or(std::min(found.lower, known.upper.value_or(found.lower)));
    const double aside = margin * (out.upper - out.lower);
    const LiftLine line = line_through(table, points_between(table.angles, out.lower + aside, out.upper - aside));
    if (!line.rises()) return flow_without_slope(known, table.drag[min]);
    out.slope = known.slope.value_or(line.slope);
    out.zero_lift = known.zero_lift.value_or(zero_next_to(line.zero, table, near));
    return out;
}

std::vector<UnsteadyAirfoil> unsteady_airfoils(const std::vector<Polar>& polars) {
    std::vector<UnsteadyAirfoil> all;
    all.reserve(polars.size());
    for (const Polar& polar : polars) all.emplace_back(polar, attached_flow(polar));
    return all;
}

}  // namespace cardan
