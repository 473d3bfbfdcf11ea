// Floquet's theory on small systems whose multipliers or exponents are known in closed form.
#include "mbs/base/entry.hpp"
#include "solvers/periodic/floquet.hpp"
#include "tests/oracles/mathieu.hpp"
#include "tests/solvers/periodic/floquet_tools.hpp"
#include "tests/solvers/periodic/hill.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

using Index = Eigen::Index;

// y'' + c y' + (a - 2 q cos 2t) y = 0, period pi.
PeriodicSystem mathieu(double a, double q, double c = 0) {
    return PeriodicSystem::second_order(pi, 1, [=](double t, SecondOrderSystem& out) {
        out.M = Matrix::Ones(1, 1);
        out.C = Matrix::Constant(1, 1, c);
        out.K = Matrix::Constant(1, 1, a - 2 * q * std::cos(2 * t));
        out.K_elastic = Matrix::Constant(1, 1, std::abs(a));
    });
}

PeriodicSystem constant(const Matrix& M, const Matrix& C, const Matrix& K, double period = 2 * pi) {
    return PeriodicSystem::second_order(period, M.rows(), [=](double, SecondOrderSystem& out) {
        out.M = M;
        out.C = C;
        out.K = K;
        out.K_elastic = K;
    });
}

PeriodicSystem oscillators(const Vector& omega, const Vector& zeta) {
    const Matrix C = Vector(2 * zeta.cwiseProduct(omega)).asDiagonal(), K = Vector(omega.array().square()).asDiagonal();
    return constant(Matrix::Identity(omega.size(), omega.size()), C, K);
}

// x' = (a + b cos t) x: mu = exp(2 pi a), p = exp(b sin t).
PeriodicSystem scalar(double a, double b) {
    return PeriodicSystem::first_order(2 * pi, 1, [=](double t, Matrix& E, Matrix& A) {
        E = Matrix::Ones(1, 1);
        A = Matrix::Constant(1, 1, a + b * std::cos(t));
    });
}

}  // namespace

TEST_CASE("Floquet: Mathieu's equation changes stability at the characteristic values of the tables", "[published]") {
    // a_r(q), b_r(q): Abramowitz and Stegun 1964, table 20.1; period pi: even r at mu = 1, odd r at mu = -1.
    struct {
        double q, a;
        int r;
        bool stable_below;
    } const table[] = {{5, -5.80004602, 0, false},  {5, -5.79008060, 1, true},   {5, 1.85818754, 1, false},
                       {5, 2.09946045, 2, true},    {5, 7.44910974, 2, false},   {10, -13.93697996, 0, false},
                       {10, -13.93655248, 1, true}, {10, -2.39914240, 1, false}, {10, -2.38215824, 2, true},
                       {10, 7.71736985, 2, false}};
    for (const auto& line : table) {
        CAPTURE(line.q, line.r, line.a);
        const double step = 2e-7;
        for (const bool below : {true, false}) {
            const Floquet result = floquet(mathieu(line.a + (below ? -step : step), line.q));
            const bool stable = below == line.stable_below;
            CHECK(result.modes.size() == (stable ? 1 : 2));
            for (const FloquetMode& mode : result.modes) {
                CHECK((mode.kind == FloquetKind::oscillation) == stable);
                CHECK((mode.multiplier().real() > 0) == (line.r % 2 == 0));
            }
            CHECK((result.growth() > 1e-6) == !stable);
        }
    }
}

TEST_CASE("Floquet: exponents of Mathieu's equation are those of Hill's determinant, and so are those of Hill's method",
          "[analytic]") {
    for (const double c : {0.0, 0.2})
        for (const double q : {0.1, 1.0, 5.0})
            for (const double a : {-1.0, 0.3, 1.1, 2.5, 5.7, 10.0}) {
                const PeriodicSystem system = mathieu(a, q, c);
                const Complex expected = oracles::mathieu_exponent(a - c * c / 4, q) - c / 2;
                const Floquet integrated = floquet(system), balanced = hill(system);
                CAPTURE(c, q, a, expected);
                CHECK(integrated.note.empty());
                for (const Floquet* result : {&integrated, &balanced}) {
                    REQUIRE(!result->modes.empty());
                    const FloquetMode* fastest = &result->modes[0];
                    for (const FloquetMode& mode : result->modes)
                        if (mode.growth() > fastest->growth()) fastest = &mode;
                    const double error = std::min(distance(fastest->exponent, expected, 2),
                                                  distance(std::conj(fastest->exponent), expected, 2));
                    CHECK(error < 1e-9);
                }
                CHECK(integrated.growth() == Approx(expected.real()).margin(1e-9));
                CHECK(integrated.stability_margin() == -integrated.growth());
            }
}

