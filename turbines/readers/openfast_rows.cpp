// Numbers of OpenFAST's files: one, a row, a table.
#include "mbs/base/text_file.hpp"
#include "turbines/readers/detail/openfast_words.hpp"
#include "turbines/readers/openfast_file.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

// Fortran leaves out the letter before an exponent that has a sign: 4.0+07.
std::optional<double> fortran_number(std::string_view word) {
    std::string digits(word);
    for (char& c : digits)
        if (c == 'd' || c == 'D') c = 'e';
    const std::size_t sign = digits.find_first_of("+-", 1);
    if (sign != std::string::npos && (is_digit(digits[sign - 1]) || digits[sign - 1] == '.')) digits.insert(sign, "e");
    const ReadNumber number = read_number(digits);
    return number.good() ? std::optional(number.value) : std::nullopt;
}

std::vector<std::string_view> words_of(std::string_view line) {
    constexpr std::string_view separators = " \t\r,";
    std::vector<std::string_view> words;
    for (std::size_t at = line.find_first_not_of(separators); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(separators, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(separators, end);
    }
    return words;
}

std::string joined(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
    return all;
}

const std::vector<double>& OpenFastTable::column(std::string_view name) const {
    for (std::size_t k = 0; k < names.size(); ++k)
        if (lower_case(names[k]) == lower_case(name)) return columns[k];
    throw ParseError(file, line, 0, text("no column '", name, "'; there are: ", joined(names)));
}

bool OpenFastTable::has(std::string_view name) const {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& n) { return lower_case(n) == lower_case(name); });
}

void OpenFastTable::fail(std::size_t row, std::string_view what) const {
    throw ParseError(file, lines[row], 0, what);
}

// Names of columns, without remarks in brackets and behind a dash. The line may be a remark for OpenFAST, which does
// not read it.
std::vector<std::string> OpenFastFile::names_in(const Line& line) {
    const std::size_t first = line.all.find_first_not_of(" \t\r#!");
    if (first == std::string::npos) return {};
    std::vector<std::string> names;
    bool in_brackets = false;
    for (const Token& token : tokens(std::string_view(line.all).substr(first))) {
        if (token.text == "-") break;
        in_brackets = in_brackets || token.text.starts_with('(');
        if (!in_brackets) names.push_back(token.text);
        if (token.text.ends_with(')')) in_brackets = false;
    }
    return names;
}

std::vector<OpenFastFile::Line>::iterator OpenFastFile::header(std::string_view first) {
    const bool beginning = first.ends_with('*');
    if (beginning) first.remove_suffix(1);
    const std::string key = lower_case(first);
    auto found = lines_.end();
    for (auto line = lines_.begin(); line != lines_.end(); ++line) {
        if (line->number <= 2 || (line->heading && !line->blank)) continue;
        const std::vector<std::string> names = names_in(*line);
        if (names.empty()) continue;
        const std::string own = lower_case(names.front());
        if (beginning ? !own.starts_with(key) : own != key) continue;
        if (!line->blank) return line;
        if (found == lines_.end() && names.size() > 1) found = line;
    }
    return found;
}

OpenFastFile::Row OpenFastFile::row_of(const Line& line) {
    Row row{{}, line.number, 0, line.keyword};
    for (const Token& token : line.tokens) {
        const std::optional<double> value = token.quoted ? std::nullopt : fortran_number(token.text);
        if (!value) {
            row.column = token.column;
            row.next = token.text;
            break;
        }
        row.values.push_back(*value);
    }
    return row;
}

void OpenFastFile::require(const Row& row, std::size_t count, std::string_view what) const {
    if (row.values.size() >= count) return;
    throw ParseError(file_, row.line, row.column,
                     cardan::text(what, ": ", count, count == 1 ? " number" : " numbers", " expected, found ",
                                  row.values.size(), row.next.empty() ? "" : cardan::text(", then '", row.next, "'")));
}

