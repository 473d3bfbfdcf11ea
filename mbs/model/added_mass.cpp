#include "mbs/model/added_mass.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"

#include <cmath>

namespace cardan {

Mat6 AddedMass::in(const Placement& frame_in_a) const {
    Mat6 turn = Mat6::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = frame_in_a.R.transpose();
    const Mat6 X = turn * twist_shift<double>(frame_in_a.p);
    const Mat6 moved = X.transpose() * inertia * X;
    return (moved + moved.transpose()) / 2;
}

void AddedMass::check() const {
    const std::string where = text("added mass '", name, "'");
    for (const double element : inertia.reshaped())
        if (!(std::abs(element) <= 1e100)) throw InputError(where, "element", element, "finite, at most 1e100");
    // Units differ: every row and column over the root of its diagonal element.
    Vec6 scale;
    for (int i = 0; i < 6; ++i) scale(i) = inertia(i, i) > 0 ? 1 / std::sqrt(inertia(i, i)) : 1;
    const Mat6 scaled = scale.asDiagonal() * inertia * scale.asDiagonal();
    if (!((scaled - scaled.transpose()).cwiseAbs().maxCoeff() <= 1e-9))
        throw InputError(where, "matrix", inertia, "symmetric within 1e-9 of its diagonal");
    const double least = Eigen::SelfAdjointEigenSolver<Matrix>(scaled, Eigen::EigenvaluesOnly).eigenvalues()(0);
    if (!(least >= -1e-9)) throw InputError(where, "least eigenvalue over its diagonal", least, ">= 0");
}

}  // namespace cardan
