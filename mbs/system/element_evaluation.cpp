// Forces, derivatives and energy of the elements at a state.
#include "mbs/base/borrowed.hpp"
#include "mbs/kernels/registers/kernel_arrays.hpp"
#include "mbs/system/bound_elements.hpp"

#include <algorithm>
#include <optional>

namespace cardan {

namespace {

using VectorMap = Eigen::Map<Vector>;
using MatrixMap = Eigen::Map<Matrix>;

struct Memory {
    std::vector<double> values, results, matrix;
    std::vector<Wrench> wrenches, bodies;
    State moved;
};

}  // namespace

// Three sets of results, of rows() each: one for the evaluation, two for differences. What an element sees of all
// coordinates and of its states it sees in place; the rest is gathered.
class BoundElements::Local {
public:
    Local(const Bound& element, int coordinates)
        : element_(element),
          nq_(element.sees_all() ? coordinates : std::ssize(element.at)),
          ns_(element.states()),
          no_(std::ssize(element.reads)),
          nu_(std::ssize(element.inputs)) {
        grow(memory_->values, 2 * nq_ + no_ + nu_);
        grow(memory_->results, 3 * rows());
        memory_->wrenches.resize(element.own.points.size());
    }

    Eigen::Index rows() const { return nq_ + ns_; }
    Eigen::Index columns() const { return 2 * nq_ + ns_ + no_ + nu_; }
    VectorMap result(int set) { return {memory_->results.data() + set * rows(), rows()}; }
    auto Q(int set = 0) { return result(set).head(nq_); }
    auto f(int set = 0) { return result(set).tail(ns_); }
    const std::vector<Wrench>& wrenches() { return memory_->wrenches; }

    ElementView view(const StateView& at) {
        double* next = memory_->values.data();
        const auto gather = [&](const Vector& from, const std::vector<int>& places) {
            VectorMap map(next, std::ssize(places));
            for (const int i : places) *next++ = from(i);
            return map;
        };
        const VectorMap others = gather(at.s, element_.reads), u = gather(at.u, element_.inputs);
        if (element_.sees_all()) return {at.time, at.q, at.qd, at.s.segment(element_.first, ns_), others, u, at};
        const VectorMap q = gather(at.q, element_.at), qd = gather(at.qd, element_.at);
        return {at.time, q, qd, at.s.segment(element_.first, ns_), others, u, at};
    }

    // Generalised forces, those of the wrenches among them, and rates.
    void evaluate(const StateView& at, int set = 0) {
        result(set).setZero();
        std::ranges::fill(memory_->wrenches, Wrench{});
        ElementForces out{Q(set), f(set), memory_->wrenches};
        element_.own.evaluate(view(at), out);
        if (element_.sees_all()) add_wrenches(at.kinematics, out.Q);
    }

    // Derivatives of the whole element into `J`, which are zero.
    void differentiate(const StateView& at, ElementJacobian& J, const BoundElements& all) {
        if (element_.own.jacobian) element_.own.jacobian(view(at), J);
        if (!element_.own.jacobian || element_.own.differences_by_inputs) difference(at, J, all);
    }

    double* zeros(Eigen::Index size) {
        grow(memory_->matrix, size);
        std::fill_n(memory_->matrix.begin(), size, 0.0);
        return memory_->matrix.data();
    }

private:
    template <class T>
    static void grow(std::vector<T>& memory, Eigen::Index size) {
        if (std::ssize(memory) < size) memory.resize(static_cast<std::size_t>(size));
    }

    // The wrenches of a body about its joint's origin; from the tips down, every joint takes its share and passes on.
    void add_wrenches(const Kinematics& kin, VectorOut& Q) {
        const KernelArrays& ws = kin.arrays();
        std::vector<Wrench>& bodies = memory_->bodies;
        bodies.assign(static_cast<std::size_t>(nq_), {});
        for (std::size_t i = 0; i < memory_->wrenches.size(); ++i) {
            const int body = element_.bodies[i];
            if (body < 0) continue;
            const Vec3 arm = entry(ws.frame, body).E.matrix() * element_.places[i];
            add_moved(entry(bodies, body), memory_->wrenches[i], arm, Vec3::Zero());
        }
        for (Eigen::Index k = nq_ - 1; k >= 0; --k) {
            const Wrench& sum = entry(bodies, k);
            const KernelArrays::Frame& frame = entry(ws.frame, k);
            const Model::Link& link = entry(kin.model().links(), k);
            Q(k) += frame.E[2].vector().dot(link.revolute ? sum.moment : sum.force);
            if (link.parent >= 0)
                add_moved(entry(bodies, link.parent), sum, frame.o.vector(), entry(ws.frame, link.parent).o.vector());
        }
    }

