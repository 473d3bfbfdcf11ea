// The 600 kW machine with the elements it takes by default: one answer, within the error that is stated.
#include "tests/oracles/rotating_blade.hpp"
#include "tests/oracles/wt600_stations.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// The error from the change by twice as many elements, at second order and above.
constexpr double largest_error = 4. / 3 * turbines::MeshOptions{}.tolerance;

}  // namespace

TEST_CASE("600 kW machine: its default elements have the frequencies of another implementation's twelve, as stated",
          "[discrete]") {
    // Of docs/wt600.md, undamped, generator free, at rest and at 27 rpm, up to the second flap.
    struct Row {
        const char* branch;
        double at_0, at_27;
    };
    const turbines::Turbine machine = turbines::wt600({.structural_damping = false, .joint_damping = false});
    CHECK(machine.mesh().converged);
    CHECK(machine.mesh().modes >= 13);
    const solvers::Campbell d = solvers::campbell(machine.system(), machine.rotor(), solvers::rpm_range(0, 27, 3));
    for (const Row& row :
         {Row{"1st tower fore-aft", 0.71303, 0.70808}, Row{"1st tower side-side", 0.71756, 0.71842},
          Row{"rotor tilt", 1.27966, 0.99126}, Row{"rotor yaw", 1.33808, 1.75775},
          Row{"1st blade flap (collective)", 1.83502, 1.93675}, Row{"1st blade flap (backward)", 2.83426, 2.67642},
          Row{"1st blade flap (forward)", 2.95526, 3.14672}, Row{"1st blade edge (backward)", 3.59350, 3.30507},
          Row{"1st blade edge (forward)", 3.69970, 4.14114}, Row{"1st drive-train torsion", 4.51190, 4.51690},
          Row{"2nd tower fore-aft", 5.08516, 5.09226}, Row{"2nd tower side-side", 5.32896, 5.33359},
          Row{"2nd blade flap (collective)", 5.64307, 5.74444}}) {
        INFO(row.branch);
        CHECK(hz(d, row.branch, 0) == Approx(row.at_0).epsilon(largest_error));
        CHECK(hz(d, row.branch, 9) == Approx(row.at_27).epsilon(largest_error));
    }
}

TEST_CASE("600 kW machine: one number for library, command and program, 5.6394 Hz of the second collective flap",
          "[regression]") {
    // That of `cardan campbell wt600` and wt600_campbell, which tests/programs/wt600_campbell.cmake runs.
    const turbines::Turbine machine = turbines::wt600();
    const solvers::Campbell d = solvers::campbell(machine.system(), machine.rotor(), {0.0});
    CHECK(hz(d, "2nd blade flap (collective)", 0) == Approx(5.6394).margin(5e-5));
}

TEST_CASE("600 kW blade, isolated: its default elements are within the stated error of the exact rod", "[analytic]") {
    const oracles::RotatingBlade rod(oracles::wt600_stations(), 1.5, 6);
    const turbines::Turbine blade = turbines::isolated_blade(turbines::wt600_description());
    for (const double speed : {0.0, 27 * rpm}) {
        const Eigen::VectorXd exact = rod.modes(speed, 3).frequency;
        const std::vector<double> f = frequencies(blade, speed);
        for (Eigen::Index i = 0; i < 3; ++i) CHECK(entry(f, i) == Approx(exact(i)).epsilon(largest_error));
    }
}
