// What a mode is: component modes, shares of the elastic energy, names.
#include "mbs/base/error.hpp"
#include "solvers/mode_names/energy_shares.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/tree_tools.hpp"

#include <numeric>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

struct Machine {
    Tree tree = {};
    ForceSet forces = {};
    RotorMap map = {};

    Link add(const std::string& name, const std::string& part, FrameId inboard, JointKind kind, const Vec3& axis,
             const RigidInertia& inertia, double stiffness) {
        BodySpec spec = joint_spec(name, inboard, kind, axis);
        const Placement back = spec.placement.inverse();
        spec.inertia = inertia.in(back);
        spec.coordinate.part = part;
        const BodyId body = tree.add_body(spec);
        if (stiffness > 0) forces.add_spring(name, body, stiffness);
        return {body, tree.add_frame(tree.frame_of(body), back, name + " axes")};
    }
};

Linearisation linearised(const System& system) {
    const int n = system.model.size();
    return linearise(system, at_rest(Vector::Zero(n)));
}

std::vector<MultiBladeRow> plain(const System& system) {
    return std::vector<MultiBladeRow>(static_cast<std::size_t>(system.model.size()));
}

// A mast of five levels, each with a hinge about y and one about z, that carries a car on a rail along x.
Machine mast() {
    Machine m;
    FrameId at = Tree::base();
    for (int i = 1; i <= 5; ++i) {
        const FrameId level =
            m.tree.add_frame(at, Placement::translation({i == 1 ? 0.0 : 2.0, 0, 0}), text("level ", i));
        const Link y = m.add(text("y ", i), "mast", level, JointKind::revolute, Vec3::UnitY(), {}, 4e4);
        const Link z = m.add(text("z ", i), "mast", y.axes, JointKind::revolute, -Vec3::UnitZ(), {8, {2, 0, 0}}, 9e4);
        at = z.axes;
    }
    m.add("car", "car", at, JointKind::prismatic, Vec3::UnitX(), {3, Vec3::Zero()}, 700);
    m.map.parts = {{"mast", Tree::base(), {}, {"mast torsion", "mast fore-aft", "mast side-side"}},
                   {"car", Tree::base(), {"car on its rail", "", ""}, {}},
                   {"a part that is not there", Tree::base(), {}, {}}};
    return m;
}

EnergyFractions energy_shares_of(const SmallRotor& rotor) {
    return {linearised(rotor.system), rotor.system.model, rotor.map, rotor.unknowns(),
            ColemanTransform(rotor.map, rotor.unknowns()).rows()};
}

double sum(const std::vector<EnergyFraction>& shares) {
    return std::accumulate(shares.begin(), shares.end(), 0.0,
                           [](double total, const EnergyFraction& share) { return total + share.total(); });
}

}  // namespace

TEST_CASE("energy shares: components are named after the axis of their coordinates and counted within the family",
          "[analytic]") {
    const Machine m = mast();
    const System system(m.tree, m.forces);
    const std::vector<int> all = system.model.coordinates().free();
    const EnergyFractions energy_shares(linearised(system), system.model, m.map, all, plain(system));
    std::vector<std::string> names;
    double last = 0;
    for (std::size_t i = 0; i < energy_shares.components().size(); ++i) {
        const Component& c = energy_shares.components()[i];
        CHECK_FALSE(c.of_blades);
        names.push_back(energy_shares.name(static_cast<int>(i), RotorPattern::none));
        if (c.part != "mast") continue;
        CHECK(c.clamped_hz >= last);
        last = c.clamped_hz;
    }
    REQUIRE(names.size() == 11);
    for (const char* family : {"mast fore-aft", "mast side-side"})
        for (const char* ordinal : {"1st", "2nd", "3rd", "4th", "5th"})
            CHECK(std::count(names.begin(), names.end(), text(ordinal, " ", family)) == 1);
    // The softer plane comes first, the only member of a family has no ordinal.
    CHECK(names.front() == "1st mast fore-aft");
    CHECK(names.back() == "car on its rail");
    // With everything else clamped the car is a mass on a spring.
    CHECK(energy_shares.components().back().clamped_hz == Approx(std::sqrt(700.0 / 3) / (2 * pi)).epsilon(1e-12));
    CHECK(energy_shares.components().back().part == "car");
}

