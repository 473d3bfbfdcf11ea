// A random tree under forces of one's choice, at a random state.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/system/system.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"

namespace cardan::testing {

/// A random tree of 8 bodies at a random state under some forces.
class ForcedTree : public State {
public:
    ForcedTree(unsigned seed, const std::function<void(ForcedTree&, ForceSet&)>& fill)
        : random(seed), tree(random_tree(random, {.bodies = 8})), system_(make(fill)), workspace_(system_.model) {
        time = 0.7;
        q = random_state(random, n), qd = random_state(random, n);
    }
    const Model& model() const { return system_.model; }
    const Forces& forces() const { return system_.forces; }
    Kinematics kin() { return kinematics(system_.model, q, workspace_); }
    Vector Q(const Forces& of) {
        Vector out(n);
        of.generalised_forces({*this, kin()}, out);
        return out;
    }
    Vector Q() { return Q(forces()); }
    double energy_at(const Vector& at) {
        Workspace own(model());
        State moved = *this;
        moved.q = at;
        return forces().potential_energy({moved, kinematics(model(), at, own)});
    }
    std::vector<ForceReport> report() { return forces().report({*this, kin()}); }
    FrameId frame(int body) const { return tree.frame_of(BodyId{body}); }
    // A frame somewhere on the body that most joints carry.
    FrameId add_tip() {
        int deepest = 0, most = 0;
        for (int k = 0; k < n; ++k) {
            int depth = 0;
            for (int a = k; a >= 0; a = entry(tree.bodies(), a).parent) ++depth;
            if (depth > most) most = depth, deepest = k;
        }
        return tree.add_frame(frame(deepest), random_placement(random), "tip");
    }

    static constexpr int n = 8;
    Random random;
    Tree tree;

private:
    System make(const std::function<void(ForcedTree&, ForceSet&)>& fill) {
        ForceSet set;
        fill(*this, set);
        return {tree, set};
    }
    System system_;
    Workspace workspace_;
};

/// -dV/dq by central differences of sixth order (errors h^6 and rounding / h).
inline Vector minus_energy_gradient(ForcedTree& s) {
    constexpr double step = 5e-3;
    Vector gradient(s.n);
    for (int j = 0; j < s.n; ++j) {
        const auto V = [&](int steps) { return s.energy_at(s.q + steps * step * Vector::Unit(s.n, j)); };
        gradient(j) = (45 * (V(1) - V(-1)) - 9 * (V(2) - V(-2)) + (V(3) - V(-3))) / (60 * step);
    }
    return -gradient;
}

}  // namespace cardan::testing
