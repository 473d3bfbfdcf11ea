// Complex modes of second-order systems against closed forms.
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

#include <numeric>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

SecondOrderSystem system_of(const Matrix& M, const Matrix& C, const Matrix& K) {
    std::vector<int> rows(static_cast<std::size_t>(M.rows()));
    std::iota(rows.begin(), rows.end(), 0);
    return {M, C, K, K, rows, -1};
}

SecondOrderSystem oscillator(double m, double omega, double zeta) {
    return system_of(Matrix::Constant(1, 1, m), Matrix::Constant(1, 1, 2 * zeta * omega * m),
                     Matrix::Constant(1, 1, omega * omega * m));
}

Matrix random_positive(Random& random, Eigen::Index n) {
    const Matrix A = random_matrix(random, n, n);
    return A * A.transpose() + 0.3 * Matrix::Identity(n, n);
}

// Residual of the quadratic eigenproblem beside the size of its terms.
double residual(const SecondOrderSystem& s, const Mode& mode) {
    const Complex l = mode.eigenvalue;
    const ComplexVector inertia = l * l * (s.M * mode.shape), damping = l * (s.C * mode.shape),
                        stiffness = s.K * mode.shape;
    return (inertia + damping + stiffness).norm() / (inertia.norm() + damping.norm() + stiffness.norm());
}

double error(Complex computed, Complex exact) {
    return std::abs(computed - exact) / std::abs(exact);
}

}  // namespace

TEST_CASE("modes: soft and stiff springs of any ratio are all found, the soft ones to working precision",
          "[analytic]") {
    for (const double ratio : {1e6, 1e13, 1e15, 1e20}) {
        SecondOrderSystem s;
        s.M = Matrix::Identity(2, 2);
        s.C = Matrix::Zero(2, 2);
        s.K = s.K_elastic = Vec3(1, ratio, 0).head<2>().asDiagonal().toDenseMatrix();
        const std::vector<Mode> found = modes(s);
        CAPTURE(ratio);
        REQUIRE(found.size() >= 1);
        CHECK(found[0].eigenvalue.imag() == Approx(1).epsilon(1e-13));
    }
}

TEST_CASE("modes: a damped oscillator has lambda = omega (-zeta +- i sqrt(1 - zeta^2))", "[analytic]") {
    const double m = 2.5, omega = 3;
    for (const double zeta : {0.0, 1e-4, 0.2, 0.9, 1 - 1e-6}) {
        CAPTURE(zeta);
        const std::vector<Mode> found = modes(oscillator(m, omega, zeta));
        REQUIRE(found.size() == 1);
        CHECK(found[0].oscillates());
        CHECK(error(found[0].eigenvalue, omega * Complex(-zeta, std::sqrt(1 - zeta * zeta))) < 1e-10);
        CHECK(found[0].natural_hz() == Approx(omega / (2 * pi)).epsilon(1e-12));
        CHECK(found[0].damped_hz() == Approx(omega / (2 * pi) * std::sqrt(1 - zeta * zeta)).epsilon(1e-8));
        CHECK(found[0].damping_ratio() == Approx(zeta).epsilon(1e-12).margin(1e-14));
        // Unit modal energy: (k + |lambda|^2 m) |x|^2 = 2, where |lambda| = omega.
        CHECK(std::norm(found[0].shape(0)) == Approx(1 / (m * omega * omega)).epsilon(1e-12));
    }
}

TEST_CASE("modes: an overdamped oscillator has two aperiodic modes, the slow one first", "[analytic]") {
    const double omega = 3;
    for (const double zeta : {1 + 1e-6, 1.5, 40.0}) {
        CAPTURE(zeta);
        const std::vector<Mode> found = modes(oscillator(2.5, omega, zeta));
        REQUIRE(found.size() == 2);
        const double root = std::sqrt(zeta * zeta - 1);
        CHECK(error(found[0].eigenvalue, -omega / (zeta + root)) < 1e-10);
        CHECK(error(found[1].eigenvalue, -omega * (zeta + root)) < 1e-10);
        for (const Mode& mode : found) {
            CHECK_FALSE(mode.oscillates());
            CHECK(mode.damping_ratio() == Approx(1).epsilon(1e-15));
        }
    }
}

TEST_CASE("modes: a point mass on springs seen from a turntable oscillates at |omega0 +- Omega|", "[analytic]") {
    // x'' + 2 Omega e_z x x' + (omega0^2 - Omega^2) x = 0; the stiffness turns negative above the critical speed.
    const double omega0 = 2;
    const Matrix one = Matrix::Identity(2, 2);
    for (const double Omega : {0.3, 1.9, 2.5, 7.0}) {
        CAPTURE(Omega);
        const Matrix G = 2 * Omega * (Matrix(2, 2) << 0, -1, 1, 0).finished();
        SecondOrderSystem s = system_of(one, G, (omega0 * omega0 - Omega * Omega) * one);
        s.K_elastic = omega0 * omega0 * one;
        const std::vector<Mode> found = modes(s);
        REQUIRE(found.size() == 2);
        CHECK(error(found[0].eigenvalue, Complex(0, std::abs(omega0 - Omega))) < 1e-12);
        CHECK(error(found[1].eigenvalue, Complex(0, omega0 + Omega)) < 1e-12);
        // Circular, z = x + i y = exp(-i (omega0 + Omega) t) and exp(i (omega0 - Omega) t): the first turns clockwise,
        // x = cos, y = -sin = Re(i exp); the second counter-clockwise below the critical speed only.
        CHECK(std::abs(found[1].shape(1) / found[1].shape(0) - Complex(0, 1)) < 1e-10);
        CHECK(std::abs(found[0].shape(1) / found[0].shape(0) - Complex(0, Omega < omega0 ? -1 : 1)) < 1e-10);
    }
}

