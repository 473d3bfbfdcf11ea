/// @file
/// Robots described in URDF as trees, and trees as URDF. Target cardan::urdf; the guide is docs/urdf.md.
///
/// URDF and Cardan place the joint differently. The frame of a URDF link is the joint frame turned by the joint, and
/// the axis is any unit vector in it; the frame of a Cardan body has z along its axis. A link whose axis is not z
/// becomes a body named after its joint and a frame on it named after the link, and its inertia is welded to that
/// frame. So `tree.frame("link name")` is the frame of the URDF link in every case.
#pragma once

#include "mbs/loops/loop_set.hpp"
#include "mbs/model/tree.hpp"
#include "mbs/system/forces.hpp"

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cardan {

/// A URDF `<mimic>`: coordinate = multiplier * other coordinate + offset. Not applied to the tree, whose
/// coordinates are independent: mimic_couplings().
struct UrdfMimic {
    std::string joint = {};  ///< name of the other joint
    double multiplier = 1;
    double offset = 0;  ///< rad or m
};

/// Data of a joint that URDF has and a Tree has not. An infinite limit means none.
struct UrdfJoint {
    std::string coordinate = {};                                ///< name of the coordinate
    double lower = -std::numeric_limits<double>::infinity();    ///< rad or m
    double upper = std::numeric_limits<double>::infinity();     ///< rad or m
    double velocity = std::numeric_limits<double>::infinity();  ///< largest speed, rad/s or m/s
    double effort = std::numeric_limits<double>::infinity();    ///< largest drive torque or force, N m or N
    double damping = 0;                                         ///< viscous, N m s/rad or N s/m
    double friction = 0;                                        ///< Coulomb, N m or N
    std::optional<UrdfMimic> mimic = {};
};

/// A robot read from URDF.
struct UrdfModel {
    std::string robot_name = {};
    Tree tree = {};                       ///< the root link is the base
    std::vector<UrdfJoint> joints = {};   ///< one per coordinate, joints[i] belongs to BodyId{i}
    std::vector<std::string> notes = {};  ///< what was passed over, ignored or renamed, "<source>:<line>: ..."
};

/// Reads a URDF file through urdfdom. Calls from several threads take turns; nothing is printed.
///
/// Revolute, continuous and prismatic joints become one coordinate with the name of the joint; floating joints six
/// ("<joint> translation x" ... "<joint> rotation z", about body-fixed x, y, z in this order), planar joints three
/// ("<joint> translation x", "... y", "<joint> rotation", in the plane whose normal is the axis), on massless
/// intermediate bodies. A fixed link becomes a frame with its name, and its inertia is welded there. Coordinates,
/// bodies and frames follow the order of the joints in the file, except that parents precede children.
/// @throws FileError if the file cannot be read, ParseError if it is not UTF-8 text, InputError ("<file>:<line>: ...")
/// if it is not XML or not URDF, if the links do not form a tree, if a value is not a finite number, if an axis is
/// zero, if an inertia is impossible, or if a link at the end of a branch moves and nothing there has an inertia.
[[nodiscard]] UrdfModel read_urdf(const std::filesystem::path& file);
/// Reads URDF text; `source_name` stands for the file in messages.
[[nodiscard]] UrdfModel parse_urdf(std::string_view xml, std::string_view source_name = "URDF text");

/// Dampers with the viscous damping of the joints, named "<coordinate> damping". (Coulomb friction has no law.)
/// @throws InputError if the tree has no such coordinate or a damping is negative
[[nodiscard]] ForceSet joint_damping(const Tree& tree, const std::vector<UrdfJoint>& joints);

/// Constraints of mimicking joints, as couplings "<coordinate> mimics <joint>" for System's loops.
/// @throws InputError if the tree has no such coordinate, or a joint mimics itself
[[nodiscard]] LoopSet mimic_couplings(const Tree& tree, const std::vector<UrdfJoint>& joints);

/// Data that are written in addition to the tree.
struct UrdfExport {
    std::string robot_name = "cardan";
    std::vector<UrdfJoint> joints = {};  ///< for some or all coordinates; the others have no limits and no damping
};

/// A tree as URDF text. Every body is a link of its name on a joint about or along its z with the name of the
/// coordinate; every frame is a massless link on a fixed joint; inertias that were welded under a part name of their
/// own are links on fixed joints, carried by the frame with the name of the part if there is one. Numbers are written
/// with enough digits to be read back exactly. What URDF cannot express is listed in a comment at the top, see
/// urdf_losses().
/// @throws InputError if joint data name no coordinate or one twice, or are impossible; if a name cannot stand in XML
[[nodiscard]] std::string to_urdf(const Tree& tree, const UrdfExport& with = {});
/// Lists what is lost in the conversion to URDF: armatures, added masses, roles and parts of coordinates, reduced
/// inertias, missing limits.
[[nodiscard]] std::vector<std::string> urdf_losses(const Tree& tree, const UrdfExport& with = {});
/// Writes to_urdf() to a file, which is called "<file>.partial" until it is complete.
/// @throws FileError if it cannot be written, and what to_urdf() throws
void write_urdf(const std::filesystem::path& file, const Tree& tree, const UrdfExport& with = {});

}  // namespace cardan
