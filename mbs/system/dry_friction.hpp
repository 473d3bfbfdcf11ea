/// @file
/// Dry friction that truly sticks: what it does at present, shared by its force, its lock and the events that tell
/// sticking from sliding.
#pragma once

#include "mbs/loops/loop_set.hpp"

#include <memory>
#include <string>

namespace cardan {

/// State of dry friction: it sticks while the lock is engaged.
struct FrictionState : LockState {
    /// 1, -1: it slides forward or backward against the surface. 0: nobody watches, and the law is regularised.
    int direction = 0;
};

/// Dry friction of a coordinate against a surface that moves along it: add_dry_friction() makes it, stick_slip()
/// watches it.
struct DryFriction {
    std::string name = {};
    BodyId coordinate = {};
    double static_force = 0;   ///< that it holds at most, N or N m
    double surface_speed = 0;  ///< m/s or rad/s
    double standstill = 0;     ///< sliding at less than this is standing still, m/s or rad/s, > 0
    std::shared_ptr<FrictionState> state = std::make_shared<FrictionState>();
};

}  // namespace cardan