    void difference(const StateView& at, ElementJacobian& J, const BoundElements& all) {
        const bool only_inputs = element_.own.differences_by_inputs;
        const double step = only_inputs ? 1e-4 : 1e-6;
        State& moved = memory_->moved;
        moved.time = at.time;
        moved.q = at.q;
        moved.qd = at.qd;
        moved.s = at.s;
        moved.u = at.u;
        std::optional<Workspace> workspace;  // the caller's kinematics must stay valid
        if (element_.sees_all() && !only_inputs) workspace.emplace(at.kinematics.model());
        const auto add = [&](double& value, double h, bool moves, auto Q_x, auto f_x) {
            const double middle = value;
            const auto evaluate_at = [&](double x, int set) {
                value = x;
                if (moves && workspace)
                    evaluate({moved, cardan::kinematics(at.kinematics.model(), moved.q, *workspace)}, set);
                else
                    evaluate({moved, at.kinematics}, set);
                return value;
            };
            const double above = evaluate_at(middle + h, 1), below = evaluate_at(middle - h, 2);
            value = middle;
            Q_x += (Q(1) - Q(2)) / (above - below);
            f_x += (f(1) - f(2)) / (above - below);
        };
        const auto place = [&](Eigen::Index i) {
            return element_.sees_all() ? i : Eigen::Index(entry(element_.at, i));
        };
        for (Eigen::Index i = 0; i < nu_; ++i) {
            const int input = entry(element_.inputs, i);
            add(moved.u(input), step * all.inputs_[input].scale, false, J.Q_u.col(i), J.f_u.col(i));
        }
        if (only_inputs) return;
        for (Eigen::Index i = 0; i < nq_; ++i) {
            add(moved.q(place(i)), step, true, J.Q_q.col(i), J.f_q.col(i));
            add(moved.qd(place(i)), step, false, J.Q_qd.col(i), J.f_qd.col(i));
        }
        for (Eigen::Index i = 0; i < ns_; ++i) {
            const int at_state = element_.first + static_cast<int>(i);
            add(moved.s(at_state), step * all.states_[at_state].scale, false, J.Q_s.col(i), J.f_s.col(i));
        }
        for (Eigen::Index i = 0; i < no_; ++i) {
            const int read = entry(element_.reads, i);
            add(moved.s(read), step * all.states_[read].scale, false, J.Q_others.col(i), J.f_others.col(i));
        }
    }

