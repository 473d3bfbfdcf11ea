#include "mbs/urdf/detail/vocabulary.hpp"

#include <algorithm>

namespace cardan::urdf_impl {

namespace {

constexpr auto text = ValueKind::text;
constexpr auto number = ValueKind::number;
constexpr auto vector = ValueKind::vector;
constexpr bool required = true;
constexpr std::string_view geometry = "geometry has no part in the dynamics";

// https://wiki.ros.org/urdf/XML, and what urdfdom 3.0 asks of it.
const std::vector<TagRule>& vocabulary() {
    static const std::vector<AttributeRule> pose{{"xyz", vector}, {"rpy", vector}};
    static const std::vector<AttributeRule> link_name{{"link", text, required}};
    static const std::vector<TagRule> rules{
        {.path = "robot", .attributes = {{"name", text, required}, {"version", text}}},
        {.path = "robot/material", .repeats = true, .passed_over = geometry},
        {.path = "robot/gazebo", .repeats = true, .passed_over = "it is for the simulator Gazebo"},
        {.path = "robot/transmission", .repeats = true, .passed_over = "drives are not part of the tree"},
        {.path = "robot/link", .attributes = {{"name", text, required}, {"type", text}}, .repeats = true},
        {.path = "robot/link/visual", .repeats = true, .passed_over = geometry},
        {.path = "robot/link/collision", .repeats = true, .passed_over = geometry},
        {.path = "robot/link/inertial", .needs = {"mass", "inertia"}},
        {.path = "robot/link/inertial/origin", .attributes = pose},
        {.path = "robot/link/inertial/mass", .attributes = {{"value", number, required}}},
        {.path = "robot/link/inertial/inertia",
         .attributes = {{"ixx", number, required},
                        {"ixy", number, required},
                        {"ixz", number, required},
                        {"iyy", number, required},
                        {"iyz", number, required},
                        {"izz", number, required}}},
        {.path = "robot/joint",
         .attributes = {{"name", text, required}, {"type", text, required}},
         .needs = {"parent", "child"},
         .repeats = true},
        {.path = "robot/joint/origin", .attributes = pose},
        {.path = "robot/joint/parent", .attributes = link_name},
        {.path = "robot/joint/child", .attributes = link_name},
        {.path = "robot/joint/axis", .attributes = {{"xyz", vector, required}}},
        {.path = "robot/joint/limit",
         .attributes = {{"lower"}, {"upper"}, {"effort", number, required}, {"velocity", number, required}}},
        {.path = "robot/joint/dynamics", .attributes = {{"damping"}, {"friction"}}},
        {.path = "robot/joint/mimic", .attributes = {{"joint", text, required}, {"multiplier"}, {"offset"}}},
        {.path = "robot/joint/safety_controller", .passed_over = "drives are not part of the tree"},
        {.path = "robot/joint/calibration", .passed_over = "sensors are not part of the tree"},
    };
    return rules;
}

}  // namespace

const TagRule* find_tag(std::string_view path) {
    const std::vector<TagRule>& rules = vocabulary();
    const auto found = std::find_if(rules.begin(), rules.end(), [&](const TagRule& r) { return r.path == path; });
    return found == rules.end() ? nullptr : &*found;
}

}  // namespace cardan::urdf_impl
