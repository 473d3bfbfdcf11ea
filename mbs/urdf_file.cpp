#include "mbs/error.hpp"
#include "mbs/pending_file.hpp"
#include "mbs/urdf.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace cardan {
namespace fs = std::filesystem;

UrdfModel read_urdf(const fs::path& file) {
    std::error_code code;
    if (fs::is_directory(file, code)) throw FileError(file.string(), "is a folder, not a file");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) throw FileError(file.string(), text("cannot be read: ", std::generic_category().message(errno)));
    const std::string xml{std::istreambuf_iterator<char>(in), {}};
    if (in.bad()) throw FileError(file.string(), "cannot be read to its end");
    return parse_urdf(xml, file.string());
}

void write_urdf(const fs::path& file, const Tree& tree, const UrdfExport& with) {
    write_file(file, to_urdf(tree, with));
}

}  // namespace cardan
