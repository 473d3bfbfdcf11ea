#include "solvers/time/integrate.hpp"

#include "mbs/base/entry.hpp"
#include "solvers/time/detail/stepper.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace cardan::solvers {

namespace {

constexpr int watched_steps = 1000;
constexpr double never = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

std::unique_ptr<Stepper> make_stepper(EquationsOfMotion& equations, const IntegrationOptions& options) {
    switch (options.method) {
        case Method::bdf:
        case Method::adams:
            return make_cvode_stepper(equations, options);
        case Method::dirk:
        case Method::erk:
            return make_arkode_stepper(equations, options);
        case Method::generalised_alpha:
            break;
    }
    return make_alpha_stepper(equations, options);
}

}  // namespace

class Integrator::While {
public:
    While(Doing& doing, Doing now) : doing_(doing), before_(std::exchange(doing, now)) {}
    ~While() { doing_ = before_; }
    While(const While&) = delete;
    While& operator=(const While&) = delete;

private:
    Doing& doing_;
    Doing before_;
};

Integrator::Integrator(const System& system, std::vector<Drive> drives, double time, const Vector& q, const Vector& qd,
                       IntegrationOptions options)
    : options_(std::move(options)),
      equations_(system, with_followers(std::move(drives), options_.controllers, q), time, q, qd),
      controllers_(options_.controllers, system.forces.inputs(), q, time),
      workspace_(system.model) {
    watch_free_bodies();
    check_options(time);
    const Eigen::Index m = equations_.size();
    if (equations_.length() == 0) throw InputError(in_integration, "number of free coordinates and states", 0, ">= 1");
    x_.resize(equations_.length());
    x_between_.resize(x_.size());
    x_.tail(equations_.states()) = states_at_start();
    for (Eigen::Index i = 0; i < m; ++i) {
        x_(i) = q(entry(equations_.unknowns(), i));
        x_(m + i) = qd(entry(equations_.unknowns(), i));
    }
    if (!equations_.project(time, x_.data()))
        throw InputError(in_integration, "start", equations_.problem(), "one that the loops allow: see close_rates()");
    equations_.require_closed_rates(time, x_.data());
    stepper_ = make_stepper(equations_, options_);
    values_.resize(options_.events.size());
    sides_.resize(options_.events.size());
    state_.time = time;
    since_ = moved_ = time;
    positions_ = q;
    for (Vector* v : {&seen_end_, &now_}) v->setZero(equations_.rates());
    find_breaks();
    begin_piece();
    if (!equations_.complete(time, x_.data(), state_))
        throw NumericalError(text(in_integration, ": no start: ", equations_.problem()));
    kinetic_at_start_ = equations_.kinetic_energy(state_);
    potential_at_start_ = equations_.potential_energy(state_);
    stored_at_start_ = equations_.stored_energy(state_);
    x_between_ = x_;
    for (std::size_t i = 0; i < sides_.size(); ++i) values_[i] = event_value(i, time);
    set_sides(-1);
}

Integrator::~Integrator() = default;

void Integrator::find_breaks() {
    breaks_ = equations_.breaks();
    breaks_.insert(breaks_.end(), options_.breaks.begin(), options_.breaks.end());
    std::sort(breaks_.begin(), breaks_.end());
}

// From now to the next break.
void Integrator::begin_piece() {
    const double now = state_.time;
    const auto next = std::upper_bound(breaks_.begin(), breaks_.end(), now + resolution(now));
    const double end = next == breaks_.end() ? infinity : *next;
    piece_end_ = std::min(end, controllers_.next());
    equations_.set_piece(next == breaks_.end() ? now + 1 : (now + end) / 2);
    start_pending_ = true;
    go_on_pending_ = repeat_pending_ = false;
}

// Within the last step, with loops closed: interpolation leaves them open by the error of the method.
void Integrator::state_at(double time, Vector& x) {
    stepper_->state_at(time, x.data());
    if (!equations_.project(time, x.data())) throw NoState(text(in_integration, ": ", equations_.problem()));
}

bool Integrator::sample_due() const {
    return controllers_.next() <= state_.time + resolution(state_.time);
}

