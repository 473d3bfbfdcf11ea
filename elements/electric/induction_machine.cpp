#include "elements/electric/induction_machine.hpp"

#include "elements/electric/detail/induction_laws.hpp"
#include "elements/electric/detail/machine_channels.hpp"
#include "elements/machine_elements/gear_ratio.hpp"
#include "mbs/base/error.hpp"

#include <cmath>
#include <memory>
#include <utility>

namespace cardan {

double EquivalentCircuit::stator_inductance() const {
    return (stator_leakage + magnetising) / (2 * pi * frequency);
}
double EquivalentCircuit::rotor_inductance() const {
    return (rotor_leakage + magnetising) / (2 * pi * frequency);
}
double EquivalentCircuit::mutual_inductance() const {
    return magnetising / (2 * pi * frequency);
}
double EquivalentCircuit::synchronous_speed() const {
    return 2 * pi * frequency / pole_pairs;
}

EquivalentCircuit EquivalentCircuit::at_frequency(double hertz) const {
    EquivalentCircuit other = *this;
    for (double* reactance : {&other.stator_leakage, &other.magnetising, &other.rotor_leakage})
        *reactance *= hertz / frequency;
    other.frequency = hertz;
    return other;
}

EquivalentCircuit::Steady EquivalentCircuit::steady(double peak, double slip, Complex rotor_voltage) const {
    // V = Z_s I_s + j X_m I_r,  V_r = j s X_m I_s + (R_r + j s X_r) I_r
    const Complex Z_s(stator_resistance, stator_leakage + magnetising), mutual(0, magnetising),
        Z_r(rotor_resistance, slip * (rotor_leakage + magnetising));
    const Complex determinant = Z_s * Z_r - slip * mutual * mutual;
    Steady out;
    out.stator_current = (Z_r * peak - mutual * rotor_voltage) / determinant;
    out.rotor_current = (Z_s * rotor_voltage - slip * mutual * peak) / determinant;
    const Complex flux = stator_inductance() * out.stator_current + mutual_inductance() * out.rotor_current;
    out.torque = -1.5 * pole_pairs * std::imag(std::conj(flux) * out.stator_current);
    out.power = 1.5 * peak * out.stator_current.real();
    out.reactive = -1.5 * peak * out.stator_current.imag();
    return out;
}

KlossCurve EquivalentCircuit::without_stator_resistance(double peak) const {
    const double share = magnetising / (stator_leakage + magnetising),  // of the voltage behind the stator's leakage
        reactance = stator_leakage * share + rotor_leakage;
    return {.synchronous_speed = synchronous_speed(),
            .breakdown_torque = 0.75 * peak * share * peak * share / (synchronous_speed() * reactance),
            .breakdown_slip = rotor_resistance / reactance};
}

EquivalentCircuit equivalent_circuit(const KlossCurve& machine, double line_voltage, double frequency,
                                     const CircuitAssumptions& assumed) {
    constexpr const char* here = "equivalent circuit";
    machine.check(here);
    require_positive(here, "voltage between lines [V]", line_voltage);
    require_positive(here, "frequency [Hz]", frequency);
    require_positive(here, "magnetising reactance over leakage", assumed.magnetising);
    require_positive(here, "leakage of rotor over stator", assumed.rotor_leakage);
    require_not_negative(here, "resistance of stator over rotor", assumed.stator_resistance);
    const double pairs = 2 * pi * frequency / machine.synchronous_speed;
    if (std::abs(pairs - std::round(pairs)) > 1e-6 * pairs)
        throw InputError(here,
                         text("number of pole pairs: ", frequency, " Hz over the synchronous speed of ",
                              machine.synchronous_speed, " rad/s"),
                         pairs, "a whole number");
    // T_b = 3/4 (V share)^2 / (w_s X), s_b = R_r / X with X = X_ls share + X_lr behind the voltage V share.
    const double share = assumed.magnetising / (1 + assumed.magnetising),
                 voltage = line_voltage * std::sqrt(2.0 / 3) * share,
                 X = 0.75 * voltage * voltage / (machine.synchronous_speed * machine.breakdown_torque),
                 leakage = X / (share + assumed.rotor_leakage), resistance = machine.breakdown_slip * X;
    return {.stator_resistance = assumed.stator_resistance * resistance,
            .stator_leakage = leakage,
            .magnetising = assumed.magnetising * leakage,
            .rotor_leakage = assumed.rotor_leakage * leakage,
            .rotor_resistance = resistance,
            .frequency = frequency,
            .pole_pairs = static_cast<int>(std::lround(pairs))};
}

void EquivalentCircuit::check(const std::string& where) const {
    require_not_negative(where, "stator resistance [ohm]", stator_resistance);
    require_positive(where, "rotor resistance [ohm]", rotor_resistance);
    require_positive(where, "stator leakage reactance [ohm]", stator_leakage);
    require_positive(where, "rotor leakage reactance [ohm]", rotor_leakage);
    require_positive(where, "magnetising reactance [ohm]", magnetising);
    require_positive(where, "frequency of the reactances [Hz]", frequency);
    if (pole_pairs < 1) throw InputError(where, "number of pole pairs", pole_pairs, ">= 1");
}

namespace {

void check(const std::string& name, double gear_ratio, const EquivalentCircuit& circuit, const Grid& grid) {
    if (name.empty()) throw InputError("electric machine: the name is missing");
    require_gear_ratio(name, gear_ratio);
    circuit.check(name);
    grid.check(name);
}

// States of a pair of axes.
void add_states(ForceElement& element, const std::string& name, const char* unit, double scale, Complex initial) {
    for (const bool d : {true, false})
        element.states.push_back({.name = text(name, d ? " d" : " q"),
                                  .unit = unit,
                                  .scale = scale,
                                  .initial = d ? initial.real() : initial.imag(),
                                  .part = "generator"});
}

struct Fluxes {
    Complex stator, rotor;
};
Fluxes fluxes(const EquivalentCircuit& circuit, const EquivalentCircuit::Steady& at) {
    const double M = circuit.mutual_inductance();
    return {circuit.stator_inductance() * at.stator_current + M * at.rotor_current,
            circuit.rotor_inductance() * at.rotor_current + M * at.stator_current};
}

ForceElement fluxes_of(const InductionGenerator& machine, const EquivalentCircuit& circuit) {
    ForceElement element{.name = machine.name, .coordinates = {machine.shaft}};
    Fluxes start{};
    double torque = 0;
    if (machine.running) {
        const EquivalentCircuit::Steady at =
            circuit.steady(machine.grid.peak(), 1 - *machine.running / circuit.synchronous_speed());
        start = fluxes(circuit, at);
        torque = at.torque;
    }
    const double flux = machine.grid.peak() / machine.grid.omega();
    if (machine.order == MachineOrder::fifth)
        add_states(element, machine.name + " stator flux", "V s", flux, start.stator);
    if (machine.order != MachineOrder::first)
        add_states(element, machine.name + " rotor flux", "V s", flux, start.rotor);
    else
        element.states.push_back({.name = machine.name + " torque state",
                                  .unit = "N m",
                                  .scale = circuit.without_stator_resistance(machine.grid.peak()).breakdown_torque,
                                  .initial = torque,
                                  .part = "generator"});
    element.breaks = machine.grid.all_breaks();
    return element;
}

}  // namespace

ForceElement induction_generator(const InductionGenerator& machine) {
    check(machine.name, machine.gear_ratio, machine.circuit, machine.grid);
    require_positive(machine.name, "resistance of the breaker over the largest reactance", machine.breaker);
    const EquivalentCircuit circuit = machine.circuit.at_frequency(machine.grid.frequency);
    ForceElement element = fluxes_of(machine, circuit);
    const detail::MachineConstants constants(circuit, machine.grid, machine.gear_ratio, machine.breaker);
    if (machine.order == MachineOrder::fifth) detail::set_law(element, detail::FifthOrder{constants});
    if (machine.order == MachineOrder::third) detail::set_law(element, detail::ThirdOrder{constants});
    if (machine.order == MachineOrder::first) detail::set_law(element, detail::FirstOrder{constants});
    return element;
}

ChannelGroup induction_generator_channels(const InductionGenerator& machine) {
    const EquivalentCircuit circuit = machine.circuit.at_frequency(machine.grid.frequency);
    const detail::MachineConstants constants(circuit, machine.grid, machine.gear_ratio, machine.breaker);
    const ForceElement element = induction_generator(machine);
    if (machine.order == MachineOrder::fifth)
        return detail::machine_channels(machine.name, machine.alias, element, detail::FifthOrder{constants}, {},
                                        constants.omega, false);
    if (machine.order == MachineOrder::third)
        return detail::machine_channels(machine.name, machine.alias, element, detail::ThirdOrder{constants}, {},
                                        constants.omega, false);
    return detail::torque_channels(machine.name, machine.alias, element, constants);
}

namespace {

// Steady state of the doubly fed machine under its converter, by iteration: the rotor's currents follow the flux.
struct DoublyFedStart {
    Complex stator_flux, rotor_flux, rotor_current;
};
DoublyFedStart start_of(const DoublyFedGenerator& machine, const detail::DoublyFed& law) {
    const detail::MachineConstants& c = law.induction.machine;
    const double w = machine.grid.omega();
    Complex flux = machine.grid.peak() / Complex(0, w), factor;
    for (int i = 0; i < 100; ++i) {
        const detail::Phasor<double> demanded =
            law.demanded(detail::Phasor<double>{flux.real(), flux.imag()}, machine.running_torque, 0.0);
        factor = Complex(demanded.d, demanded.q) / flux;
        flux = machine.grid.peak() / (Complex(0, w) + c.R_s * (1.0 - c.L_m * factor) / c.L_s);
    }
    const Complex rotor = factor * flux, stator = (flux - c.L_m * rotor) / c.L_s;
    return {flux, c.L_r * rotor + c.L_m * stator, rotor};
}

detail::DoublyFed law_of(const DoublyFedGenerator& machine) {
    const EquivalentCircuit circuit = machine.circuit.at_frequency(machine.grid.frequency);
    return {{detail::MachineConstants(circuit, machine.grid, machine.gear_ratio, 100)}, machine.bandwidth};
}

}  // namespace

ForceElement doubly_fed_generator(const DoublyFedGenerator& machine) {
    check(machine.name, machine.gear_ratio, machine.circuit, machine.grid);
    require_positive(machine.name, "bandwidth of the currents [rad/s]", machine.bandwidth);
    if (!machine.grid.interruptions.empty())
        throw InputError(text(machine.name,
                              ": a doubly fed machine is not cut off from the grid; its converter would "
                              "have to be modelled for that. Use a sag"));
    const detail::DoublyFed law = law_of(machine);
    const DoublyFedStart start = start_of(machine, law);
    const double flux = machine.grid.peak() / machine.grid.omega();
    ForceElement element{.name = machine.name, .coordinates = {machine.shaft}};
    add_states(element, machine.name + " stator flux", "V s", flux, start.stator_flux);
    add_states(element, machine.name + " rotor flux", "V s", flux, start.rotor_flux);
    add_states(element, machine.name + " converter", "V", machine.grid.peak() / 10,
               machine.circuit.rotor_resistance * start.rotor_current);
    element.breaks = machine.grid.all_breaks();
    detail::set_law(element, law, {machine.torque, machine.reactive});
    return element;
}

ChannelGroup doubly_fed_generator_channels(const DoublyFedGenerator& machine) {
    return detail::machine_channels(machine.name, machine.alias, doubly_fed_generator(machine), law_of(machine),
                                    {machine.torque, machine.reactive}, machine.grid.omega(), true);
}

}  // namespace cardan
