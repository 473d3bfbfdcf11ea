/// @file
/// YAML with errors that name file, line, column, place in the document and what was expected. Inside of the readers of
/// YAML models: not installed.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>
#include <yaml-cpp/yaml.h>

namespace cardan::turbines {

/// A node and where it is. Everything that reads throws ParseError if the node is of another kind.
class YamlNode {
public:
    /// The only document of a text. @throws ParseError for what is no YAML
    static YamlNode parse(const std::string& text, const std::string& file);

    const std::string& file() const { return document_->file; }
    const std::string& path() const { return path_; }  ///< "components.blade"
    int line() const;
    bool is_map() const { return node_.IsMap(); }
    bool is_list() const { return node_.IsSequence(); }

    /// Was it asked for, by the key or as an item of a list?
    bool was_read() const { return document_->read.contains(path_); }

    /// Entry of a map. @throws ParseError with the keys there are
    YamlNode operator[](std::string_view key) const;
    std::optional<YamlNode> find(std::string_view key) const;
    /// By dots: "structure.elastic_properties"; none if one of the steps is not there.
    std::optional<YamlNode> find_path(std::string_view keys) const;
    std::vector<std::string> keys() const;
    /// All entries of the map; they do not count as read.
    std::vector<YamlNode> entries() const;
    std::vector<YamlNode> items() const;

    std::string word() const;
    bool flag() const;
    int integer(int least, int most) const;
    /// Finite, or infinite too (".inf").
    double number(bool or_infinite = false) const;
    std::vector<double> numbers(bool or_infinite = false) const;
    /// As many as `count`.
    std::vector<double> numbers(std::size_t count) const;

    [[noreturn]] void fail(std::string_view what) const;

private:
    struct Document {
        std::string file;
        std::set<std::string> read;  // paths
    };
    YamlNode(const YAML::Node& node, std::string path, std::shared_ptr<Document> document);
    YamlNode child(const YAML::Node& node, std::string path) const;
    void require_map() const;

    YAML::Node node_;
    std::string path_;
    std::shared_ptr<Document> document_;
};

}  // namespace cardan::turbines
