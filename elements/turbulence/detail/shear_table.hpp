/// @file
/// Mann's shear at many wave numbers.
#pragma once

#include "elements/turbulence/mann_tensor.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cardan::detail {

/// mann_shear() as cubics of (k L)^2, 64 to an octave: to 1e-9 of it, in a few nanoseconds.
class ShearTable {
public:
    /// @param low, high  range of (k L)^2, > 0
    ShearTable(double gamma, double low, double high) : first_(segment(low)) {
        for (std::uint64_t i = first_; i <= segment(high); ++i) {
            const double from = std::bit_cast<double>(i << fraction_bits),
                         to = std::bit_cast<double>((i + 1) << fraction_bits);
            std::array<double, 4> f{};  // at equal distances
            for (int j = 0; j < 4; ++j)
                f[static_cast<std::size_t>(j)] = mann_shear(std::sqrt(from + (to - from) * j / 3), gamma);
            cubics_.push_back({f[0], (-11 * f[0] + 18 * f[1] - 9 * f[2] + 2 * f[3]) / 2,
                               9 * (2 * f[0] - 5 * f[1] + 4 * f[2] - f[3]) / 2,
                               9 * (-f[0] + 3 * f[1] - 3 * f[2] + f[3]) / 2});
        }
    }
    double operator()(double kL_square) const {
        const auto& c = cubics_[segment(kL_square) - first_];
        constexpr std::uint64_t below = (std::uint64_t{1} << fraction_bits) - 1;
        const double t =
            static_cast<double>(std::bit_cast<std::uint64_t>(kL_square) & below) / static_cast<double>(below + 1);
        return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
    }

private:
    // The exponent and the first 6 of 52 bits of the fraction: as integers, numbers > 0 are in their own order.
    static constexpr int fraction_bits = 46;
    static std::uint64_t segment(double value) { return std::bit_cast<std::uint64_t>(value) >> fraction_bits; }

    std::uint64_t first_;
    std::vector<std::array<double, 4>> cubics_;
};

}  // namespace cardan::detail
