#include "turbines/yaml/detail/windio_file.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"

#include <algorithm>

namespace cardan::turbines {

WindioFile::WindioFile(YamlNode root) : root_(std::move(root)) {
    const auto given = find({"windIO_version"});
    if (!given) return;
    const std::string version = given->word();
    if (!version.starts_with("1") && !version.starts_with("2"))
        given->fail(text("version ", version, "; allowed: 1.x and 2.x"));
    version_ = version[0] - '0';
    if (version_ == 2) angle_ = units::degree;
}

std::optional<YamlNode> WindioFile::find(std::initializer_list<const char*> paths) const {
    for (const char* path : paths)
        if (std::optional<YamlNode> found = root_.find_path(path)) return found;
    return std::nullopt;
}

YamlNode WindioFile::get(std::initializer_list<const char*> paths) const {
    if (std::optional<YamlNode> found = find(paths)) return *std::move(found);
    std::string all;
    for (const char* path : paths) all += (all.empty() ? "" : " or ") + std::string(path);
    // As far as the first one goes.
    YamlNode at = root_;
    std::string_view rest = *paths.begin();
    while (std::optional<YamlNode> next = at.find(rest.substr(0, rest.find('.')))) {
        at = *std::move(next);
        rest.remove_prefix(std::min(rest.find('.'), rest.size() - 1) + 1);
    }
    at.fail(text("no ", all));
}

void WindioFile::note(const YamlNode& node, std::string value, std::string why) {
    const std::string& path = node.path();
    const auto is_there = [&](const FileNote& other) { return other.keyword == path && other.why == why; };
    if (std::any_of(notes.begin(), notes.end(), is_there)) return;
    notes.push_back({node.file(), node.line(), node.path(), std::move(value), std::move(why)});
}

namespace {

// Of the blade's aerodynamics and the controller: one note for all.
bool is_of_group(const std::string& path) {
    return path.starts_with("control.") || path.starts_with("components.blade.outer_shape");
}

// In a node that was read, what was not.
void collect(const YamlNode& node, std::vector<FileNote>& out, std::vector<std::string>& group) {
    if (node.is_list())
        for (const YamlNode& item : node.items()) collect(item, out, group);
    if (!node.is_map()) return;
    for (const YamlNode& entry : node.entries())
        if (entry.was_read())
            collect(entry, out, group);
        else if (is_of_group(entry.path()))
            group.push_back(entry.path());
        else if (!entry.path().ends_with(".name"))
            out.push_back({entry.file(), entry.line(), entry.path(), "",
                           "not used: no part of the structure as it is modelled", FileNote::Kind::unused});
}

}  // namespace

std::vector<FileNote> WindioFile::unused() const {
    std::vector<FileNote> out;
    std::vector<std::string> group;
    for (const YamlNode& entry : root_.entries())
        if (!entry.was_read())
            group.push_back(entry.path());
        else if (entry.path() != "materials")  // of which others hold much
            collect(entry, out, group);
    std::string others;
    for (const std::string& path : group) others += (others.empty() ? "" : ", ") + path;
    if (!others.empty())
        out.push_back({root_.file(), 0, others, "",
                       "aerodynamics, control, costs, remarks: without meaning for the machine",
                       FileNote::Kind::unused});
    return out;
}

}  // namespace cardan::turbines