OpenFastTable OpenFastFile::table(std::string_view first, std::size_t rows) {
    OpenFastTable out;
    out.file = file_;
    auto at = header(first);
    if (at == lines_.end())
        throw ParseError(file_, lines_.back().number, 0, cardan::text("no table whose first column is ", first));
    out.line = at->number;
    out.names = names_in(*at);
    out.columns.resize(out.names.size());
    at->used = true;
    const auto next = [&] {
        while (at != lines_.end() && at->blank) ++at;
        return at != lines_.end();
    };
    ++at;
    const auto is_units = [](const Line& line) {
        if (line.heading) return false;
        return (!line.tokens.empty() && line.tokens.front().text.find_first_of("([") == 0) ||
               std::ranges::none_of(line.tokens, [](const Token& t) { return fortran_number(t.text).has_value(); });
    };
    const bool units = next() && is_units(*at);
    if (units) at++->used = true;
    bool beyond = false;
    for (std::size_t row = 0; row < rows; ++row, ++at) {
        const std::string what = cardan::text("row ", row + 1, " of ", rows, " of the table of ", out.names.front());
        if (!next()) throw ParseError(file_, lines_.back().number, 0, cardan::text(what, ": the file ends before it"));
        const Row read = at->heading ? Row{{}, at->number, 0, at->all} : row_of(*at);
        require(read, out.names.size(), cardan::text(what, " (", joined(out.names), ")"));
        for (std::size_t k = 0; k < out.names.size(); ++k) out.columns[k].push_back(read.values[k]);
        out.lines.push_back(at->number);
        at->used = true;
        if (beyond || read.values.size() == out.names.size()) continue;
        notes_.push_back({file_, at->number, cardan::text("table of ", out.names.front()),
                          digits(read.values[out.names.size()]),
                          "numbers behind the last column are left out, as in OpenFAST"});
        beyond = true;
    }
    if (at != lines_.end() && !at->heading && at->keyword.empty() && at->tokens.size() >= out.names.size() &&
        numbers_of(*at))
        throw ParseError(file_, at->number, 0, cardan::text("one more row than the ", rows, " announced"));
    return out;
}

std::vector<OpenFastFile::Row> OpenFastFile::rows_below(std::string_view what) {
    auto at = std::find_if(lines_.begin(), lines_.end(), [key = lower_case(what)](const Line& l) {
        return l.number > 2 && (l.heading || !l.tokens.empty()) && lower_case(l.all).find(key) != std::string::npos;
    });
    if (at == lines_.end()) throw ParseError(file_, lines_.back().number, 0, cardan::text("no line with '", what, "'"));
    at->used = true;
    std::vector<Row> rows;
    for (++at; at != lines_.end(); ++at) {
        if (at->blank) continue;
        if (at->heading) break;
        Row row = row_of(*at);
        if (rows.empty() && row.values.empty()) {  // names, units
            at->used = !at->keyword.empty();
            continue;
        }
        at->used = true;
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<OpenFastFile::Row> OpenFastFile::rows_after(std::string_view keyword, std::size_t part) {
    const double count = number_of(keyword, part);
    std::vector<Row> rows;
    auto at = lines_.begin() + (&line_of(keyword, part) - lines_.data()) + 1;
    for (; static_cast<double>(rows.size()) < count; ++at) {
        if (at == lines_.end())
            throw ParseError(file_, lines_.back().number, 0,
                             cardan::text("row ", rows.size() + 1, " of the ", count, " that ", keyword,
                                          " announces: the file ends before it"));
        if (at->heading || at->tokens.empty()) continue;
        Row row = row_of(*at);
        if (rows.empty() && row.values.empty()) continue;  // names
        at->used = true;
        rows.push_back(std::move(row));
    }
    if (!rows.empty() && at != lines_.end() && !at->heading && at->keyword.empty() &&
        at->tokens.size() >= rows.back().values.size() && numbers_of(*at))
        notes_.push_back({file_, at->number, std::string(keyword), digits(count),
                          "rows behind so many are not read, as in OpenFAST", FileNote::Kind::left_out});
    return rows;
}

}  // namespace cardan::turbines
