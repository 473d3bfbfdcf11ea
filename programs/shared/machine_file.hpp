/// @file
/// A machine as the argument of a program, with the options that change it, on its way to a solver.
#pragma once

#include "programs/shared/command_line.hpp"
#include "turbines/analysis/prepared_machine.hpp"
#include "turbines/machine/read_machine.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cardan::program {

/// Text on what may be given as a machine, with the names of the built-in ones: for the help of a program.
std::string machine_help();

/// Options of programs for any machine.
struct MachineOptions {
    std::string model;
    std::string generator, yaw, tower, blades;             ///< of one_of(); empty: as the model says
    std::string foundation;                                ///< file
    std::vector<std::string> with, set;                    ///< additions: files, KEY=VALUE
    int blade_elements = 0, tower_elements = 0;            ///< 0: as many as it takes
    std::optional<double> pitch;                           ///< deg; none: the model's
    double generator_inertia = 0;                          ///< 0: the model's
    std::optional<double> blade_damping, tower_damping;    ///< %
    std::optional<double> pitch_stiffness, pitch_damping;  ///< N m/rad, N m s/rad
    bool gravity = false, undamped = false, notes = false, summary = false;
    /// Entries that the model's files ask for and the model does not have, as far as they have been read.
    std::vector<turbines::FileNote> left_out = {};
};

/// The machine's argument.
void add_machine(CommandLine& app, MachineOptions& options);
/// Adds options of what is added to the model, and of what replaces its own settings.
void add_source_options(CommandLine& app, MachineOptions& options);
/// Adds the options of the source, with pitch, numbers of elements, damping and what is printed; gravity is left to the
/// program.
void add_machine_options(CommandLine& app, MachineOptions& options);

/// Prints notes, if `all` are wanted, else how many there are, in a line, and those on unusual entries. What several
/// files have alike, as those of blades, is one note.
/// @param what  they are: the begin of the line
void print_notes(const std::vector<turbines::FileNote>& notes, bool all, const char* what = "notes");
/// Prints notes, and keeps what is left out.
void print_notes(const std::vector<turbines::FileNote>& notes, MachineOptions& options, const char* what = "notes");
/// Prints in a line behind a result what is left out.
void print_left_out(const MachineOptions& options);

/// Reads the machine, prints notes, degrees of freedom and what the tower stands on, and puts what was asked for in the
/// place of what the machine's source says. The options then hold what was taken in all cases.
/// @throws InputError also for a yaw bearing that is to be free without a spring
turbines::Machine prepared_machine(MachineOptions& options);

/// Settings of the options beside what prepared_machine() puts into the machine: pitch, numbers of elements, damping.
turbines::MachineSettings numbers_of(const MachineOptions& options);
/// Puts what the library has taken there where nothing was given.
void keep_taken(const turbines::MachineSettings& taken, MachineOptions& options);

/// A report that prints remarks on the terminal as the library makes them.
/// @param all_notes  as print_notes()
turbines::Report remarks_printed(bool all_notes);

/// Chooses the mesh, assembles, prints what the assembly has to say. The options then hold the numbers of elements.
/// @param max_hz   frequencies up to here shall be right
/// @param rotor_speed  highest, rad/s
turbines::PreparedTurbine ready_machine(const turbines::Machine& machine, MachineOptions& options, double max_hz,
                                        double rotor_speed);

/// Beams, pitch, gravity and damping.
turbines::AssemblyOptions assembly_options(const turbines::Machine& machine, const MachineOptions& options);

/// Usual maximum frequency, as turbines::usual_frequency().
double usual_frequency(const turbines::Machine& machine, const MachineOptions& options);

/// Head of the input description of a result: the command with its options as they were used. Behind it stands
/// turbines::with_machine().
std::string run_text(const std::string& command, const CommandLine& options);

}  // namespace cardan::program
