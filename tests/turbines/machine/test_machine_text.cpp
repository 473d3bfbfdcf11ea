// A whole machine as our own YAML: written and read again it computes the same, bit for bit.
//
// Reference: the machine that was written. What is compared is not the text alone, which a field that is forgotten on
// both sides would not change, but what the kernels make of it: forces of the air, separation points, operating points.
#include "elements/aerodynamics/rigid_rotor.hpp"
#include "elements/wind/iec_wind.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/machine/built_in.hpp"
#include "turbines/machine/machine_text.hpp"
#include "turbines/machine/read_machine.hpp"
#include "turbines/machine/result.hpp"
#include "turbines/machine/wind_text.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/readers/wind_box_file.hpp"

#include <filesystem>
#include <fstream>

namespace cardan::testing::machine_text_tests {

namespace {

using namespace turbines;
using Catch::Matchers::Contains;
using test::message_of;

// small.fst with the air of small_AeroDyn.dat, which has a tower, a nacelle and unsteady data here.
struct Model {
    test::ModelFolder folder{"openfast"};
    Model() {
        for (const auto& entry : std::filesystem::directory_iterator(test::data_file("aerodyn")))
            std::filesystem::copy_file(entry.path(), folder / entry.path().filename().string());
        folder.replace("small.fst", "\"unused\"    AeroFile", "\"small_AeroDyn.dat\"    AeroFile");
        folder.replace("small.fst", "9.80665   Gravity      - (m/s^2)",
                       "9.80665   Gravity      - (m/s^2)\n 1.19 AirDens - (kg/m^3)\n 1.6E-05 KinVisc - (m^2/s)");
        folder.replace("small_AeroDyn.dat", "1.2       AirDens", "\"default\"  AirDens");
        folder.replace("small_AeroDyn.dat", "0         TwrPotent", "2         TwrShadow\n1         TwrPotent");
        folder.replace("small_AeroDyn.dat", "False     TwrAero", "True      TwrAero");
        folder.write(
            "small_AeroDyn.dat",
            test::bytes_of(folder / "small_AeroDyn.dat") +
                "====== Nacelle =====\nTrue NacelleDrag - (flag)\n2, 4, 3 NacArea - m^2\n0.5, 1, 1.5 NacCd - 1\n"
                "-0.5, 0, 0.75 NacDragAC - m\n====== Tower =====\n2 NumTwrNds - nodes\n"
                "TwrElev TwrDiam TwrCd TwrTI\n(m) (m) (-) (-)\n0.0 1.5 0.5 0.1\n24.0 0.9 0.75 0.15\n");
    }
    std::string main() const { return folder / "small.fst"; }
};

Machine again(const Machine& machine) {
    return parse_machine(to_yaml(machine), "m.yaml");
}

void check_same_polars(const std::vector<Polar>& a, const std::vector<Polar>& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        CHECK(a[i].name() == b[i].name());
        CHECK(a[i].reynolds() == b[i].reynolds());
        for (std::size_t k = 0; k < std::min(a[i].tables(), b[i].tables()); ++k) {
            CHECK(a[i].table(k).angles == b[i].table(k).angles);
            CHECK(a[i].table(k).lift == b[i].table(k).lift);
            CHECK(a[i].table(k).drag == b[i].table(k).drag);
            CHECK(a[i].table(k).moment == b[i].table(k).moment);
        }
    }
}

// Point of separation and rates of all states somewhere in the middle of things.
void check_same_lags(const std::vector<UnsteadyAirfoil>& a, const std::vector<UnsteadyAirfoil>& b) {
    REQUIRE(a.size() == b.size());
    const AirfoilMotion motion{.attack = 0.21, .speed = 37, .rate = 0.3, .chord = 0.7};
    for (std::size_t i = 0; i < a.size(); ++i) {
        REQUIRE(a[i].is_unsteady() == b[i].is_unsteady());
        CHECK(a[i].own_states() == b[i].own_states());
        if (!a[i].is_unsteady()) continue;  // a cylinder
        CHECK(a[i].separation(0.17).f == b[i].separation(0.17).f);
        CHECK(a[i].rates(UnsteadyAirfoil::States::Constant(0.1), motion) ==
              b[i].rates(UnsteadyAirfoil::States::Constant(0.1), motion));
    }
}

void check_same_air(const Aerodynamics& a, const Aerodynamics& b) {
    const SteadyWind wind{.speed = 9, .direction = 0.1, .density = a.density};
    const auto on = [&](const Aerodynamics& air) {
        return rigid_rotor_air(air.blade, {.hub = Vec3(0, 0, 25)}, wind, 4, 0.3, 0.02, air.options);
    };
    CHECK(on(a).force == on(b).force);
    CHECK(on(a).moment == on(b).moment);
    CHECK(a.density == b.density);
    CHECK(a.blade.viscosity == b.blade.viscosity);
    CHECK(a.blade.prebend == b.blade.prebend);
    CHECK(a.blade.sweep == b.blade.sweep);
    CHECK(a.torsion_blade().sweep == b.torsion_blade().sweep);
    check_same_polars(a.blade.polars, b.blade.polars);
    check_same_lags(a.unsteady_airfoils, b.unsteady_airfoils);
    CHECK(a.support.tower.height == b.support.tower.height);
    CHECK(a.support.tower.diameter == b.support.tower.diameter);
    CHECK(a.support.tower.drag == b.support.tower.drag);
    CHECK(a.support.tower.turbulence == b.support.tower.turbulence);
    CHECK(a.support.tower.has_influence() == b.support.tower.has_influence());
    CHECK((!b.support.tower.has_influence() || a.support.tower.influence == b.support.tower.influence));
    CHECK((!b.support.tower.has_influence() || a.support.tower.shadow == b.support.tower.shadow));
    CHECK(a.support.tower.has_loads() == b.support.tower.has_loads());
    CHECK(a.support.nacelle.area == b.support.nacelle.area);
    CHECK(a.support.nacelle.drag == b.support.nacelle.drag);
    CHECK(a.support.nacelle.centre == b.support.nacelle.centre);
}

void check_same(const Machine& a, const Machine& b) {
    CHECK(to_yaml(a) == to_yaml(b));
    CHECK(dofs_of(a.description) == dofs_of(b.description));
    CHECK(a.yaw_drive.stiffness == b.yaw_drive.stiffness);
    CHECK(a.site.tower_base == b.site.tower_base);
    CHECK(a.operation.rotor_speed == b.operation.rotor_speed);
    CHECK(a.operation.pitch == b.operation.pitch);
    CHECK(a.operation.rated_power == b.operation.rated_power);
    CHECK(a.controller.generator_efficiency == b.controller.generator_efficiency);
    REQUIRE(a.air.has_value() == b.air.has_value());
    if (a.air) check_same_air(*a.air, *b.air);
}

// Power at an operating point, W, by few elements.
double power(const Machine& machine) {
    const CardanBeamOptions bending{.elements = 2, .torsion = false};
    const AssemblyOptions few{.pitch = machine.operation.pitch, .tower_beam = bending, .blade_beam = bending};
    const Turbine turbine = assemble(machine.description, few);
    const Aerodynamics& air = machine.require_air();
    WindOperation operation(machine.description, few, air.blade,
                            {.wind = still_wind(turbine, machine, air.density),
                             .air = air.options,
                             .harmonics = 1,
                             .support = support_on(turbine, machine, air.support)});
    const WindOperatingPoint point = operation.at({8, machine.operation.rotor_speed, 0.03});
    REQUIRE(point.converged);
    return point.power;
}

// What of a machine's text the reader says, one place changed.
std::string message_after(std::string changed, const std::string& old_text, const std::string& new_text) {
    const std::size_t at = changed.find(old_text);
    if (at == std::string::npos) return "no such text: " + old_text;
    changed.replace(at, old_text.size(), new_text);
    return message_of([&] { (void)parse_machine(changed, "m.yaml"); });
}

}  // namespace

