// Spinning beams with everything off its axis: precone, hub radius, twist, sweep and prebend, centres of mass and of
// tension beside the line. Reference: the Cosserat rod in rotating axes (oracles/cosserat_rod), which shares nothing
// with the elements, not even the section matrix (oracles/rod_section).
#include "elements/cardan_beam/distributed_load.hpp"
#include "examples/studies/beams/mixed_beam.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/elements/cardan_beam/spinning_rods.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

using oracles::RodSection;

// Where the tip is, how its section stands, and the lowest five frequencies in rad/s.
struct Spun {
    Vec3 tip;
    Mat3 R;
    std::array<double, 5> omega;
};

struct Distance {
    double tip, turn;             // m, rad
    std::array<double, 5> omega;  // relative
};

Distance operator-(const Spun& a, const Spun& b) {
    Distance d{(a.tip - b.tip).norm(), (a.R - b.R).norm() / std::sqrt(2.0), {}};
    for (std::size_t k = 0; k < 5; ++k) d.omega[k] = std::abs(a.omega[k] / b.omega[k] - 1);
    return d;
}

// What is left if the error is exactly of order 2.
Spun extrapolated(const Spun& coarse, const Spun& fine) {
    Spun limit{(4 * fine.tip - coarse.tip) / 3, (4 * fine.R - coarse.R) / 3, {}};
    for (std::size_t k = 0; k < 5; ++k) limit.omega[k] = (4 * fine.omega[k] - coarse.omega[k]) / 3;
    return limit;
}

template <class Modes>
std::array<double, 5> lowest(const Modes& modes) {
    std::array<double, 5> omega;
    for (std::size_t k = 0; k < 5; ++k) omega[k] = std::abs(modes.at(k).eigenvalue);
    return omega;
}

Spun solved(const SpinningRod& setting, const oracles::CosseratRod& rod) {
    const oracles::RodSolution solution(rod, setting.loads());
    const std::vector<double> omega = solution.frequencies(5, 0.5, 0.37);
    Spun spun{solution.tip().position, solution.tip().rotation, {}};
    std::copy(omega.begin(), omega.end(), spun.omega.begin());
    return spun;
}
Spun exact(const SpinningRod& setting) {
    return solved(setting, setting.rod().rod_in_line_axes());
}

// A beam on a hub that spins about z, extension and torsion free, in its steady state.
struct Spinning {
    Tree tree;
    ForceSet forces;
    Spun spun;
    solvers::SecondOrderSystem vibration;
    std::vector<solvers::Mode> modes;

    Spinning(const SpinningRod& setting, int elements, Partition partition = Partition::segment_masses) {
        CardanBeamOptions beam_options = all_free(elements);
        beam_options.delta = {};
        beam_options.partition = partition;
        const JointedFrame hub = add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "spin", {"hub"});
        const FrameId root = tree.add_frame(hub.frame, setting.root(), "root");
        const CardanBeam beam =
            add_cardan_beam(tree, forces, root, line_of(setting.rod()), "beam", {"beam"}, beam_options);
        if (!setting.load.isZero(0))
            add_distributed_load(tree, forces, beam, {"load", [&](double) {
                                                          return Wrench{setting.load, Vec3::Zero()};
                                                      }});
        const System system(tree, forces);
        const int spin = system.model.index("spin");
        solvers::SteadyOptions options;
        options.rotor_speed = setting.speed;
        const auto steady = solvers::steady_state(system, spin, options);
        REQUIRE(steady.converged);
        std::vector<int> blade = system.model.coordinates().free();
        blade.erase(std::find(blade.begin(), blade.end(), spin));
        vibration = solvers::restrict_to(solvers::linearise(system, steady.at), blade);
        modes = solvers::modes(vibration);
        Workspace workspace(system.model);
        const Pose<double> tip = pose(kinematics(system.model, steady.at.q, workspace), beam.tip());
        spun = {tip.p, tip.R, lowest(modes)};
    }
};
Spun cardanic(const SpinningRod& setting, int elements) {
    return Spinning(setting, elements).spun;
}

