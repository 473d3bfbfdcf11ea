// What a description must not contain is refused with a message that names the place and the value; what looks odd but
// is legal is accepted.
#include "mbs/kernels/dynamics.hpp"
#include "mbs/system/system.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

RigidInertia inertia(double mass, const Vec3& moments, bool reduced = false) {
    return {mass, Vec3::Zero(), moments.asDiagonal(), reduced};
}

const RigidInertia solid_ball = inertia(2, {1, 1, 1});

BodySpec body(std::string name, const RigidInertia& of_body = solid_ball) {
    BodySpec spec;
    spec.name = std::move(name);
    spec.inertia = of_body;
    return spec;
}

std::string add(const BodySpec& spec) {
    return refusal([&] { Tree().add_body(spec); });
}

void check_body_refused(const BodySpec& spec, std::initializer_list<std::string> parts) {
    check_refused([&] { Tree().add_body(spec); }, parts);
}

}  // namespace

TEST_CASE("bad input: a mass that is negative, not a number or infinite", "[property]") {
    check_body_refused(body("hub", inertia(-3.5, {1, 1, 1})), {"body 'hub'", "mass [kg] = -3.5", ">= 0"});
    check_body_refused(body("hub", inertia(not_a_number, {1, 1, 1})), {"body 'hub'", "mass [kg] = nan", "finite"});
    check_body_refused(body("hub", inertia(infinite, {1, 1, 1})), {"body 'hub'", "mass [kg] = inf"});
    CHECK(add(body("hub", inertia(0, {1, 1, 1}))) == "(accepted)");
    CHECK(add(body("hub", {})) == "(accepted)");
}

TEST_CASE("bad input: a centre of mass or an inertia tensor that is not finite", "[property]") {
    BodySpec spec = body("hub");
    spec.inertia.com(1) = not_a_number;
    check_body_refused(spec, {"body 'hub'", "centre of mass [m]", "0 nan", "finite"});
    spec = body("hub");
    spec.inertia.J(0, 1) = not_a_number;
    check_body_refused(spec, {"body 'hub'", "inertia tensor [kg m^2]", "nan", "finite"});
}

TEST_CASE("bad input: an inertia tensor that is not symmetric or not positive", "[property]") {
    BodySpec spec = body("hub");
    spec.inertia.J(0, 1) = 0.25;
    check_body_refused(spec, {"body 'hub'", "inertia tensor [kg m^2]", "0.25", "symmetric"});
    check_body_refused(body("hub", inertia(1, {-0.125, 2, 2})),
                       {"body 'hub'", "smallest principal moment of inertia [kg m^2] = -0.125", ">= 0"});
    check_body_refused(body("hub", inertia(1, {-0.125, 2, 2}, true)), {"body 'hub'", "-0.125"});
    spec = body("hub");
    spec.inertia.J << 1, 2, 0, 2, 1, 0, 0, 0, 3;  // symmetric, eigenvalues -1, 3, 3
    check_body_refused(spec, {"smallest principal moment", "= -1;"});
}

TEST_CASE("bad input: moments of inertia against the triangle inequality, unless the body is reduced", "[property]") {
    check_body_refused(body("nacelle", inertia(1, {0, 0, 16599})),
                       {"body 'nacelle'", "principal moments of inertia [kg m^2]", "16599", "A + B >= C", "reduced"});
    CHECK(add(body("nacelle", inertia(1, {0, 0, 16599}, true))) == "(accepted)");
    // Thin sections lie exactly on the limit, in any axes; the relative tolerance is 1e-9.
    CHECK(add(body("disc", inertia(1, {1, 1, 2}))) == "(accepted)");
    CHECK(add(body("rod", inertia(1, {0, 3, 3}))) == "(accepted)");
    BodySpec turned = body("disc", inertia(1, {0.3, 0.7, 1.0}));
    turned.inertia = turned.inertia.in({rot_x(0.3) * rot_y(1.2) * rot_z(-0.7), Vec3(1, 2, 3)});
    CHECK(add(turned) == "(accepted)");
    CHECK(add(body("disc", inertia(1, {1, 1, 2 + 1e-10}))) == "(accepted)");
    check_body_refused(body("disc", inertia(1, {1, 1, 2 + 1e-8})), {"A + B >= C"});
}

