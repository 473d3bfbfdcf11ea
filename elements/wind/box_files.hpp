/// @file
/// Files of wind boxes, while they are mapped.
#pragma once

#include "elements/wind/wind_box.hpp"
#include "mbs/base/mapped_file.hpp"

#include <functional>
#include <memory>
#include <vector>

namespace cardan {

/// Mapped files that are shared by the boxes of their numbers.
using BoxFiles = std::vector<std::shared_ptr<const MappedFile>>;

/// Makes WindBoxData::require_unchanged of mapped files: none of them is written to, or shortened, from now on.
std::function<void()> change_guard(BoxFiles files);

}  // namespace cardan
