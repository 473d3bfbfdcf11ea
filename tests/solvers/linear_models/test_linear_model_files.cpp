// Linear models in files and back: HDF5, MATLAB, OpenFAST's text format.
#include "mbs/base/entry.hpp"
#include "solvers/hdf5/file.hpp"
#include "solvers/hdf5_models/state_space.hpp"
#include "solvers/linear_models/lin_file.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "solvers/linear_models/state_space.hpp"
#include "solvers/matlab/state_space.hpp"
#include "tests/solvers/linear_models/lin_file.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/mat_file.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;
using cardan::test::characters;
using cardan::test::field;
using cardan::test::Folder;
using cardan::test::LinFile;
using cardan::test::numbers;
using cardan::test::read_variable;
using cardan::test::SizeLimit;

namespace {

struct Example {
    SmallRotor rotor = small_rotor({.damping = 4, .elastic_support = true});
    LinearModel model;
    std::vector<NamedModel> constant;

    Example() {
        std::vector<LinearInput> inputs{
            LinearInput::moment("nacelle moment", rotor.map.hub, Vec3::UnitX(), WrenchAxes::base)};
        ChannelGroup group;
        for (int b = 1; b <= 3; ++b) {
            inputs.push_back(LinearInput::generalised_force(text("blade ", b, " flap moment"),
                                                            {{entry(rotor.map.blades, b - 1)[0], 1.0}}));
            group.channels.push_back(
                {text("blade ", b, " acceleration"), "rad s-2", "flap", {}, {}, text("FlapAcc", b)});
        }
        group.channels.push_back({"power", "W", "a fixed-frame signal"});
        group.sample = [map = rotor.map](const DynamicView& in, double* values) {
            for (const std::vector<int>& blade : map.blades) *values++ = in.qdd(blade[0]);
            *values = in.qd(0) * 5 + in.qd(map.spin);
        };
        StateSpaceOptions options;
        options.azimuths = 4;
        model = state_space(rotor.system, rotor.map, rotor.spinning(6), inputs, {group}, options);
        model.description = "three masses\non hinges";
        constant.push_back({"multi_blade", multi_blade(model, rotor.map)});
    }
};

const Example& example() {
    static const Example made;
    return made;
}

}  // namespace

TEST_CASE("linear model files: HDF5 gives back what was written", "[property]") {
    const Example& e = example();
    const Folder folder;
    write_hdf5(e.model, e.constant, folder / "m.h5");
    const Hdf5File file = Hdf5File::open(folder / "m.h5");
    const auto n = e.model.states.size();
    REQUIRE(file.shape("model/A") == Shape{4, n, n});
    CHECK(file.dimension("model/A", 0) == "/model/azimuth");
    CHECK(file.dimension("model/A", 1) == "/model/derivative");
    CHECK(file.dimension("model/fourier/A_sine", 0) == "/model/fourier/harmonic");
    CHECK(file.dimension("multi_blade/D", 1) == "/multi_blade/input");
    CHECK(file.read_doubles("model/azimuth")[1] == pi / 2);
    CHECK(file.read_doubles("model/time").size() == 4);
    CHECK(file.double_attribute("/", "rotor_speed") == 6);
    const auto check = [&](const std::string& name, std::size_t slice, const Matrix& expected) {
        const std::vector<double> values = file.read_doubles(name);
        const auto size = static_cast<std::size_t>(expected.size());
        const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> found(
            values.data() + slice * size, expected.rows(), expected.cols());
        INFO(name);
        CHECK(found == expected);
    };
    check("model/A", 3, e.model.samples[3].A);
    check("model/B", 2, e.model.samples[2].B);
    check("model/C", 1, e.model.samples[1].C);
    check("model/D", 0, e.model.samples[0].D);
    check("model/operating_point/x", 2, e.model.samples[2].x.transpose());
    const std::vector<StateMatrices> series = fourier_coefficients(e.model);
    REQUIRE(series.size() == 3);  // four azimuths
    CHECK(file.read_ints("model/fourier/harmonic") == std::vector<std::int64_t>{1});
    check("model/fourier/A_mean", 0, series[0].A);
    check("model/fourier/B_cosine", 0, series[1].B);
    check("model/fourier/C_sine", 0, series[2].C);
    check("multi_blade/A", 0, e.constant[0].model.A);
    check("multi_blade/D", 0, e.constant[0].model.D);
    CHECK(file.read_strings("model/states/name")[0] == e.model.states[0].name);
    CHECK(file.read_strings("model/derivative_name")[0] == e.model.states[0].name);
    CHECK(file.read_strings("model/inputs/units")[0] == "N m");
    CHECK(file.read_strings("model/input_units")[0] == "N m");
    CHECK(file.read_strings("model/outputs/alias")[2] == "FlapAcc3");
    CHECK(file.read_ints("model/outputs/blade") == std::vector<std::int64_t>{1, 2, 3, 0});
    CHECK(file.read_doubles("model/outputs/error").size() == 4);
    CHECK(file.string_attribute("multi_blade/C", "coordinates") == "output_name output_units state_name state_units");
    CHECK(file.read_strings("multi_blade/inputs/name")[1] == "blade flap moment (collective)");
}

