// Periodic response of linear systems to periodic loads. Oracles: closed form, solutions chosen beforehand.
#include "solvers/periodic/forced_response.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

Vector one(double value) {
    return Vector::Constant(1, value);
}

PeriodicSystem oscillator(double period, double mass, double damping, double stiffness) {
    return PeriodicSystem::second_order(period, 1, [=](double, SecondOrderSystem& out) {
        out.M = one(mass), out.C = one(damping), out.K = one(stiffness);
    });
}

}  // namespace

TEST_CASE("forced response: an oscillator has the amplitude and phase of the closed form", "[analytic]") {
    const double T = 3, w = 2 * pi / T, m = 2, c = 0.3, k = 7;
    const ForcedResponse q = forced_response(
        oscillator(T, m, c, k), [&](double t) { return one(5 + 4 * std::cos(w * t) + 3 * std::sin(2 * w * t)); }, 3);
    const Complex first = 4.0 / Complex(k - m * w * w, c * w), second = 3.0 / Complex(k - 4 * m * w * w, 2 * c * w);
    const Vector exact =
        (Vector(7) << 5 / k, first.real(), -first.imag(), second.imag(), second.real(), 0, 0).finished();
    CHECK((q.coefficients.transpose() - exact).norm() < 1e-14);
    CHECK(q.remainder < 1e-14);
    CHECK(q.harmonics() == 3);
    const double t = 0.4, h = 1e-4;
    CHECK(q.at(t, 1)(0) == Approx((q.at(t + h)(0) - q.at(t - h)(0)) / (2 * h)).epsilon(1e-7));
    CHECK(q.at(t, 2)(0) == Approx((q.at(t + h, 1)(0) - q.at(t - h, 1)(0)) / (2 * h)).epsilon(1e-7));
}

TEST_CASE("forced response: with periodic matrices a solution chosen beforehand comes out", "[analytic]") {
    constexpr int n = 4, harmonics = 5;
    const double T = 0.7, w = 2 * pi / T;
    Random random(7);
    const auto matrix = [&] {
        Matrix A(n, n);
        for (int j = 0; j < n; ++j) A.col(j) = random_state(random, n);
        return A;
    };
    std::array<Matrix, 6> A;
    for (Matrix& m : A) m = matrix();
    const Matrix chosen = (Matrix(n, 2 * harmonics + 1) << matrix(), matrix(), matrix().leftCols(3)).finished();
    const PeriodicSystem system = PeriodicSystem::second_order(T, n, [&](double t, SecondOrderSystem& out) {
        out.M = Matrix::Identity(n, n) + 0.1 * std::cos(w * t) * A[0];
        out.C = w * (A[1] + std::sin(2 * w * t) * A[2]);
        out.K = w * w * (A[3] + std::cos(w * t) * A[4] + std::sin(3 * w * t) * A[5]);
    });
    const ForcedResponse exact{T, chosen, 0};
    const auto load = [&](double t) -> Vector {
        SecondOrderSystem at;
        system.at(t, at);
        return at.M * exact.at(t, 2) + at.C * exact.at(t, 1) + at.K * exact.at(t);
    };
    for (int more : {0, 3}) {
        const ForcedResponse q = forced_response(system, load, harmonics + more);
        CHECK((q.coefficients.leftCols(chosen.cols()) - chosen).norm() < 1e-10);
        CHECK(q.coefficients.rightCols(2 * more).norm() < 1e-10);
        CHECK(q.remainder < 1e-11);
    }
    // Too few harmonics: the rest shows.
    CHECK(forced_response(system, load, 2).remainder > 1e-2);
}

TEST_CASE("forced response: resonance, wrong sizes and numbers are refused", "[property]") {
    const double T = 2, w = 2 * pi / T;
    const auto load = [&](double t) { return one(std::cos(w * t)); };
    CHECK_THROWS_WITH(forced_response(oscillator(T, 1, 0, w * w), load, 2),
                      Catch::Contains("undamped natural frequency"));
    CHECK_THROWS_WITH(forced_response(oscillator(T, 1, 0.1, 0), load, 2), Catch::Contains("nothing holds"));
    const PeriodicSystem good = oscillator(T, 1, 0.1, 3);
    check_refused([&] { (void)forced_response(good, load, 0); }, {"forced response", "harmonics = 0", ">= 1"});
    check_refused([&] { (void)forced_response(good, load, 3, 6); }, {"samples = 6", "twice the harmonics"});
    const PeriodicSystem first =
        PeriodicSystem::first_order(T, 1, [](double, Matrix& E, Matrix& A) { E = one(1), A = one(-1); });
    check_refused([&] { (void)forced_response(first, load, 2); }, {"order of the system = 1"});
    CHECK_THROWS_WITH(forced_response(
                          good, [](double) { return Vector(Vector::Zero(2)); }, 2),
                      Catch::Contains("2 rows; wanted: 1"));
    CHECK_THROWS_WITH(forced_response(
                          good, [](double t) { return one(1 / (t - t)); }, 2),
                      Catch::Contains("not finite"));
}
