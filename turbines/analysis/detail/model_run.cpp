#include "turbines/analysis/detail/model_run.hpp"

#include "elements/controllers/bladed_controller.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/analysis/detail/rigid_rotor.hpp"
#include "turbines/analysis/detail/rounded.hpp"
#include "turbines/analysis/in_unit.hpp"
#include "turbines/analysis/machine_wind.hpp"
#include "turbines/readers/inflow_wind.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

namespace cardan::turbines {

namespace {

using std::filesystem::path;

std::string name_of(const path& file) {
    return file.filename().string();
}

// Could it be loaded here? A library of Windows cannot.
bool is_library_here(const path& file) {
    std::array<char, 4> first{};
    std::ifstream(file, std::ios::binary).read(first.data(), first.size());
    return std::string_view(first.data(), first.size()) ==
           "\x7f"
           "ELF";
}

std::vector<std::string> names_of_library(const path& given) {
    const std::string stem = given.stem().string();
    std::vector<std::string> names{name_of(given)};
    for (const std::string& one : {stem, lower_case(stem)}) {
        names.push_back(one + ".so");
        if (!one.starts_with("lib")) names.push_back("lib" + one + ".so");
    }
    return names;
}

// Empty: there is none.
path library_beside(const Machine& machine) {
    path given = machine.controller.library;
    if (is_library_here(given)) return given;
    for (const path& folder :
         {given.parent_path(), path(machine.controller.input).parent_path(), path(machine.run->file).parent_path()}) {
        if (folder.empty()) continue;
        for (const std::string& name : names_of_library(given))
            if (is_library_here(folder / name)) return folder / name;
    }
    return {};
}

[[noreturn]] void refuse_wind(const ModelRun& run, const std::string& why) {
    throw InputError("SimulationSettings::wind", text("wind of ", name_of(run.file)), why,
                     "another one, m/s or a file, or none");
}

void take_wind(const Machine& machine, SimulationSettings& s, const Report& report) {
    const ModelRun& run = *machine.run;
    if (!run.air) {
        s.wind = WindSource::none();
        return;
    }
    if (!machine.air) refuse_wind(run, machine.no_air);
    if (run.wind.empty())
        s.wind = 0;
    else
        s.wind = path(run.wind);
    try {
        if (!run.wind.empty()) static_cast<void>(read_inflow_wind(run.wind, machine.air->density));
    } catch (const MemoryError&) {
        throw;
    } catch (const Error& error) {
        refuse_wind(run, error.what());
    }
    report_remark(report,
                  {Remark::Kind::taken, text("wind: ", run.wind.empty() ? "none, the air is still" : name_of(run.wind),
                                             " (", name_of(run.file), ")")});
}

// The state at the start: speed, pitch, azimuth, yaw.
void take_start(const Machine& machine, SimulationSettings& s, const Report& report) {
    const ModelRun& run = *machine.run;
    std::string taken;
    const auto say = [&taken](const std::string& what) { taken += text(taken.empty() ? "" : ", ", what); };
    if (!s.rotor_speed && run.rotor_speed) {
        s.rotor_speed = representable(*run.rotor_speed, units::rpm);
        say(text(rounded(*run.rotor_speed * units::to_rpm), " rpm"));
    }
    if (!s.machine.pitch && run.pitch) {
        s.machine.pitch = representable(*run.pitch, units::degree);
        say(text("pitch ", rounded(*run.pitch * units::to_degrees), " deg"));
    }
    if (!s.azimuth && run.azimuth.value_or(0) != 0) {
        s.azimuth = *run.azimuth;
        say(text("azimuth ", rounded(*run.azimuth * units::to_degrees), " deg"));
    }
    constexpr auto yaw = "yaw";
    if (run.yaw.value_or(0) != 0 && !s.q.contains(yaw)) {
        if (!s.machine.yaw && machine.description.yaw.rotation.is_rigid()) s.machine.yaw = YawDof::prescribed;
        if (s.machine.yaw != YawDof::locked) {
            s.q[yaw] = *run.yaw;
            say(text("nacelle yawed by ", rounded(*run.yaw * units::to_degrees), " deg"));
        }
    }
    if (!taken.empty())
        report_remark(report, {Remark::Kind::taken, text("start: ", taken, " (ElastoDyn of ", name_of(run.file), ")")});
}

}  // namespace

void take_run(const Machine& machine, SimulationSettings& s, const Report& report) {
    if (machine.run && !s.wind) {
        take_wind(machine, s, report);
        take_start(machine, s, report);
    }
    if (!s.wind) {
        if (machine.air)
            report_remark(report, {Remark::Kind::taken,
                                   "wind: none, since the model names none; SimulationSettings::wind gives one"});
        s.wind = WindSource::none();
    }
    if (!s.azimuth) s.azimuth = 0;
}

namespace {

bool has_damping(const BeamDamping& damping, double of_first_mode) {
    return of_first_mode > 0 || damping.needs_modes() ||
           std::ranges::any_of(damping.time_constants, [](double time) { return time > 0; });
}

}  // namespace

void note_undamped(const Machine& machine, const Report& report) {
    const TurbineDescription& d = machine.description;
    const bool tower = !d.tower.rigid && d.tower.line.length > 0 &&
                       !has_damping(d.tower.damping, d.tower.first_mode_damping),
               blades = !d.blade.rigid && !has_damping(d.blade.damping, d.blade.first_flap_damping);
    if (!tower && !blades) return;
    const char* const which = tower && blades ? "tower and blades have" : tower ? "the tower has" : "blades have";
    report_remark(report, {.text = text("in the model ", which,
                                        " no damping: vibrations do not die away, and the fastest of them set the "
                                        "steps; MachineSettings::blade_damping, MachineSettings::tower_damping")});
}

void take_controller(const Machine& machine, Controller& c, const Report& report) {
    c.kind = Controller::Kind::none;
    if (!machine.run || !machine.run->controlled || machine.controller.library.empty()) return;
    if (!dofs_of(machine.description).generator) {
        report_remark(report, {.text = "the model's controller does not act: the rotor turns at constant speed"});
        return;
    }
    const path found = library_beside(machine);
    const std::string why = found.empty() ? "" : BladedController::why_not_loaded(found);
    if (found.empty() || !why.empty()) {
        report_remark(report, {.text = text("the model's controller, ", name_of(machine.controller.library),
                                            found.empty() ? ", is no library that can be loaded here, and none lies "
                                                            "beside it or the model"
                                                          : text(", cannot be loaded here (", why, ")"),
                                            ": the baseline controller stands in")});
        c.kind = Controller::Kind::baseline;
        return;
    }
    c.kind = Controller::Kind::library;
    c.library = found;
    c.input = machine.controller.input;
    if (!c.period && machine.controller.period > 0) c.period = machine.controller.period;
    report_remark(report, {Remark::Kind::taken, text("controller: ", found.string())});
}

void take_operation(const Machine& machine, SimulationSettings& s, double wind, const Report& report) {
    const MachineOperation& own = machine.operation;
    const bool known = !own.schedule.empty() || (own.rated_power > 0 && own.rotor_speed > 0);
    if (!s.controller.acts() || s.wind->is_none() || s.rotor_speed || s.machine.pitch || !known) return;
    if (!(wind > 0)) return;
    const Operation at = RigidRotor(machine).operation(wind);
    s.rotor_speed = representable(at.rotor_speed, units::rpm);
    s.machine.pitch = representable(at.pitch, units::degree);
    report_remark(report, {Remark::Kind::taken, text("start: ", rounded(at.rotor_speed * units::to_rpm), " rpm, pitch ",
                                                     rounded(at.pitch * units::to_degrees),
                                                     " deg, as the machine runs in ", rounded(wind), " m/s")});
}

namespace {

bool takes_generator(const Machine& machine, const SimulationSettings& s) {
    return machine.run && machine.run->controlled && !s.controller.acts() && !s.generator_torque &&
           s.generator_slope == 0 && dofs_of(machine.description).generator;
}

}  // namespace

TorqueLaw torque_law_of(const Machine& machine, const SimulationSettings& s) {
    if (!takes_generator(machine, s)) return {};
    const TorqueLaw& own = machine.controller.torque_law;
    if (own.acts()) own.check("torque_law");
    return own;
}

void take_generator(const Machine& machine, SimulationSettings& s, const Report& report) {
    if (!takes_generator(machine, s)) return;
    if (const TorqueLaw law = torque_law_of(machine, s); law.acts()) {
        report_remark(report,
                      {Remark::Kind::taken,
                       text("generator: law of variable speed of ServoDyn, ", rounded(law.rated_torque), " N m from ",
                            rounded(law.rated_speed * units::to_rpm), " rpm on, on its own shaft")});
        return;
    }
    const SlippingGenerator& own = machine.controller.generator;
    if (own.slope == 0) {
        if (!s.wind->is_none())
            report_remark(report, {.text = "the model has no law of the generator's torque that is known here: the "
                                           "torque of the start stays"});
        return;
    }
    s.generator_torque = own.slope * (*s.rotor_speed * machine.description.drive_train.gear_ratio - own.no_load_speed);
    s.generator_slope = own.slope;
    report_remark(report, {Remark::Kind::taken, text("generator: induction machine of ServoDyn, without load at ",
                                                     rounded(own.no_load_speed * units::to_rpm), " rpm, ",
                                                     rounded(own.slope), " N m s/rad")});
}

double duration_of(const RecordSettings& settings, const Machine& machine) {
    constexpr double usual = 20;
    if (settings.duration) return *settings.duration;
    return machine.run && machine.run->duration ? *machine.run->duration : usual;
}

}  // namespace cardan::turbines
