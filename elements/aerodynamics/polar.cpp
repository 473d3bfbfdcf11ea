#include "elements/aerodynamics/polar.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/types.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cardan {

namespace {

constexpr double slack = 1e-6;  // rad, of the ends of a table
constexpr double same = 1e-9;   // rad, of points of two tables
constexpr double attached_angle = 0.08;
constexpr double gives_way = -0.1;                  // of the steepest slope
constexpr double max_coefficient = 1e3;             // coefficient
constexpr double max_reynolds = 1e12;               // flow: Reynolds number
constexpr double usual_angle = 10 * units::degree;  // to both sides of zero the lift is steepest

void check(const std::string& here, const Polar::Table& table) {
    const std::vector<double>& angles = table.angles;
    const std::size_t n = angles.size();
    if (n < 2) throw InputError(here, "number of points", n, "at least 2");
    if (n > std::numeric_limits<std::uint16_t>::max()) throw InputError(here, "number of points", n, "at most 65535");
    for (const auto* column : {&table.lift, &table.drag, &table.moment})
        if (column->size() != n)
            throw InputError(here, "values in a column", column->size(), text("as many as angles, ", n));
    for (std::size_t i = 0; i < n; ++i) {
        for (const auto* column : {&angles, &table.lift, &table.drag, &table.moment})
            if (!std::isfinite((*column)[i]))
                throw InputError(text(here, ", point ", i + 1), "value", (*column)[i], "finite");
        if (std::abs(angles[i]) > 2 * pi)
            throw InputError(text(here, ", point ", i + 1), "angle of attack [rad]", angles[i], "at most a turn");
        for (const auto* column : {&table.lift, &table.drag, &table.moment})
            if (std::abs((*column)[i]) > max_coefficient)
                throw InputError(text(here, ", point ", i + 1), "coefficient", (*column)[i],
                                 text(-max_coefficient, " ... ", max_coefficient));
        if (i > 0 && !(angles[i] > angles[i - 1]))
            throw InputError(text(here, ", point ", i + 1), "angle of attack [deg]", angles[i] * units::to_degrees,
                             text("above that of the point before, ", angles[i - 1] * units::to_degrees));
    }
    if (angles.front() > -pi + slack || angles.back() < pi - slack)
        throw InputError(here, "angles of attack [deg]",
                         text(angles.front() * units::to_degrees, " ... ", angles.back() * units::to_degrees),
                         "-180 ... 180");
}

// All values once.
std::vector<double> united(std::vector<double> all, double tolerance) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end(), [=](double x, double y) { return y - x < tolerance; }), all.end());
    return all;
}

// From -pi to pi, where it nearly always is.
double on_circle(double angle) {
    return std::abs(angle) <= pi ? angle : std::remainder(angle, 2 * pi);
}

}  // namespace

Polar::IndexedTable::IndexedTable(Table of) : table(std::move(of)) {
    const std::vector<double>& angles = table.angles;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const double from = -pi + 2 * pi * static_cast<double>(cell) / cells;
        const auto next = std::upper_bound(angles.begin() + 1, angles.end() - 1, from);
        first[cell] = static_cast<std::uint16_t>(next - angles.begin() - 1);
    }
    intervals.reserve(angles.size() - 1);
    for (std::size_t i = 0; i + 1 < angles.size(); ++i) {
        const auto slope = [&](const std::vector<double>& y) {
            return (y[i + 1] - y[i]) / (angles[i + 1] - angles[i]);
        };
        intervals.push_back({angles[i], table.lift[i], table.drag[i], table.moment[i], slope(table.lift),
                             slope(table.drag), slope(table.moment)});
    }
}

// @param x  from -pi to pi
Polar::Point Polar::IndexedTable::at(double x) const {
    const auto cell = std::min(static_cast<std::size_t>(std::max(0.0, (x + pi) / (2 * pi) * cells)), cells - 1);
    std::size_t i = first[cell];
    while (i + 1 < intervals.size() && x >= intervals[i + 1].from) ++i;
    const Interval& own = intervals[i];
    const double t = x - own.from, end = i + 1 < intervals.size() ? intervals[i + 1].from : pi;
    return {.lift = own.lift + own.lift_slope * t,
            .drag = own.drag + own.drag_slope * t,
            .moment = own.moment + own.moment_slope * t,
            .lift_slope = own.lift_slope,
            .drag_slope = own.drag_slope,
            .moment_slope = own.moment_slope,
            .room = std::min(t, end - x)};
}

Polar::Polar(std::string name, std::vector<Table> tables) : name_(std::move(name)) {
    const std::string here = text("polar of airfoil '", name_, "'");
    if (tables.empty()) throw InputError(here, "number of tables", 0, "at least 1");
    const bool several = tables.size() > 1;
    tables_.reserve(tables.size());
    for (Table& table : tables) {
        const std::string place = several ? text(here, ", table ", tables_.size() + 1) : here;
        check(place, table);
        const double min = tables_.empty() ? 0 : tables_.back().table.reynolds;
        if (several && !(table.reynolds > min && table.reynolds >= 1 && table.reynolds <= max_reynolds))
            throw InputError(place, "Reynolds number", table.reynolds, text("above ", min, ", 1 ... ", max_reynolds));
        tables_.emplace_back(std::move(table));
    }
    const Point attached = at(attached_angle);
    lift_line_ = {attached.lift_slope, attached.lift - attached.lift_slope * attached_angle};
    find_stalls();
}

