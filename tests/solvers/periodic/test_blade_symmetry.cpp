// The symmetry of equal blades, which takes floquet() from the whole period to a part of it.
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/solvers/periodic/hill.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

TEST_CASE("Floquet: backward rotation renumbers the blades the other way round", "[property]") {
    const SmallRotor rotor = small_rotor({.damping = 2, .elastic_support = true});
    const PeriodicSystem system =
        linearised(rotor.system, turning_undeflected(rotor.system, rotor.map.spin, -4), rotor.unknowns());
    CHECK(asymmetry(system, blade_symmetry(rotor.map, rotor.unknowns(), -4)) < 1e-12);
    CHECK(asymmetry(system, blade_symmetry(rotor.map, rotor.unknowns(), 4)) > 1e-3);
    const Floquet whole = floquet(system),
                  third = floquet(system, {.symmetry = blade_symmetry(rotor.map, rotor.unknowns(), -4)});
    CHECK(distance(exponents(whole), exponents(third), 4) < 1e-11);
}

TEST_CASE("Floquet: bending of a rotating shaft is turned with the blades", "[crosscheck]") {
    // A disc on a shaft that bends in rotating axes, y and z, with three hinged masses on it.
    Tree tree;
    ForceSet forces;
    const Link spin =
        add_joint(tree, {.name = "spin", .axis = Vec3::UnitX(), .inertia = {1, Vec3::Zero(), Mat3::Identity()}});
    const Link y =
        add_joint(tree, {.name = "y", .inboard = spin.axes, .kind = JointKind::prismatic, .axis = Vec3::UnitY()});
    const Link z = add_joint(tree, {.name = "z",
                                    .inboard = y.axes,
                                    .kind = JointKind::prismatic,
                                    .axis = Vec3::UnitZ(),
                                    .inertia = {30, Vec3::Zero(), Mat3::Identity()}});
    forces.add_spring("y", y.body, 5000, 8);
    forces.add_spring("z", z.body, 5000, 8);
    RotorMap map;
    map.machine = "disc";
    for (int k = 0; k < 3; ++k) {
        const Mat3 R = axis_frame(Vec3::UnitX()) * rot_z(2 * pi * k / 3);
        const FrameId root = tree.add_frame(z.axes, {R, R * Vec3(0.3, 0, 0)}, text("root ", k + 1));
        const Link lag = add_joint(tree, {.name = text("lag ", k + 1), .inboard = root, .inertia = {2, {1.5, 0, 0}}});
        forces.add_spring(text("lag ", k + 1), lag.body, 80, 1);
    }
    // A spring along one fixed direction makes the system periodic.
    ForceElement fixed{.name = "fixed spring", .points = {{Tree::base()}}};
    const System plain(tree, forces);
    const Model& model = plain.model;
    const int i_spin = model.index("spin"), i_y = model.index("y"), i_z = model.index("z");
    fixed.evaluate = [=](const ElementView& at, ElementForces& out) {
        const double c = std::cos(at.q(i_spin)), s = std::sin(at.q(i_spin)), u = c * at.q(i_y) - s * at.q(i_z);
        out.Q(i_y) -= 3000 * c * u;
        out.Q(i_z) += 3000 * s * u;
    };
    forces.add_element(fixed);
    const System system(tree, forces);
    map.spin = i_spin;
    for (int k = 1; k <= 3; ++k) map.blades.push_back({model.index(text("lag ", k))});
    map.rotating_pairs = {{i_y, i_z, 1.0}};
    std::vector<int> unknowns = model.coordinates().free();
    unknowns.erase(std::find(unknowns.begin(), unknowns.end(), i_spin));
    const double Omega = 5;
    const PeriodicSystem periodic = linearised(system, turning_undeflected(system, i_spin, Omega), unknowns);
    const BladeSymmetry blades = blade_symmetry(map, unknowns, Omega);
    CHECK(asymmetry(periodic, blades) < 1e-8);  // the force element is differenced
    const Floquet whole = floquet(periodic), third = floquet(periodic, {.symmetry = blades});
    CHECK(distance(exponents(whole), exponents(third), Omega) < 1e-9);
    map.rotating_pairs.clear();
    CHECK(asymmetry(periodic, blade_symmetry(map, unknowns, Omega)) > 1e-3);
}

