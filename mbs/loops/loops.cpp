#include "mbs/loops/loops.hpp"

#include "mbs/base/error.hpp"
#include "mbs/kernels/extent.hpp"
#include "mbs/kernels/registers/path_twists.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace cardan {

namespace {

constexpr const char* in_loops = "loops";
// What rounding leaves of an equation that is as good as met, over the size of what it compares.
constexpr double closest = 16 * std::numeric_limits<double>::epsilon();
// Of the forms of which the equations of one loop are made.
constexpr std::size_t max_equations = 6;

bool turns(const Kinematics& kin, const PathStep& step) {
    return entry(kin.model().links(), step.coordinate).revolute;
}

}  // namespace

using Kind = RelativeMeasure::Kind;

// ---- equations

template <class S>
void Loops::check(const KinematicsT<S>& kin, VectorInT<S> q) const {
    require_model(in_loops, "kinematics", kin.model().serial(), model_);
    require_size(in_loops, "q", q, coordinates_);
    if constexpr (!std::is_same_v<S, double>)
        if (!users_.empty() || !surfaces_.empty())
            throw InputError(in_loops, "constraints of one's own", users_.size() + surfaces_.size(),
                             "none: they are known for real numbers only");
}

template <class S>
S Loops::value(const Loop& loop, const RelativeMeasure& equation, const FrameEnds<S>& ends) const {
    if (loop.surface < 0) return measured<S>(equation, ends) - loop.length;
    if constexpr (std::is_same_v<S, double>)
        return entry(surfaces_, loop.surface).value(ends.A.transpose() * ends.d);
    else
        return S(0);
}

template <class S>
UnitWrench<S> Loops::wrench(const Loop& loop, const RelativeMeasure& equation, const FrameEnds<S>& ends) const {
    if (loop.surface < 0) return unit_wrench<S>(equation, ends);
    if constexpr (std::is_same_v<S, double>)
        return {ends.A * entry(surfaces_, loop.surface).gradient(ends.A.transpose() * ends.d), Vec3::Zero()};
    else
        return {};
}

// Second derivatives of a surface by places, base axes.
Mat3 Loops::surface_bend(const Loop& loop, const FrameEnds<double>& ends) const {
    return ends.A * entry(surfaces_, loop.surface).second(ends.A.transpose() * ends.d) * ends.A.transpose();
}

template <class Visit>
void Loops::for_each_user(double time, VectorIn q, const Visit& visit) const {
    if (users_.empty()) return;
    const Vector at = q;
    for (const User& user : users_) {
        ConstraintTerms terms;
        terms.gradient.setZero(coordinates_);
        terms.gradient_rate.setZero(coordinates_);
        terms.second.setZero(coordinates_, coordinates_);
        user.own.terms(time, at, terms);
        require_size(in_loops, "gradient of a constraint of one's own", terms.gradient, coordinates_);
        require_size(in_loops, "its rate", terms.gradient_rate, coordinates_);
        require_size(in_loops, "second derivatives of a constraint of one's own", terms.second, coordinates_,
                     coordinates_);
        visit(user.equation, terms);
    }
}

template <class S>
void Loops::residual(const KinematicsT<S>& kin, double time, VectorInT<S> q, VectorOutT<S> phi) const {
    check<S>(kin, q);
    require_size(in_loops, "phi", phi, size());
    for (const Loop& loop : loops_) {
        const FrameEnds<S> ends(kin, loop.a, loop.b);
        for (int k = loop.first; const RelativeMeasure& equation : loop.equations)
            phi(k++) = value<S>(loop, equation, ends);
    }
    for (const Linear& linear : couplings_) {
        S sum = -linear.offset;
        for (const auto& [at, factor] : linear.factors) sum += factor * q(at);
        phi(linear.equation) = sum;
    }
    for (const Held& held : locks_) {
        const LockState& lock = *held.state;
        const double wanted = lock.position + lock.rate * (time - lock.since);
        phi(held.equation) = lock.engaged ? q(held.coordinate) - wanted : S(0);
    }
    if constexpr (std::is_same_v<S, double>)
        for_each_user(time, q, [&](int k, const ConstraintTerms& terms) { phi(k) = terms.value; });
}

