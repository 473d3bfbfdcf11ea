#include "solvers/campbell/detail/sweep.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/detail/blade_frame.hpp"
#include "solvers/campbell/detail/recorded_motions.hpp"
#include "solvers/linear/coordinate_rows.hpp"
#include "solvers/mode_names/detail/component_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace cardan::solvers {

namespace {

double lowest_frequency(const Campbell& diagram, const Branch& branch) {
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < diagram.points.size(); ++i)
        if (branch.mode[i] >= 0) lowest = std::min(lowest, diagram.natural_hz(branch, i));
    return lowest;
}

std::vector<int> modes_of_branches(const Campbell& diagram, std::size_t point) {
    std::vector<int> modes;
    for (const Branch& branch : diagram.branches)
        if (branch.mode[point] >= 0) modes.push_back(branch.mode[point]);
    return modes;
}

// Keeps the modes of the branches and those up to the limit; the rest was needed for tracking and naming only.
void drop_high_modes(Campbell& diagram, double limit_hz) {
    for (std::size_t i = 0; i < diagram.points.size(); ++i) {
        std::vector<CampbellMode>& modes = diagram.points[i].modes;
        const std::vector<int> of_branches = modes_of_branches(diagram, i);
        std::vector<int> new_index(modes.size(), -1);
        std::vector<CampbellMode> kept;
        for (std::size_t m = 0; m < modes.size(); ++m) {
            const bool needed = std::ranges::find(of_branches, static_cast<int>(m)) != of_branches.end();
            if (!needed && modes[m].mode.natural_hz() > limit_hz) continue;
            new_index[m] = static_cast<int>(kept.size());
            kept.push_back(std::move(modes[m]));
        }
        modes = std::move(kept);
        for (Branch& branch : diagram.branches)
            if (branch.mode[i] >= 0) branch.mode[i] = entry(new_index, branch.mode[i]);
    }
}

// A vibration at two neighbouring points; a motion that is locked at a multiple of the rotor speed crosses nothing.
bool vibrates(const Campbell& diagram, const Branch& branch, std::size_t point) {
    const CampbellMode* mode = diagram.mode(branch, point);
    return mode && mode->kind() == FloquetKind::oscillation;
}

void find_crossings(Campbell& diagram) {
    for (std::size_t b = 0; b < diagram.branches.size(); ++b)
        for (int n : rotor_multiples(diagram.blades))
            for (std::size_t i = 0; i + 1 < diagram.points.size(); ++i) {
                const Branch& branch = diagram.branches[b];
                if (!vibrates(diagram, branch, i) || !vibrates(diagram, branch, i + 1)) continue;
                const double w0 = diagram.points[i].rotor_speed, w1 = diagram.points[i + 1].rotor_speed;
                const double f0 = diagram.damped_hz(branch, i), f1 = diagram.damped_hz(branch, i + 1);
                const double d0 = f0 - n * w0 / (2 * pi), d1 = f1 - n * w1 / (2 * pi);
                if (!(d0 * d1 <= 0) || d0 == d1 || (d1 == 0 && i + 2 < diagram.points.size())) continue;
                const double t = d0 / (d0 - d1);
                diagram.crossings.push_back({static_cast<int>(b), n, w0 + t * (w1 - w0), f0 + t * (f1 - f0)});
            }
    std::sort(diagram.crossings.begin(), diagram.crossings.end(),
              [](const Crossing& a, const Crossing& b) { return a.rotor_speed < b.rotor_speed; });
}

// "wind speed 8 m/s, 6.9 rpm" of the parameter "wind speed, m/s".
void tell_place(std::ostream& out, const std::string& parameter, double value, double rotor_speed) {
    const std::size_t comma = parameter.rfind(", ");
    if (!parameter.empty())
        out << parameter.substr(0, comma) << " " << value
            << (comma == std::string::npos ? "" : " " + parameter.substr(comma + 2)) << ", ";
    out << rotor_speed * units::to_rpm << " rpm";
}

// A growing aperiodic motion is not a branch, but it must not go unnoticed.
void warn_of_instability(const CampbellPoint& point, const std::string& parameter, double value, std::string& warning) {
    if (!warning.empty() || !(point.stability_margin < 0)) return;
    Complex fastest = 0;
    const double lowest = lowest_vibration(point.modes);
    for (const CampbellMode& m : point.modes) {
        const Complex lambda = m.mode.eigenvalue;
        if (std::abs(lambda) > max_reliable_ratio * lowest) continue;
        const double scale = std::isfinite(lowest) ? std::max(lowest, std::abs(lambda)) : std::abs(lambda);
        const bool grows = m.kind() != FloquetKind::rigid && lambda.real() > 1e-6 * scale;
        if (grows && lambda.real() > fastest.real()) fastest = lambda;
    }
    if (fastest.real() == 0) return;
    std::ostringstream out = text_stream();
    out.precision(4);
    out << "unstable at ";
    tell_place(out, parameter, value, point.rotor_speed);
    out << ": a motion at " << fastest.imag() / (2 * pi) << " Hz grows with " << fastest.real() << " 1/s";
    warning = out.str();
}

