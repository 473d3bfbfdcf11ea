// The NREL 5 MW blade on a moving platform: frames, loads of the rigid blade, invariances, bad input. Oracle of the
// kinematics: the frames written out vector by vector, their time derivatives by Taylor series.
#include "elements/cardan_beam/section_loads.hpp"
#include "elements/sections/quadrature.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "tests/oracles/jet.hpp"
#include "tests/oracles/platform_frames.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/model/channels.hpp"
#include "turbines/reference_turbines/nrel5mw_platform.hpp"

namespace cardan::testing::driven_platform {

using oracles::Jet;
using Frames = oracles::PlatformFrames<Jet<1>>;
using turbines::Nrel5mwPlatformOptions;
using turbines::Turbine;

namespace {

Turbine machine(int elements, int blades = 1,
                const turbines::Nrel5mwBlade& blade = turbines::nrel5mw_platform_blade()) {
    Nrel5mwPlatformOptions options;
    options.blades = blades;
    options.elements = turbines::nrel5mw_platform_elements(elements);
    return turbines::nrel5mw_on_platform(blade, options);
}

// Ground axes of the library: x = Z0, y = -Y0, z = X0.
Vec3 value(const Frames::Vector& v) {
    return {v.z.value, -v.y.value, v.x.value};
}
Vec3 rate(const Frames::Vector& v) {
    return {v.z.gradient(0), -v.y.gradient(0), v.x.gradient(0)};
}
Vec3 acceleration(const Frames::Vector& v) {
    return {v.z.hessian(0, 0), -v.y.hessian(0, 0), v.x.hessian(0, 0)};
}
Mat3 columns(const Vec3& a, const Vec3& b, const Vec3& c) {
    return (Mat3() << a, b, c).finished();
}

// A state of the driven coordinates, in the order of oracles::PlatformMotion, at which they have any rates.
struct Motion {
    std::array<Jet<1>, 8> at;
    explicit Motion(unsigned seed) {
        Random random(seed);
        for (std::size_t i = 0; i < at.size(); ++i) {
            at[i] = Jet<1>(uniform(random, -1, 1) * (i == 7 ? pi : i < 3 ? 5 : 0.6));
            at[i].gradient(0) = uniform(random, -1, 1);
            at[i].hessian(0, 0) = uniform(random, -1, 1);
        }
    }
    Frames frames(double blade_azimuth = 0) const {
        return Frames({at[0], at[1], at[2], at[3], at[4], at[5], at[6], at[7]}, blade_azimuth);
    }
};

// The library's machine at a state, blades undeformed unless changed.
struct PlatformState {
    const Turbine& machine;
    const Model& model = machine.system().model;
    Vector q = Vector::Zero(model.size()), qd = q, qdd = q, actuator = q;
    Workspace workspace{model};

