#include "programs/cardan/operation.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/analysis/in_unit.hpp"

#include <cmath>

namespace cardan::program {

std::optional<double> asked_speed(const std::optional<double>& asked_rpm) {
    if (!asked_rpm) return std::nullopt;
    if (!std::isfinite(*asked_rpm)) throw InputError("--rpm", "value", *asked_rpm, "finite");
    return *asked_rpm * units::rpm;
}

double rotor_speed(const std::optional<double>& asked_rpm, const turbines::Machine& machine) {
    return turbines::rotor_speed_of(asked_speed(asked_rpm), machine, "--rpm", remarks_printed(false));
}

void set_pitch(const turbines::Machine& machine, MachineOptions& options, double rotor_speed) {
    if (options.pitch) return;
    const double pitch = turbines::pitch_at_speed({}, machine, rotor_speed, remarks_printed(false));
    options.pitch = turbines::in_unit(pitch, units::degree);
}

void add_like(CommandLine& app, std::string& file) {
    app.add_option("--like", file,
                   "result (.h5) of campbell or modes for a similar machine: modes have the names of those there that "
                   "they are most like, at the rotor speeds that both have")
        .type_name("BASE.h5");
}

std::string title_of(const solvers::Campbell& diagram) {
    return diagram.remark.empty() ? diagram.machine : text(diagram.machine, ", ", diagram.remark);
}

std::string default_prefix(const std::string& machine, const char* what) {
    return std::filesystem::path(machine).stem().string() + "_" + what;
}

}  // namespace cardan::program
