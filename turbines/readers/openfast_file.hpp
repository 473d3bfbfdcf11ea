/// @file
/// The lines of OpenFAST input files: values, then a keyword, then " - " and a remark.
///
/// Entries are found by keyword, not by line number, so that files of all versions are read alike. Keywords are
/// compared without regard to case. The first line is a heading and the second a title (the third, where a line of
/// dashes stands before, as in FAST 7); headings are also later lines that begin with "---", "===", "!" or "#". Numbers
/// may be in Fortran notation (1.0D+3, 1.0+3, .5, 5.), flags too (T, .F., .true). Commas, tabs and blanks separate
/// alike. Behind the columns of a table a line may go on: readers take the numbers they expect, as OpenFAST does; those
/// that are left are noted, words are remarks.
#pragma once

#include "mbs/base/error.hpp"
#include "turbines/readers/turbine_file.hpp"

#include <filesystem>
#include <optional>
#include <string_view>

namespace cardan::turbines {

/// Numbers in named columns.
class OpenFastTable {
public:
    /// @throws ParseError listing the existing names
    [[nodiscard]] const std::vector<double>& column(std::string_view name) const;
    [[nodiscard]] bool has(std::string_view name) const;
    [[nodiscard]] std::size_t rows() const { return lines.size(); }
    /// @throws ParseError at a row, 0 being the first
    [[noreturn]] void fail(std::size_t row, std::string_view what) const;

    std::string file;
    int line = 0;  ///< of the names
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;
    std::vector<int> lines;  ///< of the rows
};

/// Keywords that are irrelevant for the structure, and why. An entry that ends in * matches keywords by prefix.
struct KeywordGroup {
    std::vector<std::string_view> keywords;
    std::string_view why;
};

class OpenFastFile {
public:
    /// The numbers with which a line begins, outside of the keyword lines.
    struct Row {
        std::vector<double> values;
        int line;
        int column;        ///< of the word behind them; 0: not known
        std::string next;  ///< that word; empty: none
    };

    static OpenFastFile parse(std::string_view text, std::string file);
    /// @throws FileError
    static OpenFastFile read(const std::filesystem::path& path);

    const std::string& name() const { return file_; }
    const std::string& title() const { return title_; }
    /// A name for what the file describes: its title, or its own name if the title only says what wrote it.
    std::string machine_name() const;
    const std::string& text() const { return text_; }

    bool has(std::string_view keyword) const { return find(keyword) != nullptr; }
    /// The following functions throw ParseError for a keyword that is missing or occurs twice, for more than one value,
    /// and for a value of the wrong kind. Entries that were requested count as used.
    double number(std::string_view keyword);
    double number_or(std::string_view keyword, double otherwise);
    double positive(std::string_view keyword);
    double not_negative(std::string_view keyword);
    /// The first so many.
    std::vector<double> numbers(std::string_view keyword, std::size_t count);
    /// Whether there is an entry of one value, this number, which then does not count as used.
    bool is_number(std::string_view keyword, double value) const;
    int integer(std::string_view keyword, int min, int max);
    bool flag(std::string_view keyword);
    bool flag_or(std::string_view keyword, bool otherwise);
    std::string word(std::string_view keyword);
    /// A number, in the place of which the word "default" may stand.
    double number_or_default(std::string_view keyword, double otherwise);
    /// A path relative to the folder of this file; where there is none of this name, that of one in another case.
    std::filesystem::path path(std::string_view keyword);
    /// Paths in the line of the keyword and in those after it.
    std::vector<std::filesystem::path> paths(std::string_view keyword, std::size_t count);
    /// Applies `read()` to the file that the keyword names. @throws ParseError at the keyword instead of FileError
    template <class Read>
    auto follow(std::string_view keyword, const Read& read) const {
        try {
            return read();
        } catch (const FileError& error) {
            fail(keyword, cardan::text(keyword, ": ", error.what()));
        }
    }

