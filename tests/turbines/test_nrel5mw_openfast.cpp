// The whole NREL 5 MW machine beside OpenFAST 5.0.0: linearisation with multi-blade transformation, gravity on, no
// aerodynamics, generator locked. A peer's numbers with idealisations of their own. [docs/nrel5mw.md]
#include "tests/oracles/polynomial_blade.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/test_nrel5mw_machine.hpp"
#include "turbines/csv.hpp"
#include "turbines/embedded_data.hpp"

#include "examples/nrel5mw_campbell/assumed_shapes.hpp"

using namespace cardan;
using namespace cardan::testing;
using nrel5mw_campbell::Limited;
using oracles::PolynomialBlade;
using turbines::Nrel5mwVariant;

namespace {

const std::array<std::string, 11> names{
    "1st tower side-side",         "1st tower fore-aft",          "drive-train torsion",
    "1st blade flap (backward)",   "1st blade flap (collective)", "1st blade flap (forward)",
    "1st blade edge (backward)",   "1st blade edge (forward)",    "2nd blade flap (backward)",
    "2nd blade flap (collective)", "2nd blade flap (forward)"};
using Row = std::array<double, 11>;  // Hz
constexpr std::array<double, 3> speeds{0, 6, 12.1};
constexpr std::array<Row, 3> elastodyn{
    {{0.3138, 0.3244, 0.6200, 0.6667, 0.6991, 0.6751, 1.0805, 1.0919, 1.9111, 2.0074, 1.9837},
     {0.3139, 0.3242, 0.6212, 0.5852, 0.7115, 0.7834, 0.9871, 1.1898, 1.8585, 2.0205, 2.0639},
     {0.3139, 0.3234, 0.6239, 0.5239, 0.7496, 0.9230, 0.8913, 1.2991, 1.8041, 2.0635, 2.1992}}};
constexpr std::array<Row, 3> beamdyn{
    {{0.3152, 0.3257, 0.6312, 0.6870, 0.7191, 0.6957, 1.0876, 1.0985, 1.9643, 2.0646, 2.0408},
     {0.3152, 0.3255, 0.6323, 0.6054, 0.7310, 0.8037, 0.9955, 1.1980, 1.9128, 2.0764, 2.1187},
     {0.3152, 0.3248, 0.6345, 0.5420, 0.7676, 0.9414, 0.8990, 1.3066, 1.8555, 2.1162, 2.2492}}};

// Under gravity, at 0, 6 and 12.1 rpm; names by the diagram without it.
std::array<Row, 3> computed(Nrel5mwVariant variant, Limited limited, int blade_elements, int tower_elements) {
    const auto description = turbines::nrel5mw_description(turbines::nrel5mw_options(variant));
    turbines::AssemblyOptions options = undamped(variant, blade_elements, tower_elements);
    const turbines::Turbine light = turbines::assemble(description, options);
    options.gravity = turbines::nrel5mw_gravity;
    const turbines::Turbine heavy = turbines::assemble(description, options);
    const solvers::Campbell d = diagram(light, {speeds[0] * rpm, speeds[1] * rpm, speeds[2] * rpm});
    std::array<Row, 3> all{};
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        solvers::AzimuthAverageOptions average;
        average.rotor_speed = speeds.at(i) * rpm;
        average.azimuths = 12;
        average.harmonics = 3;
        const auto mean = solvers::azimuth_average(heavy.system(), heavy.rotor(), average);
        const auto modes = nrel5mw_campbell::limited_modes(heavy, mean, limited);
        for (std::size_t k = 0; k < names.size(); ++k) {
            const int mode = d.branch(names.at(k)).mode.at(i);
            REQUIRE(mode >= 0);
            const auto nearest =
                solvers::nearest_mode(mean.system, modes, d.points[i].modes[static_cast<std::size_t>(mode)].mode);
            all.at(i).at(k) = modes[nearest.index].natural_hz();
        }
    }
    return all;
}

// The blade of BeamDyn's input file: no mass factor, no offsets, GA = EA / 10.
PolynomialBlade beamdyn_blade() {
    const auto t = turbines::CsvTable::parse(turbines::embedded_data("nrel5mw_blade.csv"), "blade");
    const auto r = t.column("radius_from_rotor_apex"), twist = t.column("structural_twist"),
               mass = t.column("mass_per_length"), flap = t.column("flap_stiffness"), edge = t.column("edge_stiffness"),
               EA = t.column("axial_stiffness_EA"), jf = t.column("flap_mass_inertia_per_length"),
               je = t.column("edge_mass_inertia_per_length");
    PolynomialBlade blade;
    for (std::size_t i = 0; i < t.rows(); ++i) {
        blade.stations.push_back(r[i] - r[0]);
        blade.sections.push_back({-twist[i] * pi / 180, mass[i], flap[i], edge[i], EA[i] / 10, jf[i], je[i]});
    }
    return blade;
}

