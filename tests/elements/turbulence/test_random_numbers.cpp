// Philox against the authors' own numbers; complex normal numbers by their moments and correlations.
#include "elements/turbulence/random_numbers.hpp"
#include "tests/support/catch.hpp"

#include <cmath>
#include <vector>

using namespace cardan;

namespace {

using PhiloxWords = std::array<std::uint32_t, 4>;

std::vector<Complex> normal_numbers(std::uint64_t seed, std::uint32_t stream, std::uint32_t line, std::size_t count) {
    std::vector<Complex> out(count);
    NormalNumbers(seed, stream, line).fill(0, out);
    return out;
}

// Mean of a conj(b), in units of its standard error if they are independent.
Complex standard_correlation(const std::vector<Complex>& a, const std::vector<Complex>& b, std::size_t shift = 0) {
    Complex sum = 0;
    for (std::size_t i = 0; i + shift < a.size(); ++i) sum += a[i + shift] * std::conj(b[i]);
    return sum / std::sqrt(static_cast<double>(a.size() - shift) / 2);
}

}  // namespace

TEST_CASE("random numbers: Philox4x32-10 equals the known answers of its authors", "[published]") {
    // Random123 1.09, tests/kat_vectors: philox4x32, 10 rounds.
    CHECK(philox({0, 0, 0, 0}, {0, 0}) == PhiloxWords{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    CHECK(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}) ==
          PhiloxWords{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
          PhiloxWords{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("random numbers: words of a counter that goes up are uniform, by chi-squared over 256 classes",
          "[property]") {
    constexpr int blocks = 16384, classes = 256;
    for (const int shift : {0, 8, 24}) {
        std::vector<int> count(classes);
        for (std::uint32_t i = 0; i < blocks; ++i)
            for (const std::uint32_t word : philox({i, 3, 1, 0}, {7, 0})) ++count[(word >> shift) & 0xff];
        double chi_squared = 0;
        constexpr double expected = 4.0 * blocks / classes;
        for (const int n : count) chi_squared += (n - expected) * (n - expected) / expected;
        CAPTURE(shift, chi_squared);
        CHECK(std::abs(chi_squared - (classes - 1)) < 3 * std::sqrt(2.0 * (classes - 1)));
    }
}

TEST_CASE("random numbers: moments are those of complex normal numbers", "[analytic]") {
    const std::vector<Complex> z = normal_numbers(1, 0, 1, 100000);
    const double root = std::sqrt(static_cast<double>(z.size()));
    Complex mean = 0, square = 0;
    double power = 0, fourth = 0, sixth_moment = 0;
    for (const Complex value : z) {
        const double p = std::norm(value);
        mean += value;
        square += value * value;
        power += p;
        fourth += p * p;
        sixth_moment += p * p * p;
    }
    // |z|^2 is exponential: E p^n = n!, var p^n = (2n)! - n!^2.
    CHECK(std::abs(mean) < 3 * root);
    CHECK(std::abs(square) < 3 * root * std::sqrt(2.0));
    const auto count = static_cast<double>(z.size());
    CHECK(std::abs(power / count - 1) < 3 / root);
    CHECK(std::abs(fourth / count - 2) < 3 * std::sqrt(20.0) / root);
    CHECK(std::abs(sixth_moment / count - 6) < 3 * std::sqrt(684.0) / root);
}

TEST_CASE("random numbers: of another seed, stream, line or index they are independent", "[property]") {
    constexpr std::size_t count = 20000;
    const std::vector<Complex> z = normal_numbers(5, 1, 9, count);
    for (const auto& [other, shift] : {std::pair(normal_numbers(6, 1, 9, count), 0),
                                       {normal_numbers(5 + (std::uint64_t{1} << 32), 1, 9, count), 0},
                                       {normal_numbers(5, 2, 9, count), 0},
                                       {normal_numbers(5, 1, 10, count), 0},
                                       {z, 1},
                                       {z, 2},
                                       {z, 64}}) {
        const Complex c = standard_correlation(z, other, static_cast<std::size_t>(shift));
        CAPTURE(shift, c);
        CHECK(std::abs(c.real()) < 3);
        CHECK(std::abs(c.imag()) < 3);
    }
}

TEST_CASE("random numbers: those from an index on are those from there on", "[property]") {
    const std::vector<Complex> all = normal_numbers(5, 1, 9, 40);
    std::vector<Complex> part(7);
    NormalNumbers(5, 1, 9).fill(18, part);
    for (std::size_t i = 0; i < part.size(); ++i) CHECK(part[i] == all[18 + i]);
}