// A break, or the time of a sample, or both.
void Integrator::pass_piece_end() {
    const double now = state_.time;
    const bool was_running = !start_pending_;
    if (sample_due()) {
        if (!equations_.complete(now, x_.data(), state_))
            throw NumericalError(text(in_integration, ": no forces at ", now, " s: ", equations_.problem()));
        u_ = equations_.inputs();
        controllers_.run({state_, kinematics(model(), state_.q, workspace_), equations_.forces(), loops()},
                         resolution(now), u_,
                         [&](Drive drive) { equations_.set_motion(drive.coordinate, std::move(drive.motion), now); });
        equations_.set_inputs(u_);
    }
    begin_piece();
    if (!was_running) return;
    start_pending_ = false;
    go_on_pending_ = true;
}

void Integrator::complete(Advance& result) {
    result.time = state_.time;
    if (equations_.complete(state_.time, x_.data(), state_)) return;
    if (result.end == Advance::End::failed) return;
    result.end = Advance::End::failed;
    result.message = text("no forces at ", state_.time, " s: ", equations_.problem());
}

AfterEvent Integrator::act(int event) {
    const Event& happened = entry(options_.events, event);
    if (!equations_.complete(state_.time, x_.data(), state_))
        throw NumericalError(
            text(in_integration, ": no state at the event '", happened.name, "': ", equations_.problem()));
    const While acting(doing_, Doing::acting);
    return happened.action ? happened.action(*this) : AfterEvent::stop;
}

// From the present time to one within the last step. False: an event stops here.
bool Integrator::process(double to, Advance& result) {
    double at = to;
    const int event = sides_.empty() ? -1 : first_event(to, at);
    if (!accumulate(at)) {
        result.end = Advance::End::failed;
        result.message = text("no forces within the last step: ", equations_.problem());
        return false;
    }
    state_at(at, x_between_);
    x_ = x_between_;
    equations_.positions(at, x_.data(), state_);
    if (sides_.empty()) return true;
    if (event >= 0 && at < to) {
        for (std::size_t i = 0; i < sides_.size(); ++i) values_[i] = event_value(i, at);
    }
    // An action that throws is repeated when the run continues.
    AfterEvent after = event < 0 ? AfterEvent::proceed : act(event);
    set_sides(event);
    if (event < 0) return true;
    if (after == AfterEvent::proceed && accelerations_changed()) after = AfterEvent::restart;
    if (after != AfterEvent::proceed) begin_piece();
    if (after != AfterEvent::stop) return true;
    result.end = Advance::End::event;
    result.event = entry(options_.events, event).name;
    return false;
}

// Those at the end of the step, once for each step that outputs lie in.
void Integrator::note_accelerations() {
    const double end = stepper_->time();
    if (start_pending_ || go_on_pending_ || !(end > state_.time) || end == seen_at_) return;
    state_at(end, x_between_);
    if (equations_.accelerations(end, x_between_.data(), seen_end_.data())) seen_at_ = end;
}

// Have forces changed since the present state was completed, or since the method has stepped beyond it?
bool Integrator::accelerations_changed() {
    if (start_pending_ || go_on_pending_) return false;
    if (!equations_.accelerations(state_.time, x_.data(), now_.data())) return true;
    const Eigen::Index m = equations_.size();
    for (Eigen::Index i = 0; i < m; ++i)
        if (now_(i) != state_.qdd(entry(equations_.unknowns(), i))) return true;
    if (now_.tail(equations_.states()) != state_.s_rate) return true;
    if (seen_at_ != stepper_->time() || seen_at_ <= state_.time) return false;
    state_at(seen_at_, x_between_);
    return !equations_.accelerations(seen_at_, x_between_.data(), now_.data()) || now_ != seen_end_;
}

// A stall: tiny steps in succession.
bool Integrator::stands_still(double horizon) {
    if (++steps_ < watched_steps) return false;
    const double now = stepper_->time(), shortest = shortest_step(now, horizon - now);
    const bool still = now - moved_ < watched_steps * shortest;
    steps_ = 0;
    moved_ = stepper_->time();
    return still;
}

// One step of the method.  False: it ends here.
bool Integrator::take_step(double horizon, Advance& result) {
    if (options_.cancelled && options_.cancelled()) {
        result.end = Advance::End::cancelled;
        return false;
    }
    if (start_pending_ || go_on_pending_) {
        if (start_pending_) {
            stepper_->start(state_.time, x_.data(), piece_end_);
            ++starts_;
        } else if (!stepper_->go_on(state_.time, x_.data(), piece_end_)) {
            ++starts_;
        }
        start_pending_ = go_on_pending_ = false;
        seen_at_ = never;
    }
    const bool done = stepper_->step(horizon), still = done && stands_still(horizon);
    if (done && !still) {
        if (options_.progress) options_.progress(stepper_->time(), statistics());
        return true;
    }
    result.end = Advance::End::failed;
    result.message =
        !done ? stepper_->failure()
              : text("no progress at ", state_.time, " s: ", watched_steps, " steps in less than ",
                     watched_steps * shortest_step(state_.time, horizon - state_.time),
                     " s; look for forces or stiffnesses that are far too large, or take an implicit method");
    start_pending_ = true;
    return false;
}

