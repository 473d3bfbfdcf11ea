/// @file
/// Random systems with many local states.
#pragma once

#include "solvers/linear/linearise.hpp"

#include <random>

namespace cardan::testing {

/// n coordinates with frequencies from 1 to about 20 rad/s and damping ratios of some per cent; groups of `size` lags
/// with rates of 2 to 10 1/s that act on the coordinates and on which these act.
inline solvers::SecondOrderSystem machine_in_air(unsigned seed, Eigen::Index n, Eigen::Index groups, Eigen::Index size,
                                                 double coupling) {
    using Index = Eigen::Index;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto any = [&](Index rows, Index columns) {
        return Matrix(Matrix::NullaryExpr(rows, columns, [&] { return number(random); }));
    };
    solvers::SecondOrderSystem system;
    const Matrix a = any(n, n);
    system.M = Matrix::Identity(n, n) + 0.1 / static_cast<double>(n) * a * a.transpose();
    const Vector omega = Vector::LinSpaced(n, 1, 20);
    system.K = omega.cwiseAbs2().asDiagonal();
    system.K_elastic = system.K;
    system.C = 0.05 * omega.asDiagonal();
    system.C += 0.02 * (a - a.transpose());
    solvers::StateTerms& t = system.states;
    const Index m = groups * size;
    t.Q_s = coupling * any(n, m);
    t.f_q = coupling * any(m, n);
    t.f_qd = coupling * any(m, n);
    Matrix f_s = Matrix::Zero(m, m);
    for (Index g = 0; g < groups; ++g) {
        const double rate = 2 + 8 * static_cast<double>(g) / static_cast<double>(groups);
        f_s.block(g * size, g * size, size, size) = 0.3 * any(size, size) - rate * Matrix::Identity(size, size);
    }
    t.f_s = f_s;
    t.scales = Vector::Ones(m);
    return system;
}

/// States of their own, that hardly anything feels.
inline void add_states(solvers::SecondOrderSystem& system, const Matrix& f_s) {
    using Index = Eigen::Index;
    solvers::StateTerms& t = system.states;
    const Index n = system.M.rows(), m = t.size(), more = f_s.rows();
    Matrix all = Matrix::Zero(m + more, m + more);
    all.topLeftCorner(m, m) = t.f_s.dense();
    all.bottomRightCorner(more, more) = f_s;
    t.f_s = all;
    t.Q_s.conservativeResize(n, m + more);
    t.Q_s.rightCols(more).setConstant(1e-3);
    for (Matrix* f : {&t.f_q, &t.f_qd}) {
        f->conservativeResize(m + more, n);
        f->bottomRows(more).setConstant(1e-3);
    }
    t.scales = Vector::Ones(m + more);
}

/// Units for the functions that eliminate states.
inline Vector units_of(const solvers::SecondOrderSystem& system) {
    Vector units(system.M.rows() + system.states.size());
    units << system.M.diagonal().cwiseSqrt().cwiseInverse(), system.states.scales;
    return units;
}

}  // namespace cardan::testing