// Every coordinate of every equation of joints, rods and surfaces.
template <class S, class Visit>
void Loops::for_each_entry(const KinematicsT<S>& kin, const Visit& visit) const {
    for (const Loop& loop : loops_) {
        const FrameEnds<S> ends(kin, loop.a, loop.b);
        for (int k = loop.first; const RelativeMeasure& equation : loop.equations) {
            const UnitWrench<S> pair = wrench<S>(loop, equation, ends);
            for (const PathStep& step : loop.path) visit(k, step, pair, own_twist_at<S>(kin, step.coordinate, ends.p));
            ++k;
        }
    }
}

template <class S>
void Loops::add_linear_rows([[maybe_unused]] double time, [[maybe_unused]] VectorInT<S> q, MatrixOutT<S> G) const {
    for (const Linear& linear : couplings_)
        for (const auto& [at, factor] : linear.factors) G(linear.equation, at) = factor;
    for (const Held& held : locks_) G(held.equation, held.coordinate) = held.state->engaged ? 1 : 0;
    if constexpr (std::is_same_v<S, double>)
        for_each_user(time, q, [&](int k, const ConstraintTerms& terms) { G.row(k) = terms.gradient.transpose(); });
}

template <class S>
void Loops::gradient(const KinematicsT<S>& kin, double time, VectorInT<S> q, MatrixOutT<S> G) const {
    check<S>(kin, q);
    require_size(in_loops, "gradient", G, size(), coordinates_);
    G.setZero();
    for_each_entry<S>(kin, [&](int k, const PathStep& step, const UnitWrench<S>& pair, const PointTwist<S>& twist) {
        G(k, step.coordinate) = step.sign * pair.on(twist);
    });
    add_linear_rows<S>(time, q, G);
}

void Loops::gradient(const Kinematics& kin, double time, VectorIn q, MatrixOut G, MatrixOut magnitudes) const {
    check<double>(kin, q);
    require_size(in_loops, "gradient", G, size(), coordinates_);
    require_size(in_loops, "magnitudes", magnitudes, size(), coordinates_);
    G.setZero();
    add_linear_rows<double>(time, q, G);
    magnitudes = G.cwiseAbs();
    for (const Loop& loop : loops_) {
        const FrameEnds<double> ends(kin, loop.a, loop.b);
        std::array<UnitWrench<double>, max_equations> pairs;
        for (std::size_t i = 0; i < loop.equations.size(); ++i)
            pairs[i] = wrench<double>(loop, loop.equations[i], ends);
        double longest = 0;
        for (const PathStep& step : loop.path) {
            const PointTwist<double> twist = own_twist_at<double>(kin, step.coordinate, ends.p);
            if (turns(kin, step)) longest = std::max(longest, twist.v.norm());
            for (std::size_t i = 0; i < loop.equations.size(); ++i)
                G(loop.first + static_cast<int>(i), step.coordinate) = step.sign * pairs[i].on(twist);
        }
        for (std::size_t i = 0; i < loop.equations.size(); ++i) {
            // Directions are square to one another where the equation is met.
            const bool directions = loop.surface < 0 && loop.equations[i].kind == Kind::square;
            const double turning = directions ? 1 : pairs[i].force.norm() * longest;
            const double sliding = directions ? 0 : pairs[i].force.norm();
            for (const PathStep& step : loop.path)
                magnitudes(loop.first + static_cast<int>(i), step.coordinate) = turns(kin, step) ? turning : sliding;
        }
    }
}

void Loops::time_rates(double time, VectorIn q, VectorOut out) const {
    require_size(in_loops, "rates", out, size());
    require_size(in_loops, "q", q, coordinates_);
    out.setZero();
    for_each_user(time, q, [&](int k, const ConstraintTerms& terms) { out(k) = terms.rate; });
    for (const Held& held : locks_)
        if (held.state->engaged) out(held.equation) = -held.state->rate;
}

