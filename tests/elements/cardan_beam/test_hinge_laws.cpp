// The laws of the hinges at large angles: exact derivatives, agreement at rest, gain in accuracy.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/linear/modes.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/elements/cardan_beam/rods.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/random_tree.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

// Shear-flexible elements have an energy that is not quadratic even without a law for large angles.
constexpr std::array<HingeLaw, 3> laws{HingeLaw{.isotropic = true}, HingeLaw{.section_frame = true},
                                       HingeLaw{.isotropic = true, .section_frame = true}};

// Everything coupled.
EngineeringSection general_section() {
    EngineeringSection s;
    s.mass = 2, s.j_flap = 0.01, s.j_edge = 0.03;
    s.EA = 60, s.GJ = 0.8, s.EI_flap = 1, s.EI_edge = 4, s.GA_y = 30, s.GA_z = 20;
    s.beta = 0.3;
    s.shear_centre = {0.05, -0.02}, s.tension_centre = {-0.03, 0.04};
    return s;
}

CardanBeamOptions bent(int elements, HingeLaw law, bool extension = true) {
    CardanBeamOptions options = all_free(elements);
    options.extension = extension;
    options.hinge_law = law;
    return options;
}

struct Beam {
    Tree tree;
    ForceSet forces;
    CardanBeam beam;
    System system;
    Workspace workspace;

    Beam(const EngineeringSection& section, const CardanBeamOptions& options)
        : beam(add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, section), "beam", {"beam"}, options)),
          system(tree, forces),
          workspace(system.model) {}
    Vector zero() const { return Vector::Zero(system.model.size()); }
    double energy(const Vector& q) {
        return system.forces.potential_energy({{.q = q, .qd = zero()}, kinematics(system.model, q, workspace)});
    }
    Vector force(const Vector& q) {
        Vector Q = zero();
        system.forces.generalised_forces({{.q = q, .qd = zero()}, kinematics(system.model, q, workspace)}, Q);
        return Q;
    }
    Matrix stiffness(const Vector& q) {
        ForceDerivatives d;
        system.forces.derivatives({{.q = q, .qd = zero()}, kinematics(system.model, q, workspace)}, d);
        CHECK(d.loads.isZero(0));  // a spring, not a load
        return d.elastic;
    }
    // Coordinate of element 1.
    double& at(Vector& q, ElementCoordinate kind) const {
        const CardanBeam::Element& element = beam.elements[0];
        const auto i = std::find(element.kinds.begin(), element.kinds.end(), kind) - element.kinds.begin();
        return q(system.model.index(entry(element.bodies, i)));
    }
};

// Derivative of f along direction i: central differences of order 6.
template <class F>
auto differenced(const F& f, const Vector& q, Eigen::Index i, double h) {
    const auto odd = [&](double k) {
        Vector plus = q, minus = q;
        plus(i) += k * h, minus(i) -= k * h;
        return decltype(f(q))(f(plus) - f(minus));
    };
    return decltype(f(q))((45 * odd(1) - 9 * odd(2) + odd(3)) / (60 * h));
}

// Swing vector of a rotation: turns x to R x about an axis across both.
Vec3 swing_vector(const Mat3& R) {
    const Vec3 d = R.col(0), axis(0, -d.z(), d.y());
    return axis.norm() > 0 ? Vec3(axis * std::atan2(axis.norm(), d.x()) / axis.norm()) : axis;
}

double tip_error(const oracles::RodSection& section, const Vec3& force, int elements, double delta, HingeLaw law) {
    const oracles::TwistedRod rod{.section = [section](double) { return section; }, .steps = 256};
    oracles::RodLoad load;
    load.force = force;
    const Vec3 exact = oracles::RodSolution(rod.rod(), load).tip().position;
    CardanBeamOptions options = bent(elements, law, false);
    options.delta = delta;
    Tree tree;
    ForceSet forces;
    const CardanBeam beam = add_cardan_beam(tree, forces, Tree::base(), line_of(rod), "beam", {"beam"}, options);
    Vector q;
    Vec3 tip;
    constexpr int steps = 5;
    for (int i = 1; i <= steps; ++i) {
        ForceSet loads = forces;
        loads.add_wrench({"tip force", beam.tip(), {force * i / steps, Vec3::Zero()}, WrenchAxes::base});
        const System system(tree, loads);
        solvers::SteadyOptions steady;
        steady.initial = q;
        const solvers::SteadyState state = solvers::steady_state(system, -1, steady);
        INFO(state.message);
        REQUIRE(state.converged);
        q = state.at.q;
        Workspace workspace(system.model);
        tip = pose(kinematics(system.model, q, workspace), beam.tip()).p;
    }
    return (tip - exact).norm();
}

