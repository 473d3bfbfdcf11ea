// windIO files of both versions.
#include "elements/sections/tube.hpp"
#include "mbs/base/units.hpp"
#include "mbs/kernels/kinematics.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/readers/beamdyn.hpp"
#include "turbines/yaml/description.hpp"
#include "turbines/yaml/windio.hpp"

using namespace cardan;
using namespace cardan::turbines;
using Catch::Matchers::Contains;
using test::message_of;

namespace {

using units::degree;

std::string message_after(const char* file, const char* old_text, const char* new_text) {
    const test::ModelFolder model("windio");
    model.replace(file, old_text, new_text);
    return message_of([&] { (void)read_windio(model / file); });
}

}  // namespace

TEST_CASE("windio: both versions of one machine are read as the same", "[crosscheck]") {
    const TurbineFile one = read_windio(test::data_file("windio/small_v1.yaml")),
                      two = read_windio(test::data_file("windio/small_v2.yaml"));
    const TurbineDescription &a = one.description, &b = two.description;
    CHECK(test::difference(a.blade.line, b.blade.line) < 1e-13);
    CHECK(test::difference(a.tower.line, b.tower.line) == 0);
    CHECK(a.nacelle.tilt == Approx(b.nacelle.tilt).epsilon(1e-14));
    CHECK(a.blade.cone == Approx(b.blade.cone).epsilon(1e-14));
    CHECK(a.nacelle.overhang == Approx(b.nacelle.overhang).epsilon(1e-14));
    CHECK(a.hub.inertia.J == b.hub.inertia.J);
    CHECK(a.nacelle.inertia.J.isApprox(b.nacelle.inertia.J, 1e-14));
    CHECK(a.drive_train.generator_inertia == b.drive_train.generator_inertia);
    CHECK(a.blades == b.blades);
    // Only version 2 has them.
    CHECK(a.drive_train.main_shaft.is_rigid());
    CHECK(b.drive_train.main_shaft.stiffness == 5e6);
    CHECK(a.blade.damping.time_constants == std::array<double, 6>{});
    CHECK(b.blade.damping.time_constants == std::array<double, 6>{1.2e-3, 1.1e-3, 1.0e-3, 1.5e-3, 1.4e-3, 1.3e-3});
    CHECK(one.rotor_speed == 4.7);
    CHECK(two.rotor_speed == 0);
    CHECK(test::has_note(one.notes, "torsional stiffness", "rigid"));
    CHECK(test::has_note(one.notes, "components.blade.internal_structure_2d_fem", "not used"));
    CHECK(test::has_note(one.notes, "components.hub.drag_coefficient", "not used"));
    for (const FileNote& note : one.notes)
        CHECK((note.kind == FileNote::Kind::unused) == (note.why.find("not used") != std::string::npos ||
                                                        note.why.find("without meaning") != std::string::npos));
    CHECK(test::has_note(one.notes, "environment", "without meaning"));
    CHECK(test::has_note(two.notes, "components.drivetrain.outer_shape.cd", "not used"));
    CHECK(test::has_note(two.notes, "components.yaw.elastic_properties.mass", "part of the nacelle"));
}

TEST_CASE("windio: figures in the frames and units of the library", "[analytic]") {
    const TurbineDescription d = read_windio(test::data_file("windio/small_v2.yaml")).description;
    CHECK(d.hub.radius == 0.5);
    CHECK(d.blade.cone == Approx(-2 * degree));  // away from the tower: upwind
    CHECK(d.nacelle.tilt == Approx(4 * degree));
    // The rotor centre is 2 m upwind and 1.1 m above the tower top.
    const double t = d.nacelle.tilt;
    CHECK(d.nacelle.overhang * std::cos(t) == Approx(2).epsilon(1e-14));
    CHECK(d.nacelle.shaft_height + d.nacelle.overhang * std::sin(t) == Approx(1.1).epsilon(1e-14));
    // x along the shaft becomes z, z up becomes x (blade 1), y becomes -y.
    CHECK(d.hub.inertia.com.isApprox(Vec3(0, 0, 0.1)));
    Mat3 J;
    J << 210, -3, 2, -3, 200, -1, 2, -1, 300;
    CHECK(d.hub.inertia.J.isApprox(J, 1e-14));
    CHECK(d.nacelle.inertia.mass == 4650);
    CHECK(d.nacelle.inertia.com.isApprox(Vec3(0.2, 0.05, 0.6) * 4500 / 4650, 1e-14));
}

