#include "mbs/system/forces.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/registers/vector_loops.hpp"
#include "mbs/kernels/registers/path_twists.hpp"

namespace cardan {

namespace {

// One run of coefficients after the other: rows of dense matrices of any size, in whole registers.
template <class S, class Run>
CARDAN_INLINE void springs(std::ptrdiff_t n, const Run* run, const double* K, const double* rest, const S* q, S* Q) {
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        Q[run[i].row] -= dot_from(K, q + run[i].column, rest, run[i].size);
        K += run[i].size;
        rest += run[i].size;
    }
}
template <class S, class Run>
CARDAN_INLINE void dampers(std::ptrdiff_t n, const Run* run, const double* D, const S* qd, S* Q) {
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        Q[run[i].row] -= dot(D, qd + run[i].column, run[i].size);
        D += run[i].size;
    }
}

}  // namespace

CARDAN_VECTORISED void Forces::add_springs(std::ptrdiff_t n, const Run* runs, const double* K, const double* rest,
                                           const double* q, double* Q) {
    springs(n, runs, K, rest, q, Q);
}
CARDAN_VECTORISED void Forces::add_dampers(std::ptrdiff_t n, const Run* runs, const double* D, const double* qd,
                                           double* Q) {
    dampers(n, runs, D, qd, Q);
}
void Forces::add_springs(std::ptrdiff_t n, const Run* runs, const double* K, const double* rest, const Complex* q,
                         Complex* Q) {
    springs(n, runs, K, rest, q, Q);
}
void Forces::add_dampers(std::ptrdiff_t n, const Run* runs, const double* D, const Complex* qd, Complex* Q) {
    dampers(n, runs, D, qd, Q);
}

template <class S>
void Forces::require_state(const KinematicsT<S>& kin, VectorInT<S> q, VectorInT<S> qd) const {
    require_model("forces", "kinematics", kin.model().serial(), model_);
    require_size("forces", "q", q, size_);
    require_size("forces", "qd", qd, size_);
}

template <class S>
void Forces::add_laws(VectorInT<S> q, VectorInT<S> qd, VectorOutT<S> Q) const {
    add_springs(std::ssize(springs_.runs), springs_.runs.data(), springs_.values.data(), springs_.rest.data(), q.data(),
                Q.data());
    add_dampers(std::ssize(dampers_.runs), dampers_.runs.data(), dampers_.values.data(), qd.data(), Q.data());
}

void Forces::add_law(const Law& law, const Vector& q, const Vector& qd, Vector& Q) {
    const auto n = std::ssize(law.at);
    for (Eigen::Index j = 0; j < n; ++j) {
        const int b = entry(law.at, j);
        const double x = q(b) - law.rest(j), v = qd(b);
        for (Eigen::Index i = 0; i < n; ++i) Q(entry(law.at, i)) -= law.K(i, j) * x + law.D(i, j) * v;
    }
}

// Every coordinate lifts its subtree as one body: Q_a = M_a g . v_a(C_a). Of the composites only masses and centres are
// needed, a fifth of the work.
template <class S>
void Forces::add_gravity(const KinematicsT<S>& kin, VectorOutT<S> Q) const {
    subtree_centres(kin);
    const Vec3T<S> g = gravity_.template cast<S>();
    for (int a = 0; a < kin.model().size(); ++a) {
        const auto& subtree = entry(kin.arrays().composite, a);
        Q(a) += subtree.M * dot<S>(g, own_twist_at(kin, a, subtree.C.vector()).v);
    }
}

template <class S>
void Forces::add_wrench(const FrameLoad& load, const KinematicsT<S>& kin, double time, VectorOutT<S> Q) const {
    const Pose<S> at = pose(kin, load.frame);
    const Wrench now = load.at(time);
    Vec3T<S> force = now.force.template cast<S>(), moment = now.moment.template cast<S>();
    if (load.axes == WrenchAxes::frame) {
        force = at.R * force;
        moment = at.R * moment;
    }
    for (int a = kin.model().frame(load.frame).body; a >= 0; a = own_parent(kin.model(), a)) {
        const PointTwist<S> t = own_twist_at(kin, a, at.p);
        Q(a) += dot<S>(force, t.v) + dot<S>(moment, t.w);
    }
}

