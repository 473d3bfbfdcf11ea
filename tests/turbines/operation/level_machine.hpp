// The NREL 5 MW machine as in the runs of OpenFAST that tests compare with: level, drive train and yaw bearing locked.
#pragma once

#include "turbines/reference_turbines/nrel5mw.hpp"

namespace cardan::testing {

inline turbines::TurbineDescription level_machine() {
    turbines::TurbineDescription d =
        turbines::nrel5mw_description(turbines::nrel5mw_options(turbines::Nrel5mwVariant::fast));
    d.nacelle.tilt = 0;
    d.yaw.rotation = d.drive_train.main_shaft = turbines::rigid_joint;
    return d;
}

}  // namespace cardan::testing