TEST_CASE("modes: two gyroscopically coupled oscillators follow the biquadratic equation", "[analytic]") {
    // det = lambda^4 + (k1 + k2 + g^2) lambda^2 + k1 k2.
    const double k1 = 2, k2 = 5;
    for (const double g : {0.0, 0.5, 4.0}) {
        CAPTURE(g);
        const std::vector<Mode> found =
            modes(system_of(Matrix::Identity(2, 2), (Matrix(2, 2) << 0, -g, g, 0).finished(),
                            (Matrix(2, 2) << k1, 0, 0, k2).finished()));
        const double b = k1 + k2 + g * g, high = (b + std::sqrt(b * b - 4 * k1 * k2)) / 2;
        REQUIRE(found.size() == 2);
        CHECK(error(found[0].eigenvalue, Complex(0, std::sqrt(k1 * k2 / high))) < 1e-12);
        CHECK(error(found[1].eigenvalue, Complex(0, std::sqrt(high))) < 1e-12);
    }
}

TEST_CASE("modes: a rotor with internal damping becomes unstable above its critical speed", "[analytic]") {
    // In the fixed frame, z = x + i y: m z'' + d (z' - i Omega z) + k z = 0, lambda^2 + (d/m) (lambda - i Omega) + k/m.
    const double m = 2, d = 0.3, k = 18, omega0 = 3;
    for (const double Omega : {0.5, 2.9, 3.1, 9.0}) {
        CAPTURE(Omega);
        const std::vector<Mode> found = modes(system_of(m * Matrix::Identity(2, 2), d * Matrix::Identity(2, 2),
                                                        (Matrix(2, 2) << k, d * Omega, -d * Omega, k).finished()));
        REQUIRE(found.size() == 2);
        const Complex root = std::sqrt(Complex(d * d / (4 * m * m) - k / m, d / m * Omega));
        // The two roots for z; that with negative imaginary part is the conjugate of a mode (backward whirl).
        Complex forward = -d / (2 * m) + root, backward = -d / (2 * m) - root;
        if (forward.imag() < 0) std::swap(forward, backward);
        const bool forward_first = std::abs(forward) < std::abs(backward);
        CHECK(error(found[forward_first ? 0 : 1].eigenvalue, forward) < 1e-12);
        CHECK(error(found[forward_first ? 1 : 0].eigenvalue, std::conj(backward)) < 1e-12);
        CHECK((found[forward_first ? 0 : 1].eigenvalue.real() > 0) == (Omega > omega0));
    }
}

TEST_CASE("modes: the low mode keeps twelve digits beside one a million times higher", "[analytic]") {
    // Two coupled coordinates; the small root of the characteristic equation written without cancellation.
    const Matrix M = (Matrix(2, 2) << 2, 0.9, 0.9, 1.5).finished();
    for (const bool first : {true, false}) {
        const double k1 = first ? 3.0 : 3e12, k2 = first ? 3e12 : 3.0;
        const std::vector<Mode> found =
            modes(system_of(M, Matrix::Zero(2, 2), (Matrix(2, 2) << k1, 0, 0, k2).finished()));
        const double a = M(0, 0) * M(1, 1) - M(0, 1) * M(0, 1), b = M(0, 0) * k2 + M(1, 1) * k1, c = k1 * k2;
        const double root = std::sqrt(b * b - 4 * a * c);
        REQUIRE(found.size() == 2);
        CHECK(std::abs(found[0].eigenvalue) == Approx(std::sqrt(2 * c / (b + root))).epsilon(1e-12));
        CHECK(std::abs(found[0].damping_ratio()) < 1e-12);
        // The low modes are bought with digits of the high ones.
        CHECK(std::abs(found[1].eigenvalue) == Approx(std::sqrt((b + root) / (2 * a))).epsilon(1e-3));
    }
}

