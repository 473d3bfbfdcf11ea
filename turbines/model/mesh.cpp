#include "turbines/model/mesh.hpp"

#include "elements/cardan_beam/centrifugal_limit.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "turbines/model/detail/assembler.hpp"
#include "turbines/model/detail/beam_options.hpp"
#include "turbines/model/detail/mesh_search.hpp"
#include "turbines/model/detail/parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <utility>

namespace cardan::turbines {

namespace {

using Frequencies = std::vector<double>;

// Motions that keep all loops closed; without loops any.
Matrix closed_motions(const System& system, const Kinematics& kin, const std::vector<int>& coordinates) {
    const auto n = system.model.size();
    Matrix G(system.loops.size(), n);
    system.loops.gradient<double>(kin, 0, Vector::Zero(n), G);
    return Eigen::FullPivLU<Matrix>(G(Eigen::all, coordinates)).kernel();
}

// Of the springs as they are undeformed, ascending, Hz: nothing else acts at rest without gravity, and M and K are
// symmetric. Of the spin too, unless it is held.
Frequencies frequencies_at_rest(const Assembler& part, bool spins) {
    const System system(part.tree, part.forces, part.loops);
    const auto n = system.model.size();
    const int spin = part.spin && !spins ? system.model.index(*part.spin) : -1;
    const std::vector<int> coordinates = system.model.coordinates().free_without(spin);
    if (coordinates.empty()) return {};
    const DynamicState still = at_rest(n);
    Workspace workspace(system.model);
    const Kinematics kin = kinematics(system.model, still.q, workspace);
    Matrix g(n, n);
    metric(kin, g);
    ForceDerivatives forces;
    system.forces.derivatives({still, kin}, forces);
    Matrix M = g(coordinates, coordinates), K = forces.elastic(coordinates, coordinates);
    if (!system.loops.empty()) {
        const Matrix motions = closed_motions(system, kin, coordinates);
        M = motions.transpose() * M * motions;
        K = motions.transpose() * K * motions;
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(K, M, Eigen::EigenvaluesOnly);
    Frequencies hz;
    for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i)
        hz.push_back(std::sqrt(std::max(solver.eigenvalues()(i), 0.0)) / (2 * pi));
    return hz;
}

struct Change {
    double change = 0, at_hz = 0;
    int modes = 0;
};

// Frequencies that are compared.
struct Band {
    double min_hz = 0, max_hz = 0;
};

// Below this fraction of the largest that counts, or of the usual one, a motion counts as one without stiffness, which
// rounding moves.
constexpr double at_least = 1e-3;

// From few to many elements.
Change largest_change(const Frequencies& few, const Frequencies& many, const Band& band) {
    Change largest;
    for (std::size_t k = 0; k < many.size() && many[k] <= band.max_hz; ++k) {
        if (many[k] < band.min_hz) continue;
        // A mode that few elements do not have at all.
        const double change = k < few.size() ? std::abs(few[k] / many[k] - 1) : 1.0;
        if (change >= largest.change) largest = {change, many[k], largest.modes};
        ++largest.modes;
    }
    return largest;
}

// Elements of a whole machine whose frequencies are computed: all eigenvalues of a full matrix of five or six times the
// size, in a minute.
constexpr int max_compared = 600;

constexpr std::array candidates{2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 20, 24, 32, 48};

// The frequencies of a part by its number of elements, each computed once.
template <class Compute>
class Known {
public:
    explicit Known(Compute compute) : compute_(std::move(compute)) {}
    const Frequencies& operator()(int elements) {
        const auto at = known_.find(elements);
        return at != known_.end() ? at->second : known_.emplace(elements, compute_(elements)).first->second;
    }

private:
    Compute compute_;
    std::map<int, Frequencies> known_;
};

// The fewest elements, not fewer than `from`, whose frequencies twice as many do not change.
template <class Compute>
int fewest(Compute frequencies, const MeshOptions& mesh, const Band& band, double tolerance, int from) {
    Known of(std::move(frequencies));
    for (int n : candidates)
        if (n >= from && n < mesh.max_elements && largest_change(of(n), of(2 * n), band).change <= tolerance) return n;
    return mesh.max_elements;
}

const PartDamping undamped;

MeshOptions checked(const TurbineDescription& d, const AssemblyOptions& options) {
    check_elements(options);
    MeshOptions mesh = options.mesh;
    require_positive("mesh", "tolerance", mesh.tolerance);
    require_not_negative("mesh", "largest frequency [Hz]", mesh.max_hz);
    require_not_negative("mesh", "rotor speed [rad/s]", mesh.rotor_speed);
    if (mesh.max_elements < 1) throw InputError("mesh", "maximum number of elements", mesh.max_elements, ">= 1");
    if (mesh.rotor_speed == 0) mesh.rotor_speed = d.rotor_speed;
    return mesh;
}

class Search {
public:
    Search(TurbineDescription description, const AssemblyOptions& options)
        : description_(std::move(description)), options_(options), mesh_(checked(description_, options)) {
        const double usual = usual_frequency(description_, options);
        if (mesh_.max_hz == 0) mesh_.max_hz = usual;
        band_ = {at_least * std::min(mesh_.max_hz, usual), mesh_.max_hz};
        description_.source.clear();
        description_.platform.reset();  // afloat and without gravity it would capsize
        options_.gravity.setZero();
    }

