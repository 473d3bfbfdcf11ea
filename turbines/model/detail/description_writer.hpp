/// @file
/// Writes descriptions of machines as YAML. Internal: not installed.
#pragma once

#include "mbs/base/error.hpp"
#include "turbines/model/detail/description_fields.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

namespace cardan::turbines {

// In the form the reader expects.
inline std::string digits(double value, const std::string& where, bool or_infinite = false) {
    if (or_infinite && value == std::numeric_limits<double>::infinity()) return ".inf";
    if (!std::isfinite(value)) throw InputError(where, "number", value, or_infinite ? "finite, or infinite" : "finite");
    return cardan::digits(value);
}

// What YAML folds as a line end or does not take as it is, in UTF-8, and its escape; C2 80 ... C2 9F apart.
struct Escape {
    std::string_view bytes, text;
};
inline constexpr std::array<Escape, 7> escapes{{{"\"", "\\\""},
                                                {"\\", "\\\\"},
                                                {"\n", "\\n"},
                                                {"\xE2\x80\xA8", "\\L"},
                                                {"\xE2\x80\xA9", "\\P"},
                                                {"\xEF\xBB\xBF", "\\uFEFF"},
                                                {"\xEF\xBF\xBE", "\\uFFFE"}}};

inline std::string quoted(const std::string& text) {
    constexpr auto hex = "0123456789abcdef";
    std::string_view words = text;
    std::string out = "\"";
    const auto number = [&](unsigned char byte) { out += std::string("\\x") + hex[byte >> 4] + hex[byte & 15]; };
    while (!words.empty()) {
        const auto* const escape =
            std::ranges::find_if(escapes, [&](const Escape& e) { return words.starts_with(e.bytes); });
        const auto first = static_cast<unsigned char>(words[0]),
                   second = static_cast<unsigned char>(words.size() > 1 ? words[1] : '\0');
        std::size_t taken = 1;
        if (escape != escapes.end()) {
            out += escape->text;
            taken = escape->bytes.size();
        } else if (first < 0x20 || first == 0x7F) {
            number(first);
        } else if (first == 0xC2 && second >= 0x80 && second < 0xA0) {  // further control characters
            number(second);
            taken = 2;
        } else {
            out += words[0];
        }
        words.remove_prefix(taken);
    }
    return out + "\"";
}

// Beam lines without a table are rejected, or approximated by one.
enum class BeamLines { exact, near };

// Writes in block style, with lists of numbers on one line.
class Writer {
public:
    explicit Writer(BeamLines lines) : lines_(lines) {}
    void word(const char* key, const std::string& value) { entry(key, quoted(value)); }
    void integer(const char* key, int value, int max = max_counted) {
        if (value < 0 || value > max) throw InputError(key, "number", value, text("0 ... ", max));
        entry(key, text(value));
    }
    void number(const char* key, double value) { entry(key, digits(value, key)); }
    void numbers(const char* key, const std::vector<double>& values) { entry(key, list(values)); }
    void flag(const char* key, bool value) { entry(key, value ? "true" : "false"); }
    /// Words that a file may leave out are written all the same, unless there is nothing to write.
    void optional_word(const char* key, const std::string& value) {
        if (!value.empty()) word(key, value);
    }
    void optional_flag(const char* key, bool value) { flag(key, value); }
    void optional_number(const char* key, double value) { number(key, value); }
    void optional_number(const char* key, const std::optional<double>& value) {
        if (value) number(key, *value);
    }
    void optional_numbers(const char* key, const std::vector<double>& values) {
        if (!values.empty()) numbers(key, values);
    }
    void role(const char* key, CoordinateRole value) { entry(key, name_of(value)); }
    void optional_role(const char* key, CoordinateRole value) { role(key, value); }
    void optional_role(const char* key, const std::optional<CoordinateRole>& value) {
        if (value) role(key, *value);
    }
    template <class Value>
    void optional_choice(const char* key, Value value, std::initializer_list<Value> /*allowed*/) {
        entry(key, std::string(name_of(value)));
    }
    void vector(const char* key, const Vec3& value) { entry(key, list(value)); }
    void matrix(const char* key, const Mat6& value) { entry(key, rows(value)); }
    template <std::size_t n>
    void vectors(const char* key, const std::array<Vec3, n>& values) {
        std::string all;
        for (const Vec3& value : values) all += (all.empty() ? "" : ", ") + list(value);
        entry(key, "[" + all + "]");
    }
    template <class Value, std::size_t n>
    void choices(const char* key, const std::array<Value, n>& values, std::initializer_list<Value> /*allowed*/) {
        std::string all;
        for (Value value : values) all += text(all.empty() ? "" : ", ", name_of(value));
        entry(key, "[" + all + "]");
    }
    template <class Row>
    void optional_rows(const char* key, const std::vector<Row>& rows, std::initializer_list<RowColumn<Row>> columns) {
        if (rows.empty()) return;
        group(key, [&] {
            for (const RowColumn<Row>& column : columns) {
                std::vector<double> values(rows.size());
                std::ranges::transform(rows, values.begin(), column.of);
                numbers(column.name, values);
            }
        });
    }
    void bearing(const char* key, const JointSupport& b) {
        const std::string damping = text("damping: ", digits(b.damping, key), "}");
        if (b.kind == JointSupport::Kind::spring)
            entry(key, text("{stiffness: ", digits(b.stiffness, key), ", ", damping));
        else if (b.damping != 0)
            entry(key, text("{hold: ", name_of(b.kind), ", ", damping));
        else
            entry(key, name_of(b.kind));
    }
    void optional_bearing(const char* key, const JointSupport& b) { bearing(key, b); }
    void inertia(const char* key, const RigidInertia& i) {
        group(key, [&] {
            number("mass", i.mass);
            entry("com", list(i.com));
            entry("J", rows(i.J));
            flag("reduced", i.reduced);
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
        if (const BeamTable* table = l.section.table()) {
            group(key, [&] { fields(*table); });
        } else if (lines_ == BeamLines::near) {
            sampled_line(key, l);
        } else {
            throw InputError(l.name, "sections", "a function", "a table (beam_line(), or sampled() of the line)");
        }
    }
    template <class Content>
    void group(const char* key, const Content& content) {
        out += text(indentation(), key, ":\n");
        ++depth_;
        content();
        --depth_;
    }
    /// Fields that the format has had since a version; this writes the last one.
    template <class Content>
    void since(int /*version*/, const Content& content) {
        content();
    }
    template <class Content>
    void group_if(bool given, const char* key, const Content& content) {
        if (given) group(key, content);
    }
    template <class T, class Content>
    void optional_group(const char* key, const std::optional<T>& value, const Content& content) {
        if (value) group(key, [&] { content(*value); });
    }
    template <class T, class Content>
    void counted_groups(const char* key, const std::vector<T>& values, const Content& content) {
        group(key, [&] {
            for (std::size_t i = 0; i < values.size(); ++i) group(text(i + 1).c_str(), [&] { content(values[i]); });
        });
    }
    template <class T, class Content>
    void numbered_groups(const char* key, const std::map<int, std::optional<T>>& values, int /*count*/,
                         const Content& content) {
        if (values.empty()) return;
        group(key, [&] {
            for (const auto& [number, value] : values) {
                const std::string name = text(number);
                if (value)
                    group(name.c_str(), [&own = *value, &content] { content(own); });
                else
                    entry(name.c_str(), missing);
            }
        });
    }
    std::string out;

private:
    // Curved lines, and sections that engineering constants cannot express, are at least named.
    void sampled_line(const char* key, const BeamLine& l) {
        std::optional<BeamTable> table;
        try {
            table = sampled(l);
        } catch (const InputError&) {
            return word(key, l.name + ": a function of the program");
        }
        group(key, [&] { fields(*table); });
    }
    std::string indentation() const { return std::string(static_cast<std::size_t>(2 * depth_), ' '); }
    void entry(const char* key, const std::string& value) { out += text(indentation(), key, ": ", value, "\n"); }
    template <class Values>
    std::string list(const Values& values, bool or_infinite = false) const {
        constexpr int max_in_line = 1000;
        std::string all;
        int count = 0;
        for (double value : values) {
            if (count > 0) all += count % max_in_line == 0 ? ",\n" + indentation() + "  " : ", ";
            all += digits(value, "list", or_infinite);
            ++count;
        }
        return "[" + all + "]";
    }
    template <class M>
    std::string rows(const M& m, bool or_infinite = false) const {
        std::string all;
        for (Eigen::Index i = 0; i < m.rows(); ++i)
            all += (all.empty() ? "" : ", ") + list(std::vector<double>(m.row(i).begin(), m.row(i).end()), or_infinite);
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
                    out += text(indentation(), "  - ", rows(m.*matrix, matrix == &SectionMatrices::stiffness), "\n");
            }
        }
        if (table.points.empty()) return;
        entry("shape", name_of(table.shape));
        out += text(indentation(), "points:\n");
        for (const Vec3& p : table.points) out += text(indentation(), "  - ", list(p), "\n");
    }

    BeamLines lines_;
    int depth_ = 0;
};

}  // namespace cardan::turbines
