// What is easily misread in models of other programs: signs, units, entries deep in the files, parts that do not span
// the whole. Every case gives the right machine, a note or an error, never another machine in silence.
#include "elements/sections/beam_line.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/readers/elastodyn.hpp"
#include "turbines/yaml/windio.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace cardan;
using namespace cardan::turbines;
using Catch::Matchers::Contains;
using test::has_note;
using test::message_of;

namespace {

constexpr auto elastodyn_file = "small_ElastoDyn.dat";

TurbineFile with(const char* main, const char* file, const std::string& old_text, const std::string& new_text) {
    const test::ModelFolder model("openfast");
    model.replace(file, old_text, new_text);
    return read_openfast(model / main);
}

TurbineFile windio_with(const char* file, const std::string& old_text, const std::string& new_text) {
    const test::ModelFolder model("windio");
    model.replace(file, old_text, new_text);
    return read_windio(model / file);
}

}  // namespace

TEST_CASE("openfast: the apex of a two-bladed rotor is upwind of the teeter pin by the undersling", "[analytic]") {
    // ElastoDyn: r_PQ = -UndSling g1 with g1 downwind along the shaft. The overhang counts to the pin, the hub's mass
    // lies HubCM = 0.1 m downwind of the apex.
    const test::ModelFolder model("openfast");
    model.replace(elastodyn_file, "3   NumBl", "2   NumBl");
    model.replace(elastodyn_file, "0   UndSling", "0.25   UndSling");
    const TurbineDescription d = read_elastodyn(model / elastodyn_file).description;
    CHECK(d.nacelle.overhang == 2.0);
    REQUIRE(d.hub.teeter);
    CHECK(d.hub.teeter->undersling == 0.25);
    CHECK(d.hub.teeter->bearing.is_rigid());  // TeetDOF is False
    CHECK(d.hub.inertia.com.z() == Approx(0.1 - 0.25));
    AssemblyOptions bending;
    bending.blade_beam.emplace().torsion = bending.tower_beam.emplace().torsion = false;
    const Turbine turbine = assemble(d, bending);
    const Model& model_of = turbine.system().model;
    Workspace workspace(model_of);
    const Kinematics kin = kinematics(model_of, Vector::Zero(model_of.size()), workspace);
    const auto along_shaft = [&](const char* frame) {
        const Pose<double> shaft = pose(kin, turbine.layout().shaft);
        return shaft.R.col(0).dot(pose(kin, model_of.frame(frame)).p - shaft.p);
    };
    CHECK(along_shaft("rotor centre") == Approx(-2.0));
    CHECK((along_shaft("blade 1 root") + along_shaft("blade 2 root")) / 2 ==
          Approx(-2.25 + d.hub.radius * std::sin(d.blade.cone)));
}

TEST_CASE("elastodyn: a hub that teeters has the springs and dampers that act from rest; stops are noted",
          "[analytic]") {
    const test::ModelFolder model("openfast");
    model.replace(elastodyn_file, "3   NumBl", "2   NumBl");
    model.replace(elastodyn_file, "False   TeetDOF", "True   TeetDOF");
    const auto teeter = [&] { return *read_elastodyn(model / elastodyn_file).description.hub.teeter; };
    CHECK(teeter().bearing.kind == JointSupport::Kind::free);
    model.replace(elastodyn_file, "0   TeetMod", "1   TeetMod");
    model.replace(elastodyn_file, "0   TeetDmp ", "40000   TeetDmp ");
    model.replace(elastodyn_file, "0   TeetSSSp", "3000   TeetSSSp");
    model.replace(elastodyn_file, "0   Delta3", "15   Delta3");
    CHECK(teeter().bearing.stiffness == 3000);
    CHECK(teeter().bearing.damping == 40000);
    CHECK(teeter().delta3 == Approx(15 * pi / 180));
    model.replace(elastodyn_file, "0   TeetSStP", "3   TeetSStP");
    model.replace(elastodyn_file, "0   TeetDmpP", "2   TeetDmpP");
    const TurbineFile stops = read_elastodyn(model / elastodyn_file);
    CHECK(stops.description.hub.teeter->bearing.kind == JointSupport::Kind::free);
    CHECK(stops.description.hub.teeter->bearing.damping == 0);
    CHECK(test::has_note(stops.notes, "TeetSStP", "a stop"));
    // What a note means for results.
    const auto kind = [&](const std::string& keyword) {
        const auto found = std::ranges::find_if(
            stops.notes, [&](const FileNote& note) { return note.keyword.find(keyword) != std::string::npos; });
        REQUIRE(found != stops.notes.end());
        return found->kind;
    };
    CHECK(kind("TeetSStP") == FileNote::Kind::left_out);
    CHECK(kind("FlStTunr(2)") == FileNote::Kind::left_out);
    CHECK(kind("OutList") == FileNote::Kind::unused);
    for (const FileNote& note : stops.notes) {
        const std::size_t listed = static_cast<std::size_t>(std::ranges::count(note.keyword, ',')) + 1;
        CHECK(note.entries() == (note.line == 0 ? listed : 1));
    }
    CHECK(test::has_note(stops.notes, "TeetDmpP", "beyond an angle"));
    model.replace(elastodyn_file, "0   HubIner_Teeter", "5   HubIner_Teeter");
    CHECK_THAT(message_of([&] { (void)read_elastodyn(model / elastodyn_file); }),
               Contains("HubIner_Teeter = 5; allowed: at least 12"));
    model.replace(elastodyn_file, "5   HubIner_Teeter", "32   HubIner_Teeter");
    const RigidInertia hub = read_elastodyn(model / elastodyn_file).description.hub.inertia;
    CHECK(hub.J(1, 1) == Approx(20 / std::pow(std::cos(15 * pi / 180), 2)));
    CHECK(hub.J(2, 2) == 300);
}