TEST_CASE("periodic system: the mean over one of several identical parts gives that over the period", "[crosscheck]") {
    const double Omega = 4;
    const SmallRotor rotor = small_rotor({.damping = 2, .elastic_support = true});
    const PeriodicSystem blades =
        linearised(rotor.system, turning_undeflected(rotor.system, rotor.map.spin, Omega), rotor.unknowns());
    const PeriodicSystem fixed = in_multi_blade_rows(blades, ColemanTransform(rotor.map, rotor.unknowns()), Omega);
    const Eigen::Index n = blades.rows();
    const BladeSymmetry next = blade_symmetry(rotor.map, rotor.unknowns(), Omega), same{3, Matrix::Identity(n, n)};
    for (const auto& [system, symmetry] : {std::pair(&blades, &next), std::pair(&fixed, &same)}) {
        const SecondOrderSystem whole = mean_over_period(*system, 24), part = mean_over_period(*system, 24, *symmetry);
        CHECK((part.M - whole.M).norm() < 1e-13 * whole.M.norm());
        CHECK((part.C - whole.C).norm() < 1e-13 * whole.C.norm());
        CHECK((part.K - whole.K).norm() < 1e-13 * whole.K.norm());
        CHECK((part.K_elastic - whole.K_elastic).norm() < 1e-13 * whole.K_elastic.norm());
    }
    // In blade rows a third of a revolution alone is another mean.
    const SecondOrderSystem whole = mean_over_period(blades, 24);
    CHECK((mean_over_period(blades, 24, same).M - whole.M).norm() > 1e-3 * whole.M.norm());
}

TEST_CASE("Floquet: the symmetry of a system of first order acts on its states", "[property]") {
    const double Omega = 4;
    const SmallRotor rotor = small_rotor({.damping = 2, .elastic_support = true});
    const PeriodicSystem second =
        linearised(rotor.system, turning_undeflected(rotor.system, rotor.map.spin, Omega), rotor.unknowns());
    const BladeSymmetry blades = blade_symmetry(rotor.map, rotor.unknowns(), Omega);
    const Eigen::Index n = second.rows();
    const PeriodicSystem first = PeriodicSystem::first_order(
        second.period(), 2 * n, [&](double t, Matrix& E, Matrix& A) { second.at(t, E, A); });
    BladeSymmetry both{blades.parts, Matrix::Zero(2 * n, 2 * n)};
    both.P.topLeftCorner(n, n) = both.P.bottomRightCorner(n, n) = blades.P;
    CHECK(asymmetry(first, both) < 1e-12);
    const std::vector<Complex> expected = exponents(floquet(second));
    CHECK(distance(exponents(floquet(first, {.symmetry = both})), expected, Omega) < 1e-9);
    CHECK(distance(exponents(hill(first, {.harmonics = 5})), expected, Omega) < 1e-9);
}

TEST_CASE("Floquet: blades that differ, or are not all there, are refused as a symmetry", "[property]") {
    const double Omega = 4;
    const SmallRotor unequal = small_rotor({.stiffness = {2000, 2000, 2100}, .elastic_support = true});
    const PeriodicSystem system =
        linearised(unequal.system, turning_undeflected(unequal.system, unequal.map.spin, Omega), unequal.unknowns());
    check_refused([&] { (void)floquet(system, {.symmetry = blade_symmetry(unequal.map, unequal.unknowns(), Omega)}); },
                  {"difference of the 3 parts", "whole period"});
    RotorMap map = unequal.map;
    std::vector<int> some = unequal.unknowns();
    some.pop_back();
    check_refused([&] { (void)blade_symmetry(map, some, Omega); }, {"is an unknown", "2", "all 3"});
    check_refused([&] { (void)blade_symmetry(map, unequal.unknowns(), Omega, {0}); }, {"number of blades", "3"});
    map.blades[1].clear();
    check_refused([&] { (void)blade_symmetry(map, unequal.unknowns(), Omega); }, {"coordinates of a blade", "0"});
    map.blades.resize(1);
    check_refused([&] { (void)blade_symmetry(map, unequal.unknowns(), Omega); }, {"number of blades", "1"});
    map.blades.resize(2);
    map.blades[1] = map.blades[0];
    check_refused([&] { (void)blade_symmetry(map, unequal.unknowns(), Omega, {99}); }, {"odd coordinate", "99"});
    map.rotating_pairs = {{map.blades[0][0], 99, 1.0}};
    check_refused([&] { (void)blade_symmetry(map, unequal.unknowns(), Omega); }, {"rotating pair"});
    PeriodicSteadyState state = turning_undeflected(unequal.system, 2, Omega);
    check_refused([&] { (void)linearised(unequal.system, state, {77}); }, {"index of a coordinate", "77"});
    state.coefficients.conservativeResize(3, 1);
    check_refused([&] { (void)linearised(unequal.system, state); }, {"rows of the periodic steady state", "3"});
    state.converged = false;
    check_refused([&] { (void)linearised(unequal.system, state); }, {"periodic steady state", "not converged"});
}
