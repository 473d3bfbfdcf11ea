#include "elements/machine_elements/pair_law.hpp"

#include "mbs/base/borrowed.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/registers/path_twists.hpp"
#include "mbs/loops/path.hpp"

#include <algorithm>
#include <utility>

namespace cardan {

namespace {

// Memory of one evaluation.
struct PairMemory {
    std::vector<PathStep> path;
    std::vector<PointTwist<double>> twists;    // signed, at the origin of b
    std::vector<UnitWrench<double>> wrenches;  // of the measures
    std::vector<MeasureCurvature> curvatures;
    Matrix gradient, rate_gradient;  // measures x path: dx_i/dq_c, dv_i/dq_c
    Matrix right;
    Vector x, v;
    PairForces forces;
};

UnitWrench<double> wrench_of(const PairMeasure& measure, const FrameEnds<double>& ends) {
    UnitWrench<double> sum = unit_wrench<double>(measure.parts[0], ends);
    sum.force *= measure.weights[0];
    sum.moment *= measure.weights[0];
    if (measure.weights[1] == 0) return sum;
    const UnitWrench<double> more = unit_wrench<double>(measure.parts[1], ends);
    return {sum.force + measure.weights[1] * more.force, sum.moment + measure.weights[1] * more.moment};
}

double value_of_measure(const PairMeasure& measure, const FrameEnds<double>& ends) {
    double sum = measure.weights[0] * measured<double>(measure.parts[0], ends);
    if (measure.weights[1] != 0) sum += measure.weights[1] * measured<double>(measure.parts[1], ends);
    return sum;
}

void add_curvature(MeasureCurvature& sum, const PairMeasure& measure, double factor, const FrameEnds<double>& ends) {
    for (std::size_t i = 0; i < 2; ++i)
        if (measure.weights[i] != 0) sum.add(measure.parts[i], factor * measure.weights[i], ends);
}

// Measures, rates and the law's answer.
void evaluate(const PairLaw& pair, const StateView& at, const FrameEnds<double>& ends, PairMemory& m) {
    const Model& model = at.kinematics.model();
    path_between(model, model.frame(pair.a).body, model.frame(pair.b).body, m.path);
    m.twists.clear();
    RelativeMotion<double> motion;
    for (const PathStep& step : m.path) {
        PointTwist<double> twist = own_twist_at(at.kinematics, step.coordinate, ends.p);
        motion.w += step.sign * at.qd(step.coordinate) * twist.w;
        motion.v += step.sign * at.qd(step.coordinate) * twist.v;
        twist.w *= step.sign;
        twist.v *= step.sign;
        m.twists.push_back(twist);
    }
    const Eigen::Index k = std::ssize(pair.measures);
    m.wrenches.clear();
    m.x.resize(k);
    m.v.resize(k);
    for (Eigen::Index i = 0; i < k; ++i) {
        m.wrenches.push_back(wrench_of(entry(pair.measures, i), ends));
        m.x(i) = value_of_measure(entry(pair.measures, i), ends);
        m.v(i) = m.wrenches.back().on({motion.w, motion.v});
    }
    m.forces.f.setZero(k);
    m.forces.by_x.setZero(k, k);
    m.forces.by_v.setZero(k, k);
    m.forces.energy = 0;
    pair.law(at.time, m.x, m.v, m.forces);
}

// With x_i(q), v_i = x_i,c qd^c:
// dQ_c/dq^d = x_i,c (df_i/dx_j x_j,d + df_i/dv_j dv_j/dq^d) + f_i x_i,cd,   dQ_c/dqd^d = x_i,c df_i/dv_j x_j,d .
void add_derivatives(const PairLaw& pair, const StateView& at, MatrixOut& by_q, MatrixOut& by_qd) {
    Borrowed<PairMemory> borrowed;
    PairMemory& m = *borrowed;
    const FrameEnds<double> ends(at.kinematics, pair.a, pair.b);
    evaluate(pair, at, ends, m);
    const Eigen::Index k = std::ssize(pair.measures), n = std::ssize(m.path);
    m.gradient.resize(k, n);
    m.rate_gradient.setZero(k, n);
    MeasureCurvature bent;  // of the forces
    m.curvatures.assign(pair.measures.size(), {});
    for (Eigen::Index i = 0; i < k; ++i) {
        add_curvature(bent, entry(pair.measures, i), m.forces.f(i), ends);
        add_curvature(entry(m.curvatures, i), entry(pair.measures, i), 1, ends);
        for (Eigen::Index c = 0; c < n; ++c) m.gradient(i, c) = entry(m.wrenches, i).on(entry(m.twists, c));
    }
    for (Eigen::Index c = 0; c < n; ++c)
        for (Eigen::Index d = 0; d < n; ++d) {
            const auto& before = entry(m.twists, std::min(c, d));
            const auto& behind = entry(m.twists, std::max(c, d));
            by_q(entry(m.path, c).coordinate, entry(m.path, d).coordinate) += bent.between(before, behind);
            for (Eigen::Index i = 0; i < k; ++i)
                m.rate_gradient(i, c) +=
                    entry(m.curvatures, i).between(before, behind) * at.qd(entry(m.path, d).coordinate);
        }
    const auto add = [&](MatrixOut& to) {
        for (Eigen::Index c = 0; c < n; ++c)
            for (Eigen::Index d = 0; d < n; ++d)
                to(entry(m.path, c).coordinate, entry(m.path, d).coordinate) += m.gradient.col(c).dot(m.right.col(d));
    };
    m.right.resize(k, n);
    m.right.noalias() = m.forces.by_v.lazyProduct(m.gradient);
    add(by_qd);
    m.right.noalias() = m.forces.by_x.lazyProduct(m.gradient);
    m.right.noalias() += m.forces.by_v.lazyProduct(m.rate_gradient);
    add(by_q);
}

}  // namespace

ForceElement pair_force(const PairLaw& pair) {
    const std::string where = text("'", pair.name, "'");
    if (pair.measures.empty()) throw InputError(where, "number of measures", 0, ">= 1");
    if (!pair.law) throw InputError(where, "law", "missing", "a function");
    if (pair.a == pair.b) throw InputError(where, "frames", "one and the same", "two");
    ForceElement element{.name = pair.name, .points = {{pair.a}, {pair.b}}, .elastic = pair.elastic};
    element.evaluate = [pair](const ElementView& at, ElementForces& out) {
        Borrowed<PairMemory> m;
        const FrameEnds<double> ends(at.system.kinematics, pair.a, pair.b);
        evaluate(pair, at.system, ends, *m);
        Wrench& on_b = out.wrenches[1];
        for (Eigen::Index i = 0; i < m->forces.f.size(); ++i) {
            on_b.force += m->forces.f(i) * entry(m->wrenches, i).force;
            on_b.moment += m->forces.f(i) * entry(m->wrenches, i).moment;
        }
        add_moved(out.wrenches[0], on_b, ends.p, ends.p - ends.d, -1);
    };
    element.jacobian = [pair](const ElementView& at, ElementJacobian& d) {
        add_derivatives(pair, at.system, d.Q_q, d.Q_qd);
    };
    if (pair.has_energy)
        element.potential = [pair](const ElementView& at) {
            Borrowed<PairMemory> m;
            evaluate(pair, at.system, FrameEnds<double>(at.system.kinematics, pair.a, pair.b), *m);
            return m->forces.energy;
        };
    return element;
}

}  // namespace cardan
