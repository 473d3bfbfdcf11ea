#include "turbines/analysis/detail/rigid_rotor.hpp"

#include "elements/aerodynamics/rigid_rotor.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

RigidRotor::RigidRotor(const Machine& machine)
    : machine_(&machine),
      air_(&machine.require_air()),
      radius_(air_->blade.position.back() * std::cos(machine.description.blade.cone)) {}

double RigidRotor::ratio() const {
    const MachineOperation& own = machine_->operation;
    if (own.tip_speed_ratio > 0) return own.tip_speed_ratio;
    const TurbineDescription& d = machine_->description;
    return best_tip_speed_ratio(air_->blade, d.blades, d.blade.cone, own.pitch, air_->options);
}

double RigidRotor::power(double wind, double speed, double pitch) const {
    const TurbineDescription& d = machine_->description;
    const double coefficient =
        rotor_coefficients(air_->blade, d.blades, d.blade.cone, speed * radius_ / wind, pitch, air_->options).power;
    return air_->density / 2 * pi * radius_ * radius_ * wind * wind * wind * coefficient;
}

double RigidRotor::sensitivity(double wind, double speed, double pitch) const {
    constexpr double step = 0.25 * units::degree;
    const TurbineDescription& d = machine_->description;
    const AeroBlade& blade = air_->blade;
    const RotorAir now = rigid_rotor_air(blade, {.blades = d.blades, .cone = d.blade.cone},
                                         {.speed = wind, .density = air_->density}, speed, 0, pitch, air_->options);
    // About the shaft, of a section per length, with the induced velocities of `now`.
    const auto torque = [&](std::size_t i, double change) {
        const SectionAir& section = now.sections.front()[i];
        Annulus annulus = blade.annulus(i, d.blades);
        annulus.angle += pitch + change;
        const double driving =
            section_force(annulus, section.V_x, section.V_y, section.induction, air_->density).driving;
        return blade.position[i] * std::cos(d.blade.cone) * driving;
    };
    double sum = 0;
    for (std::size_t i = 0; i + 1 < blade.sections(); ++i)
        for (const std::size_t k : {i, i + 1})
            sum += (blade.position[i + 1] - blade.position[i]) / 2 * (torque(k, -step) - torque(k, step));
    return d.blades * speed * sum / (2 * step);
}

// A rotor that stalls reaches a power, if it does, before its largest.
double RigidRotor::rated_wind(double speed, double power_wanted) const {
    constexpr double step = 0.5, highest = 40;
    const double pitch = machine_->operation.pitch;
    double high = step;
    while (high < highest && power(high, speed, pitch) < power_wanted) high += step;
    if (high >= highest) return 0;
    double low = high - step;
    for (int i = 0; i < 50; ++i) (power((low + high) / 2, speed, pitch) < power_wanted ? low : high) = (low + high) / 2;
    return high;
}

double RigidRotor::pitch_for(double power_wanted, double wind, double speed) const {
    double low = machine_->operation.pitch, high = low + 45 * units::degree;
    for (int i = 0; i < 50; ++i) (power(wind, speed, (low + high) / 2) > power_wanted ? low : high) = (low + high) / 2;
    return (low + high) / 2;
}

Operation RigidRotor::operation(double wind) const {
    const MachineOperation& own = machine_->operation;
    if (!own.schedule.empty())
        return operation_at(own.schedule, std::clamp(wind, own.schedule.front().wind, own.schedule.back().wind));
    VariableSpeed law = variable_speed(own);
    law.tip_speed_ratio = ratio();
    const double speed = law.speed_at(wind, radius_);
    const double fine = law.min_pitch_at(wind);
    if (speed < law.rated_speed || power(wind, speed, fine) <= law.rated_power) return {wind, speed, fine};
    return {wind, speed, pitch_for(law.rated_power, wind, speed)};
}

}  // namespace cardan::turbines
