#include "mbs/system/bound_elements.hpp"

#include "mbs/base/disjoint_sets.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace cardan {

namespace {

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

std::string named(const ForceElement& element) {
    return text("element '", element.name, "'");
}

int coordinate(const BodyId& body, const std::string& where, const Model& model) {
    if (body.index < 0 || body.index >= model.size()) throw InputError(where, "body", body.index, "a body of the tree");
    return model.index(body);
}

void sort_unique(std::vector<int>& values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::vector<int> all_up_to(int n) {
    std::vector<int> all(static_cast<std::size_t>(n));
    std::iota(all.begin(), all.end(), 0);
    return all;
}

}  // namespace

BoundElements::BoundElements(std::vector<ForceElement> elements, std::vector<InputInfo> inputs, const Model& model)
    : size_(model.size()) {
    std::set<std::string> taken;
    for (const CoordinateInfo& coordinate : model.coordinates()) taken.insert(coordinate.name);
    for (const InputInfo& input : inputs) check(input, "inputs", "input", taken);
    inputs_ = InputTable(std::move(inputs));
    std::vector<StateInfo> all;
    for (ForceElement& element : elements) {
        const std::string where = named(element);
        for (const StateInfo& state : element.states) check(state, where, "state", taken);
        const int first = static_cast<int>(all.size());
        all.insert(all.end(), element.states.begin(), element.states.end());
        elements_.push_back({std::move(element), {}, {}, {}, {}, {}, first});
    }
    states_ = StateTable(std::move(all));
    for (Bound& element : elements_) bind(element, model);
    find_groups(model);
}

void BoundElements::bind(Bound& element, const Model& model) {
    const std::string where = named(element.own);
    for (const BodyId body : element.own.coordinates) element.at.push_back(coordinate(body, where, model));
    for (const FramePoint& point : element.own.points) {
        if (point.frame.index < 0 || point.frame.index >= std::ssize(model.frames()))
            throw InputError(where, "frame", point.frame.index, "a frame of the tree");
        const Model::Frame& frame = model.frame(point.frame);
        element.bodies.push_back(frame.body);
        element.places.push_back(frame.in_body * point.place);
    }
    const auto index_of = [&](const std::string& name, const auto& table) {
        try {
            return table.index(name);
        } catch (const InputError& error) {
            throw InputError(text(where, ": ", error.what()));
        }
    };
    for (const std::string& name : element.own.reads) element.reads.push_back(index_of(name, states_));
    for (const std::string& name : element.own.inputs) element.inputs.push_back(index_of(name, inputs_));
}

// Elements belong together that own or read the same states; an element that declares groups stands alone.
void BoundElements::find_groups(const Model& model) {
    std::vector<const Bound*> owners(static_cast<std::size_t>(states_.size()));
    for (const Bound& element : elements_)
        for (int i = 0; i < element.states(); ++i) entry(owners, element.first + i) = &element;
    DisjointSets sets(states_.size());
    const auto states_of = [](const Bound& element) {
        std::vector<int> all = element.reads;
        for (int i = 0; i < element.states(); ++i) all.push_back(element.first + i);
        return all;
    };
    for (const Bound& element : elements_) {
        for (const int state : element.reads)
            if (!entry(owners, state)->own.groups.empty())
                throw InputError(text(named(element.own), ": it cannot read '", states_[state].name, "', a state of ",
                                      named(entry(owners, state)->own), ", which declares groups"));
        if (!element.own.groups.empty()) continue;
        const std::vector<int> all = states_of(element);
        for (const int state : all) sets.join(state, all.front());
    }
    std::map<std::ptrdiff_t, StateGroup> groups;  // by leader
    for (int i = 0; i < states_.size(); ++i)
        if (entry(owners, i)->own.groups.empty()) groups[sets.leader(i)].states.push_back(i);
    for (const Bound& element : elements_) {
        const std::vector<int> all = states_of(element);
        if (all.empty() || !element.own.groups.empty()) continue;
        std::vector<int>& coordinates = groups[sets.leader(all.front())].coordinates;
        const std::vector<int> seen = element.sees_all() ? all_up_to(size_) : element.at;
        coordinates.insert(coordinates.end(), seen.begin(), seen.end());
    }
    for (auto& [leader, group] : groups) {
        sort_unique(group.coordinates);
        groups_.push_back(std::move(group));
    }
    for (const Bound& element : elements_) add_declared_groups(element, model);
}

void BoundElements::add_declared_groups(const Bound& element, const Model& model) {
    if (element.own.groups.empty()) return;
    const std::string where = named(element.own);
    std::vector<int> times(element.own.states.size(), 0);  // that a state is in a group
    for (const ElementGroup& declared : element.own.groups) {
        StateGroup& group = groups_.emplace_back();
        for (const int state : declared.states) {
            if (state < 0 || state >= std::ssize(times))
                throw InputError(where, "state of a group", state, text("0 ... ", std::ssize(times) - 1));
            ++entry(times, state);
            group.states.push_back(element.first + state);
        }
        for (const BodyId body : declared.coordinates) group.coordinates.push_back(coordinate(body, where, model));
        std::ranges::sort(group.states);
        sort_unique(group.coordinates);
    }
    for (std::size_t i = 0; i < times.size(); ++i)
        if (times[i] != 1)
            throw InputError(text(where, ", state '", element.own.states[i].name, "'"), "number of groups with it",
                             times[i], "1");
}

void BoundElements::require_sizes(const StateView& at) const {
    require_size("force elements", "q", at.q, size_);
    require_size("force elements", "qd", at.qd, size_);
    require_size("force elements", "states", at.s, states_.size());
    require_size("force elements", "inputs", at.u, inputs_.size());
}

const BoundElements::Bound& BoundElements::bound(int i) const {
    require_index("force elements", "index", i, size());
    return entry(elements_, i);
}

const ForceElement& BoundElements::operator[](int i) const {
    return bound(i).own;
}

bool BoundElements::tells_power() const {
    return std::ranges::any_of(elements_, [](const Bound& element) { return bool(element.own.power); });
}

int BoundElements::index(std::string_view name) const {
    const auto found = std::ranges::find(elements_, name, [](const Bound& e) { return std::string_view(e.own.name); });
    if (found == elements_.end())
        throw InputError("force elements", "element", text("'", name, "'"), "one of the system");
    return static_cast<int>(found - elements_.begin());
}

void BoundElements::append_breaks(std::vector<double>& times) const {
    for (const Bound& element : elements_)
        times.insert(times.end(), element.own.breaks.begin(), element.own.breaks.end());
}

void BoundElements::scale(double factor) {
    for (Bound& element : elements_)
        if (!element.own.elastic) element.factor *= factor;
}

ElementValues::ElementValues(const BoundElements& elements, std::string_view name, const StateView& at) : system_(at) {
    elements.require_sizes(at);
    const BoundElements::Bound& element = elements.bound(elements.index(name));
    others_ = at.s(element.reads);
    u_ = at.u(element.inputs);
    if (element.sees_all()) {
        view_.emplace(
            ElementView{at.time, at.q, at.qd, at.s.segment(element.first, element.states()), others_, u_, system_});
        return;
    }
    q_ = at.q(element.at);
    qd_ = at.qd(element.at);
    view_.emplace(ElementView{at.time, q_, qd_, at.s.segment(element.first, element.states()), others_, u_, system_});
}

}  // namespace cardan
