#include "turbines/analysis/detail/linear_forms.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "mbs/model/summary.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardan::turbines {

namespace {

// Largest change of any matrix from one azimuth to another, relative to its size at the first.
double variation(const solvers::LinearModel& model) {
    double max = 0;
    for (Matrix solvers::StateMatrices::*matrix : {&solvers::StateMatrices::A, &solvers::StateMatrices::B,
                                                   &solvers::StateMatrices::C, &solvers::StateMatrices::D}) {
        const Matrix& first = model.samples.front().*matrix;
        for (const solvers::LinearSample& sample : model.samples)
            max = std::max(max, (sample.*matrix - first).norm() / std::max(first.norm(), 1e-300));
    }
    return max;
}

LinearForm form_of(const solvers::LinearModel& model, const TurbineDescription& machine) {
    constexpr double rounding = 1e-7;  // of C and D, which come from differences
    if (machine.has_equal_blades()) return LinearForm::multi_blade;
    return model.samples.size() == 1 || variation(model) < rounding ? LinearForm::constant : LinearForm::periodic;
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

// Sizes of inputs and outputs, so that newtons do not outweigh radians: a hundredth of the weight above the tower, as
// force and, a tenth of the rotor's radius beside it, as moment.
void set_sizes(solvers::BalancedOptions& options, const solvers::ConstantModel& model, const Turbine& turbine,
               const TurbineDescription& machine) {
    double mass = 0;
    for (const PartMass& part : masses_by_part(turbine.tree()))
        if (part.part != "tower" && part.part != "platform") mass += part.mass;
    const double radius = machine.hub.radius + (machine.blades > 0 ? machine.blade.line.length : 0);
    const double force = 0.01 * mass * units::standard_gravity, moment = 0.1 * radius * force;
    const auto size = [&](const solvers::Signal& signal, double other) {
        if (signal.name == "generator torque") return moment / turbine.layout().gear_ratio;
        return signal.units == "N" ? force : signal.units == "N m" ? moment : other;
    };
    options.input_size.resize(model.B.cols());
    options.output_size.resize(model.C.rows());
    for (Eigen::Index i = 0; i < model.B.cols(); ++i) options.input_size(i) = size(entry(model.inputs, i), 1);
    for (Eigen::Index i = 0; i < model.C.rows(); ++i) options.output_size(i) = size(entry(model.outputs, i), 0.01);
}

// The small model, or why there is none.
void add_balanced(MachineLinearModel& linear, const TurbineDescription& description) {
    const LinearModelSettings& s = linear.settings;
    if (!s.balanced) {
        linear.no_balanced = "it was not asked for";
        return;
    }
    const solvers::ConstantModel& whole = linear.constant.back().model;
    solvers::BalancedOptions options;
    options.order = s.order;
    if (s.order == 0) options.error = s.error;
    options.max_frequency_hz = *s.max_frequency_hz;
    options.static_gain = solvers::StaticGain::kept;
    set_sizes(options, whole, linear.turbine, description);
    try {
        linear.balanced = solvers::balanced_truncation(whole, options);
        linear.constant.push_back({"balanced", static_cast<const solvers::ConstantModel&>(*linear.balanced)});
    } catch (const NumericalError& error) {
        linear.no_balanced = error.what();
    }
}

}  // namespace

void add_constant_forms(MachineLinearModel& linear, const TurbineDescription& description) {
    linear.form = form_of(linear.model, description);
    if (linear.form == LinearForm::periodic) {
        linear.constant.push_back({"frozen", frozen(linear.model, linear.settings.azimuth)});
        linear.no_balanced = "the model is periodic";
        return;
    }
    if (linear.form == LinearForm::multi_blade) {
        linear.multi_blade = solvers::multi_blade(linear.model, linear.turbine.rotor());
        linear.constant.push_back({"multi_blade", static_cast<const solvers::ConstantModel&>(*linear.multi_blade)});
    } else {
        linear.constant.push_back({"constant", solvers::at_sample(linear.model, 0)});
    }
    add_balanced(linear, description);
}

}  // namespace cardan::turbines
