// Critical loads of beams of cardanic elements. "Discrete" values were computed by an independent implementation of
// the same formulas (docs/verification.md), exact ones are analytic (tests/oracles).
#include "solvers/equilibrium/buckling.hpp"
#include "solvers/equilibrium/equilibrium_path.hpp"
#include "solvers/equilibrium/load_stability.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/oracles/beck_column.hpp"
#include "tests/oracles/column_buckling.hpp"
#include "tests/oracles/lateral_buckling.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>
#include <tuple>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;
namespace lateral = cardan::oracles::lateral_buckling;

namespace {

// A column along x, L = EI = mass per length = 1, with a wrench at its tip and gravity.
System column(const CardanBeamOptions& options, const Vec3& force, WrenchAxes axes, const Vec3& gravity = Vec3::Zero(),
              double damping = 0) {
    Tree tree;
    ForceSet forces;
    CardanBeamOptions damped = options;
    damped.damping = BeamDamping::ratio_at(damping, 1);
    const CardanBeam beam =
        add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, slender(1, 1)), "column", {"column"}, damped);
    if (!force.isZero(0)) forces.add_wrench({"tip load", beam.tip(), {force, Vec3::Zero()}, axes});
    forces.set_gravity(gravity);
    return System(tree, forces);
}

// A narrow beam, stiff in the plane x-z: EI_z = GJ = L = 1.
struct Narrow {
    double stiff = 1e6;
    CardanBeamOptions options = {};

    Narrow(int elements, double delta, double EI_y = 1e6) : stiff(EI_y) {
        options.elements = elements;
        options.delta = delta;
    }
    EngineeringSection section() const {
        EngineeringSection s;
        s.mass = 1;
        s.EI_flap = stiff;
        s.EI_edge = s.GJ = 1;
        s.j_flap = s.j_edge = 0.01;
        return s;
    }
    template <class Load>
    System loaded(Load&& load) const {
        Tree tree;
        ForceSet forces;
        const CardanBeam beam =
            add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, section()), "beam", {"beam"}, options);
        load(tree, forces, beam.tip());
        return System(tree, forces);
    }
    System tip_force() const {
        return loaded([](Tree&, ForceSet& forces, FrameId tip) {
            forces.add_wrench({"tip force", tip, {{0, 0, -1}, Vec3::Zero()}, WrenchAxes::base});
        });
    }
};

double critical(const System& system) {
    const auto found = linear_buckling(system);
    REQUIRE(found.size() == 1);
    return found[0].factor;
}

}  // namespace

TEST_CASE("column under a dead tip load: linear buckling gives the discrete values; fourth and second order",
          "[analytic][discrete]") {
    const auto tip_load = [](int elements, double delta) {
        return critical(column(bending_only(elements, delta), {-1, 0, 0}, WrenchAxes::base));
    };
    for (const auto& [elements, s, g] : std::vector<std::tuple<int, double, double>>{{1, 2.4559963, 2.3316571},
                                                                                     {2, 2.4667365, 2.4334582},
                                                                                     {3, 2.4672712, 2.4523058},
                                                                                     {4, 2.4673602, 2.4589078},
                                                                                     {8, 2.4673986, 2.4652772}}) {
        CHECK(tip_load(elements, sixth) == Approx(s).margin(1e-7).epsilon(0));
        CHECK(tip_load(elements, delta_gauss) == Approx(g).margin(1e-7).epsilon(0));
    }
    const double exact = oracles::column_buckling::clamped_free();
    CHECK(order(tip_load(8, sixth), tip_load(16, sixth), exact) == Approx(4).margin(0.05));
    CHECK(order(tip_load(8, delta_gauss), tip_load(16, delta_gauss), exact) == Approx(2).margin(0.05));
}

TEST_CASE("column under its own weight: fourth order with static moments, second with segment masses", "[analytic]") {
    const double exact = oracles::column_buckling::clamped_free_own_weight();
    const auto own_weight = [](int elements, double delta, Partition partition) {
        return critical(column(bending_only(elements, delta, partition), Vec3::Zero(), WrenchAxes::base, {-1, 0, 0}));
    };
    const auto check = [&](double delta, Partition partition, double expected, double error) {
        const double fine = own_weight(16, delta, partition);
        CHECK(order(own_weight(8, delta, partition), fine, exact) == Approx(expected).margin(0.05));
        CHECK(fine == Approx(exact).epsilon(error));
    };
    check(sixth, Partition::static_moment, 4, 2e-6);
    check(sixth, Partition::segment_masses, 2, 3e-4);
    check(delta_gauss, Partition::segment_masses, 2, 6e-4);
}