TEST_CASE("modes: rigid-body motions are left out", "[analytic]") {
    // Two masses and a spring between them: omega^2 = k (1/m1 + 1/m2).
    const double m1 = 2, m2 = 3, k = 7;
    const Matrix K = (Matrix(2, 2) << k, -k, -k, k).finished();
    const std::vector<Mode> found = modes(system_of((Matrix(2, 2) << m1, 0, 0, m2).finished(), Matrix::Zero(2, 2), K));
    REQUIRE(found.size() == 1);
    CHECK(error(found[0].eigenvalue, Complex(0, std::sqrt(k * (1 / m1 + 1 / m2)))) < 1e-12);
    // A mass on nothing has no mode; on a damper alone it creeps to rest with d/m.
    const Matrix one = Matrix::Identity(1, 1), none = Matrix::Zero(1, 1);
    CHECK(modes(system_of(one, none, none)).empty());
    const std::vector<Mode> creeping = modes(system_of(2 * one, 0.5 * one, none));
    REQUIRE(creeping.size() == 1);
    CHECK(error(creeping[0].eigenvalue, -0.25) < 1e-12);
    CHECK(energy_by_row(system_of(2 * one, 0.5 * one, none), creeping[0]).isZero(0));
}

TEST_CASE("modes: undamped frequencies equal those of the symmetric generalised eigenproblem", "[property]") {
    Random random(3);
    for (int sample = 0; sample < 50; ++sample) {
        const Eigen::Index n = 2 + sample % 8;
        const Matrix M = random_positive(random, n), K = random_positive(random, n);
        const std::vector<Mode> found = modes(system_of(M, Matrix::Zero(n, n), K));
        const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> oracle(K, M, Eigen::EigenvaluesOnly);
        REQUIRE(found.size() == static_cast<std::size_t>(n));
        for (Eigen::Index i = 0; i < n; ++i)
            REQUIRE(std::abs(entry(found, i).eigenvalue) == Approx(std::sqrt(oracle.eigenvalues()(i))).epsilon(1e-10));
    }
}

TEST_CASE("modes: damped gyroscopic systems satisfy their equation, with unit energy and shares that add up to one",
          "[property]") {
    Random random(4);
    for (int sample = 0; sample < 60; ++sample) {
        const Eigen::Index n = 2 + sample % 7;
        const Matrix A = random_matrix(random, n, n);
        const SecondOrderSystem s =
            system_of(random_positive(random, n), (sample % 3) * random_positive(random, n) + 2 * (A - A.transpose()),
                      random_positive(random, n));
        const std::vector<Mode> found = modes(s);
        std::size_t eigenvalues = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
            const Mode& mode = found[i];
            eigenvalues += mode.oscillates() ? 2 : 1;
            REQUIRE(residual(s, mode) < 1e-9);
            REQUIRE(mode.eigenvalue.imag() >= 0);
            const double energy = mode.shape.dot(s.K_elastic * mode.shape).real() +
                                  std::norm(mode.eigenvalue) * mode.shape.dot(s.M * mode.shape).real();
            REQUIRE(energy == Approx(2).epsilon(1e-12));
            REQUIRE(std::abs(energy_product(s, mode, mode) - 2.0) < 1e-12);
            REQUIRE(energy_by_row(s, mode).sum() == Approx(1).epsilon(1e-12));
            if (i == 0 || found[i - 1].oscillates() != mode.oscillates()) continue;
            REQUIRE(found[i - 1].natural_hz() <= mode.natural_hz());
        }
        REQUIRE(eigenvalues == static_cast<std::size_t>(2 * n));
        for (std::size_t i = 1; i < found.size(); ++i) REQUIRE((found[i - 1].oscillates() || !found[i].oscillates()));
    }
}

TEST_CASE("modes: of uncoupled oscillators each stores its energy in its own row", "[analytic]") {
    const Matrix M = (Matrix(2, 2) << 2, 0, 0, 1).finished(), K = (Matrix(2, 2) << 2, 0, 0, 9).finished();
    const SecondOrderSystem s = system_of(M, Matrix::Zero(2, 2), K);
    const std::vector<Mode> found = modes(s);
    REQUIRE(found.size() == 2);
    CHECK((energy_by_row(s, found[0]) - Vector::Unit(2, 0)).norm() < 1e-13);
    CHECK((energy_by_row(s, found[1]) - Vector::Unit(2, 1)).norm() < 1e-13);
    CHECK(std::abs(energy_product(s, found[0], found[1])) < 1e-13);
}

TEST_CASE("modes: a mass matrix that is not positive definite and matrices that are not finite are errors",
          "[analytic]") {
    const Matrix one = Matrix::Identity(2, 2), none = Matrix::Zero(2, 2);
    CHECK_THROWS_AS(modes(system_of(-one, none, one)), NumericalError);
    CHECK_THROWS_AS(modes(system_of(none, none, one)), NumericalError);
    CHECK_THROWS_AS(modes(system_of((Matrix(2, 2) << 1, 2, 2, 1).finished(), none, one)), NumericalError);
    const Matrix bad = std::numeric_limits<double>::quiet_NaN() * one;
    CHECK_THROWS_AS(modes(system_of(bad, none, one)), NumericalError);
    CHECK_THROWS_AS(modes(system_of(one, bad, one)), NumericalError);
    CHECK_THROWS_AS(modes(system_of(one, none, bad)), NumericalError);
    CHECK(modes(system_of(Matrix(0, 0), Matrix(0, 0), Matrix(0, 0))).empty());
}
