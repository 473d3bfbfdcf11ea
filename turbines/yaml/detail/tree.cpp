#include "turbines/yaml/detail/tree.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <yaml.h>

namespace cardan::turbines {

namespace {

using Kind = YamlTree::Kind;

int line_of(const yaml_mark_t& mark) {
    return static_cast<int>(mark.line) + 1;
}
int column_of(const yaml_mark_t& mark) {
    return static_cast<int>(mark.column) + 1;
}

std::string text_of(const yaml_char_t* word) {
    return word == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(word));
}

/// libyaml's parser: one event after the other, so that it can be left when a limit is exceeded.
class Events {
public:
    Events(const std::string& text, const std::string& file) : file_(file) {
        if (yaml_parser_initialize(&parser_) == 0) throw std::bad_alloc();
        yaml_parser_set_encoding(&parser_, YAML_UTF8_ENCODING);
        yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()), text.size());
    }
    Events(const Events&) = delete;
    Events& operator=(const Events&) = delete;
    ~Events() {
        yaml_event_delete(&event_);
        yaml_parser_delete(&parser_);
    }

    /// Valid until the next call. @throws ParseError for what is not YAML
    const yaml_event_t& next() {
        yaml_event_delete(&event_);
        event_ = {};
        if (yaml_parser_parse(&parser_, &event_) == 0) fail();
        return event_;
    }

private:
    [[noreturn]] void fail() const {
        if (parser_.error == YAML_MEMORY_ERROR) throw std::bad_alloc();
        const yaml_mark_t& mark = parser_.problem_mark;
        throw ParseError(file_, line_of(mark), column_of(mark),
                         text("is not YAML: ", parser_.problem == nullptr ? "" : parser_.problem,
                              parser_.context == nullptr ? "" : text(" (", parser_.context, ")")));
    }

    const std::string& file_;
    yaml_parser_t parser_{};
    yaml_event_t event_{};
};

// YAML 1.1, 10.3: what stands for nothing.
bool is_null(const yaml_event_t& event) {
    const auto& scalar = event.data.scalar;
    if (scalar.style != YAML_PLAIN_SCALAR_STYLE || scalar.tag != nullptr) return false;
    const std::string_view value(reinterpret_cast<const char*>(scalar.value), scalar.length);
    return value.empty() || value == "~" || value == "null" || value == "Null" || value == "NULL";
}

/// Makes the tree from the events.
class Builder {
public:
    Builder(const std::string& file, const YamlLimits& limits) : file_(file), limits_(limits) {}

    void take(const yaml_event_t& event) {
        switch (event.type) {
            case YAML_DOCUMENT_START_EVENT:
                if (++documents_ > 1) throw ParseError(file_, 1, 0, "several YAML documents; allowed: 1");
                break;
            case YAML_ALIAS_EVENT:
                alias(event);
                break;
            case YAML_SCALAR_EVENT:
                scalar(event);
                break;
            case YAML_SEQUENCE_START_EVENT:
                open_.push_back(&made(Kind::list, event, event.data.sequence_start.anchor));
                break;
            case YAML_MAPPING_START_EVENT:
                open_.push_back(&made(Kind::map, event, event.data.mapping_start.anchor));
                break;
            case YAML_SEQUENCE_END_EVENT:
            case YAML_MAPPING_END_EVENT:
                close();
                break;
            default:
                break;
        }
    }
    int documents() const { return documents_; }

    YamlTrees trees;

private:
    [[noreturn]] void fail(const yaml_mark_t& mark, std::string_view what) const {
        throw ParseError(file_, line_of(mark), column_of(mark), what);
    }

    void alias(const yaml_event_t& event) {
        const std::string name = text_of(event.data.alias.anchor);
        const auto anchor = anchors_.find(name);
        if (anchor == anchors_.end()) fail(event.start_mark, text("is not YAML: no anchor '", name, "' before"));
        const YamlTree* target = anchor->second;
        if (std::find(open_.begin(), open_.end(), target) != open_.end())
            fail(event.start_mark, "an alias of what it is itself a part of");
        count(event.start_mark, *target);
        attach(event.start_mark, *target);
    }

    void scalar(const yaml_event_t& event) {
        YamlTree& tree = made(is_null(event) ? Kind::null : Kind::scalar, event, event.data.scalar.anchor);
        tree.scalar.assign(reinterpret_cast<const char*>(event.data.scalar.value), event.data.scalar.length);
        attach(event.start_mark, tree);
    }

    YamlTree& made(Kind kind, const yaml_event_t& event, const yaml_char_t* anchor) {
        YamlTree& tree = *trees.emplace_back(std::make_unique<YamlTree>());
        tree.kind = kind;
        tree.line = line_of(event.start_mark);
        tree.column = column_of(event.start_mark);
        count(event.start_mark, tree);
        if (anchor != nullptr) anchors_[text_of(anchor)] = &tree;
        return tree;
    }

    // Before it is attached: with what it has by now.
    void count(const yaml_mark_t& mark, const YamlTree& tree) {
        nodes_ += tree.nodes;
        if (nodes_ > limits_.nodes)
            fail(mark, text("more than ", limits_.nodes, " nodes, counting what aliases stand for, are not read"));
        if (open_.size() + tree.depth > limits_.depth)
            fail(mark, text("lists and maps nested deeper than ", limits_.depth, " are not read"));
    }

    void attach(const yaml_mark_t& mark, const YamlTree& tree) {
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
        yaml_mark_t mark{};
        mark.line = static_cast<std::size_t>(tree.line) - 1;
        mark.column = static_cast<std::size_t>(tree.column) - 1;
        attach(mark, tree);
    }

    const std::string& file_;
    YamlLimits limits_;
    std::vector<YamlTree*> open_;
    std::map<std::string, const YamlTree*> anchors_;
    std::size_t nodes_ = 0;
    int documents_ = 0;
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
    Builder builder(file, limits);
    Events events(text, file);
    for (bool more = true; more;) {
        const yaml_event_t& event = events.next();
        builder.take(event);
        more = event.type != YAML_STREAM_END_EVENT;
    }
    if (builder.documents() == 0) throw ParseError(file, 1, 0, "no YAML document; allowed: 1");
    return std::move(builder.trees);
}

}  // namespace cardan::turbines
