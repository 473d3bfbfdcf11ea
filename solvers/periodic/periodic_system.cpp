#include "solvers/periodic/periodic_system.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/finite.hpp"
#include "solvers/linear/coordinate_rows.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;
constexpr const char* in_blade_symmetry = "blade symmetry";

void check(const char* name, double time, const Matrix& A, Index rows) {
    if (A.rows() != rows || A.cols() != rows)
        throw NumericalError(text("periodic system: ", name, " at ", time, " s is ", A.rows(), " x ", A.cols(),
                                  "; wanted: ", rows, " x ", rows));
    if (!all_finite(A)) throw NumericalError(text("periodic system: ", name, " at ", time, " s is not finite"));
}

// The matrices at a time, that of the highest derivative last.
struct Coefficients {
    Coefficients(const PeriodicSystem& system, double time) {
        if (system.is_second_order()) {
            SecondOrderSystem own;
            system.at(time, own);
            matrices = {own.K, own.C, own.M};
            states = std::move(own.states);
        } else {
            matrices.resize(2);
            system.at(time, matrices[1], matrices[0]);
        }
    }
    // Diagonals added up at the frequency omega: what entries of a row are measured by.
    Vector size(double omega) const {
        Vector sum = Vector::Zero(matrices[0].rows());
        double factor = 1;
        for (const Matrix& m : matrices) {
            sum += factor * m.diagonal().cwiseAbs();
            factor *= omega;
        }
        return sum.cwiseMax(1e-12 * sum.maxCoeff());
    }
    std::vector<Matrix> matrices;
    StateTerms states;
};

void check_states(double time, const SecondOrderSystem& system, Index rows, Index beside) {
    const StateTerms& t = system.states;
    if (beside == 0 && t.size() == 0) return;
    const std::string where = text("periodic system at ", time, " s");
    const auto check = [&](const char* name, const Matrix& A, Index r, Index c) {
        require_size(where.c_str(), name, A, r, c);
        if (!all_finite(A)) throw NumericalError(text(where, ": ", name, " is not finite"));
    };
    require_count(where.c_str(), "states", static_cast<std::size_t>(t.size()), static_cast<std::size_t>(beside));
    if (!t.f_s.all_finite()) throw NumericalError(text(where, ": f_s is not finite"));
    check("Q_s", t.Q_s, rows, beside);
    check("f_q", t.f_q, beside, rows);
    check("f_qd", t.f_qd, beside, rows);
    require_size(where.c_str(), "scales of states", t.scales, beside);
}

}  // namespace

PeriodicSystem::PeriodicSystem(double period, Index rows) : period_(period), rows_(rows) {
    require_positive("periodic system", "period [s]", period);
    if (rows < 1) throw InputError("periodic system", "number of rows", rows, ">= 1");
}

PeriodicSystem PeriodicSystem::second_order(double period, Index coordinates, SecondOrder at, Index beside) {
    if (!at) throw InputError("periodic system: the function of M, C and K is empty");
    if (beside < 0) throw InputError("periodic system", "number of states beside the coordinates", beside, ">= 0");
    PeriodicSystem system(period, coordinates);
    system.beside_ = beside;
    system.second_ = std::move(at);
    return system;
}

PeriodicSystem PeriodicSystem::first_order(double period, Index states, FirstOrder at) {
    if (!at) throw InputError("periodic system: the function of E and A is empty");
    PeriodicSystem system(period, states);
    system.first_ = std::move(at);
    return system;
}

void PeriodicSystem::at(double time, SecondOrderSystem& out) const {
    if (!second_) throw InputError("periodic system", "order", 1, "2 for M, C and K");
    second_(time, out);
    check("M", time, out.M, rows_);
    check("C", time, out.C, rows_);
    check("K", time, out.K, rows_);
    if (out.K_elastic.size() == 0) out.K_elastic.setZero(rows_, rows_);
    check("K_elastic", time, out.K_elastic, rows_);
    check_states(time, out, rows_, beside_);
}

