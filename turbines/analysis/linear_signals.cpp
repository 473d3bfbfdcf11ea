#include "turbines/analysis/linear_signals.hpp"

#include "mbs/base/error.hpp"
#include "turbines/model/channels.hpp"

#include <algorithm>

namespace cardan::turbines {

std::vector<solvers::LinearInput> linear_inputs(const Turbine& turbine, solvers::RotorSpin spin) {
    using solvers::LinearInput;
    const MachineLayout& layout = turbine.layout();
    const Model& model = turbine.system().model;
    const auto is_free = [&](BodyId body) {
        return model.coordinates()[model.index(body)].role == CoordinateRole::free;
    };
    std::vector<LinearInput> list;
    if (spin == solvers::RotorSpin::free)
        list.push_back(
            LinearInput::generalised_force("generator torque", {{turbine.rotor().spin, -layout.gear_ratio}}));
    if (layout.yaw && is_free(*layout.yaw))
        list.push_back(LinearInput::generalised_force("yaw moment", {{model.index(*layout.yaw), 1.0}}));
    list.push_back(LinearInput::force("thrust", layout.hub, Vec3::UnitZ(), WrenchAxes::frame));
    list.push_back(LinearInput::moment("rotor torque", layout.hub, Vec3::UnitZ(), WrenchAxes::frame));
    for (std::size_t k = 0; k < layout.pitch.size(); ++k)
        if (is_free(layout.pitch[k]))
            list.push_back(LinearInput::generalised_force(text("blade ", layout.blade_numbers[k], " pitch moment"),
                                                          {{model.index(layout.pitch[k]), -1.0}}));
    return list;
}

std::vector<std::string> linear_outputs(const Turbine& turbine) {
    std::vector<std::string> all{"GenSpeed",  "RotSpeed",  "RotTorq", "RotTeetP", "TTDspFA",  "TTDspSS",
                                 "YawBrTAxp", "YawBrTAyp", "NacYaw",  "TwrBsMxt", "TwrBsMyt", "TwrBsMzt"};
    for (const char* what : {" root moment x", " root moment y", " pitch angle"})
        for (int number : turbine.layout().blade_numbers) all.push_back(text("blade ", number, what));
    const std::vector<ChannelGroup> groups = channels(turbine);
    const auto missing = [&](const std::string& name) {
        return std::ranges::none_of(groups, [&](const ChannelGroup& group) {
            return std::ranges::any_of(group.channels,
                                       [&](const Channel& c) { return c.name == name || c.alias == name; });
        });
    };
    std::erase_if(all, missing);
    return all;
}

std::vector<solvers::LinearInput> named_inputs(std::vector<solvers::LinearInput> all,
                                               const std::vector<std::string>& names) {
    if (names.empty()) return all;
    std::vector<solvers::LinearInput> chosen;
    chosen.reserve(names.size());
    for (const std::string& name : names) {
        const auto found = std::ranges::find(all, name, &solvers::LinearInput::name);
        if (found == all.end()) {
            std::string allowed;
            for (const solvers::LinearInput& one : all) allowed += text(allowed.empty() ? "" : ", ", one.name());
            throw InputError("LinearModelSettings::inputs", "name", name, allowed);
        }
        chosen.push_back(*found);
    }
    return chosen;
}

}  // namespace cardan::turbines
