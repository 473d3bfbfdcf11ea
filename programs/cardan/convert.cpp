// Files in other formats: a machine as our own YAML, channels of a time history as CSV.
//
// Reference: docs/file_formats.md. A result holds the machine that was computed, which is a machine like any other.
#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/shared/machine_file.hpp"
#include "programs/shared/program.hpp"
#include "solvers/campbell_data/csv.hpp"
#include "solvers/hdf5/history.hpp"
#include "turbines/machine/machine_text.hpp"

#include <iomanip>
#include <iostream>
#include <system_error>

namespace cardan::program {

namespace {

struct ConvertArguments {
    MachineOptions machine;
    std::string to;
    solvers::HistorySelection selection;
};

void declare(CommandLine& app, ConvertArguments& a) {
    app.add_option("from", a.machine.model, "a machine, or the file of a time history (.h5)").required();
    app.add_option("to", a.to, "file to write: FILE.yaml, the machine; FILE.csv, channels of the history").required();
    app.add_option("--channel", a.selection.channels, "CSV: names or aliases (default: all)").one_word();
    app.add_option("--from", a.selection.from, "CSV: first time, s").hide_default();
    app.add_option("--to", a.selection.to, "CSV: last time, s").hide_default();
    add_source_options(app, a.machine);
    app.footer(text("\n", machine_help()));
}

std::string field(const std::string& name, const std::string& units) {
    return solvers::csv_field(name + "[" + (units == "1" ? "-" : units) + "]");
}

std::string rows(const solvers::History& history) {
    std::ostringstream out = text_stream();
    out << field("time", "s");
    for (const Channel& channel : history.channels) out << "," << field(channel.name, channel.units);
    out << "\n" << std::setprecision(10);
    for (std::size_t row = 0; row < history.time.size(); ++row) {
        out << history.time[row];
        for (const std::vector<double>& values : history.values) out << "," << values[row];
        out << "\n";
    }
    return out.str();
}

void write_csv(const ConvertArguments& a) {
    const solvers::History history = solvers::read_history(a.machine.model, a.selection);
    if (history.time.empty())
        throw InputError(a.machine.model, "rows", 0, "some: --from and --to are its first and last time");
    write_file(a.to, rows(history));
    std::cout << a.to << ": " << history.time.size() << " rows of " << history.channels.size() << " channels\n";
}

void write_yaml(ConvertArguments& a) {
    const turbines::Machine machine = prepared_machine(a.machine);
    if (machine.air) print_notes(machine.air->notes, a.machine, "notes on the air");
    turbines::write_machine(machine, a.to);
    std::cout << a.to << ": " << machine.description.name << "\n";
    if (!machine.air) std::cout << "note: without air: " << machine.no_air << "\n";
}

int run(ConvertArguments& a, const CommandLine& /*command*/) {
    stop_at_once();
    const bool yaml = turbines::is_yaml(a.to);
    if (!yaml && std::filesystem::path(a.to).extension() != ".csv")
        throw InputError("to", "file", a.to, "one that ends in .yaml (a machine) or .csv (a time history)");
    check_outputs(a.to, {""}, {a.machine.model});
    if (yaml)
        write_yaml(a);
    else
        write_csv(a);
    return 0;
}

}  // namespace

int convert_command(int argc, char** argv) {
    return run_command<ConvertArguments>(
        "cardan convert",
        "A machine, from any source, as our own YAML; a time history as CSV, one line per "
        "time and one column per channel.",
        argc, argv, declare, run);
}

}  // namespace cardan::program
