// Orders of convergence of the partitions whose hinges follow the compliance, and discrete values of the
// mean-difference partition. "Discrete" values: docs/partitions.md, another implementation of the same formulas. Exact
// ones: oracles.
#include "solvers/equilibrium/buckling.hpp"
#include "solvers/equilibrium/equilibrium_path.hpp"
#include "tests/elements/cardan_beam/rotating_cantilever.hpp"
#include "tests/oracles/column_buckling.hpp"
#include "tests/oracles/elastica.hpp"
#include "tests/oracles/straight_beam_ritz.hpp"

namespace cardan::testing::compliance_orders {

namespace {

constexpr auto gauss = Partition::compliance_gauss, mean = Partition::mean_difference;

CardanBeamOptions with(int elements, Partition partition) {
    return bending_only(elements, delta_gauss, partition);
}

BeamLine wedge() {
    return {1, {}, [](double x) {
                const double t = 1 - x / 2;
                return slender(t * t * t, t).section();
            }};
}

// mu = 10^(-k x / 2), EI = 10^(-k x).
BeamLine exponential(double k) {
    return {1, {}, [k](double x) { return slender(std::pow(10, -k * x), std::pow(10, -k * x / 2)).section(); }};
}

double mode(const BeamLine& line, int elements, Partition partition, int number = 1) {
    return bending(clamped_frequencies(line, with(elements, partition)), number);
}

double critical(const BeamLine& line, const CardanBeamOptions& options) {
    Tree tree;
    ForceSet forces;
    const CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), line, "column", {"column"}, options);
    forces.add_wrench({"tip load", beam.tip(), {Vec3(-1, 0, 0), Vec3::Zero()}, WrenchAxes::base});
    return solvers::linear_buckling(System(tree, forces)).at(0).factor;
}

double critical(const BeamLine& line, int elements, Partition partition) {
    return critical(line, with(elements, partition));
}

}  // namespace

TEST_CASE("mean differences: discrete frequencies of the uniform cantilever and the wedge", "[discrete]") {
    const BeamLine uniform = uniform_beam(1, slender(1, 1));
    for (const auto& [elements, expected] : std::vector<std::pair<int, double>>{
             {1, 3.454416}, {2, 3.513676}, {3, 3.515603}, {4, 3.51589}, {8, 3.516008}, {16, 3.516015}})
        CHECK(mode(uniform, elements, mean) == Approx(expected).margin(6e-7).epsilon(0));
    for (const auto& [elements, expected] :
         std::vector<std::pair<int, double>>{{2, 21.06325}, {3, 21.90583}, {4, 21.99913}, {8, 22.03258}})
        CHECK(mode(uniform, elements, mean, 2) == Approx(expected).margin(6e-6).epsilon(0));
    for (const auto& [elements, expected] : std::vector<std::pair<int, double>>{
             {2, 3.823565}, {3, 3.823885}, {4, 3.823833}, {8, 3.823789}, {16, 3.823785}})
        CHECK(mode(wedge(), elements, mean) == Approx(expected).margin(6e-7).epsilon(0));
}

TEST_CASE("mean differences: discrete flap frequencies of the rotating uniform cantilever", "[discrete]") {
    const auto flap1 = [](int elements, double eta) { return rotating(eta, with(elements, mean)).flap1; };
    for (const auto& [elements, expected] :
         std::vector<std::pair<int, double>>{{2, 4.802399}, {4, 4.797636}, {16, 4.79728}})
        CHECK(flap1(elements, 3) == Approx(expected).margin(6e-7).epsilon(0));
    CHECK(flap1(4, 12) == Approx(13.19854).margin(6e-6).epsilon(0));
    CHECK(flap1(16, 12) == Approx(13.170318).margin(6e-7).epsilon(0));
}

TEST_CASE("compliance Gauss points: on a uniform beam they are segment masses at delta_gauss", "[property]") {
    const BeamLine uniform = uniform_beam(1, slender(1, 1));
    for (int elements : {1, 2, 4})
        for (int number : {1, 2})
            CHECK(mode(uniform, elements, gauss, number) ==
                  Approx(mode(uniform, elements, Partition::segment_masses, number)).epsilon(1e-12));
}

