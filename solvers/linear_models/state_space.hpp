/// @file
/// A machine linearised about its steady state, for the design of controllers: states, inputs, outputs.
#pragma once

#include "mbs/model/rotor_map.hpp"
#include "mbs/system/channel.hpp"
#include "mbs/system/system.hpp"
#include "solvers/linear/rotor_spin.hpp"
#include "solvers/linear_models/linear_model.hpp"
#include "solvers/periodic/steady_state.hpp"

#include <utility>

namespace cardan::solvers {

/// Input that acts on the machine from outside, as deviation from the steady state.
class LinearInput {
public:
    enum class Kind : std::uint8_t { generalised_force, force, moment, motion, system_input };
    /// Coordinates (index in the model) with factors.
    using Coordinates = std::vector<std::pair<int, double>>;

    /// Adds factor * u to the generalised force on each coordinate: a generator's torque with minus the gear ratio on
    /// the spin coordinate (positive: brakes), a yaw moment, a pitch drive. N m, or N on translations; all coordinates
    /// of one input, here and below, must have the same unit.
    static LinearInput generalised_force(std::string name, Coordinates coordinates);
    /// A force (N) or moment (N m) of size u at the origin of a frame, along a direction that is constant in the base
    /// axes (dead load) or in those of the frame (follower load). The direction is not normalised and acts as a factor.
    /// Such loads are included in the joint loads.
    static LinearInput force(std::string name, FrameId frame, const Vec3& direction, WrenchAxes axes);
    static LinearInput moment(std::string name, FrameId frame, const Vec3& direction, WrenchAxes axes);
    /// Prescribed motion factor * u of coordinates, which are then not states. Creates three inputs: `name`, "name
    /// rate", "name acceleration"; the user must keep them derivatives of one another.
    static LinearInput motion(std::string name, Coordinates coordinates);
    /// Acceleration as a single input, "name acceleration"; position and rate of each coordinate become states.
    static LinearInput acceleration(std::string name, Coordinates coordinates);
    /// An input of the system's elements with states (Forces::inputs()), of the same name.
    static LinearInput system_input(std::string name);

    Kind kind() const { return kind_; }
    const std::string& name() const { return name_; }
    const Coordinates& coordinates() const { return coordinates_; }
    FrameId frame() const { return frame_; }
    const Vec3& direction() const { return direction_; }
    WrenchAxes axes() const { return axes_; }
    bool with_states() const { return with_states_; }

private:
    LinearInput(Kind kind, std::string name) : kind_(kind), name_(std::move(name)) {}

    Kind kind_;
    std::string name_;
    Coordinates coordinates_;
    FrameId frame_ = {};
    Vec3 direction_ = Vec3::Zero();
    WrenchAxes axes_ = WrenchAxes::base;
    bool with_states_ = false;
};

struct StateSpaceOptions {
    /// Free: the deviations of azimuth and rotor speed are states; the drive torque stays at its steady-state value.
    /// Prescribed: the rotor speed is constant.
    RotorSpin spin = RotorSpin::free;
    int azimuths = 24;  ///< per revolution; one is taken at standstill and without a rotor
    /// Names or aliases of the outputs wanted, in this order; empty: all channels.
    std::vector<std::string> outputs = {};
};

/// Linearises about a periodic steady state. The states are the deviations of the free coordinates and their rates,
/// plus or minus those that inputs add or remove, and of the states of first order; inputs of the system that are not
/// among `inputs` are held. A and B are exact (solvers/linear/linearise.hpp). C and D come from
/// central differences of the channels with two steps, extrapolated; positions, rates, accelerations and drive forces
/// follow the linear model, so that accelerations and loads have the correct feedthrough, and wrenches among the inputs
/// count as loads. A channel in rad may jump by 2 pi. Channels see the forces of the system.
///
/// Cost per azimuth O(n^3), and 4 evaluations of the channels per state and input.
/// @param rotor  its spin, number of blades and name are used; a machine without spin is linearised at one instant
/// @throws InputError for inputs without effect, duplicate names or coordinates, coordinates or frames that do not
/// exist, a coordinate moved by inputs of both kinds or both moved and loaded, an unknown output, too few azimuths, a
/// steady state that did not converge or of another system; NumericalError if a channel is not finite
LinearModel state_space(const System& system, const RotorMap& rotor, const PeriodicSteadyState& about,
                        const std::vector<LinearInput>& inputs, const std::vector<ChannelGroup>& outputs,
                        const StateSpaceOptions& options = {});

/// About a steady state that is constant except for the azimuth (SteadyState::at). This is not checked: see
/// LinearModel::imbalance.
LinearModel state_space(const System& system, const RotorMap& rotor, const DynamicState& about,
                        const std::vector<LinearInput>& inputs, const std::vector<ChannelGroup>& outputs,
                        const StateSpaceOptions& options = {});

/// The number k of a name that begins with "blade k ", else 0.
int blade_number(std::string_view name);

}  // namespace cardan::solvers
