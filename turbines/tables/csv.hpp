/// @file
/// Readers for the data files of turbines: comma-separated, with units, with errors that point at the character.
///
/// Both kinds of file are UTF-8 text. Lines that begin with # are comments, blank lines are skipped, lines may end in
/// CR LF. The first other line names the columns. There is no quoting: a comma always separates. Numbers have a decimal
/// point whatever the locale. Every error is a ParseError "<file>:<line>:<column>: <what>", columns in characters from
/// 1, or a FileError when the file cannot be read. `file` is the name used in messages.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cardan::turbines {

/// A table of numbers whose header reads "name[unit],name[unit],..."; a pure number has the unit "-".
class CsvTable {
public:
    /// Requires at least one row, finite numbers only and unique names.
    [[nodiscard]] static CsvTable parse(std::string_view text, std::string_view file);
    [[nodiscard]] static CsvTable read(const std::filesystem::path& path);

    [[nodiscard]] std::size_t rows() const { return columns_.front().values.size(); }
    [[nodiscard]] const std::string& file() const { return file_; }
    /// Names in the order of the file.
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }
    /// One value per row; valid as long as the table. Throws ParseError, listing the existing names, for any other
    /// name.
    [[nodiscard]] std::span<const double> column(std::string_view name) const;
    /// Values of a column in a unit; also throws ParseError if the unit in the file differs.
    [[nodiscard]] std::span<const double> column(std::string_view name, std::string_view expected_unit) const;
    [[nodiscard]] const std::string& unit(std::string_view name) const;

private:
    struct Column {
        std::string name;
        std::string unit;
        int at;  ///< character column of the header field
        std::vector<double> values;
    };
    CsvTable() = default;
    [[nodiscard]] const Column* find(std::string_view name) const;
    [[nodiscard]] const Column& known(std::string_view name) const;

    std::string file_;
    int header_line_ = 0;
    std::vector<Column> columns_;
};

/// Single quantities, one per line: "quantity,unit,value,note". The header begins with these first three names; a
/// fourth column of any name is free text to the end of the line, commas included. A value is a number, several numbers
/// with / between them, or a text.
class CsvQuantities {
public:
    /// Requires at least one quantity and no duplicates. Values are parsed when they are requested.
    [[nodiscard]] static CsvQuantities parse(std::string_view text, std::string_view file);
    [[nodiscard]] static CsvQuantities read(const std::filesystem::path& path);

    [[nodiscard]] const std::string& file() const { return file_; }
    /// Names in the order of the file.
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] bool has(std::string_view quantity) const { return find(quantity) != nullptr; }
    /// Throws ParseError for a quantity that is missing (listing the existing names), in another unit, or not a finite
    /// number.
    [[nodiscard]] double number(std::string_view quantity, std::string_view expected_unit) const;
    /// The numbers of "2.5e4/1.0e5/1.0e5"; a single number is a list of one.
    [[nodiscard]] std::vector<double> numbers(std::string_view quantity, std::string_view expected_unit) const;
    /// Numbers of a quantity; also throws InputError if there are more or fewer of them.
    [[nodiscard]] std::vector<double> numbers(std::string_view quantity, std::string_view expected_unit,
                                              std::size_t count) const;
    /// The value as written in the file.
    [[nodiscard]] const std::string& text(std::string_view quantity) const;
    [[nodiscard]] const std::string& unit(std::string_view quantity) const;
    /// The fourth column; empty when there is none.
    [[nodiscard]] const std::string& note(std::string_view quantity) const;

private:
    struct Quantity {
        std::string name;
        std::string unit;
        std::string value;
        std::string note;
        int line;
        int unit_at;   ///< character column
        int value_at;  ///< character column
    };
    CsvQuantities() = default;
    [[nodiscard]] const Quantity* find(std::string_view name) const;
    [[nodiscard]] const Quantity& known(std::string_view name) const;
    [[nodiscard]] const Quantity& known(std::string_view name, std::string_view expected_unit) const;

    std::string file_;
    int header_line_ = 0;
    std::vector<Quantity> quantities_;
};

}  // namespace cardan::turbines
