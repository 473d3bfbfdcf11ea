// Files as others read them: ncdump, netCDF4, h5netcdf, and xarray by netCDF4 and by h5netcdf.
#include "mbs/base/error.hpp"
#include "solvers/campbell_data/csv.hpp"
#include "solvers/hdf5/axis.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5/history.hpp"
#include "solvers/hdf5_models/state_space.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "tests/solvers/signals/history_rows.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/read_back.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;
using namespace cardan::test;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::vector<double> time_of_rows(std::size_t rows) {
    std::vector<double> all;
    for (std::size_t row = 0; row < rows; ++row) all.push_back(time_of(row));
    return all;
}

std::vector<std::string> names_of(const std::vector<Signal>& signals) {
    std::vector<std::string> names;
    for (const Signal& signal : signals) names.push_back(signal.name);
    return names;
}

std::vector<double> entries_of(const Matrix& A) {
    std::vector<double> values;
    for (Eigen::Index i = 0; i < A.rows(); ++i)
        for (Eigen::Index j = 0; j < A.cols(); ++j) values.push_back(A(i, j));
    return values;
}

// All numbers and texts below a group, as our own reader finds them.
void expect_all(ReadBack& expected, const Hdf5File& file, const std::string& group) {
    for (const std::string& name : file.children(group.empty() ? "/" : group)) {
        const std::string path = text(group, "/", name);
        if (name.starts_with("string")) continue;  // runs along the characters of texts
        if (!file.has_attribute(path, "long_name"))
            expect_all(expected, file, path);
        else if (file.has_attribute(path, "units"))
            expected.numbers(path, file.read_doubles(path));
        else
            expected.texts(path, file.read_strings(path));
    }
}

// What all of them say of a file of ours, if they are to find in it what our own reader does.
std::string said_of(const Folder& folder, const std::string& path, ReadBack expected = ReadBack()) {
    expect_all(expected, Hdf5File::open(path), "");
    return expected.of(folder, path);
}

}  // namespace

TEST_CASE("read back: texts and numbers are found as they were written, and what is not there is not found",
          "[peers]") {
    if (!ReadBack::possible()) return;
    const Folder folder;
    const std::vector<std::string> table{"first", "", "G\xC3\xA4ngigkeit", " b", "\xE2\x82\xAC", "a longer one"};
    const Hdf5Axis mode = counting_axis("mode", 3, "mode", {text_label("name", {"p", "", "r"}, "name")}),
                   side = counting_axis("side", 2, "side");
    ReadBack expected;
    {
        Hdf5File file = Hdf5File::create(folder / "a.h5");
        write_array(file, "g/table", table, {mode, side}, "table");
        file.write("one", std::vector<std::string>{"text\nof two lines"}, {}, "one text", {{"note", "\xC2\xB5"}});
        write_array(file, "g/x", std::vector<double>{1, 2.5, -1e-300}, {mode}, {"m", "x"});
        write_array(file, "g/z", std::vector<Complex>{{1, 2}, {3, 4}, {5, 6}}, {mode}, {"m", "z"});
        file.finish();
    }
    expected.texts("/g/table", table);
    expected.texts("/one", {"text\nof two lines"});
    expected.texts("/one@note", {"\xC2\xB5"});
    expected.numbers("/g/x", {1, 2.5, -1e-300});
    expected.numbers("/g/z_imag", {2, 4, 6});
    expected.texts("/g/x@units", {"m"});
    CHECK_THAT(expected.of(folder, folder / "a.h5"),
               Contains("ok: ") && Contains("8 variables in 2 groups, 6 expectations"));
    expected.texts("/one@units", {"not there"});
    CHECK_THAT(expected.of(folder, folder / "a.h5"), StartsWith("wrong: "));
}

TEST_CASE("read back: an axis without a scale, without values, or hidden by another is noticed", "[peers]") {
    if (!ReadBack::possible()) return;
    const Folder folder;
    const std::vector<double> values{1, 2, 3};
    const auto said_if = [&](auto write) {
        Hdf5File file = Hdf5File::create(folder / "a.h5");
        write(file);
        file.finish();
        return ReadBack().of(folder, folder / "a.h5");
    };
    CHECK_THAT(said_if([&](Hdf5File& file) {
                   file.write("x", values, {3}, {"m", "x"});
               }),
               Contains("axis 0 has 0 scales") && Contains("phony"));
    CHECK_THAT(said_if([&](Hdf5File& file) {
                   file.make_index("mode", 3, "mode");
                   file.write("g/x", values, {3}, {"m", "x"});
                   file.attach("g/x", 0, "mode");
               }),
               Contains("axis mode has no values"));
    const Hdf5Axis mode = counting_axis("mode", 3, "mode"), other = counting_axis("other", 3, "other");
    CHECK_THAT(said_if([&](Hdf5File& file) {
                   write_array(file, "x", values, {mode}, {"m", "x"});
                   write_array(file, "g/mode", values, {other}, {"m", "mode"});
               }),
               Contains("g/mode: /mode, an axis above, has other values"));
}

