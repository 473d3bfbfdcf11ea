#include "mbs/base/error.hpp"
#include "tests/support/catch.hpp"
#include "turbines/tables/csv.hpp"

#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace cardan::testing::csv {

namespace {

namespace fs = std::filesystem;
using cardan::FileError;
using cardan::ParseError;
using cardan::turbines::CsvQuantities;
using cardan::turbines::CsvTable;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

const std::string header = "span[m],EI_flap[N m^2]\n";
const std::string quantity_header = "quantity,unit,value,note\n";

template <class Action>
std::string message_of(Action action) {
    try {
        action();
    } catch (const cardan::Error& error) {
        CHECK(dynamic_cast<const ParseError*>(&error) != nullptr);
        return error.what();
    }
    return "nothing was thrown";
}

std::string table_error(const std::string& text) {
    return message_of([&] { (void)CsvTable::parse(text, "blade.csv"); });
}

std::string quantities_error(const std::string& text) {
    return message_of([&] { (void)CsvQuantities::parse(text, "turbine.csv"); });
}

std::vector<double> vector_of(std::span<const double> values) {
    return {values.begin(), values.end()};
}

fs::path data(const char* name) {
    return fs::path(CARDAN_SOURCE_DIR) / "turbines/data" / name;
}

}  // namespace

TEST_CASE("csv table: columns are found by name, with their units", "[property]") {
    const CsvTable table =
        CsvTable::parse("# where it is from\n" + header + "0,1e9\n# half way\n 0.5 ,\t-2.5e-3\n", "f");
    CHECK(table.rows() == 2);
    CHECK(table.names() == std::vector<std::string>{"span", "EI_flap"});
    CHECK(vector_of(table.column("span")) == std::vector<double>{0.0, 0.5});
    CHECK(vector_of(table.column("EI_flap", "N m^2")) == std::vector<double>{1e9, -2.5e-3});
    CHECK(table.unit("span") == "m");
    CHECK(table.unit("EI_flap") == "N m^2");
    CHECK(table.has("span"));
    CHECK_FALSE(table.has("EI_edge"));
    CHECK(table.file() == "f");
}

TEST_CASE("csv: line ends of Windows, blank lines, a missing last line end and a byte-order mark do not matter",
          "[property]") {
    const CsvTable table = CsvTable::parse("\xEF\xBB\xBF# c\r\n\r\na[m],b[-]\r\n1,2\r\n3,4\r\n\r\n  \r\n\n", "f");
    CHECK(table.unit("b") == "-");
    CHECK(vector_of(table.column("b")) == std::vector<double>{2.0, 4.0});
    CHECK(vector_of(CsvTable::parse("a[m]\n7", "f").column("a")) == std::vector<double>{7.0});
    const CsvQuantities quantities = CsvQuantities::parse("quantity,unit,value\r\nmass,kg,5\r\n\r\n", "f");
    CHECK(quantities.number("mass", "kg") == 5.0);
    CHECK(quantities.note("mass").empty());
}

TEST_CASE("csv table: an error names file, line and character column", "[property]") {
    CHECK(table_error(header + "0,1\n1\n") == "blade.csv:3:1: 1 fields; the header has 2");
    CHECK(table_error(header + "0,1\n\n# c\n1,2,3\n") == "blade.csv:5:5: 3 fields; the header has 2");
    CHECK(table_error(header + "0,1\n1,2,\n") == "blade.csv:3:5: 3 fields; the header has 2");
    CHECK(table_error(header + "0,  abc\n") == "blade.csv:2:5: 'abc' is not a number");
    CHECK(table_error(header + "0,\n") == "blade.csv:2:3: '' is not a number");
    CHECK(table_error(header + "0,1.5m\n") == "blade.csv:2:3: '1.5m' is not a number");
    CHECK(table_error(header + "+-1,0\n") == "blade.csv:2:1: '+-1' is not a number");
    CHECK(table_error(header + "0x10,0\n") == "blade.csv:2:1: '0x10' is not a number");
    CHECK(table_error(header + "1 2,0\n") == "blade.csv:2:1: '1 2' is not a number");
    CHECK(table_error(header + "0,nan\n") == "blade.csv:2:3: 'nan' is not a finite number");
    CHECK(table_error(header + "-inf,0\n") == "blade.csv:2:1: '-inf' is not a finite number");
    CHECK(table_error(header + "0,1e999\n") == "blade.csv:2:3: '1e999' does not fit into a double");
    CHECK(table_error(header + "\xC3\xA4\xC3\xB6,x\n") == "blade.csv:2:1: '\xC3\xA4\xC3\xB6' is not a number");
    CHECK(table_error("\xC3\xA4[m],b[m]\n1,2\n3,x\n") == "blade.csv:3:3: 'x' is not a number");
}

