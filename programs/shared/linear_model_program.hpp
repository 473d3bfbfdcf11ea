/// @file
/// What the programs that make linear models for the design of controllers have in common.
#pragma once

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
#include "turbines/model/channels.hpp"

#include "programs/shared/channel_choice.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/steady_rotation.hpp"
#include <algorithm>
#include <cstdio>
#include <optional>

namespace cardan::program {

struct LinearModelArguments {
    double max_frequency = 10, error = 5;
    int azimuths = 12, order = 0, harmonics = 8;
    StationOptions stations = {};
    std::string out = {};
};

inline constexpr auto max_frequency_of_models =
    "modes are printed, and the balanced model is right, up to this frequency, Hz";

/// All but --max-frequency.
inline void add_linear_model_options(CommandLine& app, LinearModelArguments& a) {
    app.add_option("--azimuths", a.azimuths, "azimuths per revolution");
    app.add_option("--error", a.error,
                   "error of the balanced model, % of the largest response of every input and output up to the largest "
                   "frequency; its order follows");
    app.add_option("--order", a.order, "order of the balanced model instead (0: by the error)");
    add_station_options(app, a.stations);
    app.add_option("--out", a.out, "prefix of the files");
}

/// @throws InputError
inline void check(const LinearModelArguments& a, double rpm) {
    if (!std::isfinite(rpm) || rpm < 0) throw InputError("--rpm", "value", rpm, ">= 0");
    require_positive("--max-frequency", "value [Hz]", a.max_frequency);
    require_positive("--error", "value [%]", a.error);
    if (a.azimuths > 720) throw InputError("--azimuths", "value", a.azimuths, "at most 720");
}

/// Of joints that are free: the torque of the generator, moments of yaw and pitch drives; thrust and torque on the hub.
inline std::vector<solvers::LinearInput> linear_inputs(const turbines::Turbine& turbine, bool rotor_free) {
    using solvers::LinearInput;
    const turbines::MachineLayout& layout = turbine.layout();
    const Model& model = turbine.system().model;
    const auto is_free = [&](BodyId body) {
        return model.coordinates()[model.index(body)].role == CoordinateRole::free;
    };
    std::vector<LinearInput> list;
    // Positive: brakes, on the fast shaft.
    if (rotor_free)
        list.push_back(
            LinearInput::generalised_force("generator torque", {{turbine.rotor().spin, -layout.gear_ratio}}));
    if (layout.yaw && is_free(*layout.yaw))
        list.push_back(LinearInput::generalised_force("yaw moment", {{model.index(*layout.yaw), 1.0}}));
    list.push_back(LinearInput::force("thrust", layout.hub, Vec3::UnitZ(), WrenchAxes::frame));
    list.push_back(LinearInput::moment("rotor torque", layout.hub, Vec3::UnitZ(), WrenchAxes::frame));
    for (std::size_t k = 0; k < layout.pitch.size(); ++k)  // positive toward feather
        if (is_free(layout.pitch[k]))
            list.push_back(LinearInput::generalised_force(text("blade ", layout.blade_numbers[k], " pitch moment"),
                                                          {{model.index(layout.pitch[k]), -1.0}}));
    return list;
}

/// Speeds, motions of the tower, loads and pitch angles, as far as the machine has them.
inline std::vector<std::string> linear_outputs(const turbines::Turbine& turbine) {
    std::vector<std::string> all{"GenSpeed",  "RotSpeed",  "RotTorq", "RotTeetP", "TTDspFA",  "TTDspSS",
                                 "YawBrTAxp", "YawBrTAyp", "NacYaw",  "TwrBsMxt", "TwrBsMyt", "TwrBsMzt"};
    for (const char* what : {" root moment x", " root moment y", " pitch angle"})
        for (int number : turbine.layout().blade_numbers) all.push_back(text("blade ", number, what));
    const std::vector<ChannelGroup> groups = turbines::channels(turbine);
    const auto missing = [&](const std::string& name) {
        return std::ranges::none_of(groups, [&](const ChannelGroup& group) {
            return std::ranges::any_of(group.channels,
                                       [&](const Channel& c) { return c.name == name || c.alias == name; });
        });
    };
    std::erase_if(all, missing);
    return all;
}

/// Which steady state a model is linearised about.
enum class LinearisedAbout : std::uint8_t {
    constant,  ///< but for the azimuth
    periodic,
    automatic  ///< constant where there is one
};

/// About a steady state, periodic or constant but for the azimuth.
/// @param more  inputs and outputs beside the usual ones
template <class State>
solvers::LinearModel linearise_about(const turbines::Turbine& turbine, const LinearModelArguments& a,
                                     const State& state, solvers::RotorSpin spin,
                                     const std::vector<solvers::LinearInput>& more_inputs = {},
                                     const std::vector<ChannelGroup>& more_outputs = {}) {
    solvers::StateSpaceOptions options;
    options.azimuths = a.azimuths;
    options.outputs = linear_outputs(turbine);
    options.spin = spin;
    std::vector<solvers::LinearInput> inputs = linear_inputs(turbine, spin == solvers::RotorSpin::free);
    inputs.insert(inputs.end(), more_inputs.begin(), more_inputs.end());
    std::vector<ChannelGroup> channels = channels_of(turbine, a.stations);
    channels.insert(channels.end(), more_outputs.begin(), more_outputs.end());
    const auto ask_for = [&](const std::vector<ChannelGroup>& groups) {
        for (const ChannelGroup& group : groups)
            for (const Channel& channel : group.channels) options.outputs.push_back(channel.name);
    };
    ask_for(station_channels(turbine, a.stations));
    ask_for(more_outputs);
    return solvers::state_space(turbine.system(), turbine.rotor(), state, inputs, channels, options);
}

/// At the rotor speed, rad/s.
/// @throws InputError, NumericalError as the solvers do
inline solvers::LinearModel linearise(const turbines::Turbine& turbine, const LinearModelArguments& a,
                                      double rotor_speed, solvers::RotorSpin spin, LinearisedAbout about) {
    // Before the equilibrium is sought, which takes long.
    solvers::check_number_of_unknowns(turbine.rotor().machine, turbine.system().model.coordinates().free().size());
    const auto about_periodic = [&] {
        return linearise_about(turbine, a, steady_rotation(turbine, rotor_speed, a.harmonics), spin);
    };
    if (about == LinearisedAbout::periodic && rotor_speed != 0) return about_periodic();
    solvers::SteadyOptions steady;
    steady.rotor_speed = rotor_speed;
    solvers::SteadyState state;
    try {
        state = solvers::steady_state(turbine.system(), turbine.rotor().spin, steady);
        require_result(state);
    } catch (const NumericalError&) {
        if (about == LinearisedAbout::constant || rotor_speed == 0) throw;
        return about_periodic();
    }
    return linearise_about(turbine, a, state.at, spin);
}

/// The branch of a diagram whose eigenvalue at the last point is nearest to a pole, and nearly equal; null: none.
inline const solvers::Branch* branch_of(const solvers::Campbell& diagram, const Complex& pole) {
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

/// Modes of a constant model beside those of a Campbell diagram's last point; none: alone.
inline void print_modes(const solvers::ConstantModel& model, const std::optional<solvers::Campbell>& diagram,
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

/// Sizes of inputs and outputs, so that newtons do not outweigh radians.
struct SignalSizes {
    Vector input, output;
};

inline solvers::BalancedModel balanced(const solvers::ConstantModel& fixed, const LinearModelArguments& a,
                                       const SignalSizes& sizes) {
    solvers::BalancedOptions options;
    options.order = a.order;
    if (a.order == 0) options.error = a.error / 100;
    options.max_frequency_hz = a.max_frequency;
    options.static_gain = solvers::StaticGain::kept;
    options.input_size = sizes.input;
    options.output_size = sizes.output;
    return solvers::balanced_truncation(fixed, options);
}

/// Which inputs and outputs a small model serves is seen here.
inline void print(const solvers::ConstantModel& fixed, const solvers::BalancedModel& small, double max_frequency) {
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

/// Sizes of a model, and how far multi-blade coordinates leave it periodic.
inline void introduce(const solvers::LinearModel& model, double rpm, const solvers::MultiBladeModel* fixed) {
    std::printf("%s at %g rpm: %zu states, %zu inputs, %zu outputs, %zu azimuths\n", model.machine.c_str(), rpm,
                model.states.size(), model.inputs.size(), model.outputs.size(), model.samples.size());
    if (fixed)
        std::printf("periodic remainder of the multi-blade matrices, relative: A %.1e, B %.1e, C %.1e, D %.1e\n",
                    fixed->A_remainder, fixed->B_remainder, fixed->C_remainder, fixed->D_remainder);
    std::printf("estimated error of C and D, relative: %.1e\n\n", model.output_error.maxCoeff());
}

/// PREFIX.h5, PREFIX.mat, PREFIX.1.lin, ...
inline void write_files(const solvers::LinearModel& model, const std::vector<solvers::NamedModel>& constant,
                        const std::string& prefix) {
    solvers::write_hdf5(model, constant, prefix + ".h5");
    solvers::write_mat(model, constant, prefix + ".mat");
    const auto files = solvers::write_lin(model, prefix);
    std::printf("\nfiles: %s.h5, %s.mat, %s ... %zu files\n", prefix.c_str(), prefix.c_str(),
                files.front().string().c_str(), files.size());
}

}  // namespace cardan::program
