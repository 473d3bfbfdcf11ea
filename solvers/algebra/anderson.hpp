/// @file
/// Acceleration of fixed-point iterations.
#pragma once

#include "mbs/base/types.hpp"

namespace cardan::solvers {

/// Combines those of the last iterations of x := x + f(x) that cancel the present f best: in linear problems as
/// fast as GMRES, in others often where the plain iteration would not converge.     [Anderson 1965; Walker and Ni 2011]
///
/// KINSOL has the same (KINSetMAA), but the loop is KINSOL's then; those that use this keep the best state and give up
/// when it has not improved for some steps.
class Anderson {
public:
    /// @param size   of x
    /// @param depth  number of past iterations that are kept, >= 1
    Anderson(Eigen::Index size, Eigen::Index depth) : dX_(size, depth), dF_(size, depth) {}

    /// The next x. What is linear in x and holds for x and x + f, it holds for the result, too.
    /// @param x  before; f, the change by a plain iteration, in units that make its entries comparable
    Vector next(const Vector& x, const Vector& f);

private:
    Matrix dX_, dF_;
    Vector last_x_, last_f_;
    Eigen::Index count_ = 0;
};

}  // namespace cardan::solvers
