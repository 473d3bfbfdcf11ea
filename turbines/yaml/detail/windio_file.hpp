/// @file
/// A windIO document. Internal to windio: not installed.
#pragma once

#include "mbs/base/units.hpp"
#include "turbines/readers/turbine_file.hpp"
#include "turbines/yaml/detail/node.hpp"

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace cardan::turbines {

/// A windIO document: finds entries under the names of both versions and tracks which ones were read.
class WindioFile {
public:
    explicit WindioFile(YamlNode root);
    int version() const { return version_; }
    /// Radians per unit of angle.
    double angle() const { return angle_; }
    const char* unit_of_angle() const {
        return version_ == 1 ? "version 1 counts in rad" : "version 2 counts in degrees";
    }
    /// rad/s per unit of rotor speed: version 1 counts in rad/s, version 2 in rev/min.
    double rotor_speed() const { return version_ == 2 ? units::rpm : 1; }
    /// The first of several paths ("components.hub.diameter") that exists, if any.
    std::optional<YamlNode> find(std::initializer_list<const char*> paths) const;
    /// @throws ParseError naming the paths, at the point where the first one ends
    YamlNode get(std::initializer_list<const char*> paths) const;
    /// Unread entries next to others that were read, and the other top-level keys as a group.
    std::vector<FileNote> unused() const;
    const YamlNode& root() const { return root_; }
    /// Once, if asked several times.
    void note(const YamlNode& node, std::string value, std::string why);
    std::vector<FileNote> notes;

private:
    YamlNode root_;
    int version_ = 1;
    double angle_ = 1;
};

}  // namespace cardan::turbines