// In windIO all three lead away from the tower; WISDEM writes them to OpenFAST with the same signs downwind, and with
// the opposite ones upwind.
TEST_CASE("windio: a downwind rotor is on the other side of the tower, in both versions", "[analytic]") {
    const test::ModelFolder model("windio");
    model.replace("small_v1.yaml", "rotor_orientation: Upwind", "rotor_orientation: Downwind");
    model.replace("small_v2.yaml", "rotor_orientation: upwind", "rotor_orientation: downwind");
    for (const char* name : {"small_v1.yaml", "small_v2.yaml"}) {
        CAPTURE(name);
        const TurbineFile file = read_windio(model / name),
                          upwind = read_windio(test::data_file(text("windio/", name)));
        const TurbineDescription &d = file.description, &u = upwind.description;
        CHECK(d.blade.cone == Approx(2 * degree));
        CHECK(d.nacelle.tilt == Approx(-4 * degree));
        CHECK(d.nacelle.overhang == -u.nacelle.overhang);
        CHECK(d.nacelle.shaft_height == u.nacelle.shaft_height);
        CHECK(test::difference(d.blade.line, u.blade.line) == 0);
        CHECK(test::has_note(file.notes, "assembly.rotor_orientation", "away from the tower"));
    }
    // The rotor centre is 2 m downwind and 1.1 m above the tower top, 24 m up; tips that cone lie further downwind.
    const TurbineDescription d = read_windio(model / "small_v2.yaml").description;
    const Turbine turbine = assemble(d, {.tower_elements = 1, .blade_elements = 1});
    Workspace workspace(turbine.system().model);
    const Vector rest = Vector::Zero(turbine.system().model.size());
    const Kinematics kin = kinematics(turbine.system().model, rest, workspace);
    const MachineLayout& layout = turbine.layout();
    CHECK((pose(kin, layout.rotor_centre).p - Vec3(2, 0, 25.1)).norm() < 1e-12);
    // Blade 1, upward: the cone leads downwind by 2 degrees, and the tilt, whose rotor end is up, upwind by 4.
    const Vec3 along = pose(kin, layout.pitch_axes[0]).R.col(0);
    CHECK((along - Vec3(std::sin(-2 * degree), 0, std::cos(2 * degree))).norm() < 1e-12);
}

namespace {

// Bending and torsion alone, beside the layers.
constexpr const char* bending_tower =
    "      outfitting_factor: 1.05\n"
    "      elastic_properties:\n"
    "        stiffness_matrix: {grid: [0.0, 1.0], K44: [4.0, 4.0], K55: [5.0, 5.0], K66: [6.0, 6.0]}\n"
    "        inertia_matrix: {grid: [0.0, 1.0], mass: [1.0, 1.0], i_edge: [0.1, 0.1], i_flap: [0.1, 0.1], "
    "i_plr: [0.2, 0.2]}\n";

}  // namespace

TEST_CASE("windio: a tower with matrices of bending and torsion alone is that of its layers, which is noted",
          "[property]") {
    const test::ModelFolder model("windio");
    model.replace("small_v2.yaml", "      outfitting_factor: 1.05\n", bending_tower);
    const TurbineFile file = read_windio(model / "small_v2.yaml");
    const BeamLine layers = read_windio(test::data_file("windio/small_v2.yaml")).description.tower.line;
    CHECK(test::difference(file.description.tower.line, layers) == 0);
    CHECK(test::has_note(file.notes, "components.tower.structure.elastic_properties.stiffness_matrix", "its layers"));
}

