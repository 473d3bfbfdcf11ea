#include "solvers/model_reduction.hpp"

#include "mbs/decompositions.hpp"
#include "mbs/error.hpp"
#include "solvers/shifted_schur.hpp"

#include <algorithm>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

ConstantModel like(const ConstantModel& model) {
    ConstantModel reduced;
    reduced.machine = model.machine;
    reduced.description = model.description;
    reduced.rotor_speed = model.rotor_speed;
    reduced.inputs = model.inputs;
    reduced.outputs = model.outputs;
    return reduced;
}

void name_states(ConstantModel& model, const char* stem) {
    model.states.clear();
    for (Index i = 0; i < model.A.rows(); ++i)
        model.states.push_back({.name = text(stem, " state ", i + 1), .units = "1", .long_name = "of a reduced model"});
}

void check(const char* here, const ConstantModel& model) {
    const Index n = model.A.rows();
    if (n == 0) throw InputError(here, "number of states", n, ">= 1");
    if (model.A.cols() != n || model.B.rows() != n || model.C.cols() != n || model.D.rows() != model.C.rows() ||
        model.D.cols() != model.B.cols())
        throw InputError(here, "sizes of A, B, C, D",
                         text(n, " x ", model.A.cols(), ", ", model.B.rows(), " x ", model.B.cols(), ", ",
                              model.C.rows(), " x ", model.C.cols(), ", ", model.D.rows(), " x ", model.D.cols()),
                         "n x n, n x m, p x n, p x m");
    for (const Matrix* m : {&model.A, &model.B, &model.C, &model.D})
        if (!m->allFinite()) throw InputError(here, "matrices of the model", "not finite", "finite");
}

// First part as it is, second part reduced, side by side.
void join(StateMatrices& out, const StateMatrices& a, const StateMatrices& b) {
    const Index n = a.A.rows(), m = b.A.rows();
    out.A = Matrix::Zero(n + m, n + m);
    out.A.topLeftCorner(n, n) = a.A;
    out.A.bottomRightCorner(m, m) = b.A;
    out.B.resize(n + m, b.D.cols());
    out.B << a.B, b.B;
    out.C.resize(b.D.rows(), n + m);
    out.C << a.C, b.C;
    out.D = b.D;
}

Vector checked_sizes(const char* name, const Vector& sizes, Index count) {
    if (sizes.size() == 0) return Vector::Ones(count);
    if (sizes.size() != count) throw InputError("balanced truncation", name, sizes.size(), text(count, " values"));
    for (double size : sizes) require_positive("balanced truncation", name, size);
    return sizes;
}

// L with L L^T = X, X symmetric and positive semidefinite but for rounding.
Matrix root(const Matrix& X) {
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(X);
    if (solver.info() != Eigen::Success) throw NumericalError("balanced truncation: eigenvalues of a Gramian");
    return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

Matrix static_gain(const StateMatrices& part) {
    return part.A.rows() == 0 ? Matrix(Matrix::Zero(part.C.rows(), part.B.cols()))
                              : Matrix(-part.C * part.A.partialPivLu().solve(part.B));
}

// Leaves out the last states of a balanced system.
StateMatrices cut(const StateMatrices& s, Index order, StaticGain gain) {
    const Index rest = s.A.rows() - order;
    StateMatrices r{s.A.topLeftCorner(order, order), s.B.topRows(order), s.C.leftCols(order), s.D};
    if (gain == StaticGain::free || rest == 0) return r;
    const auto A22 = Matrix(s.A.bottomRightCorner(rest, rest)).partialPivLu();
    const Matrix from_x = A22.solve(Matrix(s.A.bottomLeftCorner(rest, order))),
                 from_u = A22.solve(Matrix(s.B.bottomRows(rest)));
    r.A -= s.A.topRightCorner(order, rest) * from_x;
    r.B -= s.A.topRightCorner(order, rest) * from_u;
    r.C -= s.C.rightCols(rest) * from_x;
    r.D -= s.C.rightCols(rest) * from_u;
    return r;
}

}  // namespace

ConstantModel modal_truncation(const ConstantModel& model, const ModalOptions& options) {
    const char* here = "modal truncation";
    check(here, model);
    require_not_negative(here, "largest frequency [Hz]", options.max_frequency_hz);
    const ShiftedSchur schur(model.A);
    std::vector<Complex> wanted;
    for (const Complex& pole : options.keep) {
        if (!std::isfinite(pole.real()) || !std::isfinite(pole.imag())) throw InputError(here, "pole", pole, "finite");
        Complex nearest = schur.eigenvalue(0);
        for (Index i = 1; i < schur.size(); ++i)
            if (std::abs(schur.eigenvalue(i) - pole) < std::abs(nearest - pole)) nearest = schur.eigenvalue(i);
        wanted.push_back(nearest);
    }
    const double zero = 1e-4 * schur.sigma();
    const Decoupled parts = decouple(model.A, schur, [&](Complex lambda) {
        const double size = std::abs(lambda);
        if (size <= std::max(2 * pi * options.max_frequency_hz, zero)) return true;
        return std::any_of(wanted.begin(), wanted.end(), [&](const Complex& pole) {
            const Complex mirrored(pole.real(), lambda.imag() < 0 ? -std::abs(pole.imag()) : std::abs(pole.imag()));
            return std::abs(lambda - mirrored) <= 1e-6 * size;
        });
    });
    if (parts.A_1.rows() == 0)
        throw InputError(here, "largest frequency [Hz]", options.max_frequency_hz, "one that keeps a mode");
    ConstantModel reduced = like(model);
    reduced.A = parts.A_1;
    reduced.B = parts.left_1 * model.B;
    reduced.C = model.C * parts.right_1;
    reduced.D = model.D;
    if (options.static_gain == StaticGain::kept)
        reduced.D += static_gain({parts.A_2, parts.left_2 * model.B, model.C * parts.right_2, {}});
    name_states(reduced, "modal");
    return reduced;
}