TEST_CASE("Floquet: kinds of motion of Mathieu's equation by the region of its plane", "[analytic]") {
    // First tongue: half-frequency motion; below a_0: growth without oscillation; second tongue: once per period.
    const Floquet half = floquet(mathieu(1, 0.3)), none = floquet(mathieu(-1, 0.1)), once = floquet(mathieu(4.0, 1.5));
    for (const Floquet* result : {&half, &none, &once}) {
        REQUIRE(result->modes.size() == 2);
        CHECK(result->modes[0].growth() == Approx(-result->modes[1].growth()));
        CHECK(result->stability_margin() < -0.01);
    }
    CHECK(kind_name(half.modes[0]) == "locked at 1/2 per period");
    CHECK(half.modes[0].multiplier().real() < 0);
    CHECK(half.modes[0].frequency_hz() == Approx(1 / (2 * pi)));
    CHECK(kind_name(none.modes[0]) == "aperiodic");
    CHECK(kind_name(once.modes[0]) == "locked at 1 per period");
    CHECK(once.modes[0].per_period() == Approx(1));
    CHECK(kind_name(floquet(mathieu(2.5, 0.1)).modes[0]) == "oscillation");
}

TEST_CASE("Floquet: the equation of Markus and Yamabe grows although its frozen eigenvalues do not", "[published]") {
    // Eigenvalues (-1 +- i sqrt 7) / 4 at any time; solutions exp(t/2) (cos t, -sin t), exp(-t) (sin t, cos t).
    // [Markus and Yamabe, Osaka Math. J. 12 (1960)]
    const PeriodicSystem system = PeriodicSystem::first_order(pi, 2, [](double t, Matrix& E, Matrix& A) {
        const double c = std::cos(t), s = std::sin(t);
        E = Matrix::Identity(2, 2);
        A = (Matrix(2, 2) << -1 + 1.5 * c * c, 1 - 1.5 * s * c, -1 - 1.5 * s * c, -1 + 1.5 * s * s).finished();
    });
    for (const Floquet& result : {floquet(system), hill(system)}) {
        REQUIRE(result.modes.size() == 2);
        CHECK(result.modes[0].growth() == Approx(0.5).epsilon(1e-11));
        CHECK(result.modes[1].growth() == Approx(-1).epsilon(1e-11));
        for (const FloquetMode& mode : result.modes) {
            CHECK(mode.kind == FloquetKind::subharmonic);
            CHECK(mode.exponent.imag() == Approx(1));
            // cos t and sin t: half the energy at either sign of the frequency.
            CHECK(mode.share(0) == Approx(0.5));
            CHECK(mode.share(-1) == Approx(0.5));
        }
    }
}

TEST_CASE("Floquet: a scalar equation has the multiplier of its mean and the harmonics of exp(b sin t)", "[analytic]") {
    const double a = -0.3, b = 1.4;
    for (const Floquet& result : {floquet(scalar(a, b)), hill(scalar(a, b), {.harmonics = 16})}) {
        REQUIRE(result.modes.size() == 1);
        const FloquetMode& mode = result.modes[0];
        CHECK(std::abs(mode.exponent - a) < 1e-12);
        CHECK(mode.multiplier().real() == Approx(std::exp(2 * pi * a)).epsilon(1e-11));
        // |c_j| = I_|j|(b); the sum of the squares is I_0(2 b).
        for (int j = -5; j <= 5; ++j) {
            const double bessel = std::cyl_bessel_i(std::abs(j), b);
            CHECK(mode.share(j) == Approx(bessel * bessel / std::cyl_bessel_i(0, 2 * b)).epsilon(1e-9));
        }
        CHECK(mode.participation.sum() == Approx(1));
        const Complex at_rest = mode.shape(0)(0);
        for (const double t : {0.4, 2.0, 5.5})
            CHECK(std::abs(mode.shape(t)(0) / at_rest - std::exp(b * std::sin(t))) < 1e-10);
    }
}

