// Motion of any machine in time, from a start in steady rotation or at rest.
//
// Problem: a machine (built in, or a file of OpenFAST, windIO or our own) starts at a rotor speed in its steady state
// under gravity, periodic where it is: two blades, unequal blades, gravity itself. From there its equations of motion
// are integrated with the rotor free, against a constant torque of the generator or one that rises with its speed, or
// driven at constant speed. Coordinates may start elsewhere, to see their motion decay. There is no wind.
// Checks: the energy balance, by the integration and by the recorded power of the generator.
#include "elements/machine/coordinate_force.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/base/units.hpp"
#include "turbines/model/channels.hpp"

#include "examples/shared/machine_file.hpp"
#include "examples/shared/named_values.hpp"
#include "examples/shared/simulation_run.hpp"
#include "examples/shared/steady_rotation.hpp"
#include <algorithm>

using namespace cardan;

namespace {

struct Arguments {
    program::MachineOptions machine;
    program::RunArguments run;
    std::optional<double> rpm;
    std::string start = "steady";
    double azimuth = 0, torque = 0, slope = 0;
    bool no_gravity = false, list = false;
    std::vector<std::string> plot, q, qd;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Motion of any machine in time, without wind: gravity, a rotor that is free or driven, a generator.\n"
        "Prints the largest loads and the balance of energy; writes PREFIX.h5, .svg, .png, _energy.png and "
        "_spectrum.png (second half).");
    a.run.out = "turbine_time_history";
    a.run.duration = 20;
    program::add_machine(app, a.machine);
    program::add_run_options(app, a.run);
    app.add_option("--rpm", a.rpm, "rotor speed at the start, rev/min (default: the model's)");
    app.add_option("--azimuth", a.azimuth, "azimuth of blade 1 at the start, deg, zero upward");
    app.add_option("--start", a.start, "steady: bent as in steady rotation, or at rest; undeformed: straight")
        .one_of({"steady", "undeformed"});
    app.add_option("--q", a.q, "COORDINATE=NUMBER: where it starts instead, rad or m; may be repeated").one_word();
    app.add_option("--qd", a.qd, "COORDINATE=NUMBER: its rate, rad/s or m/s; may be repeated").one_word();
    app.add_option("--generator-torque", a.torque,
                   "of the generator on its own shaft, N m, constant; positive brakes positive rotation");
    app.add_option("--generator-slope", a.slope,
                   "rise of this torque with the generator's speed above that at the start, as of slip, N m s/rad");
    app.add_flag("--no-gravity", a.no_gravity, "without gravity");
    program::add_machine_options(app, a.machine);
    app.add_option("--plot", a.plot,
                   "channels of one panel of the pictures, by name or alias, joined by +: TTDspFA+TTDspSS; may be "
                   "repeated (default: speeds, deflections and loads)")
        .one_word();
    app.add_flag("--list", a.list, "print the channels and end");
    app.add_flag("--resume", a.run.resume,
                 "go on with PREFIX.h5 from where it was broken off, or beyond its end; same options but --duration");
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    program::check_run_options(a.run);
    a.machine.gravity = !a.no_gravity;
    return -1;
}

// T = torque + slope (speed - speed at the start), of the generator on its own shaft.
struct ConstantGenerator {
    double torque = 0, slope = 0, start = 0, ratio = 1;  // N m, N m s/rad, rad/s, -
    BodyId shaft;

    double at(double rate) const { return torque + slope * (ratio * rate - start); }
    bool acts() const { return torque != 0 || slope != 0; }
};

turbines::Turbine with_generator(const turbines::Turbine& turbine, const ConstantGenerator& generator) {
    if (!generator.acts()) return turbine;
    ForceSet forces = turbine.forces();
    const auto law = [generator](double, double, double rate) {
        return CoordinateLaw{.force = -generator.ratio * generator.at(rate),
                             .by_rate = -generator.ratio * generator.ratio * generator.slope};
    };
    forces.add_user(coordinate_force("generator", generator.shaft, law, false));
    return turbine.with_forces(forces, text("generator: ", generator.torque, " N m + ", generator.slope,
                                            " N m s/rad (speed - ", generator.start, " rad/s), on its own shaft"));
}

ChannelGroup generator_channels(const ConstantGenerator& generator) {
    ChannelGroup group;
    group.channels = {{.name = "generator torque",
                       .units = "N m",
                       .long_name = "torque of the generator, positive: brakes",
                       .frame = "axis of the generator shaft",
                       .alias = "GenTq"},
                      {.name = "generator power",
                       .units = "W",
                       .long_name = "mechanical power taken from the shaft",
                       .frame = "axis of the generator shaft"}};
    group.sample = [generator](const ChannelInput& in, double* values) {
        const double rate = in.qd(in.kinematics.model().index(generator.shaft));
        values[0] = generator.at(rate);
        values[1] = values[0] * generator.ratio * rate;
    };
    return group;
}

