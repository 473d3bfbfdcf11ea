#include "solvers/equilibrium/load_curve.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "mbs/kernels/extent.hpp"
#include "solvers/equilibrium/detail/closed_start.hpp"
#include "solvers/linear/loop_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace cardan::solvers {

namespace {

constexpr const char* in_load_curve = "load curve";

void check(const System& system, const LoadCurveOptions& options) {
    if (!std::isfinite(options.from) || !std::isfinite(options.to) || options.from == options.to)
        throw InputError(in_load_curve, "load factors", text(options.from, ", ", options.to), "finite and different");
    require_positive(in_load_curve, "first step", options.first_step);
    require_positive(in_load_curve, "largest step", options.largest_step);
    require_positive(in_load_curve, "smallest step", options.smallest_step);
    if (options.points < 1) throw InputError(in_load_curve, "number of points", options.points, ">= 1");
    if (options.state.trim) throw InputError(in_load_curve, "trim", "given", "none");
    system.forces.require_no_states(in_load_curve);
}

// A point of the curve as one vector: unknown coordinates over their units, multipliers of the loops' independent
// equations, and the load factor over its range.
class Curve {
public:
    Curve(const System& system, const LoadCurveOptions& options)
        : system_(system),
          options_(options),
          unknowns_(system.model.coordinates().free_without(options.spin)),
          workspace_(system.model) {}

    // The first equilibrium.
    bool start(Vector& z, std::string& message) {
        const System loaded = under_load(system_, options_.from, options_.gravity);
        const SteadyState found = steady_state(loaded, options_.spin, options_.state);
        if (!found.converged) {
            message = text(in_load_curve, ": no state at the first load factor ", options_.from, ": ", found.message);
            return false;
        }
        at_ = found.at;
        if (!system_.loops.empty())
            equations_ = loop_start(system_, options_.spin, 0, at_.q, Vector::Zero(at_.q.size())).equations;
        set_units();
        z.resize(size());
        for (Eigen::Index i = 0; i < coordinates(); ++i) z(i) = at_.q(entry(unknowns_, i)) / units_(i);
        for (Eigen::Index k = 0; k < multipliers(); ++k) z(coordinates() + k) = at_.lambda(entry(equations_, k));
        z(size() - 1) = options_.from / range();
        return true;
    }

    Eigen::Index coordinates() const { return std::ssize(unknowns_); }
    Eigen::Index multipliers() const { return std::ssize(equations_); }
    Eigen::Index size() const { return coordinates() + multipliers() + 1; }
    double range() const { return std::abs(options_.to - options_.from); }
    double factor(const Vector& z) const { return z(size() - 1) * range(); }

    // Residual and its derivative, the last column by the load; rows: coordinates and equations of loops.
    void evaluate(const Vector& z, Vector& r, Matrix& J) {
        set(z);
        const System loaded = under_load(system_, factor(z), options_.gravity);
        const Eigen::Index n = coordinates(), m = multipliers();
        const Linearisation lin = linearise_at(loaded);
        r.resize(n + m);
        J.setZero(n + m, n + m + 1);
        const Vector unbalance = unbalance_of(loaded),
                     more = unbalance_of(under_load(system_, factor(z) + range(), options_.gravity));
        const Matrix K = lin.stiffness();
        Vector phi(system_.loops.size());
        Matrix G(system_.loops.size(), system_.model.size());
        const Kinematics kin = kinematics(system_.model, at_.q, workspace_);
        system_.loops.residual<double>(kin, 0, at_.q, phi);
        system_.loops.gradient<double>(kin, 0, at_.q, G);
        for (Eigen::Index i = 0; i < n; ++i) {
            const int a = entry(unknowns_, i);
            r(i) = unbalance(a);
            J(i, n + m) = more(a) - unbalance(a);  // forces are linear in the factor
            for (Eigen::Index j = 0; j < n; ++j) J(i, j) = K(a, entry(unknowns_, j)) * units_(j);
            for (Eigen::Index k = 0; k < m; ++k) {
                const double gradient = G(entry(equations_, k), a);
                J(i, n + k) = -gradient;
                J(n + k, i) = gradient * units_(i);
            }
        }
        for (Eigen::Index k = 0; k < m; ++k) r(n + k) = phi(entry(equations_, k));
    }

