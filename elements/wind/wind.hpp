/// @file
/// Wind over place and time: steady, tabulated, with a gust, turbulent, or several of these; one velocity and its
/// exact gradient.
///
///     const Wind wind(box, {.speed = 12, .exponent = 0.2});
///     const Vec3 there = wind.at(3.5).at({0, 10, 90});  // m/s
#pragma once

#include "elements/wind/gust.hpp"
#include "elements/wind/steady_wind.hpp"
#include "elements/wind/wind_box.hpp"
#include "mbs/base/lifetime_bound.hpp"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace cardan {

/// Axes that a whole wind is turned to, about a point above the base's origin: with all that it holds.
struct WindAxes {
    double direction = 0;       ///< to the left, rad
    double upflow = 0;          ///< above the horizontal, rad
    double pivot = 0;           ///< height of the point, m
    Mat3 R = Mat3::Identity();  ///< from ground axes to those of the wind

    WindAxes() = default;
    WindAxes(double to, double up, double about);  ///< direction, upflow, pivot
};

class WindAtTime;

/// A wind: steady, or one that changes linearly between the rows of a table over time and is held before and after
/// them; with a gust, that changes it, and with a box, whose velocities are added.
class Wind {
public:
    Wind(const SteadyWind& steady);  // NOLINT(google-explicit-constructor): a steady wind is one
    /// @param times  s, not descending; two rows of the same time are a step, after which the second one holds
    /// @throws InputError for lists of different length or empty, times that descend, rows with different laws of the
    /// shear, and as SteadyWind::check()
    Wind(std::vector<double> times, std::vector<SteadyWind> rows);
    /// A turbulent wind.
    /// @param steady  that is added; without a speed where the box holds the mean wind. Its reference height is that
    ///                 about which the wind is turned
    Wind(std::shared_ptr<const WindBox> box, const SteadyWind& steady);

    /// The wind of a time, for many places.
    WindAtTime at(double time) const CARDAN_LIFETIME_BOUND;
    /// The wind of a time without the box, before it is turned.
    SteadyWind without_box(double time) const;
    /// A steady wind near to it: that of the table and the gust at a time, turned, with the speed and the shear of the
    /// box's mean over its planes at the middle column. That from which runs in time start.
    SteadyWind mean(double time = 0) const;

    bool is_steady() const { return rows_.size() == 1 && !gust_ && !box_; }
    /// A copy with angles added to its direction and its upflow, rad. An upflow, and any turn of a box, turns also the
    /// places, about the reference height above the base's origin [InflowWind].  @throws InputError for angles out of
    /// range
    Wind turned(double direction, double upflow) const;
    /// A copy with heights counted from there, m.
    Wind over(double ground) const;
    /// A copy with a gust.  @throws InputError as Gust::check()
    Wind with(const Gust& gust) const;
    /// A copy with a box, or another one.  @throws InputError for none
    Wind with_box(std::shared_ptr<const WindBox> box) const;
    /// A copy that is turned to these axes and no others.
    Wind with_axes(const WindAxes& axes) const;
    /// A copy with another answer to what is outside its box; without one it is as it was.
    Wind with_outside(OutsideBox outside) const;
    /// Times at which the wind is not smooth: those of the table and of the gust. Those of a box's planes, which differ
    /// from place to place, are not among them. Empty: it is steady.
    std::vector<double> breaks() const;
    const std::vector<double>& times() const { return times_; }  ///< of the rows, s; of a steady wind 0
    const std::vector<SteadyWind>& rows() const { return rows_; }
    const WindBox* box() const { return box_.get(); }  ///< null: there is none
    const std::optional<Gust>& gust() const { return gust_; }
    const std::optional<WindAxes>& axes() const { return axes_; }  ///< none: it is not turned as a whole

private:
    friend class WindAtTime;

    std::vector<double> times_;
    std::vector<SteadyWind> rows_;
    std::optional<Gust> gust_ = {};
    std::optional<WindAxes> axes_ = {};
    std::shared_ptr<const WindBox> box_ = {};
};

/// Velocities of a wind at one time. Valid as long as the wind that it was taken from.
class WindAtTime {
public:
    /// @param more_speed  added to the speed at the reference height, m/s
    WindAtTime(const Wind& wind CARDAN_LIFETIME_BOUND, double time, double more_speed = 0);
    explicit WindAtTime(const SteadyWind& wind) : steady_(wind) {}

    /// m/s.  @throws InputError as WindBox::at()
    Vec3 at(const Vec3& place) const;
    /// Velocities at many places.
    /// @param out  as many
    void at(std::span<const Vec3> places, std::span<Vec3> out) const;
    /// dW_i/dx_j, 1/s.
    Mat3 gradient_at(const Vec3& place) const;
    double density() const { return steady_.wind().density; }  ///< of the air, kg/m^3

private:
    Vec3 turned(const Vec3& place) const;       // to axes of the wind
    Vec3 in_own_axes(const Vec3& place) const;  // velocity, all in axes of the wind

    SteadyWindAtPlaces steady_;
    const WindBox* box_ = nullptr;
    const WindAxes* axes_ = nullptr;
    double time_ = 0;
};

}  // namespace cardan
