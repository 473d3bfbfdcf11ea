// Our own YAML: what is written is read again bit for bit, and nothing else is read.
#include "elements/sections/tube.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/reference_turbines/nrel5mw_platform.hpp"
#include "turbines/reference_turbines/oc3_hywind.hpp"
#include "turbines/reference_turbines/teetered.hpp"
#include "turbines/reference_turbines/wt600.hpp"

using namespace cardan;
using namespace cardan::turbines;
using Catch::Matchers::Contains;
using test::message_of;

namespace {

// Equal bits, section by section, at places that are stations and at others.
void check_same_bits(const BeamLine& a, const BeamLine& b) {
    REQUIRE(a.length == b.length);
    CHECK(a.breaks == b.breaks);
    CHECK(a.name == b.name);
    CHECK(a.is_straight() == b.is_straight());
    for (int i = 0; i <= 60; ++i) {
        const double x = a.length * i / 60.0;
        const BeamSection s = a.section(x), t = b.section(x);
        CHECK(s.compliance == t.compliance);
        CHECK(s.mass == t.mass);
        CHECK(s.centre == t.centre);
        CHECK(s.J == t.J);
        CHECK(s.beta == t.beta);
        CHECK(a.pose(x).R == b.pose(x).R);
        CHECK(a.pose(x).p == b.pose(x).p);
    }
}

void check_round_trip(const TurbineDescription& d) {
    const std::string written = to_yaml(d);
    const TurbineDescription read = parse_description(written, "machine.yaml");
    CHECK(to_yaml(read) == written);
    check_same_bits(d.tower.line, read.tower.line);
    check_same_bits(d.blade.line, read.blade.line);
    CHECK(read.name == d.name);
    CHECK(read.source == d.source);
    CHECK(read.nacelle.inertia.J == d.nacelle.inertia.J);
    CHECK(read.nacelle.inertia.com == d.nacelle.inertia.com);
    CHECK(read.nacelle.inertia.reduced == d.nacelle.inertia.reduced);
    CHECK(read.nacelle.tilt == d.nacelle.tilt);
    CHECK(read.blade.cone == d.blade.cone);
    CHECK(read.yaw.rotation.stiffness == d.yaw.rotation.stiffness);
    CHECK(read.blade.damping.time_constants == d.blade.damping.time_constants);
    CHECK(read.blade.damping.modal.bending_y == d.blade.damping.modal.bending_y);
}

void check_same_platform(const TurbineDescription& d) {
    check_round_trip(d);
    const TurbineDescription read = parse_description(to_yaml(d), "machine.yaml");
    REQUIRE(read.platform);
    const PlatformDescription &a = *d.platform, &b = *read.platform;
    CHECK(a.name == b.name);
    CHECK(a.source == b.source);
    CHECK(a.inertia.mass == b.inertia.mass);
    CHECK(a.inertia.com == b.inertia.com);
    CHECK(a.inertia.J == b.inertia.J);
    CHECK(a.tower_base == b.tower_base);
    CHECK(a.added_mass == b.added_mass);
    CHECK(a.hydrostatic_stiffness == b.hydrostatic_stiffness);
    CHECK(a.mooring_stiffness == b.mooring_stiffness);
    CHECK(a.damping == b.damping);
    CHECK(a.buoyancy == b.buoyancy);
    CHECK(a.buoyancy_centre == b.buoyancy_centre);
    CHECK(a.mooring_preload == b.mooring_preload);
    CHECK(a.coordinates.role == b.coordinates.role);
    CHECK(a.coordinates.roles == b.coordinates.roles);
    CHECK(a.coordinates.directions == b.coordinates.directions);
    CHECK(a.coordinates.rotations == b.coordinates.rotations);
    CHECK(read.tower.rigid == d.tower.rigid);
}

// A text with one place changed.
std::string message_after(std::string changed, const std::string& old_text, const std::string& new_text) {
    const std::size_t at = changed.find(old_text);
    if (at == std::string::npos) return "no such text";
    changed.replace(at, old_text.size(), new_text);
    return message_of([&] { (void)parse_description(changed, "machine.yaml"); });
}

std::string small() {
    static const std::string text = to_yaml(read_openfast(test::data_file("openfast/small.fst")).description);
    return text;
}

std::string message_after(const std::string& old_text, const std::string& new_text) {
    return message_after(small(), old_text, new_text);
}

}  // namespace

