#include "turbines/tables/csv.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

namespace cardan::turbines {
namespace {

constexpr std::string_view blanks = " \t\r";
constexpr std::size_t max_columns = 1000;

/// A stretch of a line without the blanks around it, and where it begins: character column from 1.
struct Field {
    std::string_view text;
    int at;
};

// Of UTF-8: bytes 10xxxxxx continue a character.
int characters(std::string_view bytes) {
    return static_cast<int>(std::ranges::count_if(bytes, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string_view trimmed(std::string_view line) {
    const std::size_t first = std::min(line.find_first_not_of(blanks), line.size());
    line.remove_prefix(first);
    return line.substr(0, line.find_last_not_of(blanks) + 1);
}

constexpr std::size_t any_number = static_cast<std::size_t>(-1);

/// At most `limit` fields: the last one then keeps its separators.
std::vector<Field> split(std::string_view line, char separator, std::size_t limit = any_number) {
    std::vector<Field> fields;
    std::size_t begin = 0, counted = 0;
    int column = 1;  // of the character after `counted` bytes
    for (std::size_t next = 0; next <= line.size(); ++next) {
        if (next < line.size() && (line[next] != separator || fields.size() + 1 == limit)) continue;
        const std::string_view own = trimmed(line.substr(begin, next - begin));
        const auto at = own.empty() ? next : static_cast<std::size_t>(own.data() - line.data());
        column += characters(line.substr(counted, at - counted));
        counted = at;
        fields.push_back({own, column});
        begin = next + 1;
    }
    return fields;
}

struct Line {
    std::vector<Field> fields;
    int number;
};

/// Goes through the lines that count.
class Lines {
public:
    Lines(std::string_view rest, std::string_view file) : rest_(rest), file_(file) {
        require_text(rest, file);
        if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
    }

    std::optional<Line> next(std::size_t limit = any_number) {
        while (!rest_.empty()) {
            const std::size_t end = rest_.find('\n');
            const std::string_view line = rest_.substr(0, end);
            rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
            ++number_;
            const std::size_t first = line.find_first_not_of(blanks);
            if (first == std::string_view::npos || line[first] == '#') continue;
            return Line{split(line, ',', limit), number_};
        }
        return std::nullopt;
    }

    Line header() {
        std::optional<Line> line = next();
        if (!line) fail(std::max(number_, 1), 0, "the file is empty: no header, no data");
        return *std::move(line);
    }

    /// A line of data with as many fields as the header.
    std::optional<Line> row(std::size_t fields, std::size_t limit = any_number) {
        std::optional<Line> line = next(limit);
        if (line && line->fields.size() != fields) {
            const bool more = line->fields.size() > fields;
            const int at = more ? line->fields[fields].at : line->fields.back().at;
            fail(line->number, at, text(line->fields.size(), " fields; the header has ", fields));
        }
        return line;
    }

    [[noreturn]] void fail(int line, int column, std::string_view what) const {
        throw ParseError(file_, line, column, what);
    }

private:
    std::string_view rest_;
    std::string_view file_;
    int number_ = 0;
};

double finite_number(const Field& f, std::string_view file, int line) {
    const ReadNumber number = read_number(f.text);
    if (!number.good()) throw ParseError(file, line, f.at, text("'", f.text, "' ", number.fault));
    return number.value;
}

/// "a, b, c"
template <class Items>
std::string listed(const Items& items) {
    std::string all;
    for (const auto& item : items) all += (all.empty() ? "" : ", ") + item.name;
    return all;
}

template <class Items>
auto find_by_name(const Items& items, std::string_view name) -> decltype(items.data()) {
    const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
    return found == items.end() ? nullptr : &*found;
}

template <class Items>
std::vector<std::string> names_of(const Items& items) {
    std::vector<std::string> names;
    names.reserve(items.size());
    for (const auto& item : items) names.push_back(item.name);
    return names;
}

}  // namespace

CsvTable CsvTable::parse(std::string_view text_of_file, std::string_view file) {
    Lines lines(text_of_file, file);
    const Line header = lines.header();
    CsvTable table;
    table.file_ = file;
    table.header_line_ = header.number;
    if (header.fields.size() > max_columns)
        lines.fail(header.number, 0, text(header.fields.size(), " columns; allowed: at most ", max_columns));
    for (const Field& f : header.fields) {
        const std::size_t bracket = f.text.find('[');
        const bool good = bracket != std::string_view::npos && bracket > 0 && f.text.ends_with(']');
        const std::string_view name = trimmed(f.text.substr(0, good ? bracket : 0));
        const std::string_view unit = good ? trimmed(f.text.substr(bracket + 1, f.text.size() - bracket - 2)) : "";
        if (name.empty() || unit.empty()) {
            lines.fail(header.number, f.at,
                       text("'", f.text, "' is not a header field: name[unit], with [-] for a pure number"));
        }
        if (table.has(name)) lines.fail(header.number, f.at, text("column '", name, "' is there twice"));
        table.columns_.push_back({std::string(name), std::string(unit), f.at, {}});
    }
    while (const std::optional<Line> row = lines.row(table.columns_.size())) {
        for (std::size_t k = 0; k < row->fields.size(); ++k) {
            table.columns_[k].values.push_back(finite_number(row->fields[k], file, row->number));
        }
    }
    if (table.rows() == 0) lines.fail(header.number, 0, "there is a header but no data");
    return table;
}

CsvTable CsvTable::read(const std::filesystem::path& path) {
    return parse(text_file(path), path.string());
}

std::vector<std::string> CsvTable::names() const {
    return names_of(columns_);
}

const CsvTable::Column* CsvTable::find(std::string_view name) const {
    return find_by_name(columns_, name);
}

const CsvTable::Column& CsvTable::known(std::string_view name) const {
    if (const Column* found = find(name)) return *found;
    throw ParseError(file_, header_line_, 0, text("no column '", name, "'; there are: ", listed(columns_)));
}

std::span<const double> CsvTable::column(std::string_view name) const {
    return known(name).values;
}

std::span<const double> CsvTable::column(std::string_view name, std::string_view expected_unit) const {
    const Column& c = known(name);
    if (c.unit != expected_unit) {
        throw ParseError(file_, header_line_, c.at,
                         text("column '", name, "': unit ", expected_unit, " expected, ", c.unit, " found"));
    }
    return c.values;
}

const std::string& CsvTable::unit(std::string_view name) const {
    return known(name).unit;
}

CsvQuantities CsvQuantities::parse(std::string_view text_of_file, std::string_view file) {
    Lines lines(text_of_file, file);
    const Line header = lines.header();
    const std::vector<std::string_view> expected{"quantity", "unit", "value"};
    const auto& titles = header.fields;
    const bool sized = titles.size() == 3 || titles.size() == 4;
    if (!sized || !std::equal(expected.begin(), expected.end(), titles.begin(),
                              [](std::string_view a, const Field& b) { return a == b.text; })) {
        lines.fail(header.number, titles.front().at, "no header 'quantity,unit,value' or 'quantity,unit,value,note'");
    }
    CsvQuantities all;
    all.file_ = file;
    all.header_line_ = header.number;
    while (const std::optional<Line> row = lines.row(titles.size(), titles.size() > 3 ? 4 : any_number)) {
        const auto& f = row->fields;
        if (f[0].text.empty()) lines.fail(row->number, f[0].at, "the quantity has no name");
        if (f[1].text.empty()) {
            lines.fail(row->number, f[1].at,
                       cardan::text("quantity '", f[0].text, "' has no unit; - for a pure number"));
        }
        if (const Quantity* earlier = all.find(f[0].text)) {
            lines.fail(row->number, f[0].at,
                       cardan::text("quantity '", f[0].text, "' is there already, in line ", earlier->line));
        }
        all.quantities_.push_back({std::string(f[0].text), std::string(f[1].text), std::string(f[2].text),
                                   std::string(f.size() > 3 ? f[3].text : ""), row->number, f[1].at, f[2].at});
    }
    if (all.quantities_.empty()) lines.fail(header.number, 0, "there is a header but no data");
    return all;
}

CsvQuantities CsvQuantities::read(const std::filesystem::path& path) {
    return parse(text_file(path), path.string());
}

std::vector<std::string> CsvQuantities::names() const {
    return names_of(quantities_);
}

const CsvQuantities::Quantity* CsvQuantities::find(std::string_view name) const {
    return find_by_name(quantities_, name);
}

const CsvQuantities::Quantity& CsvQuantities::known(std::string_view name) const {
    if (const Quantity* found = find(name)) return *found;
    throw ParseError(file_, header_line_, 0,
                     cardan::text("no quantity '", name, "'; there are: ", listed(quantities_)));
}

const CsvQuantities::Quantity& CsvQuantities::known(std::string_view name, std::string_view expected_unit) const {
    const Quantity& q = known(name);
    if (q.unit != expected_unit) {
        throw ParseError(file_, q.line, q.unit_at,
                         cardan::text("quantity '", name, "': unit ", expected_unit, " expected, ", q.unit, " found"));
    }
    return q;
}

double CsvQuantities::number(std::string_view quantity, std::string_view expected_unit) const {
    const Quantity& q = known(quantity, expected_unit);
    return finite_number({q.value, q.value_at}, file_, q.line);
}

std::vector<double> CsvQuantities::numbers(std::string_view quantity, std::string_view expected_unit) const {
    const Quantity& q = known(quantity, expected_unit);
    std::vector<double> values;
    for (Field part : split(q.value, '/')) {
        part.at += q.value_at - 1;
        values.push_back(finite_number(part, file_, q.line));
    }
    return values;
}

std::vector<double> CsvQuantities::numbers(std::string_view quantity, std::string_view expected_unit,
                                           std::size_t count) const {
    std::vector<double> values = numbers(quantity, expected_unit);
    if (values.size() != count)
        throw InputError(cardan::text(file_, ", ", quantity), "number of values", values.size(),
                         cardan::text(count, ", separated by /"));
    return values;
}

const std::string& CsvQuantities::text(std::string_view quantity) const {
    return known(quantity).value;
}

const std::string& CsvQuantities::unit(std::string_view quantity) const {
    return known(quantity).unit;
}

const std::string& CsvQuantities::note(std::string_view quantity) const {
    return known(quantity).note;
}

}  // namespace cardan::turbines
