#include "mbs/base/pending_file.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/urdf/urdf.hpp"

namespace cardan {

UrdfModel read_urdf(const std::filesystem::path& file) {
    return parse_urdf(text_file(file), file.string());
}

void write_urdf(const std::filesystem::path& file, const Tree& tree, const UrdfExport& with) {
    write_file(file, to_urdf(tree, with));
}

}  // namespace cardan
