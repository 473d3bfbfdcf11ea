#include "elements/electric/synchronous_generator.hpp"

#include "elements/electric/detail/law.hpp"
#include "elements/electric/detail/phasor.hpp"
#include "elements/machine_elements/gear_ratio.hpp"
#include "mbs/base/error.hpp"

#include <cmath>
#include <utility>

namespace cardan {

namespace {

using detail::LawInput;
using detail::Phasor;

// A function with its slope, for a number whose imaginary part carries a derivative.
double applied(const SoftLimits& limits, double x) {
    return limits(x).value;
}
Complex applied(const SoftLimits& limits, Complex x) {
    const ControlSignal::Point at = limits(x.real());
    return {at.value, at.slope * x.imag()};
}
double real(double x) {
    return x;
}
double real(Complex x) {
    return x.real();
}

struct SynchronousLaw {
    PermanentMagnetMachine machine;
    DcLink link;
    Grid grid;
    double gear_ratio, bandwidth, lag;
    SoftLimits limits;

    enum State : std::uint8_t { flux_d, flux_q, converter_d, converter_q, voltage, control, grid_current };

    double grid_voltage(double time) const {
        if (!grid.connected(time)) return 0;
        const std::array<double, 2> v = grid.voltage(time);
        return std::hypot(v[0], v[1]);
    }
    // Gains of the control of the link: C u du/dt = ... - 1.5 V i_g about the nominal voltages.
    double gain() const { return link.capacitance * link.voltage / (1.5 * grid.peak()); }
    double proportional() const { return 2 * 0.7 * link.bandwidth * gain(); }
    double integral() const { return link.bandwidth * link.bandwidth * gain(); }

