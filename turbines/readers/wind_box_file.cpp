#include "turbines/readers/wind_box_file.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/mapped_file.hpp"
#include "mbs/base/text.hpp"
#include "mbs/base/text_file.hpp"
#include "turbines/readers/bladed_box.hpp"
#include "turbines/readers/turbsim_box.hpp"

#include <cstring>

namespace cardan::turbines {

namespace {

// The first number of a binary file.
std::int16_t first_number(const std::filesystem::path& path) {
    const MappedFile file(path);
    std::int16_t id = 0;
    if (file.bytes().size() < sizeof id) throw FileError(path.string(), "has 1 byte: no wind");
    std::memcpy(&id, file.bytes().data(), sizeof id);
    return id;
}

bool is_turbsim(std::int16_t id) {
    return id == 7 || id == 8;
}
bool is_bladed(std::int16_t id) {
    return id == -99 || (id >= -3 && id <= -1);
}

}  // namespace

bool is_wind_box(const std::filesystem::path& path) {
    const std::int16_t id = first_number(path);
    if (is_turbsim(id) || is_bladed(id)) return true;
    const std::string words = lower_case(text_file(path));
    return words.find("windf") != std::string::npos && words.find("windtype") == std::string::npos;
}

WindBoxFile read_wind_box(const std::filesystem::path& path) {
    const std::int16_t id = first_number(path);
    if (is_turbsim(id)) return read_turbsim_box(path);
    if (is_bladed(id)) return read_bladed_box(path);
    const auto in_text = [](int c) { return !is_control(static_cast<char>(c)) || c == '\t' || c == '\n' || c == '\r'; };
    if (!in_text(id & 0xff) || !in_text((id >> 8) & 0xff))
        throw FileError(path.string(), text("byte 0: begins with ", id,
                                            "; allowed: 7 or 8 (TurbSim), -99, -1, -2, -3 (Bladed's kind), or a text"));
    return read_native_bladed_box(path);
}

}  // namespace cardan::turbines
