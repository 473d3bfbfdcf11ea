/// @file
/// Machines as text: YAML of our own; docs/file_formats.md has the keys.
#pragma once

#include "turbines/machine/machine.hpp"

#include <filesystem>
#include <string>

namespace cardan::turbines {

/// The machine as YAML text, but for what its readers noted. Numbers have enough digits to be read back exactly:
/// parse_machine(to_yaml(m)) computes what m does, bit for bit.
/// @throws InputError for NaN, for beam lines without a table (see BeamTable; sampled() makes one), and for a machine
/// that is not whole (TurbineDescription::missing)
std::string to_yaml(const Machine& machine);
/// @throws FileError, InputError
void write_machine(const Machine& machine, const std::filesystem::path& path);

/// Files of all versions. What a file does not say of operation is that of machine_of().
/// @param file  name for messages
/// @throws ParseError: as parse_description(); air that does not fit together
Machine parse_machine(const std::string& text, const std::string& file);

/// A description of a result (Turbine::rotor().description) with the whole machine at its end, in the place of its
/// structure: what read_machine() finds in the file of the result.
/// @param machine  the text of its source, which the description holds already, is left out
std::string with_machine(std::string description, Machine machine);

}  // namespace cardan::turbines
