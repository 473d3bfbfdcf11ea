/// @file
/// Builds the tree of a machine from the ground up; not installed.
#pragma once

#include "turbines/model/assembly.hpp"

namespace cardan::turbines {

struct PartDamping {
    BeamDamping tower, blade;
};

/// Adds the parts in order and remembers what the rotor map needs. The arguments must outlive the object.
class Assembler {
public:
    /// @throws InputError for data out of range; the part is named
    Assembler(const TurbineDescription& description, const AssemblyOptions& options, const PartDamping& damping);

    // Call exactly one of these, once.
    void whole_machine();
    void one_blade();
    void tower_alone(const RigidInertia& head);

    Tree tree;
    ForceSet forces;
    std::optional<BodyId> spin;  ///< none: no rotor
    FrameId hub_frame;
    std::vector<std::vector<BodyId>> blades;
    std::vector<std::array<BodyId, 2>> rotating_pairs;
    std::vector<PartAxes> parts;
    std::vector<Polyline> lines;
    std::vector<std::string> warnings;
    MachineLayout layout;

private:
    void check(const char* part, const std::optional<CardanBeamOptions>& beam) const;
    Spring spring(const Spring& s) const { return {s.stiffness, options_.joint_damping ? s.damping : 0.0}; }
    // The frame outboard of a joint with a spring; for a rigid joint no joint is added.
    FrameId past_joint(FrameId carrier, JointKind kind, Axis axis, const std::string& name, const PartLabel& label,
                       const Spring& law);
    JointedFrame sprung_joint(FrameId carrier, JointKind kind, Axis axis, const std::string& name,
                              const PartLabel& label, const Spring& law, const Vec3& offset = Vec3::Zero());
    void keep(const CardanBeam& beam) { warnings.insert(warnings.end(), beam.warnings.begin(), beam.warnings.end()); }

    void add_platform();
    FrameId add_tower();
    void add_tower_axes();
    FrameId add_yaw_and_nacelle(FrameId top);
    FrameId add_tilt(FrameId nacelle);
    FrameId add_generator_and_gearbox(FrameId shaft);
    FrameId add_drive_train(FrameId shaft);
    FrameId add_drive_train_with_beam(FrameId shaft);
    FrameId add_hub_frame(FrameId shaft, FrameId rotor_centre);
    void add_blade(FrameId hub, int number, bool with_pitch_joint);

    const TurbineDescription& d_;
    const AssemblyOptions& options_;
    const PartDamping& damping_;
    FrameId foundation_ = Tree::base();  // what the tower stands on
};

}  // namespace cardan::turbines