solvers::OperatingPoint at_rest(const turbines::Turbine& turbine, double azimuth) {
    solvers::SteadyOptions options;
    options.azimuth = azimuth;
    const solvers::SteadyState state = solvers::steady_state(turbine.system(), turbine.rotor().spin, options);
    require_result(state);
    return state.at;
}

constexpr double good_start = 1e-6;  // rad or m

// Empty, with the reason printed: there is no steady state, or it was not found.
std::optional<program::Start> steady_start(const turbines::Turbine& turbine, double speed, double azimuth) {
    try {
        const solvers::OperatingPoint at = speed == 0
                                               ? at_rest(turbine, azimuth)
                                               : program::steady_rotation(turbine, speed, 8, good_start).at(azimuth);
        return program::Start{at.q, at.qd};
    } catch (const NumericalError& error) {
        std::cout << "note: the start is undeformed: " << error.what() << "\n";
        return std::nullopt;
    }
}

program::Start start_of(const Arguments& a, const turbines::Turbine& turbine, double speed) {
    const System& system = turbine.system();
    const int spin = turbine.rotor().spin;
    const double azimuth = a.azimuth * units::degree;
    std::optional<program::Start> start;
    if (a.start == "steady") start = steady_start(turbine, speed, azimuth);
    if (!start) start = {Vector::Zero(system.model.size()), Vector::Zero(system.model.size())};
    start->q(spin) = azimuth;
    start->qd(spin) = speed;
    const CoordinateTable& table = system.model.coordinates();
    return {program::named_values("--q", a.q, table, start->q, false),
            program::named_values("--qd", a.qd, table, start->qd, false)};
}

solvers::HistoryPanel panel(const std::string& joined) {
    solvers::HistoryPanel panel;
    for (std::size_t at = 0; at <= joined.size();) {
        const std::size_t plus = std::min(joined.find('+', at), joined.size());
        panel.channels.push_back(joined.substr(at, plus - at));
        at = plus + 1;
    }
    return panel;
}

bool has(const std::vector<Channel>& channels, const std::string& name) {
    return std::ranges::any_of(channels, [&](const Channel& c) { return c.name == name || c.alias == name; });
}

// Those of the first blade that is there.
std::vector<std::string> blade_panels(const turbines::MachineLayout& layout) {
    if (layout.blade_numbers.empty()) return {};
    const std::string blade = text("blade ", layout.blade_numbers.front());
    return {text(blade, " tip out-of-plane deflection+", blade, " tip in-plane deflection"),
            text(blade, " root moment y+", blade, " root moment x")};
}

// What was asked for, or what there is of a list.
std::vector<solvers::HistoryPanel> panels(const Arguments& a, const turbines::MachineLayout& layout,
                                          const std::vector<Channel>& channels) {
    std::vector<solvers::HistoryPanel> all;
    const solvers::History names{"--plot", channels, {}, {}};
    for (const std::string& joined : a.plot) {
        all.push_back(panel(joined));
        for (const std::string& channel : all.back().channels) static_cast<void>(names.index(channel));
    }
    if (!all.empty()) return all;
    std::vector<std::string> candidates{"RotSpeed",       "GenTq",           "teeter angle",     "yaw",
                                        "platform pitch", "TTDspFA+TTDspSS", "TwrBsMyt+TwrBsMxt"};
    for (std::string& blade : blade_panels(layout)) candidates.push_back(std::move(blade));
    for (const std::string& joined : candidates)
        if (const solvers::HistoryPanel one = panel(joined); has(channels, one.channels.front())) all.push_back(one);
    return all;
}

std::vector<const char*> of_interest(const turbines::MachineLayout& layout, const std::vector<Channel>& channels,
                                     std::vector<std::string>& names) {
    names = {"RotSpeed", "GenTq", "RotTorq", "TTDspFA", "TTDspSS", "TwrBsMyt", "TwrBsMxt", "yaw", "teeter angle"};
    for (int number : layout.blade_numbers) {
        const std::string blade = text("blade ", number);
        names.insert(names.end(), {blade + " tip out-of-plane deflection", blade + " root moment y",
                                   blade + " root moment x", blade + " root force z"});
    }
    std::vector<const char*> there;
    for (const std::string& name : names)
        if (has(channels, name)) there.push_back(name.c_str());
    return there;
}

void print(const std::vector<Channel>& channels) {
    for (const Channel& c : channels)
        std::printf("%-44s %-10s %-8s %s\n", c.name.c_str(), c.alias.c_str(), c.units.c_str(), c.long_name.c_str());
}

