#include "solvers/mode_names/detail/tracking.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/assignment.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace cardan::solvers {

namespace {

bool begins(const CampbellMode& mode) {
    if (mode.row >= 0) return true;
    switch (mode.kind()) {
        case FloquetKind::oscillation:
            return mode.mode.oscillates();
        case FloquetKind::rigid:
            return false;
        default:  // one of the two real motions of a locked vibration
            return mode.floquet.has_value();
    }
}

// Real and imaginary parts of shapes x and of lambda x, one above another: energy products in real arithmetic.
Matrix states(const std::vector<CampbellMode>& modes, Eigen::Index n) {
    Matrix X(4 * n, std::ssize(modes));
    for (Eigen::Index j = 0; j < X.cols(); ++j) {
        const Mode& mode = entry(modes, j).mode;
        const ComplexVector rate = mode.eigenvalue * mode.shape;
        X.col(j) << mode.shape.real(), mode.shape.imag(), rate.real(), rate.imag();
    }
    return X;
}

// Lower Cholesky factor of a few modes' energy products with each other; empty if they are nearly parallel.
ComplexMatrix factor_of(const SecondOrderSystem& system, std::span<const CampbellMode> modes) {
    constexpr double energy = 2, least = 1e-2 * energy;
    const auto size = std::ssize(modes);
    ComplexMatrix L = ComplexMatrix::Zero(size, size);
    for (Eigen::Index i = 0; i < size; ++i) {
        const EnergyProduct with_i(system, entry(modes, i).mode);
        for (Eigen::Index j = i; j < size; ++j) {
            const Complex left = with_i.with(entry(modes, j).mode) - L.row(i).head(i).dot(L.row(j).head(i));
            if (j == i && !(left.real() > least)) return {};
            L(j, i) = j == i ? Complex(std::sqrt(left.real())) : left / L(i, i);
        }
    }
    return L;
}

// Any mixture of modes with the same eigenvalue is a mode (collective and differential flap of four blades): a track
// goes on in each of them as far as it lies in their space.
// @param products  of tracks with modes
void take_spaces(const SecondOrderSystem& system, const std::vector<CampbellMode>& modes, const ComplexMatrix& products,
                 Matrix& mac) {
    constexpr double same = 1e-8, energy = 2;
    const auto count = std::ssize(modes);
    for (Eigen::Index from = 0, to = 0; from < count; from = to) {
        const Complex first = entry(modes, from).mode.eigenvalue;
        for (to = from + 1; to < count; ++to)
            if (std::abs(entry(modes, to).mode.eigenvalue - first) > same * std::abs(first)) break;
        const Eigen::Index size = to - from;
        if (size < 2) continue;
        const ComplexMatrix L =
            factor_of(system, std::span(modes).subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(size)));
        for (Eigen::Index t = 0; t < mac.rows() && L.size() > 0; ++t) {
            ComplexVector p = products.row(t).segment(from, size).adjoint();
            for (Eigen::Index j = 0; j < size; ++j) {
                for (Eigen::Index k = 0; k < j; ++k) p(j) -= L(j, k) * p(k);
                p(j) /= L(j, j);
            }
            mac.row(t).segment(from, size).setConstant(std::min(1.0, p.squaredNorm() / energy));
        }
    }
}

}  // namespace

std::vector<const CampbellMode*> Tracker::last() const {
    std::vector<const CampbellMode*> modes;
    for (const CampbellMode& mode : last_) modes.push_back(&mode);
    return modes;
}

Matrix Tracker::mac(const SecondOrderSystem& system, const CampbellPoint& point) const {
    const auto count = std::ssize(point.modes);
    Matrix likeness = Matrix::Zero(std::ssize(tracks_), count);
    if (likeness.size() == 0) return likeness;
    const Eigen::Index n = system.M.rows();
    const Matrix X = states(last_, n), Y = states(point.modes, n);
    Matrix Z(4 * n, count), turned(4 * n, count);  // K_e y, lambda_y M y; -i times as much
    for (Eigen::Index part = 0; part < 4; ++part)
        Z.middleRows(part * n, n).noalias() = (part < 2 ? system.K_elastic : system.M) * Y.middleRows(part * n, n);
    for (Eigen::Index part = 0; part < 4; part += 2) {
        turned.middleRows(part * n, n) = Z.middleRows((part + 1) * n, n);
        turned.middleRows((part + 1) * n, n) = -Z.middleRows(part * n, n);
    }
    // Modes have energy norm 2 (their own at their own speed), so |product|^2 / 4 is the MAC up to the change of M.
    ComplexMatrix products(likeness.rows(), count);
    products.real() = X.transpose() * Z;
    products.imag() = X.transpose() * turned;
    likeness = (products.cwiseAbs2() / 4).cwiseMin(1.0);
    take_spaces(system, point.modes, products, likeness);
    return likeness;
}

