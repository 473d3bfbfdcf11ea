// Flutter and divergence of a blade that turns too fast.
//
// Problem: one blade of the machine, clamped at its pitch setting to a hub that turns in still air, without gravity.
// Its sections see the air of their own motion; airfoils lag behind it (four states a section, shed vorticity among
// them), and no velocity is induced by the wake as a whole: the classical model of a blade's flutter. Modes are
// followed over the rotor speed about the steady state of each, and the speeds at which one begins or ceases to grow
// are found as roots. How much more than its own speed the machine may have is the margin.
//
// Reference for the method: D. W. Lobitz, Aeroelastic stability predictions for a MW-sized blade, Wind Energy 7 (2004)
// 211-224, whose blade turns in still air, and flutters at about twice the speed of its machine.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/cardan/options.hpp"
#include "programs/shared/campbell_program.hpp"
#include "solvers/stability/stability_limits.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/machine/machine_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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
constexpr int max_halvings = 3;
// By so many times as many elements a limit is sought again, in a range so wide about it.
constexpr std::array finer_meshes{1.5, 2.0};
constexpr double width_about = 0.15;
constexpr int steps_about = 4;

struct FlutterArguments {
    MachineOptions machine;
    AirArguments air;
    std::string rpm, out;
    bool air_roots = false;
    int steps = solvers::StabilityOptions{}.steps;
    std::optional<double> max_frequency;
};

void declare(CommandLine& app, FlutterArguments& a) {
    add_machine(app, a.machine);
    app.add_option("--rpm", a.rpm, "FIRST:LAST, rotor speeds, rev/min (default: 0.25 to 2.5 times the machine's)");
    app.add_option("--steps", a.steps, "of the search; they are halved where it is doubtful which mode is which")
        .range(1, 10000);
    add_machine_options(app, a.machine);
    add_airfoil_options(app, a.air);
    add_airfoils_option(app, a.air);
    app.add_option("--max-frequency", a.max_frequency,
                   "follow modes up to this frequency, Hz (default: 1.5 times the first torsion at rest)")
        .positive();
    app.add_flag("--air-roots", a.air_roots, "draw the roots that are mostly states of the air as well");
    app.add_option("--out", a.out, "prefix of the files (default: the machine's name and _flutter)");
}

// Torsion feels where the lift acts.
turbines::Aerodynamics air_for_torsion(const turbines::Machine& machine, const FlutterArguments& a) {
    turbines::AirSettings settings = settings_of(a.air);
    settings.wake = Wake::none;
    turbines::Aerodynamics air = turbines::air_of(machine, settings);
    if (!air.torsion_sweep.empty()) std::cout << "aerodynamic centres: those for torsion\n";
    air.blade = air.torsion_blade();
    return air;
}

struct SpeedRange {
    double first, last;  // rad/s
};

constexpr auto range_format = "FIRST:LAST, rev/min, 0 < FIRST < LAST";

SpeedRange speed_range(const std::string& given) {
    const std::vector<std::string> words = split(given, ':');
    if (words.size() != 2) throw InputError("--rpm", "value", given, range_format);
    const SpeedRange range{number("--rpm", given, words[0], range_format) * units::rpm,
                           number("--rpm", given, words[1], range_format) * units::rpm};
    if (!(range.first > 0 && range.last > range.first)) throw InputError("--rpm", "value", given, range_format);
    return range;
}

std::string usual_range(const turbines::Machine& machine) {
    const double own = machine.operation.rotor_speed * units::to_rpm;
    if (!(own > 0)) throw InputError("--rpm", "value", "none, and the model names no rotor speed", range_format);
    return text(digits(slowest * own), ":", digits(fastest * own));
}

turbines::Turbine blade_of(const turbines::Machine& machine, const MachineOptions& options) {
    const turbines::TurbineDescription& d = machine.description;
    return turbines::isolated_blade(d, assembly_options(machine, options), d.first_blade());
}

