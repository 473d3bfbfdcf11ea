// Lines of OpenFAST files: values, keyword, remark.
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/readers/openfast_file.hpp"

using namespace cardan;
using Catch::Matchers::Contains;
using test::message_of;
using turbines::OpenFastFile;

namespace {

OpenFastFile file(const std::string& lines) {
    return OpenFastFile::parse("------- heading\n a title \n" + lines, "folder/x.dat");
}

}  // namespace

TEST_CASE("openfast file: entries are found by keyword in any case, with or without a remark", "[property]") {
    OpenFastFile f = file(
        "  1.5D+3  Mass(1)  - of the first (kg)\r\n"
        "\"DEFAULT\"\tDT\t- step\n"
        ".TRUE. Flag\n"
        "t Other - a flag\n"
        " 5.   FLOAT remark without a dash\n"
        "-.5e-1 Small - x ! y\n"
        " '../a b/c.dat'  Path - to a file\n"
        "..\\d\\e.dat Windows - path\n"
        "1, 2,\t3  List - of numbers\n");
    CHECK(f.title() == "a title");
    CHECK(f.number("mass(1)") == 1500);
    CHECK(f.number("Mass1") == 1500);  // some files have the brackets, some have not
    CHECK(f.word("dt") == "DEFAULT");
    CHECK(f.flag("FLAG"));
    CHECK(f.flag("Other"));
    CHECK(f.number("Float") == 5);
    CHECK(f.number("small") == -0.05);
    CHECK(f.path("Path") == std::filesystem::path("folder/../a b/c.dat"));
    CHECK(f.path("Windows") == std::filesystem::path("folder/../d/e.dat"));
    CHECK(f.numbers("List", 3) == std::vector<double>{1, 2, 3});
    CHECK(f.number_or("Missing", 7) == 7);
    CHECK_FALSE(f.has("remark"));
}

TEST_CASE("openfast file: headings, output lists and what follows END hold no entries", "[property]") {
    OpenFastFile f = file(
        "--- 1 Heading\n=== 2 Heading\n! 3 Heading\n\n   OutList - channels\n\"A, B\" - two\n 1 NoEntry - in the "
        "list\nEND of "
        "the list\n 4 Entry - after it\n");
    for (const char* none : {"Heading", "NoEntry", "of"}) CHECK_FALSE(f.has(none));
    CHECK(f.number("Entry") == 4);
}

TEST_CASE("openfast file: errors give file, line and what was expected", "[property]") {
    const auto message = [](const std::string& lines, const auto& action) {
        return message_of([&] {
            OpenFastFile f = file(lines);
            action(f);
        });
    };
    const auto number = [](OpenFastFile& f) { (void)f.number("Mass"); };
    CHECK_THAT(message(" 1 Other - x\n", number), Contains("folder/x.dat:3: no line with the keyword Mass"));
    CHECK_THAT(message(" 1 Mass\n 2 mass\n", number), Contains("folder/x.dat:4: Mass is there already, in line 3"));
    CHECK_THAT(message(" x Mass - y\n", number), Contains("folder/x.dat:3:2: Mass: 'x' is not a finite number"));
    for (const char* bad : {"nan", "1e999", "inf", "1.5.2", "\"3\"", "0x10", "1e", "--1"})
        CHECK_THAT(message(text(" ", bad, " Mass - y\n"), number), Contains("is not a finite number"));
    CHECK_THAT(message(" 1 2 Mass - y\n", number), Contains("folder/x.dat:3: one value expected before Mass, found 2"));
    CHECK_THAT(message(" yes Mass\n", [](OpenFastFile& f) { (void)f.flag("Mass"); }),
               Contains("folder/x.dat:3:2: Mass: 'yes' is neither True nor False"));
    CHECK_THAT(message(" 2.5 Mass\n", [](OpenFastFile& f) { (void)f.integer("Mass", 1, 3); }),
               Contains("Mass = 2.5; allowed: a whole number, 1 ... 3"));
    CHECK_THAT(
        message_of([] { (void)OpenFastFile::parse("--- a\nb\n" + std::string(2'000'000, '1') + "\n", "x.dat"); }),
        Contains("x.dat:3: a line of 2000000 bytes; allowed: at most 1000000"));
    CHECK_THAT(message(" \"\" Mass\n", [](OpenFastFile& f) { (void)f.path("Mass"); }), Contains("is empty"));
    CHECK_THAT(message_of([] { (void)OpenFastFile::parse("one line", "y"); }), Contains("y:1: an OpenFAST input file"));
    CHECK_THAT(message_of([] { (void)OpenFastFile::read("no/such.dat"); }),
               Contains("no/such.dat: cannot be read: No such file"));
    CHECK_THAT(message_of([] { (void)OpenFastFile::read("/tmp"); }), Contains("is a folder"));
}

