// Section loads against statics, against centrifugal force and against each other. Oracles: equilibrium of the free
// body, by hand.
#include "elements/cardan_beam/distributed_load.hpp"
#include "elements/sections/beam_line.hpp"
#include "mbs/base/entry.hpp"
#include "tests/elements/cardan_beam/loaded_beam.hpp"
#include "tests/support/refusal.hpp"

#include <random>

using namespace cardan;
using namespace cardan::testing;

namespace {

EngineeringSection stout() {
    EngineeringSection s;
    s.mass = 3;
    s.EA = 4e6, s.GJ = 2e3, s.EI_flap = 1e3, s.EI_edge = 3e3, s.GA_y = s.GA_z = 1e6;
    s.j_flap = 0.02, s.j_edge = 0.05;
    return s;
}

const std::vector<double> all_places{0, 0.1, 0.3, 0.5, 0.75, 1.0, 1.1, 1.4, 1.7, 2.0};

}  // namespace

TEST_CASE("section loads: a small tip wrench gives N, V, T and M of statics at every place, both ways", "[analytic]") {
    const double L = 2;
    const Vec3 F(5e-4, -3e-4, 7e-4), M(2e-4, 4e-4, -6e-4);
    Loaded b = clamped(uniform_beam(L, stout()), all_free(3));
    b.forces.add_wrench({"tip", b.beam.tip(), {F, M}, WrenchAxes::base});
    b.settle();
    for (double s : all_places) {
        const Vec3 moment = M + cross<double>(Vec3(L - s, 0, 0), F);
        const Vec6 exact = (Vec6() << F, moment).finished();
        CAPTURE(s);
        // Deflections are of the order of 1e-6: the axes turn by as much.
        CHECK((b.equilibrium(s) - exact).cwiseAbs().maxCoeff() < 1e-5 * exact.norm());
        CHECK((b.constitutive(s).values - exact).cwiseAbs().maxCoeff() < 1e-5 * exact.norm());
    }
}

TEST_CASE("section loads: a distributed load, forces and moments, is in equilibrium at every place", "[analytic]") {
    const double L = 2;
    const Vec3 f(1e-4, 2e-4, -3e-4), m(5e-5, -2e-5, 1e-5);
    Loaded b = clamped(uniform_beam(L, stout()), all_free(2));
    add_distributed_load(b.tree, b.forces, b.beam, {"wind", [&](double) { return Wrench{f, m}; }});
    b.settle();
    for (double s : all_places) {
        const double l = L - s;
        // Inside a rigid segment the load sits at its Gauss points: hinges, nodes and tip are exact.
        if (std::abs(std::remainder(s, 1.0)) > 1e-9) continue;
        const Vec3 moment = l * m + cross<double>(Vec3(l * l / 2, 0, 0), f);
        const Vec6 exact = (Vec6() << l * f, moment).finished();
        CAPTURE(s);
        CHECK((b.equilibrium(s) - exact).cwiseAbs().maxCoeff() < 1e-8);
    }
}

TEST_CASE("section loads: constitutive moments under a distributed load converge with order 2", "[analytic]") {
    const double L = 2, p = 1e-3, s = 0;
    std::vector<double> errors;
    for (int elements : {2, 4, 8}) {
        Loaded b = clamped(uniform_beam(L, stout()), all_free(elements));
        add_distributed_load(b.tree, b.forces, b.beam, {"p", [&](double) { return Wrench{{0, 0, p}, Vec3::Zero()}; }});
        b.settle();
        errors.push_back(std::abs(b.constitutive(s).values(4) - -p * L * L / 2));
    }
    CHECK(errors[2] < 0.01 * p * L * L / 2);
    CHECK(std::log2(errors[0] / errors[1]) == Approx(2).margin(0.2));
    CHECK(std::log2(errors[1] / errors[2]) == Approx(2).margin(0.2));
}

TEST_CASE("section loads: a rotating beam carries the centrifugal force of what is outboard", "[analytic]") {
    const double L = 2, r0 = 0.4, Omega = 3;
    for (bool extension : {true, false}) {
        Loaded b;
        const JointedFrame hub = add_joint(b.tree, Tree::base(), JointKind::revolute, Axis::z, "spin", {"hub"});
        const FrameId root = b.tree.add_frame(hub.frame, Placement::translation({r0, 0, 0}), "root");
        CardanBeamOptions options = all_free(4);
        options.extension = extension;
        b.beam = add_cardan_beam(b.tree, b.forces, root, uniform_beam(L, stout()), "beam", {"beam"}, options);
        b.tree.weld(b.beam.tip(), {0.7, Vec3::Zero(), 1e-3 * Mat3::Identity()}, "tip mass");
        b.settle(0, Omega);
        for (double s : all_places) {
            const double N = Omega * Omega * (3 * (L - s) * (r0 + (L + s) / 2) + 0.7 * (r0 + L));
            CAPTURE(extension, s);
            // The extension, 3e-5, moves the masses outward.
            CHECK(b.equilibrium(s)(0) == Approx(N).epsilon(1e-4));
            const SectionLoads springs = b.constitutive(s);
            CHECK(springs.axial_known == extension);
            if (!extension) CHECK(std::isnan(springs.values(0)));
            if (extension && s == 1.75) CHECK(springs.values(0) == Approx(N).epsilon(0.02));
        }
    }
}

