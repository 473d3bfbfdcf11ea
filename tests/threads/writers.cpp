// Two simulations under a controller, a Campbell diagram and a table of numbers, each in a thread of its own that
// writes a file of its own: the files hold the same as those of one after the other. Under the thread sanitizer (preset
// `thread`) it also shows that they share nothing that changes.
#include "solvers/campbell_data/csv.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/hdf5/history.hpp"
#include "tests/support/files.hpp"
#include "turbines/analysis/campbell.hpp"
#include "turbines/analysis/simulation.hpp"
#include "turbines/machine/read_machine.hpp"

#include <exception>
#include <functional>
#include <iostream>
#include <thread>
#include <vector>

namespace {

using namespace cardan;
using namespace cardan::turbines;

const MachineSettings few{.blade_elements = 1, .tower_elements = 1};

std::string numbers(const solvers::History& history) {
    std::string all;
    for (const auto& row : history.values)
        for (const double value : row) all += digits(value) + " ";
    return all;
}

std::string simulation(const Machine& machine, double wind, const std::string& file) {
    Simulation run(machine, {.wind = WindSource(wind), .controller = Controller::baseline(), .machine = few});
    static_cast<void>(run.record(file, {.duration = 0.5, .step = 0.05}));
    return numbers(solvers::read_history(file));
}

std::string diagram(const Machine& machine, const std::string& file) {
    const CampbellDiagram found = campbell(machine, {.rotor_speeds = {0.0, 1.0}, .machine = few});
    solvers::write_hdf5(found, file);
    return solvers::table(solvers::read_campbell(file));
}

std::string series(const std::string& file) {
    solvers::HistoryWriter writer = solvers::HistoryWriter::create(
        file, {{.name = "a", .units = "m", .long_name = "first"}}, {.title = "series"}, {.replace = true, .chunk = 16});
    for (int row = 0; row < 2000; ++row) {
        writer.append(row, std::vector<double>{std::sin(row)});
        if (row % 100 == 99) static_cast<void>(solvers::read_history_info(file));
    }
    writer.finish();
    return numbers(solvers::read_history(file));
}

// What a piece of work came to, or why not.
std::string outcome(const std::function<std::string()>& work) {
    try {
        return work();
    } catch (const std::exception& error) {
        return text("error: ", error.what());
    }
}

}  // namespace

int main() {
    const Machine machine = read_machine("nrel5mw-fast");
    const test::Folder folder;
    const auto pieces = [&](const std::string& when) {
        const auto file = [&](const char* name) { return (folder.path / (when + name)).string(); };
        return std::vector<std::function<std::string()>>{
            [&machine, name = file("one.h5")] { return simulation(machine, 9, name); },
            [&machine, name = file("two.h5")] { return simulation(machine, 14, name); },
            [&machine, name = file("diagram.h5")] { return diagram(machine, name); },
            [name = file("series.h5")] { return series(name); }};
    };
    const auto together = pieces("together_"), alone = pieces("alone_");
    std::vector<std::string> first(together.size());
    {
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < together.size(); ++i)
            threads.emplace_back([&, i] { first[i] = outcome(together[i]); });
        for (std::thread& one : threads) one.join();
    }
    bool good = true;
    for (std::size_t i = 0; i < alone.size(); ++i) {
        const std::string again = outcome(alone[i]);
        good = good && again == first[i] && !again.empty() && !again.starts_with("error");
        if (again.starts_with("error")) std::cerr << "writers: " << again << "\n";
    }
    std::cout << (good ? "the same" : "DIFFERENT") << " files in four threads and in one\n";
    return good ? 0 : 1;
}
