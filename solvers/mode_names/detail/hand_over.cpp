#include "solvers/mode_names/detail/hand_over.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/algebra/assignment.hpp"

#include <algorithm>

namespace cardan::solvers {

bool HandOver::Wanted::fits(const Naming& naming) const {
    if (name.label == nullptr || naming.another) return false;
    return is_same(naming.label, *name.label) || (name.or_pair && is_pair(naming.label, *name.label));
}

std::vector<HandOver::Wanted> HandOver::wanted(const std::vector<Branch>& branches, std::size_t point) const {
    std::vector<Wanted> all;
    for (std::size_t b = 0; b < branches.size(); ++b)
        if (const int mode = branches[b].mode[point]; mode >= 0) all.push_back({b, mode, name_of_(point, mode)});
    return all;
}

// A name that a mode certainly has somewhere, and no branch.
void HandOver::add_missing(std::vector<Branch>& branches, std::vector<Naming>& namings) const {
    for (std::size_t i = 0; i < points_.size(); ++i) {
        for (const Wanted& one : wanted(branches, i)) {
            const auto has = [&](const Naming& naming) { return one.fits(naming); };
            if (one.name.label == nullptr || !one.name.certain || std::ranges::any_of(namings, has)) continue;
            Branch& branch = branches.emplace_back();
            branch.mode.assign(points_.size(), -1);
            branch.mac.assign(points_.size(), 0);
            namings.push_back({*one.name.label});
        }
    }
}

// True if a mode went over.
bool HandOver::exchange(std::vector<Branch>& branches, const std::vector<Naming>& namings, std::size_t point) const {
    const std::vector<Wanted> modes = wanted(branches, point);
    const auto is_there = [&](const Wanted& one) {
        return one.name.label == nullptr || one.fits(entry(namings, one.branch));
    };
    if (std::ranges::all_of(modes, is_there)) return false;
    // A name outweighs two places that are left; what has no place left takes the one that fits it best.
    constexpr double named = 4, place = 1, energy = 0.5;
    Matrix score = Matrix::Zero(std::ssize(modes), std::ssize(branches));
    for (Eigen::Index k = 0; k < score.rows(); ++k) {
        const Wanted& one = entry(modes, k);
        const CampbellMode& mode = entry(points_[point].modes, one.mode);
        for (Eigen::Index b = 0; b < score.cols(); ++b) {
            const Naming& naming = entry(namings, b);
            if (one.fits(naming)) score(k, b) += named;
            if (!naming.another) score(k, b) += energy * ModeLabels::part(mode, naming.label);
        }
        score(k, static_cast<Eigen::Index>(one.branch)) += place;
    }
    const std::vector<int> to = assign(score);
    for (const Wanted& one : modes) entry(branches, one.branch).mode[point] = -1;
    for (std::size_t k = 0; k < modes.size(); ++k) entry(branches, entry(to, k)).mode[point] = modes[k].mode;
    return true;
}

void HandOver::set_mac(Branch& branch) const {
    std::size_t before = points_.size();
    for (std::size_t i = 0; i < points_.size(); ++i) {
        if (branch.mode[i] < 0) {
            branch.mac[i] = 0;
            continue;
        }
        branch.mac[i] = before == points_.size() ? 1 : mac_(before, branch.mode[before], i, branch.mode[i]);
        before = i;
    }
}

void HandOver::run(std::vector<Branch>& branches, std::vector<Naming>& namings, bool more) const {
    if (more) add_missing(branches, namings);
    bool any = false;
    for (std::size_t i = 0; i < points_.size(); ++i) any = exchange(branches, namings, i) || any;
    if (!any) return;
    for (Branch& branch : branches) set_mac(branch);
}

}  // namespace cardan::solvers
