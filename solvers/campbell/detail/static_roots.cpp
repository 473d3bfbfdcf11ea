#include "solvers/campbell/detail/static_roots.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/real_eigen.hpp"
#include "solvers/linear/detail/shifted_state.hpp"

#include <algorithm>

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

}  // namespace cardan::solvers