TEST_CASE("partitions by compliance: fourth order at rest, uniform and tapered", "[analytic]") {
    constexpr double uniform_exact = 3.5160152685, wedge_exact = 3.82378485;  // characteristic and Bessel functions
    const BeamLine uniform = uniform_beam(1, slender(1, 1));
    CHECK(order(mode(uniform, 4, mean), mode(uniform, 8, mean), uniform_exact) == Approx(4).margin(0.1));
    CHECK(order(mode(wedge(), 8, mean), mode(wedge(), 16, mean), wedge_exact) == Approx(4).margin(0.2));
    CHECK(order(mode(wedge(), 8, gauss), mode(wedge(), 16, gauss), wedge_exact) == Approx(4).margin(0.2));
    // Three decades of stiffness.
    oracles::StraightBeam beam;
    beam.breaks = Eigen::Vector2d(0, 1);
    beam.bending_stiffness = [](double x) { return std::pow(10, -3 * x); };
    beam.mass_per_length = [](double x) { return std::pow(10, -1.5 * x); };
    const Eigen::VectorXd exact = oracles::StraightBeamRitz(beam, 30).frequencies(2);
    for (const Partition partition : {gauss, mean})
        for (int number : {1, 2}) {
            // The error of mode 2 passes through zero between 4 and 8 elements.
            const int n = number == 1 ? 8 : 24;
            CAPTURE(partition_name(partition), number);
            CHECK(order(mode(exponential(3), n, partition, number), mode(exponential(3), 2 * n, partition, number),
                        exact(number - 1)) == Approx(4).margin(0.15));
        }
}

TEST_CASE("mean differences: on a stiffness that falls by five decades two elements are too few, four are good",
          "[analytic]") {
    oracles::StraightBeam beam;
    beam.breaks = Eigen::VectorXd::LinSpaced(3, 0, 1);
    beam.bending_stiffness = [](double x) { return std::pow(10, -5 * x); };
    beam.mass_per_length = [](double x) { return std::pow(10, -2.5 * x); };
    const double exact = oracles::StraightBeamRitz(beam, 24).frequencies(1)(0);
    const auto error = [&](int elements, Partition partition) {
        return 100 * (mode(exponential(5), elements, partition) / exact - 1);
    };
    CHECK(error(2, mean) == Approx(10.4).margin(0.05));
    CHECK(error(2, gauss) == Approx(1.5).margin(0.05));
    CHECK(error(4, mean) == Approx(0.61).margin(0.01));
    CHECK(error(4, gauss) == Approx(0.56).margin(0.01));
}

TEST_CASE("mean differences: fourth order in flap and lag of rotating beams, with hub radius too", "[analytic]") {
    struct Exact {
        double eta, hub, flap1, lag1;
    };
    for (const Exact& e :
         {Exact{3, 0, 4.7972785, 3.7435119}, Exact{12, 0, 13.1701505, 5.4270493}, Exact{3, 0.1, 4.9411499, 0}}) {
        const FlapLag n4 = rotating(e.eta, with(4, mean), e.hub), n8 = rotating(e.eta, with(8, mean), e.hub),
                      n16 = rotating(e.eta, with(16, mean), e.hub);
        CAPTURE(e.eta, e.hub, n4.flap1 - e.flap1, n8.flap1 - e.flap1, n16.flap1 - e.flap1);
        CHECK(order(n8.flap1, n16.flap1, e.flap1) == Approx(4).margin(0.25));
        if (e.lag1 > 0) CHECK(order(n8.lag1, n16.lag1, e.lag1) == Approx(4).margin(0.25));
    }
    const FlapLag n8 = rotating(3, with(8, gauss)), n16 = rotating(3, with(16, gauss));
    CHECK(order(n8.flap1, n16.flap1, 4.7972785) == Approx(2).margin(0.1));
}

TEST_CASE("mean differences: fourth order of the buckling load, uniform and tapered; Gauss points have second",
          "[analytic]") {
    const BeamLine uniform = uniform_beam(1, slender(1, 1));
    const double exact = oracles::column_buckling::clamped_free();
    CHECK(order(critical(uniform, 8, mean), critical(uniform, 16, mean), exact) == Approx(4).margin(0.05));
    CHECK(order(critical(uniform, 8, gauss), critical(uniform, 16, gauss), exact) == Approx(2).margin(0.05));
    oracles::StraightBeam beam;
    beam.breaks = Eigen::Vector2d(0, 1);
    beam.mass_per_length = [](double x) { return 1 - x / 2; };
    beam.bending_stiffness = [](double x) { return std::pow(1 - x / 2, 3); };
    const double tapered = oracles::StraightBeamRitz(beam).critical_tip_load();
    CHECK(order(critical(wedge(), 8, mean), critical(wedge(), 16, mean), tapered) == Approx(4).margin(0.1));
    CHECK(order(critical(wedge(), 8, gauss), critical(wedge(), 16, gauss), tapered) == Approx(2).margin(0.1));
}

