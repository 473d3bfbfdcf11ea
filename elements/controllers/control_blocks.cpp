#include "elements/controllers/control_blocks.hpp"

#include "mbs/base/error.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace cardan {

namespace {

using Gradient = std::array<double, ControlSignal::max_sources>;

StateInfo state_of(const BlockName& name, StateKind kind = StateKind::lag) {
    return {.name = name.name,
            .unit = name.unit,
            .scale = name.scale,
            .initial = name.initial,
            .part = name.part,
            .blade = name.blade,
            .kind = kind};
}

StateInfo rate_of(const BlockName& name, double per_second) {
    StateInfo rate = state_of(name);
    rate.name += " rate";
    rate.unit += "/s";
    rate.scale *= per_second;
    rate.initial = 0;
    return rate;
}

std::string where(const char* what, const BlockName& name) {
    return text(what, " '", name.name, "'");
}

// Motion of an actuator's state towards a limited demand, with its derivatives by own states and by the demand.
struct Follower {
    Actuator own;
    ControlWire demand;

    bool first_order() const { return own.time_constant > 0; }
    struct Rate {
        double value, by_p, by_v, by_demand;
    };
    // p'
    Rate rate(const ElementView& in, double wanted) const {
        if (first_order()) {
            const ControlSignal::Point target = own.positions(wanted),
                                       limited = own.rates((target.value - in.s(0)) / own.time_constant);
            const double slope = limited.slope / own.time_constant;
            return {limited.value, -slope, 0, slope * target.slope};
        }
        const ControlSignal::Point limited = own.rates(in.s(1));
        return {limited.value, 0, limited.slope, 0};
    }
    // v' of second order
    Rate acceleration(const ElementView& in, double wanted) const {
        const ControlSignal::Point target = own.positions(wanted);
        const double w = own.frequency, c = 2 * own.damping * w;
        return {w * w * (target.value - in.s(0)) - c * in.s(1), -w * w, -c, w * w * target.slope};
    }
    void rates(const ElementView& in, VectorOut& f) const {
        Gradient gradient;
        const double wanted = demand.value(in, gradient);
        f(0) = rate(in, wanted).value;
        if (!first_order()) f(1) = acceleration(in, wanted).value;
    }
    void jacobian(const ElementView& in, ElementJacobian& d) const {
        Gradient gradient;
        const double wanted = demand.value(in, gradient);
        const auto add = [&](Eigen::Index row, const Rate& rate) {
            d.f_s(row, 0) += rate.by_p;
            if (!first_order()) d.f_s(row, 1) += rate.by_v;
            demand.add_to_f(d, row, rate.by_demand, gradient);
        };
        add(0, rate(in, wanted));
        if (!first_order()) add(1, acceleration(in, wanted));
    }
};

void check(const Actuator& block) {
    const std::string here = where("actuator", block.name);
    block.positions.check(here, "position");
    block.rates.check(here, "rate");
    if (block.time_constant != 0) return require_positive(here, "time constant [s]", block.time_constant);
    require_positive(here, "frequency [rad/s], without a time constant", block.frequency);
    require_positive(here, "damping ratio", block.damping);
}

ForceElement states_of(const Actuator& block) {
    check(block);
    ForceElement element{.name = block.name.name, .states = {state_of(block.name)}};
    if (block.time_constant == 0) element.states.push_back(rate_of(block.name, block.frequency));
    return element;
}

}  // namespace

ControlBlock low_pass(const LowPass& block) {
    require_positive(where("low pass", block.name), "time constant [s]", block.time_constant);
    ForceElement element{.name = block.name.name, .states = {state_of(block.name)}};
    const ControlWire input(block.input, element);
    const double tau = block.time_constant;
    element.evaluate = [input, tau](const ElementView& in, ElementForces& out) {
        Gradient gradient;
        out.f(0) = (input.value(in, gradient) - in.s(0)) / tau;
    };
    element.jacobian = [input, tau](const ElementView& in, ElementJacobian& d) {
        Gradient gradient;
        (void)input.value(in, gradient);
        d.f_s(0, 0) -= 1 / tau;
        input.add_to_f(d, 0, 1 / tau, gradient);
    };
    return {std::move(element), signal::state(block.name.name)};
}

ControlBlock integral(const Integral& block) {
    ForceElement element{.name = block.name.name, .states = {state_of(block.name, StateKind::integrator)}};
    const ControlWire input(block.input, element);
    element.evaluate = [input](const ElementView& in, ElementForces& out) {
        Gradient gradient;
        out.f(0) = input.value(in, gradient);
    };
    element.jacobian = [input](const ElementView& in, ElementJacobian& d) {
        Gradient gradient;
        (void)input.value(in, gradient);
        input.add_to_f(d, 0, 1, gradient);
    };
    return {std::move(element), signal::state(block.name.name)};
}