void PeriodicSystem::at(double time, Matrix& E, Matrix& A) const {
    if (first_) {
        first_(time, E, A);
        check("E", time, E, rows_);
        check("A", time, A, rows_);
        return;
    }
    SecondOrderSystem own;
    at(time, own);
    const Index n = rows_, m = beside_;
    E.setIdentity(states(), states());
    E.block(n, n, n, n) = own.M;
    A.setZero(states(), states());
    A.block(0, n, n, n).setIdentity();
    A.block(n, 0, n, n) = -own.K;
    A.block(n, n, n, n) = -own.C;
    if (m == 0) return;
    A.block(n, 2 * n, n, m) = own.states.Q_s;
    A.bottomRows(m) << own.states.f_q, own.states.f_qd, own.states.f_s.dense();
}

PeriodicSystem in_multi_blade_rows(PeriodicSystem system, ColemanTransform transform, double rotor_speed) {
    const double period = system.period();
    const Index rows = system.rows(), beside = system.states_beside();
    return PeriodicSystem::second_order(
        period, rows,
        [raw = std::move(system), T = std::move(transform), rotor_speed](double t, SecondOrderSystem& out) {
            raw.at(t, out);
            T.transform_in_place(out, rotor_speed * t, rotor_speed);
        },
        beside);
}

namespace {

bool is_identity(const Matrix& P) {
    return P == Matrix::Identity(P.rows(), P.cols());
}

Matrix renumbered(const Matrix& P, const Matrix& A) {
    return P * A * P.transpose();
}

// The matrices of the states, renumbered in place. Three and more blades stay where they are in multi-blade rows.
void renumber(const Matrix& P, const Matrix& P_beside, StateTerms& t) {
    if (is_identity(P) && is_identity(P_beside)) return;
    t.Q_s = (P * t.Q_s * P_beside.transpose()).eval();
    t.f_q = (P_beside * t.f_q * P.transpose()).eval();
    t.f_qd = (P_beside * t.f_qd * P.transpose()).eval();
    t.f_s = renumbered(P_beside, t.f_s.dense());
}

}  // namespace

Matrix BladeSymmetry::of_states(const PeriodicSystem& system) const {
    if (!system.is_second_order()) return P;
    const Index n = system.rows(), m = system.states_beside();
    Matrix all = Matrix::Zero(system.states(), system.states());
    all.block(0, 0, n, n) = all.block(n, n, n, n) = P;
    if (m > 0) all.bottomRightCorner(m, m) = P_beside;
    return all;
}

SecondOrderSystem mean_over_period(const PeriodicSystem& system, int samples, const BladeSymmetry& symmetry) {
    if (samples < 1) throw InputError("mean over a period", "number of samples", samples, ">= 1");
    const Index beside = system.states_beside();
    const int Q = symmetry.parts, of_part = (samples + Q - 1) / Q;
    SecondOrderSystem mean, scratch;
    system.at(0, mean);
    const auto at = [&](int i, SecondOrderSystem& out) { system.at(system.period() * i / (Q * of_part), out); };
    average(of_part, at, mean, scratch);
    if (Q == 1 || (is_identity(symmetry.P) && (beside == 0 || is_identity(symmetry.P_beside)))) return mean;
    // One part later the matrices are P^T A P.
    const Matrix back = symmetry.P.transpose();
    if (beside > 0) {
        StateTerms part = mean.states;
        for (int k = 1; k < Q; ++k) {
            renumber(back, symmetry.P_beside.transpose(), part);
            mean.states += part;
        }
        for (Matrix* m : {&mean.states.Q_s, &mean.states.f_q, &mean.states.f_qd}) *m /= Q;
        mean.states.f_s /= Q;
    }
    for (Matrix* m : {&mean.M, &mean.C, &mean.K, &mean.K_elastic}) {
        Matrix part = *m;
        for (int k = 1; k < Q; ++k) {
            part = renumbered(back, part);
            *m += part;
        }
        *m /= Q;
    }
    return mean;
}

