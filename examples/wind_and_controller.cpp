// The NREL 5 MW machine in a wind above rated under its baseline controller: 30 s in three lines, all channels in an
// HDF5 file. Beside the last 10 s what the report of the machine has for this wind.
//
// Reference: J. Jonkman, S. Butterfield, W. Musial, G. Scott, NREL/TP-500-38060, 2009, table 7-1 and section 7: 12.1
// rpm, 8.70 deg, 5 MW at 14 m/s.
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/turbines/analysis/simulation.hpp>
#include <cardan/turbines/machine/read_machine.hpp>

#include <cstdio>
#include <iostream>
#include <numeric>

using namespace cardan;

int main() try {
    const turbines::Machine machine = turbines::read_machine("nrel5mw-fast");
    turbines::Controller controller = turbines::Controller::baseline();
    controller.generator_efficiency = machine.controller.generator_efficiency;
    turbines::Simulation run(machine,
                             {.wind = 14, .controller = controller, .machine = {.pitch = 8.7 * units::degree}});
    const turbines::Recording result = run.record("wind_and_controller.h5", {.duration = 30, .step = 0.05});

    const auto mean_at_end = [&](const char* channel) {
        const std::vector<double>& values = result.history[channel];
        return std::accumulate(values.end() - 200, values.end(), 0.0) / 200;
    };
    std::printf("%24s %8s %8s\n", "", "mean", "report");
    std::printf("%24s %8.3f %8.3f\n", "rotor speed, rpm", mean_at_end("RotSpeed") * units::to_rpm, 12.1);
    std::printf("%24s %8.3f %8.3f\n", "pitch, deg", mean_at_end("BldPitch1") * units::to_degrees, 8.7);
    std::printf("%24s %8.3f %8.3f\n", "electrical power, MW", mean_at_end("GenPwr") / 1e6, 5.0);
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
