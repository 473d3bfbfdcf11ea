/// @file
/// Accelerations and projections of systems with loops.
#pragma once

#include "mbs/kernels/dynamics.hpp"
#include "mbs/loops/constraint_factor.hpp"
#include "mbs/system/system.hpp"
#include "solvers/time/equations_of_motion.hpp"

#include <string>

namespace cardan::solvers {

/// Lagrange's equations of the first kind on the tree's coordinates,
///
///     g_ab qdd^b + Gamma_abc qd^b qd^c = Q_a + phi_ia lambda_i,   phi_ia qdd^a = -bias_i,
///
/// solved for lambda in the inverse metric; positions and rates are brought back to phi = 0, phi_a qd^a + phi_t = 0
/// along the shortest way in the metric. So the problem of index 3 is integrated as one of index 1 that cannot drift.
///
/// Near a singular position gradients of which all but nothing is left are left out: there the motion goes on as its
/// neighbours do.
/// Nothing allocates after construction unless there are user constraints.
class ConstrainedMotion {
public:
    ConstrainedMotion(const System& system, const std::vector<bool>& driven);

    /// Adds what the loops do.
    /// @param kin           at q
    /// @param qdd, actuator in: of the tree without loops, as `forward` has left them; out: with loops
    /// @return false where the metric is singular; problem() says why
    bool constrain(const Kinematics& kin, double time, const Vector& q, const Vector& qd, const Vector& Q,
                   ForwardDynamics& forward, Vector& qdd, Vector& actuator);
    /// Moves the free coordinates and their rates onto the constraints.
    /// @return false if the loops stay open; problem() says which and how far
    bool project(double time, Vector& q, Vector& qd, Workspace& workspace);
    /// Gap of an equation.
    struct Gap {
        int equation = 0;
        double value = 0;  ///< in its unit, or per s
        double ratio = 0;  ///< over what a start may have; not more than 1: closed
    };
    /// The equation that is open the furthest, and the one that opens the fastest.
    Gap gap_at_start(double time, const Vector& q, Workspace& workspace);
    Gap opening_at_start(double time, const Vector& q, const Vector& qd, Workspace& workspace);

    /// Multipliers and gradients at the last constrain().
    const Vector& lambda() const { return lambda_; }
    const Matrix& gradient() const { return G_; }
    std::span<const int> independent() const { return factor_.independent(); }
    const Loops& loops() const { return *loops_; }
    /// EquationsOfMotion::hold(), at the last constrain().
    LockHold hold(int equation);
    /// Power that constraints supply which move by themselves, W.
    double power(double time, const Vector& q);

    const std::string& problem() const { return problem_; }

private:
    bool factorise(const Kinematics& kin, double time, const Vector& q);
    Gap widest() const;
    int rank_of(const std::vector<int>& equations);

    const Loops* loops_;
    MetricFactor metric_;
    ConstraintFactor factor_;
    Matrix G_, magnitudes_;
    Vector lambda_, phi_, allowed_, change_, loads_;
    std::string problem_;
};

}  // namespace cardan::solvers
