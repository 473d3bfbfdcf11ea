// OpenFAST's files as people write them: what Fortran reads alike is read alike, what another version or program wrote
// is told apart.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/analysis/prepared_machine.hpp"
#include "turbines/machine/machine_text.hpp"
#include "turbines/machine/read_machine.hpp"
#include "turbines/readers/openfast_file.hpp"

#include <regex>

namespace cardan::testing::openfast_dialects {

using namespace turbines;
using Catch::Matchers::Contains;
using test::has_note;
using test::message_of;

namespace {

OpenFastFile file(const std::string& lines) {
    return OpenFastFile::parse("------- heading\n a title \n" + lines, "x.dat");
}

constexpr auto elastodyn_file = "small_ElastoDyn.dat";

// Every file of the model, changed.
template <class Change>
std::string state_of(const char* main, const Change& change) {
    const test::ModelFolder model("openfast");
    for (const auto& one : std::filesystem::directory_iterator(test::data_file("openfast"))) {
        const std::string name = one.path().filename().string();
        model.write(name, change(test::bytes_of(model / name)));
    }
    return test::state(read_openfast(model / main));
}

// Every line, changed.
template <class Change>
auto by_line(const Change& change) {
    return [change](const std::string& text) {
        std::vector<std::string> lines = test::lines_of(text);
        for (std::size_t i = 2; i < lines.size(); ++i) lines[i] = change(lines[i]);
        return test::joined(lines);
    };
}

bool is_row(const std::string& line) {
    return std::regex_match(line, std::regex(R"(([ \t]+[-+.0-9EeDd]+){3,}[ \t]*)"));
}

}  // namespace

TEST_CASE("openfast dialects: what Fortran reads alike gives the same machine", "[property]") {
    for (const char* main : {"small.fst", "small_BeamDyn.fst"}) {
        const std::string expected = test::state(read_openfast(test::data_file(std::string("openfast/") + main)));
        const auto check = [&](const char* what, const auto& change) {
            CAPTURE(main, what);
            CHECK(state_of(main, change) == expected);
        };
        check("tabs", [](std::string text) { return std::regex_replace(text, std::regex(" {2,}"), "\t"); });
        check("line ends of Windows, none at the end", [](std::string text) {
            text = std::regex_replace(text, std::regex("\n"), "\r\n");
            return text.substr(0, text.size() - 2);
        });
        check("Latin-1", by_line([](const std::string& line) {
                  return line.find(" - ") == std::string::npos ? line : line + " \xB0\xE4";
              }));
        check("commas between the numbers of rows", by_line([](const std::string& line) {
                  return is_row(line) ? std::regex_replace(line, std::regex(R"((\S)[ \t]+(?=\S))"), "$1 , ") : line;
              }));
        check("remarks behind rows",
              by_line([](const std::string& line) { return is_row(line) ? line + "  root, 1 2" : line; }));
        check("blank lines and remarks between rows",
              by_line([](const std::string& line) { return is_row(line) ? "\n! next\n" + line : line; }));
        check("exponents without a letter", by_line([](const std::string& line) {
                  return is_row(line) ? std::regex_replace(line, std::regex(R"((\d)E([-+]))"), "$1$2") : line;
              }));
        check("exponents of double precision", by_line([](const std::string& line) {
                  return is_row(line) ? std::regex_replace(line, std::regex("E"), "d") : line;
              }));
        check("words in lower case, keywords in upper case", by_line([](const std::string& line) {
                  const std::size_t end = line.find(" - ");
                  std::string out = line;
                  const bool path = line.find('"') != std::string::npos;
                  for (std::size_t i = 0; i < std::min(end, path ? 0 : line.size()); ++i)
                      out[i] = i < 16 ? lower_case(line[i]) : upper_case(line[i]);
                  return out;
              }));
    }
}

TEST_CASE("openfast dialects: numbers and flags as Fortran takes them", "[property]") {
    OpenFastFile f =
        file("4.0+07 A\n 1.5-3 B\n-2.D+1, C\n.T. D\n.false E\n.True. F\nf G\n8!remark H\n\"a b.dat \" I\n");
    CHECK(f.number("A") == 4e7);
    CHECK(f.number("B") == 1.5e-3);
    CHECK(f.number("C") == -20);
    CHECK(f.flag("D"));
    CHECK_FALSE(f.flag("E"));
    CHECK(f.flag("F"));
    CHECK_FALSE(f.flag("G"));
    CHECK_FALSE(f.has("H"));
    CHECK(f.path("I") == std::filesystem::path("a b.dat"));
    for (const char* bad : {"4.0++07", "4-", "-", "+-1", "1.0E+1+2"})
        CHECK_THAT(message_of([&] { (void)file(text(" ", bad, " Mass - y\n")).number("Mass"); }),
                   Contains("is not a finite number") || Contains("one value expected") || Contains("no line"));
}

TEST_CASE("openfast dialects: the line of names of a table may have remarks, or be one", "[property]") {
    for (const char* names : {"A B(2) C (used only with B = 2) D (used only if E=True)", "A,B(2),C,D - m, kg",
                              "#A B(2) C D", "A B(2) C D ! and E"}) {
        CAPTURE(names);
        OpenFastFile f = file(text(names, "\n (-)  (m) (-) (-)\n 1 2 3 4 root\n 5 6 7 8\n"));
        const OpenFastTable t = f.table("A", 2);
        CHECK(t.names == std::vector<std::string>{"A", "B(2)", "C", "D"});
        CHECK(t.column("D") == std::vector<double>{4, 8});
    }
    OpenFastFile units = file("A B\n m kg\n 1 2\n");
    CHECK(units.table("A", 1).column("B").front() == 2);
    OpenFastFile more = file("A B\n(m) (kg)\n1 2 3\n4 5 6\n");
    CHECK(more.table("A", 2).column("B").back() == 5);
    const auto notes = more.notes({});
    REQUIRE(notes.size() == 1);
    CHECK(to_text(notes.front()) ==
          "x.dat:5: table of A = 3: numbers behind the last column are left out, as in OpenFAST");
}

TEST_CASE("openfast dialects: lists of channels hold no entries, however they are written", "[property]") {
    for (const char* list : {"OutList The next lines contain channels\n\"A, B\" two\n\"C\"  - \"D\"\n",
                             "OutList\nRotSpeed\nRotSpeed, GenSpeed\n",
                             "  OutListED - channels\n-RotTorq\n! a remark\nRotSpeed\n\n5 Entry\n"}) {
        CAPTURE(list);
        OpenFastFile f = file(text("4 Entry\n", list, "END of it\n 6 After\nRotSpeed\nRotSpeed\n"));
        CHECK(f.number("Entry") == 4);
        CHECK(f.number("After") == 6);
        CHECK_FALSE(f.has("The"));
        OpenFastFile without_end = file(text("4 Entry\n", list, "--- next part\n7 Next\n"));
        CHECK(without_end.number("Entry") == 4);
        CHECK(without_end.number("Next") == 7);
        CHECK(file(text("4 Entry\n", list)).number("Entry") == 4);
    }
    // A word that stands alone is an entry only where no other line has it with a value.
    CHECK(file("RotSpeed\n 12 RotSpeed - rpm\nRotSpeed\n").number("RotSpeed") == 12);
    CHECK_THAT(message_of([] { (void)file("RotSpeed\n").number("RotSpeed"); }), Contains("one value expected"));
}

TEST_CASE("openfast dialects: files are found in any case of their names, in lists without quotes", "[property]") {
    const test::ModelFolder model("openfast");
    model.replace("small.fst", ".\\small_ServoDyn.dat", ".\\SMALL_servodyn.DAT");
    model.replace("small.fst", "\"small_ElastoDyn.dat\"", "\" Small_elastodyn.dat \"");
    CHECK(test::state(read_openfast(model / "small.fst")) ==
          test::state(read_openfast(test::data_file("openfast/small.fst"))));
    std::filesystem::create_directory(model / "Polars");
    model.write("Polars/a.dat", "");
    model.write("main.dat",
                "--- x\ny\npolars/A.dat AFNames - first\n! of the tip\nPolars/b.dat\n\"Polars/c.dat\" third\n----\n");
    OpenFastFile f = OpenFastFile::read(model / "main.dat");
    const auto paths = f.paths("AFNames", 3);
    CHECK(paths[0] == std::filesystem::path(model / "Polars/a.dat"));
    CHECK(paths[1].filename() == "b.dat");
    CHECK(paths[2].filename() == "c.dat");
    CHECK_THAT(message_of([&] { (void)f.paths("AFNames", 4); }), Contains("4 names of files expected, found 3"));
}

TEST_CASE("openfast dialects: gravity is the model's", "[property]") {
    const test::ModelFolder model("openfast");
    model.replace("small.fst", "       9.80665   Gravity", "             0   Gravity");
    const TurbineFile none = read_openfast(model / "small.fst");
    CHECK(none.gravity == 0);
    CHECK(has_note(none.notes, "Gravity", "nothing has weight"));
    const Machine machine = read_machine(model / "small.fst");
    CHECK(machine.site.gravity == 0);
    CHECK(parse_machine(to_yaml(machine), "machine.yaml").site.gravity == 0);
    CHECK(assembly_options(machine, {}, true).gravity.isZero(0));
    CHECK(read_machine(test::data_file("openfast/small.fst")).site.gravity == 9.80665);
    model.replace("small.fst", "             0   Gravity", "         -9.81   Gravity");
    CHECK_THAT(message_of([&] { (void)read_openfast(model / "small.fst"); }),
               Contains("Gravity = -9.81; allowed: >= 0"));
}

TEST_CASE("openfast dialects: a main file of FAST 7 is the machine of the same figures in ElastoDyn and ServoDyn",
          "[property]") {
    // FAST 7 has it all in one file: the entries of both, a part of the tower that is rigid, and the foot of the tower
    // in the file of the platform.
    const test::ModelFolder model("openfast");
    const TurbineFile expected = read_openfast(model / "small.fst");
    const auto servo = test::lines_of(test::bytes_of(model / "small_ServoDyn.dat"));
    std::string fast7 = test::bytes_of(model / elastodyn_file);
    const std::string heading = "---------------------- DRIVETRAIN";
    fast7.insert(fast7.find(heading), test::joined({servo.begin() + 2, servo.end()}));
    model.write("old.fst", fast7);
    model.replace("old.fst", "             0   TowerBsHt ", "             0   TwrRBHt   ");
    const TurbineFile read = read_openfast(model / "old.fst");
    CHECK(test::state(read) == test::state(expected));
    CHECK(read.operation.rated_power == expected.operation.rated_power);
    model.write("dashes.fst", "--------\n" + test::bytes_of(model / "old.fst"));
    CHECK(read_openfast(model / "dashes.fst").description.name == read.description.name);
    CHECK(has_note(read.notes, "main file", "entries of ElastoDyn and ServoDyn"));
    for (const FileNote& note : read.notes) CHECK_THAT(note.why, !Contains("not known"));
    // 4 m of it are rigid, it begins 2 m below the water: 24 - 4 + 2 of the 24 m bend, from 2 m above the water on.
    model.replace("old.fst", "             0   TwrRBHt   ", "             4   TwrRBHt   ");
    model.replace("old.fst", heading, "3 PtfmModel\n\"platform.dat\" PtfmFile\n" + heading);
    model.write("platform.dat", "--- platform\nfloats\n 2 TwrDraft - downward\n");
    const TurbineFile afloat = read_openfast(model / "old.fst");
    CHECK(afloat.description.tower.line.length == Approx(22));
    CHECK(afloat.tower_base == 2);
    CHECK(afloat.description.missing_foundation.name == "floating platform");
    CHECK(has_note(afloat.notes, "TwrRBHt", "belongs to the ground"));
}

TEST_CASE("openfast dialects: machines at the limits of what there is", "[property]") {
    const auto with = [](const char* name, const char* old_text, const char* new_text) {
        const test::ModelFolder model("openfast");
        model.replace(name, old_text, new_text);
        return read_openfast(model / "small.fst");
    };
    CHECK(with(elastodyn_file, "0.5   HubRad", "  0   HubRad").description.hub.radius == 0);
    CHECK_THAT(message_of([&] { (void)with(elastodyn_file, "24.0   TowerHt", "-24.0  TowerHt"); }),
               Contains("small_ElastoDyn.dat:64: TowerHt = -24; allowed: above the tower's foot, 0 (TowerBsHt)") &&
                   Contains("under water"));
    CHECK(has_note(with("small.fst", "             0   CompIce", " 1 MHK - fixed\n 0   CompIce").notes, "MHK",
                   "neither buoyancy nor added mass"));
    CHECK(with("small.fst", "\"small_BeamDyn.dat\"    BDBldFile(1)", "\"no.dat\"    BDBldFile(1)").rotor_speed > 0);
}

TEST_CASE("beamdyn: key points count by the order of their columns, whatever their names", "[property]") {
    const test::ModelFolder model("openfast");
    const std::string expected = test::state(read_openfast(model / "small_BeamDyn.fst"));
    model.replace("small_BeamDyn.dat", "kp_xr       kp_yr       kp_zr   initial_twist",
                  "kp_xb       kp_yb       kp_zb   kp_twist");
    CHECK(test::state(read_openfast(model / "small_BeamDyn.fst")) == expected);
}

}  // namespace cardan::testing::openfast_dialects
