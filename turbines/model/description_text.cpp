// Descriptions as text. Writing needs no YAML library, so that every machine can say what it is.
#include "turbines/model/description_text.hpp"

#include "mbs/base/pending_file.hpp"
#include "turbines/model/detail/description_writer.hpp"

namespace cardan::turbines {

namespace {

std::string written(const TurbineDescription& description, BeamLines lines) {
    Writer writer(lines);
    writer.out = text(description_comment, "cardan_turbine: ", description_yaml_version, "\n");
    description_fields(writer, description);
    return writer.out;
}

}  // namespace

std::string to_yaml(const TurbineDescription& description) {
    description.require_complete();
    return written(description, BeamLines::exact);
}

std::string description_text(const TurbineDescription& description) {
    return written(description, BeamLines::near);
}

void write_description(const TurbineDescription& description, const std::filesystem::path& path) {
    write_file(path, to_yaml(description));
}

}  // namespace cardan::turbines