Advance Integrator::advance(double target, bool one_step) try {
    const While advancing(doing_, Doing::advancing);
    Advance result;
    try {
        advance_until(target, one_step, result);
    } catch (const NoState& none) {
        start_pending_ = true;
        result.end = Advance::End::failed;
        result.message = none.what();
    }
    complete(result);
    return result;
} catch (...) {
    start_pending_ = true;  // the method may have been left in the middle of a step
    throw;
}

void Integrator::advance_until(double target, bool one_step, Advance& result) {
    if (repeat_pending_)
        repeat_steps();
    else if (accelerations_changed())
        begin_piece();
    bool stepped = false;
    while (one_step ? !stepped : state_.time < target) {
        if (state_.time >= piece_end_ || sample_due()) pass_piece_end();
        if ((start_pending_ || go_on_pending_ || stepper_->time() <= state_.time) &&
            !take_step(one_step ? infinity : target, result))
            break;
        stepped = true;
        if (!process(one_step ? stepper_->time() : std::min(target, stepper_->time()), result)) break;
    }
    note_accelerations();
}

void Integrator::check_allowed(const char* what, Doing latest) const {
    if (doing_ <= latest) return;
    throw InputError(in_integration, what,
                     doing_ == Doing::acting ? "called in the action of an event" : "called within advance()",
                     latest == Doing::nothing ? "after advance() has returned; an action may stop it"
                                              : "between two calls of advance(), or in the action of an event");
}

Advance Integrator::advance(double time) {
    check_allowed("advance()", Doing::nothing);
    if (!std::isfinite(time) || time < state_.time)
        throw InputError(in_integration, "time to advance to [s]", time, text("finite and >= ", state_.time));
    return advance(time, false);
}

Advance Integrator::step() {
    check_allowed("step()", Doing::nothing);
    return advance(infinity, true);
}

Advance Integrator::run(const std::vector<double>& times, const std::function<void(Integrator&)>& output) {
    check_allowed("run()", Doing::nothing);
    Advance result;
    result.time = state_.time;
    for (double time : times) {
        result = advance(time);
        if (!result.reached()) break;
        if (output) output(*this);
    }
    return result;
}

void Integrator::set_motion(int coordinate, Motion motion) {
    check_allowed("set_motion()", Doing::acting);
    equations_.set_motion(coordinate, std::move(motion), state_.time);
    find_breaks();
    begin_piece();
}

void Integrator::set_forces(const Forces* forces) {
    check_allowed("set_forces()", Doing::acting);
    equations_.set_forces(forces);
    find_breaks();
    begin_piece();
}

void Integrator::set_state(const Vector& q, const Vector& qd) {
    check_allowed("set_state()", Doing::acting);
    for (const Vector* v : {&q, &qd}) {
        require_size(in_integration, "new state", *v, model().size());
        if (!v->allFinite()) throw InputError(in_integration, "new state", "not finite", "finite");
    }
    Vector x = x_;
    const Eigen::Index m = equations_.size();
    for (Eigen::Index i = 0; i < m; ++i) {
        x(i) = q(entry(equations_.unknowns(), i));
        x(m + i) = qd(entry(equations_.unknowns(), i));
    }
    DynamicState now = state_;
    if (!equations_.project(state_.time, x.data()) || !equations_.complete(state_.time, x.data(), now))
        throw InputError(in_integration, "new state", equations_.problem(), "one that the loops allow");
    work_.forces += equations_.kinetic_energy(now) - equations_.kinetic_energy(state_);
    x_ = x_between_ = x;
    state_ = now;
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = event_value(i, state_.time);
    begin_piece();
}

void Integrator::update() {
    check_allowed("update()", Doing::acting);
    if (!equations_.complete(state_.time, x_.data(), state_))
        throw NumericalError(text(in_integration, ": no forces at ", state_.time, " s: ", equations_.problem()));
}

void Integrator::restart() {
    check_allowed("restart()", Doing::acting);
    begin_piece();
}

}  // namespace cardan::solvers