TEST_CASE("Floquet: constant systems have the eigenvalues of the state matrix, frequencies beyond one per period too",
          "[analytic]") {
    const Matrix M = (Matrix(3, 3) << 2, 0.1, 0, 0.1, 1, 0.2, 0, 0.2, 3).finished(),
                 C = (Matrix(3, 3) << 0.2, 0.5, 0, -0.5, 0.1, 0, 0, 0, 0.3).finished(),
                 K = (Matrix(3, 3) << 3, 0, 1, 0, 40, 0, 1, 0, 200).finished();
    const std::vector<Complex> lambda = eigenvalues(M, C, K);
    for (const Floquet& result : {floquet(constant(M, C, K)), hill(constant(M, C, K))}) {
        REQUIRE(result.modes.size() == 3);
        CHECK(result.modes[2].per_period() > 7);
        for (const FloquetMode& mode : result.modes) {
            CHECK(distance(mode.exponent, lambda, 1e9) < 1e-9);
            CHECK(mode.share(0) == Approx(1).epsilon(1e-12));
            CHECK(mode.kind == FloquetKind::oscillation);
        }
    }
    // Phi in closed form.
    const double omega = 3, zeta = 0.2, d = omega * std::sqrt(1 - zeta * zeta), T = 2 * pi;
    const double e = std::exp(-zeta * omega * T), c = std::cos(d * T), s = std::sin(d * T), r = zeta * omega / d;
    const Matrix Phi =
        (Matrix(2, 2) << e * (c + r * s), e * s / d, -e * omega * omega / d * s, e * (c - r * s)).finished();
    const PeriodicSystem one = oscillators(Vector::Constant(1, omega), Vector::Constant(1, zeta));
    CHECK((monodromy(one, 60) - Phi).norm() < 1e-12);
}

TEST_CASE("Floquet: strongly damped motions keep their exponents beside undamped ones", "[analytic]") {
    // Multipliers from 1 down to exp(-2 pi 16) = 2e-44, mixed by a rotation of the coordinates that turns with t.
    const Vector rates = (Vector(5) << 0, -0.5, -3, -8, -16).finished();
    const PeriodicSystem system = PeriodicSystem::first_order(2 * pi, 5, [&](double t, Matrix& E, Matrix& A) {
        // x = R(t) y, y' = D y: A = R' R^T + R D R^T, R turns the planes (1, 5) and (2, 4).
        Matrix R = Matrix::Identity(5, 5), dR = Matrix::Zero(5, 5);
        for (const Index i : {0, 1}) {
            const Index j = 4 - i;
            const auto n = static_cast<double>(i + 1);
            R(i, i) = R(j, j) = std::cos(n * t);
            R(j, i) = std::sin(n * t);
            R(i, j) = -R(j, i);
            dR(i, i) = dR(j, j) = -n * std::sin(n * t);
            dR(j, i) = n * std::cos(n * t);
            dR(i, j) = -dR(j, i);
        }
        E = Matrix::Identity(5, 5);
        A = dR * R.transpose() + R * rates.asDiagonal() * R.transpose();
    });
    const Floquet result = floquet(system, {.per_period = 20, .tolerance = 1e-10});
    REQUIRE(result.modes.size() == 5);
    for (const FloquetMode& mode : result.modes) {
        const double off = (rates.array() - mode.growth()).abs().minCoeff();
        CAPTURE(mode.exponent, off, mode.error);
        CHECK(off < 1e-9);
    }
    CHECK(result.damped_out == 0);
    // In one factor all below rounding is lost, and said to be.
    const Floquet single = floquet(system, {.per_period = 20, .factors = 1});
    CHECK(single.damped_out == 2);
    CHECK(single.modes.size() == 3);
}

TEST_CASE("Floquet: errors are estimated from above, and fall with the steps", "[analytic]") {
    const Vector omega = (Vector(3) << 0.7, 5.3, 9.6).finished(), zeta = (Vector(3) << 0.01, 0.02, 0.3).finished();
    const PeriodicSystem system = oscillators(omega, zeta);
    for (const int stages : {2, 3, 5})
        for (const double tolerance : {1e-3, 1e-5, 1e-8}) {
            const Floquet result =
                floquet(system, {.transition = {.stages = stages}, .tolerance = tolerance, .max_steps = 3000});
            REQUIRE(result.modes.size() == 3);
            CAPTURE(stages, tolerance, result.steps);
            for (Index k = 0; k < 3; ++k) {
                const FloquetMode& mode = entry(result.modes, k);
                const Complex expected(-zeta(k) * omega(k), omega(k) * std::sqrt(1 - zeta(k) * zeta(k)));
                const double error = std::abs(mode.exponent - expected);
                CHECK(error <= mode.error + 1e-14 * omega(k));
                if (result.note.empty()) CHECK(mode.error <= tolerance * std::max(1.0, omega(k)));
            }
        }
    const Floquet rough = floquet(system, {.transition = {.stages = 2}, .max_steps = 200});
    CHECK(rough.note.find("less accurate than wanted") != std::string::npos);
    // Below rounding no steps help, and none are wasted.
    const Floquet vain = floquet(system, {.tolerance = 1e-19, .max_steps = 1000000});
    CHECK(vain.steps < 5000);
    CHECK(vain.note.find("less accurate than wanted") != std::string::npos);
}

