// Natural frequencies and mode shapes of the rotating NREL 5 MW blade.
//
// Problem: the blade of NREL/TP-500-38060, clamped at the hub radius of 1.5 m to a rigid hub, spins about the axis
// perpendicular to the rotor plane; at every rotor speed it is brought to its steady state (stretched and straightened
// by the centrifugal force) and linearised, M x'' + G x' + K x = 0 in the rotating frame.
// Reference: converged frequencies of the same blade by a method that shares nothing with the joint chain, exact to
// 1e-4 Hz (docs/nrel5mw_blade.md). Goals on 1st flap, 1st edge and 2nd flap: 0.1 % with 16 equal elements, 0.5 % with 8
// refined ones.
#include "elements/cardan_beam/centrifugal_limit.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "mbs/base/version.hpp"
#include "programs/shared/program.hpp"
#include "programs/shared/words.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/campbell_data/csv.hpp"
#include "solvers/pictures/blade_shapes.hpp"
#include "turbines/reference_turbines/nrel5mw_blade.hpp"

#include <array>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>

using namespace cardan;

namespace {

const std::array<std::string, 6> names{"1st blade flap", "1st blade edge", "2nd blade flap",
                                       "2nd blade edge", "3rd blade flap", "1st blade torsion"};

struct Reference {
    double rpm;
    std::array<double, 6> hz;  ///< in the order of the names; 0: not known
};
constexpr double digit = 1e-4;  ///< to which the references are exact, Hz
constexpr std::array<Reference, 3> elastic{{{0, {0.6772, 1.0855, 1.9516, 3.9962, 4.5160, 5.4709}},
                                            {6, {0.6904, 1.0875, 1.9663, 4.0015, 4.5287, 5.4719}},
                                            {12.1, {0.7288, 1.0936, 2.0105, 4.0173, 4.5676, 5.4753}}}};
constexpr Reference inextensible{12.1, {0.7290, 1.0943, 0, 0, 0, 0}};
constexpr double mass = 17608.83, first_moment = 361352;  // kg, kg m: exact integrals of the table

struct Arguments {
    std::string rpm = "0,6,12.1", boundaries, partition = "segment", out = "nrel5mw_blade", data;
    int elements = 16;
    double delta = 0;
    bool refined = false, no_extension = false, no_mass_offset = false, convergence = false;
    turbines::Nrel5mwBladeOptions blade;
};

Partition partition_of(const Arguments& a) {
    if (a.partition == "static") return Partition::static_moment;
    if (a.partition == "gauss") return Partition::compliance_gauss;
    if (a.partition == "mean-difference") return Partition::mean_difference;
    return Partition::segment_masses;
}

std::vector<double> rotor_speeds(const std::string& given) {
    constexpr auto allowed = "numbers >= 0, increasing, separated by commas, rev/min";
    std::vector<double> speeds = program::numbers("--rpm", given, allowed);
    for (std::size_t i = 0; i < speeds.size(); ++i)
        if (speeds[i] < 0 || (i > 0 && speeds[i] <= speeds[i - 1])) throw InputError("--rpm", "value", given, allowed);
    for (double& speed : speeds) speed /= units::to_rpm;
    return speeds;
}

int parse(int argc, char** argv, Arguments& a) {
    program::CommandLine app(
        "Natural frequencies and mode shapes of the rotating NREL 5 MW blade, clamped at 1.5 m.\n"
        "Prints computed | reference | error, and writes PREFIX.csv (frequencies), PREFIX_modes.csv (shapes) and\n"
        "PREFIX_modes.svg (shapes at the last rotor speed).");
    app.footer(
        "Exit code: 0; 1 error; 2 wrong usage; 3 a goal that holds for this run (0.1 % with 16 equal elements, "
        "0.5 % refined) is missed; 130 interrupted.");
    const program::Option elements = app.add_option("--elements", a.elements, "beam elements");
    app.add_option("--rpm", a.rpm, "rotor speeds, rev/min, separated by commas");
    const program::Option boundaries = app.add_option(
        "--boundaries", a.boundaries, "element ends, m from the root, separated by commas, from 0 to 61.5");
    const program::Option refined =
        app.add_flag("--refined", a.refined, "8 elements that become shorter toward the tip").excludes(boundaries);
    const program::Option partition =
        app.add_option(
               "--partition", a.partition,
               "inertia of the elements: true segment masses; static moments (with the last metre as an element of "
               "its own, unless --boundaries are given); segment masses with hinges at the Gauss points of the "
               "compliance; mean differences")
            .one_of({"segment", "static", "gauss", "mean-difference"});
    const program::Option delta =
        app.add_option(
               "--delta", a.delta,
               "place of the hinges with segment masses (default: Gauss points) and static moments (1/6), 0 ... 0.5")
            .hide_default();
    app.add_option("--mass-factor", a.blade.mass_factor, "on mass and sectional inertia");
    app.add_option("--shear-ratio", a.blade.shear_ratio, "GA / EA (default: rigid in shear)").hide_default();
    app.add_flag("--no-mass-offset", a.no_mass_offset, "mass centres on the pitch axis");
    app.add_flag("--no-extension", a.no_extension, "condense the extension out of the elements");
    app.add_flag("--convergence", a.convergence,
                 "print errors with 2, 4, 8, 16, 32 elements for all partitions, and observed orders, instead");
    app.add_option("--data", a.data, "folder with nrel5mw_blade.csv (default: built in)");
    app.add_option("--out", a.out, "prefix of the files");
    if (const int code = app.parse(argc, argv); code >= 0) return code;
    if (a.refined && (elements.given() || a.partition == "static"))
        return app.refuse("--refined", "--elements and --partition static");
    for (const program::Option& other : {elements, boundaries, refined, partition})
        if (a.convergence && other.given()) return app.refuse("--convergence", other.name());
    if (elements.given() && boundaries.given()) return app.refuse("--elements", "--boundaries");
    if (a.delta != 0 && places_hinges(partition_of(a))) return app.refuse("--delta", "--partition " + a.partition);
    if (a.delta == 0 && delta.given()) throw InputError("--delta", "value", a.delta, "0 < delta < 0.5");
    a.blade.mass_offset = !a.no_mass_offset;
    return -1;
}

CardanBeamOptions beam_options(const Arguments& a, int elements, Partition partition) {
    CardanBeamOptions options =
        a.refined ? turbines::nrel5mw_blade_refined() : turbines::nrel5mw_blade_elements(elements, partition);
    options.partition = partition;
    if (!a.boundaries.empty())
        options.boundaries = program::numbers("--boundaries", a.boundaries, "numbers separated by commas");
    if (a.delta != 0) options.delta = a.delta;
    options.extension = !a.no_extension;
    return options;
}

CardanBeamOptions beam_options(const Arguments& a) {
    return beam_options(a, a.elements, partition_of(a));
}

solvers::Campbell diagram_of(const turbines::Turbine& blade, const std::vector<double>& speeds) {
    solvers::CampbellOptions options;
    options.cancelled = program::interrupted;
    options.max_frequency_hz = 15;
    return solvers::campbell(blade.system(), blade.rotor(), speeds, options);
}

// The reference of a mode; none where the blade is another one.
std::optional<double> reference(const Arguments& a, double rpm, std::size_t mode) {
    const turbines::Nrel5mwBladeOptions given;
    if (a.blade.mass_factor != given.mass_factor || a.blade.shear_ratio != given.shear_ratio || a.no_mass_offset ||
        !a.data.empty())
        return {};
    const auto look = [&](const Reference& r) -> std::optional<double> {
        if (std::abs(r.rpm - rpm) > 1e-9 || r.hz.at(mode) == 0) return {};
        return r.hz.at(mode);
    };
    if (a.no_extension) return look(inextensible);
    for (const Reference& r : elastic)
        if (const auto found = look(r)) return found;
    return {};
}

const solvers::Branch* find(const solvers::Campbell& diagram, const std::string& name, std::size_t point) {
    for (const solvers::Branch& b : diagram.branches)
        if (b.name == name && b.mode[point] >= 0) return &b;
    return nullptr;
}

// Elastic energy of a mode in bending out of the plane and in the plane, torsion and extension.
std::array<double, 4> energies(const solvers::Campbell& d, const solvers::CampbellMode& mode) {
    std::array<double, 4> energy{};
    for (Eigen::Index i = 0; i < std::ssize(d.rows); ++i) {
        constexpr std::array kinds{"bending y", "bending z", "torsion", "extension"};
        for (std::size_t k = 0; k < kinds.size(); ++k)
            if (entry(d.rows, i).find(kinds.at(k)) != std::string::npos) energy.at(k) += mode.row_shares(i);
    }
    return energy;
}

// Prints the table; the largest relative error of the first three modes, if they all have references.
std::optional<double> print(const Arguments& a, const solvers::Campbell& d) {
    std::cout << "natural frequency, Hz: computed | reference | error;  elastic energy in flap, edge, torsion, "
                 "extension, %\n";
    double largest = 0;
    bool complete = true;
    for (std::size_t i = 0; i < d.points.size(); ++i) {
        std::cout << "\n"
                  << std::setprecision(6) << std::defaultfloat << d.points[i].rotor_speed * units::to_rpm << " rpm\n";
        for (std::size_t k = 0; k < names.size(); ++k) {
            std::cout << "  " << std::left << std::setw(18) << names.at(k) << std::right << std::fixed;
            const solvers::Branch* branch = find(d, names.at(k), i);
            const auto exact = reference(a, d.points[i].rotor_speed * units::to_rpm, k);
            if (k < 3 && !(branch && exact)) complete = false;
            if (!branch) {
                std::cout << "not found\n";
                continue;
            }
            const double hz = d.natural_hz(*branch, i);
            std::cout << std::setprecision(5) << hz << (branch->doubtful[i] ? "? | " : "  | ");
            if (exact) {
                const double error = hz / *exact - 1;
                if (k < 3) largest = std::max(largest, std::abs(error));
                std::cout << std::setprecision(4) << *exact << " | " << std::showpos << std::setw(7)
                          << std::setprecision(3) << 100 * error << std::noshowpos << " %";
            } else {
                std::cout << "     - |         -";
            }
            for (double e : energies(d, entry(d.points[i].modes, branch->mode[i])))
                std::cout << std::setw(7) << std::setprecision(1) << 100 * e;
            std::cout << "\n";
        }
    }
    return complete ? std::optional(largest) : std::nullopt;
}

// Errors over the number of elements. The order between two rows is given where the finer error is at least three times
// the last digit of the reference.
int convergence(const Arguments& a, const turbines::Nrel5mwBlade& blade, const std::vector<double>& speeds) {
    constexpr std::array counts{2, 4, 8, 16, 32};
    for (const Partition partition : {Partition::segment_masses, Partition::static_moment, Partition::compliance_gauss,
                                      Partition::mean_difference}) {
        const bool last_metre = partition == Partition::static_moment;
        std::vector<solvers::Campbell> diagrams;
        for (int n : counts) {
            diagrams.push_back(diagram_of(turbines::isolated_blade(blade, beam_options(a, n, partition)), speeds));
            if (!diagrams.back().complete) return 130;
        }
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            std::cout << partition_name(partition) << ", equal elements" << (last_metre ? " and one of 1 m" : "")
                      << ", " << std::defaultfloat << std::setprecision(6) << speeds[i] * units::to_rpm
                      << " rpm: error, % (observed order)\n  elements" << std::fixed;
            for (const std::string& name : names) std::cout << std::setw(18) << name;
            std::cout << "\n";
            std::array<double, 6> last{};
            for (std::size_t row = 0; row < counts.size(); ++row) {
                std::cout << std::setw(10) << counts.at(row);
                for (std::size_t k = 0; k < names.size(); ++k) {
                    const solvers::Branch* branch = find(diagrams[row], names.at(k), i);
                    const auto exact = reference(a, speeds[i] * units::to_rpm, k);
                    const double error = branch && exact ? diagrams[row].natural_hz(*branch, i) - *exact : 0;
                    if (branch && exact)
                        std::cout << std::showpos << std::setw(11) << std::setprecision(3) << 100 * error / *exact
                                  << std::noshowpos;
                    else
                        std::cout << std::setw(11) << "-";
                    if (std::abs(error) >= 3 * digit && last.at(k) != 0)
                        std::cout << " (" << std::setw(4) << std::setprecision(1)
                                  << std::log2(std::abs(last.at(k) / error)) << ")";
                    else
                        std::cout << "       ";
                    last.at(k) = error;
                }
                std::cout << "\n";
            }
            std::cout << "\n";
        }
    }
    return 0;
}

