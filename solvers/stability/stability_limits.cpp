#include "solvers/stability/stability_limits.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/campbell/detail/floquet_point.hpp"
#include "solvers/campbell/detail/method.hpp"
#include "solvers/campbell/detail/sweep.hpp"
#include "solvers/stability/detail/search_notes.hpp"
#include "solvers/stability/detail/state_vibrations.hpp"
#include "solvers/stability/detail/static_name.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace cardan::solvers {

namespace {

constexpr const char* in_limits = "stability limits";
// Static roots closer to zero are rigid motions, without any stiffness.
constexpr double least_static_root = 1e-10;

void check_search(const MachineFamily& machines, const std::string& parameter, double from, double to,
                  const StabilityOptions& options) {
    if (!machines) throw InputError(in_limits, "machines", "none", "a function of the parameter");
    if (!std::isfinite(from) || !std::isfinite(to) || !(from < to))
        throw InputError(in_limits, text("range of ", parameter), text(from, " ... ", to), "finite and rising");
    if (options.steps < 1) throw InputError(in_limits, "number of steps", options.steps, ">= 1");
    if (options.halvings < 0 || options.halvings > 40)
        throw InputError(in_limits, "halvings of a step", options.halvings, "0 ... 40");
    require_positive(in_limits, "tolerance of the parameter", options.tolerance);
    require_not_negative(in_limits, "growth that is rounding", options.growth);
    if (options.modes.method == CampbellMethod::frozen_azimuth)
        throw InputError(in_limits, "method", "frozen azimuth", "one whose modes are motions of the machine");
    if (options.modes.neighbour)
        throw InputError(in_limits, "neighbour of the diagram", "given",
                         "none: modes are followed from one machine to the next");
}

int number_below_zero(const StaticRoots& roots) {
    return static_cast<int>(
        std::ranges::count_if(roots.values, [](double value) { return value < -least_static_root; }));
}

// The i-th root from below, so that it passes through zero where it counts as negative; where there are fewer, that of
// a spring.
double static_root(const StaticRoots& roots, int i) {
    return i < std::ssize(roots.values) ? entry(roots.values, i) + least_static_root : 1;
}

int nearest_to_zero(const StaticRoots& roots) {
    const auto size = [](double value) { return std::abs(value); };
    return static_cast<int>(std::ranges::min_element(roots.values, {}, size) - roots.values.begin());
}

// Of an iteration: CampbellCase::start. The points themselves are handed over before the limits are sought.
struct Start {
    Matrix coordinates, states;
};

// A machine at a value of the parameter. Of its solver only what it has computed is used later on: the machine may be
// gone by then.
struct Probe {
    double parameter;
    std::unique_ptr<PointSolver> solver;
    CampbellPoint point = {};
    std::optional<StaticRoots> roots = {};  // none: they were not looked for, or could not be found
};

class LimitSearch {
public:
    LimitSearch(const MachineFamily& machines, const std::string& parameter, const StabilityOptions& options,
                const MethodChoice& choice)
        : machines_(machines),
          parameter_(parameter),
          options_(options),
          modes_(with_method(options.modes, choice.method)),
          notes_(parameter, options.growth, options.modes.max_frequency_hz),
          sweep_(modes_, choice.reason, 0, parameter) {}

    StabilityLimits run(double from, double to);

private:
    static CampbellOptions with_method(CampbellOptions modes, CampbellMethod method) {
        modes.method = method;
        modes.keep_shapes = false;
        modes.all_state_motions = true;  // they are followed as well
        return modes;
    }
    void start(PointSolver& solver, const CampbellCase& one) const;
    std::optional<Probe> probe(double parameter);
    Probe certain_probe(double parameter);
    void check_machine(const CampbellCase& one, const PointSolver& solver);
    void find_static_roots(Probe& probe);
    void accept(Probe probe, const PeriodicMac& likeness);
    bool follow(std::optional<Probe> next, double to, int halvings);
    void follow_all(double from, double to);
    void find_limits();
    void find_flutter(const Branch& branch, std::size_t i);
    void find_divergence(std::size_t i);
    StaticRoots certain_roots(double parameter);
    void add_divergence(double parameter, std::size_t i);
    double beside() const { return 10 * options_.tolerance * width_; }
    template <class F>
    double root(const F& f, std::size_t i, double first, double second) const;