TEST_CASE("read back: histories", "[peers]") {
    if (!ReadBack::possible()) return;
    const Folder folder;
    constexpr std::size_t rows = 40;
    {
        HistoryWriter writer = HistoryWriter::create(folder / "a.h5", some_channels(2), about, {.chunk = 16});
        append_rows(writer, 0, rows);
        writer.take_checkpoints([&] { return checkpoint_of(rows - 1); });
        writer.finish();
    }
    ReadBack expected;
    expected.texts("/@title", {about.title});
    expected.texts("/@Conventions", {"CF-1.8"});
    expected.numbers("/time", time_of_rows(rows));
    CHECK(read_history(folder / "a.h5").time == time_of_rows(rows));
    for (std::size_t c = 0; c < 2; ++c) {
        std::vector<double> values;
        for (std::size_t row = 0; row < rows; ++row) values.push_back(value_of(c, row));
        expected.numbers(text("/channel ", c), values);
        expected.texts(text("/channel ", c, "@long_name"), {text("number ", c)});
        expected.texts(text("/channel ", c, "@frame"), {"none"});
    }
    expected.texts("/run/input_description", {about.description});
    expected.numbers("/run/checkpoint/q", {rows - 1, rows - 1});
    CHECK_THAT(said_of(folder, folder / "a.h5", expected), StartsWith("ok: "));
}

TEST_CASE("read back: Campbell diagrams", "[peers][slow]") {
    if (!ReadBack::possible()) return;
    const Folder folder;
    const SmallRotor rotor = small_rotor({.damping = 4, .elastic_support = true});
    const Campbell d = campbell(rotor.system, rotor.map, std::vector<double>{4, 5, 6});
    write_hdf5(d, folder / "c.h5");
    write_csv(d, folder / "c.csv");
    std::vector<std::string> names, mostly;
    std::vector<double> natural, growth, angular;
    for (const Branch& b : d.branches) names.push_back(b.name);
    for (std::size_t i = 0; i < d.points.size(); ++i)
        for (const Branch& b : d.branches) {
            mostly.push_back(b.mostly[i]);
            natural.push_back(d.natural_hz(b, i));
            growth.push_back(d.mode(b, i)->mode.eigenvalue.real());
            angular.push_back(d.mode(b, i)->mode.eigenvalue.imag());
        }
    ReadBack expected("--campbell " + (folder / "c.csv"));
    expected.numbers("/branches/rotor_speed", d.rotor_speeds());
    expected.texts("/branches/name", names);
    expected.texts("/branches/mostly", mostly);
    expected.numbers("/branches/natural_frequency", natural);
    expected.numbers("/branches/eigenvalue_real", growth);
    expected.numbers("/branches/eigenvalue_imag", angular);
    CHECK_THAT(said_of(folder, folder / "c.h5", expected), StartsWith("ok: "));
}

TEST_CASE("read back: Campbell diagrams by Floquet theory and over a parameter", "[peers][slow]") {
    if (!ReadBack::possible()) return;
    const Folder folder;
    const SmallRotor soft = small_rotor({.stiffness = {2000, 2000}, .damping = 6, .gravity = {0, -1, 0}}),
                     stiff = small_rotor({.stiffness = {4000, 4000}, .damping = 6, .gravity = {0, -1, 0}});
    CampbellOptions options;
    options.method = CampbellMethod::floquet;
    options.spin = RotorSpin::prescribed;
    write_hdf5(campbell(soft.system, soft.map, std::vector<double>{0, 2}, options), folder / "f.h5");
    CHECK_THAT(said_of(folder, folder / "f.h5"), StartsWith("ok: "));
    const std::vector<CampbellCase> cases{{&soft.system, &soft.map, 2, 2000}, {&stiff.system, &stiff.map, 2, 4000}};
    write_hdf5(campbell(cases, "stiffness, N m/rad", options), folder / "p.h5");
    CHECK_THAT(said_of(folder, folder / "p.h5"), StartsWith("ok: "));
}

TEST_CASE("read back: linear models, with constant ones of other sizes beside the periodic one", "[peers][slow]") {
    if (!ReadBack::possible()) return;
    const Folder folder;
    const SmallRotor rotor = small_rotor({.damping = 4, .elastic_support = true});
    const LinearModel model = state_space(
        rotor.system, rotor.map, rotor.spinning(6),
        {LinearInput::moment("nacelle moment", rotor.map.hub, Vec3::UnitX(), WrenchAxes::base)}, {}, {.azimuths = 4});
    const ConstantModel whole = multi_blade(model, rotor.map);
    ConstantModel small = whole;  // the first two states
    small.states.resize(2);
    small.A = whole.A.topLeftCorner(2, 2);
    small.B = whole.B.topRows(2);
    small.C = whole.C.leftCols(2);
    write_hdf5(model, {{"multi_blade", whole}, {"small", small}}, folder / "m.h5");
    ReadBack expected;
    expected.texts("/model/states/name", names_of(model.states));
    expected.texts("/model/state_name", names_of(model.states));
    expected.texts("/model/inputs/name", names_of(model.inputs));
    expected.texts("/model/inputs/units", {"N m"});
    std::vector<double> A;
    for (const LinearSample& sample : model.samples) {
        const std::vector<double> values = entries_of(sample.A);
        A.insert(A.end(), values.begin(), values.end());
    }
    expected.numbers("/model/A", A);
    expected.numbers("/model/fourier/A_sine", entries_of(fourier_coefficients(model)[2].A));
    expected.numbers("/multi_blade/A", entries_of(whole.A));
    expected.numbers("/small/A", entries_of(small.A));
    CHECK_THAT(said_of(folder, folder / "m.h5", expected), StartsWith("ok: "));
}