TEST_CASE("bad input: a part that is welded on is checked like a body", "[property]") {
    Tree tree;
    const FrameId hub = tree.frame_of(tree.add_body(body("hub")));
    check_refused([&] { tree.weld(hub, inertia(-1, {1, 1, 1}), "spinner"); }, {"spinner", "mass [kg] = -1"});
    check_refused(
        [&] {
            tree.weld(Tree::base(), inertia(not_a_number, {1, 1, 1}), "foundation");
        },
        {"foundation", "nan"});
    check_refused([&] { tree.weld(FrameId{9}, solid_ball, "spinner"); }, {"spinner", "frame = 9", "0 ... 1"});
    CHECK(tree.bodies()[0].spec.inertia.mass == 2);  // nothing was added
    tree.weld(hub, inertia(1, {0, 0, 5}, true), "nacelle");
    CHECK(tree.bodies()[0].spec.inertia.reduced);
}

TEST_CASE("bad input: a placement that is not a rigid motion", "[property]") {
    BodySpec spec = body("blade");
    spec.placement.R *= 1.5;
    check_body_refused(spec, {"body 'blade'", "placement", "1.5", "proper rotation"});
    spec.placement.R = Vec3(1, 1, -1).asDiagonal();
    check_body_refused(spec, {"body 'blade'", "-1", "proper rotation"});
    spec = body("blade");
    spec.placement.p(2) = not_a_number;
    check_body_refused(spec, {"body 'blade'", "p =   0   0 nan", "finite"});
    spec = body("blade");
    spec.placement.R(0, 0) = not_a_number;
    check_body_refused(spec, {"body 'blade'", "nan"});
    spec.placement.R = rot_x(0.1);
    spec.placement.R(0, 1) += 1e-8;
    check_body_refused(spec, {"proper rotation"});
    DhParameters dh;
    dh.alpha = not_a_number;
    check_refused([&] { Tree().add_body(body("blade"), dh); }, {"body 'blade'", "nan"});
    Tree tree;
    Placement stretched;
    stretched.R *= 2;
    check_refused([&] { tree.add_frame(Tree::base(), stretched, "tip"); }, {"frame 'tip'", "2", "proper rotation"});
}

TEST_CASE("bad input: names that are empty or used twice", "[property]") {
    Tree tree;
    const BodyId hub = tree.add_body(body("hub"));
    check_refused([&] { tree.add_body(body("")); }, {"a body needs a name"});
    check_refused([&] { tree.add_frame(tree.frame_of(hub), {}, ""); }, {"a frame needs a name"});
    check_refused([&] { tree.add_body(body("hub")); }, {"body 'hub'", "name = hub", "not used before"});
    tree.add_frame(tree.frame_of(hub), {}, "flange");
    check_refused([&] { tree.add_frame(Tree::base(), {}, "flange"); }, {"frame 'flange'", "not used before"});
    // Bodies bring a frame of their own name, so both share one set of names.
    check_refused([&] { tree.add_frame(Tree::base(), {}, "hub"); }, {"frame 'hub'", "not used before"});
    check_refused([&] { tree.add_body(body("flange")); }, {"body 'flange'", "not used before"});
    check_refused([&] { tree.add_body(body("base")); }, {"body 'base'", "not used before"});
    BodySpec spec = body("blade");
    spec.coordinate.name = "hub";
    check_refused([&] { tree.add_body(spec); }, {"body 'blade'", "coordinate name = hub", "not used before"});
    CHECK(tree.bodies().size() == 1);
}

TEST_CASE("bad input: frames, bodies and coordinates that do not exist", "[property]") {
    Tree tree;
    const BodyId hub = tree.add_body(body("hub"));
    check_refused([&] { tree.frame("tip"); }, {"unknown frame 'tip'", "'base'", "'hub'"});
    check_refused([&] { tree.body("blade"); }, {"unknown body 'blade'", "'hub'"});
    check_refused([&] { tree.frame_of(BodyId{4}); }, {"body = 4", "0 ... 0"});
    check_refused([&] { tree.frame_of(BodyId{}); }, {"body = -1"});
    check_refused([&] { tree.add_frame(FrameId{7}, {}, "tip"); }, {"frame 'tip'", "frame = 7", "0 ... 1"});
    BodySpec spec = body("blade");
    spec.inboard = FrameId{-2};
    check_refused([&] { tree.add_body(spec); }, {"body 'blade'", "frame = -2"});

    const Model model(tree);
    check_refused([&] { model.frame("tip"); }, {"unknown frame 'tip'", "2 frames", "'base'"});
    check_refused([&] { model.index("pitch"); }, {"unknown coordinate 'pitch'", "1 coordinates", "'hub'"});
    check_refused([&] { model.index(BodyId{5}); }, {"body = 5"});
    CHECK(model.index(hub) == 0);
}

