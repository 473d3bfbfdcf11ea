/// @file
/// The slip of an induction generator in a linearised machine.
#pragma once

#include "elements/machine_elements/generator.hpp"
#include "turbines/model/assembly.hpp"

namespace cardan::turbines {

/// Damping of a generator's shaft coordinate by slip: the slope of Kloss' formula at a torque on the rising part of the
/// curve, times the gear ratio squared. It applies to small deviations from the speed at which the generator gives this
/// torque, whatever that speed is: at constant flux the torque-slip curve shifts with the frequency of the grid or
/// converter.
/// @param torque  of the generator at the operating point, N m, positive where it brakes; 0: at synchronous speed
/// @return N m s/rad
/// @throws InputError for a bad law, or a torque that is not below the breakdown torque
double slip_damping(const KlossCurve& law, double gear_ratio, double torque = 0);

/// The machine with this damper on its generator's azimuth. Only for equations linearised about a steady rotation
/// (modes, linear models), where the constant torque drops out; in a time simulation the damper would brake the machine
/// to standstill.
/// @throws InputError if there is no generator, and as slip_damping()
Turbine with_generator_slip(const Turbine& turbine, const KlossCurve& law, double torque = 0);

}  // namespace cardan::turbines