// The isolated element: root axes and the hub radius along them.
Spun mixed(const SpinningRod& setting, int elements) {
    const MixedBeam beam(line_of(setting.rod()), elements);
    const Mat3 root = rot_y(-setting.cone);
    MixedSetting held;
    held.omega = root.transpose() * Vec3(0, 0, setting.speed);
    held.root_position = {setting.hub_radius, 0, 0};
    const Vector x = mixed_steady_state(beam, held).x;
    const Vec3 u = x.segment<3>(beam.tip() + MixedField::u), theta = x.segment<3>(beam.tip() + MixedField::theta);
    return {root * (Vec3(setting.hub_radius + setting.length, 0, 0) + u), root * rodrigues_rotation<double>(theta),
            lowest(mixed_modes(beam, held, x))};
}

template <class Element>
void check_order_2(const SpinningRod& setting, const Spun& limit, const Element& element, double error) {
    constexpr double margin = 0.08;  // the orders between 16 and 32 elements are 1.97 ... 2.07
    const Spun coarse = element(setting, 16), fine = element(setting, 32);
    const Distance n16 = coarse - limit, n32 = fine - limit, left = extrapolated(coarse, fine) - limit;
    CAPTURE(limit.tip, limit.omega, n16.tip, n32.tip, n16.turn, n32.turn, n16.omega, n32.omega, left.tip, left.turn,
            left.omega);
    CHECK(std::log2(n16.tip / n32.tip) == Approx(2).margin(margin));
    CHECK(std::log2(n16.turn / n32.turn) == Approx(2).margin(margin));
    CHECK(left.tip < error);
    CHECK(left.turn < error);
    for (std::size_t k = 0; k < 5; ++k) {
        CHECK(std::log2(n16.omega[k] / n32.omega[k]) == Approx(2).margin(margin));
        CHECK(left.omega[k] < error);
    }
}

}  // namespace

// Errors of 16 and 32 elements; what is left after extrapolation is of order 4: with cardanic elements 2.4e-6 or less,
// with mixed ones 3.6e-5, both in the fourth and fifth frequency, otherwise a tenth of that.
constexpr double cardanic_error = 3e-6, mixed_error = 5e-5;

TEST_CASE(
    "spinning beam: mass and tension centre off the line, coned, twisted, it converges with order 2 to the exact rod",
    "[analytic][slow]") {
    for (const SpinningRod& setting : {aft(), fore()}) {
        const Spun limit = exact(setting);
        check_order_2(setting, limit, cardanic, cardanic_error);
        check_order_2(setting, limit, mixed, mixed_error);
    }
}

TEST_CASE("spinning beam: the same under a dead load along the spin axis", "[analytic]") {
    // The load lifts the tip by 0.2 m, 10 % of the length, and shifts the fifth frequency by half a per cent.
    SpinningRod setting = fore();
    const Spun unloaded = exact(setting);
    setting.load = {0, 0, 120};
    const Spun limit = exact(setting);
    CHECK(limit.tip.z() - unloaded.tip.z() == Approx(0.2085).margin(1e-3));
    check_order_2(setting, limit, cardanic, cardanic_error);
}

TEST_CASE("spinning beam: the same swept and prebent", "[analytic]") {
    SpinningRod back = aft(), forward = fore();
    back.curvature = {0.3, -0.2}, forward.curvature = {-0.2, 0.25};
    for (const SpinningRod& setting : {back, forward}) check_order_2(setting, exact(setting), cardanic, cardanic_error);
}

