/// @file
/// Values in other units, for those who have to get the same value back.
#pragma once

namespace cardan::turbines {

/// A value in a unit: the number of fewest digits that, times the unit, is the value to the last bit; if there is none,
/// value / unit.
double in_unit(double value, double unit);
/// The value itself, if in_unit() has a number that gives it, else the nearest one that has: what a user may write in
/// that unit.
inline double representable(double value, double unit) {
    return in_unit(value, unit) * unit;
}

}  // namespace cardan::turbines