TEST_CASE("energy shares: shares of random shapes add up to one and follow the stiffness of the parts", "[property]") {
    const Machine m = mast();
    const System system(m.tree, m.forces);
    const std::vector<int> all = system.model.coordinates().free();
    const Linearisation lin = linearised(system);
    const EnergyFractions energy_shares(lin, system.model, m.map, all, plain(system));
    const SecondOrderSystem whole = restrict_to(lin, all);
    Random random(5);
    for (int i = 0; i < 20; ++i) {
        const Mode mode{Complex(0, 1), random_state(random, system.model.size()).cast<Complex>() +
                                           Complex(0, 1) * random_state(random, system.model.size())};
        const std::vector<EnergyFraction> shares = energy_shares.shares(mode);
        REQUIRE(sum(shares) == Approx(1).epsilon(1e-12));
        const int car = system.model.index("car");
        REQUIRE(shares.back().total() == Approx(energy_by_row(whole, mode)(car)).epsilon(1e-10));
        for (const EnergyFraction& share : shares) {
            REQUIRE(share.total() >= 0);
            REQUIRE(share.of(RotorPattern::none) == share.total());
        }
    }
    // No energy at all: no shares, and no division by zero.
    CHECK(sum(energy_shares.shares({Complex(0, 1), ComplexVector::Zero(system.model.size())})) == 0);
}

TEST_CASE("energy shares: a part without a family name is called by its own; rigid motions are no components",
          "[analytic]") {
    Machine m;
    const Link free = m.add("slide", "sledge", Tree::base(), JointKind::prismatic, Vec3::UnitY(), {4, Vec3::Zero()}, 0);
    m.add("swing", "sledge", free.axes, JointKind::revolute, Vec3::UnitX(), {2, {0, 0, 1.0}}, 50);
    m.map.parts = {{"sledge", Tree::base(), {}, {}}};
    const System system(m.tree, m.forces);
    const EnergyFractions energy_shares(linearised(system), system.model, m.map, system.model.coordinates().free(),
                                        plain(system));
    REQUIRE(energy_shares.components().size() == 1);
    CHECK(energy_shares.name(0, RotorPattern::none) == "sledge");
    // Two bodies that move against each other: the slider takes part, omega^2 = k / (m l^2) (M + m) / M.
    CHECK(energy_shares.components()[0].clamped_hz == Approx(std::sqrt(50.0 / 2 * 6 / 4) / (2 * pi)).epsilon(1e-12));
}

TEST_CASE("energy shares: the phase between cosine and sine tells the whirl of a rotor of three or four blades",
          "[analytic]") {
    for (const int blades : {3, 4}) {
        CAPTURE(blades);
        const SmallRotor rotor =
            small_rotor({.stiffness = std::vector<double>(static_cast<std::size_t>(blades), 2000.0), .offset = 0});
        const EnergyFractions energy_shares = energy_shares_of(rotor);
        REQUIRE(energy_shares.components().size() == 1);
        CHECK(energy_shares.components()[0].of_blades);
        CHECK(energy_shares.components()[0].clamped_hz ==
              Approx(std::sqrt(2000.0 / (3 * 16)) / (2 * pi)).epsilon(1e-12));
        CHECK(energy_shares.name(0, RotorPattern::backward) == "blade flap (backward)");
        const auto share = [&](Complex collective, Complex cosine, Complex sine, Complex differential) {
            ComplexVector shape = ComplexVector::Zero(blades);
            shape.head(3) << collective, cosine, sine;
            if (blades == 4) shape(3) = differential;
            return energy_shares.shares({Complex(0, 1), shape})[0];
        };
        const Complex i(0, 1);
        // cos(w t - psi) = Re (cos psi - i sin psi) exp(i w t) runs ahead with rising azimuth.
        CHECK(share(0, 1, -i, 0).of(RotorPattern::forward) == Approx(1).epsilon(1e-13));
        CHECK(share(0, 1, -i, 0).of(RotorPattern::backward) == Approx(0).margin(1e-13));
        CHECK(share(0, 2, 2.0 * i, 0).of(RotorPattern::backward) == Approx(1).epsilon(1e-13));
        CHECK(share(0, 1, 1, 0).whirl == Approx(0).margin(1e-13));
        CHECK(share(0, 3, 1, 0).of(RotorPattern::cosine) == Approx(0.9).epsilon(1e-13));
        CHECK(share(0, 3, 1, 0).of(RotorPattern::sine) == Approx(0.1).epsilon(1e-13));
        CHECK(share(1, 1, 0, 0).of(RotorPattern::collective) == Approx(0.5).epsilon(1e-13));
        if (blades == 4) CHECK(share(1, 0, 0, 3).of(RotorPattern::differential) == Approx(0.9).epsilon(1e-13));
        // Backward and forward share what cosine and sine hold.
        const EnergyFraction mixed = share(0.3, Complex(1, 2), Complex(-0.4, 0.7), 0.2);
        CHECK(mixed.of(RotorPattern::backward) + mixed.of(RotorPattern::forward) ==
              Approx(mixed.cosine + mixed.sine).epsilon(1e-13));
        CHECK(mixed.total() == Approx(1).epsilon(1e-13));
    }
}