    template <class S>
    struct Point {
        Phasor<S> current, voltage;
        S speed{}, demand{};  // electrical, rad/s; of the current across the magnets, A
        S torque{}, machine_power{}, grid_power{}, chopper_power{}, wanted{}, delivered{};
    };
    template <class S>
    S chopper_power(const S& u) const {
        if (link.chopper == 0) return S(0);
        const S x = (u / link.voltage - link.chopper_voltage) / 0.05;
        const S share = real(x) <= 0 ? S(0) : real(x) >= 1 ? S(1) : x * x * (3.0 - 2.0 * x);
        return share * u * u / link.chopper;
    }
    template <class S>
    Point<S> at(const LawInput<S>& in) const {
        const PermanentMagnetMachine& m = machine;
        Point<S> out;
        out.current = {in.s[flux_d] / m.inductance_d, in.s[flux_q] / m.inductance_q};
        out.speed = m.pole_pairs * gear_ratio * in.qd[0];
        out.demand = -in.demands[0] / (1.5 * m.pole_pairs * m.magnet_flux);
        const S along = in.s[flux_d] + m.magnet_flux;
        out.voltage = {
            bandwidth * m.inductance_d * -out.current.d + in.s[converter_d] - out.speed * in.s[flux_q],
            bandwidth * m.inductance_q * (out.demand - out.current.q) + in.s[converter_q] + out.speed * along};
        out.torque = -1.5 * m.pole_pairs * (along * out.current.q - in.s[flux_q] * out.current.d);
        out.machine_power = -1.5 * dot(out.voltage, out.current);
        out.grid_power = 1.5 * grid_voltage(in.time) * in.s[grid_current];
        out.chopper_power = chopper_power(in.s[voltage]);
        out.wanted = proportional() * (in.s[voltage] - link.voltage) + in.s[control];
        out.delivered = applied(limits, out.wanted);
        return out;
    }
    template <class S>
    void operator()(const LawInput<S>& in, S* Q, S* f) const {
        const PermanentMagnetMachine& m = machine;
        const Point<S> now = at(in);
        Q[0] = -gear_ratio * now.torque;
        f[flux_d] = now.voltage.d - m.resistance * now.current.d + now.speed * in.s[flux_q];
        f[flux_q] = now.voltage.q - m.resistance * now.current.q - now.speed * (in.s[flux_d] + m.magnet_flux);
        f[converter_d] = bandwidth * m.resistance * -now.current.d;
        f[converter_q] = bandwidth * m.resistance * (now.demand - now.current.q);
        f[voltage] = (now.machine_power - now.grid_power - now.chopper_power) / (link.capacitance * in.s[voltage]);
        f[control] = integral() * (in.s[voltage] - link.voltage) + link.bandwidth * (now.delivered - now.wanted);
        f[grid_current] = (now.delivered - in.s[grid_current]) / lag;
    }
    ElementPower power(const LawInput<double>& in) const {
        const Point<double> now = at(in);
        const double u = in.s[voltage];
        return {.stored =
                    0.75 * (in.s[flux_d] * now.current.d + in.s[flux_q] * now.current.q) + link.capacitance * u * u / 2,
                .supplied = -now.grid_power,
                .dissipated = 1.5 * machine.resistance * dot(now.current, now.current) + now.chopper_power};
    }
};

void check(const SynchronousGenerator& generator) {
    const std::string& name = generator.name;
    if (name.empty()) throw InputError("electric machine: the name is missing");
    require_gear_ratio(name, generator.gear_ratio);
    if (generator.machine.pole_pairs < 1)
        throw InputError(name, "number of pole pairs", generator.machine.pole_pairs, ">= 1");
    require_not_negative(name, "resistance [ohm]", generator.machine.resistance);
    require_positive(name, "inductance of axis d [H]", generator.machine.inductance_d);
    require_positive(name, "inductance of axis q [H]", generator.machine.inductance_q);
    require_positive(name, "flux of the magnets [V s]", generator.machine.magnet_flux);
    require_positive(name, "voltage of the DC link [V]", generator.link.voltage);
    require_positive(name, "capacitance of the DC link [F]", generator.link.capacitance);
    require_positive(name, "bandwidth of the DC link [rad/s]", generator.link.bandwidth);
    require_not_negative(name, "resistance of the chopper [ohm]", generator.link.chopper);
    if (!(generator.link.chopper_voltage > 1))
        throw InputError(name, "voltage at which the chopper begins, over that of the link",
                         generator.link.chopper_voltage, "> 1");
    require_positive(name, "bandwidth of the currents [rad/s]", generator.bandwidth);
    require_positive(name, "limit of the current on the grid's side [A]", generator.current_limit);
    require_positive(name, "lag of the current on the grid's side [s]", generator.current_lag);
    generator.grid.check(name);
}

SynchronousLaw law_of(const SynchronousGenerator& generator) {
    return {generator.machine,
            generator.link,
            generator.grid,
            generator.gear_ratio,
            generator.bandwidth,
            generator.current_lag,
            {.lower = -generator.current_limit, .upper = generator.current_limit}};
}

}  // namespace

ForceElement synchronous_generator(const SynchronousGenerator& generator) {
    check(generator);
    const PermanentMagnetMachine& m = generator.machine;
    const double peak = generator.grid.peak(),
                 current = -generator.running_torque / (1.5 * m.pole_pairs * m.magnet_flux),
                 delivered =
                     (generator.running_torque * generator.running_speed - 1.5 * m.resistance * current * current) /
                     (1.5 * peak);
    if (std::abs(delivered) > generator.current_limit)
        throw InputError(generator.name, "current on the grid's side at the start [A]", delivered,
                         text("at most the limit, ", generator.current_limit));
    ForceElement element{.name = generator.name, .coordinates = {generator.shaft}};
    const auto state = [&](const char* what, const char* unit, double scale, double initial) {
        element.states.push_back({.name = text(generator.name, " ", what),
                                  .unit = unit,
                                  .scale = scale,
                                  .initial = initial,
                                  .part = "generator"});
    };
    const double drop = generator.link.voltage / 20;
    state("flux d", "V s", m.magnet_flux, 0);
    state("flux q", "V s", m.magnet_flux, m.inductance_q * current);
    state("converter d", "V", drop, 0);
    state("converter q", "V", drop, m.resistance * current);
    state("link voltage", "V", generator.link.voltage, generator.link.voltage);
    state("link control", "A", generator.current_limit, delivered);
    state("grid current", "A", generator.current_limit, delivered);
    element.breaks = generator.grid.all_breaks();
    detail::set_law(element, law_of(generator), {generator.torque});
    return element;
}

ChannelGroup synchronous_generator_channels(const SynchronousGenerator& generator) {
    ChannelGroup group;
    const auto channel = [&](const char* what, const char* units, const char* long_name, std::string alias = {}) {
        group.channels.push_back({.name = text(generator.name, " ", what),
                                  .units = units,
                                  .long_name = long_name,
                                  .alias = std::move(alias)});
    };
    channel("torque", "N m", "electromagnetic torque of the generator on its generator shaft, positive: braking",
            generator.alias);
    channel("power", "W", "electric power into the grid");
    channel("machine power", "W", "electric power of the machine into the DC link");
    channel("chopper power", "W", "power that the resistor at the DC link burns");
    channel("current", "A", "current of a phase of the machine, root mean square");
    channel("voltage", "V", "voltage of the grid between lines, root mean square");
    ForceElement seen{
        .name = generator.name, .states = synchronous_generator(generator).states, .coordinates = {generator.shaft}};
    const auto functions = std::make_shared<const detail::LawFunctions<SynchronousLaw>>(
        law_of(generator), std::vector{generator.torque}, seen);
    group.sample = [functions, element = generator.name](const DynamicView& in, double* values) {
        const ElementValues own(in.forces.elements(), element, in);
        const auto x = functions->values<double>(own.view());
        const auto now = functions->law().at(functions->at(in.time, x));
        *values++ = now.torque;
        *values++ = now.grid_power;
        *values++ = now.machine_power;
        *values++ = now.chopper_power;
        *values++ = std::sqrt(dot(now.current, now.current) / 2);
        *values++ = functions->law().grid_voltage(in.time) * std::sqrt(1.5);
    };
    return group;
}

}  // namespace cardan