    LoadCurvePoint point(const Vector& z, const Vector& tangent) {
        set(z);
        const System loaded = under_load(system_, factor(z), options_.gravity);
        const Matrix K = static_stiffness(reduce_loops(linearise(loaded, at_), unknowns_).system);
        return {factor(z), at_, negative_pivots(K), tangent(size() - 1) * range()};
    }

    // Of the arc length: multipliers do not count.
    double product(const Vector& a, const Vector& b) const {
        return a.head(coordinates()).dot(b.head(coordinates())) + a(size() - 1) * b(size() - 1);
    }

private:
    // 1 rad, or the extent of the tree; of a tree without any, how far it has moved.
    void set_units() {
        double length = extent(kinematics(system_.model, at_.q, workspace_));
        if (!(length > 0)) length = at_.q.lpNorm<Eigen::Infinity>();
        units_.setOnes(coordinates());
        for (Eigen::Index i = 0; i < coordinates(); ++i)
            if (!system_.model.body(entry(unknowns_, i)).revolute && length > 0) units_(i) = length;
    }
    void set(const Vector& z) {
        for (Eigen::Index i = 0; i < coordinates(); ++i) at_.q(entry(unknowns_, i)) = z(i) * units_(i);
        for (Eigen::Index k = 0; k < multipliers(); ++k) at_.lambda(entry(equations_, k)) = z(coordinates() + k);
    }
    // On the way loops are open by what Newton's method has not closed yet: the tree, and the stiffness of its loops.
    Linearisation linearise_at(const System& loaded) {
        System tree = loaded;
        tree.loops = {};
        Linearisation lin = linearise(tree, at_);
        if (system_.loops.empty()) return lin;
        lin.reactions.setZero(lin.mass.rows(), lin.mass.cols());
        const Kinematics kin = kinematics(system_.model, at_.q, workspace_);
        system_.loops.add_second_gradient(kin, 0, at_.q, -at_.lambda, lin.reactions);
        return lin;
    }
    // g qdd + Gamma qd qd - Q - phi_a lambda
    Vector unbalance_of(const System& loaded) {
        const Eigen::Index n = at_.q.size();
        Vector tau(n), Q(n);
        const Kinematics kin = kinematics(system_.model, at_.q, workspace_);
        inverse_dynamics<double>(kin, at_.qd, at_.qdd, tau);
        loaded.forces.generalised_forces({at_, kin}, Q);
        tau -= Q;
        if (system_.loops.empty()) return tau;
        Matrix G(system_.loops.size(), n);
        system_.loops.gradient<double>(kin, 0, at_.q, G);
        return tau - G.transpose() * at_.lambda;
    }

