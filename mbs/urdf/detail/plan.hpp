/// @file
/// Links and joints that a tree becomes in URDF.
#pragma once

#include "mbs/urdf/urdf.hpp"

namespace cardan::urdf_impl {

struct ExportPlan {
    struct Link {
        std::string name;
        RigidInertia inertia = {};  ///< in the link's frame
    };
    struct Joint {
        std::string name, parent, child;  ///< parent and child: links
        Placement at;                     ///< child in parent at q = 0
        bool moves = false;
        JointKind kind = JointKind::revolute;
        UrdfJoint data = {};
    };
    std::vector<Link> links;  ///< the root first
    std::vector<Joint> joints;
    std::vector<std::string> losses;
};

/// @throws InputError if joint data do not fit the tree
ExportPlan plan_export(const Tree& tree, const UrdfExport& with);

}  // namespace cardan::urdf_impl
