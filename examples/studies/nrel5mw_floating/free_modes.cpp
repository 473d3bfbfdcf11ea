#include "examples/studies/nrel5mw_floating/studies.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/campbell_program.hpp"
#include "solvers/algebra/assignment.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/campbell_data/csv.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/mode_names/community_names.hpp"
#include "solvers/periodic/azimuth_average.hpp"
#include "solvers/pictures/campbell.hpp"

#include <algorithm>
#include <cstdio>

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

// The modes of `other` that are nearest to those of `diagram`, at every rotor speed anew: optimal assignment on the
// complex energy MAC over the coordinates that both have, in the energy product of the other machine at rest. The
// platform's own modes are left out.
// @param machine  whose diagram `other` is; the rows of its modes must be among those of `diagram`
// @return `other` with the branches of `diagram` in place of its own; doubtful where the MAC is below
// `solvers::min_reliable_mac` or a mode of either machine is nearer to another one
// @throws InputError for machines whose rows do not agree
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

// Under gravity the steady state is periodic: mean of the multi-blade system over the azimuth.
Campbell diagram(const turbines::Turbine& turbine, const std::vector<double>& speeds, double max_frequency,
                 const char* what) {
    solvers::CampbellOptions options;
    options.method = solvers::CampbellMethod::averaged;
    options.spin = solvers::RotorSpin::prescribed;
    options.floquet.harmonics = 4;
    options.max_frequency_hz = max_frequency;
    options.cancelled = program::interrupted;
    options.progress = [what](int done, int total) {
        program::progress(text("\r", what, ": rotor speed ", done, " of ", total, done == total ? "\n" : ""));
    };
    return solvers::campbell(turbine.system(), turbine.rotor(), speeds, options);
}

// Multiples of the rotor speed meet them within the first turns of a start-up, which says nothing.
Campbell without_platform_crossings(Campbell d) {
    std::erase_if(d.crossings, [&](const solvers::Crossing& crossing) {
        return entry(d.branches, crossing.branch).family.starts_with("platform");
    });
    return d;
}

void print_equilibrium(const turbines::Turbine& turbine, const Campbell& d) {
    std::printf("\nequilibrium under gravity, no wind (in rotation: at azimuth 0)\n%8s", "rpm");
    for (std::size_t i = 0; i < coordinate_names.size(); ++i)
        std::printf(" %13s", text(coordinate_names.at(i), ", ", unit_name(i)).c_str());
    std::printf("\n");
    for (const solvers::CampbellPoint& point : d.points) {
        std::printf("%8.2f", point.rotor_speed * units::to_rpm);
        for (std::size_t i = 0; i < coordinate_names.size(); ++i) {
            const int at = turbine.system().model.index(turbine.layout().platform->coordinates.at(i));
            std::printf(" %13.5f", point.at.q(at) / unit(i));
        }
        std::printf("\n");
    }
}

void print_platform_modes(const Campbell& d, const std::vector<std::string>& names) {
    std::printf("\nplatform modes: damped frequency, Hz (period, s; damping ratio, %%)\n%-18s", "");
    for (const auto& point : d.points) std::printf(" %25.2f rpm", point.rotor_speed * units::to_rpm);
    std::printf("\n");
    for (std::size_t b = 0; b < d.branches.size(); ++b) {
        if (!d.branches[b].family.starts_with("platform")) continue;
        std::printf("%-18s", names[b].c_str());
        for (std::size_t p = 0; p < d.points.size(); ++p) {
            const double hz = d.damped_hz(d.branches[b], p);
            std::printf("   %9.5f (%7.2f; %6.3f)%s", hz, 1 / hz, 100 * d.damping_ratio(d.branches[b], p),
                        d.branches[b].doubtful[p] ? "?" : " ");
        }
        std::printf("\n");
    }
    for (std::size_t b = 0; b < d.branches.size(); ++b)
        for (std::size_t p = 0; p < d.points.size(); ++p)
            if (d.branches[b].family.starts_with("platform") && d.branches[b].doubtful[p])
                std::printf("? %s at %.2f rpm: by its energy mostly %s\n", names[b].c_str(),
                            d.points[p].rotor_speed * units::to_rpm, d.branches[b].mostly[p].c_str());
}

// "0.7068? +0.8 %", the mark where the pair is doubtful.
std::string beside(double hz, const Campbell& other, std::size_t branch, std::size_t point) {
    const double theirs = other.natural_hz(other.branches[branch], point);
    if (!(theirs > 0)) return "        -            ";
    char out[60];
    std::snprintf(out, sizeof out, "%9.4f%s %+9.2f %%", theirs, other.branches[branch].doubtful[point] ? "?" : " ",
                  100 * (hz / theirs - 1));
    return out;
}

