#include "solvers/algebra/anderson.hpp"

#include "mbs/base/decompositions.hpp"

#include <algorithm>

namespace cardan::solvers {

Vector Anderson::next(const Vector& x, const Vector& f) {
    Vector out = x + f;
    const Eigen::Index depth = dX_.cols(), known = std::min(count_, depth);
    if (count_ > 0) {
        const Eigen::Index column = (count_ - 1) % depth;
        dX_.col(column) = x - last_x_;
        dF_.col(column) = f - last_f_;
        const Vector part = Matrix(dF_.leftCols(known)).completeOrthogonalDecomposition().solve(f);
        out -= (dX_.leftCols(known) + dF_.leftCols(known)) * part;
    }
    last_x_ = x;
    last_f_ = f;
    ++count_;
    return out;
}

}  // namespace cardan::solvers
