#include "elements/turbulence/detail/mann_cells.hpp"

#include "elements/turbulence/detail/panels.hpp"
#include "elements/turbulence/detail/sheared_wave.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::detail {

Mat3 mean_over_cell(const ShearTable& shear, double length_scale, const Vec3& k, double dk2, double dk3) {
    const double L_square = length_scale * length_scale;
    Mat3 sum = Mat3::Zero();
    const auto line = [&](double k2, double weight2) {
        const auto add = [&](double k3, double weight3) {
            const ShearedWave wave({k(0), k2, k3}, shear((k(0) * k(0) + k2 * k2 + k3 * k3) * L_square));
            sum += weight2 * weight3 * std::pow(1 + wave.k0_square * L_square, -17.0 / 6) * wave.tensor();
        };
        if (k(2) == 0) {
            at_nodes_towards_zero(dk3 / 2, k(0), 1, add);
            at_nodes_towards_zero(dk3 / 2, k(0), 1, [&](double k3, double weight) { add(-k3, weight); });
        } else {
            at_nodes(k(2) - dk3 / 2, k(2) + dk3 / 2, 1, add);
        }
    };
    if (k(1) == 0) {  // the other half has the same, but for what is odd in k_2
        at_nodes_towards_zero(dk2 / 2, k(0), 1, line);
        sum *= 2;
        sum(0, 1) = sum(1, 0) = sum(1, 2) = sum(2, 1) = 0;
    } else {
        at_nodes(k(1) - dk2 / 2, k(1) + dk2 / 2, 1, line);
    }
    return sum / (dk2 * dk3);
}

Mat3 triangular_root(const Mat3& Phi) {
    Mat3 rest = Phi, out = Mat3::Zero();
    const double negligible = 1e-15 * Phi.trace();
    for (int column = 0; column < 3; ++column) {
        Eigen::Index pivot = 0;
        const double largest = rest.diagonal().maxCoeff(&pivot);
        if (!(largest > negligible)) break;
        out.col(column) = rest.col(pivot) / std::sqrt(largest);
        rest -= out.col(column) * out.col(column).transpose();
        rest(pivot, pivot) = 0;
    }
    return out;
}

}  // namespace cardan::detail
