#include "solvers/hdf5/detail/text.hpp"

#include <algorithm>
#include <string_view>

namespace cardan::solvers::detail {

Handle text_type(std::size_t bytes) {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.get(), std::max<std::size_t>(bytes, 1));
    H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
    H5Tset_cset(type.get(), H5T_CSET_UTF8);
    return type;
}

CharacterBlock::CharacterBlock(std::span<const std::string> texts) {
    for (const std::string& text : texts) length = std::max(length, text.size());
    characters.resize(length * texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i)
        std::copy(texts[i].begin(), texts[i].end(), characters.begin() + static_cast<std::ptrdiff_t>(i * length));
}

bool may_be_decoded(std::span<const std::string> texts) {
    const auto beyond_ascii = [](char c) { return static_cast<unsigned char>(c) >= 0x80; };
    return texts.size() == 1 ||
           std::ranges::none_of(texts, [&](const std::string& s) { return std::ranges::any_of(s, beyond_ascii); });
}

bool is_character_array(hid_t type, int axes) {
    return axes > 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) <= 0 && H5Tget_size(type) == 1;
}

std::string text_of(const char* from, std::size_t size, H5T_str_t padding) {
    const std::string_view all(from, size);
    if (padding == H5T_STR_SPACEPAD) return std::string(all.substr(0, all.find_last_not_of(' ') + 1));
    if (padding == H5T_STR_NULLPAD) return std::string(all.substr(0, all.find_last_not_of('\0') + 1));
    return std::string(all.substr(0, all.find('\0')));
}

std::string name_without_values(std::size_t length) {
    constexpr std::size_t digits = 10;  // as netCDF prints it
    std::string number = text(length);
    number.insert(0, digits - std::min(digits, number.size()), ' ');
    return "This is a netCDF dimension but not a netCDF variable." + number;
}

}  // namespace cardan::solvers::detail