TEST_CASE("machine: written as YAML and read again it is the same machine, with its air, bit for bit", "[property]") {
    SECTION("OpenFAST") {
        const Model model;
        const Machine machine = read_machine(model.main());
        REQUIRE(machine.air);
        CHECK(machine.no_air.empty());
        REQUIRE(machine.air->blade.polars.back().over_reynolds());
        CHECK(machine.air->density == 1.19);  // "default" is that of the main file
        CHECK(machine.air->support.tower.influence == TowerInfluence::potential);
        CHECK(machine.air->support.tower.shadow == TowerShadow::eames);
        CHECK(machine.air->support.nacelle.has_loads());
        check_same(machine, again(machine));
        CHECK(power(machine) == power(again(machine)));
    }
    SECTION("windIO") {
        for (const char* name : {"windio/small_v1.yaml", "windio/small_v2.yaml"}) {
            const Machine machine = read_machine(test::data_file(name));
            REQUIRE(machine.air);
            CHECK(machine.site.tower_base);
            check_same(machine, again(machine));
        }
    }
    SECTION("built in") {
        for (const BuiltInMachine& one : built_in_machines()) {
            const Machine machine = *built_in_machine(one.name);
            CHECK(machine.operation.rotor_speed > 0);
            CHECK(machine.air.has_value() == one.name.starts_with("nrel5mw"));
            check_same(machine, again(machine));
        }
        // Tables 1 of the paper, 1-1 and 5-1 of the report.
        const MachineOperation wt600 = built_in_machine("wt600")->operation;
        CHECK(wt600.rotor_speed == Approx(wt600.tip_speed_ratio * 11.86 / 21.5).epsilon(1e-12));
        CHECK(wt600.rated_power == 600e3);
        CHECK(wt600.min_speed == Approx(20 * units::rpm).epsilon(1e-12));
        const Machine nrel = *built_in_machine("nrel5mw");
        CHECK(nrel.operation.rated_power * nrel.controller.generator_efficiency == Approx(5e6).epsilon(1e-12));
        CHECK(nrel.operation.rotor_speed == Approx(nrel.description.rotor_speed).epsilon(1e-12));
    }
    SECTION("everything that a machine may have") {
        const Model model;
        Machine machine = read_machine(model.main());
        set_dofs({.generator = false, .tower_fore_aft = true, .tower_side_side = false, .blades = false},
                 machine.description);
        machine.yaw_drive = {1e6 / 3, 7};
        machine.operation.pitch_schedule = {{1, 0.1}, {1.0 / 3 + 1, -0.2}};
        machine.operation.min_pitch = {{3, 0.07}, {5.5, 0}};
        machine.operation.schedule = {{4, 2, 0.01}, {9, 4.0 / 3, 0.02}};
        machine.operation.min_speed = 0.7;
        machine.operation.tip_speed_ratio = 7.1;
        machine.controller = {"/lib/discon.so", "a b.IN", 0.01, 0.93, true};
        machine.site.tower_base = 10.0 / 3;
        machine.air->torsion_sweep.assign(machine.air->blade.sections(), -0.1);
        const Machine read = again(machine);
        check_same(machine, read);
        CHECK(read.operation.pitch_schedule.at(1).rotor_speed == 1.0 / 3 + 1);
        CHECK(read.operation.min_pitch.at(0).pitch == 0.07);
        CHECK(read.operation.schedule.at(1).rotor_speed == 4.0 / 3);
        CHECK(read.operation.min_speed == 0.7);
        CHECK(read.operation.tip_speed_ratio == 7.1);
        CHECK(read.controller.library == "/lib/discon.so");
        CHECK(read.controller.input == "a b.IN");
        CHECK(read.controller.period == 0.01);
        CHECK(read.controller.individual_pitch);
        CHECK(read.air->torsion_blade().sweep.front() == -0.1);
    }
}

