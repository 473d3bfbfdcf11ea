#include "solvers/campbell/stability_limits.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/campbell/detail/floquet_point.hpp"
#include "solvers/campbell/detail/method.hpp"
#include "solvers/campbell/detail/state_vibrations.hpp"
#include "solvers/campbell/detail/static_name.hpp"
#include "solvers/campbell/detail/sweep.hpp"

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

void add_note(std::string& note, const std::string& more) {
    note += text(note.empty() ? "" : "; ", more);
}

// Motions that may flutter; of Floquet's theory also those that are locked to the rotor.
bool vibrates(const CampbellMode& mode) {
    return mode.kind() != FloquetKind::rigid && (mode.mode.oscillates() || mode.floquet);
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

// Of an iteration: CampbellCase::start. The points themselves are handed over before the limits are sought.
struct Start {
    Matrix coordinates, states;
};

// A machine at a value of the parameter. Of its solver only what it has computed is used later on: the machine may be
// gone by then.
struct Probe {
    double parameter;
    std::unique_ptr<PointMethod> solver;
    CampbellPoint point = {};
    StaticRoots roots = {};
};

class LimitSearch {
public:
    LimitSearch(const MachineFamily& machines, const std::string& parameter, const StabilityOptions& options,
                const MethodChoice& choice)
        : machines_(machines),
          parameter_(parameter),
          options_(options),
          modes_(with_method(options.modes, choice.method)),
          sweep_(modes_, choice.reason, 0, parameter) {}

    StabilityLimits run(double from, double to);

private:
    static CampbellOptions with_method(CampbellOptions modes, CampbellMethod method) {
        modes.method = method;
        modes.keep_shapes = false;
        return modes;
    }
    std::string at(double parameter) const;
    void start(PointMethod& solver, const CampbellCase& one) const;
    std::optional<Probe> probe(double parameter);
    Probe certain_probe(double parameter);
    void check_machine(const CampbellCase& one, const PointMethod& solver);
    void find_static_roots(Probe& probe);
    void accept(Probe probe, const PeriodicMac& likeness);
    bool follow(std::optional<Probe> next, double to, int halvings);
    void follow_all(double from, double to);
    void find_limits();
    void find_flutter(const Branch& branch, std::size_t i);
    void find_divergence(std::size_t i);
    bool is_continuous(int k, double parameter, std::size_t i);
    void add_divergence(double parameter, bool begins);
    template <class F>
    double root(const F& f, std::size_t i, double first, double second) const;
    double excess(const Mode& mode) const {
        return mode.eigenvalue.real() - options_.growth * std::abs(mode.eigenvalue);
    }
    void note_growth();

    const MachineFamily& machines_;
    std::string parameter_;
    const StabilityOptions& options_;
    CampbellOptions modes_;
    Sweep sweep_;
    RotorMap rotor_;  // of the first machine
    std::vector<std::string> rows_;
    double width_ = 0;  // of the range
    bool cancelled_ = false;
    std::string failure_;  // why the last probe has no steady state
    // By point that was accepted.
    std::vector<double> parameters_;
    std::vector<Start> starts_;
    std::vector<std::unique_ptr<PointMethod>> solvers_;
    std::vector<StaticRoots> roots_;
    StabilityLimits found_;
};

// "wind speed, m/s 12"
std::string LimitSearch::at(double parameter) const {
    return text(parameter_.empty() ? "rotor speed, rad/s" : parameter_, " ", parameter);
}

void LimitSearch::check_machine(const CampbellCase& one, const PointMethod& solver) {
    if (rows_.empty()) {
        rotor_ = *one.rotor;
        rows_ = solver.row_names();
        sweep_.set_machine(*one.system, *one.rotor, solver);
    }
    if (solver.row_names() != rows_)
        throw InputError(one.rotor->machine, text("rows at ", at(one.parameter)), solver.unknowns().size(),
                         "those of the first machine");
}

void LimitSearch::find_static_roots(Probe& probe) {
    try {
        probe.roots = static_roots(probe.solver->system());
    } catch (const NumericalError& error) {
        if (found_.note.find(error.what()) == std::string::npos)
            add_note(found_.note, text("divergence was not looked for at ", at(probe.parameter), ": ", error.what()));
    }
}

// Where the machine comes without a start, that is the steady state of the nearest point that was accepted.
void LimitSearch::start(PointMethod& solver, const CampbellCase& one) const {
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
    Probe out{parameter, point_method(*one.system, *one.rotor, modes_)};
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
    }
    return out;
}

Probe LimitSearch::certain_probe(double parameter) {
    std::optional<Probe> out = probe(parameter);
    if (!out) throw NumericalError(cancelled_ ? "it was cancelled" : text(at(parameter), ": ", failure_));
    return std::move(*out);
}

