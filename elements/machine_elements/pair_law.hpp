/// @file
/// Forces between two frames that depend on how they lie and move as seen from one another: springs, bushings,
/// bearings, contact.
#pragma once

#include "mbs/loops/relative_measure.hpp"
#include "mbs/system/forces.hpp"

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace cardan {

/// Measure that a pair law depends on: a weighted sum of two relative measures at most.
struct PairMeasure {
    std::array<RelativeMeasure, 2> parts = {};
    std::array<double, 2> weights = {1, 0};

    /// Offset of the origin of b from that of a along axis i (0, 1, 2) of a, m.
    static PairMeasure along(int i) { return {{RelativeMeasure{RelativeMeasure::Kind::along, i, 0}, {}}, {1, 0}}; }
    /// Rotation of b against a about axis i, as the sine of the angle about one axis: half the skew part of the
    /// rotation matrix.
    static PairMeasure turn(int i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        return {{RelativeMeasure{RelativeMeasure::Kind::square, k, j}, {RelativeMeasure::Kind::square, j, k}},
                {0.5, -0.5}};
    }
    /// Distance of the origins from one another, m.
    static PairMeasure distance() { return {{RelativeMeasure{RelativeMeasure::Kind::distance, 0, 0}, {}}, {1, 0}}; }
};

/// Forces of a pair law, one entry per measure; all zero when it is asked.
struct PairForces {
    Vector f = {};                ///< on the measures: Q_a = f_i dx_i/dq^a
    Matrix by_x = {}, by_v = {};  ///< df_i/dx_j, df_i/dv_j
    double energy = 0;            ///< J, where the law has one
};

/// f_i(t, x, v) of a few measures between frames a and b.
struct PairLaw {
    std::string name = {};
    FrameId a = {}, b = {};
    std::vector<PairMeasure> measures = {};
    /// @param x, v  the measures and their rates
    std::function<void(double time, const Vector& x, const Vector& v, PairForces& out)> law = {};
    bool has_energy = true;  ///< `energy` means something
    bool elastic = true;     ///< counts as elastic stiffness
};

/// Acts at both frames, so that loads of joints and channels take it into account; exact derivatives.
/// @throws InputError: no measure, no law, one frame
ForceElement pair_force(const PairLaw& pair);

}  // namespace cardan
