// Spectra, cross-spectra and variances of Mann's tensor.
#include "elements/turbulence/mann_spectra.hpp"
#include "tests/elements/turbulence/mann_table.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <array>
#include <cmath>
#include <string>

namespace cardan::testing::mann_spectrum_tests {

namespace {

MannParameters unit(double gamma) {
    return {gamma, 1, 1};
}

// Integral of F over k_1 and -k_1 by the trapezoidal rule in ln k_1.
Mat3 integral_over_k1(double gamma, double low, double high, int steps) {
    Mat3 sum = Mat3::Zero();
    const double step = std::log(high / low) / steps;
    for (int i = 0; i <= steps; ++i) {
        const double k1 = low * std::exp(i * step), share = i == 0 || i == steps ? 0.5 : 1;
        sum += 2 * share * step * k1 * mann_spectrum(unit(gamma), k1);
    }
    return sum;
}

}  // namespace

// Formulas: von Karman's one-dimensional spectra.
TEST_CASE("Mann's spectra: without shear von Karman's", "[analytic]") {
    const double L = 25, A = 0.2, scale = A * std::pow(L, 5.0 / 3);
    for (const double x : {1e-3, 0.01, 0.1, 1.0, 10.0, 1e3}) {
        CAPTURE(x);
        const Mat3 F = mann_spectrum({0, L, A}, x / L);
        CHECK(F(0, 0) == Approx(9.0 / 55 * scale * std::pow(1 + x * x, -5.0 / 6)).epsilon(1e-6));
        const double across = 3.0 / 110 * scale * (3 + 8 * x * x) * std::pow(1 + x * x, -11.0 / 6);
        CHECK(F(1, 1) == Approx(across).epsilon(1e-6));
        CHECK(F(2, 2) == Approx(across).epsilon(1e-6));
        CHECK(std::abs(F(0, 2)) < 1e-12 * F(0, 0));
    }
}

// 2e-5: what its quadrature leaves at the lowest wave numbers; printed to six digits. For all rows also the 5e-4 to
// which it agrees with the tables of DTU's toolbox.
TEST_CASE("Mann's spectra: another program's, for five Gamma", "[discrete]") {
    const turbines::CsvTable table = mann_table("one_point");
    double largest = 0;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const double gamma = table.column("Gamma")[i], k1 = table.column("k1L")[i];
        CAPTURE(gamma, k1);
        const Mat3 F = k1 * mann_spectrum(unit(gamma), k1);
        const Vec3 right(table.column("k1F_uu")[i], table.column("k1F_vv")[i], table.column("k1F_ww")[i]);
        const double uw = table.column("k1F_uw")[i], uw_scale = std::sqrt(right(0) * right(2));
        const double error = std::max(((F.diagonal() - right).array() / right.array()).abs().maxCoeff(),
                                      std::abs(F(0, 2) - uw) / uw_scale);
        CHECK(error < 2e-5);
        largest = std::max(largest, error);
        CHECK(std::abs(F(0, 1)) + std::abs(F(1, 2)) < 1e-12 * F(0, 0));
    }
    UNSCOPED_INFO("largest deviation " << largest);
    CHECK(largest < 5e-4);
}

// Coherence of von Karman's isotropic turbulence by Bessel functions, that of u as in IEC 61400-1.
TEST_CASE("Mann's cross-spectra: without shear von Karman's coherence, also far apart", "[analytic]") {
    for (const double k1 : {0.05, 0.3, 2.0})
        for (const double d : {1e-4, 0.02, 0.3, 1.0, 3.0, 30.0}) {
            CAPTURE(k1, d);
            const double x = d * std::hypot(k1, 1);
            const double right = std::pow(2, 1.0 / 6) / std::tgamma(5.0 / 6) *
                                 (std::pow(x, 5.0 / 6) * std::cyl_bessel_k(5.0 / 6, x) -
                                  std::pow(x, 11.0 / 6) / 2 * std::cyl_bessel_k(1.0 / 6, x));
            const Complex across = mann_cross_spectrum(unit(0), k1, 0.6 * d, 0.8 * d)(0, 0);
            CHECK(std::abs(across / mann_spectrum(unit(0), k1)(0, 0) - right) < 1e-6);
        }
}