TEST_CASE("energy shares: two blades deflect alike or against each other", "[analytic]") {
    const SmallRotor rotor = small_rotor({.stiffness = {2000, 2000}, .offset = 0});
    const EnergyFractions energy_shares = energy_shares_of(rotor);
    CHECK(energy_shares.two_blades());
    CHECK(energy_shares.name(0, RotorPattern::antisymmetric) == "blade flap (antisymmetric)");
    const EnergyFraction share =
        energy_shares.shares({Complex(0, 1), (ComplexVector(2) << 3, Complex(0, 1)).finished()})[0];
    CHECK(share.of(RotorPattern::symmetric) == Approx(0.9).epsilon(1e-13));
    CHECK(share.of(RotorPattern::antisymmetric) == Approx(0.1).epsilon(1e-12));
}

TEST_CASE("energy shares: shares of several harmonics are added up, and at a negative frequency the whirl is reversed",
          "[analytic]") {
    const SmallRotor rotor = small_rotor({.offset = 0});
    const EnergyFractions energy_shares = energy_shares_of(rotor);
    const Complex i(0, 1);
    const Mode forward{Complex(0, 2), (ComplexVector(3) << 0, 1, -i).finished()},
        collective{Complex(0, 5), (ComplexVector(3) << 1, 0, 0).finished()},
        reversed{Complex(0, -1), (ComplexVector(3) << 0, 1, -i).finished()};
    CHECK(energy_shares.shares(std::vector<Mode>{reversed})[0].of(RotorPattern::backward) == Approx(1).epsilon(1e-13));
    const EnergyFraction sum = energy_shares.shares(std::vector<Mode>{forward, collective, reversed, reversed})[0];
    CHECK(sum.total() == Approx(1).epsilon(1e-13));
    CHECK(sum.of(RotorPattern::collective) == Approx(1.0 / 7).epsilon(1e-13));
    CHECK(sum.of(RotorPattern::forward) == Approx(2.0 / 7).epsilon(1e-13));
    CHECK(sum.of(RotorPattern::backward) == Approx(4.0 / 7).epsilon(1e-13));
}

TEST_CASE("energy shares: every rotor pattern has its name", "[property]") {
    const RotorPattern all[] = {RotorPattern::none,         RotorPattern::collective, RotorPattern::backward,
                                RotorPattern::forward,      RotorPattern::cosine,     RotorPattern::sine,
                                RotorPattern::differential, RotorPattern::symmetric,  RotorPattern::antisymmetric};
    const std::string names[] = {"none", "collective",   "backward",  "forward",      "cosine",
                                 "sine", "differential", "symmetric", "antisymmetric"};
    for (std::size_t i = 0; i < 9; ++i) CHECK(pattern_name(all[i]) == names[i]);
}