void print_comparison(const Campbell& free, const Campbell& held, const Campbell& land,
                      const std::vector<std::string>& names) {
    for (std::size_t p = 0; p < std::min({free.points.size(), held.points.size(), land.points.size()}); ++p) {
        std::printf(
            "\nnatural frequency, Hz, at %.2f rpm: free spar, spar held (same tower), land-based (its own tower); the "
            "modes of the others\nthat are nearest in shape (complex MAC)\n%-34s %9s  %9s %12s %9s %12s\n",
            free.points[p].rotor_speed * units::to_rpm, "", "free", "held", "difference", "on land", "difference");
        for (std::size_t b = 0; b < free.branches.size(); ++b) {
            const solvers::Branch& branch = free.branches[b];
            const double hz = free.natural_hz(branch, p);
            if (branch.family.starts_with("platform") || !(hz > 0)) continue;
            std::printf("%-34s %9.4f%s %s %s\n", names[b].c_str(), hz, branch.doubtful[p] ? "?" : " ",
                        beside(hz, held, b, p).c_str(), beside(hz, land, b, p).c_str());
        }
    }
    std::printf("\n? behind a frequency of the free machine: the name is doubtful; of another one: the pair is\n");
}

Campbell without_doubtful_pairs(Campbell pairs) {
    for (solvers::Branch& branch : pairs.branches)
        for (std::size_t p = 0; p < branch.mode.size(); ++p)
            if (branch.doubtful[p]) branch.mode[p] = -1;
    return pairs;
}

void draw(const Campbell& free, const Campbell& held, const ModesOptions& options, const std::string& prefix) {
    solvers::CampbellPlotOptions picture;
    picture.max_frequency_hz = options.max_frequency;
    for (const char* kind : {".svg", ".png"}) solvers::plot(free, prefix + kind, picture);
    if (free.points.size() < 2 || !free.complete) return;
    using program::panel;
    solvers::plot_panels(
        free, prefix + "_families.png",
        {panel({"platform surge", "platform sway", "platform heave", "platform roll", "platform pitch", "platform yaw"},
               "platform", 0, 0.2),
         panel({"tower fore-aft", "tower side-side"}, "tower, first modes", 1, 1),
         panel({"blade flap"}, "first flap", 1, 1.5), panel({"blade edge"}, "first edge", 1, 2.5)});
    if (held.complete && held.points.size() == free.points.size())
        solvers::plot_differences(free, without_doubtful_pairs(held), prefix + "_difference.png",
                                  "free spar less held spar");
}

}  // namespace

int free_modes(const MachineOptions& machine, const ModesOptions& options, const std::string& prefix) {
    const std::vector<double> speeds = program::rotor_speeds(options.rpm);
    const turbines::Turbine floating = on_spar(machine, CoordinateRole::free),
                            still = on_spar(machine, CoordinateRole::prescribed), ground = on_land(machine);
    if (options.summary) std::cout << floating.summary() << "\n";
    for (const std::string& warning : floating.warnings()) std::cerr << "warning: " << warning << "\n";
    program::check_outputs(prefix, {".h5", ".csv", ".svg", ".png", "_families.png", "_difference.png"});
    const Campbell free = diagram(floating, speeds, options.max_frequency, "free spar"),
                   held = diagram(still, speeds, options.max_frequency, "spar held"),
                   land = diagram(ground, speeds, options.max_frequency, "land-based");
    program::stop_at_once();
    if (free.points.empty()) return 130;
    const auto style = options.names == "community" ? solvers::NameStyle::community : solvers::NameStyle::descriptive;
    const Campbell named = solvers::renamed(free, style);
    std::vector<std::string> names;
    for (const solvers::Branch& branch : named.branches) names.push_back(branch.name);
    std::cout << solvers::table(without_platform_crossings(named)) << std::flush;
    print_equilibrium(floating, free);
    print_platform_modes(free, names);
    const Campbell held_pairs = paired(named, held, still), land_pairs = paired(named, land, ground);
    print_comparison(named, held_pairs, land_pairs, names);
    std::fflush(stdout);
    solvers::write_hdf5(named, prefix + ".h5");
    solvers::write_csv(named, prefix + ".csv");
    draw(named, held_pairs, options, prefix);
    if (options.shapes && free.complete) program::draw_modes(named, prefix + "_modes");
    const bool several = free.complete && free.points.size() > 1;
    std::cout << "\nfiles: " << prefix << ".h5, .csv, .svg, .png" << (several ? ", _families.png, _difference.png" : "")
              << (options.shapes ? text("; mode shapes in ", prefix, "_modes/") : "") << "\n";
    return free.complete && held.complete && land.complete ? 0 : 130;
}

}  // namespace cardan::floating
