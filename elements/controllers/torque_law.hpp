/// @file
/// Torque of a generator of variable speed over the speed of its shaft.
#pragma once

#include <string_view>

namespace cardan {

/// optimal_gain speed^2 up to where that meets the line of an induction machine with this slip at the rated torque;
/// that line up to the rated speed; the rated torque beyond. Turned backwards it brakes as well: the law is odd.
///                    [J. Jonkman, S. Butterfield, W. Musial, G. Scott 2009, NREL/TP-500-38060, section 7.2]
struct TorqueLaw {
    struct At {
        double torque = 0;    ///< N m, positive: brakes forward rotation
        double by_speed = 0;  ///< N m s/rad
    };

    double rated_speed = 0;   ///< rad/s
    double rated_torque = 0;  ///< N m
    double optimal_gain = 0;  ///< N m / (rad/s)^2
    double slip = 0;          ///< rated speed over the synchronous one, minus 1

    bool acts() const { return rated_torque != 0; }
    /// Speed at which the line of the induction machine begins, rad/s.
    double synchronous_speed() const { return rated_speed / (1 + slip); }
    /// Slope of the line of the induction machine, N m s/rad.
    double slope() const { return rated_torque / (rated_speed - synchronous_speed()); }
    /// Speed at which that line meets the parabola, rad/s; not a number if it does not.
    double transition_speed() const;
    /// @param speed  rad/s
    At at(double speed) const;
    /// @throws InputError naming `where` unless speed and torque are positive, the slip is 1e-4 ... 1, the gain is not
    /// negative and the parabola meets the line below the rated speed
    void check(std::string_view where) const;
};

}  // namespace cardan