TEST_CASE("bad input: an unknown name among many is answered with the first twelve", "[property]") {
    Tree tree;
    for (int k = 0; k < 14; ++k) tree.add_body(body(text("link ", k)));
    check_refused([&] { tree.body("arm"); }, {"'link 0'", "'link 11'", ", ..."});
    CHECK(refusal([&] { tree.body("arm"); }).find("link 12") == std::string::npos);
    const Model model(tree);
    check_refused([&] { model.index("arm"); }, {"14 coordinates", "'link 11'", ", ..."});
}

TEST_CASE("bad input: armatures that are not finite, empty, off one branch or on an unknown body", "[property]") {
    Tree tree;
    const BodyId trunk = tree.add_body(body("trunk"));
    BodySpec spec = body("left");
    spec.inboard = tree.frame_of(trunk);
    const BodyId left = tree.add_body(spec);
    spec.name = "right";
    const BodyId right = tree.add_body(spec);
    const auto gear = [&](double J, std::vector<std::pair<BodyId, double>> spin) {
        return [&tree, armature = Armature{"gear", J, std::move(spin)}] { tree.add_armature(armature); };
    };
    check_refused(gear(not_a_number, {{left, 1}}), {"armature 'gear'", "inertia = nan", "finite"});
    check_refused(gear(infinite, {{left, 1}}), {"armature 'gear'", "inertia = inf"});
    check_refused(gear(1, {{left, not_a_number}}), {"armature 'gear'", "spin factor = nan"});
    check_refused(gear(1, {}), {"armature 'gear'", "number of coordinates = 0"});
    check_refused(gear(1, {{BodyId{8}, 1}}), {"armature 'gear'", "body = 8", "0 ... 2"});
    check_refused(gear(1, {{left, 1}, {right, 1}}), {"armature 'gear'", "one branch"});
    CHECK(tree.armatures().empty());
    CHECK(refusal(gear(1, {{right, 3}, {trunk, -1}})) == "(accepted)");
    CHECK(refusal(gear(-0.1, {{left, 1}})) == "(accepted)");
    CHECK(tree.armatures().size() == 2);
}

TEST_CASE("bad input: a tree without bodies", "[property]") {
    check_refused([] { Model{Tree{}}; }, {"the tree has no bodies"});
}

namespace {

// A slender rod along x behind a bending joint about y and a torsion joint about x, in skew base axes.
struct Rod {
    Tree tree;
    BodyId bending, torsion;
};
Rod rod(double polar_inertia, CoordinateRole role = CoordinateRole::free) {
    Rod made;
    BodySpec spec;
    spec.name = "bending";
    spec.placement = {rot_z(0.4) * rot_x(1.1) * rot_y(0.2), Vec3(1, 2, 3)};
    made.bending = made.tree.add_body(spec);
    // From z = the bending axis to z = the rod.
    spec = joint_spec("torsion", made.tree.frame_of(made.bending), JointKind::revolute, Vec3(0.8, 0.6, 0));
    spec.coordinate.name = "twist of the rod";
    spec.coordinate.role = role;
    spec.inertia = inertia(3, {5, 5, polar_inertia});
    spec.inertia.com = Vec3(0, 0, 2.1);
    made.torsion = made.tree.add_body(spec);
    return made;
}

}  // namespace

TEST_CASE("singular metric: no polar inertia behind a torsion joint names the coordinate, the body and the pivot",
          "[property]") {
    check_refused([] { Model(rod(0).tree); },
                  {"singular metric", "coordinate 'twist of the rod'", "body 'torsion'", "pivot", "1e-12", "armature"});
    // Rounding of 1e-15 of the bending inertia is no polar inertia.
    check_refused([] { Model(rod(1e-15).tree); }, {"coordinate 'twist of the rod'"});
    CHECK(Model(rod(1e-6).tree).size() == 2);
}

TEST_CASE("singular metric: it is legal where the coordinate is driven or has an armature", "[property]") {
    CHECK(Model(rod(0, CoordinateRole::prescribed).tree).size() == 2);
    Rod geared = rod(0);
    geared.tree.add_armature({"spin", 0.2, {{geared.torsion, 1}}});
    CHECK(Model(geared.tree).size() == 2);
    Rod over_both = rod(0);
    over_both.tree.add_armature({"spin", 0.2, {{over_both.torsion, 1}, {over_both.bending, 5}}});
    CHECK(Model(over_both.tree).size() == 2);
    Rod elsewhere = rod(0);
    elsewhere.tree.add_armature({"spin", 0.2, {{elsewhere.bending, 1}}});
    check_refused([&] { Model{elsewhere.tree}; }, {"coordinate 'twist of the rod'"});
}

