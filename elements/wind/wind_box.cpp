#include "elements/wind/wind_box.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace cardan {

namespace {

// Of a cell, by which rounding may lead out of a grid.
constexpr double slack = 1e-3;

template <class Number>
double number_at(const BoxNumbers& of, std::ptrdiff_t at) {
    Number x;
    std::memcpy(&x, static_cast<const std::byte*>(of.data) + at * static_cast<std::ptrdiff_t>(sizeof x), sizeof x);
    return of.offset + of.scale * static_cast<double>(x);
}

double number_at(const BoxNumbers& of, std::ptrdiff_t at) {
    return of.type == BoxNumbers::Type::int16 ? number_at<std::int16_t>(of, at) : number_at<float>(of, at);
}

// Between two numbers of a row of them.
struct Between {
    int from, to;
    double share;  // of the way to `to`
    bool varies;   // else held at `from`
};

Between within(double at, int last) {
    const double clamped = std::clamp(at, 0.0, static_cast<double>(last));
    const int from = std::min(static_cast<int>(clamped), last - 1);
    return {from, from + 1, clamped - from, true};
}

Between around(double at, int count) {
    double in = std::fmod(at, count);
    if (in < 0) in += count;
    const int from = std::min(static_cast<int>(in), count - 1);
    return {from, from + 1 == count ? 0 : from + 1, in - from, true};
}

// Also of what is not a number.
bool is_within(double at, int last) {
    return at >= -slack && at <= last + slack;
}

Between held(double at, int last) {
    return is_within(at, last) ? within(at, last) : Between{at > 0 ? last : 0, at > 0 ? last : 0, 0, false};
}

struct Cell {
    Between step, row, column;
};

// The lower one of two whole numbers that are as near, but for rounding.
int nearest(double at, int count) {
    return static_cast<int>(std::clamp(std::ceil(at - 0.5 - slack), 0.0, count - 1.0));
}

[[noreturn]] void refuse(const WindBoxData& box, const char* what, double value, const char* unit, double low,
                         double high, const Vec3& place, double time) {
    const std::string name = box.origin.files.empty() ? "wind box" : box.origin.files.front();
    throw InputError(
        name, text(what, " [", unit, "]"), value,
        text(low, " ... ", high, "; at the place (", place.x(), ", ", place.y(), ", ", place.z(),
             ") m of the box's axes and t = ", time, " s; OutsideBox::hold or OutsideBox::repeat say what is there"));
}

Between step_at(const WindBoxData& box, const Vec3& place, double time) {
    const double at = (time + (box.start - place.x()) / box.speed) / box.grid.time_step;
    if (!std::isfinite(at) || std::abs(at) > 1e15)
        refuse(box, "time in the box", at * box.grid.time_step, "s", 0, box.grid.duration(), place, time);
    if (box.periodic || box.outside == OutsideBox::repeat) return around(at, box.grid.steps);
    const int last = box.grid.steps - 1;
    if (box.outside == OutsideBox::refuse && !is_within(at, last))
        refuse(box, "time in the box", at * box.grid.time_step, "s", 0, last * box.grid.time_step, place, time);
    return held(at, last);
}

Between column_at(const WindBoxData& box, const Vec3& place, double time) {
    const BoxGrid& grid = box.grid;
    const double half = grid.width() / 2, at = (place.y() + half) / grid.column_spacing;
    if (!std::isfinite(at)) refuse(box, "place across the wind", place.y(), "m", -half, half, place, time);
    if (is_within(at, grid.columns - 1)) return within(at, grid.columns - 1);
    if (box.outside == OutsideBox::refuse)
        refuse(box, "place across the wind", place.y(), "m", -half, half, place, time);
    return box.outside == OutsideBox::repeat ? around(at, grid.columns) : held(at, grid.columns - 1);
}

Between row_at(const WindBoxData& box, const Vec3& place, double time) {
    const BoxGrid& grid = box.grid;
    const double at = (place.z() - grid.lowest) / grid.row_spacing;
    const bool refused = box.outside == OutsideBox::refuse && !(at < 0 && box.below == BelowBox::to_ground);
    if (std::isnan(at) || (refused && !is_within(at, grid.rows - 1)))
        refuse(box, "height", place.z(), "m", grid.lowest, grid.lowest + grid.height(), place, time);
    return held(at, grid.rows - 1);
}

// Value and slopes by the three shares.
struct Corners {
    double value, by_step, by_row, by_column;
};

template <class Number, bool slopes>
Corners interpolate(const BoxNumbers& of, const Cell& c) {
    const std::ptrdiff_t t0 = c.step.from * of.step, t1 = c.step.to * of.step, k0 = c.row.from * of.row,
                         k1 = c.row.to * of.row, j0 = c.column.from * of.column, j1 = c.column.to * of.column;
    const auto at = [&](std::ptrdiff_t i) { return number_at<Number>(of, i); };
    const double a000 = at(t0 + k0 + j0), a001 = at(t0 + k0 + j1), a010 = at(t0 + k1 + j0), a011 = at(t0 + k1 + j1),
                 a100 = at(t1 + k0 + j0), a101 = at(t1 + k0 + j1), a110 = at(t1 + k1 + j0), a111 = at(t1 + k1 + j1);
    const double t = c.step.share, k = c.row.share, j = c.column.share;
    const double b00 = a000 + t * (a100 - a000), b01 = a001 + t * (a101 - a001), b10 = a010 + t * (a110 - a010),
                 b11 = a011 + t * (a111 - a011);
    const double c0 = b00 + j * (b01 - b00), c1 = b10 + j * (b11 - b10);
    Corners out{c0 + k * (c1 - c0), 0, 0, 0};
    if constexpr (slopes) {
        out.by_row = c1 - c0;
        out.by_column = (b01 - b00) + k * ((b11 - b10) - (b01 - b00));
        const double d00 = a100 - a000, d01 = a101 - a001, d10 = a110 - a010, d11 = a111 - a011;
        const double e0 = d00 + j * (d01 - d00), e1 = d10 + j * (d11 - d10);
        out.by_step = e0 + k * (e1 - e0);
    }
    return out;
}

double mean_of(const std::vector<double>& means, int columns, int row, int column) {
    return means[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)];
}

