#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/assignment.hpp"
#include "solvers/mode_names/detail/hand_over.hpp"
#include "solvers/mode_names/detail/mode_labels.hpp"
#include "solvers/mode_names/detail/state_names.hpp"
#include "solvers/mode_names/detail/tracking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

namespace cardan::solvers {

namespace {

constexpr double least_share = 0.05;  // of the energy on average: below it a branch is not named so

bool is_real(FloquetKind kind) {
    return kind == FloquetKind::aperiodic || kind == FloquetKind::synchronous || kind == FloquetKind::subharmonic;
}

bool heavily_damped(const CampbellMode& mode) {
    return mode.kind() == FloquetKind::oscillation && mode.mode.damping_ratio() >= heavy_damping;
}

class BranchNames {
public:
    BranchNames(const std::vector<CampbellPoint>& points, const EnergyFractions& energy_shares,
                const std::vector<std::string>& rows, bool whirl, NeighbourNames* neighbour)
        : points_(points),
          energy_shares_(energy_shares),
          rows_(rows),
          neighbour_(neighbour),
          whirl_(whirl),
          labels_(points, energy_shares, rows, whirl) {}

    /// @param mac  null: modes stay on their curves, HandOver
    std::vector<Branch> name(std::vector<Branch> branches, const HandOver::Mac& mac) {
        for (const Branch& branch : branches)
            if (const int row = usual_row(branch); row >= 0) labels_.add_row(row);
        if (labels_.all().empty()) {  // nothing is elastic
            for (Branch& branch : branches) set(branch, {{.row = moving_row(branch)}});
            name_motions(branches);
            return branches;
        }
        if (neighbour_) neighbour_->pair(branches);
        for (const CampbellPoint& point : points_) names_.push_back(names_at(point));
        std::vector<Naming> namings = by_sums(branches);
        if (mac) hand_over(branches, namings, mac);
        for (std::size_t b = 0; b < branches.size(); ++b) set(branches[b], namings[b]);
        name_others(branches, namings);
        name_motions(branches);
        if (neighbour_) doubt_by_neighbour(branches);
        std::erase_if(branches, [](const Branch& branch) { return length(branch) == 0; });
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
    double share(std::size_t point, int mode, const Label& label) const;
    Matrix scores(const std::vector<Branch>& branches) const;
    std::vector<Naming> by_sums(const std::vector<Branch>& branches) const;
    std::vector<HandOver::Name> names_at(const CampbellPoint& point) const;
    std::vector<HandOver::Name> names_at_rest(const std::vector<CampbellMode>& modes) const;
    void order_pairs(const std::vector<CampbellMode>& modes, std::vector<HandOver::Name>& names) const;
    void hand_over(std::vector<Branch>& branches, std::vector<Naming>& namings, const HandOver::Mac& mac) const;
    const Label* own_label(const Branch& partner) const;
    void continue_names(const std::vector<Branch>& branches, Matrix& score) const;
    void doubt_by_neighbour(std::vector<Branch>& branches) const;
    bool continues(const Branch& branch, const Branch& partner) const;
    std::string doubt(const Branch& branch, std::size_t point, const Label& label) const;
    void set(Branch& branch, const Naming& naming) const;
    const char* tendency(const Branch& branch) const;
    static void name_others(std::vector<Branch>& branches, const std::vector<Naming>& namings);
    void name_motions(std::vector<Branch>& branches) const;

    const std::vector<CampbellPoint>& points_;
    const EnergyFractions& energy_shares_;
    const std::vector<std::string>& rows_;
    NeighbourNames* neighbour_;                       // may be null
    bool whirl_;                                      // at some speed
    std::vector<std::vector<HandOver::Name>> names_;  // by point and mode
    ModeLabels labels_;
};

// Over its first shape.
int BranchNames::moving_row(const Branch& branch) const {
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (const CampbellMode* m = mode(branch, i)) {
            Eigen::Index most = 0;
            m->mode.shape.cwiseAbs().maxCoeff(&most);
            return static_cast<int>(most);
        }
    return 0;
}

// The one that most of its points are named after; -1: elastic energy.
int BranchNames::usual_row(const Branch& branch) const {
    std::map<int, int> count;
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (const CampbellMode* m = mode(branch, i)) ++count[m->row];
    int usual = -1;
    for (const auto& [row, times] : count)
        if (row >= 0 && (usual < 0 || times > count[usual])) usual = row;
    return usual;
}

std::string BranchNames::usual_kind(const Branch& branch) const {
    std::map<std::string, int> count;
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (const CampbellMode* m = mode(branch, i)) ++count[m->kind_name()];
    return std::max_element(count.begin(), count.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

// Of a mode's energy under a label. At standstill, where nothing whirls, that of a pair is under the name that the mode
// has there: a curve begins as it goes on, also where the rotor hardly turns.
double BranchNames::share(std::size_t point, int mode, const Label& label) const {
    const CampbellMode& own = entry(points_[point].modes, mode);
    const HandOver::Name& name = entry(names_[point], mode);
    const bool named_at_rest = points_[point].rotor_speed == 0 && whirl_ && name.label != nullptr && !name.or_pair;
    if (named_at_rest && is_pair(*name.label, label)) return 0;
    return named_at_rest && is_same(*name.label, label) ? ModeLabels::held(0, own, label)
                                                        : ModeLabels::part(own, label);
}

Matrix BranchNames::scores(const std::vector<Branch>& branches) const {
    Matrix score = Matrix::Zero(std::ssize(branches), std::ssize(labels_.all()));
    for (Eigen::Index b = 0; b < score.rows(); ++b)
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const CampbellMode* m = mode(entry(branches, b), i);
            if (!m) continue;
            for (Eigen::Index l = 0; l < score.cols(); ++l)
                score(b, l) += share(i, entry(branches, b).mode[i], entry(labels_.all(), l));
        }
    return score;
}

std::vector<Naming> BranchNames::by_sums(const std::vector<Branch>& branches) const {
    Matrix score = scores(branches);
    if (neighbour_) continue_names(branches, score);
    const std::vector<int> label_of = assign(score);
    std::vector<Naming> namings;
    for (Eigen::Index b = 0; b < score.rows(); ++b) {
        const int label = entry(label_of, b);
        const bool own = label >= 0 && score(b, label) >= least_share * length(entry(branches, b));
        Eigen::Index most = label;
        if (!own) score.row(b).maxCoeff(&most);
        namings.push_back({entry(labels_.all(), most), !own});
    }
    return namings;
}

void BranchNames::hand_over(std::vector<Branch>& branches, std::vector<Naming>& namings,
                            const HandOver::Mac& mac) const {
    const auto by_energy = [&](std::size_t point, int index) { return entry(names_[point], index); };
    const auto by_neighbour = [this](std::size_t point, int index) -> HandOver::Name {
        const Branch* const there = neighbour_->certain(point, index);
        return {there ? own_label(*there) : nullptr};
    };
    if (neighbour_)
        HandOver(points_, by_neighbour, mac).run(branches, namings, false);
    else
        HandOver(points_, by_energy, mac).run(branches, namings, true);
}

// As far as a point goes.
std::vector<HandOver::Name> BranchNames::names_at(const CampbellPoint& point) const {
    if (point.rotor_speed == 0 && whirl_) return names_at_rest(point.modes);
    std::vector<HandOver::Name> names;
    names.reserve(point.modes.size());
    for (const CampbellMode& mode : point.modes) names.push_back({labels_.certain(point.rotor_speed, mode)});
    return names;
}

// At standstill every vibration is named after its own energies, whatever it is followed to: which curve of a pair it
// lies on depends on the next speed, and the names at rest are not to depend on the speeds that are asked for.
std::vector<HandOver::Name> BranchNames::names_at_rest(const std::vector<CampbellMode>& modes) const {
    const std::vector<Label>& labels = labels_.all();
    Matrix score = Matrix::Zero(std::ssize(modes), std::ssize(labels));
    for (Eigen::Index m = 0; m < score.rows(); ++m) {
        const CampbellMode& mode = entry(modes, m);
        if (mode.row >= 0 || mode.mode.is_state_motion()) continue;
        for (Eigen::Index l = 0; l < score.cols(); ++l) score(m, l) = ModeLabels::part(mode, entry(labels, l));
    }
    const std::vector<int> label_of = score.size() > 0 ? assign(score) : std::vector<int>(modes.size(), -1);
    std::vector<HandOver::Name> names;
    for (std::size_t m = 0; m < modes.size(); ++m) {
        const auto row = static_cast<Eigen::Index>(m);
        const bool own = label_of[m] >= 0 && score(row, label_of[m]) >= least_share;
        const Label* const label = own ? &entry(labels, label_of[m]) : nullptr;
        const Label* const sure = labels_.certain(0, modes[m]);
        names.push_back({label, false, own && sure != nullptr && (sure == label || is_pair(*sure, *label))});
    }
    order_pairs(modes, names);
    return names;
}

// As the rotor begins to turn the lower of a pair whirls backward, the higher forward.
void BranchNames::order_pairs(const std::vector<CampbellMode>& modes, std::vector<HandOver::Name>& names) const {
    constexpr double same = 1e-6;
    const auto hz = [&](std::size_t mode) { return modes[mode].mode.natural_hz(); };
    for (std::size_t a = 0; a < names.size(); ++a) {
        const Label* const backward = names[a].label;
        if (backward == nullptr || backward->pattern != RotorPattern::backward) continue;
        const auto other = std::ranges::find_if(
            names, [&](const HandOver::Name& name) { return name.label && is_pair(*name.label, *backward); });
        if (other == names.end()) continue;
        const auto b = static_cast<std::size_t>(other - names.begin());
        if (std::abs(hz(a) - hz(b)) <= same * hz(b))
            names[a].or_pair = names[b].or_pair = true;
        else if (hz(a) > hz(b))
            std::swap(names[a].label, names[b].label);
    }
}

// Label of a branch of the neighbour, whose components may be in another order; null: none here.
const Label* BranchNames::own_label(const Branch& partner) const {
    if (partner.component < 0) return nullptr;
    const Component& wanted = neighbour_->component(partner);
    for (const Label& label : labels_.all()) {
        if (label.row >= 0 || label.pattern != partner.pattern || label.harmonic != partner.harmonic) continue;
        const Component& own = entry(energy_shares_.components(), label.component);
        if (own.part == wanted.part && own.family == wanted.family && own.ordinal == wanted.ordinal) return &label;
    }
    return nullptr;
}

// The name that a branch has in the neighbour outweighs all energies. One that is "(another)" there stays so here: no
// name but that, and that one only where it is left over.
void BranchNames::continue_names(const std::vector<Branch>& branches, Matrix& score) const {
    const double outweighs = 2 * (score.sum() + 1);
    for (std::size_t b = 0; b < branches.size(); ++b) {
        const Branch* partner = neighbour_->partner(b);
        if (!partner || usual_row(branches[b]) >= 0) continue;
        const Label* const label = own_label(*partner);
        if (label == nullptr) continue;
        const auto row = static_cast<Eigen::Index>(b), column = static_cast<Eigen::Index>(label - labels_.all().data());
        score.row(row).setZero();
        score(row, column) = partner->name == labels_.name(*label) ? outweighs : 1e-9;
    }
}

// Without a partner of the same name, or where the match with it is doubtful.
void BranchNames::doubt_by_neighbour(std::vector<Branch>& branches) const {
    for (std::size_t b = 0; b < branches.size(); ++b) {
        Branch& branch = branches[b];
        const Branch* partner = neighbour_->partner(b);
        const bool same = partner && (branch.row >= 0 ? partner->component < 0 && partner->family == branch.family
                                                      : continues(branch, *partner));
        for (std::size_t i = 0; i < branch.mode.size(); ++i) {
            if (branch.mode[i] < 0 || branch.doubtful[i]) continue;
            if (!same)
                branch.doubt[i] = "not in the neighbour";
            else if (neighbour_->doubtful(b, i, branch.mode[i]))
                branch.doubt[i] = "not surely that of the neighbour";
            branch.doubtful[i] = !branch.doubt[i].empty();
        }
    }
}

// By component and pattern.
bool BranchNames::continues(const Branch& branch, const Branch& partner) const {
    const Label* const label = own_label(partner);
    return label != nullptr && is_same(*label, {branch.component, branch.pattern, branch.harmonic});
}

// Of the name, and whether this is the mode that it was before.
std::string BranchNames::doubt(const Branch& branch, std::size_t point, const Label& label) const {
    const CampbellMode& m = *mode(branch, point);
    if (std::string lost = doubt_of_mac(branch.mac[point]); !lost.empty()) return lost;
    std::string name = labels_.doubt(points_[point].rotor_speed, m, label);
    if (!name.empty() || !heavily_damped(m)) return name;
    return text("heavily damped (from ", 100 * heavy_damping, " % on): the frequency says little");
}

void BranchNames::set(Branch& branch, const Naming& naming) const {
    const Label& label = naming.label;
    branch.component = label.component;
    branch.pattern = label.pattern;
    branch.harmonic = label.harmonic;
    branch.row = label.row;
    if (label.row < 0) {
        branch.name = labels_.name(label);
        branch.family = entry(energy_shares_.components(), label.component).family;
    } else {
        branch.family = entry(rows_, label.row);
    }
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const CampbellMode* m = mode(branch, i);
        // What is named after what it holds most of, which another branch is, is in doubt.
        branch.doubt.push_back(m == nullptr                      ? ""
                               : naming.another && label.row < 0 ? "another mode has the name"
                                                                 : doubt(branch, i, label));
        branch.doubtful.push_back(!branch.doubt.back().empty());
        branch.mostly.push_back(m ? labels_.name(labels_.strongest(points_[i].rotor_speed, *m, label), *m) : "");
    }
}

// By the mean over the points.
const char* BranchNames::tendency(const Branch& branch) const {
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
void BranchNames::name_others(std::vector<Branch>& branches, const std::vector<Naming>& namings) {
    std::map<std::string, int> count;
    for (std::size_t b = 0; b < branches.size(); ++b) {
        std::string& name = branches[b].name;
        if (!namings[b].another || name.empty()) continue;  // or a motion of a coordinate
        const int number = ++count[name];
        const std::string which = number == 1 ? "another" : text("another ", number);
        if (name.back() == ')')
            name.insert(name.size() - 1, ", " + which);
        else
            name += " (" + which + ")";
    }
}

// Names of those without elastic energy; of several alike the later ones are numbered.
void BranchNames::name_motions(std::vector<Branch>& branches) const {
    constexpr std::array numbers{"", "2nd", "3rd"};
    std::map<std::string, std::size_t> count;
    for (Branch& branch : branches) {
        if (branch.row < 0 || length(branch) == 0) continue;
        const std::string kind = usual_kind(branch);
        const char* how = kind == "rigid" || kind == "oscillation" ? "" : tendency(branch);
        const std::size_t before = count[motion_name(branch.family, kind, "", how)]++;
        const std::string number = before < numbers.size() ? numbers[before] : text(before + 1, "th");
        branch.name = motion_name(branch.family, kind, number, how);
    }
}

}  // namespace

std::vector<Branch> Tracker::branches(const std::vector<CampbellPoint>& points, const EnergyFractions& energy_shares,
                                      const std::vector<std::string>& rows, const std::vector<NamedState>& states,
                                      bool whirl, BranchesOf of, NeighbourNames* neighbour) const {
    std::vector<Branch> tracked;
    for (const Track& track : tracks_) {
        Branch& branch = tracked.emplace_back();
        branch.mode = track.mode;
        branch.mac = track.mac;
    }
    std::vector<Branch> of_states = take_branches_of_states(points, states, tracked);
    HandOver::Mac mac;
    if (of == BranchesOf::names)
        mac = [this](std::size_t before, int mode_before, std::size_t point, int mode) {
            return mac_between(before, mode_before, point, mode);
        };
    std::vector<Branch> branches =
        BranchNames(points, energy_shares, rows, whirl, neighbour).name(std::move(tracked), mac);
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
