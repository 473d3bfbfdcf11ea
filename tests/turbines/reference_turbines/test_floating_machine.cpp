// The 600 kW machine on a platform that is free: against the rigid machine put together by hand, the same machine held,
// on the ground, and driven through the same motion; free decay against the linear model.
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/mode_names/community_names.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/floating.hpp"
#include "tests/turbines/reference_turbines/sampled_channels.hpp"
#include "turbines/reference_turbines/wt600.hpp"

using namespace cardan;
using namespace cardan::testing;
using namespace cardan::turbines;

namespace {

AssemblyOptions on_ground(int elements = 1) {
    AssemblyOptions options = wt600_paper_assembly(elements);
    options.gravity = earth_gravity;
    return options;
}

Turbine floating(const PlatformDescription& platform, int elements = 1, const Vec3& gravity = earth_gravity) {
    AssemblyOptions options = on_ground(elements);
    options.gravity = gravity;
    TurbineDescription machine = wt600_description();
    machine.platform = floating_freely(platform);
    return assemble(machine, options);
}

PlatformDescription balanced(int elements = 1) {
    return in_balance(some_platform(), wt600_description(), on_ground(elements));
}

std::vector<int> platform_rows(const Turbine& turbine) {
    std::vector<int> rows;
    for (const BodyId body : turbine.layout().platform->coordinates) rows.push_back(turbine.system().model.index(body));
    return rows;
}

std::vector<int> all_but_spin(const Turbine& turbine) {
    std::vector<int> rows = turbine.system().model.coordinates().free();
    std::erase(rows, turbine.rotor().spin);
    return rows;
}

DynamicState still_at(const Turbine& turbine, const Vector& q = {}) {
    return at_rest(q.size() > 0 ? q : Vector(Vector::Zero(turbine.system().model.size())));
}

// Small angles, displacements of the platform and rates.
MachineState random_state(const Turbine& turbine, Random& random) {
    const Model& model = turbine.system().model;
    MachineState state(turbine);
    for (int i = 0; i < model.size(); ++i) {
        const double q = uniform(random, -1, 1), qd = uniform(random, -1, 1);
        state.q(i) = (model.body(i).revolute ? 0.05 : 0.5) * q;
        state.qd(i) = 0.1 * qd;
    }
    return state;
}

// Platform's matrices by hand: rigid machine, water, weights and buoyancy.
struct ByHand {
    Mat6 M, B, K;
    ByHand(const Turbine& turbine, const PlatformDescription& p) {
        const RigidWhole whole(turbine);
        M = whole.M + p.added_mass;
        B = p.damping;
        K = p.hydrostatic_stiffness + p.mooring_stiffness;
        const double righting = units::standard_gravity * -whole.first.z() + p.buoyancy * p.buoyancy_centre.z();
        K(3, 3) += righting;
        K(4, 4) += righting;
    }
};

solvers::SecondOrderSystem locked(const Turbine& turbine) {
    return solvers::restrict_to(solvers::linearise(turbine.system(), still_at(turbine)), platform_rows(turbine));
}

}  // namespace

TEST_CASE("floating machine: with its joints locked it has the modes of the rigid body put together by hand",
          "[analytic]") {
    const PlatformDescription platform = balanced(2);
    const Turbine turbine = floating(platform, 2);
    CHECK(turbine.warnings().empty());
    const ByHand hand(turbine, platform);
    const solvers::SecondOrderSystem found = locked(turbine);
    const Vec6 m = hand.M.diagonal().cwiseSqrt(), k = hand.K.diagonal().cwiseSqrt();
    for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = 0; j < 6; ++j) {
            CAPTURE(i, j);
            CHECK(std::abs(found.M(i, j) - hand.M(i, j)) < 1e-12 * m(i) * m(j));
            CHECK(std::abs(found.K(i, j) - hand.K(i, j)) < 1e-11 * k(i) * k(j));
            CHECK(std::abs(found.K_elastic(i, j) - hand.K(i, j)) < 1e-11 * k(i) * k(j));
        }
    const std::vector<std::complex<double>> expected = oscillations(hand.M, hand.B, hand.K);
    const std::vector<solvers::Mode> modes = solvers::modes(found);
    REQUIRE(modes.size() == 6);
    REQUIRE(expected.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        CAPTURE(expected[i], modes[i].eigenvalue);
        CHECK(std::abs(modes[i].eigenvalue - expected[i]) < 1e-9 * std::abs(expected[i]));
    }
}

