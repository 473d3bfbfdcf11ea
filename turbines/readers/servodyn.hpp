/// @file
/// Structure and rotor speed of ServoDyn's files.
#pragma once

#include "turbines/readers/turbine_file.hpp"

#include <filesystem>
#include <optional>

namespace cardan::turbines {

struct ServoDyn {
    JointSupport yaw = rigid_joint;  ///< spring and damper of the yaw drive
    /// Rated speed of the generator on its own shaft, rad/s; 0: not given. That of the torque law (VS_RtGnSp), of an
    /// induction generator at rated slip (SIG_SySp) or without slip (TEC_Freq, TEC_NPol), or of a ROSCO controller
    /// (PC_RefSpd of DLL_InFile). A number that three or more entries of generators have is a placeholder and not
    /// given.
    double rated_generator_speed = 0;
    double min_generator_speed = 0;  ///< that of an induction generator without slip
    std::string speed_source;        ///< the keyword and its file
    /// Below rated power, leading edge upwind, rad, of a ROSCO controller (PC_FinePit); none: not given.
    std::optional<double> fine_pitch;
    std::vector<PitchAt> pitch_schedule;  ///< by speed of the rotor, of such a controller (PS_BldPitchMin)
    std::string pitch_source;
    ModelController controller = {};  ///< library, input and period if it acts (PCMode or VSContrl 5)
    std::vector<FileNote> notes;
    std::string source;  ///< text of the file
    /// Operation: rated power of a ROSCO controller, else that of the torque law (VS_RtTq at VS_RtGnSp) or of an
    /// induction generator (SIG_RtTq at rated slip), on the generator's shaft.
    FileOperation operation = {};
};

/// A file of ServoDyn, or the main file of FAST 7, which has the same entries.
/// @throws ParseError, FileError; also for the file of a ROSCO controller
ServoDyn read_servodyn(const std::filesystem::path& path);

}  // namespace cardan::turbines
