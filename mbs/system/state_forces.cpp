#include "mbs/system/state_forces.hpp"

#include "mbs/base/disjoint_sets.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace cardan {

namespace {

using ColumnMap = Eigen::Map<Vector>;
using MatrixMap = Eigen::Map<Matrix>;

/// @param taken  names so far, to which this one is added
template <class Info>
void check(const Info& info, const std::string& where, const char* kind, std::set<std::string>& taken) {
    const std::string name = text(where, ": ", kind, " '", info.name, "'");
    if (info.name.empty()) throw InputError(text(where, ": a ", kind, " without a name"));
    if (info.unit.empty()) throw InputError(text(name, ": the unit is missing; '1' for a pure number"));
    require_positive(name, text("scale [", info.unit, "]"), info.scale);
    if (!std::isfinite(info.initial))
        throw InputError(name, text("value at the start [", info.unit, "]"), info.initial, "finite");
    if (!taken.insert(info.name).second)
        throw InputError(text(name, ": a state, an input or a coordinate of this name is there already"));
}

}  // namespace

// The matrix is stored behind the values. A nested evaluation, within a function of an element, gets fresh memory.
class StateForces::Local {
public:
    explicit Local(const Bound& element)
        : nq_(std::ssize(element.at)),
          ns_(std::ssize(element.own.states)),
          no_(std::ssize(element.reads)),
          nu_(std::ssize(element.inputs)),
          memory_(std::exchange(kept(), {})) {
        const auto needed = static_cast<std::size_t>(columns() + (3 + columns()) * rows());
        if (memory_.size() < needed) memory_.resize(needed);
    }
    ~Local() { kept() = std::move(memory_); }
    Local(const Local&) = delete;
    Local& operator=(const Local&) = delete;

    Eigen::Index rows() const { return nq_ + ns_; }
    Eigen::Index columns() const { return 2 * nq_ + ns_ + no_ + nu_; }

    void gather(const Bound& element, const StateView& at) {
        double* out = memory_.data();
        for (const int i : element.at) *out++ = at.q(i);
        for (const int i : element.at) *out++ = at.qd(i);
        for (Eigen::Index i = 0; i < ns_; ++i) *out++ = at.s(element.first + i);
        for (const int i : element.reads) *out++ = at.s(i);
        for (const int i : element.inputs) *out++ = at.u(i);
    }
    double& value(Eigen::Index column) { return memory_[static_cast<std::size_t>(column)]; }
    StateInput input(double time) {
        double* p = memory_.data();
        const ColumnMap q(p, nq_), qd(p + nq_, nq_), s(p + 2 * nq_, ns_), others(p + 2 * nq_ + ns_, no_),
            u(p + 2 * nq_ + ns_ + no_, nu_);
        return {time, q, qd, s, others, u};
    }
    /// Q, then f; of three sets.
    ColumnMap result(int set = 0) { return {memory_.data() + columns() + set * rows(), rows()}; }
    MatrixMap jacobian() { return {memory_.data() + columns() + 3 * rows(), rows(), columns()}; }
    StateJacobian blocks() {
        MatrixMap J = jacobian();
        const Eigen::Index s = 2 * nq_, o = s + ns_, u = o + no_;
        return {J.block(0, 0, nq_, nq_),     J.block(0, nq_, nq_, nq_), J.block(0, s, nq_, ns_),
                J.block(0, o, nq_, no_),     J.block(0, u, nq_, nu_),   J.block(nq_, 0, ns_, nq_),
                J.block(nq_, nq_, ns_, nq_), J.block(nq_, s, ns_, ns_), J.block(nq_, o, ns_, no_),
                J.block(nq_, u, ns_, nu_)};
    }

    void evaluate(const Bound& element, double time, int set = 0) {
        ColumnMap out = result(set);
        out.setZero();
        element.own.rates(input(time), out.head(nq_), out.tail(ns_));
    }

private:
    static std::vector<double>& kept() {
        thread_local std::vector<double> memory;
        return memory;
    }

    Eigen::Index nq_, ns_, no_, nu_;
    std::vector<double> memory_;
};

