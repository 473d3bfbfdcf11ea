#include "turbines/readers/detail/box_bytes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::turbines {

const std::byte* BoxHeader::take(std::size_t bytes, std::string_view what) {
    const std::span<const std::byte> all = file_.bytes();
    if (all.size() - at_ < bytes)
        throw FileError(file_.path(), text("ends at byte ", all.size(), ", within its header: ", what, " (", bytes,
                                           " bytes) expected at byte ", at_));
    last_ = at_;
    at_ += bytes;
    return all.data() + last_;
}

void BoxHeader::fail(std::string_view what) const {
    throw FileError(file_.path(), text("byte ", last_, ": ", what));
}

int BoxHeader::in_range(std::string_view what, int value, int min, int max) const {
    if (value < min || value > max) fail(text(what, " = ", value, "; allowed: ", min, " ... ", max));
    return value;
}

double BoxHeader::real(std::string_view what, double min, double max) {
    const double value = next<float>(what);
    if (!(value >= min && value <= max)) fail(text(what, " = ", value, "; allowed: ", min, " ... ", max));
    return value;
}

double BoxHeader::positive(std::string_view what, double max) {
    const double value = next<float>(what);
    if (!(value > 0 && value <= max)) fail(text(what, " = ", value, "; allowed: > 0, up to ", max));
    return value;
}

std::string_view BoxHeader::characters(std::string_view what, int count) {
    const auto bytes = static_cast<std::size_t>(count);
    return {reinterpret_cast<const char*>(take(bytes, what)), bytes};
}

std::size_t saturated_product(std::initializer_list<std::size_t> counts) {
    std::size_t all = 1;
    for (const std::size_t one : counts) {
        if (one == 0) return 0;
        if (all > std::numeric_limits<std::size_t>::max() / one) return std::numeric_limits<std::size_t>::max();
        all *= one;
    }
    return all;
}

void require_length(const MappedFile& file, std::size_t header, std::size_t numbers, std::string_view because) {
    const std::size_t has = file.bytes().size();
    if (has >= header && has - header == numbers) return;
    const bool cut = has < header || has - header < numbers;
    throw FileError(file.path(),
                    text("has ", has, " bytes; allowed: ", header, " before the numbers and ", numbers, " for ",
                         because, "; ", cut ? "it is cut" : "it is too long", ", or another kind of file"));
}

std::string printable(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (is_control(c) || static_cast<unsigned char>(c) >= 0x80) c = ' ';
    out.erase(0, out.find_first_not_of(' '));
    out.erase(out.find_last_not_of(' ') + 1);
    return out;
}

const MappedFile& BoxSources::map(const std::filesystem::path& path) {
    files_.push_back(std::make_shared<const MappedFile>(path));
    name(path);
    return *files_.back();
}

void BoxSources::sum() {
    const MappedFile& file = *files_.back();
    file.require_whole();
    sum(file.bytes());
    file.require_whole();
}

void BoxSources::keep_in(WindBoxData& box) const {
    box.memory = std::make_shared<const BoxFiles>(files_);
    box.require_unchanged = change_guard(files_);
}

BoxOrigin BoxSources::origin(std::string format, std::string note) const {
    return {names_, std::move(format), checksum_text(checksum_), std::move(note)};
}

BoxNumbers numbers_in(const MappedFile& file, int number, BoxNumbers::Type type, std::size_t place) {
    BoxNumbers out;
    out.data = file.bytes().data() + place;
    out.type = type;
    out.file = number;
    out.place = place;
    return out;
}

}  // namespace cardan::turbines
