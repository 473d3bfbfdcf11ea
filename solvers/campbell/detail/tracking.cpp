#include "solvers/campbell/detail/tracking.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/assignment.hpp"

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

}  // namespace

std::vector<const CampbellMode*> Tracker::last() const {
    std::vector<const CampbellMode*> modes;
    for (const CampbellMode& mode : last_) modes.push_back(&mode);
    return modes;
}

void Tracker::add(const SecondOrderSystem& system, const CampbellPoint& point) {
    const auto count = std::ssize(point.modes);
    Matrix mac = Matrix::Zero(std::ssize(tracks_), count);
    if (mac.size() > 0) {
        const Eigen::Index n = system.M.rows();
        ComplexMatrix X(n, mac.rows()), Y(n, count);
        ComplexVector lx(mac.rows()), ly(count);
        const auto set = [](const CampbellMode& from, ComplexMatrix& shapes, ComplexVector& eigenvalues,
                            Eigen::Index i) {
            shapes.col(i) = from.mode.shape;
            eigenvalues(i) = from.mode.eigenvalue;
        };
        for (Eigen::Index i = 0; i < mac.rows(); ++i) set(entry(last_, i), X, lx, i);
        for (Eigen::Index j = 0; j < count; ++j) set(entry(point.modes, j), Y, ly, j);
        // Modes have energy norm 2 (their own at their own speed), so |product|^2 / 4 is the MAC up to the change of M.
        const ComplexMatrix elastic = X.adjoint() * (system.K_elastic * Y), kinetic = X.adjoint() * (system.M * Y);
        for (Eigen::Index i = 0; i < mac.rows(); ++i)
            for (Eigen::Index j = 0; j < count; ++j)
                mac(i, j) = std::min(1.0, std::norm(elastic(i, j) + std::conj(lx(i)) * ly(j) * kinetic(i, j)) / 4);
    }
    add(mac, mac, point);
}

void Tracker::add(const Matrix& score, const Matrix& mac, const CampbellPoint& point) {
    for (const Matrix* m : {&score, &mac})
        if (m->rows() != std::ssize(tracks_) || m->cols() != std::ssize(point.modes))
            throw InputError("tracking", "size of a matrix of likenesses", text(m->rows(), " x ", m->cols()),
                             text(tracks_.size(), " x ", point.modes.size(), ", tracks by modes"));
    std::vector<int> mode_of_track(tracks_.size(), -1);
    std::vector<bool> taken(point.modes.size(), false);
    if (score.size() > 0) mode_of_track = assign(score);
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

}  // namespace cardan::solvers
