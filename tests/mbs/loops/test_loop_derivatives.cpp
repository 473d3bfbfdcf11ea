// Loops on random trees: every derivative against the complex step of the one before, multipliers against the work of
// what they stand for.
#include "mbs/loops/closure.hpp"
#include "mbs/system/system.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <cmath>

using namespace cardan;
using namespace cardan::testing;

namespace loop_tests {

constexpr std::array<CutKind, 7> all_kinds = {CutKind::revolute, CutKind::prismatic, CutKind::cylindrical,
                                              CutKind::cardan,   CutKind::spherical, CutKind::planar,
                                              CutKind::weld};

// A loop of every kind between frames at random places, and a state that closes none of them.
struct RandomLoops {
    explicit RandomLoops(unsigned seed) : random(seed), tree(random_tree(random, {.bodies = 12})) {
        const int bodies = static_cast<int>(tree.bodies().size());
        for (const CutKind kind : all_kinds) {
            const std::string name = text("joint ", static_cast<int>(kind));
            const auto [a, b] = frames(name, bodies);
            set.add_joint({name, kind, a, b});
        }
        const auto [a, b] = frames("rod", bodies);
        set.add_distance({"rod", a, b, 1.5});
        set.add_coupling({"gear", {{BodyId{1}, 2.0}, {BodyId{4}, -0.5}}, 0.3, "rad"});
        model.emplace(tree);
        loops = Loops(set, *model);
        q = random_state(random, model->size());
        qd = random_state(random, model->size());
    }
    // On two bodies, one of them the base now and then.
    std::pair<FrameId, FrameId> frames(const std::string& name, int bodies) {
        const int i = std::uniform_int_distribution<>(0, bodies - 1)(random);
        int j = std::uniform_int_distribution<>(-1, bodies - 2)(random);
        if (j >= i) ++j;
        const FrameId on_i = tree.frame_of(BodyId{i}), on_j = j < 0 ? Tree::base() : tree.frame_of(BodyId{j});
        return {tree.add_frame(on_i, random_placement(random), name + " a"),
                tree.add_frame(on_j, random_placement(random), name + " b")};
    }

    template <class S>
    VectorT<S> residual(const VectorT<S>& at) {
        WorkspaceT<S> workspace(*model);
        VectorT<S> phi(loops.size());
        loops.residual<S>(kinematics<S>(*model, at, workspace), 0, at, phi);
        return phi;
    }
    template <class S>
    MatrixT<S> gradient(const VectorT<S>& at) {
        WorkspaceT<S> workspace(*model);
        MatrixT<S> G(loops.size(), at.size());
        loops.gradient<S>(kinematics<S>(*model, at, workspace), 0, at, G);
        return G;
    }

    Random random;
    Tree tree;
    LoopSet set;
    std::optional<Model> model;
    Loops loops;
    Vector q, qd;
};

ComplexVector stepped(const Vector& q, const Vector& direction) {
    return q.cast<Complex>() + Complex(0, complex_step) * direction.cast<Complex>();
}

}  // namespace loop_tests

using namespace loop_tests;

TEST_CASE("loops: every equation belongs to the loop whose name it bears", "[property]") {
    RandomLoops given(1);
    given.set.add_user({"one's own", "m", [](double, const Vector& q, ConstraintTerms& out) { out.value = q(0); }});
    const Loops loops(given.set, *given.model);
    for (const Loops::Equation& equation : loops.equations()) {
        CAPTURE(equation.name);
        CHECK(equation.name.starts_with(loops.name(equation.loop)));
    }
}

TEST_CASE("loops: gradients, second gradients and biases are derivatives of the equations", "[property]") {
    for (unsigned seed = 0; seed < 20; ++seed) {
        CAPTURE(seed);
        RandomLoops s(seed);
        const int n = s.model->size();
        const Matrix G = s.gradient<double>(s.q);
        Matrix by_step(G.rows(), n);
        for (int a = 0; a < n; ++a)
            by_step.col(a) = s.residual<Complex>(stepped(s.q, Vector::Unit(n, a))).imag() / complex_step;
        CHECK(scaled(G - by_step, by_step) < 1e-13);

        Workspace workspace(*s.model);
        const Kinematics kin = kinematics(*s.model, s.q, workspace);
        Vector bias(s.loops.size());
        s.loops.bias<double>(kin, 0, s.q, s.qd, bias);
        const Vector along = s.gradient<Complex>(stepped(s.q, s.qd)).imag() / complex_step * s.qd;
        CHECK(scaled(bias - along, along) < 1e-12);

        const Vector factors = random_state(s.random, s.loops.size());
        Matrix H = Matrix::Zero(n, n), H_by_step(n, n);
        s.loops.add_second_gradient(kin, 0, s.q, factors, H);
        for (int a = 0; a < n; ++a)
            H_by_step.col(a) =
                s.gradient<Complex>(stepped(s.q, Vector::Unit(n, a))).imag().transpose() / complex_step * factors;
        CHECK(scaled(H - H_by_step, H_by_step) < 1e-12);
        CHECK(scaled(H - H.transpose(), H) < 1e-15);
    }
}

