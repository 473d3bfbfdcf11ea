#include "mbs/loops/loop_set.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>

namespace cardan {

void LoopSet::require_new(const std::string& name) const {
    if (name.empty()) throw InputError("loop", "name", "''", "one that is not empty");
    const auto taken = [&](const auto& list) {
        return std::ranges::any_of(list, [&](const auto& other) { return other.name == name; });
    };
    if (taken(joints_) || taken(distances_) || taken(surfaces_) || taken(couplings_) || taken(users_) || taken(locks_))
        throw InputError(text("loop '", name, "'"), "name", name, "one that no other loop has");
}

void LoopSet::add_joint(CutJoint joint) {
    require_new(joint.name);
    if (joint.a == joint.b)
        throw InputError(text("loop '", joint.name, "'"), "frames", "one and the same", "two, of different bodies");
    joints_.push_back(std::move(joint));
}

void LoopSet::add_distance(FixedDistance rod) {
    require_new(rod.name);
    require_positive(text("loop '", rod.name, "'"), "length [m]", rod.length);
    distances_.push_back(std::move(rod));
}

void LoopSet::add_surface(PointOnSurface contact) {
    require_new(contact.name);
    if (!contact.value || !contact.gradient || !contact.second)
        throw InputError(text("loop '", contact.name, "'"), "functions of the surface", "missing",
                         "value, gradient and second");
    surfaces_.push_back(std::move(contact));
}

void LoopSet::add_coupling(Coupling coupling) {
    const std::string where = text("loop '", coupling.name, "'");
    require_new(coupling.name);
    if (coupling.factors.empty()) throw InputError(where, "number of coordinates", 0, ">= 1");
    for (std::size_t i = 0; i < coupling.factors.size(); ++i) {
        const auto& [body, factor] = coupling.factors[i];
        if (!std::isfinite(factor) || factor == 0) throw InputError(where, "factor", factor, "finite and not zero");
        const auto again = [&, id = body](const auto& other) { return other.first == id; };
        if (std::any_of(coupling.factors.begin(), coupling.factors.begin() + static_cast<std::ptrdiff_t>(i), again))
            throw InputError(where, "number of a body that occurs twice", body.index, "each once");
    }
    if (!std::isfinite(coupling.offset)) throw InputError(where, "offset", coupling.offset, "finite");
    couplings_.push_back(std::move(coupling));
}

void LoopSet::add_user(UserConstraint constraint) {
    require_new(constraint.name);
    if (!constraint.terms) throw InputError(text("loop '", constraint.name, "'"), "function", "missing", "one");
    users_.push_back(std::move(constraint));
}

void LoopSet::add_lock(Lock lock) {
    require_new(lock.name);
    if (!lock.state) throw InputError(text("loop '", lock.name, "'"), "state of the lock", "missing", "one");
    locks_.push_back(std::move(lock));
}

}  // namespace cardan
