/// @file
/// From a description to a system: tower, yaw joint, nacelle, tilt joint, drive train, hub, blades.
#pragma once

#include "mbs/rotor_map.hpp"
#include "mbs/system.hpp"
#include "turbines/description.hpp"

#include <memory>
#include <optional>

namespace cardan::turbines {

/// The main shaft as one beam element instead of a torsion spring: bending stiffness of its own, torsion from the
/// description (GJ = stiffness x overhang). It reaches from the tilt joint to the hub.
struct ShaftBeam {
    double EI = 0;    ///< N m^2
    double mass = 1;  ///< kg/m; not zero, for nothing else gives the tilt joint an inertia apart from the hub's
};

struct AssemblyOptions {
    int tower_elements = 3;
    int blade_elements = 3;
    double delta = delta_gauss;  ///< of tower and blades; see CardanBeamOptions
    Partition partition = Partition::segment_masses;
    double pitch = 0;                ///< of all blades, leading edge upwind positive, rad
    Vec3 gravity = Vec3::Zero();     ///< ground axes, m/s^2
    bool structural_damping = true;  ///< of tower and blades
    bool joint_damping = true;       ///< of yaw, tilt, drive train, pitch
    std::optional<ShaftBeam> shaft_beam = std::nullopt;
};

/// A machine ready for the solvers. Immutable and cheap to copy.
class Turbine {
public:
    const System& system() const { return *system_; }
    const RotorMap& rotor() const { return rotor_; }
    const Tree& tree() const { return *tree_; }
    const std::string& source() const { return source_; }
    const std::vector<std::string>& warnings() const { return warnings_; }
    /// Bodies, coordinates, masses by part, total mass and centre of mass, warnings.
    std::string summary() const;

private:
    friend Turbine assemble(const TurbineDescription&, const AssemblyOptions&);
    friend Turbine isolated_blade(const TurbineDescription&, const AssemblyOptions&);
    Turbine() = default;
    void finish(const class Assembler& assembler, const std::string& name, std::string source,
                const std::string& settings);

    std::shared_ptr<const Tree> tree_;
    std::shared_ptr<const System> system_;
    RotorMap rotor_;
    std::string source_;
    std::vector<std::string> warnings_;
};

/// The whole machine. Coordinates in order: tower, yaw x, y, rotation, tilt, generator, gearbox, hub (or shaft beam),
/// then every blade's pitch and elements. The spin coordinate is the generator's azimuth relative to the nacelle.
/// @throws InputError for bad data; the part is named.
Turbine assemble(const TurbineDescription& description, const AssemblyOptions& options = {});

/// One blade clamped at the hub radius of a rigid hub spinning about a fixed horizontal axis (no pitch joint, no tilt).
Turbine isolated_blade(const TurbineDescription& description, const AssemblyOptions& options = {});

}  // namespace cardan::turbines