TEST_CASE("loops: what joints and rods exert does the work of their multipliers", "[property]") {
    for (unsigned seed = 0; seed < 10; ++seed) {
        CAPTURE(seed);
        RandomLoops s(seed);
        Vector lambda = random_state(s.random, s.loops.size());
        lambda(s.loops.size() - 1) = 0;  // of the gear, which acts nowhere
        Workspace workspace(*s.model);
        const Kinematics kin = kinematics(*s.model, s.q, workspace);
        std::vector<LoopLoad> loads;
        s.loops.add_loads(kin, lambda, loads);
        Vector Q = Vector::Zero(s.model->size());
        for (const LoopLoad& load : loads)
            for (int a = load.body; a >= 0; a = s.model->body(a).parent) {
                const PointTwist<double> twist = twist_at<double>(kin, a, load.point);
                Q(a) += twist.w.dot(load.moment) + twist.v.dot(load.force);
            }
        const Vector expected = s.gradient<double>(s.q).transpose() * lambda;
        CHECK(scaled(Q - expected, expected) < 1e-13);
    }
}

TEST_CASE("loops: a joint of the tree fulfils the cut joint of its kind, which leaves it that freedom", "[analytic]") {
    struct Freedoms {
        CutKind kind;
        std::vector<std::pair<JointKind, Vec3>> joints;
    };
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    const JointKind turn = JointKind::revolute, slide = JointKind::prismatic;
    const std::vector<Freedoms> cases = {{CutKind::revolute, {{turn, z}}},
                                         {CutKind::prismatic, {{slide, z}}},
                                         {CutKind::cylindrical, {{slide, z}, {turn, z}}},
                                         {CutKind::cardan, {{turn, x}, {turn, y}}},
                                         {CutKind::spherical, {{turn, x}, {turn, y}, {turn, z}}},
                                         {CutKind::planar, {{slide, x}, {slide, y}, {turn, z}}},
                                         {CutKind::weld, {}}};
    Random random(3);
    for (const Freedoms& one : cases) {
        CAPTURE(static_cast<int>(one.kind));
        // A body that could float, and on it frame a; from there on, joints as the cut joint allows them, then frame b.
        Tree tree;
        const FrameId body = add_floating_base(tree);
        const FrameId a = tree.add_frame(body, random_placement(random), "a");
        FrameId b = a;
        for (const auto& [kind, axis] : one.joints)
            b = add_joint(tree, {text("joint ", tree.bodies().size()), b, kind, axis}).axes;
        tree.weld(b, random_inertia(random));
        tree.weld(tree.frame_of(BodyId{5}), random_inertia(random));
        LoopSet set;
        if (one.joints.empty()) {  // then they are of one body, which is nothing to weld
            set.add_joint({"cut", one.kind, a, tree.add_frame(a, {}, "b")});
            CHECK_THROWS_AS(Loops(set, Model(tree)), InputError);
            continue;
        }
        set.add_joint({"cut", one.kind, a, b});
        const Model model(tree);
        const Loops loops(set, model);
        CHECK(loops.size() == 6 - static_cast<int>(one.joints.size()));
        Workspace workspace(model);
        for (int i = 0; i < 5; ++i) {
            const Vector q = random_state(random, model.size());
            const Kinematics kin = kinematics(model, q, workspace);
            Vector phi(loops.size());
            Matrix G(loops.size(), model.size());
            loops.residual<double>(kin, 0, q, phi);
            loops.gradient<double>(kin, 0, q, G);
            CHECK(phi.lpNorm<Eigen::Infinity>() < 1e-14);
            CHECK(max_abs(G) < 1e-14);  // the joints it allows, and those of the whole, do not open it
        }
    }
}

