#include "turbines/readers/openfast_file.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "turbines/readers/detail/openfast_words.hpp"

#include <algorithm>

namespace cardan::turbines {

namespace {

constexpr std::string_view blanks = " \t\r", list_of_channels = "outlist";
constexpr std::size_t longest_line = 1'000'000;

// As Fortran reads them: T, .T., .true and the like.
std::optional<bool> truth(std::string_view word) {
    std::string w = lower_case(word);
    std::erase(w, '.');
    if (w == "true" || w == "t") return true;
    if (w == "false" || w == "f") return false;
    return std::nullopt;
}

std::string_view without_blanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool is_rule(std::string_view line) {
    return line.starts_with("---") || line.starts_with("===");
}

// "END" may stand in quotes.
bool is_end(std::string_view line) {
    if (line.starts_with('"') || line.starts_with('\'')) line.remove_prefix(1);
    return lower_case(line.substr(0, 3)) == "end";
}

// Old files hold single bytes of Latin-1 in their remarks; what is kept as text must be UTF-8.
std::string utf8(std::string_view text) {
    if (is_utf8(text)) return std::string(text);
    std::string out;
    for (char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            out += c;
            continue;
        }
        out += static_cast<char>(0xC0 | (byte >> 6));
        out += static_cast<char>(0x80 | (byte & 0x3F));
    }
    return out;
}

// What a keyword is compared by: files write BldFlDmp(1), BldFlDmp1 and bldfldmp(1).
std::string key_of(std::string_view keyword) {
    std::string key = lower_case(keyword);
    std::erase_if(key, [](char c) { return c == '(' || c == ')'; });
    return key;
}

bool belongs(const std::string& keyword, const KeywordGroup& group) {
    return std::any_of(group.keywords.begin(), group.keywords.end(), [&](std::string_view member) {
        const bool beginning = member.ends_with('*');
        if (beginning) member.remove_suffix(1);
        return beginning ? key_of(keyword).starts_with(key_of(member)) : key_of(keyword) == key_of(member);
    });
}

}  // namespace

std::string to_text(const FileNote& note) {
    std::string out = note.line > 0 ? cardan::text(note.file, ":", note.line, ": ") : note.file + ": ";
    out += note.keyword;
    if (!note.value.empty()) out += " = " + note.value;
    return out + ": " + note.why;
}

std::vector<OpenFastFile::Token> OpenFastFile::tokens(std::string_view line) {
    constexpr std::string_view separators = " \t\r,";
    constexpr std::string_view ends = " \t\r,!";
    std::vector<Token> all;
    for (std::size_t i = 0; i < line.size();) {
        if (separators.find(line[i]) != std::string_view::npos) {
            ++i;
            continue;
        }
        const int column = static_cast<int>(i) + 1;
        if (line[i] == '!') break;
        if (line[i] == '"' || line[i] == '\'') {
            const std::size_t close = std::min(line.find(line[i], i + 1), line.size());
            all.push_back({std::string(line.substr(i + 1, close - i - 1)), column, true});
            i = close + 1;
            continue;
        }
        const std::size_t end = std::min(line.find_first_of(ends, i), line.size());
        all.push_back({std::string(line.substr(i, end - i)), column, false});
        i = end;
    }
    return all;
}

// "value ... keyword - remark": the keyword is the first word after the first value that begins with a letter. A list
// of output channels begins with a keyword that has no value.
OpenFastFile::Line OpenFastFile::classified(std::string_view line, int number, int titles) {
    Line out{tokens(line), "", std::string(line), number, false, false};
    const std::string_view start = without_blanks(line);
    out.blank = start.empty() || start.starts_with('!') || start.starts_with('#');
    out.heading = number <= titles || out.blank || is_rule(start) || is_end(start);
    std::vector<Token>& t = out.tokens;
    const auto remark = std::find_if(t.begin(), t.end(), [](const Token& token) { return token.text == "-"; });
    t.erase(remark, t.end());
    if (out.heading || t.empty()) return out;
    const bool list = !t[0].quoted && lower_case(t[0].text).starts_with(list_of_channels);
    if (list || (t.size() == 1 && !t[0].quoted && is_letter(t[0].text[0]))) {
        out.keyword = t[0].text;
        t.clear();
        return out;
    }
    const auto word = std::find_if(t.begin() + 1, t.end(), [](const Token& token) {
        return !token.quoted && !token.text.empty() && is_letter(token.text[0]);
    });
    if (word == t.end()) return out;
    out.keyword = word->text;
    t.erase(word, t.end());
    return out;
}

