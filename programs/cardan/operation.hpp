/// @file Operation of a machine, as its source says or the options do: rotor speeds, pitch.
#pragma once

#include "programs/shared/machine_file.hpp"
#include "solvers/campbell/diagram.hpp"

namespace cardan::program {

/// rad/s; none: it was not asked for.  @throws InputError for what is not finite
std::optional<double> asked_speed(const std::optional<double>& asked_rpm);

/// One speed: what was asked for, rev/min, or the machine's, which is told.
/// @return rad/s;  @throws InputError if there is none
double rotor_speed(const std::optional<double>& asked_rpm, const turbines::Machine& machine);

/// Puts the pitch of the machine at a rotor speed, rad/s, into options without one, and prints it.
void set_pitch(const turbines::Machine& machine, MachineOptions& options, double rotor_speed);

/// --like
void add_like(CommandLine& app, std::string& file);

/// Title of a picture: the machine, and what the diagram holds for.
std::string title_of(const solvers::Campbell& diagram);

/// The name of the machine's file without its ending, and what was made of it: "NREL-5MW_campbell".
std::string default_prefix(const std::string& machine, const char* what);

}  // namespace cardan::program
