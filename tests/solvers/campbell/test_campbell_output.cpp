// Files and pictures of a Campbell diagram.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "mbs/base/units.hpp"
#include "mbs/base/version.hpp"
#include "solvers/campbell_data/csv.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/pictures/campbell.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;

namespace {

const Campbell& diagram() {
    static const Campbell d = [] {
        const turbines::Turbine turbine = turbines::wt600({.tower_elements = 1, .blade_elements = 2});
        Campbell c = campbell(turbine.system(), turbine.rotor(), rpm_range(0, 20, 10));
        c.source = turbine.source();
        return c;
    }();
    return d;
}

}  // namespace

TEST_CASE("campbell: speeds may stand in the call; a branch is found by its name or not at all", "[property]") {
    const turbines::Turbine turbine = turbines::wt600({.tower_elements = 1, .blade_elements = 2});
    const Campbell d = campbell(turbine.system(), turbine.rotor(), {0.0, 10 * units::rpm});
    REQUIRE(d.rotor_speeds() == std::vector<double>{0, 10 * units::rpm});
    for (const Branch& b : d.branches) CHECK(d.find_branch(b.name) == &d.branch(b.name));
    CHECK(d.find_branch("17th blade flap") == nullptr);
    CHECK_THROWS_AS(d.branch("17th blade flap"), InputError);
}

TEST_CASE("campbell file: what is read again has the table and the CSV of what was written", "[property]") {
    const test::Folder folder;
    Campbell d = diagram();
    d.remark = "tower clamped at its foot";
    d.accuracy = "mesh: enough";
    write_hdf5(d, folder.path / "c.h5");
    const Campbell again = read_campbell(folder.path / "c.h5");
    CHECK(table(again) == table(d));
    CHECK_THAT(table(again), Catch::Contains("tower clamped at its foot\n") && Catch::Contains("mesh: enough\n"));
    CHECK(again.source == d.source);
    CHECK(again.spin == d.spin);
    write_csv(d, folder.path / "a.csv");
    write_csv(again, folder.path / "b.csv");
    CHECK(text_file(folder.path / "a.csv") == text_file(folder.path / "b.csv"));
    plot(again, folder.path / "again.svg");
    Hdf5File other = Hdf5File::create(folder.path / "other.h5");
    other.make_group("branches");
    other.finish();
    CHECK_THROWS_AS(read_campbell(folder.path / "other.h5"), FileError);
    CHECK_THROWS_AS(read_campbell(folder.path / "none.h5"), FileError);
}

TEST_CASE("campbell file: holds what the diagram holds, with names, units and dimension scales", "[property]") {
    const test::Folder folder;
    const auto path = folder.path / "c.h5";
    const Campbell& d = diagram();
    write_hdf5(d, path);
    const Hdf5File file = Hdf5File::open(path);
    CHECK(file.string_attribute("/", "machine") == d.machine);
    CHECK(file.string_attribute("/", "version") == version());
    CHECK(file.int_attribute("/", "complete") == 1);
    CHECK(file.read_strings("input_description").at(0).find("rotor_radius,m,21.5") != std::string::npos);
    CHECK(file.read_doubles("rotor_speed") == d.rotor_speeds());
    CHECK(file.string_attribute("rotor_speed", "units") == "rad s-1");
    const auto names = file.read_strings("branches/name");
    REQUIRE(names.size() == d.branches.size());
    const auto frequency = file.read_doubles("branches/natural_frequency");
    const auto eigenvalue = file.read_complex("branches/eigenvalue");
    const auto share = file.read_doubles("branches/energy_share");
    for (std::size_t i = 0; i < d.points.size(); ++i)
        for (std::size_t b = 0; b < names.size(); ++b) {
            const std::size_t at = i * names.size() + b;
            CHECK(names[b] == d.branches[b].name);
            if (d.branches[b].mode[i] < 0) continue;
            CHECK(frequency[at] == d.natural_hz(d.branches[b], i));
            CHECK(std::abs(eigenvalue[at]) == Approx(2 * pi * frequency[at]));
            double sum = 0;
            for (std::size_t c = 0; c < d.components.size(); ++c) sum += share[at * d.components.size() + c];
            CHECK(sum == Approx(1));
        }
    CHECK(file.string_attribute("branches/natural_frequency", "units") == "Hz");
    CHECK(file.dimension("branches/natural_frequency", 0) == "/branches/rotor_speed");
    CHECK(file.dimension("branches/natural_frequency", 1) == "/branches/branch");
    CHECK(file.read_doubles("branches/rotor_speed") == d.rotor_speeds());
    CHECK(file.string_attribute("branches/natural_frequency", "coordinates") == "name family pattern");
    CHECK(file.read_strings("branches/component_name").size() == d.components.size());
    CHECK(file.read_strings("branches/row_name") == d.rows);
    const auto rotation = file.read_complex("branches/frame_rotation"),
               displacement = file.read_complex("branches/frame_displacement");
    CHECK(file.shape("branches/frame_rotation_real") == Shape{d.points.size(), names.size(), d.frames.size(), 3});
    CHECK(file.string_attribute("branches/frame_displacement_imag", "units") == "m");
    const auto& motion = entry(d.motions[1], d.branches[2].mode[1])[4].motion;
    const std::size_t at = ((names.size() + 2) * d.frames.size() + 4) * 3;
    for (Eigen::Index k = 0; k < 3; ++k) {
        CHECK(entry(rotation, static_cast<Eigen::Index>(at) + k) == motion(k));
        CHECK(entry(displacement, static_cast<Eigen::Index>(at) + k) == motion(3 + k));
    }
    CHECK(file.read_strings("coordinates/name").size() == static_cast<std::size_t>(d.coordinates.size()));
    CHECK(file.read_strings("coordinates/unit").at(0) == "rad");
}

