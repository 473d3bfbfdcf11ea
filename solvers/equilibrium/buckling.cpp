#include "solvers/equilibrium/buckling.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/extent.hpp"
#include "solvers/equilibrium/load_path.hpp"
#include "solvers/linear/loop_reduction.hpp"
#include "solvers/linear/modes.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace cardan::solvers {

namespace {

// Sums of the magnitudes of the terms of which the stiffness of wrenches and gravity consists at a state: it is exact
// to rounding of these, not of itself. The terms are d_b (v_a . F) = F . (w_b x v_a) + M . (w_b x w_a), b inboard of a,
// with levers that are differences of places. What force elements are made of is not known.
Matrix term_sizes(const System& system, const Vector& q, bool gravity) {
    const Model& model = system.model;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, q, workspace);
    Matrix sizes = Matrix::Zero(model.size(), model.size());
    const auto add = [&](const Vec3& at, int tip, double force, double moment) {
        for (int a = tip; a >= 0; a = model.body(a).parent) {
            const PointTwist<double> twist = twist_at(kin, a, at);
            const double turns = twist.w.norm(), size = force * (twist.v.norm() + turns * at.norm()) + moment * turns;
            for (int b = a; b >= 0; b = model.body(b).parent) sizes(a, b) = sizes(b, a) = sizes(b, a) + size;
        }
    };
    for (const FrameLoad& load : system.forces.loads()) {
        const Wrench now = load.at(0);
        add(pose(kin, load.frame).p, model.frame(load.frame).body, now.force.norm(), now.moment.norm());
    }
    if (!gravity || !system.forces.has_gravity()) return sizes;
    composites(kin);
    for (int a = 0; a < model.size(); ++a) {
        const auto& subtree = entry(workspace.composite, a);
        const Vec3 C = subtree.C.vector();
        const double size = subtree.M * system.forces.gravity().norm() * (twist_at(kin, a, C).v.norm() + C.norm());
        for (int b = a; b >= 0; b = model.body(b).parent) sizes(a, b) = sizes(b, a) = sizes(b, a) + size;
    }
    return sizes;
}

// Without what is rounding of terms of these sizes.
Matrix above_rounding(const Matrix& K, const Matrix& sizes) {
    return (K.array().abs() > 1e-13 * sizes.array()).select(K, 0);
}

// Change of the elastic stiffness by the deflection under the loads, to first order in it: beams that are flexible in
// shear measure their elongation with the square of the shear. Half the difference of the states on both sides has no
// error for a law with a stiffness that is quadratic in the coordinates, whatever the step.
Matrix prestress(const System& system, const Vector& q, const Vector& deflection) {
    Workspace workspace(system.model);
    const double length = extent(kinematics(system.model, q, workspace)), step = 1e-3;
    double largest = 0;  // in rad, or over the extent
    for (int i = 0; i < system.model.size(); ++i)
        largest =
            std::max(largest, std::abs(deflection(i)) / (system.model.body(i).revolute || !(length > 0) ? 1 : length));
    if (!(largest > 0)) return Matrix::Zero(q.size(), q.size());
    const Vector d = step / largest * deflection;
    const Matrix there = linearise(system, at_rest(q + d)).elastic, back = linearise(system, at_rest(q - d)).elastic;
    return above_rounding(there - back, there.cwiseAbs() + back.cwiseAbs()) * (largest / (2 * step));
}

// Generalised forces of the loads alone.
Vector load_forces(const System& system, const Vector& q, bool gravity) {
    Workspace workspace(system.model);
    const DynamicState still = at_rest(q);
    const StateView at(still, kinematics(system.model, q, workspace));
    Vector loaded(q.size()), unloaded(q.size());
    system.forces.generalised_forces(at, loaded);
    system.forces.with_load_factor(0, gravity).generalised_forces(at, unloaded);
    return loaded - unloaded;
}

void check_potential(const Matrix& loads) {
    const double skew = (loads - loads.transpose()).norm(), size = loads.norm();
    if (skew > 1e-7 * size)
        throw InputError("linear buckling", "skew part of the load stiffness over the whole", skew / size,
                         "below 1e-7; the loads have no potential (follower forces, moments about fixed axes, user "
                         "forces), so a dynamic criterion is needed: use load_stability()");
}

Instability kind_of(const Complex& eigenvalue, double growth) {
    if (eigenvalue.real() <= growth * std::abs(eigenvalue)) return Instability::none;
    return eigenvalue.imag() > 0 ? Instability::flutter : Instability::divergence;
}

void check(const LoadStabilityOptions& options) {
    const std::string where = "load stability";
    if (!std::isfinite(options.from) || !std::isfinite(options.to) || !(options.from < options.to))
        throw InputError(where, "load factors from, to", text(options.from, ", ", options.to), "finite and rising");
    if (options.steps < 1) throw InputError(where, "number of steps", options.steps, ">= 1");
    require_positive(where, "tolerance of the load factor", options.tolerance);
    require_positive(where, "growth", options.growth);
}

// The least stable mode about the equilibrium at a load factor.
class Scan {
public:
    Scan(const System& system, const LoadStabilityOptions& options)
        : system_(system), options_(options), unknowns_(system.model.coordinates().free_without(options.spin)) {}

    struct Found {
        LoadStabilityPoint point;
        Vector q;  // the equilibrium
    };