TEST_CASE("machine: files of versions 1 and 2 are machines without air; of a whole one the structure can be read alone",
          "[property]") {
    const std::string seeds = std::string(CARDAN_SOURCE_DIR) + "/tests/fuzz/seeds/description/";
    for (const char* name : {"small.yaml", "variants.yaml"}) {
        const Machine machine = read_machine(seeds + name);
        CHECK_FALSE(machine.air);
        CHECK(to_yaml(machine.description) == to_yaml(read_description(seeds + name)));
        CHECK(machine.operation.rotor_speed == machine.description.rotor_speed);
    }
    const FileDofs variants = dofs_of(read_machine(seeds + "variants.yaml").description);
    CHECK_FALSE(variants.tower_fore_aft);  // tower.rigid
    CHECK_FALSE(variants.generator);       // spin: driven
    const Machine all = read_machine(seeds + "machine.yaml");
    check_same(all, again(all));
    CHECK(all.air->unsteady_airfoils.at(1).own_states() == 1);
    CHECK(all.operation.schedule.at(1).rotor_speed == 3.5);
    const Machine whole = *built_in_machine("nrel5mw");
    CHECK(to_yaml(parse_description(to_yaml(whole), "m.yaml")) == to_yaml(whole.description));
    CHECK(read_machine(std::string(CARDAN_SOURCE_DIR) + "/examples/data/own_turbine.yaml").operation.rotor_speed > 0);
}