void Polar::find_stalls() {
    const auto& intervals = tables_.front().intervals;
    const Table& first = table();
    const auto last = intervals.size() - 1;
    const auto end = [&](std::size_t i) { return first.angles[i + 1]; };
    double steepest = 0;
    for (std::size_t i = 0; i <= last; ++i)
        if (intervals[i].from < usual_angle && end(i) > -usual_angle)
            steepest = std::max(steepest, intervals[i].lift_slope);
    attached_from_ = -pi;
    attached_to_ = pi;
    if (steepest == 0) return;
    std::size_t middle = 0;
    while (middle < last && end(middle) <= 0) ++middle;
    std::size_t high = middle, low = middle;
    while (high < last && intervals[high].lift_slope >= steepest / 2) ++high;
    while (low > 0 && intervals[low].lift_slope >= steepest / 2) --low;
    attached_to_ = std::max(0.0, intervals[high].from);
    attached_from_ = std::min(0.0, end(low));
    for (std::size_t i = std::max<std::size_t>(high, 1); i <= last && intervals[i].from < pi / 2; ++i)
        if (intervals[i].from > 0 &&
            intervals[i].lift_slope < std::min(gives_way * steepest, intervals[i - 1].lift_slope))
            stalls_.push_back(intervals[i].from);
    for (std::size_t i = low; i + 1 > 0 && end(i) > -pi / 2; --i)
        if (end(i) < 0 && i < last &&
            intervals[i].lift_slope < std::min(gives_way * steepest, intervals[i + 1].lift_slope))
            stalls_.push_back(end(i));
}

Polar::Polar(std::string name, std::vector<double> angles, std::vector<double> lift, std::vector<double> drag,
             std::vector<double> moment)
    : Polar(std::move(name), {Table{std::move(angles), std::move(lift), std::move(drag), std::move(moment)}}) {}

std::vector<double> Polar::reynolds() const {
    std::vector<double> all;
    all.reserve(tables_.size());
    for (const IndexedTable& one : tables_) all.push_back(one.table.reynolds);
    return all;
}

Polar Polar::mixed(std::string name, const Polar& a, const Polar& b, double share) {
    std::vector<double> angles, numbers;
    for (const Polar* polar : {&a, &b}) {
        for (const IndexedTable& one : polar->tables_)
            angles.insert(angles.end(), one.table.angles.begin(), one.table.angles.end());
        const std::vector<double> own = polar->reynolds();
        if (polar->over_reynolds() || numbers.empty()) numbers.insert(numbers.end(), own.begin(), own.end());
    }
    // A single table says nothing of where the other has its own.
    if (b.over_reynolds() && !a.over_reynolds()) numbers.erase(numbers.begin());
    angles = united(std::move(angles), same);
    numbers = united(std::move(numbers), std::numeric_limits<double>::min());
    std::vector<Table> tables;
    tables.reserve(numbers.size());
    for (const double reynolds : numbers) {
        Table& table = tables.emplace_back(Table{angles, {}, {}, {}, reynolds});
        for (auto* column : {&table.lift, &table.drag, &table.moment}) column->reserve(angles.size());
        for (const double x : angles) {
            const Point from = a.between(x, reynolds), to = b.between(x, reynolds);
            table.lift.push_back((1 - share) * from.lift + share * to.lift);
            table.drag.push_back((1 - share) * from.drag + share * to.drag);
            table.moment.push_back((1 - share) * from.moment + share * to.moment);
        }
    }
    return {std::move(name), std::move(tables)};
}

Polar::Point Polar::at(double angle) const {
    return tables_.front().at(on_circle(angle));
}

Polar::Point Polar::at(double angle, double reynolds) const {
    return between(on_circle(angle), reynolds);
}

Polar::Point Polar::between(double x, double reynolds) const {
    if (!over_reynolds() || !(reynolds > tables_.front().table.reynolds)) return tables_.front().at(x);
    if (reynolds >= tables_.back().table.reynolds) return tables_.back().at(x);
    std::size_t i = 1;
    while (reynolds >= tables_[i].table.reynolds) ++i;
    const double first = tables_[i - 1].table.reynolds, width = std::log(tables_[i].table.reynolds / first),
                 t = std::log(reynolds / first) / width, by = 1 / (width * reynolds);
    const Point from = tables_[i - 1].at(x), to = tables_[i].at(x);
    const auto mean = [t](double a, double b) { return (1 - t) * a + t * b; };
    return {mean(from.lift, to.lift),
            mean(from.drag, to.drag),
            mean(from.moment, to.moment),
            mean(from.lift_slope, to.lift_slope),
            mean(from.drag_slope, to.drag_slope),
            mean(from.moment_slope, to.moment_slope),
            by * (to.lift - from.lift),
            by * (to.drag - from.drag),
            by * (to.moment - from.moment),
            std::min(from.room, to.room)};
}

}  // namespace cardan
