// A Morison member as a client of force elements and of added mass: what it does in still water and in a wave.
#include "mbs/model/solids.hpp"
#include "tests/mbs/system/morison_member.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/simulation.hpp"
#include "tests/support/tree_tools.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// A member on a free body with the mass and the inertia of a homogeneous bar.
struct Afloat {
    Afloat(MorisonMember on, const AiryWave& wave, double density = water_density)
        : member(std::move(on)), body(make_tree(density)), system(tree, forces_in(wave)), workspace(system.model) {}
    const Model::Free& free() const { return system.model.free_body("member"); }
    Kinematics kin(const Vector& q) { return kinematics(system.model, q, workspace); }
    Vector Q(const State& state) {
        Vector out(system.model.size());
        system.forces.generalised_forces({state, kin(state.q)}, out);
        return out;
    }

    MorisonMember member;
    Tree tree;
    FreeBody body;
    System system;
    Workspace workspace;

private:
    FreeBody make_tree(double density) {
        const FreeBody added = tree.add_free_body(
            {.name = "member",
             .inertia = slender_bar(density * member.area() * member.length(), member.from, member.to) +
                        RigidInertia{0, Vec3::Zero(), Mat3::Identity()}});
        member.frame = added.frame;
        tree.add_added_mass(member.added_mass("water"));
        return added;
    }
    ForceSet forces_in(const AiryWave& wave) const {
        ForceSet set;
        set.add_element(morison_element(member, wave));
        set.set_gravity(Vec3(0, 0, -standard_gravity));
        return set;
    }
};

State still(const Afloat& at, double time = 0) {
    const Vector zero = Vector::Zero(at.system.model.size());
    return {.time = time, .q = zero, .qd = zero};
}

}  // namespace

TEST_CASE("Morison member: the loads on a monopile in a wave are those of the reference", "[reference]") {
    // 6 m in diameter, wave of 3 m and 10 s in water of 20 m: force along x and moment about y at z = 0. The formula
    // was checked against HydroDyn of OpenFAST 5.0.0 to 1e-5; these digits are its own integration along the axis.
    struct Row {
        double time, drag, drag_moment, inertia, inertia_moment;
    };
    for (const Row& row :
         {Row{0, 207599.1945, -1735487.509, 0, 0}, Row{1.3, 97281.96661, -813257.6735, -965370.6602, 8872847.651},
          Row{4, -135875.4368, 1135891.322, -778401.9994, 7154394.303},
          Row{7.7, 3261.055222, -27261.76572, 1313854.106, -12075804.45}}) {
        CAPTURE(row.time);
        MorisonMember pile{.from = {0, 0, -20}, .to = Vec3::Zero(), .diameter = 6, .C_a = 0, .C_p = 0};
        const AiryWave wave(3, 10, 20);
        Afloat drag(pile, wave);
        pile.C_d = 0, pile.C_a = pile.C_p = 1;
        Afloat inertia(pile, wave);
        const auto check = [&](Afloat& at, double force, double moment) {
            const Vector Q = at.Q(still(at, row.time));
            CHECK(std::abs(Q(at.free().slides[0]) - force) < 2e-7 * 1.3e6);
            CHECK(std::abs(Q(at.free().hinges[1]) - moment) < 2e-7 * 1.2e7);
        };
        check(drag, row.drag, row.drag_moment);
        check(inertia, row.inertia, row.inertia_moment);
    }
}

TEST_CASE("Morison member: towed through still water, an inclined one is pushed across its axis", "[crosscheck]") {
    const double U = 1.3, angle = 0.6;
    const MorisonMember member{.from = {0, 0, -30},
                               .to = Vec3(9 * std::cos(angle), 0, -30 + 9 * std::sin(angle)),
                               .diameter = 0.8,
                               .C_d = 1.1};
    Afloat at(member, {});
    State towed = still(at);
    towed.qd(at.free().slides[0]) = U;
    const double normal = U * std::sin(angle), push = water_density * 1.1 * 0.4 * 9 * normal * normal;
    const Vector Q = at.Q(towed);
    CHECK(Q(at.free().slides[0]) == Approx(-push * std::sin(angle)).epsilon(1e-12));
    CHECK(std::abs(Q(at.free().slides[1])) < 1e-12 * push);
    CHECK(Q(at.free().slides[2]) == Approx(push * std::cos(angle)).epsilon(1e-12));  // as heavy as water
}

