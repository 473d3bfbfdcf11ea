#include "turbines/analysis/campbell.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "turbines/analysis/detail/rounded.hpp"
#include "turbines/analysis/in_unit.hpp"
#include "turbines/analysis/machine_wind.hpp"
#include "turbines/analysis/prepared_machine.hpp"
#include "turbines/analysis/rising.hpp"
#include "turbines/analysis/wind_run.hpp"
#include "turbines/machine/machine_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

void check(const CampbellSettings& s) {
    if (s.max_frequency_hz) require_positive("CampbellSettings::max_frequency_hz", "value [Hz]", *s.max_frequency_hz);
    if (s.harmonics < 1 || s.harmonics > 200)
        throw InputError("CampbellSettings::harmonics", "value", s.harmonics, "1 ... 200");
    for (std::size_t i = 1; i < s.pitch_schedule.size(); ++i)
        if (!(s.pitch_schedule[i].rotor_speed > s.pitch_schedule[i - 1].rotor_speed))
            throw InputError("CampbellSettings::pitch_schedule", "rotor speed [rad/s]", s.pitch_schedule[i].rotor_speed,
                             "rising");
    if (s.winds.empty()) return;
    if (!s.rotor_speeds.empty())
        throw InputError("CampbellSettings::rotor_speeds", "number", s.rotor_speeds.size(),
                         "none beside winds: see MachineOperation::schedule");
    if (!s.pitch_schedule.empty())
        throw InputError("CampbellSettings::pitch_schedule", "number of rows", s.pitch_schedule.size(),
                         "none beside winds: see MachineOperation::schedule");
    if (!s.like.empty())
        throw InputError("CampbellSettings::like", "file", s.like.string(),
                         "none beside winds: modes are followed from one to the next");
}

std::vector<double> usual_speeds(const Machine& machine, const Report& report) {
    const double rated = machine.operation.rotor_speed * units::to_rpm;
    if (!(rated > 0)) {
        report_remark(report, {Remark::Kind::taken, "rotor speed: 0, the model names none"});
        return {0};
    }
    const std::string& source = machine.operation.rotor_speed_source;
    report_remark(report,
                  {Remark::Kind::taken, text("rotor speeds: 0 to ", rounded(1.2 * rated), " rpm, 1.2 times ",
                                             rounded(rated), " rpm", source.empty() ? "" : text(" (", source, ")"))});
    const double step = read_number(text(0.1 * rated)).value;  // in few digits
    return solvers::rpm_range(0, 12 * step, step);
}

// Of the settings, or the machine's; empty: one angle for all speeds.
std::vector<PitchAt> schedule_of(const CampbellSettings& s, const Machine& machine) {
    if (!s.pitch_schedule.empty()) return s.pitch_schedule;
    return s.machine.pitch ? std::vector<PitchAt>() : machine.operation.pitch_schedule;
}

// By rotor speed, rad. A schedule that does not change between the speeds is one angle, which the settings then have.
std::vector<double> pitch_angles(CampbellSettings& s, const Machine& machine) {
    const std::vector<PitchAt> schedule = schedule_of(s, machine);
    std::vector<double> angles;
    angles.reserve(s.rotor_speeds.size());
    for (const double speed : s.rotor_speeds)
        angles.push_back(schedule.empty() ? 0 : representable(pitch_at(schedule, speed), units::degree));
    const auto [min, max] = std::ranges::minmax(angles);
    if (max - min < 1e-9 * units::degree) {
        if (!s.pitch_schedule.empty()) s.machine.pitch = angles.front();
        s.pitch_schedule.clear();
        s.machine.pitch = pitch_at_speed(s.machine.pitch, machine, s.rotor_speeds.back(), s.report);
        return std::vector<double>(angles.size(), *s.machine.pitch);
    }
    report_remark(s.report, {Remark::Kind::taken,
                             text("pitch: ", rounded(min * units::to_degrees), " to ", rounded(max * units::to_degrees),
                                  " deg over the rotor speed",
                                  s.pitch_schedule.empty() ? text(" (", machine.operation.pitch_source, ")") : "")});
    s.pitch_schedule = schedule;
    return angles;
}

// The mean over the azimuth where blades are equal and gravity or an unbalanced hub makes the equations periodic: an
// approximation that serves them. Else what suits.
solvers::CampbellMethod method_of(const Machine& machine, bool gravity) {
    const TurbineDescription& d = machine.description;
    return d.has_equal_blades() && (gravity || !d.hub.is_balanced()) ? solvers::CampbellMethod::averaged
                                                                     : solvers::CampbellMethod::automatic;
}

solvers::CampbellOptions modes_of(const CampbellSettings& s, const Machine& machine, const char* what) {
    solvers::CampbellOptions options;
    options.spin = rotor_spin(machine);
    options.max_frequency_hz = *s.max_frequency_hz;
    options.cancelled = s.cancelled;
    if (s.progress)
        options.progress = [progress = s.progress, what](int done, int total) { progress(what, done, total); };
    return options;
}