struct Errors {
    std::vector<double> of;  // N = 3, 6, 12
    double order() const { return std::log2(of[1] / of[2]); }
};
Errors tip_errors(const oracles::RodSection& section, const Vec3& force, double delta, HingeLaw law) {
    Errors e;
    for (int n : {3, 6, 12}) e.of.push_back(tip_error(section, force, n, delta, law));
    return e;
}

}  // namespace

TEST_CASE("hinge law: forces are the gradient of the energy, the Jacobian is that of the forces", "[property]") {
    Random random(41);
    for (const HingeLaw& law : {laws[0], laws[1], laws[2], HingeLaw{}}) {
        Beam beam(general_section(), bent(2, law));
        const auto n = beam.system.model.size();
        // Up to 1 rad; about the place where the series gives way to the closed form (0.2 rad); small; none.
        for (const double size : {1.0, 1.0, 0.6, 0.2, 1e-2, 1e-4, 0.0}) {
            const Vector q = Vector::NullaryExpr(n, [&] { return size * uniform(random, -1, 1); });
            const Vector Q = beam.force(q);
            const Matrix K = beam.stiffness(q);
            for (Eigen::Index i = 0; i < n; ++i) {
                const double slope = differenced([&](const Vector& x) { return beam.energy(x); }, q, i, 4e-3);
                const Vector column = differenced([&](const Vector& x) { return beam.force(x); }, q, i, 4e-3);
                CAPTURE(law.isotropic, law.section_frame, size, i);
                CHECK(std::abs(slope + Q(i)) < 1e-9 * (K.norm() + Q.norm()));
                CHECK((column + K.col(i)).norm() < 1e-9 * K.norm());
            }
            CHECK((K - K.transpose()).norm() < 1e-14 * K.norm());
        }
    }
}

TEST_CASE("hinge law: its forces and stiffness are evaluated without allocation", "[property]") {
    if (!AllocationGuard::works()) return;
    for (const HingeLaw& law : {laws[2], HingeLaw{}}) {
        Tree tree;
        ForceSet forces;
        add_cardan_beam(tree, forces, Tree::base(), uniform_beam(2, general_section()), "beam", {"beam"}, bent(3, law));
        const System system(tree, forces);
        const Vector q = Vector::Constant(system.model.size(), 0.1), qd = Vector::Zero(q.size());
        Vector Q(q.size());
        Workspace workspace(system.model);
        const Kinematics kin = kinematics(system.model, q, workspace);
        ForceDerivatives derivatives;
        system.forces.derivatives({{.q = q, .qd = qd}, kin}, derivatives);
        const State state{.q = q, .qd = qd};
        CHECK(allocations([&] { system.forces.generalised_forces({state, kin}, Q); }) == 0);
        CHECK(allocations([&] { system.forces.derivatives({state, kin}, derivatives); }) == 0);
    }
}

TEST_CASE("hinge law: at rest it is the linear law, and to first order about it", "[property]") {
    Beam linear(general_section(), bent(3, {}));
    const Matrix K = linear.stiffness(linear.zero());
    Random random(42);
    const Vector q = Vector::NullaryExpr(linear.system.model.size(), [&] { return 1e-5 * uniform(random, -1, 1); });
    for (const HingeLaw& law : laws) {
        Beam beam(general_section(), bent(3, law));
        CHECK((beam.stiffness(beam.zero()) - K).norm() < 1e-12 * K.norm());
        CHECK(beam.force(beam.zero()).norm() == 0);
        CHECK((beam.force(q) - linear.force(q)).norm() < 1e-4 * linear.force(q).norm());
        CHECK(beam.energy(q) == Approx(linear.energy(q)).epsilon(1e-4));
    }
}

TEST_CASE("hinge law: frequencies at rest do not depend on it", "[property]") {
    const BeamLine line = uniform_beam(1, general_section());
    const std::vector<double> omega = clamped_frequencies(line, bent(3, {}));
    for (const HingeLaw& law : laws) {
        const std::vector<double> same = clamped_frequencies(line, bent(3, law));
        REQUIRE(same.size() == omega.size());
        for (std::size_t i = 0; i < omega.size(); ++i) CHECK(same[i] == Approx(omega[i]).epsilon(1e-10));
    }
}

TEST_CASE("hinge law: isotropic, the arguments of the springs are the swing vectors of the two joints", "[analytic]") {
    EngineeringSection section = general_section();
    section.GA_y = section.GA_z = std::numeric_limits<double>::infinity();
    Beam beam(section, bent(1, {.isotropic = true}));
    const Mat6 K = beam.beam.elements[0].flexibility.inverse();
    Random random(43);
    for (int i = 0; i < 20; ++i) {
        const Vec6 a = Vec6::NullaryExpr([&] { return uniform(random, -1.2, 1.2); });
        Vector q = beam.zero();
        for (int k = 0; k < 6; ++k) beam.at(q, static_cast<ElementCoordinate>(k)) = a(k);
        // From B1 to the middle and from the middle to B4; each swing seen from the terminal body.
        const Vec3 first = swing_vector(rot_y(a(2)) * rot_z(a(4)));
        const Vec3 second = -swing_vector((rot_z(a(5)) * rot_y(a(3))).transpose());
        Vec6 y;
        y << a(0), a(1), first.y(), second.y(), first.z(), second.z();
        CHECK(beam.energy(q) == Approx(y.dot(K * y) / 2).epsilon(1e-12));
    }
}