TEST_CASE("windio: what has no stiffness in the file is rigid, which is noted", "[analytic]") {
    const test::ModelFolder model("windio");
    model.replace("small_v2.yaml", "      outfitting_factor: 1.05\n", bending_tower);
    model.replace("small_v2.yaml", "      layers:\n", "      walls:\n");
    // Version 2 leaves entries out, version 1 has zeros in their place.
    for (const char* key : {"K11", "K22"})
        model.replace("small_v2.yaml", text("          ", key), text("          no_", key));
    for (const char* number : {"[60000000.0", "[30000000.0", "[6000000.0"})
        model.replace("small_v1.yaml", number, "[0.0");
    for (const char* number : {", 72000000.0", ", 36000000.0", ", 7200000.0"})
        model.replace("small_v1.yaml", number, ", 0.0");
    const TurbineFile file = read_windio(model / "small_v2.yaml");
    const Mat6 tower = file.description.tower.line.section(7).compliance;
    CHECK(Mat6(tower - Mat6((Vec6() << 0, 0, 0, 1 / 6.0, 1 / 4.0, 1 / 5.0).finished().asDiagonal()))
              .cwiseAbs()
              .maxCoeff() < 1e-15);
    CHECK(test::has_note(file.notes, "components.tower.structure.elastic_properties.stiffness_matrix",
                         "shear along x, shear along y, extension"));
    const BeamLine blade = file.description.blade.line,
                   soft = read_windio(test::data_file("windio/small_v2.yaml")).description.blade.line;
    CHECK(test::has_note(file.notes, "components.blade.structure.elastic_properties.stiffness_matrix",
                         "rigid, since no stiffness or no inertia is given: shear along x, shear along y"));
    for (double x : {0.0, 3.3, 9.9}) {
        const Mat6 a = blade.section(x).compliance, b = soft.section(x).compliance;
        CHECK(a.block<2, 6>(1, 0).isZero(0));
        CHECK(a.block<3, 3>(3, 3).isApprox(b.block<3, 3>(3, 3), 1e-13));  // they do not couple with shear
        CHECK(a(0, 0) == Approx(b(0, 0)).epsilon(1e-13));
    }
    CHECK(test::difference(read_windio(model / "small_v1.yaml").description.blade.line, blade) < 1e-13);
    // Torsion without any inertia.
    model.replace("small_v2.yaml", ", i_edge: [0.1, 0.1], i_flap: [0.1, 0.1], i_plr: [0.2, 0.2]}", "}");
    const TurbineFile slender = read_windio(model / "small_v2.yaml");
    CHECK(slender.description.tower.line.section(7).compliance(3, 3) == 0);
    CHECK(test::has_note(slender.notes, "components.tower", "shear along y, extension, torsion"));
    const TurbineDescription again = parse_description(to_yaml(file.description), "again.yaml");
    CHECK(test::difference(again.blade.line, blade) == 0);
}

TEST_CASE("windio: what a model lacks may be in a file beside it", "[property]") {
    const test::ModelFolder model("windio");
    const auto move = [&](const std::string& from) {
        const std::string all = test::bytes_of(model / "small_v2.yaml");
        const std::size_t begin = all.find(from), end = all.find('\n', begin) + 1;
        const std::string line = all.substr(begin, end - begin);
        model.replace("small_v2.yaml", line, "");
        return line;
    };
    const std::string hub = move("    elastic_properties: {mass: 1200.0"),
                      nacelle = move("    elastic_properties: {mass: 4500.0");
    CHECK(read_windio(model / "small_v2.yaml").description.missing.size() == 2);
    const ModelAddition masses{"components:\n  hub:\n" + hub + "  drivetrain:\n" + nacelle, "masses.yaml"};
    const TurbineFile whole = read_windio(test::data_file("windio/small_v2.yaml")),
                      pieces = read_windio(model / "small_v2.yaml", {masses});
    CHECK(test::state(whole) == test::state(pieces));
    CHECK_THAT(pieces.description.source, Contains("# masses.yaml\ncomponents:"));
    // The last one counts; what is wrong is reported where it is.
    const ModelAddition heavier{"components: {hub: {elastic_properties: {mass: 1300}}}", "heavier.yaml"},
        wrong{"components:\n  hub:\n    diameter: wide\n", "wrong.yaml"}, list{"- 1\n", "list.yaml"};
    CHECK(read_windio(model / "small_v2.yaml", {masses, heavier}).description.hub.inertia.mass == 1300);
    CHECK_THAT(message_of([&] {
                   (void)read_windio(model / "small_v2.yaml", {masses, wrong});
               }),
               Contains("wrong.yaml:3:15: components.hub.diameter: 'wide' is not a finite number"));
    CHECK_THAT(message_of([&] { (void)read_windio(model / "small_v2.yaml", {list}); }),
               Contains("list.yaml:1: a YAML map expected"));
}

