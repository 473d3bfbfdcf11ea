// Events: when a function of the state changes its sign.
#include "mbs/model/free_body.hpp"
#include "solvers/time/detail/stepper.hpp"
#include "solvers/time/integrate.hpp"

#include <cmath>

namespace cardan::solvers {

namespace {

int sign(double value) {
    return (value > 0) - (value < 0);
}

}  // namespace

double Integrator::event_value(std::size_t event, double time) {
    const Event& own = options_.events[event];
    double value = 0;
    if (own.of_state) {
        if (!equations_.complete(time, x_between_.data(), between_))
            throw NumericalError(
                text(in_integration, ": no state for the event '", own.name, "': ", equations_.problem()));
        value = own.of_state(between_);
    } else {
        value = equations_.evaluate(own.function, time, x_between_.data());
    }
    if (!std::isfinite(value))
        throw NumericalError(
            text(in_integration, ": the function of the event '", own.name, "' at ", time, " s is ", value));
    return value;
}

bool Integrator::due(std::size_t event) const {
    const int now = sign(values_[event]), before = sides_[event], direction = options_.events[event].direction;
    return before != 0 && now != before && (direction == 0 || direction == -before);
}

// Events due at the same time as the one handled keep their sign and come next.
void Integrator::set_sides(int happened) {
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        const bool own = static_cast<int>(i) == happened;
        if (own && sign(values_[i]) == 0)
            sides_[i] = 0;  // it has happened; its side will be the one it leaves zero to
        else if (sign(values_[i]) != 0 && (own || !due(i)))
            sides_[i] = sign(values_[i]);
    }
}

// Where the function has just changed its sign, by halving and false position in turn.
double Integrator::root(std::size_t event, double to) {
    double a = state_.time, b = to, value_b = values_[event];
    state_at(a, x_between_);
    double value_a = event_value(event, a);
    if (sign(value_a) == sign(value_b)) return a;  // it was due at the start already
    for (int i = 0; i < 200 && b - a > resolution(b); ++i) {
        const double secant = a + (b - a) * value_a / (value_a - value_b);
        const double trial = i % 3 != 2 && secant > a && secant < b ? secant : a + (b - a) / 2;
        state_at(trial, x_between_);
        const double value = event_value(event, trial);
        if (sign(value) == sides_[event]) {
            a = trial;
            value_a = value;
        } else {
            b = trial;
            value_b = value;
        }
    }
    return b;
}

// The first event until `to`, or -1.
int Integrator::first_event(double to, double& at) {
    int first = -1;
    at = to;
    state_at(to, x_between_);
    for (std::size_t i = 0; i < sides_.size(); ++i) values_[i] = event_value(i, to);
    for (std::size_t i = 0; i < sides_.size(); ++i) {
        if (!due(i)) continue;
        if (const double when = root(i, to); first < 0 || when < at) {
            first = static_cast<int>(i);
            at = when;
        }
    }
    return first;
}

// Their hinges are singular where the second one stands at a right angle: at 60 degrees they are turned anew.
void Integrator::watch_free_bodies() {
    for (const Model::Free& body : equations_.model().free_bodies())
        options_.events.push_back(
            {.name = text("coordinates of '", body.name, "'"),
             .function = [&body](const StateView& at) { return free_chart_quality(body, at.q) - 0.5; },
             .direction = -1,
             .action =
                 [&body](Integrator& run) {
                     run.turn_reference(body);
                     return AfterEvent::restart;
                 }});
}

void Integrator::turn_reference(const Model::Free& body) {
    Vector q = state_.q, qd = state_.qd;
    set_free_motion(body, free_motion(body, q, qd), q, qd);
    equations_.set_jump(body.reference, Motion::constant(q(body.reference)));
    positions_(body.reference) = q(body.reference);
    set_state(q, qd);
}

}  // namespace cardan::solvers