OpenFastFile OpenFastFile::parse(std::string_view text, std::string file) {
    require_text(text, file, TextRules::any_bytes);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    OpenFastFile out;
    out.file_ = std::move(file);
    out.text_ = utf8(text);
    std::string_view rest = out.text_;
    int titles = 2;
    bool in_list = false;  // of output channels, up to END or the next heading
    for (int number = 1; !rest.empty(); ++number) {
        const std::size_t end = std::min(rest.find('\n'), rest.size());
        const std::string_view all = rest.substr(0, end);
        if (all.size() > longest_line)
            throw ParseError(out.file_, number, 0,
                             cardan::text("a line of ", all.size(), " bytes; allowed: at most ", longest_line));
        if (number == 2 && is_rule(all) && out.lines_.front().all.find_first_not_of("- \t\r") == std::string::npos)
            ++titles;
        Line line = classified(all, number, titles);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (number == titles) out.title_ = without_blanks(line.all);
        const std::string_view start = without_blanks(line.all);
        if (in_list && !is_rule(start) && !is_end(start)) continue;
        in_list = lower_case(line.keyword).starts_with(list_of_channels);
        out.lines_.push_back(std::move(line));
    }
    if (out.lines_.size() < 3) throw ParseError(out.file_, 1, 0, "an OpenFAST input file begins with two title lines");
    return out;
}

std::string OpenFastFile::machine_name() const {
    const std::string title = lower_case(title_);
    const bool says_nothing = title.find_first_of("abcdefghijklmnopqrstuvwxyz") == std::string::npos;
    const bool tool = title.find("generated") != std::string::npos || title.find("created with") != std::string::npos ||
                      title.find("created by") != std::string::npos || title.find("written by") != std::string::npos;
    return says_nothing || tool ? std::filesystem::path(file_).stem().string() : title_;
}

OpenFastFile OpenFastFile::read(const std::filesystem::path& path) {
    return parse(text_file(path), path.string());
}

// The one with a value, if there are several: words that stand alone are also what remains of other lists.
const OpenFastFile::Line* OpenFastFile::find(std::string_view keyword) const {
    const std::string key = key_of(keyword);
    const Line* found = nullptr;
    for (const Line& line : lines_) {
        if (key_of(line.keyword) != key) continue;
        if (!line.tokens.empty()) return &line;
        if (found == nullptr) found = &line;
    }
    return found;
}

OpenFastFile::Line* OpenFastFile::find(std::string_view keyword) {
    return const_cast<Line*>(std::as_const(*this).find(keyword));
}

OpenFastFile::Line& OpenFastFile::known(std::string_view keyword) {
    Line* line = find(keyword);
    if (line == nullptr)
        throw ParseError(file_, lines_.back().number, 0,
                         cardan::text("no line with the keyword ", keyword, " up to the end of the file"));
    const std::string key = key_of(keyword);
    for (const Line& other : lines_)
        if (&other != line && !other.tokens.empty() && key_of(other.keyword) == key)
            throw ParseError(file_, other.number, 0,
                             cardan::text(keyword, " is there already, in line ", line->number));
    line->used = true;
    return *line;
}

const OpenFastFile::Token& OpenFastFile::single(std::string_view keyword) {
    const Line& line = known(keyword);
    if (line.tokens.size() != 1)
        throw ParseError(file_, line.number, 0,
                         cardan::text("one value expected before ", keyword, ", found ", line.tokens.size()));
    return line.tokens.front();
}

double OpenFastFile::parsed(const Token& token, int line, std::string_view what) const {
    const std::optional<double> value = token.quoted ? std::nullopt : fortran_number(token.text);
    if (!value)
        throw ParseError(file_, line, token.column, cardan::text(what, ": '", token.text, "' is not a finite number"));
    return *value;
}

double OpenFastFile::number(std::string_view keyword) {
    const Token& token = single(keyword);
    return parsed(token, known(keyword).number, keyword);
}

