#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/assignment.hpp"
#include "solvers/campbell/detail/state_names.hpp"
#include "solvers/campbell/detail/tracking.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>

namespace cardan::solvers {

namespace {

constexpr double sure_pattern = 0.4;  // of the energy in its component: below it the pattern is doubtful
constexpr double sure_blade = 0.8;    // of the energy of all blades in one of them: from there on it alone moves
constexpr double least_share = 0.05;  // of the energy on average: below it a branch is not named so

// What a branch may be named after: a component mode with a pattern, or a coordinate (several branches may be).
struct Label {
    int component = -1;
    RotorPattern pattern = RotorPattern::none;
    int harmonic = 1;
    int row = -1;
    double least = sure_blade;  // part of the blades' energy from which on one of them moves alone
};

// @param unequal_blades  their number, if one of them may move alone
std::vector<Label> component_labels(const EnergyShares& energy_shares, bool whirl, int unequal_blades) {
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

// Share of a mode under a label, 0 ... 1. At standstill there is no whirl: backward and forward get equal shares.
double part(const CampbellMode& mode, const Label& label) {
    if (mode.row >= 0 || label.row >= 0) return mode.row == label.row ? 1 : 0;
    const Share& share = entry(mode.shares, label.component);
    if (label.pattern == RotorPattern::single) return alone(mode, label.harmonic, label.least) * share.total();
    return share.of(label.pattern, label.harmonic);
}

// Nothing whirls at standstill: a name there holds the energy of its pair.
double held(const CampbellPoint& point, const CampbellMode& mode, const Label& label) {
    const bool whirls = label.pattern == RotorPattern::backward || label.pattern == RotorPattern::forward;
    if (!whirls || point.rotor_speed != 0) return part(mode, label);
    return part(mode, {label.component, RotorPattern::backward, label.harmonic}) +
           part(mode, {label.component, RotorPattern::forward, label.harmonic});
}

bool is_real(FloquetKind kind) {
    return kind == FloquetKind::aperiodic || kind == FloquetKind::synchronous || kind == FloquetKind::subharmonic;
}

// "yaw (rigid)", "teeter (locked at 1 per rev and growing)", "teeter"
std::string motion_name(const std::string& row, const std::string& kind, const std::string& number,
                        const std::string& tendency) {
    if (kind == "oscillation") return number.empty() ? row : text(row, " (", number, ")");
    return text(row, " (", number, number.empty() ? "" : " ", kind, tendency.empty() ? "" : " and ", tendency, ")");
}

bool heavily_damped(const CampbellMode& mode) {
    return mode.kind() == FloquetKind::oscillation && mode.mode.damping_ratio() >= heavy_damping;
}

class Naming {
public:
    Naming(const std::vector<CampbellPoint>& points, const EnergyShares& energy_shares,
           const std::vector<std::string>& rows, bool whirl, NeighbourNames* neighbour)
        : points_(points),
          energy_shares_(energy_shares),
          rows_(rows),
          neighbour_(neighbour),
          labels_(component_labels(energy_shares, whirl, unequal_blades(points))) {}

    std::vector<Branch> name(std::vector<Branch> branches) {
        for (const Branch& branch : branches)
            if (const int row = usual_row(branch); row >= 0) labels_.push_back({.row = row});
        if (labels_.empty()) {  // nothing is elastic
            for (Branch& branch : branches) set(branch, {.row = moving_row(branch)});
            name_motions(branches);
            return branches;
        }
        if (neighbour_) neighbour_->pair(branches);
        Matrix score = scores(branches);
        if (neighbour_) continue_names(branches, score);
        const std::vector<int> label_of = assign(score);
        std::vector<Eigen::Index> others;
        for (Eigen::Index b = 0; b < score.rows(); ++b) {
            Branch& branch = entry(branches, b);
            const int label = entry(label_of, b);
            if (label >= 0 && score(b, label) >= least_share * length(branch))
                set(branch, entry(labels_, label));
            else
                others.push_back(b);
        }
        for (const Eigen::Index b : others) {
            Eigen::Index most = 0;
            score.row(b).maxCoeff(&most);
            set(entry(branches, b), entry(labels_, most));
        }
        name_others(branches, others);
        name_motions(branches);
        if (neighbour_) doubt_by_neighbour(branches);
        return branches;
    }

private:
    const CampbellMode* mode(const Branch& branch, std::size_t point) const {
        const int index = branch.mode[point];
        return index < 0 ? nullptr : &entry(points_[point].modes, index);
    }
    // Number of points.
    static double length(const Branch& branch) {
        return static_cast<double>(
            std::count_if(branch.mode.begin(), branch.mode.end(), [](int mode) { return mode >= 0; }));
    }
    int moving_row(const Branch& branch) const;
    int usual_row(const Branch& branch) const;
    std::string usual_kind(const Branch& branch) const;
    Matrix scores(const std::vector<Branch>& branches) const;
    std::size_t own_label(const Branch& partner) const;
    void continue_names(const std::vector<Branch>& branches, Matrix& score) const;
    void doubt_by_neighbour(std::vector<Branch>& branches) const;
    bool continues(const Branch& branch, const Branch& partner) const;
    Label strongest(std::size_t point, const CampbellMode& mode, const Label& own) const;
    std::string label_name(const Label& label, const CampbellMode& mode) const;
    void set(Branch& branch, const Label& label) const;
    double own_pattern(const CampbellMode& mode, const Label& label) const;
    const char* tendency(const Branch& branch) const;
    static void name_others(std::vector<Branch>& branches, const std::vector<Eigen::Index>& others);
    void name_motions(std::vector<Branch>& branches) const;

    const std::vector<CampbellPoint>& points_;
    const EnergyShares& energy_shares_;
    const std::vector<std::string>& rows_;
    NeighbourNames* neighbour_;  // may be null
    std::vector<Label> labels_;
};

// Over its first shape.
int Naming::moving_row(const Branch& branch) const {
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (const CampbellMode* m = mode(branch, i)) {
            Eigen::Index most = 0;
            m->mode.shape.cwiseAbs().maxCoeff(&most);
            return static_cast<int>(most);
        }
    return 0;
}

// The one that most of its points are named after; -1: elastic energy.
int Naming::usual_row(const Branch& branch) const {
    std::map<int, int> count;
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (const CampbellMode* m = mode(branch, i)) ++count[m->row];
    int usual = -1;
    for (const auto& [row, times] : count)
        if (row >= 0 && (usual < 0 || times > count[usual])) usual = row;
    return usual;
}

std::string Naming::usual_kind(const Branch& branch) const {
    std::map<std::string, int> count;
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (const CampbellMode* m = mode(branch, i)) ++count[m->kind_name()];
    return std::max_element(count.begin(), count.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

Matrix Naming::scores(const std::vector<Branch>& branches) const {
    Matrix score = Matrix::Zero(std::ssize(branches), std::ssize(labels_));
    for (Eigen::Index b = 0; b < score.rows(); ++b)
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const CampbellMode* m = mode(entry(branches, b), i);
            if (!m) continue;
            for (Eigen::Index l = 0; l < score.cols(); ++l) score(b, l) += part(*m, entry(labels_, l));
        }
    return score;
}

// Label of a branch of the neighbour, whose components may be in another order; labels_.size(): none here.
std::size_t Naming::own_label(const Branch& partner) const {
    std::size_t l = 0;
    if (partner.component < 0) return labels_.size();
    const Component& wanted = neighbour_->component(partner);
    for (; l < labels_.size(); ++l) {
        const Label& label = labels_[l];
        if (label.row >= 0 || label.pattern != partner.pattern || label.harmonic != partner.harmonic) continue;
        const Component& own = entry(energy_shares_.components(), label.component);
        if (own.part == wanted.part && own.family == wanted.family && own.ordinal == wanted.ordinal) break;
    }
    return l;
}

// The name that a branch has in the neighbour outweighs all energies. One that is "(another)" there stays so here: no
// name but that, and that one only where it is left over.
void Naming::continue_names(const std::vector<Branch>& branches, Matrix& score) const {
    const double outweighs = 2 * (score.sum() + 1);
    for (std::size_t b = 0; b < branches.size(); ++b) {
        const Branch* partner = neighbour_->partner(b);
        if (!partner || usual_row(branches[b]) >= 0) continue;
        const std::size_t l = own_label(*partner);
        if (l == labels_.size()) continue;
        const Label& label = labels_[l];
        const auto row = static_cast<Eigen::Index>(b), column = static_cast<Eigen::Index>(l);
        const bool own_name = partner->name == energy_shares_.name(label.component, label.pattern, label.harmonic);
        score.row(row).setZero();
        score(row, column) = own_name ? outweighs : 1e-9;
    }
}

// Without a partner of the same name, or where the match with it is doubtful.
void Naming::doubt_by_neighbour(std::vector<Branch>& branches) const {
    for (std::size_t b = 0; b < branches.size(); ++b) {
        Branch& branch = branches[b];
        const Branch* partner = neighbour_->partner(b);
        const bool same = partner && (branch.row >= 0 ? partner->row == branch.row : continues(branch, *partner));
        for (std::size_t i = 0; i < branch.mode.size(); ++i)
            if (branch.mode[i] >= 0 && (!same || neighbour_->doubtful(b, i, branch.mode[i]))) branch.doubtful[i] = true;
    }
}

// By component and pattern.
bool Naming::continues(const Branch& branch, const Branch& partner) const {
    const std::size_t l = own_label(partner);
    if (l == labels_.size()) return false;
    const Label& label = labels_[l];
    return branch.component == label.component && branch.pattern == label.pattern && branch.harmonic == label.harmonic;
}

// The label with the largest share; `own` if none is larger.
Label Naming::strongest(std::size_t point, const CampbellMode& mode, const Label& own) const {
    Label best = own;
    for (const Label& label : labels_)
        if (held(points_[point], mode, label) > held(points_[point], mode, best)) best = label;
    return best;
}

std::string Naming::label_name(const Label& label, const CampbellMode& mode) const {
    if (label.row < 0) return energy_shares_.name(label.component, label.pattern, label.harmonic);
    return motion_name(entry(rows_, label.row), mode.kind_name(), "", "");
}

// The part of the energy of a label's component that has its pattern (at standstill: that of its pair). A motion
// localised in one blade of three has a third of each.
double Naming::own_pattern(const CampbellMode& mode, const Label& label) const {
    if (label.row >= 0 || label.pattern == RotorPattern::none) return 1;
    if (label.pattern == RotorPattern::single) return alone(mode, label.harmonic, sure_blade);
    const Share& share = entry(mode.shares, label.component);
    const double total = share.total();
    return total > 0 ? share.of(label.pattern, label.harmonic) / total : 1;
}

void Naming::set(Branch& branch, const Label& label) const {
    branch.component = label.component;
    branch.pattern = label.pattern;
    branch.harmonic = label.harmonic;
    branch.row = label.row;
    if (label.row < 0) {
        branch.name = energy_shares_.name(label.component, label.pattern, label.harmonic);
        branch.family = entry(energy_shares_.components(), label.component).family;
    } else {
        branch.family = entry(rows_, label.row);
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
        branch.doubtful.push_back(false);
        branch.mostly.emplace_back();
        const CampbellMode* m = mode(branch, i);
        if (!m) continue;
        const Label best = strongest(i, *m, label);
        branch.doubtful.back() = branch.mac[i] < min_reliable_mac || heavily_damped(*m) ||
                                 held(points_[i], *m, label) < 0.8 * held(points_[i], *m, best) ||
                                 ((points_[i].rotor_speed != 0 || label.pattern == RotorPattern::single) &&
                                  own_pattern(*m, label) < sure_pattern);
        branch.mostly.back() = label_name(best, *m);
    }
}

// By the mean over the points.
const char* Naming::tendency(const Branch& branch) const {
    double growth = 0;
    bool real = false;
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (const CampbellMode* m = mode(branch, i)) {
            growth += m->mode.eigenvalue.real();
            real = real || is_real(m->kind());
        }
    return !real ? "" : growth > 0 ? "growing" : "decaying";
}

// Branches of the same kind as one that has the name already: the two motions of a locked mode, parts of the machine
// that have no component modes. "1st tower fore-aft (another)", "blade flap (backward, another 2)"
void Naming::name_others(std::vector<Branch>& branches, const std::vector<Eigen::Index>& others) {
    std::map<std::string, int> count;
    for (const Eigen::Index b : others) {
        Branch& branch = entry(branches, b);
        std::string& name = branch.name;
        if (name.empty()) continue;  // a motion of a coordinate
        const int number = ++count[name];
        const std::string which = number == 1 ? "another" : text("another ", number);
        if (name.back() == ')')
            name.insert(name.size() - 1, ", " + which);
        else
            name += " (" + which + ")";
        // Named after what it holds most of, which another branch is.
        for (std::size_t i = 0; i < branch.doubtful.size(); ++i) branch.doubtful[i] = branch.mode[i] >= 0;
    }
}

// Names of those without elastic energy; of several alike the later ones are numbered.
void Naming::name_motions(std::vector<Branch>& branches) const {
    constexpr std::array numbers{"", "2nd", "3rd"};
    std::map<std::string, std::size_t> count;
    for (Branch& branch : branches) {
        if (branch.row < 0) continue;
        const std::string kind = usual_kind(branch);
        const char* how = kind == "rigid" || kind == "oscillation" ? "" : tendency(branch);
        const std::size_t before = count[motion_name(branch.family, kind, "", how)]++;
        const std::string number = before < numbers.size() ? numbers[before] : text(before + 1, "th");
        branch.name = motion_name(branch.family, kind, number, how);
    }
}

}  // namespace

std::vector<Branch> Tracker::branches(const std::vector<CampbellPoint>& points, const EnergyShares& energy_shares,
                                      const std::vector<std::string>& rows, const std::vector<NamedState>& states,
                                      bool whirl, NeighbourNames* neighbour) const {
    std::vector<Branch> tracked;
    for (const Track& track : tracks_) {
        Branch& branch = tracked.emplace_back();
        branch.mode = track.mode;
        branch.mac = track.mac;
    }
    std::vector<Branch> of_states = take_branches_of_states(points, states, tracked);
    std::vector<Branch> branches = Naming(points, energy_shares, rows, whirl, neighbour).name(std::move(tracked));
    std::ranges::move(of_states, std::back_inserter(branches));
    // By frequency but for rounding, what decays before what grows.
    const auto place = [&](const Branch& branch) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (branch.mode[i] < 0) continue;
            const Mode& mode = entry(points[i].modes, branch.mode[i]).mode;
            return std::pair(static_cast<float>(mode.natural_hz()), static_cast<float>(mode.eigenvalue.real()));
        }
        return std::pair(std::numeric_limits<float>::infinity(), 0.0F);
    };
    std::ranges::stable_sort(branches, {}, place);
    return branches;
}

}  // namespace cardan::solvers