TEST_CASE("column: the dynamic criterion and the load path lose stability at the linear buckling load",
          "[crosscheck]") {
    const System system = column(bending_only(4, sixth), {-1, 0, 0}, WrenchAxes::base);
    const double expected = critical(system);
    LoadStabilityOptions scan;
    scan.to = 4;
    scan.steps = 8;
    const LoadStability found = load_stability(system, scan);
    CHECK(found.kind == Instability::divergence);
    CHECK(found.factor == Approx(expected).epsilon(1e-7));
    CHECK(found.eigenvalue.imag() == 0);
    EquilibriumPathOptions options;
    options.factors = {0, 1, 2, 3, 4};
    options.stability_tolerance = 1e-9;
    const EquilibriumPath path = equilibrium_path(system, options);
    REQUIRE(path.converged);
    REQUIRE(path.stability_change);
    CHECK(path.stability_change->factor() == Approx(expected).epsilon(1e-8));
    CHECK(path.stability_change->negative_pivots_before == 0);
    CHECK(path.stability_change->negative_pivots_after == 2);  // both planes
    CHECK(path.points.back().at.q.isZero(1e-12));              // the straight column is followed
}

TEST_CASE("linear buckling: loads that cannot buckle have no factor, whatever rounding leaves of their stiffness",
          "[property]") {
    // Load stiffness on a beam along an axis askew to the base, so that it consists of rounding.
    const auto factors = [](const Vec3& force, double size, bool torsion) {
        Tree tree;
        ForceSet forces;
        EngineeringSection section = slender(1, 1);
        section.GJ = 1, section.j_flap = section.j_edge = 0.01, section.EA = 100;
        CardanBeamOptions options = all_free(3);
        options.torsion = options.extension = torsion;
        const Mat3 R = rot_z(0.7) * rot_y(-0.4) * rot_x(1.1);
        const FrameId root = tree.add_frame(Tree::base(), Placement::rotation(R), "root");
        const CardanBeam beam = add_cardan_beam(tree, forces, root, uniform_beam(1, section), "beam", {"b"}, options);
        forces.add_wrench({"tip load", beam.tip(), {size * R * force, Vec3::Zero()}, WrenchAxes::base});
        return linear_buckling(System(tree, forces), {.count = 20});
    };
    for (const double size : {1e-12, 1.0, 1e12}) {
        CAPTURE(size);
        CHECK(factors({1, 0, 0}, size, false).empty());  // tension
        CHECK(factors({1, 0, 0}, size, true).empty());
        // Compression: as many factors as bending coordinates, none from the torsion and extension, and all of them
        // in inverse proportion to the load.
        const auto reference = factors({-1, 0, 0}, 1, true), found = factors({-1, 0, 0}, size, true);
        CHECK(reference.size() == 12);
        REQUIRE(found.size() == reference.size());
        for (std::size_t i = 0; i < found.size(); ++i)
            CHECK(found[i].factor * size == Approx(reference[i].factor).epsilon(1e-9));
    }
    // A force across does nothing to a beam that does not twist.
    for (const double size : {1e-12, 1.0, 1e12}) {
        CAPTURE(size);
        CHECK(factors({0, 1, 0}, size, false).empty());
        CHECK(factors({0, 0.6, -0.8}, size, false).empty());
    }
}

TEST_CASE("lateral buckling of a deep cantilever under a tip force: Prandtl's 4.0126 at second order", "[analytic]") {
    const double exact = lateral::tip_force();
    for (const auto& [delta, error] : {std::pair(sixth, 1e-5), std::pair(delta_gauss, 4e-4)}) {
        CAPTURE(delta);
        const double fine = critical(Narrow(32, delta).tip_force());
        CHECK(order(critical(Narrow(16, delta).tip_force()), fine, exact) == Approx(2).margin(0.15));
        CHECK(fine == Approx(exact).epsilon(error));
    }
}

TEST_CASE(
    "lateral buckling along the load path: the deflection before buckling raises the load as the bent Kirchhoff "
    "rod does",
    "[analytic][slow]") {
    const auto on_path = [](int elements, double EI_y) {
        const Narrow narrow(elements, sixth, EI_y);
        EquilibriumPathOptions options;
        options.factors = {0, 2, 3, 4, 5};
        options.stability_tolerance = 1e-7;
        const EquilibriumPath path = equilibrium_path(narrow.tip_force(), options);
        REQUIRE(path.converged);
        REQUIRE(path.stability_change);
        CHECK(path.stability_change->negative_pivots_after == 1);
        return path.stability_change->factor();
    };
    for (const auto& [EI_y, elements, error] : {std::tuple(10.0, 8, 3e-4), std::tuple(100.0, 12, 2e-5)}) {
        CAPTURE(EI_y);
        const double exact = lateral::tip_force_with_deflection(EI_y, 1), fine = on_path(2 * elements, EI_y);
        CHECK(order(on_path(elements, EI_y), fine, exact) == Approx(2).margin(0.15));
        CHECK(fine == Approx(exact).epsilon(error));
        CHECK(exact > (1 + 1 / EI_y) * lateral::tip_force());
    }
    CHECK(on_path(8, 1e6) == Approx(critical(Narrow(8, sixth).tip_force())).epsilon(2e-6));
}