    PlatformState(const Turbine& m, const Motion& motion) : machine(m) {
        for (std::size_t i = 0; i < 8; ++i) {
            const BodyId body = i < 6    ? m.layout().platform->coordinates.at(i)
                                : i == 6 ? *m.layout().yaw
                                         : *m.layout().generator;
            const int a = model.index(body);
            q(a) = motion.at[i].value;
            qd(a) = motion.at[i].gradient(0);
            qdd(a) = motion.at[i].hessian(0, 0);
        }
    }
    void deform(unsigned seed) {
        Random random(seed);
        for (int a : model.coordinates().free()) {
            q(a) = uniform(random, -0.02, 0.02);
            qd(a) = uniform(random, -0.1, 0.1);
        }
    }
    Kinematics kin() { return kinematics(model, q, workspace); }
    // Accelerations of the blades and forces of the drives.
    void solve(const Forces& forces) {
        Vector Q(model.size());
        const Kinematics at = kin();
        forces.generalised_forces({{.q = q, .qd = qd}, at}, Q);
        ForwardDynamics(model).solve(at, qd, Q, qdd, actuator);
    }
    void solve() { solve(machine.system().forces); }
    std::vector<double> sample(const ChannelGroup& group) {
        const Kinematics at = kin();
        const System& system = machine.system();
        const DynamicState state{{.q = q, .qd = qd}, qdd, {}, actuator};
        std::vector<double> values(group.channels.size());
        group.sample({state, at, system.forces, system.loops}, values.data());
        return values;
    }
};

// Force and moment about the root of the hub on a rigid blade, in the blade's axes: weight and inertia of the line.
Vec6 rigid_blade_loads(const turbines::Nrel5mwBlade& blade, const Frames& f, const Vec3& gravity) {
    const Mat3 E = columns(value(f.e1), value(f.e2), value(f.e3));
    const Mat3 E1 = columns(rate(f.e1), rate(f.e2), rate(f.e3));
    const Mat3 E2 = columns(acceleration(f.e1), acceleration(f.e2), acceleration(f.e3));
    const auto axial = [](const Mat3& W) { return Vec3(W(2, 1), W(0, 2), W(1, 0)); };
    const Vec3 w = axial(E.transpose() * E1), dw = axial(E.transpose() * E2 + E1.transpose() * E1);
    return integrate(0, blade.line.length, blade.line.breaks, Vec6(Vec6::Zero()), [&](double x) {
        const BeamSection s = blade.line.section(x);
        const Frames::Vector centre =
            f.root + Jet<1>(x) * f.e1 + Jet<1>(s.centre.y()) * f.e2 + Jet<1>(s.centre.z()) * f.e3;
        const Vec3 force = s.mass * E.transpose() * (acceleration(centre) - gravity);
        const Vec3 spin = s.J * dw + cross<double>(w, Vec3(s.J * w));
        return Vec6((Vec6() << force, cross<double>(Vec3(x, s.centre.y(), s.centre.z()), force) + spin).finished());
    });
}

}  // namespace

TEST_CASE("platform: blade roots move as the frames written out say, with velocity and acceleration", "[analytic]") {
    const Turbine m = machine(1, 3);
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const Motion motion(seed);
        PlatformState s(m, motion);
        const Kinematics kin = s.kin();
        const JointLoads loads = joint_loads({{.q = s.q, .qd = s.qd}, kin}, m.system().forces, s.qdd);
        for (std::size_t k = 0; k < 3; ++k) {
            const Frames exact = motion.frames(2 * pi / 3 * static_cast<double>(k));
            const turbines::MachineLayout& layout = m.layout();
            const Pose<double> axes = pose(kin, layout.pitch_axes[k]), root = pose(kin, layout.blades[k].nodes.front());
            CHECK((axes.R - columns(value(exact.e1), value(exact.e2), value(exact.e3))).norm() < 1e-14);
            CHECK((root.R - axes.R).norm() < 1e-14);
            CHECK((root.p - value(exact.root)).norm() < 1e-13 * 100);
            Matrix J(6, s.model.size());
            frame_jacobian<double>(kin, layout.blades[k].nodes.front(), J);
            const Vec3 velocity = (J * s.qd).tail<3>();
            CHECK((velocity - rate(exact.root)).norm() < 1e-12 * 100);
            const BodyMotion& moved = entry(loads.motion, s.model.index(layout.pitch[k]));
            CHECK((moved.acceleration - acceleration(exact.root)).norm() < 1e-12 * 300);
        }
        const Pose<double> apex = pose(kin, m.layout().rotor_centre);
        CHECK((apex.p - value(motion.frames().apex)).norm() < 1e-11);
        CHECK((apex.R.col(2) - value(motion.frames().axis)).norm() < 1e-14);
    }
}

TEST_CASE("platform: signs of the six motions in words", "[analytic]") {
    const Turbine m = machine(1);
    Workspace workspace(m.system().model);
    const auto apex = [&](BaseCoordinate which) {
        Vector q = Vector::Zero(m.system().model.size());
        const Vec3 before = pose(kinematics(m.system().model, q, workspace), m.layout().rotor_centre).p;
        q(m.system().model.index(m.layout().platform->coordinate(which))) = 1e-3;
        return Vec3(pose(kinematics(m.system().model, q, workspace), m.layout().rotor_centre).p - before);
    };
    CHECK((apex(BaseCoordinate::surge) - Vec3(1e-3, 0, 0)).norm() < 1e-12);  // downwind
    CHECK((apex(BaseCoordinate::sway) - Vec3(0, -1e-3, 0)).norm() < 1e-12);  // to the right, seen along the wind
    CHECK((apex(BaseCoordinate::heave) - Vec3(0, 0, 1e-3)).norm() < 1e-12);  // up
    CHECK(apex(BaseCoordinate::pitch).x() == Approx(-0.090).margin(1e-4));   // the tower top goes upwind
    CHECK(apex(BaseCoordinate::roll).y() == Approx(-0.090).margin(1e-4));    // to the right
    CHECK(apex(BaseCoordinate::yaw).y() == Approx(-0.005).margin(1e-4));     // counterclockwise from above
}

