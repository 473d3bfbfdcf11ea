// Section loads of strongly bent and of spinning beams against a Cosserat rod (oracles/cosserat_rod) and statics.
#include "solvers/equilibrium/equilibrium_path.hpp"
#include "tests/elements/cardan_beam/loaded_beam.hpp"
#include "tests/elements/cardan_beam/spinning_rods.hpp"

#include <Eigen/Geometry>
using namespace cardan;
using namespace cardan::testing;

namespace {

// A dead force at the tip of a clamped beam.
struct Case {
    oracles::TwistedRod rod;
    Vec3 force;
};

// Unequal bending stiffnesses, force between the principal axes: it twists by 0.3 rad, the tip moves by 0.62 L.
Case flat_beam() {
    const oracles::RodSection section{.EA = 1e3, .GJ = 0.8, .EI_y = 1, .EI_z = 4, .j_y = 0.01, .j_z = 0.01};
    return {{.section = [section](double) { return section; }, .steps = 256}, {0, 4, 2.5}};
}

// The 45-degree bend, shear rigid.            [Bathe and Bolourchi, Int. J. Numer. Meth. Eng. 14 (1979) 961-986]
Case bend() {
    const oracles::RodSection section{
        .EA = 1e7, .GJ = 5e6 / 6, .EI_y = 1e7 / 12, .EI_z = 1e7 / 12, .j_y = 1. / 12, .j_z = 1. / 12};
    return {{.length = 25 * pi, .section = [section](double) { return section; }, .curvature = {0, 0.01}, .steps = 256},
            {0, 0, 600}};
}

// Forces in units of the load, moments in units of load times length.
double distance(const Vec6& a, const Vec6& b, double force, double length) {
    return std::hypot((a - b).head<3>().norm() / force, (a - b).tail<3>().norm() / (force * length));
}

Loaded loaded(const Case& c, int elements, double delta, const HingeLaw& law = {}) {
    CardanBeamOptions options = all_free(elements, delta);
    options.hinge_law = law;
    Loaded b = clamped(line_of(c.rod), options);
    b.forces.add_wrench({"tip", b.beam.tip(), {c.force, Vec3::Zero()}, WrenchAxes::base});
    b.system.emplace(b.tree, b.forces);
    const solvers::EquilibriumPath path = solvers::equilibrium_path(*b.system, {.steps = 4});
    REQUIRE(path.converged);
    b.at = path.points.back().at;
    return b;
}

Loaded spinning(const SpinningRod& setting, int elements) {
    Loaded b;
    const JointedFrame hub = add_joint(b.tree, Tree::base(), JointKind::revolute, Axis::z, "spin", {"hub"});
    const FrameId root = b.tree.add_frame(hub.frame, setting.root(), "root");
    b.beam = add_cardan_beam(b.tree, b.forces, root, line_of(setting.rod()), "beam", {"beam"}, all_free(elements));
    b.settle(0, setting.speed);
    return b;
}

}  // namespace

TEST_CASE("section loads: at large deflection both ways are at the nodes statics of the bent beam, to rounding",
          "[analytic]") {
    // Balance of what is outboard, in base axes; the steady state is good to 1e-11 rad.
    for (const Case& c : {flat_beam(), bend()})
        for (const HingeLaw& law : {HingeLaw{}, HingeLaw{.isotropic = true, .section_frame = true}}) {
            const Loaded b = loaded(c, 5, sixth, law);
            Workspace workspace(b.system->model);
            const Kinematics kin = kinematics(b.system->model, b.at.q, workspace);
            const Vec3 tip = pose(kin, b.beam.tip()).p;
            CHECK((tip - Vec3(c.rod.length, 0, 0)).norm() > 0.5 * c.rod.length);
            for (std::size_t i = 0; i < b.beam.nodes.size(); ++i) {
                const Pose<double> node = pose(kin, b.beam.nodes[i]);
                const double s = static_cast<double>(i) * c.rod.length / 5;
                const Vec6 statics =
                    (Vec6() << node.R.transpose() * c.force, node.R.transpose() * cross<double>(tip - node.p, c.force))
                        .finished();
                CAPTURE(i);
                CHECK(distance(b.equilibrium(s), statics, c.force.norm(), c.rod.length) < 1e-10);
                CHECK(distance(b.constitutive(s).values, statics, c.force.norm(), c.rod.length) < 1e-10);
            }
            for (double t : {0.03, 0.37, 0.5, 0.63, 0.77})  // all four kinds of segments
                CHECK(distance(b.constitutive(t * c.rod.length).values, b.equilibrium(t * c.rod.length), c.force.norm(),
                               c.rod.length) < 1e-10);
        }
}

TEST_CASE(
    "section loads: at large deflection they converge to the Cosserat rod: order 2 at nodes, 1 inside of rigid "
    "segments",
    "[analytic]") {
    // Inside of a segment, which is straight, the section axes are off by O(h): so are the components. A third of the
    // beam is a third or two thirds of an element, in turn: the order is taken over four refinements.
    for (const Case& c : {flat_beam(), bend()})
        for (const double delta : {sixth, delta_gauss}) {
            oracles::RodLoad load;
            load.force = c.force;
            const oracles::RodSolution rod(c.rod.rod(), load);
            const auto errors = [&](int elements) {
                const Loaded b = loaded(c, elements, delta);
                std::vector<double> e;
                for (const double t : {0.0, 0.25, 0.5, 1.0, 1. / 3}) {
                    const double s = t * c.rod.length;
                    const Vec6 exact = rod.at(s).forces;
                    e.push_back(distance(b.equilibrium(s), exact, c.force.norm(), c.rod.length));
                    CHECK(distance(b.constitutive(s).values, exact, c.force.norm(), c.rod.length) ==
                          Approx(e.back()).margin(1e-9));
                }
                return e;
            };
            const auto n8 = errors(8), n16 = errors(16), n32 = errors(32);
            CAPTURE(delta, n8, n16, n32);
            for (std::size_t i = 0; i < 4; ++i) {
                CHECK(order(n16[i], n32[i]) == Approx(2).margin(0.03));
                CHECK(n32[i] < 2.2e-4);  // 1.9e-4: flat beam, delta = 1/6, middle
            }
            CHECK(order(n8[4], n32[4]) / 2 == Approx(1).margin(0.05));
        }
}

