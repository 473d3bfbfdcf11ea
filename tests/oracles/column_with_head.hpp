#pragma once

#include <functional>
#include <vector>

namespace cardan::oracles {

/// A clamped Euler-Bernoulli column of smoothly varying section that bends in one plane, with a rigid body on its top:
/// a tower with its nacelle. Any consistent set of units.
struct ColumnWithHead {
    std::vector<double> breaks;                       ///< 0 = x_0 < ... < x_n = L; EI and mu are smooth in between
    std::function<double(double)> bending_stiffness;  ///< EI(x)
    std::function<double(double)> mass_per_length;    ///< mu(x), a line of mass: no rotary inertia
    double head_mass = 0;
    double head_height = 0;   ///< of its mass centre above the top
    double head_inertia = 0;  ///< about its mass centre
    double gravity = 0;       ///< downward, along the column

    /// The first natural frequencies, rad/s, rising.
    ///     (EI w'')'' + (N w')' = omega^2 mu w,  N(x) = g (m + int_x^L mu),  w(0) = w'(0) = 0,
    ///     EI w'' = m g h w' + omega^2 (m h (w + h w') + J w'),  (EI w'')' + N w' = -omega^2 m (w + h w')  at x = L
    /// by integration of two solutions from the foot (Runge-Kutta of order 4, `steps` per stretch between the breaks)
    /// and zeros of their determinant at the top.
    /// @param spacing  of the walk over omega; zeros closer than that are overlooked
    std::vector<double> frequencies(int count, double spacing, int steps = 40) const;

private:
    double determinant(double omega, int steps) const;
};

}  // namespace cardan::oracles
