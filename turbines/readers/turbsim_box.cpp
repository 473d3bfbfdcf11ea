#include "turbines/readers/turbsim_box.hpp"

#include "turbines/readers/detail/box_bytes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace cardan::turbines {

namespace {

struct TurbSimHeader {
    bool periodic = false;
    BoxGrid grid;
    int tower_points = 0;
    double speed = 0, reference_height = 0;
    std::array<double, 3> slopes = {}, offsets = {};
    std::string note;
    std::size_t data = 0;  // byte at which the numbers begin
};

bool turbsim_is_periodic(BoxHeader& in) {
    constexpr int aperiodic = 7, periodic = 8;
    const int id = in.next<std::int16_t>("kind of file");
    if (id == periodic || id == aperiodic) return id == periodic;
    in.fail(text("begins with ", id, "; a file of TurbSim (.bts) begins with 7 or 8",
                 id < 0 && id >= -99 ? "; this may be one of Bladed's kind (.wnd)" : ""));
}

// Numbers over a velocity, of one component.
void read_scaling(BoxHeader& in, std::size_t component, TurbSimHeader& out) {
    constexpr const char *slopes[] = {"slope of u", "slope of v", "slope of w"},
                         *offsets[] = {"offset of u", "offset of v", "offset of w"};
    constexpr double most = 1e30;
    const double slope = in.real(slopes[component], -most, most);
    if (std::abs(slope) < 1)
        in.fail(text(slopes[component], " = ", slope,
                     " s/m; allowed: at least 1 in size, or a step of the numbers would be more than 1 m/s"));
    out.slopes[component] = slope;
    out.offsets[component] = in.real(offsets[component], -most, most);
}

TurbSimHeader read_turbsim_header(const MappedFile& file) {
    constexpr int most = std::numeric_limits<int>::max();
    constexpr double far = 1e5;
    BoxHeader in(file);
    TurbSimHeader out;
    out.periodic = turbsim_is_periodic(in);
    BoxGrid& grid = out.grid;
    grid.rows = in.integer("number of points upward", 2, most);
    grid.columns = in.integer("number of points across", 2, most);
    out.tower_points = in.integer("number of points of the tower", 0, most);
    grid.steps = in.integer("number of planes", 2, most);
    grid.row_spacing = in.positive("distance of points upward [m]", far);
    grid.column_spacing = in.positive("distance of points across [m]", far);
    grid.time_step = in.positive("time between planes [s]", far);
    out.speed = in.positive("mean wind speed [m/s]", 1e3);
    out.reference_height = in.positive("height of the hub [m]", far);
    grid.lowest = in.real("height of the lowest points [m]", -far, far);
    for (std::size_t c = 0; c < 3; ++c) read_scaling(in, c, out);
    const int length = in.integer("length of the description", 0, most);
    out.note = printable(in.characters("description", length));
    out.data = in.at();
    return out;
}

// All numbers are those of winds, which a slope or an offset of another unit makes absurd.
void require_winds(const MappedFile& file, const TurbSimHeader& header) {
    constexpr double max = 1e3;  // m/s
    constexpr const char* names[] = {"u", "v", "w"};
    const std::span<const std::byte> all = file.bytes().subspan(header.data);
    using Limits = std::numeric_limits<std::int16_t>;
    std::array<std::int16_t, 3> low{Limits::max(), Limits::max(), Limits::max()},
        high{Limits::min(), Limits::min(), Limits::min()}, own{};
    for (std::size_t i = 0; i + sizeof own <= all.size(); i += sizeof own) {
        std::memcpy(own.data(), all.data() + i, sizeof own);
        for (std::size_t c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], own[c]);
            high[c] = std::max(high[c], own[c]);
        }
    }
    for (std::size_t c = 0; c < 3; ++c)
        for (const std::int16_t number : {low[c], high[c]}) {
            const double velocity = (number - header.offsets[c]) / header.slopes[c];
            if (!(std::abs(velocity) <= max))
                throw FileError(file.path(), text("byte ", 42 + 8 * c, ": by its slope and offset ", names[c],
                                                  " becomes ", velocity, " m/s; allowed: ", -max, " ... ", max));
        }
}

}  // namespace

WindBoxFile read_turbsim_box(const std::filesystem::path& path) {
    BoxSources sources;
    const MappedFile& file = sources.map(path);
    const TurbSimHeader header = read_turbsim_header(file);
    const BoxGrid& grid = header.grid;
    const auto points =
        saturated_product({static_cast<std::size_t>(grid.rows), static_cast<std::size_t>(grid.columns)});
    const auto on_tower = static_cast<std::size_t>(header.tower_points);
    constexpr std::size_t of_point = 3 * sizeof(std::int16_t);
    // No sum overflows: each count is below 2^31.
    const std::size_t numbers = saturated_product({points + on_tower, of_point, static_cast<std::size_t>(grid.steps)});
    require_length(file, header.data, numbers,
                   text(grid.steps, " planes of ", grid.rows, " x ", grid.columns, " points and ", header.tower_points,
                        " of the tower"));
    sources.sum();
    require_winds(file, header);

    WindBoxData box;
    box.grid = grid;
    const auto component = [&](std::size_t c, std::size_t first, std::ptrdiff_t row, std::ptrdiff_t column) {
        BoxNumbers of = numbers_in(file, 0, BoxNumbers::Type::int16, header.data + first * of_point + c * 2);
        of.step = static_cast<std::ptrdiff_t>(3 * (points + on_tower));
        of.row = row;
        of.column = column;
        of.scale = 1 / header.slopes[c];
        of.offset = -header.offsets[c] / header.slopes[c];
        return of;
    };
    for (std::size_t c = 0; c < 3; ++c) box.components[c] = component(c, 0, 3 * std::ptrdiff_t{grid.columns}, 3);
    if (on_tower > 0) {
        BoxTower& tower = box.tower.emplace();
        for (std::size_t c = 0; c < 3; ++c) tower.components[c] = component(c, points, 3, 0);
        tower.points = header.tower_points;
        tower.highest = grid.lowest;
        tower.spacing = grid.row_spacing;
        box.below = BelowBox::tower;
    }
    box.speed = header.speed;
    box.periodic = header.periodic;
    box.start = header.periodic ? 0 : grid.width() / 2;
    box.origin = sources.origin("TurbSim .bts", header.note);
    sources.keep_in(box);

    WindBoxFile out;
    out.box = std::make_shared<const WindBox>(std::move(box));
    out.mean.reference_height = header.reference_height;
    return out;
}

}  // namespace cardan::turbines
