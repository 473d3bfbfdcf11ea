#include "solvers/linear/coleman.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/registers/vectorised.hpp"
#include "solvers/linear/coordinate_rows.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cardan::solvers {

namespace {

// Which multi-blade coordinate stands in the place of blade k (from 0).
MultiBladeRow row_kind(int k, int blades, int coordinate) {
    if (k == 0) return {MultiBlade::collective, 0, coordinate};
    if (blades % 2 == 0 && k == blades - 1) return {MultiBlade::differential, 0, coordinate};
    return {k % 2 == 1 ? MultiBlade::cosine : MultiBlade::sine, (k + 1) / 2, coordinate};
}

std::vector<MultiBladeRow> row_kinds(int blades) {
    std::vector<MultiBladeRow> kinds;
    kinds.reserve(static_cast<std::size_t>(blades));
    for (int k = 0; k < blades; ++k) kinds.push_back(row_kind(k, blades, 0));
    return kinds;
}

}  // namespace

Matrix multi_blade_block(std::span<const MultiBladeRow> slots, double psi) {
    const Eigen::Index blades = std::ssize(slots);
    const double B = static_cast<double>(blades), once = std::sqrt(1 / B), twice = std::sqrt(2 / B);
    Matrix block(blades, blades);
    for (Eigen::Index j = 0; j < blades; ++j) {
        const MultiBladeRow& z = entry(slots, j);
        for (Eigen::Index k = 0; k < blades; ++k) {
            const double angle = z.harmonic * (psi + 2 * pi * static_cast<double>(k) / B);
            if (z.kind == MultiBlade::cosine)
                block(k, j) = twice * std::cos(angle);
            else if (z.kind == MultiBlade::sine)
                block(k, j) = twice * std::sin(angle);
            else
                block(k, j) = z.kind == MultiBlade::differential && k % 2 ? -once : once;
        }
    }
    return block;
}

std::string multi_blade_name(const MultiBladeRow& row) {
    switch (row.kind) {
        case MultiBlade::none:
            return {};
        case MultiBlade::collective:
            return "collective";
        case MultiBlade::cosine:
            return text("cosine ", row.harmonic);
        case MultiBlade::sine:
            return text("sine ", row.harmonic);
        case MultiBlade::differential:
            return "differential";
    }
    return {};
}

std::string uneven_spacing(const RotorMap& rotor) {
    if (rotor.evenly_spaced) return {};
    const std::size_t missing = rotor.missing_blades.size(), places = rotor.blades.size() + missing;
    if (missing == 0) return "the blades are not evenly spaced";
    if (missing == 1) return text("blade ", rotor.missing_blades[0], " of ", places, " is missing");
    std::string numbers;
    for (std::size_t i = 0; i < missing; ++i)
        numbers += text(i == 0 ? "" : i + 1 == missing ? " and " : ", ", rotor.missing_blades[i]);
    return text("blades ", numbers, " of ", places, " are missing");
}

namespace {

// Of a blade by its place in the map, from 0.
int number_of_blade(const RotorMap& rotor, std::size_t k) {
    int number = static_cast<int>(k) + 1;
    for (const int missing : rotor.missing_blades)
        if (missing <= number) ++number;
    return number;
}

}  // namespace

std::string without_multi_blade_coordinates(const RotorMap& rotor, const std::vector<int>& coordinates) {
    if (rotor.blades.size() < 2) return {};
    if (!rotor.evenly_spaced && rotor.blades.size() > 2) return uneven_spacing(rotor);
    const std::vector<int>& first = rotor.blades[0];
    for (std::size_t k = 1; k < rotor.blades.size(); ++k) {
        const std::vector<int>& blade = rotor.blades[k];
        bool same = blade.size() == first.size();
        for (std::size_t i = 0; same && i < blade.size(); ++i)
            same = (row_of(coordinates, blade[i]) < 0) == (row_of(coordinates, first[i]) < 0);
        if (!same)
            return text("blade ", number_of_blade(rotor, k), " has other coordinates than blade ",
                        number_of_blade(rotor, 0));
    }
    return {};
}

