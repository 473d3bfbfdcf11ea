#include "examples/studies/nrel5mw_floating/pairing.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/algebra/assignment.hpp"
#include "solvers/periodic/azimuth_average.hpp"

#include <algorithm>

namespace cardan::floating {

namespace {

using solvers::Campbell;
using solvers::Mode;

// Where the rows of the other machine stand in the diagram.
std::vector<Eigen::Index> shared_rows(const Campbell& diagram, const Campbell& other) {
    std::vector<Eigen::Index> rows;
    for (const std::string& name : other.rows) {
        const auto found = std::ranges::find(diagram.rows, name);
        if (found == diagram.rows.end())
            throw InputError("pairing of modes", "row of the modes", name, "one that both machines have");
        rows.push_back(found - diagram.rows.begin());
    }
    return rows;
}

struct Modes {
    std::vector<std::size_t> place;  ///< of the branch, or of the mode in its point
    std::vector<Mode> modes;
};

Modes of_branches(const Campbell& d, std::size_t point, const std::vector<Eigen::Index>& rows) {
    Modes list;
    for (std::size_t b = 0; b < d.branches.size(); ++b) {
        const solvers::CampbellMode* const mode = d.mode(d.branches[b], point);
        if (!mode || d.branches[b].family.starts_with("platform")) continue;
        list.place.push_back(b);
        list.modes.push_back({mode->mode.eigenvalue, mode->mode.shape(rows)});
    }
    return list;
}

Modes oscillations(const Campbell& d, std::size_t point) {
    Modes list;
    for (std::size_t m = 0; m < d.points[point].modes.size(); ++m) {
        if (!d.points[point].modes[m].mode.oscillates()) continue;
        list.place.push_back(m);
        list.modes.push_back(d.points[point].modes[m].mode);
    }
    return list;
}

Matrix likeness(const solvers::SecondOrderSystem& system, const std::vector<Mode>& a, const std::vector<Mode>& b) {
    const auto energy = [&](const Mode& mode) { return std::real(solvers::energy_product(system, mode, mode)); };
    Matrix mac(std::ssize(a), std::ssize(b));
    std::vector<double> energies;
    energies.reserve(b.size());
    for (const Mode& mode : b) energies.push_back(energy(mode));
    for (Eigen::Index i = 0; i < mac.rows(); ++i) {
        const Mode& mode = entry(a, i);
        const double own = energy(mode);
        for (Eigen::Index j = 0; j < mac.cols(); ++j)
            mac(i, j) = std::norm(solvers::energy_product(system, mode, entry(b, j))) / (own * entry(energies, j));
    }
    return mac;
}

}  // namespace

Campbell paired(const Campbell& diagram, const Campbell& other, const turbines::Turbine& machine) {
    const std::vector<Eigen::Index> rows = shared_rows(diagram, other);
    const solvers::SecondOrderSystem at_rest =
        solvers::azimuth_average(machine.system(), machine.rotor(), {.rotor_speed = 0}).system;
    Campbell result = other;
    result.branches = diagram.branches;
    const std::size_t points = std::min(diagram.points.size(), other.points.size());
    for (solvers::Branch& branch : result.branches) {
        branch.mode.assign(other.points.size(), -1);
        branch.mac.assign(other.points.size(), 0);
        branch.doubtful.assign(other.points.size(), false);
        branch.doubt.assign(other.points.size(), "");
        branch.mostly.assign(other.points.size(), "");
    }
    for (std::size_t p = 0; p < points; ++p) {
        const Modes mine = of_branches(diagram, p, rows), theirs = oscillations(other, p);
        const Matrix mac = likeness(at_rest, mine.modes, theirs.modes);
        const std::vector<int> partner = solvers::assign(mac);
        for (Eigen::Index i = 0; i < mac.rows(); ++i) {
            const int other_mode = entry(partner, i);
            if (other_mode < 0) continue;
            solvers::Branch& branch = result.branches[entry(mine.place, i)];
            const double found = mac(i, other_mode);
            branch.mode[p] = static_cast<int>(entry(theirs.place, other_mode));
            branch.mac[p] = found;
            branch.doubtful[p] =
                found < std::max({solvers::min_reliable_mac, mac.row(i).maxCoeff(), mac.col(other_mode).maxCoeff()});
            if (branch.doubtful[p]) branch.doubt[p] = "not surely the same mode";
        }
    }
    return result;
}

}  // namespace cardan::floating
