#include "solvers/periodic/detail/motion_vectors.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/periodic/floquet_mode.hpp"

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

}  // namespace

double state_share(const PeriodicSystem& system, const ProductEigen::Vectors& vectors) {
    const Index beside = system.states_beside(), rest = system.states() - beside;
    if (beside == 0) return 0;
    double states = 0, coordinates = 0;
    for (Index k = 0; k < vectors.right.cols(); ++k) {
        const auto part = [&](Index first, Index count) {
            return std::abs(
                (vectors.left.col(k).segment(first, count).transpose() * vectors.right.col(k).segment(first, count))
                    .value());
        };
        states += part(rest, beside);
        coordinates += part(0, rest);
    }
    return states / (states + coordinates);
}

double mean_square_frequency(const std::vector<Matrix>& inertia, const ProductEigen::Vectors& vectors) {
    double rates = 0, positions = 0;
    for (Index k = 0; k < std::ssize(inertia); ++k) {
        const Matrix& M = entry(inertia, k);
        positions += hermitian_form(M, vectors.right.col(k).head(M.rows()));
        rates += hermitian_form(M, vectors.right.col(k).segment(M.rows(), M.rows()));
    }
    return rates / positions;
}

}  // namespace cardan::solvers