TEST_CASE("lateral buckling by an end moment depends on how the moment turns with the tip", "[analytic]") {
    const Wrench moment{Vec3::Zero(), {0, 1, 0}}, half{Vec3::Zero(), {0, 0.5, 0}};
    // Quasi-tangential: a pair of dead forces along x at the ends of a stiff arm along z.
    const auto pair = [](int elements) {
        return critical(Narrow(elements, delta_gauss).loaded([](Tree& tree, ForceSet& forces, FrameId tip) {
            for (const double side : {1.0, -1.0}) {
                const FrameId end = tree.add_frame(tip, Placement::translation({0, 0, side}), text("arm ", side));
                forces.add_wrench({text("force ", side), end, {{side / 2, 0, 0}, Vec3::Zero()}, WrenchAxes::base});
            }
        }));
    };
    // Semi-tangential: half about a fixed axis, half about one of the tip.
    const auto mixed = [&](int elements) {
        return critical(Narrow(elements, delta_gauss).loaded([&](Tree&, ForceSet& forces, FrameId tip) {
            forces.add_wrench({"fixed", tip, half, WrenchAxes::base});
            forces.add_wrench({"following", tip, half, WrenchAxes::frame});
        }));
    };
    const auto check = [](const auto& moment_of, double exact) {
        const double fine = moment_of(32);
        CHECK(order(moment_of(16), fine, exact) == Approx(2).margin(0.05));
        CHECK(fine == Approx(exact).epsilon(1e-3));
    };
    check(pair, lateral::quasi_tangential_moment());
    check(mixed, lateral::semi_tangential_moment());
    // Alone, neither has a potential.
    for (const WrenchAxes axes : {WrenchAxes::base, WrenchAxes::frame}) {
        const System alone = Narrow(4, delta_gauss).loaded([&](Tree&, ForceSet& forces, FrameId tip) {
            forces.add_wrench({"moment", tip, moment, axes});
        });
        check_refused([&] { (void)linear_buckling(alone); }, {"no potential", "dynamic criterion"});
    }
}

namespace {

LoadStability beck(const CardanBeamOptions& options, double damping = 0, double growth = 1e-7) {
    LoadStabilityOptions scan;
    scan.growth = growth;
    scan.to = 25;
    scan.steps = 25;
    return load_stability(column(options, {-1, 0, 0}, WrenchAxes::frame, Vec3::Zero(), damping), scan);
}

}  // namespace

TEST_CASE("Beck's column flutters at 20.05 EI / L^2: force and frequency, fourth and second order", "[analytic]") {
    const auto exact = oracles::beck_column::flutter();
    const auto check = [&](double delta, Partition partition, double expected, double error) {
        const LoadStability coarse = beck(bending_only(8, delta, partition)),
                            fine = beck(bending_only(16, delta, partition));
        for (const LoadStability* found : {&coarse, &fine}) {
            CHECK(found->converged);
            CHECK(found->kind == Instability::flutter);
            CHECK(found->factor - found->stable_factor <= 1e-9);
        }
        CHECK(order(coarse.factor, fine.factor, exact.force) == Approx(expected).margin(0.1));
        CHECK(order(coarse.eigenvalue.imag(), fine.eigenvalue.imag(), exact.omega) == Approx(expected).margin(0.1));
        CHECK(fine.factor == Approx(exact.force).epsilon(error));
        CHECK(fine.frequency_hz() == Approx(exact.omega / (2 * pi)).epsilon(error));
    };
    check(sixth, Partition::static_moment, 4, 2e-5);
    check(delta_gauss, Partition::segment_masses, 2, 2e-3);
}

TEST_CASE("Beck's column: below the flutter load all eigenvalues are imaginary", "[analytic]") {
    const LoadStability found = beck(bending_only(8, sixth, Partition::static_moment));
    REQUIRE(found.points.size() == 22);  // load factors 0, 1, ..., 21
    for (std::size_t i = 0; i < 21; ++i) {
        const LoadStabilityPoint& point = found.points[i];
        CAPTURE(point.factor);
        CHECK(point.kind == Instability::none);
        CHECK(std::abs(point.eigenvalue.real()) < 1e-9 * std::abs(point.eigenvalue));
    }
    CHECK(found.points.back().kind == Instability::flutter);
}

TEST_CASE("Beck's column: a small internal damping lowers the flutter load to 10.94", "[analytic]") {
    const auto exact = oracles::beck_column::flutter_with_vanishing_damping();
    const LoadStability found = beck(bending_only(16, sixth, Partition::static_moment), 1e-3, 1e-10);
    CHECK(found.kind == Instability::flutter);
    CHECK(found.factor == Approx(exact.force).epsilon(2e-5));
    CHECK(found.eigenvalue.imag() == Approx(exact.omega).epsilon(2e-5));
}
