/// @file
/// What ServoDyn's files say of the structure and of the speed at which it turns.
#pragma once

#include "turbines/readers/turbine_file.hpp"

#include <filesystem>
#include <optional>

namespace cardan::turbines {

struct ServoDyn {
    Bearing yaw = rigid_joint;  ///< spring and damper of the yaw drive
    /// Of the generator on its own shaft, rad/s; 0: not given. That of the torque law (VS_RtGnSp), of an induction
    /// generator at rated slip (SIG_SySp) or without slip (TEC_Freq, TEC_NPol), or of a ROSCO controller (PC_RefSpd of
    /// DLL_InFile).
    double rated_generator_speed = 0;
    std::string speed_source;  ///< the keyword and its file
    /// Below rated power, leading edge upwind, rad, of a ROSCO controller (PC_FinePit); none: not given.
    std::optional<double> fine_pitch;
    std::vector<PitchAt> pitch_schedule;  ///< by speed of the rotor, of such a controller (PS_BldPitchMin)
    std::string pitch_source;
    ModelController controller = {};  ///< library, input and period if it acts (PCMode or VSContrl 5)
    std::vector<FileNote> notes;
    std::string source;            ///< text of the file
    FileOperation operation = {};  ///< of a ROSCO controller
};

/// @throws ParseError, FileError
ServoDyn read_servodyn(const std::filesystem::path& path);

}  // namespace cardan::turbines
