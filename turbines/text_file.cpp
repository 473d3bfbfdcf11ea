#include "turbines/text_file.hpp"

#include "mbs/error.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace cardan::turbines {

std::string text_file(const std::filesystem::path& path) {
    if (std::error_code code; std::filesystem::is_directory(path, code))
        throw FileError(path.string(), "is a folder, not a file");
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    std::string all{std::istreambuf_iterator<char>(in), {}};
    if (in.is_open() && !in.bad()) return all;
    const std::string reason = errno != 0 ? std::generic_category().message(errno) : "read error";
    throw FileError(path.string(), text("cannot be read: ", reason));
}

std::string lower_case(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

}  // namespace cardan::turbines
