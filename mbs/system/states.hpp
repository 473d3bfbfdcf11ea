/// @file
/// First-order states beside the coordinates, and inputs: what they are called and what they mean.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/base/sizes.hpp"
#include "mbs/base/types.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cardan {

/// Way in which a state settles while everything else stands still.
enum class StateKind : std::uint8_t {
    lag,         ///< to a value of its own: a current, a filter, an actuator
    integrator,  ///< it does not, and in a steady state its input vanishes: the integral part of a controller
    angle        ///< it grows for ever, and nothing depends on how far: the angle of a grid's voltage
};

/// A state s of first order: ds/dt = f(t, q, qd, s, u).
struct StateInfo {
    std::string name;  ///< unique among states, coordinates and inputs: "generator slip", "blade 1 pitch demand"
    std::string unit;  ///< SI: "A", "rad/s"; "1" for a pure number
    /// Scale of the state, > 0, in its unit: the size of tolerances, of steps of differences, of shares in modes.
    double scale = 0;
    double initial = 0;     ///< value at the start unless another is given
    std::string part = {};  ///< as of coordinates: "generator", "blade"
    int blade = 0;          ///< blade number counted from 1, 0: belongs to no blade
    StateKind kind = StateKind::lag;
};

/// An input u: a value from outside that is constant unless somebody changes it, such as a controller's demand.
struct InputInfo {
    std::string name;  ///< unique among states, coordinates and inputs
    std::string unit;
    double scale = 0;    ///< as of a state
    double initial = 0;  ///< value until it is changed
};

/// States, or inputs, of a system in their order.
template <class Info>
class NamedTable {
public:
    NamedTable() = default;
    explicit NamedTable(std::vector<Info> rows) : rows_(std::move(rows)) {}

    int size() const { return static_cast<int>(rows_.size()); }
    bool empty() const { return rows_.empty(); }
    /// @throws InputError for an index out of range
    const Info& operator[](int index) const {
        require_index("table of states", "index", index, size());
        return entry(rows_, index);
    }
    auto begin() const { return rows_.begin(); }
    auto end() const { return rows_.end(); }

    /// @throws InputError naming the state and some that exist
    int index(std::string_view name) const;
    /// -1: there is none of this name.
    int find(std::string_view name) const;
    /// Values of the states at the start.
    Vector initial() const;

private:
    std::vector<Info> rows_;
};

using StateTable = NamedTable<StateInfo>;
using InputTable = NamedTable<InputInfo>;
extern template class NamedTable<StateInfo>;
extern template class NamedTable<InputInfo>;

}  // namespace cardan
