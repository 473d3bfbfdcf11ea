// Mann's tensor at single wave numbers.
#include "elements/turbulence/mann_tensor.hpp"
#include "mbs/base/decompositions.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

#include <array>
#include <cmath>

namespace cardan::testing::mann_tensor_tests {

namespace {

// 2F1(1/3, 17/6; 4/3; -x^-2) by its series at 1/(1 + x^2), after Pfaff's transformation.
double hypergeometric(double x) {
    const double y = 1 / (1 + x * x);
    double term = 1, sum = 1;
    for (int n = 0; n < 20000 && std::abs(term) > 1e-18; ++n) {
        term *= (1.0 / 3 + n) * (-1.5 + n) / ((4.0 / 3 + n) * (1 + n)) * y;
        sum += term;
    }
    return std::cbrt(x * x * y) * sum;
}

Vec3 random_wave(Random& random) {
    Vec3 k;
    for (double& entry : k) entry = (uniform(random, 0, 1) < 0.5 ? -1 : 1) * std::pow(10, uniform(random, -2, 2));
    return k;
}

}  // namespace

TEST_CASE("Mann's shear: the hypergeometric function by its series", "[analytic]") {
    for (const double x : {0.02, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0, 1e4}) {
        CAPTURE(x);
        CHECK(mann_shear(x, 3.9) ==
              Approx(3.9 / (std::cbrt(x * x) * std::sqrt(hypergeometric(x)))).epsilon(x < 0.1 ? 1e-9 : 1e-13));
    }
    // Of eddies in the inertial range the life goes with k^(-2/3).
    CHECK(mann_shear(1e6, 1) == Approx(1e-4).epsilon(1e-11));
}

TEST_CASE("Mann's shear: values of another program", "[discrete]") {
    CHECK(mann_shear(0.1, 3.9) == Approx(47.006971).epsilon(2e-8));
    CHECK(mann_shear(1, 3.9) == Approx(4.814281).epsilon(2e-7));
    CHECK(mann_shear(10, 3.9) == Approx(0.843189).epsilon(1e-6));
}

TEST_CASE("Mann's tensor: without shear von Karman's isotropic one", "[analytic]") {
    Random random(1);
    const MannParameters isotropic{0, 20, 0.3};
    for (int i = 0; i < 50; ++i) {
        const Vec3 k = random_wave(random) / 20;
        const double size = k.norm(), kL = 20 * size;
        const double E = 0.3 * std::pow(20, 5.0 / 3) * std::pow(kL, 4) * std::pow(1 + kL * kL, -17.0 / 6);
        const Mat3 right =
            E / (4 * pi * std::pow(size, 4)) * (size * size * Mat3::Identity() - k * k.transpose()).eval();
        CHECK(max_abs(mann_tensor(isotropic, k) - right) < 1e-12 * right.trace());
    }
}

TEST_CASE("Mann's tensor: symmetric, positive semidefinite, without divergence, the square of its root", "[property]") {
    Random random(2);
    for (int i = 0; i < 300; ++i) {
        const MannParameters parameters{uniform(random, 0, 5), uniform(random, 10, 60), uniform(random, 0.01, 1)};
        const Vec3 k = random_wave(random) / parameters.length_scale;
        const Mat3 Phi = mann_tensor(parameters, k), A = mann_root(parameters, k);
        CAPTURE(k.transpose(), parameters.gamma);
        const double size = Phi.trace();
        CHECK(max_abs(Phi - Phi.transpose()) == 0);
        CHECK(Eigen::SelfAdjointEigenSolver<Mat3>(Phi).eigenvalues().minCoeff() > -1e-9 * size);
        CHECK(max_abs(Phi * k) < 1e-9 * k.norm() * size);
        CHECK(max_abs(A.transpose() * k) < 1e-9 * k.norm() * std::sqrt(size));
        CHECK(max_abs(A * A.transpose() - Phi) < 1e-9 * size);
        // Mirrored left to right, and the conjugate of the opposite wave.
        const Vec3 mirror(1, -1, 1);
        const Mat3 mirrored = mann_tensor(parameters, mirror.cwiseProduct(k));
        CHECK(max_abs(mirrored - mirror.asDiagonal() * Phi * mirror.asDiagonal()) < 1e-12 * size);
        CHECK(max_abs(mann_tensor(parameters, -k) - Phi) < 1e-12 * size);
    }
}

TEST_CASE("Mann's tensor: where its formulas divide by zero it is the limit", "[property]") {
    const MannParameters parameters{3.9, 1, 1};
    CHECK(mann_tensor(parameters, Vec3::Zero()) == Mat3::Zero());
    CHECK(mann_root(parameters, Vec3::Zero()) == Mat3::Zero());
    for (const Vec3& k : {Vec3(0, 0.7, -0.4), Vec3(0, -2, 0.0), Vec3(0, 0, 1.5), Vec3(1, 0, 0.0), Vec3(0.4, 0, 2)}) {
        CAPTURE(k.transpose());
        const Mat3 there = mann_tensor(parameters, k), near = mann_tensor(parameters, k + Vec3(1e-9, 2e-9, 1e-9));
        CHECK(max_abs(there - near) < 1e-7 * there.trace());
        const Mat3 A = mann_root(parameters, k);
        CHECK(max_abs(A * A.transpose() - there) < 1e-12 * there.trace());
    }
}

TEST_CASE("Mann's tensor: parameters of the standard", "[published]") {
    // IEC 61400-1: Lambda_1 = 42 m from 60 m on, L = 0.8 Lambda_1; sigma_iso = 0.55 sigma_1.
    const MannParameters high = iec_mann(90, 2), low = iec_mann(40, 2);
    CHECK(high.gamma == 3.9);
    CHECK(high.length_scale == Approx(33.6));
    CHECK(low.length_scale == Approx(0.8 * 28));
    for (const MannParameters& p : {high, low})  // 0.688344: a third of B(5/2, 1/3)
        CHECK(0.688344 * p.dissipation * std::cbrt(p.length_scale * p.length_scale) == Approx(1.21).epsilon(1e-6));
}

TEST_CASE("Mann's tensor: parameters that are refused", "[property]") {
    check_refused([] { MannParameters{-1, 30, 1}.check(); }, {"gamma = -1", "0 (isotropic) to 100"});
    check_refused([] { MannParameters{not_a_number, 30, 1}.check(); }, {"gamma = nan"});
    check_refused([] { MannParameters{3.9, 0, 1}.check(); }, {"length scale L = 0", "> 0"});
    check_refused([] { MannParameters{3.9, 30, infinite}.check(); }, {"dissipation", "inf"});
    check_refused([] { (void)iec_mann(0, 1); }, {"height of the hub = 0"});
    check_refused([] { (void)iec_mann(90, -1); }, {"sigma_1 = -1"});
}

}  // namespace cardan::testing::mann_tensor_tests
