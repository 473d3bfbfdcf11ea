#include "elements/electric/detail/element_values.hpp"

#include "mbs/base/entry.hpp"

namespace cardan::detail {

namespace {

template <class List, class Value>
Vector gather(const List& list, const Value& value) {
    Vector out(std::ssize(list));
    for (Eigen::Index i = 0; i < out.size(); ++i) out(i) = value(entry(list, i));
    return out;
}

}  // namespace

ElementValues::ElementValues(const StateElement& element, const DynamicView& in)
    : time_(in.time),
      q_(gather(element.coordinates, [&](BodyId at) { return in.q(in.kinematics.model().index(at)); })),
      qd_(gather(element.coordinates, [&](BodyId at) { return in.qd(in.kinematics.model().index(at)); })),
      s_(gather(element.states, [&](const StateInfo& state) { return in.s(in.forces.states().index(state.name)); })),
      others_(gather(element.reads, [&](const std::string& name) { return in.s(in.forces.states().index(name)); })),
      u_(gather(element.inputs, [&](const std::string& name) { return in.u(in.forces.inputs().index(name)); })) {}

}  // namespace cardan::detail