double OpenFastFile::number_or(std::string_view keyword, double otherwise) {
    return has(keyword) ? number(keyword) : otherwise;
}

double OpenFastFile::positive(std::string_view keyword) {
    const double value = number(keyword);
    if (!(value > 0)) fail(keyword, cardan::text(keyword, " = ", value, "; allowed: > 0"));
    return value;
}

double OpenFastFile::not_negative(std::string_view keyword) {
    const double value = number(keyword);
    if (!(value >= 0)) fail(keyword, cardan::text(keyword, " = ", value, "; allowed: >= 0"));
    return value;
}

std::vector<double> OpenFastFile::numbers(std::string_view keyword, std::size_t count) {
    const Line& line = known(keyword);
    if (line.tokens.size() < count)
        fail(keyword, cardan::text(count, " numbers expected before ", keyword, ", found ", line.tokens.size()));
    std::vector<double> values;
    for (std::size_t k = 0; k < count; ++k) values.push_back(parsed(line.tokens[k], line.number, keyword));
    return values;
}

bool OpenFastFile::is_number(std::string_view keyword, double value) const {
    const Line* line = find(keyword);
    return line != nullptr && line->tokens.size() == 1 && !line->tokens.front().quoted &&
           fortran_number(line->tokens.front().text) == value;
}

int OpenFastFile::integer(std::string_view keyword, int min, int max) {
    const double value = number(keyword);
    if (value != std::round(value) || value < min || value > max)
        fail(keyword, cardan::text(keyword, " = ", value, "; allowed: ",
                                   value != std::round(value) ? "a whole number, " : "", min, " ... ", max));
    return static_cast<int>(value);
}

bool OpenFastFile::truth_of(const Token& token, int line, std::string_view keyword) const {
    const std::optional<bool> value = truth(token.text);
    if (!value)
        throw ParseError(file_, line, token.column,
                         cardan::text(keyword, ": '", token.text, "' is neither True nor False"));
    return *value;
}

bool OpenFastFile::flag(std::string_view keyword) {
    const Token& token = single(keyword);
    return truth_of(token, known(keyword).number, keyword);
}

bool OpenFastFile::flag_or(std::string_view keyword, bool otherwise) {
    return has(keyword) ? flag(keyword) : otherwise;
}

std::string OpenFastFile::word(std::string_view keyword) {
    return single(keyword).text;
}

std::size_t OpenFastFile::count(std::string_view keyword) const {
    return static_cast<std::size_t>(std::count_if(
        lines_.begin(), lines_.end(), [key = key_of(keyword)](const Line& l) { return key_of(l.keyword) == key; }));
}

const OpenFastFile::Line& OpenFastFile::line_of(std::string_view keyword, std::size_t part) const {
    const std::string key = key_of(keyword);
    for (const Line& line : lines_)
        if (key_of(line.keyword) == key && part-- == 0) return line;
    fail(keyword, cardan::text("no further line with the keyword ", keyword));
}

const OpenFastFile::Token& OpenFastFile::token_of(std::string_view keyword, std::size_t part) {
    if (!has(keyword)) static_cast<void>(known(keyword));  // says so
    const std::string key = key_of(keyword);
    for (Line& line : lines_)
        if (key_of(line.keyword) == key) line.used = true;
    const Line& line = line_of(keyword, part);
    if (line.tokens.size() != 1)
        fail_in(keyword, part, cardan::text("one value expected before ", keyword, ", found ", line.tokens.size()));
    return line.tokens.front();
}

double OpenFastFile::number_of(std::string_view keyword, std::size_t part) {
    const Token& token = token_of(keyword, part);
    return parsed(token, line_of(keyword, part).number, keyword);
}

bool OpenFastFile::flag_of(std::string_view keyword, std::size_t part) {
    const Token& token = token_of(keyword, part);
    return truth_of(token, line_of(keyword, part).number, keyword);
}

std::optional<double> OpenFastFile::number_before(std::string_view end, std::string_view keyword) {
    const Line *const line = find(keyword), *const last = find(end);
    if (line == nullptr || (last != nullptr && line->number > last->number)) return std::nullopt;
    const Token& token = token_of(keyword, 0);
    if (lower_case(token.text) == "default") return std::nullopt;
    return parsed(token, line->number, keyword);
}