template <class S>
void Forces::generalised_forces_of_laws(const KinematicsT<S>& kin, VectorInT<S> q, VectorInT<S> qd, VectorOutT<S> Q,
                                        double time) const {
    require_state<S>(kin, q, qd);
    require_size("forces", "Q", Q, size_);
    Q.setZero();
    add_laws<S>(q, qd, Q);
    if (has_gravity()) add_gravity<S>(kin, Q);
    for (const FrameLoad& load : loads_) add_wrench<S>(load, kin, time, Q);
}

void Forces::generalised_forces(const StateView& at, VectorOut Q) const {
    require_no_states("forces");
    Vector none;
    VectorOut rates(none);
    generalised_forces_of_laws<double>(at.kinematics, at.q, at.qd, Q, at.time);
    elements_.add_forces(at, Q, rates);
}

void Forces::generalised_forces(const StateView& at, VectorOut Q, VectorOut rates) const {
    generalised_forces_of_laws<double>(at.kinematics, at.q, at.qd, Q, at.time);
    elements_.add_forces(at, Q, rates);
}

void Forces::require_no_states(const char* where) const {
    if (has_states())
        throw InputError(where, "number of states", states().size(), "0: they are not taken into account here");
}

Wrench Forces::at_frame(const FrameLoad& load, const Kinematics& kin, double time) const {
    Wrench own = load.at(time);
    if (load.axes == WrenchAxes::base) return own;
    const Mat3 R = pose(kin, load.frame).R;
    return {R * own.force, R * own.moment};
}

double Forces::dissipation(const Vector& qd) const {
    require_size("dissipation", "qd", qd, size_);
    double power = 0;
    const double* D = dampers_.values.data();
    for (const Run& run : dampers_.runs) {
        power += qd(run.row) * dot(D, qd.data() + run.column, run.size);
        D += run.size;
    }
    return power;
}

double Forces::gravity_energy(const Kinematics& kin) const {
    double energy = 0;
    for (int k = 0; k < kin.model().size(); ++k)
        energy -= kin.model().body(k).inertia.mass * gravity_.dot(kin.centre_of_mass(k));
    return energy;
}

std::vector<ForceReport> Forces::report(const StateView& at) const {
    const double time = at.time;
    const Vector &q = at.q, &qd = at.qd;
    const Kinematics& kin = at.kinematics;
    require_state<double>(kin, q, qd);
    std::vector<ForceReport> reports;
    Vector Q = Vector::Zero(q.size());
    const auto power = [&] {
        const double P = Q.dot(qd);
        Q.setZero();
        return P;
    };
    for (const Law& law : laws_) {
        Vector x(law.K.rows());
        for (Eigen::Index i = 0; i < x.size(); ++i) x(i) = q(entry(law.at, i)) - law.rest(i);
        add_law(law, q, qd, Q);
        reports.push_back({law.name, x.dot(law.K * x) / 2, power()});
    }
    if (has_gravity()) {
        add_gravity<double>(kin, Q);
        reports.push_back({"gravity", gravity_energy(kin), power()});
    }
    for (const FrameLoad& load : loads_) {
        add_wrench<double>(load, kin, time, Q);
        std::optional<double> energy;  // only a dead force has a potential
        if (load.axes == WrenchAxes::base && load.wrench.moment.isZero(0) && !load.over_time)
            energy = -load.wrench.force.dot(pose(kin, load.frame).p);
        reports.push_back({load.name, energy, power()});
    }
    for (int i = 0; i < elements_.size(); ++i)
        if (!elements_[i].power)
            reports.push_back({elements_[i].name, elements_.potential(i, at), elements_.forces(i, at).dot(qd)});
    return reports;
}

double Forces::potential_energy(const StateView& at) const {
    double sum = 0;
    for (const ForceReport& element : report(at)) sum += element.energy.value_or(0.0);
    return sum;
}

StateEnergy Forces::state_energy(const StateView& at) const {
    return elements_.energy(at);
}

Vec3 place_of(const Kinematics& kin, const FramePoint& point) {
    const Pose<double> frame = pose(kin, point.frame);
    return frame.p + frame.R * point.place;
}

template void Forces::require_state<double>(const KinematicsT<double>&, VectorInT<double>, VectorInT<double>) const;
template void Forces::generalised_forces_of_laws<double>(const KinematicsT<double>&, VectorInT<double>,
                                                         VectorInT<double>, VectorOutT<double>, double) const;
template void Forces::generalised_forces_of_laws<Complex>(const KinematicsT<Complex>&, VectorInT<Complex>,
                                                          VectorInT<Complex>, VectorOutT<Complex>, double) const;

}  // namespace cardan
