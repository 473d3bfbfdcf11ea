// Response of the NREL 5 MW blade to motions of the platform under its tower.
//
// Problem: the flexible blade turns about the tilted shaft of a rigid machine whose platform surges, sways, heaves,
// rolls, pitches and yaws as prescribed; gravity, structural damping, no wind. The equations of motion are integrated
// in time from the undeformed blade until the transient has died away; mean, extremes and harmonics of the deflection
// of the tip and of the root moments over the last period are printed.
// Checks: the energy balance over the whole run; the reference, where there is one.
// Reference: converged response of the same blade by a method that shares nothing with the joint chain, without
// platform motion and with a pitch of 5 degrees at half the rotor's frequency (docs/nrel5mw_platform.md).
// Goal: 0.5 % and 1 degree on every harmonic above 0.01 m with 16 elements.
#include "examples/studies/motion_option.hpp"
#include "examples/studies/nrel5mw_platform/files.hpp"
#include "examples/studies/nrel5mw_platform/reference.hpp"
#include "examples/studies/nrel5mw_platform/response.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/simulation.hpp"

#include <array>
#include <iomanip>
#include <optional>

using namespace cardan;

namespace {

constexpr std::array names{"surge", "sway", "heave", "roll", "pitch", "yaw", "nacelle-yaw"};
constexpr std::size_t translations = 3, platform_coordinates = 6, pitch_coordinate = 4;

struct Arguments {
    std::array<std::string, names.size()> motions;
    std::string reference, method = "dirk", out = "nrel5mw_platform";
    int blades = 1, elements = 16, max_order = 2, periods = 300, samples = 720, harmonics = 5;
    double rpm = 12.1, blade_pitch = 0, damping = turbines::nrel5mw_platform_damping, gravity = units::standard_gravity;
    double tolerance = 0, step = 0, settled = 5e-6;
};

std::string option(std::size_t motion) {
    return text("--", names.at(motion));
}

constexpr std::array<const char*, names.size()> directions{
    "downwind, m",
    "to the right seen along the wind, m",
    "up, m",
    "about the downwind axis, deg",
    "about the sway axis, deg: positive moves the top of the tower upwind",
    "about the tower axis, deg",
    "of the nacelle about the tower axis, deg"};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Response of the NREL 5 MW blade to prescribed motions of the platform under its tower.\n"
        "Writes PREFIX.h5 (the whole run), .csv (last period), .svg, .png (last three periods), _energy.png and\n"
        "_spectrum.png (ten periods at the end).\n\n" +
        std::string(program::motion_help) +
        " revolutions=N instead of period=SECONDS counts in\n"
        "revolutions of the rotor. Prints mean, extremes and harmonics of the periodic response, beside the reference "
        "where\nthe case is one of the two that have one.");
    app.footer(
        "Exit code: 0; 1 error; 2 wrong usage; 3 the reference is missed (goal: 0.5 % and 1 degree with 16 elements), "
        "the response\nhas not become periodic, or the energy balance does not close; 130 interrupted: what was "
        "computed is written.");
    app.add_option("--case", a.reference, "reference case: no motion; pitch of 5 degrees every second revolution")
        .one_of({"none", "pitch"});
    program::add_motion_options(app, names, directions, a.motions);
    app.add_option("--rpm", a.rpm, "rotor speed, rev/min");
    app.add_option("--blades", a.blades, "1 to 3");
    app.add_option("--blade-pitch", a.blade_pitch, "leading edge upwind, deg");
    app.add_option("--elements", a.elements, "beam elements per blade");
    app.add_option("--damping", a.damping, "stiffness-proportional, s");
    app.add_option("--gravity", a.gravity, "m/s^2");
    app.add_option("--method", a.method, "of integration").one_of({"bdf", "dirk", "alpha"});
    app.add_option("--tolerance", a.tolerance,
                   "of integration, relative; 0: 3e-7, with more than 16 elements less in proportion");
    app.add_option("--max-order", a.max_order, "of bdf, 1 ... 5; above 2 weakly damped modes keep ringing a little");
    app.add_option("--step", a.step, "fixed step, s (dirk, alpha); 0: chosen by the method");
    app.add_option("--settled", a.settled, "change of tip deflections from period to period that ends it, m");
    app.add_option("--periods", a.periods, "at most that many").range(1, 1000000);
    app.add_option("--samples", a.samples, "of the last period").range(48, 1000000);
    app.add_option("--harmonics", a.harmonics, "printed").range(1, 20);
    app.add_option("--out", a.out, "prefix of the files");
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (!a.reference.empty() && !a.motions.at(i).empty()) return app.refuse("--case", option(i));
    if (a.reference == "pitch") a.motions.at(pitch_coordinate) = "amplitude=5,revolutions=2";
    return -1;
}

