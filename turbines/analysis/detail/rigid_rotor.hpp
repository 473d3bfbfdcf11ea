/// @file
/// The rotor of a machine in a uniform wind, not bent: what its controller has to reckon with. Internal to the room.
#pragma once

#include "turbines/machine/machine.hpp"

namespace cardan::turbines {

/// Level, in the machine's air; it stays as long as the machine does.
class RigidRotor {
public:
    /// @throws InputError for a machine without airfoils
    explicit RigidRotor(const Machine& machine);

    double radius() const { return radius_; }
    /// Tip-speed ratio below rated power: the machine's, or that of the largest power coefficient at its pitch.
    double ratio() const;
    /// W, at a rotor speed in rad/s and a pitch in rad.
    double power(double wind, double speed, double pitch) const;
    /// -d power / d pitch, W/rad, the wake frozen.
    double sensitivity(double wind, double speed, double pitch) const;
    /// The lowest wind in which a rotor with this speed has this power at the machine's pitch, m/s; 0: there is none
    /// below 40 m/s.
    double rated_wind(double speed, double power) const;
    /// Above the rated wind: pitch beyond the machine's that lowers the power to this, rad.
    double pitch_for(double power, double wind, double speed) const;
    /// Operation of the machine in a wind: by its schedule, or its law of variable speed with rated speed and power.
    Operation operation(double wind) const;

private:
    const Machine* machine_;
    const Aerodynamics* air_;
    double radius_;
};

}  // namespace cardan::turbines
