// Mean of the multi-blade system over the azimuth, about the periodic steady state under gravity.
#include "mbs/base/units.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "solvers/periodic/azimuth_average.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

turbines::Turbine heavy(int elements, double gravity) {
    turbines::AssemblyOptions options = undamped(elements);
    options.structural_damping = true;
    options.gravity = {0, 0, -gravity};
    return turbines::wt600(options);
}

solvers::AzimuthAverageOptions at(double rotor_speed, int azimuths = 24) {
    solvers::AzimuthAverageOptions options;
    options.rotor_speed = rotor_speed;
    options.azimuths = azimuths;
    return options;
}

std::vector<double> hertz(const solvers::AzimuthAverage& mean) {
    std::vector<double> f;
    for (const solvers::Mode& mode : solvers::modes(mean.system)) f.push_back(mode.natural_hz());
    return f;
}

}  // namespace

TEST_CASE("azimuth average: without gravity nothing depends on the azimuth and the modes are the Campbell diagram's",
          "[crosscheck]") {
    const turbines::Turbine machine = turbines::wt600(undamped(2));
    solvers::CampbellOptions locked;
    locked.spin = solvers::RotorSpin::prescribed;
    for (double speed : {0.0, 27 * rpm}) {
        const auto mean = solvers::azimuth_average(machine.system(), machine.rotor(), at(speed, 5));
        CHECK(mean.remainder < 1e-9);
        const auto expected = frequencies(machine, speed, locked), found = hertz(mean);
        for (std::size_t i = 0; i < expected.size(); ++i) CHECK(found.at(i) == Approx(expected[i]).epsilon(1e-8));
    }
}

TEST_CASE("azimuth average: under gravity its modes are the poles of the averaged linear model but for second order",
          "[crosscheck]") {
    // The linear model's mean is that of the state matrix M^-1 K instead of M and K.
    const double speed = 27 * rpm;
    const auto difference = [&](double gravity) {
        const turbines::Turbine machine = heavy(1, gravity);
        const auto mean = solvers::azimuth_average(machine.system(), machine.rotor(), at(speed, 12));
        solvers::PeriodicOptions periodic;
        periodic.rotor_speed = speed;
        periodic.harmonics = 4;
        const auto state = solvers::harmonic_balance(machine.system(), machine.rotor().spin, periodic);
        solvers::StateSpaceOptions options;
        options.azimuths = 12;
        options.spin = solvers::RotorSpin::prescribed;
        const auto model = solvers::multi_blade(
            solvers::state_space(machine.system(), machine.rotor(), state, {}, {}, options), machine.rotor());
        const std::vector<Complex> poles = model.poles();
        double largest = 0;
        for (const solvers::Mode& mode : solvers::modes(mean.system)) {
            if (mode.natural_hz() > 5) break;
            double nearest = 1;
            for (const Complex& pole : poles)
                nearest = std::min(nearest, std::abs(pole - mode.eigenvalue) / std::abs(pole));
            largest = std::max(largest, nearest);
        }
        return largest;
    };
    const double full = difference(units::standard_gravity), half = difference(units::standard_gravity / 2);
    CHECK(full < 6e-3);
    CHECK(half / full == Approx(0.25).epsilon(0.1));
}

TEST_CASE("azimuth average: the nearest mode of a mode is itself", "[property]") {
    const turbines::Turbine machine = turbines::wt600(undamped(1));
    const auto mean = solvers::azimuth_average(machine.system(), machine.rotor(), at(27 * rpm, 3));
    const auto modes = solvers::modes(mean.system);
    for (std::size_t i = 0; i < 10; ++i) {
        const auto nearest = solvers::nearest_mode(mean.system, modes, modes[i]);
        CHECK(nearest.index == i);
        CHECK(nearest.mac == Approx(1).epsilon(1e-9));
    }
    check_refused([&] { (void)solvers::nearest_mode(mean.system, {}, modes[0]); }, {"number of modes = 0"});
    check_refused([&] { (void)solvers::azimuth_average(machine.system(), machine.rotor(), at(27 * rpm, 2)); },
                  {"number of azimuths = 2", ">= 3"});
}