TEST_CASE("windio: angles that machines do not have are taken as they are, and noted", "[property]") {
    const test::ModelFolder model("windio");
    CHECK_FALSE(read_windio(model / "small_v2.yaml").description.unusual);
    model.replace("small_v2.yaml", "cone_angle: 2.0", "cone_angle: 30.0");
    const TurbineFile file = read_windio(model / "small_v2.yaml");
    CHECK(file.description.unusual);
    CHECK(file.description.blade.cone == Approx(-30 * degree));
    CHECK(test::has_note(file.notes, unusual_entries, "blade.cone [rad] = -0.52"));
    CHECK_NOTHROW(file.description.check());
}

TEST_CASE("windio: axes that do not make the diameter and the height of the assembly are noted", "[property]") {
    const auto notes_with = [](const char* sizes) {
        const ModelAddition addition{std::string("assembly: {") + sizes + "}\n", "sizes.yaml"};
        return read_windio(test::data_file("windio/small_v2.yaml"), {addition}).notes;
    };
    // 2 (0.5 + 10) cos 2 deg = 20.99 m; 24 + 1.1 m
    for (const char* good : {"rotor_diameter: 21, hub_height: 25", "rotor_diameter: 0, hub_height: 0"})
        for (const FileNote& note : notes_with(good)) CHECK_THAT(note.why, !Contains("other programs stretch"));
    const std::vector<FileNote> notes = notes_with("rotor_diameter: 15, hub_height: 40");
    CHECK(test::has_note(notes, "assembly.rotor_diameter", "make a diameter of 20.987"));
    CHECK(test::has_note(notes, "assembly.hub_height", "make a height of 25.1"));
}

// As windIO's own converters between its versions have it: rad/s in 1, rev/min from 2.0 on, other names from 2.1 on.
TEST_CASE("windio: the rotor speed is that of its version, in rad/s", "[analytic]") {
    for (const char* control : {"{torque: {VS_maxspd: 45.0}}", "{max_rotor_speed: 45.0}",
                                "{max_rotor_speed: 50.0, rated_rotor_speed: 45.0}"}) {
        CAPTURE(control);
        const test::ModelFolder model("windio");
        model.replace("small_v2.yaml", "materials:", text("control: ", control, "\nmaterials:"));
        CHECK(read_windio(model / "small_v2.yaml").rotor_speed == Approx(1.5 * pi).epsilon(1e-14));
    }
}

TEST_CASE("windio: the tower is a tube of the given wall", "[crosscheck]") {
    const BeamLine line = read_windio(test::data_file("windio/small_v1.yaml")).description.tower.line;
    TubeSpec spec;
    spec.length = 12;
    spec.diameter_base = spec.diameter_top = 1.8;
    spec.wall_thickness = {0.010};
    spec.E = 2.1e11;
    spec.G = 8.1e10;
    spec.density = 1.05 * 7850;
    const BeamLine cylinder = tube(spec);
    CHECK(line.length == 24);
    for (double x : {0.0, 5.0, 11.9}) {
        const BeamSection a = cylinder.section(x), b = line.section(x);
        CHECK((a.compliance - b.compliance).norm() < 1e-13 * a.compliance.norm());
        CHECK(b.mass == Approx(a.mass).epsilon(1e-13));
        CHECK((a.J - b.J).norm() < 1e-13 * a.J.norm());
    }
    // The upper half tapers; between stations h = 1.5 m apart the error of EI ~ D^3 is h^2/8 6 (D'/D)^2 < 3e-3.
    spec.diameter_top = 1.2;
    const BeamLine cone = tube(spec);
    for (double x : {0.7, 3.0, 8.2}) {
        const BeamSection a = cone.section(x), b = line.section(12 + x);
        CHECK(b.compliance(4, 4) == Approx(a.compliance(4, 4)).epsilon(3e-3));
        CHECK(b.mass == Approx(a.mass).epsilon(1e-3));
    }
}

