// Rotors whose blades differ, are not evenly spaced or have other coordinates: which method is taken and why, what it
// is compared with, and how modes are named.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell_data/csv.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "solvers/periodic/azimuth_average.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <numeric>

namespace cardan::testing::unequal_blades {

using namespace cardan::solvers;

namespace {

// A chain of hinges about the flap axis, the innermost 0.5 m from the rotor axis, each 2 m from the next, with a lag
// hinge at the end if it has a stiffness; a point mass 2 m outboard of every hinge.
struct IndividualBlade {
    std::vector<double> flap = {4000, 2500};
    double lag = 3000;
    double mass = 3;
    double damping = 4;
};

struct Spec {
    std::vector<IndividualBlade> blades;
    std::vector<int> places = {};  // numbers from 1; empty: 1 ... number of blades
    int of = 0;                    // places
    bool support = true;
    Vec3 gravity = Vec3::Zero();
    double azimuth = 0;  // of place 1 in the rotor, rad
};

struct Rotor {
    System system;
    RotorMap map;
};

Rotor rotor_of(const Spec& spec) {
    Tree tree;
    ForceSet forces;
    forces.set_gravity(spec.gravity);
    FrameId at = Tree::base();
    if (spec.support) {
        const Link tilt = add_joint(tree, {.name = "tilt", .axis = Vec3::UnitX()});
        const Link yaw = add_joint(tree, {.name = "yaw",
                                          .inboard = tilt.axes,
                                          .axis = Vec3::UnitY(),
                                          .inertia = {50, Vec3::Zero(), Vec3(900, 1100, 700).asDiagonal()}});
        forces.add_spring("tilt", tilt.body, 90000, 50);
        forces.add_spring("yaw", yaw.body, 70000, 30);
        at = tree.add_frame(yaw.axes, Placement::translation({0, 0, 1.2}), "shaft");
    }
    const Link spin = add_joint(
        tree, {.name = "spin", .inboard = at, .inertia = {10, Vec3::Zero(), Vec3(300, 300, 500).asDiagonal()}});
    const int places = spec.of > 0 ? spec.of : static_cast<int>(spec.blades.size());
    std::vector<std::vector<BodyId>> bodies(spec.blades.size());
    FrameId axes = spin.axes;
    for (std::size_t k = 0; k < spec.blades.size(); ++k) {
        const IndividualBlade& own = spec.blades[k];
        const int number = spec.places.empty() ? static_cast<int>(k) + 1 : spec.places[k];
        const Mat3 R = rot_z(spec.azimuth + 2 * pi * (number - 1) / places);
        FrameId reached = tree.add_frame(spin.axes, {R, R * Vec3(0.5, 0, 0)}, text("root ", number));
        if (k == 0) axes = reached;
        const std::size_t hinges = own.flap.size() + (own.lag > 0 ? 1 : 0);
        for (std::size_t i = 0; i < hinges; ++i) {
            const bool lag = i >= own.flap.size();
            const std::string name = text("blade ", number, lag ? " lag" : text(" flap ", i + 1));
            BodySpec body =
                joint_spec(name, reached, JointKind::revolute, lag ? Vec3(Vec3::UnitZ()) : Vec3(-Vec3::UnitY()));
            const Placement back = body.placement.inverse();
            body.inertia = RigidInertia{own.mass, {2, 0, 0}}.in(back);
            body.coordinate.part = "blade";
            body.coordinate.blade = number;
            const BodyId id = tree.add_body(body);
            reached = tree.add_frame(tree.frame_of(id), back * Placement::translation({2, 0, 0}), name + " end");
            forces.add_spring(name, id, lag ? own.lag : own.flap[i], own.damping);
            bodies[k].push_back(id);
        }
    }
    Rotor rotor{System(tree, forces), {}};
    rotor.map.machine = "unequal rotor";
    rotor.map.spin = rotor.system.model.index(spin.body);
    rotor.map.hub = spin.axes;
    for (int number = 1; number <= places && !spec.places.empty(); ++number)
        if (std::ranges::find(spec.places, number) == spec.places.end()) rotor.map.missing_blades.push_back(number);
    rotor.map.evenly_spaced = rotor.map.missing_blades.empty();
    for (const std::vector<BodyId>& blade : bodies) {
        rotor.map.blades.emplace_back();
        for (BodyId body : blade) rotor.map.blades.back().push_back(rotor.system.model.index(body));
    }
    rotor.map.parts = {{"blade", axes, {}, {"", "blade flap", "blade lag"}}};
    return rotor;
}

Campbell diagram_of(const Rotor& rotor, const std::vector<double>& speeds, CampbellOptions options = {}) {
    options.max_frequency_hz = 20;  // beyond all of them
    return campbell(rotor.system, rotor.map, speeds, options);
}

Rotor equal(std::size_t blades, Vec3 gravity = Vec3::Zero()) {
    return rotor_of({.blades = std::vector<IndividualBlade>(blades), .gravity = gravity});
}

// Three blades, the second heavier by a part.
Rotor one_heavier(double part, bool support = true) {
    return rotor_of({.blades = {{}, {.mass = 3 * (1 + part)}, {}}, .support = support});
}

std::vector<Complex> eigenvalues_of(const CampbellPoint& point) {
    std::vector<Complex> all;
    for (const CampbellMode& m : point.modes) {
        all.push_back(m.mode.eigenvalue);
        if (m.kind() == FloquetKind::oscillation) all.push_back(std::conj(m.mode.eigenvalue));
    }
    return all;
}

// In blade coordinates, over a whole revolution, by Runge and Kutta's method.
std::vector<Complex> brute_force(const Rotor& rotor, const CampbellPoint& point, const std::vector<int>& unknowns,
                                 int steps) {
    const PeriodicSystem system = linearised(rotor.system, *point.periodic, unknowns);
    const double Omega = point.rotor_speed;
    // Every column of the monodromy matrix needs the same, at the ends and in the middle of all steps.
    std::vector<SecondOrderSystem> known(static_cast<std::size_t>(2 * steps + 1));
    for (int i = 0; i <= 2 * steps; ++i) system.at(pi * i / (Omega * steps), entry(known, i));
    return exponents(
        [&](double psi, Matrix& M, Matrix& C, Matrix& K) {
            const SecondOrderSystem& at = entry(known, std::lround(psi * steps / pi));
            M = at.M, C = at.C, K = at.K;
        },
        std::ssize(unknowns), Omega, steps);
}

}  // namespace

TEST_CASE("unequal blades: the diagram says which method was taken and why", "[property]") {
    const auto diagram = [](const Spec& spec, std::vector<double> speeds = {2.0}) {
        return diagram_of(rotor_of(spec), speeds);
    };
    const Spec three{.blades = std::vector<IndividualBlade>(3)};
    CHECK(diagram(three).method == "Coleman (fixed frame)");
    CHECK(diagram(three).method_reason.empty());
    Spec spec = three;
    spec.blades[1].mass = 3.3;
    CHECK(diagram(spec).method.starts_with("Floquet (principal frequencies, fixed frame"));
    CHECK(diagram(spec).method_reason == "the blades differ");
    CHECK(diagram(spec, {0.0, 2.0}).method_reason == "the blades differ; at standstill: azimuth 0");
    CHECK(diagram(spec, {0.0}).method_reason == "the blades differ, but nothing turns; at standstill: azimuth 0");
    spec = three;
    spec.blades[1].flap = {4000, 2500, 1000};
    CHECK(diagram(spec).method_reason == "blade 2 has other coordinates than blade 1");
    CHECK(diagram(spec).method.find("blade modes in the rotating frame") != std::string::npos);
    spec = {.blades = std::vector<IndividualBlade>(2)};
    CHECK(diagram(spec).method_reason == "two blades");
    spec.places = {1, 3}, spec.of = 3;
    CHECK(diagram(spec).method_reason == "blade 2 of 3 is missing");
    spec = {.blades = std::vector<IndividualBlade>(3), .places = {1, 3, 4}, .of = 5};
    CHECK(diagram(spec).method_reason == "blades 2 and 5 of 5 are missing");
    Rotor by_hand = rotor_of({.blades = std::vector<IndividualBlade>(3), .places = {1, 2, 3}, .of = 4});
    by_hand.map.missing_blades.clear();
    CHECK(diagram_of(by_hand, {2.0}).method_reason == "the blades are not evenly spaced");
    const Vec3 down(0, -units::standard_gravity, 0);
    CHECK(diagram_of(equal(3, down), {2.0}).method_reason == "there is no constant steady state");
    CHECK(diagram_of(equal(1), {2.0}).method_reason.starts_with("one blade"));
    // In its own frame one blade on a rigid hub is constant.
    CHECK(diagram_of(rotor_of({.blades = {{}}, .support = false}), {2.0}).method_reason.empty());
    // What is asked for needs no reason.
    CHECK(diagram_of(equal(3), {2.0}, {.method = CampbellMethod::floquet}).method_reason.empty());
}

TEST_CASE("unequal blades: table and CSV say why, a diagram over a parameter says at which machine", "[property]") {
    const Campbell d = diagram_of(one_heavier(0.1), {2.0});
    CHECK(table(d).find("; chosen: the blades differ\n") != std::string::npos);
    const cardan::test::Folder folder;
    write_csv(d, folder / "unequal.csv");
    CHECK(cardan::test::bytes_of(folder / "unequal.csv").find("; chosen: the blades differ; cardan") !=
          std::string::npos);
    const Rotor same = one_heavier(0), heavier = one_heavier(0.1);
    const std::vector<CampbellCase> cases{{&same.system, &same.map, 2, 0}, {&heavier.system, &heavier.map, 2, 0.1}};
    const Campbell over = campbell(cases, "mass of blade 2 [-]");
    CHECK(over.method_reason == "the blades differ (at mass of blade 2 [-] 0.1)");
    CHECK(table(over).find("chosen: the blades differ (at") != std::string::npos);
    CHECK(campbell(std::span(cases).first(1), "mass of blade 2 [-]").method_reason.empty());
}

TEST_CASE("unequal blades: what needs multi-blade coordinates is refused with the reason and the remedy",
          "[property]") {
    const Rotor uneven = rotor_of({.blades = std::vector<IndividualBlade>(3), .places = {1, 2, 4}, .of = 4}),
                two = rotor_of({.blades = std::vector<IndividualBlade>(2), .places = {1, 3}, .of = 3}),
                other = rotor_of({.blades = {{}, {}, {.flap = {4000}}}});
    for (const CampbellMethod method :
         {CampbellMethod::coleman, CampbellMethod::averaged, CampbellMethod::frozen_azimuth}) {
        check_refused([&] { (void)diagram_of(uneven, {2.0}, {.method = method}); },
                      {"unequal rotor", "blade 3 of 4 is missing", "CampbellMethod::floquet or automatic"});
        check_refused([&] { (void)diagram_of(other, {2.0}, {.method = method}); },
                      {"unequal rotor", "blade 3 has other coordinates than blade 1", "CampbellMethod::floquet"});
        check_refused([&] { (void)diagram_of(two, {2.0}, {.method = method}); }, {"unequal rotor", "two blades"});
    }
    for (const Rotor* rotor : {&uneven, &two}) {
        const std::vector<int> unknowns = rotor->system.model.coordinates().free_without(rotor->map.spin);
        check_refused([&] { (void)blade_symmetry(rotor->map, unknowns, 2); }, {"spacing", "is missing"});
        check_refused([&] { (void)azimuth_average(rotor->system, rotor->map, {.rotor_speed = 2}); },
                      {"unequal rotor", "spacing", "is missing"});
    }
    LinearModel model;
    model.blades = 3;
    model.samples.resize(1);
    model.coordinates = uneven.system.model.coordinates().free_without(uneven.map.spin);
    check_refused([&] { (void)multi_blade(model, uneven.map); }, {"unequal rotor", "blade 3 of 4 is missing"});
    check_refused([&] { (void)diagram_of(equal(3), {-1.0}); }, {"rotor speed number 1", "-1", ">= 0"});
}

TEST_CASE("unequal blades: automatic diagrams have the exponents of a brute-force integration in blade coordinates",
          "[crosscheck][slow]") {
    Random random(11);
    int floquet = 0;
    for (int i = 0; i < 12; ++i) {
        const int blades = 1 + i % 5;
        Spec spec{.blades = std::vector<IndividualBlade>(static_cast<std::size_t>(blades)),
                  .gravity = i % 3 == 0 ? Vec3(0, -units::standard_gravity, 0) : Vec3(Vec3::Zero())};
        IndividualBlade& last = spec.blades.back();
        if (i % 2 == 0) last.mass *= uniform(random, 0.7, 1.3);
        if (i % 4 == 1) last.flap[0] *= uniform(random, 0.7, 1.3);
        if (i % 5 == 3) last.lag = 0;
        if (i > 5 && blades > 1) {
            spec.of = blades + 1;
            for (int k = 1; k <= spec.of; ++k)
                if (k != 2) spec.places.push_back(k);
        }
        const Rotor rotor = rotor_of(spec);
        const double Omega = uniform(random, 1.5, 3);
        const CampbellOptions options{.spin = RotorSpin::prescribed};
        const Campbell d = diagram_of(rotor, {Omega}, options);
        CAPTURE(i, blades, Omega, d.method_reason, d.warning);
        if (d.method_reason.empty()) continue;
        ++floquet;
        REQUIRE(d.points[0].periodic.has_value());
        const std::vector<Complex> expected = brute_force(rotor, d.points[0], d.unknowns, 2000);
        CHECK(d.points[0].modes.size() == d.unknowns.size());
        CHECK(distance(eigenvalues_of(d.points[0]), expected, Omega) < 1e-5);
    }
    CHECK(floquet >= 10);
}

TEST_CASE(
    "unequal blades: exponents are those of small motions integrated in time, three blades of four places in gravity",
    "[crosscheck]") {
    const Rotor rotor = rotor_of({.blades = {{.damping = 60}, {.mass = 2.5, .damping = 60}, {.lag = 0, .damping = 60}},
                                  .places = {1, 2, 4},
                                  .of = 4,
                                  .gravity = {0, -units::standard_gravity, -2}});
    const double Omega = 3;
    const Campbell d = diagram_of(rotor, {Omega}, {.spin = RotorSpin::prescribed, .floquet = {.harmonics = 16}});
    CHECK(d.method_reason == "blade 3 of 4 is missing");
    const CampbellPoint& point = d.points[0];
    const DynamicState start = point.periodic->at(0);
    IntegrationOptions integration;
    integration.method = Method::erk;
    integration.tolerances = {1e-11, 1e-12, 1e-12, 1e-12, 1e-12};
    integration.integrate_work = false;
    const auto n = std::ssize(d.unknowns);
    const auto after_a_turn = [&](Eigen::Index column, double step) {
        Vector q = start.q, qd = start.qd;
        (column < n ? q : qd)(entry(d.unknowns, column % n)) += step;
        Integrator integrator(rotor.system, {{rotor.map.spin, Motion::constant_rate(0, Omega)}}, 0, q, qd, integration);
        REQUIRE(integrator.advance(2 * pi / Omega).reached());
        Vector x(2 * n);
        x << integrator.state().q(d.unknowns), integrator.state().qd(d.unknowns);
        return x;
    };
    const double step = 1e-4;
    Matrix monodromy(2 * n, 2 * n);
    for (Eigen::Index j = 0; j < 2 * n; ++j)
        monodromy.col(j) = (after_a_turn(j, step) - after_a_turn(j, -step)) / (2 * step);
    const Eigen::VectorXcd multipliers = Eigen::EigenSolver<Matrix>(monodromy, false).eigenvalues();
    // What is damped to nothing within a turn is lost in the differences.
    int compared = 0;
    for (const Complex exponent : eigenvalues_of(point)) {
        const Complex multiplier = std::exp(exponent * (2 * pi / Omega));
        if (std::abs(multiplier) < 1e-2) continue;
        ++compared;
        CAPTURE(exponent, multiplier);
        CHECK((multipliers.array() - multiplier).abs().minCoeff() < 1e-5);
    }
    CHECK(compared >= 10);
}

TEST_CASE("unequal blades: every blade is measured by its own stiffness and its own modes", "[analytic]") {
    // On a rigid hub at rest each mode is one of one blade, clamped: all its energy is in that component mode.
    const Rotor rotor = rotor_of({.blades = {{.damping = 0},
                                             {.flap = {1500, 6000}, .lag = 2000, .damping = 0},
                                             {.flap = {9000, 1000}, .lag = 9000, .mass = 5, .damping = 0}},
                                  .support = false});
    const Campbell d = diagram_of(rotor, {0.0}, {.spin = RotorSpin::prescribed});
    REQUIRE(d.points[0].modes.size() == 9);
    REQUIRE(d.branches.size() == 9);
    REQUIRE(d.components.size() == 3);
    for (const Branch& branch : d.branches) {
        const CampbellMode& m = *d.mode(branch, 0);
        CAPTURE(branch.name, m.mode.natural_hz(), m.blade_shares.transpose());
        CHECK(branch.pattern == RotorPattern::single);
        CHECK_FALSE(branch.doubtful[0]);
        CHECK(branch.mostly[0] == branch.name);
        CHECK(entry(m.shares, branch.component).total() == Approx(1).epsilon(1e-10));
        CHECK(m.blade_shares(branch.harmonic - 1) == Approx(1).epsilon(1e-10));
    }
    for (const int blade : {1, 2, 3})
        for (const char* name : {"1st blade flap", "2nd blade flap", "blade lag"})
            CHECK(d.find_branch(text(name, " (blade ", blade, ")")) != nullptr);
    // In rotation the shares still add up.
    const Campbell turning = diagram_of(rotor, {2.0}, {.spin = RotorSpin::prescribed});
    for (const CampbellMode& m : turning.points[0].modes) {
        const double sum =
            std::accumulate(m.shares.begin(), m.shares.end(), 0.0,
                            [](double total, const EnergyFraction& share) { return total + share.total(); });
        CHECK(sum == Approx(1).epsilon(1e-12));
        CHECK(m.blade_shares.maxCoeff() == Approx(1).epsilon(1e-9));
    }
    // A third of the energy of a localised mode is in each of the patterns of three.
    const CampbellMode& lag = *turning.mode(turning.branch("blade lag (blade 3)"), 0);
    const EnergyFraction& share = entry(lag.shares, turning.branch("blade lag (blade 3)").component);
    CHECK(share.collective / share.total() == Approx(1.0 / 3).epsilon(1e-6));
}

TEST_CASE("unequal blades: one blade with another number of hinges has names and exponents", "[property]") {
    const Rotor rotor = rotor_of({.blades = {{}, {}, {.flap = {5200}, .lag = 0}}, .support = false});
    for (const std::vector<double>& speeds : {std::vector<double>{0.0}, {0.0, 1.0, 2.0}, {2.0}}) {
        const Campbell d = diagram_of(rotor, speeds, {.spin = RotorSpin::prescribed});
        CHECK(d.rows.front() == "blade 1 flap 1");
        CHECK(d.branches.size() == 7);
        const Branch& own = d.branch("1st blade flap (blade 3)");
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            // One hinge 0.5 m from the axis, a point mass 2 m farther out: w^2 = k / (m l^2) + Omega^2 (1 + e / l).
            const double w = std::sqrt(5200 / (3 * 4.0) + speeds[i] * speeds[i] * 1.25);
            CAPTURE(speeds[i]);
            CHECK(d.damped_hz(own, i) == Approx(w / (2 * pi)).epsilon(1e-3));  // damped
            CHECK_FALSE(own.doubtful[i]);
        }
        CHECK(d.find_branch("2nd blade flap (blade 3)") == nullptr);
    }
}

