// Time histories of simulations (HDF5): what is in them, repair after a crash, export as CSV.
//
// Reference: docs/file_formats.md, section "Time history". Files that a program is writing at the moment can be looked
// at and exported as well; nothing but `repair` changes a file.
#include "solvers/hdf5/history.hpp"

#include "examples/shared/program.hpp"
#include <cerrno>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <system_error>

using namespace cardan;
using namespace cardan::solvers;

namespace {

struct Arguments {
    std::string command, file, csv;
    HistorySelection selection;
    bool description = false;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app("Time histories: what is in a file, repair after a crash, export as CSV.");
    app.footer("Exit code: 0; 1 error; 2 wrong usage. See 'history COMMAND --help'.");
    const auto command = [&](const char* name, const char* what) {
        program::CommandLine sub = app.add_subcommand(name, what);
        sub.add_option("FILE", a.file, "history (HDF5)").required();
        return sub;
    };
    command("info", "print title, state, channels, statistics and checkpoint")
        .add_flag("--description", a.description, "print the input description as well");
    command("repair", "put a file in order whose writer was killed, so that all programs can read it");
    program::CommandLine write = command("export", "write channels as CSV: one line per time, one column per channel");
    write.add_option("--csv", a.csv, "file to write").required();
    write.add_option("--channel", a.selection.channels, "names or aliases (default: all)");
    write.add_option("--from", a.selection.from, "first time, s").hide_default();
    write.add_option("--to", a.selection.to, "last time, s").hide_default();
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    a.command = app.subcommand();
    return -1;
}

const char* state_of(const HistoryInfo& info) {
    if (info.being_written) return "being written";
    return info.finished ? "finished" : "broken off";
}

void print_statistics(const IntegrationStatistics& s) {
    std::cout << "steps       " << s.steps << " accepted, " << s.rejected << " rejected, " << s.not_converged
              << " not converged; last step " << s.last_step << " s of order " << s.order << "\n"
              << "work        " << s.evaluations << " evaluations, " << s.jacobians << " Jacobians, "
              << s.factorisations << " factorisations, " << s.iterations << " iterations, " << s.restarts
              << " restarts\n";
}

void print_channels(const std::vector<Channel>& channels) {
    std::cout << "\nchannel                         units       alias           what\n" << std::left;
    for (const Channel& c : channels) {
        std::cout << "  " << std::setw(29) << c.name << " " << std::setw(11) << c.units << " " << std::setw(15)
                  << (c.alias.empty() ? "-" : c.alias) << " " << c.long_name;
        if (!c.frame.empty()) std::cout << "; axes: " << c.frame;
        if (!c.point.empty()) std::cout << "; at: " << c.point;
        std::cout << "\n";
    }
}

int info(const Arguments& a) {
    const HistoryInfo info = read_history_info(a.file);
    std::cout << a.file << ": history '" << info.about.title << "', " << state_of(info) << "\n";
    if (info.needs_repair) std::cout << "repair      needed for programs other than this one: history repair\n";
    std::cout << "program     " << info.about.program << " " << info.version << "\n";
    if (!info.about.method.empty()) std::cout << "method      " << info.about.method << "\n";
    std::cout << "rows        " << info.rows;
    if (info.rows > 0) std::cout << ", " << info.first_time << " ... " << info.last_time << " s";
    std::cout << "\ncheckpoint  ";
    if (info.checkpoint)
        std::cout << "at " << info.checkpoint->time << " s, after " << info.checkpoint_rows << " rows\n";
    else
        std::cout << "none\n";
    if (info.statistics) print_statistics(*info.statistics);
    print_channels(info.channels);
    if (a.description) std::cout << "\ninput description:\n" << info.about.description << "\n";
    return 0;
}

int repair(const Arguments& a) {
    const HistoryRepair done = repair_history(a.file);
    const HistoryInfo info = read_history_info(a.file);
    std::cout << a.file << ": ";
    if (!done.changed()) std::cout << "in order, nothing was changed";
    if (done.flush_completed) std::cout << "the last flush, broken off, was completed";
    if (done.changed() && !done.flush_completed)
        std::cout << done.bytes_removed << " bytes of a flush that was broken off were removed";
    std::cout << "; " << info.rows << " rows, " << state_of(info) << "\n";
    return 0;
}

/// A header field in quotes if it has to be.
std::string field(const std::string& name, const std::string& units) {
    std::string plain = name + "[" + (units == "1" ? "-" : units) + "]";
    if (plain.find_first_of(",\"\n") == std::string::npos) return plain;
    std::string quoted = "\"";
    for (const char c : plain) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

void write_rows(std::ostream& out, const History& history) {
    out.imbue(std::locale::classic());
    out << field("time", "s");
    for (const Channel& channel : history.channels) out << "," << field(channel.name, channel.units);
    out << "\n" << std::setprecision(10);
    for (std::size_t row = 0; row < history.time.size(); ++row) {
        out << history.time[row];
        for (const std::vector<double>& values : history.values) out << "," << values[row];
        out << "\n";
    }
}

int write_csv(const Arguments& a) {
    const History history = read_history(a.file, a.selection);
    const PendingFile pending(a.csv);
    try {
        errno = 0;
        std::ofstream out(pending.partial(), std::ios::binary | std::ios::trunc);
        write_rows(out, history);
        out.close();
        if (!out) throw FileError(a.csv, text("cannot be completed: ", std::generic_category().message(errno)));
        pending.commit();
    } catch (...) {
        pending.discard();
        throw;
    }
    std::cout << a.csv << ": " << history.time.size() << " rows of " << history.channels.size() << " channels\n";
    return 0;
}

int run(const Arguments& a) {
    program::stop_at_once();
    const int code = a.command == "info" ? info(a) : a.command == "repair" ? repair(a) : write_csv(a);
    return std::cout.flush() ? code : 1;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("history", argc, argv, parse, run);
}