TEST_CASE("description yaml: written and read again it is the same machine, bit for bit", "[property]") {
    SECTION("ElastoDyn") {
        check_round_trip(read_openfast(test::data_file("openfast/small.fst")).description);
    }
    SECTION("BeamDyn, curved") {
        check_round_trip(read_openfast(test::data_file("openfast/small_BeamDyn.fst")).description);
    }
    SECTION("teetered, downwind, free to yaw") {
        TurbineDescription d = teetered_description();
        d.hub.teeter->undersling = 1.0 / 3;
        d.hub.teeter->delta3 = 0.1;
        d.yaw.rotation = {0, 7.0 / 3, JointSupport::Kind::free};
        d.drive_train.shaft.mass = 0.1;
        check_round_trip(d);
        const TurbineDescription read = parse_description(to_yaml(d), "machine.yaml");
        REQUIRE(read.hub.teeter);
        CHECK(read.hub.teeter->undersling == d.hub.teeter->undersling);
        CHECK(read.hub.teeter->bearing.kind == JointSupport::Kind::free);
        CHECK(read.yaw.rotation.damping == 7.0 / 3);
        CHECK(read.rotor_speed == 6.02);
        CHECK(read.drive_train.shaft.mass == 0.1);
        CHECK(assemble(read, teetered_paper_assembly(1)).summary() ==
              assemble(d, teetered_paper_assembly(1)).summary());
    }
    SECTION("blades of their own, a missing one, bearings of every kind") {
        TurbineDescription d = read_openfast(test::data_file("openfast/small.fst")).description;
        d.individual_blades[2] = d.blade;
        d.individual_blades[2]->pitch_setting = 1.0 / 7;
        d.individual_blades[2]->pitch = d.blade.pitch = prescribed_joint;
        d.individual_blades[3] = std::nullopt;
        d.yaw.translation = {1e8, 1.0 / 3};
        d.unusual = true;
        check_round_trip(d);
        const TurbineDescription read = parse_description(to_yaml(d), "machine.yaml");
        CHECK(read.unusual);
        CHECK(read.blade_at(2)->pitch_setting == 1.0 / 7);
        CHECK(read.blade_at(2)->pitch.kind == JointSupport::Kind::prescribed);
        CHECK(read.blade_at(3) == nullptr);
        CHECK(read.blade_at(1) == &read.blade);
    }
    SECTION("a file with every kind of entry") {
        const TurbineDescription d =
            read_description(std::string(CARDAN_SOURCE_DIR) + "/tests/fuzz/seeds/description/variants.yaml");
        check_round_trip(d);
        CHECK(d.yaw.rotation.kind == JointSupport::Kind::free);
        CHECK(d.yaw.rotation.damping == 3);
        CHECK(d.hub.teeter->bearing.damping == 100);
        CHECK(d.blade_at(2)->pitch_setting == 0.05);
        CHECK(d.blade_at(3) == nullptr);
        CHECK(assemble(d, {.tower_elements = 1, .blade_elements = 1}).layout().blade_numbers == std::vector<int>{1, 2});
        CHECK(d.tower.rigid);
        CHECK(d.drive_train.spin == CoordinateRole::prescribed);
        REQUIRE(d.platform);
        CHECK(d.platform->name == "a barge");
        CHECK(d.platform->added_mass(4, 0) == -2e5);
        CHECK(d.platform->buoyancy_centre == Vec3(0, 0, -3));
        CHECK(d.platform->coordinates.role == CoordinateRole::free);
        CHECK(d.platform->coordinates.roles[1] == CoordinateRole::prescribed);
        CHECK(d.platform->coordinates.roles[5] == CoordinateRole::free);
        CHECK_FALSE(d.platform->coordinates.roles[0]);
        const Turbine turbine = assemble(d, {.tower_elements = 1, .blade_elements = 1});
        const CoordinateTable& table = turbine.system().model.coordinates();
        CHECK(table[table.index("platform sway")].role == CoordinateRole::prescribed);
        CHECK(table[table.index("platform surge")].role == CoordinateRole::free);
        CHECK(table.of_part("tower").empty());
    }
    SECTION("on a platform: OC3-Hywind, the platform study; a rigid tower") {
        TurbineDescription spar = nrel5mw_oc3_hywind_description();
        spar.blade.line = beam_line(sampled(spar.blade.line, 1));  // linear between its breaks
        spar.platform->inertia.J(0, 1) = spar.platform->inertia.J(1, 0) = 1.0 / 3;
        spar.platform->coordinates.roles[3] = CoordinateRole::prescribed;
        check_same_platform(spar);
        TurbineDescription study = nrel5mw_platform_description(nrel5mw_platform_blade());
        study.blade.line = beam_line(sampled(study.blade.line, 1));
        check_same_platform(study);
        const TurbineDescription read = parse_description(to_yaml(study), "machine.yaml");
        CHECK(read.tower.rigid);
        CHECK(read.drive_train.spin == CoordinateRole::prescribed);
        CHECK(read.platform->coordinates.directions[1] == -Vec3::UnitY());
        CHECK(read.platform->coordinates.rotations[0] == BaseCoordinate::roll);
        CHECK(assemble(read).summary() == assemble(study).summary());
    }
    SECTION("a hub without blades") {
        TurbineDescription d = read_openfast(test::data_file("openfast/small.fst")).description;
        d.blades = 0;
        check_round_trip(d);
    }
    SECTION("texts with quotes, line ends, control characters; numbers of all sizes") {
        TurbineDescription d = read_openfast(test::data_file("openfast/small.fst")).description;
        // The last ones: next line, line and paragraph separators, which YAML folds; a byte order mark.
        d.name =
            "a \"quoted\" \\ name: # no comment\t\x01 \xC3\xA4 a\xC2\x85z a\xE2\x80\xA8z a\xE2\x80\xA9z \xEF\xBB\xBF "
            "\xC2\x80";
        d.source = "1\n\n 2: x\r\n- y\n";
        d.nacelle.inertia.J << 1.0 / 3, 5e-324, -1e-300, 5e-324, 1.7976931348623157e308, 0.1, -1e-300, 0.1, 2.0 / 7;
        d.blade.damping.time_constants = {0.1, 1e-17, 3, 0, 1.0 / 3, 2};
        d.blade.cone = -0.0;
        check_round_trip(d);
    }
}

