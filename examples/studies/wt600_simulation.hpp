/// @file
/// What the programs that simulate the 600 kW machine have in common: options, starts, pictures.
#pragma once

#include "mbs/base/outcome.hpp"
#include "mbs/base/units.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "turbines/machines/wt600_operation.hpp"

#include "programs/shared/simulation_run.hpp"

namespace cardan::program {

struct SimulationArguments : RunArguments {
    int blade_elements = 3, tower_elements = 3;
    std::string data;
};

/// The kind of elements with which the paper is reproduced: few coordinates, and none as stiff as an extension.
inline turbines::AssemblyOptions elements_of_paper(int blade_elements, int tower_elements) {
    turbines::AssemblyOptions options = turbines::wt600_paper_assembly();
    options.blade_elements = blade_elements;
    options.tower_elements = tower_elements;
    return options;
}

inline void add_simulation_options(CommandLine& app, SimulationArguments& a) {
    add_run_options(app, a);
    app.add_option("--blade-elements", a.blade_elements, "beam elements per blade");
    app.add_option("--tower-elements", a.tower_elements, "beam elements of the tower");
    app.add_option("--data", a.data, "folder with wt600_blade.csv and wt600_turbine.csv (default: built in)");
}

/// What makes a run but its length, for its file.
inline std::string options_text(const SimulationArguments& a) {
    return text("blade elements ", a.blade_elements, ", tower elements ", a.tower_elements, ", ",
                options_text(static_cast<const RunArguments&>(a)), ", data '", a.data, "'");
}

inline turbines::Wt600OperationOptions operation_options(const SimulationArguments& a) {
    turbines::Wt600OperationOptions options;
    const Vec3 gravity = options.assembly.gravity;
    options.assembly = elements_of_paper(a.blade_elements, a.tower_elements);
    options.assembly.gravity = gravity;
    options.data = a.data;
    return options;
}

/// Constant state under some forces; the spin is held at its azimuth or turns steadily.
/// @param initial  where the iteration starts and driven coordinates are held; empty: zero
inline Vector steady_position(const turbines::Turbine& turbine, const ForceSet& forces, double speed, double azimuth,
                              const Vector& initial = {}) {
    const System system(turbine.tree(), forces);
    solvers::SteadyOptions options;
    options.rotor_speed = speed;
    options.azimuth = azimuth;
    options.initial = initial;
    const solvers::SteadyState state = solvers::steady_state(system, turbine.rotor().spin, options);
    require_result(state, "start of the simulation");
    return state.at.q;
}

/// State at time zero.
struct Start {
    Vector q, qd;
};

/// At rest under gravity, blade 1 up.
/// @param driven  where the driven coordinates are; empty: at zero
inline Start standing_start(const turbines::Wt600Operation& machine, const Vector& driven = {}) {
    const Vector q = steady_position(machine.turbine, machine.turbine.forces(), 0, 0, driven);
    return {q, Vector::Zero(q.size())};
}

/// Rotor speed at which the torques of rotor load and generator are equal, the blades turned as far as they turn in
/// their pitch drives: that of a constant rotation without gravity and tower shadow. By the secant method.
/// @param calm   the machine without gravity and tower shadow
/// @param guess  rad/s, about right
/// @throws NumericalError if there is none near the guess
inline double balanced_speed(const turbines::Wt600Operation& calm, double guess) {
    const System& system = calm.turbine.system();
    const int spin = calm.turbine.rotor().spin;
    Workspace workspace(system.model);
    Vector Q(system.model.size()), tau(system.model.size());
    const auto surplus = [&](double speed) {
        Vector qd = Vector::Zero(system.model.size());
        const Vector q = steady_position(calm.turbine, calm.turbine.forces(), speed, 0), qdd = qd;
        qd(spin) = speed;
        const Kinematics kin = kinematics(system.model, q, workspace);
        system.forces.generalised_forces(kin, 0, q, qd, Q);
        inverse_dynamics(kin, VectorIn(qd), VectorIn(qdd), VectorOut(tau));
        return Q(spin) - tau(spin);
    };
    double a = guess, b = 1.001 * guess, fa = surplus(a);
    for (int i = 0; i < 30; ++i) {
        const double fb = surplus(b), next = b - fb * (b - a) / (fb - fa);
        a = b, fa = fb, b = next;
        if (std::abs(b - a) < 1e-10 * guess) return b;
    }
    throw NumericalError(text("start of the simulation: no rotor speed near ", guess / units::rpm,
                              " rpm at which rotor and generator balance; give one (--rpm)"));
}

/// In rotation, blade 1 up: the steady state without gravity and tower shadow, and what gravity bends the standing
/// machine, as the azimuth changes it. This is periodic but for the square of rotor speed over natural frequencies.
/// @param calm  the same machine without gravity and tower shadow
inline Start rotating_start(const turbines::Wt600Operation& machine, const turbines::Wt600Operation& calm,
                            double speed) {
    constexpr double h = 1e-3;
    const auto sag = [&](double azimuth) {
        return Vector(steady_position(machine.turbine, machine.turbine.forces(), 0, azimuth) -
                      steady_position(calm.turbine, calm.turbine.forces(), 0, azimuth));
    };
    const Vector rotating = steady_position(calm.turbine, calm.turbine.forces(), speed, 0);
    Start start{rotating + sag(0), speed * (sag(h) - sag(-h)) / (2 * h)};
    start.qd(machine.turbine.rotor().spin) = speed;
    return start;
}

/// Coordinates of the platform, if there is one, that are not at rest.
inline std::vector<std::string> platform_motions(const solvers::History& history) {
    std::vector<std::string> moving;
    for (const char* which : {"surge", "sway", "heave", "roll", "pitch", "yaw"}) {
        const std::string name = text("platform ", which);
        const auto channel = std::ranges::find(history.channels, name, &Channel::name);
        if (channel == history.channels.end()) continue;
        const auto [least, most] = std::ranges::minmax(history[name]);
        if (least < most) moving.push_back(name);
    }
    return moving;
}

/// Closes the file, draws the pictures and says what there is.
/// @param complete      the run came to its end
/// @param spectra_from  s; the spectra are those of the stretch from there to the end
inline void write_outputs(Rows& rows, const std::string& prefix, bool complete, double spectra_from) {
    std::vector<solvers::HistoryPanel> panels = solvers::one_panel_each(platform_motions(rows.history()));
    panels.insert(panels.end(), {{{"RotSpeed"}},
                                 {{"BldPitch1"}},
                                 {{"GenTq", "RotTorq"}},
                                 {{"TTDspFA", "TTDspSS"}},
                                 {{"TwrBsMyt", "TwrBsMxt"}},
                                 {{"RootMyb1", "RootMxb1"}}});
    write_outputs(rows, prefix, complete, panels, {{{"YawBrTAxp", "YawBrTAyp"}}, {{"RootMyb1", "RootMxb1"}}},
                  {.from = spectra_from, .max_frequency_hz = 8});
}

/// Powers of the machine's elements as recorded, added up over time: all but that of the thrust.
inline double recorded_work(const solvers::History& history) {
    double work =
        integral(history, "rotor load power") - integral(history, "generator power") - integral(history, "brake power");
    for (int k = 1; k <= 3; ++k) work += integral(history, text("blade ", k, " pitch drive power"));
    return work;
}

/// The energy balance, twice: what the integration has lost, and recorded powers against the work that it has added
/// up: those of the machine's elements against the work of all forces without potential. On a platform that moves the
/// thrust does work as well; then it is the drives of the platform against theirs. Trapezoids are wrong by half an
/// output step at every jump of a power.
inline bool check_energy(solvers::Integrator& integrator, const solvers::History& history,
                         const SimulationArguments& a) {
    const solvers::EnergyBalance end = integrator.energy();
    const double scale = largest(history, "kinetic energy").value;
    std::printf("\n");
    const bool closes = check_energy(end, scale, 10 * a.tolerance);
    const std::vector<std::string> moving = platform_motions(history);
    if (moving.empty())
        return check("recorded powers against the work of all loads, likewise",
                     (recorded_work(history) - end.loads) / scale, a.step / 4) &&
               closes;
    double work = 0;
    for (const std::string& name : moving) work += integral(history, name + " drive", name + " rate");
    return check("recorded powers of the platform's drives against their work", (work - end.drives) / scale,
                 a.step / 4) &&
           closes;
}

}  // namespace cardan::program
