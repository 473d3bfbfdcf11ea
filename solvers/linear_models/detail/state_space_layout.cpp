// Which coordinates are states, which are driven, and what every column of B stands for.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/linear_models/detail/state_space.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

namespace cardan::solvers {

namespace {

constexpr const char* in_inputs = "inputs of a linear model";

}  // namespace

LinearInput LinearInput::generalised_force(std::string name, Coordinates coordinates) {
    LinearInput input(Kind::generalised_force, std::move(name));
    input.coordinates_ = std::move(coordinates);
    return input;
}

LinearInput LinearInput::force(std::string name, FrameId frame, const Vec3& direction, WrenchAxes axes) {
    LinearInput input(Kind::force, std::move(name));
    input.frame_ = frame;
    input.direction_ = direction;
    input.axes_ = axes;
    return input;
}

LinearInput LinearInput::moment(std::string name, FrameId frame, const Vec3& direction, WrenchAxes axes) {
    LinearInput input = force(std::move(name), frame, direction, axes);
    input.kind_ = Kind::moment;
    return input;
}

LinearInput LinearInput::motion(std::string name, Coordinates coordinates) {
    LinearInput input(Kind::motion, std::move(name));
    input.coordinates_ = std::move(coordinates);
    return input;
}

LinearInput LinearInput::acceleration(std::string name, Coordinates coordinates) {
    LinearInput input = motion(std::move(name), std::move(coordinates));
    input.with_states_ = true;
    return input;
}

LinearInput LinearInput::system_input(std::string name) {
    return {Kind::system_input, std::move(name)};
}

int blade_number(std::string_view name) {
    constexpr std::string_view stem = "blade ";
    if (!name.starts_with(stem)) return 0;
    int number = 0;
    std::size_t at = stem.size();
    for (; at < name.size() && is_digit(name[at]) && number < 1000; ++at) number = 10 * number + (name[at] - '0');
    return at > stem.size() && (at == name.size() || name[at] == ' ') ? number : 0;
}

namespace detail {

namespace {

// What the coordinates that inputs move are to become.
struct Moved {
    std::vector<int> split, with_states;