TEST_CASE("description yaml: version 1 is read, with its infinite and zero springs", "[property]") {
    // The same machine as it was written then.
    const TurbineDescription old = read_description(std::string(CARDAN_SOURCE_DIR) +
                                                    "/tests/fuzz/seeds/description/small.yaml"),
                             now = read_openfast(test::data_file("openfast/small.fst")).description;
    CHECK(old.yaw.rotation.stiffness == now.yaw.rotation.stiffness);
    CHECK(old.yaw.translation.is_rigid());
    CHECK(old.blade.pitch.is_rigid());
    CHECK(old.drive_train.main_shaft.damping == now.drive_train.main_shaft.damping);
    check_same_bits(old.blade.line, now.blade.line);
    std::string text = test::bytes_of(std::string(CARDAN_SOURCE_DIR) + "/tests/fuzz/seeds/description/small.yaml");
    const std::size_t at = text.find("stiffness: 2e+07");
    REQUIRE(at != std::string::npos);
    text.replace(at, 16, "stiffness: 0");
    CHECK(parse_description(text, "old.yaml").yaw.rotation.kind == JointSupport::Kind::free);
}

TEST_CASE("description yaml: a file is written and read", "[property]") {
    const test::Folder folder;
    const TurbineDescription d = read_openfast(test::data_file("openfast/small.fst")).description;
    write_description(d, folder / "machine.yaml");
    CHECK(to_yaml(read_description(folder / "machine.yaml")) == to_yaml(d));
    CHECK(is_description(test::bytes_of(folder / "machine.yaml")));
    CHECK_FALSE(is_description("windIO_version: 2\n"));
    CHECK_THAT(message_of([&] { write_description(d, folder / "no/machine.yaml"); }), Contains("machine.yaml"));
    CHECK_THAT(message_of([&] { (void)read_description(folder / "none.yaml"); }),
               Contains("none.yaml: cannot be read"));
}

