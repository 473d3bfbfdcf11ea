#include "elements/wind/wind.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cardan {

namespace {

// What a table over time changes linearly.
constexpr std::array changing{
    &SteadyWind::speed,    &SteadyWind::reference_height, &SteadyWind::exponent, &SteadyWind::roughness,
    &SteadyWind::gradient, &SteadyWind::direction,        &SteadyWind::veer,     &SteadyWind::upflow,
    &SteadyWind::density,  &SteadyWind::lateral,          &SteadyWind::gust,     &SteadyWind::vertical,
    &SteadyWind::ground};

// Linear between the rows.
SteadyWind row_at(const std::vector<double>& times, const std::vector<SteadyWind>& rows, double time) {
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    if (next == times.begin()) return rows.front();
    if (next == times.end()) return rows.back();
    const auto i = static_cast<std::size_t>(next - times.begin());
    const SteadyWind &from = rows[i - 1], &to = rows[i];
    const double t = (time - times[i - 1]) / (times[i] - times[i - 1]);
    SteadyWind out = from;
    for (const auto value : changing) out.*value = (1 - t) * from.*value + t * to.*value;
    return out;
}

// Speed and exponent of a power law through the mean wind of a box, over its planes at the middle column.
void take_mean(const WindBox& box, SteadyWind& steady) {
    const BoxGrid& grid = box.grid();
    std::vector<double> heights, speeds(static_cast<std::size_t>(grid.rows));
    for (int row = 0; row < grid.rows; ++row) heights.push_back(grid.height_of(row));
    // Plane by plane, as they lie in files.
    for (int step = 0; step < grid.steps; ++step)
        for (int row = 0; row < grid.rows; ++row)
            speeds[static_cast<std::size_t>(row)] += box.at_point(step, row, grid.columns / 2).x();
    for (double& speed : speeds) speed /= grid.steps;
    const double at = std::clamp((steady.reference_height - grid.lowest) / grid.row_spacing, 0.0, grid.rows - 1.0);
    const auto below = static_cast<std::size_t>(std::min(static_cast<int>(at), grid.rows - 2));
    steady.speed = std::max(0.0, std::lerp(speeds[below], speeds[below + 1], at - static_cast<double>(below)));
    steady.shear = Shear::none;
    double product = 0, square = 0;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        if (!(heights[i] > 0 && speeds[i] > 0 && steady.speed > 0)) return;
        const double x = std::log(heights[i] / steady.reference_height);
        product += x * std::log(speeds[i] / steady.speed);
        square += x * x;
    }
    steady.shear = Shear::power;
    steady.exponent = std::clamp(product / square, -1.0, 1.0);
}

}  // namespace

Wind::Wind(const SteadyWind& steady) : times_{0}, rows_{steady} {
    steady.check();
}

Wind::Wind(std::vector<double> times, std::vector<SteadyWind> rows) : times_(std::move(times)), rows_(std::move(rows)) {
    if (rows_.empty() || times_.size() != rows_.size())
        throw InputError("wind over time", "rows", rows_.size(), text("as many as times, ", times_.size(), ", >= 1"));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const auto here = text("wind over time, row ", i + 1);
        if (!std::isfinite(times_[i]) || (i > 0 && times_[i] < times_[i - 1]))
            throw InputError(here, "time [s]", times_[i], "finite, not descending");
        if (rows_[i].shear != rows_.front().shear)
            throw InputError(here, "law of the shear", "another one", "that of the first row");
        try {
            rows_[i].check();
        } catch (const InputError& error) {
            throw InputError(text(here, ": ", error.what()));
        }
    }
}

Wind::Wind(std::shared_ptr<const WindBox> box, const SteadyWind& steady)
    : Wind(Wind(steady).with_box(std::move(box))) {}

SteadyWind Wind::without_box(double time) const {
    const SteadyWind now = row_at(times_, rows_, time);
    return gust_ ? gust_->applied(now, time) : now;
}

SteadyWind Wind::mean(double time) const {
    SteadyWind out = without_box(time);
    if (box_ && out.speed == 0) take_mean(*box_, out);
    if (axes_) {
        out.direction += axes_->direction;
        out.upflow += axes_->upflow;
    }
    return out;
}

