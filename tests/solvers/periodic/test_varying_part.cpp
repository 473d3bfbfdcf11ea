// Systems of which few combinations of the coordinates vary, beside the integration of all and beside a constant
// system.
#include "mbs/base/decompositions.hpp"
#include "solvers/periodic/detail/varying_part.hpp"
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/support/catch.hpp"

#include <cmath>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

using Index = Eigen::Index;

// Of full rank.
Matrix some(Index rows, Index columns, double size, double phase) {
    Matrix A(rows, columns);
    for (Index j = 0; j < columns; ++j)
        for (Index i = 0; i < rows; ++i) {
            const auto k = static_cast<double>(i * columns + j);
            A(i, j) = size * std::sin(phase + 2.3 * k * k);
        }
    return A;
}

// Oscillators of a wide range of frequencies, coupled by constant and, along some directions, by varying terms.
PeriodicSystem oscillators(Index directions, double highest_harmonic) {
    const Index n = 8;
    const Matrix B = some(n, directions, 0.4, 1.0), inertia = some(directions, directions, 0.1, 2.0),
                 rates = some(directions, directions, 0.3, 3.0), springs = some(directions, directions, 0.5, 4.0),
                 constant = some(n, n, 0.1, 5.0);
    return PeriodicSystem::second_order(2 * pi, n, [=](double t, SecondOrderSystem& out) {
        const double h = highest_harmonic, c = std::cos(t), s = std::sin(h * t);
        out.M = Matrix::Identity(n, n) + B * (c * (inertia + inertia.transpose())) * B.transpose();
        out.C = constant + B * (s * rates + std::cos(2 * t) * inertia) * B.transpose();
        out.K = B * ((c + 0.3 * s) * springs) * B.transpose();
        for (Index i = 0; i < n; ++i) out.K(i, i) += std::pow(3.0, static_cast<double>(i));
        out.K_elastic = out.K;
    });
}

// The constant system of a disc with five oscillators on it, seen in the fixed frame: the disc turns with its two
// coordinates, the rest moves with it.
class Turned {
public:
    static constexpr Index n = 9;

    Turned() {
        M_ = Matrix::Identity(n, n);
        const Matrix inertia = some(n - 2, n - 2, 0.02, 1);
        M_.bottomRightCorner(n - 2, n - 2) += inertia + inertia.transpose();
        K_ = 0.3 * (some(n, n, 1, 2) + some(n, n, 1, 2).transpose());
        for (Index i = 0; i < n; ++i) K_(i, i) += 1.7 + std::pow(static_cast<double>(i), 4);
        C_ = 0.01 * K_;
    }
    // u = R(t) q turns the first two: M (R q)'' + C (R q)' + K R q, times R^T.
    PeriodicSystem system() const {
        return PeriodicSystem::second_order(2 * pi, n, [*this](double t, SecondOrderSystem& out) {
            Matrix R = Matrix::Identity(n, n), S = Matrix::Zero(n, n);
            R.topLeftCorner(2, 2) << std::cos(t), std::sin(t), -std::sin(t), std::cos(t);
            S.topLeftCorner(2, 2) << -std::sin(t), std::cos(t), -std::cos(t), -std::sin(t);
            Matrix second = Matrix::Zero(n, n);
            second.topLeftCorner(2, 2) = -R.topLeftCorner(2, 2);
            out.M = R.transpose() * M_ * R;
            out.C = R.transpose() * (2 * M_ * S + C_ * R);
            out.K = R.transpose() * (M_ * second + C_ * S + K_ * R);
            out.K_elastic = R.transpose() * K_ * R;
        });
    }
    std::vector<Complex> exponents() const {
        Matrix A = Matrix::Zero(2 * n, 2 * n);
        A.topRightCorner(n, n).setIdentity();
        A.bottomRows(n) << -M_.partialPivLu().solve(K_), -M_.partialPivLu().solve(C_);
        const ComplexVector all = Eigen::EigenSolver<Matrix>(A, false).eigenvalues();
        return {all.begin(), all.end()};
    }

private:
    Matrix M_, C_, K_;
};

}  // namespace

TEST_CASE("varying part: steps are those of all equations", "[crosscheck]") {
    for (const Index directions : {0, 2}) {
        const PeriodicSystem system = oscillators(directions, 5);
        const std::optional<VaryingPart> part = VaryingPart::find(system, 10, 1e-11);
        REQUIRE(part);
        CHECK(part->directions().cols() == directions);
        CHECK(part->error() < 1e-11);
        for (const int stages : {2, 7}) {
            VaryingPartStep step(*part, stages);
            for (const int steps : {3, 4}) {  // of another length
                const Matrix own = transitions(step, system.states(), 0.4, 2.9, 1, steps).front(),
                             all = transitions(system, 0.4, 2.9, 1, steps, {.stages = stages}).front();
                CHECK((own - all).cwiseAbs().maxCoeff() < 1e-12 * all.cwiseAbs().maxCoeff());
            }
        }
    }
}

TEST_CASE("varying part: none where many directions vary, more harmonics or a system of first order", "[crosscheck]") {
    CHECK(VaryingPart::find(oscillators(4, 8), 10, 1e-11));
    CHECK_FALSE(VaryingPart::find(oscillators(5, 8), 10, 1e-11));
    CHECK_FALSE(VaryingPart::find(oscillators(2, 9), 10, 1e-11));
    // Aliases of the azimuths: the mean, and a harmonic that is taken into account.
    CHECK_FALSE(VaryingPart::find(oscillators(2, VaryingPart::azimuths), 10, 1e-11));
    CHECK_FALSE(VaryingPart::find(oscillators(2, VaryingPart::azimuths - 3), 10, 1e-11));
    const auto first = [](double t, Matrix& E, Matrix& A) {
        E = Matrix::Identity(2, 2);
        A = std::cos(t) * E;
    };
    CHECK_FALSE(VaryingPart::find(PeriodicSystem::first_order(2 * pi, 2, first), 10, 1e-11));
}

TEST_CASE("varying part: a constant system in a frame that turns with some of its coordinates keeps its exponents",
          "[analytic]") {
    const Turned turned;
    const std::optional<VaryingPart> part = VaryingPart::find(turned.system(), 70, 1e-11);
    REQUIRE(part);
    CHECK(part->directions().cols() == 4);  // two that turn, and the springs between them and the rest
    const Floquet all = floquet(turned.system(), {.per_period = 70});
    CHECK(all.note.empty());
    CHECK(distance(exponents(all), turned.exponents(), 1) < 1e-8);
    for (const FloquetMode& mode : all.modes)
        CHECK(distance(mode.exponent, turned.exponents(), 1) < mode.error + 1e-11);
}

TEST_CASE("varying part: of the slow motions only, none is lost and fast ones are left out", "[analytic]") {
    const Turned turned;
    const FloquetOptions options{.per_period = 1.5, .only_slow = true};
    const Floquet slow = floquet(turned.system(), options);
    const std::vector<Complex> found = exponents(slow);
    Index fast = 0;
    for (const Complex exponent : turned.exponents()) {
        if (std::abs(exponent) <= 1.5 * options.per_period) CHECK(distance(exponent, found, 1) < 1e-8);
        if (std::abs(exponent) > 10 * options.per_period) ++fast;
    }
    REQUIRE(fast == 10);
    CHECK(std::ssize(found) <= 2 * Turned::n - fast);
    CHECK(slow.unresolved.empty());
}
