#include "solvers/algebra/azimuth_series.hpp"

#include "solvers/algebra/fft.hpp"

#include <cmath>

namespace cardan::solvers {

Vector fourier_basis(double psi, int harmonics, int derivative) {
    Vector basis(Eigen::Index{2} * harmonics + 1);
    basis(0) = derivative == 0 ? 1 : 0;
    for (int j = 1; j <= harmonics; ++j) {
        // Every derivative turns both by a quarter and multiplies by j.
        const double angle = j * psi + derivative * pi / 2, factor = std::pow(j, derivative);
        basis(Eigen::Index{2} * j - 1) = factor * std::cos(angle);
        basis(Eigen::Index{2} * j) = factor * std::sin(angle);
    }
    return basis;
}

Vector fourier_weights(double psi, int harmonics, int count) {
    Vector weights = 2.0 / count * fourier_basis(psi, harmonics);
    weights(0) /= 2;
    return weights;
}

Matrix fourier_coefficients(const Matrix& samples, int harmonics) {
    const auto count = static_cast<int>(samples.cols());
    Matrix coefficients = Matrix::Zero(samples.rows(), 2 * harmonics + 1);
    for (int s = 0; s < count; ++s)
        coefficients += samples.col(s) * fourier_weights(2 * pi * s / count, harmonics, count).transpose();
    return coefficients;
}

ComplexMatrix fourier_coefficients(const ComplexMatrix& samples) {
    const auto S = static_cast<std::size_t>(samples.cols());
    const Eigen::Index J = (samples.cols() - 1) / 2;
    RealFourier fourier(S);
    Vector row(samples.cols());
    ComplexVector X(static_cast<Eigen::Index>(fourier.frequencies())), Y(X.size());
    const auto transform = [&](ComplexVector& out) {
        fourier.transform({row.data(), S}, {out.data(), fourier.frequencies()});
    };
    ComplexMatrix harmonics(samples.rows(), 2 * J + 1);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        row = samples.row(i).real();
        transform(X);
        row = samples.row(i).imag();
        transform(Y);
        for (Eigen::Index j = 0; j <= J; ++j) {
            harmonics(i, J + j) = X(j) + Complex(0, 1) * Y(j);
            harmonics(i, J - j) = std::conj(X(j)) + Complex(0, 1) * std::conj(Y(j));
        }
    }
    return harmonics / static_cast<double>(S);
}

}  // namespace cardan::solvers
