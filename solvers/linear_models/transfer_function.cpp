#include "solvers/linear_models/transfer_function.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"

namespace cardan::solvers {

TransferFunction::TransferFunction(const StateMatrices& model) : D_(model.D) {
    const Eigen::Index n = model.A.rows(), outputs = model.C.rows();
    Matrix beside(outputs + model.B.cols(), n);  // times Q
    beside << model.C, model.B.transpose();
    if (n > 0) {
        const Eigen::HessenbergDecomposition<Matrix> form(model.A);
        T_ = form.matrixH().transpose();
        beside *= form.matrixQ();
    }
    C_ = beside.topRows(outputs);
    B_ = beside.bottomRows(model.B.cols()).transpose();
}

// Each row is eliminated from the next one, the larger of both pivots first.
ComplexMatrix TransferFunction::at(Complex s) {
    const Eigen::Index n = T_.rows();
    if (n == 0) return D_.cast<Complex>();
    rows_ = -T_.cast<Complex>();
    rows_.diagonal().array() += s;
    x_ = B_.cast<Complex>();
    for (Eigen::Index k = 0; k + 1 < n; ++k) {
        const Eigen::Index rest = n - k;
        if (std::abs(rows_(k, k + 1)) > std::abs(rows_(k, k))) {
            rows_.col(k).tail(rest).swap(rows_.col(k + 1).tail(rest));
            x_.row(k).swap(x_.row(k + 1));
        }
        if (rows_(k, k) == 0.0) continue;
        const Complex factor = rows_(k, k + 1) / rows_(k, k);
        rows_.col(k + 1).tail(rest) -= factor * rows_.col(k).tail(rest);
        x_.row(k + 1) -= factor * x_.row(k);
    }
    for (Eigen::Index k = n - 1; k >= 0; --k) {
        const Eigen::Index rest = n - k - 1;
        x_.row(k) = (x_.row(k) - rows_.col(k).tail(rest).transpose() * x_.bottomRows(rest)).eval() / rows_(k, k);
    }
    if (!x_.allFinite()) throw NumericalError(text("linear model: the transfer function has a pole at ", s));
    return C_.cast<Complex>() * x_ + D_.cast<Complex>();
}

}  // namespace cardan::solvers
