#include "solvers/linear/detail/shifted_states.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <limits>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

}  // namespace

FirstOrderWithStates::FirstOrderWithStates(const SecondOrderSystem& system, const Vector& units, double scale)
    : units_(units) {
    const StateTerms& t = system.states;
    const Index n = system.M.rows(), m = t.size();
    order_.reserve(static_cast<std::size_t>(m));
    for (const GroupedMatrix::Group& group : t.f_s.groups()) {
        const Vector u = units.tail(m)(group.rows);
        groups.push_back(
            {std::ssize(order_), u.cwiseInverse().asDiagonal() * group.block * u.asDiagonal() / scale, 0, {}});
        order_.insert(order_.end(), group.rows.begin(), group.rows.end());
    }
    units_.tail(m) = units.tail(m)(order_);
    const auto d = units_.head(n).asDiagonal(), u = units_.tail(m).asDiagonal();
    const Vector inverse = units_.tail(m).cwiseInverse();
    M = d * system.M * d;
    C = d * system.C * d / scale;
    K = d * system.K * d / (scale * scale);
    if (m > 0) {
        Q_s = d * t.Q_s(Eigen::all, order_) * u / (scale * scale);
        rates.resize(m, 2 * n);
        rates.leftCols(n) = inverse.asDiagonal() * t.f_q(order_, Eigen::all) * d / scale;
        rates.rightCols(n) = inverse.asDiagonal() * t.f_qd(order_, Eigen::all) * d;
        find_loads();
    } else {
        Q_s.resize(n, 0);
        rates.resize(0, 2 * n);
        loads.resize(n, 0);
    }
}

void FirstOrderWithStates::find_loads() {
    constexpr double rounding = 1e-14;
    std::vector<Matrix> parts;
    Index count = 0;
    for (Group& group : groups) {
        const Index k = group.f_s.rows();
        Eigen::ColPivHouseholderQR<Matrix> qr;
        qr.setThreshold(rounding);
        qr.compute(Q_s.middleCols(group.first, k));
        const Index rank = qr.rank();
        const Matrix triangle = qr.matrixR().topRows(rank).triangularView<Eigen::Upper>();
        group.first_load = count;
        group.load = triangle * qr.colsPermutation().transpose();
        parts.push_back(qr.householderQ() * Matrix::Identity(rows(), rank));
        count += rank;
    }
    loads.resize(rows(), count);
    for (std::size_t g = 0; g < groups.size(); ++g) loads.middleCols(groups[g].first_load, parts[g].cols()) = parts[g];
}

ComplexVector FirstOrderWithStates::times_B(const ComplexVector& z) const {
    ComplexVector out = z;
    out.segment(rows(), rows()) = product_in_parts(M, z.segment(rows(), rows()));
    return out;
}

ComplexVector FirstOrderWithStates::forces(const ComplexVector& r) const {
    const Index n = rows(), m = states();
    ComplexVector out(n + m);
    out.head(n) = units_.head(n).cwiseProduct(r.head(n));
    for (Index i = 0; i < m; ++i) out(n + i) = r(n + entry(order_, i)) / units_(n + i);
    return out;
}

ComplexVector FirstOrderWithStates::motion(const ComplexVector& x) const {
    const Index n = rows(), m = states();
    ComplexVector out(n + m);
    out.head(n) = units_.head(n).cwiseProduct(x.head(n));
    for (Index i = 0; i < m; ++i) out(n + entry(order_, i)) = units_(n + i) * x(n + i);
    return out;
}

ComplexVector FirstOrderWithStates::left(const ComplexVector& w) const {
    const Index n = rows(), m = states();
    ComplexVector out(n + m);
    out.head(n) = units_.head(n).cwiseProduct(w.head(n));
    for (Index i = 0; i < m; ++i) out(n + entry(order_, i)) = w(n + i) / units_(n + i);
    return out;
}

