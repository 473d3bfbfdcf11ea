// The NREL 5 MW machine on the OC3-Hywind spar beside published figures.
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/linearise.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/floating.hpp"
#include "turbines/reference_turbines/oc3_hywind.hpp"

using namespace cardan;
using namespace cardan::testing;
using namespace cardan::turbines;

TEST_CASE("OC3-Hywind: hull, masses and buoyancy are those published", "[published][discrete]") {
    const PlatformDescription spar = oc3_hywind();
    // HydroDyn's input file: displaced volume 8029.21 m^3 of the hull with these diameters; strip theory takes 0.969954
    // times its mass along.
    const std::vector<HullStation> hull{{0, 6.5}, {4, 6.5}, {12, 9.4}, {120, 9.4}};
    CHECK(displaced_volume(hull) == Approx(8029.21).epsilon(1e-5));
    CHECK(spar.added_mass(0, 0) == Approx(0.969954 * 1025 * 8029.21).epsilon(1e-5));
    CHECK(spar.buoyancy == Approx(1025 * units::standard_gravity * 8029.21).epsilon(1e-6));
    // ElastoDyn's summary: tower 249718.003 kg, everything 8065437.845 kg (its blades have 70 kg less than the integral
    // of the table); the report, by RAFT: mass centre 77.97 m below the water (the parts as published give 78.00 m).
    const Turbine turbine = nrel5mw_on_oc3_hywind(CoordinateRole::free, Nrel5mwVariant::fast, 4, 4);
    double tower = 0;
    for (const Tree::Piece& piece : turbine.tree().pieces())
        if (piece.part == "tower") tower += piece.inertia.mass;
    CHECK(tower == Approx(249718.003).epsilon(1e-6));
    const RigidWhole whole(turbine);
    CHECK(whole.mass == Approx(8065437.845).epsilon(5e-5));
    CHECK(whole.first.z() / whole.mass == Approx(-77.97).margin(0.05));
    // Buoyancy less the pull of the lines carries the weight (to 1e-4: 4 kN or 1 cm of heave).
    CHECK(spar.buoyancy + spar.mooring_preload.z() == Approx(units::standard_gravity * whole.mass).epsilon(1e-4));
    CHECK(turbine.warnings().empty());
    CHECK(turbine.rotor().description.find("OC3-Hywind") != std::string::npos);
}

TEST_CASE("OC3-Hywind: the pitch frequency of the whole is the published one", "[published]") {
    // J. Jonkman at forums.nrel.gov (topic 2422), of the full system by eigenanalysis: 0.034 Hz, two
    // digits. His added mass is WAMIT's, ours strip theory's.
    const Turbine turbine = nrel5mw_on_oc3_hywind(CoordinateRole::free, Nrel5mwVariant::fast, 2, 4);
    const solvers::SteadyState steady = solvers::steady_state(turbine.system(), turbine.rotor().spin);
    REQUIRE(steady.converged);
    std::vector<int> rows = turbine.system().model.coordinates().free();
    std::erase(rows, turbine.rotor().spin);
    const auto modes = solvers::modes(solvers::restrict_to(solvers::linearise(turbine.system(), steady.at), rows));
    const int pitch = turbine.system().model.index(turbine.layout().platform->coordinate(BaseCoordinate::pitch));
    const auto row = std::find(rows.begin(), rows.end(), pitch) - rows.begin();
    const auto mode = std::max_element(modes.begin(), modes.begin() + 6, [&](const auto& a, const auto& b) {
        return std::abs(a.eigenvalue * a.shape(row)) < std::abs(b.eigenvalue * b.shape(row));
    });
    CAPTURE(mode->natural_hz());
    CHECK(mode->natural_hz() == Approx(0.034).margin(0.001));
}

TEST_CASE("OC3-Hywind: held it is the machine on its tower without water", "[property]") {
    const Turbine held = nrel5mw_on_oc3_hywind(CoordinateRole::prescribed, Nrel5mwVariant::fast, 2, 2);
    Nrel5mwOptions data = nrel5mw_options(Nrel5mwVariant::fast);
    data.tower = Nrel5mwTower::oc3_hywind;
    AssemblyOptions options = nrel5mw_assembly(Nrel5mwVariant::fast, 2, 2);
    options.gravity = nrel5mw_gravity;
    const Turbine ground = assemble(nrel5mw_description(data), options);
    const auto frequencies = [](const Turbine& turbine) {
        const solvers::SteadyState steady = solvers::steady_state(turbine.system(), turbine.rotor().spin);
        REQUIRE(steady.converged);
        std::vector<int> rows = turbine.system().model.coordinates().free();
        std::erase(rows, turbine.rotor().spin);
        return solvers::modes(solvers::restrict_to(solvers::linearise(turbine.system(), steady.at), rows));
    };
    const auto a = frequencies(held), b = frequencies(ground);
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        CHECK(std::abs(a[i].eigenvalue - b[i].eigenvalue) < 1e-8 * std::abs(b[i].eigenvalue));
}

TEST_CASE("OC3-Hywind: tables of a folder are read, and bad ones refused with file and place", "[property]") {
    const std::filesystem::path data = std::filesystem::path(CARDAN_SOURCE_DIR) / "turbines/data";
    const PlatformDescription spar = oc3_hywind(data), built_in = oc3_hywind();
    CHECK(spar.source == built_in.source);
    CHECK(spar.added_mass == built_in.added_mass);
    CHECK_THROWS_AS(oc3_hywind(data / "nowhere"), FileError);
    Nrel5mwOptions options;
    options.tower = Nrel5mwTower::oc3_hywind;
    CHECK(nrel5mw_description(data, options).tower.line.length == Approx(77.6).epsilon(1e-12));
    CHECK_THROWS_AS(nrel5mw_description(data / "nowhere", options), FileError);
    const test::Folder folder;
    const auto written = [&](const std::string& from, const std::string& to) {
        std::string text = built_in.source;
        text.replace(text.find(from), from.size(), to);
        std::ofstream(folder / "oc3_hywind_platform.csv") << text;
        return test::message_of([&] { (void)oc3_hywind(folder.path); });
    };
    CHECK(written("platform_mass,kg", "platform_mass,t").find("platform_mass") != std::string::npos);
    CHECK(written("damping_yaw,", "damping_jaw,").find("damping_yaw") != std::string::npos);
    CHECK(written("hull_depth,m,0/4/", "hull_depth,m,4/").find("number of hull_diameter = 4") != std::string::npos);
    CHECK(written("hull_depth,m,0/4/", "hull_depth,m,0/14/").find("depth of station 3") != std::string::npos);
    CHECK(written("displaced_volume,m^3,8029.21", "displaced_volume,m^3,8031.21").find("that of the hull, 8029.2") !=
          std::string::npos);
    CHECK(written("hull_depth,m,0/4/12/120", "hull_depth,m,0/4/12/121").find("displaced_volume") != std::string::npos);
}