template <class S>
void Loops::bias(const KinematicsT<S>& kin, [[maybe_unused]] double time, VectorInT<S> q, VectorInT<S> qd,
                 VectorOutT<S> out) const {
    check<S>(kin, q);
    require_size(in_loops, "qd", qd, coordinates_);
    require_size(in_loops, "bias", out, size());
    out.setZero();
    for (const Loop& loop : loops_) {
        const FrameEnds<S> ends(kin, loop.a, loop.b);
        RelativeMotion<S> b;
        for (const PathStep& step : loop.path)
            b.append(own_twist_at<S>(kin, step.coordinate, ends.p), step.sign * qd(step.coordinate));
        if constexpr (std::is_same_v<S, double>)
            if (loop.surface >= 0) {
                const Vec3 f = wrench<double>(loop, loop.equations[0], ends).force;
                out(loop.first) = f.dot(b.a) + b.v.dot(surface_bend(loop, ends) * b.v);
                continue;
            }
        for (int k = loop.first; const RelativeMeasure& equation : loop.equations)
            out(k++) = cardan::bias<S>(equation, ends, b);
    }
    if constexpr (std::is_same_v<S, double>)
        for_each_user(time, q, [&](int k, const ConstraintTerms& terms) {
            out(k) = qd.dot(terms.second * qd) + 2 * terms.gradient_rate.dot(qd) + terms.rate_rate;
        });
}

void Loops::add_second_gradient(const Kinematics& kin, double time, VectorIn q, VectorIn factors, MatrixOut H) const {
    check<double>(kin, q);
    require_size(in_loops, "factors", factors, size());
    require_size(in_loops, "second gradient", H, coordinates_, coordinates_);
    for (const Loop& loop : loops_) {
        const FrameEnds<double> ends(kin, loop.a, loop.b);
        MeasureCurvature curvature;
        if (loop.surface >= 0) {
            const double factor = factors(loop.first);
            curvature.force = factor * wrench<double>(loop, loop.equations[0], ends).force;
            curvature.bend = factor * surface_bend(loop, ends);
        } else {
            for (int k = loop.first; const RelativeMeasure& equation : loop.equations)
                curvature.add(equation, factors(k++), ends);
        }
        for (std::size_t i = 0; i < loop.path.size(); ++i) {
            const PathStep& before = loop.path[i];
            const PointTwist<double> b = own_twist_at<double>(kin, before.coordinate, ends.p);
            for (std::size_t j = i; j < loop.path.size(); ++j) {
                const PathStep& behind = loop.path[j];
                const double second = before.sign * behind.sign *
                                      curvature.between(b, own_twist_at<double>(kin, behind.coordinate, ends.p));
                H(before.coordinate, behind.coordinate) += second;
                if (i != j) H(behind.coordinate, before.coordinate) += second;
            }
        }
    }
    for_each_user(time, q, [&](int k, const ConstraintTerms& terms) { H += factors(k) * terms.second; });
}

// ---- what they mean

int Loops::turned_over(const Kinematics& kin) const {
    require_model(in_loops, "kinematics", kin.model().serial(), model_);
    for (int i = 0; const Loop& loop : loops_) {
        const FrameEnds<double> ends(kin, loop.a, loop.b);
        if ((loop.aligned && ends.A.col(2).dot(ends.B.col(2)) < 0) ||
            (loop.same_x && ends.A.col(0).dot(ends.B.col(0)) < 0))
            return i;
        ++i;
    }
    return -1;
}

double Loops::size_of(const Loop& loop, const Kinematics& kin, VectorIn q, const FrameEnds<double>& ends) const {
    double size = loop.length;
    for (const PathStep& step : loop.path) {
        const PointTwist<double> twist = own_twist_at<double>(kin, step.coordinate, ends.p);
        size = std::max(size, turns(kin, step) ? twist.v.norm() : std::abs(q(step.coordinate)));
    }
    return size;
}

