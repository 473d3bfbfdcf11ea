#include "solvers/mode_names/detail/mode_labels.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/text.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::solvers {

namespace {

constexpr double sure_pattern = 0.4;    // of the energy in its component: below it the pattern is doubtful
constexpr double sure_blade = 0.8;      // of the energy of all blades in one of them: from there on it alone moves
constexpr double sure_component = 0.5;  // of the elastic energy: below it the name is doubtful
// Of the energy under a name: from there on another one competes. Of whirl: 1/9 the one way or the other.
constexpr double rival_share = 0.8;
// Of the elastic energy under a name: three times as much as all the rest.
constexpr double certain_share = 0.75;

// @param unequal_blades  their number, if one of them may move alone
std::vector<Label> component_labels(const EnergyFractions& energy_shares, bool whirl, int unequal_blades) {
    std::vector<Label> labels;
    const auto& components = energy_shares.components();
    const RotorPattern first = whirl ? RotorPattern::backward : RotorPattern::cosine,
                       second = whirl ? RotorPattern::forward : RotorPattern::sine;
    for (std::size_t i = 0; i < components.size(); ++i) {
        const int c = static_cast<int>(i);
        if (components[i].whirls) {
            labels.push_back({c, first});
            labels.push_back({c, second});
            continue;
        }
        if (!components[i].of_blades) {
            labels.push_back({c, RotorPattern::none});
            continue;
        }
        // Without patterns the blades are all there is to name a mode after.
        const double least = energy_shares.without_patterns() ? 0 : sure_blade;
        for (int blade = 1; blade <= unequal_blades; ++blade)
            labels.push_back({c, RotorPattern::single, blade, -1, least});
        if (energy_shares.without_patterns()) {
            labels.push_back({c, RotorPattern::collective});
            continue;
        }
        if (energy_shares.two_blades()) {
            for (const RotorPattern pattern : {RotorPattern::symmetric, RotorPattern::antisymmetric})
                labels.push_back({c, pattern});
            continue;
        }
        labels.push_back({c, RotorPattern::collective});
        for (int n = 1; n <= energy_shares.harmonics(); ++n) {
            labels.push_back({c, first, n});
            labels.push_back({c, second, n});
        }
        labels.push_back({c, RotorPattern::differential});
    }
    return labels;
}

// Number of the blades if they differ.
int unequal_blades(const std::vector<CampbellPoint>& points) {
    Eigen::Index most = 0;
    for (const CampbellPoint& point : points)
        for (const CampbellMode& mode : point.modes) most = std::max(most, mode.blade_shares.size());
    return static_cast<int>(most);
}

// Part of the blades' energy that is in one of them, if it alone moves.
double alone(const CampbellMode& mode, int blade, double least) {
    const double own = blade <= mode.blade_shares.size() ? mode.blade_shares(blade - 1) : 0;
    return own >= least ? own : 0;
}

// The part of the energy of a label's component that has its pattern (at standstill: that of its pair). A motion
// localised in one blade of three has a third of each.
double own_pattern(const CampbellMode& mode, const Label& label) {
    if (label.row >= 0 || label.pattern == RotorPattern::none) return 1;
    if (label.pattern == RotorPattern::single) return alone(mode, label.harmonic, sure_blade);
    const EnergyFraction& share = entry(mode.shares, label.component);
    const double total = share.total();
    return total > 0 ? share.of(label.pattern, label.harmonic) / total : 1;
}

std::string per_cent(double share) {
    return text(std::lround(100 * share), " %");
}

}  // namespace

bool is_same(const Label& a, const Label& b) {
    return a.component == b.component && a.pattern == b.pattern && a.harmonic == b.harmonic && a.row == b.row;
}

bool is_pair(const Label& a, const Label& b) {
    const auto other = [](RotorPattern pattern) {
        switch (pattern) {
            case RotorPattern::backward:
                return RotorPattern::forward;
            case RotorPattern::forward:
                return RotorPattern::backward;
            case RotorPattern::cosine:
                return RotorPattern::sine;
            case RotorPattern::sine:
                return RotorPattern::cosine;
            default:
                return RotorPattern::none;
        }
    };
    return a.row < 0 && b.row < 0 && a.component == b.component && a.harmonic == b.harmonic &&
           a.pattern != RotorPattern::none && other(a.pattern) == b.pattern;
}

