#include "examples/studies/nrel5mw_campbell/comparison.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>

namespace cardan::nrel5mw_campbell {

const std::array<std::string, 11> compared_modes{
    "1st tower side-side",         "1st tower fore-aft",          "drive-train torsion",
    "1st blade flap (backward)",   "1st blade flap (collective)", "1st blade flap (forward)",
    "1st blade edge (backward)",   "1st blade edge (forward)",    "2nd blade flap (backward)",
    "2nd blade flap (collective)", "2nd blade flap (forward)"};

const std::array<OpenFast, 3> openfast{
    {{0,
      {0.3138, 0.3244, 0.6200, 0.6667, 0.6991, 0.6751, 1.0805, 1.0919, 1.9111, 2.0074, 1.9837},
      {0.3152, 0.3257, 0.6312, 0.6870, 0.7191, 0.6957, 1.0876, 1.0985, 1.9643, 2.0646, 2.0408}},
     {6,
      {0.3139, 0.3242, 0.6212, 0.5852, 0.7115, 0.7834, 0.9871, 1.1898, 1.8585, 2.0205, 2.0639},
      {0.3152, 0.3255, 0.6323, 0.6054, 0.7310, 0.8037, 0.9955, 1.1980, 1.9128, 2.0764, 2.1187}},
     {12.1,
      {0.3139, 0.3234, 0.6239, 0.5239, 0.7496, 0.9230, 0.8913, 1.2991, 1.8041, 2.0635, 2.1992},
      {0.3152, 0.3248, 0.6345, 0.5420, 0.7676, 0.9414, 0.8990, 1.3066, 1.8555, 2.1162, 2.2492}}}};

std::optional<std::size_t> point_at(const solvers::Campbell& diagram, double rpm) {
    for (std::size_t i = 0; i < diagram.points.size(); ++i)
        if (std::abs(diagram.points[i].rotor_speed * units::to_rpm - rpm) < 1e-6) return i;
    return {};
}

UnderGravity under_gravity(const turbines::Turbine& heavy, const solvers::Campbell& diagram, std::size_t point,
                           Limited limited, double azimuth) {
    solvers::AzimuthAverageOptions options;
    options.rotor_speed = diagram.points[point].rotor_speed;
    options.standstill = azimuth;
    const solvers::AzimuthAverage mean = solvers::azimuth_average(heavy.system(), heavy.rotor(), options);
    const std::vector<solvers::Mode> modes = limited_modes(heavy, mean, limited);
    UnderGravity result;
    result.point = point;
    result.remainder = mean.remainder;
    for (const solvers::Branch& branch : diagram.branches) {
        result.hz.push_back(std::numeric_limits<double>::quiet_NaN());
        result.mac.push_back(0);
        if (branch.mode[point] < 0) continue;
        const auto& light = entry(diagram.points[point].modes, branch.mode[point]).mode;
        const solvers::NearestMode nearest = solvers::nearest_mode(mean.system, modes, light);
        result.hz.back() = modes[nearest.index].natural_hz();
        result.mac.back() = nearest.mac;
    }
    return result;
}

namespace {

void print_difference(double computed, double reference) {
    std::cout << std::fixed << std::setprecision(4) << std::setw(11) << reference << std::showpos
              << std::setprecision(2) << std::setw(9) << 100 * (computed / reference - 1) << " %" << std::noshowpos;
}

void print_row(const solvers::Campbell& diagram, const OpenFast& reference, std::size_t mode, std::size_t point,
               const UnderGravity* gravity, solvers::NameStyle style) {
    const std::string& name = compared_modes.at(mode);
    const bool short_names = style == solvers::NameStyle::community;
    std::cout << "  " << std::left << std::setw(32) << (short_names ? solvers::community_name(name) : name)
              << std::right;
    const auto branch = std::find_if(diagram.branches.begin(), diagram.branches.end(),
                                     [&](const solvers::Branch& b) { return b.name == name; });
    if (branch == diagram.branches.end() || branch->mode[point] < 0) {
        std::cout << "not found (whirl has names in diagrams with rotation only)\n";
        return;
    }
    double hz = diagram.natural_hz(*branch, point);
    std::cout << std::fixed << std::setprecision(4) << std::setw(9) << hz << (branch->doubtful[point] ? "?" : " ");
    if (gravity) {
        const auto at = static_cast<std::size_t>(branch - diagram.branches.begin());
        hz = gravity->hz.at(at);
        std::cout << std::setw(10) << hz << (gravity->mac.at(at) < solvers::min_reliable_mac ? "?" : " ");
    }
    print_difference(hz, reference.elastodyn.at(mode));
    print_difference(hz, reference.beamdyn.at(mode));
    std::cout << "\n";
}

}  // namespace

void print_comparison(const solvers::Campbell& diagram, std::span<const UnderGravity> gravity, solvers::NameStyle style,
                      bool yaw_locked) {
    for (const OpenFast& reference : openfast) {
        const auto point = point_at(diagram, reference.rpm);
        if (!point) continue;
        const auto heavy =
            std::find_if(gravity.begin(), gravity.end(), [&](const UnderGravity& g) { return g.point == *point; });
        const UnderGravity* own = heavy == gravity.end() ? nullptr : &*heavy;
        std::cout << "\nbeside OpenFAST (which has gravity on and the yaw bearing locked"
                  << (yaw_locked ? "" : "; here it is on its spring, the same machine is --yaw locked") << "), "
                  << std::defaultfloat << std::setprecision(6) << reference.rpm << " rpm: natural frequency, Hz\n"
                  << "  mode                              computed" << (own ? "    gravity" : "")
                  << "   ElastoDyn difference    BeamDyn difference\n";
        for (std::size_t mode = 0; mode < compared_modes.size(); ++mode)
            print_row(diagram, reference, mode, *point, own, style);
        if (own)
            std::cout << "  remainder of the multi-blade matrices that the mean leaves out: " << std::scientific
                      << std::setprecision(1) << own->remainder << " (relative)\n";
    }
}

}  // namespace cardan::nrel5mw_campbell
