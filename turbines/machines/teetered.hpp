/// @file
/// Two-bladed machine with a teetered hub on an elastic tower: Lee, Hodges and Patil, Wind Energy 5 (2002), Table I.
///
/// Ground axes: x downwind, z up, y = z x x; the paper's n1, n2, n3 are -y, x, z. Spin about the shaft axis that points
/// downwind; azimuth 0: blade 1 up. SI units, radians.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/model/rotor_map.hpp"
#include "mbs/system/system.hpp"
#include "turbines/model/description.hpp"

#include <filesystem>
#include <memory>

namespace cardan::turbines {

/// A straight beam with the same section everywhere.
struct PrismaticBeam {
    double length = 0;  ///< m
    EngineeringSection section = {};
    double mass() const { return length * section.mass; }  ///< kg
};

/// The hub and what it carries, in hub axes with the origin where teeter axis and shaft axis meet: z along the shaft
/// (downwind), x along blade 1, y the teeter axis (without delta-3).
struct TeeteredHubDescription {
    RigidInertia inertia;
    double root_arm = 0;    ///< d_h2: blade roots from the shaft axis, spanwise, m
    double undersling = 0;  ///< d_h1: the point where the blade axes meet lies this far upwind of the teeter axis, m
    double delta3 = 0;      ///< rotation of the teeter axis in the rotor plane, rad; positive: a blade that teeters
                            ///< downwind pitches its leading edge upwind by tan(delta3) times the teeter angle
    double cone = 0;        ///< blade axes out of the rotor plane, tips downwind positive, rad
    Spring teeter;
};

/// All data of the machine; any of them may be changed before assembly.
struct TeeteredDescription {
    std::string name;
    std::string source;      ///< the text it was read from; kept with every result
    double rotor_speed = 0;  ///< nominal, rad/s
    /// From the ground up. Beam axes y, z are ground x (downwind), y: EI_flap and j_flap are about ground x (lateral
    /// bending), EI_edge and j_edge about ground y (fore-aft).
    PrismaticBeam tower;
    Spring yaw;               ///< about the tower axis; no stiffness: free
    RigidInertia nacelle;     ///< ground axes, origin at the tower top
    double shaft_height = 0;  ///< shaft axis above the tower top where it meets the tower axis, m
    double tilt = 0;          ///< upwind end of the shaft up, rad
    double overhang = 0;      ///< from the tower axis to the teeter axis along the shaft, upwind, m; the paper's rotor
                              ///< lies downwind: -d_n2
    RigidInertia shaft;       ///< spins; x downwind along the shaft, z up at azimuth 0, origin on the tower axis
    TeeteredHubDescription hub;
    PrismaticBeam blade;  ///< from the root out; x radial, y to the leading edge, z downwind
};

/// Table I of the paper.
TeeteredDescription teetered_description();
/// As above, from a folder with teetered.csv.
/// @throws FileError, ParseError, InputError
TeeteredDescription teetered_description(const std::filesystem::path& folder);
/// The data as YAML (SI units), without `source`, as stored with histories and diagrams. There is no reader for it.
/// @throws InputError: a number that is not finite
std::string description_text(const TeeteredDescription& description);
/// Tower stiffnesses as multiples of the blade's: fore-aft EI of flap EI, lateral EI of lag EI, GJ of GJ (Table III:
/// 10, 100, 1000).
/// @throws InputError: ratio not finite and positive
TeeteredDescription with_tower_rigidity(TeeteredDescription description, double ratio);

struct TeeteredOptions {
    CardanBeamOptions tower = beam(6), blade = beam(6);
    bool rigid_tower = false;     ///< no tower coordinates: the yaw joint sits on the ground at the tower's height
    Vec3 gravity = Vec3::Zero();  ///< ground axes, m/s^2
    bool joint_damping = true;    ///< of yaw and teeter
    bool teeter_locked = false;   ///< the teeter coordinate is prescribed, and zero
    CoordinateRole spin = CoordinateRole::driven;  ///< driven: rotor speed prescribed, as in the paper

    static CardanBeamOptions beam(int elements) {
        CardanBeamOptions options;
        options.elements = elements;
        return options;
    }
    /// The same number of elements for tower and blades.
    static TeeteredOptions with_elements(int elements) {
        TeeteredOptions options;
        options.tower = options.blade = beam(elements);
        return options;
    }
};

/// A machine ready for the solvers. Immutable and cheap to copy.
class TeeteredTurbine {
public:
    const System& system() const { return *system_; }
    const RotorMap& rotor() const { return rotor_; }
    const Tree& tree() const { return *tree_; }
    const std::string& source() const { return source_; }
    const std::vector<std::string>& warnings() const { return warnings_; }
    /// Coordinates that change sign in the half-revolution symmetry: teeter. The equations of motion are invariant if
    /// the azimuth increases by pi, the blades exchange their coordinates and these coordinates change sign. Empty if
    /// teeter is locked.
    const std::vector<int>& odd_coordinates() const { return odd_coordinates_; }
    /// Bodies, coordinates, masses by part, total mass and centre of mass, warnings.
    std::string summary() const;

private:
    friend TeeteredTurbine assemble(const TeeteredDescription&, const TeeteredOptions&);
    friend TeeteredTurbine isolated_blade(const TeeteredDescription&, const TeeteredOptions&);
    TeeteredTurbine(const class TeeteredAssembler& assembler, const std::string& name,
                    const TeeteredDescription& description, const std::string& settings);

    std::shared_ptr<const Tree> tree_;
    std::shared_ptr<const System> system_;
    RotorMap rotor_;
    std::vector<int> odd_coordinates_;
    std::string source_;
    std::vector<std::string> warnings_;
};

/// The whole machine. Coordinates in order: tower, "yaw", "rotor azimuth" (the spin coordinate), "teeter", elements of
/// blade 1, elements of blade 2. Frames: "tower top", "nacelle", "shaft" (fixed to the nacelle), "rotor centre" (spins,
/// does not teeter; hub axes), "hub" (teeters), "blade <k> root".
/// @throws InputError for bad data; the part is named.
TeeteredTurbine assemble(const TeeteredDescription& description, const TeeteredOptions& options = {});

/// One blade clamped at the root arm of a rigid hub that spins about a fixed horizontal axis: no teeter, no tilt.
TeeteredTurbine isolated_blade(const TeeteredDescription& description, const TeeteredOptions& options = {});

}  // namespace cardan::turbines