TEST_CASE("csv table: a header that is missing or wrong is an error", "[property]") {
    CHECK(table_error("") == "blade.csv:1: the file is empty: no header, no data");
    CHECK(table_error("# only\n# comments\n\n") == "blade.csv:3: the file is empty: no header, no data");
    CHECK(table_error(header) == "blade.csv:1: there is a header but no data");
    CHECK(table_error("0,1\n2,3\n") ==
          "blade.csv:1:1: '0' is not a header field: name[unit], with [-] for a pure number");
    for (const char* field : {"span", "span[]", "[m]", "span[m", "span m]", ""}) {
        CHECK_THAT(table_error("a[m]," + std::string(field) + "\n1,2\n"),
                   StartsWith("blade.csv:1:6: '" + std::string(field) + "' is not a header field"));
    }
    CHECK(table_error("# c\na[m],b[m],a[kg]\n1,2,3\n") == "blade.csv:2:11: column 'a' is there twice");
    CHECK_THAT(table_error(quantity_header + "mass,kg,1,\n"), Contains("'quantity' is not a header field"));
}

TEST_CASE("csv table: asking for an unknown column or another unit is an error", "[property]") {
    const CsvTable table = CsvTable::parse("# c\n" + header + "0,1\n", "blade.csv");
    CHECK(message_of([&] { (void)table.column("GJ"); }) == "blade.csv:2: no column 'GJ'; there are: span, EI_flap");
    CHECK(message_of([&] { (void)table.unit("GJ"); }) == "blade.csv:2: no column 'GJ'; there are: span, EI_flap");
    CHECK(message_of([&] { (void)table.column("GJ", "m"); }) ==
          "blade.csv:2: no column 'GJ'; there are: span, EI_flap");
    CHECK(message_of([&] { (void)table.column("EI_flap", "N mm^2"); }) ==
          "blade.csv:2:9: column 'EI_flap': unit N mm^2 expected, N m^2 found");
}

TEST_CASE("csv quantities: numbers, lists of numbers and texts are found by name", "[property]") {
    const CsvQuantities q = CsvQuantities::parse(
        "# c\nquantity,unit,value,source\nmass,kg, 1970 ,P, ca. 2000\ninertia,kg m^2,2.5e4/1.0e5 "
        "/-3,\nkind,-,upwind,A\n",
        "f");
    CHECK(q.names() == std::vector<std::string>{"mass", "inertia", "kind"});
    CHECK(q.number("mass", "kg") == 1970.0);
    CHECK(q.numbers("mass", "kg") == std::vector<double>{1970.0});
    CHECK(q.numbers("inertia", "kg m^2") == std::vector<double>{2.5e4, 1.0e5, -3.0});
    CHECK(q.text("kind") == "upwind");
    CHECK(q.text("mass") == "1970");
    CHECK(q.unit("inertia") == "kg m^2");
    CHECK(q.note("mass") == "P, ca. 2000");
    CHECK(q.note("inertia").empty());
    CHECK(q.has("kind"));
    CHECK_FALSE(q.has("speed"));
    CHECK(q.file() == "f");
}

