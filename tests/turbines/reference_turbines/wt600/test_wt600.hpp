/// @file
/// What the tests of the 600 kW machine share: its undamped model, its computed Campbell diagrams, shares and motions.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <algorithm>

namespace cardan::testing {

using units::rpm;

/// Modes by their names in the diagram.
inline constexpr const char* flap_collective = "1st blade flap (collective)";
inline constexpr const char* flap_backward = "1st blade flap (backward)";
inline constexpr const char* flap_forward = "1st blade flap (forward)";
inline constexpr const char* lag_collective = "1st blade edge (collective)";
inline constexpr const char* lag_backward = "1st blade edge (backward)";
inline constexpr const char* lag_forward = "1st blade edge (forward)";
inline constexpr const char* tower_longitudinal = "1st tower fore-aft";

/// The discretisation of the reference numbers; no damping anywhere.
inline turbines::AssemblyOptions undamped(int elements = 3) {
    turbines::AssemblyOptions options = turbines::wt600_paper_assembly(elements);
    options.structural_damping = options.joint_damping = false;
    return options;
}

/// Natural frequencies below 10 Hz at one rotor speed, rising.
inline std::vector<double> frequencies(const turbines::Turbine& turbine, double rotor_speed,
                                       const solvers::CampbellOptions& options = {}) {
    const double speed[] = {rotor_speed};
    const solvers::Campbell diagram = solvers::campbell(turbine.system(), turbine.rotor(), speed, options);
    std::vector<double> f;
    for (const solvers::CampbellMode& mode : diagram.points[0].modes) f.push_back(mode.mode.natural_hz());
    return f;
}

/// Diagram of the machine with the elements of the paper (three, damped, generator free) from 0 to 40 rpm in steps of
/// 1: the point number is the rotor speed in rpm. Computed once.
inline const solvers::Campbell& diagram(solvers::CampbellMethod method = solvers::CampbellMethod::coleman) {
    const auto compute = [](solvers::CampbellMethod m) {
        solvers::CampbellOptions options;
        options.method = m;
        const turbines::Turbine machine = turbines::wt600(turbines::wt600_paper_assembly());
        return solvers::campbell(machine.system(), machine.rotor(), solvers::rpm_range(0, 40, 1), options);
    };
    static const solvers::Campbell coleman = compute(solvers::CampbellMethod::coleman);
    static const solvers::Campbell frozen = compute(solvers::CampbellMethod::frozen_azimuth);
    return method == solvers::CampbellMethod::coleman ? coleman : frozen;
}

/// The isolated blade of the same discretisation over the same speeds, in its rotating frame.
inline const solvers::Campbell& blade_diagram() {
    static const solvers::Campbell blade = [] {
        const turbines::Turbine single =
            turbines::isolated_blade(turbines::wt600_description(), turbines::wt600_paper_assembly());
        return solvers::campbell(single.system(), single.rotor(), solvers::rpm_range(0, 40, 1));
    }();
    return blade;
}

inline const solvers::CampbellMode& mode_of(const solvers::Campbell& d, const char* branch, int point) {
    const auto at = static_cast<std::size_t>(point);
    return d.points[at].modes.at(static_cast<std::size_t>(d.branch(branch).mode[at]));
}

inline double hz(const solvers::Campbell& d, const char* branch, int point) {
    return d.natural_hz(d.branch(branch), static_cast<std::size_t>(point));
}

/// Part of the elastic energy of a mode in component number `ordinal` of a family, all rotor patterns.
inline const solvers::EnergyFraction& share(const solvers::Campbell& d, const solvers::CampbellMode& mode,
                                            const char* family, int ordinal = 1) {
    for (const solvers::EnergyFraction& s : mode.shares) {
        const solvers::Component& c = entry(d.components, s.component);
        if (c.family == family && c.ordinal == ordinal) return s;
    }
    throw Error(text("no component ", ordinal, " of family ", family));
}

/// Energy in the first (or only) component of a family, in the mode of a branch.
inline double part(const solvers::Campbell& d, const char* branch, int point, const char* family) {
    return share(d, mode_of(d, branch, point), family).total();
}

/// Strictly rising (or falling) from point to point, at all of them.
template <class F>
bool monotonic(F f, double sign, int first = 0, int last = 40) {
    for (int point = first; point < last; ++point)
        if (!(sign * (f(point + 1) - f(point)) > 0)) return false;
    return true;
}

/// Frequency of a branch by the number of the point.
inline auto branch_hz(const solvers::Campbell& d, const char* branch) {
    return [&d, branch](int point) { return hz(d, branch, point); };
}

/// Mean frequency of the modes between two frequencies, weighted by their energy in one rotor pattern of a component:
/// where two branches veer, the pattern goes over from one to the other, and this mean follows it.
inline double pattern_hz(const solvers::Campbell& d, int point, const char* family, int ordinal,
                         solvers::RotorPattern pattern, double low, double high) {
    double weight = 0, sum = 0;
    for (const solvers::CampbellMode& mode : entry(d.points, point).modes) {
        const double f = mode.mode.natural_hz(), e = share(d, mode, family, ordinal).of(pattern);
        if (f < low || f > high) continue;
        weight += e;
        sum += e * f;
    }
    return sum / weight;
}

/// Motion of a named frame in a mode, [rotation; displacement].
inline Vec6T<Complex> motion_of(const solvers::Campbell& d, const char* branch, int point, const std::string& frame) {
    const auto found = std::find(d.frames.begin(), d.frames.end(), frame);
    if (found == d.frames.end()) throw Error(text("no frame ", frame));
    return entry(d.motion(d.branch(branch), static_cast<std::size_t>(point)), found - d.frames.begin()).motion;
}

/// Displacement of the tip of a blade of three elements along the shaft (downwind), relative to the rigid hub.
inline Complex flap_of_tip(const solvers::Campbell& d, const char* branch, int point, int blade) {
    const std::string tip_name = text("blade ", blade, " node 3");
    const Vec6T<Complex> tip = motion_of(d, branch, point, tip_name), hub = motion_of(d, branch, point, "hub");
    const auto place = [&](const std::string& name) {
        return entry(d.frame_positions, std::find(d.frames.begin(), d.frames.end(), name) - d.frames.begin());
    };
    const Vec3T<Complex> arm = (place(tip_name) - place("hub")).cast<Complex>();
    const Vec3T<Complex> carried = hub.tail<3>() + cross<Complex>(hub.head<3>(), arm);
    const double tilt = 5 * units::degree;
    const Vec3T<Complex> shaft = Vec3(std::cos(tilt), 0, -std::sin(tilt)).cast<Complex>();
    return dot<Complex>(shaft, tip.tail<3>() - carried);
}

}  // namespace cardan::testing
