#include "tests/oracles/strip_flutter.hpp"
#include "tests/support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

namespace cardan::oracles::strip_flutter_tests {

namespace {

constexpr double pi = std::numbers::pi;

// Half chord, a and rho of the wing of M. Goland, J. Appl. Mech. 12 (1945) A197; elastic axis at 33 % of the chord,
// mass 35.71 kg/m at 43 %.
constexpr double chord = 1.8288, span = 6.096, EI = 9.77e6, GJ = 0.987e6;
constexpr Strip goland{chord / 2, -0.34, 1.225, 35.71, 35.71 * 0.1 * chord, 8.64};

StripFlutter wing(int modes) {
    return {goland, cantilever_shapes(span, EI, GJ, modes)};
}

}  // namespace

TEST_CASE("strip flutter: Theodorsen's function at values of his table, and its limits", "[oracles][published]") {
    // Theodorsen, NACA Report 496, 1935, table II: F and -G, four digits.
    for (const auto& [k, F, G] : {std::tuple{0.1, 0.8319, 0.1723}, {0.5, 0.5979, 0.1507}, {1.0, 0.5394, 0.1003}}) {
        CAPTURE(k);
        CHECK(theodorsen(k).real() == Approx(F).margin(6e-5).epsilon(0));
        CHECK(-theodorsen(k).imag() == Approx(G).margin(6e-5).epsilon(0));
    }
    CHECK(std::abs(theodorsen(1e-6) - 1.0) < 1e-4);
    CHECK(std::abs(theodorsen(200) - 0.5) < 1e-3);
    // The two exponentials are within 2 % of it.
    for (const double k : {0.02, 0.1, 0.3, 0.6, 1.0}) CHECK(std::abs(jones_lags(k) - theodorsen(k)) < 0.02);
}

TEST_CASE("strip flutter: Goland's wing", "[oracles][published]") {
    // About 137 m/s and 70.7 rad/s in Goland's paper and later results of strip theory.
    const FlutterPoint exact = wing(6).flutter(theodorsen, 150);
    CHECK(exact.speed == Approx(137).epsilon(0.005));
    CHECK(exact.frequency == Approx(70.7).epsilon(0.011));
}

namespace {

// By frequency; those of the lags are real.
std::vector<std::complex<double>> oscillations(const Eigen::VectorXcd& eigenvalues) {
    std::vector<std::complex<double>> all;
    for (const std::complex<double> value : eigenvalues)
        if (value.imag() > 1e-6) all.push_back(value);
    std::ranges::sort(all, {}, [](const std::complex<double>& value) { return value.imag(); });
    return all;
}

}  // namespace

TEST_CASE("strip flutter: Goland's wing by another implementation", "[oracles][discrete]") {
    // Six bending and six torsion modes, a program of its own, by its eigenvalues; digits as printed.
    const Deficiency quasi_steady = [](double) { return 1; };
    const TwoLags others{{0.3, 0.7}, {0.14, 0.53}};
    for (const auto& [C, speed, frequency] : {std::tuple<Deficiency, double, double>{theodorsen, 136.950429, 70.018328},
                                              {jones_lags, 137.334691, 69.346361},
                                              {others, 124.164057, 58.535744},
                                              {quasi_steady, 64.523575, 87.697538}}) {
        CAPTURE(speed);
        const FlutterPoint own = wing(6).flutter(C, 150);
        CHECK(own.speed == Approx(speed).epsilon(1e-7));
        CHECK(own.frequency == Approx(frequency).epsilon(1e-7));
        CHECK(wing(4).flutter(C, 150).speed == Approx(speed).epsilon(1e-5));
    }
    const FlutterPoint steady = wing(6).steady_flutter(200);
    CHECK(steady.speed == Approx(102.057776).epsilon(1e-7));
    CHECK(steady.frequency == Approx(64.991590).epsilon(1e-5));  // a double root: the square root of rounding
    const Eigen::VectorXd in_vacuo = wing(6).frequencies();
    CHECK(in_vacuo(0) == Approx(48.152).margin(5e-4).epsilon(0));
    CHECK(in_vacuo(1) == Approx(95.703).margin(5e-4).epsilon(0));
    CHECK(in_vacuo(2) == Approx(243.73).margin(5e-3).epsilon(0));
    for (const auto& [speed, mode, real, imag] : {std::tuple{40.0, std::size_t{0}, -2.576538, 46.651118},
                                                  {40.0, std::size_t{2}, -4.472524, 233.235089},
                                                  {120.0, std::size_t{0}, -13.335039, 56.156404},
                                                  {120.0, std::size_t{1}, -5.456153, 75.160377},
                                                  {160.0, std::size_t{1}, 6.114551, 66.772797}}) {
        CAPTURE(speed, mode);
        const std::complex<double> own = oscillations(wing(6).eigenvalues(jones_lags, speed)).at(mode);
        CHECK(own.real() == Approx(real).margin(1e-6).epsilon(0));
        CHECK(own.imag() == Approx(imag).margin(1e-6).epsilon(0));
    }
}

TEST_CASE("strip flutter: k-method and eigenvalues agree where a motion lasts", "[oracles]") {
    const StripFlutter section({1, -0.2, 1, 20 * pi, 2 * pi, 4.8 * pi}, section_shapes(3.2 * pi, 4.8 * pi));
    const FlutterPoint found = section.flutter(jones_lags, 10);
    const Eigen::VectorXcd at = section.eigenvalues(jones_lags, found.speed);
    double nearest = 1;
    for (const std::complex<double> value : at)
        nearest = std::min(nearest, std::abs(value - std::complex<double>(0, found.frequency)));
    CHECK(nearest < 1e-10);
}

}  // namespace cardan::oracles::strip_flutter_tests
