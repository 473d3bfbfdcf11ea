// MAC of motions with periodic shapes, and tracking by it.
#include "mbs/base/error.hpp"
#include "solvers/mode_names/detail/floquet_mac.hpp"
#include "solvers/mode_names/detail/tracking.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

namespace cardan::testing::floquet_mac {

using namespace solvers;

namespace {

constexpr Eigen::Index n = 4;
constexpr double period = 2;

SecondOrderSystem weights(Random& random) {
    SecondOrderSystem system;
    for (Matrix* m : {&system.M, &system.C, &system.K, &system.K_elastic}) {
        Matrix root(n, n);
        for (Eigen::Index j = 0; j < n; ++j) root.col(j) = random_state(random, static_cast<int>(n));
        *m = root * root.transpose() + Matrix::Identity(n, n);
    }
    return system;
}

CampbellMode motion(Random& random, Complex exponent, FloquetKind kind = FloquetKind::oscillation) {
    CampbellMode mode;
    FloquetMode& f = mode.floquet.emplace();
    f.exponent = exponent;
    f.period = period;
    f.kind = kind;
    f.first_harmonic = -2;
    f.harmonics.resize(n, 5);
    for (Eigen::Index j = 0; j < 5; ++j) {
        const Vector re = random_state(random, static_cast<int>(n)), im = random_state(random, static_cast<int>(n));
        f.harmonics.col(j) = re.cast<Complex>() + Complex(0, 1) * im.cast<Complex>();
    }
    mode.mode = {exponent, f.harmonics.col(2)};
    return mode;
}

// A motion with another of its harmonics as the principal one.
CampbellMode seen_from(CampbellMode mode, int harmonic) {
    mode.floquet->exponent += Complex(0, 2 * pi / period * harmonic);
    mode.floquet->first_harmonic -= harmonic;
    mode.mode = {mode.floquet->exponent, mode.floquet->harmonics.col(-mode.floquet->first_harmonic)};
    return mode;
}

CampbellMode conjugate(CampbellMode mode) {
    FloquetMode& f = *mode.floquet;
    f.exponent = std::conj(f.exponent);
    f.harmonics = f.harmonics.conjugate().rowwise().reverse().eval();
    f.first_harmonic = -(f.first_harmonic + 4);
    mode.mode.eigenvalue = f.exponent;
    return mode;
}

double mac(const SecondOrderSystem& system, const CampbellMode& a, const CampbellMode& b) {
    return periodic_mac(system, {&a}, {b}).mac(0, 0);
}

}  // namespace

TEST_CASE("periodic MAC: one for a motion and itself in any phase and size, with up to two harmonics between",
          "[property]") {
    Random random(3);
    const SecondOrderSystem system = weights(random);
    const CampbellMode one = motion(random, {-0.1, 20}), other = motion(random, {-0.3, 21});
    for (int shift = -2; shift <= 2; ++shift) {
        CAPTURE(shift);
        CampbellMode same = seen_from(one, shift);
        same.floquet->harmonics *= Complex(0.3, -2);
        CHECK(mac(system, one, same) == Approx(1).epsilon(1e-12));
        CHECK(mac(system, same, one) == Approx(1).epsilon(1e-12));
        CHECK(mac(system, other, same) < 0.9);
    }
    CHECK(mac(system, one, other) == Approx(mac(system, other, one)).epsilon(1e-12));
}

TEST_CASE("periodic MAC: where two motions exchange a harmonic the branches keep their principal ones", "[property]") {
    // Unit matrices: a and b hold their energy in one harmonic each, at frequencies that differ by one period.
    SecondOrderSystem system;
    system.M = system.K_elastic = Matrix::Identity(n, n);
    const auto mixture = [](double in_principal, double beside, Eigen::Index row, int at) {
        CampbellMode mode;
        FloquetMode& f = mode.floquet.emplace();
        f.period = period;
        f.exponent = Complex(0, 20 - pi * at);
        f.first_harmonic = std::min(at, 0);
        f.harmonics = ComplexMatrix::Zero(n, 2);
        f.harmonics(row, -f.first_harmonic) = in_principal;
        f.harmonics(1 - row, at - f.first_harmonic) = beside;
        mode.mode = {f.exponent, f.harmonics.col(-f.first_harmonic)};
        return mode;
    };
    // Before the exchange 0.8 and 0.6, after it with the other sign.
    const CampbellMode a = mixture(0.8, 0.6, 0, 1), b = mixture(0.8, -0.6, 1, -1);
    const std::vector<CampbellMode> after{mixture(0.8, -0.6, 0, 1), mixture(0.8, 0.6, 1, -1)};
    const PeriodicMac likeness = periodic_mac(system, {&a, &b}, after);
    for (Eigen::Index i : {0, 1}) {
        CHECK(likeness.score(i, i) > 0.3);
        CHECK(likeness.score(i, 1 - i) < 0.25);
        CHECK(likeness.mac(i, 1 - i) > 0.8);  // what an infinitely small step would follow
    }
}

TEST_CASE("periodic MAC: at low frequencies the complex conjugate is the same motion", "[property]") {
    Random random(4);
    const SecondOrderSystem system = weights(random);
    const CampbellMode low = motion(random, {-0.1, 0.2}), high = motion(random, {-0.1, 20});
    CHECK(mac(system, low, conjugate(low)) == Approx(1).epsilon(1e-12));
    CHECK(mac(system, high, high) == Approx(1).epsilon(1e-12));
}

TEST_CASE("periodic MAC: rigid motions are compared by shape, and only with motions without elastic energy",
          "[property]") {
    Random random(5);
    const SecondOrderSystem system = weights(random);
    CampbellMode rigid = motion(random, {1e-9, 0}, FloquetKind::rigid), elastic = motion(random, {-0.1, 3});
    rigid.row = 1;
    CampbellMode same = rigid;
    same.floquet->harmonics *= 1e-3;
    same.floquet->exponent = same.mode.eigenvalue = -2e-9;
    CHECK(mac(system, rigid, same) == Approx(1).epsilon(1e-12));
    CHECK(mac(system, rigid, elastic) == 0);
    elastic.row = 0;
    CHECK(mac(system, rigid, elastic) > 0);
}

TEST_CASE("tracking: tracks follow a score supplied by the caller", "[property]") {
    CampbellPoint point;
    for (const double frequency : {1.0, 2.0}) {
        CampbellMode& mode = point.modes.emplace_back();
        mode.mode = {Complex(0, frequency), ComplexVector::Zero(2)};
    }
    Tracker tracker;
    tracker.add(Matrix(0, 2), Matrix(0, 2), point);
    REQUIRE(tracker.last().size() == 2);
    CHECK(tracker.last()[0]->mode.eigenvalue.imag() == 1);
    Matrix likeness(2, 2);
    likeness << 0.2, 0.9, 0.9, 0.2;
    tracker.add(likeness, likeness, point);
    CHECK(tracker.last()[0]->mode.eigenvalue.imag() == 2);
    CHECK(tracker.last()[1]->mode.eigenvalue.imag() == 1);
    check_refused([&] { tracker.add(likeness, Matrix(1, 2), point); },
                  {"size of a matrix of likenesses = 1 x 2", "2 x 2"});
}

}  // namespace cardan::testing::floquet_mac