double OpenFastFile::number_or_default(std::string_view keyword, double otherwise) {
    return !has(keyword) || lower_case(word(keyword)) == "default" ? otherwise : number(keyword);
}

void OpenFastFile::fail(std::string_view keyword, std::string_view what) const {
    const Line* line = find(keyword);
    throw ParseError(file_, line == nullptr ? lines_.back().number : line->number, 0, what);
}

void OpenFastFile::fail_in(std::string_view keyword, std::size_t part, std::string_view what) const {
    throw ParseError(file_, line_of(keyword, part).number, 0, what);
}

std::optional<std::vector<double>> OpenFastFile::numbers_of(const Line& line) const {
    std::vector<double> values;
    for (const Token& token : line.tokens) {
        const std::optional<double> value = token.quoted ? std::nullopt : fortran_number(token.text);
        if (!value) return std::nullopt;
        values.push_back(*value);
    }
    return values;
}

void OpenFastFile::pass_over(std::string_view keyword, std::size_t lines) {
    const std::size_t first = static_cast<std::size_t>(&known(keyword) - lines_.data()) + 1;
    for (std::size_t i = first; i < std::min(first + lines, lines_.size()); ++i) lines_[i].used = true;
}

void OpenFastFile::add_note(const Line& line, std::string why) {
    std::string value;
    for (const Token& token : line.tokens) value += (value.empty() ? "" : ", ") + token.text;
    notes_.push_back({file_, line.number, line.keyword, value, std::move(why)});
}

void OpenFastFile::note(std::string_view keyword, std::string why) {
    add_note(known(keyword), std::move(why));
}

void OpenFastFile::note_of(std::string_view keyword, std::size_t part, std::string why) {
    static_cast<void>(token_of(keyword, part));  // counts as used
    add_note(line_of(keyword, part), std::move(why));
}

void OpenFastFile::note_unless(std::string_view keyword, double neutral, std::string why) {
    if (has(keyword) && number(keyword) != neutral) note(keyword, std::move(why));
}

void OpenFastFile::left_out(std::string_view keyword, std::string why) {
    note(keyword, std::move(why));
    notes_.back().kind = FileNote::Kind::left_out;
}

void OpenFastFile::left_out_unless(std::string_view keyword, double neutral, std::string why) {
    if (has(keyword) && number(keyword) != neutral) left_out(keyword, std::move(why));
}

std::vector<FileNote> OpenFastFile::notes(const std::vector<KeywordGroup>& groups) const {
    constexpr FileNote::Kind unused = FileNote::Kind::unused;
    std::vector<FileNote> out = notes_;
    // In files whose other entries are all irrelevant, these are irrelevant too.
    const bool lone_numbers = std::none_of(groups.begin(), groups.end(), [](const KeywordGroup& g) {
        return std::find(g.keywords.begin(), g.keywords.end(), "*") != g.keywords.end();
    });
    const auto is_numbers = [&](const Line& line) {
        return !line.heading && !line.tokens.empty() && numbers_of(line).has_value();
    };
    std::vector<std::vector<std::string>> members(groups.size());
    for (const Line& line : lines_) {
        if (line.used || (line.keyword.empty() && !(lone_numbers && is_numbers(line)))) continue;
        const auto group =
            std::find_if(groups.begin(), groups.end(), [&](const KeywordGroup& g) { return belongs(line.keyword, g); });
        if (group != groups.end()) {
            entry(members, group - groups.begin()).push_back(line.keyword);
            continue;
        }
        std::string value;
        for (const Token& token : line.tokens) value += (value.empty() ? "" : ", ") + token.text;
        if (line.keyword.empty())
            out.push_back({file_, line.number, "line without a keyword", value, "without effect", unused});
        else
            out.push_back(
                {file_, line.number, line.keyword, value, "not known to this reader and without effect", unused});
    }
    for (std::size_t g = 0; g < groups.size(); ++g)
        if (!members[g].empty()) out.push_back({file_, 0, joined(members[g]), "", std::string(groups[g].why), unused});
    return out;
}

}  // namespace cardan::turbines
