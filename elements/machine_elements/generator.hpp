/// @file
/// Generators: steady torque-speed curves as forces on the coordinate of the shaft.
///
/// Signs: the torque of a generator is positive where it brakes positive rotation, Q = -ratio * torque(ratio * qd).
/// Speeds and torques are those of the generator (the fast side of a gearbox), coordinates those of the tree.
#pragma once

#include "elements/machine_elements/switch.hpp"
#include "mbs/base/monotone_cubic.hpp"
#include "mbs/system/channel.hpp"

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace cardan {

/// Induction machine on a grid of fixed frequency, in steady state, stator resistance neglected: Kloss' formula
///
///     T = 2 T_b / (s / s_b + s_b / s),   s = speed / synchronous speed - 1,
///
/// with the slip s counted positive where it generates. Regular at s = 0, where the slope is 2 T_b / (s_b w_s).
///                               [M. Kloss, Archiv fuer Elektrotechnik 5 (1916) 59]
struct KlossCurve {
    double synchronous_speed = 0;  ///< 2 pi times the grid frequency / number of pole pairs, rad/s
    double breakdown_torque = 0;   ///< the largest, N m
    double breakdown_slip = 0;     ///< slip at which it occurs, > 0

    /// Torque, N m, at a speed in rad/s.
    template <class S>
    S torque(S speed) const {
        const S r = (speed / synchronous_speed - 1.0) / breakdown_slip;
        return 2.0 * breakdown_torque * r / (1.0 + r * r);
    }
    /// d torque / d speed, N m s/rad.
    double slope(double speed) const;
    /// @throws InputError unless all three are finite and positive
    void check(std::string_view where) const;
};

/// Torque-speed curve of a generator with a converter: cubics through points, monotone where the points are, with zero
/// slope at the ends and constant beyond them; slope continuous. See MonotoneCubic.
class TorqueTable {
public:
    /// @param speeds   rad/s, at least two, ascending
    /// @param torques  N m; the first one zero, unless the machine is to drive in reverse rotation
    /// @throws InputError naming the point
    TorqueTable(std::vector<double> speeds, std::vector<double> torques);

    double torque(double speed) const { return curve_.at(speed).value; }
    double slope(double speed) const { return curve_.at(speed).slope; }

private:
    MonotoneCubic curve_;
};

/// A generator on a shaft.
struct Generator {
    std::string name = "generator";
    BodyId shaft = {};      ///< coordinate the generator turns with, e.g. its azimuth referred to the slow shaft
    double gear_ratio = 1;  ///< generator speed / rate of the coordinate; negative: it turns the other way
    std::variant<KlossCurve, TorqueTable> law = KlossCurve{};
    std::shared_ptr<const Switch> grid = {};  ///< off: no torque; null: always on
    std::string alias = "GenTq";  ///< alias of its torque channel; a second generator needs another one or none

    /// Torque of the generator, N m, at a rate of the coordinate, rad/s; and the power it takes from the shaft, W.
    double torque(double rate) const;
    double power(double rate) const { return torque(rate) * gear_ratio * rate; }
};

/// @throws InputError for bad numbers
ForceElement generator_force(const Generator& generator);

/// "<name> torque" (of the generator) and "<name> power" (mechanical, taken from the shaft).
ChannelGroup generator_channels(const Generator& generator);

}  // namespace cardan