    const Bound& element_;
    Eigen::Index nq_, ns_, no_, nu_;
    Borrowed<Memory> memory_;
};

void BoundElements::add_forces(const StateView& at, VectorOut& Q, VectorOut& rates) const {
    require_sizes(at);
    require_size("force elements", "Q", Q, size_);
    require_size("force elements", "rates", rates, states_.size());
    for (const Bound& element : elements_) {
        Local local(element, size_);
        local.evaluate(at);
        const auto own = local.Q();
        if (element.sees_all())
            Q += element.factor * own;
        else
            for (Eigen::Index i = 0; i < own.size(); ++i) Q(entry(element.at, i)) += element.factor * own(i);
        rates.segment(element.first, element.states()) = local.f();
    }
}

std::vector<Wrench> BoundElements::wrenches(int i, const StateView& at) const {
    require_sizes(at);
    const Bound& element = bound(i);
    if (element.own.points.empty()) return {};
    Local local(element, size_);
    local.evaluate(at);
    std::vector<Wrench> out = local.wrenches();
    for (Wrench& w : out) w = {element.factor * w.force, element.factor * w.moment};
    return out;
}

Vector BoundElements::forces(int i, const StateView& at) const {
    require_sizes(at);
    const Bound& element = bound(i);
    Local local(element, size_);
    local.evaluate(at);
    if (element.sees_all()) return element.factor * local.Q();
    Vector Q = Vector::Zero(size_);
    for (Eigen::Index k = 0; k < local.Q().size(); ++k) Q(entry(element.at, k)) += element.factor * local.Q()(k);
    return Q;
}

std::optional<double> BoundElements::potential(int i, const StateView& at) const {
    require_sizes(at);
    const Bound& element = bound(i);
    if (!element.own.potential) return std::nullopt;
    Local local(element, size_);
    return element.factor * element.own.potential(local.view(at));
}

void BoundElements::derivatives(const StateView& at, Matrix& elastic, Matrix& loads, Matrix& damping,
                                StateDerivatives& out) const {
    require_sizes(at);
    const int m = states_.size(), u = inputs_.size();
    out.Q_s.setZero(size_, m);
    out.f_q.setZero(m, size_);
    out.f_qd.setZero(m, size_);
    out.f_s.setZero(m, m);
    out.Q_u.setZero(size_, u);
    out.f_u.setZero(m, u);
    for (const Bound& element : elements_)
        add_derivatives(element, at, element.own.elastic ? elastic : loads, damping, out);
}

void BoundElements::add_derivatives(const Bound& element, const StateView& at, Matrix& stiffness, Matrix& damping,
                                    StateDerivatives& out) const {
    Local local(element, size_);
    const Eigen::Index ns = element.states(), no = std::ssize(element.reads), nu = std::ssize(element.inputs);
    const int first = element.first;
    if (element.sees_all()) {
        // The rows of its states are its own, in place; the forces add to those of others.
        const Eigen::Index n = size_, s = 2 * n, o = s + ns, u = o + no;
        double* const memory = local.zeros(n * (u + nu) + ns * (no + nu));
        MatrixMap Q(memory, n, u + nu), f_more(memory + n * (u + nu), ns, no + nu);
        ElementJacobian J{Q.middleCols(0, n),
                          Q.middleCols(n, n),
                          Q.middleCols(s, ns),
                          Q.middleCols(o, no),
                          Q.middleCols(u, nu),
                          out.f_q.middleRows(first, ns),
                          out.f_qd.middleRows(first, ns),
                          out.f_s.block(first, first, ns, ns),
                          f_more.leftCols(no),
                          f_more.rightCols(nu)};
        local.differentiate(at, J, *this);
        stiffness -= element.factor * Q.middleCols(0, n);
        damping -= element.factor * Q.middleCols(n, n);
        out.Q_s.middleCols(first, ns) += element.factor * Q.middleCols(s, ns);
        for (Eigen::Index i = 0; i < no; ++i) {
            out.Q_s.col(entry(element.reads, i)) += element.factor * Q.col(o + i);
            out.f_s.col(entry(element.reads, i)).segment(first, ns) += f_more.col(i);
        }
        for (Eigen::Index i = 0; i < nu; ++i) {
            out.Q_u.col(entry(element.inputs, i)) += element.factor * Q.col(u + i);
            out.f_u.col(entry(element.inputs, i)).segment(first, ns) += f_more.col(no + i);
        }
        return;
    }
    const Eigen::Index nq = std::ssize(element.at), s = 2 * nq, o = s + ns, u = o + no;
    MatrixMap all(local.zeros(local.rows() * local.columns()), local.rows(), local.columns());
    ElementJacobian J{all.block(0, 0, nq, nq),   all.block(0, nq, nq, nq), all.block(0, s, nq, ns),
                      all.block(0, o, nq, no),   all.block(0, u, nq, nu),  all.block(nq, 0, ns, nq),
                      all.block(nq, nq, ns, nq), all.block(nq, s, ns, ns), all.block(nq, o, ns, no),
                      all.block(nq, u, ns, nu)};
    local.differentiate(at, J, *this);
    // A column of the element's matrix into columns of the system's.
    const auto add = [&](Eigen::Index from, Matrix& by_Q, double factor, Matrix& by_f, int to) {
        for (Eigen::Index i = 0; i < nq; ++i) by_Q(entry(element.at, i), to) += factor * all(i, from);
        for (Eigen::Index i = 0; i < ns; ++i) by_f(first + i, to) += all(nq + i, from);
    };
    Eigen::Index column = 0;
    for (const int to : element.at) add(column++, stiffness, -element.factor, out.f_q, to);
    for (const int to : element.at) add(column++, damping, -element.factor, out.f_qd, to);
    for (int i = 0; i < ns; ++i) add(column++, out.Q_s, element.factor, out.f_s, first + i);
    for (const int to : element.reads) add(column++, out.Q_s, element.factor, out.f_s, to);
    for (const int to : element.inputs) add(column++, out.Q_u, element.factor, out.f_u, to);
}

StateEnergy BoundElements::energy(const StateView& at) const {
    require_sizes(at);
    StateEnergy sum;
    for (const Bound& element : elements_) {
        if (!element.own.power) continue;
        Local local(element, size_);
        const ElementPower own = element.own.power(local.view(at));
        sum.stored += own.stored;
        sum.supplied += own.supplied;
        sum.dissipated += own.dissipated;
        local.evaluate(at);
        const auto Q = local.Q();
        for (Eigen::Index i = 0; i < Q.size(); ++i)
            sum.work += Q(i) * at.qd(element.sees_all() ? i : entry(element.at, i));
    }
    return sum;
}

}  // namespace cardan
