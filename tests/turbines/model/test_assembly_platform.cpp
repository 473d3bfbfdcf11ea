// The 600 kW machine on a moving platform: invariances (Galilei, equivalence of acceleration and gravity), loads at the
// foot against the rate of change of momentum and against the forces of the drives, a free platform.
#include "mbs/base/entry.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "solvers/campbell/diagram.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/floating.hpp"
#include "tests/turbines/reference_turbines/sampled_channels.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <numeric>

using namespace cardan;
using namespace cardan::testing;
using namespace cardan::turbines;

namespace {

struct Setup {
    TurbineDescription description = wt600_description();
    AssemblyOptions options;
    Turbine assembled() const { return assemble(description, options); }
};

Setup on_ground(const Vec3& gravity, int elements = 2) {
    Setup setup;
    setup.options = wt600_paper_assembly(elements);
    setup.options.gravity = gravity;
    return setup;
}
Setup on_platform(const Vec3& gravity, int elements = 2) {
    Setup setup = on_ground(gravity, elements);
    setup.description.platform.emplace();
    return setup;
}

// Positions, rates and accelerations of surge, sway, heave, roll, pitch, yaw.
struct PlatformMotion {
    Vec6 q = Vec6::Zero(), qd = q, qdd = q;
    Mat3 R() const { return rot_z(q(5)) * rot_y(q(4)) * rot_x(q(3)); }
};

Vec6 random_vector6(Random& random, double length, double angle) {
    Vec6 v;
    v << length * random_vector(random), angle * random_vector(random);
    return v;
}

// A machine in a random motion: with the same seed the same one on the ground and on a platform.
struct Moving {
    Turbine turbine;
    MachineState state;
    Vector actuator;

    Moving(const Setup& setup, unsigned seed, const PlatformMotion& platform = {})
        : turbine(setup.assembled()), state(turbine) {
        Random random(seed);
        const Model& model = turbine.system().model;
        for (const CoordinateInfo& row : model.coordinates()) {
            if (row.part == "platform") continue;
            const int i = model.index(row.name);
            const double q = uniform(random, -1, 1), qd = uniform(random, -1, 1);
            state.q(i) = (model.body(i).revolute ? 0.02 : 0.001) * q;
            state.qd(i) = 0.05 * qd;
        }
        state.q(turbine.rotor().spin) = 0.9 + seed;
        state.qd(turbine.rotor().spin) = 2.9;
        if (turbine.layout().platform) put(platform);
        accelerate();
    }
    int platform(int coordinate) const {
        return turbine.system().model.index(entry(turbine.layout().platform->coordinates, coordinate));
    }

private:
    void put(const PlatformMotion& motion) {
        for (int i = 0; i < 6; ++i) {
            state.q(platform(i)) = motion.q(i);
            state.qd(platform(i)) = motion.qd(i);
            state.qdd(platform(i)) = motion.qdd(i);
        }
    }
    // Accelerations of the free coordinates under the machine's forces, and the forces of the drives.
    void accelerate() {
        const Model& model = turbine.system().model;
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, state.q, workspace);
        Vector Q(model.size());
        actuator = Vector::Zero(model.size());
        turbine.system().forces.generalised_forces({state, kin}, Q);
        ForwardDynamics(model).solve(kin, state.qd, Q, state.qdd, actuator);
    }
};

// Scale of a channel with these units: the weight of the machine, its moment, a length, a rate, the largest
// acceleration of a coordinate.
double size_of(const std::string& units, double acceleration) {
    return units == "N"         ? 1e6
           : units == "N m"     ? 5e7
           : units == "rad s-1" ? 100
           : units == "m s-2"   ? std::max(10., acceleration)
                                : 10;
}