ControlBlock second_order_filter(const SecondOrderFilter& block) {
    const std::string here = where("filter", block.name);
    require_positive(here, "frequency [rad/s]", block.frequency);
    require_positive(here, "damping ratio", block.damping);
    const double w = block.frequency, c = 2 * block.damping * w;
    ForceElement element{.name = block.name.name, .states = {state_of(block.name), rate_of(block.name, w)}};
    const ControlWire input(block.input, element);
    element.evaluate = [=](const ElementView& in, ElementForces& out) {
        Gradient gradient;
        out.f(0) = in.s(1);
        out.f(1) = w * w * (input.value(in, gradient) - in.s(0)) - c * in.s(1);
    };
    element.jacobian = [=](const ElementView& in, ElementJacobian& d) {
        Gradient gradient;
        (void)input.value(in, gradient);
        d.f_s(0, 1) += 1;
        d.f_s(1, 0) -= w * w;
        d.f_s(1, 1) -= c;
        input.add_to_f(d, 1, w * w, gradient);
    };
    const std::string rate = element.states[1].name;
    ControlSignal output = block.band_pass ? (c / (w * w)) * signal::state(rate) : signal::state(block.name.name);
    return {std::move(element), std::move(output)};
}

ControlBlock pi_controller(const PiController& block) {
    const std::string here = where("PI controller", block.name);
    require_positive(here, "time of unwinding [s]", block.unwinding);
    block.limits.check(here, "output");
    const ControlSignal wanted = block.gain * (block.proportional * block.error) + signal::state(block.name.name),
                        output = wanted.through(block.limits);
    const double back = 1 / block.unwinding;
    const ControlSignal change = block.gain * (block.integral * block.error) + back * (output - wanted);
    return {integral({block.name, change}).element, output};
}

ControlBlock actuator(const Actuator& block) {
    ForceElement element = states_of(block);
    const ControlWire demand(block.demand, element);
    const Follower follower{block, demand};
    element.evaluate = [follower](const ElementView& in, ElementForces& out) { follower.rates(in, out.f); };
    element.jacobian = [follower](const ElementView& in, ElementJacobian& d) { follower.jacobian(in, d); };
    return {std::move(element), signal::state(block.name.name)};
}

ControlBlock position_actuator(const Actuator& block, BodyId coordinate, double stiffness, double drive_damping,
                               double sense, double zero) {
    const std::string here = where("actuator", block.name);
    require_positive(here, "stiffness of the drive", stiffness);
    require_not_negative(here, "damping of the drive", drive_damping);
    if (sense != 1 && sense != -1) throw InputError(here, "sense", sense, "1 or -1");
    if (!std::isfinite(zero)) throw InputError(here, "position at the coordinate's zero", zero, "finite");
    ForceElement element = states_of(block);
    element.coordinates = {coordinate};
    const ControlWire demand(block.demand, element);
    const Follower follower{block, demand};
    const double k = stiffness, c = drive_damping;
    element.evaluate = [=](const ElementView& in, ElementForces& out) {
        follower.rates(in, out.f);
        out.Q(0) = -k * (in.q(0) - sense * (in.s(0) - zero)) - c * (in.qd(0) - sense * out.f(0));
    };
    element.jacobian = [=](const ElementView& in, ElementJacobian& d) {
        follower.jacobian(in, d);
        Gradient gradient;
        const Follower::Rate rate = follower.rate(in, demand.value(in, gradient));
        d.Q_q(0, 0) -= k;
        d.Q_qd(0, 0) -= c;
        d.Q_s(0, 0) += sense * (k + c * rate.by_p);
        if (!follower.first_order()) d.Q_s(0, 1) += sense * c * rate.by_v;
        demand.add_to_Q(d, 0, sense * c * rate.by_demand, gradient);
    };
    // What the spring holds, what the motor puts in behind it, what the damper takes.
    element.power = [=](const ElementView& in) {
        Gradient gradient;
        const double stretch = in.q(0) - sense * (in.s(0) - zero),
                     rate = sense * follower.rate(in, demand.value(in, gradient)).value, slip = in.qd(0) - rate,
                     force = -k * stretch - c * slip;
        return ElementPower{k * stretch * stretch / 2, force * rate, c * slip * slip};
    };
    return {std::move(element), signal::state(block.name.name)};
}

ControlBlock force_actuator(const Actuator& block, BodyId coordinate, double factor) {
    ForceElement element = states_of(block);
    element.coordinates = {coordinate};
    const Follower follower{block, ControlWire(block.demand, element)};
    element.evaluate = [=](const ElementView& in, ElementForces& out) {
        follower.rates(in, out.f);
        out.Q(0) = factor * in.s(0);
    };
    element.jacobian = [=](const ElementView& in, ElementJacobian& d) {
        follower.jacobian(in, d);
        d.Q_s(0, 0) += factor;
    };
    return {std::move(element), signal::state(block.name.name)};
}

ForceElement signal_force(std::string name, const ControlSignal& signal, BodyId coordinate, double factor) {
    ForceElement element{.name = std::move(name), .coordinates = {coordinate}};
    const ControlWire wire(signal, element);
    element.evaluate = [wire, factor](const ElementView& in, ElementForces& out) {
        Gradient gradient;
        out.Q(0) = factor * wire.value(in, gradient);
    };
    element.jacobian = [wire, factor](const ElementView& in, ElementJacobian& d) {
        Gradient gradient;
        (void)wire.value(in, gradient);
        wire.add_to_Q(d, 0, factor, gradient);
    };
    return element;
}

}  // namespace cardan
