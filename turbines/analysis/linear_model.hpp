/// @file
/// A linear model of a machine for the design of controllers: at a rotor speed, or at an operating point in the wind.
///
///     const turbines::Machine machine = turbines::read_machine("MODEL.fst");
///     const turbines::MachineLinearModel linear =
///         turbines::linear_model(machine, {.wind = 15, .inputs = {"wind speed"}, .outputs = {"RotSpeed", "TTDspFA"}});
///     solvers::write_hdf5(linear.model, linear.constant, "model.h5");
///
/// It is what `cardan linearise` computes, to the last digit.
#pragma once

#include "solvers/linear_models/linear_model.hpp"
#include "solvers/linear_models/model_reduction.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "turbines/analysis/settings.hpp"
#include "turbines/analysis/wind_run.hpp"
#include "turbines/machine/machine.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cardan::turbines {

/// Way in which a model becomes one with constant matrices.
enum class LinearForm : std::uint8_t {
    multi_blade,  ///< three and more equal blades: in multi-blade coordinates, averaged over the azimuth
    constant,     ///< it is constant as it is: standstill, no blades
    periodic      ///< it is not: two blades, or blades that differ
};

struct MachineLinearModel {
    solvers::LinearModel model;  ///< over the azimuth
    LinearForm form = LinearForm::constant;
    /// "multi_blade", "constant" or, of a periodic model, "frozen", the matrices at one azimuth, whose eigenvalues are
    /// not motions of the machine; and "balanced", a smaller one, except of a periodic model, and where there is none.
    std::vector<solvers::NamedModel> constant = {};
    std::optional<solvers::MultiBladeModel> multi_blade = {};  ///< with what varies over the azimuth
    std::optional<solvers::BalancedModel> balanced = {};       ///< with its errors
    std::string no_balanced = {};                              ///< why there is none
    Turbine turbine;                                           ///< that was linearised
    std::optional<WindRun> in_wind = {};                       ///< with the operating point
    LinearModelSettings settings = {};                         ///< with what was not given
    Mesh mesh = {};
    std::vector<Remark> remarks = {};  ///< what it had to say

    /// One of `constant`.  @throws InputError with the names there are
    const solvers::ConstantModel& constant_model(const std::string& name) const;
};

/// Linear model about the steady state, periodic where gravity or the wind make it so. In the wind its speed and the
/// collective pitch are inputs, and what the air does to the rotor is among the outputs.
/// @throws InputError for settings out of range, with the field, names of inputs and outputs that there are not, and
/// for what the machine does not have; NumericalError where no steady state is found
MachineLinearModel linear_model(const Machine& source, const LinearModelSettings& settings = {});

/// The model over the azimuth of a turbine that is assembled already, with loads of one's own; there is no wind.
/// @param settings  with a rotor speed and harmonics; those of the machine, the wind and constant forms are not used
solvers::LinearModel linearised(const Turbine& turbine, const LinearModelSettings& settings, solvers::RotorSpin spin);

}  // namespace cardan::turbines
