#include "solvers/campbell/diagram.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/detail/blade_frame.hpp"
#include "solvers/campbell/detail/component_order.hpp"
#include "solvers/campbell/detail/floquet_mac.hpp"
#include "solvers/campbell/detail/method.hpp"
#include "solvers/campbell/detail/recorded_motions.hpp"
#include "solvers/campbell/detail/tracking.hpp"
#include "solvers/campbell/point.hpp"
#include "solvers/linear/coordinate_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
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

void check_speeds(std::span<const double> rotor_speed) {
    if (rotor_speed.empty()) throw InputError("Campbell diagram", "number of rotor speeds", 0, "at least one");
    for (std::size_t i = 0; i < rotor_speed.size(); ++i)
        if (!std::isfinite(rotor_speed[i]) || rotor_speed[i] < 0 || (i > 0 && !(rotor_speed[i] > rotor_speed[i - 1])))
            throw InputError("Campbell diagram", text("rotor speed number ", i + 1, " [rad/s]"), rotor_speed[i],
                             "finite, >= 0 and increasing");
}

void check_cases(std::span<const CampbellCase> cases, const std::string& parameter) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const CampbellCase& one = cases[i];
        if (!std::isfinite(one.parameter) || (i > 0 && !(one.parameter > cases[i - 1].parameter)))
            throw InputError("Campbell diagram", parameter, one.parameter, "finite and increasing");
        if (!(one.rotor_speed >= 0) || std::isinf(one.rotor_speed))
            throw InputError("Campbell diagram", "rotor speed [rad/s]", one.rotor_speed, "finite and >= 0");
        if (!one.system || !one.rotor)
            throw InputError("Campbell diagram", text("system and rotor at ", parameter, " ", one.parameter), "none",
                             "both");
    }
}

