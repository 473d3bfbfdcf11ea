// Emergency stop of the 600 kW machine after the loss of the grid.
//
// Problem: the machine runs at rated power, 32.9 rpm, with its converter. The grid is lost, the generator's torque
// vanishes, the rotor speeds up. At the overspeed limit all blades are commanded to feather; below a speed, or after a
// delay, the brake is applied until the rotor stands. Equations of motion g q'' + Gamma q' q' = Q with gravity and a
// prescribed load on the rotor (no aerodynamics, see elements/machine/rotor_load.hpp).
// Checks: the energy balance, by the integration and by the recorded powers; the order of events; standstill.
#include "mbs/base/units.hpp"

#include "examples/studies/wt600_simulation.hpp"

using namespace cardan;

namespace {

struct Arguments {
    program::SimulationArguments simulation;
    double speed = 0;  // rev/min; 0: where rotor and generator balance
    double wind = 11.86, loss = 5, overspeed = 1.1, brake_speed = 12, brake_delay = 0, after = 20;
    bool by_delay = false, no_gravity = false;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Emergency stop of the 600 kW machine: grid loss, overspeed, pitch to feather, brake, standstill.\n"
        "Prints the events, the largest loads and the balance of energy; writes PREFIX.h5, .svg, .png, "
        "_energy.png and\n_spectrum.png (after standstill).");
    a.simulation.out = "wt600_emergency_stop";
    program::add_simulation_options(app, a.simulation);
    const program::Option speed =
        app.add_option("--rpm", a.speed,
                       "rotor speed at the start, rev/min (default: where rotor and generator balance)")
            .hide_default();
    app.add_option("--wind", a.wind, "wind speed, m/s");
    app.add_option("--grid-loss", a.loss, "time of the loss of the grid, s");
    app.add_option("--overspeed", a.overspeed, "limit of the speed, by the speed at the start");
    const program::Option brake_speed =
        app.add_option("--brake-speed", a.brake_speed, "the brake is applied below, rev/min");
    const program::Option brake_delay =
        app.add_option("--brake-delay", a.brake_delay, "or so long after the overspeed, s")
            .hide_default()
            .excludes(brake_speed);
    app.add_option("--after", a.after, "time simulated after standstill, s");
    app.add_flag("--no-gravity", a.no_gravity, "leave out gravity");
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    a.by_delay = brake_delay.given();
    program::check_run_options(a.simulation);
    if (speed.given()) require_positive("--rpm", "value", a.speed);
    require_positive("--brake-speed", "value", a.brake_speed);
    require_positive("--grid-loss", "value", a.loss);
    require_not_negative("--after", "value", a.after);
    require_not_negative("--brake-delay", "value", a.brake_delay);
    if (!(a.overspeed > 1)) throw InputError("--overspeed", "value", a.overspeed, "> 1");
    return -1;
}

struct Happened {
    std::string name;
    double time, speed, pitch;  // s, rad/s, rad
};

// The supervisor of the machine: events, and what was noted at each.
class Supervisor {
public:
    Supervisor(const Arguments& a, turbines::Wt600Operation machine)
        : a_(a), machine_(std::move(machine)), spin_(machine_.turbine.rotor().spin) {}

    std::vector<solvers::Event> events() {
        using solvers::AfterEvent;
        std::vector<solvers::Event> events;
        const auto add = [&](const char* name, int direction, auto function, auto action) {
            events.push_back({name, function, direction, [this, name, action](solvers::Integrator& integrator) {
                                  const AfterEvent after = action(integrator.time());
                                  if (after != AfterEvent::proceed) note(name, integrator);
                                  return after;
                              }});
        };
        add(
            "grid loss", 1, [this](const ForceInput& in) { return in.time - a_.loss; },
            [this](double time) {
                machine_.grid->turn(false, time);
                return AfterEvent::restart;
            });
        add(
            "overspeed, pitch to feather", 1,
            [this](const ForceInput& in) { return in.qd(spin_) - a_.overspeed * a_.speed * units::rpm; },
            [this](double time) {
                if (overspeed_at_ >= 0) return AfterEvent::proceed;
                overspeed_at_ = time;
                machine_.pitch->move_to(pi / 2, time);
                return AfterEvent::restart;
            });
        add(
            "brake on", -1,
            [this](const ForceInput& in) {
                if (overspeed_at_ < 0 || machine_.brake_valve->is_on()) return 1.0;
                if (a_.by_delay) return overspeed_at_ + a_.brake_delay - in.time;
                return in.qd(spin_) - a_.brake_speed * units::rpm;
            },
            [this](double time) {
                machine_.brake_valve->turn(true, time);
                return AfterEvent::restart;
            });
        add(
            "standstill", -1, [this](const ForceInput& in) { return hub_speed(in.qd, in.kinematics.model()); },
            [this](double) {  // later it swings about zero
                return std::exchange(stands_, true) ? AfterEvent::proceed : AfterEvent::stop;
            });
        return events;
    }

