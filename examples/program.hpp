/// @file
/// What the programs have in common: Ctrl-C, errors and exit codes, progress, a first look at the output files.
#pragma once

#include "mbs/error.hpp"
#include "mbs/pending_file.hpp"
#include "mbs/version.hpp"

#include <CLI/CLI.hpp>

#include <atomic>
#include <csignal>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <string>
#include <unistd.h>

namespace cardan::program {

inline std::atomic<bool> interrupt{false};
static_assert(std::atomic<bool>::is_always_lock_free);

/// Was Ctrl-C pressed? Asked by the program where it can stop tidily.
inline bool interrupted() {
    return interrupt;
}

/// For a last part that is short: from here on Ctrl-C ends the program at once.
inline void stop_at_once() {
    std::signal(SIGINT, SIG_DFL);
}

/// For people only: nothing is written to files and pipes.
inline void progress(const std::string& what) {
    static const bool terminal = isatty(STDERR_FILENO) != 0;
    if (terminal) std::cerr << what << std::flush;
}

/// Files that cannot be written are found out before the work, not after it.
inline void check_outputs(const std::string& prefix, std::initializer_list<const char*> endings) {
    const std::filesystem::path path(prefix), folder = path.parent_path();
    if (path.filename().empty()) throw InputError("--out", "prefix", prefix, "a path that ends in a file name");
    if (!folder.empty() && !std::filesystem::is_directory(folder))
        throw FileError(prefix, text("the folder '", folder.string(), "' does not exist"));
    for (const char* ending : endings) PendingFile(prefix + ending).discard();
}

/// Reads the command line.
/// @return exit code to end with (0 after --help and --version, 2 for wrong usage), -1: go on
inline int parse(CLI::App& app, int argc, char** argv) {
    app.set_version_flag("--version", std::string(version()));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return -1;
}

/// The body of main().
/// @param parse  fills the arguments; an exit code >= 0 ends the program there, -1 goes on
/// @param run    does the work; Ctrl-C is caught from here on
/// @return exit code; 1 after an error, which is printed with the name of the program
template <class Arguments>
int run_program(const char* name, int argc, char** argv, int (*parse)(int, char**, Arguments&),
                int (*run)(const Arguments&)) {
    try {
        Arguments arguments;
        if (const int code = parse(argc, argv, arguments); code >= 0) return code;
        std::signal(SIGINT, [](int) { interrupt = true; });
        return run(arguments);
    } catch (const Error& error) {
        std::cerr << name << ": " << error.what() << "\n";
    } catch (const std::exception& error) {
        std::cerr << name << ": unexpected: " << error.what() << "\n";
    }
    return 1;
}

}  // namespace cardan::program
