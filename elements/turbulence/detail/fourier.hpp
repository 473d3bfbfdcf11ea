/// @file
/// Complex Fourier transforms of any length with small factors, by Eigen's kissfft.
#pragma once

#include "mbs/base/types.hpp"

#include <memory>

namespace cardan::detail {

/// Transforms without a factor; plans are kept. Not safe for use by several threads at once.
class Fourier {
public:
    Fourier();
    Fourier(const Fourier&) = delete;
    Fourier& operator=(const Fourier&) = delete;
    ~Fourier();

    /// out_k = sum_j in_j exp(-2 pi i j k/n)
    /// @param size  n, at least 2
    /// @param out   another place
    void forward(const Complex* in, int size, Complex* out);
    /// Transforms back, with exp(+2 pi i j k/n).
    void inverse(const Complex* in, int size, Complex* out);

private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
};

/// The smallest even number not below n, at least 2, with no prime factor above 5: fast to transform.
int fast_length(int n);
/// n's largest prime factor.
int largest_factor(int n);
/// Above it a transform takes too long.
inline constexpr int max_factor = 100;

}  // namespace cardan::detail
