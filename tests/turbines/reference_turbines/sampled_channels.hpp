// Channels of a turbine at one state, by name and alias; random states; a blade's mass moments and axes by hand.
#pragma once

#include "mbs/base/error.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/support/random_tree.hpp"
#include "turbines/model/channels.hpp"

#include <Eigen/Geometry>

#include <map>

namespace cardan::testing {

/// A state of a machine, at first at rest.
struct MachineState : DynamicState {
    explicit MachineState(const turbines::Turbine& turbine) : DynamicState(at_rest(turbine.system().model.size())) {
        actuator = Vector::Zero(q.size());
    }
};

class Sampled {
public:
    Sampled(const System& system, const std::vector<ChannelGroup>& groups, const MachineState& at) {
        Workspace workspace(system.model);
        const DynamicView view(at, kinematics(system.model, at.q, workspace), system.forces, system.loops);
        for (const ChannelGroup& group : groups) {
            std::vector<double> own(group.channels.size());
            group.sample(view, own.data());
            for (std::size_t i = 0; i < own.size(); ++i) {
                values[group.channels[i].name] = own[i];
                if (!group.channels[i].alias.empty()) aliases[group.channels[i].alias] = own[i];
            }
        }
    }
    Sampled(const turbines::Turbine& turbine, const MachineState& at)
        : Sampled(turbine.system(), turbines::channels(turbine), at) {}

    double operator[](const std::string& name) const {
        const auto alias = aliases.find(name);
        if (alias != aliases.end()) return alias->second;
        const auto found = values.find(name);
        if (found == values.end()) throw Error(text("no channel ", name));
        return found->second;
    }
    /// Three channels that end in x, y, z and something.
    Vec3 vector(const std::string& stem, const std::string& end) const {
        return {(*this)[stem + "x" + end], (*this)[stem + "y" + end], (*this)[stem + "z" + end]};
    }

    std::map<std::string, double> values, aliases;
};

/// A random state in consistent motion under the machine's forces, but for coordinates that are at rest at zero.
inline MachineState in_motion(const turbines::Turbine& turbine, unsigned seed,
                              const std::vector<std::string>& at_rest = {}) {
    Random random(seed);
    MachineState state(turbine);
    const Model& model = turbine.system().model;
    for (int i = 0; i < model.size(); ++i) {
        state.q(i) = (model.body(i).revolute ? 0.02 : 0.001) * uniform(random, -1, 1);
        state.qd(i) = 0.05 * uniform(random, -1, 1);
    }
    state.q(turbine.rotor().spin) = 0.9 + seed;
    state.qd(turbine.rotor().spin) = 2.9;
    for (const std::string& name : at_rest) state.q(model.index(name)) = state.qd(model.index(name)) = 0;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, state.q, workspace);
    Vector Q(model.size()), actuator(model.size());
    turbine.system().forces.generalised_forces({state, kin}, Q);
    ForwardDynamics(model).solve(kin, state.qd, Q, state.qdd, actuator);
    return state;
}

/// Mass of a straight blade, or of what is beyond a place on it, and its first moment about the root or that place, in
/// axes x downwind, y toward the trailing edge, z to the tip at zero pitch: Simpson's rule between the stations, exact
/// for linear mass times linear offset.
struct BladeMoments {
    double mass = 0;
    Vec3 first = Vec3::Zero();

    explicit BladeMoments(const BeamLine& line, double from = 0) {
        std::vector<double> ends{from};
        for (const double x : line.breaks)
            if (x > from) ends.push_back(x);
        ends.push_back(line.length);
        for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
            constexpr int steps = 64;  // the twist turns the offsets: not polynomial
            const double h = (ends[i + 1] - ends[i]) / steps;
            if (h <= 0) continue;
            for (int k = 0; k <= steps; ++k) {
                const double x = std::clamp(ends[i] + k * h, ends[i] + 1e-12, ends[i + 1] - 1e-12);
                const double weight = h / 3 * (k == 0 || k == steps ? 1 : k % 2 == 1 ? 4 : 2);
                const BeamSection section = line.section(x);
                mass += weight * section.mass;
                first += weight * section.mass * Vec3(section.centre.z(), -section.centre.y(), x - from);
            }
        }
    }
};

/// Axes of a blade on a straight machine in ground axes, the columns x, y, z of OpenFAST's blade axes.
/// @param pitch  toward feather: about minus z
inline Mat3 blade_axes(double tilt, double azimuth, double pitch) {
    const Vec3 shaft(std::cos(tilt), 0, -std::sin(tilt)), up(std::sin(tilt), 0, std::cos(tilt));
    const Vec3 z = std::cos(azimuth) * up + std::sin(azimuth) * shaft.cross(up), trailing = -shaft.cross(z);
    const Mat3 turned = Eigen::AngleAxisd(-pitch, z).toRotationMatrix();
    return (Mat3() << turned * shaft, turned * trailing, z).finished();
}

}  // namespace cardan::testing
