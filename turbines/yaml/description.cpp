#include "turbines/yaml/description.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "turbines/model/detail/description_fields.hpp"
#include "turbines/yaml/detail/node.hpp"

#include <cmath>
#include <set>

namespace cardan::turbines {

namespace {

// One level of the document: remembers which keys were asked for.
class Level {
public:
    explicit Level(YamlNode node) : node_(std::move(node)) {}
    YamlNode operator[](const char* key) {
        asked_.insert(key);
        return node_[key];
    }
    std::optional<YamlNode> find(const char* key) {
        asked_.insert(key);
        return node_.find(key);
    }
    void finish() const {
        std::string known;
        for (const std::string& key : asked_) known += (known.empty() ? "" : ", ") + key;
        for (const std::string& key : node_.keys())
            if (!asked_.contains(key)) node_[key].fail(text("not a key of the format; allowed: ", known));
    }
    const YamlNode& node() const { return node_; }

private:
    YamlNode node_;
    std::set<std::string> asked_;
};

template <class M>
M square(const YamlNode& node, bool or_infinite = false) {
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

Vec3 triple(const YamlNode& node) {
    const std::vector<double> v = node.numbers(std::size_t{3});
    return {v[0], v[1], v[2]};
}

std::vector<EngineeringSection> sections(const YamlNode& node, std::size_t count) {
    std::vector<EngineeringSection> all(count);
    Level level(node);
    for (const SectionColumn& column : section_columns()) {
        const YamlNode values = level[column.name];
        const std::vector<double> numbers = values.numbers(column.may_be_infinite);
        if (numbers.size() != count)
            values.fail(text(numbers.size(), " numbers; allowed: ", count, ", one per station"));
        for (std::size_t i = 0; i < count; ++i) column.of(all[i]) = numbers[i];
    }
    level.finish();
    return all;
}

template <class Value>
Value choice(const YamlNode& node, std::initializer_list<Value> values) {
    std::string known;
    for (Value value : values) {
        if (node.word() == name_of(value)) return value;
        known += (known.empty() ? "" : ", ") + std::string(name_of(value));
    }
    node.fail(text("'", node.word(), "'; allowed: ", known));
}

BeamTable table(Level level) {
    BeamTable t;
    t.name = level["name"].word();
    t.stations = level["stations"].numbers();
    if (const auto given = level.find("sections")) {
        t.interpolation = choice(level["interpolation"], {Interpolation::linear, Interpolation::log_linear_stiffness});
        t.sections = sections(*given, t.stations.size());
    } else {
        t.beta = level["beta"].numbers(t.stations.size());
        const YamlNode stiffness = level["stiffness"], mass = level["mass_matrix"];
        const std::vector<YamlNode> K = stiffness.items(), M = mass.items();
        for (const auto* list : {&K, &M})
            if (list->size() != t.stations.size())
                (list == &K ? stiffness : mass).fail(text(list->size(), " matrices; allowed: ", t.stations.size()));
        for (std::size_t i = 0; i < K.size(); ++i) t.matrices.push_back({square<Mat6>(K[i], true), square<Mat6>(M[i])});
    }
    if (const auto points = level.find("points")) {
        for (const YamlNode& point : points->items()) t.points.push_back(triple(point));
        t.shape = choice(level["shape"], {LineShape::spline, LineShape::polyline});
    }
    level.finish();
    return t;
}

class DescriptionReader {
public:
    explicit DescriptionReader(YamlNode root) { levels_.emplace_back(std::move(root)); }

    void version() {
        const YamlNode node = at()["cardan_turbine"];
        const double given = node.number();
        if (given != 1 && given != description_yaml_version)
            node.fail(text("version ", given, "; allowed: 1, ", description_yaml_version));
        version_ = static_cast<int>(given);
    }
    void word(const char* key, std::string& value) { value = at()[key].word(); }
    void integer(const char* key, int& value) { value = at()[key].integer(0, most_counted); }
    void flag(const char* key, bool& value) { value = at()[key].flag(); }
    void number(const char* key, double& value) { value = at()[key].number(); }
    /// What is left out stays as it is.
    void optional_flag(const char* key, bool& value) {
        if (at().find(key)) flag(key, value);
    }
    void optional_number(const char* key, double& value) {
        if (at().find(key)) number(key, value);
    }
    void role(const char* key, CoordinateRole& value) {
        value = choice(at()[key], {CoordinateRole::free, CoordinateRole::driven});
    }
    void optional_role(const char* key, CoordinateRole& value) {
        if (at().find(key)) role(key, value);
    }
    void optional_role(const char* key, std::optional<CoordinateRole>& value) {
        if (at().find(key)) role(key, value.emplace());
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
    void bearing(const char* key, Bearing& b) {
        using Hold = Bearing::Hold;
        b = rigid_joint;
        const YamlNode node = at()[key];
        if (!node.is_map()) {
            b.hold = choice(node, {Hold::free, Hold::rigid, Hold::driven});
            return;
        }
        group(key, [&] {
            const auto hold = at().find("hold");
            b.hold = hold ? choice(*hold, {Hold::free, Hold::spring}) : Hold::spring;
            if (b.hold == Hold::spring) b.stiffness = at()["stiffness"].number(version_ == 1);
            number("damping", b.damping);
        });
        if (version_ == 1 && std::isinf(b.stiffness)) b = rigid_joint;
        if (version_ == 1 && b.hold == Hold::spring && b.stiffness == 0) b.hold = Hold::free;
    }
    void inertia(const char* key, RigidInertia& i) {
        group(key, [&] {
            number("mass", i.mass);
            i.com = triple(at()["com"]);
            i.J = square<Mat3>(at()["J"]);
            i.reduced = at()["reduced"].flag();
        });
    }
    void damping(const char* key, BeamDamping& d) {
        group(key, [&] {
            const std::vector<double> tau = at()["time_constants"].numbers(std::size_t{6});
            std::copy(tau.begin(), tau.end(), d.time_constants.begin());
            number("mass_proportional", d.mass_proportional);
            d.modal.all = at()["all"].numbers();
            d.modal.bending_y = at()["bending_y"].numbers();
            d.modal.bending_z = at()["bending_z"].numbers();
            d.modal.torsion = at()["torsion"].numbers();
            d.modal.extension = at()["extension"].numbers();
        });
    }
    void line(const char* key, BeamLine& l) {
        const YamlNode node = at()[key];
        try {
            l = beam_line(table(Level(node)));
        } catch (const InputError& error) {
            node.fail(error.what());
        }
    }
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
    void finish() {
        at().finish();
        levels_.pop_back();
    }

private:
    Level& at() { return levels_.back(); }
    // A list as long as the array; one that is left out stays as it is.
    template <class Values, class Read>
    void for_each_of(const char* key, Values& values, const Read& read) {
        const auto node = at().find(key);
        if (!node) return;
        const std::vector<YamlNode> items = node->items();
        if (items.size() != values.size()) node->fail(text(items.size(), " entries; allowed: ", values.size()));
        for (std::size_t i = 0; i < values.size(); ++i) read(items[i], values.at(i));
    }
    std::vector<Level> levels_;
    int version_ = description_yaml_version;
};

}  // namespace

TurbineDescription parse_description(const std::string& text, const std::string& file) {
    DescriptionReader reader(YamlNode::parse(text, file));
    TurbineDescription description;
    reader.version();
    description_fields(reader, description);
    reader.finish();
    return description;
}

TurbineDescription read_description(const std::filesystem::path& path) {
    return parse_description(text_file(path), path.string());
}

bool is_description(const std::string& text) {
    try {
        return YamlNode::parse(text, "").find("cardan_turbine").has_value();
    } catch (const ParseError&) {
        return text.find("cardan_turbine") != std::string::npos;
    }
}

}  // namespace cardan::turbines
