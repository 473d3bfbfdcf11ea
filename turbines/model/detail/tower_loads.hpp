/// @file
/// Common parts of the channels of loads, and the loads of a rigid tower. Internal to channels: not installed.
#pragma once

#include "turbines/model/channels.hpp"

namespace cardan::turbines {

/// Loads at the ends of a tower without coordinates. It shares a body (or the ground) with what carries it and with
/// what is fixed to its top, so they follow from the joints on that body and the parts that were welded to it.
class RigidTower {
public:
    explicit RigidTower(const Turbine& turbine);
    /// Load on the tower at its top, or on what carries it at its foot; base axes, about the frame's origin.
    Wrench top_load(const Turbine& source, const DynamicView& in) const;
    Wrench foot_load(const Turbine& source, const DynamicView& in) const;

private:
    Wrench load_above(FrameId cut, const Turbine& source, const DynamicView& in) const;
    void add_part(Wrench& sum, const RigidInertia& part, const DynamicView& in, const Vec3& at) const;

    FrameId carrier_;          // the body's own frame
    int body_ = -1;            // of the model; -1: the ground
    std::vector<int> joints_;  // of the model: bodies that move on it
    RigidInertia tower_, head_;
};

}  // namespace cardan::turbines
