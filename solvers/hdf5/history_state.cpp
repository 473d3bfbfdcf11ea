#include "mbs/base/error.hpp"
#include "solvers/hdf5/detail/history.hpp"

#include <hdf5.h>

#include <array>

namespace cardan::solvers::detail {
namespace {

constexpr const char* checkpoint_group = "run/checkpoint/";
constexpr const char* notes_group = "run/checkpoint/notes";
constexpr const char* statistics_group = "run/statistics/";

/// One number of a checkpoint or of the statistics.
template <class Whole, class Number>
struct Field {
    const char* name;
    const char* units;
    const char* long_name;
    Number Whole::*member;
};

constexpr std::array<Field<Checkpoint, double>, 3> checkpoint_numbers{{
    {"checkpoint_time", "s", "time of the checkpoint", &Checkpoint::time},  // "time" is the name of an axis
    {"kinetic_energy_at_start", "J", "kinetic energy at the start, where the work is zero",
     &Checkpoint::kinetic_at_start},
    {"potential_energy_at_start", "J", "potential energy at the start, where the work is zero",
     &Checkpoint::potential_at_start},
}};
constexpr std::array<Field<Work, double>, 3> work_numbers{{
    {"work_of_forces", "J", "work of all forces since the start", &Work::forces},
    {"work_of_dissipation", "J", "time integral of the power of linear dampers since the start", &Work::dissipation},
    {"work_of_drives", "J", "work of the drives since the start", &Work::drives},
}};
constexpr std::array<Field<Work, double>, 3> state_work_numbers{{
    {"energy_supplied_to_states", "J", "energy supplied to elements with states since the start", &Work::state_supply},
    {"energy_dissipated_by_states", "J", "energy dissipated by elements with states since the start",
     &Work::state_dissipation},
    {"work_of_states", "J", "work of the forces of elements with states since the start", &Work::state_work},
}};
constexpr Field<Checkpoint, double> stored_at_start{
    "energy_of_states_at_start", "J", "energy in elements with states at the start", &Checkpoint::stored_at_start};
constexpr const char* controllers_group = "run/checkpoint/controllers";
constexpr const char* method_steps = "method_steps";
constexpr const char* positions_at_start = "positions_at_start";
constexpr std::array<Field<MethodState, double>, 3> method_numbers{{
    {"method_time", "s", "time of the method's state", &MethodState::time},
    {"method_horizon", "s", "time that was wanted next: a scale of a first step", &MethodState::horizon},
    {"time_at_start", "s", "time of the first start", &MethodState::since},
}};
using Statistics = IntegrationStatistics;
constexpr std::array<Field<Statistics, long>, 8> counts{{
    {"steps", "1", "accepted steps", &Statistics::steps},
    {"rejected", "1", "steps rejected by the error test", &Statistics::rejected},
    {"not_converged", "1", "steps repeated because the iteration did not converge", &Statistics::not_converged},
    {"evaluations", "1", "evaluations of the equations of motion by the method", &Statistics::evaluations},
    {"jacobians", "1", "Jacobians or tangents", &Statistics::jacobians},
    {"factorisations", "1", "factorisations of the matrix of Newton's method", &Statistics::factorisations},
    {"iterations", "1", "nonlinear iterations", &Statistics::iterations},
    {"restarts", "1", "restarts at breaks of motions and after events", &Statistics::restarts},
}};

template <class Value>
void put(Hdf5File& file, const std::string& name, std::span<const Value> values, const Shape& shape, hid_t memory,
         const Description& about) {
    if (!file.has(name)) return file.write(name, values, shape, about);
    const Quiet quiet;
    Hdf5File::Impl& impl = Hdf5File::Impl::of(file);
    const Handle dataset = impl.open_dataset(name);
    const Shape stored = impl.shape(dataset.get(), name);
    if (stored != shape)
        throw InputError(text(impl.path, ": ", name), "length", values.size(),
                         text("that of earlier checkpoints, ", stored.empty() ? 1 : stored.front()));
    impl.change(name, [&] {
        impl.ok(H5Dwrite(dataset.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name, "be written");
    });
}

void put(Hdf5File& file, const std::string& name, double value, const Description& about) {
    put<double>(file, name, {&value, 1}, {}, H5T_NATIVE_DOUBLE, about);
}

void put(Hdf5File& file, const std::string& name, std::int64_t value, const Description& about) {
    put<std::int64_t>(file, name, {&value, 1}, {}, H5T_NATIVE_INT64, about);
}

// The axis that counts the entries of a vector; netCDF wants one for every data set.
struct IndexAxis {
    const char* name;
    const char* long_name;
};
constexpr IndexAxis coordinate_axis{"coordinate", "index of the coordinate"};
constexpr IndexAxis first_order_axis{"state", "index of the state of first order"};
constexpr IndexAxis input_axis{"input", "index of the input"};
constexpr IndexAxis state_axis{"method_state_index", "index of the state"};
constexpr IndexAxis memory_axis{"method_memory_index", "index of what is remembered"};

void put(Hdf5File& file, const std::string& name, const Vector& values, const Description& about,
         const IndexAxis& axis) {
    const auto n = static_cast<std::size_t>(values.size());
    const bool first = !file.has(name);
    put<double>(file, name, {values.data(), n}, {n}, H5T_NATIVE_DOUBLE, about);
    if (!first) return;
    const std::string scale = std::string(checkpoint_group) + axis.name;
    if (!file.has(scale)) file.make_index(scale, n, axis.long_name);
    file.attach(name, 0, scale);
}

Vector vector_of(const Hdf5File& file, const std::string& name) {
    const std::vector<double> values = file.read_doubles(name);
    return Eigen::Map<const Vector>(values.data(), std::ssize(values));
}

IntegrationStatistics statistics_of(const Hdf5File& file) {
    const std::string group = statistics_group;
    IntegrationStatistics statistics;
    const auto count = [&](const char* name) { return file.read_ints(group + name).at(0); };
    for (const auto& f : counts) statistics.*f.member = static_cast<long>(count(f.name));
    statistics.order = static_cast<int>(count("order"));
    statistics.last_step = file.read_doubles(group + "last_step").at(0);
    return statistics;
}

// For files that have it: written by versions that could continue from within a step.
MethodState method_of(const Hdf5File& file) {
    const std::string group = checkpoint_group;
    MethodState method;
    if (!file.has(group + method_steps)) return method;
    for (const auto& f : method_numbers) method.*f.member = file.read_doubles(group + f.name).at(0);
    if (file.has(group + positions_at_start)) method.positions = vector_of(file, group + positions_at_start);
    method.steps = static_cast<long>(file.read_ints(group + method_steps).at(0));
    if (method.steps < 0) return method;
    method.x = vector_of(file, group + "method_state");
    method.memory = vector_of(file, group + "method_memory");
    return method;
}

void put_method(Hdf5File& file, const MethodState& method) {
    const std::string group = checkpoint_group;
    put(file, group + method_steps, std::int64_t{method.steps},
        {"1", "steps of the method since its state here; -1: it starts anew from q, qd"});
    for (const auto& f : method_numbers) put(file, group + f.name, method.*f.member, {f.units, f.long_name});
    if (method.positions.size() > 0)
        put(file, group + positions_at_start, method.positions, {"rad or m", "coordinates at the first start"},
            coordinate_axis);
    if (method.steps < 0) return;
    put(file, group + "method_state", method.x, {"SI", "free coordinates, their rates, and states of first order"},
        state_axis);
    put(file, group + "method_memory", method.memory, {"SI", "what the method remembers besides"}, memory_axis);
}

void put_controller(Hdf5File& file, const SampledState& controller) {
    const std::string group = text(controllers_group, "/", controller.name, "/");
    const auto list = [&](const char* name, std::span<const double> values, const char* axis, const char* long_name) {
        if (values.empty()) return;
        const bool first = !file.has(group + name);
        put<double>(file, group + name, values, {values.size()}, H5T_NATIVE_DOUBLE, {"1", long_name});
        if (!first) return;
        file.make_index(group + axis, values.size(), text("index of the ", axis));
        file.attach(group + name, 0, group + axis);
    };
    put(file, group + "next", std::int64_t{controller.next}, {"1", "sample to come"});
    list("pending", {controller.pending.data(), static_cast<std::size_t>(controller.pending.size())}, "output",
         "what is put out at the next sample, if it is delayed");
    list("memory", controller.memory, "number", "what the controller keeps for itself");
    list("followed", controller.followed, "demand", "last three demands of each coordinate that follows them");
}

SampledState controller_of(const Hdf5File& file, const std::string& name) {
    const std::string group = text(controllers_group, "/", name, "/");
    SampledState out{name, static_cast<long>(file.read_ints(group + "next").at(0))};
    if (file.has(group + "pending")) out.pending = vector_of(file, group + "pending");
    if (file.has(group + "memory")) out.memory = file.read_doubles(group + "memory");
    if (file.has(group + "followed")) out.followed = file.read_doubles(group + "followed");
    return out;
}

Checkpoint checkpoint_of(const Hdf5File& file) {
    const std::string group = checkpoint_group;
    Checkpoint checkpoint;
    for (const auto& f : checkpoint_numbers) checkpoint.*f.member = file.read_doubles(group + f.name).at(0);
    for (const auto& f : work_numbers) checkpoint.work.*f.member = file.read_doubles(group + f.name).at(0);
    checkpoint.q = vector_of(file, group + "q");
    checkpoint.qd = vector_of(file, group + "qd");
    if (file.has(group + "s")) {
        checkpoint.s = vector_of(file, group + "s");
        for (const auto& f : state_work_numbers) checkpoint.work.*f.member = file.read_doubles(group + f.name).at(0);
        checkpoint.stored_at_start = file.read_doubles(group + stored_at_start.name).at(0);
    }
    if (file.has(group + "u")) checkpoint.u = vector_of(file, group + "u");
    if (file.has(controllers_group))
        for (const std::string& name : file.children(controllers_group))
            checkpoint.controllers.push_back(controller_of(file, name));
    checkpoint.method = method_of(file);
    if (file.has(notes_group))
        for (const std::string& name : file.children(notes_group))
            checkpoint.notes[name] = file.read_doubles(text(notes_group, "/", name)).at(0);
    return checkpoint;
}

}  // namespace

void put_checkpoint(Hdf5File& file, const Checkpoint& checkpoint, std::size_t rows) {
    const std::string group = checkpoint_group;
    put(file, group + "rows", static_cast<std::int64_t>(rows), {"1", "rows of the history up to the checkpoint"});
    for (const auto& f : checkpoint_numbers) put(file, group + f.name, checkpoint.*f.member, {f.units, f.long_name});
    for (const auto& f : work_numbers) put(file, group + f.name, checkpoint.work.*f.member, {f.units, f.long_name});
    put(file, group + "q", checkpoint.q, {"rad or m", "coordinates"}, coordinate_axis);
    put(file, group + "qd", checkpoint.qd, {"rad s-1 or m s-1", "rates of the coordinates"}, coordinate_axis);
    if (checkpoint.s.size() > 0) {
        put(file, group + "s", checkpoint.s, {"SI", "states of first order beside the coordinates"}, first_order_axis);
        for (const auto& f : state_work_numbers)
            put(file, group + f.name, checkpoint.work.*f.member, {f.units, f.long_name});
        const auto& f = stored_at_start;
        put(file, group + f.name, checkpoint.*f.member, {f.units, f.long_name});
    }
    if (checkpoint.u.size() > 0) put(file, group + "u", checkpoint.u, {"SI", "inputs"}, input_axis);
    for (const SampledState& controller : checkpoint.controllers) put_controller(file, controller);
    put_method(file, checkpoint.method);
    for (const auto& [name, value] : checkpoint.notes)
        put(file, text(notes_group, "/", name), value, {"1", "note of the program for itself"});
    put_statistics(file, checkpoint.statistics);
}

void put_statistics(Hdf5File& file, const IntegrationStatistics& statistics) {
    const std::string group = statistics_group;
    for (const auto& f : counts) put(file, group + f.name, std::int64_t{statistics.*f.member}, {f.units, f.long_name});
    put(file, group + "order", std::int64_t{statistics.order}, {"1", "order of the last step"});
    put(file, group + "last_step", statistics.last_step, {"s", "length of the last step"});
}

void read_state(const Hdf5File& file, HistoryInfo& info) {
    if (file.has(statistics_group + std::string("steps"))) info.statistics = statistics_of(file);
    const std::string rows = checkpoint_group + std::string("rows");
    if (!file.has(rows)) return;
    info.checkpoint = checkpoint_of(file);
    info.checkpoint->statistics = info.statistics.value_or(IntegrationStatistics{});
    info.checkpoint_rows = static_cast<std::size_t>(file.read_ints(rows).at(0));
    if (info.checkpoint_rows > info.rows)
        throw FileError(file.path(),
                        text("the checkpoint comes after ", info.checkpoint_rows, " rows, there are ", info.rows));
}

}  // namespace cardan::solvers::detail