TEST_CASE("singular metric: a massless leaf names its coordinate", "[property]") {
    for (const JointKind kind : {JointKind::revolute, JointKind::prismatic}) {
        const auto make = [&](CoordinateRole role, bool armature) {
            Tree tree;
            const BodyId hub = tree.add_body(body("hub"));
            BodySpec leaf = joint_spec("vane", tree.frame_of(hub), kind, Vec3::UnitY());
            leaf.coordinate.name = "vane motion";
            leaf.coordinate.role = role;
            const BodyId vane = tree.add_body(leaf);
            if (armature) tree.add_armature({"actuator", 0.01, {{vane, 1}}});
            return Model(tree).size();
        };
        check_refused([&] { make(CoordinateRole::free, false); },
                      {"singular metric", "coordinate 'vane motion'", "body 'vane'"});
        CHECK(make(CoordinateRole::prescribed, false) == 2);
        CHECK(make(CoordinateRole::free, true) == 2);
    }
}

TEST_CASE("singular metric: two joints that do the same are found behind one another", "[property]") {
    // Two sliding joints along one axis with nothing between them.
    Tree tree;
    const BodySpec first = joint_spec("first", Tree::base(), JointKind::prismatic, Vec3(1, 2, 2) / 3);
    const FrameId at = tree.frame_of(tree.add_body(first));
    BodySpec second = joint_spec("second", at, JointKind::prismatic, Vec3::UnitZ());
    second.inertia = solid_ball;
    tree.add_body(second);
    check_refused([&] { Model{tree}; }, {"singular metric", "coordinate 'second'"});
}

TEST_CASE("singular metric: one armature is not inertia enough for two coordinates, however its factors round",
          "[property]") {
    for (int i = 1; i <= 20; ++i) {
        Tree tree;
        const BodyId first = tree.add_body(joint_spec("first", Tree::base(), JointKind::revolute, Vec3::UnitZ()));
        const BodyId second =
            tree.add_body(joint_spec("second", tree.frame_of(first), JointKind::revolute, Vec3::UnitZ()));
        tree.add_armature({"shared", 0.7, {{first, 0.1 * i}, {second, 0.3}}});
        check_refused([&] { Model{tree}; }, {"singular metric", "coordinate 'second'"});
        tree.add_armature({"own", 0.2, {{second, 1}}});
        CHECK(Model(tree).size() == 2);
    }
}

TEST_CASE("singular metric: a negative armature is legal as long as the metric stays positive", "[property]") {
    const auto make = [](double J) {
        Tree tree;
        const BodyId wheel = tree.add_body(body("wheel", inertia(1, {0.6, 0.6, 1})));
        tree.add_armature({"correction", J, {{wheel, 2}}});
        return Model(tree).size();
    };
    CHECK(make(-0.249) == 1);
    check_refused([&] { make(-0.25); }, {"coordinate 'wheel'"});
    check_refused([&] { make(-0.5); }, {"indefinite metric", "coordinate 'wheel'", "pivot -1"});
}

namespace {

struct Springs {
    Springs() : a(tree.add_body(body("a"))), b(tree.add_body(body("b"))) {}
    LinearLaw law(const Matrix& stiffness) const {
        return {.name = "beam", .coordinates = {a, b}, .stiffness = stiffness};
    }
    void refused(const LinearLaw& bad, std::initializer_list<std::string> parts) {
        check_refused([&] { forces.add_law(bad); }, parts);
        CHECK(forces.laws().empty());
    }
    Tree tree;
    BodyId a, b;
    ForceSet forces;
};

Matrix block(double k11, double k12, double k21, double k22) {
    return (Matrix(2, 2) << k11, k12, k21, k22).finished();
}

}  // namespace

TEST_CASE("bad input: springs that are negative or not finite", "[property]") {
    Springs s;
    const auto spring = [&](double k, double d, double rest) {
        return [&s, k, d, rest] { s.forces.add_spring("yaw spring", s.a, k, d, rest); };
    };
    check_refused(spring(-7.5, 0, 0), {"force element 'yaw spring'", "stiffness = -7.5", ">= 0"});
    check_refused(spring(not_a_number, 0, 0), {"force element 'yaw spring'", "stiffness = nan", "finite"});
    check_refused(spring(1, -0.5, 0), {"force element 'yaw spring'", "damping = -0.5", ">= 0"});
    check_refused(spring(1, not_a_number, 0), {"force element 'yaw spring'", "damping = nan"});
    check_refused(spring(1, 0, not_a_number), {"force element 'yaw spring'", "rest position = nan", "1 finite values"});
    CHECK(s.forces.laws().empty());
    CHECK(refusal(spring(0, 0, -3)) == "(accepted)");
}

