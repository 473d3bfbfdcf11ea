/// @file
/// The cases, by family.
#pragma once

#include "examples/studies/beam_accuracy/study.hpp"

namespace cardan::accuracy {

// cases_rest.cpp
Study uniform_at_rest();
Study timoshenko();
Study wedge();
Study strong_taper();
Study torsion();
// cases_rotation.cpp
Study rotating_slowly();
Study rotating_fast();
// cases_statics.cpp
Study column();
Study elastica();
Study bend();
Study round_hinges();
Study flat_hinges();
// cases_blades.cpp
Study wt600_at_rest();
Study wt600_rotating();
Study wt600_placed();
Study nrel_at_rest();
Study nrel_rotating();
Study nrel_placed();

/// Uniform, L = EI = mass = 1, shear rigid and without rotary inertia.
inline EngineeringSection slender() {
    EngineeringSection s;
    s.mass = s.EI_flap = s.EI_edge = 1;
    return s;
}

}  // namespace cardan::accuracy