TEST_CASE("mean differences: fourth order of large deflection under a tip force", "[analytic]") {
    const auto tip = [](int elements, Partition partition) {
        Tree tree;
        ForceSet forces;
        const CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, slender(1, 1)), "beam",
                                                {"beam"}, with(elements, partition));
        forces.add_wrench({"load", beam.tip(), {{0, 0, 5}, Vec3::Zero()}, WrenchAxes::base});
        const System system(tree, forces);
        const solvers::EquilibriumPath path = solvers::equilibrium_path(system, {});
        REQUIRE(path.converged);
        Workspace workspace(system.model);
        return pose(kinematics(system.model, path.points.back().at.q, workspace), beam.tip()).p;
    };
    const auto exact = oracles::elastica::under_transverse_force(5);
    for (const auto& [partition, expected] : {std::pair(mean, 4.0), std::pair(gauss, 2.0)}) {
        const Vec3 coarse = tip(8, partition), fine = tip(16, partition);
        CHECK(order(coarse.x(), fine.x(), exact.x) == Approx(expected).margin(0.1));
        CHECK(order(coarse.z(), fine.z(), exact.y) == Approx(expected).margin(0.1));
    }
}

TEST_CASE("four partitions on the uniform beam and the wedge with 2, 3, 4 and 8 elements: errors", "[analytic]") {
    // %, in the order of the columns of docs/partitions.md.
    struct Row {
        Partition partition;
        int elements;
        std::array<double, 9> errors;
    };
    constexpr auto segment = Partition::segment_masses, moments = Partition::static_moment;
    const std::vector<Row> rows{
        {segment, 2, {-0.0186, -2.77, -0.24, -3.76, 0.76, -1.17, 3.04, 16.8, -1.38}},
        {segment, 3, {-0.00226, -0.223, -0.0389, -0.72, 0.312, 0.262, 1.29, 7.35, -0.612}},
        {segment, 4, {-0.000558, -0.0443, -0.0111, -0.181, 0.17, 0.204, 0.674, 3.9, -0.344}},
        {segment, 8, {-2.55e-05, -0.00134, -0.000612, -0.00762, 0.0409, 0.0549, 0.141, 0.829, -0.0861}},
        {moments, 2, {-0.0575, -2.84, -0.35, -8.62, 0.114, -1.99, 1.57, 8.93, -0.0269}},
        {moments, 3, {-0.0109, -0.469, -0.0633, -1.41, 0.0236, -0.343, 0.527, 3.06, -0.00526}},
        {moments, 4, {-0.00341, -0.141, -0.0194, -0.404, 0.00757, -0.101, 0.216, 1.26, -0.00166}},
        {moments, 8, {-0.000211, -0.00837, -0.00118, -0.0229, 0.000479, -0.00581, 0.0185, 0.109, -0.000103}},
        {gauss, 2, {-0.0186, -2.77, 0.0258, -3.98, 0.76, -1.17, 3.04, 16.8, -1.38}},
        {gauss, 3, {-0.00226, -0.223, 0.00979, -0.385, 0.312, 0.262, 1.29, 7.35, -0.612}},
        {gauss, 4, {-0.000558, -0.0443, 0.00359, -0.0653, 0.17, 0.204, 0.674, 3.9, -0.344}},
        {gauss, 8, {-2.55e-05, -0.00134, 0.000252, -0.00108, 0.0409, 0.0549, 0.141, 0.829, -0.0861}},
        {mean, 2, {-0.0665, -4.41, -0.00576, -4.73, 0.107, -3.49, 1.56, 8.89, -0.0269}},
        {mean, 3, {-0.0117, -0.584, 0.00262, -0.66, 0.0229, -0.458, 0.525, 3.06, -0.00526}},
        {mean, 4, {-0.00355, -0.16, 0.00125, -0.159, 0.00745, -0.121, 0.216, 1.26, -0.00166}},
        {mean, 8, {-0.000213, -0.00867, 0.000104, -0.00715, 0.000477, -0.00612, 0.0185, 0.109, -0.000103}}};
    const BeamLine uniform = uniform_beam(1, slender(1, 1));
    for (const Row& row : rows) {
        const CardanBeamOptions options =
            bending_only(row.elements, row.partition == moments ? 1. / 6 : delta_gauss, row.partition);
        const std::vector<double> rest = clamped_frequencies(uniform, options),
                                  tapered = clamped_frequencies(wedge(), options);
        const FlapLag eta3 = rotating(3, options), eta12 = rotating(12, options);
        const std::array<double, 9> found{rest[0],     rest[2],    tapered[0],
                                          tapered[2],  eta3.flap1, eta3.flap2,
                                          eta12.flap1, eta12.lag1, critical(uniform, options)};
        const std::array<double, 9> exact{3.5160152685, 22.0344915647, 3.82378485,
                                          18.31726090,  4.7972785,     23.3202637,
                                          13.1701505,   5.4270493,     oracles::column_buckling::clamped_free()};
        for (std::size_t k = 0; k < exact.size(); ++k) {
            CAPTURE(partition_name(row.partition), row.elements, k);
            CHECK(100 * (found.at(k) / exact.at(k) - 1) == Approx(row.errors.at(k)).epsilon(0.006));
        }
    }
}

}  // namespace cardan::testing::compliance_orders