    Moved(const std::vector<LinearInput>& inputs, int size) {
        for (const LinearInput& input : inputs) {
            if (input.kind() != LinearInput::Kind::motion) continue;
            for (const auto& [coordinate, factor] : input.coordinates()) {
                if (coordinate < 0 || coordinate >= size)
                    throw InputError(in_inputs, text("coordinate of '", input.name(), "'"), coordinate,
                                     text("0 ... ", size - 1));
                (input.with_states() ? with_states : split).push_back(coordinate);
            }
        }
        for (int coordinate : split)
            if (contains(with_states, coordinate))
                throw InputError(in_inputs, "coordinate that is moved with and without states", coordinate,
                                 "one of them");
    }
    static bool contains(const std::vector<int>& list, int value) {
        return std::find(list.begin(), list.end(), value) != list.end();
    }
};

}  // namespace

Layout::Layout(const System& system, const RotorMap& rotor, const std::vector<LinearInput>& inputs,
               const StateSpaceOptions& options)
    : system_(system), inputs_(inputs) {
    const CoordinateTable& table = system.model.coordinates();
    if (rotor.spin >= table.size())
        throw InputError("linear model", "index of the spin coordinate", rotor.spin, text("-1 ... ", table.size() - 1));
    const Moved moved(inputs, table.size());
    for (int i = 0; i < table.size(); ++i) {
        const bool states = Moved::contains(moved.with_states, i);
        const bool held = states || Moved::contains(moved.split, i) || table[i].role == CoordinateRole::prescribed ||
                          (i == rotor.spin && options.spin == RotorSpin::prescribed);
        if (states || !held) coordinates.push_back(i);
        (held ? driven : unknowns).push_back(i);
    }
    if (unknowns.empty()) throw InputError("linear model", "number of free coordinates", 0, ">= 1");
    add_columns(inputs);
    name_states();
}

void Layout::keep_independent(const std::vector<int>& kept) {
    independent = kept;
    for (const int i : unknowns)
        if (!Moved::contains(kept, i)) followers.push_back(i);
    std::erase_if(coordinates, [&](int i) { return Moved::contains(followers, i); });
    state_signals.clear();
    name_states();
}

void Layout::check(const LinearInput& input) const {
    const std::string where = text(in_inputs, ": '", input.name(), "'");
    const Model& model = system_.model;
    const bool wrench = input.kind() == LinearInput::Kind::force || input.kind() == LinearInput::Kind::moment;
    if (wrench) {
        const int index = input.frame().index;
        if (index < 0 || index >= static_cast<int>(model.frames().size()) || model.frame(input.frame()).body < 0)
            throw InputError(where, "index of the frame", index, "a frame of a body");
        if (!input.direction().allFinite() || input.direction().isZero(0))
            throw InputError(where, "direction", input.direction().transpose(), "finite and not zero");
        return;
    }
    if (input.kind() == LinearInput::Kind::system_input) {
        (void)system_.forces.inputs().index(input.name());
        return;
    }
    if (input.coordinates().empty()) throw InputError(where, "number of coordinates", 0, ">= 1");
    std::set<int> seen;
    for (const auto& [coordinate, factor] : input.coordinates()) {
        if (coordinate < 0 || coordinate >= model.size())
            throw InputError(where, "index of a coordinate", coordinate, text("0 ... ", model.size() - 1));
        if (!seen.insert(coordinate).second)
            throw InputError(where, "coordinate", model.coordinates()[coordinate].name, "each once");
        const std::string &unit = model.coordinates()[coordinate].unit,
                          &first = model.coordinates()[input.coordinates()[0].first].unit;
        if (unit != first)
            throw InputError(where, text("unit of '", model.coordinates()[coordinate].name, "'"), unit,
                             text(first, ", that of the first coordinate"));
        if (!std::isfinite(factor) || factor == 0) throw InputError(where, "factor", factor, "finite and not zero");
        if (input.kind() == LinearInput::Kind::generalised_force && Moved::contains(driven, coordinate))
            throw InputError(where, "coordinate", model.coordinates()[coordinate].name,
                             "one that is not driven: a force on it has no effect");
    }
}

std::string Layout::units(const LinearInput& input) const {
    if (input.kind() == LinearInput::Kind::force) return "N";
    if (input.kind() == LinearInput::Kind::moment) return "N m";
    if (input.kind() == LinearInput::Kind::system_input) {
        const InputTable& table = system_.forces.inputs();
        return table[table.index(input.name())].unit;
    }
    const std::string& unit = system_.model.coordinates()[input.coordinates()[0].first].unit;
    if (input.kind() == LinearInput::Kind::motion) return unit;
    return unit == "m" ? "N" : "N m";
}

void Layout::add_columns(const std::vector<LinearInput>& inputs) {
    constexpr std::array<const char*, 3> suffix{"", " rate", " acceleration"}, per{"", " s-1", " s-2"};
    std::set<std::string> names;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const LinearInput& input = inputs[i];
        check(input);
        const bool motion = input.kind() == LinearInput::Kind::motion;
        const int first = input.with_states() ? 2 : 0, last = motion ? 2 : 0;
        for (int d = first; d <= last; ++d) {
            Signal signal{.name = input.name() + entry(suffix, d), .units = units(input) + entry(per, d)};
            signal.blade = blade_number(signal.name);
            if (input.name().empty() || !names.insert(signal.name).second)
                throw InputError(in_inputs, "name", text("'", signal.name, "'"), "not empty, each name once");
            columns_.push_back({i, d});
            input_signals.push_back(std::move(signal));
        }
    }
}

void Layout::name_states() {
    const CoordinateTable& table = system_.model.coordinates();
    for (bool rate : {false, true})
        for (int i : coordinates) {
            const CoordinateInfo& info = table[i];
            state_signals.push_back({.name = info.name + (rate ? " rate" : ""),
                                     .units = info.unit + (rate ? " s-1" : ""),
                                     .long_name = text(rate ? "rate" : "position", " of '", info.name, "', deviation"),
                                     .blade = info.blade});
        }
    for (const StateInfo& info : system_.forces.states())
        state_signals.push_back({.name = info.name,
                                 .units = info.unit,
                                 .long_name = text("state '", info.name, "', deviation"),
                                 .blade = info.blade});
}

void Layout::begin(const Kinematics& kin, Directions& out) const {
    const Eigen::Index n = system_.model.size();
    for (Matrix* m : {&out.q, &out.qd, &out.qdd, &out.actuator, &out.Q}) m->setZero(n, columns());
    out.s.setZero(first_order(), columns());
    out.u.setZero(system_.forces.inputs().size(), columns());
    const Eigen::Index half = std::ssize(coordinates);
    for (Eigen::Index i = 0; i < first_order(); ++i) out.s(i, 2 * half + i) = 1;
    for (Eigen::Index i = 0; i < half; ++i) {
        const int coordinate = entry(coordinates, i);
        out.q(coordinate, i) = 1;
        out.qd(coordinate, half + i) = 1;
    }
    for (Eigen::Index column = states(); column < columns(); ++column) {
        const Column& own = entry(columns_, column - states());
        const LinearInput& input = inputs_[own.input];
        if (const std::optional<FrameLoad> load = wrench_of(column)) {
            Matrix J(6, n);
            frame_jacobian<double>(kin, load->frame, J);
            const Wrench at = system_.forces.at_frame(*load, kin);
            out.Q.col(column) = J.topRows(3).transpose() * at.moment + J.bottomRows(3).transpose() * at.force;
            continue;
        }
        if (input.kind() == LinearInput::Kind::system_input) {
            out.u(system_.forces.inputs().index(input.name()), column) = 1;
            continue;
        }
        Matrix& target = input.kind() == LinearInput::Kind::generalised_force ? out.Q
                         : own.derivative == 0                                ? out.q
                         : own.derivative == 1                                ? out.qd
                                                                              : out.qdd;
        for (const auto& [coordinate, factor] : input.coordinates()) target(coordinate, column) += factor;
    }
}

std::optional<FrameLoad> Layout::wrench_of(Eigen::Index column) const {
    if (column < states()) return std::nullopt;
    const LinearInput& input = inputs_[entry(columns_, column - states()).input];
    FrameLoad load{.name = input.name(), .frame = input.frame(), .axes = input.axes()};
    if (input.kind() == LinearInput::Kind::force)
        load.wrench.force = input.direction();
    else if (input.kind() == LinearInput::Kind::moment)
        load.wrench.moment = input.direction();
    else
        return std::nullopt;
    return load;
}

Vector Layout::input_values(const DynamicState& at) const {
    Vector values = Vector::Zero(std::ssize(columns_));
    for (Eigen::Index c = 0; c < values.size(); ++c) {
        const Column& own = entry(columns_, c);
        const LinearInput& input = inputs_[own.input];
        if (input.kind() == LinearInput::Kind::system_input) {
            const InputTable& table = system_.forces.inputs();
            const int i = table.index(input.name());
            values(c) = at.u.size() > 0 ? at.u(i) : table[i].initial;
        }
        if (input.kind() != LinearInput::Kind::motion) continue;
        const auto& [coordinate, factor] = input.coordinates()[0];
        const Vector& from = own.derivative == 0 ? at.q : own.derivative == 1 ? at.qd : at.qdd;
        values(c) = from(coordinate) / factor;
    }
    return values;
}

}  // namespace detail

}  // namespace cardan::solvers
