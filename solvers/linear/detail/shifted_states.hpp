/// @file
/// Systems with local states at one point of the complex plane, solved without their states. Internal to solvers: not
/// installed.
#pragma once

#include "solvers/algebra/dense.hpp"
#include "solvers/linear/linearise.hpp"

#include <vector>

namespace cardan::solvers {

/// A second-order system with states s as B z' = A z for z = (x, x', s), B = diag(1, M, 1), in units in which its rows
/// are alike in size. States come in groups that couple with one another (GroupedMatrix), which stand together.
class FirstOrderWithStates {
public:
    /// @param units  of coordinates, then states: x = units x'
    /// @param scale  unit of rates, rad/s
    FirstOrderWithStates(const SecondOrderSystem& system, const Vector& units, double scale = 1);

    Eigen::Index rows() const { return M.rows(); }
    Eigen::Index states() const { return Q_s.cols(); }
    Eigen::Index size() const { return 2 * rows() + states(); }
    /// B z, and B^H z as B is symmetric.
    ComplexVector times_B(const ComplexVector& z) const;
    /// Forces on the coordinates and rates of the states, from the system's units and order.
    ComplexVector forces(const ComplexVector& r) const;
    /// x and s in the system's units and order; and rows of its equations that left vectors stand for.
    ComplexVector motion(const ComplexVector& x) const;
    ComplexVector left(const ComplexVector& w) const;
    /// No motion of this coordinate, or of state row - rows(), by the system's order: its equation becomes x = 0 at the
    /// shift zero.
    void hold(Eigen::Index row);

    /// Forces of a group's states are few: its columns of Q_s are `loads` columns times `load`.
    struct Group {
        Eigen::Index first;  ///< state
        Matrix f_s;
        Eigen::Index first_load;
        Matrix load;
    };
    Matrix M, C, K, Q_s, loads;
    Matrix rates;  ///< f_q, f_qd side by side
    auto f_q() const { return rates.leftCols(rows()); }
    auto f_qd() const { return rates.rightCols(rows()); }
    std::vector<Group> groups;

private:
    void find_loads();

    std::vector<Eigen::Index> order_;  // of the states, by place here
    Vector units_;
};

/// A system at s = sigma with the states eliminated group by group: x of
///
///     S = sigma^2 M + sigma C + K - Q_s (sigma - f_s)^-1 (f_q + sigma f_qd).
///
/// Cost to set it up 2 n^2 l + 6 n^3 real multiplications for n rows and m states that make l loads, three or so for
/// each section of the air; for a product some 8 n m.
class ShiftedStates {
public:
    explicit ShiftedStates(const FirstOrderWithStates& system);

    void set(Complex sigma);
    /// Pivot ratio of S, LuFactors::pivot_ratio(); not a number if a group of states is singular.
    double pivot_ratio() const;
    /// S without its factors: respond(), solve() and solve_adjoint() need set().
    void assemble(Complex sigma);
    /// Real part of S.
    const Matrix& real_part() const { return re_; }
    const Matrix& imaginary_part() const { return im_; }
    /// Q_s (sigma - f_s)^-1 (f_q + sigma f_qd)
    ComplexMatrix of_states() const;
    /// s := (sigma - f_s)^-1 (f_q x + f_qd x') of z = (x, x', s).
    void set_states(ComplexVector& z) const;
    /// S x = r + Q_s (sigma - f_s)^-1 r_s, and s: what forces r on the coordinates and rates r_s make at e^(sigma t).
    /// @param r  r, then r_s; becomes x, then s
    void respond(ComplexVector& r) const;
    /// out = (A - sigma B)^-1 b
    void solve(const ComplexVector& b, ComplexVector& out) const;
    /// out = (A - sigma B)^-H b
    void solve_adjoint(const ComplexVector& b, ComplexVector& out) const;

private:
    ComplexVector eliminated(const ComplexVector& s, bool adjoint) const;
    ComplexVector solved(const ComplexVector& b, bool adjoint) const;

    const FirstOrderWithStates& system_;
    Complex sigma_;
    std::vector<LuFactors> groups_;         // of [a, -b; b, a] with sigma - f_s = a + i b
    Matrix re_, im_;                        // of S
    LuFactors factors_;                     // of [re, -im; im, re]
    Matrix turned_, part_, of_re_, of_im_;  // memory of set()
};

}  // namespace cardan::solvers
