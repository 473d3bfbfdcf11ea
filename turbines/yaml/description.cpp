#include "turbines/yaml/description.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "turbines/yaml/detail/description_reader.hpp"

namespace cardan::turbines {

TurbineDescription parse_description(const std::string& text, const std::string& file) {
    DescriptionReader reader(YamlNode::parse(text, file));
    TurbineDescription description;
    reader.version();
    description_fields(reader, description);
    reader.since(3, [&] { reader.pass_over(machine_keys); });
    reader.finish();
    return description;
}

TurbineDescription read_description(const std::filesystem::path& path) {
    return parse_description(text_file(path), path.string());
}

bool is_description(const std::string& text) {
    try {
        return YamlNode::parse(text, "").find("cardan_turbine").has_value();
    } catch (const ParseError&) {
        return text.find("cardan_turbine") != std::string::npos;
    }
}

}  // namespace cardan::turbines