// The first torsion of the blade at rest, without air, Hz.
double torsion_hz(const turbines::Machine& machine, MachineOptions options) {
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
    throw InputError(machine.description.name, "blades", "rigid in torsion",
                     "ones that twist: without torsion there is no flutter");
}

solvers::StabilityLimits limits_of(const turbines::Turbine& blade, const turbines::Aerodynamics& air,
                                   const FlutterArguments& a, const SpeedRange& range, int steps) {
    RotorAirOptions own_motion = air.options;
    own_motion.skew = Skew::none;
    turbines::MachineAir still(blade, air.blade, SteadyWind{.density = air.density}, own_motion);
    if (!air.unsteady_airfoils.empty()) still = still.lagging({.airfoils = air.unsteady_airfoils});
    const turbines::Turbine in_air = still.on(blade);

    solvers::StabilityOptions options;
    options.steps = steps;
    options.halvings = max_halvings;
    options.modes = campbell_options(*a.max_frequency);
    options.modes.spin = solvers::RotorSpin::prescribed;
    options.modes.method = solvers::CampbellMethod::coleman;  // nothing depends on the azimuth
    const auto same = [&](double) {
        return solvers::CampbellCase{.system = &in_air.system(), .rotor = &in_air.rotor()};
    };
    return solvers::stability_limits(same, "", range.first, range.last, options);
}

// A limit by a finer mesh.
struct FinerLimit {
    int elements;
    std::optional<solvers::StabilityLimit> limit;  // none: not found next to the other
};

std::vector<FinerLimit> finer_limits(const solvers::StabilityLimit& limit, const turbines::Machine& machine,
                                     const turbines::Aerodynamics& air, const FlutterArguments& a) {
    std::vector<FinerLimit> all;
    const SpeedRange range{(1 - width_about) * limit.rotor_speed, (1 + width_about) * limit.rotor_speed};
    const auto distance = [&](const solvers::StabilityLimit& other) {
        return std::pair(other.name != limit.name, std::abs(other.rotor_speed - limit.rotor_speed));
    };
    for (const double times : finer_meshes) {
        MachineOptions options = a.machine;
        options.blade_elements = static_cast<int>(std::ceil(times * a.machine.blade_elements));
        solvers::StabilityLimits found;
        try {
            found = limits_of(blade_of(machine, options), air, a, range, steps_about);
        } catch (const NumericalError&) {  // no steady state at the lower end
        }
        if (interrupted()) break;
        std::erase_if(found.limits, [&](const solvers::StabilityLimit& other) {
            return other.kind != limit.kind || other.begins != limit.begins;
        });
        FinerLimit& one = all.emplace_back(FinerLimit{options.blade_elements, std::nullopt});
        if (!found.limits.empty()) one.limit = *std::ranges::min_element(found.limits, {}, distance);
    }
    return all;
}

// Without what is heavily damped everywhere, but for motions of states, which are left out or wanted by an option.
solvers::Campbell lightly_damped(const solvers::Campbell& diagram) {
    solvers::Campbell out = diagram;
    std::erase_if(out.branches, [&](const solvers::Branch& branch) {
        for (std::size_t i = 0; i < diagram.points.size(); ++i)
            if (diagram.damping_ratio(branch, i) < solvers::heavy_damping) return false;
        return !branch.of_states;
    });
    return out;
}

// With as many decimals as it has but for its error, which has one digit; three without an error.
std::string rounded(double value, double error) {
    const int decimals = error > 0 ? std::clamp(static_cast<int>(-std::floor(std::log10(error))), 0, 6) : 3;
    std::array<char, 64> digits{};
    std::snprintf(digits.data(), digits.size(), "%.*f", decimals, value);
    return digits.data();
}

