/// @file
/// Fills the fields of a description, or of a whole machine, from YAML. Internal to the readers of our own files: not
/// installed.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "turbines/model/description_text.hpp"
#include "turbines/model/detail/description_fields.hpp"
#include "turbines/yaml/detail/node.hpp"

#include <initializer_list>
#include <map>
#include <set>
#include <span>

namespace cardan::turbines {

/// One level of the document: remembers which keys were asked for.
class YamlLevel {
public:
    explicit YamlLevel(YamlNode node) : node_(std::move(node)) {}
    YamlNode operator[](const char* key) {
        asked_.insert(key);
        return node_[key];
    }
    std::optional<YamlNode> find(const char* key) {
        asked_.insert(key);
        return node_.find(key);
    }
    void pass_over(const char* key) { asked_.insert(key); }
    /// @throws ParseError at a key that nobody asked for
    void finish() const;
    const YamlNode& node() const { return node_; }

private:
    YamlNode node_;
    std::set<std::string> asked_;
};

/// The archive that reads: what `Writer` writes. What a file may leave out (optional_...) stays as it is.
class DescriptionReader {
public:
    explicit DescriptionReader(YamlNode root) { levels_.emplace_back(std::move(root)); }

    void version();
    void word(const char* key, std::string& value) { value = at()[key].word(); }
    void integer(const char* key, int& value, int max = max_counted) { value = at()[key].integer(0, max); }
    void flag(const char* key, bool& value) { value = at()[key].flag(); }
    void number(const char* key, double& value) { value = at()[key].number(); }
    void numbers(const char* key, std::vector<double>& values) { values = at()[key].numbers(); }
    void optional_word(const char* key, std::string& value) {
        if (at().find(key)) word(key, value);
    }
    void optional_flag(const char* key, bool& value) {
        if (at().find(key)) flag(key, value);
    }
    void optional_number(const char* key, double& value) {
        if (at().find(key)) number(key, value);
    }
    void optional_number(const char* key, std::optional<double>& value) {
        if (at().find(key)) number(key, value.emplace());
    }
    void optional_numbers(const char* key, std::vector<double>& values) {
        if (at().find(key)) numbers(key, values);
    }
    void role(const char* key, CoordinateRole& value) {
        value = choice(at()[key], {CoordinateRole::free, CoordinateRole::prescribed});
    }
    void optional_role(const char* key, CoordinateRole& value) {
        if (at().find(key)) role(key, value);
    }
    void optional_role(const char* key, std::optional<CoordinateRole>& value) {
        if (at().find(key)) role(key, value.emplace());
    }
    template <class Value>
    void optional_choice(const char* key, Value& value, std::initializer_list<Value> allowed) {
        if (const auto node = at().find(key)) value = choice(*node, allowed);
    }
    void vector(const char* key, Vec3& value) { value = triple(at()[key]); }
    void matrix(const char* key, Mat6& value) { value = square<Mat6>(at()[key]); }
    template <std::size_t n>
    void vectors(const char* key, std::array<Vec3, n>& values) {
        for_each_of(key, values, [](const YamlNode& node, Vec3& value) { value = triple(node); });
    }
    template <class Value, std::size_t n>
    void choices(const char* key, std::array<Value, n>& values, std::initializer_list<Value> allowed) {
        for_each_of(key, values, [&](const YamlNode& node, Value& value) { value = choice(node, allowed); });
    }
    /// Rows of a table, as one list per column; the first one ascends.
    template <class Row>
    void optional_rows(const char* key, std::vector<Row>& rows, std::initializer_list<RowColumn<Row>> columns) {
        if (!at().find(key)) return;
        rows.clear();
        group(key, [&] {
            for (const RowColumn<Row>& column : columns) {
                const YamlNode node = at()[column.name];
                const std::vector<double> values = node.numbers();
                if (rows.empty()) {
                    require_ascending(node, values);
                    rows.resize(values.size());
                }
                if (values.size() != rows.size())
                    node.fail(text(values.size(), " numbers; allowed: ", rows.size(), ", one per row"));
                for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*column.of = values[i];
            }
        });
    }
    void bearing(const char* key, JointSupport& b);
    void optional_bearing(const char* key, JointSupport& b) {
        if (at().find(key)) bearing(key, b);
    }
    void inertia(const char* key, RigidInertia& i);
    void damping(const char* key, BeamDamping& d);
    void line(const char* key, BeamLine& l);
    template <class Content>
    void group(const char* key, const Content& content) {
        levels_.emplace_back(at()[key]);
        content();
        finish();
    }
    /// Fields that the format has had since a version.
    template <class Content>
    void since(int version, const Content& content) {
        if (version_ >= version) content();
    }
    template <class Content>
    void group_if(bool /*given*/, const char* key, const Content& content) {
        if (at().find(key)) group(key, content);
    }
    template <class T, class Content>
    void optional_group(const char* key, std::optional<T>& value, const Content& content) {
        if (at().find(key)) group(key, [&] { content(value.emplace()); });
    }
    /// Groups under the keys 1, 2, ...
    template <class T, class Content>
    void counted_groups(const char* key, std::vector<T>& values, const Content& content) {
        group(key, [&] {
            const std::size_t count = at().node().keys().size();
            for (std::size_t number = 1; number <= count; ++number)
                group(text(number).c_str(), [&] { content(values.emplace_back()); });
        });
    }
    template <class T, class Content>
    void numbered_groups(const char* key, std::map<int, std::optional<T>>& values, int count, const Content& content) {
        if (!at().find(key)) return;
        group(key, [&] {
            for (int number = 1; number <= count; ++number) {
                const std::string name = text(number);
                const auto node = at().find(name.c_str());
                if (!node) continue;
                std::optional<T>& value = values[number];
                if (node->is_map())
                    group(name.c_str(), [&] { content(value.emplace()); });
                else if (node->word() != missing)
                    node->fail(text("'", node->word(), "'; allowed: the keys of a blade, or ", missing));
            }
        });
    }
    /// Makes something of what stands under a key.  @throws ParseError there in the place of InputError
    template <class Make>
    void make_of(const char* key, const Make& make) {
        const YamlNode node = at()[key];
        try {
            make();
        } catch (const InputError& error) {
            node.fail(error.what());
        }
    }
    /// Keys that are somebody else's.
    void pass_over(std::span<const char* const> keys) {
        for (const char* key : keys) at().pass_over(key);
    }
    void finish() {
        at().finish();
        levels_.pop_back();
    }

private:
    YamlLevel& at() { return levels_.back(); }
    static Vec3 triple(const YamlNode& node);
    static void require_ascending(const YamlNode& node, const std::vector<double>& values);
    static std::vector<EngineeringSection> sections(const YamlNode& node, std::size_t count);
    static BeamTable table(YamlLevel level);
    template <class M>
    static M square(const YamlNode& node, bool or_infinite = false) {
        M m;
        const std::vector<YamlNode> rows = node.items();
        if (std::ssize(rows) != m.rows()) node.fail(text(rows.size(), " rows; allowed: ", m.rows()));
        for (Eigen::Index i = 0; i < m.rows(); ++i) {
            const std::vector<double> row = entry(rows, i).numbers(or_infinite);
            if (std::ssize(row) != m.cols()) entry(rows, i).fail(text(row.size(), " numbers; allowed: ", m.cols()));
            for (Eigen::Index j = 0; j < m.cols(); ++j) m(i, j) = entry(row, j);
        }
        return m;
    }
    template <class Value>
    static Value choice(const YamlNode& node, std::initializer_list<Value> values) {
        std::string known;
        for (Value value : values) {
            if (node.word() == name_of(value)) return value;
            known += (known.empty() ? "" : ", ") + std::string(name_of(value));
        }
        node.fail(text("'", node.word(), "'; allowed: ", known));
    }
    // A list as long as the array; one that is left out stays as it is.
    template <class Values, class Read>
    void for_each_of(const char* key, Values& values, const Read& read) {
        const auto node = at().find(key);
        if (!node) return;
        const std::vector<YamlNode> items = node->items();
        if (items.size() != values.size()) node->fail(text(items.size(), " entries; allowed: ", values.size()));
        for (std::size_t i = 0; i < values.size(); ++i) read(items[i], values.at(i));
    }
    std::vector<YamlLevel> levels_;
    int version_ = description_yaml_version;
};

}  // namespace cardan::turbines