TEST_CASE("spinning beam: a wrong sign of cone, twist, offset or curvature would show", "[property]") {
    // Every change is at least a hundred times the error that the tests above allow.
    SpinningRod setting = fore();
    setting.curvature = {-0.2, 0.25};
    const Spun as_it_is = exact(setting);
    const auto change = [&](const auto& turn) {
        SpinningRod turned = setting;
        turn(turned);
        const Distance d = exact(turned) - as_it_is;
        CAPTURE(d.tip, d.turn, d.omega);
        CHECK(std::max(d.tip, d.turn) > 1e-3);
        CHECK(*std::max_element(d.omega.begin(), d.omega.end()) > 3e-4);
    };
    change([](SpinningRod& r) { r.cone = -r.cone; });
    change([](SpinningRod& r) { r.beta_root = -r.beta_root, r.beta_tip = -r.beta_tip; });
    change([](SpinningRod& r) { r.section.mass_centre(0) *= -1; });
    change([](SpinningRod& r) { r.section.mass_centre(1) *= -1; });
    change([](SpinningRod& r) { r.section.tension_centre(0) *= -1; });
    change([](SpinningRod& r) { r.section.tension_centre(1) *= -1; });
    change([](SpinningRod& r) { r.curvature(0) *= -1; });
    change([](SpinningRod& r) { r.curvature(1) *= -1; });
}

TEST_CASE(
    "spinning beam: with everything off the line stiffness is symmetric, the gyroscopic matrix skew, "
    "eigenvalues imaginary",
    "[property]") {
    // A conservative system in steady rotation. Rounding: 1e-18, 1e-15 and 4e-14.
    SpinningRod setting = fore();
    setting.section.shear_centre = {0.05, 0.02};
    setting.load = {0, 0, 120};
    for (const Eigen::Vector2d& curvature : {Eigen::Vector2d(0, 0), Eigen::Vector2d(-0.2, 0.25)}) {
        setting.curvature = curvature;
        const Spinning beam(setting, 6);
        const Matrix &K = beam.vibration.K, &G = beam.vibration.C;
        CHECK((K - K.transpose()).norm() < 1e-14 * K.norm());
        CHECK((G + G.transpose()).norm() < 1e-13 * G.norm());
        // Not a matter of course: without the gyroscopic terms the lowest frequency is higher by 4e-3.
        solvers::SecondOrderSystem without = beam.vibration;
        without.C.setZero();
        CHECK(std::abs(solvers::modes(without)[0].eigenvalue) / beam.spun.omega[0] > 1.003);
        CHECK(beam.modes.size() == 36);
        for (const solvers::Mode& mode : beam.modes) {
            CHECK(mode.oscillates());
            CHECK(std::abs(mode.eigenvalue.real()) < 1e-12 * std::abs(mode.eigenvalue));
        }
    }
}

TEST_CASE("spinning beam: with the shear centre off the line too, it converges with order 2 to the exact rod",
          "[analytic][slow]") {
    // Torsion about a shear centre beside the line shears the line by gamma = e kappa_x; hinges on the line would tilt
    // the bodies between them by gamma / (1 - 2 delta), with any number of elements. They lie on the shear centres.
    SpinningRod setting = fore();
    setting.section.shear_centre = {0.05, 0.02};
    SpinningRod bare = setting, bent = setting;
    bare.section.mass_centre = {0, 0};
    bent.curvature = {-0.2, 0.25};
    for (const SpinningRod& rod : {setting, bare, bent}) {
        const Spun limit = exact(rod);
        check_order_2(rod, limit, cardanic, cardanic_error);
        if (rod.curvature.isZero(0)) check_order_2(rod, limit, mixed, mixed_error);
    }
}

TEST_CASE(
    "spinning beam: flexible in shear it converges with order 2 to the exact rod, tapered and with all partitions",
    "[analytic][slow]") {
    // EA / 10 in shear; the axial force is up to 6 % of that.
    SpinningRod setting = fore();
    setting.cone = 0, setting.speed = 6;
    setting.section.GA_y = setting.section.GA_z = 4e4;
    setting.section.mass_centre = setting.section.tension_centre = {0, 0};
    SpinningRod slim = setting;
    slim.taper = 0.4;
    for (const SpinningRod& rod : {setting, slim}) {
        const Spun limit = exact(rod);
        for (const Partition partition : {Partition::segment_masses, Partition::static_moment,
                                          Partition::compliance_gauss, Partition::mean_difference}) {
            CAPTURE(rod.taper, partition_name(partition));
            const auto element = [partition](const SpinningRod& r, int n) { return Spinning(r, n, partition).spun; };
            const Spun coarse = element(rod, 16), fine = element(rod, 32);
            const Distance n16 = coarse - limit, n32 = fine - limit, left = extrapolated(coarse, fine) - limit;
            CAPTURE(n16.omega, n32.omega, left.omega, limit.omega);
            for (std::size_t k = 0; k < 5; ++k) {
                CHECK(n32.omega[k] < 1e-3);
                CHECK(left.omega[k] < 2e-5);
            }
        }
        const Spun beside = extrapolated(mixed(rod, 16), mixed(rod, 32));
        CHECK((beside - limit).omega[0] < mixed_error);
        CHECK((beside - limit).omega[4] < mixed_error);
    }
}