namespace {

// P of a symmetry, piece by piece.
class Permutation {
public:
    explicit Permutation(const std::vector<int>& coordinates)
        : P(Matrix::Identity(std::ssize(coordinates), std::ssize(coordinates))), coordinates_(coordinates) {}

    /// @param rows  one of every blade
    void renumber(const std::vector<Index>& rows, bool backward);
    void renumber(const std::vector<std::vector<int>>& blades, std::size_t coordinate, bool backward);
    void turn(const RotatingPair& pair, double angle);
    void reverse(int coordinate);

    Matrix P;

private:
    Index row(int coordinate) const { return row_of(coordinates_, coordinate); }
    bool has(int coordinate) const { return row(coordinate) >= 0; }

    const std::vector<int>& coordinates_;
};

void Permutation::renumber(const std::vector<std::vector<int>>& blades, std::size_t coordinate, bool backward) {
    const std::size_t Q = blades.size();
    const auto there = static_cast<std::size_t>(
        std::count_if(blades.begin(), blades.end(), [&](const auto& blade) { return has(blade[coordinate]); }));
    if (there == 0) return;
    if (there < Q)
        throw InputError(in_blade_symmetry, text("blades whose coordinate number ", coordinate, " is an unknown"),
                         there, text("none or all ", Q));
    std::vector<Index> rows;
    rows.reserve(Q);
    for (const auto& blade : blades) rows.push_back(row(blade[coordinate]));
    renumber(rows, backward);
}

void Permutation::renumber(const std::vector<Index>& rows, bool backward) {
    const std::size_t Q = rows.size();
    for (std::size_t k = 0; k < Q; ++k) {
        const Index here = rows[k], next = rows[(k + 1) % Q];
        P(here, here) = 0;
        (backward ? P(here, next) : P(next, here)) = 1;
    }
}

void Permutation::turn(const RotatingPair& pair, double angle) {
    if (!has(pair.y) && !has(pair.z)) return;
    if (!has(pair.y) || !has(pair.z))
        throw InputError(in_blade_symmetry, "coordinates of a rotating pair", 1, "none or both of a pair");
    const Index y = row(pair.y), z = row(pair.z);
    const double c = std::cos(angle), s = pair.sense * std::sin(angle);
    P(y, y) = P(z, z) = c;
    P(y, z) = -s;
    P(z, y) = s;
}

void Permutation::reverse(int coordinate) {
    if (!has(coordinate)) throw InputError(in_blade_symmetry, "odd coordinate", coordinate, "one of the unknowns");
    P.row(row(coordinate)) *= -1;
}

// Empty if there are none.
Matrix permutation_of_states(const RotorMap& rotor, const StateTable& states, bool backward) {
    if (states.empty()) return {};
    std::vector<int> all(static_cast<std::size_t>(states.size()));
    std::iota(all.begin(), all.end(), 0);
    Permutation permutation(all);
    for (const std::vector<int>& one : states_of_blades(rotor, states))
        permutation.renumber(std::vector<Index>(one.begin(), one.end()), backward);
    return permutation.P;
}

}  // namespace

BladeSymmetry blade_symmetry(const RotorMap& rotor, const std::vector<int>& coordinates, double rotor_speed,
                             const std::vector<int>& odd, const StateTable& states) {
    const std::size_t Q = rotor.blades.size();
    if (Q < 2) throw InputError(in_blade_symmetry, "number of blades", Q, ">= 2");
    if (!rotor.evenly_spaced)
        throw InputError(in_blade_symmetry, "spacing of the blades", uneven_spacing(rotor), "equal angles");
    if (!odd.empty() && Q != 2)
        throw InputError(in_blade_symmetry, "number of blades", Q,
                         "2 where coordinates change sign after a part of a turn");
    for (const auto& blade : rotor.blades)
        if (blade.size() != rotor.blades[0].size())
            throw InputError(in_blade_symmetry, "coordinates of a blade", blade.size(),
                             text(rotor.blades[0].size(), " as of blade 1"));
    Permutation permutation(coordinates);
    for (std::size_t i = 0; i < rotor.blades[0].size(); ++i) permutation.renumber(rotor.blades, i, rotor_speed < 0);
    for (const RotatingPair& pair : rotor.rotating_pairs)
        permutation.turn(pair, (rotor_speed < 0 ? -2 : 2) * pi / static_cast<double>(Q));
    for (int coordinate : odd) permutation.reverse(coordinate);
    return {static_cast<int>(Q), permutation.P, permutation_of_states(rotor, states, rotor_speed < 0)};
}