TEST_CASE("floating machine: its platform modes are named and come near those of the rigid machine", "[crosscheck]") {
    const PlatformDescription platform = balanced();
    const Turbine turbine = floating(platform);
    solvers::CampbellOptions options;
    options.method = solvers::CampbellMethod::averaged;
    options.spin = solvers::RotorSpin::prescribed;
    options.floquet.harmonics = 3;
    const std::vector<double> speeds{0, 2.8};
    const solvers::Campbell d = solvers::campbell(turbine.system(), turbine.rotor(), speeds, options);
    const ByHand hand(turbine, platform);
    const auto expected = oscillations(hand.M, hand.B, hand.K);
    std::vector<double> found;
    for (const char* name : {"surge", "sway", "heave", "roll", "pitch", "yaw"}) {
        const solvers::Branch& branch = d.branch(text("platform ", name));
        CHECK(solvers::community_name(branch)[9] == std::toupper(name[0]));
        found.push_back(d.damped_hz(branch, 0));
        CHECK(d.damping_ratio(branch, 0) > 0);
        // The rotor turns: gyroscopic moments and little else.
        CHECK(d.damped_hz(branch, 1) == Approx(found.back()).epsilon(0.02));
    }
    std::sort(found.begin(), found.end());
    for (std::size_t i = 0; i < 6; ++i) {
        CAPTURE(found[i], expected[i].imag() / (2 * pi));
        // The elastic machine gives way by (f_platform / f_tower)^2 at most.
        CHECK(found[i] == Approx(expected[i].imag() / (2 * pi)).epsilon(0.005));
    }
    CHECK(d.natural_hz(d.branch("1st tower fore-aft"), 0) > 0.7);
}

TEST_CASE("floating machine: on ever stiffer moorings its modes become those on the ground, with the stiffness",
          "[property]") {
    const auto frequencies = [](const Turbine& turbine) {
        const solvers::SteadyState steady = solvers::steady_state(turbine.system(), turbine.rotor().spin);
        REQUIRE(steady.converged);
        std::vector<double> hz;
        for (const solvers::Mode& mode : solvers::modes(
                 solvers::restrict_to(solvers::linearise(turbine.system(), steady.at), all_but_spin(turbine))))
            if (mode.oscillates() && mode.natural_hz() < 5) hz.push_back(mode.natural_hz());
        return hz;
    };
    const std::vector<double> ground = frequencies(wt600(on_ground()));
    REQUIRE(ground.size() > 8);
    const auto difference = [&](double factor) {
        PlatformDescription stiff;
        stiff.mooring_stiffness.diagonal() << Vec3::Constant(1e9 * factor), Vec3::Constant(1e12 * factor);
        stiff.mooring_preload.z() =
            units::standard_gravity * RigidWhole(wt600(on_ground())).mass;  // or it would sink a little
        const std::vector<double> free = frequencies(floating(stiff));
        REQUIRE(free.size() == ground.size());
        double largest = 0;
        for (std::size_t i = 0; i < ground.size(); ++i) largest = std::max(largest, std::abs(free[i] / ground[i] - 1));
        return largest;
    };
    const double soft = difference(1), stiff = difference(100);
    CAPTURE(soft, stiff);
    CHECK(stiff < 1e-4);
    CHECK(soft / stiff == Approx(100).epsilon(0.05));
}