    /// Returns what `make` returns; an InputError of its own is reported at the entry.
    template <class Make>
    auto checked(std::string_view keyword, const Make& make) const {
        try {
            return make();
        } catch (const InputError& error) {
            fail(keyword, error.what());
        }
    }

    /// The rows below a line of names that begins with `first` (with an * behind: with a word that begins so) and a
    /// line of units. What stands in brackets among the names is a remark.
    OpenFastTable table(std::string_view first, std::size_t rows);
    /// The rows of numbers below the heading, or the line of names, that contains `what`, up to the next heading or
    /// line without a number; those in between are passed over.
    std::vector<Row> rows_below(std::string_view what);
    /// @throws ParseError unless the row has so many numbers
    void require(const Row& row, std::size_t count, std::string_view what) const;

    /// Number of lines with the keyword.
    std::size_t count(std::string_view keyword) const;
    /// Value of one part for a keyword that several parts have, the first part being 0. All count as used.
    double number_of(std::string_view keyword, std::size_t part);
    bool flag_of(std::string_view keyword, std::size_t part);
    std::filesystem::path path_of(std::string_view keyword, std::size_t part);
    /// Value of the first part alone, which ends at the first line with the keyword `end`: none if the keyword is not
    /// there, or with the word "default".
    std::optional<double> number_before(std::string_view end, std::string_view keyword);
    /// The rows of numbers after the line with the keyword, as many as it says; headings are passed over.
    std::vector<Row> rows_after(std::string_view keyword, std::size_t part = 0);
    [[noreturn]] void fail_in(std::string_view keyword, std::size_t part, std::string_view what) const;

    /// Marks the lines after the keyword as used.
    void pass_over(std::string_view keyword, std::size_t lines);

    /// Adds a note on the entry, which then counts as used.
    void note(std::string_view keyword, std::string why);
    /// Notes a keyword that several parts have.
    void note_of(std::string_view keyword, std::size_t part, std::string why);
    /// Notes an entry if it exists and its number differs from the one without effect.
    void note_unless(std::string_view keyword, double neutral, std::string why);
    /// Notes what the file asks for and the model does not have (FileNote::Kind::left_out).
    void left_out(std::string_view keyword, std::string why);
    void left_out_unless(std::string_view keyword, double neutral, std::string why);
    /// Notes added by the functions above.
    const std::vector<FileNote>& added_notes() const { return notes_; }
    /// Notes on unused entries: by groups, then one by one.
    std::vector<FileNote> notes(const std::vector<KeywordGroup>& groups) const;

    [[noreturn]] void fail(std::string_view keyword, std::string_view what) const;

private:
    struct Token {
        std::string text;
        int column;
        bool quoted;
    };
    struct Line {
        std::vector<Token> tokens;  // without keyword and remark
        std::string keyword;
        std::string all;
        int number;
        bool heading;
        bool blank;  // or a remark alone
        bool used = false;
    };
    OpenFastFile() = default;
    static std::vector<Token> tokens(std::string_view line);
    static Line classified(std::string_view line, int number, int titles);
    Line* find(std::string_view keyword);
    const Line* find(std::string_view keyword) const;
    Line& known(std::string_view keyword);
    const Line& line_of(std::string_view keyword, std::size_t part) const;
    void add_note(const Line& line, std::string why);
    bool truth_of(const Token& token, int line, std::string_view keyword) const;
    const Token& token_of(std::string_view keyword, std::size_t part);
    const Token& single(std::string_view keyword);
    std::filesystem::path beside(const std::string& given, int line, std::string_view keyword) const;
    std::optional<std::vector<double>> numbers_of(const Line& line) const;
    static Row row_of(const Line& line);
    static std::vector<std::string> names_in(const Line& line);
    std::vector<Line>::iterator header(std::string_view first);
    double parsed(const Token& token, int line, std::string_view what) const;

    std::string file_, title_, text_;
    std::vector<Line> lines_;
    std::vector<FileNote> notes_;
};

}  // namespace cardan::turbines
