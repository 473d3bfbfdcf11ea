// A time history in order whose writer was killed, so that all programs can read it.
//
// Reference: docs/file_formats.md, section "Time history".
#include "programs/cardan/commands.hpp"
#include "programs/shared/history_state.hpp"
#include "programs/shared/program.hpp"
#include "solvers/hdf5/history.hpp"

namespace cardan::program {

namespace {

struct RepairArguments {
    std::string file;
};

void declare(CommandLine& app, RepairArguments& a) {
    app.add_option("FILE", a.file, "history (.h5)").required();
}

int run(RepairArguments& a, const CommandLine& /*command*/) {
    stop_at_once();
    const solvers::HistoryRepair done = solvers::repair_history(a.file);
    const solvers::HistoryInfo info = solvers::read_history_info(a.file);
    std::cout << a.file << ": ";
    if (!done.changed()) std::cout << "in order, nothing was changed";
    if (done.flush_completed) std::cout << "the last flush, broken off, was completed";
    if (done.changed() && !done.flush_completed)
        std::cout << done.bytes_removed << " bytes of a flush that was broken off were removed";
    std::cout << "; " << info.rows << " rows, " << state_in_words(info) << "\n";
    return 0;
}

}  // namespace

int repair_command(int argc, char** argv) {
    return run_command<RepairArguments>(
        "cardan repair",
        "Puts a time history in order whose writer was killed, so that all programs can "
        "read it. What is in order is not changed.",
        argc, argv, declare, run);
}

}  // namespace cardan::program
