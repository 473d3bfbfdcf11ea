// Linear model of the 600 kW machine for the design of controllers.
//
// Problem: at a rotor speed the machine is linearised about its steady state, x' = A(psi) x + B(psi) u,
// y = C(psi) x + D(psi) u, with the torque of the generator, moments of yaw and pitch drives and thrust as inputs and
// speeds, accelerations and loads as outputs; the multi-blade transformation makes the matrices constant; balanced
// truncation leaves a small model to design with.
// Reference: the modes of A are those of the Campbell diagram at this rotor speed (docs/wt600.md).
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/outcome.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/control/lin_file.hpp"
#include "solvers/control/model_reduction.hpp"
#include "solvers/control/multi_blade_model.hpp"
#include "solvers/control/state_space.hpp"
#include "solvers/hdf5_models/state_space.hpp"
#include "solvers/linear/problem_size.hpp"
#include "solvers/matlab/state_space.hpp"
#include "turbines/machines/wt600.hpp"
#include "turbines/model/channels.hpp"

#include "examples/programs/wt600_generator_option.hpp"
#include "examples/shared/program.hpp"
#include <algorithm>
#include <cstdio>

using namespace cardan;

namespace {

struct Arguments {
    double rotor_rpm = 27, max_frequency = 10;
    int azimuths = 12, order = 0, harmonics = 8;
    double error = 5;
    bool gravity = false;
    program::GeneratorOption generator;
    std::string out = "wt600_linear_model", data;
    turbines::AssemblyOptions assembly;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Linear model of the 600 kW three-blade machine for control design.\n"
        "Writes PREFIX.h5, PREFIX.mat and PREFIX.1.lin, PREFIX.2.lin ... (one per azimuth), and prints the modes.");
    app.add_option("--rpm", a.rotor_rpm, "rotor speed, rev/min");
    app.add_option("--azimuths", a.azimuths, "azimuths per revolution");
    app.add_option("--error", a.error,
                   "error of the balanced model, % of the largest response of every input and output up to the largest "
                   "frequency; its order follows");
    app.add_option("--order", a.order, "order of the balanced model instead (0: by the error)");
    app.add_option("--max-frequency", a.max_frequency,
                   "modes are printed, and the balanced model is right, up to this frequency, Hz");
    app.add_option("--blade-elements", a.assembly.blade_elements, "beam elements per blade");
    app.add_option("--tower-elements", a.assembly.tower_elements, "beam elements of the tower");
    app.add_flag("--gravity", a.gravity, "about the periodic steady state under gravity");
    program::add_generator_option(app, a.generator);
    app.add_option("--out", a.out, "prefix of the files");
    app.add_option("--data", a.data, "folder with wt600_blade.csv and wt600_turbine.csv (default: built in)");
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    if (a.gravity) a.assembly.gravity = {0, 0, -units::standard_gravity};
    return -1;
}

std::vector<solvers::LinearInput> inputs(const turbines::Turbine& turbine, bool rotor_free) {
    using solvers::LinearInput;
    const turbines::MachineLayout& layout = turbine.layout();
    const Model& model = turbine.system().model;
    std::vector<LinearInput> list;
    // Positive: brakes, on the fast shaft.
    if (rotor_free)
        list.push_back(
            LinearInput::generalised_force("generator torque", {{turbine.rotor().spin, -layout.gear_ratio}}));
    list.push_back(LinearInput::generalised_force("yaw moment", {{model.index(*layout.yaw), 1.0}}));
    list.push_back(LinearInput::force("thrust", layout.hub, Vec3::UnitZ(), WrenchAxes::frame));
    list.push_back(LinearInput::moment("rotor torque", layout.hub, Vec3::UnitZ(), WrenchAxes::frame));
    for (std::size_t k = 0; k < layout.pitch.size(); ++k)  // positive toward feather
        list.push_back(LinearInput::generalised_force(text("blade ", k + 1, " pitch moment"),
                                                      {{model.index(layout.pitch[k]), -1.0}}));
    return list;
}

const std::vector<std::string> outputs{"GenSpeed",  "RotSpeed",  "RotTorq",   "TTDspFA",   "TTDspSS",
                                       "YawBrTAxp", "YawBrTAyp", "NacYaw",    "TwrBsMxt",  "TwrBsMyt",
                                       "TwrBsMzt",  "RootMxb1",  "RootMxb2",  "RootMxb3",  "RootMyb1",
                                       "RootMyb2",  "RootMyb3",  "BldPitch1", "BldPitch2", "BldPitch3"};

