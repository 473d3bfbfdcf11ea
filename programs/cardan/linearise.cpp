// Linear model of any machine at a rotor speed for the design of controllers.
//
// Problem: the machine is linearised about its steady state, x' = A(psi) x + B(psi) u, y = C(psi) x + D(psi) u, with
// the torque of the generator, moments of yaw and pitch drives and thrust as inputs and speeds, accelerations and loads
// as outputs, at several azimuths. Three and more equal blades: multi-blade coordinates, averaged over the azimuth,
// make it constant, and balanced truncation leaves a small model. Two blades, or blades that differ: no coordinates do
// so, the model stays periodic; it is given as it is, with its values at one azimuth as a constant model, whose
// eigenvalues are not motions of the machine. What does not change with the azimuth (standstill, no blades) is
// constant. Reference: the modes of A, or the characteristic exponents of the periodic A by Floquet's theory, are those
// of the Campbell diagram at this rotor speed.
#include "mbs/model/summary.hpp"
#include "solvers/periodic/floquet.hpp"
#include "turbines/machine/machine_text.hpp"

#include "programs/cardan/campbell_wind.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/cardan/operation.hpp"
#include "programs/shared/linear_model_program.hpp"
#include <functional>
#include <utility>

namespace cardan::program {

namespace {

struct LineariseArguments {
    MachineOptions machine;
    VibrationArguments air;
    LinearModelArguments model{.azimuths = 24};
    std::optional<double> rpm, max_frequency;
    double azimuth = 0;
};

void declare(CommandLine& app, LineariseArguments& a) {
    add_machine(app, a.machine);
    app.add_option("--rpm", a.rpm, "rotor speed, rev/min (default: the model's)");
    add_linear_model_options(app, a.model);
    app.add_option("--max-frequency", a.max_frequency,
                   text(max_frequency_of_models, " (default: 1.3 times the third of the blade, clamped and at rest)"));
    app.add_option("--azimuth", a.azimuth,
                   "of a periodic model that is given as a constant one, deg; the nearest there is");
    app.add_flag("--gravity", a.machine.gravity, "about the periodic steady state under gravity");
    add_vibration_options(app, a.air);
    add_machine_options(app, a.machine);
}

// What the machine's constant model is, and why.
enum class Form : std::uint8_t { multi_blade, constant, periodic };

// Largest change of any matrix from one azimuth to another, relative to its size at the first.
double variation(const solvers::LinearModel& model) {
    double most = 0;
    for (Matrix solvers::StateMatrices::*matrix : {&solvers::StateMatrices::A, &solvers::StateMatrices::B,
                                                   &solvers::StateMatrices::C, &solvers::StateMatrices::D}) {
        const Matrix& first = model.samples.front().*matrix;
        for (const solvers::LinearSample& sample : model.samples)
            most = std::max(most, (sample.*matrix - first).norm() / std::max(first.norm(), 1e-300));
    }
    return most;
}

Form form_of(const solvers::LinearModel& model, const turbines::TurbineDescription& machine) {
    constexpr double rounding = 1e-7;  // of C and D, which come from differences
    if (machine.has_equal_blades()) return Form::multi_blade;
    return model.samples.size() == 1 || variation(model) < rounding ? Form::constant : Form::periodic;
}

std::size_t nearest_sample(const solvers::LinearModel& model, double azimuth) {
    const auto distance = [&](const solvers::LinearSample& s) { return 1 - std::cos(s.azimuth - azimuth); };
    const auto nearest = std::ranges::min_element(model.samples, {}, distance);
    return static_cast<std::size_t>(nearest - model.samples.begin());
}

// The matrices at one azimuth, with the azimuth said.
solvers::ConstantModel frozen(const solvers::LinearModel& model, double azimuth) {
    const std::size_t sample = nearest_sample(model, azimuth);
    solvers::ConstantModel at = solvers::at_sample(model, sample);
    at.description = text("frozen at the azimuth ", model.samples[sample].azimuth * units::to_degrees,
                          " deg: its eigenvalues are not motions of the machine\n\n", at.description);
    return at;
}

// Modes at the rotor speed by the method that suits the machine. From standstill on where that costs little, so that
// the modes keep their names. Empty, with the reason printed, where it fails.
std::optional<solvers::Campbell> diagram(const turbines::Turbine& turbine, const LineariseArguments& a, double speed,
                                         solvers::RotorSpin spin, Form form) {
    if (form == Form::multi_blade && a.machine.gravity) return std::nullopt;  // the mean is not Floquet's
    solvers::CampbellOptions options;
    options.spin = spin;
    options.max_frequency_hz = a.model.max_frequency;
    options.keep_shapes = false;
    std::vector<double> speeds{speed};
    if (form == Form::multi_blade && speed > 0)
        speeds = solvers::rpm_range(0, speed * units::to_rpm, speed * units::to_rpm / 9);
    try {
        return solvers::campbell(turbine.system(), turbine.rotor(), speeds, options);
    } catch (const NumericalError& error) {
        std::printf("no Campbell diagram: %s\n", error.what());
        return std::nullopt;
    }
}

// x' = A(psi) x between the azimuths by their Fourier series.
solvers::PeriodicSystem periodic_system(const solvers::LinearModel& model) {
    std::vector<solvers::StateMatrices> series = solvers::fourier_coefficients(model);
    for (solvers::StateMatrices& term : series) term.B = term.C = term.D = Matrix();
    const auto states = static_cast<Eigen::Index>(model.states.size());
    const double speed = model.rotor_speed;
    return solvers::PeriodicSystem::first_order(2 * pi / std::abs(speed), states,
                                                [=](double time, Matrix& E, Matrix& A) {
                                                    E.setIdentity(states, states);
                                                    A = solvers::evaluate(series, speed * time).A;
                                                });
}

// Distance of two exponents, each of which stands for all that differ from it by multiples of i omega, and for their
// conjugates.
double distance(const Complex& a, const Complex& b, double omega) {
    const auto apart = [&](const Complex& difference) {
        return std::abs(Complex(difference.real(), std::remainder(difference.imag(), omega)));
    };
    return std::min(apart(a - b), apart(a - std::conj(b)));
}

// Characteristic exponents of the sampled A beside the modes of the diagram.
void print_exponents(const solvers::LinearModel& model, const std::optional<solvers::Campbell>& diagram,
                     double max_frequency) {
    const solvers::PeriodicSystem system = periodic_system(model);
    solvers::FloquetOptions options;
    options.per_period = 2 * pi * max_frequency / system.frequency();
    options.steps = std::max(64, static_cast<int>(8 * options.per_period));  // of order 9
    const solvers::Floquet floquet = solvers::floquet(system, options);
    if (!diagram) return;
    std::printf(
        "modes of the Campbell diagram, and how far the next characteristic exponent of A(psi) is from each\n"
        "   damped Hz  damping %%    relative\n");
    const std::size_t last = diagram->points.size() - 1;
    for (const solvers::Branch& branch : diagram->branches) {
        const solvers::CampbellMode* mode = diagram->mode(branch, last);
        if (mode == nullptr || diagram->natural_hz(branch, last) > max_frequency) continue;
        const Complex exponent = mode->mode.eigenvalue;
        double nearest = std::numeric_limits<double>::infinity();
        for (const solvers::FloquetMode& other : floquet.modes)
            nearest = std::min(nearest, distance(exponent, other.exponent, system.frequency()));
        std::printf("%12.6f %10.4f %11.1e  %s%s\n", diagram->damped_hz(branch, last),
                    100 * diagram->damping_ratio(branch, last),
                    nearest / std::max(std::abs(exponent), 1e-9 + system.frequency()), branch.name.c_str(),
                    branch.doubtful[last] ? " ?" : "");
    }
    std::printf("(exponents count modulo the rotor speed; relative to the exponent, at least to the rotor speed)\n");
}

// A hundredth of the weight above the tower, as force and, a tenth of the rotor's radius beside it, as moment.
SignalSizes sizes(const solvers::ConstantModel& model, const turbines::Turbine& turbine,
                  const turbines::TurbineDescription& machine) {
    double mass = 0;
    for (const PartMass& part : masses_by_part(turbine.tree()))
        if (part.part != "tower" && part.part != "platform") mass += part.mass;
    const double radius = machine.hub.radius + (machine.blades > 0 ? machine.blade.line.length : 0);
    const double force = 0.01 * mass * units::standard_gravity, moment = 0.1 * radius * force;
    const auto size = [&](const solvers::Signal& signal, double other) {
        if (signal.name == "generator torque") return moment / turbine.layout().gear_ratio;
        return signal.units == "N" ? force : signal.units == "N m" ? moment : other;
    };
    SignalSizes all{Vector(model.B.cols()), Vector(model.C.rows())};
    for (Eigen::Index i = 0; i < model.B.cols(); ++i) all.input(i) = size(entry(model.inputs, i), 1);
    for (Eigen::Index i = 0; i < model.C.rows(); ++i) all.output(i) = size(entry(model.outputs, i), 0.01);
    return all;
}

std::string why_periodic(const turbines::Turbine& turbine, const turbines::TurbineDescription& machine) {
    if (!machine.own_blades.empty()) return "blades that differ";
    return turbine.layout().blades.size() == 2 ? "two blades" : "a rotor that is not balanced";
}

// The small model, or why there is none.
void add_balanced(std::vector<solvers::NamedModel>& models, const LineariseArguments& a, const SignalSizes& sizes) {
    const solvers::ConstantModel& whole = models.back().model;
    try {
        const solvers::BalancedModel small = balanced(whole, a.model, sizes);
        print(whole, small, a.model.max_frequency);
        models.push_back({"balanced", static_cast<const solvers::ConstantModel&>(small)});
    } catch (const NumericalError& error) {
        std::printf("\nno balanced model: %s\n", error.what());
    }
}

// The constant forms of a model, its modes beside those of the Campbell diagram, and the files.
// @param diagram  of a form; called once
int finish(LineariseArguments& a, const CommandLine& command, const turbines::Turbine& turbine,
           const turbines::Machine& machine, solvers::LinearModel model,
           const std::function<std::optional<solvers::Campbell>(Form)>& diagram) {
    const turbines::TurbineDescription& description = machine.description;
    model.description = run_text("linearise", command) + turbines::with_machine(model.description, machine);
    const Form form = form_of(model, description);
    std::vector<solvers::NamedModel> constant;
    if (form == Form::multi_blade) {
        const solvers::MultiBladeModel fixed = solvers::multi_blade(model, turbine.rotor());
        introduce(model, *a.rpm, &fixed);
        constant.push_back({"multi_blade", static_cast<const solvers::ConstantModel&>(fixed)});
    } else {
        introduce(model, *a.rpm, nullptr);
    }
    const std::optional<solvers::Campbell> modes = diagram(form);
    if (form == Form::periodic) {
        constant.push_back({"frozen", frozen(model, a.azimuth * units::degree)});
        const std::string& about = constant.back().model.description;
        std::printf("%s: the model is periodic. It is given at %zu azimuths; as a constant model, 'frozen', %s\n",
                    why_periodic(turbine, description).c_str(), model.samples.size(),
                    about.substr(0, about.find('\n')).c_str());
        print_exponents(model, modes, a.model.max_frequency);
    } else {
        if (form == Form::constant) {
            constant.push_back({"constant", solvers::at_sample(model, 0)});
            std::printf("the matrices do not change with the azimuth: the model is constant as it is\n");
        }
        print_modes(constant.back().model, modes, a.model.max_frequency);
        add_balanced(constant, a, sizes(constant.back().model, turbine, description));
    }
    write_files(model, constant, a.model.out);
    return 0;
}

// A parked rotor, blade 1 up.
solvers::OperatingPoint standing(const turbines::AeroelasticPoint& point) {
    solvers::SteadyOptions options;
    options.initial = point.start.col(0);
    if (point.state_start.cols() > 0) options.states = point.state_start.col(0);
    const solvers::SteadyState state =
        solvers::steady_state(point.machine.system(), point.machine.rotor().spin, options);
    require_result(state);
    return state.at;
}

// At an operating point in the wind; wind and pitch are inputs, and what the air does to the rotor an output.
int run_in_wind(LineariseArguments& a, turbines::Machine machine, const CommandLine& command) {
    if (a.rpm) throw InputError("--rpm", "value", *a.rpm, "none beside --wind: see --schedule");
    take_wind(machine, a.air.wind, a.machine.notes);
    WindRun run = wind_run(machine, a.machine, a.air.wind, a.air.harmonics, a.model.azimuths, a.model.max_frequency);
    if (run.speeds.size() != 1)
        throw InputError("--wind", "number of wind speeds", run.speeds.size(), "1 for a linear model");
    std::printf("%s\n", in_words(run.ready.mesh).c_str());
    turbines::AeroelasticOptions air = air_that_lags(a.air, run.air);
    find_points(run, machine, a.machine, a.air.wind);
    if (run.points.empty()) return run.complete ? 1 : 130;
    tell_air("vibrations", vibration_in_words(run.air, air));
    const turbines::Operation& operation = run.points.front().operation;
    a.rpm = operation.rotor_speed * units::to_rpm;

    const solvers::RotorSpin spin = rotor_spin(machine);
    const auto modes = [&, air](Form form) -> std::optional<solvers::Campbell> {
        if (form != Form::multi_blade) return std::nullopt;
        solvers::CampbellOptions options;
        options.spin = spin;
        options.max_frequency_hz = a.model.max_frequency;
        options.keep_shapes = false;
        options.floquet.harmonics = a.air.harmonics;
        return turbines::aeroelastic_campbell(run.operation, run.points, air, options);
    };
    air.wind_input = true;
    const turbines::AeroelasticPoint point = turbines::aeroelastic(run.operation, run.points.front(), air);
    const turbines::Turbine& turbine = point.machine;
    solvers::LinearInput::Coordinates toward_feather;
    for (const BodyId drive : turbine.layout().pitch_drives)
        toward_feather.emplace_back(turbine.system().model.index(drive), -1.0);
    const auto about = [&](const auto& state) {
        return linearise_about(turbine, a.model, state, spin,
                               {solvers::LinearInput::system_input(turbines::wind_input),
                                solvers::LinearInput::motion("collective pitch", toward_feather)},
                               {point.air.channels()});
    };
    solvers::LinearModel model = operation.rotor_speed == 0
                                     ? about(standing(point))
                                     : about(turbines::steady_state(point, operation.rotor_speed, a.air.harmonics));
    return finish(a, command, turbine, machine, std::move(model), modes);
}

int run(LineariseArguments& a, const CommandLine& command) {
    const bool windy = !a.air.wind.speeds.empty();
    const turbines::Machine machine = prepared_machine(a.machine);
    if (a.model.out.empty()) a.model.out = default_prefix(a.machine.model, windy ? "linear_wind" : "linear");
    if (!a.max_frequency) a.max_frequency = usual_frequency(machine, a.machine);
    a.model.max_frequency = *a.max_frequency;
    check_outputs(a.model.out, {".h5", ".mat", ".1.lin"});
    check(a.model, a.rpm.value_or(0));
    if (windy) return run_in_wind(a, machine, command);
    const double speed = rotor_speed(a.rpm, machine);
    a.rpm = speed * units::to_rpm;
    set_pitch(machine, a.machine, speed);
    const ReadyMachine ready = ready_machine(machine, a.machine, a.model.max_frequency, std::abs(speed));
    std::printf("%s\n", in_words(ready.mesh).c_str());
    const solvers::RotorSpin spin = rotor_spin(machine);
    solvers::LinearModel model = linearise(ready.turbine, a.model, speed, spin,
                                           a.machine.gravity ? LinearisedAbout::periodic : LinearisedAbout::automatic);
    return finish(a, command, ready.turbine, machine, std::move(model),
                  [&](Form form) { return diagram(ready.turbine, a, speed, spin, form); });
}

}  // namespace

int linearise_command(int argc, char** argv) {
    return run_command<LineariseArguments>(
        "cardan linearise",
        "Linear model of any machine at a rotor speed, or with --wind at an operating point, for control design.\n"
        "Writes PREFIX.h5, PREFIX.mat and PREFIX.1.lin, PREFIX.2.lin ... (one per azimuth), and prints the modes.\n"
        "Three and more equal blades: in multi-blade coordinates, averaged over the azimuth, and reduced. Two blades "
        "or blades that differ: the model is periodic, and is given at all azimuths.",
        argc, argv, declare, run);
}

}  // namespace cardan::program