namespace {

void require_cyclic(const Matrix& P, int parts) {
    if (is_identity(P)) return;
    Matrix all = P;
    for (int i = 1; i < parts; ++i) all = all * P;
    const double off = (all - Matrix::Identity(P.rows(), P.cols())).cwiseAbs().maxCoeff();
    if (!(off < 1e-9))
        throw InputError(in_blade_symmetry, text("difference of P^", parts, " and the unit matrix"), off, "below 1e-9");
}

// Coordinates in units of their diagonals, states in units of their scales.
double asymmetry_of_states(const Coefficients& now, const Coefficients& later, const BladeSymmetry& symmetry,
                           const Vector& size) {
    StateTerms own = now.states, next = later.states;
    renumber(symmetry.P, symmetry.P_beside, next);
    const Vector unit = size.cwiseSqrt().cwiseInverse();
    for (StateTerms* terms : {&own, &next}) rescale(*terms, unit, now.states.scales);
    const auto part = [](const Matrix& a, const Matrix& b) {
        const double largest = a.cwiseAbs().maxCoeff();
        return largest > 0 ? (b - a).cwiseAbs().maxCoeff() / largest : b.cwiseAbs().maxCoeff();
    };
    const double size_of_f_s = own.f_s.largest();
    own.f_s.add(next.f_s, -1);
    const double of_f_s = size_of_f_s > 0 ? own.f_s.largest() / size_of_f_s : own.f_s.largest();
    return std::max({part(own.Q_s, next.Q_s), part(own.f_q, next.f_q), part(own.f_qd, next.f_qd), of_f_s});
}

}  // namespace

double asymmetry(const PeriodicSystem& system, const BladeSymmetry& symmetry) {
    if (symmetry.parts < 2) return 0;
    const Index n = system.rows();
    if (symmetry.P.rows() != n || symmetry.P.cols() != n)
        throw InputError(in_blade_symmetry, "size of P", text(symmetry.P.rows(), " x ", symmetry.P.cols()),
                         text(n, " x ", n));
    const bool same_places = is_identity(symmetry.P);  // three and more blades in multi-blade rows
    require_cyclic(symmetry.P, symmetry.parts);
    const Index beside = system.states_beside();
    if (beside > 0) {
        require_size(in_blade_symmetry, "P of the states", symmetry.P_beside, beside, beside);
        require_cyclic(symmetry.P_beside, symmetry.parts);
    }
    const double part = system.period() / symmetry.parts, omega = system.frequency();
    double largest = 0;
    for (double fraction : {0.07, 0.38}) {
        const Coefficients now(system, fraction * part), later(system, (fraction + 1) * part);
        const Vector size = now.size(omega);
        for (std::size_t m = 0; m < now.matrices.size(); ++m) {
            const Matrix& own = later.matrices[m];
            const Matrix difference = (same_places ? own : renumbered(symmetry.P, own)) - now.matrices[m];
            const double factor = std::pow(omega, static_cast<double>(m));
            for (Index j = 0; j < n; ++j)
                for (Index i = 0; i < n; ++i)
                    largest = std::max(largest, factor * std::abs(difference(i, j)) / std::sqrt(size(i) * size(j)));
        }
        if (beside > 0) largest = std::max(largest, asymmetry_of_states(now, later, symmetry, size));
    }
    return largest;
}

}  // namespace cardan::solvers
