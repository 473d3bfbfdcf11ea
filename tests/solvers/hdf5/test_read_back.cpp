// Files as others read them: netCDF4, and xarray by netCDF4 and by h5netcdf.
#include "mbs/base/error.hpp"
#include "solvers/control/multi_blade_model.hpp"
#include "solvers/control/state_space.hpp"
#include "solvers/hdf5/campbell.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5/history.hpp"
#include "solvers/hdf5_models/state_space.hpp"
#include "tests/solvers/signals/history_rows.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/read_back.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;
using namespace cardan::test;
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

}  // namespace

TEST_CASE("read back: netCDF4 and xarray find texts and numbers as they were written", "[peers]") {
    if (!ReadBack::possible()) return;
    const Folder folder;
    const std::vector<std::string> table{"first", "", "G\xC3\xA4ngigkeit", " b", "\xE2\x82\xAC", "a longer one"};
    ReadBack expected;
    {
        Hdf5File file = Hdf5File::create(folder / "a.h5");
        file.write("mode", std::vector<int>{0, 1, 2}, {3}, {"1", "mode"});
        file.write("side", std::vector<int>{0, 1}, {2}, {"1", "side"});
        file.make_dimension("mode");
        file.make_dimension("side");
        file.write("g/table", table, {3, 2}, "table");
        file.attach("g/table", 0, "mode");
        file.attach("g/table", 1, "side");
        file.write("one", std::vector<std::string>{"text\nof two lines"}, {}, "one text", {{"note", "\xC2\xB5"}});
        file.write("g/x", std::vector<double>{1, 2.5, -1e-300}, {3}, {"m", "x"});
        file.attach("g/x", 0, "mode");
        file.finish();
    }
    expected.texts("/g/table", table);
    expected.texts("/one", {"text\nof two lines"});
    expected.texts("/one@note", {"\xC2\xB5"});
    expected.numbers("/g/x", {1, 2.5, -1e-300});
    expected.texts("/g/x@units", {"m"});
    CHECK_THAT(expected.of(folder, folder / "a.h5"), StartsWith("ok: 5 variables and attributes in 2 groups"));
    expected.texts("/one@units", {"not there"});
    CHECK_THAT(expected.of(folder, folder / "a.h5"), StartsWith("wrong: "));
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
    for (std::size_t c = 0; c < 2; ++c) {
        std::vector<double> values;
        for (std::size_t row = 0; row < rows; ++row) values.push_back(value_of(c, row));
        expected.numbers(text("/channel ", c), values);
        expected.texts(text("/channel ", c, "@long_name"), {text("number ", c)});
        expected.texts(text("/channel ", c, "@frame"), {"none"});
    }
    expected.texts("/run/input_description", {about.description});
    expected.numbers("/run/checkpoint/q", {rows - 1, rows - 1});
    CHECK_THAT(expected.of(folder, folder / "a.h5"), StartsWith("ok: "));
}

TEST_CASE("read back: Campbell diagrams and linear models", "[peers][slow]") {
    if (!ReadBack::possible()) return;
    const Folder folder;
    const SmallRotor rotor = small_rotor({.damping = 4, .elastic_support = true});
    ReadBack of_diagram;
    {
        const Campbell d = campbell(rotor.system, rotor.map, std::vector<double>{4, 5, 6});
        write_hdf5(d, folder / "c.h5");
        std::vector<std::string> names, mostly;
        std::vector<double> natural;
        for (const Branch& b : d.branches) names.push_back(b.name);
        for (std::size_t i = 0; i < d.points.size(); ++i)
            for (const Branch& b : d.branches) {
                mostly.push_back(b.mostly[i]);
                natural.push_back(d.natural_hz(b, i));
            }
        of_diagram.numbers("/rotor_speed", d.rotor_speeds());
        of_diagram.texts("/branches/name", names);
        of_diagram.texts("/branches/mostly", mostly);
        of_diagram.numbers("/branches/natural_frequency", natural);
    }
    CHECK_THAT(of_diagram.of(folder, folder / "c.h5"), StartsWith("ok: "));

    const LinearModel model = state_space(
        rotor.system, rotor.map, rotor.spinning(6),
        {LinearInput::moment("nacelle moment", rotor.map.hub, Vec3::UnitX(), WrenchAxes::base)}, {}, {.azimuths = 4});
    write_hdf5(model, {{"multi_blade", multi_blade(model, rotor.map)}}, folder / "m.h5");
    ReadBack of_model;
    of_model.texts("/states/name", names_of(model.states));
    of_model.texts("/inputs/name", names_of(model.inputs));
    of_model.texts("/inputs/units", {"N m"});
    std::vector<double> A;
    for (const LinearSample& sample : model.samples)
        for (Eigen::Index i = 0; i < sample.A.rows(); ++i)
            for (Eigen::Index j = 0; j < sample.A.cols(); ++j) A.push_back(sample.A(i, j));
    of_model.numbers("/A", A);
    CHECK_THAT(of_model.of(folder, folder / "m.h5"), StartsWith("ok: "));
}
