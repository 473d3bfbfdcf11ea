// Data of a turbine that must be refused: where, what, which value, what is allowed.
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

namespace cardan::testing::bad_input {

using Catch::Matchers::Contains;
using test::message_of;

namespace {

// The data set in a folder of its own, with one piece of text replaced.
struct DataFolder {
    test::Folder folder;
    DataFolder() {
        for (const char* name : {"wt600_blade.csv", "wt600_turbine.csv"})
            std::filesystem::copy_file(std::string(CARDAN_SOURCE_DIR) + "/turbines/data/" + name, folder / name);
    }
    void replace(const char* name, const std::string& old_text, const std::string& new_text) const {
        std::string all = test::bytes_of(folder / name);
        const std::size_t at = all.find(old_text);
        REQUIRE(at != std::string::npos);
        all.replace(at, old_text.size(), new_text);
        std::ofstream(folder / name, std::ios::binary) << all;
    }
    std::string message() const {
        return message_of([&] { (void)turbines::wt600_description(folder.path); });
    }
};

// Assembles the machine with a changed description or options and checks the refusal.
template <class Change>
void check_machine_refused(Change change, std::initializer_list<std::string> parts) {
    turbines::TurbineDescription d = turbines::wt600_description();
    turbines::AssemblyOptions options = undamped();
    change(d, options);
    check_refused([&] { (void)turbines::assemble(d, options); }, parts);
}
using D = turbines::TurbineDescription;
using O = turbines::AssemblyOptions;

}  // namespace

TEST_CASE("turbine data in a folder: an unchanged copy gives the built-in machine", "[property]") {
    const DataFolder data;
    const auto copy = turbines::wt600_description(data.folder.path);
    CHECK(frequencies(turbines::assemble(copy, undamped()), 0) == frequencies(turbines::wt600(undamped()), 0));
    CHECK(copy.source == turbines::wt600_description().source);
}

TEST_CASE("turbine data in a folder: a changed value changes the machine", "[property]") {
    const DataFolder data;
    data.replace("wt600_turbine.csv", "hub_mass,kg,7500", "hub_mass,kg,8000");
    data.replace("wt600_blade.csv", "0.00,290,", "0.00,300,");
    const auto changed = turbines::wt600_description(data.folder.path);
    CHECK(changed.hub.inertia.mass == 8000);
    CHECK(changed.blade.line.section(0).mass == 300);
}

TEST_CASE("turbine data in a folder: malformed text is reported with file, line and column", "[property]") {
    {
        const DataFolder data;
        data.replace("wt600_blade.csv", "0.10,165,1.70e8", "0.10,165,1.7O e8");
        CHECK(data.message() == data.folder / "wt600_blade.csv" + ":7:10: '1.7O e8' is not a number");
    }
    {
        const DataFolder data;
        data.replace("wt600_blade.csv", "0.20,142,", "0.20,");
        CHECK_THAT(data.message(), Contains("wt600_blade.csv:8:47: 9 fields; the header has 10"));
    }
    {
        const DataFolder data;
        data.replace("wt600_turbine.csv", "gear_ratio,-,50,", "gear_ratio,-,fifty,");
        CHECK_THAT(data.message(), Contains("wt600_turbine.csv:37:14: ") && Contains("'fifty' is not a number"));
    }
}

TEST_CASE("turbine data in a folder: a missing file is reported with its path and the system's reason", "[property]") {
    const DataFolder data;
    std::filesystem::remove(data.folder / "wt600_turbine.csv");
    CHECK_THROWS_AS(turbines::wt600_description(data.folder.path), FileError);
    CHECK_THAT(data.message(), Contains(data.folder / "wt600_turbine.csv") && Contains("No such file or directory"));
}

TEST_CASE("turbine data in a folder: a missing quantity, another unit, a wrong number of values are named",
          "[property]") {
    {
        const DataFolder data;
        data.replace("wt600_turbine.csv", "overhang,", "over_hang,");
        CHECK_THAT(data.message(), Contains("wt600_turbine.csv") && Contains("'overhang'"));
    }
    {
        const DataFolder data;
        data.replace("wt600_turbine.csv", "nacelle_mass,kg,26000", "nacelle_mass,t,26");
        CHECK_THAT(data.message(), Contains("'nacelle_mass'") && Contains("unit kg expected, t found"));
    }
    {
        const DataFolder data;
        data.replace("wt600_turbine.csv", "2.5e4/1.0e5/1.0e5", "2.5e4/1.0e5");
        CHECK_THAT(data.message(), Contains("nacelle_inertia_roll_pitch_yaw") &&
                                       Contains("number of values = 2; allowed: 3, separated by /"));
    }
    {
        const DataFolder data;
        data.replace("wt600_blade.csv", "flap_stiffness[N m^2]", "flap_stiffness[N mm^2]");
        CHECK_THAT(data.message(), Contains("column 'flap_stiffness': unit N m^2 expected, N mm^2 found"));
    }
}

TEST_CASE("turbine data in a folder: impossible sections are named by station", "[property]") {
    {
        const DataFolder data;
        data.replace("wt600_blade.csv", "0.30,126,5.10e7", "0.30,126,-5.10e7");
        CHECK_THAT(data.message(), Contains("blade, station 6 (x = 6 m): EI flap [N m^2] = -51000000; allowed: > 0"));
    }
    {
        const DataFolder data;
        data.replace("wt600_blade.csv", "0.30,126,", "0.15,126,");
        CHECK_THAT(data.message(), Contains("blade: station 6 [m] = 3; allowed: finite and increasing"));
    }
    {
        const DataFolder data;
        data.replace("wt600_turbine.csv", "0.020/0.017/0.013", "0.020/1.7/0.013");
        CHECK_THAT(data.message(), Contains("tower: wall thickness [m] = 1.7; allowed: 0 ... 1.05"));
    }
}

TEST_CASE("turbine description: refused with the part named", "[property]") {
    check_machine_refused([](D& d, O&) { d.blades = -1; }, {"600 kW", "number of blades = -1", ">= 0"});
    check_machine_refused([](D& d, O&) { d.nacelle.inertia.mass = -1; }, {"nacelle", "mass", "-1"});
    check_machine_refused([](D& d, O&) { d.hub.inertia.J = Vec3(1, 1, 5).asDiagonal(); }, {"hub", "inertia"});
    check_machine_refused([](D& d, O&) { d.yaw.rotation.stiffness = -6e7; },
                          {"yaw.rotation.stiffness [N m/rad] = -60000000", "free_joint"});
    check_machine_refused([](D& d, O& o) { d.yaw.rotation.damping = -5, o.joint_damping = true; },
                          {"yaw.rotation.damping [N m s/rad] = -5"});
    check_machine_refused([](D& d, O&) { d.drive_train.main_shaft.stiffness = not_a_number; },
                          {"drive_train.main_shaft.stiffness [N m/rad] = not given", "rigid_joint"});
    check_machine_refused([](D& d, O&) { d.tower.line.length = 0; }, {"tower", "length [m] = 0"});
    check_machine_refused([](D& d, O&) { d.blade.line.section = {}; }, {"blade", "section function is missing"});
    check_machine_refused([](D& d, O& o) { d.blade.first_flap_damping = -0.1, o.structural_damping = true; },
                          {"blade.first_flap_damping = -0.1"});
    check_machine_refused([](D& d, O&) { d.nacelle.overhang = not_a_number; }, {"overhang [m] = nan", "finite"});
    check_machine_refused([](D& d, O&) { d.hub.radius = -3; }, {"hub radius [m] = -3", ">= 0"});
    check_machine_refused([](D& d, O&) { d.drive_train.gear_ratio = -50; }, {"gear ratio = -50", "> 0"});
    check_machine_refused([](D& d, O&) { d.drive_train.gearbox_inertia = -1; }, {"gearbox inertia", "-1", ">= 0"});
}

TEST_CASE("assembly options: refused with the value and what is allowed", "[property]") {
    check_machine_refused([](D&, O& o) { o.tower_elements = 0; }, {"tower", "number of elements = 0", "1 ... 1000"});
    check_machine_refused([](D&, O& o) { o.blade_elements = -3; }, {"blade", "number of elements = -3"});
    check_machine_refused([](D&, O& o) { o.delta = 0.5; }, {"tower", "delta = 0.5", "0 < delta < 0.5"});
    check_machine_refused([](D&, O& o) { o.pitch = not_a_number; }, {"600 kW", "pitch [rad] = nan"});
    check_machine_refused([](D&, O& o) { o.gravity = Vec3(0, not_a_number, 0); }, {"gravity", "nan"});
}

}  // namespace cardan::testing::bad_input
