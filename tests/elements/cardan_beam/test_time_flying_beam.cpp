// A free beam that is flung by a force and a moment at its lower end and flies on, after Simo and Vu-Quoc [J. Appl.
// Mech. 53 (1986) 855-863; Comput. Methods Appl. Mech. Eng. 66 (1987) 125-161 in space]: no published number is used
// but the data; what holds exactly are impulse and momentum, and the energy once the load has ended. The plane motion
// is held against Ritz's method for the geometrically exact rod (oracles/planar_rod).
#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/atlas/atlas.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/oracles/planar_rod.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/tree_tools.hpp"

#include <array>
#include <limits>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// Force and moment, fixed axes; the load is over at `end`.
struct Load {
    Vec3 force, moment;  // at the time of the peak
    bool triangular;     // rising to 2.5 s, falling to 5 s; else constant up to 2.5 s: the impulse is the same
    double end() const { return triangular ? 5 : 2.5; }
    double factor(double t) const {
        if (!triangular) return 1;  // until it is taken away: a jump in here would be seen by the step that ends at it
        return t < 2.5 ? t / 2.5 : t < 5 ? 2 - t / 2.5 : 0;
    }
    Vec3 impulse() const { return 2.5 * force; }
};

struct Section {
    double EI = 500, EA = 1e4, GA = 1e4, GJ = 500, mass = 1, rotary_inertia = 10;
};

constexpr double armature = 100;
const Vec3 lower(6, 0, 0), direction = Vec3(-6, 8, 0) / 10;  // from (6, 0) to (0, 8)

// The beam on translations x, y(, z) and rotations about the axes given, clamped to the last one with its lower end.
// Coordinates "angular impulse x" ... hold the time integral of the moment of the load about the origin as their rate:
// massless bodies with an armature of 100 kg, so that the method of integration evaluates it beside the motion.
struct FlyingBeam {
    CardanBeam beam;
    System system;
    std::vector<Drive> drives;  ///< out of the plane nothing moves, if it flies in the plane

    FlyingBeam(int elements, const Section& section, const Load& load, const std::vector<int>& axes,
               const std::string& chart = "")
        : FlyingBeam(Tree(), ForceSet(), elements, section, load, axes, chart) {}

    Vector at_rest() const {
        Vector q = Vector::Zero(system.model.size());
        for (int i = 0; i < 3; ++i)
            if (const std::string name = text("translation ", i); has(name)) q(system.model.index(name)) = lower(i);
        return q;
    }
    Vec3 angular_impulse(const Vector& qd) const {
        Vec3 h;
        for (int i = 0; i < 3; ++i) h(i) = armature * qd(system.model.index(text("angular impulse ", i)));
        return h;
    }
    Momentum momentum_of(const DynamicState& state) const {
        Workspace workspace(system.model);
        return momentum(kinematics(system.model, state.q, workspace), state.qd);
    }
    Vec3 tip(const DynamicState& state) const {
        Workspace workspace(system.model);
        return pose(kinematics(system.model, state.q, workspace), beam.tip()).p;
    }

private:
    FlyingBeam(Tree tree, ForceSet forces, int elements, const Section& section, const Load& load,
               const std::vector<int>& axes, const std::string& chart)
        : beam(add(tree, forces, elements, section, load, axes, chart)), system(tree, forces) {
        if (axes.size() == 3) return;
        for (int i = 0; i < system.model.size(); ++i)
            if (system.model.coordinates()[i].name.find("bending y") != std::string::npos)
                drives.push_back({i, Motion::constant(0)});
    }
    bool has(const std::string& name) const {
        for (const CoordinateInfo& c : system.model.coordinates())
            if (c.name == name) return true;
        return false;
    }
    static ForceElement flinging(const Load& load, FrameId root, const Model& model,
                                 const std::vector<BodyId>& integrals, bool plane) {
        std::array<int, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) at[i] = model.index(integrals[i]);
        ForceElement user{.name = "load", .points = {{Tree::base()}}};
        user.evaluate = [load, root, at](const ElementView& in, ElementForces& out) {
            const double factor = load.factor(in.time);
            Matrix J(6, out.Q.size());
            frame_jacobian<double>(in.system.kinematics, root, J);
            Vec6 wrench;
            wrench << factor * load.moment, factor * load.force;
            out.Q += J.transpose() * wrench;
            const Vec3 moment = wrench.head<3>() + pose(in.system.kinematics, root).p.cross(wrench.tail<3>());
            for (int i = 0; i < 3; ++i) out.Q(entry(at, i)) += moment(i);
        };
        // In the plane only the moment about the origin depends on the position.
        if (plane)
            user.jacobian = [load, at](const ElementView& in, ElementJacobian& d) {
                d.Q_q(at[2], 0) += load.factor(in.time) * load.force.y();
                d.Q_q(at[2], 1) -= load.factor(in.time) * load.force.x();
            };
        return user;
    }
    static CardanBeam add(Tree& tree, ForceSet& forces, int elements, const Section& data, const Load& load,
                          const std::vector<int>& axes, const std::string& chart) {
        const bool plane = axes.size() == 1;
        FrameId at = Tree::base();
        for (int i = 0; i < (plane ? 2 : 3); ++i)
            at = testing::add_joint(tree, {text("translation ", i), at, JointKind::prismatic, Vec3::Unit(i)}).axes;
        for (int axis : axes)
            at = testing::add_joint(tree, {text(chart, "rotation ", axis), at, JointKind::revolute, Vec3::Unit(axis)})
                     .axes;
        tree.add_frame(at, {}, "carrier");
        const FrameId root =
            tree.add_frame(at, Placement::rotation(rot_z(std::atan2(direction.y(), direction.x()))), "root");
        EngineeringSection section = slender(data.EI, data.mass);
        section.EA = data.EA, section.GA_y = section.GA_z = data.GA;
        section.j_flap = section.j_edge = data.rotary_inertia;
        if (!plane) section.GJ = data.GJ;
        CardanBeamOptions options = bending_only(elements, sixth, Partition::static_moment);
        options.extension = true;
        options.torsion = !plane;
        CardanBeam beam = add_cardan_beam(tree, forces, root, uniform_beam(10, section), "beam", {"beam"}, options);
        std::vector<BodyId> integrals;
        for (int i = 0; i < 3; ++i) {
            const std::string name = text("angular impulse ", i);
            integrals.push_back(testing::add_joint(tree, {name, Tree::base(), JointKind::prismatic}).body);
            tree.add_armature({name, armature, {{integrals.back(), 1.0}}});
        }
        forces.add_element(flinging(load, root, Model(tree), integrals, plane));
        return beam;
    }
};

