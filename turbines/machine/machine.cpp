#include "turbines/machine/machine.hpp"

#include "mbs/base/error.hpp"
#include "turbines/aerodynamics/machine_air.hpp"

#include <utility>

namespace cardan::turbines {

namespace {

// Base axes, m.
double foot_at_rest(const Turbine& turbine) {
    const FrameId foot = turbine.layout().tower_base;
    return foot == FrameId{} ? 0 : place_at_rest(turbine, foot).z();
}

// As the model counts heights, m.
double foot_height(const Turbine& turbine, const Machine& machine) {
    return machine.site.tower_base.value_or(foot_at_rest(turbine));
}

}  // namespace

AeroBlade Aerodynamics::torsion_blade() const {
    AeroBlade out = blade;
    if (torsion_sweep.empty()) return out;
    out.sweep = torsion_sweep;
    if (out.prebend.empty()) out.prebend.assign(out.sections(), 0);
    return out;
}

const Aerodynamics& Machine::require_air() const {
    if (!air) throw InputError(description.name, "air", text("none: ", no_air), "airfoils, as of read_air()");
    return *air;
}

Machine machine_of(TurbineDescription description) {
    Machine machine;
    machine.operation.rotor_speed = description.rotor_speed;
    machine.yaw_drive = description.yaw.rotation;
    machine.description = std::move(description);
    return machine;
}

Machine machine_of(TurbineFile file) {
    Machine machine;
    machine.description = std::move(file.description);
    machine.yaw_drive = file.yaw_drive;
    machine.site.tower_base = file.tower_base;
    machine.site.gravity = file.gravity;
    machine.operation = {.rotor_speed = file.rotor_speed,
                         .rotor_speed_source = std::move(file.rotor_speed_source),
                         .pitch = file.pitch,
                         .pitch_source = std::move(file.pitch_source),
                         .pitch_schedule = std::move(file.pitch_schedule),
                         .rated_power = file.operation.rated_power,
                         .min_speed = file.operation.min_rotor_speed,
                         .tip_speed_ratio = file.operation.tip_speed_ratio,
                         .min_pitch = std::move(file.operation.min_pitch),
                         .source = std::move(file.operation.source)};
    machine.run = std::move(file.run);
    machine.controller = std::move(file.controller);
    machine.notes = std::move(file.notes);
    return machine;
}

TowerNacelleAero support_on(const Turbine& turbine, const Machine& machine, TowerNacelleAero support) {
    support.tower.foot = foot_height(turbine, machine);
    return support;
}

SteadyWind still_wind(const Turbine& turbine, const Machine& machine, double density) {
    const double ground = foot_at_rest(turbine) - foot_height(turbine, machine);
    return {.reference_height = hub_at_rest(turbine).z() - ground, .density = density, .ground = ground};
}

VariableSpeed variable_speed(const MachineOperation& operation) {
    return {.tip_speed_ratio = operation.tip_speed_ratio,
            .min_rotor_speed = operation.min_speed,
            .rated_speed = operation.rotor_speed,
            .rated_power = operation.rated_power,
            .fine_pitch = operation.pitch,
            .min_pitch = operation.min_pitch};
}

}  // namespace cardan::turbines
