#include "solvers/equilibrium/buckling.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/kernels/extent.hpp"
#include "mbs/kernels/registers/kernel_arrays.hpp"
#include "solvers/linear/linearise.hpp"

#include <algorithm>

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
        const auto& subtree = entry(kin.arrays().composite, a);
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

}  // namespace cardan::solvers