BalancedModel balanced_truncation(const ConstantModel& model, const BalancedOptions& options) {
    const char* here = "balanced truncation";
    check(here, model);
    require_not_negative(here, "stability margin [1/s]", options.stability_margin);
    if (!(options.tolerance >= 0 && options.tolerance < 1))
        throw InputError(here, "tolerance", options.tolerance, "0 ... 1");
    const Vector u = checked_sizes("sizes of inputs", options.input_size, model.B.cols()),
                 y = checked_sizes("sizes of outputs", options.output_size, model.C.rows());
    const double margin = options.stability_margin > 0 ? options.stability_margin : 1e-4;
    const ShiftedSchur schur(model.A);
    const Decoupled parts = decouple(model.A, schur, [&](Complex lambda) { return !(lambda.real() < -margin); });
    const StateMatrices kept{parts.A_1, parts.left_1 * model.B, model.C * parts.right_1, {}};
    StateMatrices stable{parts.A_2, parts.left_2 * model.B * u.asDiagonal(),
                         y.cwiseInverse().asDiagonal() * model.C * parts.right_2,
                         y.cwiseInverse().asDiagonal() * model.D * u.asDiagonal()};
    const Index n = stable.A.rows();
    if (options.order < 0 || options.order > n) throw InputError(here, "order", options.order, text("0 ... ", n));

    BalancedModel result;
    static_cast<ConstantModel&>(result) = like(model);
    result.kept_as_is = static_cast<int>(parts.A_1.rows());
    StateMatrices reduced = stable;
    if (n > 0) {
        const Matrix Lc = root(lyapunov(stable.A, stable.B * stable.B.transpose(), schur.sigma())),
                     Lo = root(lyapunov(stable.A.transpose(), stable.C.transpose() * stable.C, schur.sigma()));
        const Eigen::JacobiSVD<Matrix> svd(Lo.transpose() * Lc, Eigen::ComputeThinU | Eigen::ComputeThinV);
        result.hankel = svd.singularValues();
        const double largest = result.hankel(0);
        // What is rounding beside the largest cannot be balanced; it is left out in any case.
        const auto above = [&](double limit) {
            return static_cast<Index>(std::count_if(result.hankel.begin(), result.hankel.end(),
                                                    [&](double value) { return value > limit * largest; }));
        };
        const Index usable = above(1e-10);
        Index order = options.order > 0 ? std::min<Index>(options.order, usable) : above(options.tolerance);
        order = std::min(order, usable);
        const Vector scale = result.hankel.head(usable).cwiseSqrt().cwiseInverse();
        const Matrix right = Lc * svd.matrixV().leftCols(usable) * scale.asDiagonal(),
                     left = scale.asDiagonal() * svd.matrixU().leftCols(usable).transpose() * Lo.transpose();
        const StateMatrices balanced{left * stable.A * right, left * stable.B, stable.C * right, stable.D};
        reduced = cut(balanced, order, options.static_gain);
        result.order = static_cast<int>(order);
        result.error_bound = 2 * result.hankel.tail(n - order).sum();
    }
    reduced.B = reduced.B * u.cwiseInverse().asDiagonal();
    reduced.C = y.asDiagonal() * reduced.C;
    reduced.D = y.asDiagonal() * reduced.D * u.cwiseInverse().asDiagonal();
    join(result, kept, reduced);
    name_states(result, "balanced");
    return result;
}

Matrix lyapunov(const Matrix& A, const Matrix& Q, double sigma) {
    const char* here = "Lyapunov's equation";
    if (A.rows() != A.cols() || Q.rows() != A.rows() || Q.cols() != A.rows())
        throw InputError(here, "sizes of A and Q", text(A.rows(), " x ", A.cols(), ", ", Q.rows(), " x ", Q.cols()),
                         "square and equal");
    require_not_negative(here, "shift [1/s]", sigma);
    const ShiftedSchur schur(A, sigma);
    for (Index i = 0; i < schur.size(); ++i)
        if (!(schur.eigenvalue(i).real() < 0))
            throw NumericalError(text(here, ": the eigenvalue ", schur.eigenvalue(i), " 1/s is not stable"));
    return schur.lyapunov(Q);
}

}  // namespace cardan::solvers