TEST_CASE("linear model files: MATLAB's format gives back what was written", "[property]") {
    const Example& e = example();
    const Folder folder;
    const std::string path = folder / "m.mat";
    write_mat(e.model, e.constant, path);
    const auto model = read_variable(path, "model"), fixed = read_variable(path, "multi_blade");
    const auto check = [](const Matrix& found, const Matrix& expected) { CHECK(found == expected); };
    check(numbers(field(model, "A"), 3), e.model.samples[3].A);
    check(numbers(field(model, "B"), 2), e.model.samples[2].B);
    check(numbers(field(model, "C"), 1), e.model.samples[1].C);
    check(numbers(field(model, "D"), 0), e.model.samples[0].D);
    check(numbers(field(model, "x_operating")).col(2), e.model.samples[2].x);
    check(numbers(field(model, "fourier_B"), 2), fourier_coefficients(e.model)[2].B);
    check(numbers(field(fixed, "A")), e.constant[0].model.A);
    CHECK(numbers(field(model, "rotor_speed"))(0, 0) == 6);
    CHECK(characters(field(model, "machine")) == "small rotor");
    matvar_t* names = Mat_VarGetStructFieldByName(fixed.get(), "input_names", 0);
    REQUIRE(names->class_type == MAT_C_CELL);
    CHECK(names->dims[0] == 4);
    CHECK(characters(Mat_VarGetCell(names, 3)) == "blade flap moment (sine 1)");
    CHECK(folder.files() == 1);
}

TEST_CASE("linear model files: OpenFAST's text format gives back what was written", "[property]") {
    const Example& e = example();
    const Folder folder;
    const auto paths = write_lin(e.model, folder / "m");
    REQUIRE(paths.size() == 4);
    CHECK(paths[1] == folder / "m.2.lin");
    LinFile file(paths[1].string());
    const LinearSample& sample = e.model.samples[1];
    CHECK(file.head.at("Rotor Speed") == 6);
    CHECK(file.head.at("Azimuth") == sample.azimuth);
    CHECK(file.head.at("Simulation time") == sample.time);
    CHECK(file.head.at("Number of continuous states") == static_cast<double>(e.model.states.size()));
    CHECK(file.head.at("Number of inputs") == 4);
    CHECK(file.head.at("Number of outputs") == 4);
    CHECK(file.matrices.at("A") == sample.A);
    CHECK(file.matrices.at("B") == sample.B);
    CHECK(file.matrices.at("C") == sample.C);
    CHECK(file.matrices.at("D") == sample.D);
    const auto& states = file.tables.at("continuous states");
    const auto& derivatives = file.tables.at("continuous state derivatives");
    const std::size_t half = states.size() / 2;
    for (Eigen::Index i = 0; i < std::ssize(states); ++i) {
        CHECK(entry(states, i).value == sample.x(i));
        CHECK(entry(derivatives, i).value == sample.xdot(i));
        CHECK(entry(states, i).order == 2);
        CHECK(entry(states, i).rotating == (entry(e.model.states, i).blade > 0 ? "T" : "F"));
    }
    CHECK(states[0].description == "Cardan tilt, rad");
    CHECK(states[half].description == "Cardan First time derivative of tilt, rad/s");
    CHECK(derivatives[0].description == "First time derivative of Cardan tilt, rad/s");
    CHECK(file.tables.at("inputs")[0].rotating == "F");
    CHECK(file.tables.at("inputs")[1].rotating == "T");
    CHECK(file.tables.at("inputs")[1].description == "Cardan blade 1 flap moment, N-m");
    CHECK(file.tables.at("outputs")[2].description == "Cardan FlapAcc3, rad/s^2");
    CHECK(file.tables.at("outputs")[3].description == "Cardan power, W");
    // Line by line, as readers that count expect it: five lines before the title of the head, matrices without gaps.
    CHECK(file.lines[0].empty());
    CHECK(file.lines[1].starts_with("Linearized model: Cardan"));
    CHECK(file.lines[3].empty());
    CHECK(file.lines[4] == "small rotor; three masses");
    CHECK(file.lines[5].empty());
    CHECK(file.lines[6] == "Simulation information:");
    CHECK(file.lines[15].starts_with("   Jacobians included in this file?"));
    CHECK(file.lines[17] == "Order of continuous states:");
}

