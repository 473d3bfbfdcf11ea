#include "solvers/algebra/fft.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/sizes.hpp"
#include "mbs/base/types.hpp"

#include <bit>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace cardan::solvers {

namespace {

using Complex = std::complex<double>;

// Eigen's transform takes O(n p) for the largest prime factor p; from here on the convolution is faster.
constexpr std::size_t largest_factor = 100;

std::size_t largest_prime_factor(std::size_t n) {
    std::size_t largest = 1;
    for (std::size_t p = 2; p * p <= n; ++p)
        for (; n % p == 0; n /= p) largest = p;
    return n > 1 ? n : largest;
}

}  // namespace

/// With j k = (j^2 + k^2 - (k - j)^2)/2 a transform is a convolution with the chirp exp(pi i j^2/n)
/// [Bluestein, IEEE Trans. Audio Electroacoust. 18 (1970) 451-455], which is done by transforms of length 2^m.
struct RealFourier::Plan {
    Eigen::FFT<double> fft{Eigen::FFT<double>::impl_type(), Eigen::FFT<double>::HalfSpectrum};
    std::vector<Complex> chirp, kernel;  // exp(-pi i j^2/n); transform of its conjugate; empty: not needed
    std::vector<Complex> a, A;

    explicit Plan(std::size_t n) {
        if (largest_prime_factor(n) <= largest_factor) return;
        const std::size_t length = std::bit_ceil(2 * n - 1);
        chirp.resize(n);
        for (std::size_t j = 0; j < n; ++j) {
            const std::size_t square = j * j % (2 * n);  // keeps the angle exact
            chirp[j] = std::polar(1.0, -pi * static_cast<double>(square) / static_cast<double>(n));
        }
        a.assign(length, 0.0);
        A.resize(length);
        kernel.resize(length);
        for (std::size_t j = 0; j < n; ++j) a[j] = a[(length - j) % length] = std::conj(chirp[j]);
        forward(a, kernel);
    }

    void forward(const std::vector<Complex>& from, std::vector<Complex>& to) {
        fft.fwd(to.data(), from.data(), std::ssize(from));
    }

    void convolve(std::span<const double> x, std::span<Complex> X) {
        std::fill(a.begin(), a.end(), 0.0);
        for (std::size_t j = 0; j < x.size(); ++j) a[j] = chirp[j] * x[j];
        forward(a, A);
        for (std::size_t k = 0; k < A.size(); ++k) A[k] *= kernel[k];
        fft.inv(a.data(), A.data(), std::ssize(A));
        for (std::size_t k = 0; k < X.size(); ++k) X[k] = chirp[k] * a[k];
    }
};

RealFourier::RealFourier(std::size_t size) : size_(size) {
    constexpr std::size_t limit = std::size_t{1} << 28;
    if (size == 0 || size > limit) throw InputError("Fourier transform", "length", size, text("1 to ", limit));
    plan_ = std::make_unique<Plan>(size);
}

RealFourier::~RealFourier() = default;

void RealFourier::transform(std::span<const double> x, std::span<Complex> X) {
    require_count("Fourier transform", "x", x.size(), size_);
    require_count("Fourier transform", "X", X.size(), frequencies());
    if (size_ == 1)
        X[0] = x[0];  // Eigen has no memory for a factor of 1
    else if (plan_->chirp.empty())
        plan_->fft.fwd(X.data(), x.data(), static_cast<Eigen::Index>(size_));
    else
        plan_->convolve(x, X);
}

}  // namespace cardan::solvers
