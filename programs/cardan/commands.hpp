/// @file
/// The commands of `cardan`: each has a command line of its own, and returns the exit code.
#pragma once

namespace cardan::program {

int campbell_command(int argc, char** argv);
int modes_command(int argc, char** argv);
int steady_command(int argc, char** argv);
int simulate_command(int argc, char** argv);
int wind_command(int argc, char** argv);
int linearise_command(int argc, char** argv);
int flutter_command(int argc, char** argv);
int convert_command(int argc, char** argv);
int plot_command(int argc, char** argv);
int info_command(int argc, char** argv);
int repair_command(int argc, char** argv);
int repeat_command(int argc, char** argv);

/// A command by its name; null: there is none.
int (*command_of(const char* name))(int argc, char** argv);

}  // namespace cardan::program