// One machine for all speeds, or one for each.
solvers::Campbell over_speeds(const Machine& machine, const CampbellSettings& s, const Turbine& first,
                              const std::vector<double>& pitch) {
    solvers::CampbellOptions options = modes_of(s, machine, "rotor speed");
    options.method = method_of(machine, s.gravity);
    std::optional<solvers::Campbell> like;
    if (!s.like.empty()) {
        options.neighbour = &like.emplace(solvers::read_campbell(s.like, solvers::CampbellShapes::read));
        report_remark(s.report, {Remark::Kind::taken, text("names: those of ", like->machine, " (",
                                                           s.like.filename().string(), "), where modes are alike")});
    }
    if (s.pitch_schedule.empty()) return solvers::campbell(first.system(), first.rotor(), s.rotor_speeds, options);
    std::vector<Turbine> machines;
    MachineSettings own = s.machine;
    for (const double angle : pitch) {
        own.pitch = angle;
        machines.push_back(assemble(machine.description, assembly_options(machine, own, s.gravity)));
    }
    std::vector<solvers::CampbellCase> cases;
    for (std::size_t i = 0; i < machines.size(); ++i)
        cases.push_back({&machines[i].system(), &machines[i].rotor(), s.rotor_speeds[i], 0});
    return solvers::campbell(cases, "", options);
}

CampbellDiagram over_rotor_speed(const Machine& machine, CampbellSettings s) {
    if (s.rotor_speeds.empty()) s.rotor_speeds = usual_speeds(machine, s.report);
    if (s.progress) s.progress("rotor speed", 0, static_cast<int>(s.rotor_speeds.size()));
    const std::vector<double> pitch = pitch_angles(s, machine);
    // Where the pitch changes, the mesh is that of the last speed.
    MachineSettings at_last = s.machine;
    at_last.pitch = pitch.back();
    const AssemblyOptions assembly = assembly_options(machine, at_last, s.gravity);
    if (!s.max_frequency_hz) s.max_frequency_hz = usual_frequency(machine.description, assembly);
    const PreparedTurbine ready =
        assembled(machine, assembly, *s.max_frequency_hz, std::abs(s.rotor_speeds.back()), s.report);
    check_size(ready.turbine);
    keep_elements(ready.mesh, s.machine);
    CampbellDiagram diagram{over_speeds(machine, s, ready.turbine, pitch)};
    diagram.mesh = ready.mesh;
    diagram.turbine = ready.turbine;
    diagram.settings = std::move(s);
    return diagram;
}

CampbellDiagram over_wind(const Machine& machine, CampbellSettings s) {
    if (!s.max_frequency_hz)
        s.max_frequency_hz = usual_frequency(machine.description, assembly_options(machine, s.machine, s.gravity));
    constexpr const char* what = "wind speed";
    if (s.progress) s.progress(what, 0, static_cast<int>(s.winds.size()));
    WindRun run = wind_run(machine, {.winds = s.winds,
                                     .operation = s.operation,
                                     .air = s.air,
                                     .machine = s.machine,
                                     .gravity = s.gravity,
                                     .harmonics = s.harmonics,
                                     .max_frequency_hz = *s.max_frequency_hz,
                                     .report = s.report,
                                     .cancelled = s.cancelled});
    check_size(run.ready.turbine);
    s.machine = run.options.machine;
    const AeroelasticOptions air = aeroelastic_options(run.air);
    const std::string words = in_words(run.air.model);
    report_remark(s.report, {Remark::Kind::taken, text("air of the vibrations: ", words)});
    solvers::CampbellOptions modes = modes_of(s, run.machine, what);
    modes.floquet.harmonics = s.harmonics;
    modes.all_state_motions = s.all_air_motions;
    if (s.floquet) modes.method = solvers::CampbellMethod::floquet;
    // One after the other, so that what is cancelled has the modes of its points.
    CampbellDiagram diagram{aeroelastic_campbell(
        run.operation, [&] { return next_point(run); }, s.winds.size(), air, modes)};
    diagram.remark = words;
    diagram.complete = diagram.complete && run.complete;
    diagram.mesh = run.ready.mesh;
    diagram.turbine = run.ready.turbine;
    diagram.not_converged = run.not_converged;
    diagram.settings = std::move(s);
    return diagram;
}

}  // namespace

CampbellDiagram campbell(const Machine& source, const CampbellSettings& settings) {
    check(settings);
    CampbellSettings s = settings;
    std::vector<Remark> remarks;
    s.report = kept(remarks, settings.report);
    if (!s.like.empty()) s.like = std::filesystem::absolute(s.like);  // to be repeated from elsewhere
    s.rotor_speeds = rising(std::move(s.rotor_speeds), "CampbellSettings::rotor_speeds", "rotor speeds", units::rpm,
                            "rpm", s.report);
    s.winds = rising(std::move(s.winds), "CampbellSettings::winds", "wind speeds", 1, "m/s", s.report);
    const Machine machine = with_settings(source, s.machine, s.report);
    s.machine.foundation.reset();  // it is the machine's now
    CampbellDiagram diagram =
        s.winds.empty() ? over_rotor_speed(machine, std::move(s)) : over_wind(machine, std::move(s));
    if (std::ranges::none_of(diagram.points, [](const solvers::CampbellPoint& one) { return !one.modes.empty(); }) &&
        diagram.complete && !diagram.points.empty())
        throw InputError(machine.description.name, text("modes up to ", *diagram.settings.max_frequency_hz, " Hz"), 0,
                         "some; a model that switches off all that bends has none: MachineSettings::tower, blades");
    const std::string foundation = foundation_in_words(machine);
    diagram.remark += text(diagram.remark.empty() || foundation.empty() ? "" : "; ", foundation);
    diagram.accuracy = in_words(diagram.mesh);
    diagram.source = with_machine(diagram.source, machine);
    diagram.settings.report = settings.report;
    diagram.remarks = std::move(remarks);
    return diagram;
}

}  // namespace cardan::turbines
