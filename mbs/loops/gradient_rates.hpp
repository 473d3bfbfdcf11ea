/// @file
/// Rates of the loops' gradients along a motion.
#pragma once

#include "mbs/loops/loops.hpp"

namespace cardan {

/// First and second derivatives by time of phi_a along a motion: what a deviation dx(t) from it has to fulfil,
///
///     phi_a dx^a = 0,   phi_a dx'^a + phi'_a dx^a = 0,   phi_a dx''^a + 2 phi'_a dx'^a + phi''_a dx^a = 0.
///
/// They are the derivatives of phi' and phi'' by q, by complex steps: exact. With surfaces and constraints of one's
/// own, which are known for real numbers only, by differences (relative 1e-9). One object per thread.
class GradientRates {
public:
    /// Model and loops must live as long as this.
    GradientRates(const Model& model, const Loops& loops);

    /// @param first, second  out, equations x coordinates.  Cost O(n) evaluations of all equations.
    /// @throws InputError for sizes
    void at(double time, VectorIn q, VectorIn qd, VectorIn qdd, Matrix& first, Matrix& second);

private:
    const Model& model_;
    const Loops& loops_;
    WorkspaceT<Complex> complex_;
    Workspace real_;
};

}  // namespace cardan
