#include "turbines/machine/detail/wind_box_fields.hpp"

#include "elements/wind/box_files.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/mapped_file.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cardan::turbines {

namespace {

constexpr std::size_t numbers_of_component = 7;

std::vector<double> list_of(const BoxNumbers& of) {
    return {static_cast<double>(of.file),
            static_cast<double>(of.place),
            static_cast<double>(of.step),
            static_cast<double>(of.row),
            static_cast<double>(of.column),
            of.scale,
            of.offset};
}

// In whole numbers as far as a double counts them.
std::int64_t whole(double value) {
    constexpr double max = 9e15;
    if (!(std::abs(value) < max) || std::trunc(value) != value)
        throw InputError("wind box", "place of numbers", value, "a whole number");
    return static_cast<std::int64_t>(value);
}

// Lowest and highest place that steps of a stride lead to, in numbers.
void stretch(std::pair<double, double>& reach, double stride, int count) {
    const double far = stride * (count - 1);
    (far < 0 ? reach.first : reach.second) += far;
}

BoxNumbers numbers_of(const std::vector<double>& list, BoxNumbers::Type type, const BoxFiles& files,
                      const std::array<int, 3>& counts) {
    if (list.size() != numbers_of_component)
        throw InputError("wind box", "numbers of a component", list.size(), text(numbers_of_component));
    const std::int64_t file = whole(list[0]), place = whole(list[1]);
    if (file < 0 || file >= static_cast<std::int64_t>(files.size()))
        throw InputError("wind box", "file of a component", file, text("0 ... ", files.size() - 1));
    const std::span<const std::byte> bytes = files[static_cast<std::size_t>(file)]->bytes();
    const double width = type == BoxNumbers::Type::int16 ? 2 : 4;
    std::pair<double, double> reach{0, 0};
    for (std::size_t i = 0; i < 3; ++i) stretch(reach, static_cast<double>(whole(list[2 + i])), counts.at(i));
    const double first = static_cast<double>(place) + width * reach.first,
                 end = static_cast<double>(place) + width * (reach.second + 1);
    if (!(first >= 0 && end <= static_cast<double>(bytes.size())))
        throw InputError("wind box", "end of a component's numbers [bytes]", end, text("up to ", bytes.size()));
    return {.data = bytes.data() + place,
            .type = type,
            .step = whole(list[2]),
            .row = whole(list[3]),
            .column = whole(list[4]),
            .scale = list[5],
            .offset = list[6],
            .file = static_cast<int>(file),
            .place = static_cast<std::uint64_t>(place)};
}

std::filesystem::path found(const std::filesystem::path& path, const std::filesystem::path& beside) {
    std::error_code none;
    if (std::filesystem::exists(path, none)) return path;
    const std::filesystem::path other = beside / path.filename();
    return std::filesystem::exists(other, none) ? other : path;
}

void require_checksum(const BoxFiles& files, const std::string& checksum) {
    std::uint64_t sum = checksum_of({});
    std::string all;
    for (const auto& file : files) {
        sum = checksum_of(file->bytes(), sum);
        all += (all.empty() ? "" : ", ") + file->path();
    }
    if (checksum_text(sum) != checksum)
        throw InputError(all, "checksum", checksum_text(sum), text(checksum, ", that of the wind box of the run"));
}

}  // namespace

WindBoxFields fields_of(const WindBox& box) {
    const WindBoxData& data = box.data();
    WindBoxFields out{.files = {},
                      .format = data.origin.format,
                      .checksum = data.origin.checksum,
                      .note = data.origin.note,
                      .type = data.components[0].type,
                      .grid = data.grid,
                      .u = list_of(data.components[0]),
                      .v = list_of(data.components[1]),
                      .w = list_of(data.components[2]),
                      .tower_u = {},
                      .tower_v = {},
                      .tower_w = {},
                      .means = data.means,
                      .speed = data.speed,
                      .start = data.start,
                      .periodic = data.periodic,
                      .below = data.below,
                      .outside = data.outside};
    for (const std::string& file : data.origin.files) out.files.push_back(std::filesystem::absolute(file).string());
    if (data.tower) {
        out.tower_points = data.tower->points;
        out.tower_highest = data.tower->highest;
        out.tower_spacing = data.tower->spacing;
        out.tower_u = list_of(data.tower->components[0]);
        out.tower_v = list_of(data.tower->components[1]);
        out.tower_w = list_of(data.tower->components[2]);
    }
    return out;
}

std::shared_ptr<const WindBox> wind_box_of(const WindBoxFields& f, const std::filesystem::path& beside) {
    if (f.files.empty())
        throw InputError("wind box", "files", "none: the box of the run was made in memory",
                         "a box that is a file: write_turbsim() makes one");
    const auto files = std::make_shared<BoxFiles>();
    for (const std::string& path : f.files) files->push_back(std::make_shared<const MappedFile>(found(path, beside)));
    require_checksum(*files, f.checksum);
    WindBoxData data{.grid = f.grid,
                     .components = {},
                     .means = f.means,
                     .speed = f.speed,
                     .start = f.start,
                     .periodic = f.periodic,
                     .below = f.below,
                     .outside = f.outside,
                     .origin = {f.files, f.format, f.checksum, f.note},
                     .memory = files,
                     .require_unchanged = change_guard(*files)};
    const std::array<int, 3> counts{f.grid.steps, f.grid.rows, f.grid.columns};
    const auto component = [&](const std::vector<double>& list) { return numbers_of(list, f.type, *files, counts); };
    data.components = {component(f.u), component(f.v), component(f.w)};
    if (f.tower_points > 0) {
        const std::array<int, 3> points{f.grid.steps, f.tower_points, 1};
        const auto along = [&](const std::vector<double>& list) { return numbers_of(list, f.type, *files, points); };
        data.tower = BoxTower{
            {along(f.tower_u), along(f.tower_v), along(f.tower_w)}, f.tower_points, f.tower_highest, f.tower_spacing};
    }
    return std::make_shared<const WindBox>(std::move(data));
}

}  // namespace cardan::turbines