    double hub_speed(const Vector& qd, const Model& model) const {
        double sum = 0;
        for (const auto& [body, factor] : machine_.turbine.layout().azimuth) sum += factor * qd(model.index(body));
        return sum;
    }

    std::vector<Happened> list;

private:
    void note(const char* name, const solvers::Integrator& integrator) {
        const Model& model = machine_.turbine.system().model;
        list.push_back({name, integrator.time(), hub_speed(integrator.state().qd, model),
                        machine_.pitch->at(integrator.time()).position});
    }

    const Arguments& a_;
    turbines::Wt600Operation machine_;
    int spin_;
    double overspeed_at_ = -1;
    bool stands_ = false;
};

turbines::Wt600Operation machine_of(const Arguments& a, bool gravity) {
    turbines::Wt600OperationOptions options = program::operation_options(a.simulation);
    options.generator = turbines::Wt600Generator::converter;
    options.wind = a.wind;
    if (!gravity) options.assembly.gravity.setZero();
    return turbines::wt600_operation(options);
}

bool in_order(const std::vector<Happened>& list) {
    const char* const names[] = {"grid loss", "overspeed, pitch to feather", "brake on", "standstill"};
    if (list.size() < std::size(names)) return false;
    for (std::size_t i = 0; i < std::size(names); ++i)
        if (list[i].name != names[i]) return false;
    return true;
}

int run(const Arguments& given) {
    program::check_outputs(given.simulation.out, program::run_outputs);
    Arguments a = given;
    const turbines::Wt600Operation machine = machine_of(a, !a.no_gravity), calm = machine_of(a, false);
    const bool balanced = a.speed == 0;
    if (balanced) a.speed = program::balanced_speed(calm, turbines::wt600_rated_speed()) / units::rpm;
    const program::Start start = program::rotating_start(machine, calm, a.speed * units::rpm);
    const System& system = machine.turbine.system();
    Supervisor supervisor(a, machine);
    solvers::IntegrationOptions options = program::integration_options(a.simulation);
    options.events = supervisor.events();
    solvers::Integrator integrator(system, {}, 0, start.q, start.qd, options);
    solvers::Recorder recorder(integrator, machine.channels);
    program::Rows rows("emergency stop of the 600 kW machine", machine.turbine.summary(), a.simulation, integrator,
                       recorder);

    const program::Stopwatch watch;
    solvers::Advance end = program::record(integrator, recorder, 0, a.simulation.duration, a.simulation.step, rows);
    const bool stands = end.end == solvers::Advance::End::event;
    const double standstill = integrator.time();
    if (stands && a.after > 0)
        end = program::record(integrator, recorder, integrator.time(), integrator.time() + a.after, a.simulation.step,
                              rows);
    const program::Elapsed elapsed = watch.elapsed();
    program::progress("\r                              \r");

    std::printf("%-32s %10s %10s %10s\n", "event", "time, s", "rpm", "pitch, deg");
    for (const Happened& h : supervisor.list)
        std::printf("%-32s %10.4f %10.3f %10.2f\n", h.name.c_str(), h.time, h.speed / units::rpm,
                    h.pitch / units::degree);
    const program::Extreme fastest = program::largest(rows.history(), "RotSpeed");
    std::printf("%-32s %10.4f %10.3f\n", "(largest rotor speed)", fastest.time, fastest.value / units::rpm);
    program::print_largest(
        rows.history(), {"TwrBsMyt", "TwrBsMxt", "TwrBsFxt", "TTDspFA", "YawBrTAxp", "RootMyb1", "RootMxb1", "RootFzb1",
                         "OoPDefl1", "IPDefl1", "RotTorq", "HSSBrTq", "GenTq"});
    bool good = program::check_energy(integrator, rows.history(), a.simulation);
    const double spectra_from = stands ? standstill : integrator.time() - 40;
    if (end.end == solvers::Advance::End::cancelled) {
        program::write_outputs(rows, a.simulation.out, false, spectra_from);
        return 130;
    }
    if (balanced)
        good = program::check("start in equilibrium: change of rotor speed before grid loss",
                              program::speed_drift(rows.history(), a.loss), 1e-3) &&
               good;
    good = program::check("events in order, rotor stands (0: yes)", stands && in_order(supervisor.list) ? 0 : 1, 0) &&
           good;
    program::print_effort(integrator, system, elapsed);
    program::write_outputs(rows, a.simulation.out, true, spectra_from);
    return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("wt600_emergency_stop", argc, argv, parse, run);
}
