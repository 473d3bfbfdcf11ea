// Names of files in OpenFAST's files.
#include "mbs/base/error.hpp"
#include "mbs/base/text.hpp"
#include "turbines/readers/detail/openfast_words.hpp"
#include "turbines/readers/openfast_file.hpp"

#include <algorithm>

namespace cardan::turbines {

namespace {

// The entry of a folder with this name but for its case, the first one in the alphabet; empty: there is none.
std::filesystem::path in_any_case(const std::filesystem::path& folder, const std::filesystem::path& name) {
    const std::string wanted = lower_case(name.string());
    std::filesystem::path found;
    std::error_code error;
    for (const auto& one : std::filesystem::directory_iterator(folder.empty() ? "." : folder, error)) {
        const std::filesystem::path own = one.path().filename();
        if (lower_case(own.string()) == wanted && (found.empty() || own < found)) found = own;
    }
    return found;
}

// Many models are written under Windows, where the case of a name does not matter: what is not there as it is written
// is looked for in any case.
std::filesystem::path existing(const std::filesystem::path& wanted) {
    std::error_code error;
    if (std::filesystem::exists(wanted, error)) return wanted;
    std::filesystem::path at;
    for (const std::filesystem::path& part : wanted) {
        const std::filesystem::path own =
            std::filesystem::exists(at / part, error) || part == ".." || part == "." ? part : in_any_case(at, part);
        if (own.empty()) return wanted;
        at /= own;
    }
    return at;
}

}  // namespace

std::filesystem::path file_beside(const std::filesystem::path& file, std::string name) {
    constexpr auto around = " \t";
    std::replace(name.begin(), name.end(), '\\', '/');
    name.erase(0, name.find_first_not_of(around));
    name.erase(name.find_last_not_of(around) + 1);
    return name.empty() ? std::filesystem::path() : existing(file.parent_path() / name);
}

std::filesystem::path OpenFastFile::beside(const std::string& given, int line, std::string_view keyword) const {
    std::filesystem::path path = file_beside(file_, given);
    if (path.empty()) throw ParseError(file_, line, 0, cardan::text(keyword, ": the name of the file is empty"));
    return path;
}

std::filesystem::path OpenFastFile::path(std::string_view keyword) {
    return beside(word(keyword), known(keyword).number, keyword);
}

std::filesystem::path OpenFastFile::path_of(std::string_view keyword, std::size_t part) {
    const Token& token = token_of(keyword, part);
    return beside(token.text, line_of(keyword, part).number, keyword);
}

std::vector<std::filesystem::path> OpenFastFile::paths(std::string_view keyword, std::size_t count) {
    std::vector<std::filesystem::path> all;
    for (auto line = lines_.begin() + (&known(keyword) - lines_.data()); all.size() < count; ++line) {
        // A name that stands alone and without quotes is taken for a keyword.
        const bool none = line == lines_.end() || (line->heading && !line->blank) ||
                          (line->tokens.empty() && !line->blank && (all.empty() || line->keyword.empty()));
        if (none)
            throw ParseError(file_, line == lines_.end() ? lines_.back().number : line->number, 0,
                             cardan::text(keyword, ": ", count, " names of files expected, found ", all.size()));
        line->used = true;
        if (line->blank) continue;
        all.push_back(beside(line->tokens.empty() ? line->keyword : line->tokens.front().text, line->number, keyword));
    }
    return all;
}

}  // namespace cardan::turbines
