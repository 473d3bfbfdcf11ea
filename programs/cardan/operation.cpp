#include "programs/cardan/operation.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"

#include <cmath>
#include <iostream>

namespace cardan::program {

double rotor_speed(const std::optional<double>& asked_rpm, const MachineFile& machine) {
    const turbines::TurbineFile& model = machine.file;
    if (asked_rpm && !std::isfinite(*asked_rpm)) throw InputError("--rpm", "value", *asked_rpm, "finite");
    if (asked_rpm) return *asked_rpm * units::rpm;
    std::cout << "rotor speed: " << model.rotor_speed * units::to_rpm << " rpm";
    if (!model.rotor_speed_source.empty()) std::cout << " (" << model.rotor_speed_source << ")";
    std::cout << "\n";
    return model.rotor_speed;
}

void set_pitch(const MachineFile& machine, MachineOptions& options, double rotor_speed) {
    if (options.pitch) return;
    const turbines::TurbineFile& model = machine.file;
    const double pitch =
        model.pitch_schedule.empty() ? model.pitch : turbines::pitch_at(model.pitch_schedule, rotor_speed);
    options.pitch = pitch * units::to_degrees;
    if (!model.pitch_source.empty())
        std::cout << "pitch: " << *options.pitch << " deg (" << model.pitch_source << ")\n";
}

solvers::CampbellMethod diagram_method(const MachineFile& machine, const MachineOptions& options) {
    const turbines::TurbineDescription& d = machine.file.description;
    return d.has_equal_blades() && (options.gravity || !d.hub.is_balanced()) ? solvers::CampbellMethod::averaged
                                                                             : solvers::CampbellMethod::automatic;
}

solvers::RotorSpin rotor_spin(const MachineFile& machine) {
    return machine.file.dofs.generator ? solvers::RotorSpin::free : solvers::RotorSpin::prescribed;
}

void tell_origin(solvers::Campbell& diagram, const MachineFile& machine, const ReadyMachine& ready,
                 const std::string& run) {
    const std::string foundation = foundation_in_words(machine);
    diagram.remark += text(diagram.remark.empty() || foundation.empty() ? "" : "; ", foundation);
    diagram.accuracy = in_words(ready.mesh);
    diagram.source = run + diagram.source;
}

std::string title_of(const solvers::Campbell& diagram) {
    return diagram.remark.empty() ? diagram.machine : text(diagram.machine, ", ", diagram.remark);
}

std::string default_prefix(const std::string& machine, const char* what) {
    return std::filesystem::path(machine).stem().string() + "_" + what;
}

}  // namespace cardan::program