TEST_CASE("bad input: coupled blocks of wrong size, not symmetric or indefinite", "[property]") {
    Springs s;
    s.refused(s.law(Matrix::Identity(3, 3)), {"force element 'beam'", "stiffness size = 3 x 3", "2 x 2"});
    s.refused(s.law(Matrix::Identity(2, 3)), {"stiffness size = 2 x 3"});
    s.refused(s.law({}), {"stiffness size = 0 x 0", "2 x 2"});
    s.refused(s.law(block(1, 0.25, 0, 1)), {"force element 'beam'", "stiffness", "0.25", "symmetric"});
    s.refused(s.law(block(1, not_a_number, not_a_number, 1)), {"stiffness", "nan", "finite"});
    // Indefinite although the diagonal is positive, judged by eigenvalues of the block scaled to unit diagonal.
    s.refused(s.law(block(1e12, 2e3, 2e3, 1e-6)), {"force element 'beam'", "lowest scaled eigenvalue = -1", ">= 0"});
    s.refused(s.law(block(0, 1, 1, 1)), {"lowest scaled eigenvalue"});
    LinearLaw law = s.law(block(2, 1, 1, 2));
    law.damping = block(1, 0, 0, -1);
    s.refused(law, {"force element 'beam'", "damping = -1"});
    law.damping = Matrix::Identity(1, 1);
    s.refused(law, {"damping size = 1 x 1", "2 x 2"});
    law.damping = {};
    law.rest = Vector::Zero(3);
    s.refused(law, {"rest position = 0 0 0", "2 finite values"});
    law.rest = {};
    law.coordinates.clear();
    s.refused(law, {"force element 'beam'", "number of coordinates = 0"});
    // Semidefinite blocks of very different magnitudes are legal.
    CHECK(refusal([&] { s.forces.add_law(s.law(block(1e12, 1e3, 1e3, 1e-6))); }) == "(accepted)");
    CHECK(refusal([&] { s.forces.add_law(s.law(Matrix::Zero(2, 2))); }) == "(accepted)");
}

TEST_CASE("bad input: loads, gravity and force elements", "[property]") {
    ForceSet forces;
    check_refused([&] { forces.set_gravity(Vec3(0, 0, not_a_number)); }, {"gravity", "0   0 nan", "finite"});
    CHECK(forces.gravity() == Vec3::Zero());
    FrameLoad load{.name = "thrust"};
    load.wrench.force(1) = infinite;
    check_refused([&] { forces.add_wrench(load); }, {"load 'thrust'", "inf", "finite"});
    load.wrench.force.setZero();
    load.wrench.moment(0) = not_a_number;
    check_refused([&] { forces.add_wrench(load); }, {"load 'thrust'", "nan"});
    check_refused([&] { forces.add_element({.name = "aerodynamics"}); }, {"element 'aerodynamics'", "missing"});
    CHECK(forces.loads().empty());
    CHECK(forces.elements().empty());
}

TEST_CASE("bad input: force elements on bodies and frames that the model does not have", "[property]") {
    Tree tree;
    tree.add_body(body("hub"));
    const Model model(tree);
    ForceSet springs;
    springs.add_spring("pitch spring", BodyId{3}, 10);
    check_refused([&] { Forces(springs, model); }, {"force element 'pitch spring'", "body = 3"});
    ForceSet unset;
    unset.add_spring("pitch spring", BodyId{}, 10);
    check_refused([&] { Forces(unset, model); }, {"force element 'pitch spring'", "body = -1"});
    ForceSet loads;
    loads.add_wrench({.name = "thrust", .frame = FrameId{12}});
    check_refused([&] { Forces(loads, model); }, {"load 'thrust'", "frame = 12"});
}

TEST_CASE("bad input: flags of driven coordinates of another size", "[property]") {
    Tree tree;
    tree.add_body(body("hub"));
    const Model model(tree);
    check_refused([&] { ForwardDynamics(model, std::vector<bool>(3)); }, {"driven", "= 3", "1, one per coordinate"});
}
