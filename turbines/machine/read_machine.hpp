/// @file
/// A machine with all that belongs to it, from whatever source.
#pragma once

#include "turbines/machine/machine.hpp"
#include "turbines/yaml/model_addition.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace cardan::turbines {

/// A built-in machine, or what a file holds: our own YAML, a model of windIO, the result (.h5) of a computation, which
/// holds the machine that was computed, or the main file (.fst) or ElastoDyn file of an OpenFAST model. Air that cannot
/// be read does not keep the structure from being read: Machine::no_air then says why.
/// @param machine    name of built_in_machines(), which comes first: a file of that name is read as ./NAME; or a path
/// @param additions  to a model of windIO
/// @throws InputError for a word that is neither a name nor a file, with the names there are, and for additions to
/// another machine; as the readers
Machine read_machine(const std::string& machine, const std::vector<ModelAddition>& additions = {});

/// Airfoils from a file beside the machine: windIO (.yaml), else the main file of AeroDyn 15, where "default" is that
/// of the machine's site.
/// @throws ParseError, FileError, InputError
Aerodynamics read_air(const std::filesystem::path& path, const Machine& machine);

/// Reads a schedule of rotor speed and pitch over the wind: CSV with the columns wind[m/s],rotor_speed[rpm],pitch[deg].
/// @throws ParseError, FileError
std::vector<Operation> read_schedule(const std::filesystem::path& path);

/// Whether a file is YAML, by the ending of its name.
bool is_yaml(const std::filesystem::path& path);

}  // namespace cardan::turbines