TEST_CASE("loops: every kind of joint holds as many directions as it has equations", "[analytic]") {
    Random random(5);
    for (const CutKind kind : all_kinds) {
        CAPTURE(static_cast<int>(kind));
        Tree tree;
        const FrameId body = add_floating_base(tree);
        tree.weld(body, random_inertia(random));
        const Placement place = random_placement(random);
        LoopSet set;
        set.add_joint({"cut", kind, tree.add_frame(Tree::base(), place, "a"), tree.add_frame(body, place, "b")});
        const System system(tree, {}, set);
        // At zero the frames coincide. From nearby, the loop is closed; then it has full rank.
        const Vector start = 0.2 * random_state(random, 6);
        const Closure closed = close_loops(system.model, system.loops, start);
        REQUIRE(closed.converged);
        CHECK(closed.rank == system.loops.size());
        CHECK(closed.gap < 1e-12);
        CHECK(closed.distance > 0);
        if (kind == CutKind::weld) CHECK(closed.q.norm() < 1e-12);
    }
}

TEST_CASE("loops: the closed position is the nearest one in the metric", "[analytic]") {
    // A point mass on a circle: of all its points the one on the line to the start. With unequal inertia in x and y the
    // metric is diag(m + 3, m), and the nearest point that of an ellipse.
    for (const double more : {0.0, 3.0}) {
        CAPTURE(more);
        Tree tree;
        const Link along_x = add_joint(tree, {.name = "x",
                                              .kind = JointKind::prismatic,
                                              .axis = Vec3::UnitX(),
                                              .inertia = {more, Vec3::Zero(), Mat3::Zero()}});
        const Link along_y = add_joint(tree, {.name = "y",
                                              .inboard = along_x.axes,
                                              .kind = JointKind::prismatic,
                                              .axis = Vec3::UnitY(),
                                              .inertia = {1, Vec3::Zero(), Mat3::Zero()}});
        LoopSet set;
        set.add_distance({"rod", Tree::base(), along_y.axes, 1});
        const System system(tree, {}, set);
        const Vector start{{1.2, 0.9}};
        const Closure closed = close_loops(system.model, system.loops, start);
        REQUIRE(closed.converged);
        // The best of a thousand points, bisected: d/dt of (M + 3)(cos t - x)^2 + (sin t - y)^2.
        double low = 0, high = pi / 2;
        for (int i = 0; i < 100; ++i) {
            const double t = (low + high) / 2, c = std::cos(t), s = std::sin(t);
            const double slope = -(1 + more) * (c - start(0)) * s + (s - start(1)) * c;
            (slope < 0 ? low : high) = t;
        }
        CHECK(closed.q(0) == Approx(std::cos(low)).margin(1e-8));
        CHECK(closed.q(1) == Approx(std::sin(low)).margin(1e-8));
        const Vector rates = close_rates(system.model, system.loops, closed.q, Vector{{1.0, 2.0}});
        CHECK(std::abs(closed.q.dot(rates)) < 1e-14);
    }
}

TEST_CASE("loops: a surface, and two that make a curve", "[analytic]") {
    // The ellipsoid x^2/4 + y^2 + z^2 = 1 in turned axes.
    Random random(11);
    Tree tree;
    const FrameId body = add_floating_base(tree);
    tree.weld(body, random_inertia(random));
    const FrameId point = tree.add_frame(body, Placement::translation({0.1, 0.2, 0.3}), "point");
    const FrameId surface = tree.add_frame(Tree::base(), random_placement(random), "surface");
    const Mat3 A = Vec3(0.25, 1, 1).asDiagonal();
    LoopSet set;
    set.add_surface({"ellipsoid", surface, point, [A](const Vec3& x) { return x.dot(A * x) - 1; },
                     [A](const Vec3& x) { return Vec3(2 * A * x); }, [A](const Vec3&) { return Mat3(2 * A); }});
    set.add_surface({"plane", surface, point, [](const Vec3& x) { return x(2) - 0.5; },
                     [](const Vec3&) { return Vec3(0, 0, 1); }, [](const Vec3&) { return Mat3(Mat3::Zero()); }});
    const System system(tree, {}, set);
    const Closure closed = close_loops(system.model, system.loops, random_state(random, 6));
    REQUIRE(closed.converged);
    Workspace workspace(system.model);
    const auto at = [&](const Vector& q) {
        const Kinematics kin = kinematics(system.model, q, workspace);
        const Pose<double> on = pose(kin, surface);
        return Vec3(on.R.transpose() * (pose(kin, point).p - on.p));
    };
    const Vec3 x = at(closed.q);
    CHECK(x(0) * x(0) / 4 + x(1) * x(1) == Approx(0.75).epsilon(1e-12));
    CHECK(x(2) == Approx(0.5).epsilon(1e-12));
    // Second gradients and biases by central differences of the gradient, step 1e-6.
    const Vector factors{{0.7, -1.3}}, qd = random_state(random, 6);
    const auto gradient = [&](const Vector& q) {
        Matrix G(2, 6);
        system.loops.gradient<double>(kinematics(system.model, q, workspace), 0, q, G);
        return G;
    };
    Matrix H = Matrix::Zero(6, 6), by_difference(6, 6);
    Vector bias(2);
    system.loops.add_second_gradient(kinematics(system.model, closed.q, workspace), 0, closed.q, factors, H);
    system.loops.bias<double>(kinematics(system.model, closed.q, workspace), 0, closed.q, qd, bias);
    const double step = 1e-6;
    for (int a = 0; a < 6; ++a) {
        const Vector d = step * Vector::Unit(6, a);
        by_difference.col(a) = (gradient(closed.q + d) - gradient(closed.q - d)).transpose() * factors / (2 * step);
    }
    CHECK(scaled(H - by_difference, H) < 1e-8);
    const Vector d = step * qd;
    const Vector expected = (gradient(closed.q + d) - gradient(closed.q - d)) * qd / (2 * step);
    CHECK(scaled(bias - expected, expected) < 1e-8);
}