// How much too high one element of order 5 makes its first flap, first edge and second flap mode at rest.
std::array<double, 3> order_five() {
    const PolynomialBlade blade = beamdyn_blade();
    const Eigen::VectorXd coarse = blade.frequencies(5, PolynomialBlade::Rule::trapezoidal, 3),
                          fine = blade.frequencies(24, PolynomialBlade::Rule::gauss, 3);
    return {coarse(0) / fine(0), coarse(1) / fine(1), coarse(2) / fine(2)};
}

// Largest relative difference over the modes `first` ... `last` - 1 and all speeds.
double largest(const std::array<Row, 3>& found, const std::array<Row, 3>& reference, std::size_t first,
               std::size_t last) {
    double difference = 0;
    for (std::size_t i = 0; i < speeds.size(); ++i)
        for (std::size_t k = first; k < last; ++k)
            difference = std::max(difference, std::abs(found.at(i).at(k) / reference.at(i).at(k) - 1));
    return difference;
}

}  // namespace

TEST_CASE("NREL 5 MW machine limited to ElastoDyn's shapes: within 2 % of OpenFAST with ElastoDyn's blades",
          "[published]") {
    const auto found = computed(Nrel5mwVariant::fast, Limited::tower_and_blades, 12, 8);
    CHECK(largest(found, elastodyn, 0, 2) < 0.003);   // tower
    CHECK(largest(found, elastodyn, 2, 3) < 0.005);   // drive train
    CHECK(largest(found, elastodyn, 3, 8) < 0.015);   // first flap and edge
    CHECK(largest(found, elastodyn, 8, 11) < 0.028);  // second flap; 1.3 % in rotation
}

TEST_CASE(
    "NREL 5 MW machine without limits: first flap and edge within 1 % of ElastoDyn's, the tower 3 % softer fore-aft",
    "[published]") {
    const auto found = computed(Nrel5mwVariant::fast, Limited::nothing, 8, 4);
    CHECK(largest(found, elastodyn, 3, 8) < 0.01);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        CHECK(found.at(i)[0] / elastodyn.at(i)[0] - 1 == Approx(-0.007).margin(0.001));
        CHECK(found.at(i)[1] / elastodyn.at(i)[1] - 1 == Approx(-0.0326).margin(0.001));
    }
}

TEST_CASE("NREL 5 MW machine with ElastoDyn's tower: OpenFAST with BeamDyn's blades but for the error of order 5",
          "[published]") {
    const auto factor = order_five();
    CHECK(factor[0] == Approx(1.010).margin(0.001));
    CHECK(factor[1] == Approx(1.005).margin(0.001));
    CHECK(factor[2] == Approx(1.047).margin(0.002));
    auto found = computed(Nrel5mwVariant::beamdyn, Limited::tower, 8, 8);
    CHECK(largest(found, beamdyn, 0, 2) < 0.003);
    CHECK(largest(found, beamdyn, 2, 3) < 0.004);
    for (Row& row : found)
        for (std::size_t k = 3; k < row.size(); ++k) row.at(k) *= k < 6 ? factor[0] : k < 8 ? factor[1] : factor[2];
    CHECK(largest(found, beamdyn, 3, 8) < 0.013);
    CHECK(largest(found, beamdyn, 8, 11) < 0.03);
    for (std::size_t i : {1u, 2u}) CHECK(found.at(i)[4] == Approx(beamdyn.at(i)[4]).epsilon(0.003));
}

TEST_CASE("NREL 5 MW blade with the shear flexibility of BeamDyn's file: the elements converge to polynomials",
          "[analytic]") {
    const turbines::Turbine blade =
        turbines::isolated_blade(turbines::nrel5mw_description(turbines::nrel5mw_options(Nrel5mwVariant::beamdyn)),
                                 undamped(Nrel5mwVariant::beamdyn, 24, 1));
    const solvers::Campbell d = diagram(blade, {0});
    const Eigen::VectorXd exact = beamdyn_blade().frequencies(30, PolynomialBlade::Rule::gauss, 3);
    CHECK(hz(d, "1st blade flap") == Approx(exact(0)).epsilon(5e-4));
    CHECK(hz(d, "1st blade edge") == Approx(exact(1)).epsilon(5e-4));
    CHECK(hz(d, "2nd blade flap") == Approx(exact(2)).epsilon(1e-3));
}