TEST_CASE("Floquet: motions too fast for the samples are distinguished from the others", "[analytic]") {
    const Vector omega = (Vector(2) << 0.7, 3000.3).finished(), zeta = Vector::Zero(2);
    const Floquet result = floquet(oscillators(omega, zeta));
    CHECK(result.note.empty());
    REQUIRE(result.modes.size() == 1);
    CHECK(std::abs(result.modes[0].exponent - Complex(0, 0.7)) < 1e-9);
    CHECK(result.damped_out + static_cast<int>(result.unresolved.size()) >= 1);
    // With samples enough they are as good as the others.
    const Floquet fine = floquet(oscillators((Vector(2) << 0.7, 33.3).finished(), zeta), {.per_period = 40});
    REQUIRE(fine.modes.size() == 2);
    CHECK(std::abs(fine.modes[1].exponent - Complex(0, 33.3)) < 1e-9);
    CHECK(fine.unresolved.empty());
    const Floquet coarse = floquet(oscillators((Vector(2) << 0.7, 33.3).finished(), zeta));
    CHECK(coarse.modes.size() == 1);
    CHECK(coarse.unresolved.size() == 1);
}

TEST_CASE("Floquet: the scheme of eq. 19 maps the frequency f to (N / pi) atan(pi f / N)", "[analytic]") {
    const Vector f = (Vector(4) << 0.32, 2.624, 5.345, 13.936).finished();
    for (const int N : {100, 500}) {
        const FloquetOptions options{.transition = {.method = TransitionMethod::midpoint}, .steps = N};
        const Floquet result = floquet(oscillators(f, Vector::Zero(4)), options);
        REQUIRE(result.modes.size() == 4);
        CHECK(result.steps == N);
        for (Index i = 0; i < 4; ++i) {
            const FloquetMode& mode = entry(result.modes, i);
            const double own = f(i), mapped = N / pi * std::atan(pi * own / N);
            CAPTURE(N, own);
            CHECK(mode.per_period() == Approx(mapped).epsilon(1e-11));
            CHECK(std::abs(mode.growth()) < 1e-12 * own);
            CHECK(std::isnan(mode.error));
        }
    }
    // With damping: mu = ((1 + lambda h / 2) / (1 - lambda h / 2))^N.
    const double omega = 2.3, zeta = 0.1, h = 2 * pi / 100;
    const Complex lambda(-zeta * omega, omega * std::sqrt(1 - zeta * zeta)),
        step = (1.0 + lambda * h / 2.0) / (1.0 - lambda * h / 2.0);
    const Floquet damped = floquet(oscillators(Vector::Constant(1, omega), Vector::Constant(1, zeta)),
                                   {.transition = {.method = TransitionMethod::midpoint}, .steps = 100});
    CHECK(std::abs(damped.modes.at(0).exponent - std::log(step) / h) < 1e-11);
}

TEST_CASE("Floquet: free motion is a rigid pair, defective, and no instability", "[analytic]") {
    // A mass without spring beside an oscillator that it excites periodically.
    const PeriodicSystem system = PeriodicSystem::second_order(2 * pi, 2, [](double t, SecondOrderSystem& out) {
        out.M = (Matrix(2, 2) << 3, 0.4 * std::cos(t), 0.4 * std::cos(t), 1).finished();
        out.C = (Matrix(2, 2) << 0, -0.8 * std::sin(t), 0, 0.1).finished();
        out.K = (Matrix(2, 2) << 0, -0.4 * std::cos(t), 0, 2.3).finished();  // d^2/dt^2 of 0.4 cos(t) y in row 1
        out.K_elastic = (Matrix(2, 2) << 0, 0, 0, 2.3).finished();
    });
    for (const Floquet& result : {floquet(system), hill(system)}) {
        REQUIRE(result.modes.size() == 3);
        int rigid = 0;
        for (const FloquetMode& mode : result.modes)
            if (mode.kind == FloquetKind::rigid) {
                ++rigid;
                CHECK(std::abs(mode.exponent) < 1e-6);
                CHECK(std::abs(mode.shape(0.3)(0)) > 1e3 * std::abs(mode.shape(0.3)(1)));
            }
        CHECK(rigid == 2);
        CHECK(result.growth() < -0.01);
    }
    const Floquet result = floquet(system);
    CHECK(kind_name(result.modes[0]) == "rigid (one of a defective pair)");
    CHECK(result.modes[0].condition > 1e6);
}

