/// @file
/// A friction brake on a shaft.
#pragma once

#include "elements/machine/switch.hpp"
#include "mbs/system/channel.hpp"

#include <cmath>
#include <memory>
#include <string>

namespace cardan {

/// Coulomb friction, regularised: T = T_max r(t) tanh(speed / regularisation), positive where it brakes positive
/// rotation; r rises from 0 to 1 along 10 x^3 - 15 x^4 + 6 x^5 within the ramp after the application and is zero at
/// once on release. It only ever dissipates, T speed >= 0. It does not hold: under a torque M at rest the disc creeps
/// at atanh(M / T_max) times the regularisation speed. Speeds and torques are those of the disc.
struct Brake {
    std::string name = "brake";
    BodyId shaft = {};          ///< coordinate that the disc turns with
    double gear_ratio = 1;      ///< speed of the disc over the rate of the coordinate; not zero
    double maximum_torque = 0;  ///< N m
    double ramp = 0;            ///< from application to full torque, s; 0: at once
    /// rad/s: 76 % of the torque at this speed, 99.5 % at three times as much. Small values make the motion stiff.
    double regularisation = 0;
    std::shared_ptr<const Switch> applied = {};  ///< on: brakes; none: always
    std::string alias = "HSSBrTq";               ///< of the channel of its torque; a second brake needs another or none

    /// Share of the torque at a time, 0 ... 1.
    double application(double time) const;
    /// N m at the full torque, at a speed of the disc in rad/s.
    template <class S>
    S friction(S speed) const {
        return maximum_torque * std::tanh(speed / regularisation);
    }
    /// d friction / d speed, N m s/rad.
    double slope(double speed) const;
    /// Of the disc, N m, at a rate of the coordinate.
    double torque(double time, double rate) const { return application(time) * friction(gear_ratio * rate); }
    /// Heat, W.
    double power(double time, double rate) const { return torque(time, rate) * gear_ratio * rate; }
};

/// Q = -ratio * torque.  @throws InputError for bad numbers
UserForce brake_force(const Brake& brake);

/// "<name> torque" (of the disc) and "<name> power" (heat).
ChannelGroup brake_channels(const Brake& brake);

}  // namespace cardan
