// CSV tables of Campbell diagrams with quotation marks and line ends in names, read by a reader of its own (RFC 4180).
#include "mbs/error.hpp"
#include "solvers/campbell_csv.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

using namespace cardan;
using namespace cardan::solvers;

namespace {

// Records of fields; a quoted field may hold commas, line ends and doubled quotes.
std::vector<std::vector<std::string>> records(const std::string& text) {
    std::vector<std::vector<std::string>> all;
    std::vector<std::string> record{""};
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
            record.back() += c, ++i;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && c == ',')
            record.emplace_back();
        else if (!quoted && c == '\n')
            all.push_back(record), record = {""};
        else
            record.back() += c;
    }
    CHECK_FALSE(quoted);
    CHECK(record == std::vector<std::string>{""});  // a line end at the end
    return all;
}

struct Table {
    std::vector<std::string> comments, header;
    std::vector<std::vector<std::string>> rows;
};

Table table_of(const Campbell& diagram) {
    const test::Folder folder;
    write_csv(diagram, folder.path / "c.csv");
    std::string rest = test::bytes_of(folder / "c.csv");
    Table table;
    while (rest.starts_with('#')) {
        const std::size_t end = rest.find('\n');
        table.comments.push_back(rest.substr(0, end));
        rest.erase(0, end + 1);
    }
    table.rows = records(rest);
    REQUIRE_FALSE(table.rows.empty());
    table.header = table.rows.front();
    table.rows.erase(table.rows.begin());
    for (const auto& row : table.rows) CHECK(row.size() == table.header.size());
    return table;
}

// One branch with one mode at 2 Hz that decays with 0.5 1/s.
Campbell small(const std::string& name) {
    Campbell d;
    d.machine = "machine";
    d.method = "method";
    CampbellPoint& point = d.points.emplace_back();
    point.rotor_speed = 1;
    point.stability_margin = 0.5;
    point.modes.emplace_back().mode = {Complex(-0.5, 4 * pi), ComplexVector::Ones(1)};
    Branch& branch = d.branches.emplace_back();
    branch.name = name;
    branch.mode = {0};
    branch.mac = {1};
    branch.doubtful = {false};
    branch.mostly = {name};
    return d;
}

constexpr std::size_t mode_column = 1, mostly_column = 7;

}  // namespace

TEST_CASE("campbell table: quotation marks and line ends in names survive", "[property]") {
    Campbell d = small("the \"first\", so called, of\ntwo lines");
    d.parameter = "5\" of a \"mast\"";
    d.parameters = {1};
    const Table table = table_of(d);
    REQUIRE(table.rows.size() == 1);
    REQUIRE(table.rows[0].size() > mostly_column);
    CHECK(table.rows[0][mode_column] == d.branches[0].name);
    CHECK(table.rows[0][mostly_column] == d.branches[0].name);
    CHECK(table.header.back() == d.parameter);
}

TEST_CASE("campbell table: a machine's name or a warning of two lines stays a comment", "[property]") {
    Campbell d = small("1st tower fore-aft");
    d.machine = "two\nlines";
    d.warning = "also\nthree\nlines";
    const Table table = table_of(d);
    CHECK(table.header.front() == "rotor_speed[rpm]");
    CHECK(table.rows.size() == 1);
}
