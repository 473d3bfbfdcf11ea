// The whole NREL 5 MW machine beside OpenFAST 5.0.0: linearisation with multi-blade transformation, gravity on, no
// aerodynamics, generator and yaw bearing locked. A peer's numbers with idealisations of their own, which an
// independent model of ElastoDyn has as well. [docs/nrel5mw.md]
#include "examples/studies/nrel5mw_campbell/assumed_shapes.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "tests/oracles/elastodyn_turbine.hpp"
#include "tests/oracles/polynomial_blade.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/nrel5mw/test_nrel5mw_machine.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

#include <algorithm>

namespace cardan::testing::nrel5mw_openfast {

using nrel5mw_campbell::Limited;
using oracles::ElastodynTurbine;
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

turbines::TurbineDescription yaw_locked(Nrel5mwVariant variant) {
    turbines::TurbineDescription description = turbines::nrel5mw_description(turbines::nrel5mw_options(variant));
    description.yaw.rotation = turbines::rigid_joint;
    return description;
}

// The machine in ElastoDyn's shapes, from the data alone.
ElastodynTurbine elastodyn_turbine(int blade_elements, int tower_elements) {
    const auto& polynomials = turbines::elastodyn_tower_polynomials;
    const auto& b = table("blade");
    const auto& t = table("tower");
    const auto values = [](std::span<const double> column, double offset, double factor) {
        std::vector<double> all;
        for (const double y : column) all.push_back(factor * (y - offset));
        return all;
    };
    const auto radius = b.column("radius_from_rotor_apex", "m");
    const auto q = turbines::CsvQuantities::parse(turbines::embedded_data("nrel5mw_turbine.csv"), "turbine");
    using units::degree;
    ElastodynTurbine machine;
    machine.blade.x = values(radius, radius[0], 1);
    machine.blade.mass = values(b.column("mass_per_length"), 0, q.number("blade_mass_adjust_factor", "-"));
    machine.blade.EI_flap = values(b.column("flap_stiffness"), 0, 1);
    machine.blade.EI_edge = values(b.column("edge_stiffness"), 0, 1);
    machine.blade.twist = values(b.column("structural_twist", "deg"), 0, degree);
    machine.blade.shapes = turbines::elastodyn_blade_polynomials;
    machine.blade.root_radius = q.number("hub_radius", "m");
    machine.blade.cone = q.number("precone", "deg") * degree;
    machine.blade.elements = blade_elements;
    machine.tower.height = values(t.column("height_above_ground", "m"), 0, 1);
    machine.tower.mass = values(t.column("mass_per_length"), 0, 1);
    machine.tower.EI = values(t.column("fore_aft_stiffness"), 0, 1);
    machine.tower.shapes = polynomials;
    machine.tower.elements = tower_elements;
    machine.nacelle_mass = q.number("nacelle_mass", "kg");
    machine.nacelle_x = q.number("nacelle_cm_downwind_of_tower_axis", "m");
    machine.nacelle_z = q.number("nacelle_cm_above_tower_top", "m");
    machine.nacelle_inertia =
        q.number("nacelle_inertia_about_yaw_axis", "kg m^2") - machine.nacelle_mass * std::pow(machine.nacelle_x, 2);
    machine.shaft_height = q.number("tower_top_to_shaft_vertical", "m");
    machine.tilt = -q.number("shaft_tilt", "deg") * degree;
    machine.overhang = -q.number("overhang", "m");
    machine.hub_mass = q.number("hub_mass", "kg");
    machine.hub_inertia = q.number("hub_inertia_about_shaft", "kg m^2");
    machine.shaft_stiffness = q.number("drive_shaft_torsional_stiffness_LSS", "N m/rad");
    return machine;
}

// Rising frequencies in the order of `names`: the 11 compared modes are the lowest ones in ElastoDyn's shapes, and come
// in the same order in all models.
template <class Rising>
Row by_name(const Rising& rising, const Row& reference) {
    Row row{};
    for (std::size_t k = 0; k < row.size(); ++k) {
        const auto rank =
            std::count_if(reference.begin(), reference.end(), [&](double hz) { return hz < reference.at(k); });
        row.at(k) = rising(rank);
    }
    return row;
}
std::array<Row, 3> independent(int blade_elements, int tower_elements) {
    const ElastodynTurbine machine = elastodyn_turbine(blade_elements, tower_elements);
    std::array<Row, 3> all{};
    for (std::size_t i = 0; i < speeds.size(); ++i)
        all.at(i) = by_name(machine.modes(speeds.at(i) * rpm).hz, elastodyn.at(i));
    return all;
}

// The mean over the azimuth, Cardan's tower and blades limited to ElastoDyn's shapes.
Row limited_row(std::size_t at, int blade_elements, int tower_elements) {
    turbines::AssemblyOptions options = undamped(Nrel5mwVariant::fast, blade_elements, tower_elements);
    options.gravity = turbines::nrel5mw_gravity;
    const turbines::Turbine machine = turbines::assemble(yaw_locked(Nrel5mwVariant::fast), options);
    solvers::AzimuthAverageOptions average;
    average.rotor_speed = speeds.at(at) * rpm;
    average.azimuths = 12;
    average.harmonics = 3;
    const auto mean = solvers::azimuth_average(machine.system(), machine.rotor(), average);
    const auto modes = nrel5mw_campbell::limited_modes(machine, mean, Limited::tower_and_blades);
    return by_name([&](std::ptrdiff_t k) { return entry(modes, k).natural_hz(); }, elastodyn.at(at));
}

// Under gravity, at 0, 6 and 12.1 rpm, the yaw bearing locked; names by the diagram without gravity.
std::array<Row, 3> computed(Nrel5mwVariant variant, Limited limited, int blade_elements, int tower_elements) {
    const auto description = yaw_locked(variant);
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
            const auto nearest = solvers::nearest_mode(mean.system, modes, entry(d.points[i].modes, mode).mode);
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
        blade.sections.push_back({-twist[i] * units::degree, mass[i], flap[i], edge[i], EA[i] / 10, jf[i], je[i]});
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

TEST_CASE("ElastoDyn's machine written from positions of points: OpenFAST's frequencies, in rotation in all digits",
          "[discrete]") {
    // Sums over as many elements as its files ask for: BldNodes = 17, TwrNodes = 20.
    const auto found = independent(17, 20);
    CAPTURE(found[0], found[1], found[2]);
    for (const std::size_t i : {1u, 2u})
        for (std::size_t k = 0; k < names.size(); ++k)
            CHECK(found.at(i).at(k) == Approx(elastodyn.at(i).at(k)).margin(1e-4).epsilon(0));
    CHECK(largest(found, elastodyn, 0, 3) < 5.5e-4);  // tower and drive train at rest
    CHECK(largest(found, elastodyn, 3, 11) < 2e-4);
}

TEST_CASE(
    "ElastoDyn's machine at rest: of the asymmetric flap modes the lower one tilts, the higher one yaws the rotor",
    "[discrete]") {
    const ElastodynTurbine::Modes at_rest = elastodyn_turbine(17, 20).modes(0);
    const auto lower = at_rest.shapes.col(3), higher = at_rest.shapes.col(4);
    CHECK(at_rest.hz(3) == Approx(0.6667).epsilon(2e-4));
    CHECK(at_rest.hz(4) == Approx(0.6751).epsilon(2e-4));
    // Rows 8 and 11: first flap, cosine (blade 1, which is up, against the others) and sine.
    CHECK(lower(11) < 0.02 * lower(8));
    CHECK(higher(8) < 0.02 * higher(11));
}

TEST_CASE("NREL 5 MW machine limited to ElastoDyn's shapes: an independent model of the same, integrals for its sums",
          "[crosscheck]") {
    const std::size_t at = 2;
    const Row reference = by_name(elastodyn_turbine(200, 100).modes(speeds.at(at) * rpm).hz, elastodyn.at(at));
    const Row found = limited_row(at, 16, 8);
    // The shapes on 16 elements: chords of the shapes, the edge shape with the largest curvature at the root.
    const Row margin{5e-4, 5e-4, 2e-3, 3e-3, 3e-3, 3e-3, 5.2e-3, 5.2e-3, 1.2e-3, 1.2e-3, 1.2e-3};
    for (std::size_t k = 0; k < names.size(); ++k) {
        CAPTURE(names.at(k));
        CHECK(found.at(k) == Approx(reference.at(k)).epsilon(margin.at(k)));
    }
}

TEST_CASE("NREL 5 MW machine limited to ElastoDyn's shapes, 48 elements per blade: the independent model to 0.1 %",
          "[crosscheck][slow]") {
    const auto reference = independent(400, 200);
    std::array<Row, 3> found{};
    for (std::size_t i = 0; i < speeds.size(); ++i) found.at(i) = limited_row(i, 48, 12);
    CHECK(largest(found, reference, 0, 2) < 4e-4);
    CHECK(largest(found, reference, 2, 3) < 7e-4);
    CHECK(largest(found, reference, 3, 6) < 4e-4);
    CHECK(largest(found, reference, 6, 8) < 1.1e-3);
    CHECK(largest(found, reference, 8, 11) < 7e-4);
}

TEST_CASE(
    "NREL 5 MW machine without limits: first flap and edge within 1 % of ElastoDyn's, the tower 3 % softer fore-aft",
    "[discrete]") {
    const auto found = computed(Nrel5mwVariant::fast, Limited::nothing, 8, 4);
    CHECK(largest(found, elastodyn, 3, 8) < 0.01);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        CHECK(found.at(i)[0] / elastodyn.at(i)[0] - 1 == Approx(-0.007).margin(0.001));
        CHECK(found.at(i)[1] / elastodyn.at(i)[1] - 1 == Approx(-0.0326).margin(0.001));
    }
}

TEST_CASE("NREL 5 MW machine with ElastoDyn's tower: OpenFAST with BeamDyn's blades but for the error of order 5",
          "[discrete]") {
    const auto factor = order_five();
    CHECK(factor[0] == Approx(1.010).margin(0.001));
    CHECK(factor[1] == Approx(1.005).margin(0.001));
    CHECK(factor[2] == Approx(1.047).margin(0.002));
    auto found = computed(Nrel5mwVariant::beamdyn, Limited::tower, 8, 8);
    CHECK(largest(found, beamdyn, 0, 2) < 0.002);
    CHECK(largest(found, beamdyn, 2, 3) < 0.0025);
    for (Row& row : found)
        for (std::size_t k = 3; k < row.size(); ++k) row.at(k) *= k < 6 ? factor[0] : k < 8 ? factor[1] : factor[2];
    // At rest, for which the error of order 5 was computed, and in rotation, where a part of the stiffness is
    // centrifugal.
    const auto at_rest = std::array{found[0], beamdyn[0], beamdyn[0]},
               reference = std::array{beamdyn[0], beamdyn[0], beamdyn[0]};
    CHECK(largest(at_rest, reference, 3, 8) < 0.002);
    CHECK(largest(at_rest, reference, 8, 11) < 0.007);
    CHECK(largest(found, beamdyn, 3, 8) < 0.005);
    CHECK(largest(found, beamdyn, 8, 11) < 0.013);
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

}  // namespace cardan::testing::nrel5mw_openfast