StateForces::StateForces(std::vector<StateElement> elements, std::vector<InputInfo> inputs, const Model& model,
                         const std::vector<OtherStates>& others)
    : size_(model.size()) {
    std::set<std::string> taken;
    for (const CoordinateInfo& coordinate : model.coordinates()) taken.insert(coordinate.name);
    for (const InputInfo& input : inputs) check(input, "inputs", "input", taken);
    inputs_ = InputTable(std::move(inputs));
    std::vector<StateInfo> all;
    for (StateElement& element : elements) {
        const std::string where = text("element '", element.name, "'");
        for (const StateInfo& state : element.states) check(state, where, "state", taken);
        const int first = static_cast<int>(all.size());
        all.insert(all.end(), element.states.begin(), element.states.end());
        elements_.push_back({std::move(element), {}, {}, {}, first});
    }
    own_ = static_cast<int>(all.size());
    std::vector<int> firsts;
    for (const OtherStates& other : others) {
        const std::string where = text("field '", other.owner, "'");
        for (const StateInfo& state : other.states) check(state, where, "state", taken);
        firsts.push_back(static_cast<int>(all.size()));
        all.insert(all.end(), other.states.begin(), other.states.end());
    }
    states_ = StateTable(std::move(all));
    for (Bound& element : elements_) bind(element, model);
    find_groups();
    for (std::size_t i = 0; i < others.size(); ++i)
        add_groups(others[i], firsts[i], text("field '", others[i].owner, "'"));
}

void StateForces::add_groups(const OtherStates& others, int first, const std::string& where) {
    std::vector<int> times(others.states.size(), 0);  // that a state is in a group
    for (StateGroup group : others.groups) {
        for (int& state : group.states) {
            if (state < 0 || state >= std::ssize(times))
                throw InputError(where, "state of a group", state, text("0 ... ", std::ssize(times) - 1));
            ++entry(times, state);
            state += first;
        }
        std::ranges::sort(group.states);
        std::ranges::sort(group.coordinates);
        groups_.push_back(std::move(group));
    }
    for (std::size_t i = 0; i < times.size(); ++i)
        if (times[i] != 1)
            throw InputError(text(where, ", state '", others.states[i].name, "'"), "number of groups with it", times[i],
                             "1");
}

// Elements belong together that own or read the same states.
void StateForces::find_groups() {
    DisjointSets sets(own_);
    const auto states_of = [](const Bound& element) {
        std::vector<int> all = element.reads;
        for (int i = 0; i < static_cast<int>(element.own.states.size()); ++i) all.push_back(element.first + i);
        return all;
    };
    for (const Bound& element : elements_) {
        const std::vector<int> all = states_of(element);
        for (const int state : all) sets.join(state, all.front());
    }
    std::map<std::ptrdiff_t, StateGroup> groups;  // by leader
    for (int i = 0; i < own_; ++i) groups[sets.leader(i)].states.push_back(i);
    for (const Bound& element : elements_) {
        const std::vector<int> all = states_of(element);
        if (all.empty()) continue;
        std::vector<int>& coordinates = groups[sets.leader(all.front())].coordinates;
        coordinates.insert(coordinates.end(), element.at.begin(), element.at.end());
    }
    for (auto& [leader, group] : groups) {
        std::ranges::sort(group.coordinates);
        group.coordinates.erase(std::unique(group.coordinates.begin(), group.coordinates.end()),
                                group.coordinates.end());
        groups_.push_back(std::move(group));
    }
}

void StateForces::bind(Bound& element, const Model& model) {
    const std::string where = text("element '", element.own.name, "'");
    for (const BodyId body : element.own.coordinates) {
        if (body.index < 0 || body.index >= model.size())
            throw InputError(where, "body", body.index, "a body of the tree");
        element.at.push_back(model.index(body));
    }
    const auto named = [&](const std::string& name, const auto& table) {
        try {
            return table.index(name);
        } catch (const InputError& error) {
            throw InputError(text(where, ": ", error.what()));
        }
    };
    for (const std::string& name : element.own.reads) {
        element.reads.push_back(named(name, states_));
        // Groups of a field know nothing of elements.
        if (element.reads.back() >= own_)
            throw InputError(text(where, ": it cannot read '", name, "', a state of a field"));
    }
    for (const std::string& name : element.own.inputs) element.inputs.push_back(named(name, inputs_));
}

void StateForces::require_sizes(const StateView& at) const {
    require_size("elements with states", "q", at.q, size_);
    require_size("elements with states", "qd", at.qd, size_);
    require_size("elements with states", "s", at.s, states_.size());
    require_size("elements with states", "u", at.u, inputs_.size());
}

