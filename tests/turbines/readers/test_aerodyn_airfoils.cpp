// Unsteady airfoils from AeroDyn's files: what they say, what they leave to the program, where airfoils are steady.
#include "elements/aerodynamics/attached_flow.hpp"
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/iea22_rotor.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/aerodynamics/machine_air.hpp"
#include "turbines/readers/aerodyn.hpp"
#include "turbines/readers/openfast_file.hpp"
#include "turbines/tables/csv.hpp"

#include <cmath>
#include <cstdlib>

namespace cardan::testing::aerodyn_airfoil_tests {

namespace {

using namespace turbines;

// A cylinder, and an airfoil at three Reynolds numbers in three sections.
struct SmallModel : test::ModelFolder {
    SmallModel() : ModelFolder("aerodyn") {}
    AeroDynFile read() const { return read_aerodyn(*this / "small_AeroDyn.dat", 1); }
    // Further entries of the main file, or of the unsteady data of the second polar's first table.
    void add_to_main(const std::string& lines) const {
        replace("small_AeroDyn.dat", "====== Airfoils", lines + "====== Airfoils");
    }
    void add_to_polar(const std::string& lines) const {
        replace("small_Polar_2.dat", "9.0        alpha1", lines + "9.0        alpha1");
    }
};

// What is said of a change that is refused.
std::string message_after(const std::string& file, const std::string& from, const std::string& to) {
    return test::message_of([&] {
        const SmallModel model;
        model.replace(file, from, to);
        static_cast<void>(model.read());
    });
}

// A rotor in steady rotation in air that may lag.
struct IeaState {
    double power, thrust;
    double twist;  // of the tip, rad
};

IeaState iea_state(const Turbine& machine, const MachineAir& air, double speed) {
    const Turbine windy = air.on(machine);
    const Model& model = windy.system().model;
    const solvers::SteadyState found =
        solvers::steady_state(windy.system(), windy.rotor().spin, {.rotor_speed = speed});
    CAPTURE(found.message);
    REQUIRE(found.converged);
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, found.at.q, workspace);
    const StateView at(found.at, kin);
    const MachineAir::Rotor rotor = air.rotor(air.values(at, windy.system().forces).view());
    const CardanBeam& blade = windy.layout().blades[0];
    const Pose<double> root = pose(kin, windy.layout().blade_roots[0]), tip = pose(kin, blade.tip());
    const Mat3 turned = root.R.transpose() * tip.R * blade.line.pose(blade.line.length).R.transpose();
    return {rotor.power(), rotor.force.x(), iea22_twist(turned)};
}

}  // namespace

TEST_CASE("aerodyn airfoils: what the file says, and what it leaves to the program", "[analytic]") {
    const SmallModel model;
    AeroDynFile file = model.read();
    REQUIRE(file.airfoils.size() == file.blade.polars.size());
    CHECK(file.model.airfoils == Airfoils::steady);
    CHECK(!file.airfoils[0].is_unsteady());
    const UnsteadyAirfoil& airfoil = file.airfoils[1];
    CHECK(airfoil.polar().name() == "small_Polar_2.dat");
    AttachedFlow flow = airfoil.flow();
    CHECK(flow.zero_lift == Approx(-3.1 * units::degree));
    // The slopes of its three points near zero agree; alpha1 lies beyond the range, alpha2 is not given.
    CHECK(flow.slope == Approx(0.09 / units::degree));
    CHECK(flow.upper == Approx(9 * units::degree));
    CHECK(flow.lower == Approx(-5 * units::degree));
    CHECK(flow.zero_lift_drag == 0.01);
    const UnsteadyAirfoilConstants thin;
    CHECK(airfoil.lags().A1 == thin.A1);
    CHECK(airfoil.lags().boundary_layer == thin.boundary_layer);

    model.add_to_polar(
        "12 alphaUpper\n-8 alphaLower\n6.2 C_lalpha\n4 T_f0\n\"Default\" T_p\n0.15 b1\n0.5 b2\n.2 A1\n0.6 A2\n0.02 "
        "Cd0\n");
    file = model.read();
    flow = file.airfoils[1].flow();
    CHECK(flow.slope == 6.2);
    CHECK(flow.upper == Approx(12 * units::degree));
    CHECK(flow.lower == Approx(-8 * units::degree));
    CHECK(flow.zero_lift_drag == 0.02);
    const UnsteadyAirfoilConstants lags = file.airfoils[1].lags();
    CHECK(lags.A1 == 0.2);
    CHECK(lags.A2 == 0.6);
    CHECK(lags.b1 == 0.15);
    CHECK(lags.b2 == 0.5);
    CHECK(lags.pressure == thin.pressure);
    CHECK(lags.boundary_layer == 4);
    // All of it left to the program.
    model.replace("small_Polar_2.dat", "True       InclUAdata", "False      InclUAdata");
    file = model.read();
    flow = file.airfoils[1].flow();
    CHECK(flow.slope == Approx(0.09 / units::degree));
    CHECK(flow.zero_lift == Approx(-10.0 / 3 * units::degree));
    CHECK(flow.upper == Approx(5 * units::degree));
    CHECK(file.airfoils[1].lags().b1 == thin.b1);
    model.replace("small_Polar_2.dat", "False      InclUAdata", "");
    CHECK(model.read().airfoils[1].flow().slope == flow.slope);
}

