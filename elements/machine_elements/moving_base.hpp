/// @file
/// A base that moves with six coordinates: floating platform, shaking table, vehicle.
#pragma once

#include "elements/machine_elements/joints.hpp"
#include "mbs/base/entry.hpp"

#include <array>
#include <optional>

namespace cardan {

enum class BaseCoordinate : std::uint8_t { surge, sway, heave, roll, pitch, yaw };

struct MovingBaseOptions {
    /// Unit vectors along or about which surge, sway, heave, roll, pitch and yaw, in this order, are positive
    /// (rotations right-handed), in the carrier's axes at rest. The default with x downwind and z up is that of
    /// OpenFAST: positive pitch moves the top of the tower downwind.
    std::array<Vec3, 6> directions{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ(),
                                   Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    /// Order of the rotations, the first one about an axis of the carrier: R = R_first R_second R_third. The middle
    /// angle must stay away from +-90 degrees, where the first and third axis coincide if the three are orthogonal.
    std::array<BaseCoordinate, 3> rotations{BaseCoordinate::yaw, BaseCoordinate::pitch, BaseCoordinate::roll};
    /// Driven: the motion is prescribed, with its velocity and acceleration. Free: it follows from forces on the base.
    CoordinateRole role = CoordinateRole::prescribed;
    /// Roles of individual coordinates, surge ... yaw, where they differ from `role`.
    std::array<std::optional<CoordinateRole>, 6> roles = {};

    /// @param name  of the base, for messages
    /// @throws InputError: a direction that is no unit vector, translations in one plane, consecutive rotations about
    /// one axis, an order that lacks a rotation
    void check(const std::string& name) const;
};

/// Parts of a moving base that were added to the tree.
struct MovingBase {
    FrameId frame;                      ///< moving frame; at q = 0 it coincides with the carrier
    std::array<BodyId, 6> coordinates;  ///< surge ... yaw
    BodyId coordinate(BaseCoordinate which) const { return entry(coordinates, which); }
};

/// Three translations in the carrier's axes (surge, sway, heave), then three rotations about the point reached: six
/// massless bodies. Coordinates are called "<name> surge" ... "<name> yaw", the frame "<name>". What stands on the base
/// is added to the frame; its masses by Tree::weld() there.
/// @throws InputError as MovingBaseOptions::check()
MovingBase add_moving_base(Tree& tree, FrameId carrier, const std::string& name = "platform",
                           const MovingBaseOptions& options = {});

}  // namespace cardan