TEST_CASE("floating machine: unmoored, it moves as a rigid body without elastic force, and vibrates free-free",
          "[analytic]") {
    PlatformDescription raft = some_platform();
    raft.hydrostatic_stiffness.setZero();
    raft.mooring_stiffness.setZero();
    raft.damping.setZero();
    const Turbine turbine = floating(raft, 1, Vec3::Zero());
    const solvers::SecondOrderSystem system =
        solvers::restrict_to(solvers::linearise(turbine.system(), still_at(turbine)), all_but_spin(turbine));
    for (Eigen::Index i = 0; i < system.K.rows(); ++i)
        if (turbine.system().model.coordinates()[entry(system.coordinates, i)].part == "platform") {
            CHECK(system.K.row(i).isZero(0));
            CHECK(system.K.col(i).isZero(0));
        }
    // Six zeros of the pencil; the next one is the lowest vibration.
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> pencil((system.K + system.K.transpose()) / 2, system.M,
                                                                  Eigen::EigenvaluesOnly);
    const Vector& squared = pencil.eigenvalues();
    for (Eigen::Index i = 0; i < 6; ++i) CHECK(std::abs(squared(i)) < 1e-6 * squared(6));
    CHECK(std::sqrt(squared(6)) / (2 * pi) > 0.5);
}

TEST_CASE(
    "floating machine: drives that lead it through its free motion have nothing to do, and their forces make a free "
    "one follow",
    "[crosscheck]") {
    const PlatformDescription platform = balanced();
    TurbineDescription held = wt600_description();
    held.platform = platform;
    const Turbine driven = assemble(held, on_ground()), free = floating(platform);
    const Model& model = free.system().model;
    for (unsigned seed : {1u, 2u, 3u}) {
        Random random(seed);
        MachineState state = random_state(free, random);
        state.qd(free.rotor().spin) = 2.8;
        const auto solve = [&](const Turbine& turbine, const Vector& more, Vector& qdd) {
            Workspace workspace(turbine.system().model);
            const Kinematics kin = kinematics(turbine.system().model, state.q, workspace);
            Vector Q(model.size()), actuator = Vector::Zero(model.size());
            turbine.system().forces.generalised_forces({state, kin}, Q);
            Q += more;
            ForwardDynamics(turbine.system().model).solve(kin, state.qd, Q, qdd, actuator);
            return actuator;
        };
        const Vector none = Vector::Zero(model.size());
        Vector own = none;
        solve(free, none, own);
        Vector led = own;
        const double size = 1e6;  // N, N m: weights are larger
        CHECK(solve(driven, none, led).cwiseAbs().maxCoeff() < 1e-6 * size);
        CHECK((led - own).cwiseAbs().maxCoeff() < 1e-9 * own.cwiseAbs().maxCoeff());

        Vector wanted = none;
        for (const int i : platform_rows(free)) wanted(i) = uniform(random, -1, 1);
        const Vector forces = solve(driven, none, wanted);
        Vector followed = none;
        solve(free, forces, followed);
        CHECK((followed - wanted).cwiseAbs().maxCoeff() < 1e-9 * wanted.cwiseAbs().maxCoeff());
    }
}

TEST_CASE("floating machine: a steady drift changes nothing where no mooring and no water resist it", "[property]") {
    PlatformDescription adrift = some_platform();
    adrift.mooring_stiffness.setZero();
    adrift.hydrostatic_stiffness.setZero();
    adrift.damping.setZero();
    adrift.buoyancy_centre.setZero();
    const Turbine turbine = floating(adrift);
    const Model& model = turbine.system().model;
    Random random(5);
    MachineState state = random_state(turbine, random);
    const auto accelerations = [&](const Vec3& drift) {
        Vector qd = state.qd, Q(model.size()), qdd = Vector::Zero(model.size()), actuator = qdd;
        const std::vector<int> rows = platform_rows(turbine);
        for (Eigen::Index i = 0; i < 3; ++i) qd(entry(rows, i)) += drift(i);
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, state.q, workspace);
        turbine.system().forces.generalised_forces({{.q = state.q, .qd = qd}, kin}, Q);
        ForwardDynamics(model).solve(kin, qd, Q, qdd, actuator);
        return qdd;
    };
    const Vector at_rest = accelerations(Vec3::Zero()), drifting = accelerations({5, -3, 2});
    CHECK((drifting - at_rest).cwiseAbs().maxCoeff() < 1e-10 * at_rest.cwiseAbs().maxCoeff());
}