TEST_CASE("csv quantities: an error names file, line and character column", "[property]") {
    CHECK(quantities_error("") == "turbine.csv:1: the file is empty: no header, no data");
    CHECK(quantities_error(quantity_header) == "turbine.csv:1: there is a header but no data");
    CHECK(quantities_error("mass,kg,1,\n") ==
          "turbine.csv:1:1: no header 'quantity,unit,value' or 'quantity,unit,value,note'");
    CHECK_THAT(quantities_error("quantity,unit\nmass,kg\n"), Contains("no header"));
    CHECK_THAT(quantities_error("quantity,unit,value,note,more\na,b,1,d,e\n"), Contains("no header"));
    CHECK(quantities_error(quantity_header + "mass,kg,1\n") == "turbine.csv:2:9: 3 fields; the header has 4");
    CHECK(quantities_error("quantity,unit,value\nmass,kg,1, b\n") == "turbine.csv:2:12: 4 fields; the header has 3");
    CHECK(quantities_error(quantity_header + ",kg,1,\n") == "turbine.csv:2:1: the quantity has no name");
    CHECK(quantities_error(quantity_header + "mass,,1,\n") ==
          "turbine.csv:2:6: quantity 'mass' has no unit; - for a pure number");
    CHECK(quantities_error(quantity_header + "mass,kg,1,\nlength,m,2,\nmass,kg,3,\n") ==
          "turbine.csv:4:1: quantity 'mass' is there already, in line 2");

    const CsvQuantities q = CsvQuantities::parse(
        "# c\n" + quantity_header + "mass,kg,heavy,\nlist,m,1/x2/3,\ngap,m,1//3,\nnan,m,NaN,\n", "turbine.csv");
    const auto error = [&](auto ask) { return message_of([&] { (void)ask(); }); };
    CHECK(error([&] { return q.number("speed", "rpm"); }) ==
          "turbine.csv:2: no quantity 'speed'; there are: mass, list, gap, nan");
    CHECK(error([&] { return q.text("speed").size(); }) ==
          "turbine.csv:2: no quantity 'speed'; there are: mass, list, gap, nan");
    CHECK(error([&] { return q.number("mass", "t"); }) ==
          "turbine.csv:3:6: quantity 'mass': unit t expected, kg found");
    CHECK(error([&] { return q.number("mass", "kg"); }) == "turbine.csv:3:9: 'heavy' is not a number");
    CHECK(error([&] { return q.number("list", "m"); }) == "turbine.csv:4:8: '1/x2/3' is not a number");
    CHECK(error([&] { return q.numbers("list", "m"); }) == "turbine.csv:4:10: 'x2' is not a number");
    CHECK(error([&] { return q.numbers("list", "kg"); }) ==
          "turbine.csv:4:6: quantity 'list': unit kg expected, m found");
    CHECK(error([&] { return q.numbers("gap", "m"); }) == "turbine.csv:5:9: '' is not a number");
    CHECK(error([&] { return q.number("nan", "m"); }) == "turbine.csv:6:7: 'NaN' is not a finite number");
}

TEST_CASE("csv: a file is read from a path, and one that cannot be read is an error that says why", "[property]") {
    const fs::path folder = fs::temp_directory_path() / cardan::text("cardan_csv_", ::getpid());
    fs::create_directories(folder);
    const std::string path = (folder / "t.csv").string();
    std::ofstream(path) << header << "0,1\n2,x\n";
    CHECK_THROWS_WITH(CsvTable::read(path), StartsWith(path + ":3:3: 'x' is not a number"));
    std::ofstream(path) << header << "0,1\n2,3\n";
    CHECK(CsvTable::read(path).rows() == 2);
    std::ofstream(path) << quantity_header << "mass,kg,3,\n";
    CHECK(CsvQuantities::read(path).number("mass", "kg") == 3.0);
    fs::remove_all(folder);
    CHECK_THROWS_AS(CsvTable::read(path), FileError);
    CHECK_THROWS_WITH(CsvQuantities::read(path), path + ": cannot be read: No such file or directory");
    CHECK_THROWS_WITH(CsvTable::read(fs::temp_directory_path()), Contains("is a folder, not a file"));
}

TEST_CASE("csv: the files of the turbines can be read", "[property]") {
    const CsvTable nrel_blade = CsvTable::read(data("nrel5mw_blade.csv"));
    CHECK(nrel_blade.rows() == 49);
    CHECK(nrel_blade.column("radius_from_rotor_apex", "m").back() == 63.0);
    CHECK(nrel_blade.column("flap_stiffness", "N m^2").front() == 1.811e10);
    CHECK(CsvTable::read(data("nrel5mw_tower.csv")).column("height_above_ground", "m").back() == 87.6);
    CHECK(CsvTable::read(data("wt600_blade.csv")).column("structural_twist", "deg").front() == 16.0);
    const CsvQuantities nrel = CsvQuantities::read(data("nrel5mw_turbine.csv"));
    CHECK(nrel.number("number_of_blades", "-") == 3.0);
    const CsvQuantities wt600 = CsvQuantities::read(data("wt600_turbine.csv"));
    CHECK(wt600.number("hub_height", "m") == 52.2);
    CHECK(wt600.numbers("tower_wall_thickness_thirds", "m") == std::vector<double>{0.020, 0.017, 0.013});
    CHECK(wt600.note("nacelle_mass") == "A");
    for (const std::string& name : nrel.names()) CHECK_FALSE(nrel.numbers(name, nrel.unit(name)).empty());
    for (const std::string& name : wt600.names()) CHECK_FALSE(wt600.numbers(name, wt600.unit(name)).empty());
}

}  // namespace cardan::testing::csv