std::string options_of(const Arguments& a, double speed) {
    std::string changed;
    for (const std::string& word : a.q) changed += ", q " + word;
    for (const std::string& word : a.qd) changed += ", qd " + word;
    return text("start ", a.start, " at ", speed, " rad/s, azimuth ", a.azimuth, " deg", changed, ", ",
                program::options_text(a.run));
}

// A rotor that is driven turns on at the speed of the start.
std::vector<solvers::Drive> drives(bool driven, int spin, const program::Start& start) {
    if (!driven) return {};
    return {{spin, solvers::Motion::constant_rate(start.q(spin), start.qd(spin))}};
}

bool check_energy(solvers::Integrator& integrator, const solvers::History& history, const Arguments& a,
                  bool generator) {
    const solvers::EnergyBalance end = integrator.energy();
    const double kinetic = program::largest(history, "kinetic energy").value;
    const double exchanged = program::exchanged_energy(history);
    const bool parked = exchanged > kinetic;
    const double scale = parked ? exchanged : kinetic;
    std::printf("\n");
    bool good = program::check_energy(end, scale, 10 * a.run.tolerance, parked);
    if (generator && history.time.size() > 1)
        good = program::check("recorded power of the generator against its work, likewise",
                              (program::integral(history, "generator power") + end.loads) / scale, a.run.step / 4) &&
               good;
    return good;
}

int run(const Arguments& given) {
    Arguments a = given;
    const program::MachineFile machine = program::prepared_machine(a.machine);
    const turbines::TurbineDescription& description = machine.file.description;
    const double speed = a.rpm ? *a.rpm * units::rpm : machine.file.rotor_speed;
    if (!std::isfinite(speed)) throw InputError("--rpm", "value", *a.rpm, "finite");
    const turbines::Mesh mesh =
        program::choose_mesh(machine, a.machine, program::usual_frequency(machine, a.machine), std::abs(speed));
    const turbines::Turbine plain = turbines::assemble(description, program::assembly_options(machine, a.machine));
    program::introduce(plain, a.machine.summary);
    std::cout << program::in_words(mesh) << "\n";
    const double ratio = plain.layout().gear_ratio;
    const ConstantGenerator generator{a.torque, a.slope, ratio * speed, ratio, *plain.layout().generator};
    const turbines::Turbine turbine = with_generator(plain, generator);
    const System& system = turbine.system();
    const int spin = turbine.rotor().spin;
    const bool driven = !machine.file.dofs.generator;

    const std::string title = text(description.name, a.machine.gravity ? "" : ", no gravity"),
                      about = text(options_of(a, speed), "\n", turbine.rotor().description);
    if (!a.run.resume && !a.list) program::check_outputs(a.run.out, program::run_outputs);
    const std::optional<solvers::Checkpoint> broken_off = program::start_of(a.run, about);
    const program::Start start = start_of(a, turbine, speed);
    const solvers::IntegrationOptions options = program::integration_options(a.run);
    solvers::Integrator integrator =
        broken_off ? solvers::Integrator(system, drives(driven, spin, start), *broken_off, options)
                   : solvers::Integrator(system, drives(driven, spin, start), 0, start.q, start.qd, options);
    std::vector<ChannelGroup> channels = turbines::channels(turbine);
    if (generator.acts()) channels.push_back(generator_channels(generator));
    solvers::Recorder recorder(integrator, channels);
    if (a.list) return print(recorder.channels()), 0;
    const std::vector<solvers::HistoryPanel> pictures = panels(a, turbine.layout(), recorder.channels());
    program::Rows rows = broken_off ? program::Rows(a.run, integrator, recorder)
                                    : program::Rows(title, about, a.run, integrator, recorder);

    const program::Stopwatch watch;
    const solvers::Advance end = program::record(integrator, recorder, 0, a.run.duration, a.run.step, rows);
    const program::Elapsed elapsed = watch.elapsed();
    program::progress("\r                              \r");

    std::printf("%s: from %g rpm, rotor %s, %g s\n", title.c_str(), speed / units::rpm, driven ? "driven" : "free",
                integrator.time());
    std::vector<std::string> names;
    program::print_largest(rows.history, of_interest(turbine.layout(), recorder.channels(), names));
    const bool good = check_energy(integrator, rows.history, a, generator.acts());
    program::print_effort(integrator, system, elapsed);
    std::vector<solvers::HistoryPanel> spectra;
    if (turbine.layout().tower) spectra.push_back({{"YawBrTAxp", "YawBrTAyp"}});
    if (const auto blade = blade_panels(turbine.layout()); !blade.empty()) spectra.push_back(panel(blade.back()));
    program::write_outputs(rows, a.run.out, end.reached(), pictures, spectra,
                           {.from = integrator.time() / 2,
                            .blades = static_cast<int>(turbine.layout().blades.size()),
                            .max_frequency_hz = 8});
    if (!end.reached()) return 130;
    return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("turbine_time_history", argc, argv, parse, run);
}