void append(std::string& warning, const std::string& more) {
    if (!more.empty()) warning += (warning.empty() ? "" : "; ") + more;
}

// @param fixed  the rows of the blades are those of the fixed frame
std::string method_name(CampbellMethod method, std::size_t blades, bool fixed) {
    const char* rotating = "rotating frame of the blade";
    if (blades == 0 && method == CampbellMethod::coleman) return "fixed frame";
    switch (method) {
        case CampbellMethod::automatic:  // chosen before
        case CampbellMethod::coleman:
            return blades == 1 ? rotating : "Coleman (fixed frame)";
        case CampbellMethod::frozen_azimuth:
            return blades == 1 ? rotating : "frozen azimuth";
        case CampbellMethod::floquet:
            return text("Floquet (principal frequencies, ",
                        blades == 1 ? "rotating frame of the blade"
                        : fixed     ? "fixed frame"
                                    : "blade modes in the rotating frame",
                        ")");
        case CampbellMethod::averaged:
            return blades == 1 ? text(rotating, ", mean over the azimuth")
                               : "Coleman (fixed frame), mean over the azimuth about the periodic steady state";
    }
    return {};
}

}  // namespace

void check_case(const CampbellCase& one, const std::string& parameter) {
    if (!(one.rotor_speed >= 0) || std::isinf(one.rotor_speed))
        throw InputError("Campbell diagram", "rotor speed [rad/s]", one.rotor_speed, "finite and >= 0");
    if (!one.system || !one.rotor)
        throw InputError("Campbell diagram", text("system and rotor at ", parameter, " ", one.parameter), "none",
                         "both");
}

Sweep::Sweep(const CampbellOptions& options, std::string why, std::size_t points, const std::string& parameter)
    : options_(options), why_(std::move(why)), points_(points) {
    diagram_.parameter = parameter;
    if (!(options.max_frequency_hz > 0))
        throw InputError("Campbell diagram", "largest frequency [Hz]", options.max_frequency_hz, "> 0");
}

void Sweep::set_machine(const System& system, const RotorMap& rotor, const PointSolver& solver) {
    diagram_.machine = rotor.machine;
    diagram_.source = rotor.description;
    const std::vector<int>& unknowns = solver.unknowns();
    const bool spin_is_unknown = row_of(unknowns, rotor.spin) >= 0;
    diagram_.spin = spin_is_unknown ? RotorSpin::free : RotorSpin::prescribed;
    diagram_.blades = static_cast<int>(rotor.blades.size());
    const bool fixed = rotor.blades.size() != 2 && without_multi_blade_coordinates(rotor, unknowns).empty();
    diagram_.method = rotor.spin < 0 ? "at rest" : method_name(options_.method, rotor.blades.size(), fixed);
    diagram_.method_reason = why_;
    diagram_.coordinates = system.model.coordinates();
    diagram_.unknowns = solver.unknowns();
    diagram_.rows = solver.row_names();
    diagram_.states = solver.state_names();
    states_.clear();
    for (const StateInfo& state : system.forces.states())
        states_.push_back({state.part.empty() ? state.name : state.part, state.scale});
    diagram_.remark = held_inputs(system.forces);
    frames_ = recorded_frames(system, rotor, diagram_);
    if (options_.neighbour) neighbour_.emplace(*options_.neighbour).set_machine(diagram_);
}

bool Sweep::is_cancelled() {
    if (!options_.cancelled || !options_.cancelled()) return false;
    diagram_.complete = false;
    return true;
}

bool Sweep::add(const System& system, PointSolver& solver, double rotor_speed, double parameter) {
    if (is_cancelled()) return false;
    CampbellPoint point;
    try {
        point = solve(solver, rotor_speed);
    } catch (const NumericalError&) {
        if (is_cancelled()) return false;
        throw;
    }
    const PeriodicMac alike = likeness(solver, point);
    if (neighbour_)
        neighbour_->add(solver.system(), point, [&] {
            std::vector<int> all(point.modes.size());
            std::iota(all.begin(), all.end(), 0);
            return motions(system, solver, point, all, frames_);
        });
    add(std::move(point), alike, parameter);
    systems_.push_back(&system);
    if (options_.progress) options_.progress(static_cast<int>(diagram_.points.size()), static_cast<int>(points_));
    return true;
}

CampbellPoint Sweep::solve(PointSolver& solver, double rotor_speed) {
    CampbellPoint point;
    solver.solve(rotor_speed, point);
    align(*solver.energy_shares(), point);
    return point;
}

PeriodicMac Sweep::likeness(const PointSolver& solver, const CampbellPoint& point) const {
    if (options_.method == CampbellMethod::floquet) return likeness_of_periodic(solver, point);
    const Matrix mac = tracker_.mac(solver.system(), point);
    return {mac, mac};
}

