/// @file
/// The tree of a YAML document, with limits that hold while it is read. Inside of the readers of YAML models: not
/// installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cardan::turbines {

/// What a document may ask of the machine that reads it. Models of turbines have 2 MiB, 200 000 nodes and a depth
/// of 12.
struct YamlLimits {
    std::size_t bytes = std::size_t{8} << 20;
    std::size_t nodes = 1'000'000;  ///< what an alias stands for counts each time
    std::size_t depth = 60;         ///< likewise
    std::size_t line = 1 << 20;     ///< bytes of one line: what the parser holds back until it knows a key
    std::size_t key = 1024;         ///< bytes
};

/// A scalar, a list or a map, and where it begins.
struct YamlTree {
    enum class Kind : std::uint8_t { null, scalar, list, map };
    Kind kind = Kind::null;
    int line = 1, column = 1;  ///< from 1
    std::string scalar = {};
    /// Items, or keys and values in turn. An alias is the same node again, so that there is no loop.
    std::vector<const YamlTree*> children = {};
    std::size_t nodes = 1, depth = 1;  ///< with all that is in it
};

/// All nodes of a document; the first one is its root.
using YamlTrees = std::vector<std::unique_ptr<YamlTree>>;

/// @throws ParseError with file, line and limit: what is no text (require_text()) or has control characters, is no
/// YAML, is more than one document, goes beyond the limits, has an alias of what the alias is in
[[nodiscard]] YamlTrees yaml_trees(const std::string& text, const std::string& file, const YamlLimits& limits = {});

}  // namespace cardan::turbines
