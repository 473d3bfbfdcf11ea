#include "turbines/description_yaml_node.hpp"

#include "mbs/error.hpp"

#include <charconv>
#include <limits>
#include <set>
#include <system_error>

namespace cardan::turbines {

YamlNode::YamlNode(const YAML::Node& node, std::string path, std::shared_ptr<Document> document)
    : node_(node), path_(std::move(path)), document_(std::move(document)) {}

YamlNode YamlNode::child(const YAML::Node& node, std::string path) const {
    document_->read.insert(path);
    return {node, std::move(path), document_};
}

YamlNode YamlNode::parse(const std::string& text, const std::string& file) {
    try {
        const std::vector<YAML::Node> documents = YAML::LoadAll(text);
        if (documents.size() != 1)
            throw ParseError(file, 1, 0, cardan::text(documents.size(), " YAML documents; allowed: 1"));
        YamlNode root(documents.front(), "", std::make_shared<Document>(Document{file, {}}));
        if (!root.is_map()) throw ParseError(file, 1, 0, "a YAML map expected");
        return root;
    } catch (const YAML::Exception& error) {
        throw ParseError(file, std::max(error.mark.line, 0) + 1, std::max(error.mark.column, 0) + 1,
                         cardan::text("is not YAML: ", error.msg));
    }
}

int YamlNode::line() const {
    return std::max(node_.Mark().line, 0) + 1;
}

void YamlNode::fail(std::string_view what) const {
    throw ParseError(file(), line(), std::max(node_.Mark().column, 0) + 1,
                     path_.empty() ? std::string(what) : text(path_, ": ", what));
}

void YamlNode::require_map() const {
    if (!node_.IsMap()) fail("a map (key: value) expected");
    std::set<std::string> seen;
    for (const auto& entry : node_) {
        if (!entry.first.IsScalar()) fail("a key is not a word");
        if (!seen.insert(entry.first.Scalar()).second)
            fail(text("the key '", entry.first.Scalar(), "' is there twice"));
    }
}

std::optional<YamlNode> YamlNode::find(std::string_view key) const {
    require_map();
    for (const auto& entry : node_)
        if (entry.first.Scalar() == key)
            return child(entry.second, path_.empty() ? std::string(key) : text(path_, ".", key));
    return std::nullopt;
}

YamlNode YamlNode::operator[](std::string_view key) const {
    if (std::optional<YamlNode> found = find(key)) return *std::move(found);
    std::string known;
    for (const std::string& other : keys()) known += (known.empty() ? "" : ", ") + other;
    fail(text("no '", key, "'; there are: ", known));
}

std::optional<YamlNode> YamlNode::find_path(std::string_view keys) const {
    const std::size_t dot = keys.find('.');
    std::optional<YamlNode> found = find(keys.substr(0, dot));
    if (!found || dot == std::string_view::npos) return found;
    return found->find_path(keys.substr(dot + 1));
}

std::vector<std::string> YamlNode::keys() const {
    require_map();
    std::vector<std::string> all;
    for (const auto& entry : node_) all.push_back(entry.first.Scalar());
    return all;
}

std::vector<YamlNode> YamlNode::entries() const {
    require_map();
    std::vector<YamlNode> all;
    for (const auto& entry : node_) {
        const std::string& key = entry.first.Scalar();
        all.push_back({entry.second, path_.empty() ? key : text(path_, ".", key), document_});
    }
    return all;
}

std::vector<YamlNode> YamlNode::items() const {
    if (!node_.IsSequence()) fail("a list expected");
    std::vector<YamlNode> all;
    for (std::size_t i = 0; i < node_.size(); ++i) all.push_back(child(node_[i], text(path_, "[", i, "]")));
    return all;
}

std::string YamlNode::word() const {
    if (!node_.IsScalar()) fail("a text expected");
    return node_.Scalar();
}

bool YamlNode::flag() const {
    const std::string w = word();
    if (w == "true") return true;
    if (w == "false") return false;
    fail(text("'", w, "' is neither true nor false"));
}

double YamlNode::number(bool or_infinite) const {
    if (!node_.IsScalar()) fail("a number expected");
    const std::string& digits = node_.Scalar();
    if (or_infinite && digits == ".inf") return std::numeric_limits<double>::infinity();
    const char* begin = digits.data();
    const char* const end = begin + digits.size();
    if (digits.size() > 1 && *begin == '+' && begin[1] != '-') ++begin;
    double value = 0;
    const auto [last, error] = std::from_chars(begin, end, value);
    if (error != std::errc() || last != end || begin == end || !std::isfinite(value))
        fail(text("'", digits, "' is not a finite number"));
    return value;
}

int YamlNode::integer(int least, int most) const {
    const double value = number();
    if (value != std::round(value) || value < least || value > most)
        fail(text(value, "; allowed: ", least, " ... ", most));
    return static_cast<int>(value);
}

std::vector<double> YamlNode::numbers(bool or_infinite) const {
    std::vector<double> all;
    for (const YamlNode& item : items()) all.push_back(item.number(or_infinite));
    return all;
}

std::vector<double> YamlNode::numbers(std::size_t count) const {
    std::vector<double> all = numbers();
    if (all.size() != count) fail(text(all.size(), " numbers; allowed: ", count));
    return all;
}

}  // namespace cardan::turbines
