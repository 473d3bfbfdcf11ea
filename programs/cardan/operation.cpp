#include "programs/cardan/operation.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/machine/machine_text.hpp"

#include <cmath>
#include <iostream>

namespace cardan::program {

double rotor_speed(const std::optional<double>& asked_rpm, const turbines::Machine& machine) {
    const turbines::MachineOperation& own = machine.operation;
    if (asked_rpm && !std::isfinite(*asked_rpm)) throw InputError("--rpm", "value", *asked_rpm, "finite");
    if (asked_rpm) return *asked_rpm * units::rpm;
    std::cout << "rotor speed: " << own.rotor_speed * units::to_rpm << " rpm";
    if (!own.rotor_speed_source.empty()) std::cout << " (" << own.rotor_speed_source << ")";
    std::cout << "\n";
    return own.rotor_speed;
}

void set_pitch(const turbines::Machine& machine, MachineOptions& options, double rotor_speed) {
    if (options.pitch) return;
    const turbines::MachineOperation& own = machine.operation;
    const double pitch = own.pitch_schedule.empty() ? own.pitch : turbines::pitch_at(own.pitch_schedule, rotor_speed);
    options.pitch = pitch * units::to_degrees;
    if (!own.pitch_source.empty()) std::cout << "pitch: " << *options.pitch << " deg (" << own.pitch_source << ")\n";
}

solvers::CampbellMethod diagram_method(const turbines::Machine& machine, const MachineOptions& options) {
    const turbines::TurbineDescription& d = machine.description;
    return d.has_equal_blades() && (options.gravity || !d.hub.is_balanced()) ? solvers::CampbellMethod::averaged
                                                                             : solvers::CampbellMethod::automatic;
}

solvers::RotorSpin rotor_spin(const turbines::Machine& machine) {
    return dofs_of(machine.description).generator ? solvers::RotorSpin::free : solvers::RotorSpin::prescribed;
}

void tell_origin(solvers::Campbell& diagram, const std::string& name, const CommandLine& command,
                 const turbines::Machine& machine, const ReadyMachine& ready) {
    const std::string foundation = foundation_in_words(machine);
    diagram.remark += text(diagram.remark.empty() || foundation.empty() ? "" : "; ", foundation);
    diagram.accuracy = in_words(ready.mesh);
    diagram.source = run_text(name, command) + turbines::with_machine(diagram.source, machine);
}

std::string title_of(const solvers::Campbell& diagram) {
    return diagram.remark.empty() ? diagram.machine : text(diagram.machine, ", ", diagram.remark);
}

std::string default_prefix(const std::string& machine, const char* what) {
    return std::filesystem::path(machine).stem().string() + "_" + what;
}

}  // namespace cardan::program
