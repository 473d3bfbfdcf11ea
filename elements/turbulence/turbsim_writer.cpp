#include "elements/turbulence/turbsim_writer.hpp"

#include "elements/turbulence/box_statistics.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "mbs/base/sizes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace cardan {

namespace {

// Little endian, whatever the machine.
template <class Number>
void append_little_endian(std::string& out, Number number) {
    using Bits = std::conditional_t<sizeof(Number) == 2, std::uint16_t, std::uint32_t>;
    const auto bits = std::bit_cast<Bits>(number);
    for (std::size_t byte = 0; byte < sizeof(Number); ++byte)
        out.push_back(static_cast<char>(static_cast<unsigned char>(bits >> (8 * byte))));
}

// velocity = (number - offset)/slope with numbers of 16 bits.
struct Packing {
    float slope = 1, offset = 0;

    Packing(double lowest, double highest) {
        constexpr double first = std::numeric_limits<std::int16_t>::min(),
                         last = std::numeric_limits<std::int16_t>::max();
        if (highest - lowest > 1e-6) {
            slope = static_cast<float>((last - first) / (highest - lowest));
            offset = static_cast<float>(first - slope * lowest);
        } else {
            offset = static_cast<float>(-lowest);
        }
    }
    std::int16_t operator()(double velocity) const {
        constexpr double first = std::numeric_limits<std::int16_t>::min(),
                         last = std::numeric_limits<std::int16_t>::max();
        return static_cast<std::int16_t>(std::clamp(std::round(velocity * slope + offset), first, last));
    }
};

void check_turbsim(const TurbulenceBox& box, const TurbsimFile& file) {
    constexpr auto where = "TurbSim file";
    const BoxGrid& grid = box.grid;
    for (const auto& [name, number] : {std::pair("rows", grid.rows), {"columns", grid.columns}, {"steps", grid.steps}})
        if (number < 2) throw InputError(where, name, number, ">= 2");
    require_positive(where, "time step [s]", grid.time_step);
    require_positive(where, "spacing of the rows [m]", grid.row_spacing);
    require_positive(where, "spacing of the columns [m]", grid.column_spacing);
    require_positive(where, "speed of the box [m/s]", box.speed);
    require_positive(where, "height of the lowest row [m]", grid.lowest);
    for (const std::vector<float>& values : box.velocity)
        require_count(where, "velocities of the box", values.size(), box.index(grid.steps, 0, 0));
    file.mean.check();
    for (const auto& [name, angle] : {std::pair("direction of the mean wind [rad]", file.mean.direction),
                                      {"veer of the mean wind [rad/m]", file.mean.veer},
                                      {"upflow of the mean wind [rad]", file.mean.upflow}})
        if (angle != 0) throw InputError(where, name, angle, "0; a file is turned where it is read");
    constexpr std::size_t longest = 200;  // of readers
    if (file.text.size() > longest)
        throw InputError(where, "characters of the text", file.text.size(), text("at most ", longest));
    for (const char c : file.text)
        if (is_control(c) || static_cast<unsigned char>(c) > 0x7F)
            throw InputError(where, "text", file.text, "printable ASCII characters");
}

}  // namespace

void write_turbsim(const std::filesystem::path& path, const TurbulenceBox& box, const TurbsimFile& file) {
    check_turbsim(box, file);
    const BoxGrid& grid = box.grid;
    const auto points = static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns);

    std::array<std::vector<double>, 3> means;
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            const double y = column * grid.column_spacing - grid.width() / 2, z = grid.lowest + row * grid.row_spacing;
            const Vec3 mean = file.mean.at({0, y, z + file.mean.ground});
            for (int k = 0; k < 3; ++k) entry(means, k).push_back(mean[k]);
        }
    // On the tower's line, the first one at the height of the lowest row.
    int tower_points = 0;
    const auto middle = static_cast<std::size_t>(centre_column(grid));
    for (double z = grid.lowest; file.tower && z > 0; z = grid.lowest - tower_points * grid.row_spacing) {
        const Vec3 mean = file.mean.at({0, 0, z + file.mean.ground});
        for (int k = 0; k < 3; ++k) entry(means, k).push_back(mean[k]);
        ++tower_points;
    }
    const std::size_t places = points + static_cast<std::size_t>(tower_points);
    const auto velocity = [&](int k, int step, std::size_t place) {
        const std::size_t point = place < points ? place : middle;
        return entry(box.velocity, k)[static_cast<std::size_t>(step) * points + point] + entry(means, k)[place];
    };
    std::vector<Packing> packings;
    for (int k = 0; k < 3; ++k) {
        double lowest = HUGE_VAL, highest = -HUGE_VAL;
        for (int step = 0; step < grid.steps; ++step)
            for (std::size_t place = 0; place < places; ++place) {
                const double value = velocity(k, step, place);
                if (!std::isfinite(value))
                    throw InputError("TurbSim file", text("velocity of component ", k, " at step ", step, " [m/s]"),
                                     value, "finite");
                lowest = std::min(lowest, value);
                highest = std::max(highest, value);
            }
        packings.emplace_back(lowest, highest);
    }

    std::string out;
    with_memory([&] { return text("a TurbSim file of ", grid.steps, " steps at ", points, " points"); },
                [&] { out.reserve(70 + file.text.size() + 6 * places * static_cast<std::size_t>(grid.steps)); });
    append_little_endian(out, static_cast<std::int16_t>(file.periodic ? 8 : 7));
    for (const std::int32_t number : {grid.rows, grid.columns, tower_points, grid.steps})
        append_little_endian(out, number);
    const double hub = file.mean.reference_height;
    for (const double number : {grid.row_spacing, grid.column_spacing, grid.time_step, box.speed, hub, grid.lowest})
        append_little_endian(out, static_cast<float>(number));
    for (const Packing& packing : packings) {
        append_little_endian(out, packing.slope);
        append_little_endian(out, packing.offset);
    }
    append_little_endian(out, static_cast<std::int32_t>(file.text.size()));
    out += file.text;
    for (int step = 0; step < grid.steps; ++step)
        for (std::size_t place = 0; place < places; ++place)
            for (int k = 0; k < 3; ++k) append_little_endian(out, entry(packings, k)(velocity(k, step, place)));
    write_file(path, out);
}

}  // namespace cardan