TEST_CASE("description yaml: lines that are functions are refused, sampled ones come near", "[property]") {
    TurbineDescription d = wt600_description();
    d.tower.line = tube({.length = 50.7,
                         .diameter_base = 3.6,
                         .diameter_top = 2.2,
                         .wall_thickness = {0.022, 0.018, 0.014},
                         .E = 2.1e11,
                         .G = 8.1e10,
                         .density = 7850},
                        "tower");
    CHECK_THAT(message_of([&] { (void)to_yaml(d); }), Contains("tower: sections = a function"));
    d.blade.line.section = [own = d.blade.line.section](double x) { return own(x); };
    const BeamLine tower = d.tower.line, blade = d.blade.line;
    d.tower.line = beam_line(sampled(tower, 64));
    d.blade.line = beam_line(sampled(blade, 4));
    check_round_trip(d);
    // Linear between the stations of each piece: the error goes with the square of their distance.
    const double fine = test::difference(blade, d.blade.line),
                 coarse = test::difference(blade, beam_line(sampled(blade, 2)));
    CHECK(fine < 1e-3);
    CHECK(coarse / fine == Approx(4).epsilon(0.3));
    // The wall of the tower jumps: both sides are kept.
    for (double x : tower.breaks)
        for (double at : {x - 1e-3, x + 1e-3})
            if (at > 0 && at < tower.length)
                CHECK(d.tower.line.section(at).mass == Approx(tower.section(at).mass).epsilon(1e-4));
}

TEST_CASE("description yaml: what the format does not define is refused with file, line and what is allowed",
          "[property]") {
    CHECK_THAT(message_after("cardan_turbine: 3", "cardan_turbine: 4"),
               Contains("machine.yaml:2:17: cardan_turbine: version 4; allowed: 1, 2, 3"));
    CHECK_THAT(message_after("  tilt: ", "  titl: "),
               Contains("nacelle: no 'tilt'; there are: inertia, shaft_height, titl"));
    CHECK_THAT(message_after("\nhub:\n", "\nhub:\n  colour: red\n"),
               Contains("hub.colour: not a key of the format; allowed: inertia, radius, teeter"));
    CHECK_THAT(message_after("\nhub:\n", "\nhub:\n  radius: 1\n"), Contains("hub: the key 'radius' is there twice"));
    CHECK_THAT(message_after("overhang: 2", "overhang: .nan"),
               Contains("nacelle.overhang: '.nan' is not a finite number"));
    CHECK_THAT(message_after("overhang: 2", "overhang: .inf"),
               Contains("nacelle.overhang: '.inf' is not a finite number"));
    CHECK_THAT(message_after("blades: 3", "blades: 2.5"), Contains("blades: 2.5; allowed: 0 ..."));
    CHECK_THAT(message_after("reduced: true", "reduced: maybe"), Contains("'maybe' is neither true nor false"));
    CHECK_THAT(message_after("interpolation: linear", "interpolation: cubic"),
               Contains("'cubic'; allowed: linear, log_linear_stiffness"));
    CHECK_THAT(message_after("com: [", "com: [0, "), Contains("com: 4 numbers; allowed: 3"));
    CHECK_THAT(message_after("stations: [0, ", "stations: [0, 0.1, "), Contains("allowed: 5, one per station"));
    CHECK_THAT(message_after("stations: [0, ", "stations: [0.5, "), Contains("first station [m] = 0.5; allowed: 0"));
    CHECK_THAT(message_after("blades: 3", "blades: [3"), Contains("is not YAML"));
    CHECK_THAT(message_of([] { (void)parse_description("- 1\n", "m.yaml"); }),
               Contains("m.yaml:1: a YAML map expected"));
    CHECK_THAT(message_of([] { (void)parse_description("", "m.yaml"); }), Contains("m.yaml:1:"));
    TurbineDescription d = read_openfast(test::data_file("openfast/small.fst")).description;
    d.nacelle.tilt = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(message_of([&] { (void)to_yaml(d); }), Contains("tilt: number = nan; allowed"));
}