TEST_CASE("machine: air that cannot be read keeps the structure; whoever asks for the air learns why", "[property]") {
    const Model model;
    model.folder.replace("small_Polar_1.dat", "NumAlf", "NumAlph");
    const Machine machine = read_machine(model.main());
    CHECK(to_yaml(machine.description) == to_yaml(read_openfast(model.main()).description));
    CHECK_FALSE(machine.air);
    CHECK_THAT(message_of([&] { (void)machine.require_air(); }),
               Contains("air = none: the airfoils of the model cannot be read") && Contains("small_Polar_1.dat:"));
    CHECK(again(machine).no_air == machine.no_air);
    // Another file in its place; what it calls "default" is that of the site.
    model.folder.replace("small_Polar_1.dat", "NumAlph", "NumAlf");
    CHECK(read_air(model.folder / "small_AeroDyn.dat", again(machine)).density == 1.19);
    CHECK_THAT(message_of([] { (void)read_machine("wt600").require_air(); }), Contains("the machine has no airfoils"));
}

TEST_CASE("machine: a word that is no machine, and additions to what is no model of windIO, are refused",
          "[property]") {
    CHECK_THAT(message_of([] { (void)read_machine("wt601"); }),
               Contains("machine: name = wt601; allowed: wt600, teetered, nrel5mw"));
    CHECK_THAT(message_of([] {
                   (void)read_machine("wt600", {{"a: 1\n", "more.yaml"}});
               }),
               Contains("value = more.yaml; allowed: none"));
}

TEST_CASE("machine yaml: what does not fit together is refused with file, line and what is allowed", "[property]") {
    const Model model;
    const std::string whole = to_yaml(read_machine(model.main()));
    CHECK_THAT(message_after(whole, "\nair:\n", "\nair:\n  colour: red\n"),
               Contains("air.colour: not a key of the format; allowed: airfoil_model, airfoils"));
    CHECK_THAT(message_after(whole, "    airfoil: [1, ", "    airfoil: [9, "),
               Contains("m.yaml:") && Contains("air: blade: airfoil = 9; allowed: 1 ... "));
    CHECK_THAT(message_after(whole, "    chord: [", "    chord: [1, "), Contains("m.yaml:") && Contains("air: "));
    CHECK_THAT(message_after(whole, "      1:\n", "      2:\n"), Contains("no '1'; there are: "));
    CHECK_THAT(message_after(whole, "    influence: potential", "    influence: much"),
               Contains("air.tower.influence: 'much'; allowed: none, potential, bak"));
    CHECK_THAT(
        message_after(whole, "\noperation:\n",
                      "\noperation:\n  schedule:\n    wind: [4, 4]\n    rotor_speed: [1, 2]\n    pitch: [0, 0]\n"),
        Contains("operation.schedule.wind: 4 after 4; allowed: ascending"));
    CHECK_THAT(message_after(whole, "\noperation:\n", "\noperation:\n  min_pitch:\n    wind: [4, 5]\n    pitch: [0]\n"),
               Contains("operation.min_pitch.pitch: 1 numbers; allowed: 2, one per row"));
    CHECK_THAT(message_after(whole, "cardan_turbine: 3", "cardan_turbine: 2"), Contains("not a key of the format"));
}

TEST_CASE("machine: a result's description ends with the whole machine", "[property]") {
    const Machine machine = *built_in_machine("nrel5mw");
    const Turbine turbine = assemble(machine.description, {.tower_elements = 1, .blade_elements = 1});
    const std::string about = with_machine("made by a test\n\n" + turbine.rotor().description, machine);
    const Machine read = parse_machine(machine_text(about, "a.h5"), "a.h5");
    Machine expected = machine;
    expected.description.source.clear();
    check_same(expected, read);
    CHECK(with_machine(about, machine) == about);
    CHECK_THAT(message_of([] { (void)machine_text("nothing", "a.h5"); }), Contains("a.h5: holds no machine"));
}

TEST_CASE("wind yaml: a wind over time is read again from a description, bit for bit", "[property]") {
    std::vector<SteadyWind> rows(3, SteadyWind{.reference_height = 25, .shear = Shear::power, .exponent = 1.0 / 7});
    rows[1].speed = 12.0 / 7;
    rows[2] = rows[1];
    rows[2].gust = 0.3;
    rows[2].ground = -2;
    const Wind wind({0, 1.0 / 3, 1.0 / 3}, rows);
    const std::string about = "made by a test\n\na line\n" + to_yaml(wind) + "the rest\n\nmore\n";
    const auto read = wind_of(about, "a.h5");
    REQUIRE(read);
    CHECK(read->times() == wind.times());
    for (const double t : {0.0, 0.2, 1.0 / 3, 5.0})
        for (const double z : {1.0, 30.0}) CHECK(read->at(t).at({3, 4, z}) == wind.at(t).at({3, 4, z}));
    CHECK_FALSE(wind_of("made by a test\n\nno wind\n", "a.h5"));
    std::string bad = about;
    bad.replace(bad.find("speed: ["), 8, "speed: [1, ");
    CHECK_THAT(message_of([&] { (void)wind_of(bad, "a.h5"); }), Contains("values of speed = 4; allowed: 3"));
}

