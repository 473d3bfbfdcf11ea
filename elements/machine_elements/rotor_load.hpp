/// @file
/// A prescribed torque and thrust on a rotor. This is not an aerodynamic model but a simple formula with the right
/// trends, to start machines up, load their generators and stop them.
#pragma once

#include "elements/machine_elements/coordinate_force.hpp"
#include "mbs/system/channel.hpp"

#include <functional>
#include <memory>
#include <string>

namespace cardan {

/// Torque M (about the rotor axis, positive: drives positive rotation) and thrust T (downwind) of a rotor of radius R
/// in the wind V at the speed w and the pitch b (positive toward feather):
///
///     M = rho/2 pi R^3 (c_p / l) V [ 2 V c - (w R / l) (c + k s) ] g,   c = cos^2 b, s = sin b,
///     T = rho/2 pi R^2 (c_t / l) V w R c g.
///
/// At zero pitch the power coefficient over the tip speed ratio is the parabola c_p x (2 - x) with x = w R / (V l),
/// which peaks at the design ratio l; the torque is finite at standstill and falls linearly to the runaway ratio 2 l.
/// In feather (b = pi / 2) only the braking term in k remains. g = 1 - d (1 + cos B (psi - pi)) / 2 reduces both by the
/// fraction d when one of the B blades passes the tower.
struct RotorCurve {
    double radius = 0;           ///< R, m
    double power = 0;            ///< c_p, at the design tip speed ratio
    double tip_speed_ratio = 0;  ///< l, at the design point
    double thrust = 0;           ///< c_t, there
    double feather_braking =
        2.6;                     ///< k; with this value the torque vanishes at 20 degrees of pitch at the design ratio
    double tower_shadow = 0;     ///< d, 0 ... 1
    int blades = 3;              ///< B
    double air_density = 1.225;  ///< kg/m^3

    /// Values and their derivatives by azimuth, speed and pitch (N m, N, and per rad, rad/s).
    struct Value {
        double torque = 0, thrust = 0;
        Vec3 torque_by = Vec3::Zero(), thrust_by = Vec3::Zero();
    };
    Value at(double wind, double azimuth, double speed, double pitch) const;
    /// Torque alone, for any scalar.
    template <class S>
    S torque(double wind, S azimuth, S speed, S pitch) const;
    template <class S>
    S thrust_force(double wind, S azimuth, S speed, S pitch) const;
    /// @throws InputError naming the quantity
    void check(std::string_view where) const;
};

/// The load of a curve on the hub of a rotor.
struct RotorLoad {
    std::string name = "rotor load";
    FrameId hub = {};            ///< acts at its origin; its z axis points downwind along the rotor axis
    CoordinateSum azimuth = {};  ///< of the hub relative to the nacelle
    CoordinateSum pitch = {};    ///< mean pitch of the blades, positive toward feather; empty: pitch_setting alone
    double pitch_setting = 0;    ///< added to it, rad
    RotorCurve curve = {};
    std::function<double(double time)> wind = {};  ///< m/s, >= 0; its jumps are breaks of the integration
    /// Any torque and thrust with their derivatives, in the place of curve and wind.
    std::function<RotorCurve::Value(double time, double azimuth, double speed, double pitch)> law = {};

    RotorCurve::Value value(const StateView& in) const;
    /// Force and moment at the hub frame's origin, base axes.
    Wrench wrench(const StateView& in) const;
};

/// The load as a follower wrench on the hub. Exact Jacobian with respect to all coordinates that move the hub.
/// @throws InputError for bad numbers, neither wind nor law, no azimuth
ForceElement rotor_load_force(const RotorLoad& load);

/// "<name> torque", "<name> thrust", "<name> power" (torque times rotor speed) and, if there is a wind, "wind speed".
ChannelGroup rotor_load_channels(const RotorLoad& load);

}  // namespace cardan
