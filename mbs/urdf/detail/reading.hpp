/// @file
/// The steps of reading URDF, inside of cardan::urdf.
///
///   text --outline--> links, joints, notes, tidy text --urdfdom--> values --(urdf_read.cpp)--> Tree
///                          |
///                       structure: is it a tree? in which order?
#pragma once

#include "mbs/base/error.hpp"

#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <urdf_model/model.h>
#include <vector>

namespace cardan::urdf_impl {

struct LinkEntry {
    std::string name;
    int line = 0;
};
struct JointEntry {
    std::string name, type, parent, child;
    int line = 0;
    bool has_axis = false, has_limit = false;
};

/// A URDF document as far as it concerns dynamics, in the order of the file.
struct Outline {
    std::string source;
    std::string robot_name;
    std::string tidy;  ///< what urdfdom gets to read: no geometry, no unknown tags, white space in order
    std::vector<LinkEntry> links;
    std::vector<JointEntry> joints;
    std::vector<std::string> notes;

    std::string at(int line) const { return text(source, ":", line, ": "); }
};

/// Parses the XML and holds it against the vocabulary of URDF: unknown tags and attributes become notes, values that
/// are no finite numbers and missing ones become errors.
/// @throws InputError
Outline outline(std::string_view xml, std::string_view source);

/// The links as a tree.
struct Structure {
    int root = -1;           ///< index of the link
    std::vector<int> order;  ///< all joints, parents before children, else in the order of the file
};
/// @throws InputError: names given twice, unknown links and joint types, loops, several roots
Structure structure(const Outline& outline);

/// What urdfdom makes of the text. It speaks through console_bridge; all that it says is collected meanwhile.
/// @throws InputError with urdfdom's words if it reports any error: a link with errors is otherwise kept half read
std::shared_ptr<urdf::ModelInterface> urdfdom_model(const Outline& outline, std::vector<std::string>& warnings);

/// Hands out names that were not used before.
class UniqueNames {
public:
    void reserve(std::string_view name) { used_.emplace(name); }
    /// The name itself, or with the first free number behind it: "hub", "hub 2", "hub 3" ...
    std::string take(const std::string& wish) {
        std::string name = wish;
        for (int i = 2; !used_.insert(name).second; ++i) name = text(wish, " ", i);
        return name;
    }

private:
    std::set<std::string, std::less<>> used_;
};

}  // namespace cardan::urdf_impl
