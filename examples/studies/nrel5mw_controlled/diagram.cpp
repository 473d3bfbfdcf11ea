#include "solvers/campbell/diagram.hpp"

#include "examples/studies/nrel5mw_controlled/studies.hpp"
#include "programs/shared/program.hpp"
#include "solvers/pictures/campbell.hpp"

#include <cmath>
#include <cstdio>
#include <iostream>

namespace cardan::controlled {

namespace {

constexpr double balance_allowed = 1e-6;  // part of the rated speed

// Machines at one wind after another.
struct Machines {
    std::vector<double> winds;
    std::vector<turbines::Turbine> open, closed;
};

Machines machines_at(const MachineOptions& options, const std::vector<double>& all) {
    Machines machines{all, {}, {}};
    machines.open.reserve(all.size());
    machines.closed.reserve(all.size());
    for (const double wind : all) {
        const Plant here = plant(options, wind);
        machines.open.push_back(open_loop(here));
        machines.closed.push_back(linear_loop(here, {}).turbine);
    }
    return machines;
}

solvers::Campbell over_wind(const Machines& machines, const std::vector<turbines::Turbine>& turbines, bool balanced,
                            double max_frequency) {
    std::vector<solvers::CampbellCase> cases;
    cases.reserve(turbines.size());
    for (std::size_t i = 0; i < turbines.size(); ++i)
        cases.push_back({&turbines[i].system(), &turbines[i].rotor(), rated_speed, machines.winds[i]});
    solvers::CampbellOptions options;
    options.balanced = balanced;
    options.method = solvers::CampbellMethod::coleman;
    options.max_frequency_hz = max_frequency;
    solvers::Campbell found = solvers::campbell(cases, "wind speed, m/s", options);
    found.machine += balanced ? ", under its controller" : ", pitch and torque held";
    return found;
}

bool keeps_speed(const solvers::Campbell& closed) {
    bool good = true;
    for (std::size_t i = 0; i < closed.points.size(); ++i) {
        const solvers::CampbellPoint& point = closed.points[i];
        if (std::abs(point.rotor_speed / rated_speed - 1) < balance_allowed && point.stability_margin > 0) continue;
        std::printf("at %g m/s: rotor speed %.6f rad/s, stability margin %.4f 1/s\n", closed.parameters[i],
                    point.rotor_speed, point.stability_margin);
        good = false;
    }
    return good;
}

}  // namespace

int diagram(const MachineOptions& machine, const DiagramOptions& options, const std::string& out) {
    const std::vector<double> all = winds_above_rated("--winds", options.winds);
    program::check_outputs(out, {"_open.svg", "_open.png", "_closed.svg", "_closed.png"});
    const Machines machines = machines_at(machine, all);
    const solvers::Campbell open = over_wind(machines, machines.open, false, options.max_frequency),
                            closed = over_wind(machines, machines.closed, true, options.max_frequency);
    std::cout << solvers::table(open) << "\n" << solvers::table(closed) << "\n";
    for (const char* ending : {".svg", ".png"}) {
        solvers::plot(open, out + "_open" + ending);
        solvers::plot(closed, out + "_closed" + ending);
    }
    const bool good = keeps_speed(closed);
    std::printf("files: %s_open.svg, .png, %s_closed.svg, .png\n", out.c_str(), out.c_str());
    return good ? 0 : 3;
}

}  // namespace cardan::controlled