void Loops::tolerances(const Kinematics& kin, double time, VectorIn q, double fraction, VectorOut out) const {
    check<double>(kin, q);
    require_size(in_loops, "tolerances", out, size());
    for (const Loop& loop : loops_) {
        const FrameEnds<double> ends(kin, loop.a, loop.b);
        const double far = std::max(ends.p.norm(), (ends.p - ends.d).norm()), length = size_of(loop, kin, q, ends);
        for (int k = loop.first; const RelativeMeasure& equation : loop.equations) {
            const bool directions = loop.surface < 0 && equation.kind == Kind::square;
            const double size = directions ? 1 : length;
            out(k++) = std::max({fraction * size, closest * (directions ? 1 : std::max(far, length)),
                                 std::numeric_limits<double>::min()});
        }
    }
    if (couplings_.empty() && locks_.empty() && users_.empty()) return;
    const double tree = extent(kin);
    const auto of_coordinate = [&](int at) {
        const bool angle = entry(kin.model().links(), at).revolute;
        return std::max(std::abs(q(at)), angle ? 1.0 : tree);
    };
    const auto set = [&](int equation, double size) {
        out(equation) = std::max(std::max(fraction, closest) * size, std::numeric_limits<double>::min());
    };
    for (const Linear& linear : couplings_) {
        double sum = std::abs(linear.offset);
        for (const auto& [at, factor] : linear.factors) sum += std::abs(factor) * of_coordinate(at);
        set(linear.equation, sum);
    }
    for (const Held& held : locks_) set(held.equation, of_coordinate(held.coordinate));
    for_each_user(time, q, [&](int k, const ConstraintTerms& terms) {
        double sum = 0;
        for (int a = 0; a < coordinates_; ++a) sum += std::abs(terms.gradient(a)) * of_coordinate(a);
        set(k, sum);
    });
}

bool Loops::holds_directions(int pair) const {
    const Loop& loop = entry(loops_, pair);
    return loop.surface < 0 &&
           std::ranges::any_of(loop.equations, [](const RelativeMeasure& m) { return m.kind == Kind::square; });
}

Mat3 Loops::axes(const Kinematics& kin, int pair) const {
    return pose<double>(kin, entry(loops_, pair).a).R;
}

double Loops::rod_tension(const Kinematics& kin, int pair, const LoopLoad& on_b) const {
    const FrameEnds<double> ends(kin, entry(loops_, pair).a, entry(loops_, pair).b);
    return -on_b.force.dot(ends.d) / ends.length();
}

LoopLoad Loops::reaction(const Kinematics& kin, int loop, VectorIn lambda) const {
    require_model(in_loops, "kinematics", kin.model().serial(), model_);
    require_size(in_loops, "multipliers", lambda, size());
    if (loop < 0 || loop >= std::ssize(loops_))
        throw InputError(in_loops, "loop with a force", loop,
                         text("0 ... ", std::ssize(loops_) - 1, ": joints, rods and surfaces"));
    const Loop& own = entry(loops_, loop);
    const FrameEnds<double> ends(kin, own.a, own.b);
    LoopLoad load{own.body_b, ends.p, Vec3::Zero(), Vec3::Zero()};
    for (int k = own.first; const RelativeMeasure& equation : own.equations) {
        const UnitWrench<double> pair = wrench<double>(own, equation, ends);
        load.force += lambda(k) * pair.force;
        load.moment += lambda(k) * pair.moment;
        ++k;
    }
    return load;
}

void Loops::add_loads(const Kinematics& kin, VectorIn lambda, std::vector<LoopLoad>& out) const {
    for (int i = 0; i < static_cast<int>(loops_.size()); ++i) {
        const LoopLoad load = reaction(kin, i, lambda);
        out.push_back(load);
        out.push_back({entry(loops_, i).body_a, load.point, -load.force, -load.moment});
    }
}

template void Loops::residual<double>(const Kinematics&, double, VectorIn, VectorOut) const;
template void Loops::gradient<double>(const Kinematics&, double, VectorIn, MatrixOut) const;
template void Loops::bias<double>(const Kinematics&, double, VectorIn, VectorIn, VectorOut) const;
template void Loops::residual<Complex>(const KinematicsT<Complex>&, double, VectorInT<Complex>,
                                       VectorOutT<Complex>) const;
template void Loops::gradient<Complex>(const KinematicsT<Complex>&, double, VectorInT<Complex>,
                                       MatrixOutT<Complex>) const;
template void Loops::bias<Complex>(const KinematicsT<Complex>&, double, VectorInT<Complex>, VectorInT<Complex>,
                                   VectorOutT<Complex>) const;

}  // namespace cardan
