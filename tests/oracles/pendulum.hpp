#pragma once

namespace cardan::oracles {

/// Swinging pendulum released from rest: theta'' = -omega0^2 sin(theta), theta(0) = amplitude, theta'(0) = 0.
/// omega0^2 = g / l for the mathematical pendulum, m g s / J_pivot for a rigid body (s = distance pivot - mass centre).
///     sin(theta/2) = k sn(omega0 t + K(k), k),  k = sin(amplitude/2),  period = 4 K(k) / omega0
/// [Landau and Lifshitz, Mechanics, section 11, problem 1; Whittaker, Analytical Dynamics, section 44]
class SwingingPendulum {
public:
    /// @param omega0     circular frequency of small swings, rad/s, > 0
    /// @param amplitude  rad, in [0, pi)
    SwingingPendulum(double omega0, double amplitude);

    double period() const;             ///< s
    double angle(double time) const;   ///< rad, from the lower rest position
    double rate(double time) const;    ///< rad/s
    double energy(double time) const;  ///< theta'^2/2 - omega0^2 cos(theta), rad^2/s^2; constant

private:
    double omega0_;
    double k_;
    double quarter_;  // K(k)
};

/// Pendulum that goes over the top: theta(0) = 0, theta'(0) = rate_at_bottom > 2 omega0.
///     theta = 2 am(rate_at_bottom t / 2, k),  k = 2 omega0 / rate_at_bottom,  time of one turn = 2 k K(k) / omega0
class RevolvingPendulum {
public:
    RevolvingPendulum(double omega0, double rate_at_bottom);

    double period() const;            ///< s, of one full turn
    double angle(double time) const;  ///< rad, grows without bound
    double rate(double time) const;   ///< rad/s

private:
    double rate_at_bottom_;
    double k_;
};

}  // namespace cardan::oracles
