// One command for everything that is done with a machine: cardan COMMAND MACHINE OPTIONS.
//
// A machine is a model of OpenFAST or windIO, our own YAML, a result, or a built-in one; all commands take it in the
// same way. What each of them does stands at the head of its file, programs/cardan/COMMAND.cpp.
#include "mbs/base/version.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/shared/program.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace cardan::program {

namespace {

struct Command {
    const char *name, *what;
    int (*run)(int argc, char** argv);
};

constexpr std::array commands{
    Command{"campbell", "Campbell diagram: frequencies and damping over rotor speed", campbell_command},
    Command{"modes", "modes at one rotor speed, with pictures of their shapes", modes_command},
    Command{"steady", "steady state at one rotor speed: deflections and loads over a revolution", steady_command},
    Command{"simulate", "motion in time", simulate_command},
    Command{"wind", "turbulent wind: made for a machine, or looked at", wind_command},
    Command{"linearise", "linear model for the design of controllers", linearise_command},
    Command{"flutter", "rotor speeds at which a blade flutters or diverges", flutter_command},
    Command{"convert", "a machine to our own YAML, a time history to CSV", convert_command},
    Command{"plot", "pictures of results, several over each other", plot_command},
    Command{"info", "what is in a machine or a result", info_command},
    Command{"repair", "put a time history in order whose writer was killed", repair_command},
    Command{"repeat", "make a result once more from what its file holds", repeat_command}};

constexpr std::array examples{
    std::pair("cardan info MODEL", "what the model holds, and what is left out"),
    std::pair("cardan campbell MODEL", "Campbell diagram from standstill to 1.2 times the rated speed"),
    std::pair("cardan campbell MODEL --wind 4:24:2", "the same in the wind, with the damping of the air"),
    std::pair("cardan steady MODEL --wind 4:24:2", "power curve, deflections and loads"),
    std::pair("cardan simulate MODEL --wind 12", "motion in a wind of 12 m/s"),
    std::pair("cardan wind MODEL --speed 12", "turbulent wind for the machine, as a file (.bts)"),
    std::pair("cardan plot A.h5 B.h5", "two results of one kind over each other")};

void print_usage(std::FILE* to) {
    std::fprintf(to, "Wind turbines as multibody systems.\nUsage: cardan COMMAND [OPTIONS]\n\nCommands:\n");
    for (const Command& one : commands) std::fprintf(to, "  %-12s%s\n", one.name, one.what);
    std::fprintf(to,
                 "\nOptions:\n  --help      print this help, or that of a command: cardan COMMAND --help\n"
                 "  --version   print the version\n\nExamples:\n");
    for (const auto& [line, what] : examples) std::fprintf(to, "  %-42s%s\n", line, what);
    std::fprintf(to,
                 "MODEL is a file of OpenFAST (.fst) or windIO (.yaml), or a machine that is built in, as nrel5mw.\n");
}

}  // namespace

int (*command_of(const char* name))(int argc, char** argv) {
    const auto* const found = std::ranges::find(commands, std::string_view(name), &Command::name);
    return found == commands.end() ? nullptr : found->run;
}

}  // namespace cardan::program

int main(int argc, char** argv) {
    using namespace cardan::program;
    const std::string_view word = argc > 1 ? argv[1] : "";
    if (word == "--help" || word == "-h" || (word == "help" && argc == 2)) return print_usage(stdout), shown("cardan");
    if (word == "--version") return std::puts(std::string(cardan::version()).c_str()), shown("cardan");
    const bool help = word == "help";
    const char* const name = help ? argv[2] : argv[1];  // null: none
    int (*const command)(int, char**) = name == nullptr ? nullptr : command_of(name);
    if (name == nullptr) return print_usage(stderr), 2;
    if (command == nullptr) {
        std::fprintf(stderr, "cardan: there is no command '%s'\n\n", name);
        print_usage(stderr);
        return 2;
    }
    std::string full = std::string("cardan ") + name, help_option = "--help";
    std::array<char*, 3> for_help{full.data(), help_option.data(), nullptr};
    if (help) return command(2, for_help.data());
    argv[1] = full.data();
    return command(argc - 1, argv + 1);
}
