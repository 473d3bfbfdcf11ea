/// @file
/// Texts in HDF5 files, stored so that damage cannot go unnoticed. Variable-length strings lie in a heap without
/// checksums, which the C library follows blindly; arrays of fixed-length strings are read incorrectly by netCDF. So
/// attributes have fixed length, and arrays are character arrays with one more axis, as in netCDF. Internal: includes
/// hdf5.h, not for users of the library.
#pragma once

#include "solvers/hdf5/detail/storage.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace cardan::solvers::detail {

/// UTF-8, padded with NUL. HDF5 needs at least one byte.
[[nodiscard]] Handle text_type(std::size_t bytes);

/// Texts one after another, each padded with NUL to the length of the longest.
struct CharacterBlock {
    explicit CharacterBlock(std::span<const std::string> texts);
    std::size_t length = 1;  ///< bytes of a text
    std::vector<char> characters;
};

/// netCDF4-python up to 1.6 splits arrays of texts in the wrong places when asked to decode them, unless there is only
/// one text or all are ASCII.
[[nodiscard]] bool may_be_decoded(std::span<const std::string> texts);

/// True for an array of characters whose last axis runs along a text.
[[nodiscard]] bool is_character_array(hid_t type, int axes);

/// The text without its padding.
[[nodiscard]] std::string text_of(const char* from, std::size_t size, H5T_str_t padding);

/// Name that netCDF writes for the scale of an axis without values.
[[nodiscard]] std::string name_without_values(std::size_t length);

}  // namespace cardan::solvers::detail