    const MachineFamily& machines_;
    std::string parameter_;
    const StabilityOptions& options_;
    CampbellOptions modes_;
    SearchNotes notes_;
    Sweep sweep_;
    RotorMap rotor_;  // of the first machine
    std::vector<std::string> rows_;
    double width_ = 0;  // of the range
    bool cancelled_ = false;
    std::string failure_;  // why the last probe has no steady state
    // By point that was accepted.
    std::vector<double> parameters_;
    std::vector<Start> starts_;
    Sweep::Solvers solvers_;
    std::vector<std::optional<StaticRoots>> roots_;
    StabilityLimits found_;
};

void LimitSearch::check_machine(const CampbellCase& one, const PointSolver& solver) {
    if (rows_.empty()) {
        rotor_ = *one.rotor;
        rows_ = solver.row_names();
        sweep_.set_machine(*one.system, *one.rotor, solver);
    }
    if (solver.row_names() != rows_)
        throw InputError(one.rotor->machine, text("rows at ", notes_.at(one.parameter)), solver.unknowns().size(),
                         "those of the first machine");
}

void LimitSearch::find_static_roots(Probe& probe) {
    try {
        probe.roots = static_roots(probe.solver->system());
    } catch (const NumericalError& error) {
        if (notes_.words().find(error.what()) == std::string::npos)
            notes_.add(text("divergence was not looked for at ", notes_.at(probe.parameter), ": ", error.what()));
    }
}

// Where the machine comes without a start, that is the steady state of the nearest point that was accepted.
void LimitSearch::start(PointSolver& solver, const CampbellCase& one) const {
    if (one.start.size() > 0 || starts_.empty()) return solver.start_from(one.start, one.state_start);
    const auto distance = [&](double parameter) { return std::abs(parameter - one.parameter); };
    const auto nearest = std::ranges::min_element(parameters_, {}, distance) - parameters_.begin();
    const Start& from = starts_[static_cast<std::size_t>(nearest)];
    solver.start_from(from.coordinates, from.states);
}

// None if it was cancelled, or if there is no steady state.
std::optional<Probe> LimitSearch::probe(double parameter) {
    cancelled_ = cancelled_ || (modes_.cancelled && modes_.cancelled());
    if (cancelled_) return std::nullopt;
    CampbellCase one = machines_(parameter);
    one.parameter = parameter;
    if (parameter_.empty()) one.rotor_speed = parameter;
    check_case(one, parameter_);
    Probe out{parameter, point_solver(*one.system, *one.rotor, modes_)};
    check_machine(one, *out.solver);
    if (!solvers_.empty()) out.solver->mode_range() = solvers_.front()->mode_range();
    start(*out.solver, one);
    try {
        out.point = sweep_.solve(*out.solver, one.rotor_speed);
    } catch (const NumericalError& error) {
        failure_ = error.what();
        return std::nullopt;
    }
    if (modes_.method != CampbellMethod::floquet || out.point.rotor_speed == 0) {
        take_vibrations_of_states(*out.solver, out.point);
        find_static_roots(out);
    } else {
        notes_.add("divergence was not looked for where the rotor turns, by Floquet's theory");
    }
    return out;
}

Probe LimitSearch::certain_probe(double parameter) {
    std::optional<Probe> out = probe(parameter);
    if (!out) throw NumericalError(cancelled_ ? "it was cancelled" : text(notes_.at(parameter), ": ", failure_));
    return std::move(*out);
}

void LimitSearch::accept(Probe probe, const PeriodicMac& likeness) {
    const CampbellPoint& point = probe.point;
    if (point.periodic)
        starts_.push_back({point.periodic->coefficients, point.periodic->state_coefficients});
    else
        starts_.push_back({point.at.q, point.at.s});
    notes_.see(probe.parameter, point);
    sweep_.add(std::move(probe.point), likeness, probe.parameter);
    parameters_.push_back(probe.parameter);
    solvers_.push_back(std::move(probe.solver));
    roots_.push_back(std::move(probe.roots));
}

// From the last point that was accepted to the next; in halves if the modes do not continue there beyond doubt, or if
// there is no steady state. False: it cannot be reached.
bool LimitSearch::follow(std::optional<Probe> next, double to, int halvings) {
    if (cancelled_) return false;
    if (next) {
        const PeriodicMac likeness = sweep_.likeness(*next->solver, next->point);
        if (halvings == 0 || sweep_.continues(likeness, next->point)) {
            accept(std::move(*next), likeness);
            return true;
        }
    }
    if (halvings == 0) return false;
    const double middle = (parameters_.back() + to) / 2;
    return follow(probe(middle), middle, halvings - 1) && follow(std::move(next), to, halvings - 1);
}

void LimitSearch::follow_all(double from, double to) {
    std::optional<Probe> first = probe(from);
    if (!first && !cancelled_) throw NumericalError(text(notes_.at(from), ": ", failure_));
    if (!first) return;
    const PeriodicMac likeness = sweep_.likeness(*first->solver, first->point);
    accept(std::move(*first), likeness);
    for (int i = 1; i <= options_.steps; ++i) {
        const double next = i == options_.steps ? to : from + (to - from) * i / options_.steps;
        if (!follow(probe(next), next, options_.halvings)) break;
        if (modes_.progress) modes_.progress(i, options_.steps);
    }
    if (parameters_.back() < to)
        notes_.add(text("no further than ", notes_.at(parameters_.back()), ": ", cancelled_ ? "cancelled" : failure_));
}

// In the step behind point i, from the values of f at its ends.
template <class F>
double LimitSearch::root(const F& f, std::size_t i, double first, double second) const {
    const auto close = [this](double low, double high) { return high - low <= options_.tolerance * width_; };
    std::uintmax_t iterations = 200;
    const auto bracket =
        boost::math::tools::toms748_solve(f, parameters_[i], parameters_[i + 1], first, second, close, iterations);
    return bracket.first + (bracket.second - bracket.first) / 2;
}

// The mode in between is the one that is most like those at both ends.
void LimitSearch::find_flutter(const Branch& branch, std::size_t i) {
    const CampbellMode *before = found_.diagram.mode(branch, i), *after = found_.diagram.mode(branch, i + 1);
    if (!before || !after || !vibrates(*before) || !vibrates(*after)) return;
    const bool begins = excess(after->mode, options_.growth) > 0;
    if (begins == (excess(before->mode, options_.growth) > 0)) return;
    // The limit is zero growth where the other end decays, by more than rounding; else where growth is no more
    // rounding.
    const Mode& calm = (begins ? before : after)->mode;
    const double rounding = excess(calm, -options_.growth) < 0 ? 0 : options_.growth;
    const auto between = [&](double parameter) {
        Probe there = certain_probe(parameter);
        std::erase_if(there.point.modes, [](const CampbellMode& mode) { return !vibrates(mode); });
        if (there.point.modes.empty()) throw NumericalError(text(notes_.at(parameter), ": nothing vibrates"));
        const PeriodicMac alike = periodic_mac(there.solver->system(), {before, after}, there.point.modes);
        Eigen::Index most = 0;
        alike.score.colwise().sum().maxCoeff(&most);
        return std::pair(std::move(entry(there.point.modes, most).mode), there.point.rotor_speed);
    };
    StabilityLimit limit{.kind = Instability::flutter,
                         .begins = begins,
                         .name = branch.name,
                         .doubtful = branch.doubtful[i] || branch.doubtful[i + 1]};
    limit.parameter = root([&](double parameter) { return excess(between(parameter).first, rounding); }, i,
                           excess(before->mode, rounding), excess(after->mode, rounding));
    const auto [mode, speed] = between(limit.parameter);
    limit.eigenvalue = mode.eigenvalue;
    limit.rotor_speed = speed;
    found_.limits.push_back(std::move(limit));
}

StaticRoots LimitSearch::certain_roots(double parameter) {
    Probe there = certain_probe(parameter);
    if (!there.roots) throw NumericalError(text(notes_.at(parameter), ": no static stiffness"));
    return std::move(*there.roots);
}

// In which direction a root passes through zero is seen next to it: at the ends of the step others may be below zero.
void LimitSearch::add_divergence(double parameter, std::size_t i) {
    const Probe there = certain_probe(parameter);
    const StaticRoots beyond = certain_roots(std::min(parameter + beside(), parameters_[i + 1])),
                      before = certain_roots(std::max(parameter - beside(), parameters_[i]));
    const int k = nearest_to_zero(*there.roots);
    const auto root_of = [](const StaticRoots& roots) { return entry(roots.values, nearest_to_zero(roots)); };
    const bool falls = root_of(beyond) < root_of(before);
    found_.limits.push_back({.kind = Instability::divergence,
                             .begins = falls == grows_below_zero(there.solver->system(), *there.roots, k),
                             .name = static_name(*there.solver, *there.roots, k, rows_),
                             .parameter = parameter,
                             .rotor_speed = there.point.rotor_speed});
}

void LimitSearch::find_divergence(std::size_t i) {
    if (!roots_[i] || !roots_[i + 1]) return;  // as the note says
    constexpr double small = 1e-5;
    const StaticRoots &first = *roots_[i], &last = *roots_[i + 1];
    const auto [fewer, more] = std::minmax({number_below_zero(first), number_below_zero(last)});
    int found = 0;
    for (int k = fewer; k < more; ++k) {
        const auto root_at = [&](double at) { return static_root(certain_roots(at), k); };
        const double parameter = root(root_at, i, static_root(first, k), static_root(last, k));
        // A pair of complex roots may become two real ones, of which both are negative, or the other way round: nothing
        // passes through zero then.
        const double low = root_at(std::max(parameter - beside(), parameters_[i])),
                     high = root_at(std::min(parameter + beside(), parameters_[i + 1]));
        if (!(std::abs(high - low) < small)) continue;
        add_divergence(parameter, i);
        ++found;
    }
    if ((first.product > 0) != (last.product > 0) && found % 2 == 0)
        add_divergence(root([&](double at) { return certain_roots(at).product; }, i, first.product, last.product), i);
}

void LimitSearch::find_limits() {
    try {
        for (std::size_t i = 0; i + 1 < parameters_.size(); ++i) {
            for (const Branch& branch : found_.diagram.branches) find_flutter(branch, i);
            find_divergence(i);
        }
    } catch (const NumericalError& error) {
        notes_.add(text("not all limits were found: ", error.what()));
        found_.diagram.complete = false;
    }
    std::ranges::stable_sort(found_.limits, {}, &StabilityLimit::parameter);
}

StabilityLimits LimitSearch::run(double from, double to) {
    width_ = to - from;
    follow_all(from, to);
    if (parameters_.empty()) {
        notes_.add("cancelled before the first point");
        found_.note = notes_.words();
        found_.diagram.complete = false;
        return std::move(found_);
    }
    found_.diagram = sweep_.finish(rotor_, solvers_, BranchesOf::curves);
    found_.diagram.complete = parameters_.back() == to;
    if (!parameter_.empty()) found_.diagram.parameters = parameters_;
    notes_.tell_growth(found_.diagram);
    find_limits();
    found_.note = notes_.words();
    return std::move(found_);
}

// Coleman's if it suits the machines of both ends.
MethodChoice choose_for_range(const MachineFamily& machines, const std::string& parameter, double from, double to,
                              const CampbellOptions& options) {
    for (const double end : {from, to}) {
        CampbellCase one = machines(end);
        one.parameter = end;
        if (parameter.empty()) one.rotor_speed = end;
        check_case(one, parameter);
        MethodChoice choice = choose_method(std::span(&one, 1), parameter, options);
        if (choice.method != CampbellMethod::coleman) return choice;
    }
    return {CampbellMethod::coleman};
}

}  // namespace

const StabilityLimit* StabilityLimits::first(Instability kind) const {
    const auto found = std::ranges::find_if(
        limits, [kind](const StabilityLimit& limit) { return limit.kind == kind && limit.begins; });
    return found == limits.end() ? nullptr : &*found;
}

StabilityLimits stability_limits(const MachineFamily& family, const std::string& parameter, double from, double to,
                                 const StabilityOptions& options) {
    check_search(family, parameter.empty() ? "rotor speed, rad/s" : parameter, from, to, options);
    const MethodChoice choice = choose_for_range(family, parameter, from, to, options.modes);
    return LimitSearch(family, parameter, options, choice).run(from, to);
}

}  // namespace cardan::solvers
