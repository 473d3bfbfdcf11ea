/// @file
/// A friction brake on a shaft.
#pragma once

#include "elements/machine_elements/switch.hpp"
#include "mbs/system/channel.hpp"

#include <cmath>
#include <memory>
#include <string>

namespace cardan {

/// Coulomb friction, regularised: T = T_max r(t) tanh(speed / regularisation), positive where it brakes positive
/// rotation; r rises from 0 to 1 along 10 x^3 - 15 x^4 + 6 x^5 over the ramp time after application and drops to zero
/// immediately on release. The brake only dissipates, T speed >= 0. There is no stiction: under a torque M at
/// standstill the disc creeps at atanh(M / T_max) times the regularisation speed. Speeds and torques are those of the
/// disc.
struct Brake {
    std::string name = "brake";
    BodyId shaft = {};          ///< coordinate that the disc turns with
    double gear_ratio = 1;      ///< disc speed / rate of the coordinate; not zero
    double maximum_torque = 0;  ///< N m
    double ramp = 0;            ///< from application to full torque, s; 0: at once
    /// rad/s: 76 % of the torque at this speed, 99.5 % at three times as much. Small values make the equations stiff.
    double regularisation = 0;
    std::shared_ptr<const Switch> applied = {};  ///< the brake acts while this is on; null: always
    std::string alias = "HSSBrTq";  ///< alias of its torque channel; a second brake needs another one or none

    /// Fraction r of the torque at a time, 0 ... 1.
    double application(double time) const;
    /// Fully applied torque, N m, at a disc speed in rad/s.
    template <class S>
    S friction(S speed) const {
        return maximum_torque * std::tanh(speed / regularisation);
    }
    /// d friction / d speed, N m s/rad.
    double slope(double speed) const;
    /// Torque on the disc, N m, at a rate of the coordinate.
    double torque(double time, double rate) const { return application(time) * friction(gear_ratio * rate); }
    /// Dissipated power, W.
    double power(double time, double rate) const { return torque(time, rate) * gear_ratio * rate; }
};

/// Q = -ratio * torque.  @throws InputError for bad numbers
ForceElement brake_force(const Brake& brake);

/// "<name> torque" (on the disc) and "<name> power" (dissipated).
ChannelGroup brake_channels(const Brake& brake);

}  // namespace cardan
