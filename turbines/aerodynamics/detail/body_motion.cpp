#include "turbines/aerodynamics/detail/body_motion.hpp"

#include "mbs/base/registers/packed.hpp"
#include "mbs/base/registers/vectorised.hpp"

#include <algorithm>

namespace cardan::turbines {

namespace {

using Packed = Packed3<double>;

// Angular velocities and velocities of the joints' origins, from the base out. Those of the body before stay in
// registers for the next one, which it carries as a rule.
CARDAN_VECTORISED void find_rates(std::size_t count, const int* bodies, const Model::Link* links,
                                  const KernelArrays::Frame* frames, const double* qd, BodyRate* rates) {
    int last = -1;
    Packed w = Packed::zero(), v = w, o = w;
    for (std::size_t i = 0; i < count; ++i) {
        const int k = bodies[i];
        const Model::Link& link = links[k];
        const KernelArrays::Frame& frame = frames[k];
        if (link.parent != last) {
            const bool on_base = link.parent < 0;
            w = on_base ? Packed::zero() : Packed::of(rates[link.parent].angular);
            v = on_base ? Packed::zero() : Packed::of(rates[link.parent].origin);
            o = on_base ? Packed::zero() : frames[link.parent].o;
        }
        v += cross(w, frame.o - o);
        (link.revolute ? w : v) += qd[k] * frame.E[2];
        o = frame.o;
        rates[k] = {w.vector(), v.vector()};
        last = k;
    }
}

}  // namespace

BodyMotion::BodyMotion(const StateView& at, std::span<const int> bodies, std::vector<BodyRate>& rates)
    : kin_(at.kinematics), rates_(rates) {
    rates_.resize(static_cast<std::size_t>(model().size()));
    find_rates(bodies.size(), bodies.data(), model().links().data(), kin_.arrays().frame.data(), at.qd.data(),
               rates_.data());
}

Mat3 BodyMotion::rotation(int body) const {
    return body < 0 ? Mat3(Mat3::Identity()) : entry(kin_.arrays().frame, body).E.matrix();
}

Vec3 BodyMotion::place(int body, const Vec3& in_body) const {
    if (body < 0) return in_body;
    const auto& frame = entry(kin_.arrays().frame, body);
    return frame.o.vector() + frame.E.matrix() * in_body;
}

Mover BodyMotion::mover(int coordinate) const {
    const auto& frame = entry(kin_.arrays().frame, coordinate);
    const Vec3 e = frame.E[2].vector(), o = frame.o.vector();
    const BodyRate& rate = entry(rates_, coordinate);
    const Vec3 linear = rate.origin - cross<double>(rate.angular, o);
    if (entry(model().links(), coordinate).revolute) return {e, cross<double>(o, e), rate.angular, linear};
    return {Vec3::Zero(), e, rate.angular, linear};
}

int BodyMotion::depth(int body) const {
    return body < 0 ? 0 : entry(model().links(), body).depth;
}

std::vector<int> path_to(const Model& model, int body) {
    std::vector<int> path;
    for (int at = body; at >= 0; at = model.body(at).parent) path.push_back(at);
    std::reverse(path.begin(), path.end());
    return path;
}

void add_row(const Model& model, const std::vector<Mover>& movers, int b, const std::vector<int>& columns,
             const Columns6& sum_q, const Columns6& sum_qd, const Vec6& wrench, MatrixOut by_q, MatrixOut by_qd) {
    const Mover& own = entry(movers, b);
    Vec6 S;
    S << own.w, own.v;
    for (const int a : columns) {
        double value = S.dot(sum_q.col(a));
        if (a < b && model.precedes(a, b)) {
            const Mover& first = entry(movers, a);
            Vec6 turned;
            turned << cross<double>(first.w, own.w), cross<double>(first.w, own.v) + cross<double>(first.v, own.w);
            value += turned.dot(wrench);
        }
        by_q(b, a) += value;
        by_qd(b, a) += S.dot(sum_qd.col(a));
    }
}

}  // namespace cardan::turbines