TEST_CASE("Floquet: equal exponents are counted as often as they occur", "[analytic]") {
    // Two oscillators of the same damping, above critical: -1 and -2, each twice.
    const Matrix one = Matrix::Identity(2, 2);
    for (const Floquet& result : {floquet(constant(one, 3 * one, 2 * one)), hill(constant(one, 3 * one, 2 * one))}) {
        REQUIRE(result.modes.size() == 4);
        for (std::size_t i = 0; i < 4; ++i) {
            CHECK(result.modes[i].kind == FloquetKind::aperiodic);
            CHECK(result.modes[i].growth() == Approx(i < 2 ? -1 : -2).epsilon(1e-9));
        }
    }
}

TEST_CASE("Floquet: algebraic states are no modes", "[analytic]") {
    const PeriodicSystem system = PeriodicSystem::first_order(2 * pi, 2, [](double t, Matrix& E, Matrix& A) {
        E = (Matrix(2, 2) << 1, 0, 0, 0).finished();
        A = (Matrix(2, 2) << -1, std::cos(t), 1, 2).finished();
    });
    for (const Floquet& result : {floquet(system), hill(system)}) {
        REQUIRE(result.modes.size() == 1);
        CHECK(std::abs(result.modes[0].exponent + 1.0) < 1e-10);
        CHECK(result.damped_out == 1);
    }
}

TEST_CASE("Floquet: bad options are refused with the value and the limit", "[property]") {
    const PeriodicSystem system = mathieu(2, 0.3);
    check_refused([&] { (void)floquet(system, {.steps = -1}); }, {"steps per period", "-1"});
    check_refused([&] { (void)floquet(system, {.per_period = -1}); }, {"frequency per period", "-1"});
    check_refused([&] { (void)floquet(system, {.tolerance = 0}); }, {"tolerance", "0"});
    check_refused([&] { (void)floquet(system, {.max_steps = 0}); }, {"limit of steps", "0"});
    check_refused([&] { (void)floquet(system, {.factors = 0}); }, {"number of factors", "0"});
    const auto refused = [](const PeriodicSystem& of, const BladeSymmetry& symmetry, const Matrix& weight,
                            std::initializer_list<std::string> parts) {
        FloquetOptions options;
        options.symmetry = symmetry;
        options.weight = weight;
        check_refused([&] { (void)floquet(of, options); }, parts);
    };
    refused(system, {0, {}}, {}, {"identical parts", "0"});
    refused(system, {2, Matrix::Identity(3, 3)}, {}, {"size of P", "3 x 3"});
    refused(system, {3, -Matrix::Identity(1, 1)}, {}, {"P^3", "2", "below 1e-9"});
    // Half a period of Mathieu's equation is not like the other half.
    refused(system, {2, Matrix::Identity(1, 1)}, {}, {"whole period"});
    refused(scalar(-1, 0), {}, Matrix::Identity(2, 2), {"weight", "2 x 2"});
    refused(constant(-Matrix::Identity(1, 1), Matrix::Zero(1, 1), Matrix::Identity(1, 1)), {}, {},
            {"inertia of row 0", "-1"});
    check_refused([&] { (void)hill(system, {.harmonics = 0}); }, {"number of harmonics", "0"});
    check_refused([&] { (void)hill(system, {.harmonics = 5, .samples = 20}); }, {"number of samples", "20", "21"});
}

TEST_CASE("periodic system: its mean over a period is the constant part of its Fourier series", "[analytic]") {
    const PeriodicSystem one = mathieu(3, 0.7, 0.2);
    for (int samples : {3, 8, 24}) {  // the one harmonic there is
        const SecondOrderSystem mean = mean_over_period(one, samples);
        CHECK(std::abs(mean.M(0, 0) - 1) < 1e-15);
        CHECK(std::abs(mean.C(0, 0) - 0.2) < 1e-15);
        CHECK(std::abs(mean.K(0, 0) - 3) < 1e-14);
        CHECK(std::abs(mean.K_elastic(0, 0) - 3) < 1e-14);
    }
    // One sample is no mean: the value at the start.
    CHECK(mean_over_period(one, 1).K(0, 0) == Approx(3 - 2 * 0.7).epsilon(1e-15));
    check_refused([&] { (void)mean_over_period(one, 0); }, {"mean over a period", "number of samples = 0", ">= 1"});
    check_refused([] { (void)mean_over_period(scalar(1, 1), 4); }, {"order = 1", "2 for M, C and K"});
}
