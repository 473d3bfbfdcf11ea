#include "turbines/readers/detail/polar_rows.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/types.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

namespace {

constexpr double end_slack = 1e-6, rounded_end = 0.01;  // rad

std::string in_degrees(double from, double to) {
    return text(from * units::to_degrees, " ... ", to * units::to_degrees);
}

// A row before another one.
void insert_row(Polar::Table& table, std::ptrdiff_t at, double angle, double lift, double drag, double moment) {
    table.angles.insert(table.angles.begin() + at, angle);
    table.lift.insert(table.lift.begin() + at, lift);
    table.drag.insert(table.drag.begin() + at, drag);
    table.moment.insert(table.moment.begin() + at, moment);
}

// A row at 360 deg is that at 0 again.  @return true if it was another one
bool drop_last(Polar::Table& table) {
    bool differs = false;
    for (auto* column : {&table.lift, &table.drag, &table.moment}) {
        differs = differs || column->back() != column->front();
        column->pop_back();
    }
    table.angles.pop_back();
    return differs;
}

// A table from 0 to 360 deg as one from -180 to 180: what lies beyond 180 deg goes before the rest. At 180 deg there is
// what lies between its neighbours, if no row is there.
void turn_to_front(Polar::Table& table) {
    std::vector<double>& angles = table.angles;
    auto at = std::lower_bound(angles.begin(), angles.end(), pi - end_slack) - angles.begin();
    const auto i = static_cast<std::size_t>(at);
    if (i == angles.size()) return;
    if (std::abs(angles[i] - pi) < end_slack) {
        angles[i] = pi;
    } else {
        const double t = i == 0 ? 0 : (pi - angles[i - 1]) / (angles[i] - angles[i - 1]);
        const auto between = [&](const std::vector<double>& y) { return i == 0 ? y[0] : std::lerp(y[i - 1], y[i], t); };
        insert_row(table, at, pi, between(table.lift), between(table.drag), between(table.moment));
    }
    insert_row(table, at + 1, -pi, table.lift[i], table.drag[i], table.moment[i]);
    ++at;
    for (std::size_t k = i + 2; k < angles.size(); ++k) angles[k] -= 2 * pi;
    for (auto* column : {&angles, &table.lift, &table.drag, &table.moment})
        std::rotate(column->begin(), column->begin() + at, column->end());
}

// What was changed, in words; empty: nothing.  @throws InputError
std::string close_circle(Polar::Table& table) {
    const double from = table.angles.front(), to = table.angles.back();
    if (from < -pi + end_slack && to > pi - end_slack && from > -pi - rounded_end && to < pi + rounded_end) return {};
    std::string change = "beyond these the coefficients stay those of the ends, as in AeroDyn";
    if (to > pi + end_slack && from > -end_slack && to < 2 * pi + end_slack) {
        const bool jumps = to > 2 * pi - end_slack && table.angles.size() > 1 && drop_last(table);
        turn_to_front(table);
        change = text("those beyond 180 deg are taken as negative ones",
                      jumps ? "; the last row differs from that at 0 deg, which holds" : "");
    } else if (from < -pi - rounded_end || to > pi + rounded_end) {
        throw InputError("polar", "angles of attack [deg]", in_degrees(from, to), "-180 ... 180, or 0 ... 360");
    }
    const auto &lift = table.lift, &drag = table.drag, &moment = table.moment;
    if (table.angles.front() > -pi + end_slack) insert_row(table, 0, -pi, lift.front(), drag.front(), moment.front());
    if (table.angles.back() < pi - end_slack)
        insert_row(table, std::ssize(table.angles), pi, lift.back(), drag.back(), moment.back());
    return change;
}

}  // namespace

Polar::Table polar_of_rows(const OpenFastFile& file, const std::vector<OpenFastFile::Row>& rows,
                           const PolarColumns& columns, std::vector<FileNote>& notes) {
    Polar::Table out;
    for (auto* column : {&out.angles, &out.lift, &out.drag, &out.moment}) column->reserve(rows.size());
    const int last = std::max({columns.angle, columns.lift, columns.drag, columns.moment});
    for (const OpenFastFile::Row& row : rows) {
        file.require(row, static_cast<std::size_t>(last), "polar");
        const auto value = [&](int column) { return column == 0 ? 0.0 : entry(row.values, column - 1); };
        const double degrees = value(columns.angle);
        if (&row != &rows.front() && row.values == (&row - 1)->values) {
            notes.push_back(
                {file.name(), row.line, "angle of attack", text(degrees), "the row before again, left out"});
            continue;
        }
        if (!out.angles.empty() && !(degrees * units::degree > out.angles.back()))
            throw ParseError(file.name(), row.line, 0,
                             text("angle of attack = ", degrees, " deg after ", out.angles.back() * units::to_degrees,
                                  "; allowed: ascending"));
        out.angles.push_back(degrees * units::degree);
        out.lift.push_back(value(columns.lift));
        out.drag.push_back(value(columns.drag));
        out.moment.push_back(value(columns.moment));
    }
    if (rows.empty()) return out;
    if (const auto min = std::ranges::min_element(out.drag); *min < 0)
        notes.push_back({file.name(), rows.front().line, "drag", text(*min, " ..."),
                         "less than zero, taken as it is: such an airfoil drives itself"});
    const std::string range = in_degrees(out.angles.front(), out.angles.back());
    try {
        const std::string change = close_circle(out);
        if (!change.empty())
            notes.push_back({file.name(), rows.front().line, "angles of attack", range + " deg", change});
    } catch (const InputError& error) {
        throw ParseError(file.name(), rows.front().line, 0, error.what());
    }
    return out;
}

}  // namespace cardan::turbines
