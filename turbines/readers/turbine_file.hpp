/// @file
/// What the readers of model files return: a description, and a note on everything in the files that it does not hold.
#pragma once

#include "turbines/model/description.hpp"

#include <vector>

namespace cardan::turbines {

/// An entry of a model file that has no part in the description, or another one than in the program it was made for.
/// Entries without meaning for the structure (output, solver settings, aerodynamics) come as one note per group: their
/// keywords are listed, line and value are those of none.
struct FileNote {
    std::string file;
    int line = 0;  ///< 0: none
    std::string keyword;
    std::string value;
    std::string why;
};

/// "file:12: NacYaw = 3: the nacelle points into the wind here"
std::string to_text(const FileNote& note);

/// Freedoms of the machine that a file may switch off (ElastoDyn's flags); the description does not tell them.
struct FileFreedoms {
    bool generator = true;  ///< false: the rotor turns at its speed, whatever happens (RotorSpin::prescribed)
    /// False: rigid (CardanBeamOptions::held_z of the tower, held_y of the tower, both of the blades).
    bool tower_fore_aft = true, tower_side_side = true, blades = true;
};

/// A machine read from files.
struct TurbineFile {
    TurbineDescription description;
    FileFreedoms freedoms = {};
    /// Of the yaw drive, also where the files have the yaw bearing locked and the description has it rigid; rigid: they
    /// give no spring.
    Spring yaw_drive = rigid_joint;
    std::vector<FileNote> notes;
    double rotor_speed = 0;  ///< rated or initial rotor speed, rad/s; 0: the files name none
    double pitch = 0;        ///< pitch setting of the blades, leading edge upwind, rad
};

}  // namespace cardan::turbines
