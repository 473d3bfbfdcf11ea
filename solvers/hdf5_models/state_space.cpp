#include "solvers/hdf5_models/state_space.hpp"

#include "mbs/base/version.hpp"
#include "solvers/hdf5/file.hpp"

#include <string>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

void append(std::vector<double>& values, const Matrix& A) {
    for (Index i = 0; i < A.rows(); ++i)
        for (Index j = 0; j < A.cols(); ++j) values.push_back(A(i, j));
}

std::size_t count(Index n) {
    return static_cast<std::size_t>(n);
}

// The axis, "state" for the group "states", lies beside the group.
void write_signals(Hdf5File& file, const std::string& group, const std::vector<Signal>& signals, const char* what) {
    const std::string axis = group.substr(0, group.size() - 1);
    file.make_index(axis, signals.size(), "index of the " + std::string(what));
    const auto column = [&](const char* name, std::string Signal::*field, const std::string& long_name) {
        std::vector<std::string> values;
        values.reserve(signals.size());
        for (const Signal& signal : signals) values.push_back(signal.*field);
        file.write(group + "/" + name, values, {values.size()}, long_name);
        file.attach(group + "/" + name, 0, axis);
    };
    const std::string of = std::string(" of the ") + what;
    column("name", &Signal::name, "name" + of);
    column("units", &Signal::units, "units" + of);
    column("long_name", &Signal::long_name, "description" + of);
    column("alias", &Signal::alias, "name in OpenFAST, if any," + of);
    std::vector<int> blade;
    blade.reserve(signals.size());
    for (const Signal& signal : signals) blade.push_back(signal.blade);
    file.write(group + "/blade", blade, {blade.size()}, {"1", "blade number, 0: none," + of});
    file.attach(group + "/blade", 0, axis);
}

void write_all_signals(Hdf5File& file, const std::string& group, const std::vector<Signal>& states,
                       const std::vector<Signal>& inputs, const std::vector<Signal>& outputs) {
    write_signals(file, group + "states", states, "states, columns of A and C");
    write_signals(file, group + "inputs", inputs, "inputs, columns of B and D");
    write_signals(file, group + "outputs", outputs, "outputs, rows of C and D");
    file.make_index(group + "derivative", states.size(), "index of the derivatives of the states, rows of A and B");
}

constexpr const char* mixed = "SI, by row and column";

struct NamedMatrix {
    const char* name;
    Matrix StateMatrices::*matrix;
    const char *rows, *columns;  // axes
};
constexpr NamedMatrix matrices[] = {{"A", &StateMatrices::A, "derivative", "state"},
                                    {"B", &StateMatrices::B, "derivative", "input"},
                                    {"C", &StateMatrices::C, "output", "state"},
                                    {"D", &StateMatrices::D, "output", "input"}};

template <class Items>
void write_stack(Hdf5File& file, const std::string& group, const Items& items, const char* axis,
                 const std::string& long_name) {
    for (const NamedMatrix& m : matrices) {
        std::vector<double> values;
        for (const auto& item : items) append(values, item.*m.matrix);
        const Matrix& first = items.front().*m.matrix;
        const std::string name = group + m.name;
        file.write(name, values, {items.size(), count(first.rows()), count(first.cols())}, {mixed, m.name + long_name});
        file.attach(name, 0, axis);
        file.attach(name, 1, m.rows);
        file.attach(name, 2, m.columns);
    }
}

void write_constant(Hdf5File& file, const NamedModel& named) {
    const ConstantModel& model = named.model;
    const std::string group = named.name + "/";
    file.make_group(named.name, {{"machine", model.machine}, {"rotor_speed", model.rotor_speed}});
    write_all_signals(file, group, model.states, model.inputs, model.outputs);
    for (const NamedMatrix& m : matrices) {
        std::vector<double> values;
        const Matrix& A = model.*m.matrix;
        append(values, A);
        file.write(group + m.name, values, {count(A.rows()), count(A.cols())},
                   {mixed, std::string(m.name) + " of x' = A x + B u, y = C x + D u"});
        file.attach(group + m.name, 0, group + m.rows);
        file.attach(group + m.name, 1, group + m.columns);
    }
}

void write_operating_point(Hdf5File& file, const LinearModel& model) {
    const auto rows = [&](const char* name, Vector LinearSample::*field, const char* axis, const char* long_name) {
        std::vector<double> values;
        for (const LinearSample& sample : model.samples) append(values, (sample.*field).transpose());
        const std::string path = std::string("operating_point/") + name;
        file.write(path, values, {model.samples.size(), count((model.samples[0].*field).size())},
                   {"SI, by column", long_name});
        file.attach(path, 0, "azimuth");
        file.attach(path, 1, axis);
    };
    rows("x", &LinearSample::x, "state", "states");
    rows("xdot", &LinearSample::xdot, "derivative", "derivatives of the states");
    rows("u", &LinearSample::u, "input", "inputs");
    rows("y", &LinearSample::y, "output", "outputs");
}

}  // namespace

void write_hdf5(const LinearModel& model, const std::vector<NamedModel>& constant, const std::filesystem::path& path) {
    const std::vector<StateMatrices> series = fourier_coefficients(model);
    check_names(constant, "HDF5 file",
                {"A", "B", "C", "D", "azimuth", "time", "states", "inputs", "outputs", "state", "input", "output",
                 "derivative", "term", "input_description", "operating_point", "fourier"});
    Hdf5File file = Hdf5File::create(path);
    for (auto& [name, value] : Attributes{{"title", std::string("linear model of ") + model.machine},
                                          {"machine", model.machine},
                                          {"cardan_version", std::string(version())},
                                          {"rotor_speed", model.rotor_speed},
                                          {"blades", std::int64_t{model.blades}},
                                          {"imbalance", model.imbalance}})
        file.set_attribute("/", {name, value});
    file.write("input_description", std::vector<std::string>{model.description}, {},
               "the machine as assembled, what it was read from, and the machine that was computed");
    std::vector<double> azimuth, time;
    for (const LinearSample& sample : model.samples) {
        azimuth.push_back(sample.azimuth);
        time.push_back(sample.time);
    }
    file.write("azimuth", azimuth, {azimuth.size()}, {"rad", "azimuth of blade 1"});
    file.make_dimension("azimuth");
    file.write("time", time, {time.size()}, {"s", "time at which forces were evaluated"});
    file.attach("time", 0, "azimuth");
    write_all_signals(file, "", model.states, model.inputs, model.outputs);
    const auto errors = [&](const char* name, const Vector& values) {
        file.write(std::string("outputs/") + name, std::vector<double>(values.begin(), values.end()),
                   {count(values.size())},
                   {"1", "estimated error of C and D over the largest difference of the output"});
        file.attach(std::string("outputs/") + name, 0, "output");
    };
    errors("error", model.output_error);
    write_stack(file, "", model.samples, "azimuth", "(azimuth) of x' = A x + B u, y = C x + D u");
    write_operating_point(file, model);
    file.make_index("term", series.size(), "of a Fourier series in the azimuth: mean, cosine 1, sine 1, cosine 2 ...");
    write_stack(file, "fourier/", series, "term",
                ": mean, cosine 1, sine 1, cosine 2 ... of its Fourier series in the azimuth");
    for (const NamedModel& named : constant) write_constant(file, named);
    file.finish();
}

}  // namespace cardan::solvers
