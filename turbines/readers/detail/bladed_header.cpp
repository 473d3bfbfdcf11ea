#include "turbines/readers/detail/bladed_header.hpp"

#include <limits>

namespace cardan::turbines {

namespace {

constexpr int bladed_points = std::numeric_limits<int>::max();
constexpr int bladed_half = (std::numeric_limits<int>::max() - 1) / 2;
constexpr double bladed_far = 1e5;

// The old kind: int16 throughout, lengths in mm, the speed in 0.1 m/s, points in thousands.
BladedHeader old_header(BoxHeader& in, int components, int& half) {
    constexpr int most = std::numeric_limits<std::int16_t>::max();
    constexpr double millimetre = 1e-3;
    BladedHeader out;
    out.components = components;
    out.row_spacing = in.integer<std::int16_t>("distance of points upward [mm]", 1, most) * millimetre;
    out.column_spacing = in.integer<std::int16_t>("distance of points across [mm]", 1, most) * millimetre;
    out.plane_spacing = in.integer<std::int16_t>("distance of planes [mm]", 1, most) * millimetre;
    half = in.integer<std::int16_t>("half the number of planes", 1, most);
    out.speed = in.integer<std::int16_t>("mean wind speed [0.1 m/s]", 1, 10000) * 0.1;
    in.skip("length scales, seed", 5 * sizeof(std::int16_t));
    out.rows = in.integer<std::int16_t>("1000 times the number of points upward", 2000, most) / 1000;
    out.columns = in.integer<std::int16_t>("1000 times the number of points across", 2000, most) / 1000;
    if (components == 3) in.skip("length scales of v and w", 6 * sizeof(std::int16_t));
    return out;
}

int number_of_components(BoxHeader& in) {
    return in.integer("number of components", 1, 3);
}

// What stands between the kind of turbulence and the grid.
void read_turbulence(BoxHeader& in, int kind, BladedHeader& out) {
    constexpr double most = 1e4;
    switch (kind) {
        case 1:
        case 2:
            out.components = 1;
            break;
        case 3:
        case 5:
            out.components = 3;
            break;
        case 4:
            out.components = number_of_components(in);
            in.skip("latitude, roughness, reference height", 3 * sizeof(float));
            for (double& one : out.intensities) one = std::max(0.0, in.real("intensity [%]", -most, most));
            break;
        case 7:
        case 8:
            in.skip("size of the header", sizeof(std::int32_t));
            out.components = number_of_components(in);
            break;
        default:
            in.fail(text("kind of turbulence = ", kind, "; allowed: 1, 2, 3, 4, 5, 7, 8"));
    }
}

BladedHeader new_header(BoxHeader& in, int& half) {
    BladedHeader out;
    const int kind = in.next<std::int16_t>("kind of turbulence");
    read_turbulence(in, kind, out);
    out.row_spacing = in.positive("distance of points upward [m]", bladed_far);
    out.column_spacing = in.positive("distance of points across [m]", bladed_far);
    out.plane_spacing = in.positive("distance of planes [m]", bladed_far);
    half = in.integer("half the number of planes", 1, bladed_half);
    out.speed = in.positive("mean wind speed [m/s]", 1e3);
    in.skip("length scales, seed", 3 * sizeof(float) + 2 * sizeof(std::int32_t));
    out.rows = in.integer("number of points upward", 2, bladed_points);
    out.columns = in.integer("number of points across", 2, bladed_points);
    if (out.components == 3) in.skip("length scales of v and w", 6 * sizeof(float));
    if (kind == 7) in.skip("decay and scale of the coherence", 2 * sizeof(float));
    if (kind == 8) in.skip("parameters of the Mann model", 16 * sizeof(float));
    return out;
}

}  // namespace

BladedHeader read_bladed_header(const MappedFile& file) {
    constexpr int newer = -99;
    BoxHeader in(file);
    const int id = in.next<std::int16_t>("kind of file");
    if (id != newer && (id < -3 || id > -1))
        in.fail(text("begins with ", id, "; a wind file of Bladed's kind (.wnd) begins with -99, -1, -2 or -3",
                     id == 7 || id == 8 ? "; this may be one of TurbSim (.bts)" : ""));
    int half = 0;
    BladedHeader out = id == newer ? new_header(in, half) : old_header(in, -id, half);
    out.data = in.at();
    const std::size_t of_plane =
        saturated_product({out.points(), static_cast<std::size_t>(out.components), sizeof(std::int16_t)});
    const std::size_t there = file.bytes().size() - out.data;
    // Writers halve an odd number of planes.
    const bool odd = of_plane <= there && there / of_plane == 2 * static_cast<std::size_t>(half) + 1;
    out.planes = 2 * half + (odd ? 1 : 0);
    const std::size_t numbers = saturated_product({of_plane, static_cast<std::size_t>(out.planes)});
    require_length(file, out.data, numbers,
                   text(out.planes, " planes of ", out.rows, " x ", out.columns, " points, ", out.components,
                        out.components == 1 ? " component" : " components"));
    return out;
}

WindBoxData bladed_numbers(const MappedFile& file, const BladedHeader& header, double speed, bool mirrored) {
    WindBoxData box;
    box.grid = {.steps = header.planes,
                .rows = header.rows,
                .columns = header.columns,
                .time_step = header.plane_spacing / speed,
                .row_spacing = header.row_spacing,
                .column_spacing = header.column_spacing};
    const auto components = static_cast<std::size_t>(header.components);
    for (std::size_t c = 0; c < 3; ++c) {
        const bool there = c < components;
        const std::size_t first =
            (there ? c : 0) + (mirrored ? components * static_cast<std::size_t>(header.columns - 1) : 0);
        BoxNumbers& of = box.components[c];
        of = numbers_in(file, 0, BoxNumbers::Type::int16, header.data + first * sizeof(std::int16_t));
        of.step = static_cast<std::ptrdiff_t>(components * header.points());
        of.row = std::ptrdiff_t{header.components} * header.columns;
        of.column = mirrored ? -header.components : header.components;
        of.scale = there ? 1 : 0;
    }
    box.speed = speed;
    return box;
}

}  // namespace cardan::turbines
