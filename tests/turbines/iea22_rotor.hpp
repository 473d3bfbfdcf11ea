// The IEA 22 MW machine from its public files, as its published states and modes are computed: level, all but the
// blades rigid. The files are no part of these sources: CARDAN_MODELS names a folder that holds their repository.
#pragma once

#include "turbines/readers/aerodyn.hpp"
#include "turbines/readers/openfast.hpp"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

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

}  // namespace cardan::testing
