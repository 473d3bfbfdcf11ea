// What the command has written is what the same lines of the library compute: every number, bit for bit.
//
// The commands: tests/programs/cardan_library.cmake.
#include "solvers/hdf5/campbell.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5/history.hpp"
#include "solvers/hdf5_models/state_space.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "turbines/analysis/campbell.hpp"
#include "turbines/analysis/linear_model.hpp"
#include "turbines/analysis/simulation.hpp"
#include "turbines/machine/read_machine.hpp"

#include <cmath>

using namespace cardan;

namespace {

const turbines::MachineSettings coarse{.blade_elements = 2, .tower_elements = 1};

bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

void check_equal(const solvers::Campbell& own, const solvers::Campbell& file) {
    CHECK(own.parameters == file.parameters);
    CHECK(own.remark == file.remark);
    CHECK(own.accuracy == file.accuracy);
    REQUIRE(own.points.size() == file.points.size());
    REQUIRE(own.branches.size() == file.branches.size());
    for (std::size_t b = 0; b < own.branches.size(); ++b) {
        const solvers::Branch &mine = own.branches[b], &theirs = file.branches[b];
        CAPTURE(mine.name);
        CHECK(mine.name == theirs.name);
        for (std::size_t i = 0; i < own.points.size(); ++i) {
            CHECK(same(own.natural_hz(mine, i), file.natural_hz(theirs, i)));
            CHECK(same(own.damping_ratio(mine, i), file.damping_ratio(theirs, i)));
        }
    }
}

}  // namespace

TEST_CASE("cardan simulate: the file of the command has the numbers of the library", "[.program][property]") {
    const solvers::History file = solvers::read_history("example_library_simulate.h5");
    const turbines::Machine machine = turbines::read_machine("nrel5mw");
    turbines::Simulation run(machine, {.wind = 12, .controller = turbines::Controller::baseline(), .machine = coarse});
    const solvers::History own = run.record({.duration = 1, .step = 0.05}).history;
    CHECK(own.title == file.title);
    CHECK(own.time == file.time);
    REQUIRE(own.values.size() == file.values.size());
    for (std::size_t i = 0; i < own.values.size(); ++i) {
        CAPTURE(own.channels[i].name);
        CHECK(own.channels[i].name == file.channels[i].name);
        CHECK(own.values[i] == file.values[i]);
    }
}

TEST_CASE("cardan campbell: the file of the command has the numbers of the library", "[.program][property]") {
    const turbines::Machine machine = turbines::read_machine("nrel5mw");
    check_equal(turbines::campbell(machine, {.machine = coarse}),
                solvers::read_campbell("example_library_campbell.h5"));
}

TEST_CASE("cardan campbell in the wind: the file of the command has the numbers of the library",
          "[.program][property]") {
    const turbines::Machine machine = turbines::read_machine("nrel5mw");
    check_equal(turbines::campbell(machine, {.winds = {8, 12}, .machine = coarse, .max_frequency_hz = 3}),
                solvers::read_campbell("example_library_campbell_wind.h5"));
}

TEST_CASE("cardan linearise: the file of the command has the numbers of the library", "[.program][property]") {
    const turbines::Machine machine = turbines::read_machine("nrel5mw");
    const turbines::MachineLinearModel linear =
        turbines::linear_model(machine, {.wind = 15,
                                         .machine = coarse,
                                         .azimuths = 8,
                                         .max_frequency_hz = 3,
                                         .air = {.wake = Wake::equilibrium, .airfoils = Airfoils::steady}});
    const test::Folder folder;
    solvers::write_hdf5(linear.model, linear.constant, folder / "own.h5");
    const auto own = solvers::Hdf5File::open(folder / "own.h5");
    const auto file = solvers::Hdf5File::open("example_library_linearise.h5");
    for (const std::string group : {"model/", "multi_blade/", "balanced/"})
        for (const char* matrix : {"A", "B", "C", "D"}) {
            CAPTURE(group, matrix);
            CHECK(own.read_doubles(group + matrix) == file.read_doubles(group + matrix));
        }
}
