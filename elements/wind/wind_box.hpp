/// @file
/// Wind on a grid across it, over time, wherever the numbers lie: in a file that is mapped, or in memory.
///
/// Axes of a box: x downwind, y to the left as seen along the wind, z up, heights from the ground. The air is carried
/// through the grid with the box's speed and does not change on its way (frozen turbulence [Taylor]): a place x
/// downwind of the grid sees at t what the grid saw at t - x/speed.
#pragma once

#include "mbs/base/types.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cardan {

/// One component of the velocity as a field of numbers in memory, of which velocity = offset + scale number, m/s. The
/// number of step t, row k, column j lies at data + (t steps + k rows + j columns), counted in numbers.
struct BoxNumbers {
    enum class Type : std::uint8_t { int16, float32 };

    const void* data = nullptr;  ///< of step 0, row 0, column 0; aligned or not
    Type type = Type::float32;
    std::ptrdiff_t step = 0, row = 0, column = 0;  ///< strides, which may be negative
    double scale = 1, offset = 0;
    int file = 0;             ///< of BoxOrigin::files, in which they lie
    std::uint64_t place = 0;  ///< of the number of step 0, row 0, column 0 in that file, bytes
};

/// The grid of a box.
struct BoxGrid {
    int steps = 0;              ///< planes, at least 2
    int rows = 0, columns = 0;  ///< upward and to the left, at least 2
    double time_step = 0;       ///< between planes, s
    double row_spacing = 0;     ///< m
    double column_spacing = 0;  ///< m
    double lowest = 0;          ///< height of the first row, m

    double width() const { return (columns - 1) * column_spacing; }
    double height() const { return (rows - 1) * row_spacing; }
    double duration() const { return steps * time_step; }  ///< of a periodic box, s
    double height_of(int row) const { return lowest + row * row_spacing; }
    double place_of(int column) const { return column * column_spacing - width() / 2; }  ///< to the left, m
    int row_near(double z) const;     ///< the lower one of two that are as near
    int column_near(double y) const;  ///< likewise the right one
    friend bool operator==(const BoxGrid&, const BoxGrid&) = default;
};

/// Points on a vertical line below the grid, numbered downward, which stand for the wind at all places beside them.
struct BoxTower {
    std::array<BoxNumbers, 3> components;  ///< `row` is the stride from point to point, `column` is not used
    int points = 0;
    double highest = 0;  ///< height of the first point, m
    double spacing = 0;  ///< between them, m
};

/// Answers to what the wind is below the grid.
enum class BelowBox : std::uint8_t {
    refuse,  ///< there is none: an error
    tower,   ///< linear from the first row down the points of BoxTower, from the lowest of which to zero at the ground
    to_ground  ///< linear from the first row to zero at the ground
};

/// Answers to what the wind is beside and above the grid, before and after its planes.
enum class OutsideBox : std::uint8_t {
    refuse,  ///< there is none: an error
    hold,    ///< as on the nearest edge, and as in the first and the last plane
    repeat   ///< the box again, in time and across; above and below as hold
};
const char* name_of(OutsideBox outside);

/// Orders of the planes of a box that is counted downwind: the one that a fixed point sees first. Spectra and coherence
/// are the same, the sign of the phase over the height is not.
enum class PlaneOrder : std::uint8_t {
    last_first,  ///< the one furthest downwind, as the wind carries the box: what is higher leads in time
    first_first  ///< mirrored in time, as InflowWind of OpenFAST reads boxes: what is higher lags
};

/// The origin of a box, for results.
struct BoxOrigin {
    std::vector<std::string> files;  ///< whose bytes the numbers are, as they were given; empty: made in memory
    std::string format;              ///< "TurbSim .bts", ...
    std::string checksum;            ///< of these files, one after the other: checksum_text()
    std::string note;                ///< what the file says of itself, such as the program and its seed
};

/// A box as data.
struct WindBoxData {
    BoxGrid grid;
    std::array<BoxNumbers, 3> components;  ///< u, v, w: along x, y, z
    std::optional<BoxTower> tower = {};
    std::vector<double> means = {};  ///< taken off u at every point: rows times columns, by rows; empty: nothing is
    double speed = 0;                ///< with which the air passes the grid, > 0, m/s
    double start = 0;                ///< x of the first plane at t = 0, m: places see it at t = (x - start)/speed
    bool periodic = false;           ///< after the last plane comes the first
    BelowBox below = BelowBox::refuse;
    OutsideBox outside = OutsideBox::refuse;
    BoxOrigin origin = {};
    std::shared_ptr<const void> memory = {};  ///< keeps the numbers alive
    /// Throws FileError if the files have changed since they were read; none: there is nothing that could.
    std::function<void()> require_unchanged = {};
};

/// Wind of a box at places and times. Immutable, may be used by several threads.
class WindBox {
public:
    /// @throws InputError for a grid without two planes, rows or columns, spacings and a speed that are not positive
    explicit WindBox(WindBoxData data);

    struct Sample {
        Vec3 velocity;  ///< m/s
        Mat3 gradient =
            Mat3::Zero();  ///< dW_i/dx_j, 1/s: exact between the points of the grid, where the wind is linear
    };
    /// Interpolates linearly in time and across, between eight points of the box. At and below the ground there is no
    /// wind.
    /// @throws InputError for a place or a time outside, unless OutsideBox says what is there
    Vec3 at(const Vec3& place, double time) const;
    Sample with_gradient(const Vec3& place, double time) const;

    const WindBoxData& data() const { return data_; }
    /// Checks that the files are those that were read, for work that takes long.  @throws FileError if they are not
    void require_unchanged() const {
        if (data_.require_unchanged) data_.require_unchanged();
    }
    const BoxGrid& grid() const { return data_.grid; }
    /// Velocity at a point of the grid, m/s.
    Vec3 at_point(int step, int row, int column) const;
    /// Mean and standard deviation of each component over all planes, at a point of the grid.
    struct Statistics {
        Vec3 mean, deviation;  ///< deviation: of the population, m/s
    };
    Statistics statistics(int row, int column) const;
    /// A box of the same numbers, with another answer to what is outside.
    WindBox with_outside(OutsideBox outside) const;

private:
    template <class Number, bool slopes>
    void add_grid(const Vec3& place, double time, Sample& out) const;
    template <bool slopes>
    Sample sample(const Vec3& place, double time) const;

    WindBoxData data_;
};

/// FNV-1a of bytes, 64 bits, but eight bytes at a time, which is eight times as fast; the last ones, fewer than eight,
/// one at a time.
/// @param before  checksum of what comes before these bytes
std::uint64_t checksum_of(std::span<const std::byte> bytes, std::uint64_t before = 0xcbf29ce484222325ULL);
/// As 16 hexadecimal digits.
std::string checksum_text(std::uint64_t checksum);

}  // namespace cardan
