#include "turbines/readers/hawc2_box.hpp"

#include "turbines/readers/detail/box_bytes.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

namespace {

constexpr auto hawc2_box = "box of HAWC2's kind";

void require_counts(const Hawc2Box& given) {
    for (const auto& [name, count] : {std::pair("planes along the wind", given.planes),
                                      {"points upward", given.rows},
                                      {"points across", given.columns}})
        if (count < 2) throw InputError(hawc2_box, text("number of ", name), count, "at least 2");
    require_positive(hawc2_box, "distance of the planes [m]", given.plane_spacing);
    require_positive(hawc2_box, "distance of points upward [m]", given.row_spacing);
    require_positive(hawc2_box, "distance of points across [m]", given.column_spacing);
}

void require_scaling(const Hawc2Box& given) {
    given.mean.check();
    require_positive(hawc2_box, "mean wind speed [m/s]", given.mean.speed);
    if (!std::isfinite(given.start)) throw InputError(hawc2_box, "place of the first plane [m]", given.start, "finite");
    for (const double factor : given.factors)
        if (!(std::abs(factor) <= 1e6)) throw InputError(hawc2_box, "factor", factor, "-1e6 ... 1e6");
    for (const double deviation : given.deviations)
        if (!(deviation >= 0 && deviation <= 1e3))
            throw InputError(hawc2_box, "standard deviation [m/s]", deviation, "0 ... 1000");
}

// One pass: the checksum, and whether every number is finite and one of a velocity.
void look_through(const MappedFile& file, BoxSources& sources) {
    constexpr std::size_t piece = std::size_t{1} << 20;  // bytes, from the cache the second time
    constexpr float most = 1e6F;
    const std::span<const std::byte> all = file.bytes();
    file.require_whole();
    for (std::size_t from = 0; from < all.size(); from += piece) {
        const auto own = all.subspan(from, std::min(piece, all.size() - from));
        sources.sum(own);
        for (std::size_t i = 0; i + sizeof(float) <= own.size(); i += sizeof(float)) {
            float value = 0;
            std::memcpy(&value, own.data() + i, sizeof value);
            if (!(std::abs(value) <= most))
                throw FileError(file.path(), text("byte ", from + i, ": ", value, "; allowed: -1e6 ... 1e6"));
        }
    }
    file.require_whole();
}

BoxNumbers hawc2_component(const Hawc2Box& given, const MappedFile& file, int number) {
    const std::ptrdiff_t row = 1, column = given.rows, plane = column * given.columns;
    const bool last_first = given.order == PlaneOrder::last_first;
    const std::ptrdiff_t first = (given.columns - 1) * column + (last_first ? (given.planes - 1) * plane : 0);
    BoxNumbers out =
        numbers_in(file, number, BoxNumbers::Type::float32, static_cast<std::size_t>(first) * sizeof(float));
    out.step = last_first ? -plane : plane;
    out.row = row;
    out.column = -column;
    return out;
}

void scale_as_given(const Hawc2Box& given, WindBoxData& box) {
    if (given.scaling == BoxScaling::none) return;
    if (given.scaling == BoxScaling::factors) {
        for (std::size_t c = 0; c < 3; ++c) box.components[c].scale = given.factors[c];
        return;
    }
    const Vec3 is = WindBox(box).statistics((box.grid.rows - 1) / 2, (box.grid.columns - 1) / 2).deviation;
    for (std::size_t c = 0; c < 3; ++c) {
        const double deviation = is(static_cast<Eigen::Index>(c)), wanted = given.deviations[c];
        if (wanted > 0 && !(deviation > 0))
            throw FileError(given.files[c].string(),
                            text("does not change at the middle point; allowed: another standard deviation than ",
                                 wanted, " m/s: 0"));
        box.components[c].scale = deviation > 0 ? wanted / deviation : 0;
    }
}

// Of u at each point, by rows.
std::vector<double> means_of(const WindBoxData& box) {
    const auto rows = static_cast<std::size_t>(box.grid.rows), columns = static_cast<std::size_t>(box.grid.columns);
    std::vector<double> out(rows * columns);
    const WindBox numbers(box);
    for (int t = 0; t < box.grid.steps; ++t)
        for (int j = 0; j < box.grid.columns; ++j)  // as they lie
            for (int k = 0; k < box.grid.rows; ++k)
                out[static_cast<std::size_t>(k) * columns + static_cast<std::size_t>(j)] +=
                    numbers.at_point(t, k, j).x();
    for (double& mean : out) mean /= box.grid.steps;
    return out;
}

}  // namespace

WindBoxFile read_hawc2_box(const Hawc2Box& given) {
    require_counts(given);
    require_scaling(given);
    const double speed = given.mean.speed;
    WindBoxData box;
    box.grid = {.steps = given.planes,
                .rows = given.rows,
                .columns = given.columns,
                .time_step = given.plane_spacing / speed,
                .row_spacing = given.row_spacing,
                .column_spacing = given.column_spacing};
    box.grid.lowest = given.mean.reference_height - box.grid.height() / 2;
    const std::size_t bytes =
        saturated_product({static_cast<std::size_t>(given.planes), static_cast<std::size_t>(given.columns),
                           static_cast<std::size_t>(given.rows), sizeof(float)});
    BoxSources sources;
    for (std::size_t c = 0; c < 3; ++c) {
        const MappedFile& file = sources.map(given.files[c]);
        require_length(file, 0, bytes,
                       text(given.planes, " planes of ", given.columns, " x ", given.rows, " numbers of 4 bytes"));
        look_through(file, sources);
        box.components[c] = hawc2_component(given, file, static_cast<int>(c));
    }
    box.speed = speed;
    box.periodic = true;
    box.start = given.start;
    box.below = BelowBox::to_ground;
    scale_as_given(given, box);
    if (given.scaling != BoxScaling::none) box.means = means_of(box);
    box.origin = sources.origin("HAWC2 .bin");
    sources.keep_in(box);
    WindBoxFile out;
    out.box = std::make_shared<const WindBox>(std::move(box));
    out.mean = given.mean;
    return out;
}

}  // namespace cardan::turbines
