// A random tree at a random state, with some coordinates driven if asked for.
#pragma once

#include "mbs/kernels/metric.hpp"
#include "tests/support/random_tree.hpp"

namespace cardan::testing {

struct SampledTree {
    explicit SampledTree(unsigned seed, RandomTreeOptions options = {})
        : random(seed),
          model(random_tree(random, options)),
          workspace(model),
          n(model.size()),
          q(random_state(random, n)),
          qd(random_state(random, n, 2)),
          qdd(random_state(random, n, 3)),
          kin(kinematics(model, q, workspace)) {}
    SampledTree(const SampledTree&) = delete;
    SampledTree& operator=(const SampledTree&) = delete;

    Matrix g() const {
        Matrix m(n, n);
        metric(kin, m);
        return m;
    }
    Vector vector(double size = 1) { return random_state(random, n, size); }
    std::vector<bool> some_driven(double share) {
        std::vector<bool> driven(static_cast<std::size_t>(n));
        for (std::size_t k = 0; k < driven.size(); ++k) driven[k] = uniform(random, 0, 1) < share;
        return driven;
    }

    Random random;
    Model model;
    Workspace workspace;
    int n;
    Vector q, qd, qdd;
    Kinematics kin;  ///< at q
};

inline std::vector<int> indices_of(const std::vector<bool>& flags, bool value) {
    std::vector<int> at;
    for (std::size_t k = 0; k < flags.size(); ++k)
        if (flags[k] == value) at.push_back(static_cast<int>(k));
    return at;
}

inline double largest(const Matrix& m) {
    return m.size() == 0 ? 0.0 : m.cwiseAbs().maxCoeff();
}

}  // namespace cardan::testing
