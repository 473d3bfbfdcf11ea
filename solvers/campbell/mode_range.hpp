/// @file
/// Range of the modes of a constant system that a Campbell diagram computes.
#pragma once

#include "solvers/campbell/diagram.hpp"

namespace cardan::solvers {

/// All at the first point: names are decided by all of them. Then those up to one and a half times the largest
/// frequency of the diagram, or as far as the 24 lowest of the first point reach, so that a small largest frequency
/// does not change names; and twice the rotor speed more, since whirl modes fan out by the rotor speed.
///
/// With many states (has_many_states()) the first point is no exception unless all motions of states are wanted: the 24
/// lowest are those with the states held.
class ModeRange {
public:
    /// Largest |eigenvalue| at a rotor speed, rad/s; infinite: all modes.
    /// @param system  whose modes are computed next
    double largest(const CampbellOptions& options, double rotor_speed, const SecondOrderSystem& system);
    /// Tells what was found. Counts at the first point only.
    /// @param modes  by natural frequency
    void set(const std::vector<CampbellMode>& modes, double rotor_speed);

private:
    void set_usual(const std::vector<Complex>& eigenvalues, double rotor_speed);

    double usual_ = -1;  // that of the 24 lowest; negative: before the first point
};

}  // namespace cardan::solvers
