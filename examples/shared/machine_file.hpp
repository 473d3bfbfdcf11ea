/// @file
/// A machine as the argument of a program: a built-in one by its name, or a file of any kind that can be read.
#pragma once

#include "turbines/model/assembly.hpp"
#include "turbines/readers/turbine_file.hpp"

#include "examples/shared/command_line.hpp"
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace cardan::program {

enum class MachineKind : std::uint8_t {
    built_in,     ///< turbines/machines
    description,  ///< our own YAML
    windio,       ///< other YAML
    openfast      ///< everything else
};

/// A machine, with what its source says of how it runs.
struct MachineFile {
    turbines::TurbineFile file;
    MachineKind kind = MachineKind::built_in;
    /// Beams of a built-in machine as its own programs have them; empty: every direction is free in which the sections
    /// are not rigid.
    std::function<turbines::AssemblyOptions(int blade_elements, int tower_elements)> beams = {};
};

/// What may be given as a machine, with the names of the built-in ones: for the help of a program.
std::string machine_help();

/// A name of a built-in machine comes first: a file of that name is read as ./NAME.
/// @param machine  name, or path of a .yaml (ours or windIO's), an .fst or an ElastoDyn file
/// @throws InputError for a word that is neither a name nor a file, with the names there are; as the readers
MachineFile read_machine(const std::string& machine);

/// Is it YAML, by the ending of its name?
bool is_yaml(const std::filesystem::path& path);

/// What programs for any machine ask about it.
struct MachineOptions {
    std::string model, generator, yaw;
    int blade_elements = 3, tower_elements = 3;
    std::optional<double> pitch;  ///< deg; none: the model's
    double generator_inertia = 0;
    bool gravity = false, undamped = false, notes = false, summary = false;
};

/// The machine's argument.
void add_machine(CommandLine& app, MachineOptions& options);
/// Numbers of elements and what replaces the model's own settings; gravity is left to the program.
void add_machine_options(CommandLine& app, MachineOptions& options);

/// Reads the machine, prints notes and degrees of freedom, and puts what was asked for in the place of what it says.
/// @throws InputError also for a yaw bearing that is to be free without a spring
MachineFile prepared_machine(const MachineOptions& options);

/// Beams, pitch, gravity and damping.
turbines::AssemblyOptions assembly_options(const MachineFile& machine, const MachineOptions& options);

/// Three or more blades, all there and alike: multi-blade coordinates make their equations constant, or nearly so.
bool has_equal_blades(const turbines::TurbineDescription& machine);

}  // namespace cardan::program