// Accelerations of the free coordinates, and all channels but the accelerations of the tower top, which are absolute.
void check_same(const Moving& a, const Moving& b, const Vec3& absolute = Vec3::Zero()) {
    const Model &on_a = a.turbine.system().model, &on_b = b.turbine.system().model;
    double largest = 0, difference = 0;
    for (const CoordinateInfo& row : on_b.coordinates()) {
        if (row.part == "platform") continue;
        const double qdd = b.state.qdd(on_b.index(row.name));
        largest = std::max(largest, std::abs(qdd));
        difference = std::max(difference, std::abs(a.state.qdd(on_a.index(row.name)) - qdd));
    }
    CAPTURE(difference, largest);
    CHECK(difference < 1e-11 * largest);
    Sampled first(a.turbine, a.state);
    const Sampled second(b.turbine, b.state);
    Workspace workspace(on_a);
    const Kinematics kin = kinematics(on_a, a.state.q, workspace);
    const Vec3 in_top = pose(kin, a.turbine.layout().tower_top).R.transpose() * absolute;
    first.values["tower top fore-aft acceleration"] -= in_top.x();
    first.values["tower top side-side acceleration"] -= in_top.y();
    for (const ChannelGroup& group : channels(b.turbine))
        for (const Channel& channel : group.channels) {
            CAPTURE(channel.name, first.values[channel.name], second[channel.name]);
            CHECK(std::abs(first.values[channel.name] - second[channel.name]) <
                  1e-12 * size_of(channel.units, largest));
        }
}

// Linear momentum, and angular momentum about a point, of the machine's bodies by the inertias as they were given.
template <class S>
VectorT<S> momentum(const Turbine& turbine, const VectorT<S>& q, const VectorT<S>& qd, const Vec3& about,
                    bool with_platform) {
    const Model& model = turbine.system().model;
    WorkspaceT<S> workspace(model);
    const KinematicsT<S> kin = kinematics<S>(model, q, workspace);
    MatrixT<S> J(6, model.size());
    VectorT<S> sum = VectorT<S>::Zero(6);
    for (const Tree::Piece& piece : turbine.tree().pieces()) {
        if (piece.part == "platform" && !with_platform) continue;
        const FrameId frame = turbine.tree().frame_of(BodyId{piece.body});
        const Pose<S> own = pose(kin, frame);
        frame_jacobian<S>(kin, frame, J);
        const VectorT<S> twist = J * qd;
        const Vec3T<S> w = twist.template head<3>(), arm = own.R * piece.inertia.com.cast<S>(),
                       r = own.p + arm - about.cast<S>();
        const Vec3T<S> p = S(piece.inertia.mass) * (twist.template tail<3>() + cross<S>(w, arm));
        const Vec3T<S> spin = own.R * piece.inertia.J.cast<S>() * own.R.transpose() * w;
        sum.template head<3>() += p;
        sum.template tail<3>() += cross<S>(r, p) + spin;
    }
    return sum;
}

// Rate of the momentum along the motion, by a complex step: exact.
Vec6 momentum_rate(const Moving& m, const Vec3& about, bool with_platform) {
    constexpr double h = 1e-40;
    const Complex step(0, h);
    const ComplexVector q = m.state.q.cast<Complex>() + step * m.state.qd.cast<Complex>(),
                        qd = m.state.qd.cast<Complex>() + step * m.state.qdd.cast<Complex>();
    return momentum<Complex>(m.turbine, q, qd, about, with_platform).imag() / h;
}

// Force and moment of gravity about a point.
Vec6 gravity_load(const Moving& m, const Vec3& about) {
    const Model& model = m.turbine.system().model;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, m.state.q, workspace);
    Vec6 sum = Vec6::Zero();
    for (const Tree::Piece& piece : m.turbine.tree().pieces()) {
        if (piece.part == "platform") continue;
        const Pose<double> own = pose(kin, m.turbine.tree().frame_of(BodyId{piece.body}));
        const Vec3 force = piece.inertia.mass * earth_gravity, r = own.p + own.R * piece.inertia.com - about;
        sum.head<3>() += force;
        sum.tail<3>() += r.cross(force);
    }
    return sum;
}

double mass(const Turbine& turbine) {
    double sum = 0;
    for (const Tree::Piece& piece : turbine.tree().pieces()) sum += piece.inertia.mass;
    return sum;
}

// Load on the foot by the channels, base axes.
Vec6 foot_load(const Moving& m, const PlatformMotion& motion) {
    const Sampled now(m.turbine, m.state);
    Vec6 load;
    load << motion.R() * now.vector("TwrBsF", "t"), motion.R() * now.vector("TwrBsM", "t");
    return load;
}

PlatformMotion any_motion(unsigned seed) {
    Random random(seed + 100);
    return {random_vector6(random, 3, 0.4), random_vector6(random, 1, 0.5), random_vector6(random, 2, 0.7)};
}

