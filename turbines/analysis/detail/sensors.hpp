/// @file
/// Sensors of a controller. Internal to the room.
#pragma once

#include "elements/controllers/bladed_controller.hpp"
#include "mbs/system/channel.hpp"
#include "solvers/time/sampled.hpp"
#include "turbines/model/assembly.hpp"

#include <map>
#include <string>
#include <vector>

namespace cardan::turbines {

/// Channels of a machine at a sample, by their names in OpenFAST.
class Sensors {
public:
    /// @param also  channels beside those of any machine
    Sensors(const Turbine& turbine, const std::vector<ChannelGroup>& also);

    void measure(const DynamicView& in);
    /// Zero, of what the machine does not have.
    double at(const std::string& alias) const;
    /// Angular acceleration of the nacelle, rad/s^2.
    double nodding() const { return nodding_; }

private:
    Turbine turbine_;
    std::vector<ChannelGroup> groups_;
    std::map<std::string, std::size_t> places_;
    std::vector<double> values_;
    double nodding_ = 0;
};

/// Measurements for a library in Bladed's style; without time, torque and power of the generator.
BladedController::Measured measured(const Sensors& sensors, const MachineLayout& layout);

/// Mean pitch of the blades, toward feather, rad.
double mean_pitch(const MachineLayout& layout, const Model& model, const Vector& q);

}  // namespace cardan::turbines