// What is taken off u in a cell, and its slopes.
Corners means_in(const WindBoxData& box, const Cell& c) {
    const auto at = [&](int row, int column) { return mean_of(box.means, box.grid.columns, row, column); };
    const double a = at(c.row.from, c.column.from), b = at(c.row.from, c.column.to), d = at(c.row.to, c.column.from),
                 e = at(c.row.to, c.column.to), k = c.row.share, j = c.column.share;
    const double low = a + j * (b - a), high = d + j * (e - d);
    return {low + k * (high - low), 0, high - low, (b - a) + k * ((e - d) - (b - a))};
}

// Above the ground by `share` of the height up to which it is linear.
void scale_to_ground(WindBox::Sample& out, double z, double top) {
    const double share = z / top;
    out.gradient *= share;
    out.gradient.col(2) = out.velocity / top;
    out.velocity *= share;
}

// Below the grid, on the tower's line.
template <bool slopes>
WindBox::Sample on_tower(const WindBoxData& box, const Vec3& place, double time) {
    const BoxTower& tower = *box.tower;
    const Between step = step_at(box, place, time);
    const double down = std::max(0.0, (tower.highest - place.z()) / tower.spacing);
    const int last = tower.points - 1;
    const bool beyond = down >= last;
    const int from = beyond ? last : static_cast<int>(down), to = beyond ? last : from + 1;
    const double share = beyond ? 0 : down - from;
    WindBox::Sample out{Vec3::Zero()};
    for (int c = 0; c < 3; ++c) {
        const BoxNumbers& of = tower.components[static_cast<std::size_t>(c)];
        const auto at = [&](int t, int point) { return number_at(of, t * of.step + point * of.row); };
        const double a0 = at(step.from, from), a1 = at(step.from, to), b0 = at(step.to, from), b1 = at(step.to, to);
        const double a = a0 + share * (a1 - a0), b = b0 + share * (b1 - b0);
        out.velocity(c) = a + step.share * (b - a);
        if constexpr (slopes) {
            out.gradient(c, 0) = step.varies ? -(b - a) / (box.grid.time_step * box.speed) : 0;
            const double slope = (1 - step.share) * (a1 - a0) + step.share * (b1 - b0);
            out.gradient(c, 2) = beyond || place.z() > tower.highest ? 0 : -slope / tower.spacing;
        }
    }
    const double lowest = tower.highest - last * tower.spacing;
    if (place.z() < lowest) scale_to_ground(out, place.z(), lowest);
    return out;
}

void require_grid(const WindBoxData& box) {
    const BoxGrid& grid = box.grid;
    for (const auto& [name, count] : {std::pair("planes", grid.steps), {"rows", grid.rows}, {"columns", grid.columns}})
        if (count < 2) throw InputError("wind box", text("number of ", name), count, "at least 2");
    require_positive("wind box", "time between planes [s]", grid.time_step);
    require_positive("wind box", "spacing of the rows [m]", grid.row_spacing);
    require_positive("wind box", "spacing of the columns [m]", grid.column_spacing);
    require_positive("wind box", "speed with which the air passes [m/s]", box.speed);
    if (!std::isfinite(grid.lowest)) throw InputError("wind box", "height of the first row [m]", grid.lowest, "finite");
    if (!std::isfinite(box.start)) throw InputError("wind box", "place of the first plane [m]", box.start, "finite");
    const std::size_t points = static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns);
    if (!box.means.empty() && box.means.size() != points)
        throw InputError("wind box", "number of means", box.means.size(), text("as many as points, ", points));
}