TEST_CASE("section loads: in any motion the loads at a hinge, along its axis, are the forces of its spring",
          "[property]") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> u(-0.3, 0.3);
    EngineeringSection s = stout();
    s.beta = 0.4, s.mass_centre = {0.05, -0.02};
    Loaded b;
    const JointedFrame base = add_joint(b.tree, Tree::base(), JointKind::revolute, Axis::y, "carrier", {"carrier"});
    b.beam = add_cardan_beam(b.tree, b.forces, base.frame, uniform_beam(2, s), "beam", {"beam"}, all_free(3));
    b.tree.weld(b.beam.nodes[1], {0.5, Vec3(0.1, 0, 0), 1e-3 * Mat3::Identity()}, "instrument");
    b.forces.set_gravity({0, 1, -9.8});
    b.forces.add_wrench({"tip", b.beam.tip(), {Vec3(1, 2, 3), Vec3(-1, 0.5, 2)}, WrenchAxes::frame});
    add_distributed_load(b.tree, b.forces, b.beam, {"p", [](double x) { return Wrench{{0, 1, x}, {0, 0, 1}}; }});
    b.system.emplace(b.tree, b.forces);
    const Model& model = b.system->model;
    const auto random_vector = [&] { return Vector(Vector::NullaryExpr(model.size(), [&] { return u(random); })); };
    b.at = {{.q = random_vector(), .qd = random_vector()}, random_vector()};

    Workspace workspace(model);
    const Kinematics kin = kinematics(model, b.at.q, workspace);
    const JointLoads loads = joint_loads({b.at, kin}, b.system->forces, b.at.qdd);
    Vector tau(model.size()), Q(model.size());
    inverse_dynamics<double>(kin, b.at.qd, b.at.qdd, tau);
    b.system->forces.generalised_forces({b.at, kin}, Q);
    for (const CardanBeam::Element& element : b.beam.elements) {
        Vector q(6);
        for (Eigen::Index i = 0; i < 6; ++i) q(i) = b.at.q(model.index(entry(element.bodies, i)));
        const Vector springs = hinge_forces({}, {element.bodies, element.kinds, element.stiffness, element.tilt}, q);
        for (Eigen::Index i = 0; i < 6; ++i) {
            const int a = model.index(entry(element.bodies, i));
            const Wrench& joint = entry(loads.joint, a);
            const Vec3 axis = kin.axis(a);
            const double along = axis.dot(model.body(a).revolute ? joint.moment : joint.force);
            // tau - Q without the spring's own -K q is what the joint transmits along its axis.
            CHECK(along == Approx(tau(a) - Q(a) - springs(i)).margin(1e-9));
        }
    }

    // Without anything fixed to it, a node is the same seen from both elements; the instrument on node 1 makes a jump.
    const double node1 = 2.0 / 3, node2 = 4.0 / 3, tiny = 1e-7;
    CHECK((b.equilibrium(node2 - tiny) - b.equilibrium(node2 + tiny)).norm() < 1e-3);
    CHECK((b.equilibrium(node1 - tiny) - b.equilibrium(node1 + tiny)).head<3>().norm() > 1);
    for (std::size_t e : {1u, 2u}) {  // hinge 2 and middle of the same element
        const double start = b.beam.elements[e].start, arc = b.beam.elements[e].arc;
        for (double t : {delta_gauss, 0.5, 1 - delta_gauss}) {
            const Vec6 a = b.equilibrium(start + t * arc - tiny), c = b.equilibrium(start + t * arc + tiny);
            CHECK(a.head<3>().norm() == Approx(c.head<3>().norm()).epsilon(1e-5));
        }
    }
}

TEST_CASE("section loads: with sectional inertia cut at the torsion centre both sides of a node and of a hinge agree",
          "[property]") {
    BeamLine line = uniform_beam(2, stout());
    line.section = [](double x) {
        EngineeringSection s = stout();
        const double t = 1 - 0.4 * x;
        s.EI_flap *= std::pow(t, 3), s.EI_edge *= std::pow(t, 3), s.GJ *= std::pow(t, 3), s.j_edge *= 40 * t;
        return s.section();
    };
    CardanBeamOptions options = all_free(2);
    options.partition = Partition::compliance_gauss;
    Loaded b = clamped(line, options);
    b.system.emplace(b.tree, b.forces);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> u(-0.3, 0.3);
    const auto random_vector = [&] {
        return Vector(Vector::NullaryExpr(b.system->model.size(), [&] { return u(random); }));
    };
    b.at = {{.q = random_vector(), .qd = random_vector()}, random_vector()};
    const double tiny = 1e-7;
    CHECK((b.equilibrium(1 - tiny) - b.equilibrium(1 + tiny)).norm() < 1e-4);
    const CardanBeam::Element& element = b.beam.elements[0];
    CHECK(element.rotary_split > 0.53);
    for (double t : {element.hinges.first, element.hinges.middle, element.hinges.second}) {
        const Vec6 inboard = b.equilibrium(t - tiny), outboard = b.equilibrium(t + tiny);
        CAPTURE(t);
        CHECK(inboard.head<3>().norm() == Approx(outboard.head<3>().norm()).epsilon(1e-5));
        if (t == element.hinges.middle) continue;  // drawn apart by the extension
        CHECK(inboard.tail<3>().norm() == Approx(outboard.tail<3>().norm()).epsilon(1e-5));
    }
}

