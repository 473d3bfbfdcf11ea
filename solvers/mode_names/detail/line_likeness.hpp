/// @file
/// Likeness of the motions of two machines, by the lines of their parts. Internal: not for users of the library.
#pragma once

#include "solvers/campbell_data/diagram.hpp"

namespace cardan::solvers {

/// MAC of motions of lines that have the same part and blade in two diagrams, whatever frames are on them: between
/// these the motion is linear, and places correspond by their fraction of the line's length.
///
///     MAC = |a^H b|^2 / (a^H a b^H b),    a^H b = sum over lines int u_a^H u_b + r^2 theta_a^H theta_b ds,
///
/// with the displacement u, the rotation theta, and r a hundredth of the length, about the radius of gyration of a
/// section, so that torsion alone counts too. Without masses, modes of one machine are not orthogonal in it: what is
/// alike has a MAC near one, what is not need not be near zero.
class LineLikeness {
public:
    /// @param here  its lines have the lengths that weigh
    LineLikeness(const Campbell& there, const Campbell& here);

    bool has_lines() const { return !places_there_.empty(); }
    /// A row per motion of `there`, a column per motion of `here`; each by frame of its own diagram.
    Matrix mac(const std::vector<const std::vector<FrameMotion>*>& there,
               const std::vector<std::vector<FrameMotion>>& here) const;

private:
    // A place between two frames, and its weight.
    struct Place {
        int before, behind;
        double part;  // of the way
        double weight, arm;
    };
    static void add_line(const Campbell& diagram, const Polyline& line, double length, std::vector<Place>& places);
    static ComplexVector weighted(const std::vector<Place>& places, const std::vector<FrameMotion>& motion);

    std::vector<Place> places_there_, places_here_;
};

}  // namespace cardan::solvers
