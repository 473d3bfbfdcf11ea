/// @file
/// Builds the tree of a machine from the ground up; not installed.
#pragma once

#include "turbines/model/assembly.hpp"

namespace cardan::turbines {

struct PartDamping {
    BeamDamping tower;
    std::map<int, BeamDamping> blades;  ///< by their places
};

/// Adds the parts in order and remembers what the rotor map needs. The arguments must outlive the object.
class Assembler {
public:
    /// The description must have passed its check.
    /// @throws InputError for options out of range; the part is named
    Assembler(const TurbineDescription& description, const AssemblyOptions& options, const PartDamping& damping);

    // Call exactly one of these, once.
    void whole_machine();
    void one_blade(int number);
    void tower_alone(const RigidInertia& head);

    Tree tree;
    ForceSet forces;
    LoopSet loops;
    std::optional<BodyId> spin;  ///< none: no rotor
    bool hub_is_driven = false;  ///< see RotorMap
    int places = 0;              ///< for blades
    std::vector<BodyId> odd;     ///< see RotorMap
    std::vector<std::vector<BodyId>> blades;
    std::vector<std::array<BodyId, 2>> rotating_pairs;
    std::vector<PartAxes> parts;
    std::vector<Polyline> lines;
    std::vector<std::string> warnings;
    MachineLayout layout;

private:
    void check(const char* part, const std::optional<CardanBeamOptions>& beam) const;
    // The frame outboard of a joint; for a rigid one no joint is added.
    FrameId past_joint(FrameId carrier, JointKind kind, Axis axis, const std::string& name, const PartLabel& label,
                       const JointSupport& bearing);
    JointedFrame jointed(FrameId carrier, JointKind kind, Axis axis, const std::string& name, const PartLabel& label,
                         const JointSupport& bearing, const Vec3& offset = Vec3::Zero());
    void keep(const CardanBeam& beam) { warnings.insert(warnings.end(), beam.warnings.begin(), beam.warnings.end()); }

    void add_platform();
    FrameId add_tower();
    FrameId add_flexible_tower(FrameId foot);
    FrameId add_rigid_tower(FrameId foot);
    void add_tower_axes();
    FrameId add_yaw_and_nacelle(FrameId top);
    FrameId add_tilt(FrameId nacelle);
    FrameId add_generator_and_gearbox(FrameId shaft);
    FrameId add_drive_train(FrameId shaft);
    FrameId add_drive_train_with_beam(FrameId shaft);
    FrameId add_rotor_centre(FrameId carrier, const Placement& place);
    FrameId add_hub(FrameId rotor_centre);
    FrameId add_teeter(FrameId rotor_centre, const TeeterDescription& teeter);
    void add_blades(FrameId hub);
    CardanBeam add_blade_beam(FrameId root, int number, const BladeDescription& blade);
    void add_blade(FrameId hub, int number, const BladeDescription& blade, bool with_pitch_joint);
    BodyId add_linkage(FrameId pitch_axis, FrameId blade_side, int number, const PitchLinkage& linkage);
    FrameId add_pitch_axis(FrameId hub, int number, const BladeDescription& blade);

    const TurbineDescription& d_;
    const AssemblyOptions& options_;
    const PartDamping& damping_;
    FrameId foundation_ = Tree::base();  // what the tower stands on
};

}  // namespace cardan::turbines