// 2e-4: what the table's quadrature of 240 x 180 points leaves at distances of L, where it has too few points on a wave
// of the phase. (Of k_1 L = 2, d = L its squared coherence of w over y is 0.00172 to 0.00177, depending on where the
// integral ends.)
TEST_CASE("Mann's cross-spectra: another program's coherence and phase over height and across", "[discrete]") {
    const turbines::CsvTable table = mann_table("two_point");
    const std::array<std::string, 3> names{"u", "v", "w"};
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const double k1 = table.column("k1L")[i], d = table.column("d_over_L")[i];
        const Mat3 F = mann_spectrum(unit(3.9), k1);
        const Mat3T<Complex> up = mann_cross_spectrum(unit(3.9), k1, 0, d),
                             left = mann_cross_spectrum(unit(3.9), k1, d, 0);
        for (int c = 0; c < 3; ++c) {
            const std::string& name = names.at(static_cast<std::size_t>(c));
            CAPTURE(k1, d, name);
            const Complex up_right = std::polar(std::sqrt(table.column("coh2_" + name + "_dz")[i]),
                                                table.column("phase_" + name + "_dz")[i] * pi / 180);
            CHECK(std::abs(up(c, c) / F(c, c) - up_right) < 2e-4);
            const double left_right = std::sqrt(table.column("coh2_" + name + "_dy")[i]);
            CHECK(std::abs(std::abs(left(c, c)) / F(c, c) - left_right) < 2e-4);
            CHECK(std::abs(left(c, c).imag()) < 1e-9 * F(c, c));
        }
    }
}

TEST_CASE("Mann's cross-spectra: upper eddies lie further downwind; conjugates and mirrors", "[property]") {
    const MannParameters parameters = iec_mann(90, 2);
    const double k1 = 0.03;
    const Mat3T<Complex> up = mann_cross_spectrum(parameters, k1, 0, 15);
    CHECK(std::arg(up(0, 0)) < -0.1);
    const Mat3T<Complex> there = mann_cross_spectrum(parameters, k1, 7, 15),
                         back = mann_cross_spectrum(parameters, k1, -7, -15),
                         mirrored = mann_cross_spectrum(parameters, k1, -7, 15);
    const double size = mann_spectrum(parameters, k1).trace();
    const Vec3 mirror(1, -1, 1);
    CHECK((back - there.adjoint()).cwiseAbs().maxCoeff() < 1e-12 * size);
    CHECK((mirrored - mirror.asDiagonal() * there * mirror.asDiagonal()).cwiseAbs().maxCoeff() < 1e-12 * size);
}

// The table's integrals end at k_1 L = 1e-4 and 1e4; 2e-5: five digits.
TEST_CASE("Mann's variances: closed form without shear, another program's, the spectra's integral", "[discrete]") {
    CHECK(max_abs(mann_covariance(unit(0)) - 0.6883439 * Mat3::Identity()) < 5e-7);
    const turbines::CsvTable table = mann_table("variances");
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const double gamma = table.column("Gamma")[i];
        CAPTURE(gamma);
        // Left out: F as at the lower end below it; isotropic turbulence above the upper one, 9/55 k_1^(-5/3) and 4/3
        // of it.
        const Mat3 below = 2e-4 * mann_spectrum(unit(gamma), 1e-4);
        const double above = 2 * 9.0 / 55 * 1.5 * std::pow(1e4, -2.0 / 3);
        const Mat3 C =
            mann_covariance(unit(gamma)) - below - above * Vec3(1, 4.0 / 3, 4.0 / 3).asDiagonal().toDenseMatrix();
        CHECK(C(0, 0) == Approx(table.column("uu")[i]).epsilon(4e-5));
        CHECK(C(1, 1) == Approx(table.column("vv")[i]).epsilon(4e-5));
        CHECK(C(2, 2) == Approx(table.column("ww")[i]).epsilon(4e-5));
        CHECK(C(0, 2) == Approx(table.column("uw")[i]).epsilon(4e-5).margin(1e-7));
        CHECK(std::abs(C(0, 1)) + std::abs(C(1, 2)) < 1e-12);
    }
    const Mat3 in_steps = integral_over_k1(3.9, 1e-4, 1e4, 60);
    CHECK(in_steps(0, 0) == Approx(2.2210).epsilon(1e-4));
    CHECK(in_steps(1, 1) == Approx(1.1279).epsilon(1e-4));
    CHECK(in_steps(2, 2) == Approx(0.60117).epsilon(1e-4));
    CHECK(in_steps(0, 2) == Approx(-0.53416).epsilon(1e-4));
}

TEST_CASE("Mann's spectra: of the standard, and over time", "[analytic]") {
    const MannParameters parameters = iec_mann(90, 2);
    CHECK(std::sqrt(mann_covariance(parameters)(0, 0)) == Approx(0.55 * 2 * 1.7974).epsilon(1e-4));
    const double V = 12, f = 0.1;
    const Mat3 S = mann_spectrum_over_time(parameters, f, V);
    CHECK(max_abs(S - 4 * pi / V * mann_spectrum(parameters, 2 * pi * f / V)) < 1e-12 * S.trace());
    check_refused([&] { (void)mann_spectrum(parameters, 0); }, {"wave number k1 = 0", "> 0"});
    check_refused([&] { (void)mann_cross_spectrum(parameters, 0.1, infinite, 0); }, {"distance = inf", "finite"});
    check_refused([&] { (void)mann_spectrum_over_time(parameters, -1, V); }, {"frequency = -1"});
    check_refused([&] { (void)mann_spectrum_over_time(parameters, f, 0); }, {"speed = 0"});
}

}  // namespace cardan::testing::mann_spectrum_tests