TEST_CASE("aerodyn airfoils: data of a later table are not those of the first one", "[property]") {
    const SmallModel model;
    model.replace("small_Polar_2.dat", "-3.1       alpha0      ! deg\n", "");
    model.replace("small_Polar_2.dat", "False      InclUAdata", "True       InclUAdata\n-2         alpha0");
    CHECK(model.read().airfoils[1].flow().zero_lift == Approx(-10.0 / 3 * units::degree));
}

TEST_CASE("aerodyn airfoils: where files ask for them, and sections that stay steady", "[property]") {
    const SmallModel model;
    model.add_to_main("4 UA_Mod - four states\n");
    AeroDynFile file = model.read();
    CHECK(file.model.airfoils == Airfoils::unsteady);
    CHECK(!test::has_note(file.notes, "UA_Mod", "airfoils lag"));
    CHECK(test::has_note(file.notes, "AFTabMod", "those of the first Reynolds number"));
    CHECK(file.airfoils[1].own_states() == 4);
    model.replace("small_AeroDyn.dat", "4 UA_Mod", "6 UA_Mod");
    file = model.read();
    CHECK(!test::has_note(file.notes, "UA_Mod", "airfoils lag"));
    CHECK(file.airfoils[1].own_states() == 1);
    CHECK(file.airfoils[1].lags().boundary_layer == 3);  // AeroDyn's default, not the usual 6
    model.replace("small_AeroDyn.dat", "6 UA_Mod", "3 UA_Mod");
    file = model.read();
    CHECK(file.model.airfoils == Airfoils::unsteady);
    CHECK(test::has_note(file.notes, "UA_Mod", "as with UA_Mod = 4"));
    model.replace("small_AeroDyn.dat", "3 UA_Mod", "3 UAMod");
    CHECK(model.read().model.airfoils == Airfoils::unsteady);
    model.replace("small_AeroDyn.dat", "3 UAMod", "1 AFAeroMod - steady\n3 UAMod");
    file = model.read();
    CHECK(file.model.airfoils == Airfoils::steady);
    CHECK(!test::has_note(file.notes, "UAMod", "lag"));

    REQUIRE(file.blade.airfoil == std::vector<std::size_t>{0, 1, 1, 1});
    model.add_to_main("0.5 UAStartRad - from\n0.9 UAEndRad - to\n");
    file = model.read();
    REQUIRE(file.airfoils.size() == 3);
    REQUIRE(file.blade.polars.size() == 3);
    CHECK(file.blade.airfoil == std::vector<std::size_t>{0, 2, 1, 2});
    CHECK(file.airfoils[1].is_unsteady());
    CHECK(!file.airfoils[2].is_unsteady());
    CHECK(file.blade.polars[2].name() == file.blade.polars[1].name());
    CHECK(file.blade.polars[2].over_reynolds());
    CHECK_NOTHROW(file.blade.check());
}

