/// @file
/// Synchronous generator with permanent magnets, full converter and DC link.
#pragma once

#include "elements/controllers/control_signal.hpp"
#include "elements/electric/grid.hpp"
#include "mbs/system/channel.hpp"
#include "mbs/system/force_element.hpp"

#include <string>

namespace cardan {

/// The machine in axes that turn with its rotor, d along the magnets: psi_d = L_d i_d + magnet_flux, psi_q = L_q i_q.
struct PermanentMagnetMachine {
    int pole_pairs = 1;
    double resistance = 0;                      ///< ohm, of a phase
    double inductance_d = 0, inductance_q = 0;  ///< H
    double magnet_flux = 0;                     ///< V s, peak, through a phase
};

/// Link between the converters: a capacitor, and a resistor that burns what the grid does not take.
struct DcLink {
    double voltage = 0;            ///< V, that the converter of the grid's side holds
    double capacitance = 0;        ///< F
    double bandwidth = 50;         ///< of the control of the voltage, rad/s; damping 0.7
    double chopper = 0;            ///< resistance of the chopper, ohm; 0: there is none
    double chopper_voltage = 1.1;  ///< at which it begins to conduct, over `voltage`; it conducts in full at 0.05 more
};

/// A generator whose torque follows a demand by control of the currents (i_d = 0), with the bandwidth given; what it
/// delivers goes through the DC link to the grid, whose converter delivers active current up to its limit. Converters
/// are without losses. States: "<name> flux d", "... q" (V s, without the magnets'), "<name> converter d", "... q" (V),
/// "<name> link voltage" (V), "<name> link control" (A), "<name> grid current" (A, peak).
struct SynchronousGenerator {
    std::string name = "generator";
    BodyId shaft = {};
    double gear_ratio = 1;
    PermanentMagnetMachine machine = {};
    DcLink link = {};
    Grid grid = {};
    ControlSignal torque = signal::constant(0);  ///< demand, N m, braking positive
    double bandwidth = 200;                      ///< of the control of the currents, rad/s
    double current_limit = 0;                    ///< of the grid's side, A, peak, > 0
    double current_lag = 0.005;                  ///< of the grid's side, s
    /// Speed of the machine, rad/s, and torque in whose steady operation the states start.
    double running_speed = 0, running_torque = 0;
    std::string alias = "GenTq";
};
/// @throws InputError for bad numbers
ForceElement synchronous_generator(const SynchronousGenerator& generator);
/// "<name> torque", "<name> power" (into the grid), "<name> machine power" (into the link), "<name> chopper power",
/// "<name> current" (of the machine, root mean square of a phase) and "<name> voltage" (of the grid, root mean square
/// between lines).
ChannelGroup synchronous_generator_channels(const SynchronousGenerator& generator);

}  // namespace cardan