bool ColemanTransform::exists(const RotorMap& rotor, const std::vector<int>& coordinates) {
    const std::size_t blades = rotor.blades.size();
    if (blades == 0) return !rotor.rotating_pairs.empty();
    return blades > 1 && blades <= max_blades && without_multi_blade_coordinates(rotor, coordinates).empty();
}

ColemanTransform::ColemanTransform(const RotorMap& rotor, const std::vector<int>& coordinates, const StateTable& states)
    : blades_(static_cast<int>(rotor.blades.size())) {
    coordinates_.kinds.resize(coordinates.size());
    if (blades_ == 1 || (blades_ == 0 && rotor.rotating_pairs.empty()))
        throw InputError(rotor.machine, "number of blades", blades_, "at least 2 for a multi-blade transformation");
    if (blades_ > max_blades) throw InputError(rotor.machine, "number of blades", blades_, text("<= ", max_blades));
    if (const std::string why = without_multi_blade_coordinates(rotor, coordinates); !why.empty())
        throw InputError(rotor.machine, "multi-blade coordinates", text("none (", why, ")"),
                         "blades at equal angles, all with the same free coordinates; Floquet theory needs neither");
    blade_block_ = multi_blade_block(row_kinds(blades_));
    for (std::size_t i = 0; blades_ > 0 && i < rotor.blades[0].size(); ++i) {
        std::vector<int> rows;
        for (const std::vector<int>& blade : rotor.blades) rows.push_back(row_of(coordinates, blade[i]));
        if (rows[0] < 0) continue;  // held on all blades
        add_blade_rows(coordinates_, std::move(rows), static_cast<int>(i));
    }
    add_states(rotor, states);
    // A vector fixed in space, seen from a part that turns by sense * psi about its x axis.
    for (const RotatingPair& pair : rotor.rotating_pairs) {
        const int y = row_of(coordinates, pair.y), z = row_of(coordinates, pair.z);
        if (y < 0 || z < 0) continue;
        if (pair.turns) coordinates_.pairs.push_back({y, z, pair.sense});
        if (blades_ > 0) continue;
        std::vector<MultiBladeRow>& kinds = coordinates_.kinds;
        entry(kinds, y).kind = pair.sense > 0 ? MultiBlade::cosine : MultiBlade::sine;
        entry(kinds, z).kind = pair.sense > 0 ? MultiBlade::sine : MultiBlade::cosine;
        for (const int row : {y, z}) entry(kinds, row).harmonic = 1;
    }
}

// One coordinate, or state, of every blade.
void ColemanTransform::add_blade_rows(Part& part, std::vector<int> rows, int in_blade) const {
    for (int k = 0; k < blades_; ++k) {
        const int row = entry(rows, k);
        const MultiBladeRow z = row_kind(k, blades_, in_blade);
        entry(part.kinds, row) = z;
        if (z.kind == MultiBlade::cosine)
            part.pairs.push_back({row, entry(rows, k + 1), static_cast<double>(z.harmonic)});
    }
    part.at.push_back(std::move(rows));
}

std::vector<std::vector<int>> states_of_blades(const RotorMap& rotor, const StateTable& states) {
    std::vector<std::vector<int>> of_blade(rotor.blades.size());
    for (int i = 0; i < states.size(); ++i)
        for (std::size_t k = 0; k < of_blade.size(); ++k)
            if (states[i].blade == number_of_blade(rotor, k)) of_blade[k].push_back(i);
    for (std::size_t k = 1; k < of_blade.size(); ++k)
        if (of_blade[k].size() != of_blade[0].size())
            throw InputError(rotor.machine, text("states of blade ", number_of_blade(rotor, k)), of_blade[k].size(),
                             text("as many as of blade ", number_of_blade(rotor, 0), ", ", of_blade[0].size()));
    std::vector<std::vector<int>> all(of_blade.empty() ? 0 : of_blade[0].size());
    for (std::size_t i = 0; i < all.size(); ++i)
        for (const std::vector<int>& own : of_blade) all[i].push_back(own[i]);
    return all;
}

void ColemanTransform::add_states(const RotorMap& rotor, const StateTable& states) {
    states_.kinds.resize(static_cast<std::size_t>(states.size()));
    int in_blade = 0;
    for (std::vector<int>& rows : states_of_blades(rotor, states)) add_blade_rows(states_, std::move(rows), in_blade++);
}