TEST_CASE("section loads: an arc carries a tip force as statics say, in the axes of every place", "[analytic]") {
    const double R = 3, angle = 1.2;
    const ReferenceLine arc =
        ReferenceLine::curve([=](double t) { return Vec3(R * std::sin(t), R * (1 - std::cos(t)), 0); },
                             [=](double t) { return Vec3(R * std::cos(t), R * std::sin(t), 0); }, 0, angle);
    Loaded b = clamped(along(uniform_beam(R * angle, stout()), arc), all_free(2));
    const Vec3 F(1e-4, -2e-4, 3e-4);
    b.forces.add_wrench({"tip", b.beam.tip(), {F, Vec3::Zero()}, WrenchAxes::base});
    b.settle();
    const Vec3 tip = arc.pose(R * angle).p;
    for (double t : {0.0, 0.2, 0.5, 0.6, 0.9, 1.1, 1.2}) {
        const Placement here = arc.pose(R * t);
        const Vec6 exact =
            (Vec6() << here.R.transpose() * F, here.R.transpose() * cross<double>(tip - here.p, F)).finished();
        CAPTURE(t);
        CHECK((b.equilibrium(R * t) - exact).cwiseAbs().maxCoeff() < 1e-5 * exact.norm());
        CHECK((b.constitutive(R * t).values - exact).cwiseAbs().maxCoeff() < 1e-5 * exact.norm());
    }
}

TEST_CASE("section loads: only what was placed on the beam counts, wherever on its segments", "[analytic]") {
    // A second beam on the same body, loaded; a force right at a hinge of the first one.
    Loaded loaded = clamped(uniform_beam(2, stout()), all_free(2));
    const CardanBeam other = add_cardan_beam(
        loaded.tree, loaded.forces, loaded.tree.add_frame(Tree::base(), Placement::translation({0, 1, 0}), "beside"),
        uniform_beam(2, stout()), "other", {"beam"}, all_free(2));
    const double load = 1e-4;
    const DistributedLoad w{"w", [&](double) { return Wrench{{0, 0, load}, Vec3::Zero()}; }};
    add_distributed_load(loaded.tree, loaded.forces, loaded.beam, w);  // one load, two beams of one line
    add_distributed_load(loaded.tree, loaded.forces, other, w);
    const CardanBeam::Segment& first = loaded.beam.elements[0].segments[0];
    const double hinge = loaded.beam.elements[0].hinges.first * loaded.beam.elements[0].length;
    const FrameId at_hinge =
        loaded.tree.add_frame(first.carrier, Placement::translation({hinge - first.x, 0, 0}), "hinge");
    loaded.forces.add_wrench({"at the hinge", at_hinge, {{0, 0, load}, Vec3::Zero()}, WrenchAxes::base});
    loaded.settle();
    for (double s :
         {0.0, (1 - 1e-6) * hinge, (1 + 1e-6) * hinge, 1.0}) {  // ends of segments: the load is lumped in them
        const double force = load * (2 - s) + (s < hinge ? load : 0);
        const double moment = -load * (2 - s) * (2 - s) / 2 - (s < hinge ? load * (hinge - s) : 0);
        CAPTURE(s);
        CHECK(loaded.equilibrium(s)(2) == Approx(force).epsilon(1e-5));
        CHECK(loaded.equilibrium(s)(4) == Approx(moment).epsilon(1e-5));
        CHECK(std::abs(loaded.equilibrium(s)(3)) < 1e-9);
    }
}

TEST_CASE("section loads: a place outside of the beam, a load without function or with NaN are refused", "[property]") {
    Loaded b = clamped(uniform_beam(2, stout(), "spar"), all_free(1));
    check_refused([&] { add_distributed_load(b.tree, b.forces, b.beam, {"wind"}); }, {"wind", "function"});
    check_refused(
        [&] {
            add_distributed_load(b.tree, b.forces, b.beam, {"wind", [](double) {
                                                                return Wrench{{0, 0, std::nan("")}, Vec3::Zero()};
                                                            }});
        },
        {"load 'wind' at s = ", "nan", "finite"});
    b.settle();
    check_refused([&] { (void)b.equilibrium(2.1); }, {"beam: place of the section [m] = 2.1; allowed: 0 ... 2"});
    check_refused([&] { (void)constitutive_loads(b.beam, b.system->model, Vector::Zero(2), b.at.qd, 1); },
                  {"beam: sizes of q and qd = 2, 6; allowed: 6, one per coordinate"});
    check_refused([&] { (void)b.constitutive(-0.1); }, {"beam: place of the section [m] = -0.1"});
}