TEST_CASE("linear model files: names in all languages survive in MATLAB's format", "[property]") {
    LinearModel model = example().model;
    const Folder folder;
    // Two, three and four bytes per character; more bytes than characters must not be read from memory.
    for (const char* words :
         {"M\u00fchle", "Gro\u00dfe M\u00fchle \u2013 5 MW: Pr\u00fcfstand", "\u98a8\u8eca \U0001f300"}) {
        model.machine = model.states[0].name = words;
        write_mat(model, {}, folder / "m.mat");
        const auto read = read_variable(folder / "m.mat", "model");
        CHECK(characters(field(read, "machine")) == words);
        matvar_t* names = Mat_VarGetStructFieldByName(read.get(), "state_names", 0);
        REQUIRE(names != nullptr);
        REQUIRE(names->class_type == MAT_C_CELL);
        REQUIRE(Mat_VarGetCell(names, 0) != nullptr);
        CHECK(characters(Mat_VarGetCell(names, 0)) == words);
        REQUIRE(Mat_VarGetCell(names, 1) != nullptr);
        CHECK(characters(Mat_VarGetCell(names, 1)) == model.states[1].name);
    }
    model.machine = "Latin-1: M\xfchle, cut off: \xe2\x80";
    write_mat(model, {}, folder / "m.mat");
    CHECK(characters(field(read_variable(folder / "m.mat", "model"), "machine")) == "Latin-1: M?hle, cut off: ??");
}

TEST_CASE("linear model files: fewer azimuths leave no files of an earlier model", "[property]") {
    LinearModel model = example().model;
    const Folder folder;
    REQUIRE(write_lin(model, folder / "m").size() == 4);
    model.samples.resize(1);
    const auto paths = write_lin(model, folder / "m");
    CHECK(paths == std::vector<std::filesystem::path>{folder / "m.1.lin"});
    CHECK(folder.files() == 1);
}

// The multi-blade transformation of second-order states as MBC3 makes it from these files:       [Bir 2008, eqs. 8-30]
// x = S z, z' = S^-1 (A S - S') z, S = [T 0; Omega T_psi T]; the mean over the azimuths.
TEST_CASE("linear model files: the text files give MBC3 the modes of the multi-blade model", "[crosscheck]") {
    const Example& e = example();
    const Folder folder;
    Matrix mean;
    const auto paths = write_lin(e.model, folder / "m");
    for (const std::filesystem::path& path : paths) {
        const LinFile file(path.string());
        const double omega = file.head.at("Rotor Speed"), psi = file.head.at("Azimuth");
        const auto& states = file.tables.at("continuous states");
        const auto half = std::ssize(states) / 2;
        // Rows in the rotating frame that differ in the number only.
        std::map<std::string, std::vector<Eigen::Index>> sets;
        for (Eigen::Index i = 0; i < half; ++i) {
            const auto& row = entry(states, i);
            if (row.rotating != "T") continue;
            std::string key = row.description;
            key.erase(key.find_first_of("123"), 1);
            sets[key].push_back(i);
        }
        CHECK(sets.size() == 1);  // flap
        Matrix T = Matrix::Identity(half, half), by_psi = Matrix::Zero(half, half), twice = by_psi;
        for (const auto& set : sets) {
            REQUIRE(set.second.size() == 3);
            for (std::size_t k = 0; k < 3; ++k) {
                const double at = psi + 2 * pi * static_cast<double>(k) / 3, c = std::cos(at), s = std::sin(at);
                const Eigen::Index row = set.second[k];
                const auto put = [&](Matrix& M, const Vec3& values) {
                    for (Eigen::Index j = 0; j < 3; ++j) M(row, entry(set.second, j)) = values(j);
                };
                put(T, {1, c, s});
                put(by_psi, {0, -s, c});
                put(twice, {0, -c, -s});
            }
        }
        Matrix S = Matrix::Zero(2 * half, 2 * half), rate = S;
        S << T, Matrix::Zero(half, half), omega * by_psi, T;
        rate << by_psi, Matrix::Zero(half, half), omega * twice, by_psi;
        const Matrix A = S.inverse() * (file.matrices.at("A") * S - omega * rate);
        mean = mean.size() == 0 ? A : Matrix(mean + A);
    }
    mean /= static_cast<double>(paths.size());
    ConstantModel fixed = e.constant[0].model;
    const std::vector<Complex> expected = fixed.poles();
    fixed.A = mean;
    const std::vector<Complex> found = fixed.poles();
    for (const Complex& pole : expected) {
        double nearest = 1e9;
        for (const Complex& other : found) nearest = std::min(nearest, std::abs(other - pole));
        CAPTURE(pole, nearest);
        CHECK(nearest < 1e-9 * fixed.A.norm());
    }
}

