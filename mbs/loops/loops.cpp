#include "mbs/loops/loops.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <utility>

namespace cardan {

namespace {

constexpr const char* in_loops = "loops";
constexpr std::array<char, 3> axis_names = {'x', 'y', 'z'};

const char* name_of(CutKind kind) {
    switch (kind) {
        case CutKind::revolute:
            return "revolute";
        case CutKind::prismatic:
            return "prismatic";
        case CutKind::cylindrical:
            return "cylindrical";
        case CutKind::cardan:
            return "cardan";
        case CutKind::spherical:
            return "spherical";
        case CutKind::planar:
            return "planar";
        case CutKind::weld:
            break;
    }
    return "weld";
}

}  // namespace

using Kind = RelativeMeasure::Kind;

// ---- what it is made of

Loops::Loops(const LoopSet& set, const Model& model) : model_(model.serial()), coordinates_(model.size()) {
    involved_.assign(static_cast<std::size_t>(model.size()), false);
    for (const CutJoint& joint : set.joints()) {
        const bool aligned = joint.kind != CutKind::spherical && joint.kind != CutKind::cardan;
        const bool fixed = joint.kind == CutKind::weld || joint.kind == CutKind::prismatic;
        std::vector<RelativeMeasure> equations;
        if (joint.kind != CutKind::planar) equations = {{Kind::along, 0}, {Kind::along, 1}};
        if (joint.kind != CutKind::prismatic && joint.kind != CutKind::cylindrical)
            equations.push_back({Kind::along, 2});
        if (aligned) equations.insert(equations.end(), {{Kind::square, 0, 2}, {Kind::square, 1, 2}});
        if (fixed) equations.push_back({Kind::square, 0, 1});
        if (joint.kind == CutKind::cardan) equations.push_back({Kind::square, 0, 1});
        add_loop(joint.name, model, {joint.a, joint.b, -1, -1, 0, -1, aligned, fixed, {}, equations, size()});
        places_.back() = text(name_of(joint.kind), " joint ", places_.back());
    }
    for (const FixedDistance& rod : set.distances()) {
        add_loop(rod.name, model, {rod.a, rod.b, -1, -1, rod.length, -1, false, false, {}, {{Kind::distance}}, size()});
        places_.back() = text("rod ", places_.back());
    }
    for (const PointOnSurface& contact : set.surfaces()) {
        const int index = static_cast<int>(surfaces_.size());
        surfaces_.push_back(contact);
        add_loop(contact.name, model,
                 {contact.surface, contact.point, -1, -1, 0, index, false, false, {}, {{}}, size()});
        places_.back() = text("surface ", places_.back());
    }
    for (const Coupling& coupling : set.couplings()) {
        Linear linear{{}, coupling.offset, size()};
        std::string place = "coupling of";
        for (const auto& [body, factor] : coupling.factors) {
            const int at = model.index(body);
            linear.factors.emplace_back(at, factor);
            involved_[static_cast<std::size_t>(at)] = true;
            place += text(" '", model.coordinates()[at].name, "'");
        }
        couplings_.push_back(std::move(linear));
        add_equation(coupling.name, coupling.unit);  // before the name: it counts those there are
        names_.push_back(coupling.name);
        places_.push_back(std::move(place));
        first_.push_back(size());
    }
    for (const UserConstraint& user : set.users()) {
        users_.push_back({user, size()});
        involved_.assign(involved_.size(), true);
        add_equation(user.name, user.unit);
        names_.push_back(user.name);
        places_.emplace_back("constraint of one's own");
        first_.push_back(size());
    }
}

void Loops::add_loop(const std::string& name, const Model& model, Loop loop) {
    loop.body_a = model.frame(loop.a).body;
    loop.body_b = model.frame(loop.b).body;
    const auto body_name = [&](int body) { return body < 0 ? std::string("base") : model.body(body).name; };
    const std::string bodies = text("between '", body_name(loop.body_a), "' and '", body_name(loop.body_b), "'");
    path_between(model, loop.body_a, loop.body_b, loop.path);
    if (loop.path.empty())
        throw InputError(text("loop '", name, "' ", bodies), "number of coordinates that move it", 0,
                         ">= 1: frames of two bodies");
    for (const PathStep& step : loop.path) involved_[static_cast<std::size_t>(step.coordinate)] = true;
    for (const RelativeMeasure& equation : loop.equations) {
        const char i = entry(axis_names, equation.i), j = entry(axis_names, equation.j);
        if (loop.surface >= 0)
            add_equation(text(name, ": on the surface"), "m");
        else if (equation.kind == Kind::along)
            add_equation(text(name, ": ", i, " together"), "m");
        else if (equation.kind == Kind::square)
            add_equation(text(name, ": ", i, " square to ", j), "1");
        else
            add_equation(text(name, ": length"), "m");
    }
    names_.push_back(name);
    places_.push_back(bodies);
    loops_.push_back(std::move(loop));
    first_.push_back(size());
}

void Loops::add_equation(const std::string& name, std::string unit) {
    equations_.push_back({name, std::move(unit), static_cast<int>(names_.size())});
}

const std::string& Loops::name(int loop) const {
    require_index(in_loops, "loop", loop, std::ssize(names_));
    return entry(names_, loop);
}

std::string Loops::describe(int loop) const {
    return text("'", name(loop), "' (", entry(places_, loop), ")");
}

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
void Loops::residual(const KinematicsT<S>& kin, [[maybe_unused]] double time, VectorInT<S> q, VectorOutT<S> phi) const {
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
    if constexpr (std::is_same_v<S, double>)
        for_each_user(time, q, [&](int k, const ConstraintTerms& terms) { phi(k) = terms.value; });
}

template <class S>
void Loops::gradient(const KinematicsT<S>& kin, [[maybe_unused]] double time, VectorInT<S> q, MatrixOutT<S> G) const {
    check<S>(kin, q);
    require_size(in_loops, "gradient", G, size(), coordinates_);
    G.setZero();
    for (const Loop& loop : loops_) {
        const FrameEnds<S> ends(kin, loop.a, loop.b);
        for (int k = loop.first; const RelativeMeasure& equation : loop.equations) {
            const UnitWrench<S> pair = wrench<S>(loop, equation, ends);
            for (const PathStep& step : loop.path) {
                const PointTwist<S> twist = own_twist_at<S>(kin, step.coordinate, ends.p);
                G(k, step.coordinate) = step.sign * pair.on(twist);
            }
            ++k;
        }
    }
    for (const Linear& linear : couplings_)
        for (const auto& [at, factor] : linear.factors) G(linear.equation, at) = factor;
    if constexpr (std::is_same_v<S, double>)
        for_each_user(time, q, [&](int k, const ConstraintTerms& terms) { G.row(k) = terms.gradient.transpose(); });
}

void Loops::gradient(const Kinematics& kin, double time, VectorIn q, MatrixOut G, MatrixOut magnitudes) const {
    gradient<double>(kin, time, q, magnitudes);
    require_size(in_loops, "gradient", G, size(), coordinates_);
    G = magnitudes;
    magnitudes = G.cwiseAbs();
    for (const Loop& loop : loops_) {
        const FrameEnds<double> ends(kin, loop.a, loop.b);
        for (int k = loop.first; const RelativeMeasure& equation : loop.equations) {
            const UnitWrench<double> pair = wrench<double>(loop, equation, ends);
            // Directions are square to one another where the equation is met.
            const bool directions = loop.surface < 0 && equation.kind == Kind::square;
            const double force = pair.force.norm(), moment = directions ? 1 : 0;
            for (const PathStep& step : loop.path) {
                const PointTwist<double> twist = own_twist_at<double>(kin, step.coordinate, ends.p);
                magnitudes(k, step.coordinate) = moment * twist.w.norm() + force * twist.v.norm();
            }
            ++k;
        }
    }
}

void Loops::time_rates(double time, VectorIn q, VectorOut out) const {
    require_size(in_loops, "rates", out, size());
    require_size(in_loops, "q", q, coordinates_);
    out.setZero();
    for_each_user(time, q, [&](int k, const ConstraintTerms& terms) { out(k) = terms.rate; });
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

double Loops::extent(const Kinematics& kin) const {
    double largest = 1;
    for (const Loop& loop : loops_) {
        const FrameEnds<double> ends(kin, loop.a, loop.b);
        largest = std::max({largest, ends.p.norm(), (ends.p - ends.d).norm()});
    }
    return largest;
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
