// The vectors of the kernels against Eigen's, in both of their forms: registers of four doubles and complex numbers.
#include "mbs/base/aligned_numbers.hpp"
#include "mbs/base/elementary.hpp"
#include "mbs/base/registers/packed.hpp"
#include "mbs/model/inertia.hpp"
#include "mbs/model/spatial.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

#include <bit>
#include <cstdint>
#include <utility>

using namespace cardan;
using namespace cardan::testing;

namespace {

Vec3T<double> random_numbers(Random& random, double) {
    return random_vector(random);
}
Vec3T<Complex> random_numbers(Random& random, Complex) {
    return random_vector(random).cast<Complex>() + Complex(0, 1) * random_vector(random).cast<Complex>();
}

template <class S>
double difference(const Packed3<S>& a, const Vec3T<S>& b) {
    return (a.vector() - b).norm();
}
template <class S>
double difference(const Packed33<S>& a, const Mat3T<S>& b) {
    return (a.matrix() - b).norm();
}

}  // namespace

TEMPLATE_TEST_CASE("packed vectors: products are those of Eigen, without conjugation", "[analytic]", double, Complex) {
    using S = TestType;
    Random random(3);
    for (int round = 0; round < 50; ++round) {
        const Vec3T<S> a = random_numbers(random, S()), b = random_numbers(random, S());
        Mat3T<S> A, B;
        for (int j = 0; j < 3; ++j) A.col(j) = random_numbers(random, S()), B.col(j) = random_numbers(random, S());
        const Packed3<S> pa = Packed3<S>::of(a), pb = Packed3<S>::of(b);
        const Packed33<S> pA = Packed33<S>::of(A), pB = Packed33<S>::of(B);
        CHECK(difference<S>(cross(pa, pb), cross<S>(a, b)) < 1e-15);
        CHECK(std::abs(dot(pa, pb) - dot<S>(a, b)) < 1e-15);
        CHECK(difference<S>(pA * pb, A * b) < 2e-15);
        CHECK(difference<S>(pA * pB, A * B) < 2e-15);
        CHECK(difference<S>(transpose(pA), A.transpose()) == 0);
        CHECK(difference<S>(minus_times_skew(pA, pb), -A * skew<S>(b)) < 2e-15);
        CHECK(difference<S>(rotated(pA, pB), A * B * A.transpose()) < 1e-14);
        CHECK(difference<S>(S(2) * pa - pb, S(2) * a - b) < 1e-15);
        CHECK(cross(pa, pb).lanes[3] == S(0));
        CHECK(broadcast<1>(pa).lanes[3] == a(1));
        CHECK(times(broadcast<2>(pa), Packed3<S>::all(S(2))).lanes[3] == S(2) * a(2));
        CHECK(transpose(pA)[1].lanes[3] == S(0));
    }
}

TEST_CASE("packed vectors: Binet's tensor of an inertia tensor", "[analytic]") {
    Random random(5);
    const Mat3 J = random_inertia(random).J;
    CHECK((binet(Packed33<double>::of(J)).matrix() - binet_tensor<double>(J)).norm() < 1e-15 * J.norm());
}

TEST_CASE("packed vectors: aligned like a register, whatever the flags of the compiler", "[property]") {
    CHECK(alignof(Packed3<double>) == 32);
    CHECK(sizeof(Packed3<double>) == 32);
    CHECK(sizeof(Packed33<double>) == 96);
}

TEST_CASE("sines: within 4e-16 of the standard library's in extended precision, at any size of angle", "[property]") {
    Random random(7);
    // Sizes that are no multiple of a register, and angles up to those of a year at 12 rpm.
    for (const double size : {1e-8, 1.0, 100.0, 1e4, 4e7})
        for (const int n : {1, 3, 4, 7, 61}) {
            Vector q = random_state(random, n, size), s(n), c(n);
            q(0) = -0.0;
            sines(q, s, c);
            CHECK(s(0) == 0);
            CHECK(c(0) == 1);
            for (int i = 0; i < n; ++i) {
                const auto angle = static_cast<long double>(q(i));
                CAPTURE(size, q(i));
                CHECK(std::abs(static_cast<double>(s(i) - std::sin(angle))) < 4e-16);
                CHECK(std::abs(static_cast<double>(c(i) - std::cos(angle))) < 4e-16);
            }
        }
}

TEST_CASE("sines: of complex angles", "[analytic]") {
    ComplexVector q(2), s(2), c(2);
    q << Complex(0.3, 0), Complex(0.3, 1e-40);
    sines(q, s, c);
    CHECK(s(1).real() == Approx(std::sin(0.3)));
    CHECK(s(1).imag() / 1e-40 == Approx(std::cos(0.3)));
    CHECK(c(1).imag() / 1e-40 == Approx(-std::sin(0.3)));
}

TEST_CASE("aligned numbers: zero, and at a multiple of 32 bytes, copied as well", "[property]") {
    for (std::size_t blocks = 1; blocks < 20; ++blocks) {
        AlignedNumbers numbers(blocks);
        for (std::size_t i = 0; i < 4 * blocks; ++i) CHECK(numbers.data()[i] == 0);
        numbers.data()[4 * blocks - 1] = 7;
        const AlignedNumbers copy = numbers;
        CHECK(copy.data()[4 * blocks - 1] == 7);
        CHECK(copy.blocks() == blocks);
        for (const double* x : {std::as_const(numbers).data(), copy.data()})
            CHECK(std::bit_cast<std::uintptr_t>(x) % 32 == 0);
    }
}
