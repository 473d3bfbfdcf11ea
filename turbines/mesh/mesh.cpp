#include "turbines/mesh/mesh.hpp"

#include "elements/cardan_beam/centrifugal_limit.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear/loop_reduction.hpp"
#include "solvers/linear/modes.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace cardan::turbines {

namespace {

enum class Rotor { held, as_it_is };

// Of the springs as they are undeformed: without gravity nothing else acts at rest.
std::vector<double> frequencies_at_rest(const Turbine& turbine, double largest_hz, Rotor rotor) {
    const System& system = turbine.system();
    const int spin = turbine.rotor().spin;
    const Vector zero = Vector::Zero(system.model.size());
    const solvers::Linearisation lin = solvers::linearise(system, {zero, zero, zero, 0});
    std::vector<double> all;
    // A loop, such as the linkage of a blade's pitch, is closed there.
    const solvers::SecondOrderSystem unknowns =
        solvers::reduce_loops(lin, system.model.coordinates().free_without(rotor == Rotor::held ? spin : -1), spin)
            .system;
    // Some more than wanted: with more elements they may come below the limit.
    for (const solvers::Mode& mode : solvers::modes(unknowns, 1.3 * largest_hz * 2 * pi))
        if (mode.oscillates()) all.push_back(mode.natural_hz());
    std::sort(all.begin(), all.end());
    return all;
}

struct Change {
    double change = 0, at_hz = 0;
    int modes = 0;
};

// From few to many elements, of the frequencies up to the largest.
Change largest_change(const std::vector<double>& few, const std::vector<double>& many, double largest_hz) {
    Change largest;
    for (std::size_t k = 0; k < many.size() && many[k] <= largest_hz; ++k) {
        // A mode that few elements do not have at all.
        const double change = k < few.size() ? std::abs(few[k] / many[k] - 1) : 1.0;
        if (change >= largest.change) largest = {change, many[k], 0};
        largest.modes = static_cast<int>(k) + 1;
    }
    return largest;
}

constexpr std::array candidates{2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 16, 20, 24, 32, 48};

// The fewest elements, not fewer than `from`, whose frequencies twice as many do not change.
template <class Frequencies>
int fewest(const Frequencies& frequencies, const MeshOptions& mesh, double tolerance, int from) {
    std::map<int, std::vector<double>> known;
    const auto of = [&](int elements) -> const std::vector<double>& {
        const auto at = known.find(elements);
        return at != known.end() ? at->second : known.emplace(elements, frequencies(elements)).first->second;
    };
    for (int n : candidates)
        if (n >= from && n < mesh.most && largest_change(of(n), of(2 * n), mesh.largest_hz).change <= tolerance)
            return n;
    return mesh.most;
}

bool bends(const std::optional<CardanBeamOptions>& beam) {
    return !beam || !(beam->held_y && beam->held_z);
}

class Search {
public:
    Search(TurbineDescription description, const MeshedOptions& options, const MeshOptions& mesh)
        : description_(std::move(description)), options_(options), mesh_(mesh) {
        description_.platform.reset();  // afloat and without gravity it would capsize
    }

    Mesh find() {
        Mesh found;
        found.blade_elements = mesh_.blade_elements.value_or(blades());
        found.tower_elements = mesh_.tower_elements.value_or(tower());
        // Of all together: what moves little in each part may move more where parts meet.
        for (;;) {
            check(found);
            if (found.converged || !enlarge(found)) return found;
        }
    }

private:
    // Half of what is allowed is left to the other part.
    double part_tolerance() const { return mesh_.tolerance / 2; }

    bool has_blade(int number) const {
        return description_.blade_at(number) != nullptr && (number == 1 || description_.own_blades.contains(number));
    }
    int blades() const {
        int most = 1;
        for (int k = 1; k <= description_.blades; ++k)
            if (has_blade(k)) most = std::max(most, blade(k));
        return most;
    }
    int blade(int number) const {
        if (!bends(options_(1, 1).blade_beam)) return 1;
        const auto turbine = [&](int n) { return isolated_blade(description_, options_(n, 1), number); };
        int least = candidates.front();
        while (least < mesh_.most && !endures_rotation(turbine(least))) ++least;
        return fewest([&](int n) { return frequencies_at_rest(turbine(n), mesh_.largest_hz, Rotor::held); }, mesh_,
                      part_tolerance(), least);
    }
    bool endures_rotation(const Turbine& turbine) const {
        const MachineLayout& layout = turbine.layout();
        return centrifugal_limit(layout.blades.front(), description_.hub.radius) >= 2 * mesh_.rotor_speed;
    }
    int tower() const {
        if (description_.tower.rigid || !bends(options_(1, 1).tower_beam)) return 1;
        return fewest(
            [&](int n) {
                return frequencies_at_rest(isolated_tower(description_, options_(1, n), true), mesh_.largest_hz,
                                           Rotor::held);
            },
            mesh_, part_tolerance(), candidates.front());
    }

    void check(Mesh& mesh) const {
        const auto at = [&](int times) {
            return frequencies_at_rest(
                assemble(description_, options_(times * mesh.blade_elements, times * mesh.tower_elements)),
                mesh_.largest_hz, Rotor::as_it_is);
        };
        const Change change = largest_change(at(1), at(2), mesh_.largest_hz);
        mesh.change = change.change;
        mesh.at_hz = change.at_hz;
        mesh.modes = change.modes;
        mesh.converged = change.change <= mesh_.tolerance;
    }
    // Half as many elements more, where they are not given.
    bool enlarge(Mesh& mesh) const {
        const auto more = [&](int& elements, const std::optional<int>& given, bool elastic) {
            const int next = std::min(mesh_.most, elements + std::max(1, elements / 2));
            if (given || !elastic || next == elements) return false;
            elements = next;
            return true;
        };
        const bool blades = more(mesh.blade_elements, mesh_.blade_elements,
                                 description_.blades > 0 && bends(options_(1, 1).blade_beam));
        const bool tower = more(mesh.tower_elements, mesh_.tower_elements,
                                !description_.tower.rigid && bends(options_(1, 1).tower_beam));
        return blades || tower;
    }

    TurbineDescription description_;
    const MeshedOptions& options_;
    const MeshOptions& mesh_;
};

}  // namespace

Mesh converged_mesh(const TurbineDescription& description, const MeshedOptions& options, const MeshOptions& mesh) {
    if (!(mesh.tolerance > 0)) throw InputError("mesh", "tolerance", mesh.tolerance, "> 0");
    if (!(mesh.largest_hz > 0)) throw InputError("mesh", "largest frequency [Hz]", mesh.largest_hz, "> 0");
    if (mesh.most < 1) throw InputError("mesh", "most elements", mesh.most, ">= 1");
    return Search(description, options, mesh).find();
}

std::vector<double> clamped_blade_hz(const TurbineDescription& description, const AssemblyOptions& options,
                                     double largest_hz, int number) {
    return frequencies_at_rest(isolated_blade(description, options, number), largest_hz, Rotor::held);
}

}  // namespace cardan::turbines
