/// @file
/// YAML with errors that name file, line, column, place in the document and what was expected. Internal to the readers
/// of YAML models: not installed.
#pragma once

#include "turbines/yaml/detail/tree.hpp"
#include "turbines/yaml/model_addition.hpp"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cardan::turbines {

/// A node and where it is. All reading functions throw ParseError if the node is of another kind.
class YamlNode {
public:
    /// The only document of a text, with what others add: a map to a map, by keys; anything else replaces what is
    /// there. @throws ParseError, see yaml_trees(), and if one is not a map
    static YamlNode parse(const std::string& text, const std::string& file,
                          const std::vector<ModelAddition>& additions = {}, const YamlLimits& limits = {});

    const std::string& file() const { return document_->files[static_cast<std::size_t>(tree_->document)]; }
    const std::string& path() const { return path_; }  ///< "components.blade"
    int line() const { return tree_->line; }
    bool is_map() const { return tree_->kind == YamlTree::Kind::map; }
    bool is_list() const { return tree_->kind == YamlTree::Kind::list; }

    /// True if it was requested, by key or as an item of a list.
    bool was_read() const { return document_->read.contains(path_); }

    /// Entry of a map. @throws ParseError listing the existing keys
    YamlNode operator[](std::string_view key) const;
    std::optional<YamlNode> find(std::string_view key) const;
    /// Entry by a dotted path, "structure.elastic_properties"; none if any part of it does not exist.
    std::optional<YamlNode> find_path(std::string_view keys) const;
    std::vector<std::string> keys() const;
    /// All entries of the map; they do not count as read.
    std::vector<YamlNode> entries() const;
    std::vector<YamlNode> items() const;

    std::string word() const;
    bool flag() const;
    int integer(int min, int max) const;
    /// A finite number, optionally also infinite (".inf").
    double number(bool or_infinite = false) const;
    std::vector<double> numbers(bool or_infinite = false) const;
    /// Exactly `count` numbers.
    std::vector<double> numbers(std::size_t count) const;

    [[noreturn]] void fail(std::string_view what) const;

private:
    struct Document {
        std::vector<std::string> files;
        YamlTrees trees;
        std::set<std::string> read;                // paths
        std::set<const YamlTree*> with_good_keys;  // maps that were looked at
    };
    YamlNode(const YamlTree& tree, std::string path, std::shared_ptr<Document> document);
    YamlNode child(const YamlTree& tree, std::string path) const;
    std::string path_of(std::string_view key) const;
    const std::string& scalar(const char* expected) const;
    void require_map() const;

    const YamlTree* tree_;
    std::string path_;
    std::shared_ptr<Document> document_;
};

}  // namespace cardan::turbines
