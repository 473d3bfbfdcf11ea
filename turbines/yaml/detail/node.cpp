#include "turbines/yaml/detail/node.hpp"

#include "mbs/base/error.hpp"

#include <limits>
#include <set>
#include <system_error>

namespace cardan::turbines {

YamlNode::YamlNode(const YamlTree& tree, std::string path, std::shared_ptr<Document> document)
    : tree_(&tree), path_(std::move(path)), document_(std::move(document)) {}

YamlNode YamlNode::child(const YamlTree& tree, std::string path) const {
    document_->read.insert(path);
    return {tree, std::move(path), document_};
}

namespace {

// The trees of a document whose root is a map.
YamlTrees maps(const std::string& text, const std::string& file, int document, const YamlLimits& limits) {
    YamlTrees trees = yaml_trees(text, file, limits);
    if (trees.empty() || trees.front()->kind != YamlTree::Kind::map)
        throw ParseError(file, 1, 0, "a YAML map expected");
    for (const auto& tree : trees) tree->document = document;
    return trees;
}

// a with what b adds; what is made goes to `trees`.
const YamlTree& merged(const YamlTree& a, const YamlTree& b, YamlTrees& trees) {
    if (a.kind != YamlTree::Kind::map || b.kind != YamlTree::Kind::map) return b;
    YamlTree& out = *trees.emplace_back(std::make_unique<YamlTree>(a));
    for (std::size_t i = 0; i < b.children.size(); i += 2) {
        const YamlTree &key = *b.children[i], &value = *b.children[i + 1];
        std::size_t k = 0;
        while (k < a.children.size() && a.children[k]->scalar != key.scalar) k += 2;
        if (k < a.children.size())
            out.children[k + 1] = &merged(*a.children[k + 1], value, trees);
        else
            out.children.insert(out.children.end(), {&key, &value});
    }
    return out;
}

}  // namespace

YamlNode YamlNode::parse(const std::string& text, const std::string& file, const std::vector<ModelAddition>& additions,
                         const YamlLimits& limits) {
    auto document = std::make_shared<Document>(Document{{file}, maps(text, file, 0, limits), {}, {}});
    const YamlTree* root = document->trees.front().get();
    for (const ModelAddition& addition : additions) {
        YamlTrees more = maps(addition.text, addition.name, static_cast<int>(document->files.size()), limits);
        const YamlTree& added = *more.front();
        document->files.push_back(addition.name);
        document->trees.insert(document->trees.end(), std::move_iterator(more.begin()), std::move_iterator(more.end()));
        root = &merged(*root, added, document->trees);
    }
    return {*root, "", std::move(document)};
}

void YamlNode::fail(std::string_view what) const {
    throw ParseError(file(), line(), tree_->column, path_.empty() ? std::string(what) : text(path_, ": ", what));
}

std::string YamlNode::path_of(std::string_view key) const {
    return path_.empty() ? std::string(key) : text(path_, ".", key);
}

void YamlNode::require_map() const {
    if (!is_map()) fail("a map (key: value) expected");
    if (document_->with_good_keys.contains(tree_)) return;
    std::set<std::string_view> seen;
    for (std::size_t i = 0; i < tree_->children.size(); i += 2) {
        const YamlTree& key = *tree_->children[i];
        if (key.kind != YamlTree::Kind::scalar) fail("a key is not a word");
        if (!seen.insert(key.scalar).second) fail(text("the key '", key.scalar, "' is there twice"));
    }
    document_->with_good_keys.insert(tree_);
}

std::optional<YamlNode> YamlNode::find(std::string_view key) const {
    require_map();
    for (std::size_t i = 0; i < tree_->children.size(); i += 2)
        if (tree_->children[i]->scalar == key) return child(*tree_->children[i + 1], path_of(key));
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
    for (std::size_t i = 0; i < tree_->children.size(); i += 2) all.push_back(tree_->children[i]->scalar);
    return all;
}

std::vector<YamlNode> YamlNode::entries() const {
    require_map();
    std::vector<YamlNode> all;
    for (std::size_t i = 0; i < tree_->children.size(); i += 2)
        all.push_back({*tree_->children[i + 1], path_of(tree_->children[i]->scalar), document_});
    return all;
}

std::vector<YamlNode> YamlNode::items() const {
    if (!is_list()) fail("a list expected");
    std::vector<YamlNode> all;
    for (std::size_t i = 0; i < tree_->children.size(); ++i)
        all.push_back(child(*tree_->children[i], text(path_, "[", i, "]")));
    return all;
}

const std::string& YamlNode::scalar(const char* expected) const {
    if (tree_->kind != YamlTree::Kind::scalar) fail(expected);
    return tree_->scalar;
}

std::string YamlNode::word() const {
    return scalar("a text expected");
}

bool YamlNode::flag() const {
    const std::string w = word();
    if (w == "true") return true;
    if (w == "false") return false;
    fail(text("'", w, "' is neither true nor false"));
}

double YamlNode::number(bool or_infinite) const {
    const std::string& digits = scalar("a number expected");
    if (or_infinite && digits == ".inf") return std::numeric_limits<double>::infinity();
    const ReadNumber number = read_number(digits);
    if (!number.good()) fail(text("'", digits, "' is not a finite number"));
    return number.value;
}

int YamlNode::integer(int min, int max) const {
    const double value = number();
    if (value != std::round(value) || value < min || value > max) fail(text(value, "; allowed: ", min, " ... ", max));
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