TEST_CASE("openfast: a damping ratio of zero stays one, all zeros are no damping", "[analytic]") {
    const auto flap = [](const char* second, const char* first) {
        const test::ModelFolder model("openfast");
        model.replace("small_Blade.dat", "0.7   BldFlDmp(2)", text(second, "   BldFlDmp(2)"));
        model.replace("small_Blade.dat", "0.5   BldFlDmp(1)", text(first, "   BldFlDmp(1)"));
        return read_openfast(model / "small.fst").description.blade.damping.modal.bending_y;
    };
    CHECK(flap("0.0", "0.5") == std::vector<double>{0.005, 0});
    CHECK(flap("0.7", "0.0") == std::vector<double>{0, 0.7 / 100});
    CHECK(flap("0.0", "0.0").empty());
}

TEST_CASE("openfast: structure that lies outside of the structure's files is noted by itself", "[property]") {
    const auto servo = [](const char* entry) {
        return with("small.fst", "small_ServoDyn.dat", "             0   YCMode",
                    text(entry, "\n             0   YCMode"));
    };
    CHECK(has_note(servo("  1  NumNStC - nacelle").notes, "NumNStC", "not part of the model"));
    CHECK(has_note(servo(" True  CompTTMD - tower").notes, "CompTTMD", "not part of the model"));
    CHECK_FALSE(has_note(servo("  0  NumBStC - blades").notes, "NumBStC", "not part of the model"));
    const auto main = [](const char* old_text, const char* new_text) {
        return with("small_BeamDyn.fst", "small_BeamDyn.fst", old_text, new_text);
    };
    CHECK_THAT(
        message_of([&] { (void)main("\"small_BeamDyn.dat\"    BDBldFile(2)", "\"another.dat\"    BDBldFile(2)"); }),
        Contains("BDBldFile(2): ") && Contains("another.dat: cannot be read"));
    CHECK(has_note(main("             2   CompElast", "  True   MirrorRotor\n             2   CompElast").notes,
                   "MirrorRotor", "clockwise"));
    CHECK_THAT(
        message_of([&] { (void)main("             2   CompElast", "  2   NRotors\n             2   CompElast"); }),
        Contains("NRotors = 2; allowed: 1"));
}

TEST_CASE("beamdyn: members and few key points are noted", "[property]") {
    const auto notes = [](const char* a, const char* b) {
        return with("small_BeamDyn.fst", "small_BeamDyn.dat", a, b).notes;
    };
    const auto plain = notes("1   member_total", "1   member_total");
    CHECK_FALSE(has_note(plain, "member_total", ""));
    CHECK_FALSE(has_note(plain, "without a keyword", ""));
    CHECK(has_note(notes("1   member_total - (-)\n             5   kp_total     - (-)\n     1     5",
                         "2   member_total - (-)\n             5   kp_total     - (-)\n     1     3\n     2     3"),
                   "member_total", "one smooth line"));
    CHECK_THAT(message_of([&] { (void)notes("1   member_total", "5   member_total"); }), Contains("allowed: 1 ... 4"));
}

