#include "mbs/base/entry.hpp"
#include "mbs/urdf/detail/reading.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace cardan::urdf_impl {

namespace {

using Index = std::map<std::string_view, int>;

template <class Entries>
Index index_by_name(const Entries& entries, const Outline& outline, const char* kind) {
    Index index;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto [first, is_new] = index.emplace(entries[i].name, static_cast<int>(i));
        if (!is_new)
            throw InputError(text(outline.at(entries[i].line), kind, " '", entries[i].name,
                                  "' is defined twice, in line ", entry(entries, first->second).line, " before"));
    }
    return index;
}

void check_type(const JointEntry& joint, const Outline& outline) {
    constexpr std::array known{"revolute", "continuous", "prismatic", "fixed", "floating", "planar"};
    const std::string where = text(outline.at(joint.line), "joint '", joint.name, "'");
    if (std::find(known.begin(), known.end(), joint.type) == known.end())
        throw InputError(where, "type", joint.type, "revolute, continuous, prismatic, fixed, floating, planar");
    if (!joint.has_limit && (joint.type == "revolute" || joint.type == "prismatic"))
        throw InputError(text(where, ": a ", joint.type, " joint needs a tag <limit>",
                              joint.type == "revolute" ? " (without limits it is of type continuous)" : ""));
}

int link_of(const Index& links, const std::string& name, const JointEntry& joint, const Outline& outline,
            const char* which) {
    const auto found = links.find(name);
    if (found == links.end())
        throw InputError(text(outline.at(joint.line), "joint '", joint.name, "'"), text(which, " link"),
                         text("'", name, "'"), "a link of this document");
    return found->second;
}

// Joint that carries each link, -1: none.
std::vector<int> carriers(const Outline& outline, const Index& links) {
    std::vector<int> carrier(outline.links.size(), -1);
    for (std::size_t j = 0; j < outline.joints.size(); ++j) {
        const JointEntry& joint = outline.joints[j];
        check_type(joint, outline);
        link_of(links, joint.parent, joint, outline, "parent");
        int& by = entry(carrier, link_of(links, joint.child, joint, outline, "child"));
        if (joint.parent == joint.child)
            throw InputError(text(outline.at(joint.line), "joint '", joint.name, "' is a loop: it joins the link '",
                                  joint.child, "' to itself; only trees can be held"));
        if (by >= 0)
            throw InputError(text(outline.at(joint.line), "joint '", joint.name, "' closes a loop: its child link '",
                                  joint.child, "' is carried by joint '", entry(outline.joints, by).name,
                                  "' already; only trees can be held"));
        by = static_cast<int>(j);
    }
    return carrier;
}

int the_root(const Outline& outline, const std::vector<int>& carrier) {
    if (outline.links.empty()) throw InputError(text(outline.source, ": robot has no <link>"));
    int root = -1;
    for (std::size_t i = 0; i < carrier.size(); ++i) {
        if (carrier[i] >= 0) continue;
        if (root >= 0)
            throw InputError(text(outline.at(outline.links[i].line), "link '", outline.links[i].name,
                                  "' hangs on no joint, and link '", entry(outline.links, root).name,
                                  "' does not either; there must be one root"));
        root = static_cast<int>(i);
    }
    if (root < 0) throw InputError(text(outline.source, ": the joints form a loop: every link is carried by another"));
    return root;
}

}  // namespace

Structure structure(const Outline& outline) {
    const Index links = index_by_name(outline.links, outline, "link");
    index_by_name(outline.joints, outline, "joint");
    const std::vector<int> carrier = carriers(outline, links);
    Structure result;
    result.root = the_root(outline, carrier);
    // A joint whose parent link has not been placed yet waits for the joints on the path to it.
    std::vector<bool> placed(outline.joints.size(), false);
    for (std::size_t j = 0; j < outline.joints.size(); ++j) {
        std::vector<int> way;
        for (int k = static_cast<int>(j); k >= 0 && !entry(placed, k);) {
            const JointEntry& joint = entry(outline.joints, k);
            if (way.size() > outline.joints.size())
                throw InputError(text(outline.at(outline.joints[j].line), "joint '", outline.joints[j].name,
                                      "' belongs to a loop or hangs on one, and not on the root '",
                                      entry(outline.links, result.root).name, "'; only trees can be held"));
            way.push_back(k);
            k = entry(carrier, links.at(joint.parent));
        }
        for (; !way.empty(); way.pop_back()) {
            entry(placed, way.back()) = true;
            result.order.push_back(way.back());
        }
    }
    return result;
}

}  // namespace cardan::urdf_impl