TEST_CASE("hinge law: isotropic, a round beam stores the same energy whichever way its hinges bend", "[property]") {
    EngineeringSection s;
    s.mass = 1, s.j_flap = s.j_edge = 0.01, s.GJ = 0.8, s.EI_flap = s.EI_edge = 1;
    for (const bool isotropic : {true, false}) {
        Beam beam(s, bent(1, {.isotropic = isotropic}, false));
        std::vector<double> energy;
        constexpr double bend = 0.8;
        for (double direction : {0.0, 0.4, 0.9, 1.4}) {
            // Both hinges turn x by `bend` toward the direction.
            const Vec3 d(std::cos(bend), std::sin(bend) * std::cos(direction), std::sin(bend) * std::sin(direction));
            Vector q = beam.zero();
            using enum ElementCoordinate;
            beam.at(q, az1) = beam.at(q, az2) = std::asin(d.y());
            beam.at(q, ay1) = beam.at(q, ay2) = -std::atan2(d.z(), d.x());
            energy.push_back(beam.energy(q));
        }
        const auto [min, most] = std::minmax_element(energy.begin(), energy.end());
        if (isotropic)
            CHECK(*most - *min < 1e-13 * *most);
        else
            CHECK(*most - *min > 0.01 * *most);
    }
}

TEST_CASE("hinge law: isotropic, a round beam bent diagonally gains two orders with delta = 1/6",
          "[analytic][discrete]") {
    // Dead tip force between y and z; torsionally stiff or soft, it does not matter.
    const HingeLaw isotropic{.isotropic = true};
    for (const double GJ : {1.0, 1e3}) {
        const oracles::RodSection round{.GJ = GJ, .j_y = 0.01, .j_z = 0.01};
        // Two digits from another implementation.
        const Errors linear = tip_errors(round, {0, 2, 2}, sixth, {}),
                     swing = tip_errors(round, {0, 2, 2}, sixth, isotropic);
        CAPTURE(linear.of, swing.of, linear.order(), swing.order());
        CHECK(linear.of[0] == Approx(4.2e-3).margin(0.5e-4));
        CHECK(swing.of[0] == Approx(1.8e-4).margin(0.5e-5));
        CHECK(linear.order() == Approx(2).margin(0.05));
        CHECK(swing.order() == Approx(4).margin(0.05));
    }
    const oracles::RodSection round{.GJ = 1, .j_y = 0.01, .j_z = 0.01};
    const Vec3 large = Vec3(0, 5, 5) / std::sqrt(2.0);
    const Errors linear = tip_errors(round, large, sixth, {}), swing = tip_errors(round, large, sixth, isotropic);
    CHECK(swing.of[0] < 0.07 * linear.of[0]);
    CHECK(swing.order() == Approx(4).margin(0.05));
    // At the Gauss points bending in a plane is of order 2 at large angles: the law gains a factor only.
    const Errors gauss = tip_errors(round, large, delta_gauss, {}),
                 gauss_swing = tip_errors(round, large, delta_gauss, isotropic);
    CAPTURE(linear.of, swing.of, gauss.of, gauss_swing.of);
    CHECK(gauss_swing.of[0] < 0.3 * gauss.of[0]);
    CHECK(gauss_swing.order() == Approx(2).margin(0.05));
}

TEST_CASE("hinge law: in the section's frame, unequal stiffnesses with torsion keep order 2 and gain a factor 3",
          "[analytic][discrete]") {
    const oracles::RodSection flat{.GJ = 0.8, .EI_y = 1, .EI_z = 4, .j_y = 0.01, .j_z = 0.01};
    for (const double delta : {sixth, delta_gauss}) {
        const auto errors = [&](HingeLaw law) { return tip_errors(flat, {0, 4, 1.5}, delta, law); };
        const Errors linear = errors({}), frame = errors({.section_frame = true}), both = errors(laws[2]);
        CAPTURE(delta, linear.of, frame.of, both.of);
        if (delta < 0.2) {  // two digits from another implementation
            CHECK(linear.of[0] == Approx(2.0e-2).margin(0.5e-3));
            CHECK(frame.of[0] == Approx(6.3e-3).margin(0.5e-4));
        }
        CHECK(frame.of[0] < 0.33 * linear.of[0]);
        CHECK(both.of[0] < 0.46 * linear.of[0]);  // the swing vectors do not help here
        CHECK(both.of[0] > frame.of[0]);
        for (const Errors& e : {linear, frame, both}) CHECK(e.order() == Approx(2).margin(0.05));
    }
}
