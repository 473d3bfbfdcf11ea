// The IEA 22 MW machine from its public files, as its published states and modes are computed: level, all but the
// blades rigid. The files are no part of these sources: CARDAN_MODELS names a folder that holds their repository.
#pragma once

#include "turbines/readers/aerodyn.hpp"
#include "turbines/readers/openfast.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace cardan::testing {

struct Iea22Rotor {
    turbines::TurbineDescription description;
    turbines::AeroDynFile air;
};
/// None without the files.
inline std::optional<Iea22Rotor> iea22_rotor() {
    const char* const models = std::getenv("CARDAN_MODELS");
    if (models == nullptr) return std::nullopt;
    const std::filesystem::path folder = std::filesystem::path(models) / "IEA-22-280-RWT" / "IEA-22-280-RWT-Monopile";
    turbines::TurbineDescription d = turbines::read_openfast(folder / "IEA-22-280-RWT-Monopile.fst").description;
    d.nacelle.tilt = 0;
    d.tower.rigid = true;
    d.yaw.rotation = d.drive_train.main_shaft = turbines::rigid_joint;
    turbines::AeroDynFile air = turbines::read_aerodyn(folder / "IEA-22-280-RWT_AeroDyn15.dat", d.hub.radius);
    return Iea22Rotor{std::move(d), std::move(air)};
}

/// Twenty equal elements, the last one divided: toward the tip the torsional stiffness falls to a thousandth, and an
/// element twists in its middle. By ten undivided ones the tip is twisted 7 to 9 % too much, by twenty up to 3 %, by
/// these within 0.3 %; elsewhere on the blade ten are off by 1 %.
inline CardanBeamOptions iea22_blade_elements(const turbines::TurbineDescription& description) {
    constexpr int equal = 20;
    const double length = description.blade.line.length;
    CardanBeamOptions options{.partition = Partition::mean_difference, .extension = true};
    for (int i = 0; i < equal; ++i) options.boundaries.push_back(length * i / equal);
    for (double end : {0.98, 1.0}) options.boundaries.push_back(length * end);
    options.elements = static_cast<int>(options.boundaries.size()) - 1;
    return options;
}

/// Twist by elasticity, rad: a section is turned about x of the pitched root (downwind), then about its y, at last
/// about its own z, along the span; the last of these angles. It is the one that fits the published twist all along the
/// blade at all winds. The rotation vector's part along the root's axis, which is BeamDyn's own output but for the
/// length of its parameters, is smaller by 6 % where the tip moves by 20 m.
/// @param turned  rotation of the section from rest in beam axes of the root: x outward, z downwind
inline double iea22_twist(const Mat3& turned) {
    return std::atan2(turned(2, 1), turned(2, 2));
}

}  // namespace cardan::testing
