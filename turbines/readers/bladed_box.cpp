// Wind files of Bladed's kind with a summary beside them: InflowWind's WindType 4.
#include "turbines/readers/bladed_box.hpp"

#include "mbs/base/text_file.hpp"
#include "turbines/readers/detail/bladed_header.hpp"
#include "turbines/readers/detail/openfast_words.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cardan::turbines {

namespace {

struct BladedSummary {
    bool mirrored = false, periodic = false, left_hand = false;
    double hub_height = 0, speed = 0, height_offset = 0;
    std::array<double, 3> intensities = {};  // %
};

// Reads a summary line by line, in the order in which InflowWind looks for its entries.
class SummaryLines {
public:
    SummaryLines(std::string all, std::string file) : file_(std::move(file)), all_(std::move(all)) {}

    bool next() {
        if (at_ >= all_.size()) return false;
        const std::size_t end = std::min(all_.find('\n', at_), all_.size());
        line_ = all_.substr(at_, end - at_);
        at_ = end + 1;
        ++number_;
        for (char& c : line_) c = upper_case(c);
        return true;
    }
    bool has(std::string_view what) const { return line_.find(what) != std::string::npos; }
    // The first word of the line, or of what stands behind its equals sign, as a number.
    double number(std::string_view what, double min, double max) const {
        const auto value = fortran_number(first_word(line_.find('=') + 1));  // npos + 1 = 0
        if (!value) fail(text("no number for ", what, ": '", line_, "'"));
        if (*value < min || *value > max) fail(text(what, " = ", *value, "; allowed: ", min, " ... ", max));
        return *value;
    }
    bool truth(std::string_view what) const {
        const std::string_view word = first_word(0);
        const char c = word.empty() ? ' ' : word.front() == '.' && word.size() > 1 ? word[1] : word.front();
        if (c != 'T' && c != 'Y' && c != 'F' && c != 'N')
            fail(text("no T or F, nor Yes or No, for ", what, ": '", line_, "'"));
        return c == 'T' || c == 'Y';
    }
    [[noreturn]] void fail(std::string_view what) const { throw ParseError(file_, number_, 0, what); }

private:
    std::string_view first_word(std::size_t from) const {
        const auto words = words_of(std::string_view(line_).substr(from));
        if (words.empty()) return {};
        return words.front().substr(0, words.front().find('%'));
    }