TEST_CASE("linear model files: a model without inputs and outputs can be written and read", "[property]") {
    const Example& e = example();
    StateSpaceOptions options;
    options.azimuths = 4;
    LinearModel bare = state_space(e.rotor.system, e.rotor.map, e.rotor.spinning(6), {}, {}, options);
    bare.machine = bare.description = "M\u00fchle";
    const std::vector<NamedModel> constant{{"fixed", multi_blade(bare, e.rotor.map)}};
    const Folder folder;
    write_hdf5(bare, constant, folder / "b.h5");
    const Hdf5File file = Hdf5File::open(folder / "b.h5");
    const std::size_t n = bare.states.size();
    CHECK(file.shape("model/B") == Shape{4, n, 0});
    CHECK(file.shape("fixed/D") == Shape{0, 0});
    CHECK_FALSE(file.has("inputs/name"));
    write_mat(bare, constant, folder / "b.mat");
    const auto model = read_variable(folder / "b.mat", "model");
    CHECK(numbers(field(model, "A"), 3) == bare.samples[3].A);
    CHECK(field(model, "C")->dims[0] == 0);
    CHECK(field(model, "input_names")->dims[0] == 0);
    const LinFile lin(write_lin(bare, folder / "b")[3].string());
    CHECK(lin.matrices.at("A") == bare.samples[3].A);
    CHECK(lin.matrices.size() == 1);
    CHECK(lin.tables.size() == 2);
    CHECK(lin.head.at("Number of inputs") == 0);
    CHECK(lin.lines[4] == bare.machine);
}

TEST_CASE("linear model files: what cannot be written is an error and leaves no file", "[property]") {
    const Example& e = example();
    const Folder folder;
    CHECK_THROWS_AS(write_lin(e.model, folder / "no/m"), FileError);
    CHECK_THROWS_AS(write_mat(e.model, e.constant, folder / "no/m.mat"), FileError);
    CHECK_THROWS_AS(write_hdf5(e.model, e.constant, folder / "no/m.h5"), FileError);
    {
        const SizeLimit limit(2000);
        CHECK_THROWS_AS(write_mat(e.model, e.constant, folder / "m.mat"), FileError);
        CHECK_THROWS_AS(write_lin(e.model, folder / "m"), FileError);
    }
    CHECK(folder.files() == 0);
    check_refused([&] { write_mat(e.model, {{"2nd", e.constant[0].model}}, folder / "m.mat"); }, {"'2nd'", "letter"});
    check_refused([&] { write_mat(e.model, {{"model", e.constant[0].model}}, folder / "m.mat"); }, {"'model'", "once"});
    for (const char* name : {"", "model", "input_description", "twice", "a/b"})
        check_refused(
            [&] {
                write_hdf5(e.model, {{"twice", e.constant[0].model}, {name, e.constant[0].model}}, folder / "m.h5");
            },
            {"HDF5 file: name of a model", name, "once"});
    check_refused([&] { (void)write_lin(LinearModel{}, folder / "m"); }, {"azimuths = 0"});
    CHECK(folder.files() == 0);
}
