// Start-up of the 600 kW machine, through the resonance of its tower, to operation.
//
// Problem: from standstill with the blades in feather these are pitched slowly into the wind; the rotor speeds up, and
// three times its speed (the tower's shadow falls on every blade in turn) passes the first frequency of the tower.
// --mode fixed: the induction generator (Kloss' law) is connected to the grid when it reaches the synchronous speed;
// --mode variable: a converter loads it by a table of torque over speed. Gravity and a prescribed load on the rotor (no
// aerodynamics, see elements/machine_elements/rotor_load.hpp). The tower may stand on a platform that moves as
// prescribed. Checks: the energy balance, by the integration and by the recorded powers; at the end the speed at which
// the torques of rotor and generator are equal, found by bisection.
#include "examples/studies/motion_option.hpp"
#include "examples/studies/wt600_simulation.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/simulation_run.hpp"
#include "solvers/campbell/diagram.hpp"

#include <array>

using namespace cardan;

namespace {

constexpr std::array names{"surge", "sway", "heave", "roll", "pitch", "yaw"};
constexpr std::array<const char*, names.size()> directions{
    "of a platform under the tower, downwind, m",
    "likewise, to the left, looking downwind, m",
    "up, m",
    "about the downwind axis, deg",
    "about the sway axis, deg: positive moves the top of the tower downwind",
    "about the tower axis, deg"};

struct Arguments {
    program::RunArguments run{.duration = 120, .out = "wt600_time_history"};
    int blade_elements = 3, tower_elements = 3;
    std::string data;
    std::array<std::string, names.size()> motions;
    std::string mode = "fixed";
    double wind = 11.86, pitch_rate = 1.5, shadow = 0.1;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Start-up of the 600 kW machine through the resonance of its tower, to operation with an induction generator "
        "at the grid (fixed) or with a converter (variable).\nPrints events, resonances, the largest loads and the "
        "balance of energy; writes PREFIX.h5, .svg, .png, _energy.png and\n_spectrum.png (last 40 s).\n\nThe tower "
        "stands on the ground, or on a platform with prescribed motions if there are any. " +
        std::string(program::motion_help));
    program::add_run_options(app, a.run);
    app.add_option("--blade-elements", a.blade_elements, "beam elements per blade");
    app.add_option("--tower-elements", a.tower_elements, "beam elements of the tower");
    app.add_option("--data", a.data, "folder with wt600_blade.csv and wt600_turbine.csv (default: built in)");
    app.add_option("--mode", a.mode, "generator").one_of({"fixed", "variable"});
    app.add_option("--wind", a.wind, "wind speed, m/s");
    app.add_option("--pitch-rate", a.pitch_rate, "of the blades from feather into the wind, deg/s");
    app.add_option("--tower-shadow", a.shadow, "share of the rotor load that is lost when a blade passes the tower");
    program::add_motion_options(app, names, directions, a.motions);
    app.add_flag(
        "--resume", a.run.resume,
        "go on with PREFIX.h5 from where it was broken off, or beyond its end; same options but --duration. The "
        "rows are those of an uninterrupted run, bit for bit with dirk, erk and alpha, within the tolerance with "
        "bdf and adams");
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    program::check_run_options(a.run);
    require_positive("--pitch-rate", "value", a.pitch_rate);
    return -1;
}

turbines::Wt600Operation machine_of(const Arguments& a) {
    turbines::Wt600OperationOptions options;
    const Vec3 gravity = options.assembly.gravity;
    options.assembly = program::elements_of_paper(a.blade_elements, a.tower_elements);
    options.assembly.gravity = gravity;
    options.data = a.data;
    const bool fixed = a.mode == "fixed";
    options.generator = fixed ? turbines::Wt600Generator::induction : turbines::Wt600Generator::converter;
    options.at_grid = !fixed;
    options.pitch = pi / 2;
    options.wind = a.wind;
    options.tower_shadow = a.shadow;
    if (std::ranges::any_of(a.motions, [](const std::string& given) { return !given.empty(); }))
        options.platform.emplace();
    return turbines::wt600_operation(options);
}

