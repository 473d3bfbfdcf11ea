/// @file
/// Modes of systems with many states of first order: those of the motion, one after another. Internal to solvers: not
/// installed.
#pragma once

#include "solvers/linear/linearise.hpp"

#include <vector>

namespace cardan::solvers {

struct ModesOfMotion {
    struct Value {
        Complex eigenvalue;    ///< 1/s, of pairs the one with positive imaginary part
        ComplexVector vector;  ///< coordinates, then states
        double state_share;    ///< Mode::state_share
    };
    /// Every mode without lags and with a damping ratio below 0.4 has led to one of its own, and no other root grows,
    /// by the argument principle (growing_roots()).
    bool complete = false;
    std::vector<Value> values = {};
};

/// The modes up to an |eigenvalue| that those of the machine without lags become as the lags appear. Without lags, the
/// states act as they would at one frequency w,
///
///     K_0 = K - Re G(i w),  C_0 = C - Im G(i w) / w,  G(s) = Q_s (s - f_s)^-1 (f_q + s f_qd),
///
/// which leaves 2 n modes. Each is followed by inverse iteration with right and left vector next to its eigenvalue, the
/// states eliminated (ShiftedStates): at once, and where this leads to another shape or to a mode that is known
/// already, with lags that appear little by little, G_t = (1 - t) G_0 + t G. Roots that are mostly states of their own,
/// of which there are as many as states, are not looked for.
///
/// Cost 25 (2 n)^3, some 40 points of growing_roots() and three or four of ShiftedStates for each mode.
/// @param units  as left_vector()
/// @param scale  a rate near the lowest frequency, rad/s
ModesOfMotion modes_of_motion(const SecondOrderSystem& system, const Vector& units, double scale, double largest);

}  // namespace cardan::solvers