TEST_CASE("platform: blade pitch setting turns the leading edge upwind, the coordinate downwind", "[property]") {
    Nrel5mwPlatformOptions options;
    options.elements = turbines::nrel5mw_platform_elements(1);
    options.pitch = 0.2;
    const Turbine set = turbines::nrel5mw_on_platform(turbines::nrel5mw_platform_blade(), options);
    const Turbine turned = machine(1);
    Workspace first(set.system().model), second(turned.system().model);
    Vector q = Vector::Zero(set.system().model.size());
    const Kinematics at_set = kinematics(set.system().model, q, first);
    q(turned.system().model.index(turned.layout().pitch[0])) = -0.2;
    const Kinematics at_turned = kinematics(turned.system().model, q, second);
    const Mat3 R = pose(at_set, set.layout().blades[0].nodes.front()).R;
    CHECK((R - pose(at_turned, turned.layout().blades[0].nodes.front()).R).norm() < 1e-14);
    CHECK((R.transpose() * pose(at_set, set.layout().pitch_axes[0]).R.col(2))(1) ==
          Approx(-std::sin(0.2)).epsilon(1e-12));
}

TEST_CASE("platform: root loads of the undeformed blade are weight and inertia of the line, whatever moves",
          "[analytic]") {
    // For the blade flexible in shear (GA = 20 EA) the elements keep products of inertia with the axis to order h^2
    // only.
    turbines::Nrel5mwBladeOptions shear_rigid;
    shear_rigid.shear_ratio = std::numeric_limits<double>::infinity();
    for (const auto& [blade, error] :
         {std::pair(turbines::nrel5mw_blade(shear_rigid), 1e-11), std::pair(turbines::nrel5mw_platform_blade(), 2e-6)})
        for (int elements : {1, 5}) {
            const Turbine m = machine(elements, 1, blade);
            for (unsigned seed = 1; seed <= 5; ++seed) {
                const Motion motion(seed);
                PlatformState s(m, motion);
                const std::vector<double> values = s.sample(turbines::blade_channels(m));
                const Vec6 exact = rigid_blade_loads(blade, motion.frames(), {0, 0, -units::standard_gravity});
                for (int i = 0; i < 6; ++i) {
                    CAPTURE(elements, seed, i);
                    CHECK(std::abs(entry(values, 3 + i) - exact(i)) < error * exact.segment<3>(i < 3 ? 0 : 3).norm());
                }
                for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(values[i]) < 1e-12);
            }
        }
}

TEST_CASE("platform: drives carry the root loads of the deformed blade; section loads at the root are their reaction",
          "[property]") {
    const Turbine m = machine(4);
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const Motion motion(seed);
        PlatformState s(m, motion);
        s.deform(seed);
        s.solve();
        const std::vector<double> values = s.sample(turbines::blade_channels(m));
        const Frames f = motion.frames();
        const Mat3 E = columns(value(f.e1), value(f.e2), value(f.e3));
        const Vec3 force = E * Vec3(values[3], values[4], values[5]),
                   moment = E * Vec3(values[6], values[7], values[8]);
        const auto drive = [&](BodyId body) { return s.actuator(s.model.index(body)); };
        const auto about = [&](const Vec3& point) {
            return Vec3(moment + cross<double>(Vec3(value(f.root) - point), force));
        };
        const double scale = 1e-11 * moment.norm(), arm = 100;
        CHECK(std::abs(drive(m.layout().platform->coordinate(BaseCoordinate::surge)) - force.x()) < scale);
        CHECK(std::abs(drive(m.layout().platform->coordinate(BaseCoordinate::sway)) + force.y()) < scale);
        CHECK(std::abs(drive(m.layout().platform->coordinate(BaseCoordinate::heave)) - force.z()) < scale);
        const Vec3 origin(motion.at[0].value, -motion.at[1].value, motion.at[2].value);
        CHECK(std::abs(drive(m.layout().platform->coordinate(BaseCoordinate::roll)) - about(origin).x()) < scale * arm);
        CHECK(std::abs(drive(*m.layout().generator) - dot<double>(value(f.axis), about(value(f.apex)))) < scale * arm);
        CHECK(std::abs(drive(m.layout().pitch[0]) - values[6]) < scale);

        const std::vector<double> drives = s.sample(turbines::drive_channels(m));
        const ChannelGroup group = turbines::drive_channels(m);
        REQUIRE(group.channels.size() == 18);
        for (std::size_t i = 0; i < drives.size(); i += 2) {
            const int a = s.model.index(group.channels[i].name);
            CHECK(drives[i] == s.q(a));
            CHECK(group.channels[i + 1].name == group.channels[i].name + " drive");
            CHECK(drives[i + 1] == s.actuator(a));
        }

        const Kinematics kin = s.kin();
        const JointLoads loads = joint_loads({{.q = s.q, .qd = s.qd}, kin}, m.system().forces, s.qdd);
        const SectionLoads section = equilibrium_loads(m.layout().blades[0], kin, m.system().forces, loads, 0);
        for (int i = 0; i < 6; ++i) CHECK(std::abs(section.values(i) + entry(values, 3 + i)) < scale * arm);
    }
}