std::string title(const Arguments& a) {
    std::string motions;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (!a.motions.at(i).empty())
            motions += text(motions.empty() ? ", platform " : ", ", names.at(i), " ", a.motions.at(i));
    return text("start-up of the 600 kW machine, ", a.mode, " speed", motions);
}

std::vector<solvers::Drive> drives(const Arguments& a, const turbines::Turbine& turbine) {
    std::vector<solvers::Drive> all;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (a.motions.at(i).empty()) continue;
        const int coordinate = turbine.system().model.index(turbine.layout().platform->coordinates.at(i));
        const double unit = turbine.system().model.body(coordinate).revolute ? units::degree : 1;
        all.push_back({coordinate, program::motion_option(text("--", names.at(i)), a.motions.at(i), {}).motion(unit)});
    }
    return all;
}

// Where the driven coordinates are at time zero.
Vector first_position(const System& system, const std::vector<solvers::Drive>& drives) {
    Vector q = Vector::Zero(system.model.size());
    for (const solvers::Drive& drive : drives) q(drive.coordinate) = drive.motion.at(0).position;
    return q;
}

constexpr const char* connected = "generator connected [s]";

// Connects the induction machine when it comes to its synchronous speed.
std::vector<solvers::Event> events(const turbines::Wt600Operation& machine, double& connected_at) {
    const auto* law = std::get_if<KlossCurve>(&machine.generator.law);
    if (!law) return {};
    const double synchronous = law->synchronous_speed / machine.generator.gear_ratio;
    const int spin = machine.turbine.rotor().spin;
    solvers::Event connect;
    connect.name = "synchronous speed";
    connect.direction = 1;
    connect.function = [=](const StateView& in) { return in.qd(spin) - synchronous; };
    connect.action = [grid = machine.grid, &connected_at](solvers::Integrator& integrator) {
        if (grid->is_on()) return solvers::AfterEvent::proceed;
        connected_at = integrator.time();
        integrator.note(connected, connected_at);
        grid->turn(true, integrator.time());
        return solvers::AfterEvent::restart;
    };
    return {connect};
}

// First fore-aft frequency of the tower at standstill, Hz.
double tower_frequency(const Arguments& a) {
    const turbines::Turbine turbine = turbines::wt600(program::elements_of_paper(a.blade_elements, a.tower_elements));
    const solvers::Campbell diagram = solvers::campbell(turbine.system(), turbine.rotor(), solvers::rpm_range(0, 0, 1));
    return diagram.natural_hz(diagram.branch("1st tower fore-aft"), 0);
}

// Half of what a channel swings within a stretch of time.
double amplitude(const solvers::History& history, const char* channel, double from, double to) {
    const std::vector<double>& v = history[channel];
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < v.size(); ++i) {
        if (history.time[i] < from || history.time[i] > to) continue;
        low = std::min(low, v[i]);
        high = std::max(high, v[i]);
    }
    return high < low ? 0 : (high - low) / 2;
}

void print_swing(const solvers::History& history, const std::string& what, double speed, double t) {
    std::printf("%6s %8.2f %8.2f", what.c_str(), speed / units::rpm, t);
    for (const char* channel : {"YawBrTAxp", "YawBrTAyp"})
        std::printf(" %10.4f %10.4f", amplitude(history, channel, t - 6, t - 2), amplitude(history, channel, t, t + 6));
    std::printf("\n");
}

