// Linear model of the 600 kW machine for the design of controllers.
//
// Problem: at a rotor speed the machine is linearised about its steady state, x' = A(psi) x + B(psi) u,
// y = C(psi) x + D(psi) u, with the torque of the generator, moments of yaw and pitch drives and thrust as inputs and
// speeds, accelerations and loads as outputs; the multi-blade transformation makes the matrices constant; balanced
// truncation leaves a small model to design with.
// Reference: the modes of A are those of the Campbell diagram at this rotor speed (docs/wt600.md).
#include "turbines/analysis/linear_model.hpp"
#include "turbines/machines/wt600.hpp"

#include "examples/studies/wt600_generator_option.hpp"
#include "programs/shared/linear_model_program.hpp"

using namespace cardan;

namespace {

struct Arguments {
    double rotor_rpm = 27;
    bool gravity = false;
    program::LinearModelArguments model;
    program::GeneratorOption generator;
    std::string data;
    turbines::AssemblyOptions assembly;
};

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Linear model of the 600 kW three-blade machine for control design.\n"
        "Writes PREFIX.h5 and PREFIX.mat, with --lin also PREFIX.1.lin, PREFIX.2.lin ... (one per azimuth), and prints "
        "the modes.");
    a.model.out = "wt600_linear_model";
    app.add_option("--rpm", a.rotor_rpm, "rotor speed, rev/min");
    program::add_linear_model_options(app, a.model);
    app.add_option("--max-frequency", a.model.max_frequency, program::max_frequency_of_models);
    app.add_option("--blade-elements", a.assembly.blade_elements,
                   "beam elements per blade (default: as many as it takes)");
    app.add_option("--tower-elements", a.assembly.tower_elements,
                   "beam elements of the tower (default: as many as it takes)");
    app.add_flag("--gravity", a.gravity, "about the periodic steady state under gravity");
    program::add_generator_option(app, a.generator);
    app.add_option("--data", a.data, "folder with wt600_blade.csv and wt600_turbine.csv (default: built in)");
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    if (a.gravity) a.assembly.gravity = {0, 0, -units::standard_gravity};
    return -1;
}

// From standstill on, so that the modes keep their names. Under gravity it would be Floquet's and take long.
std::optional<solvers::Campbell> diagram(const turbines::Turbine& turbine, const Arguments& a) {
    if (a.gravity) return std::nullopt;
    const std::vector<double> speeds =
        a.rotor_rpm > 0 ? solvers::rpm_range(0, a.rotor_rpm, a.rotor_rpm / 9) : std::vector<double>{0};
    solvers::CampbellOptions options;
    options.spin = a.generator.spin();
    options.max_frequency_hz = a.model.max_frequency;
    options.keep_shapes = false;
    return solvers::campbell(turbine.system(), turbine.rotor(), speeds, options);
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

solvers::BalancedModel balanced(const solvers::ConstantModel& fixed, const program::LinearModelArguments& a) {
    solvers::BalancedOptions options;
    options.order = a.order;
    if (a.order == 0) options.error = a.error / 100;
    options.max_frequency_hz = a.max_frequency;
    options.static_gain = solvers::StaticGain::kept;
    options.output_size = output_sizes(fixed);
    options.input_size.resize(fixed.B.cols());
    for (Eigen::Index i = 0; i < fixed.B.cols(); ++i) options.input_size(i) = input_size(entry(fixed.inputs, i));
    return solvers::balanced_truncation(fixed, options);
}

int run(const Arguments& a) {
    program::check(a.model, a.rotor_rpm);
    const turbines::TurbineDescription description =
        a.data.empty() ? turbines::wt600_description() : turbines::wt600_description(std::filesystem::path(a.data));
    const turbines::Turbine turbine =
        program::with_generator(turbines::assemble(description, a.assembly), a.generator, a.data);
    program::check_outputs(a.model.out, {".h5", ".mat"});

    const solvers::LinearModel model = turbines::linearised(turbine,
                                                            {.rotor_speed = a.rotor_rpm * units::rpm,
                                                             .gravity = a.gravity,
                                                             .stations = program::stations_of(a.model.stations),
                                                             .azimuths = a.model.azimuths},
                                                            a.generator.spin());
    const solvers::MultiBladeModel fixed = solvers::multi_blade(model, turbine.rotor());
    const solvers::BalancedModel small = balanced(fixed, a.model);
    program::introduce(model, a.rotor_rpm, &fixed);
    std::printf("%s\n", turbines::in_words(turbine.mesh()).c_str());
    program::print_modes(fixed, diagram(turbine, a), a.model.max_frequency);
    program::print(fixed, small, a.model.max_frequency);
    program::write_files(model,
                         {{"multi_blade", static_cast<const solvers::ConstantModel&>(fixed)},
                          {"balanced", static_cast<const solvers::ConstantModel&>(small)}},
                         a.model);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("wt600_linear_model", argc, argv, parse, run);
}
