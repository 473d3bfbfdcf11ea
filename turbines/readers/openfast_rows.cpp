// Numbers of OpenFAST's files: one, a row, a table.
#include "mbs/base/text_file.hpp"
#include "turbines/readers/detail/openfast_words.hpp"
#include "turbines/readers/openfast_file.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

std::optional<double> fortran_number(std::string_view word) {
    std::string digits(word);
    for (char& c : digits)
        if (c == 'd' || c == 'D') c = 'e';
    const ReadNumber number = read_number(digits);
    return number.good() ? std::optional(number.value) : std::nullopt;
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

OpenFastTable OpenFastFile::table(std::string_view first, std::size_t rows) {
    OpenFastTable out;
    out.file = file_;
    auto at = std::find_if(lines_.begin(), lines_.end(), [key = lower_case(first)](const Line& l) {
        return !l.heading && !l.tokens.empty() && lower_case(l.tokens.front().text) == key;
    });
    if (at == lines_.end())
        throw ParseError(file_, lines_.back().number, 0, cardan::text("no table whose first column is ", first));
    out.line = at->number;
    for (const Token& token : tokens(at->all)) out.names.push_back(token.text);
    out.columns.resize(out.names.size());
    at->used = true;
    ++at;
    const bool units = at != lines_.end() && !at->tokens.empty() && at->tokens.front().text.starts_with('(');
    if (units) at++->used = true;
    for (std::size_t row = 0; row < rows; ++row, ++at) {
        const std::string what = cardan::text("row ", row + 1, " of ", rows, " of the table of ", first);
        if (at == lines_.end())
            throw ParseError(file_, lines_.back().number, 0, cardan::text(what, ": the file ends before it"));
        if (at->heading || at->tokens.empty() || !at->keyword.empty() || at->tokens.size() != out.names.size())
            throw ParseError(file_, at->number, 0,
                             cardan::text(what, ": ", out.names.size(), " numbers expected (", joined(out.names), ")"));
        for (std::size_t k = 0; k < out.names.size(); ++k)
            out.columns[k].push_back(parsed(at->tokens[k], at->number, cardan::text(what, ", ", out.names[k])));
        out.lines.push_back(at->number);
        at->used = true;
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
        const bool blank = at->all.find_first_not_of(" \t\r") == std::string::npos;
        if (blank) continue;
        if (at->heading || (!at->keyword.empty() && !rows.empty())) break;
        if (!at->keyword.empty()) {
            at->used = true;
            continue;
        }
        if (!at->tokens.empty() && at->tokens.front().text.starts_with('(')) continue;  // units
        Row row{{}, at->number};
        for (const Token& token : at->tokens) row.values.push_back(parsed(token, at->number, what));
        at->used = true;
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<OpenFastFile::Row> OpenFastFile::rows_after(std::string_view keyword, std::size_t part) {
    const double count = number_of(keyword, part);
    std::vector<Row> rows;
    for (auto at = lines_.begin() + (&line_of(keyword, part) - lines_.data()) + 1;
         static_cast<double>(rows.size()) < count; ++at) {
        if (at == lines_.end())
            throw ParseError(file_, lines_.back().number, 0,
                             cardan::text("row ", rows.size() + 1, " of the ", count, " that ", keyword,
                                          " announces: the file ends before it"));
        const bool names = rows.empty() && !at->tokens.empty() && !fortran_number(at->tokens.front().text);
        if (at->heading || at->tokens.empty() || names) continue;
        Row row{{}, at->number};
        for (const Token& token : at->tokens) row.values.push_back(parsed(token, at->number, keyword));
        at->used = true;
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace cardan::turbines
