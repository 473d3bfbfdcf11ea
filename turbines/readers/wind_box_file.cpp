#include "turbines/readers/wind_box_file.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/mapped_file.hpp"
#include "turbines/readers/bladed_box.hpp"
#include "turbines/readers/turbsim_box.hpp"

#include <cstring>

namespace cardan::turbines {

WindBoxFile read_wind_box(const std::filesystem::path& path) {
    std::int16_t id = 0;
    {
        const MappedFile file(path);
        if (file.bytes().size() < sizeof id) throw FileError(path.string(), "has 1 byte: no wind");
        std::memcpy(&id, file.bytes().data(), sizeof id);
    }
    if (id == 7 || id == 8) return read_turbsim_box(path);
    if (id == -99 || (id >= -3 && id <= -1)) return read_bladed_box(path);
    const auto in_text = [](int c) { return !is_control(static_cast<char>(c)) || c == '\t' || c == '\n' || c == '\r'; };
    if (!in_text(id & 0xff) || !in_text((id >> 8) & 0xff))
        throw FileError(path.string(), text("byte 0: begins with ", id,
                                            "; allowed: 7 or 8 (TurbSim), -99, -1, -2, -3 (Bladed's kind), or a text"));
    return read_native_bladed_box(path);
}

}  // namespace cardan::turbines