TEST_CASE("unequal blades: a mode of one blade keeps its name and its frequency when the rotor begins to turn",
          "[analytic]") {
    // Lag of a point mass: one hinge at e = 0.5 m, l = 2 m; flap as well. The rotating frame has one frequency.
    const Rotor rotor = rotor_of({.blades = {{.flap = {4000}, .lag = 0, .damping = 0},
                                             {.flap = {5000}, .lag = 0, .damping = 0},
                                             {.flap = {6500}, .lag = 0, .damping = 0}},
                                  .support = false});
    const std::vector<double> speeds{0, 0.5, 1, 2, 4};
    for (const std::vector<double>& list : {speeds, {0.0}, {0.5, 4.0}}) {
        const Campbell d = diagram_of(rotor, list, {.spin = RotorSpin::prescribed});
        REQUIRE(d.branches.size() == 3);
        for (int k = 1; k <= 3; ++k) {
            const double stiffness[] = {4000, 5000, 6500};
            const Branch& branch = d.branch(text("blade flap (blade ", k, ")"));
            for (std::size_t i = 0; i < list.size(); ++i) {
                CAPTURE(k, list[i], branch.mac[i]);
                const double w = std::sqrt(stiffness[k - 1] / 12 + list[i] * list[i] * 1.25);
                CHECK(d.damped_hz(branch, i) == Approx(w / (2 * pi)).epsilon(1e-8));
                CHECK_FALSE(branch.doubtful[i]);
                CHECK(branch.mostly[i] == branch.name);
                CHECK(d.mode(branch, i)->blade_shares(k - 1) == Approx(1).epsilon(1e-8));
            }
        }
        // Sorted by frequency still.
        for (const CampbellPoint& point : d.points)
            CHECK(std::ranges::is_sorted(point.modes, {}, [](const CampbellMode& m) { return m.mode.natural_hz(); }));
    }
    CHECK(table(diagram_of(rotor, speeds)).find("frequencies in its rotating frame") != std::string::npos);
    CHECK(table(diagram_of(equal(3), speeds)).find("frequencies in its rotating frame") == std::string::npos);
}