TEST_CASE("openfast file: tables have as many rows as announced, each with all columns", "[property]") {
    const std::string head = "  A   B(2)\n (-)  (m)\n";
    OpenFastFile f = file(head + " 1 2\n 3 4\n--- end\n");
    const turbines::OpenFastTable t = f.table("a", 2);
    CHECK(t.column("b(2)") == std::vector<double>{2, 4});
    CHECK(t.rows() == 2);
    const auto message = [&](const std::string& rows, std::size_t count) {
        return message_of([&] { (void)file(head + rows).table("A", count); });
    };
    CHECK_THAT(message("1 2\n3\n", 2),
               Contains("x.dat:6: row 2 of 2 of the table of A (A, B(2)): 2 numbers expected, found 1"));
    CHECK_THAT(message("1 2\n--- end\n", 2), Contains("x.dat:6: row 2 of 2"));
    CHECK_THAT(message("1 2\n", 2), Contains("the file ends before it"));
    CHECK_THAT(message("1 2\n3 4\n5 6\n", 2), Contains("x.dat:7: one more row than the 2 announced"));
    CHECK_THAT(message("1 2\n3 *\n", 2),
               Contains("x.dat:6:3: row 2 of 2 of the table of A (A, B(2)): 2 numbers expected, found 1, then '*'"));
    CHECK_THAT(message("1 2\n3 x4\n", 2), Contains("x.dat:6: ") && Contains("found 1, then 'x4'"));
    CHECK_THAT(message_of([&] { (void)file(head + "1 2\n").table("C", 1); }),
               Contains("no table whose first column is C"));
    CHECK_THAT(message_of([&] { (void)t.column("C"); }), Contains("no column 'C'; there are: A, B(2)"));
}

TEST_CASE("openfast file: bytes that are not UTF-8 are read as Latin-1", "[property]") {
    CHECK(file("1 A - \xB0 and \xE4\n").text() == "------- heading\n a title \n1 A - \xC2\xB0 and \xC3\xA4\n");
    CHECK(file("1 A - \xC2\xB0\n").text() == "------- heading\n a title \n1 A - \xC2\xB0\n");
}

TEST_CASE("openfast file: entries not asked for are noted, by group or one by one", "[property]") {
    OpenFastFile f = file(" 1 Asked\n 2 OutA - x\n 3 OutB - x\n 4, 5 Strange - x\n 6 Off\n");
    (void)f.number("Asked");
    f.note_unless("Off", 6, "not neutral");
    f.note("Asked", "was asked");
    const auto notes = f.notes({{{"Out*"}, "output"}});
    REQUIRE(notes.size() == 3);
    CHECK(to_text(notes[0]) == "folder/x.dat:3: Asked = 1: was asked");
    CHECK(to_text(notes[1]) == "folder/x.dat:6: Strange = 4, 5: not known to this reader and without effect");
    CHECK(to_text(notes[2]) == "folder/x.dat: OutA, OutB: output");
}
