// Coleman's transformation against Floquet's theory on the untransformed machine: equations linearised at every azimuth
// in blade coordinates, integrated over a third of a revolution.
#include "mbs/decompositions.hpp"
#include "solvers/linearise.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/test_wt600.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// Radau IIA of order 5 for M q'' + C q' + K q = 0, matrices given at the stages: L-stable, so the stiff modes of the
// chain die out. State (q, q'), one column per initial value.      [Hairer and Wanner, Solving ODEs II, table IV.5.6]
struct Radau {
    Eigen::Matrix3d A;
    Vec3 c;
    Radau() {
        const double r = std::sqrt(6.0);
        A << (88 - 7 * r) / 360, (296 - 169 * r) / 1800, (-2 + 3 * r) / 225,  //
            (296 + 169 * r) / 1800, (88 + 7 * r) / 360, (-2 - 3 * r) / 225,   //
            (16 - r) / 36, (16 + r) / 36, 1. / 9;
        c << (4 - r) / 10, (4 + r) / 10, 1;
    }
    /// @param at  at(i): the system at stage i
    template <class Stage>
    void step(double h, const Stage& at, Matrix& x) const {
        const Eigen::Index n = x.rows() / 2;
        const Eigen::Matrix3d AA = A * A;
        const auto q = x.topRows(n), v = x.bottomRows(n);
        Matrix left(3 * n, 3 * n), right(3 * n, x.cols());
        for (Eigen::Index i = 0; i < 3; ++i) {
            const solvers::SecondOrderSystem s = at(i);
            for (Eigen::Index j = 0; j < 3; ++j)
                left.block(i * n, j * n, n, n) =
                    (i == j ? s.M : Matrix::Zero(n, n)) + h * A(i, j) * s.C + h * h * AA(i, j) * s.K;
            right.middleRows(i * n, n) = -s.C * v - s.K * (q + c(i) * h * v);
        }
        const Matrix a = left.partialPivLu().solve(right);  // accelerations at the stages
        const Matrix q_end =
            q + h * v + h * h * (AA(2, 0) * a.topRows(n) + AA(2, 1) * a.middleRows(n, n) + AA(2, 2) * a.bottomRows(n));
        x.bottomRows(n) += h * (A(2, 0) * a.topRows(n) + A(2, 1) * a.middleRows(n, n) + A(2, 2) * a.bottomRows(n));
        x.topRows(n) = q_end;
    }
};

// Multipliers over a third of a revolution: after it blade k stands where blade k + 1 stood.
Eigen::VectorXcd multipliers(const turbines::Turbine& machine, const std::vector<int>& unknowns, double rotor_speed,
                             int steps) {
    const RotorMap& rotor = machine.rotor();
    solvers::SteadyOptions options;
    options.rotor_speed = rotor_speed;
    const auto steady = solvers::steady_state(machine.system(), rotor.spin, options);
    REQUIRE(steady.converged);
    const auto at_azimuth = [&](double psi) {
        solvers::OperatingPoint at = steady.at;
        at.q(rotor.spin) = psi;
        return solvers::restrict_to(solvers::linearise(machine.system(), at), unknowns, rotor.spin);
    };
    const auto n = static_cast<Eigen::Index>(unknowns.size());
    const double third = 2 * pi / (3 * rotor_speed), h = third / steps;
    const Radau radau;
    Matrix x = Matrix::Identity(2 * n, 2 * n);
    for (int i = 0; i < steps; ++i)
        radau.step(
            h, [&](Eigen::Index s) { return at_azimuth(rotor_speed * (i + radau.c(s)) * h); }, x);
    std::vector<Eigen::Index> from(static_cast<std::size_t>(2 * n));
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<Eigen::Index>(i);
    const auto row = [&](int coordinate) {
        return std::find(unknowns.begin(), unknowns.end(), coordinate) - unknowns.begin();
    };
    for (std::size_t i = 0; i < rotor.blades[0].size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto to = row(rotor.blades[(k + 1) % 3][i]), source = row(rotor.blades[k][i]);
            from[static_cast<std::size_t>(to)] = source;
            from[static_cast<std::size_t>(to + n)] = source + n;
        }
    const Matrix shifted = x(from, Eigen::all);
    return Eigen::EigenSolver<Matrix>(shifted, false).eigenvalues();
}

}  // namespace

TEST_CASE("Floquet: the untransformed 600 kW machine at 27 rpm has the modes that Coleman's transformation gives",
          "[property]") {
    const double rotor_speed = 27 * rpm, third = 2 * pi / (3 * rotor_speed);
    const turbines::Turbine machine = turbines::wt600();
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