bool Sweep::continues(const PeriodicMac& likeness, const CampbellPoint& point) const {
    return tracker_.continues(likeness.score, likeness.mac, point, options_.max_frequency_hz);
}

void Sweep::add(CampbellPoint point, const PeriodicMac& likeness, double parameter) {
    tracker_.add(likeness.score, likeness.mac, point);
    if (std::isfinite(point.stability_margin)) warn_of_instability(point, diagram_.parameter, parameter, instability_);
    diagram_.points.push_back(std::move(point));
}

// A rotor that begins to turn takes its blades along, but not what a tower sees of them: a mode at standstill continues
// in the fixed frame or, if it is one of single blades, with them.
PeriodicMac Sweep::likeness_of_periodic(const PointSolver& solver, const CampbellPoint& point) const {
    const std::vector<const CampbellMode*> last = tracker_.last();
    PeriodicMac fixed = periodic_mac(solver.system(), last, point.modes);
    const bool starts = !diagram_.points.empty() && diagram_.points.back().rotor_speed == 0 && point.rotor_speed != 0;
    if (!starts || !solver.coleman()) return fixed;
    std::vector<CampbellMode> turning;
    turning.reserve(last.size());
    for (const CampbellMode* mode : last)
        turning.push_back(mode->blade_shares.size() > 0 && mode->row < 0
                              ? carried_along(*mode, *solver.coleman(), point.rotor_speed)
                              : *mode);
    std::vector<const CampbellMode*> pointers;
    pointers.reserve(turning.size());
    for (const CampbellMode& mode : turning) pointers.push_back(&mode);
    const PeriodicMac carried = periodic_mac(solver.system(), pointers, point.modes);
    return {fixed.mac.cwiseMax(carried.mac), fixed.score.cwiseMax(carried.score)};
}

// Another machine may have its component modes in another order.
void Sweep::align(const EnergyFractions& own, CampbellPoint& point) {
    if (!first_) first_ = &own;
    if (first_ == &own) return;
    const std::vector<Component>&wanted = first_->components(), &there = own.components();
    const std::optional<std::vector<std::size_t>> found = component_order(wanted, there);
    if (!found)
        throw InputError(diagram_.machine, text("component modes at point ", diagram_.points.size() + 1), there.size(),
                         text(wanted.size(), ", of every part as many as at the first point"));
    for (CampbellMode& m : point.modes) {
        std::vector<EnergyFraction> shares;
        for (std::size_t i = 0; i < found->size(); ++i) {
            shares.push_back(m.shares[(*found)[i]]);
            shares.back().component = static_cast<int>(i);
        }
        m.shares = std::move(shares);
    }
}

void Sweep::set_branches(const Solvers& solvers, BranchesOf of) {
    const EnergyFractions* energy_shares = solvers[0]->energy_shares();
    if (!energy_shares) return;
    diagram_.components = energy_shares->components();
    const bool whirl = options_.method != CampbellMethod::frozen_azimuth &&
                       std::any_of(diagram_.points.begin(), diagram_.points.end(),
                                   [](const CampbellPoint& p) { return p.rotor_speed != 0; });
    diagram_.branches = tracker_.branches(diagram_.points, *energy_shares, diagram_.rows, states_, whirl, of,
                                          neighbour_ ? &*neighbour_ : nullptr);
    take_blade_frequencies(diagram_);
    std::erase_if(diagram_.branches,
                  [&](const Branch& b) { return lowest_frequency(diagram_, b) > options_.max_frequency_hz; });
    drop_high_modes(diagram_, options_.max_frequency_hz);
    if (!options_.keep_shapes) return;
    for (std::size_t i = 0; i < diagram_.points.size(); ++i)
        diagram_.motions.push_back(motions(*systems_[i], *solvers[std::min(i, solvers.size() - 1)], diagram_.points[i],
                                           modes_of_branches(diagram_, i), frames_));
}

void Sweep::set_warning(const RotorMap& rotor, const Solvers& solvers) {
    if (options_.method == CampbellMethod::frozen_azimuth && rotor.blades.size() > 2)
        diagram_.warning =
            "frozen azimuth: these are eigenvalues of the equations at one azimuth, no motions of the machine; they "
            "show spurious damping. Use the Coleman result for design";
    for (const std::unique_ptr<PointSolver>& solver : solvers)
        if (solvers.size() == 1 || diagram_.warning.empty()) append(diagram_.warning, solver->warning());
    append(diagram_.warning, instability_);
}

Campbell Sweep::finish(const RotorMap& rotor, const Solvers& solvers, BranchesOf of) {
    set_branches(solvers, of);
    set_warning(rotor, solvers);
    if (diagram_.parameter.empty()) find_crossings(diagram_);
    return std::move(diagram_);
}

}  // namespace cardan::solvers
