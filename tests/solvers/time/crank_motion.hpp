// Crank, rod and piston as a system of one coordinate, from geometry: no trees, no loops.
#pragma once

#include "tests/support/numbers.hpp"

#include <cmath>
#include <complex>

namespace cardan::testing {

/// A crank of radius r about z, a uniform slender rod of length l, a piston on the x axis.
struct CrankMotion {
    double r = 0.1, l = 0.3, inertia = 2, rod = 0.3, piston = 1;  // m, kg m^2 of the crank, kg

    template <class S>
    S sine_of_rod(S t) const {
        return -r / l * std::sin(t);
    }
    template <class S>
    S cosine_of_rod(S t) const {
        return std::sqrt(S(1) - sine_of_rod(t) * sine_of_rod(t));
    }
    // d/dt of the rod's angle and of the piston's place.
    template <class S>
    S rod_rate(S t) const {
        return -r / l * std::cos(t) / cosine_of_rod(t);
    }
    template <class S>
    S piston_rate(S t) const {
        return -r * std::sin(t) - l * sine_of_rod(t) * rod_rate(t);
    }
    double place(double t) const { return r * std::cos(t) + l * cosine_of_rod(t); }
    double rod_angle(double t) const { return std::asin(sine_of_rod(t)); }
    double piston_second(double t) const { return piston_rate(std::complex(t, 1e-30)).imag() / 1e-30; }

    /// Twice the kinetic energy is mass(t) times the square of the crank's rate.
    template <class S>
    S mass(S t) const {
        const S x = -r * std::sin(t) - l / 2 * sine_of_rod(t) * rod_rate(t),
                y = r * std::cos(t) + l / 2 * cosine_of_rod(t) * rod_rate(t);
        return inertia + rod * (x * x + y * y) + rod * l * l / 12 * rod_rate(t) * rod_rate(t) +
               piston * piston_rate(t) * piston_rate(t);
    }
    double mass_slope(double t) const { return mass(std::complex(t, 1e-30)).imag() / 1e-30; }
    /// Of the crank, under a torque on it and a force on the piston.
    double acceleration(double t, double rate, double torque, double force) const {
        return (torque + force * piston_rate(t) - mass_slope(t) / 2 * rate * rate) / mass(t);
    }

    /// The way of the piston, back and forth, from crank angle `from` to `to` > `from`.
    double travel(double from, double to) const {
        double way = 0, at = from;
        while (at < to) {
            // Dead centres at multiples of half a turn.
            const double next = std::min(to, (std::floor(at / pi_ + 1e-12) + 1) * pi_);
            way += std::abs(place(next) - place(at));
            at = next;
        }
        return way;
    }

private:
    static constexpr double pi_ = 3.14159265358979323846;
};

}  // namespace cardan::testing