TEST_CASE("windio: matrices of the tower, where given, are read instead of its layers", "[analytic]") {
    const std::vector<double> K = {1e9, 1.1e9, 8e9, 3e10, 2.5e10, 2e10}, mu = {0.01, 0.02, 0.03, 0.04, 0.05, 0.06};
    std::string
        two =
            "      elastic_properties:\n        structural_damping: {mu: [0.01, 0.02, 0.03, 0.04, 0.05, 0.06]}\n"
            "        stiffness_matrix:\n          grid: [0.0, 1.0]\n",
        one =
            "    elastic_properties_mb:\n      six_x_six:\n        stiff_matrix:\n          grid: [0.0, 1.0]\n"
            "          values:\n";
    std::string row;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = i; j < 6; ++j) {
            const std::string entry = std::to_string(i == j ? K[i] : 0.0);
            two += text("          K", i + 1, j + 1, ": [", entry, ", ", entry, "]\n");
            row += (row.empty() ? "" : ", ") + entry;
        }
    two +=
        "        inertia_matrix: {grid: [0.0, 1.0], mass: [2000.0, 1000.0], cm_x: [0.1, 0.1], cm_y: [0.2, 0.2],\n"
        "          i_edge: [700.0, 700.0], i_flap: [600.0, 600.0], i_plr: [1300.0, 1300.0], i_cp: [0.0, 0.0]}\n";
    // m, 0, 0, 0, 0, -m y; m, 0, 0, 0, m x; m, m y, -m x, 0; edge, 0, 0; flap, 0; polar
    const std::string mass =
                          "[2000, 0, 0, 0, 0, -400, 2000, 0, 0, 0, 200, 2000, 400, -200, 0, 700, 0, 0, 600, 0, 1300]",
                      half =
                          "[1000, 0, 0, 0, 0, -200, 1000, 0, 0, 0, 100, 1000, 200, -100, 0, 700, 0, 0, 600, 0, 1300]";
    one += text("            - [", row, "]\n            - [", row, "]\n        inertia_matrix:\n",
                "          grid: [0.0, 1.0]\n          values:\n            - ", mass, "\n            - ", half, "\n");
    const test::ModelFolder model("windio");
    model.replace("small_v2.yaml", "      outfitting_factor: 1.05\n", two);
    model.replace("small_v1.yaml", "  tower:\n", "  tower:\n" + one);
    const TurbineFile a = read_windio(model / "small_v2.yaml"), b = read_windio(model / "small_v1.yaml");
    CHECK(test::difference(a.description.tower.line, b.description.tower.line) < 1e-13);
    // Along the tower, downwind, to the left.
    const BeamSection section = a.description.tower.line.section(12);
    const Vec6 stiffness = section.compliance.diagonal().cwiseInverse();
    CHECK(stiffness.isApprox((Vec6() << K[2], K[0], K[1], K[5], K[3], K[4]).finished(), 1e-13));
    CHECK(section.mass == Approx(1500).epsilon(1e-13));
    CHECK(section.centre.isApprox(Vec3(0, 0.1, 0.2), 1e-12));
    CHECK(section.J(1, 1) == Approx(700 - 1500 * 0.04).epsilon(1e-12));
    CHECK(section.J(2, 2) == Approx(600 - 1500 * 0.01).epsilon(1e-12));
    CHECK(a.description.tower.damping.time_constants ==
          std::array<double, 6>{mu[2], mu[0], mu[1], mu[5], mu[3], mu[4]});
    CHECK(test::has_note(a.notes, "components.tower.structure.layers", "not used"));
    CHECK(test::has_note(b.notes, "components.tower.internal_structure_2d_fem", "not used"));
}