TEST_CASE("section loads: by equilibrium those of a spinning beam with everything off its axis converge with order 2",
          "[analytic]") {
    // Forces in units of the root force, moments in that times the length.
    SpinningRod swept = fore();
    swept.curvature = {-0.2, 0.25};
    for (const SpinningRod& setting : {aft(), swept}) {
        const oracles::RodSolution rod(setting.rod().rod_in_line_axes(), setting.loads());
        const double unit = rod.at(0).forces.head<3>().norm();
        const Loaded n16 = spinning(setting, 16), n32 = spinning(setting, 32);
        for (const double t : {0.0, 0.25, 0.5, 0.75, 0.875}) {
            const double s = t * setting.length;
            const Vec6 exact = rod.at(s).forces;
            const double coarse = distance(n16.equilibrium(s), exact, unit, setting.length),
                         fine = distance(n32.equilibrium(s), exact, unit, setting.length);
            CAPTURE(t, coarse, fine);
            CHECK(order(coarse, fine) == Approx(2).margin(0.03));
            CHECK(fine < 1e-5);  // up to 8.3e-6
        }
    }
}

TEST_CASE("section loads: the pull of a spinning beam by equilibrium is the centrifugal force of what is outboard",
          "[analytic]") {
    // int mu r Omega^2 ds over the deflected rod, r the distance of the mass centres from the spin axis, in the
    // plane of rotation. The elements are good to 1e-5 (above), the midpoint rule of 200 points to 200^-2 / 24 = 1e-6.
    for (const SpinningRod& setting : {aft(), fore()}) {
        const oracles::RodSolution rod(setting.rod().rod(), setting.loads());
        const Loaded b = spinning(setting, 32);
        const Mat3 root = rot_y(-setting.cone);
        for (const double t : {0.0, 0.5}) {
            Vec3 pull = Vec3::Zero();
            constexpr int n = 200;
            const double ds = (1 - t) * setting.length / n;
            for (int i = 0; i < n; ++i) {
                const oracles::RodState at = rod.at(t * setting.length + (i + 0.5) * ds);
                const Vec3 centre =
                    at.position + at.rotation * Vec3(0, setting.section.mass_centre(0), setting.section.mass_centre(1));
                pull += setting.section.mass * setting.speed * setting.speed * ds * Vec3(centre.x(), centre.y(), 0);
            }
            const Mat3 axes = t == 0 ? root
                                     : Mat3(rod.at(t * setting.length).rotation *
                                            setting.rod().principal(t * setting.length).transpose());
            const Vec3 expected = axes.transpose() * pull;
            CHECK((b.equilibrium(t * setting.length).head<3>() - expected).norm() < 2e-5 * pull.norm());
        }
    }
}

TEST_CASE(
    "section loads: the springs of a spinning beam give them with order 2 in the middle of elements, without the shear "
    "that moments across the beam ask for",
    "[analytic]") {
    // Springs know the force as constant in an element. They see M' of the shear, which a distributed moment m changes:
    // M_y' = V_z - m_y, M_z' = -V_y - m_z. Here the centrifugal force at the mass centre has one about the line.
    SpinningRod centred = fore();
    centred.section.mass_centre = {0, 0};
    for (const SpinningRod& setting : {centred, fore()}) {
        const oracles::CosseratRod line = setting.rod().rod_in_line_axes();
        const oracles::RodSolution rod(line, setting.loads());
        const double unit = rod.at(0).forces.head<3>().norm();
        const Loaded n16 = spinning(setting, 16), n32 = spinning(setting, 32);
        const auto errors = [&](const Loaded& b, double s) {
            const oracles::RodState at = rod.at(s);
            const Vec3 c = at.rotation * line.inertia(s).centre, W(0, 0, setting.speed);
            const Vec3 a = W.cross(W.cross(at.position + c));
            const Vec3 m = at.rotation.transpose() * c.cross(-setting.section.mass * a);
            Vec6 seen = at.forces;
            seen(1) += m.z(), seen(2) -= m.y();
            const Vec6 found = b.constitutive(s).values;
            return std::pair(distance(found, seen, unit, setting.length),
                             distance(found, at.forces, unit, setting.length));
        };
        const bool off = setting.section.mass_centre(0) != 0;
        for (const double t : {0.25, 0.5, 0.75}) {
            const double middle = setting.length / 64;  // of an element of 32; of 16: twice that
            const auto coarse = errors(n16, t * setting.length + 2 * middle),
                       fine = errors(n32, t * setting.length + middle);
            CAPTURE(off, t, coarse.first, fine.first, fine.second);
            CHECK(fine.first < 3e-5);
            if (!off) CHECK(order(coarse.first, fine.first) == Approx(2).margin(0.2));
            if (off) CHECK(fine.second > 0.03);
        }
    }
}
