// Campbell diagram of any machine, over the rotor speed; or in the wind, over the wind speed (campbell_wind.cpp).
//
// Problem: the machine's source becomes a description, blades and tower as beams; at every rotor speed it is brought to
// its steady state and linearised, and the multi-blade transformation makes the equations constant. With gravity or an
// unbalanced hub the steady state is periodic and the modes are those of the mean over the azimuth, with two blades
// they are Floquet's. Where a controller sets the pitch by the rotor speed, the machine differs from speed to speed.
// What a source holds beside the structure, and what is taken otherwise than in the program it was made for, is printed
// as notes. Frames, signs, and what is read: docs/coming_from_openfast.md, docs/coming_from_windio.md.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"

#include "programs/cardan/campbell_wind.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/cardan/operation.hpp"
#include "programs/shared/campbell_program.hpp"
#include "programs/shared/words.hpp"
#include <algorithm>
#include <iostream>
#include <optional>

namespace cardan::program {

namespace {

struct CampbellArguments {
    MachineOptions machine;
    VibrationArguments air;
    std::string rpm, pitch_schedule, out;
    std::optional<double> max_frequency;
    bool air_roots = false;
};

void declare(CommandLine& app, CampbellArguments& a) {
    add_machine(app, a.machine);
    app.add_option("--rpm", a.rpm,
                   "rotor speeds, numbers and FIRST:LAST:STEP separated by commas, rev/min (default: from 0 to 1.2 "
                   "times the machine's, in 12 steps)");
    app.add_option("--pitch-schedule", a.pitch_schedule,
                   "pitch over rotor speed, RPM:DEG separated by commas, linear in between (default: that of the "
                   "machine's controller, if it has one); --pitch sets one angle");
    add_machine_options(app, a.machine);
    app.add_option(
        "--max-frequency", a.max_frequency,
        "follow modes up to this frequency, Hz (default: 1.3 times the third of the blade, clamped and at rest)");
    app.add_flag("--gravity", a.machine.gravity, "with gravity");
    add_vibration_options(app, a.air);
    app.add_flag("--floquet", a.air.floquet,
                 "with --wind, Floquet's theory about the periodic state in the place of the mean over the azimuth");
    app.add_flag("--air-roots", a.air_roots,
                 "with --wind, compute all roots that are mostly states of the air, and draw them as well");
    app.add_option("--out", a.out, "prefix of the files (default: the machine's name and _campbell)");
}

std::vector<double> speeds_of(CampbellArguments& a, const turbines::Machine& machine) {
    if (!a.rpm.empty()) return rotor_speeds(a.rpm);
    const double rated = machine.operation.rotor_speed * units::to_rpm;
    if (!(rated > 0)) throw InputError("--rpm", "value", "none, and the model names no rotor speed", rpm_format);
    std::cout << "rotor speeds: 0 to " << 1.2 * rated << " rpm, 1.2 times " << rated << " rpm";
    if (!machine.operation.rotor_speed_source.empty()) std::cout << " (" << machine.operation.rotor_speed_source << ")";
    std::cout << "\n";
    const double step = read_number(text(0.1 * rated)).value;  // in few digits
    a.rpm = text("0:", digits(12 * step), ":", digits(step));
    return rotor_speeds(a.rpm);
}

// "0:4,7.5:1" to rad/s and rad.
std::vector<turbines::PitchAt> parse_schedule(const std::string& given) {
    constexpr auto option = "--pitch-schedule", allowed = "RPM:DEG separated by commas, speeds increasing";
    std::vector<turbines::PitchAt> schedule;
    for (const std::string& word : split(given, ',')) {
        const std::vector<std::string> pair = split(word, ':');
        if (pair.size() != 2) throw InputError(option, "value", given, allowed);
        const double speed = number(option, given, pair[0], allowed) * units::rpm,
                     pitch = number(option, given, pair[1], allowed) * units::degree;
        if (!schedule.empty() && !(speed > schedule.back().rotor_speed))
            throw InputError(option, "value", given, allowed);
        schedule.push_back({speed, pitch});
    }
    return schedule;
}

std::string schedule_words(const std::vector<turbines::PitchAt>& schedule) {
    std::string words;
    for (const turbines::PitchAt& one : schedule)
        words += text(words.empty() ? "" : ",", digits(one.rotor_speed * units::to_rpm), ":",
                      digits(one.pitch * units::to_degrees));
    return words;
}

// That of the options, or the machine's; empty: one angle for all speeds.
std::vector<turbines::PitchAt> schedule_of(const CampbellArguments& a, const turbines::Machine& machine) {
    if (!a.pitch_schedule.empty()) return parse_schedule(a.pitch_schedule);
    return a.machine.pitch ? std::vector<turbines::PitchAt>() : machine.operation.pitch_schedule;
}

// Degrees, by rotor speed. A schedule that does not change between the speeds is one angle, which --pitch holds.
std::vector<double> pitch_angles(CampbellArguments& a, const turbines::Machine& machine,
                                 const std::vector<double>& speeds) {
    const std::vector<turbines::PitchAt> schedule = schedule_of(a, machine);
    std::vector<double> angles;
    angles.reserve(speeds.size());
    for (const double speed : speeds)
        angles.push_back(schedule.empty() ? 0 : turbines::pitch_at(schedule, speed) * units::to_degrees);
    const auto [least, most] = std::ranges::minmax(angles);
    if (most - least < 1e-9) {
        if (!a.pitch_schedule.empty()) a.machine.pitch = angles.front();
        a.pitch_schedule.clear();
        set_pitch(machine, a.machine, speeds.back());
        return std::vector<double>(speeds.size(), *a.machine.pitch);
    }
    std::cout << "pitch: " << least << " to " << most << " deg over the rotor speed";
    if (a.pitch_schedule.empty()) std::cout << " (" << machine.operation.pitch_source << ")";
    std::cout << "\n";
    a.pitch_schedule = schedule_words(schedule);
    return angles;
}

// One machine for all speeds, or one for each.
solvers::Campbell diagram_of(const turbines::Machine& machine, const CampbellArguments& a,
                             const turbines::Turbine& first, const std::vector<double>& speeds,
                             const std::vector<double>& pitch, const solvers::CampbellOptions& options) {
    if (a.pitch_schedule.empty()) return solvers::campbell(first.system(), first.rotor(), speeds, options);
    std::vector<turbines::Turbine> machines;
    MachineOptions own = a.machine;
    for (const double angle : pitch) {
        own.pitch = angle;
        machines.push_back(turbines::assemble(machine.description, assembly_options(machine, own)));
    }
    std::vector<solvers::CampbellCase> cases;
    for (std::size_t i = 0; i < speeds.size(); ++i)
        cases.push_back({&machines[i].system(), &machines[i].rotor(), speeds[i], 0});
    return solvers::campbell(cases, "", options);
}

int run_in_wind(CampbellArguments& a, turbines::Machine machine, const CommandLine& command) {
    if (!a.rpm.empty()) throw InputError("--rpm", "value", a.rpm, "none beside --wind: see --schedule");
    if (!a.pitch_schedule.empty())
        throw InputError("--pitch-schedule", "value", a.pitch_schedule, "none beside --wind: see --schedule");
    take_wind(machine, a.air.wind, a.machine.notes);
    if (a.out.empty()) a.out = default_prefix(a.machine.model, "campbell_wind");
    if (!a.max_frequency) a.max_frequency = usual_frequency(machine, a.machine);
    return campbell_in_wind(machine, a.machine, a.air, *a.max_frequency, a.out, a.air_roots, command);
}

int run(CampbellArguments& a, const CommandLine& command) {
    const turbines::Machine machine = prepared_machine(a.machine);
    if (!a.air.wind.speeds.empty()) return run_in_wind(a, machine, command);
    if (a.out.empty()) a.out = default_prefix(a.machine.model, "campbell");
    const std::vector<double> speeds = speeds_of(a, machine), pitch = pitch_angles(a, machine, speeds);
    if (!a.pitch_schedule.empty()) a.machine.pitch = pitch.back();
    if (!a.max_frequency) a.max_frequency = usual_frequency(machine, a.machine);
    const ReadyMachine ready = ready_machine(machine, a.machine, *a.max_frequency, std::abs(speeds.back()));
    if (!a.pitch_schedule.empty()) a.machine.pitch.reset();

    check_outputs(a.out, {".h5", ".csv", ".svg", ".png"});
    solvers::CampbellOptions options = campbell_options(*a.max_frequency);
    options.method = diagram_method(machine, a.machine);
    options.spin = rotor_spin(machine);
    solvers::Campbell diagram = diagram_of(machine, a, ready.turbine, speeds, pitch, options);
    stop_at_once();
    tell_origin(diagram, "campbell", command, machine, ready);
    print_table(diagram);
    if (diagram.points.empty()) return 130;
    solvers::CampbellPlotOptions picture;
    picture.max_frequency_hz = *a.max_frequency;
    picture.title = title_of(diagram);
    write_files(diagram, a.out, picture);
    std::cout << "\nfiles: " << a.out << ".h5, .csv, .svg, .png\n";
    return diagram.complete ? 0 : 130;
}

}  // namespace

int campbell_command(int argc, char** argv) {
    return run_command<CampbellArguments>(
        "cardan campbell",
        "Campbell diagram of any machine: frequencies and damping over rotor speed, or with "
        "--wind, in the air, over the wind speed.\n"
        "Writes PREFIX.h5, PREFIX.csv, PREFIX.svg, PREFIX.png, and prints a table; "
        "with --wind also PREFIX_roots.svg, .png.",
        argc, argv, declare, run);
}

}  // namespace cardan::program
