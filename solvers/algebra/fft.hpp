/// @file
/// Discrete Fourier transform of real numbers.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace cardan::solvers {

/// X_k = sum_j x_j exp(-2 pi i j k/n), k = 0 ... n/2, for one length n, in O(n log n) for every n (lengths with a large
/// prime factor by convolution, which kissfft, that is Eigen's, lacks). Not safe for use by several threads at once.
class RealFourier {
public:
    /// @throws InputError for a size of 0 or beyond 2^28
    explicit RealFourier(std::size_t size);
    RealFourier(const RealFourier&) = delete;
    RealFourier& operator=(const RealFourier&) = delete;
    ~RealFourier();

    std::size_t size() const { return size_; }                 ///< n
    std::size_t frequencies() const { return size_ / 2 + 1; }  ///< number of X_k
    /// @param x  n numbers
    /// @param X  out, frequencies() numbers
    void transform(std::span<const double> x, std::span<std::complex<double>> X);

private:
    struct Plan;
    std::size_t size_;
    std::unique_ptr<Plan> plan_;
};

}  // namespace cardan::solvers
