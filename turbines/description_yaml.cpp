#include "turbines/description_yaml.hpp"

#include "mbs/error.hpp"
#include "mbs/pending_file.hpp"
#include "mbs/text_file.hpp"
#include "turbines/description_yaml_fields.hpp"
#include "turbines/description_yaml_node.hpp"

#include <charconv>
#include <set>

namespace cardan::turbines {

namespace {

constexpr int most = 1000;  // of what is counted

// As the reader takes them.
std::string digits(double value, const std::string& where, bool or_infinite = false) {
    if (or_infinite && value == std::numeric_limits<double>::infinity()) return ".inf";
    if (!std::isfinite(value)) throw InputError(where, "number", value, or_infinite ? "finite, or infinite" : "finite");
    std::array<char, 40> buffer{};
    const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return std::string(buffer.data(), end);
}

std::string quoted(const std::string& words) {
    constexpr auto hex = "0123456789abcdef";
    std::string out = "\"";
    for (char c : words) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            out += std::string("\\") + c;
        else if (c == '\n')
            out += "\\n";
        else if (byte < 0x20 || byte == 0x7F)
            out += std::string("\\x") + hex[byte >> 4] + hex[byte & 15];
        else
            out += c;
    }
    return out + "\"";
}

const char* name_of(Interpolation interpolation) {
    return interpolation == Interpolation::linear ? "linear" : "log_linear_stiffness";
}

const char* name_of(LineShape shape) {
    return shape == LineShape::spline ? "spline" : "polyline";
}

// Writes block by block, lists of numbers in one line.
class Writer {
public:
    void word(const char* key, const std::string& value) { entry(key, quoted(value)); }
    void integer(const char* key, int value) {
        if (value < 1 || value > most) throw InputError(key, "number", value, text("1 ... ", most));
        entry(key, text(value));
    }
    void number(const char* key, double value) { entry(key, digits(value, key)); }
    void spring(const char* key, const Spring& s) {
        entry(key, text("{stiffness: ", digits(s.stiffness, key, true), ", damping: ", digits(s.damping, key), "}"));
    }
    void inertia(const char* key, const RigidInertia& i) {
        group(key, [&] {
            number("mass", i.mass);
            entry("com", list(i.com));
            entry("J", rows(i.J));
            entry("reduced", i.reduced ? "true" : "false");
        });
    }
    void damping(const char* key, const BeamDamping& d) {
        group(key, [&] {
            entry("time_constants", list(d.time_constants));
            number("mass_proportional", d.mass_proportional);
            entry("all", list(d.modal.all));
            entry("bending_y", list(d.modal.bending_y));
            entry("bending_z", list(d.modal.bending_z));
            entry("torsion", list(d.modal.torsion));
            entry("extension", list(d.modal.extension));
        });
    }
    void line(const char* key, const BeamLine& l) {
        const BeamTable* table = table_of(l);
        if (table == nullptr)
            throw InputError(l.name, "sections", "a function", "a table (beam_line(), or sampled() of the line)");
        group(key, [&] { fields(*table); });
    }
    template <class Content>
    void group(const char* key, const Content& content) {
        out += text(indentation(), key, ":\n");
        ++depth_;
        content();
        --depth_;
    }
    std::string out;

private:
    std::string indentation() const { return std::string(static_cast<std::size_t>(2 * depth_), ' '); }
    void entry(const char* key, const std::string& value) { out += text(indentation(), key, ": ", value, "\n"); }
    template <class Values>
    std::string list(const Values& values, bool or_infinite = false) const {
        std::string all;
        for (double value : values) all += (all.empty() ? "" : ", ") + digits(value, "list", or_infinite);
        return "[" + all + "]";
    }
    template <class M>
    std::string rows(const M& m) const {
        std::string all;
        for (Eigen::Index i = 0; i < m.rows(); ++i)
            all += (all.empty() ? "" : ", ") + list(std::vector<double>(m.row(i).begin(), m.row(i).end()));
        return "[" + all + "]";
    }
    void fields(const BeamTable& table) {
        word("name", table.name);
        entry("stations", list(table.stations));
        if (!table.sections.empty()) {
            entry("interpolation", name_of(table.interpolation));
            group("sections", [&] {
                for (const SectionColumn& column : section_columns()) {
                    std::vector<double> values;
                    for (EngineeringSection section : table.sections) values.push_back(column.of(section));
                    entry(column.name, list(values, column.may_be_infinite));
                }
            });
        } else {
            entry("beta", list(table.beta));
            for (const auto& [key, matrix] : {std::pair{"stiffness", &SectionMatrices::stiffness},
                                              std::pair{"mass_matrix", &SectionMatrices::mass}}) {
                out += text(indentation(), key, ":\n");
                for (const SectionMatrices& m : table.matrices)
                    out += text(indentation(), "  - ", rows(m.*matrix), "\n");
            }
        }
        if (table.points.empty()) return;
        entry("shape", name_of(table.shape));
        out += text(indentation(), "points:\n");
        for (const Vec3& p : table.points) out += text(indentation(), "  - ", list(p), "\n");
    }