TEST_CASE("campbell table: one line per rotor speed and mode, units in the header", "[property]") {
    const test::Folder folder;
    write_csv(diagram(), folder.path / "c.csv");
    const std::string table = test::bytes_of(folder.path / "c.csv");
    CHECK(table.find("rotor_speed[rpm],mode[-],natural_frequency[Hz],damped_frequency[Hz],damping_ratio[-]") !=
          std::string::npos);
    std::size_t rows = 0;
    for (const Branch& branch : diagram().branches)
        for (int mode : branch.mode) rows += mode >= 0;
    CHECK(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')) == rows + 2);
    CHECK(table.find("\n10,1st tower fore-aft,0.7") != std::string::npos);
}

TEST_CASE("campbell pictures: axes with units, legend, nP lines and every mode by name", "[property]") {
    const test::Folder folder;
    plot(diagram(), folder.path / "c.svg");
    const std::string svg = test::bytes_of(folder.path / "c.svg");
    for (const char* expected : {"damped frequency, Hz", "rotor speed, rev/min", "damping ratio, %", ">1P<", ">3P<",
                                 "1st tower fore-aft", "rotor tilt"})
        CHECK(svg.find(expected) != std::string::npos);
    for (const Branch& branch : diagram().branches) CHECK(svg.find(branch.name) != std::string::npos);
    plot(diagram(), folder.path / "c.png");
    CHECK(test::bytes_of(folder.path / "c.png").substr(1, 3) == "PNG");

    CampbellPlotOptions tower;
    tower.families = {"tower fore-aft"};
    plot_panels(diagram(), folder.path / "p.svg", {tower, tower});
    const std::string panels = test::bytes_of(folder.path / "p.svg");
    CHECK(panels.find("1st tower fore-aft") != std::string::npos);
    CHECK(panels.find("rotor tilt") == std::string::npos);
}

TEST_CASE("mode shape pictures: drawn at standstill and in rotation; unknown points are refused", "[property]") {
    const test::Folder folder;
    const Branch& branch = diagram().branch("1st tower fore-aft");
    plot_mode(diagram(), branch, 2, folder.path / "m.svg");
    const std::string svg = test::bytes_of(folder.path / "m.svg");
    for (const char* expected : {"side view", "front view", "top view", "undeformed", "z (up), m", "20 rpm"})
        CHECK(svg.find(expected) != std::string::npos);
    Campbell without_shapes = diagram();
    without_shapes.motions.clear();
    CHECK_THROWS_AS(plot_mode(without_shapes, branch, 0, folder.path / "n.svg"), InputError);
    CHECK_THROWS_WITH(diagram().branch("3rd tail rotor"), Catch::Contains("1st tower fore-aft"));
}

TEST_CASE("campbell outputs: an unwritable path and an empty diagram are clear errors", "[property]") {
    const auto nowhere = std::filesystem::path("/no/such/folder");
    CHECK_THROWS_AS(write_hdf5(diagram(), nowhere / "c.h5"), FileError);
    CHECK_THROWS_AS(write_csv(diagram(), nowhere / "c.csv"), FileError);
    CHECK_THROWS_AS(plot(diagram(), nowhere / "c.svg"), FileError);
    const test::Folder folder;
    CHECK_THROWS_AS(plot(Campbell{}, folder.path / "c.svg"), InputError);
    CHECK_THROWS_WITH(plot(diagram(), folder.path / "c.bmp"), Catch::Contains(".svg"));
}

TEST_CASE("campbell outputs: a full disk leaves no file that poses as complete", "[property]") {
    const test::Folder folder;
    {
        const test::SizeLimit full(4096);
        CHECK_THROWS_AS(write_hdf5(diagram(), folder.path / "c.h5"), FileError);
        CHECK_THROWS_AS(write_csv(diagram(), folder.path / "c.csv"), FileError);
    }
    CHECK_FALSE(std::filesystem::exists(folder.path / "c.h5"));
    CHECK_FALSE(std::filesystem::exists(folder.path / "c.csv"));
}
