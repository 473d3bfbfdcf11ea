/// @file
/// Common parts of the programs: signals, errors and exit codes, an early check of the output files.
#pragma once

#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "programs/shared/command_line.hpp"
#include "programs/shared/option_names.hpp"
#include "programs/shared/progress.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <initializer_list>
#include <iostream>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace cardan::program {

/// The signal that asked the program to stop; 0: none has.
inline std::atomic<int> interrupt{0};
static_assert(std::atomic<int>::is_always_lock_free);

/// Ctrl-C, kill and the end of a batch job, a terminal that was closed: what was computed is saved after all of them.
inline constexpr int stopping_signals[] = {SIGINT, SIGTERM, SIGHUP};

/// Was the program asked to stop? Asked by it where it can stop tidily.
inline bool interrupted() {
    return interrupt != 0;
}

/// Sets the handler of the signals that end a program; what is ignored, as under nohup, stays ignored.
inline void handle_signals(void (*handler)(int)) {
    for (const int signal : stopping_signals)
        if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
}

/// Lets such a signal end the program at once from here on, for a last part that is short or leaves nothing behind.
inline void stop_at_once() {
    handle_signals(SIG_DFL);
    end_progress();
}

/// The first such signal asks the program to stop, which is printed; the second one ends it.
inline void ask_to_stop(int signal) {
    constexpr std::string_view words = "\nstopping, and keeping what is done; once more: at once\n";
    interrupt = signal;
    handle_signals(SIG_DFL);
    static_cast<void>(!write(STDERR_FILENO, words.data(), words.size()));
}

/// A file that is mapped, as wind boxes are, was shortened by another program: nothing can go on; a result is as after
/// a kill.
inline void end_of_mapped_file(int /*signal*/) {
    constexpr std::string_view words =
        "\nerror: a file that is being read, such as a wind box, was shortened by another program\n";
    static_cast<void>(!write(STDERR_FILENO, words.data(), words.size()));
    _exit(1);
}

/// Files that cannot be written are noticed before the work, not after it, and what a killed run has left
/// behind is named and removed.
/// @param sources  what is read, the machine's file for one, which is not replaced
inline void check_outputs(const std::string& prefix, std::initializer_list<const char*> endings,
                          const std::vector<std::string>& sources = {}) {
    const std::string name = std::filesystem::path(prefix).filename().string();
    if (name.empty() || name == "." || name == "..")
        throw InputError("--out", "prefix", prefix, "a path that ends in a file name");
    for (const char* ending : endings) {
        std::error_code none;
        for (const std::string& source : sources)
            if (std::filesystem::equivalent(prefix + ending, source, none))
                throw InputError("output", "file", prefix + ending,
                                 "another one than what is read, which it would replace");
        const PendingFile file(prefix + ending);
        if (file.left_over())
            std::cerr << "note: " << file.partial() << " was left behind by a run that was killed; it is removed\n";
        file.discard();
    }
}

/// Prints what the assembly has to say, before the work.
template <class Turbine>
void introduce(const Turbine& turbine, bool summary) {
    if (summary) std::cout << turbine.summary() << "\n";
    for (const std::string& warning : turbine.warnings()) std::cerr << "warning: " << warning << "\n";
}

/// @return 0, or 1 if what was printed has not arrived (a full disk), which is said
inline int shown(const char* name) {
    errno = 0;
    if (std::cout.flush() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return 0;
    std::cerr << name << ": standard output cannot be written"
              << (errno != 0 ? ": " + std::generic_category().message(errno) : "") << "\n";
    return 1;
}

/// Runs the body of a program, and handles what ends it: its errors, and the signals that came.
/// @param name  for messages
/// @param body  returns an exit code, 130 if it was interrupted
/// @return exit code; 1 after an error, which is printed with the name of the program; if it was interrupted 128 and
///         the number of the signal: 130, 143 or 129
template <class Body>
int with_errors(const char* name, const Body& body) {
    int code = 1;
    try {
        code = body();
        if (code == 0) code = shown(name);
        if (code != 130) return code;
    } catch (const Error& error) {
        std::cerr << name << ": " << in_options(error.what()) << "\n";
    } catch (const std::exception& error) {
        std::cerr << name << ": unexpected: " << error.what() << "\n";
    }
    return interrupted() ? 128 + interrupt : code;
}

/// Prepares a program: from here on signals are caught, and long work is reported; what there is no memory for is an
/// error with advice.
/// @param name  of the program
template <class Body>
int working(const char* name, const Body& body) {
    handle_signals(ask_to_stop);
    std::signal(SIGBUS, end_of_mapped_file);
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error as a full disk is
    const LongWork reported(name);
    return with_memory("this run; fewer elements, times or speeds need less", body);
}

/// Something is done that is worth keeping: after stop_at_once(), signals ask again.
inline void keep_from_here() {
    handle_signals(ask_to_stop);
}

/// The body of main().
/// @param parse  fills the arguments; an exit code >= 0 ends the program there, -1 goes on
/// @param run    does the work; signals are caught from here on; returns 130 if it was interrupted
/// @return as with_errors()
template <class Arguments>
int run_program(const char* name, int argc, char** argv, int (*parse)(int, char**, Arguments&),
                int (*run)(const Arguments&)) {
    return with_errors(name, [&] {
        Arguments arguments;
        if (const int code = parse(argc, argv, arguments); code >= 0) return code;
        return working(name, [&] { return run(arguments); });
    });
}

/// Runs a command that keeps its command line, to say in its files how they were made. Behind its result stands what is
/// left out of its machine, print_left_out().
/// @param name     "cardan campbell"
/// @param options  declares the options, with their targets in the arguments
template <class Arguments>
int run_command(const char* name, const char* about, int argc, char** argv, void (*options)(CommandLine&, Arguments&),
                int (*run)(Arguments&, const CommandLine&)) {
    return with_errors(name, [&] {
        Arguments arguments;
        CommandLine command(about);
        options(command, arguments);
        if (const int code = command.parse(argc, argv); code >= 0) return code;
        return working(name, [&] {
            const int code = run(arguments, command);
            if constexpr (requires { print_left_out(arguments.machine); }) print_left_out(arguments.machine);
            return code;
        });
    });
}

}  // namespace cardan::program
