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
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/cardan/commands.hpp"
#include "programs/cardan/options.hpp"
#include "programs/shared/channel_choice.hpp"
#include "programs/shared/program.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/hdf5_models/state_space.hpp"
#include "solvers/linear_models/lin_file.hpp"
#include "solvers/linear_models/model_reduction.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "solvers/matlab/state_space.hpp"
#include "solvers/periodic/floquet.hpp"
#include "turbines/analysis/in_unit.hpp"
#include "turbines/analysis/linear_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cardan::program {

namespace {

struct LineariseArguments {
    MachineOptions machine;
    VibrationArguments air;
    StationOptions stations;
    std::string out;
    std::optional<double> rpm, max_frequency;
    double error = 5, azimuth = 0;
    int azimuths = 24, order = 0;
    bool lin = false;
};

void declare(CommandLine& app, LineariseArguments& a) {
    add_machine(app, a.machine);
    app.add_option("--rpm", a.rpm, "rotor speed, rev/min (default: the model's)");
    app.add_option("--azimuths", a.azimuths, "azimuths per revolution");
    app.add_option("--error", a.error,
                   "error of the balanced model, % of the largest response of every input and output up to the largest "
                   "frequency; its order follows");
    app.add_option("--order", a.order, "order of the balanced model instead (0: by the error)");
    add_station_options(app, a.stations);
    app.add_flag("--lin", a.lin, "write files of OpenFAST's linearisation too, one per azimuth: PREFIX.1.lin ...");
    app.add_option("--out", a.out, "prefix of the files");
    app.add_option("--max-frequency", a.max_frequency,
                   "modes are printed, and the balanced model is right, up to this frequency, Hz (default: 1.3 times "
                   "the third of the blade, clamped and at rest)");
    app.add_option("--azimuth", a.azimuth,
                   "of a periodic model that is given as a constant one, deg; the nearest there is")
        .finite();
    app.add_flag("--gravity", a.machine.gravity, "about the periodic steady state under gravity");
    add_vibration_options(app, a.air);
    add_machine_options(app, a.machine);
}

void require_numbers(const LineariseArguments& a) {
    if (a.rpm && (!std::isfinite(*a.rpm) || *a.rpm < 0)) throw InputError("--rpm", "value", *a.rpm, ">= 0");
    if (a.max_frequency) require_positive("--max-frequency", "value [Hz]", *a.max_frequency);
    require_positive("--error", "value [%]", a.error);
    if (a.azimuths < 1 || a.azimuths > 720) throw InputError("--azimuths", "value", a.azimuths, "1 ... 720");
    if (a.order < 0) throw InputError("--order", "value", a.order, ">= 0");
    static_cast<void>(stations_of(a.stations));
}

turbines::LinearModelSettings settings_of(const LineariseArguments& a) {
    turbines::LinearModelSettings s;
    if (a.rpm) s.rotor_speed = *a.rpm * units::rpm;
    const std::vector<double> winds = winds_of(a.air.wind);
    if (winds.size() > 1) throw InputError("--wind", "number of wind speeds", winds.size(), "1 for a linear model");
    if (!winds.empty()) s.wind = winds.front();
    s.machine = numbers_of(a.machine);
    s.gravity = a.machine.gravity;
    s.stations = stations_of(a.stations);
    s.azimuths = a.azimuths;
    if (s.wind) s.harmonics = a.air.harmonics;
    s.max_frequency_hz = a.max_frequency;
    s.error = a.error / 100;
    s.order = a.order;
    s.azimuth = a.azimuth * units::degree;
    s.air = settings_of(a.air.wind.air);
    s.operation = operation_of(a.air.wind);
    s.report = remarks_printed(a.machine.notes);
    s.cancelled = interrupted;
    return s;
}

void keep_taken(const turbines::LinearModelSettings& taken, LineariseArguments& a) {
    keep_taken(taken.machine, a.machine);
    a.rpm = turbines::in_unit(*taken.rotor_speed, units::rpm);
    a.max_frequency = taken.max_frequency_hz;
}

solvers::CampbellOptions modes_of(const turbines::MachineLinearModel& linear, solvers::RotorSpin spin) {
    solvers::CampbellOptions options;
    options.spin = spin;
    options.max_frequency_hz = *linear.settings.max_frequency_hz;
    options.keep_shapes = false;
    options.cancelled = interrupted;
    return options;
}

// Modes at the rotor speed by the method that suits the machine. From standstill on where that costs little, so that
// the modes keep their names.
std::optional<solvers::Campbell> diagram_over_speed(const turbines::MachineLinearModel& linear,
                                                    solvers::RotorSpin spin) {
    const bool multi_blade = linear.form == turbines::LinearForm::multi_blade;
    if (multi_blade && linear.settings.gravity) return std::nullopt;  // the mean is not Floquet's
    const double speed = *linear.settings.rotor_speed;
    std::vector<double> speeds{speed};
    if (multi_blade && speed > 0) speeds = solvers::rpm_range(0, speed * units::to_rpm, speed * units::to_rpm / 9);
    return solvers::campbell(linear.turbine.system(), linear.turbine.rotor(), speeds, modes_of(linear, spin));
}

std::optional<solvers::Campbell> diagram_in_wind(const turbines::MachineLinearModel& linear, solvers::RotorSpin spin) {
    if (linear.form != turbines::LinearForm::multi_blade) return std::nullopt;
    solvers::CampbellOptions options = modes_of(linear, spin);
    options.floquet.harmonics = *linear.settings.harmonics;
    const turbines::WindRun& run = *linear.in_wind;
    return turbines::aeroelastic_campbell(run.operation, run.points, turbines::aeroelastic_options(run.air), options);
}

// Empty, with the reason printed, where it fails.
std::optional<solvers::Campbell> diagram(const turbines::MachineLinearModel& linear, solvers::RotorSpin spin) {
    if (linear.in_wind) return diagram_in_wind(linear, spin);
    try {
        return diagram_over_speed(linear, spin);
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

// The branch of a diagram whose eigenvalue at the last point is nearest to a pole, and nearly equal; null: none.
const solvers::Branch* branch_of(const solvers::Campbell& diagram, const Complex& pole) {
    const solvers::Branch* best = nullptr;
    double nearest = 1e-3 * std::abs(pole);
    for (const solvers::Branch& branch : diagram.branches) {
        const solvers::CampbellMode* mode = diagram.mode(branch, diagram.points.size() - 1);
        if (mode == nullptr) continue;
        const double distance = std::abs(mode->mode.eigenvalue - pole);
        if (distance < nearest) best = &branch, nearest = distance;
    }
    return best;
}

// Modes of a constant model beside those of a Campbell diagram's last point; none: alone.
// @param max_frequency  Hz
void print_modes(const solvers::ConstantModel& model, const std::optional<solvers::Campbell>& diagram,
                 double max_frequency) {
    std::printf("modes of A%s\n", diagram ? " and of the Campbell diagram" : "");
    std::printf("  natural Hz  damping %%%s\n", diagram ? "    natural Hz  damping %" : "");
    for (const Complex& pole : model.poles()) {
        const double hertz = std::abs(pole) / (2 * pi), damping = -100 * pole.real() / std::abs(pole);
        if (pole.imag() <= 1e-3 || hertz > max_frequency) continue;
        std::printf("%12.6f %10.4f", hertz, damping);
        if (const solvers::Branch* branch = diagram ? branch_of(*diagram, pole) : nullptr) {
            const std::size_t last = diagram->points.size() - 1;
            std::printf("  %12.6f %10.4f  %s%s", diagram->natural_hz(*branch, last),
                        100 * diagram->damping_ratio(*branch, last), branch->name.c_str(),
                        branch->doubtful[last] ? " ?" : "");
        }
        std::printf("\n");
    }
}

// Which inputs and outputs a small model serves is seen here.
// @param max_frequency  Hz, up to which it does
void print(const solvers::ConstantModel& fixed, const solvers::BalancedModel& small, double max_frequency) {
    const auto print = [](const std::vector<solvers::Signal>& signals, const Vector& error) {
        for (Eigen::Index i = 0; i < error.size(); ++i)
            std::printf("  %-34s %8.2f %%\n", entry(signals, i).name.c_str(), 100 * error(i));
    };
    std::printf("\nbalanced model: order %d and %d states that are not stable\n", small.order, small.kept_as_is);
    std::printf("largest error up to %g Hz, of the largest response to the same input (each output by its own size)\n",
                max_frequency);
    print(fixed.inputs, small.input_error);
    std::printf("and of the largest response of the same output (each input by its own size)\n");
    print(fixed.outputs, small.output_error);
    std::printf("Hankel singular values:");
    for (Eigen::Index i = 0; i < std::min<Eigen::Index>(small.hankel.size(), small.order + 4); ++i)
        std::printf("%s%s %.3e", i % 8 == 0 ? "\n " : "", i == small.order ? " |" : "", small.hankel(i));
    std::printf("\n");
}

// Sizes of a model, and how far multi-blade coordinates leave it periodic.
// @param fixed  null: there are none
void introduce(const solvers::LinearModel& model, double rpm, const solvers::MultiBladeModel* fixed) {
    std::printf("%s at %g rpm: %zu states, %zu inputs, %zu outputs, %zu azimuths\n", model.machine.c_str(), rpm,
                model.states.size(), model.inputs.size(), model.outputs.size(), model.samples.size());
    if (fixed)
        std::printf("periodic remainder of the multi-blade matrices, relative: A %.1e, B %.1e, C %.1e, D %.1e\n",
                    fixed->A_remainder, fixed->B_remainder, fixed->C_remainder, fixed->D_remainder);
    std::printf("estimated error of C and D, relative: %.1e\n\n", model.output_error.maxCoeff());
}

// PREFIX.h5, PREFIX.mat, and where they are asked for PREFIX.1.lin, ...
void write_files(const solvers::LinearModel& model, const std::vector<solvers::NamedModel>& constant,
                 const std::string& prefix, bool lin) {
    solvers::write_hdf5(model, constant, prefix + ".h5");
    solvers::write_mat(model, constant, prefix + ".mat");
    std::printf("\nfiles: %s.h5, .mat", prefix.c_str());
    if (lin) {
        const auto files = solvers::write_lin(model, prefix);
        std::printf(", %s ... %zu files", files.front().string().c_str(), files.size());
    }
    std::printf("\n");
}

std::string why_periodic(const turbines::Turbine& turbine, const turbines::TurbineDescription& machine) {
    if (!machine.individual_blades.empty()) return "blades that differ";
    return turbine.layout().blades.size() == 2 ? "two blades" : "a rotor that is not balanced";
}

// By which command they were made.
void set_origin(const std::string& origin, turbines::MachineLinearModel& linear) {
    const std::string own = linear.model.description;
    linear.model.description = origin + own;
    for (solvers::NamedModel& one : linear.constant) {
        std::string& description = one.model.description;
        const std::size_t at = description.find(own);
        if (at != std::string::npos) description.insert(at, origin);
    }
}

void print_periodic(const turbines::MachineLinearModel& linear, const turbines::TurbineDescription& description,
                    const std::optional<solvers::Campbell>& modes) {
    const std::string& about = linear.constant.back().model.description;
    std::printf("%s: the model is periodic. It is given at %zu azimuths; as a constant model, 'frozen', %s\n",
                why_periodic(linear.turbine, description).c_str(), linear.model.samples.size(),
                about.substr(0, about.find('\n')).c_str());
    print_exponents(linear.model, modes, *linear.settings.max_frequency_hz);
}

// Its modes beside those of the Campbell diagram, and the small model, or why there is none.
void print_constant(const turbines::MachineLinearModel& linear, const std::optional<solvers::Campbell>& modes) {
    const double max_frequency = *linear.settings.max_frequency_hz;
    if (linear.form == turbines::LinearForm::constant)
        std::printf("the matrices do not change with the azimuth: the model is constant as it is\n");
    const solvers::ConstantModel& whole = linear.constant.front().model;
    print_modes(whole, modes, max_frequency);
    if (linear.balanced)
        print(whole, *linear.balanced, max_frequency);
    else
        std::printf("\nno balanced model: %s\n", linear.no_balanced.c_str());
}

int run(LineariseArguments& a, const CommandLine& command) {
    const bool windy = !a.air.wind.speeds.empty();
    check_wind(a.air.wind, a.rpm ? text(*a.rpm) : "");
    require_numbers(a);
    const turbines::LinearModelSettings settings = settings_of(a);
    if (a.out.empty()) a.out = default_prefix(a.machine.model, windy ? "linear_wind" : "linear");
    check_outputs(a.out, {".h5", ".mat"}, {a.machine.model});
    if (a.lin) check_outputs(a.out, {".1.lin"}, {a.machine.model});
    turbines::Machine machine = prepared_machine(a.machine);
    check_stations(machine, a.machine, a.stations);
    if (windy) take_wind(machine, a.air.wind, a.machine);
    stop_at_once();  // nothing is kept
    progress("linear model");
    turbines::MachineLinearModel linear = turbines::linear_model(machine, settings);
    keep_taken(linear.settings, a);
    if (a.machine.summary) std::cout << linear.turbine.summary() << "\n";
    set_origin(run_text("linearise", command), linear);

    introduce(linear.model, *a.rpm, linear.multi_blade ? &*linear.multi_blade : nullptr);
    const std::optional<solvers::Campbell> modes = diagram(linear, turbines::rotor_spin(machine));
    if (linear.form == turbines::LinearForm::periodic)
        print_periodic(linear, machine.description, modes);
    else
        print_constant(linear, modes);
    end_progress();
    write_files(linear.model, linear.constant, a.out, a.lin);
    return 0;
}

}  // namespace

int linearise_command(int argc, char** argv) {
    return run_command<LineariseArguments>(
        "cardan linearise",
        "Linear model of any machine at a rotor speed, or with --wind at an operating point, for control design.\n"
        "Writes PREFIX.h5 and PREFIX.mat, with --lin also PREFIX.1.lin, PREFIX.2.lin ... (one per azimuth), and prints "
        "the modes.\n"
        "Three and more equal blades: in multi-blade coordinates, averaged over the azimuth, and reduced. Two blades "
        "or blades that differ: the model is periodic, and is given at all azimuths.",
        argc, argv, declare, run);
}

}  // namespace cardan::program