solvers::LinearModel linearise(const turbines::Turbine& turbine, const Arguments& a) {
    // Before the equilibrium is sought, which takes long.
    solvers::check_number_of_unknowns(turbine.rotor().machine, turbine.system().model.coordinates().free().size());
    const double rotor_speed = a.rotor_rpm * units::rpm;
    solvers::StateSpaceOptions options;
    options.azimuths = a.azimuths;
    options.outputs = outputs;
    options.spin = a.generator.spin();
    const auto list = inputs(turbine, options.spin == solvers::RotorSpin::free);
    const auto channels = turbines::channels(turbine);
    const int spin = turbine.rotor().spin;
    if (a.gravity && rotor_speed != 0) {
        solvers::PeriodicOptions periodic;
        periodic.rotor_speed = rotor_speed;
        periodic.harmonics = a.harmonics;
        periodic.rotor = &turbine.rotor();
        const auto state = solvers::harmonic_balance(turbine.system(), spin, periodic);
        require_result(state);
        return solvers::state_space(turbine.system(), turbine.rotor(), state, list, channels, options);
    }
    solvers::SteadyOptions steady;
    steady.rotor_speed = rotor_speed;
    const solvers::SteadyState state = solvers::steady_state(turbine.system(), spin, steady);
    require_result(state);
    return solvers::state_space(turbine.system(), turbine.rotor(), state.at, list, channels, options);
}

// Modes of the linear model beside those of the Campbell diagram.
void print_modes(const turbines::Turbine& turbine, const solvers::ConstantModel& fixed, const Arguments& a) {
    const std::vector<Complex> poles = fixed.poles();
    solvers::Campbell diagram;
    if (!a.gravity) {
        // From standstill on, so that the modes keep their names.
        const std::vector<double> speeds =
            a.rotor_rpm > 0 ? solvers::rpm_range(0, a.rotor_rpm, a.rotor_rpm / 9) : std::vector<double>{0};
        solvers::CampbellOptions options;
        options.spin = a.generator.spin();
        options.max_frequency_hz = a.max_frequency;
        options.keep_shapes = false;
        diagram = solvers::campbell(turbine.system(), turbine.rotor(), speeds, options);
    }
    const std::size_t last = diagram.points.size() - 1;
    std::printf("modes of A%s\n", a.gravity ? "" : " and of the Campbell diagram");
    std::printf("  natural Hz  damping %%%s\n", a.gravity ? "" : "    natural Hz  damping %");
    for (const Complex& pole : poles) {
        const double hertz = std::abs(pole) / (2 * pi), damping = -100 * pole.real() / std::abs(pole);
        if (pole.imag() <= 1e-3 || hertz > a.max_frequency) continue;
        std::printf("%12.6f %10.4f", hertz, damping);
        const solvers::Branch* best = nullptr;
        double nearest = 1e-3 * std::abs(pole);
        for (const solvers::Branch& branch : diagram.branches) {
            const solvers::CampbellMode* mode = diagram.mode(branch, last);
            if (mode == nullptr) continue;
            const Complex other = mode->mode.eigenvalue;
            if (std::abs(other - pole) < nearest) best = &branch, nearest = std::abs(other - pole);
        }
        if (best)
            std::printf("  %12.6f %10.4f  %s%s", diagram.natural_hz(*best, last),
                        100 * diagram.damping_ratio(*best, last), best->name.c_str(), best->doubtful[last] ? " ?" : "");
        std::printf("\n");
    }
}

// What counts as much in each output, so that newtons do not outweigh radians: 10 kN (m), and 0.01 of the others.
Vector output_sizes(const solvers::ConstantModel& model) {
    Vector size(model.C.rows());
    for (Eigen::Index i = 0; i < size.size(); ++i) {
        const std::string& units = entry(model.outputs, i).units;
        size(i) = units == "N m" || units == "N" ? 1e4 : 0.01;
    }
    return size;
}

// Inputs: a tenth of what the machine has.
double input_size(const solvers::Signal& input) {
    for (const auto& [name, size] :
         {std::pair{"generator torque", 400.0}, std::pair{"yaw moment", 2e4}, std::pair{"thrust", 1e4},
          std::pair{"rotor torque", 2e4}, std::pair{"blade", 5e5}})  // 0.01 rad of the pitch drive's spring
        if (input.name.starts_with(name)) return size;
    throw InputError("balanced model", "input", input.name, "one whose size is known");
}

