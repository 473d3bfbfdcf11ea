#include "turbines/machine/machine_text.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/pending_file.hpp"
#include "turbines/machine/detail/machine_fields.hpp"
#include "turbines/model/description_text.hpp"
#include "turbines/model/detail/description_writer.hpp"
#include "turbines/yaml/detail/description_reader.hpp"

#include <utility>

namespace cardan::turbines {

namespace {

std::string written(const Machine& machine, BeamLines lines) {
    Writer writer(lines);
    writer.out = text(description_comment, "cardan_turbine: ", description_yaml_version, "\n");
    description_fields(writer, machine.description);
    std::optional<AirFields> air;
    if (machine.air) air = fields_of(*machine.air);
    machine_fields(writer, machine, std::as_const(air));
    return writer.out;
}

}  // namespace

std::string to_yaml(const Machine& machine) {
    machine.description.require_complete();
    return written(machine, BeamLines::exact);
}

void write_machine(const Machine& machine, const std::filesystem::path& path) {
    write_file(path, to_yaml(machine));
}

Machine parse_machine(const std::string& text, const std::string& file) {
    DescriptionReader reader(YamlNode::parse(text, file));
    TurbineDescription description;
    reader.version();
    description_fields(reader, description);
    Machine machine = machine_of(std::move(description));
    std::optional<AirFields> air;
    reader.since(3, [&] { machine_fields(reader, machine, air); });
    if (air) {
        reader.make_of("air", [&] { machine.air = aerodynamics_of(*std::move(air)); });
        machine.no_air.clear();
    }
    reader.finish();
    if (const std::string why = refusal_of(machine.description); !why.empty())
        throw InputError(cardan::text(file, ": ", why));
    if (!machine.air && machine.no_air.empty()) machine.no_air = Machine().no_air;
    return machine;
}

std::string with_machine(std::string description, Machine machine) {
    machine.description.source.clear();
    if (machine.description.platform) machine.description.platform->source.clear();
    const std::size_t at = description.rfind(computed_machine);
    if (at != std::string::npos) description.erase(at);
    return text(description, computed_machine, written(machine, BeamLines::near));
}

}  // namespace cardan::turbines
