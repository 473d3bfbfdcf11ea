#include "solvers/hdf5_models/state_space.hpp"

#include "mbs/base/version.hpp"
#include "solvers/hdf5/axis.hpp"
#include "solvers/hdf5/file.hpp"

#include <numeric>
#include <string>
#include <utility>

namespace cardan::solvers {

namespace {

using Index = Eigen::Index;

// Of the model at all azimuths, as the structure of that name in MATLAB's file.
constexpr const char* periodic_group = "model";

void append(std::vector<double>& values, const Matrix& A) {
    for (Index i = 0; i < A.rows(); ++i)
        for (Index j = 0; j < A.cols(); ++j) values.push_back(A(i, j));
}

template <class Field>
auto column(const std::vector<Signal>& signals, Field Signal::*field) {
    std::vector<Field> values;
    values.reserve(signals.size());
    for (const Signal& signal : signals) values.push_back(signal.*field);
    return values;
}

// Beside the matrices: who stands along the axis. "state" gets state_name and state_units.
Hdf5Axis axis_of(const std::string& name, const std::vector<Signal>& signals, const std::string& what) {
    return counting_axis(name, signals.size(), "index of the " + what,
                         {text_label(name + "_name", column(signals, &Signal::name), "name of the " + what),
                          text_label(name + "_units", column(signals, &Signal::units), "units of the " + what)});
}

constexpr const char *states_are = "states, columns of A and C", *inputs_are = "inputs, columns of B and D",
                     *outputs_are = "outputs, rows of C and D";

struct SignalAxes {
    template <class Model>
    explicit SignalAxes(const Model& model)
        : state(axis_of("state", model.states, states_are)),
          input(axis_of("input", model.inputs, inputs_are)),
          output(axis_of("output", model.outputs, outputs_are)),
          derivative(counting_axis("derivative", state.size(),
                                   "index of the derivatives of the states, rows of A and B",
                                   {text_label("derivative_name", column(model.states, &Signal::name),
                                               "name of the state whose derivative it is")})) {}
    Hdf5Axis state, input, output, derivative;
};

// With all there is to say about the signals, for a group of their own.
Hdf5Axis described(const Hdf5Axis& axis, const std::vector<Signal>& signals, const std::string& what) {
    return axis.with(
        {text_label("name", column(signals, &Signal::name), "name of the " + what),
         text_label("units", column(signals, &Signal::units), "units of the " + what),
         text_label("long_name", column(signals, &Signal::long_name), "description of the " + what),
         text_label("alias", column(signals, &Signal::alias), "name in OpenFAST, if any, of the " + what)});
}

void write_signals(Hdf5File& file, const std::string& group, const Hdf5Axis& axis, const std::vector<Signal>& signals,
                   const std::string& what) {
    const Hdf5Axis with_all = described(axis, signals, what);
    write_array(file, group + "/blade", column(signals, &Signal::blade), {with_all},
                {"1", "blade number, 0: none, of the " + what});
}

template <class Model>
void write_all_signals(Hdf5File& file, const std::string& group, const SignalAxes& axes, const Model& model) {
    write_signals(file, group + "states", axes.state, model.states, states_are);
    write_signals(file, group + "inputs", axes.input, model.inputs, inputs_are);
    write_signals(file, group + "outputs", axes.output, model.outputs, outputs_are);
}

constexpr const char* mixed = "SI, by row and column";

struct NamedMatrix {
    const char* name;
    Matrix StateMatrices::*matrix;
    Hdf5Axis SignalAxes::*rows;
    Hdf5Axis SignalAxes::*columns;
};
constexpr NamedMatrix matrices[] = {{"A", &StateMatrices::A, &SignalAxes::derivative, &SignalAxes::state},
                                    {"B", &StateMatrices::B, &SignalAxes::derivative, &SignalAxes::input},
                                    {"C", &StateMatrices::C, &SignalAxes::output, &SignalAxes::state},
                                    {"D", &StateMatrices::D, &SignalAxes::output, &SignalAxes::input}};

// One matrix per place on the axis: items[first], items[first + step] ...
template <class Items>
void write_stack(Hdf5File& file, const std::string& name, const NamedMatrix& m, const Items& items, std::size_t first,
                 std::size_t step, const Hdf5Axis& axis, const SignalAxes& axes, const std::string& long_name) {
    std::vector<double> values;
    for (std::size_t i = first; i < items.size(); i += step) append(values, items[i].*m.matrix);
    write_array(file, name, values, {axis, axes.*m.rows, axes.*m.columns}, {mixed, m.name + long_name});
}

void write_matrix(Hdf5File& file, const std::string& name, const NamedMatrix& m, const StateMatrices& model,
                  const SignalAxes& axes, const std::string& long_name) {
    std::vector<double> values;
    append(values, model.*m.matrix);
    write_array(file, name, values, {axes.*m.rows, axes.*m.columns}, {mixed, m.name + long_name});
}

void write_constant(Hdf5File& file, const NamedModel& named) {
    const ConstantModel& model = named.model;
    const std::string group = named.name + "/";
    const SignalAxes axes(model);
    file.make_group(named.name, {{"machine", model.machine}, {"rotor_speed", model.rotor_speed}});
    for (const NamedMatrix& m : matrices)
        write_matrix(file, group + m.name, m, model, axes, " of x' = A x + B u, y = C x + D u");
    write_all_signals(file, group, axes, model);
}

// A_mean, A_cosine, A_sine ...
void write_fourier(Hdf5File& file, const std::string& group, const std::vector<StateMatrices>& series,
                   const SignalAxes& axes) {
    std::vector<std::int64_t> multiples(series.size() / 2);
    std::iota(multiples.begin(), multiples.end(), 1);
    const Hdf5Axis harmonic{"harmonic", multiples, {"1", "multiple of the azimuth"}};
    const std::string of = " of its Fourier series in the azimuth";
    for (const NamedMatrix& m : matrices) {
        const std::string name = group + m.name;
        write_matrix(file, name + "_mean", m, series.front(), axes, ": mean" + of);
        if (multiples.empty()) continue;
        write_stack(file, name + "_cosine", m, series, 1, 2, harmonic, axes, ": cosine coefficients" + of);
        write_stack(file, name + "_sine", m, series, 2, 2, harmonic, axes, ": sine coefficients" + of);
    }
}

void write_operating_point(Hdf5File& file, const std::string& group, const LinearModel& model, const Hdf5Axis& azimuth,
                           const SignalAxes& axes) {
    const auto rows = [&](const char* name, Vector LinearSample::*field, const Hdf5Axis& axis, const char* long_name) {
        std::vector<double> values;
        for (const LinearSample& sample : model.samples) append(values, (sample.*field).transpose());
        write_array(file, group + name, values, {azimuth, axis}, {"SI, by column", long_name});
    };
    rows("x", &LinearSample::x, axes.state, "states");
    rows("xdot", &LinearSample::xdot, axes.derivative, "derivatives of the states");
    rows("u", &LinearSample::u, axes.input, "inputs");
    rows("y", &LinearSample::y, axes.output, "outputs");
}

// The azimuths, with the times at which forces were evaluated.
Hdf5Axis axis_of_azimuths(const LinearModel& model) {
    std::vector<double> azimuth, time;
    for (const LinearSample& sample : model.samples) {
        azimuth.push_back(sample.azimuth);
        time.push_back(sample.time);
    }
    return {"azimuth",
            azimuth,
            {"rad", "azimuth of blade 1"},
            {{"time", time, {"s", "time at which forces were evaluated"}}}};
}

// At all azimuths. In a group of its own: reduced models have axes of the same names and other lengths, and in xarray's
// trees axes of a group hold in all groups below.
void write_periodic(Hdf5File& file, const LinearModel& model, const std::vector<StateMatrices>& series) {
    const std::string group = periodic_group + std::string("/");
    const SignalAxes axes(model);
    const Hdf5Axis azimuth = axis_of_azimuths(model);
    for (const NamedMatrix& m : matrices)
        write_stack(file, group + m.name, m, model.samples, 0, 1, azimuth, axes,
                    "(azimuth) of x' = A x + B u, y = C x + D u");
    write_all_signals(file, group, axes, model);
    const Hdf5Axis output = described(axes.output, model.outputs, outputs_are);
    write_array(file, group + "outputs/error",
                std::vector<double>(model.output_error.begin(), model.output_error.end()), {output},
                {"1", "estimated error of C and D over the largest difference of the output"});
    write_operating_point(file, group + "operating_point/", model, azimuth, axes);
    write_fourier(file, group + "fourier/", series, axes);
}

}  // namespace

void write_hdf5(const LinearModel& model, const std::vector<NamedModel>& constant, const std::filesystem::path& path) {
    const std::vector<StateMatrices> series = fourier_coefficients(model);
    check_names(constant, "HDF5 file", {periodic_group, "input_description"});
    Hdf5File file = Hdf5File::create(path);
    for (auto& [name, value] : Attributes{{"title", std::string("linear model of ") + model.machine},
                                          {"machine", model.machine},
                                          {"Conventions", std::string("CF-1.8")},
                                          {"cardan_version", std::string(version())},
                                          {"rotor_speed", model.rotor_speed},
                                          {"blades", std::int64_t{model.blades}},
                                          {"imbalance", model.imbalance}})
        file.set_attribute("/", {name, value});
    file.write("input_description", std::vector<std::string>{model.description}, {},
               "the machine as assembled, what it was read from, and the machine that was computed");
    write_periodic(file, model, series);
    for (const NamedModel& named : constant) write_constant(file, named);
    file.finish();
}

}  // namespace cardan::solvers
