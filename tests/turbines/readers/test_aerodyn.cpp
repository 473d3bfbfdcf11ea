// AeroDyn's files: both generations of keywords, what is noted, what is refused.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/readers/aerodyn.hpp"

#include <fstream>

namespace cardan::testing::aerodyn_reader_tests {

namespace {

using namespace turbines;
using test::check_error;

// Two sections and two polars; the main file names its keywords as the version does.
class Model {
public:
    explicit Model(const std::string& options) {
        write("polar_1.dat",
              "! ------------ AirfoilInfo Input File ----------\n! line\n! line\nDEFAULT InterpOrd ! order\n"
              "1 NonDimArea ! area\n@\"coords.txt\" NumCoords ! file\n1 NumTabs ! tables\n! ---\n0.75 Re ! 1e6\n"
              "True InclUAdata ! data follows\n-2.0 alpha0 ! deg\n! ....\n4 NumAlf ! lines in the table\n"
              "!    Alpha      Cl      Cd        Cm\n!    (deg)      (-)     (-)       (-)\n"
              "-180.0 0.0 0.1 0.0\n-10 -0.5 0.02 0.1\n1.0D+1 1.0 0.02 -0.1\n180.00 0.0 0.1 0.0\n");
        write("polar_2.dat", "! a\n! b\n2 NumAlf\n-180 0 0.5 0\n180 0 0.5 0\n");
        write("blade.dat",
              "------- AERODYN BLADE -----\ntitle\n====== Blade Properties ===\n2 NumBlNds - nodes\n"
              "BlSpn BlCrvAC BlSwpAC BlCrvAng BlTwist BlChord BlAFID\n(m) (m) (m) (deg) (deg) (m) (-)\n"
              "0.0 0.0 0.0 0.0 12.0 3.5 2\n40.0 -1.5 0.25 0.0 0.5 1.2 1\n");
        write("main.dat",
              "------- AERODYN INPUT FILE ----\ntitle\n====== General Options =====\n" + options +
                  "1 AFTabMod - tables\n1 InCol_Alfa - a\n2 InCol_Cl - l\n3 InCol_Cd - d\n4 InCol_Cm - m\n"
                  "0 InCol_Cpmin - none\n2 NumAFfiles - files\n\"polar_1.dat\" AFNames - names\n"
                  "\"polar_2.dat\"\n====== Blades =====\nTrue UseBlCm - moments\n"
                  "\"blade.dat\" ADBlFile(1) - one\n\"blade.dat\" ADBlFile(2) - two\n"
                  "\"other.dat\" ADBlFile(3) - three\n====== Nacelle =====\n"
                  "0, 0, 0 NacCenB - m\n20, 40, 30 NacArea - m^2\n0.5, 1, 1.5 NacCd - 1\n"
                  "-2.5, 0, 1.75 NacDragAC - m\n====== Tower =====\n2 NumTwrNds - nodes\n"
                  "TwrElev TwrDiam TwrCd TwrTI TwrCb !TwrTI used only with TwrShadow=2\n"
                  "(m) (m) (-) (-) (-)\n15.0 6.5 0.5 0.1 0.0\n80.0 3.0 0.75 0.1 0.0\n====== Outputs ====\n");
    }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
    std::string text_of(const std::string& name) const { return test::bytes_of(folder_ / name); }
    void replace(const std::string& name, const std::string& from, const std::string& to) const {
        std::string text = text_of(name);
        const std::size_t at = text.find(from);
        REQUIRE(at != std::string::npos);
        write(name, text.replace(at, from.size(), to));
    }
    AeroDynFile read() const { return read_aerodyn(folder_ / "main.dat", 1.5); }
    std::string operator/(const std::string& name) const { return folder_ / name; }

private:
    test::Folder folder_;
};

// What is said of a file that is refused.
const std::string newer =
    "1 Wake_Mod - BEMT\n1 TwrPotent - tower\n0 TwrShadow - none\nTrue TwrAero - loads\n1.1 AirDens - kg/m^3\n"
    "1 BEM_Mod - model\n1 Skew_Mod - skew\nFalse SkewMomCorr - off\ndefault SkewRedistr_Mod - Pitt\n"
    "default SkewRedistrFactor - default\nTrue TipLoss - t\nFalse HubLoss - h\nTrue TanInd - a'\nFalse AIDrag - a\n"
    "True TIDrag - t\n0 DBEMT_Mod - none\n4 UA_Mod - unsteady\n";
const std::string older =
    "1 WakeMod - BEMT\n2 AFAeroMod - unsteady\n0 TwrPotent - none\nFalse TwrAero - no\ndefault AirDens - of the main "
    "file\n"
    "1 SkewMod - uncoupled\n\"default\" SkewModFactor - default\nTrue TipLoss - t\nTrue HubLoss - h\nTrue TanInd - a'\n"
    "True AIDrag - a\nFalse TIDrag - t\n3 UAMod - model\n";

}  // namespace

TEST_CASE("aerodyn: sections, polars and options of newer files", "[analytic]") {
    const Model model(newer);
    const AeroDynFile file = model.read();
    CHECK(file.density == 1.1);
    CHECK(file.options.induction);
    CHECK(file.options.skew == Skew::pitt_peters);
    CHECK(file.options.momentum.tip_loss);
    CHECK(!file.options.momentum.hub_loss);
    CHECK(!file.options.momentum.axial_drag);
    CHECK(file.options.momentum.tangential_drag);
    const AeroBlade& blade = file.blade;
    REQUIRE(blade.sections() == 2);
    CHECK(blade.position[1] == Approx(41.5));
    CHECK(blade.twist[0] == Approx(12 * units::degree));
    CHECK(blade.chord[1] == 1.2);
    CHECK(blade.prebend[1] == -1.5);
    CHECK(blade.sweep[1] == 0.25);
    CHECK(blade.airfoil == std::vector<std::size_t>{1, 0});
    CHECK(blade.polars[0].name() == "polar_1.dat");
    CHECK(blade.polars[0].at(0).lift == Approx(0.25));
    CHECK(blade.polars[0].at(10 * units::degree).moment == Approx(-0.1));
    CHECK(blade.polars[1].at(1).drag == Approx(0.5));
    CHECK_NOTHROW(blade.check());
    CHECK(file.model.wake == Wake::equilibrium);
    CHECK(file.model.wake_source == "DBEMT_Mod = 0 in main.dat");
    CHECK(file.model.airfoils == Airfoils::unsteady);
    CHECK(file.model.airfoils_source == "UA_Mod = 4 in main.dat");
    CHECK(test::has_note(file.notes, "ADBlFile(3)", "the sections of the first one"));
    CHECK(!test::has_note(file.notes, "ADBlFile(2)", "the sections of the first one"));
}

TEST_CASE("aerodyn: older files, and what is left out", "[analytic]") {
    const Model model(older);
    AeroDynFile file = model.read();
    CHECK(file.density == 1.225);
    CHECK(file.options.skew == Skew::none);
    CHECK(file.options.momentum.axial_drag);
    CHECK(!file.options.momentum.tangential_drag);
    CHECK(test::has_note(file.notes, "UAMod", "airfoils lag as with UA_Mod = 4"));
    model.replace("main.dat", "1 WakeMod", "0 WakeMod");
    model.replace("main.dat", "1 SkewMod", "2 SkewMod");
    model.replace("main.dat", "True UseBlCm", "False UseBlCm");
    file = model.read();
    CHECK(!file.options.induction);
    CHECK(file.options.skew == Skew::pitt_peters);
    CHECK(file.blade.polars[0].at(0.1).moment == 0);
}

TEST_CASE("aerodyn: models of wake and airfoils that the files ask for", "[analytic]") {
    const auto model_of = [](const std::string& text, const char* line, const std::string& other) {
        const Model model(text);
        model.replace("main.dat", line, other);
        return model.read().model;
    };
    const auto with_mode = [&](const std::string& mode) { return model_of(newer, "0 DBEMT_Mod", mode + " DBEMT_Mod"); };
    CHECK(with_mode("-1").wake == Wake::frozen);
    CHECK(with_mode("0").wake == Wake::equilibrium);
    CHECK(with_mode("2").wake == Wake::oye);
    CHECK(with_mode("2").inflow_time_constant == 0);
    for (const char* constant : {"1", "3"}) {
        const AirModel model = with_mode(std::string("4.5 tau1_const - s\n") + constant);
        CHECK(model.wake == Wake::oye);
        CHECK(model.inflow_time_constant == 4.5);
    }
    check_error([&] { with_mode("4"); }, {"main.dat", "DBEMT_Mod = 4", "-1 ... 3"});
    check_error([&] { with_mode("0 tau1_const - s\n1"); }, {"main.dat", "tau1_const = 0", "> 0"});
    // Where nothing is said of it, or it cannot be had, the defaults hold.
    const AirModel vortices = model_of(newer, "1 Wake_Mod", "3 Wake_Mod");
    CHECK(vortices.wake == Wake::oye);
    CHECK(vortices.wake_source.empty());
    CHECK(model_of(newer, "1 Wake_Mod", "0 Wake_Mod").wake == Wake::none);
    CHECK(model_of(newer, "4 UA_Mod", "0 UA_Mod").airfoils == Airfoils::steady);
    // DBEMT_Mod is of no effect beside WakeMod 1.
    CHECK(model_of(older, "1 WakeMod", "2 DBEMT_Mod - varies\n1 WakeMod").wake == Wake::equilibrium);
    CHECK(model_of(older, "1 WakeMod", "2 DBEMT_Mod - varies\n2 WakeMod").wake == Wake::oye);
    CHECK(model_of(older, "1 WakeMod", "2 WakeMod").wake == Wake::oye);
    CHECK(model_of(older, "2 AFAeroMod", "2 AFAeroMod").airfoils == Airfoils::unsteady);
    const AirModel steady = model_of(older, "2 AFAeroMod", "1 AFAeroMod");
    CHECK(steady.airfoils == Airfoils::steady);
    CHECK(steady.airfoils_source == "AFAeroMod = 1 in main.dat");
}

TEST_CASE("aerodyn: tower and nacelle", "[analytic]") {
    const Model model(newer);
    AeroDynFile file = model.read();
    const AeroTower tower = file.support.tower;
    CHECK(tower.influence == TowerInfluence::potential);
    CHECK(tower.loads);
    CHECK(tower.height == std::vector<double>{15, 80});
    CHECK(tower.diameter == std::vector<double>{6.5, 3});
    CHECK(tower.drag == std::vector<double>{0.5, 0.75});
    CHECK_NOTHROW(tower.check());
    CHECK(!file.support.nacelle.has_loads());
    for (const char* keyword : {"TwrPotent", "TwrAero", "TwrShadow", "NacelleDrag"})
        CHECK(!test::has_note(file.notes, keyword, "here"));
    model.replace("main.dat", "1 TwrPotent", "2 TwrPotent");
    model.replace("main.dat", "0 TwrShadow - none", "1 TwrShadow - Powles\nTrue NacelleDrag - loads");
    model.replace("main.dat", "True TwrAero", "False TwrAero");
    file = model.read();
    CHECK(file.support.tower.influence == TowerInfluence::bak);
    CHECK(!file.support.tower.loads);
    CHECK(file.support.nacelle.area == Vec3(20, 40, 30));
    CHECK(file.support.nacelle.drag == Vec3(0.5, 1, 1.5));
    CHECK(file.support.nacelle.centre == Vec3(-2.5, 0, 1.75));
    CHECK(file.support.tower.shadow == TowerShadow::powles);
    CHECK(file.support.tower.turbulence.empty());
    CHECK(!test::has_note(file.notes, "TwrShadow", ""));
    model.replace("main.dat", "1 TwrShadow", "2 TwrShadow");
    file = model.read();
    CHECK(file.support.tower.shadow == TowerShadow::eames);
    CHECK(file.support.tower.turbulence == std::vector<double>{0.1, 0.1});
    CHECK_NOTHROW(file.support.tower.check());
    // Where nothing is asked for there is nothing, not even a table.
    model.replace("main.dat", "2 TwrPotent", "0 TwrPotent");
    model.replace("main.dat", "2 TwrShadow", "0 TwrShadow");
    model.replace("main.dat", "2 NumTwrNds", "0 NumTwrNds");
    CHECK(model.read().support.tower.height.empty());
}

TEST_CASE("aerodyn: flags of older files for the influence of the tower", "[analytic]") {
    const Model model(older);
    CHECK(!model.read().support.tower.has_influence());
    model.replace("main.dat", "0 TwrPotent - none", "True TwrPotent - flow\nFalse TwrShadow - wake");
    model.replace("main.dat", "TwrElev TwrDiam TwrCd TwrTI TwrCb !TwrTI used only with TwrShadow=2",
                  "TwrElev TwrDiam TwrCd");
    model.replace("main.dat", "15.0 6.5 0.5 0.1 0.0\n80.0 3.0 0.75 0.1 0.0", "15.0 6.5 0.5\n80.0 3.0 0.75");
    CHECK(model.read().support.tower.influence == TowerInfluence::potential);
    CHECK(model.read().support.tower.shadow == TowerShadow::none);
    model.replace("main.dat", "True TwrPotent", "False TwrPotent");
    model.replace("main.dat", "False TwrShadow", "True TwrShadow");
    const AeroTower tower = model.read().support.tower;
    CHECK(tower.influence == TowerInfluence::none);
    CHECK(tower.shadow == TowerShadow::powles);
    CHECK(tower.drag == std::vector<double>{0.5, 0.75});
    CHECK_NOTHROW(tower.check());
    model.replace("main.dat", "True TwrShadow", "2 TwrShadow");
    check_error([&] { static_cast<void>(model.read()); }, {"main.dat", "no column 'TwrTI'", "TwrElev, TwrDiam, TwrCd"});
    model.replace("main.dat", "2 TwrShadow", "Yes TwrShadow");
    check_error([&] { static_cast<void>(model.read()); }, {"main.dat", "TwrShadow: 'Yes' is neither True nor False"});
}

TEST_CASE("aerodyn: bad files are refused with file and line", "[validation]") {
    const auto with = [](const std::string& name, const std::string& from, const std::string& to) {
        return [=] {
            const Model model(newer);
            model.replace(name, from, to);
            static_cast<void>(model.read());
        };
    };
    check_error(with("polar_1.dat", "-10 -0.5", "-190 -0.5"),
                {"polar_1.dat:17", "angle of attack = -190 deg after -180"});
    check_error(with("polar_1.dat", "180.00 0.0", "270.00 0.0"),
                {"polar_1.dat:16", "-180 ... 270; allowed: -180 ... 180, or 0 ... 360"});
    check_error(with("polar_1.dat", "4 NumAlf", "5 NumAlf"),
                {"polar_1.dat:19", "row 5 of the 5 that NumAlf announces"});
    check_error(with("polar_1.dat", "1.0D+1 1.0", "1.0D+1 x"),
                {"polar_1.dat:18", "4 numbers expected, found 1, then 'x'"});
    check_error(with("blade.dat", "1.2 1\n", "1.2 3\n"), {"blade.dat:8", "BlAFID = 3; allowed: 1 ... 2"});
    check_error(with("blade.dat", "40.0 -1.5", "-40.0 -1.5"), {"blade.dat:8", "BlSpn", "ascending"});
    check_error(with("blade.dat", "1.2 1\n", "0 1\n"), {"blade.dat:8", "BlChord = 0; allowed: > 0"});
    check_error(with("blade.dat", " 0.5 1.2 1\n", " 500 1.2 1\n"),
                {"blade.dat:8", "BlTwist = 500; allowed: -180 ... 180 degrees"});
    check_error(with("main.dat", "2 NumAFfiles", "3 NumAFfiles"), {"main.dat", "3 names of files expected, found 2"});
    check_error(with("main.dat", "polar_2.dat", "none.dat"), {"main.dat", "AFNames", "none.dat"});
    check_error(with("main.dat", "1 TwrPotent", "3 TwrPotent"), {"main.dat", "TwrPotent = 3; allowed: 0 ... 2"});
    check_error(with("main.dat", "0 TwrShadow", "3 TwrShadow"), {"main.dat", "TwrShadow = 3; allowed: 0 ... 2"});
    check_error(
        [] {
            const Model model(newer);
            model.replace("main.dat", "0 TwrShadow", "2 TwrShadow");
            model.replace("main.dat", "0.75 0.1 0.0", "0.75 10 0.0");
            static_cast<void>(model.read());
        },
        {"main.dat", "TwrTI = 10; allowed with TwrShadow = 2: more than 0, less than 1"});
    check_error(with("main.dat", "80.0 3.0 0.75", "8.0 3.0 0.75"), {"main.dat", "TwrElev; allowed: ascending"});
    check_error(with("main.dat", "80.0 3.0 0.75", "80.0 0 0.75"), {"main.dat", "TwrDiam = 0; allowed: > 0"});
    check_error(with("main.dat", "80.0 3.0 0.75", "80.0 3.0 -1"), {"main.dat", "TwrCd = -1; allowed: >= 0"});
    check_error(with("main.dat", "2 NumTwrNds", "1 NumTwrNds"), {"main.dat", "NumTwrNds = 1; allowed: 2 ..."});
    check_error(
        [] {
            const Model model(newer);
            model.replace("main.dat", "0 TwrShadow - none", "True NacelleDrag - loads");
            model.replace("main.dat", "20, 40, 30", "20, -40, 30");
            static_cast<void>(model.read());
        },
        {"main.dat", "air on the nacelle: area [m^2] = -40"});
    check_error(with("main.dat", "1.1 AirDens", "-1 AirDens"), {"AirDens = -1; allowed: > 0"});
    check_error(with("main.dat", "2 NumAFfiles - files\n", ""), {"not a file of AeroDyn 15", "NumAFfiles"});
}

TEST_CASE("aerodyn: rows of a polar behind those that are announced are told", "[property]") {
    const Model model(newer);
    CHECK(!test::has_note(model.read().notes, "NumAlf", "not read"));
    model.replace("polar_1.dat", "4 NumAlf", "3 NumAlf");
    CHECK(test::has_note(model.read().notes, "NumAlf", "rows behind so many are not read"));
}

TEST_CASE("aerodyn: sections beyond the structure of the blade are refused, where they end before it is noted",
          "[property]") {
    const Model model(newer);  // up to 40 m
    const auto read = [&](double end) { return read_aerodyn(model / "main.dat", 1.5, 1.2, 1.5e-5, end); };
    CHECK(!test::has_note(read(40.2).notes, "BlSpn", ""));
    CHECK(!test::has_note(model.read().notes, "BlSpn", ""));
    CHECK(test::has_note(read(42).notes, "BlSpn", "no air acts beyond"));
    CHECK_NOTHROW(read(39.99));
    check_error([&] { static_cast<void>(read(39)); }, {"blade.dat:8", "BlSpn = 40; allowed: up to the end", "39 m"});
}

TEST_CASE("aerodyn: polars that drive themselves, or jump at 360 deg, are noted", "[property]") {
    const Model model(newer);
    CHECK(!test::has_note(model.read().notes, "drag", ""));
    model.replace("polar_1.dat", "-10 -0.5 0.02", "-10 -0.5 -0.02");
    CHECK(test::has_note(model.read().notes, "drag", "drives itself"));
    model.write("polar_1.dat", "! a\n! b\n3 NumAlf\n0 0.3 0.01 0\n180 0 0.1 0\n360 0.4 0.01 0\n");
    CHECK(test::has_note(model.read().notes, "angles of attack", "the last row differs from that at 0 deg"));
    model.write("polar_1.dat", "! a\n! b\n3 NumAlf\n0 0.3 0.01 0\n180 0 0.1 0\n360 0.3 0.01 0\n");
    CHECK(!test::has_note(model.read().notes, "angles of attack", "differs"));
}

TEST_CASE("aerodyn: polars that do not reach around the circle keep the values of their ends, as in AeroDyn",
          "[property]") {
    const auto first = [](const std::string& rows) {
        const Model model(newer);
        model.write("polar_1.dat", "! a\n! b\n" + rows);
        const AeroDynFile file = model.read();
        return std::pair(file.blade.polars[0], test::has_note(file.notes, "angles of attack", ""));
    };
    const auto [to_20, noted] = first("3 NumAlf\n-179.9 0.1 0.2 0.3\n0 0.4 0.01 0\n20 1.4 0.2 -0.1\n");
    CHECK(noted);
    CHECK(to_20.at(10 * units::degree).lift == Approx(0.9));
    CHECK(to_20.at(20 * units::degree).lift == Approx(1.4));
    CHECK(to_20.at(3).lift == 1.4);
    CHECK(to_20.at(-pi).drag == 0.2);
    CHECK(to_20.at(-179.95 * units::degree).moment == Approx(0.3));
    // A table from 0 to 360 deg is the same as one from -180 to 180, with a row at 180 deg or without.
    const auto [whole, unsaid] =
        first("5 NumAlf\n-180 0 0.1 0\n-90 -1 1.3 0\n0 0.3 0.01 0\n90 1 1.2 -0.1\n180 0 0.1 0\n");
    CHECK(!unsaid);
    for (const char* rows : {"5 NumAlf\n0 0.3 0.01 0\n90 1 1.2 -0.1\n180 0 0.1 0\n270 -1 1.3 0\n360 0.3 0.01 0\n",
                             "4 NumAlf\n0 0.3 0.01 0\n90 1 1.2 -0.1\n180 0 0.1 0\n270 -1 1.3 0\n"}) {
        const auto [turned, said] = first(rows);
        CHECK(said);
        for (const double angle : {-3.0, -1.6, -0.7, -0.1, 0.0, 0.4, 1.57, 2.2, 3.1}) {
            if (std::string(rows)[0] == '4' && angle < 0 && angle > -pi / 2) continue;  // no row at 360 deg
            CHECK(turned.at(angle).lift == Approx(whole.at(angle).lift).margin(1e-14));
            CHECK(turned.at(angle).drag == Approx(whole.at(angle).drag));
            CHECK(turned.at(angle).moment == Approx(whole.at(angle).moment).margin(1e-14));
        }
    }
    const Polar twice = first("4 NumAlf\n-180 0 0.1 0\n0 0.3 0.01 0\n0 0.3 0.01 0\n180 0 0.1 0\n").first;
    CHECK(twice.table().angles.size() == 3);
    const auto [between, also] = first("3 NumAlf\n0 0.3 0.01 0\n90 1 1.2 0\n270 -1 1.3 0\n");
    CHECK(also);
    CHECK(between.at(pi).lift == Approx(0).margin(1e-14));
    CHECK(between.at(-pi).drag == Approx(1.25));
}

TEST_CASE("aerodyn: polars at several Reynolds numbers, or the first table of each", "[analytic]") {
    const test::ModelFolder model("aerodyn");
    const auto read = [&] { return read_aerodyn(model / "small_AeroDyn.dat", 1); };
    AeroDynFile file = read();
    CHECK(file.blade.viscosity == 1.5e-5);
    CHECK(!file.blade.polars[0].over_reynolds());
    const Polar& polar = file.blade.polars[1];
    CHECK(polar.reynolds() == std::vector<double>{0.5e6, 2e6, 8e6});
    CHECK(polar.at(0, 0.1e6).lift == Approx(0.3));
    CHECK(polar.at(0, 1e6).lift == Approx(0.35));  // the geometric mean of the first two
    CHECK(polar.at(10 * units::degree, 4e6).lift == Approx((1.4 + 0.4 + 1.4 * 10 / 12) / 2));
    CHECK(polar.at(12 * units::degree, 1e8).lift == Approx(1.8));
    CHECK(!test::has_note(file.notes, "AFTabMod", ""));
    model.replace("small_AeroDyn.dat", "2         AFTabMod", "3         AFTabMod");
    file = read();
    CHECK(test::has_note(file.notes, "AFTabMod", "the first table of every polar is used here"));
    CHECK(!file.blade.polars[1].over_reynolds());
    CHECK(file.blade.polars[1].at(0, 1e6).lift == Approx(0.3));
    model.replace("small_AeroDyn.dat", "3         AFTabMod", "1         AFTabMod");
    model.replace("small_AeroDyn.dat", "1.5e-5    KinVisc", "default   KinVisc");
    CHECK(read().blade.viscosity == standard_viscosity);
    CHECK(read_aerodyn(model / "small_AeroDyn.dat", 1, 1.2, 1.7e-5).blade.viscosity == 1.7e-5);
    CHECK(!read().blade.polars[1].over_reynolds());
}

TEST_CASE("aerodyn: tables over the Reynolds number that do not fit are refused with file and line", "[validation]") {
    const auto with = [](const std::string& name, const std::string& from, const std::string& to) {
        return [=] {
            const test::ModelFolder model("aerodyn");
            model.replace(name, from, to);
            static_cast<void>(read_aerodyn(model / "small_AeroDyn.dat", 1));
        };
    };
    const std::string polar = "small_Polar_2.dat", main = "small_AeroDyn.dat";
    check_error(with(polar, "2.0        Re", "0.5        Re"),
                {"small_Polar_2.dat:24", "Re = 0.5; allowed: above 0.5"});
    check_error(with(polar, "0.5        Re", "-1         Re"), {"small_Polar_2.dat:9", "Re = -1; allowed: above 0"});
    check_error(with(polar, "8.0        Re", "8.0 9      Re"),
                {"small_Polar_2.dat:36", "one value expected before Re"});
    check_error(with(polar, "3          NumTabs", "4          NumTabs"),
                {"small_Polar_2.dat:7", "NumTabs = 4, but there are 3 lines with NumAlf"});
    check_error(with(polar, "8.0        Re          ! 1e6\n0          Ctrl", "8.0        Re\n1          Ctrl"),
                {"small_Polar_2.dat:37", "Ctrl = 1; allowed: 0, as in the first table"});
    check_error(with(polar, "  14.0     1.6", "   9.0     1.6"), {"small_Polar_2.dat:33", "9 deg after 10"});
    check_error(with(polar, "  12.0     1.8", " 190.0     1.8"), {"small_Polar_2.dat:45", "180 deg after 190"});
    check_error(with(main, "2         AFTabMod", "4         AFTabMod"),
                {"small_AeroDyn.dat:21", "AFTabMod = 4; allowed: 1, 2, 3"});
    check_error(with(main, "1.5e-5    KinVisc", "0         KinVisc"),
                {"small_AeroDyn.dat:9", "KinVisc = 0; allowed: > 0"});
}

}  // namespace cardan::testing::aerodyn_reader_tests
