/// @file
/// Texts in HDF5 files, so that a damaged file leads nobody astray. Texts of variable length lie in a heap that has no
/// checksums and that the C library follows without looking; arrays of texts of fixed length are read wrong by netCDF.
/// So attributes are of fixed length, and arrays are characters with one more axis, as netCDF has them.
/// Internal: includes hdf5.h, not for users of the library.
#pragma once

#include "solvers/hdf5/detail/storage.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace cardan::solvers::detail {

/// UTF-8, filled up with NUL. One byte is the least that HDF5 has.
[[nodiscard]] Handle text_type(std::size_t bytes);

/// Texts one after the other, each filled up with NUL to the length of the longest.
struct CharacterBlock {
    explicit CharacterBlock(std::span<const std::string> texts);
    std::size_t length = 1;  ///< bytes of a text
    std::vector<char> characters;
};

/// netCDF4-python up to 1.6 cuts arrays of texts at wrong places when it is told to decode them, unless there is one or
/// all are ASCII.
[[nodiscard]] bool may_be_decoded(std::span<const std::string> texts);

/// An array of characters, whose last axis runs over a text?
[[nodiscard]] bool is_character_array(hid_t type, int axes);

/// Up to the fill.
[[nodiscard]] std::string text_of(const char* from, std::size_t size, H5T_str_t padding);

/// What netCDF writes as the name of a scale of an axis that has no values.
[[nodiscard]] std::string name_without_values(std::size_t length);

}  // namespace cardan::solvers::detail