void require_numbers(const WindBoxData& box) {
    for (const BoxNumbers& of : box.components) {
        if (of.data == nullptr) throw InputError("wind box", "numbers", "none", "of u, v and w");
        if (of.type != box.components[0].type) throw InputError("wind box", "type of numbers", "mixed", "one");
    }
    if (box.below != BelowBox::tower) return;
    if (!box.tower || box.tower->points < 1) throw InputError("wind box", "points of the tower", "none", "at least 1");
    if (box.tower->points > 1) require_positive("wind box", "spacing of the tower's points [m]", box.tower->spacing);
    for (const BoxNumbers& of : box.tower->components)
        if (of.data == nullptr) throw InputError("wind box", "numbers of the tower", "none", "of u, v and w");
}

}  // namespace

int BoxGrid::row_near(double z) const {
    return nearest((z - lowest) / row_spacing, rows);
}

int BoxGrid::column_near(double y) const {
    return nearest((y + width() / 2) / column_spacing, columns);
}

const char* name_of(OutsideBox outside) {
    return outside == OutsideBox::refuse ? "refuse" : outside == OutsideBox::hold ? "hold" : "repeat";
}

WindBox::WindBox(WindBoxData data) : data_(std::move(data)) {
    require_grid(data_);
    require_numbers(data_);
}

template <class Number, bool slopes>
void WindBox::add_grid(const Vec3& place, double time, Sample& out) const {
    const BoxGrid& grid = data_.grid;
    const Cell cell{step_at(data_, place, time), row_at(data_, place, time), column_at(data_, place, time)};
    const auto take = [&](int c, const Corners& is, double sign) {
        out.velocity(c) += sign * is.value;
        if constexpr (slopes) {
            if (cell.step.varies) out.gradient(c, 0) -= sign * is.by_step / (grid.time_step * data_.speed);
            if (cell.column.varies) out.gradient(c, 1) += sign * is.by_column / grid.column_spacing;
            if (cell.row.varies) out.gradient(c, 2) += sign * is.by_row / grid.row_spacing;
        }
    };
    for (int c = 0; c < 3; ++c)
        take(c, interpolate<Number, slopes>(data_.components[static_cast<std::size_t>(c)], cell), 1);
    if (!data_.means.empty()) take(0, means_in(data_, cell), -1);
}

template <bool slopes>
WindBox::Sample WindBox::sample(const Vec3& place, double time) const {
    Sample out{Vec3::Zero()};
    if (place.z() <= 0) return out;
    const double lowest = data_.grid.lowest;
    const bool below = place.z() < lowest - slack * data_.grid.row_spacing;
    if (below && data_.below == BelowBox::tower) return on_tower<slopes>(data_, place, time);
    if (data_.components[0].type == BoxNumbers::Type::int16)
        add_grid<std::int16_t, slopes>(place, time, out);
    else
        add_grid<float, slopes>(place, time, out);
    if (below && data_.below == BelowBox::to_ground) scale_to_ground(out, place.z(), lowest);
    return out;
}

Vec3 WindBox::at(const Vec3& place, double time) const {
    return sample<false>(place, time).velocity;
}

WindBox::Sample WindBox::with_gradient(const Vec3& place, double time) const {
    return sample<true>(place, time);
}

Vec3 WindBox::at_point(int step, int row, int column) const {
    Vec3 out;
    for (int c = 0; c < 3; ++c) {
        const BoxNumbers& of = data_.components[static_cast<std::size_t>(c)];
        out(c) = number_at(of, step * of.step + row * of.row + column * of.column);
    }
    if (!data_.means.empty()) out(0) -= mean_of(data_.means, data_.grid.columns, row, column);
    return out;
}

WindBox::Statistics WindBox::statistics(int row, int column) const {
    Vec3 sum = Vec3::Zero(), squares = Vec3::Zero();
    for (int t = 0; t < data_.grid.steps; ++t) sum += at_point(t, row, column);
    const Vec3 mean = sum / data_.grid.steps;
    for (int t = 0; t < data_.grid.steps; ++t) squares += (at_point(t, row, column) - mean).cwiseAbs2();
    return {mean, (squares / data_.grid.steps).cwiseSqrt()};
}

WindBox WindBox::with_outside(OutsideBox outside) const {
    WindBoxData data = data_;
    data.outside = outside;
    return WindBox(std::move(data));
}

std::uint64_t checksum_of(std::span<const std::byte> bytes, std::uint64_t before) {
    constexpr std::uint64_t prime = 0x100000001b3ULL;
    std::uint64_t sum = before;
    std::size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
        std::uint64_t eight = 0;
        std::memcpy(&eight, bytes.data() + i, sizeof eight);
        sum = (sum ^ eight) * prime;
    }
    for (; i < bytes.size(); ++i) sum = (sum ^ static_cast<std::uint64_t>(bytes[i])) * prime;
    return sum;
}

std::string checksum_text(std::uint64_t checksum) {
    constexpr const char* digits = "0123456789abcdef";
    std::string out(16, '0');
    for (int i = 15; i >= 0; --i, checksum >>= 4) out[static_cast<std::size_t>(i)] = digits[checksum & 15];
    return out;
}

}  // namespace cardan