void FirstOrderWithStates::hold(Index row) {
    if (row < rows()) {
        for (Matrix* A : {&M, &C, &K}) {
            A->row(row).setZero();
            A->col(row).setZero();
        }
        K(row, row) = 1;
        Q_s.row(row).setZero();
        loads.row(row).setZero();
        rates.col(row).setZero();
        rates.col(rows() + row).setZero();
        return;
    }
    for (Group& group : groups)
        for (Index i = 0; i < group.f_s.rows(); ++i) {
            const Index state = group.first + i;
            if (entry(order_, state) != row - rows()) continue;
            group.f_s.row(i).setZero();
            group.f_s.col(i).setZero();
            group.f_s(i, i) = -1;
            Q_s.col(state).setZero();
            group.load.col(i).setZero();
            rates.row(state).setZero();
        }
}

ShiftedStates::ShiftedStates(const FirstOrderWithStates& system)
    : system_(system), re_(system.rows(), system.rows()), im_(re_), factors_(2 * system.rows()) {
    groups_.reserve(system.groups.size());
    for (const FirstOrderWithStates::Group& group : system.groups) groups_.emplace_back(2 * group.f_s.rows());
}

// S, with P (sigma - f_s)^-1 = (a + i b)^T of every group, P its loads.
void ShiftedStates::assemble(Complex sigma) {
    sigma_ = sigma;
    const FirstOrderWithStates& z = system_;
    const Index n = z.rows();
    of_re_.resize(z.loads.cols(), n);
    of_im_.resize(z.loads.cols(), n);
    for (std::size_t g = 0; g < z.groups.size(); ++g) {
        const auto& [first, f_s, first_load, load] = z.groups[g];
        const Index k = f_s.rows(), r = load.rows();
        Matrix& shifted = groups_[g].matrix();
        shifted.setZero();
        shifted.topLeftCorner(k, k) = -f_s;
        shifted.bottomRightCorner(k, k) = -f_s;
        shifted.diagonal().array() += sigma.real();
        shifted.topRightCorner(k, k).diagonal().setConstant(-sigma.imag());
        shifted.bottomLeftCorner(k, k).diagonal().setConstant(sigma.imag());
        groups_[g].factorise();
        turned_.setZero(2 * k, r);  // (a; -b)
        turned_.topRows(k) = load.transpose();
        groups_[g].solve_transposed(turned_);
        const Matrix both = turned_.reshaped(k, 2 * r).transpose();  // of each load a, -b
        part_.setZero(2 * r, 2 * n);
        add_product(part_, both, z.rates.middleRows(first, k));
        for (Index i = 0; i < r; ++i) {
            const auto a_q = part_.row(2 * i).head(n), a_qd = part_.row(2 * i).tail(n),
                       b_q = part_.row(2 * i + 1).head(n), b_qd = part_.row(2 * i + 1).tail(n);
            of_re_.row(first_load + i) = a_q + sigma.real() * a_qd + sigma.imag() * b_qd;
            of_im_.row(first_load + i) = sigma.imag() * a_qd - b_q - sigma.real() * b_qd;
        }
    }
    const Complex square = sigma * sigma;
    re_ = square.real() * z.M + sigma.real() * z.C + z.K;
    im_ = square.imag() * z.M + sigma.imag() * z.C;
    add_product(re_, z.loads, of_re_, -1);
    if (sigma.imag() != 0) add_product(im_, z.loads, of_im_, -1);
}

void ShiftedStates::set(Complex sigma) {
    assemble(sigma);
    factors_.matrix() << re_, -im_, im_, re_;
    factors_.factorise();
}

ComplexMatrix ShiftedStates::of_states() const {
    const FirstOrderWithStates& z = system_;
    const Complex square = sigma_ * sigma_;
    ComplexMatrix out(z.rows(), z.rows());
    out.real() = square.real() * z.M + sigma_.real() * z.C + z.K - re_;
    out.imag() = square.imag() * z.M + sigma_.imag() * z.C - im_;
    return out;
}

