#include "turbines/analysis/prepared_machine.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/linear/problem_size.hpp"
#include "turbines/analysis/detail/rounded.hpp"
#include "turbines/analysis/in_unit.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace cardan::turbines {

namespace {

void set_yaw(YawDof asked, Machine& machine) {
    JointSupport& yaw = machine.description.yaw.rotation;
    if (asked == YawDof::locked) yaw = rigid_joint;
    if (asked == YawDof::prescribed) yaw = prescribed_joint;
    if (asked != YawDof::free || !yaw.is_rigid()) return;
    if (machine.yaw_drive.is_rigid())
        throw InputError("MachineSettings::yaw", "value", "free", "locked: the model gives no spring of a yaw drive");
    yaw = machine.yaw_drive;
}

void set_dofs(const MachineSettings& settings, Machine& machine) {
    FileDofs f = dofs_of(machine.description);
    if (settings.generator) f.generator = settings.generator == GeneratorDof::free;
    if (settings.blades) f.blades = settings.blades == BladeDof::bend;
    if (settings.tower) {
        f.tower_fore_aft = settings.tower == TowerDof::bends || settings.tower == TowerDof::fore_aft;
        f.tower_side_side = settings.tower == TowerDof::bends || settings.tower == TowerDof::side_side;
    }
    set_dofs(f, machine.description);
    if (settings.yaw) set_yaw(*settings.yaw, machine);
}

void set_foundation(const MachineSettings& settings, Machine& machine) {
    if (!settings.foundation) return;
    if (machine.description.platform)
        throw InputError("MachineSettings::foundation", "value", settings.foundation->name,
                         text("none: the tower stands on ", machine.description.platform->name));
    machine.description.platform = settings.foundation;
}

void set_pitch_bearing(const MachineSettings& settings, JointSupport& pitch) {
    if (settings.pitch_stiffness) {
        require_positive("MachineSettings::pitch_stiffness", "value [N m/rad]", *settings.pitch_stiffness);
        pitch.kind = JointSupport::Kind::spring;
        pitch.stiffness = *settings.pitch_stiffness;
    }
    if (!settings.pitch_damping) return;
    require_not_negative("MachineSettings::pitch_damping", "value [N m s/rad]", *settings.pitch_damping);
    if (pitch.kind != JointSupport::Kind::spring && pitch.kind != JointSupport::Kind::free)
        throw InputError(
            "MachineSettings::pitch_damping", "value [N m s/rad]", *settings.pitch_damping,
            "none beside pitch bearings without a spring: MachineSettings::pitch_stiffness gives them one");
    pitch.damping = *settings.pitch_damping;
}

// Damping of beams, springs of the pitch bearings.
void set_beams(const MachineSettings& settings, TurbineDescription& d) {
    std::vector<BladeDescription*> blades{&d.blade};
    for (auto& [number, blade] : d.individual_blades)
        if (blade) blades.push_back(&*blade);
    for (BladeDescription* blade : blades) {
        set_pitch_bearing(settings, blade->pitch);
        if (!settings.blade_damping) continue;
        require_not_negative("MachineSettings::blade_damping", "value", *settings.blade_damping);
        blade->damping = {};
        blade->first_flap_damping = *settings.blade_damping;
    }
    if (!settings.tower_damping) return;
    require_not_negative("MachineSettings::tower_damping", "value", *settings.tower_damping);
    d.tower.damping = {};
    d.tower.first_mode_damping = *settings.tower_damping;
}

// A diagram of a machine that a file holds altogether would be empty: its beams bend.
void free_beams_if_nothing_moves(Machine& machine, const Report& report) {
    const TurbineDescription& d = machine.description;
    const bool teeters = d.hub.teeter && !d.hub.teeter->bearing.is_rigid();
    FileDofs f = dofs_of(d);
    if (f.generator || f.blades || !d.tower.rigid || teeters || !d.yaw.rotation.is_rigid() ||
        !d.drive_train.main_shaft.is_rigid())
        return;
    f.blades = f.tower_fore_aft = f.tower_side_side = true;
    set_dofs(f, machine.description);
    report_remark(report, {.text = "the model switches off all degrees of freedom: tower and blades bend here"});
}

}  // namespace

Machine with_settings(Machine machine, const MachineSettings& settings, const Report& report) {
    set_dofs(settings, machine);
    set_foundation(settings, machine);
    set_beams(settings, machine.description);
    free_beams_if_nothing_moves(machine, report);
    if (settings.generator_inertia) machine.description.drive_train.generator_inertia = *settings.generator_inertia;
    return machine;
}