WindAtTime Wind::at(double time) const {
    return {*this, time};
}

WindAxes::WindAxes(double to, double up, double about) : direction(to), upflow(up), pivot(about) {
    const double ca = std::cos(to), sa = std::sin(to), cb = std::cos(up), sb = -std::sin(up);
    R << cb * ca, cb * sa, -sb, -sa, ca, 0, sb * ca, sb * sa, cb;
}

Wind Wind::turned(double direction, double upflow) const {
    Wind out = *this;
    if (!box_ && !axes_ && upflow == 0) {
        for (SteadyWind& row : out.rows_) {
            row.direction += direction;
            row.check();
        }
        return out;
    }
    SteadyWind extremes = rows_.front();  // of which the angles are checked
    extremes.direction = direction + (axes_ ? axes_->direction : 0);
    extremes.upflow = upflow + (axes_ ? axes_->upflow : 0);
    extremes.check();
    out.axes_ = WindAxes(extremes.direction, extremes.upflow, extremes.reference_height);
    return out;
}

Wind Wind::over(double ground) const {
    Wind out = *this;
    for (SteadyWind& row : out.rows_) row.ground = ground;
    return out;
}

Wind Wind::with(const Gust& gust) const {
    gust.check();
    Wind out = *this;
    out.gust_ = gust;
    return out;
}

Wind Wind::with_box(std::shared_ptr<const WindBox> box) const {
    if (!box) throw InputError("wind", "box", "none", "one; a steady wind needs none");
    Wind out = *this;
    out.box_ = std::move(box);
    return out;
}

Wind Wind::with_axes(const WindAxes& axes) const {
    Wind out = *this;
    out.axes_ = axes;
    return out;
}

Wind Wind::with_outside(OutsideBox outside) const {
    Wind out = *this;
    if (box_) out.box_ = std::make_shared<const WindBox>(box_->with_outside(outside));
    return out;
}

std::vector<double> Wind::breaks() const {
    std::vector<double> out;
    if (rows_.size() > 1) out = times_;
    if (gust_) {
        const std::vector<double> more = gust_->breaks();
        out.insert(out.end(), more.begin(), more.end());
        std::ranges::sort(out);
    }
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

WindAtTime::WindAtTime(const Wind& wind, double time, double more_speed)
    : steady_([&] {
          SteadyWind now = wind.without_box(time);
          now.speed += more_speed;
          return now;
      }()),
      box_(wind.box_.get()),
      axes_(wind.axes_ ? &*wind.axes_ : nullptr),
      time_(time) {}

// In axes of the wind.
Vec3 WindAtTime::turned(const Vec3& place) const {
    const Vec3 pivot(0, 0, steady_.wind().ground + axes_->pivot);
    return axes_->R * (place - pivot) + pivot;
}

Vec3 WindAtTime::in_own_axes(const Vec3& place) const {
    Vec3 out = steady_.at(place);
    if (box_ != nullptr) out += box_->at(place - Vec3(0, 0, steady_.wind().ground), time_);
    return out;
}

Vec3 WindAtTime::at(const Vec3& place) const {
    if (axes_ == nullptr) return in_own_axes(place);
    return axes_->R.transpose() * in_own_axes(turned(place));
}

void WindAtTime::at(std::span<const Vec3> places, std::span<Vec3> out) const {
    if (box_ == nullptr && axes_ == nullptr) return steady_.at(places, out);
    for (std::size_t i = 0; i < places.size(); ++i) out[i] = at(places[i]);
}

Mat3 WindAtTime::gradient_at(const Vec3& place) const {
    if (box_ == nullptr && axes_ == nullptr) return steady_.wind().gradient_at(place);
    const Vec3 own = axes_ == nullptr ? place : turned(place);
    Mat3 out = steady_.wind().gradient_at(own);
    if (box_ != nullptr) out += box_->with_gradient(own - Vec3(0, 0, steady_.wind().ground), time_).gradient;
    if (axes_ == nullptr) return out;
    return axes_->R.transpose() * out * axes_->R;
}

}  // namespace cardan
