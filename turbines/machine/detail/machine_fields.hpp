/// @file
/// The fields of a machine beside those of its description, listed once for both writing and reading. Internal to
/// machine_text: not installed.
#pragma once

#include "turbines/machine/machine.hpp"
#include "turbines/model/detail/description_fields.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cardan {

inline const char* name_of(Skew skew) {
    return skew == Skew::none ? "none" : "pitt_peters";
}
inline const char* name_of(TowerInfluence influence) {
    return influence == TowerInfluence::none ? "none" : influence == TowerInfluence::potential ? "potential" : "bak";
}
inline const char* name_of(TowerShadow shadow) {
    return shadow == TowerShadow::none ? "none" : shadow == TowerShadow::powles ? "powles" : "eames";
}
inline const char* name_of(UnsteadyAirfoilModel model) {
    return model == UnsteadyAirfoilModel::beddoes_leishman ? "four_states" : "separation";
}

}  // namespace cardan

namespace cardan::turbines {

/// Fields of an airfoil's unsteady aerodynamics.
struct UnsteadyFields {
    AttachedFlow flow;
    UnsteadyAirfoilConstants lags;
};

struct AirfoilFields {
    std::string name;
    std::vector<Polar::Table> tables;
    std::optional<UnsteadyFields> unsteady = std::nullopt;
};

/// An Aerodynamics as lists.
struct AirFields {
    Aerodynamics air;             ///< without polars and unsteady airfoils
    std::vector<double> airfoil;  ///< of each section, from 1
    std::vector<AirfoilFields> airfoils;
};
AirFields fields_of(const Aerodynamics& air);
/// @throws InputError for what does not fit together
Aerodynamics aerodynamics_of(AirFields fields);

template <class Archive, class Airfoil>
void airfoil_fields(Archive& archive, Airfoil& airfoil) {
    archive.word("name", airfoil.name);
    archive.counted_groups("tables", airfoil.tables, [&](auto& table) {
        archive.optional_number("reynolds", table.reynolds);
        archive.numbers("angle_of_attack", table.angles);
        archive.numbers("lift", table.lift);
        archive.numbers("drag", table.drag);
        archive.numbers("moment", table.moment);
    });
    archive.optional_group("unsteady", airfoil.unsteady, [&](auto& unsteady) {
        archive.number("lift_slope", unsteady.flow.slope);
        archive.number("zero_lift_angle", unsteady.flow.zero_lift);
        archive.number("separation_above", unsteady.flow.upper);
        archive.number("separation_below", unsteady.flow.lower);
        archive.number("min_drag", unsteady.flow.zero_lift_drag);
        archive.optional_choice("model", unsteady.lags.model,
                                {UnsteadyAirfoilModel::beddoes_leishman, UnsteadyAirfoilModel::oye});
        archive.optional_number("A1", unsteady.lags.A1);
        archive.optional_number("A2", unsteady.lags.A2);
        archive.optional_number("b1", unsteady.lags.b1);
        archive.optional_number("b2", unsteady.lags.b2);
        archive.optional_number("T_p", unsteady.lags.pressure);
        archive.optional_number("T_f", unsteady.lags.boundary_layer);
    });
}

template <class Archive, class Support>
void support_fields(Archive& archive, Support& support) {
    archive.group_if(!support.tower.height.empty(), "tower", [&] {
        archive.numbers("height", support.tower.height);
        archive.numbers("diameter", support.tower.diameter);
        archive.numbers("drag", support.tower.drag);
        archive.optional_flag("loads", support.tower.loads);
        archive.optional_numbers("turbulence", support.tower.turbulence);
        archive.optional_choice("influence", support.tower.influence,
                                {TowerInfluence::none, TowerInfluence::potential, TowerInfluence::bak});
        archive.optional_choice("shadow", support.tower.shadow,
                                {TowerShadow::none, TowerShadow::powles, TowerShadow::eames});
    });
    archive.group_if(support.nacelle.has_loads(), "nacelle", [&] {
        archive.vector("area", support.nacelle.area);
        archive.vector("drag", support.nacelle.drag);
        archive.vector("centre", support.nacelle.centre);
    });
}

template <class Archive, class Fields>
void air_fields(Archive& archive, Fields& f) {
    archive.optional_number("density", f.air.density);
    archive.optional_number("viscosity", f.air.blade.viscosity);
    archive.optional_choice("wake", f.air.model.wake, {Wake::none, Wake::frozen, Wake::equilibrium, Wake::oye});
    archive.optional_number("inflow_time_constant", f.air.model.inflow_time_constant);
    archive.optional_choice("airfoil_model", f.air.model.airfoils, {Airfoils::steady, Airfoils::unsteady});
    archive.optional_word("wake_source", f.air.model.wake_source);
    archive.optional_word("airfoils_source", f.air.model.airfoils_source);
    archive.group_if(true, "momentum", [&] {
        archive.optional_flag("induction", f.air.options.induction);
        archive.optional_choice("skew", f.air.options.skew, {Skew::none, Skew::pitt_peters});
        archive.optional_flag("tip_loss", f.air.options.momentum.tip_loss);
        archive.optional_flag("hub_loss", f.air.options.momentum.hub_loss);
        archive.optional_flag("axial_drag", f.air.options.momentum.axial_drag);
        archive.optional_flag("rotation", f.air.options.momentum.rotation);
        archive.optional_flag("tangential_drag", f.air.options.momentum.tangential_drag);
    });
    archive.group("blade", [&] {
        archive.numbers("position", f.air.blade.position);
        archive.numbers("chord", f.air.blade.chord);
        archive.numbers("twist", f.air.blade.twist);
        archive.numbers("airfoil", f.airfoil);
        archive.optional_numbers("prebend", f.air.blade.prebend);
        archive.optional_numbers("sweep", f.air.blade.sweep);
        archive.optional_numbers("torsion_sweep", f.air.torsion_sweep);
    });
    support_fields(archive, f.air.support);
    archive.counted_groups("airfoils", f.airfoils, [&](auto& airfoil) { airfoil_fields(archive, airfoil); });
}

template <class Archive, class Operating>
void operation_fields(Archive& archive, Operating& o) {
    archive.optional_number("rotor_speed", o.rotor_speed);
    archive.optional_word("rotor_speed_source", o.rotor_speed_source);
    archive.optional_number("pitch", o.pitch);
    archive.optional_word("pitch_source", o.pitch_source);
    archive.optional_rows("pitch_schedule", o.pitch_schedule,
                          {{"rotor_speed", &PitchAt::rotor_speed}, {"pitch", &PitchAt::pitch}});
    archive.optional_number("rated_power", o.rated_power);
    archive.optional_number("min_speed", o.min_speed);
    archive.optional_number("tip_speed_ratio", o.tip_speed_ratio);
    archive.optional_rows("min_pitch", o.min_pitch, {{"wind", &PitchAtWind::wind}, {"pitch", &PitchAtWind::pitch}});
    archive.optional_rows(
        "schedule", o.schedule,
        {{"wind", &Operation::wind}, {"rotor_speed", &Operation::rotor_speed}, {"pitch", &Operation::pitch}});
    archive.optional_word("source", o.source);
}

template <class Archive, class Gains>
void gains_fields(Archive& archive, Gains& g) {
    archive.optional_number("corner_frequency", g.corner_frequency);
    archive.optional_number("min_speed", g.min_speed);
    archive.optional_number("rated_speed", g.rated_speed);
    archive.optional_number("optimal_gain", g.optimal_gain);
    archive.optional_number("rated_torque", g.rated_torque);
    archive.optional_number("max_torque", g.max_torque);
    archive.optional_number("max_torque_rate", g.max_torque_rate);
    archive.optional_flag("constant_power", g.constant_power);
    archive.optional_rows("pitch_gains", g.pitch_gains,
                          {{"pitch", &PitchGains::pitch},
                           {"proportional", &PitchGains::proportional},
                           {"integral", &PitchGains::integral}});
    archive.optional_number("min_pitch", g.min_pitch);
    archive.optional_number("max_pitch", g.max_pitch);
    archive.optional_number("max_pitch_rate", g.max_pitch_rate);
    archive.optional_word("source", g.source);
}

template <class Archive, class Run>
void run_fields(Archive& archive, Run& r) {
    archive.optional_flag("air", r.air);
    archive.optional_word("wind", r.wind);
    archive.optional_flag("controlled", r.controlled);
    archive.optional_number("duration", r.duration);
    archive.optional_number("rotor_speed", r.rotor_speed);
    archive.optional_number("pitch", r.pitch);
    archive.optional_number("azimuth", r.azimuth);
    archive.optional_number("yaw", r.yaw);
    archive.optional_word("file", r.file);
}

/// The keys are `machine_keys`.
template <class Archive, class AnyMachine, class Air>
void machine_fields(Archive& archive, AnyMachine& m, Air& air) {
    archive.optional_bearing("yaw_drive", m.yaw_drive);
    archive.group_if(true, "site", [&] {
        archive.optional_number("density", m.site.density);
        archive.optional_number("viscosity", m.site.viscosity);
        archive.optional_number("gravity", m.site.gravity);
        archive.optional_number("tower_foot", m.site.tower_base);
    });
    archive.group_if(true, "operation", [&] { operation_fields(archive, m.operation); });
    archive.group_if(true, "controller", [&] {
        archive.optional_word("library", m.controller.library);
        archive.optional_word("input", m.controller.input);
        archive.optional_number("period", m.controller.period);
        archive.optional_number("generator_efficiency", m.controller.generator_efficiency);
        archive.optional_flag("individual_pitch", m.controller.individual_pitch);
        archive.group_if(!m.controller.gains.source.empty(), "gains",
                         [&] { gains_fields(archive, m.controller.gains); });
        archive.group_if(m.controller.generator.slope != 0, "generator", [&] {
            archive.number("no_load_speed", m.controller.generator.no_load_speed);
            archive.number("slope", m.controller.generator.slope);
        });
        archive.group_if(m.controller.torque_law.acts(), "torque_law", [&] {
            archive.number("rated_speed", m.controller.torque_law.rated_speed);
            archive.number("rated_torque", m.controller.torque_law.rated_torque);
            archive.number("optimal_gain", m.controller.torque_law.optimal_gain);
            archive.number("slip", m.controller.torque_law.slip);
        });
    });
    archive.optional_group("run", m.run, [&](auto& run) { run_fields(archive, run); });
    archive.optional_group("air", air, [&](auto& fields) { air_fields(archive, fields); });
    archive.optional_word("no_air", m.no_air);
}

}  // namespace cardan::turbines