    int depth_ = 0;
};

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
M matrix(const YamlNode& node) {
    M m;
    const std::vector<YamlNode> rows = node.items();
    if (static_cast<Eigen::Index>(rows.size()) != m.rows()) node.fail(text(rows.size(), " rows; allowed: ", m.rows()));
    for (Eigen::Index i = 0; i < m.rows(); ++i) {
        const std::vector<double> row = rows[static_cast<std::size_t>(i)].numbers(static_cast<std::size_t>(m.cols()));
        for (Eigen::Index j = 0; j < m.cols(); ++j) m(i, j) = row[static_cast<std::size_t>(j)];
    }
    return m;
}

Vec3 vector(const YamlNode& node) {
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
        for (std::size_t i = 0; i < K.size(); ++i) t.matrices.push_back({matrix<Mat6>(K[i]), matrix<Mat6>(M[i])});
    }
    if (const auto points = level.find("points")) {
        for (const YamlNode& point : points->items()) t.points.push_back(vector(point));
        t.shape = choice(level["shape"], {LineShape::spline, LineShape::polyline});
    }
    level.finish();
    return t;
}

class Reader {
public:
    explicit Reader(YamlNode root) { levels_.emplace_back(std::move(root)); }

    void version() {
        const YamlNode node = at()["cardan_turbine"];
        const double given = node.number();
        if (given != description_yaml_version)
            node.fail(text("version ", given, "; allowed: ", description_yaml_version));
    }
    void word(const char* key, std::string& value) { value = at()[key].word(); }
    void integer(const char* key, int& value) { value = at()[key].integer(1, most); }
    void number(const char* key, double& value) { value = at()[key].number(); }
    void spring(const char* key, Spring& s) {
        group(key, [&] {
            s.stiffness = at()["stiffness"].number(true);
            number("damping", s.damping);
        });
    }
    void inertia(const char* key, RigidInertia& i) {
        group(key, [&] {
            number("mass", i.mass);
            i.com = vector(at()["com"]);
            i.J = matrix<Mat3>(at()["J"]);
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
    void finish() {
        at().finish();
        levels_.pop_back();
    }

private:
    Level& at() { return levels_.back(); }
    std::vector<Level> levels_;
};

}  // namespace

std::string to_yaml(const TurbineDescription& description) {
    Writer writer;
    writer.out = text("# A wind turbine, read by cardan. SI units, radians; axes and signs: docs/conventions.md.\n",
                      "cardan_turbine: ", description_yaml_version, "\n");
    description_fields(writer, description);
    return writer.out;
}

void write_description(const TurbineDescription& description, const std::filesystem::path& path) {
    write_file(path, to_yaml(description));
}

TurbineDescription parse_description(const std::string& text, const std::string& file) {
    Reader reader(YamlNode::parse(text, file));
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