void Tracker::require_size(const Matrix& matrix, const CampbellPoint& point) const {
    if (matrix.rows() != std::ssize(tracks_) || matrix.cols() != std::ssize(point.modes))
        throw InputError("tracking", "size of a matrix of likenesses", text(matrix.rows(), " x ", matrix.cols()),
                         text(tracks_.size(), " x ", point.modes.size(), ", tracks by modes"));
}

bool Tracker::continues(const Matrix& score, const Matrix& mac, const CampbellPoint& point, double largest_hz) const {
    constexpr double competes = 0.8, heavily_damped = 0.5;
    for (const Matrix* m : {&score, &mac}) require_size(*m, point);
    if (score.rows() == 0) return true;
    const auto alone = [&](Eigen::Index t, Eigen::Index own) {
        const Complex before = entry(last_, t).mode.eigenvalue;
        const auto distance = [&](Eigen::Index m) { return std::abs(entry(point.modes, m).mode.eigenvalue - before); };
        for (Eigen::Index m = 0; m < mac.cols(); ++m)
            if (m != own && mac(t, m) >= competes * mac(t, own) && distance(m) < distance(own)) return false;
        return true;
    };
    const std::vector<int> mode_of_track = score.cols() > 0 ? assign(score) : std::vector<int>(tracks_.size(), -1);
    for (Eigen::Index t = 0; t < score.rows(); ++t) {
        const Mode& last = entry(last_, t).mode;
        const bool followed = entry(tracks_, t).mode.back() >= 0 && last.oscillates() && !last.is_state_motion();
        if (!followed || last.natural_hz() > largest_hz || last.damping_ratio() > heavily_damped) continue;
        const int mode = entry(mode_of_track, t);
        if (mode < 0 || mac(t, mode) < min_reliable_mac || !alone(t, mode)) return false;
    }
    return true;
}

void Tracker::add(const Matrix& score, const Matrix& mac, const CampbellPoint& point) {
    for (const Matrix* m : {&score, &mac}) require_size(*m, point);
    std::vector<int> mode_of_track(tracks_.size(), -1);
    std::vector<bool> taken(point.modes.size(), false);
    if (score.size() > 0) mode_of_track = assign(score);
    mac_.push_back(mac);
    for (Eigen::Index t = 0; t < std::ssize(tracks_); ++t) {
        Track& track = entry(tracks_, t);
        const int mode = entry(mode_of_track, t);
        if (mode < 0 || score(t, mode) < min_score) {
            track.mode.push_back(-1);
            track.mac.push_back(0);
            continue;
        }
        track.mode.push_back(mode);
        track.mac.push_back(mac(t, mode));
        entry(taken, mode) = true;
        entry(last_, t) = entry(point.modes, mode);
    }
    for (std::size_t m = 0; m < point.modes.size(); ++m) {
        if (taken[m] || !begins(point.modes[m])) continue;
        Track track{std::vector<int>(points_, -1), std::vector<double>(points_, 0.0)};
        track.mode.push_back(static_cast<int>(m));
        track.mac.push_back(1);
        tracks_.push_back(std::move(track));
        last_.push_back(point.modes[m]);
    }
    ++points_;
}

// Of a mode with one before; 0 if its track went on in between to another, with which the later one was compared.
double Tracker::mac_between(std::size_t before, int mode_before, std::size_t point, int mode) const {
    const auto own = std::ranges::find_if(tracks_, [&](const Track& t) { return t.mode[before] == mode_before; });
    if (own == tracks_.end()) return 0;
    for (std::size_t i = before + 1; i < point; ++i)
        if (own->mode[i] >= 0) return 0;
    return mac_[point](own - tracks_.begin(), mode);
}

}  // namespace cardan::solvers