TEST_CASE("floating machine: total momentum changes by external forces alone", "[analytic]") {
    // Rate of the momentum of the bodies, by the accelerations of their mass centres; of the water, A x''.
    const PlatformDescription platform = balanced();
    const Turbine turbine = floating(platform);
    const Model& model = turbine.system().model;
    Random random(7);
    MachineState state = random_state(turbine, random);
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, state.q, workspace);
    Vector Q(model.size()), actuator = Vector::Zero(model.size());
    turbine.system().forces.generalised_forces({state, kin}, Q);
    ForwardDynamics(model).solve(kin, state.qd, Q, state.qdd, actuator);
    const JointLoads loads = joint_loads({state, kin}, turbine.system().forces, state.qdd);
    Vec3 rate = Vec3::Zero(), outer = Vec3(0, 0, platform.buoyancy);
    for (int i = 0; i < model.size(); ++i) {
        const double m = model.body(i).inertia.mass;
        if (m == 0) continue;
        rate += m * entry(loads.motion, i).at(kin.centre_of_mass(i));
        outer += m * earth_gravity;
    }
    Vec6 x, xd, xdd;
    const std::vector<int> rows = platform_rows(turbine);
    for (Eigen::Index i = 0; i < 6; ++i) {
        const int row = entry(rows, i);
        x(i) = state.q(row), xd(i) = state.qd(row), xdd(i) = state.qdd(row);
    }
    rate += (platform.added_mass * xdd).head<3>();
    outer -= ((platform.hydrostatic_stiffness + platform.mooring_stiffness) * x + platform.damping * xd).head<3>();
    CAPTURE(rate.transpose(), outer.transpose());
    CHECK((rate - outer).norm() < 1e-10 * platform.buoyancy);
}

TEST_CASE("floating machine: in equilibrium it pitches by the overhang of nacelle and rotor over the pitch stiffness",
          "[analytic]") {
    PlatformDescription platform = balanced();
    platform.inertia.com.head<2>().setZero();
    const Turbine turbine = floating(platform);
    const ByHand hand(turbine, platform);
    const RigidWhole whole(turbine);
    // Weights to the upwind side (-x) pitch it upwind (negative), to the left (+y) roll it to the left (negative).
    Vec6 load = Vec6::Zero();
    load(3) = -units::standard_gravity * whole.first.y();
    load(4) = units::standard_gravity * whole.first.x();
    const Vec6 expected = hand.K.inverse() * load;
    Vector q = Vector::Zero(turbine.system().model.size());
    const std::vector<int> rows = platform_rows(turbine);
    for (Eigen::Index i = 0; i < 6; ++i) q(entry(rows, i)) = expected(i);
    Workspace workspace(turbine.system().model);
    const Kinematics kin = kinematics(turbine.system().model, q, workspace);
    Vector Q(q.size());
    turbine.system().forces.generalised_forces({{.q = q, .qd = Vector::Zero(q.size())}, kin}, Q);
    REQUIRE(std::abs(load(4)) > 1e5);
    CHECK(std::abs(expected(4)) > 1e-4);
    // Rigid it is in equilibrium there, up to the square of the angle.
    const double square = expected.tail<3>().squaredNorm();
    for (const int row : rows) CHECK(std::abs(Q(row)) < 10 * square * load.norm() + 1e-9 * load.norm());
    // Elastic it gives way by some per cent more: the tower bends under the same moment.
    const solvers::SteadyState steady = solvers::steady_state(turbine.system(), turbine.rotor().spin);
    REQUIRE(steady.converged);
    CAPTURE(expected.transpose(), steady.at.q(rows[4]));
    CHECK(steady.at.q(rows[4]) == Approx(expected(4)).epsilon(0.03));
    CHECK(std::abs(steady.at.q(rows[4])) > std::abs(expected(4)));
}

