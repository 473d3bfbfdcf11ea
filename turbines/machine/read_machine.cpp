#include "turbines/machine/read_machine.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "turbines/machine/built_in.hpp"
#include "turbines/machine/machine_text.hpp"
#include "turbines/machine/result.hpp"
#include "turbines/readers/aerodyn.hpp"
#include "turbines/readers/openfast.hpp"
#include "turbines/readers/openfast_file.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/yaml/description.hpp"
#include "turbines/yaml/windio.hpp"
#include "turbines/yaml/windio_air.hpp"

#include <system_error>
#include <utility>

namespace cardan::turbines {

namespace {

void refuse(const std::vector<ModelAddition>& additions) {
    if (!additions.empty())
        throw InputError("additions to the machine", "value", additions.front().name, "none: it is no model of windIO");
}

Aerodynamics air_of(AeroDynFile file) {
    return {.blade = std::move(file.blade),
            .options = file.options,
            .model = std::move(file.model),
            .density = file.density,
            .support = std::move(file.support),
            .unsteady_airfoils = std::move(file.airfoils),
            .notes = std::move(file.notes)};
}

Aerodynamics air_of(WindioAir file) {
    return {.blade = std::move(file.blade),
            .options = file.options,
            .density = file.density,
            .unsteady_airfoils = std::move(file.airfoils),
            .notes = std::move(file.notes)};
}

// What `read` returns or, if it fails, the reason.
template <class Read>
void add_air(Machine& machine, const Read& read) {
    try {
        machine.air = read();
        if (machine.air) machine.no_air.clear();
    } catch (const MemoryError&) {
        throw;
    } catch (const Error& error) {
        machine.no_air = text("the airfoils of the model cannot be read (", error.what(), ")");
    }
}

// Of the first blade's structure along the pitch axis, from its root, m.
double blade_end(const TurbineDescription& machine) {
    const BeamLine& line = machine.blade.line;
    return line.pose(line.length).p.x();
}

// None: the model has no file of it.
std::optional<Aerodynamics> openfast_air(const std::filesystem::path& path, Machine& machine) {
    OpenFastFile main = OpenFastFile::read(path);
    Site& site = machine.site;
    site.density = main.number_or_default("AirDens", site.density);
    site.viscosity = main.number_or_default("KinVisc", site.viscosity);
    const char* const keyword = main.has("AeroFile") ? "AeroFile" : "ADFile";  // of FAST 7
    if (!main.has(keyword)) return std::nullopt;
    const TurbineDescription& d = machine.description;
    return air_of(read_aerodyn(main.path(keyword), d.hub.radius, site.density, site.viscosity, blade_end(d)));
}

Machine read_file(const std::filesystem::path& path, const std::vector<ModelAddition>& additions) {
    if (is_yaml(path) && !is_description(text_file(path))) {
        Machine machine = machine_of(read_windio(path, additions));
        add_air(machine, [&] {
            return std::optional(air_of(read_windio_air(path, machine.description.hub.radius, additions)));
        });
        return machine;
    }
    refuse(additions);
    if (const std::string ending = lower_case(path.extension().string()); ending == ".bts" || ending == ".wnd")
        throw FileError(path.string(), "is a wind and no machine (cardan wind looks at it)");
    if (is_yaml(path)) return parse_machine(text_file(path), path.string());
    if (is_result(path)) return parse_machine(machine_text(input_description(path), path.string()), path.string());
    Machine machine = machine_of(read_openfast(path));
    add_air(machine, [&] { return openfast_air(path, machine); });
    return machine;
}

// A word that can only be meant as a name.
bool is_word(const std::filesystem::path& path) {
    std::error_code error;
    return !path.has_parent_path() && !path.has_extension() && !std::filesystem::exists(path, error);
}

std::string names_of_machines() {
    std::string names;
    for (const BuiltInMachine& one : built_in_machines()) names += text(names.empty() ? "" : ", ", one.name);
    return names;
}

}  // namespace

bool is_yaml(const std::filesystem::path& path) {
    const std::string ending = lower_case(path.extension().string());
    return ending == ".yaml" || ending == ".yml";
}

Machine read_machine(const std::string& machine, const std::vector<ModelAddition>& additions) {
    if (std::optional<Machine> built_in = built_in_machine(machine)) {
        refuse(additions);
        return *std::move(built_in);
    }
    if (is_word(machine)) throw InputError("machine", "name", machine, text(names_of_machines(), ", or a file"));
    return read_file(machine, additions);
}

Aerodynamics read_air(const std::filesystem::path& path, const Machine& machine) {
    const double hub_radius = machine.description.hub.radius;
    if (is_yaml(path)) return air_of(read_windio_air(path, hub_radius));
    return air_of(
        read_aerodyn(path, hub_radius, machine.site.density, machine.site.viscosity, blade_end(machine.description)));
}

std::vector<Operation> read_schedule(const std::filesystem::path& path) {
    const CsvTable table = CsvTable::read(path);
    const auto wind = table.column("wind", "m/s"), speed = table.column("rotor_speed", "rpm"),
               pitch = table.column("pitch", "deg");
    std::vector<Operation> schedule;
    schedule.reserve(table.rows());
    for (std::size_t i = 0; i < table.rows(); ++i)
        schedule.push_back({wind[i], speed[i] * units::rpm, pitch[i] * units::degree});
    return schedule;
}

}  // namespace cardan::turbines
