/// @file
/// An airfoil whose flow lags behind its motion: four states for the wake's shed vorticity, the pressure and the point
/// of separation [M. H. Hansen, M. Gaunaa, H. Aa. Madsen, A Beddoes-Leishman type dynamic stall model in state-space
/// and indicial formulations, Riso-R-1354, 2004], or the last of them alone [S. Oye, Dynamic stall simulated as time
/// lag of separation, Fourth IEA Symposium on the Aerodynamics of Wind Turbines, 1991].
#pragma once

#include "elements/aerodynamics/polar.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace cardan {

/// Lift and drag of an airfoil whose flow does not separate.
struct AttachedFlow {
    double slope = 0;             ///< of the lift, 1/rad
    double zero_lift = 0;         ///< angle of attack without lift, rad
    double upper = 0, lower = 0;  ///< angles of attack at which the flow begins to separate, rad
    double zero_lift_drag = 0;    ///< drag coefficient without lift
};

/// Model of unsteady airfoil aerodynamics.
enum class UnsteadyAirfoilModel : std::uint8_t {
    beddoes_leishman,  ///< all of it [Hansen, Gaunaa and Madsen]
    oye  ///< the point of separation [Oye]: for stall; attached flow does not lag, so that flutter comes early
};

/// Constants of a thin airfoil, indicial response by two exponentials; lags in half chords travelled.
struct UnsteadyAirfoilConstants {
    double A1 = 0.3, A2 = 0.7, b1 = 0.14, b2 = 0.53;
    double pressure = 1.7, boundary_layer = 3.0;
    UnsteadyAirfoilModel model = UnsteadyAirfoilModel::beddoes_leishman;
};
/// Oye's model has a single lag, usually of 6 half chords.
inline constexpr UnsteadyAirfoilConstants oye_lags{.boundary_layer = 6, .model = UnsteadyAirfoilModel::oye};

/// Motion of a section through the air, at its aerodynamic centre, a quarter of the chord behind the leading edge.
struct AirfoilMotion {
    double attack;  ///< rad
    double speed;   ///< of the air, m/s
    double rate;    ///< of the section about its span, nose up, rad/s
    double chord;   ///< m
};

/// An airfoil whose coefficients follow its motion late. With T = c / (2 U), the angle of attack at three quarters of
/// the chord, alpha_34 = atan2(U sin alpha + rate c/2, U cos alpha), and alpha_E = (1 - A1 - A2) alpha_34 + x1 + x2:
///
///     T x1' = A1 b1 alpha_34 - b1 x1,      T x2' = A2 b2 alpha_34 - b2 x2,
///     T_p T x3' = c_p - x3,                c_p = slope (alpha_E - zero_lift) + pi T rate,
///     T_f T x4' = f(alpha_F) - x4,         alpha_F = x3 / slope + zero_lift,
///
///     c_l = x4 slope (alpha_E - zero_lift) + (1 - x4) c_l,separated(alpha_E) + pi T rate,
///     c_d = c_d(alpha_E) + (alpha_34 - alpha_E + T rate) (c_l - pi T rate)
///           + [c_d(alpha_E) - minimum drag] [(sqrt f(alpha_E) - sqrt x4) / 2 - (f(alpha_E) - x4) / 4],
///     c_m = c_m(alpha_E) - pi/2 T rate.
///
/// With UnsteadyAirfoilModel::oye alpha_E = alpha_F = alpha_34, the terms with the rate are not there, and c_d is that
/// of the table: x1 to x3 stay zero and are no states.
///
/// The speed is taken as constant in the lags. Beyond 40 degrees of attack the coefficients go over to those of the
/// table, which they are from 45 degrees on (by a cosine; a choice as in AeroDyn).
class UnsteadyAirfoil {
public:
    enum State : std::uint8_t { wake_1, wake_2, lagging_lift, separation_point, states };
    using States = Eigen::Matrix<double, states, 1>;
    struct Coefficients {
        double lift, drag, moment;
    };

    /// f from Kirchhoff's flow, c_l = slope (alpha - zero_lift) [(1 + sqrt f) / 2]^2, at the points of the table,
    /// linear in between; zero beyond its first minimum below one half outside of `lower` ... `upper`. An airfoil
    /// without slope (a cylinder) keeps its table's coefficients.
    /// @throws InputError for values that are not finite, a slope or a lag that is negative, `lower` above `upper`
    UnsteadyAirfoil(const Polar& polar, const AttachedFlow& flow, const UnsteadyAirfoilConstants& lags = {});

    /// States at rest.
    States steady(const AirfoilMotion& motion) const;
    States rates(const States& x, const AirfoilMotion& motion) const;
    Coefficients coefficients(const States& x, const AirfoilMotion& motion) const;

    /// Derivatives of rates and coefficients (rows).
    struct Slopes {
        enum Column : std::uint8_t { attack = states, speed, rate, columns };  ///< behind the states
        Eigen::Matrix<double, states, columns> rates;
        Eigen::Matrix<double, 3, columns> coefficients;
    };
    Slopes slopes(const States& x, const AirfoilMotion& motion) const;

    /// Point of separation, from 0 at the leading to 1 at the trailing edge, and the lift of the separated flow.
    struct Separation {
        double f, lift, f_slope, lift_slope;  ///< slopes per rad
    };
    Separation separation(double attack) const;

    bool is_unsteady() const { return flow_.slope > 0; }
    /// Number of states: the last ones of State.
    int own_states() const { return follows_separation_alone() ? 1 : int{states}; }
    const AttachedFlow& flow() const { return flow_; }
    const UnsteadyAirfoilConstants& lags() const { return lags_; }
    const Polar& polar() const { return polar_; }

private:
    bool follows_separation_alone() const { return lags_.model == UnsteadyAirfoilModel::oye; }
    template <class S>
    struct Flow;
    template <class S>
    struct Values;
    template <class S>
    Flow<S> flow_at(const Values<S>& at) const;
    template <class S>
    std::array<S, states> rates_of(const Values<S>& at) const;
    template <class S>
    std::array<S, 3> coefficients_of(const Values<S>& at) const;

    Polar polar_;
    Polar curves_;  // f in the place of the lift, that of the separated flow in the place of the drag
    AttachedFlow flow_;
    UnsteadyAirfoilConstants lags_;
};

}  // namespace cardan