TEST_CASE("openfast: numbers that belong to no keyword or column are not dropped silently", "[property]") {
    CHECK(has_note(with(elastodyn_file, elastodyn_file, "             0   TipMass(1)", "  5000 - tip brake").notes,
                   "line without a keyword", "without effect"));
    const TurbineFile more =
        with("small.fst", "small_Blade.dat", "4.0000E+07   4.2000E+07", "4.0000E+07   4.2000E+07 9.9");
    CHECK(has_note(more.notes, "table of BlFract", "numbers behind the last column are left out"));
    CHECK(test::state(more) == test::state(read_openfast(test::data_file("openfast/small.fst"))));
}

TEST_CASE("elastodyn: a column of FAST 7 that is all zeros is as good as none", "[property]") {
    const test::ModelFolder model("openfast");
    const auto with_column = [&](const char* value, const char* column = " GJStff", const char* more = "") {
        std::string out;
        bool rows = false;
        for (const std::string& line : test::lines_of(test::bytes_of(test::data_file("openfast/small_Blade.dat")))) {
            const bool names = line.find("BlFract") != std::string::npos, heading = line.starts_with("---");
            rows = (rows || names) && !heading;
            out += line + (names ? column : rows ? text(" ", value, more) : "") + "\n";
        }
        model.write("small_Blade.dat", out);
        return read_openfast(model / "small.fst");
    };
    const TurbineFile zeros = with_column("0"), given = with_column("1e6");
    CHECK(zeros.description.blade.line.section(5).compliance(3, 3) == 0);
    CHECK_FALSE(has_note(zeros.notes, "GJStff", ""));
    // Nothing turns with the blade where its sections have no inertia about its axis.
    CHECK(given.description.blade.line.section(5).compliance(3, 3) == 0);
    CHECK(has_note(given.notes, "GJStff", "no inertia of the sections"));
    const TurbineFile with_inertia = with_column("1e6", " GJStff FlpIner", " 12");
    CHECK(with_inertia.description.blade.line.section(5).compliance(3, 3) == Approx(1e-6).epsilon(1e-14));
    CHECK(has_note(with_inertia.notes, "GJStff", "columns of FAST 7"));
}

TEST_CASE("openfast: files of another kind, or missing, are reported where they are named", "[property]") {
    CHECK_THAT(message_of([] { (void)read_openfast(test::data_file("openfast/small_Blade.dat")); }),
               Contains("small_Blade.dat:1: neither a main file of OpenFAST") && Contains("nor one of ElastoDyn"));
    CHECK_THAT(message_of([] { (void)with(elastodyn_file, elastodyn_file, "\"small_Tower.dat\"", "\"no.dat\""); }),
               Contains("small_ElastoDyn.dat:121: TwrFile: ") && Contains("no.dat: cannot be read"));
    CHECK_THAT(message_of([] { (void)with("small.fst", "small.fst", "\"small_ElastoDyn.dat\"", "\"no.dat\""); }),
               Contains("small.fst:20: EDFile: "));
    // The title is no heading.
    const test::ModelFolder model("openfast");
    std::vector<std::string> lines = test::lines_of(test::bytes_of(model / "small_BeamDyn_Blade.dat"));
    lines.at(1) = "Blade with distributed properties and mu1 of 0.001";
    model.write("small_BeamDyn_Blade.dat", test::joined(lines));
    CHECK(test::state(read_openfast(model / "small_BeamDyn.fst")) ==
          test::state(read_openfast(test::data_file("openfast/small_BeamDyn.fst"))));
}

TEST_CASE("windio: a rotor of unknown orientation is refused", "[property]") {
    const auto side = [](const char* word) {
        return message_of([&] {
            (void)windio_with("small_v2.yaml", "rotor_orientation: upwind", text("rotor_orientation: ", word));
        });
    };
    CHECK_THAT(side("sideways"), Contains("assembly.rotor_orientation: 'sideways'; allowed: upwind and downwind"));
    CHECK_NOTHROW((void)windio_with("small_v2.yaml", "rotor_orientation: upwind", "rotor_orientation: Upwind"));
    CHECK_THAT(message_of([] { (void)windio_with("small_v1.yaml", "cone_angle: 0.03", "cone_angle: 2.03"); }),
               Contains("below an eighth of a turn (version 1 counts in rad)"));
}