// Two seconds from the undeformed machine in rotation.
solvers::History simulate(const Setup& setup, const std::vector<std::pair<BaseCoordinate, solvers::Motion>>& motions) {
    const Turbine turbine = setup.assembled();
    const Model& model = turbine.system().model;
    std::vector<solvers::Drive> drives;
    for (const auto& [which, motion] : motions)
        drives.push_back({model.index(turbine.layout().platform->coordinate(which)), motion});
    const Vector q = Vector::Zero(model.size());
    Vector qd = q;
    qd(turbine.rotor().spin) = 2.8;
    solvers::IntegrationOptions integration;
    integration.tolerances = {1e-10, 1e-12, 1e-12, 1e-11, 1e-11};
    integration.fixed_step = 0.005;  // or rounding would change the choice of the steps
    solvers::Integrator integrator(turbine.system(), drives, 0, q, qd, integration);
    solvers::Recorder recorder(integrator, channels(turbine),
                               {.coordinates = false, .rates = false, .actuators = false, .statistics = false});
    solvers::History history;
    REQUIRE(solvers::record(integrator, recorder, solvers::sample_times(0, 2, 0.05), history).reached());
    return history;
}

// Deflections and loads, each against its largest value.
void check_same(const solvers::History& a, const solvers::History& b) {
    for (const char* channel :
         {"TTDspFA", "TTDspSS", "TwrBsMyt", "TwrBsMxt", "TwrBsFzt", "OoPDefl1", "IPDefl2", "RootMyb3", "RotTorq"}) {
        double difference = 0, size = 0;
        for (std::size_t i = 0; i < a.time.size(); ++i) {
            difference = std::max(difference, std::abs(a[channel][i] - b[channel][i]));
            size = std::max(size, std::abs(b[channel][i]));
        }
        CAPTURE(channel, difference, size);
        CHECK(difference < 1e-11 * size);
    }
}

double mean(const std::vector<double>& y) {
    return std::accumulate(y.begin(), y.end(), 0.0) / static_cast<double>(y.size());
}

}  // namespace

TEST_CASE("machine on a platform: at rest in any pose it moves as on the ground under gravity turned with it",
          "[property]") {
    for (unsigned seed : {1u, 2u, 3u}) {
        const PlatformMotion pose{any_motion(seed).q, Vec6::Zero(), Vec6::Zero()};
        check_same(Moving(on_platform(earth_gravity), seed, pose),
                   Moving(on_ground(pose.R().transpose() * earth_gravity), seed));
    }
}

TEST_CASE("machine on a platform: a steady velocity changes nothing", "[property]") {
    for (unsigned seed : {1u, 2u}) {
        PlatformMotion motion;
        motion.qd.head<3>() = Vec3(3, -2, 1);
        check_same(Moving(on_platform(earth_gravity), seed, motion), Moving(on_ground(earth_gravity), seed));
    }
}

TEST_CASE("machine on a platform: an acceleration along a line is gravity the other way", "[property]") {
    for (unsigned seed : {1u, 2u, 3u}) {
        PlatformMotion motion = any_motion(seed);
        motion.qd.tail<3>().setZero();
        motion.qdd.tail<3>().setZero();
        const Vec3 a = motion.qdd.head<3>();
        check_same(Moving(on_platform(earth_gravity), seed, motion),
                   Moving(on_ground(motion.R().transpose() * (earth_gravity - a)), seed), a);
    }
}

TEST_CASE("machine on a platform: with the platform held the modes are those on the ground", "[property]") {
    const auto diagram = [](const Setup& setup) {
        const Turbine turbine = setup.assembled();
        return solvers::campbell(turbine.system(), turbine.rotor(), solvers::rpm_range(0, 27, 27));
    };
    const solvers::Campbell held = diagram(on_platform(Vec3::Zero())), fixed = diagram(on_ground(Vec3::Zero()));
    REQUIRE(held.branches.size() == fixed.branches.size());
    REQUIRE(held.branches.size() > 10);
    for (const solvers::Branch& branch : fixed.branches) {
        const solvers::Branch& same = held.branch(branch.name);
        for (std::size_t point : {0, 1}) {
            CAPTURE(branch.name, point);
            CHECK(held.natural_hz(same, point) == Approx(fixed.natural_hz(branch, point)).epsilon(1e-10));
            CHECK(held.damping_ratio(same, point) == Approx(fixed.damping_ratio(branch, point)).epsilon(1e-8));
        }
    }
}