// "24.5 rpm (+-0.6: 25.1 with 15 elements per blade, 24.1 with 20), 2.02 times the machine's, tip 162 m/s, 1.07 Hz"
std::string limit_in_words(const solvers::StabilityLimit& limit, const std::vector<FinerLimit>& others,
                           double own_speed, double radius) {
    double error = 0, error_hz = 0;
    for (const FinerLimit& other : others) {
        if (!other.limit) continue;
        error = std::max(error, std::abs(other.limit->rotor_speed - limit.rotor_speed));
        error_hz = std::max(error_hz, std::abs(other.limit->frequency_hz() - limit.frequency_hz()));
    }
    const auto rpm = [&](double speed) { return rounded(speed * units::to_rpm, error * units::to_rpm); };
    std::string words = rpm(limit.rotor_speed) + " rpm", meshes;
    for (const FinerLimit& other : others)
        meshes += text(meshes.empty() ? "" : ", ", other.limit ? rpm(other.limit->rotor_speed) : "none near", " with ",
                       other.elements, meshes.empty() ? " elements per blade" : "");
    if (!meshes.empty()) words += text(" (", error > 0 ? text("+-", rpm(error), ": ") : "", meshes, ")");
    if (own_speed > 0)
        words += text(", ", rounded(limit.rotor_speed / own_speed, error / own_speed), " times the machine's");
    words += text(", tip ", rounded(limit.rotor_speed * radius, error * radius), " m/s");
    if (limit.kind == solvers::Instability::flutter)
        words += text(", ", rounded(limit.frequency_hz(), error_hz), " Hz");
    return words + (limit.doubtful ? " (which mode it is, is doubtful)" : "");
}

void print_limits(const solvers::StabilityLimits& found, const turbines::Machine& machine,
                  const turbines::Aerodynamics& air, const FlutterArguments& a) {
    for (const solvers::StabilityLimit& limit : found.limits) {
        const std::vector<FinerLimit> others = finer_limits(limit, machine, air, a);
        std::printf("%s of %s %s %s\n", limit.kind == solvers::Instability::flutter ? "flutter" : "divergence",
                    limit.name.c_str(), limit.begins ? "from" : "ends at",
                    limit_in_words(limit, others, machine.operation.rotor_speed, air.blade.position.back()).c_str());
    }
    if (found.limits.empty() && found.diagram.complete) std::printf("neither flutter nor divergence begins or ends\n");
    if (!found.note.empty()) std::printf("note: %s\n", found.note.c_str());
    if (!found.diagram.warning.empty()) std::printf("warning: %s\n", found.diagram.warning.c_str());
}

int run(FlutterArguments& a, const CommandLine& command) {
    if (!a.rpm.empty()) static_cast<void>(speed_range(a.rpm));
    if (a.out.empty()) a.out = default_prefix(a.machine.model, "flutter");
    check_outputs(a.out, {".h5", ".csv", ".svg", ".png", "_roots.svg", "_roots.png"}, {a.machine.model});
    turbines::Machine machine = prepared_machine(a.machine);
    if (a.rpm.empty()) a.rpm = usual_range(machine);
    const SpeedRange range = speed_range(a.rpm);
    take_air(machine, a.air, a.machine);
    const turbines::Aerodynamics air = air_for_torsion(machine, a);
    set_pitch(machine, a.machine, machine.operation.rotor_speed);
    if (!a.max_frequency) a.max_frequency = modes_up_to * torsion_hz(machine, a.machine);
    const turbines::PreparedTurbine ready = ready_machine(machine, a.machine, *a.max_frequency, range.last);
    const turbines::Turbine blade = blade_of(machine, a.machine);
    const std::string answer = turbines::in_words(air.model);
    std::cout << "air of the blade: " << answer << "\n";
    solvers::StabilityLimits found = limits_of(blade, air, a, range, a.steps);
    solvers::Campbell& diagram = found.diagram;
    diagram.remark = "blade alone in still air, " + answer;
    diagram.accuracy = in_words(ready.mesh);
    diagram.source = run_text("flutter", command) + turbines::with_machine(diagram.source, machine);
    if (diagram.points.empty()) return 130;
    std::printf("\n");
    print_limits(found, machine, air, a);
    stop_at_once();
    solvers::CampbellPlotOptions picture;
    picture.max_frequency_hz = *a.max_frequency;
    picture.states = a.air_roots;
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