TEST_CASE("aerodyn airfoils: data that do not fit their polar, and other limits, are noted", "[property]") {
    const SmallModel model;
    CHECK(!test::has_note(model.read().notes, "InclUAdata", "do not fit"));
    CHECK(!test::has_note(model.read().notes, "UACutout", ""));
    model.replace("small_Polar_2.dat", "-3.1       alpha0", "-1.1       alpha0");
    model.replace("small_Polar_2.dat", "\"DEFAULT\"  UACutout", "30         UACutout");
    const AeroDynFile file = model.read();
    // No flow gives more lift at 0 deg than the line through that zero: 0.099 of the 0.3 of the table.
    CHECK(test::has_note(file.notes, "InclUAdata", "is off by 0.201 at 0 deg"));
    CHECK(test::has_note(file.notes, "UACutout", "steady from 45 deg on"));
    const auto note = std::ranges::find(file.notes, "InclUAdata", &FileNote::keyword);
    REQUIRE(note != file.notes.end());
    CHECK(note->line == 11);
    CHECK(note->file.ends_with("small_Polar_2.dat"));
}

TEST_CASE("aerodyn airfoils: bad data are refused with file and line", "[validation]") {
    const std::string polar = "small_Polar_2.dat", alpha1 = "9.0        alpha1";
    const auto check = [](const std::string& message, std::initializer_list<std::string> parts) {
        for (const std::string& part : parts) {
            CAPTURE(message, part);
            CHECK(message.find(part) != std::string::npos);
        }
    };
    check(message_after(polar, alpha1, "190 alpha1"), {"small_Polar_2.dat:13", "alpha1 = 190; allowed: -180 ... 180"});
    check(message_after(polar, alpha1, "none alpha1"), {"small_Polar_2.dat:13", "'none' is not a finite number"});
    check(message_after(polar, alpha1, "0 T_p\n"), {"small_Polar_2.dat:13", "T_p = 0; allowed: > 0"});
    check(message_after(polar, alpha1, "-0.1 A1\n"), {"small_Polar_2.dat:13", "A1 = -0.1; allowed: >= 0"});
    check(message_after(polar, alpha1, "-1 C_lalpha\n"), {"small_Polar_2.dat:13", "C_lalpha = -1; allowed: >= 0"});
    check(message_after(polar, alpha1, "1e308 C_lalpha\n"), {"small_Polar_2.dat:17", "allowed: finite"});
    check(message_after(polar, alpha1, "-4 alphaUpper\n3 alphaLower\n"),
          {"small_Polar_2.dat:13", "alphaUpper = -4; allowed: at least alphaLower, 3"});
    check(message_after(polar, "True       InclUAdata", "Maybe      InclUAdata"),
          {"small_Polar_2.dat:11", "'Maybe' is neither True nor False"});
    check(message_after("small_AeroDyn.dat", "====== Airfoils", "1.2 UAStartRad - far\n====== Airfoils"),
          {"small_AeroDyn.dat:20", "UAStartRad = 1.2; allowed: 0 ... 1"});
}

TEST_CASE("aerodyn airfoils: a cylinder lags in nothing, whatever its file has for that", "[property]") {
    const SmallModel model;
    model.replace("small_Polar_1.dat", "False      InclUAdata  ! none\n",
                  "True InclUAdata ! zeros\n0 alpha0 ! deg\n0 C_nalpha ! 1/rad\n0 T_f0 ! -\n0 T_p ! -\n");
    CHECK_FALSE(model.read().airfoils[0].is_unsteady());
}