TEST_CASE("machine on a platform: two seconds held, in steady motion, or in surge that is gravity on the ground",
          "[property]") {
    using solvers::Motion, solvers::MotionState;
    constexpr double a = 1.3;
    const solvers::History fixed = simulate(on_ground(earth_gravity, 1), {});
    check_same(simulate(on_platform(earth_gravity, 1), {}), fixed);
    check_same(simulate(on_platform(earth_gravity, 1), {{BaseCoordinate::surge, Motion::constant_rate(-4, 2)},
                                                        {BaseCoordinate::heave, Motion::constant_rate(0, 1)}}),
               fixed);
    const Motion surge = Motion::function([](double t) { return MotionState{a * t * t / 2, a * t, a}; });
    const solvers::History accelerated = simulate(on_platform(earth_gravity, 1), {{BaseCoordinate::surge, surge}});
    check_same(accelerated, simulate(on_ground(earth_gravity - a * Vec3::UnitX(), 1), {}));
    // The effect is not small: the tower bends upwind by some centimetres.
    CHECK(mean(accelerated["TTDspFA"]) < mean(fixed["TTDspFA"]) - 0.02);
}

TEST_CASE("machine on a platform: the load at the foot is weight less rate of change of momentum, in any motion",
          "[analytic]") {
    // Elastic; rigid; rigid with everything up to the shaft fixed to it.
    Setup elastic = on_platform(earth_gravity), rigid = elastic;
    rigid.description.tower.rigid = true;
    Setup stiff = rigid;
    stiff.description.yaw = {rigid_joint, rigid_joint};
    stiff.description.nacelle.tilt_bearing = rigid_joint;
    const std::vector<std::pair<Setup, unsigned>> cases{{elastic, 1}, {elastic, 2}, {elastic, 3}, {elastic, 4},
                                                        {rigid, 5},   {rigid, 6},   {stiff, 7},   {stiff, 8}};
    for (const auto& [setup, seed] : cases) {
        const PlatformMotion motion = any_motion(seed);
        const Moving m(setup, seed, motion);
        const Vec3 foot = motion.q.head<3>();
        const Vec6 expected = gravity_load(m, foot) - momentum_rate(m, foot, false), found = foot_load(m, motion);
        CAPTURE(expected.transpose(), found.transpose());
        CHECK((found - expected).head<3>().norm() < 1e-12 * mass(m.turbine) * 9.8);
        CHECK((found - expected).tail<3>().norm() < 1e-12 * mass(m.turbine) * 9.8 * 50);
    }
}

TEST_CASE("machine on a platform: the drives carry what the foot and the platform's own mass ask for", "[crosscheck]") {
    for (unsigned seed : {1u, 2u, 3u}) {
        const PlatformMotion motion = any_motion(seed);
        Setup setup = on_platform(earth_gravity);
        setup.description.platform->inertia.mass = 5e4;  // a point at the foot
        const Moving m(setup, seed, motion);
        const Vec6 load = foot_load(m, motion);
        const Vec3 force = 5e4 * (motion.qdd.head<3>() - earth_gravity) - load.head<3>(), moment = -load.tail<3>();
        const Mat3 yaw = rot_z(motion.q(5));
        CAPTURE(force.transpose(), moment.transpose());
        for (int i = 0; i < 3; ++i) CHECK(m.actuator(m.platform(i)) == Approx(force(i)).epsilon(1e-11));
        CHECK(m.actuator(m.platform(3)) == Approx(moment.dot(motion.R().col(0))).epsilon(1e-11));
        CHECK(m.actuator(m.platform(4)) == Approx(moment.dot(yaw.col(1))).epsilon(1e-11));
        CHECK(m.actuator(m.platform(5)) == Approx(moment.z()).epsilon(1e-11));
    }
}

