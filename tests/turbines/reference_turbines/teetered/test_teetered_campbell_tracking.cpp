// Campbell diagrams of the two-bladed machine where tracking is hard: from standstill on, where a tower mode is locked
// at the rotor speed and turns into two real motions, and over a spring that is soft at first.
#include "solvers/campbell/diagram.hpp"
#include "tests/support/catch.hpp"
#include "turbines/reference_turbines/teetered.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace cardan;
using solvers::Branch;
using solvers::Campbell;
using solvers::CampbellMode;
using solvers::FloquetKind;
using turbines::AssemblyOptions;
using turbines::Turbine;

namespace {

Turbine machine(bool teeter_locked) {
    AssemblyOptions options = turbines::teetered_paper_assembly(1);
    options.tower_beam->torsion_armature = options.blade_beam->torsion_armature = -1. / 12;
    turbines::TurbineDescription description = turbines::with_tower_rigidity(turbines::teetered_description(), 100);
    if (teeter_locked) description.hub.teeter->bearing = turbines::rigid_joint;
    return turbines::assemble(description, options);
}

Campbell floquet_diagram(const Turbine& machine, double first, double last, double step, double max_frequency) {
    solvers::CampbellOptions options;
    options.method = solvers::CampbellMethod::floquet;
    options.max_frequency_hz = max_frequency;
    return solvers::campbell(machine.system(), machine.rotor(), solvers::rpm_range(first, last, step), options);
}

}  // namespace

TEST_CASE("campbell of the teetered machine: from standstill on no branch begins as another mode", "[property]") {
    const Campbell d = floquet_diagram(machine(false), 0, 40, 8, 12);
    for (const Branch& branch : d.branches)
        for (std::size_t i = 1; i < d.points.size(); ++i) {
            if (branch.mode[i - 1] < 0 || branch.mode[i] < 0) continue;
            CAPTURE(branch.name, i);
            // Locked motions gain 0.13 Hz per step, antisymmetric lag falls by 0.2 Hz from azimuth 0 at rest.
            CHECK(std::abs(d.damped_hz(branch, i) - d.damped_hz(branch, i - 1)) < 0.3);
        }
}

TEST_CASE("campbell of the teetered machine: a mode that is locked becomes two motions, and both are in the diagram",
          "[property]") {
    const Campbell d = floquet_diagram(machine(true), 40, 42.5, 0.25, 3);
    int locked = 0;
    for (std::size_t i = 0; i < d.points.size(); ++i)
        for (std::size_t m = 0; m < d.points[i].modes.size(); ++m) {
            const CampbellMode& mode = d.points[i].modes[m];
            if (mode.mode.damped_hz() > 2) continue;
            CAPTURE(i, mode.mode.eigenvalue, mode.kind_name());
            locked += mode.kind() == FloquetKind::synchronous;
            CHECK(std::any_of(d.branches.begin(), d.branches.end(),
                              [&](const Branch& b) { return b.mode[i] == static_cast<int>(m); }));
        }
    CHECK(locked >= 4);  // 40.75 and 41 rpm
}

TEST_CASE("campbell of the teetered machine: the warning speaks of the fastest growing motion", "[property]") {
    // Too few harmonics split the double zero of free yaw into a slow growth beside that of the teeter.
    AssemblyOptions options = turbines::teetered_paper_assembly(1);
    options.gravity = {0, 0, -9.80665};
    const Turbine machine =
        turbines::assemble(turbines::with_tower_rigidity(turbines::teetered_description(), 100), options);
    solvers::CampbellOptions how;
    how.method = solvers::CampbellMethod::floquet;
    how.floquet.harmonics = 1;
    how.max_frequency_hz = 3;
    const double speed[] = {40 * pi / 30};
    const Campbell d = solvers::campbell(machine.system(), machine.rotor(), speed, how);
    const double growth = -d.points[0].stability_margin;
    REQUIRE(growth > 0.1);
    std::ostringstream shown;
    shown.precision(4);
    shown << growth;
    CHECK_THAT(d.warning, Catch::Contains("grows with " + shown.str()));
}
