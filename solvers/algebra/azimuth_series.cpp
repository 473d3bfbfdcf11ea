#include "solvers/algebra/azimuth_series.hpp"

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

}  // namespace cardan::solvers
