#include "mbs/error.hpp"
#include "mbs/urdf.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace cardan {
namespace fs = std::filesystem;

namespace {

std::string reason(int number) {
    return std::generic_category().message(number);
}

// Under a name of its own until it is complete; goes away if it does not get there.
class PartialFile {
public:
    explicit PartialFile(const fs::path& path) : path_(path), partial_(path.string() + ".partial") {}
    PartialFile(const PartialFile&) = delete;
    PartialFile& operator=(const PartialFile&) = delete;
    ~PartialFile() {
        std::error_code ignored;
        if (opened_ && !complete_) fs::remove(partial_, ignored);
    }

    void write(const std::string& contents) {
        errno = 0;
        std::ofstream out(partial_, std::ios::binary | std::ios::trunc);
        if (!out)
            throw FileError(path_.string(), text("cannot be written: ", reason(errno), " (", partial_.string(), ")"));
        opened_ = true;
        out << contents;
        out.close();
        if (!out) throw FileError(path_.string(), text("cannot be completed: ", reason(errno)));
    }

    void commit() {
        std::error_code code;
        fs::rename(partial_, path_, code);
        if (code) throw FileError(path_.string(), text("cannot be completed: ", code.message()));
        complete_ = true;
    }

private:
    fs::path path_, partial_;
    bool opened_ = false, complete_ = false;
};

void check_place(const fs::path& file) {
    if (file.empty()) throw FileError("(empty path)", "a file name is needed");
    std::error_code code;
    const fs::file_status there = fs::status(file, code);
    if (fs::is_directory(there)) throw FileError(file.string(), "is a folder, not a file");
    if (!file.has_filename()) throw FileError(file.string(), "a file name is needed");
    if (fs::exists(there) && !fs::is_regular_file(there))
        throw FileError(file.string(), "exists and is not an ordinary file; it is not replaced");
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, code))
        throw FileError(file.string(), text("the folder ", folder.string(), " does not exist"));
}

}  // namespace

UrdfModel read_urdf(const fs::path& file) {
    std::error_code code;
    if (fs::is_directory(file, code)) throw FileError(file.string(), "is a folder, not a file");
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) throw FileError(file.string(), text("cannot be read: ", reason(errno)));
    const std::string xml{std::istreambuf_iterator<char>(in), {}};
    if (in.bad()) throw FileError(file.string(), "cannot be read to its end");
    return parse_urdf(xml, file.string());
}

void write_urdf(const fs::path& file, const Tree& tree, const UrdfExport& with) {
    const std::string xml = to_urdf(tree, with);
    check_place(file);
    PartialFile partial(file);
    partial.write(xml);
    partial.commit();
}

}  // namespace cardan
