/// @file
/// The steps of reading URDF. Internal to cardan::urdf.
///
///   text --outline--> links, joints, notes, tidy text --urdfdom--> values --(read.cpp)--> Tree
///                          |
///                       structure: is it a tree? in which order?
///
/// The XML is parsed twice because urdfdom's messages do not suffice: they have no line numbers, unknown tags and
/// attributes are passed over in silence, a link with a malformed inertia is kept half read, a link with two parents is
/// accepted. So outline() goes through it first, with TinyXML, which urdfdom needs anyway, and leaves what concerns
/// dynamics; what urdfdom still reports is a real error.
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

/// The parts of a URDF document that concern dynamics, in the order of the file.
struct Outline {
    std::string source;
    std::string robot_name;
    std::string tidy;  ///< the text given to urdfdom: no geometry, no unknown tags, white space normalised
    std::vector<LinkEntry> links;
    std::vector<JointEntry> joints;
    std::vector<std::string> notes;

    std::string at(int line) const { return text(source, ":", line, ": "); }
};

/// Parses the XML and checks it against the vocabulary of URDF: unknown tags and attributes become notes; missing
/// values and values that are not finite numbers become errors.
/// @throws InputError
Outline outline(std::string_view xml, std::string_view source);

/// The links as a tree.
struct Structure {
    int root = -1;           ///< index of the link
    std::vector<int> order;  ///< all joints, parents before children, else in the order of the file
};
/// @throws InputError: names given twice, unknown links and joint types, loops, several roots
Structure structure(const Outline& outline);

/// The text parsed by urdfdom, whose console_bridge messages are collected meanwhile. @throws InputError with urdfdom's
/// message if it reports any error, since it would keep a faulty link half read
std::shared_ptr<urdf::ModelInterface> urdfdom_model(const Outline& outline, std::vector<std::string>& warnings);

/// Hands out unused names.
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
