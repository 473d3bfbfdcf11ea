/// @file
/// Campbell diagram of a machine over the rotor speed or, in the air, over the wind speed.
///
///     const turbines::Machine machine = turbines::read_machine("MODEL.fst");
///     const turbines::CampbellDiagram diagram = turbines::campbell(machine, {.winds = {6, 8, 10, 12}});
///     std::cout << solvers::table(diagram);
///     solvers::write_hdf5(diagram, "diagram.h5");
///
/// It is what `cardan campbell` computes, to the last digit.
#pragma once

#include "solvers/campbell/diagram.hpp"
#include "turbines/analysis/settings.hpp"
#include "turbines/machine/machine.hpp"
#include "turbines/model/assembly.hpp"

#include <optional>
#include <vector>

namespace cardan::turbines {

/// A Campbell diagram with the machine in its description (`source`), and what it holds for and how accurate it is in
/// words.
struct CampbellDiagram : solvers::Campbell {
    CampbellSettings settings = {};  ///< with what was not given: rotor speeds, schedule of the pitch, frequency
    Mesh mesh = {};
    std::optional<Turbine> turbine = {};     ///< at the last rotor speed, or without its air
    std::vector<double> not_converged = {};  ///< winds without a state, m/s: left out
    std::vector<Remark> remarks = {};        ///< what it had to say
};

/// At every rotor speed the machine is brought to its steady state, linearised, and its modes are followed from one to
/// the next. Three and more equal blades: with gravity or an unbalanced hub the modes are those of the mean over the
/// azimuth, otherwise exact in multi-blade coordinates; two blades or blades that differ: Floquet's. Over the wind the
/// states are those of operating points in the air, and the air follows the vibrations as the settings say.
/// @throws InputError for settings out of range, with the field, and for what the machine does not have: a rotor speed,
/// airfoils, rated power, a mode up to the frequency; NumericalError where no steady state is found
CampbellDiagram campbell(const Machine& source, const CampbellSettings& settings = {});

}  // namespace cardan::turbines
