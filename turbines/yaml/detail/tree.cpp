#include "turbines/yaml/detail/tree.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

namespace cardan::turbines {

namespace {

using Kind = YamlTree::Kind;

/// Receives the parser's events one by one, so that it can stop the parser when a limit is exceeded.
class Builder : public YAML::EventHandler {
public:
    Builder(const std::string& file, const YamlLimits& limits) : file_(file), limits_(limits) {}

    void OnDocumentStart(const YAML::Mark&) override {}
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { leaf(Kind::null, mark, anchor, {}); }
    void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  const std::string& value) override {
        leaf(Kind::scalar, mark, anchor, value);
    }
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        const YamlTree* target = anchors_.at(anchor);
        if (std::find(open_.begin(), open_.end(), target) != open_.end())
            fail(mark, "an alias of what it is itself a part of");
        count(mark, *target);
        attach(mark, *target);
    }
    void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                         YAML::EmitterStyle::value) override {
        open_.push_back(&made(Kind::list, mark, anchor));
    }
    void OnSequenceEnd() override { close(); }
    void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value) override {
        open_.push_back(&made(Kind::map, mark, anchor));
    }
    void OnMapEnd() override { close(); }

    YamlTrees trees;

private:
    [[noreturn]] void fail(const YAML::Mark& mark, std::string_view what) const {
        throw ParseError(file_, mark.line + 1, mark.column + 1, what);
    }

    void leaf(Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor, const std::string& value) {
        YamlTree& tree = made(kind, mark, anchor);
        tree.scalar = value;
        attach(mark, tree);
    }

    YamlTree& made(Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
        YamlTree& tree = *trees.emplace_back(std::make_unique<YamlTree>());
        tree.kind = kind;
        tree.line = mark.line + 1;
        tree.column = mark.column + 1;
        count(mark, tree);
        if (anchor != 0) anchors_[anchor] = &tree;
        return tree;
    }

    // Before it is attached: with what it has by now.
    void count(const YAML::Mark& mark, const YamlTree& tree) {
        nodes_ += tree.nodes;
        if (nodes_ > limits_.nodes)
            fail(mark, text("more than ", limits_.nodes, " nodes, counting what aliases stand for, are not read"));
        if (open_.size() + tree.depth > limits_.depth)
            fail(mark, text("lists and maps nested deeper than ", limits_.depth, " are not read"));
    }

    void attach(const YAML::Mark& mark, const YamlTree& tree) {
        if (open_.empty()) return;
        YamlTree& into = *open_.back();
        if (into.kind == Kind::map && into.children.size() % 2 == 0 && tree.scalar.size() > limits_.key)
            fail(mark, text("a key of ", tree.scalar.size(), " bytes; allowed: at most ", limits_.key));
        into.children.push_back(&tree);
        into.nodes += tree.nodes;
        into.depth = std::max(into.depth, tree.depth + 1);
    }

    void close() {
        const YamlTree& tree = *open_.back();
        open_.pop_back();
        YAML::Mark mark;
        mark.line = tree.line - 1;
        mark.column = tree.column - 1;
        attach(mark, tree);
    }

    const std::string& file_;
    YamlLimits limits_;
    std::vector<YamlTree*> open_;
    std::map<YAML::anchor_t, const YamlTree*> anchors_;
    std::size_t nodes_ = 0;
};

/// YAML allows tabulators and line ends only; the parser takes 0x04 for the end of the text.
void refuse_control_characters(const std::string& text, const std::string& file) {
    int line = 1;
    for (const char c : text) {
        if (c == '\n') ++line;
        const auto code = static_cast<unsigned char>(c);
        if ((code < 0x20 && c != '\n' && c != '\r' && c != '\t') || code == 0x7F)
            throw ParseError(file, line, 0,
                             cardan::text("is not YAML: the control character ", int{code}, " (in quotes: \\x...)"));
    }
}

void check_size(const std::string& text, const std::string& file, const YamlLimits& limits) {
    if (text.size() > limits.bytes)
        throw ParseError(file, 1, 0, cardan::text(text.size(), " bytes of YAML; allowed: at most ", limits.bytes));
    int line = 1;
    for (std::size_t begin = 0; begin < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        if (end - begin > limits.line)
            throw ParseError(file, line, 0,
                             cardan::text("a line of ", end - begin, " bytes; allowed: at most ", limits.line));
        begin = end + 1;
    }
}

}  // namespace

YamlTrees yaml_trees(const std::string& text, const std::string& file, const YamlLimits& limits) {
    require_text(text, file);
    check_size(text, file, limits);
    refuse_control_characters(text, file);
    std::istringstream in(text);
    Builder builder(file, limits);
    try {
        YAML::Parser parser(in);
        if (!parser.HandleNextDocument(builder)) throw ParseError(file, 1, 0, "no YAML document; allowed: 1");
        YamlTrees trees = std::move(builder.trees);
        builder.trees.clear();
        if (parser.HandleNextDocument(builder)) throw ParseError(file, 1, 0, "several YAML documents; allowed: 1");
        return trees;
    } catch (const YAML::Exception& error) {
        throw ParseError(file, std::max(error.mark.line, 0) + 1, std::max(error.mark.column, 0) + 1,
                         cardan::text("is not YAML: ", error.msg));
    }
}

}  // namespace cardan::turbines