void LimitSearch::accept(Probe probe, const PeriodicMac& likeness) {
    const CampbellPoint& point = probe.point;
    if (point.periodic)
        starts_.push_back({point.periodic->coefficients, point.periodic->state_coefficients});
    else
        starts_.push_back({point.at.q, point.at.s});
    sweep_.add(*probe.solver, std::move(probe.point), likeness);
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
    if (!first && !cancelled_) throw NumericalError(text(at(from), ": ", failure_));
    if (!first) return;
    const PeriodicMac likeness = sweep_.likeness(*first->solver, first->point);
    accept(std::move(*first), likeness);
    for (int i = 1; i <= options_.steps; ++i) {
        const double next = i == options_.steps ? to : from + (to - from) * i / options_.steps;
        if (!follow(probe(next), next, options_.halvings)) break;
        if (modes_.progress) modes_.progress(i, options_.steps);
    }
    if (!cancelled_ && parameters_.back() < to)
        add_note(found_.note, text("no further than ", at(parameters_.back()), ": ", failure_));
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
    const double first = excess(before->mode), second = excess(after->mode);
    if ((first > 0) == (second > 0)) return;
    const auto between = [&](double parameter) {
        Probe there = certain_probe(parameter);
        std::erase_if(there.point.modes, [](const CampbellMode& mode) { return !vibrates(mode); });
        if (there.point.modes.empty()) throw NumericalError(text(at(parameter), ": nothing vibrates"));
        const PeriodicMac alike = periodic_mac(there.solver->system(), {before, after}, there.point.modes);
        Eigen::Index most = 0;
        alike.score.colwise().sum().maxCoeff(&most);
        return std::pair(std::move(entry(there.point.modes, most).mode), there.point.rotor_speed);
    };
    StabilityLimit limit{.kind = Instability::flutter,
                         .begins = second > 0,
                         .name = branch.name,
                         .doubtful = branch.doubtful[i] || branch.doubtful[i + 1]};
    limit.parameter = root([&](double parameter) { return excess(between(parameter).first); }, i, first, second);
    const auto [mode, speed] = between(limit.parameter);
    limit.eigenvalue = mode.eigenvalue;
    limit.rotor_speed = speed;
    found_.limits.push_back(std::move(limit));
}

// A pair of complex roots may become two real ones, of which both are negative, or the other way round: nothing passes
// through zero then.
bool LimitSearch::is_continuous(int k, double parameter, std::size_t i) {
    constexpr double small = 1e-5;
    const double beside = 10 * options_.tolerance * width_;
    const double low = std::max(parameter - beside, parameters_[i]),
                 high = std::min(parameter + beside, parameters_[i + 1]);
    return std::abs(static_root(certain_probe(high).roots, k) - static_root(certain_probe(low).roots, k)) < small;
}

void LimitSearch::add_divergence(double parameter, bool begins) {
    const Probe there = certain_probe(parameter);
    StabilityLimit limit{.kind = Instability::divergence,
                         .begins = begins,
                         .parameter = parameter,
                         .rotor_speed = there.point.rotor_speed};
    const auto nearest = std::ranges::min_element(there.roots.values, {}, [](double value) { return std::abs(value); });
    if (nearest != there.roots.values.end())
        limit.name =
            static_name(*there.solver, there.roots, static_cast<int>(nearest - there.roots.values.begin()), rows_);
    found_.limits.push_back(std::move(limit));
}

void LimitSearch::find_divergence(std::size_t i) {
    const int before = number_below_zero(roots_[i]), after = number_below_zero(roots_[i + 1]);
    int found = 0;
    for (int k = std::min(before, after); k < std::max(before, after); ++k) {
        const double parameter = root([&](double at) { return static_root(certain_probe(at).roots, k); }, i,
                                      static_root(roots_[i], k), static_root(roots_[i + 1], k));
        if (!is_continuous(k, parameter, i)) continue;
        add_divergence(parameter, after > before);
        ++found;
    }
    const double first = roots_[i].product, second = roots_[i + 1].product;
    const bool another = (first > 0) != (second > 0) && found % 2 == 0;
    if (another)
        add_divergence(root([&](double at) { return certain_probe(at).roots.product; }, i, first, second),
                       after == before ? first > 0 : after > before);
}

// What has no limit of its own in the range.
void LimitSearch::note_growth() {
    const Campbell& diagram = found_.diagram;
    const auto grows = [&](const Branch& branch, std::size_t i) {
        const CampbellMode* mode = diagram.mode(branch, i);
        return mode && vibrates(*mode) && excess(mode->mode) > 0;
    };
    for (std::size_t i = 0; i < parameters_.size(); ++i)
        for (const Branch& branch : diagram.branches) {
            if (!grows(branch, i)) continue;
            if (i == 0)
                add_note(found_.note, text(branch.name, " grows at ", at(parameters_[0]), " already"));
            else if (!diagram.mode(branch, i - 1))
                add_note(found_.note, text(branch.name, " grows at ", at(parameters_[i]), ", where it is first found"));
            if (i + 1 < parameters_.size() && !diagram.mode(branch, i + 1))
                add_note(found_.note, text(branch.name, ", which grows, is lost beyond ", at(parameters_[i])));
        }
    if (number_below_zero(roots_[0]) > 0)
        add_note(found_.note, text("the machine diverges at ", at(parameters_[0]), " already"));
}

void LimitSearch::find_limits() {
    try {
        for (std::size_t i = 0; i + 1 < parameters_.size(); ++i) {
            for (const Branch& branch : found_.diagram.branches) find_flutter(branch, i);
            find_divergence(i);
        }
    } catch (const NumericalError& error) {
        add_note(found_.note, text("not all limits were found: ", error.what()));
        found_.diagram.complete = false;
    }
    std::ranges::stable_sort(found_.limits, {}, &StabilityLimit::parameter);
}

StabilityLimits LimitSearch::run(double from, double to) {
    width_ = to - from;
    follow_all(from, to);
    if (parameters_.empty()) {
        found_.diagram.complete = false;
        return std::move(found_);
    }
    std::vector<const PointMethod*> solvers;
    for (const auto& solver : solvers_) solvers.push_back(solver.get());
    found_.diagram = sweep_.finish(rotor_, solvers);
    found_.diagram.complete = parameters_.back() == to;
    if (!parameter_.empty()) found_.diagram.parameters = parameters_;
    note_growth();
    find_limits();
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
