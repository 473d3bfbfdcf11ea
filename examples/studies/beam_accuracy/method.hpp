/// @file
/// The ways to discretise a beam that are compared: one line each in method.cpp.
#pragma once

#include "elements/cardan_beam/cardan_beam.hpp"

#include <string>
#include <vector>

namespace cardan::accuracy {

enum class Scheme : std::uint8_t {
    chain,        ///< cardanic elements
    hermite,      ///< cubic shape functions, consistent matrices
    statics,      ///< the true static shapes of the element, consistent matrices
    mixed,        ///< geometrically exact mixed element
    corotational  ///< cubic elements that turn with their chord; plane statics
};

struct Method {
    std::string key;    ///< in tables and files
    std::string label;  ///< in legends
    Scheme scheme;
    CardanBeamOptions chain = {};  ///< elements, boundaries and free coordinates are set by the case
    int colour = 0, symbol = 7;    ///< of the curve: index into the palette, point type of gnuplot
    bool dashed = false;           ///< drawn over the solid curves, where it may lie on one of them
};

const std::vector<Method>& methods();
/// @throws InputError for an unknown key
const Method& method(const std::string& key);

}  // namespace cardan::accuracy
