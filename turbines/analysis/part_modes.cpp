#include "turbines/analysis/part_modes.hpp"

#include "mbs/base/error.hpp"
#include "turbines/analysis/prepared_machine.hpp"

#include <cmath>

namespace cardan::turbines {

namespace {

// At rest, ascending.
double limit(const PartModesSettings& settings, const std::vector<double>& hz) {
    if (settings.max_frequency_hz) return *settings.max_frequency_hz;
    return 1.3 * (hz.size() < 3 ? hz.back() : hz[2]);
}

solvers::Campbell diagram(const Turbine& part, const std::vector<double>& speeds, double max_hz, std::string remark) {
    solvers::CampbellOptions options;
    options.spin = solvers::RotorSpin::prescribed;
    options.max_frequency_hz = max_hz;
    solvers::Campbell out = solvers::campbell(part.system(), part.rotor(), speeds, options);
    out.remark = std::move(remark);
    return out;
}

std::vector<double> speeds_of(const PartModesSettings& settings, const Machine& machine) {
    if (!settings.rotor_speeds.empty()) return settings.rotor_speeds;
    if (machine.operation.rotor_speed > 0) return {0, machine.operation.rotor_speed};
    return {0};
}

solvers::Campbell blade_modes(const Machine& machine, const PartModesSettings& settings) {
    const TurbineDescription& d = machine.description;
    const std::vector<double> speeds = speeds_of(settings, machine);
    MachineSettings own = settings.machine;
    own.pitch = pitch_at_speed(own.pitch, machine, speeds.back());
    AssemblyOptions assembly = assembly_options(machine, own, false);
    assembly.spin = CoordinateRole::prescribed;
    assembly.mesh.max_hz = limit(settings, clamped_blade_hz(d, assembly, d.first_blade()));
    assembly.mesh.rotor_speed = std::abs(speeds.back());
    return diagram(isolated_blade(d, assembly, d.first_blade()), speeds, assembly.mesh.max_hz,
                   "clamped at its root, no other part moves");
}

solvers::Campbell tower_modes(const Machine& machine, const PartModesSettings& settings) {
    AssemblyOptions assembly = assembly_options(machine, settings.machine, false);
    assembly.mesh.max_hz = limit(settings, clamped_tower_hz(machine.description, assembly));
    return diagram(isolated_tower(machine.description, assembly), {0}, assembly.mesh.max_hz,
                   "clamped at its foot, without what it carries: the machine's frequencies are lower");
}

}  // namespace

PartModes part_modes(const Machine& source, const PartModesSettings& settings) {
    using enum MissingEntry::Part;
    if (settings.max_frequency_hz)
        require_positive("PartModesSettings::max_frequency_hz", "value [Hz]", *settings.max_frequency_hz);
    const Machine machine = with_settings(source, settings.machine);
    const TurbineDescription& d = machine.description;
    const int first = d.first_blade();
    PartModes parts;
    if (d.has(blade) && first <= d.blades && !d.blade_at(first)->rigid) parts.blade = blade_modes(machine, settings);
    if (d.has(tower) && !d.tower.rigid) parts.tower = tower_modes(machine, settings);
    return parts;
}

}  // namespace cardan::turbines