IntegrationOptions with(Method method, double tolerance) {
    IntegrationOptions options;
    options.method = method;
    options.tolerances = {tolerance, tolerance, tolerance, tolerance, tolerance};
    options.breaks = {2.5, 5};
    return options;
}

// In the plane: 8 N to the right and 80 N m clockwise at the lower end.
Load plane_load(bool triangular) {
    return {Vec3(8, 0, 0), Vec3(0, 0, -80), triangular};
}

}  // namespace

TEST_CASE("flying beam: in the plane it converges to the geometrically exact rod", "[time][analytic]") {
    const Load load = plane_load(true);
    const Section section{.GA = std::numeric_limits<double>::infinity()};
    const std::vector<double> times{2.5, 5, 7};
    const oracles::PlanarRod rod{10, section.mass, section.rotary_inertia, section.EA, section.EI, 9, 6};
    oracles::PlanarRodMotion exact(rod, lower.head<2>(), std::atan2(direction.y(), direction.x()), [&](double t) {
        const double f = load.factor(t);
        return oracles::PlanarRodMotion::Load{f * load.force.x(), f * load.force.y(), f * load.moment.z()};
    });
    std::vector<Eigen::Vector2d> places;
    for (double t : times) {
        exact.advance(t, static_cast<int>(500 * (t - exact.time()) + 0.5));
        places.emplace_back(exact.position(10));
    }
    const auto errors = [&](int elements) {
        const FlyingBeam flying(elements, section, load, {2});
        Integrator integrator(flying.system, flying.drives, 0, flying.at_rest(),
                              Vector::Zero(flying.system.model.size()), with(Method::adams, 1e-8));
        std::vector<double> list;
        for (std::size_t i = 0; i < times.size(); ++i) {
            REQUIRE(integrator.advance(times[i]).reached());
            list.push_back((flying.tip(integrator.state()).head<2>() - places[i]).norm());
        }
        return list;
    };
    const auto e4 = errors(4), e8 = errors(8), e16 = errors(16);
    for (std::size_t i = 0; i < times.size(); ++i) {
        CAPTURE(times[i], e4[i], e8[i], e16[i]);
        CHECK(order(e8[i], e16[i]) > 1.6);
        CHECK(e16[i] < 5e-3);
    }
}