TEST_CASE("Morison member: derivatives are exact in a wave", "[property]") {
    Random random(3);
    const MorisonMember member{.from = {-2, 1, -14}, .to = {3, -1, -8}, .diameter = 0.9, .C_d = 1.2, .C_a = 0.8};
    Afloat at(member, AiryWave(1.5, 7, 40));
    const int n = at.system.model.size();
    State state{.time = 2.3, .q = random_state(random, n, 0.3), .qd = random_state(random, n, 0.5)};
    ForceDerivatives out;
    at.system.forces.derivatives({state, at.kin(state.q)}, out);
    const auto difference = [&](Vector State::*x, int b) {
        constexpr double h = 1e-5;
        State up = state, down = state;
        (up.*x)(b) += h;
        (down.*x)(b) -= h;
        return Vector((at.Q(up) - at.Q(down)) / (2 * h));
    };
    Matrix by_q(n, n), by_qd(n, n);
    for (int b = 0; b < n; ++b) by_q.col(b) = difference(&State::q, b), by_qd.col(b) = difference(&State::qd, b);
    const Matrix stiffness = -(out.gravity + out.loads + out.elastic);
    CHECK(scaled(stiffness - by_q, by_q) < 1e-9);
    CHECK(scaled(-out.damping - by_qd, by_qd) < 1e-9);
}

TEST_CASE("Morison member: a pendulum in water swings with added mass and buoyancy", "[crosscheck]") {
    // (m + rho C_a A) L^2/3 theta'' = -(m - rho A) g L/2 sin theta: an elliptic integral for any amplitude.
    const double L = 4, mass = 2500, amplitude = 0.8;  // kg/m
    MorisonMember member{.from = {0, 0, -10}, .to = {0, 0, -10 - L}, .diameter = 1.1, .C_d = 0, .C_a = 0.9};
    Tree tree;
    const Link hinge =
        add_joint(tree, {.name = "pendulum",
                         .inboard = tree.add_frame(Tree::base(), Placement::translation(member.from), "support"),
                         .axis = Vec3::UnitY(),
                         .inertia = slender_bar(mass * L, Vec3::Zero(), Vec3(0, 0, -L))});
    member.frame = hinge.axes;
    member.to -= member.from;
    member.from.setZero();
    tree.add_added_mass(member.added_mass("water"));
    const double inertia = (mass + 0.9 * water_density * member.area()) * L * L / 3;
    const double weight = (mass - water_density * member.area()) * standard_gravity * L / 2;
    const double period = 4 * std::comp_ellint_1(std::sin(amplitude / 2)) * std::sqrt(inertia / weight);
    const auto system = [&](double C_d) {
        ForceSet set;
        member.C_d = C_d;
        set.add_element(morison_element(member));
        set.set_gravity(Vec3(0, 0, -standard_gravity));
        return System(tree, set);
    };
    const System ideal = system(0), real = system(1);
    Simulation free(ideal, Vector{{amplitude}}, Vector{{0.0}}), damped(real, Vector{{amplitude}}, Vector{{0.0}});
    const double energy = free.energy();
    free.advance(period / 4, 400);
    CHECK(std::abs(free.q()(0)) < 1e-9 * amplitude);
    CHECK(std::abs(free.energy() - energy) < 1e-9 * std::abs(energy));
    free.advance(0.75 * period, 1200);
    CHECK(free.q()(0) == Approx(amplitude).epsilon(1e-9));
    damped.advance(period, 1600);
    CHECK(damped.q()(0) < 0.95 * amplitude);
    CHECK(damped.energy() < energy);
}

TEST_CASE("Morison member: as heavy as water and without drag it moves with the water across it", "[crosscheck]") {
    // (rho A + rho C_a A) qdd = rho (C_a + 1) A a, whatever C_a.
    const AiryWave wave(0.4, 6, 60);
    const MorisonMember member{.from = {0, 0, -10.5}, .to = {0, 0, -10}, .diameter = 0.3, .C_d = 0, .C_a = 0.7};
    Afloat at(member, wave);
    const State state = still(at, 1.1);
    Vector qdd = state.q, actuator = state.q;
    const Vector Q = at.Q(state);
    ForwardDynamics forward(at.system.model);
    forward.solve(at.kin(state.q), state.qd, Q, qdd, actuator);
    const double turn = qdd(at.free().hinges[1]);  // the wave is a little stronger above
    CHECK(qdd(at.free().slides[0]) - 10.25 * turn ==
          Approx(wave.at(Vec3(0, 0, -10.25), 1.1).acceleration.x()).epsilon(1e-3));
}