TEST_CASE("spinning beam: flexible in shear with masses off the line it converges to the exact rod, at rest too",
          "[analytic][slow]") {
    // Shear turns the bodies between the hinges and not the sections: with the masses left on them the limit is off by
    // several per cent in the third to fifth frequency. The second offset asks of the end bodies more rotary inertia
    // than the sections have, so that a part stays.
    SpinningRod setting = fore();
    setting.cone = 0;
    setting.section.GA_y = setting.section.GA_z = 4e4;
    setting.section.tension_centre = {0, 0};
    struct Offset {
        Eigen::Vector2d mass_centre;
        double left;
    };
    for (const Offset& offset : {Offset{{0.05, -0.02}, 1e-5}, Offset{{0.1, -0.04}, 3e-4}})
        for (const double speed : {0.0, 6.0}) {
            setting.speed = speed;
            setting.section.mass_centre = offset.mass_centre;
            const Spun limit = exact(setting);
            for (const Partition partition : {Partition::segment_masses, Partition::static_moment,
                                              Partition::compliance_gauss, Partition::mean_difference}) {
                CAPTURE(offset.mass_centre, speed, partition_name(partition));
                const Spun coarse = Spinning(setting, 16, partition).spun, fine = Spinning(setting, 32, partition).spun;
                const Distance n16 = coarse - limit, n32 = fine - limit, left = extrapolated(coarse, fine) - limit;
                CAPTURE(n16.omega, n32.omega, left.omega, limit.omega);
                for (std::size_t k = 0; k < 5; ++k) {
                    CHECK(n32.omega[k] < 1e-3);
                    CHECK(left.omega[k] < offset.left);
                }
            }
        }
}

TEST_CASE("distributed moment: across the beam it bends the rod, and twists joints that shear has tilted",
          "[analytic]") {
    // L = EI = GJ = 1, moment m per length about y. A rod bends by kappa_y = m (1 - s), w = -m / 3, unsheared and
    // untwisted. Of the moment the share 1 - 2 delta acts on bodies that a shear strain tilts by
    // gamma_z / (1 - 2 delta), against the springs as m gamma_z: gamma_z = -m / GA with any number of elements, a known
    // limitation. A shear centre beside the line does not matter, for the hinges lie on it.
    const double m = 1e-5;
    const auto tip = [&](const RodSection& section, int elements) {
        Tree tree;
        ForceSet forces;
        const CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, engineering(section)),
                                                "beam", {"beam"}, all_free(elements));
        add_distributed_load(tree, forces, beam, {"m", [&](double) { return Wrench{Vec3::Zero(), {0, m, 0}}; }});
        const System system(tree, forces);
        const auto steady = solvers::steady_state(system, -1);
        REQUIRE(steady.converged);
        Workspace workspace(system.model);
        return pose(kinematics(system.model, steady.at.q, workspace), beam.tip());
    };
    RodSection section{.EA = 1e3, .GJ = 1, .j_y = 0.01, .j_z = 0.01};
    for (const int elements : {4, 16}) {
        CHECK(tip(section, elements).p.z() == Approx(-m / 3).epsilon(1e-9));
        RodSection soft = section, off = section;
        soft.GA_y = soft.GA_z = 30;
        CHECK(tip(soft, elements).p.z() == Approx(-m / 3 - m / 30).epsilon(1e-9));
        off.shear_centre = {0.1, 0};
        CHECK(std::abs(tip(off, elements).R(2, 1)) < 1e-6 * m);
        CHECK(tip(off, elements).p.z() == Approx(-m / 3).epsilon(1e-9));
    }
}