TEST_CASE("loops: what does not fit is refused with names", "[bad-input]") {
    Tree tree;
    const Link one = add_joint(tree, {.name = "one", .inertia = {1, {1, 0, 0}, Mat3::Identity()}});
    const Link two = add_joint(tree, {.name = "two", .inboard = one.axes, .inertia = {1, {1, 0, 0}, Mat3::Identity()}});
    LoopSet set;
    check_refused([&] { set.add_joint({"", CutKind::weld, one.axes, two.axes}); }, {"name"});
    check_refused([&] { set.add_joint({"pin", CutKind::weld, one.axes, one.axes}); }, {"pin", "frames"});
    check_refused([&] { set.add_distance({"rod", one.axes, two.axes, 0}); }, {"rod", "length"});
    check_refused([&] { set.add_coupling({"gear", {}, 0, "rad"}); }, {"gear", "coordinates"});
    check_refused([&] { set.add_coupling({"gear", {{one.body, 1.0}, {one.body, 2.0}}, 0, "rad"}); }, {"gear", "twice"});
    check_refused([&] { set.add_user({"own", "m", {}}); }, {"own", "function"});
    check_refused([&] { set.add_surface({"ball", one.axes, two.axes, {}, {}, {}}); }, {"ball", "functions"});
    set.add_distance({"rod", Tree::base(), two.axes, 5});
    check_refused([&] { set.add_distance({"rod", Tree::base(), two.axes, 5}); }, {"rod", "other loop"});
    LoopSet twice;
    twice.add_joint({"pin", CutKind::weld, one.axes, tree.frame_of(one.body)});
    check_refused([&] { Loops(twice, Model(tree)); }, {"pin", "'one' and 'one'"});
    LoopSet unknown;
    unknown.add_joint({"pin", CutKind::weld, FrameId{100}, two.axes});
    check_refused([&] { Loops(unknown, Model(tree)); }, {"frame", "100"});

    const System system(tree, {}, set);  // of 1 m at most, a rod of 5 m
    const Closure open = close_loops(system.model, system.loops, Vector{{0.1, 0.2}});
    CHECK_FALSE(open.converged);
    for (const char* part : {"'rod'", "'base'", "'two'", "cannot be closed"}) {
        CAPTURE(open.message, part);
        CHECK(open.message.find(part) != std::string::npos);
    }
    CHECK(open.gap > 3);
    check_refused([&] { (void)close_loops(system.model, system.loops, Vector{{0.1}}); }, {"position"});
    check_refused([&] { (void)close_loops(system.model, system.loops, Vector{{0.1, not_a_number}}); }, {"'two'"});
    check_refused(
        [&] {
            (void)close_loops(system.model, system.loops, Vector{{0.1, 0}}, {.fixed = {7}});
        },
        {"fixed coordinate", "7"});
    check_refused([&] { system.require_no_loops("this"); }, {"this", "rod"});
}

TEST_CASE("loops: closed the wrong way round is not closed", "[analytic]") {
    // A shaft to be welded to ground from half a turn away: all equations of directions are met there, too.
    Tree tree;
    const Link shaft = add_joint(tree, {.name = "shaft", .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
    LoopSet set;
    set.add_joint({"key", CutKind::weld, Tree::base(), shaft.axes});
    const System system(tree, {}, set);
    const Closure turned = close_loops(system.model, system.loops, Vector{{3.0}});
    CHECK_FALSE(turned.converged);
    CHECK(turned.message.find("against each other") != std::string::npos);
    CHECK(close_loops(system.model, system.loops, Vector{{1.0}}).converged);
}
