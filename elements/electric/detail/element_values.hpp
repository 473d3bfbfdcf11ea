/// @file
/// What an element with states sees, out of what a channel sees.
#pragma once

#include "mbs/system/channel.hpp"
#include "mbs/system/state_element.hpp"

#include <string>
#include <vector>

namespace cardan::detail {

/// The values of an element in a channel's function, found by their names.
class ElementValues {
public:
    ElementValues(const StateElement& element, const DynamicView& in);

    StateInput input() const { return {time_, q_, qd_, s_, others_, u_}; }

private:
    double time_;
    Vector q_, qd_, s_, others_, u_;
};

}  // namespace cardan::detail