// Where multiples of the rotor speed meet the tower's frequency, and how much the tower top swings before and after.
void print_resonances(const solvers::History& history, double tower_hz) {
    std::printf(
        "\nfirst tower frequency %.4f Hz; acceleration of its top, m/s^2, half of peak to peak 6 to 2 s before and "
        "within 6 s after\n%6s %8s %8s %10s %10s %10s %10s\n",
        tower_hz, "", "rpm", "time, s", "fore-aft", "after", "side-side", "after");
    const std::vector<double>& speed = history["RotSpeed"];
    for (int p : {6, 3, 2, 1}) {
        const double meets = 2 * pi * tower_hz / p;
        const auto at = std::ranges::find_if(speed, [&](double now) { return now >= meets; });
        if (at == speed.end())
            std::printf("%5dP %8.2f %8s\n", p, meets / units::rpm, "-");
        else
            print_swing(history, text(p, "P"), meets, entry(history.time, at - speed.begin()));
    }
    if (history.time.back() > 6) print_swing(history, "end", speed.back(), history.time.back() - 6);
}

// Rotor speed at which the mean torque of the rotor load is that of the generator.
double balanced_speed(const turbines::Wt600Operation& machine, double wind) {
    RotorCurve curve = machine.rotor.curve;
    const double mean = 1 - curve.tower_shadow / 2;
    curve.tower_shadow = 0;
    const auto surplus = [&](double speed) {
        return mean * curve.torque(wind, 0.0, speed, 0.0) -
               machine.generator.gear_ratio * machine.generator.torque(speed);
    };
    double low = 0, high = 2 * wind * curve.tip_speed_ratio / curve.radius;
    for (int i = 0; i < 100; ++i) (surplus((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    return low;
}

// Mean over the last three turns or so.
double last_speed(const solvers::History& history) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < history.time.size(); ++i)
        if (history.time[i] > history.time.back() - 6) {
            sum += history["RotSpeed"][i];
            ++count;
        }
    return sum / count;
}

// What makes a run but its length, for its file.
std::string options_of(const Arguments& a) {
    return text("wind ", a.wind, " m/s, pitch rate ", a.pitch_rate, " deg/s, tower shadow ", a.shadow,
                ", blade elements ", a.blade_elements, ", tower elements ", a.tower_elements, ", ",
                program::options_text(a.run), ", data '", a.data, "'");
}

// Coordinates of the platform, if there is one, that are not at rest.
std::vector<std::string> platform_motions(const solvers::History& history) {
    std::vector<std::string> moving;
    for (const char* which : names) {
        const std::string name = text("platform ", which);
        const auto channel = std::ranges::find(history.channels, name, &Channel::name);
        if (channel == history.channels.end()) continue;
        const auto [min, max] = std::ranges::minmax(history[name]);
        if (min < max) moving.push_back(name);
    }
    return moving;
}

// Powers of the machine's elements as recorded, added up over time: all but that of the thrust. The brake stays off.
double recorded_work(const solvers::History& history) {
    double work = program::integral(history, "rotor load power") - program::integral(history, "generator power");
    for (int k = 1; k <= 3; ++k) work += program::integral(history, text("blade ", k, " pitch drive power"));
    return work;
}

// The energy balance, twice: what the integration has lost, and recorded powers against the work that it has added up:
// those of the machine's elements against the work of all forces without potential. On a platform that moves the thrust
// does work as well; then it is the drives of the platform against theirs. Trapezoids are wrong by half an output step
// at every jump of a power.
bool check_energy(solvers::Integrator& integrator, const solvers::History& history, const program::RunArguments& a) {
    const solvers::EnergyBalance end = integrator.energy();
    const double scale = program::largest(history, "kinetic energy").value;
    std::printf("\n");
    const bool closes = program::check_energy(end, scale, 10 * a.tolerance);
    const std::vector<std::string> moving = platform_motions(history);
    if (moving.empty())
        return program::check("recorded powers against the work of all loads, likewise",
                              (recorded_work(history) - end.loads) / scale, a.step / 4) &&
               closes;
    double work = 0;
    for (const std::string& name : moving) work += program::integral(history, name + " drive", name + " rate");
    return program::check("recorded powers of the platform's drives against their work", (work - end.drives) / scale,
                          a.step / 4) &&
           closes;
}

// The pictures' panels; the spectra are those of the last 40 s, or of the second half.
void write_outputs(program::Rows& rows, const std::string& prefix, bool complete) {
    std::vector<solvers::HistoryPanel> panels = solvers::one_panel_each(platform_motions(rows.history()));
    panels.insert(panels.end(), {{{"RotSpeed"}},
                                 {{"BldPitch1"}},
                                 {{"GenTq", "RotTorq"}},
                                 {{"TTDspFA", "TTDspSS"}},
                                 {{"TwrBsMyt", "TwrBsMxt"}},
                                 {{"RootMyb1", "RootMxb1"}}});
    const double end = rows.history().time.back();
    program::write_outputs(rows, prefix, complete, panels, {{{"YawBrTAxp", "YawBrTAyp"}}, {{"RootMyb1", "RootMxb1"}}},
                           {.from = std::max(end - 40, end / 2), .max_frequency_hz = 8});
}

int run(const Arguments& a) {
    const program::RunArguments& s = a.run;
    if (!s.resume) program::check_outputs(s.out, program::run_outputs);
    const turbines::Wt600Operation machine = machine_of(a);
    const System& system = machine.turbine.system();
    const std::vector<solvers::Drive> platform = drives(a, machine.turbine);
    const std::string description = text(title(a), ", ", options_of(a), "\n", machine.turbine.summary());
    const std::optional<solvers::Checkpoint> broken_off = program::start_of(s, description);
    machine.pitch->move_to(0, 0, a.pitch_rate * units::degree);
    double connected_at = -1;
    if (broken_off && broken_off->notes.contains(connected)) {
        connected_at = broken_off->notes.at(connected);
        machine.grid->turn(true, connected_at);
    }
    solvers::IntegrationOptions options = program::integration_options(s);
    options.events = events(machine, connected_at);
    options.breaks = machine.pitch->breaks();
    const auto begin = [&] {
        const program::Start start = program::standing_start(machine, first_position(system, platform));
        return solvers::Integrator(system, platform, 0, start.q, start.qd, options);
    };
    solvers::Integrator integrator = broken_off ? solvers::Integrator(system, platform, *broken_off, options) : begin();
    solvers::Recorder recorder(integrator, machine.channels);
    program::Rows rows = broken_off ? program::Rows(s, integrator, recorder)
                                    : program::Rows(title(a), description, s, integrator, recorder);

    const program::Stopwatch watch;
    const solvers::Advance end = program::record(integrator, recorder, 0, s.duration, s.step, rows);
    const program::Elapsed elapsed = watch.elapsed();
    program::progress("\r                              \r");

    std::printf("%s speed, wind %g m/s, pitch from 90 to 0 deg until %.2f s\n", a.mode.c_str(), a.wind,
                machine.pitch->arrival());
    if (connected_at >= 0) std::printf("generator connected at synchronous speed: %.4f s\n", connected_at);
    print_resonances(rows.history(), tower_frequency(a));
    program::print_largest(rows.history(), {"RotSpeed", "TwrBsMyt", "TwrBsMxt", "TTDspFA", "TTDspSS", "RootMyb1",
                                            "RootMxb1", "RootFzb1", "RotTorq", "GenTq", "generator power"});
    bool good = check_energy(integrator, rows.history(), s);
    const double expected = balanced_speed(machine, a.wind);
    const bool settled = rows.history().time.back() > machine.pitch->arrival() + 15;
    if (settled) {
        std::printf("rotor speed at the end %.3f rpm, by the balance of torques %.3f rpm\n",
                    last_speed(rows.history()) / units::rpm, expected / units::rpm);
        good = program::check("rotor speed at the end against the balance of torques",
                              last_speed(rows.history()) / expected - 1, 5e-3) &&
               good;
    }
    program::print_effort(integrator, system, elapsed);
    const bool complete = end.reached();
    write_outputs(rows, s.out, complete);
    if (!complete) return 130;
    return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("wt600_time_history", argc, argv, parse, run);
}
