#include "solvers/tracking.hpp"

#include "solvers/assignment.hpp"

#include <algorithm>
#include <limits>

namespace cardan::solvers {

namespace {

constexpr double sure_mac = 0.6;       // below: the link is doubtful
constexpr double new_track_mac = 0.1;  // below: not the same mode at all

struct Label {
    int component;
    RotorPattern pattern;
    int harmonic = 1;
};

std::vector<Label> possible_labels(const Identification& identification, bool whirl) {
    std::vector<Label> labels;
    const auto& components = identification.components();
    const RotorPattern first = whirl ? RotorPattern::backward : RotorPattern::cosine,
                       second = whirl ? RotorPattern::forward : RotorPattern::sine;
    for (std::size_t i = 0; i < components.size(); ++i) {
        const int c = static_cast<int>(i);
        if (!components[i].of_blades) {
            labels.push_back({c, RotorPattern::none});
            continue;
        }
        labels.push_back({c, RotorPattern::collective});
        for (int n = 1; n <= identification.harmonics(); ++n) {
            labels.push_back({c, first, n});
            labels.push_back({c, second, n});
        }
        labels.push_back({c, RotorPattern::differential});
    }
    return labels;
}

// Elastic energy of a mode under a label. At standstill there is no whirl: backward and forward share evenly.
double energy(const CampbellMode& mode, const Label& label) {
    return mode.shares[static_cast<std::size_t>(label.component)].of(label.pattern, label.harmonic);
}

// Nothing whirls at standstill: a name there holds the energy of its pair.
double held_energy(const CampbellPoint& point, const CampbellMode& mode, const Label& label) {
    const bool whirls = label.pattern == RotorPattern::backward || label.pattern == RotorPattern::forward;
    if (!whirls || point.rotor_speed != 0) return energy(mode, label);
    return energy(mode, {label.component, RotorPattern::backward, label.harmonic}) +
           energy(mode, {label.component, RotorPattern::forward, label.harmonic});
}

// The label that holds most energy; `own` where none holds more.
Label strongest_label(const CampbellPoint& point, const CampbellMode& mode, const Label& own,
                      const std::vector<Label>& labels) {
    Label strongest = own;
    for (const Label& label : labels)
        if (held_energy(point, mode, label) > held_energy(point, mode, strongest)) strongest = label;
    return strongest;
}

}  // namespace

void Tracker::add(const SecondOrderSystem& system, const CampbellPoint& point) {
    const auto count = static_cast<Eigen::Index>(point.modes.size());
    std::vector<int> mode_of_track(tracks_.size(), -1);
    std::vector<bool> taken(point.modes.size(), false);
    Matrix mac = Matrix::Zero(static_cast<Eigen::Index>(tracks_.size()), count);
    if (mac.size() > 0) {
        const Eigen::Index n = system.M.rows();
        ComplexMatrix X(n, mac.rows()), Y(n, count);
        ComplexVector lx(mac.rows()), ly(count);
        for (Eigen::Index i = 0; i < mac.rows(); ++i)
            X.col(i) = last_[static_cast<std::size_t>(i)].shape, lx(i) = last_[static_cast<std::size_t>(i)].eigenvalue;
        for (Eigen::Index j = 0; j < count; ++j)
            Y.col(j) = point.modes[static_cast<std::size_t>(j)].mode.shape,
            ly(j) = point.modes[static_cast<std::size_t>(j)].mode.eigenvalue;
        // Modes have energy norm 2 (their own at their own speed), so |product|^2 / 4 is the MAC up to the change of M.
        const ComplexMatrix elastic = X.adjoint() * (system.K_elastic * Y), kinetic = X.adjoint() * (system.M * Y);
        for (Eigen::Index i = 0; i < mac.rows(); ++i)
            for (Eigen::Index j = 0; j < count; ++j)
                mac(i, j) = std::min(1.0, std::norm(elastic(i, j) + std::conj(lx(i)) * ly(j) * kinetic(i, j)) / 4);
        mode_of_track = assign(mac);
    }
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
        const int mode = mode_of_track[t];
        const double link = mode < 0 ? 0.0 : mac(static_cast<Eigen::Index>(t), mode);
        if (link < new_track_mac) {
            tracks_[t].mode.push_back(-1);
            tracks_[t].mac.push_back(0);
            continue;
        }
        tracks_[t].mode.push_back(mode);
        tracks_[t].mac.push_back(link);
        taken[static_cast<std::size_t>(mode)] = true;
        last_[t] = point.modes[static_cast<std::size_t>(mode)].mode;
    }
    for (std::size_t m = 0; m < point.modes.size(); ++m) {
        if (taken[m] || !point.modes[m].mode.oscillates()) continue;
        Track track{std::vector<int>(points_, -1), std::vector<double>(points_, 0.0)};
        track.mode.push_back(static_cast<int>(m));
        track.mac.push_back(1);
        tracks_.push_back(std::move(track));
        last_.push_back(point.modes[m].mode);
    }
    ++points_;
}

std::vector<Branch> Tracker::branches(const std::vector<CampbellPoint>& points, const Identification& identification,
                                      bool whirl) const {
    const std::vector<Label> labels = possible_labels(identification, whirl);
    Matrix score = Matrix::Zero(static_cast<Eigen::Index>(tracks_.size()), static_cast<Eigen::Index>(labels.size()));
    for (std::size_t t = 0; t < tracks_.size(); ++t)
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (tracks_[t].mode[i] < 0) continue;
            const CampbellMode& mode = points[i].modes[static_cast<std::size_t>(tracks_[t].mode[i])];
            for (std::size_t l = 0; l < labels.size(); ++l)
                score(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(l)) += energy(mode, labels[l]);
        }
    const std::vector<int> label_of = assign(score);
    std::vector<Branch> branches;
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
        if (label_of[t] < 0) continue;
        const Label label = labels[static_cast<std::size_t>(label_of[t])];
        Branch branch;
        branch.component = label.component;
        branch.pattern = label.pattern;
        branch.harmonic = label.harmonic;
        branch.name = identification.name(label.component, label.pattern, label.harmonic);
        branch.family = identification.components()[static_cast<std::size_t>(label.component)].family;
        branch.mode = tracks_[t].mode;
        branch.mac = tracks_[t].mac;
        for (std::size_t i = 0; i < points.size(); ++i) {
            branch.doubtful.push_back(false);
            branch.mostly.emplace_back();
            if (branch.mode[i] < 0) continue;
            const CampbellMode& mode = points[i].modes[static_cast<std::size_t>(branch.mode[i])];
            const Label strongest = strongest_label(points[i], mode, label, labels);
            branch.doubtful.back() = branch.mac[i] < sure_mac || held_energy(points[i], mode, label) <
                                                                     0.8 * held_energy(points[i], mode, strongest);
            branch.mostly.back() = identification.name(strongest.component, strongest.pattern, strongest.harmonic);
        }
        branches.push_back(std::move(branch));
    }
    const auto first_frequency = [&](const Branch& branch) {
        for (std::size_t i = 0; i < points.size(); ++i)
            if (branch.mode[i] >= 0) return points[i].modes[static_cast<std::size_t>(branch.mode[i])].mode.natural_hz();
        return std::numeric_limits<double>::infinity();
    };
    std::stable_sort(branches.begin(), branches.end(),
                     [&](const Branch& a, const Branch& b) { return first_frequency(a) < first_frequency(b); });
    return branches;
}

}  // namespace cardan::solvers
