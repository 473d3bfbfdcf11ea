// Beams flexible in shear under axial force: the springs measure the elongation without the shortening by shear.
#include "solvers/equilibrium/buckling.hpp"
#include "solvers/equilibrium/equilibrium_path.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/elements/cardan_beam/spinning_rods.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

EngineeringSection soft(double GA, double EA = 1e6) {
    EngineeringSection s = slender(1, 1);
    s.GA_y = s.GA_z = GA, s.EA = EA;
    return s;
}

// A column L = 1 under a dead force of 1 toward its foot.
System column(const BeamLine& line, CardanBeamOptions options) {
    options.torsion = false;
    Tree tree;
    ForceSet forces;
    const CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), line, "column", {"column"}, options);
    forces.add_wrench({"load", beam.tip(), {{-1, 0, 0}, Vec3::Zero()}, WrenchAxes::base});
    return System(tree, forces);
}

double critical(const BeamLine& line, const CardanBeamOptions& options) {
    const auto found = solvers::linear_buckling(column(line, options));
    REQUIRE(found.size() == 1);
    return found[0].factor;
}

CardanBeamOptions extensible(int elements, Partition partition) {
    CardanBeamOptions options;
    options.elements = elements;
    options.partition = partition;
    options.extension = true;
    return options;
}

// That column with four elements and without the load.
struct BareColumn {
    BareColumn(double GA, bool extension) {
        CardanBeamOptions options = extensible(4, Partition::segment_masses);
        options.torsion = false;
        options.extension = extension;
        Tree tree;
        beam = add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, soft(GA)), "column", {"c"}, options);
    }
    ForceSet forces;
    CardanBeam beam;
};

// Haringx (1942), Reissner (1972): P (1 + P / GA) = pi^2 EI / 4 L^2 for a clamped-free column that does not yield along
// its axis. The column follows the slopes of its sections: the other reading, Engesser's, has P / (1 - P / GA).
double haringx(double GA) {
    const double euler = pi * pi / 4;
    return GA / 2 * (std::sqrt(1 + 4 * euler / GA) - 1);
}

}  // namespace

TEST_CASE("column flexible in shear: Haringx' critical load, with order 2 for all partitions", "[analytic][discrete]") {
    for (const double GA : {20.0, 10.0}) {
        const double exact = haringx(GA);
        CHECK(exact == Approx(GA == 20 ? 2.22080 : 2.04798).margin(5e-6));
        for (const Partition partition : {Partition::segment_masses, Partition::compliance_gauss,
                                          Partition::static_moment, Partition::mean_difference}) {
            const double n8 = critical(uniform_beam(1, soft(GA)), extensible(8, partition)),
                         n16 = critical(uniform_beam(1, soft(GA)), extensible(16, partition));
            CAPTURE(GA, partition_name(partition), n8, n16, exact);
            CHECK(order(n8, n16, exact) == Approx(2).margin(0.1));
            CHECK(n16 == Approx(exact).epsilon(3e-4));
        }
    }
    // Discrete values of another implementation (planar, energy Hessian).
    const auto discrete = [](double GA, int elements) {
        return critical(uniform_beam(1, soft(GA)), extensible(elements, Partition::segment_masses));
    };
    CHECK(discrete(20, 4) == Approx(2.21392).margin(2e-5));
    CHECK(discrete(20, 8) == Approx(2.21911).margin(2e-5));
    CHECK(discrete(20, 16) == Approx(2.22039).margin(2e-5));
    CHECK(discrete(10, 16) == Approx(2.04770).margin(5e-5));
    // The scan over load factors meets it, with the equilibrium compressed by 2e-6 of its length.
    solvers::EquilibriumPathOptions path;
    path.factors = {0, 2, 2.5};
    path.stability_tolerance = 1e-7;
    const auto found =
        solvers::equilibrium_path(column(uniform_beam(1, soft(20)), extensible(8, Partition::segment_masses)), path);
    REQUIRE(found.stability_change);
    CHECK(found.stability_change->factor() == Approx(discrete(20, 8)).epsilon(2e-5));
}

TEST_CASE("column flexible in shear: condensed extension gives a warning about axial forces", "[property]") {
    const auto warnings = [](double GA, bool extension) { return BareColumn(GA, extension).beam.warnings; };
    CHECK(warnings(20, true).empty());
    CHECK(warnings(shear_rigid, false).empty());
    CHECK(warnings(1e4, false).empty());  // EI / GA L^2 = 1e-4: negligible
    const auto found = warnings(20, false);
    REQUIRE(found.size() == 1);
    CHECK(found[0].find("GA + 1.732050808 N") != std::string::npos);
    CHECK(found[0].find("keep the extension free") != std::string::npos);
    // What it says: the plain law has that limit, P (1 + P / (GA - P / (1 - 2 delta))) to first order.
    CardanBeamOptions condensed = extensible(32, Partition::segment_masses);
    condensed.extension = false;
    CHECK(critical(uniform_beam(1, soft(20)), condensed) == Approx(2.176).margin(1e-3));
}

TEST_CASE("column flexible in shear: a beam rigid in shear keeps its linear law", "[property]") {
    const auto users = [](double GA, bool extension) {
        const BareColumn column(GA, extension);
        CHECK(column.beam.elements[0].tilt.products.empty() == column.forces.elements().empty());
        return column.forces.elements().size();
    };
    CHECK(users(shear_rigid, true) == 0);
    CHECK(users(20, false) == 0);
    CHECK(users(20, true) == 1);
}
