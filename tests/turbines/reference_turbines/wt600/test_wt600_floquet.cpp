// Coleman's transformation against Floquet's theory on the untransformed machine: equations linearised at every azimuth
// in blade coordinates, integrated over a third of a revolution.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/linear/linearise.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/teetered/periodic_modes.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

#include <numeric>

using namespace cardan;
using namespace cardan::testing;

namespace {

// Multipliers over a third of a revolution: after it blade k stands where blade k + 1 stood.
Eigen::VectorXcd multipliers(const turbines::Turbine& machine, const std::vector<int>& unknowns, double rotor_speed,
                             int steps) {
    const RotorMap& rotor = machine.rotor();
    solvers::SteadyOptions options;
    options.rotor_speed = rotor_speed;
    const auto steady = solvers::steady_state(machine.system(), rotor.spin, options);
    REQUIRE(steady.converged);
    const auto at_azimuth = [&](double psi) {
        DynamicState at = steady.at;
        at.q(rotor.spin) = psi;
        return solvers::restrict_to(solvers::linearise(machine.system(), at), unknowns, rotor.spin);
    };
    const auto n = std::ssize(unknowns);
    const double third = 2 * pi / (3 * rotor_speed), h = third / steps;
    const Radau radau;
    Matrix x = Matrix::Identity(2 * n, 2 * n);
    for (int i = 0; i < steps; ++i)
        radau.step(
            h, [&](Eigen::Index s) { return at_azimuth(rotor_speed * (i + radau.c(s)) * h); }, x);
    std::vector<Eigen::Index> from(static_cast<std::size_t>(2 * n));
    std::iota(from.begin(), from.end(), Eigen::Index{0});
    const auto row = [&](int coordinate) {
        return std::find(unknowns.begin(), unknowns.end(), coordinate) - unknowns.begin();
    };
    for (std::size_t i = 0; i < rotor.blades[0].size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto to = row(rotor.blades[(k + 1) % 3][i]), source = row(rotor.blades[k][i]);
            entry(from, to) = source;
            entry(from, to + n) = source + n;
        }
    const Matrix shifted = x(from, Eigen::all);
    return Eigen::EigenSolver<Matrix>(shifted, false).eigenvalues();
}

}  // namespace

TEST_CASE("Floquet: the untransformed 600 kW machine at 27 rpm has the modes that Coleman's transformation gives",
          "[property]") {
    const double rotor_speed = 27 * rpm, third = 2 * pi / (3 * rotor_speed);
    const turbines::Turbine machine = turbines::wt600(turbines::wt600_paper_assembly());
    const double speed[] = {rotor_speed};
    const auto coleman = solvers::campbell(machine.system(), machine.rotor(), speed);
    const Eigen::VectorXcd mu = multipliers(machine, coleman.unknowns, rotor_speed, 200);
    REQUIRE(coleman.points[0].modes.size() == 16);
    for (const solvers::CampbellMode& mode : coleman.points[0].modes) {
        const Complex lambda = mode.mode.eigenvalue, expected = std::exp(lambda * third);
        Eigen::Index at = 0;
        const double nearest = (mu.array() - expected).abs().minCoeff(&at);
        // Difference in frequency and in growth rate.
        const Complex difference = std::log(mu(at) / expected) / third;
        INFO(lambda.imag() / (2 * pi) << " Hz: " << difference << ", multiplier off by " << nearest);
        CHECK(std::abs(difference.imag()) / (2 * pi) < 1e-6);
        CHECK(std::abs(difference.real()) < 1e-5);
    }
    // No multiplier leaves the unit circle: the damped machine is stable. The free spin has a double one at 1.
    std::vector<double> size;
    for (const Complex& m : mu) size.push_back(std::abs(m));
    std::sort(size.begin(), size.end(), std::greater<>());
    CHECK(size[0] == Approx(1).margin(1e-5));
    CHECK(size[1] == Approx(1).margin(1e-5));
    CHECK(size[2] < 0.999);
}
