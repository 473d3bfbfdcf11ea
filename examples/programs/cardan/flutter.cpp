// Flutter and divergence of a blade that turns too fast.
//
// Problem: one blade of the machine, clamped at its pitch setting to a hub that turns in still air, without gravity.
// Its sections see the air of their own motion; profiles lag behind it (four states a section, shed vorticity among
// them), and no velocity is induced by the wake as a whole: the classical model of a blade's flutter. Modes are
// followed over the rotor speed about the steady state of each, and the speeds at which one begins or ceases to grow
// are found as roots. How much more than its own speed the machine may have is the margin.
//
// Reference for the method: D. W. Lobitz, Aeroelastic stability predictions for a MW-sized blade, Wind Energy 7 (2004)
// 211-224, whose blade turns in still air, and flutters at about twice the speed of its machine.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/stability_limits.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/machines/nrel5mw_air.hpp"

#include "examples/programs/campbell_program.hpp"
#include "examples/programs/cardan/air.hpp"
#include "examples/programs/cardan/commands.hpp"
#include "examples/programs/cardan/operation.hpp"
#include <cstdio>
#include <iostream>
#include <limits>
#include <optional>

namespace cardan::program {

namespace {

// Of the machine's rotor speed.
constexpr double slowest = 0.25, fastest = 2.5;
// Of the first torsion at rest: what flutters lies below it, what it becomes is still seen.
constexpr double modes_up_to = 1.5;
constexpr int most_halvings = 3;

struct FlutterArguments {
    MachineOptions machine;
    AirArguments air;
    std::string rpm, out;
    bool steady_profiles = false;
    int steps = solvers::StabilityOptions{}.steps;
    std::optional<double> max_frequency;
};

void declare(CommandLine& app, FlutterArguments& a) {
    add_machine(app, a.machine);
    app.add_option("--rpm", a.rpm, "FIRST:LAST, rotor speeds, rev/min (default: 0.25 to 2.5 times the machine's)");
    app.add_option("--steps", a.steps, "of the search; they are halved where it is doubtful which mode is which")
        .range(1, 10000);
    add_machine_options(app, a.machine);
    add_profile_options(app, a.air);
    app.add_flag("--steady-profiles", a.steady_profiles,
                 "lift, drag and moment follow the angle of attack at once: flutter then comes early");
    app.add_option("--max-frequency", a.max_frequency,
                   "follow modes up to this frequency, Hz (default: 1.5 times the first torsion at rest)");
    app.add_option("--out", a.out, "prefix of the files (default: the machine's name and _flutter)");
}

// Torsion feels where the lift acts, which AeroDyn's files of the built-in machine leave out and its report has.
Air air_for_torsion(const MachineFile& machine, const FlutterArguments& a) {
    Air air = air_of(machine, a.machine, a.air);
    if (machine.kind == MachineKind::built_in && a.air.file.empty()) {
        std::cout << "aerodynamic centres: as in the machine's report\n";
        air.blade = turbines::nrel5mw_aero_blade(turbines::Nrel5mwCentres::report);
    }
    return air;
}

struct SpeedRange {
    double first, last;  // rad/s
};

SpeedRange speed_range(FlutterArguments& a, const MachineFile& machine) {
    constexpr auto format = "FIRST:LAST, rev/min, 0 < FIRST < LAST";
    const double own = machine.file.rotor_speed * units::to_rpm;
    if (a.rpm.empty()) {
        if (!(own > 0)) throw InputError("--rpm", "value", "none, and the model names no rotor speed", format);
        a.rpm = text(digits(slowest * own), ":", digits(fastest * own));
    }
    const std::vector<std::string> words = split(a.rpm, ':');
    if (words.size() != 2) throw InputError("--rpm", "value", a.rpm, format);
    const SpeedRange range{number("--rpm", a.rpm, words[0], format) * units::rpm,
                           number("--rpm", a.rpm, words[1], format) * units::rpm};
    if (!(range.first > 0 && range.last > range.first)) throw InputError("--rpm", "value", a.rpm, format);
    return range;
}

turbines::Turbine blade_of(const MachineFile& machine, const MachineOptions& options) {
    const turbines::TurbineDescription& d = machine.file.description;
    return turbines::isolated_blade(d, assembly_options(machine, options), first_blade(d));
}

// The first torsion of the blade at rest, without air, Hz.
double torsion_hz(const MachineFile& machine, MachineOptions options) {
    constexpr int enough = 12;  // elements
    if (options.blade_elements == 0) options.blade_elements = enough;
    options.tower_elements = 1;
    const turbines::Turbine blade = blade_of(machine, options);
    solvers::CampbellOptions all;
    all.max_frequency_hz = std::numeric_limits<double>::infinity();
    all.keep_shapes = false;
    const solvers::Campbell at_rest = solvers::campbell(blade.system(), blade.rotor(), {0.0}, all);
    for (const solvers::Branch& branch : at_rest.branches)
        if (branch.family == "blade torsion") return at_rest.natural_hz(branch, 0);
    throw InputError(machine.file.description.name, "blades", "rigid in torsion",
                     "ones that twist: without torsion there is no flutter");
}

solvers::StabilityLimits limits_of(const turbines::Turbine& blade, const Air& air, const FlutterArguments& a,
                                   const SpeedRange& range) {
    RotorAirOptions own_motion = air.options;
    own_motion.induction = false;
    own_motion.skew = Skew::none;
    turbines::MachineAir still(blade, air.blade, SteadyWind{.density = air.density}, own_motion);
    const bool lags = !a.steady_profiles && !air.profiles.empty();
    if (lags) still = still.lagging({.profiles = air.profiles});
    const turbines::Turbine in_air = still.on(blade);

    solvers::StabilityOptions options;
    options.steps = a.steps;
    options.halvings = most_halvings;
    options.modes = campbell_options(*a.max_frequency);
    options.modes.spin = solvers::RotorSpin::prescribed;
    options.modes.method = solvers::CampbellMethod::coleman;  // nothing depends on the azimuth
    const auto same = [&](double) {
        return solvers::CampbellCase{.system = &in_air.system(), .rotor = &in_air.rotor()};
    };
    solvers::StabilityLimits found = solvers::stability_limits(same, "", range.first, range.last, options);
    found.diagram.remark = text("blade alone in still air, profiles ", lags ? "unsteady" : "steady");
    return found;
}

// Without what is heavily damped everywhere: mixtures with the air's states.
solvers::Campbell lightly_damped(const solvers::Campbell& diagram) {
    constexpr double heavily = 0.5;
    solvers::Campbell out = diagram;
    std::erase_if(out.branches, [&](const solvers::Branch& branch) {
        for (std::size_t i = 0; i < diagram.points.size(); ++i)
            if (diagram.damping_ratio(branch, i) < heavily) return false;
        return true;
    });
    return out;
}

void print_limits(const solvers::StabilityLimits& found, double own_speed, double radius) {
    for (const solvers::StabilityLimit& limit : found.limits) {
        const bool flutter = limit.kind == solvers::Instability::flutter;
        std::printf("%s of %s %s %.3f rpm", flutter ? "flutter" : "divergence", limit.name.c_str(),
                    limit.begins ? "from" : "ends at", limit.rotor_speed * units::to_rpm);
        if (own_speed > 0) std::printf(", %.3f times the machine's", limit.rotor_speed / own_speed);
        std::printf(", tip %.1f m/s", limit.rotor_speed * radius);
        if (flutter) std::printf(", %.4f Hz", limit.frequency_hz());
        std::printf("%s\n", limit.doubtful ? " (which mode it is, is doubtful)" : "");
    }
    if (found.limits.empty() && found.diagram.complete) std::printf("neither flutter nor divergence begins or ends\n");
    if (!found.note.empty()) std::printf("note: %s\n", found.note.c_str());
}

int run(FlutterArguments& a, const CommandLine& command) {
    const MachineFile machine = prepared_machine(a.machine);
    if (a.out.empty()) a.out = default_prefix(a.machine.model, "flutter");
    const SpeedRange range = speed_range(a, machine);
    const Air air = air_for_torsion(machine, a);
    set_pitch(machine, a.machine, machine.file.rotor_speed);
    if (!a.max_frequency) a.max_frequency = modes_up_to * torsion_hz(machine, a.machine);
    const ReadyMachine ready = ready_machine(machine, a.machine, *a.max_frequency, range.last);
    check_outputs(a.out, {".h5", ".csv", ".svg", ".png", "_roots.svg", "_roots.png"});

    const turbines::Turbine blade = blade_of(machine, a.machine);
    solvers::StabilityLimits found = limits_of(blade, air, a, range);
    stop_at_once();
    solvers::Campbell& diagram = found.diagram;
    diagram.accuracy = in_words(ready.mesh);
    diagram.source = run_text("flutter", command) + diagram.source;
    if (diagram.points.empty()) return 130;
    std::printf("\n");
    print_limits(found, machine.file.rotor_speed, air.blade.position.back());
    solvers::CampbellPlotOptions picture;
    picture.max_frequency_hz = *a.max_frequency;
    picture.title = title_of(diagram);
    write_files_and_roots(diagram, lightly_damped(diagram), a.out, picture);
    if (diagram.complete) return 0;
    return interrupted() ? 130 : 1;
}

}  // namespace

int flutter_command(int argc, char** argv) {
    return run_command<FlutterArguments>(
        "cardan flutter",
        "Rotor speeds at which a blade of a machine begins to flutter or diverges: one blade that turns in still air, "
        "its modes followed over the rotor speed.\n"
        "Writes PREFIX.h5, PREFIX.csv, PREFIX.svg, PREFIX.png, PREFIX_roots.svg, PREFIX_roots.png, and prints the "
        "limits.",
        argc, argv, declare, run);
}

}  // namespace cardan::program
