// Two blades have no constant multi-blade system: what is refused, and what serves instead.
#include "solvers/campbell/diagram.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "solvers/periodic/floquet.hpp"
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

SmallRotor rotor_of(std::size_t blades) {
    return small_rotor({.stiffness = std::vector<double>(blades, 2000.0), .damping = 5, .elastic_support = true});
}

LinearModel model_of(const SmallRotor& rotor, double speed, int azimuths = 24) {
    StateSpaceOptions options;
    options.spin = RotorSpin::prescribed;
    options.azimuths = azimuths;
    std::vector<LinearInput> inputs;
    for (std::size_t k = 0; k < rotor.map.blades.size(); ++k)
        inputs.push_back(
            LinearInput::generalised_force(text("blade ", k + 1, " flap moment"), {{rotor.map.blades[k][0], 1.0}}));
    return state_space(rotor.system, rotor.map, rotor.spinning(speed), inputs, {}, options);
}

}  // namespace

TEST_CASE("multi-blade model: one and two blades are refused, in rotation and at standstill", "[property]") {
    for (const std::size_t blades : {1U, 2U}) {
        const SmallRotor rotor = rotor_of(blades);
        for (const double speed : {0.0, 3.0}) {
            CAPTURE(blades, speed);
            const LinearModel model = model_of(rotor, speed);
            CHECK(model.blades == static_cast<int>(blades));
            check_refused([&] { (void)multi_blade(model, rotor.map); },
                          {"small rotor", text("number of blades = ", blades), "at least 3", "Floquet"});
            check_refused([&] { (void)multi_blade_states(model, rotor.map, 0.3); },
                          {text("number of blades = ", blades)});
        }
    }
}

TEST_CASE("multi-blade model: a model and a machine with different numbers of blades are refused", "[property]") {
    const SmallRotor two = rotor_of(2), three = rotor_of(3);
    const LinearModel of_two = model_of(two, 3), of_three = model_of(three, 3);
    check_refused([&] { (void)multi_blade(of_two, three.map); }, {"number of blades"});
    check_refused([&] { (void)multi_blade(of_three, two.map); }, {"number of blades"});
    CHECK_NOTHROW(multi_blade(of_three, three.map));
}

TEST_CASE("multi-blade model: why two blades are refused: their mean over the azimuth has other eigenvalues",
          "[crosscheck]") {
    // Eigenvalues of the mean of A in sums and differences of the blades lie far from the exponents of the machine;
    // with three blades they are the exponents.
    for (const std::size_t blades : {2U, 3U}) {
        const SmallRotor rotor = rotor_of(blades);
        const double Omega = 4;
        const Floquet exact =
            floquet(linearised(rotor.system, turning_undeflected(rotor.system, rotor.map.spin, Omega)));
        const LinearModel model = model_of(rotor, Omega);
        const std::vector<Complex> expected = exponents(exact);
        double largest = 0;
        if (blades == 2) {
            Matrix mean = Matrix::Zero(model.samples[0].A.rows(), model.samples[0].A.rows());
            for (const LinearSample& sample : model.samples)
                mean += sample.A / static_cast<double>(model.samples.size());
            // A constant change of coordinates (sum and difference) does not move eigenvalues.
            const Eigen::VectorXcd lambda = mean.eigenvalues();
            for (const Complex one : lambda) largest = std::max(largest, distance(one, expected, Omega));
            CHECK(largest > 1e-3);
        } else {
            for (const Complex one : multi_blade(model, rotor.map).poles())
                largest = std::max(largest, distance(one, expected, Omega));
            CHECK(largest < 1e-7);
        }
    }
}
