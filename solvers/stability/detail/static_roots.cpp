#include "solvers/stability/detail/static_roots.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/dense.hpp"
#include "solvers/algebra/real_eigen.hpp"
#include "solvers/linear/detail/shifted_state.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

// All rows but that of a free spin.
std::vector<int> held_rows(const SecondOrderSystem& system) {
    std::vector<int> rows;
    for (int i = 0; i < system.M.rows(); ++i)
        if (i != system.cyclic) rows.push_back(i);
    return rows;
}

Matrix weights_of(const SecondOrderSystem& system, double sigma) {
    return system.K_elastic + sigma * sigma * system.M;
}

}  // namespace

StaticRoots static_roots(const SecondOrderSystem& system) {
    const std::vector<int> rows = held_rows(system);
    StaticRoots out{.sigma = lowest_scale(system), .shapes = Matrix::Zero(system.M.rows(), 0)};
    if (rows.empty()) return out;
    const Matrix weights = weights_of(system, out.sigma);
    const Eigen::LLT<Matrix> factor(Matrix(weights(rows, rows)));
    if (factor.info() != Eigen::Success)
        throw NumericalError("static stability: the elastic stiffness has negative springs");
    Matrix scaled = static_stiffness(system)(rows, rows);
    factor.matrixL().solveInPlace(scaled);
    factor.matrixU().solveInPlace<Eigen::OnTheRight>(scaled);
    RealEigen eigen(scaled.rows(), scaled.rows());
    if (!eigen.compute(scaled)) throw NumericalError("static stability: the eigenvalue iteration did not converge");
    for (const RealEigen::Value& value : eigen.values())
        out.product *= value.mu.imag() == 0 ? value.mu.real() : std::norm(value.mu);
    std::vector<RealEigen::Value> real = eigen.values();
    std::erase_if(real, [](const RealEigen::Value& value) { return value.mu.imag() != 0; });
    std::ranges::sort(real, {}, [](const RealEigen::Value& value) { return value.mu.real(); });
    out.shapes.setZero(system.M.rows(), std::ssize(real));
    for (const RealEigen::Value& value : real) {
        Vector shape = eigen.vectors().col(value.column);
        factor.matrixU().solveInPlace(shape);
        out.shapes.col(std::ssize(out.values))(rows) = shape;
        out.values.push_back(value.mu.real());
    }
    return out;
}

// By inverse iteration next to the root.
Vector left_shape(const SecondOrderSystem& system, double sigma, double mu) {
    constexpr double beside = 1e-9;
    const std::vector<int> rows = held_rows(system);
    const Matrix singular = static_stiffness(system) - (mu + beside) * weights_of(system, sigma);
    const Eigen::PartialPivLU<Matrix> factor(Matrix(singular(rows, rows).transpose()));
    Vector own = Vector::Ones(std::ssize(rows));
    for (int i = 0; i < 3; ++i) own = factor.solve(own).normalized();
    Vector out = Vector::Zero(system.M.rows());
    out(rows) = own;
    return out;
}

namespace {

// P(lambda) of the complete system by powers of lambda, the states solved for: of first and second order times a
// vector.
class SlowTerms {
public:
    explicit SlowTerms(const SecondOrderSystem& system) : system_(system) {}
    struct Terms {
        Vector first, second;
    };
    Terms times(const Vector& x) const {
        const StateTerms& t = system_.states;
        Terms out{system_.C * x, system_.M * x};
        if (t.size() == 0) return out;
        Matrix follow = t.f_q * x;
        t.f_s.solve(follow);
        follow += t.f_qd * x;
        t.f_s.solve(follow);
        out.first += t.Q_s * follow;
        t.f_s.solve(follow);
        out.second += t.Q_s * follow;
        return out;
    }

private:
    const SecondOrderSystem& system_;
};

// K z = b, b without a part along y, z with none either: y^T W z = 0.
Vector solve_beside(const Matrix& K, const Vector& Wx, const Vector& yW, const Vector& b) {
    const Eigen::Index n = K.rows();
    Matrix bordered = Matrix::Zero(n + 1, n + 1);
    bordered.topLeftCorner(n, n) = K;
    bordered.topRightCorner(n, 1) = Wx;
    bordered.bottomLeftCorner(1, n) = yW.transpose();
    Vector right = Vector::Zero(n + 1);
    right.head(n) = b;
    return Eigen::PartialPivLU<Matrix>(bordered).solve(right).head(n);
}

}  // namespace

bool grows_below_zero(const SecondOrderSystem& system, const StaticRoots& roots, int k) {
    constexpr double rounding = 1e-9;
    const std::vector<int> rows = held_rows(system);
    const Vector x = roots.shapes.col(k), y = left_shape(system, roots.sigma, entry(roots.values, k));
    const Matrix W = weights_of(system, roots.sigma);
    const Vector Wx = W * x, yW = W.transpose() * y;
    const double size = y.dot(Wx);
    const SlowTerms slow(system);
    const SlowTerms::Terms own = slow.times(x);
    const double c = y.dot(own.first);
    Vector z = Vector::Zero(x.size());
    z(rows) = solve_beside(static_stiffness(system)(rows, rows), Wx(rows), yW(rows),
                           Vector((own.first - c / size * Wx)(rows)));
    const double m = y.dot(own.second - slow.times(z).first);
    return size * (std::abs(c) > rounding * roots.sigma * std::abs(m) ? c : m) > 0;
}

}  // namespace cardan::solvers