std::optional<double> revolution(const Arguments& a) {
    require_not_negative("--rpm", "value", a.rpm);
    return a.rpm > 0 ? std::optional(units::minute / a.rpm) : std::nullopt;
}

using Motions = std::array<std::optional<program::MotionOption>, names.size()>;

Motions read_motions(const Arguments& a) {
    Motions motions;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (!a.motions.at(i).empty()) motions.at(i) = program::motion_option(option(i), a.motions.at(i), revolution(a));
    return motions;
}

// The reference that this run must meet: steady translations change nothing.
const platform::ReferenceCase* reference(const Arguments& a, const Motions& motions) {
    const Arguments standard;
    if (a.rpm != standard.rpm || a.blade_pitch != 0 || a.damping != standard.damping || a.gravity != standard.gravity)
        return nullptr;
    bool pitches = false;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!motions.at(i)) continue;
        const program::MotionOption& m = *motions.at(i);
        if (i < translations ? m.oscillates() : m.mean != 0 || m.velocity != 0) return nullptr;
        if (!m.oscillates()) continue;
        if (i != pitch_coordinate || m.amplitude != 5 || m.phase != 0 || std::abs(m.period * a.rpm / 120 - 1) > 1e-9)
            return nullptr;
        pitches = true;
    }
    return &platform::reference_cases().at(pitches ? 1 : 0);
}

std::vector<solvers::Drive> drives(const Arguments& a, const turbines::Turbine& machine, const Motions& motions) {
    const Model& model = machine.system().model;
    std::vector<solvers::Drive> all{
        {model.index(*machine.layout().generator), solvers::Motion::constant_rate(0, a.rpm * units::rpm)}};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!motions.at(i)) continue;
        const BodyId body =
            i < platform_coordinates ? machine.layout().platform->coordinates.at(i) : *machine.layout().yaw;
        all.push_back({model.index(body), motions.at(i)->motion(i < translations ? 1 : units::degree)});
    }
    return all;
}

double period_of(const Arguments& a, const Motions& motions) {
    std::vector<double> periods;
    if (revolution(a)) periods.push_back(*revolution(a));
    for (const auto& motion : motions)
        if (motion && motion->oscillates()) periods.push_back(motion->period);
    return platform::common_period(periods);
}

double tolerance(const Arguments& a) {
    return a.tolerance != 0 ? a.tolerance : 3e-7 * std::min(1.0, 16.0 / a.elements);
}

solvers::IntegrationOptions integration(const Arguments& a) {
    solvers::IntegrationOptions options = program::integration_options(a.method, tolerance(a), a.max_order);
    options.fixed_step = a.step;
    // A parked blade follows a slow platform in steps of a second, through which the work of its stiff joints is not
    // known as well as the motion.
    if (a.rpm == 0) options.max_step = 0.05;
    return options;
}

solvers::HistoryMetadata about(const Arguments& a, const turbines::Turbine& machine) {
    std::string motions;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (!a.motions.at(i).empty()) motions += text(", ", names.at(i), " ", a.motions.at(i));
    return {.title = text("NREL 5 MW blade on a platform, ", a.rpm, " rpm", motions),
            .method = text(a.method, ", relative tolerance ", tolerance(a)),
            .description = text(a.rpm, " rpm", motions, ", blade pitch ", a.blade_pitch, " deg, damping ", a.damping,
                                " s, gravity ", a.gravity, " m/s^2\n\n", machine.rotor().description),
            .program = "nrel5mw_platform"};
}

// What is left of a transient that dies away like a geometric series.
std::string remainder(const std::vector<double>& changes) {
    constexpr std::size_t back = 5;
    if (changes.size() < back + 2) return "unknown";
    const double ratio = std::pow(changes.back() / changes[changes.size() - 1 - back], 1.0 / back);
    return ratio < 1 ? text(std::setprecision(2), changes.back() * ratio / (1 - ratio)) : "unknown";
}

void print_run(const platform::Response& response, double period, double settled) {
    const std::vector<double>& changes = response.changes;
    std::cout << changes.size() << " periods of " << period << " s; largest change of a tip deflection from one to the "
              << "next, m:" << std::setprecision(1) << std::scientific;
    const std::size_t stride = std::max<std::size_t>(1, changes.size() / 6);
    for (std::size_t i = stride; i + 1 < changes.size(); i += stride) std::cout << " " << changes[i];
    std::cout << " ... " << changes.back() << "\n" << std::defaultfloat;
    if (response.settled)
        std::cout << "periodic; what is left of the transient, m: about " << remainder(changes) << "\n";
    else
        std::cout << "NOT PERIODIC: the last change is above " << settled << " m and "
                  << (response.stalled ? "has ceased to fall; take a smaller --tolerance, or some damping\n"
                                       : "was still falling; take more --periods\n");
}

