#include "solvers/algebra/radau.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Eigenvalues of the symmetric tridiagonal matrix of the Legendre recursion, its last diagonal entry changed so that 1
// is one of them.      [Golub, Some modified matrix eigenvalue problems, SIAM Review 15 (1973), section 7]
Vector nodes(int stages) {
    const Index s = stages;
    const auto beta = [](Index k) { return static_cast<double>(k * k) / static_cast<double>(4 * k * k - 1); };
    Matrix T = Matrix::Zero(s, s);
    for (Index k = 1; k < s; ++k) T(k, k - 1) = T(k - 1, k) = std::sqrt(beta(k));
    double before = 0, now = 1;  // monic polynomials of degree k - 1 and k at 1
    for (Index k = 1; k < s; ++k) {
        const double next = now - (k > 1 ? beta(k - 1) * before : 0.0);
        before = now;
        now = next;
    }
    T(s - 1, s - 1) = s > 1 ? 1 - beta(s - 1) * before / now : 1;
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(T, Eigen::EigenvaluesOnly);
    Vector c = (eigen.eigenvalues().array() + 1) / 2;
    c(s - 1) = 1;
    return c;
}

}  // namespace

RadauIIA::RadauIIA(int stages) {
    if (stages < 1 || stages > 9) throw InputError("Radau IIA", "number of stages", stages, "1 ... 9");
    c = nodes(stages);
    // In Legendre polynomials of y = 2 x - 1: values at the nodes, and integrals from 0 to the nodes,
    // (P_{k+1} - P_{k-1}) / (2 (2 k + 1)), with -1 for P_{-1}.
    const Index s = c.size();
    Matrix values(s, s + 1), integrals(s, s);
    for (Index i = 0; i < s; ++i) {
        const double y = 2 * c(i) - 1;
        values(i, 0) = 1;
        values(i, 1) = y;
        for (Index k = 1; k < s; ++k)
            values(i, k + 1) =
                (static_cast<double>(2 * k + 1) * y * values(i, k) - static_cast<double>(k) * values(i, k - 1)) /
                static_cast<double>(k + 1);
        for (Index k = 0; k < s; ++k)
            integrals(i, k) =
                (values(i, k + 1) - (k > 0 ? values(i, k - 1) : -1.0)) / (2 * static_cast<double>(2 * k + 1));
    }
    const Matrix basis = values.leftCols(s).transpose();
    A = basis.partialPivLu().solve(integrals.transpose()).transpose();
    A2 = A * A;
}

RadauStage::RadauStage(const RadauIIA& method, Index rows, Index states)
    : method_(&method),
      n_(rows),
      second_(rows - states),
      C_(static_cast<std::size_t>(method.stages())),
      K_(C_.size()),
      factors_(method.stages() * rows) {}

void RadauStage::set(Index stage, double h, const Matrix& M, const Matrix& C, const Matrix& K) {
    entry(C_, stage) = C;
    entry(K_, stage) = K;
    const Index states = n_ - second_;
    for (Index j = 0; j < method_->stages(); ++j) {
        const double a = h * method_->A(stage, j), a2 = h * h * method_->A2(stage, j);
        auto block = factors_.matrix().block(stage * n_, j * n_, n_, n_);
        block.leftCols(second_).noalias() = a * C.leftCols(second_) + a2 * K.leftCols(second_);
        if (states > 0) block.rightCols(states).noalias() = a * K.rightCols(states);
        if (j != stage) continue;
        block.leftCols(second_) += M.leftCols(second_);
        if (states > 0) block.rightCols(states) += C.rightCols(states);
    }
}

void RadauStage::factorise() {
    factors_.factorise();
}

void RadauStage::solve(Matrix& f) const {
    factors_.solve(f);
}

void RadauStage::transition(double h, Matrix& Phi) {
    const Index s = method_->stages(), n = second_, states = n_ - second_, size = 2 * n + states;
    right_.resize(s * n_, size);
    for (Index i = 0; i < s; ++i) {
        const Matrix &C = entry(C_, i), &K = entry(K_, i);
        auto own = right_.middleRows(i * n_, n_);
        own.leftCols(n) = -K.leftCols(n);
        own.middleCols(n, n) = -method_->c(i) * h * K.leftCols(n) - C.leftCols(n);
        if (states > 0) own.rightCols(states) = -K.rightCols(states);
    }
    solve(right_);
    Phi.setIdentity(size, size);
    Phi.block(0, n, n, n).diagonal().setConstant(h);
    for (Index j = 0; j < s; ++j) {
        const auto a = right_.middleRows(j * n_, n);
        Phi.topRows(n) += h * h * method_->A2(s - 1, j) * a;
        Phi.middleRows(n, n) += h * method_->A(s - 1, j) * a;
        if (states > 0) Phi.bottomRows(states) += h * method_->A(s - 1, j) * right_.middleRows(j * n_ + n, states);
    }
}

}  // namespace cardan::solvers
