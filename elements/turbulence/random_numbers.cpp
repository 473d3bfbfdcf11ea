#include "elements/turbulence/random_numbers.hpp"

#include <cmath>
#include <cstddef>

namespace cardan {

std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = std::uint64_t{0xD2511F53U} * counter[0], b = std::uint64_t{0xCD9E8D57U} * counter[2];
        counter = {static_cast<std::uint32_t>(b >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(b),
                   static_cast<std::uint32_t>(a >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(a)};
        key[0] += 0x9E3779B9U;  // golden ratio
        key[1] += 0xBB67AE85U;  // root of 3, less 1
    }
    return counter;
}

namespace {

// In the middle of its 2^-32: never 0 or 1.
double unit_number(std::uint32_t bits) {
    return (bits + 0.5) * 0x1p-32;
}

Complex complex_normal(std::uint32_t size, std::uint32_t turn) {
    const double r = std::sqrt(-std::log(unit_number(size))), angle = 2 * pi * unit_number(turn);
    return {r * std::cos(angle), r * std::sin(angle)};
}

}  // namespace

NormalNumbers::NormalNumbers(std::uint64_t seed, std::uint32_t stream, std::uint32_t line)
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}, stream_(stream), line_(line) {}

void NormalNumbers::fill(std::uint64_t first, std::span<Complex> out) const {
    auto block = static_cast<std::uint32_t>(first / 2);
    for (std::size_t i = 0; i < out.size(); i += 2, ++block) {
        const auto bits = philox({block, line_, stream_, 0}, key_);
        out[i] = complex_normal(bits[0], bits[1]);
        if (i + 1 < out.size()) out[i + 1] = complex_normal(bits[2], bits[3]);
    }
}

}  // namespace cardan
