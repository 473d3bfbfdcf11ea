#include "solvers/mode_names/detail/state_names.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/mode_names/detail/mode_labels.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace cardan::solvers {

namespace {

const CampbellMode* mode_at(const std::vector<CampbellPoint>& points, const Branch& branch, std::size_t i) {
    return branch.mode[i] < 0 ? nullptr : &entry(points[i].modes, branch.mode[i]);
}

bool is_of_states(const std::vector<CampbellPoint>& points, const Branch& branch) {
    int own = 0, all = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (const CampbellMode* m = mode_at(points, branch, i)) {
            ++all;
            if (m->mode.is_state_motion()) ++own;
        }
    return 2 * own > all;
}

std::string family_of(const std::vector<CampbellPoint>& points, const std::vector<NamedState>& states,
                      const Branch& branch) {
    std::map<std::string, double> moves;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const CampbellMode* m = mode_at(points, branch, i);
        if (!m) continue;
        const auto size = [&](Eigen::Index k) { return std::norm(m->mode.states(k) / entry(states, k).scale); };
        double all = 0;
        for (Eigen::Index k = 0; k < m->mode.states.size(); ++k) all += size(k);
        for (Eigen::Index k = 0; k < m->mode.states.size() && all > 0; ++k)
            moves[entry(states, k).family] += size(k) / all;
    }
    return std::ranges::max_element(moves, {}, [](const auto& one) { return one.second; })->first;
}

}  // namespace

std::vector<Branch> take_branches_of_states(const std::vector<CampbellPoint>& points,
                                            const std::vector<NamedState>& states, std::vector<Branch>& branches) {
    std::vector<Branch> taken;
    std::map<std::string, int> count;
    for (Branch& branch : branches) {
        if (!is_of_states(points, branch)) continue;
        branch.of_states = true;
        branch.family = family_of(points, states, branch);
        branch.name = text(branch.family, " ", ++count[branch.family]);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool there = branch.mode[i] >= 0;
            branch.doubt.push_back(there ? doubt_of_mac(branch.mac[i]) : "");
            branch.doubtful.push_back(!branch.doubt.back().empty());
            branch.mostly.push_back(there ? branch.name : "");
        }
        taken.push_back(std::move(branch));
    }
    std::erase_if(branches, [](const Branch& branch) { return branch.mode.empty(); });
    return taken;
}

}  // namespace cardan::solvers
