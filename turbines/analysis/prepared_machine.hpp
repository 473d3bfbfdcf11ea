/// @file
/// A machine on its way to a solver: what is otherwise than its source says, how it runs, its mesh.
#pragma once

#include "solvers/campbell/diagram.hpp"
#include "turbines/analysis/settings.hpp"
#include "turbines/machine/machine.hpp"

namespace cardan::turbines {

/// Degrees of freedom, foundation and generator as set. Beams of a machine that its source holds altogether bend, with
/// a note. Applied twice it is what it was.
/// @throws InputError for a yaw that is to be free without a spring, and a foundation beside a platform
Machine with_settings(Machine machine, const MachineSettings& settings, const Report& report = {});

/// Beams, pitch, damping and gravity. How the generator turns is left to the analysis.
AssemblyOptions assembly_options(const Machine& machine, const MachineSettings& settings, bool gravity);

struct PreparedTurbine {
    Turbine turbine;
    Mesh mesh;  ///< in figures also where numbers of elements were given
};
/// Warnings of the assembly are reported.
/// @param assembly  assembly_options()
/// @param max_hz    frequencies up to here shall be right
/// @param rotor_speed  highest, rad/s
PreparedTurbine assembled(const Machine& machine, AssemblyOptions assembly, double max_hz, double rotor_speed,
                          const Report& report = {});

/// Before what is done with full matrices.
/// @throws InputError: too many coordinates for that, or none
void check_size(const Turbine& turbine);

/// The numbers of elements that were chosen become those of the settings.
void keep_elements(const Mesh& mesh, MachineSettings& settings);

/// One speed, rad/s: that which is asked for, or the machine's, which is reported.
/// @param field  that asks, for errors
/// @throws InputError for what is not finite
double rotor_speed_of(const std::optional<double>& asked, const Machine& machine, const char* field,
                      const Report& report = {});
/// Pitch at a rotor speed, given or the machine's, rad.
double pitch_at_speed(const std::optional<double>& asked, const Machine& machine, double rotor_speed,
                      const Report& report = {});

/// Free, or prescribed where the generator is locked.
solvers::RotorSpin rotor_spin(const Machine& machine);

/// Text on a foundation that is left out, for titles: "tower clamped at its foot, substructure left out"; else empty.
std::string foundation_in_words(const Machine& machine);
/// Whether the foundation that a machine's source names is left out.
bool is_clamped(const Machine& machine);

}  // namespace cardan::turbines