void ShiftedStates::set_states(ComplexVector& z) const {
    const Index n = system_.rows(), m = system_.states();
    z.tail(m) = eliminated(
        product_in_parts(system_.f_q(), z.head(n)) + product_in_parts(system_.f_qd(), z.segment(n, n)), false);
}

double ShiftedStates::pivot_ratio() const {
    for (const LuFactors& group : groups_)
        if (!group.regular()) return std::numeric_limits<double>::quiet_NaN();
    return factors_.pivot_ratio();
}

ComplexVector ShiftedStates::eliminated(const ComplexVector& s, bool adjoint) const {
    ComplexVector out(s.size());
    Vector own;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const Index first = system_.groups[g].first, k = system_.groups[g].f_s.rows();
        own.resize(2 * k);
        own << s.segment(first, k).real(), s.segment(first, k).imag();
        if (adjoint)
            groups_[g].solve_transposed(own);
        else
            groups_[g].solve(own);
        out.segment(first, k).real() = own.head(k);
        out.segment(first, k).imag() = own.tail(k);
    }
    return out;
}

ComplexVector ShiftedStates::solved(const ComplexVector& b, bool adjoint) const {
    const Index n = b.size();
    Vector parts(2 * n);
    parts << b.real(), b.imag();
    if (adjoint)
        factors_.solve_transposed(parts);
    else
        factors_.solve(parts);
    ComplexVector x(n);
    x.real() = parts.head(n);
    x.imag() = parts.tail(n);
    return x;
}

void ShiftedStates::respond(ComplexVector& r) const {
    const FirstOrderWithStates& z = system_;
    const Index n = z.rows(), m = z.states();
    if (m == 0) {
        r = solved(r, false);
        return;
    }
    const ComplexVector r_s = r.tail(m);
    const ComplexVector x = solved(r.head(n) + product_in_parts(z.Q_s, eliminated(r_s, false)), false);
    r << x, eliminated(r_s + product_in_parts(z.f_q(), x) + sigma_ * product_in_parts(z.f_qd(), x), false);
}

// v = b_x + sigma x: S x = -b_v - (C + sigma M) b_x + ..., with rates f_qd b_x - b_s of the states.
void ShiftedStates::solve(const ComplexVector& b, ComplexVector& out) const {
    const FirstOrderWithStates& z = system_;
    const Index n = z.rows(), m = z.states();
    const ComplexVector b_x = b.head(n);
    ComplexVector r(n + m);
    r << -b.segment(n, n) - product_in_parts(z.C, b_x) - sigma_ * product_in_parts(z.M, b_x),
        product_in_parts(z.f_qd(), b_x) - b.tail(m);
    respond(r);
    out.resize(z.size());
    out << r.head(n), b_x + sigma_ * r.head(n), r.tail(m);
}

// Rows w = (w_x, w_v, w_s), with D = (sigma - f_s)^-H:
//   S^H w_v = -(b_x + conj(sigma) b_v + (f_q + sigma f_qd)^H D b_s),
//   w_s = D (Q_s^T w_v - b_s),  w_x = b_v + (C + sigma M)^H w_v - f_qd^T w_s.
void ShiftedStates::solve_adjoint(const ComplexVector& b, ComplexVector& out) const {
    const FirstOrderWithStates& z = system_;
    const Index n = z.rows(), m = z.states();
    const Complex sigma = std::conj(sigma_);
    const ComplexVector b_s = b.tail(m), own = eliminated(b_s, true);
    const ComplexVector w_v =
        solved(-(b.head(n) + sigma * b.segment(n, n) + product_in_parts(z.f_q().transpose(), own) +
                 sigma * product_in_parts(z.f_qd().transpose(), own)),
               true);
    const ComplexVector w_s = eliminated(product_in_parts(z.Q_s.transpose(), w_v) - b_s, true);
    out.resize(z.size());
    out << b.segment(n, n) + product_in_parts(z.C.transpose(), w_v) + sigma * product_in_parts(z.M.transpose(), w_v) -
               product_in_parts(z.f_qd().transpose(), w_s),
        w_v, w_s;
}

}  // namespace cardan::solvers
