// Everything that is read and written, in a host program whose locale has decimal commas: the same numbers and bytes as
// in the C locale.
#include "mbs/model/summary.hpp"
#include "solvers/campbell_data/blade_shapes.hpp"
#include "solvers/campbell_data/csv.hpp"
#include "solvers/campbell_data/difference.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/hdf5/history.hpp"
#include "solvers/hdf5_models/state_space.hpp"
#include "solvers/linear_models/lin_file.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "solvers/matlab/state_space.hpp"
#include "solvers/mode_names/community_names.hpp"
#include "solvers/pictures/blade_shapes.hpp"
#include "solvers/pictures/campbell.hpp"
#include "solvers/pictures/history.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/host_locale.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/readers/aerodyn.hpp"
#include "turbines/readers/inflow_wind.hpp"
#include "turbines/reference_turbines/wt600.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/yaml/windio.hpp"
#include "turbines/yaml/windio_air.hpp"

#include <map>

namespace cardan::testing::host_locale_tests {

namespace {

using namespace solvers;
using namespace turbines;
using test::bytes_of;
using test::data_file;

/// What was read or written, by name; numbers in all digits.
using Results = std::map<std::string, std::string>;

template <class Numbers>
std::string listed(const Numbers& numbers) {
    std::string all;
    for (const double number : numbers) all += digits(number) + " ";
    return all;
}

std::string notes_of(const std::vector<FileNote>& notes) {
    std::string all;
    for (const FileNote& note : notes) all += to_text(note) + "\n";
    return all;
}

std::string air_of(const AeroBlade& blade, double density) {
    std::string all = listed(std::vector{density}) + listed(blade.position) + listed(blade.chord) + listed(blade.twist);
    for (const Polar& polar : blade.polars) all += listed(std::vector{polar.at(0.1).lift, polar.at(0.1).drag});
    return all;
}

// Faster than 1000 rpm, and unstable where its weight turns the support over: numbers of more than three digits, and a
// warning.
Campbell diagram(double weight) {
    Campbell d = diagram_of(
        small_rotor(
            {.stiffness = {2e7, 2e7, 2e7}, .damping = 30, .elastic_support = true, .gravity = Vec3(0, 0, -weight)}),
        {110, 220}, {.max_frequency_hz = 2000});
    d.machine = "K\xC3\xBCste \xE2\x80\xA6 1";  // a byte of the dots is a control character in ISO 8859-1
    return d;
}

History history() {
    return {"gust",
            {{"rotor speed", "rad s-1", "speed"}, {"moment", "N m", "moment"}},
            {0, 0.5, 1.5},
            {{1.25, 1.5, 1.75}, {1000.5, 2000.5, 123456.75}}};
}

void diagrams(Results& out, const test::Folder& folder) {
    const Campbell one = diagram(1e5), other = diagram(0);
    write_csv(one, folder / "c.csv");
    out["diagram, CSV"] = bytes_of(folder / "c.csv");
    out["diagram, table"] = table(one);
    out["diagram, differences"] = difference_table(one, other);
    out["diagram, names"] = community_name("2nd blade flap (backward, 2)") + community_name("platform surge");
    write_hdf5(one, folder / "c.h5");
    out["diagram, HDF5"] = bytes_of(folder / "c.h5");
    const BladeShapes shapes{"machine",
                             123.5,
                             {{"1st blade flap",
                               1234.5678,
                               false,
                               {1.5, 2000.5},
                               {Vec3T<Complex>(0.125, 0, 1), Vec3T<Complex>(0, 0.5, 1)},
                               {Vec3T<Complex>(0, 0.25, 0), Vec3T<Complex>(0.5, 0, 0)}}}};
    write_csv(std::vector{shapes}, folder / "s.csv");
    out["shapes, CSV"] = bytes_of(folder / "s.csv");
    plot(shapes, folder.path / "s.svg");
    out["shapes, picture"] = bytes_of(folder / "s.svg");
    plot(one, folder.path / "c.svg");
    out["diagram, picture"] = bytes_of(folder / "c.svg");
    const History samples = history();
    plot(samples, one_panel_each({"rotor speed", "moment"}), folder.path / "h.svg");
    out["history, picture"] = bytes_of(folder / "h.svg");
}

void linear_models(Results& out, const test::Folder& folder) {
    const SmallRotor rotor = small_rotor({.stiffness = {2e6, 2e6, 2e6}, .damping = 4, .elastic_support = true});
    StateSpaceOptions options;
    options.azimuths = 3;
    const LinearModel model = state_space(
        rotor.system, rotor.map, rotor.spinning(110.5),
        {LinearInput::moment("nacelle moment", rotor.map.hub, Vec3::UnitX(), WrenchAxes::base)}, {}, options);
    for (const auto& path : write_lin(model, folder.path / "m")) out["model, .lin"] += bytes_of(path.string());
    write_hdf5(model, {}, folder / "m.h5");
    out["model, HDF5"] = bytes_of(folder / "m.h5");
    write_mat(model, {}, folder / "m.mat");
    const std::string mat = bytes_of(folder / "m.mat");
    out["model, MATLAB"] = mat.substr(std::min<std::size_t>(128, mat.size()));  // the head has the time
}

void histories(Results& out, const test::Folder& folder) {
    const History rows = history();
    HistoryWriter writer =
        HistoryWriter::create(folder / "h.h5", rows.channels, {.title = text("from ", 1234.5, " s")});
    for (std::size_t i = 0; i < rows.time.size(); ++i)
        writer.append(rows.time[i], std::vector{rows.values[0][i], rows.values[1][i]});
    writer.finish();
    const History again = read_history(folder / "h.h5");
    out["history, HDF5"] = again.title + listed(again.time) + listed(again.values[1]) + bytes_of(folder / "h.h5");
    out["history, error"] = test::message_of([&] { (void)again["Moment 2"]; });
}

void models(Results& out) {
    const test::ModelFolder model("openfast");
    model.replace("small_ServoDyn.dat", "             0   PCMode ",
                  "\"DISCON.IN\" DLL_InFile\n             5   PCMode ");
    model.replace("small_ServoDyn.dat", "             1   VSContrl ", "             5   VSContrl ");
    model.write("DISCON.IN",
                "1 ! PS_Mode\n1.225e2 ! PC_RefSpd\n0.02 ! PC_FinePit\n60.25 ! VS_MinOMSpd\n8.125 ! VS_TSRopt\n"
                "2100000.5 ! VS_RtPwr\n95.5 ! VS_GenEff\n16.5 ! WE_BladeRadius\n20.25 ! WE_GearboxRatio\n"
                "3.5 5.5 7.5 ! PS_WindSpeeds\n0.09 0.08 0.05 ! PS_BldPitchMin\n");
    const TurbineFile file = read_openfast(model / "small.fst");
    std::vector<double> numbers{file.rotor_speed, file.pitch, file.operation.rated_power,
                                file.operation.min_rotor_speed, file.operation.tip_speed_ratio};
    for (const PitchAt& at : file.pitch_schedule) numbers.insert(numbers.end(), {at.rotor_speed, at.pitch});
    for (const PitchAtWind& at : file.operation.min_pitch) numbers.insert(numbers.end(), {at.wind, at.pitch});
    out["ROSCO"] = listed(numbers) + file.rotor_speed_source;
    const std::string yaml = to_yaml(file.description);
    out["OpenFAST"] = yaml + notes_of(file.notes);
    out["YAML"] = to_yaml(parse_description(yaml, "again"));
    out["tree"] = summary(wt600({}).tree());
    out["OpenFAST, BeamDyn"] = to_yaml(read_openfast(model / "small_BeamDyn.fst").description);
    const AeroDynFile air = read_aerodyn(data_file("aerodyn/small_AeroDyn.dat"), 1);
    out["AeroDyn"] = air_of(air.blade, air.density) + notes_of(air.notes);
    const TurbineFile windio = read_windio(data_file("windio/small_v2.yaml"));
    out["windIO"] = to_yaml(windio.description) + notes_of(windio.notes);
    const WindioAir windio_air = read_windio_air(data_file("windio/small_v2.yaml"), 1);
    out["windIO, air"] = air_of(windio_air.blade, windio_air.density) + notes_of(windio_air.notes);
}

void tables(Results& out, const test::Folder& folder) {
    const CsvTable table = CsvTable::parse("a[m],b[-]\n1.5,1000.25\n-2.5e3,3\n", "f");
    out["CSV"] = listed(table.column("a")) + listed(table.column("b"));
    out["CSV, error"] = test::message_of([] { (void)CsvTable::parse("a[m]\n1,5\n", "f"); }) +
                        test::message_of([] { (void)CsvTable::parse("a[m]\n1;5\n", "f"); });
    const std::string wind = folder / "wind.dat";
    std::ofstream(wind) << "InflowWind\ntitle\n---\n2 WindType - kind\n30.5 PropagationDir - deg\n"
                           "\"a.wnd\" Filename_Uni - name\n90.5 RefHt_Uni - m\n60.25 RefLength - m\n";
    std::ofstream(folder / "a.wnd") << "! a table\n0.0 12.5 3.5 0.25 0.125 0.2 0.5 1.5\n10.5 14.25 0 0 0 0.2 0 0\n";
    const InflowWindFile inflow = read_inflow_wind(wind);
    for (const SteadyWind& row : inflow.wind.rows())
        out["InflowWind"] += listed(std::vector{row.speed, row.direction, row.gradient, row.lateral, row.gust});
}

Results everything() {
    Results out;
    models(out);  // has a folder of its own
    const test::Folder folder;
    diagrams(out, folder);
    linear_models(out, folder);
    histories(out, folder);
    tables(out, folder);
    return out;
}

}  // namespace

TEST_CASE("host locale: everything is read and written as in the C locale", "[property]") {
    const Results in_c = everything();
    CHECK(in_c.at("ROSCO").find("122.5") == std::string::npos);  // divided by the gears
    CHECK(in_c.at("diagram, CSV").find("\n1050.4226") != std::string::npos);
    CHECK(in_c.at("diagram, table").find("warning: unstable at 1050 rpm") != std::string::npos);
    CHECK(in_c.at("CSV") == "1.5 -2500 1000.25 3 ");
    for (const char* name : {"de_DE.UTF-8", "de_DE.ISO-8859-1"}) {
        Results hosted;
        bool c_too = false;
        {
            const test::HostLocale host(name);
            hosted = everything();
            c_too = host.in_c();
        }
        CHECK(hosted.size() == in_c.size());
        for (const auto& [what, expected] : in_c) {
            CAPTURE(name, what);
            CHECK(hosted[what] == expected);
        }
        if (!c_too) WARN("no locale " << name << " here (localedef): tested with std::locale alone");
    }
}

}  // namespace cardan::testing::host_locale_tests
