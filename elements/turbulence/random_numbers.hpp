/// @file
/// Random numbers that are a function of where they belong and not of what was drawn before: the same on every machine
/// and for any number of threads.
#pragma once

#include "mbs/base/types.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace cardan {

/// Philox4x32 of ten rounds [Salmon, Moraes, Dror, Shaw, Parallel random numbers: as easy as 1, 2, 3, Proc. SC11
/// (2011)]: mixes a counter of four words under a key of two. Every bit of the result depends on all of both; it passes
/// TestU01's BigCrush for counters that go up by one.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// Complex normal numbers of a place: real and imaginary parts are independent and normal with variance 1/2, so that
/// E|z|^2 = 1 and E z^2 = 0 [Box, Muller, Ann. Math. Statist. 29 (1958) 610]. Numbers of different seeds, streams,
/// lines and indices are independent. |z| is at most 4.75, as the numbers have 32 bits.
class NormalNumbers {
public:
    /// @param stream  what the numbers are for, such as a component of the velocity
    /// @param line    which line of a spectrum
    NormalNumbers(std::uint64_t seed, std::uint32_t stream, std::uint32_t line);

    /// Numbers first, first + 1 ...  Allocates nothing.
    /// @param first  even; the last index is below 2^33
    void fill(std::uint64_t first, std::span<Complex> out) const;

private:
    std::array<std::uint32_t, 2> key_;
    std::uint32_t stream_, line_;
};

}  // namespace cardan
