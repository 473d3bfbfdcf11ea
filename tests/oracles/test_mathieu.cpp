#include "tests/oracles/mathieu.hpp"
#include "tests/support/catch.hpp"

using namespace cardan::oracles;

TEST_CASE("Mathieu: Hill's determinant gives cos(pi nu) = +-1 at the characteristic values of the tables",
          "[oracles][published]") {
    // a_r(q), b_r(q): Abramowitz and Stegun 1964, table 20.1; eight digits after the point.
    struct {
        double q, a, cosine;
    } const table[] = {{5, -5.80004602, 1},   {5, -5.79008060, -1},   {5, 1.85818754, -1},
                       {5, 2.09946045, 1},    {5, 7.44910974, 1},     {10, -13.93697996, 1},
                       {10, -2.39914240, -1}, {10, -13.93655248, -1}, {10, 7.71736985, 1}};
    for (const auto& line : table) {
        CAPTURE(line.q, line.a);
        // Rounding of the last digit, by the slope there.
        const double slope = (mathieu_cosine(line.a + 1e-5, line.q) - mathieu_cosine(line.a - 1e-5, line.q)) / 2e-5;
        CHECK(std::abs(mathieu_cosine(line.a, line.q) - line.cosine) < 6e-9 * std::abs(slope) + 1e-9);
    }
}

TEST_CASE("Mathieu: without the periodic part the exponent is the root, with a little of it as the series says",
          "[oracles][analytic]") {
    for (const double a : {0.3, 2.5, 7.0})
        CHECK(mathieu_cosine(a, 0) == Approx(std::cos(3.14159265358979 * std::sqrt(a))));
    CHECK(mathieu_exponent(-1, 0).real() == Approx(1));
    CHECK(mathieu_exponent(-1, 0).imag() == 0);
    // a = nu^2 + q^2 / (2 (nu^2 - 1)) + O(q^4).                                       [Abramowitz and Stegun 20.3.15]
    const double nu = 0.6, q = 0.01, a = nu * nu + q * q / (2 * (nu * nu - 1));
    CHECK(mathieu_exponent(a, q).imag() == Approx(nu).epsilon(1e-8));
    // First region of instability: |Re| = q / 2, nearly, and half the frequency.
    CHECK(mathieu_exponent(1, 0.01).real() == Approx(0.005).epsilon(1e-3));
    CHECK(mathieu_exponent(1, 0.01).imag() == 1);
}