TEST_CASE("floating machine: let go in the shape of a mode it decays as the linear model says", "[crosscheck]") {
    const PlatformDescription platform = balanced();
    const Turbine turbine = floating(platform);
    const System& system = turbine.system();
    const solvers::SteadyState steady = solvers::steady_state(system, turbine.rotor().spin);
    REQUIRE(steady.converged);
    const solvers::SecondOrderSystem linear =
        solvers::restrict_to(solvers::linearise(system, steady.at), all_but_spin(turbine));
    const std::vector<solvers::Mode> modes = solvers::modes(linear);
    const std::vector<int> rows = platform_rows(turbine);
    for (const int which : {2, 4}) {  // heave, pitch
        CAPTURE(which);
        const auto row = std::find(linear.coordinates.begin(), linear.coordinates.end(), entry(rows, which)) -
                         linear.coordinates.begin();
        // The one of the lowest six in which this coordinate is largest, by its share of the kinetic energy.
        const auto mode = std::max_element(modes.begin(), modes.begin() + 6, [&](const auto& a, const auto& b) {
            return std::norm(a.eigenvalue * a.shape(row)) < std::norm(b.eigenvalue * b.shape(row));
        });
        constexpr double size = 1e-4;
        const Complex scale = size / mode->shape(row);
        Vector q = steady.at.q, qd = Vector::Zero(q.size());
        for (Eigen::Index i = 0; i < mode->shape.size(); ++i) {
            const int coordinate = entry(linear.coordinates, i);
            const Complex x = scale * mode->shape(i);
            q(coordinate) += x.real();
            qd(coordinate) += (mode->eigenvalue * x).real();
        }
        solvers::IntegrationOptions options;
        options.tolerances = {1e-7, 1e-11, 1e-11, 1e-11, 1e-11};
        solvers::Integrator integrator(system, {{turbine.rotor().spin, solvers::Motion::constant(0)}}, 0, q, qd,
                                       options);
        double largest = 0;
        for (double t = 2; t < 60; t += 2) {
            REQUIRE(integrator.advance(t).reached());
            const double expected = size * std::exp(mode->eigenvalue * t).real();
            largest = std::max(largest, std::abs(integrator.state().q(entry(rows, which)) -
                                                 steady.at.q(entry(rows, which)) - expected));
        }
        CAPTURE(mode->damped_hz(), largest / size);
        // Second order in the size, and what the integration leaves.
        CHECK(largest < 1e-5 * size);
        CHECK(std::abs(integrator.energy().error) < 1e-9 * std::abs(integrator.energy().potential));
    }
}

TEST_CASE("floating machine: channels of the platform are its displacement and its angles under OpenFAST's names",
          "[analytic]") {
    const Turbine turbine = floating(balanced());
    MachineState state(turbine);
    const std::vector<int> rows = platform_rows(turbine);
    const Vec6 x = (Vec6() << 3, -2, 1, 0.2, -0.3, 0.4).finished();
    for (Eigen::Index i = 0; i < 6; ++i) state.q(entry(rows, i)) = x(i);
    const Sampled now(turbine, state);
    const char* aliases[] = {"PtfmSurge", "PtfmSway", "PtfmHeave", "PtfmRoll", "PtfmPitch", "PtfmYaw"};
    for (Eigen::Index i = 0; i < 6; ++i) CHECK(now[aliases[i]] == Approx(x(i)).epsilon(1e-13));
    // The foot of the tower stands off the reference point.
    Workspace workspace(turbine.system().model);
    const Kinematics kin = kinematics(turbine.system().model, state.q, workspace);
    const Mat3 R = (Eigen::AngleAxisd(0.4, Vec3::UnitZ()) * Eigen::AngleAxisd(-0.3, Vec3::UnitY()) *
                    Eigen::AngleAxisd(0.2, Vec3::UnitX()))
                       .toRotationMatrix();
    const Vec3 foot = x.head<3>() + R * Vec3(0, 0, 5);
    CHECK((pose(kin, turbine.layout().tower_base).p - foot).norm() < 1e-13);
    // On the ground there are none.
    for (const ChannelGroup& group : channels(wt600(on_ground())))
        for (const Channel& channel : group.channels) CHECK(channel.alias != "PtfmSurge");
}

TEST_CASE("floating machine: without weights it would capsize, and is refused by name", "[property]") {
    check_refused([] { (void)floating(balanced(), 1, Vec3::Zero()); }, {"test spar", "capsizes", "gravity"});
}