TEST_CASE(
    "description yaml: a bad platform is refused with file, line and what is allowed; what has a default may be "
    "missing",
    "[property]") {
    const std::string whole =
        test::bytes_of(std::string(CARDAN_SOURCE_DIR) + "/tests/fuzz/seeds/description/variants.yaml");
    const auto after = [&](const std::string& old_text, const std::string& new_text) {
        return message_after(whole, old_text, new_text);
    };
    CHECK_THAT(after("  rigid: true", "  rigid: yes"), Contains("tower.rigid: 'yes' is neither true nor false"));
    CHECK_THAT(after("  spin: driven", "  spin: locked"),
               Contains("drive_train.spin: 'locked'; allowed: free, driven"));
    CHECK_THAT(after("  tower_foot: [0, 0, 4]", "  tower_foot: [0, 4]"),
               Contains("machine.yaml:") && Contains("platform.tower_foot: 2 numbers; allowed: 3"));
    CHECK_THAT(after("  hydrostatic: [[0, 0, 0, 0, 0, 0], ", "  hydrostatic: ["),
               Contains("platform.hydrostatic: 5 rows; allowed: 6"));
    CHECK_THAT(after("  mooring: [[5.0e+4, 0, ", "  mooring: [[5.0e+4, "),
               Contains("platform.mooring[0]: 5 numbers; allowed: 6"));
    CHECK_THAT(after("  buoyancy: ", "  bouyancy: "), Contains("platform: no 'buoyancy'; there are: "));
    CHECK_THAT(after("    role: free", "    role: held"),
               Contains("platform.coordinates.role: 'held'; allowed: free, driven"));
    CHECK_THAT(after("    role: free\n", ""), Contains("platform.coordinates: no 'role'"));
    CHECK_THAT(after("    sway: driven", "    sideways: driven"),
               Contains("platform.coordinates.sideways: not a key of the format; allowed: directions, heave"));
    CHECK_THAT(after("    directions: [[1, 0, 0], ", "    directions: ["),
               Contains("platform.coordinates.directions: 5 entries; allowed: 6"));
    CHECK_THAT(after("rotations: [roll, ", "rotations: [role, "),
               Contains("platform.coordinates.rotations[0]: 'role'; allowed: surge, sway, heave, roll, pitch, yaw"));
    CHECK_THAT(after("rotations: [roll, ", "rotations: ["),
               Contains("platform.coordinates.rotations: 2 entries; allowed: 3"));

    std::string shorter = whole;
    for (const std::string& left_out :
         {std::string("  rigid: true\n"), std::string("  spin: driven\n"),
          std::string("    rotations: [roll, pitch, yaw]\n"),
          std::string("    directions: [[1, 0, 0], [0, -1, 0], [0, 0, 1], [1, 0, 0], [0, -1, 0], [0, 0, 1]]\n")}) {
        const std::size_t at = shorter.find(left_out);
        REQUIRE(at != std::string::npos);
        shorter.erase(at, left_out.size());
    }
    const TurbineDescription d = parse_description(shorter, "machine.yaml");
    CHECK_FALSE(d.tower.rigid);
    CHECK(d.drive_train.spin == CoordinateRole::free);
    CHECK(d.platform->coordinates.directions == MovingBaseOptions().directions);
    CHECK(d.platform->coordinates.rotations == MovingBaseOptions().rotations);
}

TEST_CASE("description yaml: the record of a machine that was assembled is that machine, changes included",
          "[property]") {
    const auto recorded = [](const std::string& record) {
        const std::size_t at = record.find("cardan_turbine: 3");
        return parse_description(at == std::string::npos ? "" : record.substr(at), "record");
    };
    TurbineDescription d = wt600_description();
    d.yaw.rotation.stiffness *= 2;
    d.blade.cone += 0.01;
    const Turbine turbine = assemble(d, {.tower_elements = 1, .blade_elements = 1});
    const TurbineDescription read = recorded(turbine.rotor().description);
    CHECK(read.yaw.rotation.stiffness == d.yaw.rotation.stiffness);
    CHECK(read.blade.cone == d.blade.cone);
    CHECK(read.name == d.name);
    CHECK(test::difference(read.blade.line, d.blade.line) < 0.02);  // its sections are a function: sampled
    CHECK(recorded(isolated_blade(d).rotor().description).blade.cone == d.blade.cone);
    CHECK(recorded(isolated_tower(d).rotor().description).yaw.rotation.stiffness == d.yaw.rotation.stiffness);
    const TurbineDescription tables = read_openfast(test::data_file("openfast/small.fst")).description;
    CHECK(description_text(tables) == to_yaml(tables));
}
