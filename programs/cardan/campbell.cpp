// Campbell diagram of any machine, over the rotor speed; or in the wind, over the wind speed.
//
// Problem: the machine's source becomes a description, blades and tower as beams; at every rotor speed it is brought to
// its steady state and linearised, and the multi-blade transformation makes the equations constant. With gravity or an
// unbalanced hub the steady state is periodic and the modes are those of the mean over the azimuth, with two blades
// they are Floquet's. Where a controller sets the pitch by the rotor speed, the machine differs from speed to speed.
// In the wind the machine is brought to its operating points as `cardan steady --wind` does, and the air is frozen, in
// equilibrium, or lags behind the motion; motions of the air alone are apart: no vibrations of the machine.
// What a source holds beside the structure, and what is taken otherwise than in the program it was made for, is printed
// as notes. Frames, signs, and what is read: docs/coming_from_openfast.md, docs/coming_from_windio.md.
#include "turbines/analysis/campbell.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/cardan/options.hpp"
#include "programs/shared/campbell_program.hpp"
#include "programs/shared/words.hpp"
#include "turbines/analysis/in_unit.hpp"

#include <iostream>
#include <optional>

namespace cardan::program {

namespace {

struct CampbellArguments {
    MachineOptions machine;
    VibrationArguments air;
    std::string rpm, pitch_schedule, like, out;
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
           "follow modes up to this frequency, Hz (default: 1.3 times the third of the blade, clamped and at rest)")
        .positive();
    add_like(app, a.like);
    app.add_flag("--gravity", a.machine.gravity, "with gravity");
    const Option wind = add_vibration_options(app, a.air);
    app.add_flag("--floquet", a.air.floquet,
                 "with --wind, Floquet's theory about the periodic state in the place of the mean over the azimuth")
        .only_with(wind);
    app.add_flag("--air-roots", a.air_roots,
                 "with --wind, compute all roots that are mostly states of the air, and draw them as well")
        .only_with(wind);
    app.add_option("--out", a.out, "prefix of the files (default: the machine's name and _campbell)");
}

// "0:4,7.5:1" to rad/s and rad.
std::vector<turbines::PitchAt> parse_schedule(const std::string& given) {
    constexpr auto option = "--pitch-schedule", allowed = "RPM:DEG separated by commas, speeds increasing";
    std::vector<turbines::PitchAt> schedule;
    if (given.empty()) return schedule;
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
        words += text(words.empty() ? "" : ",", digits(turbines::in_unit(one.rotor_speed, units::rpm)), ":",
                      digits(turbines::in_unit(one.pitch, units::degree)));
    return words;
}

turbines::CampbellSettings settings_of(const CampbellArguments& a) {
    turbines::CampbellSettings s;
    if (!a.rpm.empty()) s.rotor_speeds = rotor_speeds(a.rpm);
    s.winds = winds_of(a.air.wind);
    s.pitch_schedule = parse_schedule(a.pitch_schedule);
    s.machine = numbers_of(a.machine);
    s.gravity = a.machine.gravity;
    s.max_frequency_hz = a.max_frequency;
    s.like = a.like;
    s.air = settings_of(a.air.wind.air);
    s.operation = operation_of(a.air.wind);
    s.floquet = a.air.floquet;
    s.all_air_motions = a.air_roots;
    s.harmonics = a.air.harmonics;
    s.report = remarks_printed(a.machine.notes);
    s.progress = show_progress;
    s.cancelled = interrupted;
    return s;
}

// All of them, in the fewest digits that give them back.
std::string words_of(const std::vector<double>& speeds) {
    std::string words;
    for (const double speed : speeds)
        words += text(words.empty() ? "" : ",", digits(turbines::in_unit(speed, units::rpm)));
    return words;
}

void keep_taken(const turbines::CampbellSettings& taken, CampbellArguments& a) {
    keep_taken(taken.machine, a.machine);
    if (taken.winds.empty() && a.rpm.empty()) a.rpm = words_of(taken.rotor_speeds);
    a.pitch_schedule = schedule_words(taken.pitch_schedule);
    a.max_frequency = taken.max_frequency_hz;
    a.like = taken.like.string();
}

void write(const turbines::CampbellDiagram& diagram, const CampbellArguments& a) {
    solvers::CampbellPlotOptions picture;
    picture.max_frequency_hz = *a.max_frequency;
    picture.title = title_of(diagram);
    if (diagram.settings.winds.empty()) {
        write_files(diagram, a.out, picture);
        std::cout << "\nfiles: " << a.out << ".h5, .csv, .svg, .png\n";
        return;
    }
    picture.states = a.air_roots;
    picture.log_damping = true;
    write_files_and_roots(diagram, diagram, a.out, picture);
}

int run(CampbellArguments& a, const CommandLine& command) {
    const bool windy = !a.air.wind.speeds.empty();
    check_wind(a.air.wind, a.rpm);
    if (windy && !a.pitch_schedule.empty())
        throw InputError("--pitch-schedule", "value", a.pitch_schedule, "none beside --wind: see --schedule");
    const turbines::CampbellSettings settings = settings_of(a);
    if (a.out.empty()) a.out = default_prefix(a.machine.model, windy ? "campbell_wind" : "campbell");
    if (windy) check_outputs(a.out, {"_roots.svg", "_roots.png"}, {a.machine.model});
    check_outputs(a.out, {".h5", ".csv", ".svg", ".png"}, {a.machine.model, a.air.wind.schedule, a.like});
    turbines::Machine machine = prepared_machine(a.machine);
    if (windy) take_wind(machine, a.air.wind, a.machine);
    stop_at_once();  // until a point is done
    turbines::CampbellDiagram diagram = turbines::campbell(machine, settings);
    stop_at_once();
    if (a.machine.summary) std::cout << diagram.turbine->summary() << "\n";
    keep_taken(diagram.settings, a);
    diagram.source = run_text("campbell", command) + diagram.source;
    if (diagram.points.empty()) return interrupted() ? 130 : 1;
    print_table(diagram);
    write(diagram, a);
    if (!diagram.complete) return 130;
    return diagram.not_converged.empty() ? 0 : 1;
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