    Mesh machine() const {
        return enlarged(blades(), tower(true), [&](int blade, int tower) {
            const AssemblyOptions options = with(blade, tower);
            Assembler whole(description_, options, undamped);
            whole.whole_machine();
            return frequencies_at_rest(whole, true);
        });
    }
    Mesh one_blade(int number) const {
        const TurbineDescription alone = blade_alone(description_, number);
        return enlarged(blade(number), 1, [&](int elements, int) { return blade_hz(alone, number, elements); });
    }
    Mesh tower_alone(bool with_top) const {
        const RigidInertia head = top(with_top);
        return enlarged(1, tower(with_top), [&](int, int elements) { return tower_hz(elements, head); });
    }

private:
    // Half of what is allowed is left to the other part.
    double part_tolerance() const { return mesh_.tolerance / 2; }
    AssemblyOptions with(int blade_elements, int tower_elements) const {
        AssemblyOptions options = options_;
        options.blade_elements = blade_elements;
        options.tower_elements = tower_elements;
        return options;
    }

    // Those that share a description need the same number.
    int blades() const {
        int max = 1;
        bool shared = false;
        for (int k = 1; k <= description_.blades; ++k) {
            const bool own = description_.individual_blades.contains(k);
            if (description_.blade_at(k) == nullptr || (!own && shared)) continue;
            max = std::max(max, blade(k));
            shared |= !own;
        }
        return max;
    }
    int blade(int number) const {
        if (!seeks_blade_elements(description_, options_) || description_.blade_at(number)->rigid)
            return options_.blade_elements.value_or(1);
        const TurbineDescription alone = blade_alone(description_, number);
        int min = candidates.front();
        while (min < mesh_.max_elements && !endures_rotation(alone, number, min)) ++min;
        return fewest([&](int n) { return blade_hz(alone, number, n); }, mesh_, band_, part_tolerance(), min);
    }
    Frequencies blade_hz(const TurbineDescription& alone, int number, int elements) const {
        const AssemblyOptions options = with(elements, 1);
        Assembler blade(alone, options, undamped);
        blade.one_blade(number);
        return frequencies_at_rest(blade, false);
    }
    bool endures_rotation(const TurbineDescription& alone, int number, int elements) const {
        if (mesh_.rotor_speed == 0) return true;
        const AssemblyOptions options = with(elements, 1);
        Assembler blade(alone, options, undamped);
        blade.one_blade(number);
        return centrifugal_limit(blade.layout.blades.front(), alone.hub.radius) >= 2 * mesh_.rotor_speed;
    }

    RigidInertia top(bool with_top) const {
        return with_top ? tower_top_inertia(completed(description_), options_) : RigidInertia{};
    }
    int tower(bool with_top) const {
        if (!seeks_tower_elements(description_, options_)) return options_.tower_elements.value_or(1);
        const RigidInertia head = top(with_top);
        return fewest([&](int n) { return tower_hz(n, head); }, mesh_, band_, part_tolerance(), candidates.front());
    }
    Frequencies tower_hz(int elements, const RigidInertia& head) const {
        const AssemblyOptions options = with(1, elements);
        const TurbineDescription alone = turbines::tower_alone(description_);
        Assembler tower(alone, options, undamped);
        tower.tower_alone(head);
        return frequencies_at_rest(tower, false);
    }