TEST_CASE("windio: the blade is that of a BeamDyn file with the same figures", "[crosscheck]") {
    const test::ModelFolder model("openfast");
    const BeamLine windio = read_windio(test::data_file("windio/small_v2.yaml")).description.blade.line;
    const BeamTable* table = windio.section.table();
    REQUIRE(table != nullptr);
    // Without sweep and couplings the file of the tests has the same line and the same masses.
    std::string main = test::bytes_of(model / "small_BeamDyn.dat");
    for (const char* sweep : {"0.0100", "0.0500", "0.1400", "0.3000"}) {
        const std::size_t at = main.find(text("      ", sweep));
        REQUIRE(at != std::string::npos);
        main.replace(at, 12, "      0.0000");
    }
    model.write("small_BeamDyn.dat", main);
    const BeamLine beamdyn = read_beamdyn(model / "small_BeamDyn.dat").beam.line;
    CHECK(windio.length == Approx(beamdyn.length).epsilon(1e-12));
    for (double s : {0.0, 0.3, 0.55, 0.8, 1.0}) {
        const double x = s * windio.length;
        const BeamSection a = windio.section(x), b = beamdyn.section(s * beamdyn.length);
        CHECK(a.mass == Approx(b.mass).epsilon(1e-9));
        CHECK((a.centre - b.centre).norm() < 1e-4);    // turned by the twist
        CHECK(a.beta == Approx(b.beta).margin(1e-3));  // twist by fractions of arc there, at the key points here
        CHECK((windio.pose(x).p - beamdyn.pose(s * beamdyn.length).p).norm() < 1e-9);
    }
}

TEST_CASE("windio: what cannot be read is reported with file, line and place", "[property]") {
    CHECK_THAT(message_after("small_v2.yaml", "windIO_version: \"2.0\"", "windIO_version: \"3.0\""),
               Contains("version 3.0; allowed: 1.x and 2.x"));
    CHECK_THAT(message_after("small_v2.yaml", "cone_angle", "cone"), Contains("no components.hub.cone_angle"));
    CHECK_THAT(message_after("small_v2.yaml", "K44", "K4"), Contains("no 'K44'; there are: "));
    CHECK_THAT(message_after("small_v2.yaml", "material: steel", "material: iron"), Contains("no material 'iron'"));
    CHECK_THAT(message_after("small_v2.yaml", "E: 2.1e+11", "E: [1.0, 2.0, 3.0]"),
               Contains("several values; allowed: one"));
    CHECK_THAT(message_after("small_v2.yaml", "mu: [", "mu: [0.1, "), Contains("mu: 7 numbers; allowed: 6"));
    CHECK_THAT(message_after("small_v2.yaml", "grid: [0.0, 0.4, 1.0]", "grid: [0.0, 1.4, 1.0]"),
               Contains("1 after 1.4"));
    CHECK_THAT(message_after("small_v2.yaml", "diameter: 1.0", "diameter: one"),
               Contains("components.hub.diameter: 'one' is not a finite number"));
    const test::ModelFolder degrees("windio");
    for (int k = 0; k < 2; ++k) degrees.replace("small_v1.yaml", "[0.24434609527920614", "[14.0");
    CHECK_THAT(message_of([&] { (void)read_windio(degrees / "small_v1.yaml"); }),
               Contains("twist of 14; allowed: half a turn at most (version 1 counts in rad)"));
    CHECK_THAT(message_of([] { (void)read_windio("no/such.yaml"); }), Contains("no/such.yaml: cannot be read"));
    CHECK_THAT(message_of([] { (void)parse_windio("a: b: c\n", "x.yaml"); }), Contains("x.yaml:1:"));
}
