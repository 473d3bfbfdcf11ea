// The CSV table of a Campbell diagram, read by a reader of its own (RFC 4180): names with commas, quotation
// marks and line ends, kinds of motion, another parameter, missing modes.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell_data/blade_shapes.hpp"
#include "solvers/campbell_data/csv.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"

#include <cmath>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

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

template <class Written>
Table table_of(const Written& written) {
    const test::Folder folder;
    write_csv(written, folder.path / "c.csv");
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
    branch.doubt = {""};
    branch.mostly = {name};
    return d;
}

constexpr std::size_t mode_column = 1, mostly_column = 7, kind_column = 8;

}  // namespace

TEST_CASE("campbell table: whirl of the second harmonic has a comma in its name and stays one field", "[property]") {
    const SmallRotor rotor = small_rotor({.stiffness = std::vector<double>(5, 2000.0), .damping = 3});
    CampbellOptions options;
    options.spin = RotorSpin::prescribed;
    const std::vector<double> speeds{1, 2};
    const Campbell d = campbell(rotor.system, rotor.map, speeds, options);
    const Table table = table_of(d);
    REQUIRE(table.rows.size() == 10);  // five modes, two speeds
    std::size_t commas = 0, row = 0;
    for (std::size_t i = 0; i < speeds.size(); ++i)
        for (const Branch& branch : d.branches) {
            const std::vector<std::string>& line = table.rows[row++];
            CHECK(line[mode_column] == branch.name);
            CHECK(line[mostly_column] == branch.mostly[i]);
            commas += branch.name.find(", 2)") != std::string::npos;
            // Closed form: w^2 = k / (m l^2) + Omega^2 (1 + e / l), in the fixed frame w + n Omega.
            const double m = 3, l = 4, e = 0.5, Omega = speeds[i], decay = 3 / (2 * m * l * l),
                         w = std::sqrt(2000 / (m * l * l) + Omega * Omega * (1 + e / l) - decay * decay),
                         n = branch.pattern == RotorPattern::backward  ? -branch.harmonic
                             : branch.pattern == RotorPattern::forward ? branch.harmonic
                                                                       : 0;
            const double expected = (w + n * Omega) / (2 * pi);
            CAPTURE(branch.name, Omega);
            CHECK(std::stod(line[0]) == Approx(Omega * units::to_rpm).epsilon(1e-9));
            CHECK(std::stod(line[3]) == Approx(expected).epsilon(1e-9));
            CHECK(std::stod(line[2]) == Approx(std::hypot(expected, decay / (2 * pi))).epsilon(1e-9));
            CHECK(std::stod(line[4]) == Approx(decay / std::hypot(2 * pi * expected, decay)).epsilon(1e-8));
            CHECK(std::stod(line[9]) == Approx(-decay).epsilon(1e-8));
            CHECK(std::stod(line[10]) == Approx(decay).epsilon(1e-8));
            CHECK(line[kind_column] == "oscillation");
        }
    CHECK(commas == 4);
}

TEST_CASE("campbell table: header with units in every column, comments before it", "[property]") {
    Campbell d = small("1st tower fore-aft");
    const Table table = table_of(d);
    CHECK(table.header == std::vector<std::string>{"rotor_speed[rpm]", "mode[-]", "natural_frequency[Hz]",
                                                   "damped_frequency[Hz]", "damping_ratio[-]", "mac[-]", "doubtful[-]",
                                                   "mostly[-]", "kind[-]", "growth_rate[1/s]", "stability_margin[1/s]",
                                                   "doubt[-]"});
    REQUIRE(table.comments.size() == 1);
    d.warning = "something, to \"say\"";
    d.complete = false;
    const Table warned = table_of(d);
    REQUIRE(warned.comments.size() == 3);
    CHECK(warned.comments[1] == "# warning: something, to \"say\"");
    CHECK(warned.comments[2] == "# the sweep was interrupted");
    CHECK(warned.rows == table.rows);
}

TEST_CASE("campbell table: a point where a branch has no mode has no line", "[property]") {
    Campbell d = small("1st tower fore-aft");
    d.points.push_back(d.points[0]);
    d.points[1].rotor_speed = 2;
    d.branches[0].mode.push_back(-1);
    d.branches[0].mac.push_back(0);
    d.branches[0].doubtful.push_back(false);
    d.branches[0].doubt.emplace_back();
    d.branches[0].mostly.emplace_back();
    CHECK(table_of(d).rows.size() == 1);
}

TEST_CASE("campbell table: over another parameter it is the last column", "[property]") {
    Campbell d = small("1st tower fore-aft");
    d.parameter = "tower over blade rigidity, -";  // with a comma
    d.parameters = {12.5};
    const Table table = table_of(d);
    CHECK(table.header.size() == 13);
    CHECK(table.header.back() == d.parameter);
    REQUIRE(table.rows.size() == 1);
    CHECK(table.rows[0].back() == "12.5");
    CHECK(table.rows[0][0] == "9.549296586");
}

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

TEST_CASE("campbell table: so it is with the shapes of blades", "[property]") {
    const Vec3T<Complex> one(1, 0, Complex(0, 2));
    const BladeShapes shapes{
        "two\nlines", 1, {{"2nd blade flap (backward, 2)", 2, false, {3, 4}, {one, one}, {one, one}}}};
    const Table table = table_of(std::vector{shapes});
    CHECK(table.header.size() == 12);
    REQUIRE(table.rows.size() == 2);
    CHECK(table.rows[1][mode_column] == "2nd blade flap (backward, 2)");
    CHECK(table.rows[1][3] == "4");
    CHECK(table.rows[1][8] == "2");  // the imaginary part of flap
}