TEST_CASE("flying beam: impulse and momentum, and the energy after the load, in the plane", "[time][analytic]") {
    struct Case {
        Method method;
        double tolerance, error;
    };
    const Case all[] = {{Method::bdf, 1e-9, 1e-6},
                        {Method::adams, 1e-9, 1e-6},
                        {Method::dirk, 1e-8, 1e-6},
                        {Method::erk, 1e-9, 1e-7},
                        {Method::generalised_alpha, 1e-7, 5e-4}};
    for (const bool triangular : {true, false}) {
        // Bends into a hook under the triangle; the constant load hits a beam that is five times stiffer.
        const Load load = plane_load(triangular);
        const FlyingBeam flying(4, {.EI = triangular ? 100.0 : 500.0}, load, {2});
        const Vector rest = Vector::Zero(flying.system.model.size());
        const Forces springs = flying.system.forces.with_load_factor(0, false);
        for (const Case& c : all) {
            if (!triangular && c.method != Method::adams && c.method != Method::erk) continue;
            Integrator integrator(flying.system, flying.drives, 0, flying.at_rest(), rest, with(c.method, c.tolerance));
            REQUIRE(integrator.advance(load.end()).reached());
            const EnergyBalance released = integrator.energy();
            const Vec3 impulse = flying.angular_impulse(integrator.state().qd);
            const double total = released.kinetic + released.potential;
            const double energy = total - impulse.squaredNorm() / (2 * armature);  // of the beam
            integrator.set_forces(&springs);
            REQUIRE(integrator.advance(10).reached());
            const EnergyBalance balance = integrator.energy();
            const Momentum now = flying.momentum_of(integrator.state());
            const double linear = (now.linear - load.impulse()).norm();
            const double angular = std::abs(now.angular.z() - impulse.z());
            const double drift = std::abs(balance.kinetic + balance.potential - total);
            CAPTURE(triangular, static_cast<int>(c.method), linear, angular, drift, energy, balance.error);
            CHECK(std::abs(impulse.z()) > 100);
            CHECK(linear < c.error);
            CHECK(angular < 10 * c.error);
            CHECK(drift < c.error * energy);
            CHECK(std::abs(balance.error) < c.error * energy);
        }
    }
}

TEST_CASE("flying beam: impulse, momentum and energy in space, through changes of chart", "[time][analytic]") {
    // A force of 20 N, a moment of 200 N m about z and half of it across. Rotations about z, y, x are singular where
    // the beam stands along z, those about y, z, x where it lies along y.
    const Load load{Vec3(20, 0, 0), Vec3(0, 100, -200), true};
    const FlyingBeam zyx(4, {}, load, {2, 1, 0}, "first "), yzx(4, {}, load, {1, 2, 0}, "second ");
    struct Case {
        Method method;
        double tolerance, error;
    };
    for (const Case& c : {Case{Method::adams, 1e-9, 1e-6}, Case{Method::erk, 1e-9, 1e-9}}) {
        const IntegrationOptions options = with(c.method, c.tolerance);
        AtlasIntegrator atlas({{&zyx.system, {}, options}, {&yzx.system, {}, options}}, "carrier", 0, zyx.at_rest(),
                              Vector::Zero(zyx.system.model.size()));
        const auto flying = [&]() -> const FlyingBeam& { return atlas.chart() == 0 ? zyx : yzx; };
        REQUIRE(atlas.advance(load.end()).reached());
        const EnergyBalance released = atlas.integrator().energy();
        const Vec3 impulse = flying().angular_impulse(atlas.integrator().state().qd);
        const double total = released.kinetic + released.potential;
        const double energy = total - impulse.squaredNorm() / (2 * armature);
        REQUIRE(atlas.advance(10).reached());
        const Momentum now = flying().momentum_of(atlas.integrator().state());
        const EnergyBalance balance = atlas.integrator().energy();
        const double linear = (now.linear - load.impulse()).norm(), angular = (now.angular - impulse).norm();
        const double drift = std::abs(balance.kinetic + balance.potential - total);
        CAPTURE(static_cast<int>(c.method), linear, angular, drift, balance.error, atlas.changes());
        CHECK(impulse.norm() > 600);
        CHECK(linear < c.error * load.impulse().norm());
        CHECK(angular < c.error * impulse.norm());
        CHECK(drift < c.error * energy);
        CHECK(std::abs(balance.error) < c.error * energy);
        CHECK(atlas.changes() >= 2);
    }
}
