/// @file
/// End stops of a joint, such as a teeter hinge or a pitch bearing.
#pragma once

#include "mbs/system/forces.hpp"

#include <string>

namespace cardan {

/// A spring and a damper beyond a limit, on one side. Over a depth w the spring grows as x^2 / 2w to its stiffness and
/// the damper as 3 (x/w)^2 - 2 (x/w)^3 to its value, so that force and derivatives are continuous. While in contact the
/// damper acts in both directions; on fast separation it briefly pulls back.
struct EndStop {
    std::string name = "end stop";
    BodyId coordinate = {};
    double limit = 0;      ///< rad or m
    bool upper = true;     ///< acts above the limit; else below
    double stiffness = 0;  ///< N m/rad or N/m
    double damping = 0;    ///< N m s/rad or N s/m
    double depth = 0;      ///< w, rad or m, > 0

    /// Force along the coordinate.
    template <class S>
    S force(S position, S rate) const {
        const double sense = upper ? 1 : -1;
        const S x = sense * (position - limit), u = x / depth;
        if (real(u) <= 0) return S(0);
        const S v = sense * rate;
        if (real(u) >= 1) return -sense * (stiffness * (x - depth / 2) + damping * v);
        return -sense * (stiffness * x * u / 2.0 + damping * u * u * (3.0 - 2.0 * u) * v);
    }
    /// Energy of the spring, J.
    double energy(double position) const;

private:
    static double real(double value) { return value; }
    static double real(const Complex& value) { return value.real(); }
};

/// Force element with exact Jacobian. @throws InputError: a limit that is not finite, negative stiffness or damping,
/// depth not positive
ForceElement end_stop_force(const EndStop& stop);

}  // namespace cardan
