// Emergency stop of the 600 kW machine after the loss of the grid: the rotor speeds up, the blades turn to feather, the
// brake holds the rotor. Events change switches and commands; the history goes to an HDF5 file as it comes.
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/solvers/hdf5/history.hpp>
#include <cardan/solvers/periodic/steady_state.hpp>
#include <cardan/solvers/pictures/history.hpp>
#include <cardan/turbines/reference_turbines/wt600_operation.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    const turbines::Wt600Operation machine =
        turbines::wt600_operation({.generator = turbines::Wt600Generator::converter});
    const System& system = machine.turbine.system();
    const int spin = machine.turbine.rotor().spin;
    const double rated = turbines::wt600_rated_speed();

    const solvers::PeriodicSteadyState start =
        solvers::harmonic_balance(system, spin, {.rotor_speed = rated, .rotor = &machine.turbine.rotor()});
    require_result(start, "start");  // bent by gravity and thrust

    std::vector<solvers::HistoryMark> marks;  // each event counts once: speeds swing about their limits
    const auto event = [&marks](const char* name, int direction, auto function, auto action) {
        return solvers::Event{name, function, direction, [&marks, name, action](solvers::Integrator& now) {
                                  for (const solvers::HistoryMark& mark : marks)
                                      if (mark.label == name) return solvers::AfterEvent::proceed;
                                  action(now.time());
                                  marks.push_back({now.time(), name});
                                  return solvers::AfterEvent::restart;
                              }};
    };
    const auto after_5_s = [](const StateView& in) { return in.time - 5; };
    const auto above = [spin](double limit) { return [=](const StateView& in) { return in.qd(spin) - limit; }; };
    solvers::IntegrationOptions options;
    options.events = {
        event("grid lost", 1, after_5_s, [&](double time) { machine.grid->turn(false, time); }),
        event("overspeed", 1, above(1.1 * rated), [&](double time) { machine.pitch->move_to(pi / 2, time); }),
        event("brake", -1, above(12 * units::rpm), [&](double time) { machine.brake_valve->turn(true, time); })};
    const DynamicState at = start.at(0);
    solvers::Integrator integrator(system, {}, 0, at.q, at.qd, options);
    solvers::Recorder recorder(integrator, machine.channels);
    auto file = solvers::HistoryWriter::create("emergency_stop.h5", recorder.channels(),
                                               {.title = "emergency stop of the 600 kW machine"}, {.replace = true});
    require_result(solvers::record(integrator, recorder, solvers::sample_times(0, 30, 0.02), file));
    file.finish();
    for (const solvers::HistoryMark& mark : marks) std::printf("%8.3f s  %s\n", mark.time, mark.label.c_str());
    const solvers::History history = solvers::read_history("emergency_stop.h5");
    solvers::plot(history, {{{"RotSpeed"}}, {{"BldPitch1"}}, {{"RotTorq"}}, {{"TTDspFA", "TTDspSS"}}},
                  "emergency_stop.svg", {.marks = marks});
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
