#include "solvers/campbell/detail/tracking.hpp"

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
    const auto count = static_cast<Eigen::Index>(point.modes.size());
    Matrix mac = Matrix::Zero(static_cast<Eigen::Index>(tracks_.size()), count);
    if (mac.size() > 0) {
        const Eigen::Index n = system.M.rows();
        ComplexMatrix X(n, mac.rows()), Y(n, count);
        ComplexVector lx(mac.rows()), ly(count);
        const auto set = [](const CampbellMode& from, ComplexMatrix& shapes, ComplexVector& eigenvalues,
                            Eigen::Index i) {
            shapes.col(i) = from.mode.shape;
            eigenvalues(i) = from.mode.eigenvalue;
        };
        for (Eigen::Index i = 0; i < mac.rows(); ++i) set(last_[static_cast<std::size_t>(i)], X, lx, i);
        for (Eigen::Index j = 0; j < count; ++j) set(point.modes[static_cast<std::size_t>(j)], Y, ly, j);
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
        if (m->rows() != static_cast<Eigen::Index>(tracks_.size()) ||
            m->cols() != static_cast<Eigen::Index>(point.modes.size()))
            throw InputError("tracking", "size of a matrix of likenesses", text(m->rows(), " x ", m->cols()),
                             text(tracks_.size(), " x ", point.modes.size(), ", tracks by modes"));
    std::vector<int> mode_of_track(tracks_.size(), -1);
    std::vector<bool> taken(point.modes.size(), false);
    if (score.size() > 0) mode_of_track = assign(score);
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
        const int mode = mode_of_track[t];
        const auto row = static_cast<Eigen::Index>(t);
        if (mode < 0 || score(row, mode) < least_score) {
            tracks_[t].mode.push_back(-1);
            tracks_[t].mac.push_back(0);
            continue;
        }
        tracks_[t].mode.push_back(mode);
        tracks_[t].mac.push_back(mac(row, mode));
        taken[static_cast<std::size_t>(mode)] = true;
        last_[t] = point.modes[static_cast<std::size_t>(mode)];
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