turbines::Turbine machine_of(const Arguments& a) {
    turbines::Nrel5mwPlatformOptions options;
    options.blades = a.blades;
    options.pitch = a.blade_pitch * units::degree;
    options.gravity = Vec3(0, 0, -a.gravity);
    options.elements = turbines::nrel5mw_platform_elements(a.elements, a.damping);
    return turbines::nrel5mw_on_platform(turbines::nrel5mw_platform_blade(), options);
}

platform::ResponseOptions response_options(const Arguments& a, const turbines::Turbine& machine,
                                           const Motions& motions) {
    platform::ResponseOptions options;
    options.period = period_of(a, motions);
    options.compared = platform::tip_deflections(machine);
    options.settled = a.settled;
    options.max_periods = a.periods;
    options.samples = a.samples;
    options.progress = [](int period, double change) {
        program::progress(text("\rperiod ", period, ": change ", change, " m    "));
    };
    return options;
}

// The harmonics of the last period, beside the reference if there is one.
// @return is that met?
bool print_response(const Arguments& a, const solvers::History& period, const platform::ReferenceCase* exact) {
    std::cout << "\n";
    if (exact) std::cout << "reference case: " << exact->name << "\n";
    const double used = platform::print_signals(period, a.harmonics, exact);
    if (exact)
        std::cout << "\ngoal: mean, extremes and every harmonic above 0.01 m within 0.5 % + 0.05 mm and 1 deg: "
                  << (used <= 1 ? "reached" : "MISSED") << " (" << std::setprecision(2) << 100 * used
                  << " % of that used)\n";
    return used <= 1;
}

int run(const Arguments& a) {
    const Motions motions = read_motions(a);
    const turbines::Turbine machine = machine_of(a);
    const platform::ResponseOptions settings = response_options(a, machine, motions);
    program::check_outputs(a.out, platform::outputs);
    std::cout << machine.rotor().machine << ": " << a.blades << " blade(s) of " << a.elements << " elements, " << a.rpm
              << " rpm, damping " << a.damping << " s\n"
              << std::flush;

    const Vector rest = Vector::Zero(machine.system().model.size());
    solvers::Integrator integrator(machine.system(), drives(a, machine, motions), 0, rest, rest, integration(a));
    solvers::Recorder recorder(integrator, platform::recorded_channels(machine), platform::recorder_options());
    solvers::HistoryRecording file(a.out + ".h5", about(a, machine), integrator, recorder);
    const program::Stopwatch watch;
    const platform::Response response =
        platform::periodic_response(integrator, recorder, settings,
                                    [&](double time, const std::vector<double>& values) { file.append(time, values); });
    const program::Elapsed elapsed = watch.elapsed();
    program::progress("\r");
    program::stop_at_once();
    file.close(response.complete);

    platform::PictureOptions pictures{settings.period, integrator.time(), a.rpm * units::rpm};
    if (response.complete) pictures.periodic_to -= settings.period;
    const platform::Drawn drawn = platform::draw_pictures(machine, a.out, pictures);
    const std::string files = text("\nfiles: ", a.out, ".h5 (", file.rows(), " samples of ", recorder.channels().size(),
                                   " channels)", drawn.files);
    if (!response.complete) {
        std::cout << "interrupted at " << integrator.time() << " s, after " << response.changes.size() << " periods of "
                  << settings.period << " s\n"
                  << files << "\n";
        return 130;
    }
    print_run(response, settings.period, a.settled);
    const double allowed = 10 * tolerance(a) * (integrator.time() / settings.period);  // that much in every period
    const bool parked = a.rpm == 0;
    bool good = program::check_energy(integrator.energy(),
                                      parked ? drawn.exchanged_energy : drawn.largest_kinetic_energy, allowed, parked);
    program::print_effort(integrator, machine.system(), elapsed);
    good = print_response(a, response.last, reference(a, motions)) && good;
    platform::write_csv(machine, response.last, a.out + ".csv");
    std::cout << files << ", .csv\n";
    if (!std::cout.flush()) throw FileError("standard output", "the table could not be written");
    return response.settled && good ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("nrel5mw_platform", argc, argv, parse, run);
}
