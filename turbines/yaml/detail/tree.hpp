/// @file
/// The tree of a YAML document, with limits enforced while it is read. Internal to the readers of YAML models: not
/// installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cardan::turbines {

/// Limits on the resources a document may use. Turbine models have 2 MiB, 200 000 nodes and a depth of 12.
struct YamlLimits {
    std::size_t bytes = std::size_t{8} << 20;
    std::size_t nodes = 1'000'000;  ///< the target of an alias counts each time
    std::size_t depth = 60;         ///< of nested nodes
    std::size_t line = 1 << 20;     ///< bytes of one line
    std::size_t key = 1024;         ///< bytes
};

/// A scalar, a list or a map, and where it begins.
struct YamlTree {
    enum class Kind : std::uint8_t { null, scalar, list, map };
    Kind kind = Kind::null;
    int line = 1, column = 1;  ///< from 1
    int document = 0;          ///< which of several documents that were merged
    std::string scalar = {};
    /// Items, or alternating keys and values. An alias refers to the same node again; there are no cycles.
    std::vector<const YamlTree*> children = {};
    std::size_t nodes = 1, depth = 1;  ///< including all descendants
};

/// All nodes of a document; the first one is its root.
using YamlTrees = std::vector<std::unique_ptr<YamlTree>>;

/// @throws ParseError with file, line and limit: if it is not text (require_text()) or has control characters, is not
/// YAML, contains more than one document, exceeds the limits, or has an alias to a node that contains the alias
[[nodiscard]] YamlTrees yaml_trees(const std::string& text, const std::string& file, const YamlLimits& limits = {});

}  // namespace cardan::turbines
