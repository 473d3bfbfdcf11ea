// Numbers for coordinates by their names.
#include "elements/machine_elements/joints.hpp"
#include "mbs/model/model.hpp"
#include "mbs/model/solids.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// The order in which branches are added is not that of the model, which runs along each branch.
Model two_branches() {
    Tree tree;
    const JointedFrame left = add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "left", {"arms"});
    const JointedFrame right = add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "right", {"arms"});
    const JointedFrame hand = add_joint(tree, left.frame, JointKind::prismatic, Axis::x, "hand", {"arms"});
    for (const FrameId frame : {left.frame, right.frame, hand.frame}) tree.weld(frame, solid_sphere(1, 0.1));
    return Model(tree);
}

}  // namespace

TEST_CASE("coordinates: numbers by name stand where the model has the coordinate, zero where none is given",
          "[property]") {
    const Model model = two_branches();
    const CoordinateTable& table = model.coordinates();
    const Vector q = table.vector({{"right", 3}, {"hand", 2}});
    REQUIRE(q.size() == 3);
    CHECK(q(model.index("left")) == 0);
    CHECK(q(model.index("right")) == 3);
    CHECK(q(model.index("hand")) == 2);
    CHECK(table.vector({}) == Vector::Zero(3));
}

TEST_CASE("coordinates: a name that does not exist, or stands twice, is refused", "[property]") {
    const Model model = two_branches();
    const CoordinateTable& table = model.coordinates();
    check_refused([&] { (void)table.vector({{"foot", 1}}); }, {"unknown coordinate 'foot'", "'hand'"});
    check_refused([&] { (void)table.vector({{"hand", 1}, {"hand", 2}}); }, {"'hand'", "twice"});
}
