#include "solvers/linear/detail/left_vector.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/algebra/coupled_groups.hpp"
#include "solvers/algebra/dense.hpp"

#include <cmath>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Columns of complex numbers.
struct Parts {
    Matrix re, im;
};

// x := (near - f_s)^-H x, the states in units u, as [a, b; -b, a] by groups with a - i b = u (near - f_s)^H / u.
class StateFactors {
public:
    StateFactors(const Matrix& f_s, Complex near, const Vector& units) {
        for (std::vector<Index>& rows : coupled_groups(f_s, 0)) {
            const Index k = std::ssize(rows);
            const Vector own = units(rows);
            Group& group = groups_.emplace_back(Group{std::move(rows), LuFactors(2 * k)});
            Matrix& B = group.factors.matrix();
            const Matrix unit = Matrix::Identity(k, k);
            B.topLeftCorner(k, k) = B.bottomRightCorner(k, k) =
                near.real() * unit -
                Matrix(own.asDiagonal() * f_s(group.rows, group.rows).transpose() * own.cwiseInverse().asDiagonal());
            B.topRightCorner(k, k) = near.imag() * unit;
            B.bottomLeftCorner(k, k) = -near.imag() * unit;
            group.factors.factorise();
        }
    }

    void solve(Parts& x) const {
        for (const Group& group : groups_) {
            const Index k = std::ssize(group.rows);
            Matrix own(2 * k, x.re.cols());
            own << x.re(group.rows, Eigen::all), x.im(group.rows, Eigen::all);
            group.factors.solve(own);
            x.re(group.rows, Eigen::all) = own.topRows(k);
            x.im(group.rows, Eigen::all) = own.bottomRows(k);
        }
    }

private:
    struct Group {
        std::vector<Index> rows;
        LuFactors factors;
    };
    std::vector<Group> groups_;
};

}  // namespace

// P^H x = b again and again, with P = [A, B; C, D]:
//   (A^H - C^H Y) x_q = b_q - C^H D^-H b_s,  x_s = D^-H b_s - Y x_q,  Y = D^-H B^T.
ComplexVector left_vector(const SecondOrderSystem& system, Complex eigenvalue, const Vector& units) {
    const StateTerms& t = system.states;
    const Index n = system.M.rows(), m = t.size();
    const Vector d = units.head(n), u = units.tail(m), over = u.cwiseInverse();
    const Complex near = eigenvalue + Complex(1, 1) * (1e-9 * std::abs(eigenvalue) + 1e-12), square = near * near;
    Matrix re = d.asDiagonal() * Matrix(square.real() * system.M + near.real() * system.C + system.K).transpose() *
                d.asDiagonal(),
           im = -(d.asDiagonal() * Matrix(square.imag() * system.M + near.imag() * system.C).transpose() *
                  d.asDiagonal());
    const StateFactors D(t.f_s, near, u);
    Parts Y, C;
    if (m > 0) {
        Y.re = -(u.asDiagonal() * t.Q_s.transpose() * d.asDiagonal());
        Y.im.setZero(m, n);
        D.solve(Y);
        C.re = -(over.asDiagonal() * Matrix(t.f_q + near.real() * t.f_qd) * d.asDiagonal());
        C.im = -near.imag() * (over.asDiagonal() * t.f_qd * d.asDiagonal());
        re -= C.re.transpose() * Y.re + C.im.transpose() * Y.im;
        im -= C.re.transpose() * Y.im - C.im.transpose() * Y.re;
    }
    LuFactors lu(2 * n);
    Matrix& S = lu.matrix();
    S << re, -im, im, re;
    lu.factorise();
    Parts x_s{Matrix::Ones(m, 1), Matrix::Ones(m, 1)};
    Vector x_q = Vector::Ones(2 * n);
    for (int i = 0; i < 3; ++i) {
        if (m > 0) {
            D.solve(x_s);
            x_q.head(n) -= C.re.transpose() * x_s.re + C.im.transpose() * x_s.im;
            x_q.tail(n) -= C.re.transpose() * x_s.im - C.im.transpose() * x_s.re;
        }
        lu.solve(x_q);
        if (m > 0) {
            x_s.re -= Y.re * x_q.head(n) - Y.im * x_q.tail(n);
            x_s.im -= Y.re * x_q.tail(n) + Y.im * x_q.head(n);
        }
        const double length = std::sqrt(x_q.squaredNorm() + x_s.re.squaredNorm() + x_s.im.squaredNorm());
        x_q /= length, x_s.re /= length, x_s.im /= length;
    }
    ComplexVector left(n + m);
    left.head(n).real() = d.cwiseProduct(x_q.head(n));
    left.head(n).imag() = d.cwiseProduct(x_q.tail(n));
    left.tail(m).real() = over.cwiseProduct(x_s.re.col(0));
    left.tail(m).imag() = over.cwiseProduct(x_s.im.col(0));
    return left;
}

}  // namespace cardan::solvers