TEST_CASE("unequal blades: on a support that moves a blade far from the others is named from standstill on",
          "[property]") {
    const Rotor rotor = rotor_of({.blades = {{}, {}, {.flap = {7000, 5000}}}});
    const Campbell d = diagram_of(rotor, {0.0, 0.5, 1.0, 1.5});
    const Campbell still = diagram_of(rotor, {0.0});
    for (const char* name : {"1st blade flap (blade 3)", "2nd blade flap (blade 3)"}) {
        const Branch& own = d.branch(name);
        for (std::size_t i = 0; i < d.points.size(); ++i) {
            CAPTURE(name, i, own.mac[i], own.mostly[i]);
            CHECK_FALSE(own.doubtful[i]);
            CHECK(own.mostly[i] == own.name);
            // By less than the support and the centrifugal force change it: not by the rotor speed.
            CHECK(std::abs(d.natural_hz(own, i) - d.natural_hz(own, 0)) < 0.05);
        }
        CHECK(still.natural_hz(still.branch(name), 0) == Approx(d.natural_hz(own, 0)).epsilon(1e-9));
    }
}

TEST_CASE("unequal blades: the generator of a machine with one blade is free if it is asked to be", "[analytic]") {
    // One lag hinge on a hub with inertia J about the shaft: the hub turns against the blade. With the blade's
    // I = m l^2 about the hinge, c = m l (e + l) and J' = J + m (e + l)^2: w^2 = k / (I - c^2 / J') at standstill.
    const double m = 3, l = 2, e = 0.5, k = 3000, J = 500;
    Rotor rotor = rotor_of({.blades = {{.flap = {}, .lag = k, .mass = m, .damping = 0}}, .support = false});
    const double held = std::sqrt(k / (m * l * l)),
                 free = std::sqrt(k / (m * l * l - std::pow(m * l * (e + l), 2) / (J + m * std::pow(e + l, 2))));
    for (const double Omega : {0.0, 2.0}) {
        const Campbell d = diagram_of(rotor, {Omega}),
                       prescribed = diagram_of(rotor, {Omega}, {.spin = RotorSpin::prescribed});
        CHECK(d.spin == RotorSpin::free);
        CHECK(prescribed.spin == RotorSpin::prescribed);
        if (Omega > 0) continue;
        CHECK(2 * pi * d.natural_hz(d.branch("blade lag"), 0) == Approx(free).epsilon(1e-10));
        CHECK(2 * pi * prescribed.natural_hz(prescribed.branch("blade lag"), 0) == Approx(held).epsilon(1e-10));
    }
    // A blade cut from its machine has nothing that would turn with it.
    rotor.map.hub_is_driven = true;
    CHECK(diagram_of(rotor, {0.0}).spin == RotorSpin::prescribed);
}

TEST_CASE("unequal blades: evenly spaced ones of more places are as others", "[crosscheck]") {
    // 1, 3 and 5 of six; 2, 4 and 6, where the first one is not up at azimuth 0.
    const Campbell three = diagram_of(equal(3), {2.0});
    for (const std::vector<int>& places : {std::vector<int>{1, 3, 5}, {2, 4, 6}}) {
        Rotor rotor = rotor_of({.blades = std::vector<IndividualBlade>(3), .places = places, .of = 6});
        rotor.map.evenly_spaced = true;
        const Campbell some = diagram_of(rotor, {2.0});
        CHECK(some.method == three.method);
        REQUIRE(some.branches.size() == three.branches.size());
        for (std::size_t i = 0; i < some.branches.size(); ++i) {
            CHECK(some.branches[i].name == three.branches[i].name);
            CHECK(some.natural_hz(some.branches[i], 0) == Approx(three.natural_hz(three.branches[i], 0)).epsilon(1e-9));
        }
    }
}

}  // namespace cardan::testing::unequal_blades
