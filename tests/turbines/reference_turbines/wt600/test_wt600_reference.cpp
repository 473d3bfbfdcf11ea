// The 600 kW machine against numbers of an independent implementation of the same element and assembly (its matrices,
// its Coleman transformation; its Floquet analysis of the untransformed equations agreed with it to 1e-5 Hz).
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// Undamped, generator free, fixed frame, Hz. Frequencies with 3 elements in blades and tower, and with 12.
struct Row {
    const char* branch;
    double n3_at_0, n3_at_27, n12_at_0, n12_at_27;
};
constexpr Row rows[] = {
    {"1st tower fore-aft", 0.71287, 0.70787, 0.71303, 0.70808},
    {"1st tower side-side", 0.71746, 0.71832, 0.71756, 0.71842},
    {"rotor tilt", 1.27448, 0.98685, 1.27966, 0.99126},
    {"rotor yaw", 1.33211, 1.75505, 1.33808, 1.75775},
    {"1st blade flap (collective)", 1.81179, 1.91914, 1.83502, 1.93675},
    {"1st blade flap (backward)", 2.79624, 2.64612, 2.83426, 2.67642},
    {"1st blade flap (forward)", 2.91323, 3.11641, 2.95526, 3.14672},
    {"1st blade edge (backward)", 3.56751, 3.26378, 3.59350, 3.30507},
    {"1st blade edge (forward)", 3.64960, 4.10945, 3.69970, 4.14114},
    {"1st drive-train torsion", 4.50637, 4.51226, 4.51190, 4.51690},
    {"2nd tower fore-aft", 5.04068, 5.06481, 5.08516, 5.09226},
    {"2nd tower side-side", 5.29785, 5.31461, 5.32896, 5.33359},
    {"2nd blade flap (collective)", 5.38828, 5.48565, 5.64307, 5.74444},
    {"1st blade edge (collective)", 8.34543, 8.38335, 8.44514, 8.48063},
};
constexpr double last_digit = 1e-5;

// The wrong sign of the twist: every section mirrored in the plane of rotation, z -> -z.
turbines::TurbineDescription with_wrong_twist() {
    turbines::TurbineDescription d = turbines::wt600_description();
    d.blade.line.section = [right = d.blade.line.section](double x) {
        BeamSection s = right(x);
        const Vec3 place(1, 1, -1);
        const Vec6 load = (Vec6() << 1, 1, -1, -1, -1, 1).finished();
        s.compliance = load.asDiagonal() * s.compliance * load.asDiagonal();
        s.centre = place.asDiagonal() * s.centre;
        s.J = place.asDiagonal() * s.J * place.asDiagonal();
        return s;
    };
    return d;
}

}  // namespace

TEST_CASE("600 kW machine: fourteen modes with three elements, to the digit, at 0 and 27 rpm", "[discrete]") {
    const turbines::Turbine machine = turbines::wt600(undamped(3));
    const solvers::Campbell d = solvers::campbell(machine.system(), machine.rotor(), solvers::rpm_range(0, 27, 1));
    for (const Row& row : rows) {
        INFO(row.branch);
        CHECK(hz(d, row.branch, 0) == Approx(row.n3_at_0).margin(last_digit).epsilon(0));
        CHECK(hz(d, row.branch, 27) == Approx(row.n3_at_27).margin(last_digit).epsilon(0));
    }
}

TEST_CASE("600 kW machine: the same fourteen modes with twelve elements, to the digit", "[discrete]") {
    const turbines::Turbine machine = turbines::wt600(undamped(12));
    // Twelve elements at two speeds only, so rows are told apart by order; the second flap pair lies above row 13.
    const std::vector<double> at_0 = frequencies(machine, 0), at_27 = frequencies(machine, 27 * rpm);
    std::vector<double> expected_0, expected_27;
    for (const Row& row : rows) expected_0.push_back(row.n12_at_0), expected_27.push_back(row.n12_at_27);
    std::sort(expected_0.begin(), expected_0.end());
    std::sort(expected_27.begin(), expected_27.end());
    REQUIRE(at_0.size() == 16);
    REQUIRE(at_27.size() == 16);
    for (std::size_t i = 0; i < 14; ++i) {
        const std::size_t at = i < 13 ? i : 15;
        CHECK(at_0[at] == Approx(expected_0[i]).margin(last_digit).epsilon(0));
        CHECK(at_27[at] == Approx(expected_27[i]).margin(last_digit).epsilon(0));
    }
}

TEST_CASE("600 kW blade, isolated: three elements give flap and lag to four digits at 0 and 27 rpm", "[discrete]") {
    const turbines::Turbine blade = turbines::isolated_blade(turbines::wt600_description(), undamped(3));
    const std::vector<double> at_0 = frequencies(blade, 0), at_27 = frequencies(blade, 27 * rpm);
    const double expected_0[] = {1.7636, 3.4433, 5.2333}, expected_27[] = {1.8676, 3.4600, 5.3661};
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(at_0.at(i) == Approx(expected_0[i]).margin(1e-4).epsilon(0));
        CHECK(at_27.at(i) == Approx(expected_27[i]).margin(1e-4).epsilon(0));
    }
}

TEST_CASE("600 kW machine: a gearbox that spun with the high-speed shaft's twist alone would raise drive-train torsion",
          "[discrete]") {
    // The gearbox turns with generator plus twist, so its armature couples both; on the diagonal alone 4.5406 Hz.
    const turbines::Turbine machine = turbines::wt600(undamped(3));
    const CoordinateTable& table = machine.system().model.coordinates();
    const Vector zero = Vector::Zero(table.size());
    solvers::Linearisation lin = solvers::linearise(machine.system(), at_rest(zero));
    const int generator = table.index("generator azimuth"), twist = table.index("high-speed shaft twist");
    const auto torsion = [&] {
        const solvers::ColemanTransform coleman(machine.rotor(), table.free());
        const auto own = solvers::restrict_to(lin, table.free(), machine.rotor().spin);
        return solvers::modes(coleman.transform(own, 0, 0)).at(9).natural_hz();
    };
    CHECK(torsion() == Approx(4.5064).margin(5e-5).epsilon(0));
    constexpr double gearbox = 1500;
    lin.mass(generator, generator) -= gearbox;
    lin.mass(generator, twist) -= gearbox;
    lin.mass(twist, generator) -= gearbox;
    CHECK(torsion() == Approx(4.5406).margin(5e-5).epsilon(0));
}

TEST_CASE("600 kW machine: twist of the wrong sign moves a mode by 2.6e-3 Hz, but none of the isolated blade",
          "[property]") {
    const turbines::TurbineDescription right = turbines::wt600_description(), wrong = with_wrong_twist();
    const auto largest = [](const std::vector<double>& a, const std::vector<double>& b) {
        REQUIRE(a.size() == b.size());
        double difference = 0;
        for (std::size_t i = 0; i < a.size(); ++i) difference = std::max(difference, std::abs(a[i] - b[i]));
        return difference;
    };
    CHECK(largest(frequencies(turbines::assemble(right, undamped()), 0),
                  frequencies(turbines::assemble(wrong, undamped()), 0)) == Approx(2.6e-3).margin(5e-5));
    CHECK(largest(frequencies(turbines::isolated_blade(right, undamped()), 27 * rpm),
                  frequencies(turbines::isolated_blade(wrong, undamped()), 27 * rpm)) < 1e-12);
}