TEST_CASE("machine on a free platform: it falls as a whole; without gravity its momentum is conserved", "[analytic]") {
    Setup setup = on_platform(earth_gravity);
    setup.description.platform->coordinates.role = CoordinateRole::free;
    setup.description.platform->inertia = {2e5, Vec3(0, 0, -10), Vec3(4e7, 4e7, 2e7).asDiagonal()};
    Moving falling(setup, 1);
    const Model& model = falling.turbine.system().model;
    Workspace workspace(model);
    Vector Q(model.size()), qdd(model.size()), none = Vector::Zero(model.size()), actuator = none;
    const Kinematics kin = kinematics(model, none, workspace);
    falling.turbine.system().forces.generalised_forces({{.q = none, .qd = none}, kin}, Q);
    ForwardDynamics(model).solve(kin, none, Q, qdd, actuator);
    qdd(falling.platform(2)) -= earth_gravity.z();
    CHECK(qdd.cwiseAbs().maxCoeff() < 1e-9);

    setup.options.gravity.setZero();
    for (unsigned seed : {1u, 2u}) {
        const PlatformMotion motion = any_motion(seed);
        const Moving m(setup, seed, motion);
        const Vec6 rate = momentum_rate(m, motion.q.head<3>(), true);
        CAPTURE(rate.transpose());
        CHECK(rate.head<3>().norm() < 1e-12 * mass(m.turbine) * 9.8);
        CHECK(rate.tail<3>().norm() < 1e-12 * mass(m.turbine) * 9.8 * 50);
    }
}

TEST_CASE("machine on a moored platform: it has modes of the platform, at the frequency of its mass on the springs",
          "[analytic]") {
    Setup setup = on_platform(Vec3::Zero());
    setup.description.platform->coordinates.role = CoordinateRole::free;
    const Turbine bare = setup.assembled();
    ForceSet forces = bare.forces();
    const auto& coordinates = bare.layout().platform->coordinates;
    const std::array<std::string, 3> name{"surge", "sway", "heave"};
    const std::array<double, 3> hz{0.01, 0.015, 0.02};
    for (std::size_t i : {0u, 1u, 2u})
        forces.add_spring(name[i], coordinates[i], mass(bare) * std::pow(2 * pi * hz[i], 2));
    for (std::size_t i : {3u, 4u, 5u}) forces.add_spring(text("mooring ", i), coordinates[i], 1e13);
    const Turbine moored = bare.with_forces(forces);
    const solvers::Campbell d = solvers::campbell(moored.system(), moored.rotor(), solvers::rpm_range(0, 0, 1));
    // The machine on top gives way a little: (0.02 Hz / 0.7 Hz)^2.
    for (std::size_t i : {0u, 1u, 2u})
        CHECK(d.natural_hz(d.branch("platform " + name[i]), 0) == Approx(hz[i]).epsilon(1e-3));
    CHECK(d.natural_hz(d.branch("1st tower fore-aft"), 0) > 0.7);
}

TEST_CASE("machine on a platform: its coordinates are named and the description mentions it", "[property]") {
    CHECK_FALSE(wt600(wt600_paper_assembly()).layout().platform);
    Setup setup = on_platform(earth_gravity);
    setup.description.platform->inertia.mass = 1234;
    CHECK_FALSE(isolated_blade(setup.description, setup.options).layout().platform);
    const Turbine turbine = setup.assembled();
    const CoordinateTable& table = turbine.system().model.coordinates();
    REQUIRE(turbine.layout().platform);
    for (const char* name : {"surge", "sway", "heave", "roll", "pitch", "yaw"}) {
        const CoordinateInfo& row = table[table.index(text("platform ", name))];
        CHECK(row.part == "platform");
        CHECK(row.role == CoordinateRole::prescribed);
    }
    CHECK(turbine.rotor().description.find("on a platform of 1234 kg") != std::string::npos);
    CHECK(mass(turbine) - mass(on_ground(earth_gravity).assembled()) == Approx(1234));
}

TEST_CASE("machine on a platform: a bad platform is refused", "[property]") {
    Setup setup = on_platform(earth_gravity);
    setup.description.platform->inertia.mass = -1;
    check_refused([&] { (void)setup.assembled(); }, {"600 kW", "platform", "mass", "-1"});
    setup = on_platform(earth_gravity);
    setup.description.platform->coordinates.directions[0] = Vec3::Zero();
    check_refused([&] { setup.description.check(); }, {"600 kW", "platform", "direction of surge", "unit vector"});
}