    // None if there is no equilibrium; then `message` says why.
    std::optional<Found> at(double factor, const Vector& start) {
        const System loaded = under_load(system_, factor, options_.gravity);
        SteadyOptions state = options_.state;
        state.initial = start;
        const SteadyState found = steady_state(loaded, options_.spin, state);
        if (!found.converged) {
            message = text("load stability: no equilibrium at load factor ", factor, ": ", found.message);
            return std::nullopt;
        }
        LoadStabilityPoint point{factor, Instability::none, {}};
        double worst = -2;  // Re / |.| lies between -1 and 1
        for (const Mode& mode : modes(reduce_loops(linearise(loaded, found.at), unknowns_).system)) {
            const double growth = mode.eigenvalue.real() / std::abs(mode.eigenvalue);
            if (growth <= worst) continue;
            worst = growth;
            point.eigenvalue = mode.eigenvalue;
        }
        point.kind = kind_of(point.eigenvalue, options_.growth);
        return Found{point, found.at.q};
    }

    std::string message;

private:
    const System& system_;
    const LoadStabilityOptions& options_;
    std::vector<int> unknowns_;
};

}  // namespace

std::vector<BucklingMode> linear_buckling(const System& system, const BucklingOptions& options) {
    system.require_no_loops("linear buckling");
    const Eigen::Index n = system.model.size();
    if (options.count < 1) throw InputError("linear buckling", "number of factors", options.count, ">= 1");
    if (options.at.size() != 0 && (options.at.size() != n || !options.at.allFinite()))
        throw InputError("linear buckling", "size of the state", options.at.size(),
                         text(n, " finite values, one per coordinate, or empty"));
    const std::vector<int> free = system.model.coordinates().free();
    if (free.empty()) return {};
    const Vector zero = Vector::Zero(n), at = options.at.size() > 0 ? options.at : zero;
    const Linearisation lin = linearise(system, at_rest(at));
    Matrix structure = lin.elastic(free, free), loads = lin.loads;
    if (options.gravity)
        loads += lin.gravity;
    else
        structure += lin.gravity(free, free);
    loads = above_rounding(loads, term_sizes(system, at, options.gravity))(free, free).eval();
    check_potential(loads);
    const Eigen::LLT<Matrix> cholesky(structure);
    if (cholesky.info() != Eigen::Success)
        throw NumericalError(
            "linear buckling: the stiffness without the loads is not positive definite (a mechanism, or gravity has "
            "buckled the structure already); lock or support the free coordinates");
    Vector deflection = zero;
    const Vector forces = load_forces(system, at, options.gravity)(free), moved = cholesky.solve(forces);
    deflection(free) = moved;
    loads += prestress(system, at, deflection)(free, free);

    // (-K_loads) x = mu K x with mu = 1 / factor: the largest mu first.
    const Matrix destabilising = -(loads + loads.transpose()) / 2;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(destabilising, structure);
    if (solver.info() != Eigen::Success)
        throw NumericalError("linear buckling: the eigenvalue iteration did not converge");
    const Vector& mu = solver.eigenvalues();
    const double rounding = 1e-12 * mu.cwiseAbs().maxCoeff();
    std::vector<BucklingMode> result;
    for (Eigen::Index i = mu.size() - 1; i >= 0 && mu(i) > rounding; --i) {
        if (result.size() == static_cast<std::size_t>(options.count)) break;
        const Vector x = solver.eigenvectors().col(i);
        Eigen::Index largest = 0;
        x.cwiseAbs().maxCoeff(&largest);
        BucklingMode mode{1 / mu(i), zero};
        mode.shape(free) = x / x(largest);
        result.push_back(std::move(mode));
    }
    return result;
}

LoadStability load_stability(const System& system, const LoadStabilityOptions& options) {
    check(options);
    Scan scan(system, options);
    LoadStability result;
    Scan::Found stable{{options.from, Instability::none, {}}, options.state.initial};
    std::optional<Scan::Found> unstable;
    // False: there is no equilibrium.
    const auto step_to = [&](double factor) {
        std::optional<Scan::Found> found = scan.at(factor, stable.q);
        if (!found) {
            result.message = scan.message;
            return false;
        }
        if (found->point.kind == Instability::none)
            stable = std::move(*found);
        else
            unstable = std::move(found);
        const LoadStabilityPoint& last = unstable ? unstable->point : stable.point;
        result.factor = last.factor;
        result.eigenvalue = last.eigenvalue;
        result.kind = last.kind;
        result.stable_factor = stable.point.factor;
        return true;
    };
    for (int i = 0; i <= options.steps && !unstable; ++i) {
        const double factor = i == options.steps
                                  ? options.to
                                  : options.from + (options.to - options.from) * static_cast<double>(i) / options.steps;
        if (!step_to(factor)) return result;
        result.points.push_back({result.factor, result.kind, result.eigenvalue});
    }
    if (result.points.size() == 1 && unstable)
        result.note = text("unstable already at the first load factor ", result.factor);
    while (unstable && result.factor - result.stable_factor > options.tolerance) {
        const double middle = (result.factor + result.stable_factor) / 2;
        if (middle <= result.stable_factor || middle >= result.factor) break;
        if (!step_to(middle)) return result;
    }
    result.converged = true;
    return result;
}

}  // namespace cardan::solvers
