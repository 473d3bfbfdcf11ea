/// @file
/// Loads of the air on a line of rigid pieces: a beam's segments, or a body that does not bend. Internal to the air on
/// machines: not installed.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/model/model.hpp"

#include <functional>
#include <vector>

namespace cardan::turbines {

/// A rigid piece: what it covers of the line, and where that is in its body.
struct RigidPiece {
    double from, to;  ///< along the line, m
    FrameId carrier;
    int body;                               ///< -1: the base
    Placement carrier_axes;                 ///< in body axes
    std::function<Placement(double)> pose;  ///< of the line's axes, x along it, in body axes
};

/// Rigid pieces of a beam, from its root to its tip; the beam has to outlive them.
std::vector<RigidPiece> pieces_of(const CardanBeam& beam, const Model& model);

/// Arc length at which a line has this distance along the x axis of its beam, m.
/// @throws InputError for a place beyond its ends; files may round them, by 1e-3 of the length
double arc_at(const BeamLine& line, double x, const std::string& where, const char* quantity);

/// Point at which the load of a section acts on a segment. Loads per length are linear between sections, so a section
/// loads all segments between its neighbours; on a rigid segment its load is one force through one point, whatever the
/// motion:
///
///     length = int N ds,    place = int N x ds / length,    N: 1 at the section, 0 at its neighbours and beyond.
///
/// The segments move as rigid bodies: the forces do the work of the load per length, exactly.
struct AirPoint {
    int body;
    FramePoint at;  ///< on a frame of the segment
    Vec3 place;     ///< `at` in body axes, m
    double length;  ///< m
    std::size_t section;
};

/// Sections along a line of rigid pieces, at their places or off them.
class AirLine {
public:
    /// @param breaks   where the line or what it carries is not smooth, m
    /// @param places   of the sections along the line, m, ascending
    /// @param offsets  from the line, in its axes there; linear between sections
    AirLine(std::vector<RigidPiece> pieces, std::vector<double> breaks, std::vector<double> places,
            std::vector<Vec3> offsets);

    const std::vector<RigidPiece>& pieces() const { return pieces_; }
    const RigidPiece& piece(std::size_t section) const;
    double place(std::size_t section) const { return places_[section]; }
    const Vec3& offset(std::size_t section) const { return offsets_[section]; }
    void add_points(std::size_t section, std::vector<AirPoint>& points) const;

private:
    std::size_t interval(double s) const;
    double share(std::size_t section, double s) const;
    Vec3 offset_at(double s) const;

    std::vector<RigidPiece> pieces_;
    std::vector<double> breaks_, places_;
    std::vector<Vec3> offsets_;
};

/// Order by body, descending: derivatives are gathered from the tip down.
void sort_by_body(std::vector<AirPoint>& points);

}  // namespace cardan::turbines
