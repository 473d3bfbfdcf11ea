#include "solvers/hdf5/detail/checks.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"

#include <algorithm>

namespace cardan::solvers::detail {

void refuse(const std::string& path, std::string_view object, std::string_view why) {
    throw InputError(text(path, ": ", object, ": ", why));
}

std::string flaw(std::string_view s) {
    if (s.find('\0') != std::string_view::npos) return "contains a NUL";
    return is_utf8(s) ? "" : "is not UTF-8";
}

std::string checked_name(const std::string& path, std::string_view name) {
    if (name.starts_with('/')) name.remove_prefix(1);
    bool good = flaw(name).empty();
    for (std::size_t start = 0; start <= name.size();) {
        const std::size_t end = std::min(name.find('/', start), name.size());
        const std::string_view part = name.substr(start, end - start);
        good = good && !part.empty() && part != "." && part != "..";
        start = end + 1;
    }
    if (!good)
        refuse(path, text("'", name, "'"),
               "is not a name; allowed: parts in UTF-8 that are not empty, with / between them");
    return std::string(name);
}

void check_attributes(const std::string& path, std::string_view object, const Attributes& attributes) {
    for (const Attribute& a : attributes) {
        const auto* value = std::get_if<std::string>(&a.value);
        if (a.name.empty() || !flaw(a.name).empty()) refuse(path, object, "an attribute has no name in UTF-8");
        if (value != nullptr && !flaw(*value).empty())
            refuse(path, object, text("attribute ", a.name, " ", flaw(*value)));
    }
}

Attributes checked_attributes(const std::string& path, std::string_view object, const Description& about) {
    if (about.units.empty()) refuse(path, object, "units are missing; write \"1\" for a pure number");
    if (about.long_name.empty()) refuse(path, object, "long_name is missing");
    Attributes all{{"units", about.units}, {"long_name", about.long_name}};
    all.insert(all.end(), about.more.begin(), about.more.end());
    check_attributes(path, object, all);
    return all;
}

}  // namespace cardan::solvers::detail