TEST_CASE("windio: entries within entries that were read are noted as well", "[property]") {
    const auto notes = [](const char* old_text, const char* new_text) {
        return windio_with("small_v2.yaml", old_text, new_text).notes;
    };
    const auto elastic =
        notes("        structural_damping: {mu: [",
              "        point_mass: [{grid: 0.5, mass: 100}]\n        structural_damping: {zz: 1, mu: [");
    CHECK(has_note(elastic, "components.blade.structure.elastic_properties.point_mass", "not used"));
    CHECK(has_note(elastic, "elastic_properties.structural_damping.zz", "not used"));
    CHECK(has_note(notes("          K11: [", "          K21: [9, 9, 9]\n          K11: ["), "stiffness_matrix.K21",
                   "not used"));
    CHECK(has_note(notes("{name: wall, material", "{name: wall, fancy: 7, material"),
                   "components.tower.structure.layers[0].fancy", "not used"));
    CHECK_FALSE(has_note(notes("E: 2.1e+11", "E: 2.1e+11"), "layers[0].name", ""));
}

TEST_CASE("windio: grids of tower and axis span the whole, and all their places count", "[analytic]") {
    const auto message = [](const char* old_text, const char* new_text) {
        return message_of([&] { (void)windio_with("small_v2.yaml", old_text, new_text); });
    };
    CHECK_THAT(message("thickness: {grid: [0.0, 1.0]", "thickness: {grid: [0.2, 0.5]"),
               Contains("thickness.grid: places 0.2 ... 0.5; allowed: 0 ... 1"));
    CHECK_THAT(message("outer_diameter: {grid: [0.0, 0.5, 1.0]", "outer_diameter: {grid: [0.0, 0.25, 0.5]"),
               Contains("outer_diameter.grid: places 0 ... 0.5"));
    CHECK_THAT(message("x: {grid: [0.0, 0.25, 0.5, 0.75, 1.0]", "x: {grid: [0.1, 0.25, 0.5, 0.75, 0.9]"),
               Contains("reference_axis.x.grid: places 0.1 ... 0.9"));
    // A finer grid of y does not take the places of x and z away.
    const BeamLine plain = read_windio(test::data_file("windio/small_v2.yaml")).description.blade.line;
    const BeamLine fine =
        windio_with(
            "small_v2.yaml", "y: {grid: [0.0, 1.0], values: [0.0, 0.0]}",
            "y: {grid: [0.0, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0], values: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]}")
            .description.blade.line;
    const BeamTable* table = fine.section.table();
    REQUIRE(table != nullptr);
    for (const Vec3& p : plain.section.table()->points)
        CHECK(std::any_of(table->points.begin(), table->points.end(),
                          [&](const Vec3& q) { return (p - q).norm() < 1e-14; }));
}

TEST_CASE("windio: the drive train's spring under its name of version 1", "[property]") {
    const TurbineDescription d =
        windio_with("small_v1.yaml", "      system_mass: 4500.0\n",
                    "      spring_constant: 7.0e+6\n      damping_coefficient: 2.0e+4\n      system_mass: 4500.0\n")
            .description;
    CHECK(d.drive_train.main_shaft.stiffness == 7e6);
    CHECK(d.drive_train.main_shaft.damping == 2e4);
}

TEST_CASE("windio: the tilt under its name before version 1", "[property]") {
    CHECK(
        windio_with("small_v1.yaml", "      uptilt: 0.06981", "      uptilt_angle: 0.06981").description.nacelle.tilt ==
        read_windio(test::data_file("windio/small_v1.yaml")).description.nacelle.tilt);
}

TEST_CASE("own yaml: what cannot be read again is not written", "[property]") {
    TurbineDescription d = read_openfast(test::data_file("openfast/small.fst")).description;
    d.hub.radius = std::numeric_limits<double>::infinity();
    CHECK_THAT(message_of([&] { (void)to_yaml(d); }), Contains("radius: number = inf; allowed: finite"));
    d.hub.radius = 1;
    d.yaw.rotation.stiffness = -std::numeric_limits<double>::infinity();
    CHECK_THAT(message_of([&] { (void)to_yaml(d); }), Contains("rotation: number = -inf; allowed: finite"));
    d.yaw.rotation.stiffness = 1;
    d.blades = 1001;
    CHECK_THAT(message_of([&] { (void)to_yaml(d); }), Contains("blades: number = 1001; allowed: 0 ... 1000"));
    d.blades = 3;
    const std::string plain = to_yaml(d);
    CHECK(is_description(plain));
    std::string in_quotes = plain;
    in_quotes.replace(in_quotes.find("cardan_turbine"), 14, "\"cardan_turbine\"");
    CHECK(is_description(in_quotes));
    CHECK_FALSE(is_description(test::bytes_of(test::data_file("windio/small_v2.yaml"))));
}
