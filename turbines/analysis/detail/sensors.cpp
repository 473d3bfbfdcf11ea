#include "turbines/analysis/detail/sensors.hpp"

#include "turbines/model/channels.hpp"

namespace cardan::turbines {

Sensors::Sensors(const Turbine& turbine, const std::vector<ChannelGroup>& also)
    : turbine_(turbine), groups_(channels(turbine)) {
    groups_.insert(groups_.end(), also.begin(), also.end());
    std::size_t count = 0;
    for (const ChannelGroup& group : groups_)
        for (const Channel& channel : group.channels) {
            if (!channel.alias.empty()) places_[channel.alias] = count;
            ++count;
        }
    values_.resize(count);
}

void Sensors::measure(const DynamicView& in) {
    double* values = values_.data();
    for (const ChannelGroup& group : groups_) {
        group.sample(in, values);
        values += group.channels.size();
    }
    const FrameId top = turbine_.layout().tower_top;
    const int body = in.kinematics.model().frame(top).body;
    nodding_ = body < 0 ? 0
                        : pose(in.kinematics, top)
                              .R.col(1)
                              .dot(in.loads().motion[static_cast<std::size_t>(body)].angular_acceleration);
}

double Sensors::at(const std::string& alias) const {
    const auto place = places_.find(alias);
    return place == places_.end() ? 0 : values_[place->second];
}

BladedController::Measured measured(const Sensors& sensors, const MachineLayout& layout) {
    BladedController::Measured now;
    now.generator_speed = sensors.at("GenSpeed");
    now.rotor_speed = sensors.at("RotSpeed");
    now.azimuth = sensors.at("Azimuth");
    now.yaw = sensors.at("NacYaw");
    now.wind_speed = sensors.at("HorWindV");
    now.tower_acceleration = sensors.at("YawBrTAxp");
    now.nacelle_nodding = sensors.nodding();
    for (std::size_t k = 0; k < layout.blade_numbers.size() && k < 3; ++k) {
        const int number = layout.blade_numbers[k];
        now.pitch.at(k) = sensors.at(text("BldPitch", number));
        now.out_of_plane.at(k) = sensors.at(text("RootMyc", number));
        now.in_plane.at(k) = sensors.at(text("RootMxc", number));
    }
    return now;
}

double mean_pitch(const MachineLayout& layout, const Model& model, const Vector& q) {
    double sum = 0;
    for (std::size_t k = 0; k < layout.pitch.size(); ++k)
        sum += layout.pitch_settings[k] - q(model.index(layout.pitch[k]));
    return sum / static_cast<double>(layout.pitch.size());
}

}  // namespace cardan::turbines