namespace {

using Index = Eigen::Index;
constexpr Index strip_width = 16;  // rows or columns that are transformed together

// x_j = sum_k x_k T_kj for every entry of a strip; T by columns.
CARDAN_VECTORISED void combine(const double* x, double* out, Index blades, const double* T) {
    for (Index j = 0; j < blades; ++j) {
        double* __restrict y = out + j * strip_width;
        for (Index c = 0; c < strip_width; ++c) y[c] = 0;
        for (Index k = 0; k < blades; ++k) {
            const double t = T[k + j * blades];
            const double* __restrict in = x + k * strip_width;
            for (Index c = 0; c < strip_width; ++c) y[c] += in[c] * t;
        }
    }
}

// The same for one entry of each blade, in place.
template <class Entry>
void combine_one(const Matrix& T, const Entry& of_blade) {
    std::array<double, ColemanTransform::max_blades> x{};
    for (Index k = 0; k < T.rows(); ++k) entry(x, k) = of_blade(k);
    for (Index j = 0; j < T.cols(); ++j) {
        double sum = 0;
        for (Index k = 0; k < T.rows(); ++k) sum += entry(x, k) * T(k, j);
        of_blade(j) = sum;
    }
}

// Cosine and sine of factor * psi; those of neighbouring pairs are mostly the same.
class Turn {
public:
    explicit Turn(double psi) : psi_(psi) {}
    void set(double factor) {
        if (factor == factor_) return;
        factor_ = factor;
        c = std::cos(factor * psi_);
        s = std::sin(factor * psi_);
    }
    void apply(double& a, double& b) const {
        const double before = a;
        a = c * before - s * b;
        b = s * before + c * b;
    }

private:
    double psi_, factor_ = 0, c = 1, s = 0;
};

}  // namespace

// A T: every row alike.
void ColemanTransform::transform_columns(const Part& part, double psi, Matrix& A) const {
    std::array<double, max_blades * strip_width> x{}, y{};
    for (const std::vector<int>& rows : part.at)
        for (Index i = 0; i < A.rows(); i += strip_width) {
            const Index count = std::min<Index>(strip_width, A.rows() - i);
            for (Index k = 0; k < blades_; ++k) std::copy_n(&A(i, entry(rows, k)), count, &entry(x, k * strip_width));
            combine(x.data(), y.data(), blades_, blade_block_.data());
            for (Index k = 0; k < blades_; ++k) std::copy_n(&entry(y, k * strip_width), count, &A(i, entry(rows, k)));
        }
    if (psi == 0) return;
    Turn turn(psi);
    for (const TurningPair& pair : part.pairs) {
        turn.set(pair.factor);
        for (Index i = 0; i < A.rows(); ++i) turn.apply(A(i, pair.a), A(i, pair.b));
    }
}

// T^T A: every column alike.
void ColemanTransform::transform_rows(const Part& part, double psi, Matrix& A) const {
    Turn turn(psi);
    for (Index column = 0; column < A.cols(); ++column) {
        double* const own = A.data() + column * A.rows();
        for (const std::vector<int>& rows : part.at)
            combine_one(blade_block_, [&](Index k) -> double& { return own[entry(rows, k)]; });
        if (psi == 0) continue;
        for (const TurningPair& pair : part.pairs) {
            turn.set(pair.factor);
            turn.apply(own[pair.a], own[pair.b]);
        }
    }
}

// T_s^T A T_s, where every group of A has all blades' states of a kind or none.
void ColemanTransform::transform_groups(double psi, GroupedMatrix& A) const {
    std::array<Index, max_blades> at{};
    for (const std::vector<int>& rows : states_.at) {
        Matrix& block = A.block(A.group_of(rows[0]));
        for (Index k = 0; k < blades_; ++k) entry(at, k) = A.place_in_group(entry(rows, k));
        for (Index i = 0; i < block.rows(); ++i)
            combine_one(blade_block_, [&](Index k) -> double& { return block(i, entry(at, k)); });
        for (Index j = 0; j < block.cols(); ++j)
            combine_one(blade_block_, [&](Index k) -> double& { return block(entry(at, k), j); });
    }
    if (psi == 0) return;
    Turn turn(psi);
    for (const TurningPair& pair : states_.pairs) {
        turn.set(pair.factor);
        Matrix& block = A.block(A.group_of(pair.a));
        const Index a = A.place_in_group(pair.a), b = A.place_in_group(pair.b);
        for (Index i = 0; i < block.rows(); ++i) turn.apply(block(i, a), block(i, b));
        for (Index j = 0; j < block.cols(); ++j) turn.apply(block(a, j), block(b, j));
    }
}

