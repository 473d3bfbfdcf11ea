/// @file
/// Induction machines by their equivalent circuit: squirrel cage, in three orders, and doubly fed with its converter.
///
/// Voltages, currents and fluxes are components in axes d, q that turn with the nominal frequency of the grid (Park,
/// amplitude-invariant): constant coefficients, so that steady states, modes and Campbell diagrams exist. Currents are
/// positive into the machine. Torques are positive where they brake positive rotation (generator), as in generator.hpp.
/// Zero-sequence quantities are left out; phase quantities, and unsymmetrical connections: three_phase.hpp.
///                                           [Krause, Wasynczuk and Sudhoff, Analysis of Electric Machinery, 2002]
#pragma once

#include "elements/controllers/control_signal.hpp"
#include "elements/electric/grid.hpp"
#include "elements/machine_elements/generator.hpp"
#include "mbs/system/force_element.hpp"

#include <optional>
#include <string>

namespace cardan {

/// T-shaped equivalent circuit of one phase, rotor quantities referred to the stator. Resistances and, at `frequency`,
/// reactances in ohm.
struct EquivalentCircuit {
    double stator_resistance = 0, stator_leakage = 0, magnetising = 0, rotor_leakage = 0, rotor_resistance = 0;
    double frequency = 50;  ///< of the reactances, Hz
    int pole_pairs = 1;

    /// L_s, L_r, L_m, H; with magnetising inductance.
    double stator_inductance() const;
    double rotor_inductance() const;
    double mutual_inductance() const;
    double synchronous_speed() const;  ///< of the shaft at `frequency`, rad/s
    /// A copy with its reactances at another frequency.
    EquivalentCircuit at_frequency(double hertz) const;

    /// Steady operation.
    struct Steady {
        double torque = 0;       ///< N m, braking positive
        double power = 0;        ///< taken from the grid by the stator, W
        double reactive = 0;     ///< taken from the grid by the stator, var
        Complex stator_current;  ///< A, peak, relative to the phase of the stator's voltage
        Complex rotor_current;   ///< A, peak, into the rotor
    };
    /// @param peak           of the phase voltage, V
    /// @param slip           1 - speed / synchronous speed: negative in generators
    /// @param rotor_voltage  of a converter, V, peak, referred to the stator
    Steady steady(double peak, double slip, Complex rotor_voltage = 0) const;
    /// Kloss' formula for this machine: breakdown torque and slip without stator resistance.
    KlossCurve without_stator_resistance(double peak) const;
    /// @throws InputError for a resistance that is negative (rotor: not positive), a reactance that is not positive
    void check(const std::string& where) const;
};

/// Assumptions about what Kloss' formula leaves open, where nothing better is known.
struct CircuitAssumptions {
    double magnetising = 40;         ///< magnetising reactance over the leakage of the stator
    double rotor_leakage = 1;        ///< over that of the stator
    double stator_resistance = 0.8;  ///< over that of the rotor
};
/// An equivalent circuit with the breakdown torque and slip of a machine: without its stator resistance its steady
/// curve is Kloss' formula. The number of pole pairs follows from frequency and synchronous speed.
/// @param line_voltage  root mean square between lines, V
/// @throws InputError also for a synchronous speed that is not the frequency over a whole number of pole pairs
EquivalentCircuit equivalent_circuit(const KlossCurve& machine, double line_voltage, double frequency,
                                     const CircuitAssumptions& assumed = {});

/// Order of the machine's electric dynamics.
enum class MachineOrder : std::uint8_t {
    fifth,  ///< fluxes of stator and rotor: four states, currents of a direct start, sags
    third,  ///< fluxes of the rotor, stator at its steady state in axes that turn with the grid's voltage: two states
    first   ///< torque behind that of steady operation by the time constant 1 / (breakdown slip x omega): one state
};

/// Squirrel-cage machine on a shaft. States: "<name> stator flux d", "... q", "<name> rotor flux d", "... q", V s
/// (fifth), the latter two (third), "<name> torque state", N m (first).
struct InductionGenerator {
    std::string name = "generator";
    BodyId shaft = {};
    double gear_ratio = 1;  ///< speed of the machine / rate of the coordinate; negative: it turns the other way
    EquivalentCircuit circuit = {};
    Grid grid = {};
    MachineOrder order = MachineOrder::fifth;
    /// Speed of the machine, rad/s, from whose steady operation the states start; none: without flux (a direct start).
    std::optional<double> running = {};
    /// Cut off, the stator has this resistance more than its own, over the largest reactance of the circuit: currents
    /// die out at once, as in a breaker.
    double breaker = 100;
    std::string alias = "GenTq";  ///< of the torque channel
};
/// @throws InputError for bad numbers
ForceElement induction_generator(const InductionGenerator& machine);
/// "<name> torque", "<name> power" (electric, into the grid), "<name> reactive power" (into the grid), "<name> current"
/// (root mean square of a phase, symmetrical), "<name> current a", "b", "c" (instantaneous) and "<name> voltage" (root
/// mean square between lines).
ChannelGroup induction_generator_channels(const InductionGenerator& machine);

/// Doubly fed machine: its rotor is fed by a converter that controls the rotor's currents, which follow demands of
/// torque and of stator reactive power. With i* the currents that give both at the stator's flux psi (stator resistance
/// left out), and the terms that couple the axes fed forward,
///
///     v_r = k_p (i* - i_r) + z + (terms of rotation),  dz/dt = k_i (i* - i_r),
///     k_p = bandwidth sigma L_r,  k_i = bandwidth R_r.
///
/// The converter is without losses; the power of the rotor goes through it to the grid. States as of the squirrel cage
/// of fifth order, and "<name> converter d", "... q", V.
struct DoublyFedGenerator {
    std::string name = "generator";
    BodyId shaft = {};
    double gear_ratio = 1;
    EquivalentCircuit circuit = {};
    Grid grid = {};
    ControlSignal torque = signal::constant(0);    ///< demand, N m, braking positive
    ControlSignal reactive = signal::constant(0);  ///< demand, var, from the stator into the grid
    double bandwidth = 200;                        ///< of the control of currents, rad/s
    /// Speed of the machine, rad/s, and torque from whose steady operation without reactive power the states start.
    double running_speed = 0, running_torque = 0;
    std::string alias = "GenTq";
};
ForceElement doubly_fed_generator(const DoublyFedGenerator& machine);
/// Channels as those of the squirrel cage; powers are those of stator and converter together. In addition "<name> rotor
/// voltage", peak, V, referred to the stator.
ChannelGroup doubly_fed_generator_channels(const DoublyFedGenerator& machine);

}  // namespace cardan