void write_files(const solvers::Campbell& diagram, const std::string& out) {
    solvers::write_csv(diagram, out + ".csv");
    std::vector<solvers::BladeShapes> shapes;
    for (std::size_t i = 0; i < diagram.points.size(); ++i)
        shapes.push_back(solvers::blade_shapes(diagram, names, i, Vec3::UnitX()));
    solvers::write_csv(shapes, out + "_modes.csv");
    solvers::plot(shapes.back(), out + "_modes.svg");
    std::cout << "\nfiles: " << out << ".csv, _modes.csv, _modes.svg\n";
}

int run(const Arguments& a) {
    const std::vector<double> speeds = rotor_speeds(a.rpm);
    const turbines::Nrel5mwBlade blade = a.data.empty()
                                             ? turbines::nrel5mw_blade(a.blade)
                                             : turbines::nrel5mw_blade(std::filesystem::path(a.data), a.blade);
    if (a.convergence) return convergence(a, blade, speeds);

    const CardanBeamOptions options = beam_options(a);
    program::check_outputs(a.out, {".csv", "_modes.csv", "_modes.svg"});
    const turbines::Turbine isolated = turbines::isolated_blade(blade, options);
    for (const std::string& warning : isolated.layout().blades.front().warnings)
        std::cerr << "warning: " << warning << "\n";
    const double limit = centrifugal_limit(isolated.layout().blades.front(), blade.root_radius);
    if (speeds.back() > limit / 2)
        std::cerr << "warning: " << speeds.back() * units::to_rpm << " rpm is above half of the "
                  << limit * units::to_rpm
                  << " rpm at which this discretisation loses its stiffness to the centrifugal force; take more "
                     "elements or another partition\n";
    std::cout << isolated.rotor().machine << ": " << isolated.layout().blades.front().elements.size() << " elements, ";
    if (!places_hinges(options.partition)) std::cout << "delta " << options.hinge_delta() << ", ";
    std::cout << partition_name(options.partition) << ", extension " << (options.extension ? "free" : "condensed")
              << "\nends, m from the root:";
    for (const CardanBeam::Element& e : isolated.layout().blades.front().elements) std::cout << " " << e.start;
    std::cout << " " << blade.line.length << std::fixed << std::setprecision(2) << "\nmass " << blade.mass()
              << " kg (reference " << mass << "), first moment about the root " << std::setprecision(0)
              << blade.first_moment() << " kg m (" << first_moment << ")\n\n";
    const solvers::Campbell diagram = diagram_of(isolated, speeds);
    if (!diagram.complete) return 130;
    program::stop_at_once();
    const std::optional<double> error = print(a, diagram);
    write_files(diagram, a.out);
    if (!std::cout.flush()) throw FileError("standard output", "the table could not be written");

    const bool standard = options.partition == Partition::segment_masses && a.delta == 0 && !a.no_extension && error;
    const bool sixteen = options.boundaries.empty() && options.elements >= 16;
    if (!standard || !(sixteen || a.refined)) return 0;
    const double goal = a.refined ? 0.005 : 0.001;
    const bool reached = *error <= goal;
    std::cout << "goal: 1st flap, 1st edge and 2nd flap within " << std::defaultfloat << std::setprecision(2)
              << 100 * goal << " %: " << (reached ? "reached" : "MISSED") << " (" << 100 * *error << " %)\n";
    return reached ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
    return program::run_program("nrel5mw_blade_modes", argc, argv, parse, run);
}
