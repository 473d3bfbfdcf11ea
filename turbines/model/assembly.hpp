/// @file
/// Assembly of a system from a description: tower, yaw joint, nacelle, tilt joint, drive train, hub, blades.
#pragma once

#include "elements/machine_elements/coordinate_force.hpp"
#include "mbs/model/rotor_map.hpp"
#include "mbs/system/system.hpp"
#include "turbines/model/assembly_options.hpp"
#include "turbines/model/description.hpp"
#include "turbines/model/mesh.hpp"

#include <memory>
#include <optional>

namespace cardan::turbines {

/// Parts in the tree of a machine, for loads and channels. Parts that a machine lacks are empty.
struct MachineLayout {
    /// "platform surge" ... "platform yaw"; its frame has its origin at the reference point, x downwind, z up.
    std::optional<MovingBase> platform;
    std::optional<CardanBeam> tower;  ///< none: rigid
    FrameId tower_base, tower_top;    ///< axes of the tower's beam; x downwind, z up at rest; a blade alone
                                      ///< has none: the ground
    FrameId shaft;                    ///< carries the drive train, x along the shaft, downwind
    FrameId rotor_centre;             ///< RotorMap::hub: spins with the shaft, does not teeter
    FrameId hub;                      ///< carries the blades; the same axes where nothing teeters
    std::optional<BodyId> yaw, teeter, generator;  ///< the generator's azimuth is the spin coordinate
    CoordinateSum azimuth;                         ///< of the rotor centre relative to the shaft frame
    double gear_ratio = 1;                         ///< generator speed over the rate of its coordinate
    std::vector<int> blade_numbers;                ///< places of the blades below, from 1; some may be missing
    std::vector<CardanBeam> blades;
    std::vector<FrameId> pitch_axes;      ///< per blade, before the pitch joint: x along the blade, z downwind
    std::vector<FrameId> blade_roots;     ///< behind pitch joint and pitch setting: the blade's axes
    std::vector<BodyId> pitch;            ///< pitch joints; their coordinates are positive away from feather
    std::vector<double> pitch_settings;   ///< per blade, rad, positive toward feather
    std::vector<BodyId> pitch_drives;     ///< per blade, if the assembly has them
    std::vector<BodyId> pitch_actuators;  ///< per blade, if linkages turn them: strokes, m
};

/// A machine ready for the solvers. Immutable and cheap to copy.
class Turbine {
public:
    const System& system() const { return *system_; }
    const RotorMap& rotor() const { return rotor_; }
    const Tree& tree() const { return *tree_; }
    const ForceSet& forces() const { return *forces_; }
    /// Pitch linkages; usually empty.
    const LoopSet& loops() const { return *loops_; }
    const MachineLayout& layout() const { return *layout_; }
    /// Numbers of elements; where one of them was not given, also how far the frequencies have converged.
    const Mesh& mesh() const { return mesh_; }
    /// A copy of the machine with other forces: usually a copy of forces() with generator, brake or loads added.
    /// @param remark  describes the forces, for the description stored in files
    /// @throws InputError as System does
    Turbine with_forces(const ForceSet& forces, const std::string& remark = {}) const;
    const std::string& source() const { return source_; }
    const std::vector<std::string>& warnings() const { return warnings_; }
    /// Bodies, coordinates, masses by part, total mass and centre of mass, mesh, warnings.
    std::string summary() const;

private:
    friend Turbine assemble(const TurbineDescription& description, const AssemblyOptions& options);
    friend Turbine isolated_blade(const TurbineDescription& description, const AssemblyOptions& options, int number);
    friend Turbine isolated_tower(const TurbineDescription& description, const AssemblyOptions& options, bool with_top);
    Turbine() = default;
    void finish(const class Assembler& assembler, const std::string& name, std::string source,
                const std::string& settings, const std::optional<Mesh>& found);

    std::shared_ptr<const Tree> tree_;
    std::shared_ptr<const ForceSet> forces_;
    std::shared_ptr<const LoopSet> loops_;
    std::shared_ptr<const MachineLayout> layout_;
    std::shared_ptr<const System> system_;
    RotorMap rotor_;
    Mesh mesh_;
    std::string source_;
    std::vector<std::string> warnings_;
};

/// The whole machine. Coordinates in order: platform if there is one, tower, yaw x, y, rotation, tilt, generator,
/// gearbox, hub (or shaft beam), teeter, then every blade's pitch, pitch actuator and elements; rigid joints are left
/// out. The spin coordinate is the generator's azimuth relative to the nacelle. Frames: "tower foot", "tower top",
/// "nacelle", "shaft" (fixed to the nacelle), "rotor centre" (spins), "hub" (teeters), "blade <k> pitch axis" and,
/// behind the pitch joint, "blade <k> root". Numbers of elements that the options do not give are those of
/// converged_mesh(), which takes as long as several assemblies: with_elements() saves a second search.
/// @throws InputError for bad data; the part is named.
Turbine assemble(const TurbineDescription& description, const AssemblyOptions& options = {});

/// One blade clamped at the hub radius of a rigid hub spinning about a fixed horizontal axis (with its cone; no pitch
/// joint, no teeter, no tilt, no platform). The rest of the description is left out, and may lack anything. If no
/// number of elements is given, as many as the frequencies of the blade alone take.
/// @param number  which one
/// @throws InputError also for a blade that is missing
Turbine isolated_blade(const TurbineDescription& description, const AssemblyOptions& options = {}, int number = 1);

/// The tower clamped at its foot, alone or with everything above it as one rigid body: blades undeformed, blade 1 up,
/// at their pitch setting. It has no rotor and can only be analysed at standstill. A platform is left out. Of the rest
/// of the description it needs nothing; with its top, or a damping ratio of the first mode, which is that of the tower
/// with its top, it needs the masses, but no bearings. If no number of elements is given, as many as its frequencies
/// take.
/// @throws InputError also for a tower that is rigid
Turbine isolated_tower(const TurbineDescription& description, const AssemblyOptions& options = {},
                       bool with_top = false);

}  // namespace cardan::turbines