TEST_CASE("wind yaml: a gust and a box in turned axes are read again, and the box is the one that was", "[property]") {
    const std::filesystem::path folder = std::filesystem::path(CARDAN_TEST_OUTPUT_DIR) / "wind_yaml",
                                elsewhere = folder / "results";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(elsewhere);
    const auto data = std::filesystem::path(CARDAN_SOURCE_DIR) / "tests/data/wind";
    for (const char* name : {"box8.bts", "native.ipt", "native.wnd"})
        std::filesystem::copy_file(data / name, folder / name);
    for (const char* name : {"box8.bts", "native.ipt"}) {
        CAPTURE(name);
        const WindBoxFile file = read_wind_box(folder / name);
        const Gust gust = iec_gust({.hub_height = 70, .rotor_diameter = 40}, iec_wind_name("ecd-:9"), 2);
        const Wind wind = Wind(file.box, file.mean).with_outside(OutsideBox::hold).with(gust).turned(0.2, 0.1).over(-3);
        const std::string about = "made by a test\n\na line\n" + to_yaml(wind) + "the rest\n\nmore\n";
        const auto same = [&](const Wind& read) {
            for (const double t : {0.0, 3.3, 9.0, 50.0})
                for (const double z : {5.0, 40.0, 71.0, 140.0})
                    if (read.at(t).at({3, 4, z}) != wind.at(t).at({3, 4, z})) return false;
            return true;
        };
        const auto read = wind_of(about, (elsewhere / "a.h5").string());
        REQUIRE(read);
        CHECK(same(*read));
        CHECK(to_yaml(*read) == to_yaml(wind));
        CHECK(*read->gust() == gust);
        // A result that has moved with its box.
        const std::filesystem::path binary = read->box()->data().origin.files.front();
        for (const std::string& used : read->box()->data().origin.files)
            std::filesystem::rename(used, elsewhere / std::filesystem::path(used).filename());
        const auto moved = wind_of(about, (elsewhere / "a.h5").string());
        REQUIRE(moved);
        CHECK(same(*moved));
        CHECK_THAT(message_of([&] { (void)wind_of(about, "b.h5"); }), Contains(binary.filename().string()));
        // Another box of the same size.
        std::fstream bytes(elsewhere / binary.filename(), std::ios::in | std::ios::out | std::ios::binary);
        bytes.seekp(-3, std::ios::end);
        bytes.put('x');
        bytes.close();
        CHECK_THAT(message_of([&] { (void)wind_of(about, (elsewhere / "a.h5").string()); }),
                   Contains("that of the wind box of the run"));
    }
    // Places beyond the end of a file are refused before they are read.
    const WindBoxFile file = read_wind_box(data / "box8.bts");
    std::string about = "made by a test\n\n" + to_yaml(Wind(file.box, file.mean));
    const std::size_t planes = about.find("planes: 16");
    REQUIRE(planes != std::string::npos);
    about.replace(planes, 10, "planes: 99");
    CHECK_THAT(message_of([&] { (void)wind_of(about, "a.h5"); }), Contains("numbers [bytes]"));
}

TEST_CASE("wind yaml: an hour at 50 Hz is read again, what does not change is one number", "[property]") {
    std::vector<double> times;
    std::vector<SteadyWind> rows;
    for (int i = 0; i <= 180'000; ++i) {
        times.push_back(0.02 * i);
        rows.push_back({.speed = 12 + std::sin(0.01 * i), .direction = 0.1 * std::cos(0.003 * i)});
    }
    const Wind wind(times, rows);
    const std::string about = "made by a test\n\n" + to_yaml(wind);
    CHECK_THAT(about, Contains("\ngust: [0]\n"));
    const auto read = wind_of(about, "a.h5");
    REQUIRE(read);
    CHECK(read->times() == wind.times());
    const auto same = [](const SteadyWind& a, const SteadyWind& b) {
        return a.speed == b.speed && a.direction == b.direction && a.gust == b.gust && a.density == b.density;
    };
    CHECK(std::ranges::equal(read->rows(), wind.rows(), same));
}

}  // namespace cardan::testing::machine_text_tests
