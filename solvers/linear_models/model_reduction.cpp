#include "solvers/linear_models/model_reduction.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear_models/detail/shifted_schur.hpp"
#include "solvers/linear_models/transfer_function.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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

// L with L L^T = X, X symmetric and positive semidefinite up to rounding.
Matrix root(const Matrix& X) {
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(X);
    if (solver.info() != Eigen::Success) throw NumericalError("balanced truncation: eigenvalues of a Gramian");
    return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

Matrix static_gain(const StateMatrices& part) {
    return part.A.rows() == 0 ? Matrix(Matrix::Zero(part.C.rows(), part.B.cols()))
                              : Matrix(-part.C * part.A.partialPivLu().solve(part.B));
}

// How many of the values are above a part of the first, the largest.
Index count_above(const Vector& hankel, double part) {
    return static_cast<Index>(
        std::count_if(hankel.begin(), hankel.end(), [&](double value) { return value > part * hankel(0); }));
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

namespace {

// A stable system in balanced coordinates, by descending Hankel value.
struct Balanced {
    Vector hankel;
    StateMatrices system;  // as many states as are more than rounding
};

Balanced balance(const StateMatrices& stable, double sigma) {
    const Matrix Lc = root(lyapunov(stable.A, stable.B * stable.B.transpose(), sigma)),
                 Lo = root(lyapunov(stable.A.transpose(), stable.C.transpose() * stable.C, sigma));
    const Eigen::JacobiSVD<Matrix> svd(Lo.transpose() * Lc, Eigen::ComputeThinU | Eigen::ComputeThinV);
    Balanced result{svd.singularValues(), {}};
    // States at rounding level relative to the largest cannot be balanced and are always left out.
    const Index usable = count_above(result.hankel, 1e-10);
    const Vector scale = result.hankel.head(usable).cwiseSqrt().cwiseInverse();
    const Matrix right = Lc * svd.matrixV().leftCols(usable) * scale.asDiagonal(),
                 left = scale.asDiagonal() * svd.matrixU().leftCols(usable).transpose() * Lo.transpose();
    result.system = {left * stable.A * right, left * stable.B, stable.C * right, stable.D};
    return result;
}

StateMatrices scaled(const StateMatrices& s, const Vector& u, const Vector& y) {
    return {s.A, s.B * u.asDiagonal(), y.cwiseInverse().asDiagonal() * s.C,
            y.cwiseInverse().asDiagonal() * s.D * u.asDiagonal()};
}

void check(const char* here, const BalancedOptions& options, Index states) {
    require_not_negative(here, "stability margin [1/s]", options.stability_margin);
    require_not_negative(here, "error", options.error);
    require_not_negative(here, "largest frequency [Hz]", options.max_frequency_hz);
    if (options.error > 0) require_positive(here, "largest frequency [Hz]", options.max_frequency_hz);
    if (options.error > 0 && options.order > 0)
        throw InputError(here, "order besides an error", options.order, "one of them");
    if (!(options.tolerance >= 0 && options.tolerance < 1))
        throw InputError(here, "tolerance", options.tolerance, "0 ... 1");
    if (options.order < 0 || options.order > states)
        throw InputError(here, "order", options.order, text("0 ... ", states));
}

// Largest responses of the entries of G in a band, at frequencies that include those of all poles.
class Band {
public:
    Band(const StateMatrices& stable, double max_frequency_hz) {
        constexpr int steps = 150;
        const double last = 2 * pi * max_frequency_hz;
        std::vector<double> omega{0};
        for (int i = 0; i <= steps; ++i) omega.push_back(last * std::pow(1e-3, 1 - static_cast<double>(i) / steps));
        ConstantModel model;
        static_cast<StateMatrices&>(model) = stable;
        for (const Complex& pole : model.poles())
            if (pole.imag() > 0 && pole.imag() < last) omega.push_back(pole.imag());
        TransferFunction G(stable);
        for (double w : omega) {
            s_.emplace_back(0, w);
            G_.push_back(G.at(s_.back()));
        }
    }
    Matrix largest() const {
        Matrix max = Matrix::Zero(G_[0].rows(), G_[0].cols());
        for (const ComplexMatrix& G : G_) max = max.cwiseMax(G.cwiseAbs());
        return max;
    }
    Matrix largest_difference(const StateMatrices& other) const {
        TransferFunction G(other);
        Matrix max = Matrix::Zero(G_[0].rows(), G_[0].cols());
        for (std::size_t i = 0; i < s_.size(); ++i) max = max.cwiseMax((G_[i] - G.at(s_[i])).cwiseAbs());
        return max;
    }

private:
    std::vector<Complex> s_;
    std::vector<ComplexMatrix> G_;
};

struct Reduction {
    Vector hankel;
    Index order = 0;
    StateMatrices system;  // in the units of the stable part
    Vector input_error = {}, output_error = {};

    double error() const { return std::max(input_error.maxCoeff(), output_error.maxCoeff()); }
};

// The errors of reduced systems by rows and columns, at sizes of inputs and outputs with which every row and every
// column of the responses has a largest entry of one.
class Errors {
public:
    Errors(const StateMatrices& stable, double max_frequency_hz, const Vector& u, const Vector& y)
        : input(u), output(y), band_(stable, max_frequency_hz) {
        const Matrix largest = band_.largest();
        for (int i = 0; i < 20; ++i) {
            replace(output, Vector((largest * input.asDiagonal()).rowwise().maxCoeff()));
            Vector per_input = input.cwiseInverse();
            replace(per_input, Vector((output.cwiseInverse().asDiagonal() * largest).colwise().maxCoeff()));
            input = per_input.cwiseInverse();
        }
        size_ = sized(largest);
    }
    void measure(Reduction& r) const {
        const Matrix error = sized(band_.largest_difference(r.system));
        r.input_error = quotient(error.colwise().maxCoeff(), size_.colwise().maxCoeff());
        r.output_error = quotient(error.rowwise().maxCoeff(), size_.rowwise().maxCoeff());
    }

    Vector input, output;

private:
    // Inputs without effect and outputs without response keep their scale.
    static void replace(Vector& sizes, const Vector& by) {
        for (Index k = 0; k < sizes.size(); ++k)
            if (by(k) > 0) sizes(k) = by(k);
    }
    static Vector quotient(const Vector& error, const Vector& largest) {
        Vector q = Vector::Zero(error.size());
        for (Index i = 0; i < q.size(); ++i)
            if (largest(i) > 0) q(i) = error(i) / largest(i);
        return q;
    }
    Matrix sized(const Matrix& G) const { return output.cwiseInverse().asDiagonal() * G * input.asDiagonal(); }

    Band band_;
    Matrix size_;
};

// The stable part without its modes above a frequency, with their static gain.
StateMatrices below(const StateMatrices& stable, const ShiftedSchur& schur, double frequency_hz) {
    const Decoupled parts =
        decouple(stable.A, schur, [&](Complex lambda) { return std::abs(lambda) <= 2 * pi * frequency_hz; });
    return {parts.A_1, parts.left_1 * stable.B, stable.C * parts.right_1,
            stable.D + static_gain({parts.A_2, parts.left_2 * stable.B, stable.C * parts.right_2, {}})};
}

Reduction by_order(const StateMatrices& stable, double sigma, const BalancedOptions& options, const Vector& u,
                   const Vector& y) {
    const Balanced all = balance(scaled(stable, u, y), sigma);
    const Index wanted = options.order > 0 ? Index{options.order} : count_above(all.hankel, options.tolerance);
    const Index order = std::min(all.system.A.rows(), wanted);
    const StateMatrices reduced = cut(all.system, order, options.static_gain);
    Reduction r{all.hankel, order, scaled(reduced, u.cwiseInverse(), y.cwiseInverse())};
    if (options.max_frequency_hz > 0) Errors(stable, options.max_frequency_hz, u, y).measure(r);
    return r;
}

// The smallest order by bisection: the error need not fall with every state, so the last one that was measured to be
// good enough is taken.
Reduction by_error(const StateMatrices& stable, double sigma, const BalancedOptions& options, const Vector& u,
                   const Vector& y) {
    const Errors errors(stable, options.max_frequency_hz, u, y);
    const Vector per_input = errors.input.cwiseInverse(), per_output = errors.output.cwiseInverse();
    const ShiftedSchur schur(stable.A, sigma);
    double best = std::numeric_limits<double>::infinity();
    for (const double factor : {2.0, 4.0, 8.0, std::numeric_limits<double>::infinity()}) {
        const StateMatrices part =
            std::isfinite(factor) ? below(stable, schur, factor * options.max_frequency_hz) : stable;
        if (part.A.rows() == 0) continue;
        const Balanced all = balance(scaled(part, errors.input, errors.output), sigma);
        const auto at_order = [&](Index order) {
            Reduction r{all.hankel, order, scaled(cut(all.system, order, options.static_gain), per_input, per_output)};
            errors.measure(r);
            return r;
        };
        Reduction good = at_order(all.system.A.rows());
        best = std::min(best, good.error());
        if (!(good.error() <= options.error)) continue;
        for (Index min = 0; min < good.order;) {
            const Index middle = (min + good.order) / 2;
            Reduction tried = at_order(middle);
            if (tried.error() <= options.error)
                good = std::move(tried);
            else
                min = middle + 1;
        }
        return good;
    }
    throw NumericalError(text("balanced truncation: no order reaches the error ", options.error, " up to ",
                              options.max_frequency_hz, " Hz (the minimum is ", best, "); ask for a larger one"));
}

}  // namespace

BalancedModel balanced_truncation(const ConstantModel& model, const BalancedOptions& options) {
    const char* here = "balanced truncation";
    check(here, model);
    const Vector u = checked_sizes("sizes of inputs", options.input_size, model.B.cols()),
                 y = checked_sizes("sizes of outputs", options.output_size, model.C.rows());
    const double margin = options.stability_margin > 0 ? options.stability_margin : 1e-4;
    const ShiftedSchur schur(model.A);
    const Decoupled parts = decouple(model.A, schur, [&](Complex lambda) { return !(lambda.real() < -margin); });
    const StateMatrices kept{parts.A_1, parts.left_1 * model.B, model.C * parts.right_1, {}};
    const StateMatrices stable{parts.A_2, parts.left_2 * model.B, model.C * parts.right_2, model.D};
    check(here, options, stable.A.rows());

    BalancedModel result;
    static_cast<ConstantModel&>(result) = like(model);
    result.kept_as_is = static_cast<int>(parts.A_1.rows());
    Reduction reduced{{}, 0, stable};
    if (stable.A.rows() > 0)
        reduced = options.error > 0 ? by_error(stable, schur.sigma(), options, u, y)
                                    : by_order(stable, schur.sigma(), options, u, y);
    result.hankel = reduced.hankel;
    result.order = static_cast<int>(reduced.order);
    result.error_bound = 2 * reduced.hankel.tail(reduced.hankel.size() - reduced.order).sum();
    result.input_error = reduced.input_error;
    result.output_error = reduced.output_error;
    join(result, kept, reduced.system);
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
