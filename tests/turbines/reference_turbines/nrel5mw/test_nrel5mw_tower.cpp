// The tower of the NREL 5 MW machine: alone, and with everything above it as one rigid body.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "tests/oracles/column_with_head.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/nrel5mw/test_nrel5mw_machine.hpp"

using namespace cardan;
using namespace cardan::testing;
using namespace cardan::turbines;

namespace {

// Piecewise linear over the stations of a table.
std::function<double(double)> linear(std::span<const double> x, std::span<const double> y) {
    return [x, y](double at) {
        std::size_t i = 1;
        while (i + 1 < x.size() && at > x[i]) ++i;
        return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
    };
}

// A line of mass, as in the oracle.
TurbineDescription without_rotary_inertia() {
    TurbineDescription d = nrel5mw_description();
    d.tower.line.section = [own = d.tower.line.section](double x) {
        BeamSection s = own(x);
        s.J.setZero();
        return s;
    };
    return d;
}

oracles::ColumnWithHead oracle() {
    const auto h = table("tower").column("height_above_ground", "m");
    return {.breaks = {h.begin(), h.end()},
            .bending_stiffness = linear(h, table("tower").column("fore_aft_stiffness")),
            .mass_per_length = linear(h, table("tower").column("mass_per_length"))};
}

// A tower alone, as a line of mass, with a rigid body on its top.
solvers::SecondOrderSystem tower_with_head(const RigidInertia& head, double gravity, int elements) {
    Tree tree;
    ForceSet forces;
    forces.set_gravity({0, 0, -gravity});
    const FrameId foot = tree.add_frame(Tree::base(), Placement::rotation(axis_rotation(Axis::y)), "foot");
    CardanBeamOptions options;
    options.elements = elements;
    options.torsion = false;
    const CardanBeam beam =
        add_cardan_beam(tree, forces, foot, without_rotary_inertia().tower.line, "tower", {"tower"}, options);
    if (!head.is_massless()) tree.weld(beam.tip(), head, "head");
    const System system(tree, forces);
    const Vector zero = Vector::Zero(system.model.size());
    return solvers::restrict_to(solvers::linearise(system, at_rest(zero)), system.model.coordinates().free());
}

// First, third ... frequency: those of one plane (both are the same).
std::vector<double> of_one_plane(const solvers::SecondOrderSystem& system) {
    std::vector<double> f;
    const auto all = solvers::modes(system);
    for (std::size_t i = 0; i < all.size(); i += 2) f.push_back(all[i].natural_hz());
    return f;
}

}  // namespace

TEST_CASE("NREL 5 MW tower: alone it has the frequencies of the continuous column, by name", "[analytic]") {
    AssemblyOptions options = undamped(Nrel5mwVariant::report, 2, 12);
    options.tower_beam->torsion = false;  // it has none without rotary inertia
    const Turbine tower = isolated_tower(without_rotary_inertia(), options);
    CHECK(tower.rotor().spin == -1);
    CHECK(tower.rotor().machine.find("tower alone") != std::string::npos);
    const solvers::Campbell found = diagram(tower, {0});
    const auto exact = oracle().frequencies(2, 0.5, 20);
    for (const char* direction : {"fore-aft", "side-side"}) {
        CHECK(hz(found, text("1st tower ", direction)) == Approx(exact[0] / (2 * pi)).epsilon(2e-5));
        CHECK(hz(found, text("2nd tower ", direction)) == Approx(exact[1] / (2 * pi)).epsilon(2e-4));
    }
}

TEST_CASE("NREL 5 MW tower: alone and with a body on its top, with and without its weight", "[analytic]") {
    oracles::ColumnWithHead column = oracle();
    const auto compare = [&](const RigidInertia& head, double gravity, int elements, double first, double second) {
        column.head_mass = head.mass, column.head_height = head.com.x(), column.head_inertia = head.J(1, 1);
        column.gravity = gravity;
        const auto exact = column.frequencies(2, 0.5, 20);
        const auto found = of_one_plane(tower_with_head(head, gravity, elements));
        CHECK(found[0] == Approx(exact[0] / (2 * pi)).epsilon(first));
        CHECK(found[1] == Approx(exact[1] / (2 * pi)).epsilon(second));
        return found[0];
    };
    // Everything above the tower as one body: 349.6 t, mass centre 1.8 m above the top (beam axes: x upward).
    RigidInertia head;
    head.mass = 349600;
    head.com = {1.8, 0, 0};
    head.J = Vec3(2e7, 2.4e7, 2.4e7).asDiagonal();
    const double bare = compare({}, 0, 6, 2e-4, 2e-3);
    const double loaded = compare(head, 0, 6, 2e-4, 2e-3);
    const double heavy = compare(head, units::standard_gravity, 6, 5e-4, 2e-3);
    CHECK(loaded < bare / 2.5);
    CHECK(heavy < 0.995 * loaded);
    // Fourth order without weight; 12 elements are sixteen times closer.
    compare(head, 0, 12, 2e-5, 2e-4);
}

TEST_CASE("NREL 5 MW tower: with a rigid top it is the limit of a machine with stiff blades, yaw bearing and shaft",
          "[crosscheck]") {
    const AssemblyOptions options = undamped(Nrel5mwVariant::report, 2, 4);
    TurbineDescription stiff = nrel5mw_description();
    stiff.blade.line.section = [own = stiff.blade.line.section](double x) {
        BeamSection s = own(x);
        s.compliance *= 1e-6;
        return s;
    };
    stiff.yaw.rotation = rigid_joint;
    stiff.drive_train.main_shaft = stiff.drive_train.high_speed_shaft = rigid_joint;
    const solvers::Campbell whole = diagram(assemble(stiff, options), {0}),
                            tower = diagram(isolated_tower(stiff, options, true), {0});
    // Blades move 1e-6 of what the real ones do, whose first frequency is about twice that of the tower.
    for (const char* mode : {"1st tower fore-aft", "1st tower side-side", "2nd tower fore-aft", "2nd tower side-side"})
        CHECK(hz(tower, mode) == Approx(hz(whole, mode)).epsilon(1e-4));
}

TEST_CASE("NREL 5 MW tower: it includes neither a platform under the machine nor a rotor", "[property]") {
    const AssemblyOptions options = undamped(Nrel5mwVariant::report, 2, 2);
    TurbineDescription machine = nrel5mw_description();
    const double on_ground = hz(diagram(isolated_tower(machine, options, true), {0}), "1st tower fore-aft");
    machine.platform.emplace().inertia.mass = 1e6;
    const Turbine tower = isolated_tower(machine, options, true);
    CHECK_FALSE(tower.layout().platform);
    CHECK(hz(diagram(tower, {0}), "1st tower fore-aft") == on_ground);
    CHECK_THROWS_AS(diagram(tower, {1.0}), InputError);
}