TEST_CASE(
    "platform: a steady velocity of the base changes no acceleration and no load, an acceleration acts as gravity",
    "[property]") {
    const Turbine m = machine(4);
    const Motion motion(7);
    PlatformState still(m, motion);
    still.deform(7);
    still.solve();
    const double size = still.qdd.norm(), forces = still.actuator.norm();
    constexpr std::array directions{BaseCoordinate::surge, BaseCoordinate::sway, BaseCoordinate::heave};
    const std::array<Vec3, 3> along{Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ()};
    for (std::size_t i = 0; i < 3; ++i) {
        PlatformState moving = PlatformState(m, motion);
        moving.q = still.q;
        moving.qd = still.qd;
        const int a = moving.model.index(m.layout().platform->coordinate(directions.at(i)));
        moving.qd(a) += 20;
        moving.q(a) += 1000;
        moving.solve();
        CHECK((moving.qdd - still.qdd).norm() < 1e-9 * size);
        CHECK((moving.actuator - still.actuator).norm() < 1e-9 * forces);

        PlatformState accelerated = PlatformState(m, motion);
        accelerated.q = still.q;
        accelerated.qd = still.qd;
        accelerated.qdd(a) += 3;
        accelerated.solve();
        CHECK((accelerated.qdd - still.qdd).norm() > 1e-3 * size);
        PlatformState heavier = PlatformState(m, motion);
        heavier.q = still.q;
        heavier.qd = still.qd;
        heavier.solve(m.system().forces.with_gravity(Vec3(0, 0, -units::standard_gravity) - 3 * along.at(i)));
        accelerated.qdd(a) = heavier.qdd(a) = 0;
        CHECK((accelerated.qdd - heavier.qdd).norm() < 1e-9 * size);
        CHECK((accelerated.actuator - heavier.actuator).norm() < 1e-9 * forces);
    }
}

TEST_CASE("platform: driven are the platform, yaw, spin and pitch, free are the blades", "[property]") {
    const Turbine m = machine(2, 3);
    const Model& model = m.system().model;
    CHECK(model.size() == 6 + 2 + 3 * (1 + 12));
    CHECK(model.coordinates().free().size() == 36);
    CHECK(model.mass() == Approx(3 * 17608.83).epsilon(1e-6));
    REQUIRE(m.rotor().blades.size() == 3);
    for (int a : model.coordinates().free()) CHECK(model.coordinates()[a].part == "blade");
    for (std::size_t k = 0; k < 3; ++k)
        for (int a : m.rotor().blades[k]) CHECK(model.coordinates()[a].blade == static_cast<int>(k) + 1);
    CHECK(m.rotor().spin == model.index("generator azimuth"));
    // Damping ratio at the first flap frequency at rest, 0.6772 Hz: 0.477465 %.
    CHECK(pi * 0.6772 * turbines::nrel5mw_platform_damping == Approx(0.00477465).epsilon(1e-4));
}

TEST_CASE("platform: bad options are refused", "[property]") {
    const auto refused = [](auto change, std::initializer_list<std::string> parts) {
        Nrel5mwPlatformOptions options;
        options.elements = turbines::nrel5mw_platform_elements(2);
        change(options);
        check_refused([&] { (void)turbines::nrel5mw_on_platform(turbines::nrel5mw_platform_blade(), options); }, parts);
    };
    using O = Nrel5mwPlatformOptions;
    for (int blades : {0, 4})
        refused([=](O& o) { o.blades = blades; }, {"platform: number of blades = ", text(blades), "1 ... 3"});
    refused([](O& o) { o.pitch = std::nan(""); }, {"platform: pitch [rad] = nan", "finite"});
    refused([](O& o) { o.gravity(1) = std::nan(""); }, {"gravity", "nan", "finite"});
    for (int elements : {0, 1001})
        refused([=](O& o) { o.elements.elements = elements; }, {"number of elements = ", text(elements)});
    refused([](O& o) { o.elements = turbines::nrel5mw_platform_elements(2, -1); }, {"damping", "-1", ">= 0"});
    turbines::Nrel5mwBladeOptions rigid;
    rigid.axial = false;
    check_refused([&] { (void)turbines::nrel5mw_on_platform(nrel5mw_blade(rigid)); }, {"extension", "EA"});
}

}  // namespace cardan::testing::driven_platform
