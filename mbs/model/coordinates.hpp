/// @file
/// The table that says what every coordinate means. It accompanies every result.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/base/sizes.hpp"
#include "mbs/base/types.hpp"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace cardan {

/// Free coordinates are unknowns; driven ones have prescribed position, velocity and acceleration.
enum class CoordinateRole : std::uint8_t { free, prescribed };

struct CoordinateInfo {
    std::string name;                            ///< unique, e.g. "blade 1 element 2 flap bending inboard"
    std::string part = {};                       ///< the part it belongs to, e.g. "tower", "drive train", "blade"
    int blade = 0;                               ///< blade number counted from 1, 0: belongs to no blade
    CoordinateRole role = CoordinateRole::free;  ///< default role; solvers may be given another
    std::string unit = {};                       ///< "rad" or "m"; filled in by the tree
};

/// A number for a coordinate, by its name.
struct NamedNumber {
    std::string_view coordinate;
    double value;
};

/// Coordinates of a model in its order.
class CoordinateTable {
public:
    CoordinateTable() = default;
    explicit CoordinateTable(std::vector<CoordinateInfo> rows) : rows_(std::move(rows)) {}

    int size() const { return static_cast<int>(rows_.size()); }
    /// @throws InputError for an index out of range
    const CoordinateInfo& operator[](int index) const {
        require_index("table of coordinates", "index", index, size());
        return entry(rows_, index);
    }
    auto begin() const { return rows_.begin(); }
    auto end() const { return rows_.end(); }

    /// @throws InputError naming the coordinate and some that exist.
    int index(std::string_view name) const;
    /// A number for each coordinate, such as positions or rates: those that are named, zero for the others.
    /// @throws InputError for a name that does not exist or stands twice
    Vector vector(std::initializer_list<NamedNumber> named) const;
    /// Indices of the coordinates with role free.
    std::vector<int> free() const;
    /// The free coordinates without one of them: the unknowns of a steady rotation, whose spin is prescribed; -1: all.
    std::vector<int> free_without(int index) const;
    /// One flag per coordinate: true where the role is driven.
    std::vector<bool> driven() const;
    /// Names of parts in order of first appearance.
    std::vector<std::string> parts() const;
    /// Indices of the coordinates of a part, all blades or one (numbered from 1).
    std::vector<int> of_part(std::string_view part, int blade = 0) const;

private:
    std::vector<CoordinateInfo> rows_;
};

}  // namespace cardan
