/// @file
/// The tags and attributes of URDF that urdfdom understands, as far as they concern dynamics.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace cardan::urdf_impl {

enum class ValueKind : std::uint8_t { text, number, vector };

struct AttributeRule {
    std::string_view name;
    ValueKind value = ValueKind::number;
    bool required = false;
};

struct TagRule {
    std::string_view path;  ///< tags from the root, "robot/link/inertial"
    std::vector<AttributeRule> attributes = {};
    std::vector<std::string_view> needs = {};  ///< tags that must be in it
    bool repeats = false;                      ///< may stand several times in its parent
    std::string_view passed_over = {};         ///< why it is known but not read; empty: it is read
};

/// The rule for a tag; null: unknown.
const TagRule* find_tag(std::string_view path);

}  // namespace cardan::urdf_impl
