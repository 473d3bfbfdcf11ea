// Channels of a turbine at one state, by name and alias; a blade's mass moments and axes by hand.
#pragma once

#include "mbs/base/error.hpp"
#include "solvers/time/recorder.hpp"
#include "turbines/model/channels.hpp"

#include <Eigen/Geometry>

#include <map>

namespace cardan::testing {

/// Position, rates and accelerations of all coordinates.
struct MachineState {
    Vector q, qd, qdd;
    explicit MachineState(const turbines::Turbine& turbine)
        : q(Vector::Zero(turbine.system().model.size())), qd(q), qdd(q) {}
};

class Sampled {
public:
    Sampled(const System& system, const std::vector<ChannelGroup>& groups, const MachineState& at) {
        Workspace workspace(system.model);
        const Kinematics kin = kinematics(system.model, at.q, workspace);
        const JointLoads loads = joint_loads(kin, system.forces, at.qd, at.qdd);
        const Vector none = Vector::Zero(at.q.size());
        for (const ChannelGroup& group : groups) {
            std::vector<double> own(group.channels.size());
            group.sample({0, at.q, at.qd, at.qdd, none, kin, system.forces, loads}, own.data());
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

/// Mass of a straight blade and its first moment about the root, in axes x downwind, y toward the trailing edge, z to
/// the tip at zero pitch: Simpson's rule between the stations, exact for linear mass times linear offset.
struct BladeMoments {
    double mass = 0;
    Vec3 first = Vec3::Zero();

    explicit BladeMoments(const BeamLine& line) {
        std::vector<double> ends = line.breaks;
        ends.insert(ends.begin(), 0);
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
                first += weight * section.mass * Vec3(section.centre.z(), -section.centre.y(), x);
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
