// A small rotor with states of first order on its blades and on its support.
#pragma once

#include "mbs/base/decompositions.hpp"
#include "tests/solvers/small_rotor.hpp"

namespace cardan::testing {

// On every blade a lagging damper in flap with two states, and one state of the support beside them.
// @param unit  that of all states is so many times larger: their values are so many times smaller
inline SmallRotor rotor_with_lags(double coupling, int blades = 3, const Vec3& gravity = Vec3::Zero(),
                                  double unit = 1) {
    SmallRotorSpec spec{.stiffness = std::vector<double>(static_cast<std::size_t>(blades), 2000.0),
                        .damping = 2,
                        .hinges = BladeHinges::flap_and_lag,
                        .elastic_support = true,
                        .gravity = gravity};
    spec.more = [coupling, unit](ForceSet& forces, const std::vector<std::vector<BodyId>>& bodies) {
        ForceElement support{.name = "support",
                             .states = {{.name = "support lag", .unit = "N m", .scale = 100 / unit}},
                             .coordinates = {BodyId{0}}};
        support.evaluate = [coupling, unit](const ElementView& in, ElementForces& out) {
            out.Q(0) = -coupling * unit * in.s(0);
            out.f(0) = 800 / unit * in.qd(0) - 3 * in.s(0);
        };
        forces.add_element(support);
        for (std::size_t k = 0; k < bodies.size(); ++k) {
            const int blade = static_cast<int>(k) + 1;
            ForceElement lag{.name = text("blade ", blade, " lag"),
                             .states = {{.name = text("blade ", blade, " first"),
                                         .unit = "N m",
                                         .scale = 50 / unit,
                                         .part = "blade",
                                         .blade = blade},
                                        {.name = text("blade ", blade, " second"),
                                         .unit = "N m",
                                         .scale = 50 / unit,
                                         .part = "blade",
                                         .blade = blade}},
                             .coordinates = {bodies[k][0], bodies[k][1]}};
            lag.evaluate = [coupling, unit](const ElementView& in, ElementForces& out) {
                out.Q(0) = -coupling * unit * in.s(0);
                out.Q(1) = coupling * unit * in.s(1);
                out.f(0) = 900 / unit * in.qd(0) - 4 * in.s(0);
                out.f(1) = 300 / unit * in.q(1) + 2 * in.s(0) - 7 * in.s(1);
            };
            forces.add_element(lag);
        }
    };
    return small_rotor(spec);
}

// x' = A x, x = (q, qd, s).
struct FirstOrder {
    Matrix A;
    Eigen::Index n, m;
};

inline FirstOrder first_order(const solvers::SecondOrderSystem& z) {
    const Eigen::Index n = z.M.rows(), m = z.states.size();
    Matrix A = Matrix::Zero(2 * n + m, 2 * n + m);
    const Eigen::LLT<Matrix> mass(z.M);
    A.block(0, n, n, n).setIdentity();
    A.block(n, 0, n, n) = -Matrix(mass.solve(z.K));
    A.block(n, n, n, n) = -Matrix(mass.solve(z.C));
    A.block(n, 2 * n, n, m) = mass.solve(z.states.Q_s);
    A.block(2 * n, 0, m, n) = z.states.f_q;
    A.block(2 * n, n, m, n) = z.states.f_qd;
    A.block(2 * n, 2 * n, m, m) = z.states.f_s.dense();
    return {A, n, m};
}

}  // namespace cardan::testing