solvers::BalancedModel balanced(const solvers::ConstantModel& fixed, const Arguments& a) {
    solvers::BalancedOptions options;
    options.order = a.order;
    if (a.order == 0) options.error = a.error / 100;
    options.max_frequency_hz = a.max_frequency;
    options.static_gain = solvers::StaticGain::kept;
    options.input_size.resize(fixed.B.cols());
    for (Eigen::Index i = 0; i < fixed.B.cols(); ++i) options.input_size(i) = input_size(entry(fixed.inputs, i));
    options.output_size = output_sizes(fixed);
    return solvers::balanced_truncation(fixed, options);
}

// Which inputs and outputs a small model serves is seen here.
void print_errors(const solvers::ConstantModel& fixed, const solvers::BalancedModel& small, double max_frequency) {
    const auto print = [](const std::vector<solvers::Signal>& signals, const Vector& error) {
        for (Eigen::Index i = 0; i < error.size(); ++i)
            std::printf("  %-34s %8.2f %%\n", entry(signals, i).name.c_str(), 100 * error(i));
    };
    std::printf("largest error up to %g Hz, of the largest response to the same input (each output by its own size)\n",
                max_frequency);
    print(fixed.inputs, small.input_error);
    std::printf("and of the largest response of the same output (each input by its own size)\n");
    print(fixed.outputs, small.output_error);
}

int run(const Arguments& a) {
    if (!std::isfinite(a.rotor_rpm) || a.rotor_rpm < 0) throw InputError("--rpm", "value", a.rotor_rpm, ">= 0");
    require_positive("--max-frequency", "value [Hz]", a.max_frequency);
    require_positive("--error", "value [%]", a.error);
    if (a.azimuths > 720) throw InputError("--azimuths", "value", a.azimuths, "at most 720");
    const turbines::TurbineDescription description =
        a.data.empty() ? turbines::wt600_description() : turbines::wt600_description(std::filesystem::path(a.data));
    const turbines::Turbine turbine =
        program::with_generator(turbines::assemble(description, a.assembly), a.generator, a.data);
    program::check_outputs(a.out, {".h5", ".mat", ".1.lin"});

    const solvers::LinearModel model = linearise(turbine, a);
    const solvers::MultiBladeModel fixed = solvers::multi_blade(model, turbine.rotor());
    const solvers::BalancedModel small = balanced(fixed, a);
    std::printf("%s at %g rpm: %zu states, %zu inputs, %zu outputs, %zu azimuths\n", model.machine.c_str(), a.rotor_rpm,
                model.states.size(), model.inputs.size(), model.outputs.size(), model.samples.size());
    std::printf("periodic remainder of the multi-blade matrices, relative: A %.1e, B %.1e, C %.1e, D %.1e\n",
                fixed.A_remainder, fixed.B_remainder, fixed.C_remainder, fixed.D_remainder);
    std::printf("estimated error of C and D, relative: %.1e\n\n", model.output_error.maxCoeff());
    print_modes(turbine, fixed, a);
    std::printf("\nbalanced model: order %d and %d states that are not stable\n", small.order, small.kept_as_is);
    print_errors(fixed, small, a.max_frequency);
    std::printf("Hankel singular values:");
    for (Eigen::Index i = 0; i < std::min<Eigen::Index>(small.hankel.size(), small.order + 4); ++i)
        std::printf("%s%s %.3e", i % 8 == 0 ? "\n " : "", i == small.order ? " |" : "", small.hankel(i));

    const std::vector<solvers::NamedModel> constant{{"multi_blade", static_cast<const solvers::ConstantModel&>(fixed)},
                                                    {"balanced", static_cast<const solvers::ConstantModel&>(small)}};
    solvers::write_hdf5(model, constant, a.out + ".h5");
    solvers::write_mat(model, constant, a.out + ".mat");
    const auto files = solvers::write_lin(model, a.out);
    std::printf("\n\nfiles: %s.h5, %s.mat, %s ... %zu files\n", a.out.c_str(), a.out.c_str(),
                files.front().string().c_str(), files.size());
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("wt600_linear_model", argc, argv, parse, run);
}
