#include "solvers/stability/detail/search_notes.hpp"

#include "mbs/base/error.hpp"
#include "solvers/campbell/point.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

bool vibrates(const CampbellMode& mode) {
    return mode.kind() != FloquetKind::rigid && (mode.mode.oscillates() || mode.floquet);
}

double excess(const Mode& mode, double growth) {
    return mode.eigenvalue.real() - growth * std::abs(mode.eigenvalue);
}

void SearchNotes::add(const std::string& note) {
    if (words_.find(note) == std::string::npos) words_ += text(words_.empty() ? "" : "; ", note);
}

bool SearchNotes::grows(const CampbellMode* mode) const {
    return mode && vibrates(*mode) && excess(mode->mode, growth_) > 0;
}

// Growth of what is much stiffer than the rest is rounding.
void SearchNotes::see(double parameter, const CampbellPoint& point) {
    const double lowest = lowest_vibration(point.modes), reliable = max_reliable_ratio * lowest;
    const auto diverges = [&](const Mode& mode) {
        return !mode.oscillates() && mode.eigenvalue.real() > (std::isfinite(lowest) ? growth_ * lowest : 0);
    };
    if (parameters_.empty())
        diverges_ = std::ranges::any_of(point.modes,
                                        [&](const CampbellMode& m) {
                                            return m.kind() == FloquetKind::aperiodic && diverges(m.mode);
                                        }) ||
                    std::ranges::any_of(point.state_motions, diverges, &StateMotion::mode);
    for (const CampbellMode& mode : point.modes) {
        if (!vibrates(mode)) continue;
        const double hz = mode.mode.natural_hz();
        lowest_hz_ = std::min(lowest_hz_, hz);
        if (hz > largest_hz_ && grows(&mode) && std::abs(mode.mode.eigenvalue) < reliable)
            high_.emplace_back(parameters_.size(), mode.mode.eigenvalue);
    }
    parameters_.push_back(parameter);
}

void SearchNotes::tell_branch(const Campbell& diagram, const Branch& branch, std::size_t point) {
    const auto vibration = [&](std::size_t i) {
        const CampbellMode* mode = diagram.mode(branch, i);
        return mode && vibrates(*mode);
    };
    if (!grows(diagram.mode(branch, point))) return;
    if (point == 0)
        add(text(branch.name, " grows at ", at(parameters_[0]), " already"));
    else if (!vibration(point - 1))
        add(text(branch.name, " grows at ", at(parameters_[point]), ", where it is first found"));
    if (point + 1 < parameters_.size() && !vibration(point + 1))
        add(text(branch.name, ", which grows, is lost beyond ", at(parameters_[point])));
}

// Those that no branch has: a branch may rise beyond the largest frequency.
void SearchNotes::tell_high_modes(const Campbell& diagram) {
    std::erase_if(high_, [&](const auto& one) {
        return std::ranges::any_of(diagram.branches, [&](const Branch& branch) {
            const CampbellMode* mode = diagram.mode(branch, one.first);
            return mode && mode->mode.eigenvalue == one.second;
        });
    });
    if (!high_.empty())
        add(text("a motion of ", std::abs(high_[0].second) / (2 * pi), " Hz grows at ", at(parameters_[high_[0].first]),
                 ", beyond the largest frequency that is followed, ", largest_hz_, " Hz"));
    if (!diagram.branches.empty()) return;
    if (std::isfinite(lowest_hz_))
        add(text("no motion was followed for flutter: the lowest has ", lowest_hz_,
                 " Hz, and the largest frequency that is followed is ", largest_hz_, " Hz"));
    else
        add("nothing vibrates that could flutter");
}

void SearchNotes::tell_growth(const Campbell& diagram) {
    for (std::size_t i = 0; i < parameters_.size(); ++i)
        for (const Branch& branch : diagram.branches) tell_branch(diagram, branch, i);
    if (diverges_) add(text("the machine diverges at ", at(parameters_[0]), " already"));
    tell_high_modes(diagram);
}

}  // namespace cardan::solvers
