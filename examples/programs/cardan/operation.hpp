/// @file
/// How a machine runs, as its source says or the options do: rotor speeds, pitch.
#pragma once

#include "solvers/campbell/diagram.hpp"

#include "examples/shared/machine_file.hpp"

namespace cardan::program {

/// One speed: what was asked for, rev/min, or the machine's, which is told.
/// @return rad/s;  @throws InputError if there is none
double rotor_speed(const std::optional<double>& asked_rpm, const MachineFile& machine);

/// Without a pitch among the options, that of the machine at a rotor speed, rad/s, is put there, and told.
void set_pitch(const MachineFile& machine, MachineOptions& options, double rotor_speed);

/// The mean over the azimuth where blades are equal and gravity or an unbalanced hub makes the equations periodic: an
/// approximation that serves them. Else what suits.
solvers::CampbellMethod diagram_method(const MachineFile& machine, const MachineOptions& options);

/// The name of the machine's file without its ending, and what was made of it: "NREL-5MW_campbell".
std::string default_prefix(const std::string& machine, const char* what);

}  // namespace cardan::program
