// The four partitions on two blades with few elements: errors of the first two flap and edge modes, at rest and at
// rated speed. The tables of docs/partitions.md are these numbers.
#include "elements/cardan_beam/centrifugal_limit.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/oracles/rotating_blade.hpp"
#include "tests/oracles/wt600_stations.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/nrel5mw/test_nrel5mw_blade.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <limits>

namespace cardan::testing::blade_partitions {

namespace {

constexpr auto segment = Partition::segment_masses, moments = Partition::static_moment,
               gauss = Partition::compliance_gauss, mean = Partition::mean_difference;
const std::array<std::string, 4> modes{"1st blade flap", "1st blade edge", "2nd blade flap", "2nd blade edge"};

using Errors = std::array<double, 4>;  // %, in the order of the modes

struct Row {
    Partition partition;
    int elements;
    Errors rest, rated;
};

// Against the geometrically exact rod.
const std::vector<Row> wt600_blade{
    {segment, 1, {-51.319, -25.277, -42.250, -28.312}, {-40.849, -24.296, -38.254, -27.849}},
    {segment, 2, {-7.170, -2.074, -3.994, -9.770}, {-5.416, -1.936, -3.548, -9.705}},
    {segment, 3, {-1.209, -0.370, -5.526, -6.572}, {-0.854, -0.324, -4.977, -6.429}},
    {segment, 4, {-0.319, -0.099, -2.446, -1.053}, {-0.194, -0.080, -2.174, -1.039}},
    {segment, 8, {-0.015, -0.006, -0.155, -0.153}, {0.004, -0.002, -0.118, -0.152}},
    {moments, 1, {-62.857, -35.046, -71.548, -66.628}, {-48.087, -34.033, -69.513, -66.392}},
    {moments, 2, {-6.540, -0.681, -51.118, -34.061}, {-5.491, -0.537, -49.366, -34.063}},
    {moments, 3, {-0.781, -0.406, -19.018, -6.993}, {-0.693, -0.375, -18.688, -7.033}},
    {moments, 4, {-0.214, -0.097, -5.024, -3.349}, {-0.193, -0.093, -4.937, -3.426}},
    {moments, 8, {-0.012, -0.006, -0.217, -0.285}, {-0.011, -0.006, -0.213, -0.303}},
    {gauss, 1, {-9.076, 8.859, 201.609, 365.145}, {-5.115, 9.753, 198.893, 363.744}},
    {gauss, 2, {0.451, 0.812, -10.535, -8.011}, {0.871, 0.950, -9.527, -7.917}},
    {gauss, 3, {0.211, 0.198, -3.154, -0.073}, {0.320, 0.233, -2.636, -0.058}},
    {gauss, 4, {0.079, 0.072, -0.602, -0.421}, {0.137, 0.088, -0.416, -0.447}},
    {gauss, 8, {0.006, 0.006, 0.006, -0.005}, {0.022, 0.010, 0.035, 0.001}},
    {mean, 1, {6.604, 29.253, -36.096, 7.405}, {10.577, 30.745, -42.013, 6.416}},
    {mean, 2, {0.707, 0.972, 0.033, 0.024}, {1.082, 1.068, 0.826, 0.128}},
    {mean, 3, {0.157, 0.185, -0.864, 1.390}, {0.206, 0.203, -0.425, 1.482}},
    {mean, 4, {0.052, 0.063, -0.188, -0.078}, {0.064, 0.068, -0.070, -0.087}},
    {mean, 8, {0.004, 0.006, 0.010, -0.004}, {0.005, 0.006, 0.014, -0.005}},
};

// Against the exact frequencies to 1e-4 Hz, which is 0.015, 0.009, 0.005, 0.0025 %. Static moments with a last element
// of 1 m.
const std::vector<Row> nrel5mw_blade{
    {segment, 1, {-76.436, -43.395, -41.305, -34.528}, {-51.963, -41.099, -35.331, -33.301}},
    {segment, 2, {-31.245, -5.852, -15.718, -16.277}, {-18.252, -5.411, -11.673, -15.910}},
    {segment, 3, {-8.078, -1.184, -19.546, -9.107}, {-4.684, -1.029, -16.124, -8.294}},
    {segment, 4, {-2.346, -0.329, -11.044, 1.387}, {-1.443, -0.290, -9.184, 2.270}},
    {segment, 8, {-0.094, -0.009, -0.782, -0.438}, {-0.049, -0.010, -0.677, -0.380}},
    {moments, 1, {-77.550, -45.420, -74.225, -70.049}, {-46.955, -40.797, -70.843, -69.625}},
    {moments, 2, {-58.370, -30.536, -69.390, -66.090}, {-43.806, -29.223, -66.917, -65.742}},
    {moments, 3, {-6.917, -2.112, -39.643, -28.732}, {-5.661, -1.976, -38.401, -28.699}},
    {moments, 4, {-0.986, -0.347, -13.001, -5.078}, {-0.808, -0.365, -12.636, -5.109}},
    {moments, 8, {-0.025, -0.009, -0.295, -0.225}, {-0.027, -0.016, -0.290, -0.215}},
    {gauss, 1, {-12.313, 13.410, 975.714, 1126.571}, {-5.871, 15.192, 947.306, 1120.312}},
    {gauss, 2, {0.566, 1.196, -11.533, -7.028}, {1.497, 1.306, -9.900, -6.810}},
    {gauss, 3, {0.612, 0.254, -3.941, -0.690}, {0.683, 0.292, -3.045, -0.479}},
    {gauss, 4, {0.176, 0.094, -0.234, -0.833}, {0.232, 0.110, -0.017, -0.541}},
    {gauss, 8, {0.014, 0.012, 0.078, 0.031}, {0.031, 0.012, 0.115, 0.039}},
    {mean, 1, {2.504, 40.070, -46.215, 9.383}, {-6.240, 43.478, -51.513, 7.661}},
    {mean, 2, {0.774, 1.191, -6.783, 1.418}, {1.692, 1.301, -9.516, 1.730}},
    {mean, 3, {0.517, 0.238, -2.158, 2.805}, {0.537, 0.274, -1.422, 2.076}},
    {mean, 4, {0.150, 0.083, 0.009, -0.310}, {0.145, 0.093, 0.124, -0.127}},
    {mean, 8, {0.014, 0.011, 0.087, 0.034}, {0.009, 0.009, 0.086, 0.039}},
};

Errors errors(const solvers::Campbell& d, std::size_t point, const Errors& exact) {
    Errors e{};
    for (std::size_t k = 0; k < 4; ++k) e.at(k) = 100 * (d.natural_hz(d.branch(modes.at(k)), point) / exact.at(k) - 1);
    return e;
}

solvers::Campbell both_speeds(const System& system, const RotorMap& rotor, double rated) {
    solvers::CampbellOptions options;
    options.max_frequency_hz = 60;
    const double at[] = {0, rated};
    return solvers::campbell(system, rotor, at, options);
}

void check(const Row& row, const solvers::Campbell& d, const Errors& exact_rest, const Errors& exact_rated) {
    const Errors rest = errors(d, 0, exact_rest), rated = errors(d, 1, exact_rated);
    for (std::size_t k = 0; k < 4; ++k) {
        CAPTURE(partition_name(row.partition), row.elements, modes.at(k));
        CHECK(rest.at(k) == Approx(row.rest.at(k)).margin(6e-4).epsilon(1e-4));
        CHECK(rated.at(k) == Approx(row.rated.at(k)).margin(6e-4).epsilon(1e-4));
    }
}

const Row& row_of(const std::vector<Row>& table, Partition partition, int elements) {
    for (const Row& row : table)
        if (row.partition == partition && row.elements == elements) return row;
    throw Error("no such row");
}

// Largest of both speeds, %.
double worst(const std::vector<Row>& table, Partition partition, int elements, std::size_t mode) {
    const Row& row = row_of(table, partition, elements);
    return std::max(std::abs(row.rest.at(mode)), std::abs(row.rated.at(mode)));
}

turbines::Turbine wt600_isolated(Partition partition, int elements) {
    turbines::AssemblyOptions options = turbines::wt600_paper_assembly(elements);
    options.partition = partition;
    options.structural_damping = false;
    if (partition == moments) options.delta = 1. / 6;
    return turbines::isolated_blade(turbines::wt600_description(), options);
}

}  // namespace

TEST_CASE("600 kW blade: errors of the four partitions with 1, 2, 3, 4 and 8 elements", "[analytic]") {
    const oracles::RotatingBlade rod(oracles::wt600_stations(), 1.5, 6);
    const auto exact = [&](double speed) {
        const Eigen::VectorXd f = rod.modes(speed, 5).frequency;  // flap 3 comes before edge 2
        return Errors{f(0), f(1), f(2), f(4)};
    };
    const Errors rest = exact(0), rated = exact(27 * rpm);
    for (const Row& row : wt600_blade) {
        const turbines::Turbine blade = wt600_isolated(row.partition, row.elements);
        check(row, both_speeds(blade.system(), blade.rotor(), 27 * rpm), rest, rated);
    }
}

TEST_CASE("NREL 5 MW blade: errors of the four partitions with 1, 2, 3, 4 and 8 elements", "[analytic]") {
    const Errors rest{0.6772, 1.0855, 1.9516, 3.9962}, rated{0.7288, 1.0936, 2.0105, 4.0173};
    for (const Row& row : nrel5mw_blade) {
        const auto blade = turbines::isolated_blade(turbines::nrel5mw_blade(),
                                                    turbines::nrel5mw_blade_elements(row.elements, row.partition));
        check(row, both_speeds(blade.system(), blade.rotor(), 12.1 * rpm), rest, rated);
    }
}

TEST_CASE("mean differences: with two to four elements nearer than segment masses in every mode of both blades",
          "[property]") {
    for (const auto& table : {wt600_blade, nrel5mw_blade})
        for (int n : {2, 3, 4})
            for (std::size_t mode = 0; mode < 4; ++mode) {
                CAPTURE(n, modes.at(mode));
                const Row &s = row_of(table, segment, n), &m = row_of(table, mean, n);
                // The least gain: edge 1 of the 600 kW blade, N = 4, rotating, 0.068 against -0.080 %.
                CHECK(std::abs(m.rest.at(mode)) < 0.9 * std::abs(s.rest.at(mode)));
                CHECK(std::abs(m.rated.at(mode)) < 0.9 * std::abs(s.rated.at(mode)));
                if (mode % 2 == 0) CHECK(worst(table, mean, n, mode) < 0.83 * worst(table, segment, n, mode));
                if (mode == 0) CHECK(worst(table, mean, n, mode) < 0.25 * worst(table, segment, n, mode));
            }
}

TEST_CASE(
    "mean differences: with eight elements nearer than segment masses in second modes, no worse than 0.015 % in "
    "first ones",
    "[property]") {
    for (const auto& table : {wt600_blade, nrel5mw_blade}) {
        for (std::size_t mode : {2u, 3u}) CHECK(worst(table, mean, 8, mode) < 0.15 * worst(table, segment, 8, mode));
        for (std::size_t mode : {0u, 1u}) CHECK(worst(table, mean, 8, mode) < 0.015);
    }
}

TEST_CASE("compliance Gauss points: first modes within 1.5 % with two elements; second ones take four", "[property]") {
    for (const auto& table : {wt600_blade, nrel5mw_blade}) {
        for (std::size_t mode : {0u, 1u}) {
            CHECK(worst(table, gauss, 2, mode) < 1.5);
            CHECK(worst(table, gauss, 2, mode) < 0.5 * worst(table, segment, 2, mode));
        }
        CHECK(worst(table, gauss, 2, 2) > 10);
        for (std::size_t mode : {2u, 3u}) CHECK(worst(table, gauss, 4, mode) < 0.85);
    }
    // Not always better: second flap of the 600 kW blade in two elements.
    CHECK(worst(wt600_blade, gauss, 2, 2) > 2.5 * worst(wt600_blade, segment, 2, 2));
}

TEST_CASE("NREL 5 MW blade: torsion converges from above and faster with the polar inertia cut at the torsion centre",
          "[property]") {
    const auto error = [](Partition partition, int elements) {
        const auto blade =
            turbines::isolated_blade(turbines::nrel5mw_blade(), turbines::nrel5mw_blade_elements(elements, partition));
        const solvers::Campbell d = both_speeds(blade.system(), blade.rotor(), 1);
        return 100 * (d.natural_hz(d.branch("1st blade torsion"), 0) / 5.4709 - 1);
    };
    for (const auto& [elements, half, centre] : std::vector<std::tuple<int, double, double>>{
             {2, -47.0, 17.8}, {3, -22.9, 6.2}, {4, -12.6, 1.2}, {8, -2.6, 0.2}}) {
        CHECK(error(segment, elements) == Approx(half).margin(0.06));
        CHECK(error(mean, elements) == Approx(centre).margin(0.06));
    }
}

namespace {

// Rotor speed at which the least eigenvalue of the stiffness about the steady state of the blade, twist and offsets
// included, passes zero, or where it turns before it gets there: loads off the axis bend the blade instead, as they
// bend a column next to its buckling load. rad/s; each state is sought from the one before.
double divergence(const System& system, const RotorMap& rotor, double about) {
    Vector last;
    double before = std::numeric_limits<double>::infinity();
    constexpr double step = 1e-3;
    for (double share = 0.93; share < 1.1; share += step) {
        solvers::SteadyOptions options;
        options.rotor_speed = share * about;
        options.initial = last;
        const solvers::SteadyState steady = solvers::steady_state(system, rotor.spin, options);
        REQUIRE(steady.converged);
        last = steady.at.q;
        const Matrix K = solvers::restrict_to(solvers::linearise(system, steady.at), rotor.blades.at(0)).K;
        const double min = Eigen::SelfAdjointEigenSolver<Matrix>((K + K.transpose()) / 2).eigenvalues()(0);
        if (min < 0) return (share + step * min / (before - min)) * about;
        if (min > before) return (share - step) * about;
        before = min;
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace

TEST_CASE(
    "NREL 5 MW blade: centrifugal limit of the mean differences within 3.7 % of the divergence of the blade; none of "
    "true segments",
    "[crosscheck]") {
    const turbines::Nrel5mwBlade blade = turbines::nrel5mw_blade();
    const auto isolated = [&](Partition partition, int elements) {
        return turbines::isolated_blade(blade, turbines::nrel5mw_blade_elements(elements, partition));
    };
    for (const auto& [elements, expected] :
         std::vector<std::pair<int, double>>{{2, 2.607}, {3, 4.005}, {4, 5.610}, {8, 12.630}}) {
        const auto built = isolated(mean, elements);
        const double limit = centrifugal_limit(built.layout().blades.front(), blade.root_radius),
                     exact = divergence(built.system(), built.rotor(), limit);
        CAPTURE(elements, limit / exact);
        CHECK(limit == Approx(exact).epsilon(0.037));
        CHECK(exact / (12.1 * rpm) == Approx(expected).epsilon(1.5e-3));
        for (const Partition partition : {gauss, segment})
            CHECK(std::isinf(
                centrifugal_limit(isolated(partition, elements).layout().blades.front(), blade.root_radius)));
    }
}

TEST_CASE("static moments on equal elements of the 5 MW blade: the last one is refused up to 32 of them",
          "[property]") {
    const auto build = [](int elements) {
        CardanBeamOptions equal = turbines::nrel5mw_blade_elements(elements);
        equal.partition = moments;
        equal.delta = 1. / 6;
        (void)turbines::isolated_blade(turbines::nrel5mw_blade(), equal);
    };
    check_refused([&] { build(16); }, {"NREL 5 MW blade, element at 57.65625 m",
                                       "moment of inertia left for the middle bodies [kg m^2] = -23.88",
                                       "allowed: >= 0", "take another partition"});
    check_refused([&] { build(32); }, {"element at 59.578125 m", "= -0.00197958"});
    CHECK_NOTHROW(build(33));
    CHECK_NOTHROW(build(1));
}

}  // namespace cardan::testing::blade_partitions