// A growing aperiodic motion is not a branch, but it must not go unnoticed.
void warn_of_instability(const CampbellPoint& point, std::string& warning) {
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
    std::ostringstream out;
    out.precision(4);
    out << "unstable at " << point.rotor_speed * units::to_rpm << " rpm: a motion at " << fastest.imag() / (2 * pi)
        << " Hz grows with " << fastest.real() << " 1/s";
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

// The diagram of one machine or of several like it, point by point.
class Sweep {
public:
    Sweep(const CampbellOptions& options, std::string why, std::size_t points, const std::string& parameter = {})
        : options_(options), why_(std::move(why)), points_(points) {
        diagram_.parameter = parameter;
        if (!(options.max_frequency_hz > 0))
            throw InputError("Campbell diagram", "largest frequency [Hz]", options.max_frequency_hz, "> 0");
    }

    void set_machine(const System& system, const RotorMap& rotor, const PointMethod& solver);
    /// False if it was cancelled.
    bool add(const System& system, PointMethod& solver, double rotor_speed);
    /// @param solvers  by point, or one for all
    Campbell finish(const RotorMap& rotor, const std::vector<const PointMethod*>& solvers);

private:
    void align(const EnergyShares& own, CampbellPoint& point);
    PeriodicMac likeness_to_last(const PointMethod& solver, const CampbellPoint& point) const;
    void set_branches(const std::vector<const PointMethod*>& solvers);
    void set_warning(const RotorMap& rotor, const std::vector<const PointMethod*>& solvers);

    const CampbellOptions& options_;
    std::string why_;  // this method was chosen
    std::size_t points_;
    Campbell diagram_;
    std::vector<FrameId> frames_;
    std::vector<const System*> systems_;   // by point
    const EnergyShares* first_ = nullptr;  // of the first machine
    Tracker tracker_;
    std::optional<NeighbourNames> neighbour_;
    std::string instability_;
};

void Sweep::set_machine(const System& system, const RotorMap& rotor, const PointMethod& solver) {
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
    diagram_.remark = held_inputs(system.forces);
    frames_ = recorded_frames(system, rotor, diagram_);
    if (options_.neighbour) neighbour_.emplace(*options_.neighbour).check(diagram_);
}

bool Sweep::add(const System& system, PointMethod& solver, double rotor_speed) {
    if (options_.cancelled && options_.cancelled()) {
        diagram_.complete = false;
        return false;
    }
    CampbellPoint point;
    solver.solve(rotor_speed, point);
    align(*solver.energy_shares(), point);
    if (options_.method == CampbellMethod::floquet) {
        const PeriodicMac likeness = likeness_to_last(solver, point);
        tracker_.add(likeness.score, likeness.mac, point);
    } else {
        tracker_.add(solver.system(), point);
    }
    if (neighbour_) neighbour_->add(solver.system(), point);
    if (std::isfinite(point.stability_margin)) warn_of_instability(point, instability_);
    diagram_.points.push_back(std::move(point));
    systems_.push_back(&system);
    if (options_.progress) options_.progress(static_cast<int>(diagram_.points.size()), static_cast<int>(points_));
    return true;
}

// A rotor that begins to turn takes its blades along, but not what a tower sees of them: a mode at standstill continues
// in the fixed frame or, if it is one of single blades, with them.
PeriodicMac Sweep::likeness_to_last(const PointMethod& solver, const CampbellPoint& point) const {
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
void Sweep::align(const EnergyShares& own, CampbellPoint& point) {
    if (!first_) first_ = &own;
    if (first_ == &own) return;
    const std::vector<Component>&wanted = first_->components(), &there = own.components();
    const std::optional<std::vector<std::size_t>> found = component_order(wanted, there, diagram_.parameter.empty());
    if (!found)
        throw InputError(diagram_.machine, text("component modes at point ", diagram_.points.size() + 1), there.size(),
                         text(wanted.size(), " with the same names as at the first point"));
    for (CampbellMode& m : point.modes) {
        std::vector<Share> shares;
        for (std::size_t i = 0; i < found->size(); ++i) {
            shares.push_back(m.shares[(*found)[i]]);
            shares.back().component = static_cast<int>(i);
        }
        m.shares = std::move(shares);
    }
}

void Sweep::set_branches(const std::vector<const PointMethod*>& solvers) {
    const EnergyShares* energy_shares = solvers[0]->energy_shares();
    if (!energy_shares) return;
    diagram_.components = energy_shares->components();
    const bool whirl = options_.method != CampbellMethod::frozen_azimuth &&
                       std::any_of(diagram_.points.begin(), diagram_.points.end(),
                                   [](const CampbellPoint& p) { return p.rotor_speed != 0; });
    diagram_.branches =
        tracker_.branches(diagram_.points, *energy_shares, diagram_.rows, whirl, neighbour_ ? &*neighbour_ : nullptr);
    take_blade_frequencies(diagram_);
    std::erase_if(diagram_.branches,
                  [&](const Branch& b) { return lowest_frequency(diagram_, b) > options_.max_frequency_hz; });
    drop_high_modes(diagram_, options_.max_frequency_hz);
    if (!options_.keep_shapes) return;
    for (std::size_t i = 0; i < diagram_.points.size(); ++i)
        diagram_.motions.push_back(motions(*systems_[i], *solvers[std::min(i, solvers.size() - 1)], diagram_.points[i],
                                           modes_of_branches(diagram_, i), frames_));
}

void Sweep::set_warning(const RotorMap& rotor, const std::vector<const PointMethod*>& solvers) {
    if (options_.method == CampbellMethod::frozen_azimuth && rotor.blades.size() > 2)
        diagram_.warning =
            "frozen azimuth: these are eigenvalues of the equations at one azimuth, no motions of the machine; they "
            "show spurious damping. Use the Coleman result for design";
    for (const PointMethod* solver : solvers)
        if (solvers.size() == 1 || diagram_.warning.empty()) append(diagram_.warning, solver->warning());
    append(diagram_.warning, instability_);
}

Campbell Sweep::finish(const RotorMap& rotor, const std::vector<const PointMethod*>& solvers) {
    set_branches(solvers);
    set_warning(rotor, solvers);
    if (diagram_.parameter.empty()) find_crossings(diagram_);
    return std::move(diagram_);
}

}  // namespace

std::vector<double> rpm_range(double first, double last, double step) {
    if (!std::isfinite(first) || !std::isfinite(last) || !std::isfinite(step) || !(step > 0) || last < first)
        throw InputError("rotor speeds", "FIRST:LAST:STEP [rpm]", text(first, ":", last, ":", step),
                         "finite, STEP > 0, FIRST <= LAST");
    std::vector<double> speeds;
    const double intervals = std::floor((last - first) / step + 1e-9);
    if (!(intervals < 1e5))
        throw InputError("rotor speeds", "number of speeds in FIRST:LAST:STEP", intervals + 1, "at most 100000");
    const auto count = static_cast<std::size_t>(intervals);
    for (std::size_t i = 0; i <= count; ++i) speeds.push_back((first + static_cast<double>(i) * step) * units::rpm);
    return speeds;
}

Campbell campbell(const System& system, const RotorMap& rotor, std::span<const double> rotor_speed,
                  const CampbellOptions& options) {
    check_speeds(rotor_speed);
    const MethodChoice choice = choose_method(system, rotor, rotor_speed, options);
    CampbellOptions own = options;
    own.method = choice.method;
    Sweep sweep(own, choice.reason, rotor_speed.size());
    const std::unique_ptr<PointMethod> solver = point_method(system, rotor, own);
    sweep.set_machine(system, rotor, *solver);
    for (const double speed : rotor_speed)
        if (!sweep.add(system, *solver, speed)) break;
    return sweep.finish(rotor, {solver.get()});
}

Campbell campbell(std::span<const CampbellCase> cases, const std::string& parameter, const CampbellOptions& options) {
    if (cases.empty()) throw InputError("Campbell diagram", "number of points", 0, "at least one");
    std::vector<CampbellCase> by_speed(cases.begin(), cases.end());
    for (CampbellCase& one : by_speed) one.parameter = one.rotor_speed;
    const std::string name = parameter.empty() ? "rotor speed [rad/s]" : parameter;
    if (parameter.empty()) cases = by_speed;
    check_cases(cases, name);
    if (options.neighbour)
        throw InputError("Campbell diagram", text("neighbour of a diagram over ", name), "given",
                         "none: modes are followed from one machine to the next");
    const MethodChoice choice = choose_method(cases, name, options);
    CampbellOptions own = options;
    own.method = choice.method;
    Sweep sweep(own, choice.reason, cases.size(), parameter);
    std::vector<std::unique_ptr<PointMethod>> solvers;
    std::vector<const PointMethod*> used;
    std::vector<double> parameters;
    for (const CampbellCase& one : cases) {
        solvers.push_back(point_method(*one.system, *one.rotor, own));
        if (parameters.empty()) sweep.set_machine(*one.system, *one.rotor, *solvers.back());
        if (solvers.back()->row_names() != solvers.front()->row_names())
            throw InputError(one.rotor->machine, text("rows at ", name, " ", one.parameter),
                             solvers.back()->unknowns().size(), "those of the first machine");
        used.push_back(solvers.back().get());
        solvers.back()->start_from(one.start, one.state_start);
        if (!sweep.add(*one.system, *solvers.back(), one.rotor_speed)) break;
        parameters.push_back(one.parameter);
    }
    Campbell diagram = sweep.finish(*cases[0].rotor, used);
    if (!parameter.empty()) diagram.parameters = std::move(parameters);
    return diagram;
}

}  // namespace cardan::solvers