AssemblyOptions assembly_options(const Machine& machine, const MachineSettings& settings, bool gravity) {
    AssemblyOptions o;
    o.blade_elements = settings.blade_elements;
    o.tower_elements = settings.tower_elements;
    o.spin = CoordinateRole::free;
    o.pitch = settings.pitch.value_or(machine.operation.pitch);
    if (gravity) o.gravity = {0, 0, -machine.site.gravity};
    o.structural_damping = o.joint_damping = settings.damping;
    return o;
}

namespace {

// A speed or an angle in another unit, before the work.
void check(const TurbineDescription& d, double rotor_speed, double pitch) {
    constexpr double largest_tip_speed = 1000;  // m/s
    const double tip_speed = std::abs(rotor_speed) * (d.hub.radius + d.blade.line.length);
    if (!(tip_speed <= largest_tip_speed))
        throw InputError(text(d.name, " at ", rounded(rotor_speed * units::to_rpm), " rpm"), "tip speed [m/s]",
                         rounded(tip_speed), text("at most ", largest_tip_speed, ", three times that of sound"));
    if (!(std::abs(pitch) <= 2 * pi))
        throw InputError(d.name, "pitch [deg]", rounded(pitch * units::to_degrees), "at most a turn either way");
}

}  // namespace

PreparedTurbine assembled(const Machine& machine, AssemblyOptions assembly, double max_hz, double rotor_speed,
                          const Report& report) {
    const TurbineDescription& description = machine.description;
    check(description, rotor_speed, assembly.pitch);
    assembly.mesh.max_hz = max_hz;
    assembly.mesh.rotor_speed = rotor_speed;
    const Turbine turbine = assemble(description, assembly);
    // Numbers that were asked for are judged as well.
    const Mesh mesh = turbine.mesh().max_hz > 0 ? turbine.mesh() : converged_mesh(description, assembly);
    if (description.platform)
        report_remark(report,
                      {Remark::Kind::taken, text("mesh: chosen with the ", description.platform->name, " held")});
    for (const std::string& warning : turbine.warnings()) report_remark(report, {Remark::Kind::warning, warning});
    return {turbine, mesh};
}

void check_size(const Turbine& turbine) {
    solvers::check_number_of_unknowns(turbine.rotor().machine, turbine.system().model.coordinates().free().size());
}

void keep_elements(const Mesh& mesh, MachineSettings& settings) {
    settings.blade_elements = mesh.blade_elements;
    settings.tower_elements = mesh.tower_elements;
}

double rotor_speed_of(const std::optional<double>& asked, const Machine& machine, const char* field,
                      const Report& report) {
    if (asked) {
        if (!std::isfinite(*asked)) throw InputError(field, "value [rad/s]", *asked, "finite");
        return *asked;
    }
    const MachineOperation& own = machine.operation;
    report_remark(report, {Remark::Kind::taken,
                           text("rotor speed: ", rounded(own.rotor_speed * units::to_rpm), " rpm",
                                own.rotor_speed_source.empty() ? "" : text(" (", own.rotor_speed_source, ")"))});
    return representable(own.rotor_speed, units::rpm);
}

double pitch_at_speed(const std::optional<double>& asked, const Machine& machine, double rotor_speed,
                      const Report& report) {
    if (asked) return *asked;
    const MachineOperation& own = machine.operation;
    const double pitch = own.pitch_schedule.empty() ? own.pitch : pitch_at(own.pitch_schedule, rotor_speed);
    if (!own.pitch_source.empty())
        report_remark(report, {Remark::Kind::taken,
                               text("pitch: ", rounded(pitch * units::to_degrees), " deg (", own.pitch_source, ")")});
    return representable(pitch, units::degree);
}

solvers::RotorSpin rotor_spin(const Machine& machine) {
    return dofs_of(machine.description).generator ? solvers::RotorSpin::free : solvers::RotorSpin::prescribed;
}

bool is_clamped(const Machine& machine) {
    const TurbineDescription& d = machine.description;
    return !d.missing_foundation.name.empty() && !d.platform;
}

std::string foundation_in_words(const Machine& machine) {
    const std::string& name = machine.description.missing_foundation.name;
    return is_clamped(machine) ? text("tower clamped at its foot, ", name, " left out") : "";
}

}  // namespace cardan::turbines