    // Of all together: what moves little in each part may move more where parts meet.
    template <class Compute>
    Mesh enlarged(int blade_elements, int tower_elements, const Compute& frequencies) const {
        Mesh mesh;
        mesh.blade_elements = blade_elements;
        mesh.tower_elements = tower_elements;
        mesh.max_hz = mesh_.max_hz;
        if (2 * (description_.blades * blade_elements + tower_elements) > max_compared) return mesh;
        Frequencies few = frequencies(blade_elements, tower_elements);
        const auto change = [&](int blade_factor, int tower_factor) {
            return largest_change(
                few, frequencies(blade_factor * mesh.blade_elements, tower_factor * mesh.tower_elements), band_);
        };
        // More elements of what is sought do not make up for few of what was given.
        const int blade_factor = seeks_blade_elements(description_, options_) ? 2 : 1,
                  tower_factor = seeks_tower_elements(description_, options_) ? 2 : 1;
        Change found = change(blade_factor, tower_factor);
        while (found.change > mesh_.tolerance && enlarge(mesh)) {
            few = frequencies(mesh.blade_elements, mesh.tower_elements);
            found = change(blade_factor, tower_factor);
        }
        if (blade_factor * tower_factor < 4) found = change(2, 2);
        mesh.change = found.change;
        mesh.at_hz = found.at_hz;
        mesh.modes = found.modes;
        mesh.converged = found.change <= mesh_.tolerance;
        return mesh;
    }
    // Half as many elements more, where they are sought.
    bool enlarge(Mesh& mesh) const {
        const auto more = [&](int& elements, bool sought) {
            const int next = std::min(mesh_.max_elements, elements + std::max(1, elements / 2));
            if (!sought || elements == 1 || next <= elements) return false;
            elements = next;
            return true;
        };
        const bool blades = more(mesh.blade_elements, seeks_blade_elements(description_, options_)),
                   tower = more(mesh.tower_elements, seeks_tower_elements(description_, options_));
        return blades || tower;
    }

    TurbineDescription description_;
    AssemblyOptions options_;
    MeshOptions mesh_;
    Band band_;
};

bool bends(const BladeDescription& blade) {
    return !blade.rigid && blade.line.section && blade.line.length > 0;
}

constexpr int fine = 12;  // elements of a part whose frequencies are asked for

}  // namespace

std::string in_words(const Mesh& mesh) {
    std::ostringstream out = text_stream();
    out << "mesh: " << mesh.blade_elements << " elements per blade, " << mesh.tower_elements << " in the tower";
    if (mesh.max_hz == 0) return out.str() + ", as given";
    if (mesh.modes == 0 && !mesh.converged) return out.str() + ", too many to be compared with twice as many";
    out << "; with twice as many no frequency at rest up to " << mesh.max_hz << " Hz changes by more than "
        << std::fixed << std::setprecision(2) << 100 * mesh.change << " % (that at " << std::setprecision(3)
        << mesh.at_hz << " Hz, of " << mesh.modes << ")";
    return out.str();
}

AssemblyOptions with_elements(AssemblyOptions options, const Mesh& mesh) {
    options.blade_elements = mesh.blade_elements;
    options.tower_elements = mesh.tower_elements;
    return options;
}

Mesh converged_mesh(const TurbineDescription& description, const AssemblyOptions& options) {
    description.check();
    return Search(description, options).machine();
}

Mesh blade_mesh(const TurbineDescription& description, const AssemblyOptions& options, int number) {
    return Search(description, options).one_blade(number);
}

Mesh tower_mesh(const TurbineDescription& description, const AssemblyOptions& options, bool with_top) {
    return Search(description, options).tower_alone(with_top);
}

std::vector<double> clamped_blade_hz(const TurbineDescription& description, const AssemblyOptions& options,
                                     int number) {
    const TurbineDescription alone = blade_alone(description, number);
    alone.check();
    AssemblyOptions elements = options;
    elements.blade_elements = options.blade_elements.value_or(fine);
    Assembler blade(alone, elements, undamped);
    blade.one_blade(number);
    return frequencies_at_rest(blade, false);
}

std::vector<double> clamped_tower_hz(const TurbineDescription& description, const AssemblyOptions& options) {
    const TurbineDescription alone = tower_alone(description);
    alone.check();
    AssemblyOptions elements = options;
    elements.tower_elements = options.tower_elements.value_or(fine);
    Assembler tower(alone, elements, undamped);
    tower.tower_alone({});
    return frequencies_at_rest(tower, false);
}

double usual_frequency(const TurbineDescription& description, const AssemblyOptions& options) {
    const int first = description.first_blade();
    if (first > description.blades || !bends(*description.blade_at(first))) return 5;
    AssemblyOptions elements = options;
    elements.blade_elements = fine;
    const std::vector<double> hz = clamped_blade_hz(description, elements, first);
    if (hz.size() < 3) return 5;
    const double wanted = 1.3 * hz[2], unit = std::pow(10, std::floor(std::log10(wanted)) - 1);
    return unit * std::ceil(wanted / unit);
}

}  // namespace cardan::turbines
