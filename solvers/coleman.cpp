#include "solvers/coleman.hpp"

#include "mbs/error.hpp"

#include <algorithm>

namespace cardan::solvers {

namespace {

int row_of(const std::vector<int>& coordinates, int coordinate) {
    const auto found = std::find(coordinates.begin(), coordinates.end(), coordinate);
    return found == coordinates.end() ? -1 : static_cast<int>(found - coordinates.begin());
}

// Which multi-blade coordinate stands in the place of blade k (from 0).
MultiBladeRow row_kind(int k, int blades, int coordinate) {
    if (k == 0) return {MultiBlade::collective, 0, coordinate};
    if (blades % 2 == 0 && k == blades - 1) return {MultiBlade::differential, 0, coordinate};
    return {k % 2 == 1 ? MultiBlade::cosine : MultiBlade::sine, (k + 1) / 2, coordinate};
}

// d-th derivative of cos (or sin) n psi with respect to psi.
double harmonic(bool cosine, int n, double psi, int d) {
    const double phase = n * psi + d * pi / 2;
    return std::pow(n, d) * (cosine ? std::cos(phase) : std::sin(phase));
}

}  // namespace

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

ColemanTransform::ColemanTransform(const RotorMap& rotor, const std::vector<int>& coordinates)
    : blades_(static_cast<int>(rotor.blades.size())), rows_(coordinates.size()) {
    if (blades_ < 3)
        throw InputError(rotor.machine, "number of blades", blades_,
                         "at least 3 for a multi-blade transformation (two blades need Floquet's theory)");
    for (const std::vector<int>& blade : rotor.blades)
        if (blade.size() != rotor.blades[0].size())
            throw InputError(rotor.machine, "coordinates of a blade", blade.size(),
                             text(rotor.blades[0].size(), ", as blade 1 has"));
    for (std::size_t i = 0; i < rotor.blades[0].size(); ++i) {
        std::vector<int> rows;
        for (const std::vector<int>& blade : rotor.blades) rows.push_back(row_of(coordinates, blade[i]));
        if (std::all_of(rows.begin(), rows.end(), [](int r) { return r < 0; })) continue;
        if (std::any_of(rows.begin(), rows.end(), [](int r) { return r < 0; }))
            throw InputError(rotor.machine, "blade coordinate number", i + 1, "free on all blades or on none of them");
        at_.push_back(rows);
        for (int k = 0; k < blades_; ++k)
            rows_[static_cast<std::size_t>(rows[static_cast<std::size_t>(k)])] =
                row_kind(k, blades_, static_cast<int>(i));
    }
    for (const RotatingPair& pair : rotor.rotating_pairs) {
        const std::array<int, 2> rows{row_of(coordinates, pair.y), row_of(coordinates, pair.z)};
        if (rows[0] < 0 || rows[1] < 0) continue;
        pairs_.push_back(rows);
        sense_.push_back(pair.sense);
    }
}

Matrix ColemanTransform::matrix(double psi, int derivative) const {
    const auto n = static_cast<Eigen::Index>(rows_.size());
    Matrix T = Matrix::Zero(n, n);
    if (derivative == 0) T.setIdentity();
    const double B = blades_, once = std::sqrt(1 / B), twice = std::sqrt(2 / B);
    for (const std::vector<int>& rows : at_)
        for (int k = 0; k < blades_; ++k) {
            const double psi_k = psi + 2 * pi * k / B;
            for (int j = 0; j < blades_; ++j) {
                const int row = rows[static_cast<std::size_t>(k)], column = rows[static_cast<std::size_t>(j)];
                const MultiBladeRow& z = rows_[static_cast<std::size_t>(column)];
                double value = 0;
                if (z.kind == MultiBlade::collective) value = derivative == 0 ? once : 0;
                if (z.kind == MultiBlade::differential) value = derivative == 0 ? (k % 2 ? -once : once) : 0;
                if (z.kind == MultiBlade::cosine || z.kind == MultiBlade::sine)
                    value = twice * harmonic(z.kind == MultiBlade::cosine, z.harmonic, psi_k, derivative);
                T(row, column) = value;
            }
        }
    // A vector fixed in space, seen from a part that turns by sense * psi about its x axis.
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
        const auto [y, z] = pairs_[i];
        const double turn = std::pow(sense_[i], derivative);
        const double c = turn * harmonic(true, 1, sense_[i] * psi, derivative);
        const double s = turn * harmonic(false, 1, sense_[i] * psi, derivative);
        T(y, y) = c, T(y, z) = s, T(z, y) = -s, T(z, z) = c;
    }
    return T;
}

SecondOrderSystem ColemanTransform::transform(const SecondOrderSystem& system, double psi, double rotor_speed) const {
    const Matrix T = matrix(psi), T1 = rotor_speed * matrix(psi, 1), T2 = rotor_speed * rotor_speed * matrix(psi, 2);
    SecondOrderSystem z = system;
    z.M = T.transpose() * system.M * T;
    z.C = T.transpose() * (system.C * T + 2 * system.M * T1);
    z.K = T.transpose() * (system.K * T + system.C * T1 + system.M * T2);
    z.K_elastic = T.transpose() * system.K_elastic * T;
    return z;
}

}  // namespace cardan::solvers
