#include "tests/support/random_tree.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <Eigen/Geometry>

namespace cardan::testing {

double uniform(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

Vec3 random_vector(Random& random, double size) {
    return size * Vec3(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
}

Mat3 random_rotation(Random& random) {
    std::normal_distribution<double> normal;
    Eigen::Quaterniond q(normal(random), normal(random), normal(random), normal(random));
    return q.normalized().toRotationMatrix();
}

Placement random_placement(Random& random) {
    return {random_rotation(random), random_vector(random)};
}

RigidInertia random_inertia(Random& random) {
    // A few point masses about the centre: an inertia tensor that exists.
    RigidInertia inertia;
    inertia.mass = uniform(random, 0.5, 2);
    inertia.com = random_vector(random);
    for (int i = 0; i < 4; ++i) {
        const Vec3 x = random_vector(random, 0.7);
        inertia.J += 0.3 * inertia.mass * (x.squaredNorm() * Mat3::Identity() - x * x.transpose());
    }
    return inertia;
}

Vector random_state(Random& random, int n, double size) {
    Vector x(n);
    for (int i = 0; i < n; ++i) x(i) = uniform(random, -size, size);
    return x;
}

Matrix random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns) {
    return random_state(random, static_cast<int>(rows * columns)).reshaped(rows, columns);
}

Mat6 random_added_mass(Random& random) {
    const Matrix root = random_matrix(random, 6, 1 + static_cast<int>(uniform(random, 0, 6)));
    const Mat6 A = root * root.transpose();
    return (A + A.transpose()) / 2;
}

Tree random_tree(Random& random, const RandomTreeOptions& options) {
    const int n = options.bodies;
    std::vector<int> parent(static_cast<std::size_t>(n));
    std::vector<bool> leaf(static_cast<std::size_t>(n), true);
    for (int k = 0; k < n; ++k) {
        // Mostly chains, sometimes branches, sometimes further children of the base.
        const double choice = uniform(random, 0, 1);
        const int p = k == 0 || choice < 0.05 ? -1
                      : choice < 0.65         ? k - 1
                                              : std::uniform_int_distribution<int>(0, k - 1)(random);
        entry(parent, k) = p;
        if (p >= 0) entry(leaf, p) = false;
    }
    Tree tree;
    std::vector<BodyId> ids;
    // At most two massless bodies in a row: four prismatic joints with one mass would be truly singular.
    std::vector<int> massless_run(static_cast<std::size_t>(n), 0);
    for (int k = 0; k < n; ++k) {
        const std::size_t i = static_cast<std::size_t>(k);
        BodySpec spec;
        spec.name = text("body ", k);
        spec.inboard = parent[i] < 0 ? Tree::base() : tree.frame_of(entry(ids, parent[i]));
        spec.placement = random_placement(random);
        if (parent[i] >= 0 && uniform(random, 0, 1) < options.coincident) spec.placement.p.setZero();
        spec.joint = uniform(random, 0, 1) < options.prismatic ? JointKind::prismatic : JointKind::revolute;
        const int run = parent[i] < 0 ? 0 : entry(massless_run, parent[i]);
        if (leaf[i] || run == 2 || uniform(random, 0, 1) >= options.massless)
            spec.inertia = random_inertia(random);
        else
            massless_run[i] = run + 1;
        if (k < options.driven) spec.coordinate.role = CoordinateRole::prescribed;
        ids.push_back(tree.add_body(spec));
    }
    if (options.armatures && n > 3) {
        tree.add_armature({"single", 0.7, {{ids[1], 1.0}}});
        std::vector<std::pair<BodyId, double>> spin;
        for (int k = n - 1; k >= 0 && spin.size() < 3; k = entry(parent, k))
            spin.emplace_back(entry(ids, k), uniform(random, -2, 2));
        tree.add_armature({"geared", 1.3, spin});
    }
    for (int k = 0; options.added_mass > 0 && k < n; ++k) {
        if (uniform(random, 0, 1) >= options.added_mass) continue;
        const FrameId at = tree.add_frame(tree.frame_of(entry(ids, k)), random_placement(random), text("water ", k));
        tree.add_added_mass({text("water ", k), at, random_added_mass(random)});
    }
    return tree;
}

ForceSet random_forces(Random& random, const Tree& tree) {
    ForceSet forces;
    const int n = static_cast<int>(tree.bodies().size());
    for (int k = 0; k < n; k += 2)
        forces.add_spring(text("spring ", k), BodyId{k}, uniform(random, 1, 5), uniform(random, 0.1, 1),
                          uniform(random, -1, 1));
    const int m = std::min(n, 6);
    const Matrix A = Matrix::NullaryExpr(m, m, [&] { return uniform(random, -1, 1); });
    LinearLaw law{"coupled", {}, A * A.transpose(), 0.1 * A * A.transpose(), random_state(random, m)};
    for (int k = 0; k < m; ++k) law.coordinates.push_back(BodyId{n - 1 - k});
    forces.add_law(law);
    forces.set_gravity(random_vector(random, 5));
    for (const WrenchAxes axes : {WrenchAxes::base, WrenchAxes::frame})
        forces.add_wrench({axes == WrenchAxes::base ? "dead" : "follower",
                           tree.frame_of(BodyId{n - 1 - (axes == WrenchAxes::base ? 0 : n / 2)}),
                           {random_vector(random, 3), random_vector(random, 3)},
                           axes});
    return forces;
}

}  // namespace cardan::testing
