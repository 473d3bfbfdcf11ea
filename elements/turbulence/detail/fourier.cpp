#include "elements/turbulence/detail/fourier.hpp"

#include <algorithm>
#include <unsupported/Eigen/FFT>

namespace cardan::detail {

struct Fourier::Plans {
    Eigen::FFT<double> fft{Eigen::FFT<double>::impl_type(), Eigen::FFT<double>::Unscaled};
};

Fourier::Fourier() : plans_(std::make_unique<Plans>()) {}
Fourier::~Fourier() = default;

void Fourier::forward(const Complex* in, int size, Complex* out) {
    plans_->fft.fwd(out, in, size);
}

void Fourier::inverse(const Complex* in, int size, Complex* out) {
    plans_->fft.inv(out, in, size);
}

int fast_length(int n) {
    for (int out = std::max(2, n + n % 2);; out += 2)
        if (largest_factor(out) <= 5) return out;
}

int largest_factor(int n) {
    int largest = 1;
    for (int p = 2; p <= n / p; ++p)
        for (; n % p == 0; n /= p) largest = p;
    return n > 1 ? n : largest;
}

}  // namespace cardan::detail