    const System& system_;
    const LoadCurveOptions& options_;
    std::vector<int> unknowns_, equations_;
    Vector units_;  ///< of the unknown coordinates in z
    Workspace workspace_;
    DynamicState at_;
};

// The direction of the curve, of unit arc length, that goes on from `before`.
Vector tangent_of(const Curve& curve, const Matrix& J, const Vector& before) {
    const Eigen::Index n = curve.size();
    Matrix A(n, n);
    A.topRows(n - 1) = J;
    A.row(n - 1) = before.transpose();
    const Vector t = A.partialPivLu().solve(Vector::Unit(n, n - 1));
    return t / std::sqrt(curve.product(t, t));
}

struct Corrected {
    Vector z, tangent;
    int iterations = 0;
};

// Newton's method across the tangent from a point ahead.
std::optional<Corrected> correct(Curve& curve, const Vector& z0, const Vector& tangent, double step) {
    constexpr int most = 12;
    const Eigen::Index n = curve.size();
    Vector r, z = z0 + step * tangent, across = tangent;
    across.segment(curve.coordinates(), curve.multipliers()).setZero();
    Matrix J;
    double last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most; ++i) {
        curve.evaluate(z, r, J);
        Matrix A(n, n);
        A.topRows(n - 1) = J;
        A.row(n - 1) = across.transpose();
        Vector full(n);
        full.head(n - 1) = r;
        full(n - 1) = curve.product(tangent, z - z0) - step;
        const Vector change = A.partialPivLu().solve(full);
        if (!change.allFinite()) return std::nullopt;
        z -= change;
        const double size = std::sqrt(curve.product(change, change));
        if (size > 10 * step && i > 0) return std::nullopt;
        // At rounding, or no better than before once it is small.
        if (size < 1e-13 || (size < 1e-9 && size > last / 4)) {
            curve.evaluate(z, r, J);
            return Corrected{z, tangent_of(curve, J, across), i + 1};
        }
        last = size;
    }
    return std::nullopt;
}

// Where the load does not change along the curve, between the ends of a step from z with this tangent.
std::optional<Corrected> limit_between(Curve& curve, const Corrected& from, double step, double slope_behind) {
    double a = 0, b = step, slope_a = from.tangent(curve.size() - 1), slope_b = slope_behind;
    std::optional<Corrected> found;
    for (int i = 0; i < 60 && b - a > 1e-10 * step; ++i) {
        const double secant = a + (b - a) * slope_a / (slope_a - slope_b);
        const double trial = i % 3 != 2 && secant > a && secant < b ? secant : (a + b) / 2;
        const std::optional<Corrected> at = correct(curve, from.z, from.tangent, trial);
        if (!at) break;
        found = at;
        const double slope = at->tangent(curve.size() - 1);
        ((slope > 0) == (slope_a > 0) ? a : b) = trial;
        ((slope > 0) == (slope_a > 0) ? slope_a : slope_b) = slope;
    }
    return found;
}

}  // namespace

LoadCurve load_curve(const System& system, const LoadCurveOptions& options) {
    check(system, options);
    LoadCurve out;
    Curve curve(system, options);
    Corrected now;
    if (!curve.start(now.z, out.message)) return out;
    Vector r;
    Matrix J;
    curve.evaluate(now.z, r, J);
    const double sense = options.to > options.from ? 1 : -1;
    now.tangent = tangent_of(curve, J, sense * Vector::Unit(curve.size(), curve.size() - 1));
    out.points.push_back(curve.point(now.z, now.tangent));
    for (double step = options.first_step; static_cast<int>(out.points.size()) < options.points;) {
        step = std::min(step, options.largest_step);
        const std::optional<Corrected> next = correct(curve, now.z, now.tangent, step);
        // A tangent that turns by more than a quarter belongs to another part of the curve.
        if (!next || curve.product(next->tangent, now.tangent) < 0.3) {
            step /= 2;
            if (step >= options.smallest_step) continue;
            out.message = text("load curve ended at load factor ", curve.factor(now.z), ", step ", step,
                               ": Newton's method does not follow it; look for forces that are not smooth");
            return out;
        }
        const double slope = next->tangent(curve.size() - 1);
        if (slope * now.tangent(curve.size() - 1) < 0)
            if (const auto limit = limit_between(curve, now, step, slope))
                out.limits.push_back(curve.point(limit->z, limit->tangent));
        out.points.push_back(curve.point(next->z, next->tangent));
        now = *next;
        if (sense * (curve.factor(now.z) - options.to) >= 0) {
            out.converged = true;
            return out;
        }
        if (now.iterations <= 4) step *= 1.5;
    }
    out.message = text("load curve not at load factor ", options.to, " after ", options.points, " points, but at ",
                       curve.factor(now.z), "; allow more points or longer steps");
    return out;
}

}  // namespace cardan::solvers