std::string doubt_of_mac(double mac) {
    if (!(mac < min_reliable_mac)) return {};
    std::ostringstream out = text_stream();
    out.precision(2);
    out << std::fixed << "hard to follow (MAC " << mac << ")";
    return out.str();
}

std::string motion_name(const std::string& row, const std::string& kind, const std::string& number,
                        const std::string& tendency) {
    if (kind == "oscillation") return number.empty() ? row : text(row, " (", number, ")");
    return text(row, " (", number, number.empty() ? "" : " ", kind, tendency.empty() ? "" : " and ", tendency, ")");
}

ModeLabels::ModeLabels(const std::vector<CampbellPoint>& points, const EnergyFractions& energy_shares,
                       const std::vector<std::string>& rows, bool whirl)
    : energy_shares_(energy_shares),
      rows_(rows),
      labels_(component_labels(energy_shares, whirl, unequal_blades(points))) {}

double ModeLabels::part(const CampbellMode& mode, const Label& label) {
    if (mode.row >= 0 || label.row >= 0) return mode.row == label.row ? 1 : 0;
    const EnergyFraction& share = entry(mode.shares, label.component);
    if (label.pattern == RotorPattern::single) return alone(mode, label.harmonic, label.least) * share.total();
    return share.of(label.pattern, label.harmonic);
}

double ModeLabels::held(double rotor_speed, const CampbellMode& mode, const Label& label) {
    const bool whirls = label.pattern == RotorPattern::backward || label.pattern == RotorPattern::forward;
    if (!whirls || rotor_speed != 0) return part(mode, label);
    return part(mode, {label.component, RotorPattern::backward, label.harmonic}) +
           part(mode, {label.component, RotorPattern::forward, label.harmonic});
}

Label ModeLabels::strongest(double rotor_speed, const CampbellMode& mode, const Label& own) const {
    Label best = own;
    for (const Label& label : labels_)
        if (held(rotor_speed, mode, label) > held(rotor_speed, mode, best)) best = label;
    return best;
}

const Label* ModeLabels::certain(double rotor_speed, const CampbellMode& mode) const {
    if (mode.row >= 0 || mode.mode.is_state_motion()) return nullptr;
    const auto found = std::ranges::find_if(
        labels_, [&](const Label& label) { return held(rotor_speed, mode, label) >= certain_share; });
    return found == labels_.end() ? nullptr : &*found;
}

std::string ModeLabels::doubt(double rotor_speed, const CampbellMode& mode, const Label& label) const {
    if (mode.row != label.row) {
        const Label best = mode.row >= 0 ? Label{.row = mode.row} : strongest(rotor_speed, mode, label);
        return is_same(best, label) ? std::string() : "mostly " + name(best, mode);
    }
    if (label.row >= 0) return {};
    const double own = held(rotor_speed, mode, label);
    const Label best = strongest(rotor_speed, mode, label);
    if (best.component != label.component && held(rotor_speed, mode, best) > own) return "mostly " + name(best);
    const double of_component = entry(mode.shares, label.component).total();
    if (of_component < sure_component) return per_cent(of_component) + " of the elastic energy";
    for (const EnergyFraction& other : mode.shares)
        if (other.component != label.component && other.total() >= rival_share * of_component)
            return text(per_cent(of_component), " of the elastic energy, another part ", per_cent(other.total()));
    const bool whirls = label.pattern == RotorPattern::backward || label.pattern == RotorPattern::forward;
    if (whirls && rotor_speed == 0 && own < certain_share) return "nothing whirls, and it mixes with other parts";
    for (const Label& other : labels_) {
        if (is_same(label, other)) continue;
        const bool pair = is_pair(label, other), resting = pair && rotor_speed == 0;
        const double there = held(rotor_speed, mode, other);
        if (there < (resting ? own / rival_share : rival_share * own)) continue;
        if (pair && whirls) return rival_share * there > own ? "whirls the other way" : "hardly whirls";
        return text("also ", name(other));
    }
    if ((rotor_speed != 0 || label.pattern == RotorPattern::single) && own_pattern(mode, label) < sure_pattern)
        return "other patterns of the blades as well";
    return {};
}

std::string ModeLabels::name(const Label& label, const CampbellMode& mode) const {
    return label.row < 0 ? name(label) : motion_name(entry(rows_, label.row), mode.kind_name(), "", "");
}

std::string ModeLabels::name(const Label& label) const {
    return energy_shares_.name(label.component, label.pattern, label.harmonic);
}

}  // namespace cardan::solvers