    std::string file_, all_, line_;
    std::size_t at_ = 0;  // in all
    int number_ = 0;
};

// To the line that has the entry.
void find_entry(SummaryLines& in, std::string_view entry) {
    while (in.next())
        if (in.has(entry)) return;
    in.fail(text("ends without the entry '", entry,
                 "'; allowed: CLOCKWISE, HUB HEIGHT, UBAR =, three lines of "
                 "intensities = ... %, HEIGHT OFFSET =, in this order"));
}

void read_height(SummaryLines& in, BladedSummary& out) {
    constexpr auto turning = "CLOCKWISE", height = "HUB HEIGHT";
    bool found = false;
    while (in.next()) {
        if (!found && in.has(turning)) {
            out.mirrored = in.truth(turning);
            found = true;
        }
        if (!in.has(height) && !in.has("ZHUB")) continue;
        out.hub_height = in.number(height, 1e-3, 1e5);
        return;
    }
    in.fail(text("ends without the entry '", height, "'"));
}

BladedSummary read_bladed_summary(std::string all, const std::string& file) {
    require_text(all, file, TextRules::any_bytes);
    SummaryLines in(std::move(all), file);
    BladedSummary out;
    read_height(in, out);
    find_entry(in, "UBAR");
    out.speed = in.number("UBAR [m/s]", 0, 1e3);
    for (double& one : out.intensities) {
        if (!in.next()) in.fail("ends within the three intensities of turbulence that follow UBAR");
        one = in.number("intensity [%]", 0, 1e4);
    }
    while (in.next())
        if (in.has("HEIGHT OFFSET")) {
            out.height_offset = in.number("HEIGHT OFFSET [m]", -1e5, 1e5);
            break;
        }
    while (in.next()) {
        if (in.has("PERIODIC")) out.periodic = true;
        if (in.has("BLADED LEFT-HAND RULE")) out.left_hand = true;
    }
    return out;
}

// Points of the tower: their distance, that of the planes, height of the highest, planes, points, speed, intensities,
// then numbers by planes, points, components.
BoxTower read_tower_points(const MappedFile& file, const WindBoxData& box, double plane_spacing) {
    BoxHeader in(file);
    const auto same = [&](const char* what, double value, double expected) {
        if (!(std::abs(value - expected) <= 1e-4 * std::abs(expected)))
            in.fail(text(what, " = ", value, "; allowed: ", expected, ", as in the .wnd"));
    };
    BoxTower tower;
    tower.spacing = in.next<float>("distance of points [m]");
    same("distance of points [m]", tower.spacing, box.grid.row_spacing);
    same("distance of planes [m]", in.next<float>("distance of planes [m]"), plane_spacing);
    tower.highest = in.next<float>("height of the highest point [m]");
    same("height of the highest point [m]", tower.highest, box.grid.lowest);
    in.integer("number of planes", box.grid.steps, box.grid.steps);
    tower.points = in.integer("number of points", 1, std::numeric_limits<int>::max());
    same("mean wind speed [m/s]", in.next<float>("mean wind speed [m/s]"), box.speed);
    std::array<double, 3> intensities = {};
    for (double& one : intensities) one = in.real("intensity [%]", 0, 1e4);
    constexpr std::size_t of_point = 3 * sizeof(std::int16_t);
    const auto points = static_cast<std::size_t>(tower.points);
    require_length(file, in.at(), saturated_product({points, of_point, static_cast<std::size_t>(box.grid.steps)}),
                   text(box.grid.steps, " planes of ", tower.points, " points"));
    for (std::size_t c = 0; c < 3; ++c) {
        BoxNumbers& of = tower.components[c];
        of = numbers_in(file, 1, BoxNumbers::Type::int16, in.at() + c * sizeof(std::int16_t));
        of.step = static_cast<std::ptrdiff_t>(3 * points);
        of.row = 3;
        of.scale = 1e-5 * intensities[c] * box.speed;
        of.offset = c == 0 ? box.speed : 0;
    }
    return tower;
}

// The intensities by which the numbers count: those of the header where it has them.
std::array<double, 3> intensities_of(const BladedHeader& header, const BladedSummary& summary, const std::string& file,
                                     std::vector<FileNote>& notes) {
    std::array<double, 3> out = summary.intensities;
    for (std::size_t c = 0; c < 3; ++c) {
        if (!(header.intensities[c] > 0)) continue;
        out[c] = header.intensities[c];
        constexpr const char* names[] = {"TI(u)", "TI(v)", "TI(w)"};
        if (std::abs(out[c] - summary.intensities[c]) > 1e-3 * out[c])
            notes.push_back({file, 0, names[c], text(summary.intensities[c], " %"),
                             text("that of the .wnd counts, ", out[c], " %")});
    }
    return out;
}

}  // namespace

WindBoxFile read_bladed_box(const std::filesystem::path& path, TowerFile tower) {
    BoxSources sources;
    const MappedFile& file = sources.map(path);
    const BladedHeader header = read_bladed_header(file);
    sources.sum();
    WindBoxFile out;
    const auto beside = [&](const char* ending) { return file_beside(path, path.stem().string() + ending); };
    const MappedFile* const tower_file = tower == TowerFile::beside ? &sources.map(beside(".twr")) : nullptr;
    if (tower_file != nullptr) sources.sum();
    const std::filesystem::path summary_path = beside(".sum");
    const std::string summary_name = summary_path.string(), all = text_file(summary_path);
    sources.name(summary_path);
    sources.sum(std::as_bytes(std::span(all)));
    const BladedSummary summary = read_bladed_summary(all, summary_name);
    if (std::abs(summary.speed - header.speed) > 0.1)
        throw FileError(summary_name, text("UBAR = ", summary.speed, " m/s; allowed: ", header.speed,
                                           ", as in the .wnd, or they do not belong together"));

    WindBoxData box = bladed_numbers(file, header, header.speed, summary.mirrored);
    box.grid.lowest = summary.hub_height - summary.height_offset - box.grid.height() / 2;
    const auto intensities = intensities_of(header, summary, summary_name, out.notes);
    for (std::size_t c = 0; c < 3; ++c) box.components[c].scale *= 1e-5 * header.speed * intensities[c];
    box.components[0].offset = header.speed;
    if (summary.left_hand) box.components[1].scale *= -1;
    if (tower_file != nullptr) {
        box.tower = read_tower_points(*tower_file, box, header.plane_spacing);
        box.below = BelowBox::tower;
    }
    box.periodic = summary.periodic;
    box.start = box.periodic ? 0 : box.grid.width() / 2;
    box.origin = sources.origin("Bladed .wnd with .sum");
    sources.keep_in(box);
    out.box = std::make_shared<const WindBox>(std::move(box));
    out.mean.reference_height = summary.hub_height;
    return out;
}

}  // namespace cardan::turbines
