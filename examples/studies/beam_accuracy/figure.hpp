/// @file
/// Errors over the number of elements, both logarithmic, with lines of order 2 (dashed) and 4 (dotted).
#pragma once

#include "examples/studies/beam_accuracy/study.hpp"

#include <filesystem>

namespace cardan::accuracy {

struct Panel {
    std::string study;
    std::size_t quantity;
    std::string title;
};

struct Figure {
    std::string name, title;
    std::vector<Panel> panels;
    std::vector<std::string> without = {};  ///< methods of the studies that are not drawn
    int per_row = 3;
};
const std::vector<Figure>& figures();

/// @throws InputError if the results lack a panel
void draw(const Figure& figure, const std::vector<Result>& results, const std::filesystem::path& path);
bool complete(const Figure& figure, const std::vector<Result>& results);

}  // namespace cardan::accuracy
