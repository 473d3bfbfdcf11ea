// What `cardan simulate` has written, beside the same motion by calls of the library: started from a
// periodic steady state by shooting, with the generator as a damper and a constant torque, integrated by another method
// with a smaller tolerance.
#include "elements/machine_elements/coordinate_force.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/base/units.hpp"
#include "solvers/hdf5/history.hpp"
#include "solvers/periodic/steady_state.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/support/catch.hpp"
#include "turbines/model/channels.hpp"
#include "turbines/reference_turbines/wt600.hpp"

using namespace cardan;

namespace {

// As in tests/programs/cardan_simulate.cmake.
constexpr double speed = 20 * units::rpm, torque = 500, slope = 20;

turbines::Turbine machine() {
    // Beams as the command takes them, of the machine's own sections: there they are sampled.
    turbines::AssemblyOptions options;
    options.gravity = {0, 0, -units::standard_gravity};
    options.tower_beam = {.elements = 1, .partition = Partition::mean_difference};
    options.blade_beam = {.elements = 1, .partition = Partition::mean_difference, .extension = true};
    const turbines::Turbine turbine = turbines::wt600(options);
    const double n = turbine.layout().gear_ratio;
    ForceSet forces = turbine.forces();
    forces.add_spring("slip", *turbine.layout().generator, 0, n * n * slope);
    const double rest = -n * (torque - slope * n * speed);
    forces.add_element(coordinate_force(
        "generator", *turbine.layout().generator,
        [rest](double, double, double) { return CoordinateLaw{.force = rest}; }, false));
    return turbine.with_forces(forces);
}

solvers::History by_hand(const std::vector<double>& times) {
    const turbines::Turbine turbine = machine();
    const System& system = turbine.system();
    solvers::PeriodicOptions periodic;
    periodic.rotor_speed = speed;
    const solvers::PeriodicSteadyState state = solvers::shooting(system, turbine.rotor().spin, periodic);
    require_result(state);
    const DynamicState start = state.at(0);
    solvers::IntegrationOptions options;
    options.method = solvers::Method::bdf;
    options.tolerances = {1e-8, 1e-10, 1e-10, 1e-9, 1e-9};
    solvers::Integrator integrator(system, {}, 0, start.q, start.qd, options);
    solvers::Recorder recorder(integrator, turbines::channels(turbine));
    solvers::History history;
    require_result(solvers::record(integrator, recorder, times, history));
    return history;
}

}  // namespace

TEST_CASE("cardan simulate: the file of the program holds the motion that the library computes",
          "[.program][crosscheck]") {
    const solvers::History file = solvers::read_history("example_turbine_time_generator.h5");
    const solvers::History own = by_hand(file.time);
    REQUIRE(own.time == file.time);
    CHECK(file["RotSpeed"].back() < 0.99 * file["RotSpeed"].front());
    for (const char* channel : {"RotSpeed", "GenSpeed", "TTDspFA", "TTDspSS", "TwrBsMyt", "RootMyb1", "RootMxb1",
                                "RootMxb3", "blade 2 tip in-plane deflection", "yaw"}) {
        CAPTURE(channel);
        const std::vector<double>&a = file[channel], &b = own[channel];
        double largest = 0, difference = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            largest = std::max(largest, std::abs(b[i]));
            difference = std::max(difference, std::abs(a[i] - b[i]));
        }
        CHECK(difference < 1e-3 * largest);  // the program integrates to 1e-5 a step
    }
    for (std::size_t i = 0; i < file.time.size(); ++i)
        CHECK(file["GenTq"][i] == Approx(torque + slope * (file["GenSpeed"][i] - file["GenSpeed"][0])).epsilon(1e-9));
}
