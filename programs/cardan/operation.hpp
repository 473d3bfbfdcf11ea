/// @file
/// How a machine runs, as its source says or the options do: rotor speeds, pitch.
#pragma once

#include "solvers/campbell/diagram.hpp"

#include "programs/shared/machine_file.hpp"

namespace cardan::program {

/// One speed: what was asked for, rev/min, or the machine's, which is told.
/// @return rad/s;  @throws InputError if there is none
double rotor_speed(const std::optional<double>& asked_rpm, const turbines::Machine& machine);

/// Without a pitch among the options, that of the machine at a rotor speed, rad/s, is put there, and told.
void set_pitch(const turbines::Machine& machine, MachineOptions& options, double rotor_speed);

/// The mean over the azimuth where blades are equal and gravity or an unbalanced hub makes the equations periodic: an
/// approximation that serves them. Else what suits.
solvers::CampbellMethod diagram_method(const turbines::Machine& machine, const MachineOptions& options);

/// Free, or prescribed where the generator is locked.
solvers::RotorSpin rotor_spin(const turbines::Machine& machine);

/// Puts into a diagram what it holds for, how accurate it is, by which command it was made, and the machine.
/// @param name  of the command
void tell_origin(solvers::Campbell& diagram, const std::string& name, const CommandLine& command,
                 const turbines::Machine& machine, const ReadyMachine& ready);

/// Of a picture: the machine, and what the diagram holds for.
std::string title_of(const solvers::Campbell& diagram);

/// The name of the machine's file without its ending, and what was made of it: "NREL-5MW_campbell".
std::string default_prefix(const std::string& machine, const char* what);

}  // namespace cardan::program