void ColemanTransform::congruence(double psi, Matrix& A) const {
    transform_columns(coordinates_, psi, A);
    transform_rows(coordinates_, psi, A);
}

Matrix ColemanTransform::matrix(double psi, int derivative) const {
    return matrix(coordinates_, psi, derivative);
}

Matrix ColemanTransform::state_matrix(double psi, int derivative) const {
    return matrix(states_, psi, derivative);
}

Matrix ColemanTransform::matrix(const Part& part, double psi, int derivative) const {
    if (derivative < 0) throw InputError("multi-blade transformation", "derivative", derivative, ">= 0");
    const auto n = std::ssize(part.kinds);
    Matrix T = Matrix::Identity(n, n);
    transform_columns(part, psi, T);
    for (int d = 0; d < derivative; ++d) {
        Matrix next = Matrix::Zero(n, n);
        for (const TurningPair& pair : part.pairs) {
            next.col(pair.a) = -pair.factor * T.col(pair.b);
            next.col(pair.b) = pair.factor * T.col(pair.a);
        }
        T = std::move(next);
    }
    return T;
}

void ColemanTransform::transform_in_place(SecondOrderSystem& system, double psi, double rotor_speed) const {
    const auto size = std::ssize(rows());
    for (const Matrix* A : {&system.M, &system.C, &system.K, &system.K_elastic})
        require_size("multi-blade transformation", "matrix of the system", *A, size, size);
    for (Matrix* A : {&system.M, &system.C, &system.K, &system.K_elastic}) congruence(psi, *A);
    for (const TurningPair& pair : turning_pairs()) {
        const double n = pair.factor * rotor_speed;
        auto &M = system.M, &C = system.C, &K = system.K;
        K.col(pair.a) -= n * C.col(pair.b) + (n * n) * M.col(pair.a);
        K.col(pair.b) += n * C.col(pair.a) - (n * n) * M.col(pair.b);
        C.col(pair.a) -= 2 * n * M.col(pair.b);
        C.col(pair.b) += 2 * n * M.col(pair.a);
    }
    if (system.states.size() == 0) return;
    require_count("multi-blade transformation", "states", static_cast<std::size_t>(system.states.size()),
                  state_rows().size());
    transform_states(system.states, psi, rotor_speed);
}

void ColemanTransform::transform_states(StateTerms& terms, double psi, double rotor_speed) const {
    transform_rows(coordinates_, psi, terms.Q_s);
    transform_columns(states_, psi, terms.Q_s);
    for (Matrix* A : {&terms.f_q, &terms.f_qd}) {
        transform_rows(states_, psi, *A);
        transform_columns(coordinates_, psi, *A);
    }
    terms.f_s.join(states_.at);
    transform_groups(psi, terms.f_s);
    for (const TurningPair& pair : turning_pairs()) {
        const double n = pair.factor * rotor_speed;
        terms.f_q.col(pair.a) -= n * terms.f_qd.col(pair.b);
        terms.f_q.col(pair.b) += n * terms.f_qd.col(pair.a);
    }
    for (const TurningPair& pair : states_.pairs) {
        const double n = pair.factor * rotor_speed;
        Matrix& block = terms.f_s.block(terms.f_s.group_of(pair.a));
        const Index a = terms.f_s.place_in_group(pair.a), b = terms.f_s.place_in_group(pair.b);
        block(a, b) -= n;
        block(b, a) += n;
    }
}

SecondOrderSystem ColemanTransform::transform(SecondOrderSystem system, double psi, double rotor_speed) const {
    transform_in_place(system, psi, rotor_speed);
    return system;
}

}  // namespace cardan::solvers
