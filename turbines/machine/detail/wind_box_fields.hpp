/// @file
/// Wind boxes as fields of a text: where their numbers lie in which files. Internal: not installed.
#pragma once

#include "elements/wind/wind_box.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace cardan {

inline const char* name_of(BoxNumbers::Type type) {
    return type == BoxNumbers::Type::int16 ? "int16" : "float32";
}
inline const char* name_of(BelowBox below) {
    return below == BelowBox::refuse ? "refuse" : below == BelowBox::tower ? "tower" : "to_ground";
}

}  // namespace cardan

namespace cardan::turbines {

/// The fields of a box, listed once for both writing and reading.
struct WindBoxFields {
    std::vector<std::string> files;  ///< absolute; none: the box was made in memory
    std::string format, checksum, note;
    BoxNumbers::Type type = BoxNumbers::Type::float32;
    BoxGrid grid;
    std::vector<double> u, v, w;  ///< file, byte, strides of step, row and column, scale, offset
    int tower_points = 0;
    double tower_highest = 0, tower_spacing = 0;
    std::vector<double> tower_u, tower_v, tower_w;  ///< likewise; of no points none
    std::vector<double> means;
    double speed = 0, start = 0;
    bool periodic = false;
    BelowBox below = BelowBox::refuse;
    OutsideBox outside = OutsideBox::refuse;
};

inline constexpr int max_in_box = 1 << 30;  // planes, points: of a file that is mapped

template <class Archive, class Fields>
void wind_box_fields(Archive& archive, Fields& f) {
    archive.counted_groups("files", f.files, [&](auto& file) { archive.word("wind_file", file); });
    archive.word("format", f.format);
    archive.word("checksum", f.checksum);
    archive.word("note", f.note);
    archive.optional_choice("numbers", f.type, {BoxNumbers::Type::int16, BoxNumbers::Type::float32});
    archive.integer("planes", f.grid.steps, max_in_box);
    archive.integer("rows", f.grid.rows, max_in_box);
    archive.integer("columns", f.grid.columns, max_in_box);
    archive.number("time_step", f.grid.time_step);
    archive.number("row_spacing", f.grid.row_spacing);
    archive.number("column_spacing", f.grid.column_spacing);
    archive.number("lowest", f.grid.lowest);
    archive.numbers("u", f.u);
    archive.numbers("v", f.v);
    archive.numbers("w", f.w);
    archive.integer("tower_points", f.tower_points, max_in_box);
    archive.number("tower_highest", f.tower_highest);
    archive.number("tower_spacing", f.tower_spacing);
    archive.numbers("tower_u", f.tower_u);
    archive.numbers("tower_v", f.tower_v);
    archive.numbers("tower_w", f.tower_w);
    archive.numbers("means", f.means);
    archive.number("speed", f.speed);
    archive.number("start", f.start);
    archive.flag("periodic", f.periodic);
    archive.optional_choice("below", f.below, {BelowBox::refuse, BelowBox::tower, BelowBox::to_ground});
    archive.optional_choice("outside", f.outside, {OutsideBox::refuse, OutsideBox::hold, OutsideBox::repeat});
}

WindBoxFields fields_of(const WindBox& box);

/// Maps the files again, which have to be those that were: by their checksum.
/// @param beside  folder in which files are sought that are no longer at their paths
/// @throws FileError, InputError
std::shared_ptr<const WindBox> wind_box_of(const WindBoxFields& fields, const std::filesystem::path& beside);

}  // namespace cardan::turbines