void StateForces::rates(const StateView& at, VectorOut& Q, VectorOut& f) const {
    require_sizes(at);
    require_size("elements with states", "Q", Q, size_);
    require_size("elements with states", "f", f, states_.size());
    for (const Bound& element : elements_) {
        Local local(element);
        local.gather(element, at);
        local.evaluate(element, at.time);
        const ColumnMap out = local.result();
        Eigen::Index row = 0;
        for (const int i : element.at) Q(i) += factor_ * out(row++);
        for (int i = element.first; row < local.rows(); ++i) f(i) = out(row++);
    }
}

// The size of the step by which a value of an element is varied.
double StateForces::step(const Bound& element, int column) const {
    constexpr double relative = 1e-6;
    const int motion = 2 * static_cast<int>(std::ssize(element.at)),
              own = static_cast<int>(std::ssize(element.own.states)),
              read = static_cast<int>(std::ssize(element.reads));
    if (column < motion) return relative;
    if ((column -= motion) < own) return relative * states_[element.first + column].scale;
    if ((column -= own) < read) return relative * states_[entry(element.reads, column)].scale;
    return relative * inputs_[entry(element.inputs, column - read)].scale;
}

void StateForces::difference(const Bound& element, double time, Local& local) const {
    MatrixMap J = local.jacobian();
    for (int column = 0; column < J.cols(); ++column) {
        double& value = local.value(column);
        const double middle = value, h = step(element, column);
        value = middle + h;
        const double above = value;
        local.evaluate(element, time, 1);
        value = middle - h;
        const double below = value;
        local.evaluate(element, time, 2);
        value = middle;
        J.col(column) = (local.result(1) - local.result(2)) / (above - below);
    }
}

void StateForces::derivatives(const StateView& at, Matrix& K, Matrix& D, StateDerivatives& out) const {
    require_sizes(at);
    const int m = states_.size(), u = inputs_.size();
    out.Q_s.setZero(size_, m);
    out.f_q.setZero(m, size_);
    out.f_qd.setZero(m, size_);
    out.f_s.setZero(m, m);
    out.Q_u.setZero(size_, u);
    out.f_u.setZero(m, u);
    for (const Bound& element : elements_) {
        Local local(element);
        local.gather(element, at);
        MatrixMap J = local.jacobian();
        if (element.own.jacobian) {
            J.setZero();
            StateJacobian blocks = local.blocks();
            element.own.jacobian(local.input(at.time), blocks);
        } else {
            difference(element, at.time, local);
        }
        const int nq = static_cast<int>(std::ssize(element.at)), ns = static_cast<int>(std::ssize(element.own.states));
        // A column of the element's matrix into columns of the system's.
        const auto add = [&](Eigen::Index from, Matrix& by_Q, double sign, Matrix& by_f, int to) {
            for (int i = 0; i < nq; ++i) by_Q(entry(element.at, i), to) += sign * factor_ * J(i, from);
            for (int i = 0; i < ns; ++i) by_f(element.first + i, to) += J(nq + i, from);
        };
        Eigen::Index column = 0;
        for (const int to : element.at) add(column++, K, -1, out.f_q, to);
        for (const int to : element.at) add(column++, D, -1, out.f_qd, to);
        for (int i = 0; i < ns; ++i) add(column++, out.Q_s, 1, out.f_s, element.first + i);
        for (const int to : element.reads) add(column++, out.Q_s, 1, out.f_s, to);
        for (const int to : element.inputs) add(column++, out.Q_u, 1, out.f_u, to);
    }
}

StateEnergy StateForces::energy(const StateView& at) const {
    require_sizes(at);
    StateEnergy sum;
    for (const Bound& element : elements_) {
        if (!element.own.power) continue;
        Local local(element);
        local.gather(element, at);
        const StatePower own = element.own.power(local.input(at.time));
        sum.stored += own.stored;
        sum.supplied += own.supplied;
        sum.dissipated += own.dissipated;
        local.evaluate(element, at.time);
        const ColumnMap out = local.result();
        Eigen::Index row = 0;
        for (const int i : element.at) sum.work += out(row++) * at.qd(i);
    }
    return sum;
}

void StateForces::append_breaks(std::vector<double>& times) const {
    for (const Bound& element : elements_)
        times.insert(times.end(), element.own.breaks.begin(), element.own.breaks.end());
}

void StateForces::scale(double factor) {
    factor_ *= factor;
}

}  // namespace cardan