// Public models are not part of these sources: CARDAN_MODELS names a folder that holds their repositories. Their files
// were made by AirfoilPrep, which finds angles and slopes in its own way: alpha0 is the zero of the table, alpha1 and
// alpha2 are where f = 0.7.
TEST_CASE("aerodyn airfoils: polars of the IEA 22 MW and 3.4 MW machines against what their files say",
          "[discrete][.models]") {
    const char* const models = std::getenv("CARDAN_MODELS");
    if (models == nullptr) return;
    const std::filesystem::path folder(models);
    int compared = 0, thin = 0;
    for (const char* place : {"IEA-22-280-RWT/IEA-22-280-RWT/Airfoils", "IEA-3.4-130-RWT/Airfoils"})
        for (const auto& one : std::filesystem::directory_iterator(folder / place)) {
            const std::string name = one.path().filename().string();
            if (name.find("AeroDyn15_Polar") == std::string::npos) continue;
            OpenFastFile file = OpenFastFile::read(one.path());
            CAPTURE(name);
            Polar::Table table;
            for (const OpenFastFile::Row& row : file.rows_after("NumAlf")) {
                table.angles.push_back(row.values[0] * units::degree);
                table.lift.push_back(row.values[1]);
                table.drag.push_back(row.values[2]);
                table.moment.push_back(row.values[3]);
            }
            const Polar polar(name, {table});
            const AttachedFlow flow = attached_flow(polar);
            const double slope = file.number("C_nalpha"), zero_lift_drag = file.number("Cd0");
            if (slope == 0) {
                CHECK(flow.slope == 0);
                continue;
            }
            CHECK(flow.zero_lift * units::to_degrees == Approx(file.number("alpha0")).margin(1e-5));
            // Theirs is that at zero lift.
            if (zero_lift_drag > 0) CHECK(polar.at(flow.zero_lift).drag == Approx(zero_lift_drag).margin(1e-6));
            if (zero_lift_drag > 0) CHECK(flow.zero_lift_drag <= zero_lift_drag + 1e-6);
            ++compared;
            // What has more drag is half a cylinder, whose lift is no line.
            if (flow.zero_lift_drag > 0.05) continue;
            ++thin;
            CHECK(flow.slope == Approx(slope).epsilon(0.1));
            const UnsteadyAirfoil airfoil(polar, flow);
            // f changes by 0.08 there for 5 % of the slope, and by 0.04 within an interval of the tables.
            const double margin = 0.04 + 1.6 * std::abs(flow.slope / slope - 1);
            for (const char* stall : {"alpha1", "alpha2"})
                CHECK(airfoil.separation(file.number(stall) * units::degree).f == Approx(0.7).margin(margin));
        }
    CHECK(compared == 86);
    CHECK(thin == 76);
}

// OpenFAST ran these states with UA_Mod = 4 and loads in the plane of the rotor (BEM_Mod = 2, before that WakeMod =
// 12), where the rate of a section about the radius has no part of the rotor's speed (SetInputsForBEMT() of
// AeroDyn.f90): its airfoils are steady then. Here they see Omega sin(cone + slope) about the bent blade, and lose lift
// by it.
TEST_CASE("aerodyn airfoils: IEA 22 MW rotor with and without lags against OpenFAST", "[discrete][.models]") {
    const std::optional<Iea22Rotor> rotor = iea22_rotor();
    if (!rotor) return;
    const AeroDynFile& file = rotor->air;
    REQUIRE(file.model.airfoils == Airfoils::unsteady);
    CHECK(!test::has_note(file.notes, "InclUAdata", "do not fit"));
    const CsvTable table =
        CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/turbines/operation/iea22_steady.csv");
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        if (at("program") != 1) continue;
        AssemblyOptions options;
        options.blade_beam = iea22_blade_elements(rotor->description);
        options.spin = CoordinateRole::prescribed;
        options.pitch = at("pitch") * units::degree;
        const Turbine machine = assemble(rotor->description, options);
        const MachineAir air(machine, file.blade, {.speed = at("wind"), .density = file.density}, file.options);
        const IeaState steady = iea_state(machine, air, at("rotor_speed") * units::rpm),
                       lagging =
                           iea_state(machine, air.lagging({.airfoils = file.airfoils}), at("rotor_speed") * units::rpm);
        CAPTURE(at("wind"));
        CHECK(steady.power == Approx(at("power")).epsilon(0.01));
        CHECK(steady.thrust == Approx(at("thrust")).epsilon(0.003));
        CHECK(steady.twist * units::to_degrees == Approx(at("twist")).epsilon(0.03));
        if (at("wind") < 14) continue;
        CHECK(lagging.power < 0.995 * at("power"));
        CHECK(lagging.thrust < 0.99 * at("thrust"));
    }
}

}  // namespace cardan::testing::aerodyn_airfoil_tests
