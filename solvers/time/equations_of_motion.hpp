/// @file
/// A system with prescribed motions of some coordinates, as seen by the integration methods.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/kernels/branch_matrix.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "mbs/kernels/metric_factor.hpp"
#include "mbs/system/system.hpp"
#include "solvers/time/motion.hpp"

#include <memory>
#include <optional>
#include <string>

namespace cardan::solvers {

class ConstrainedMotion;

/// Load that a lock has to hold, beside the other loops and locks.
struct LockHold {
    bool beside_loops = false;  ///< loops alone leave its coordinate free to move
    bool beside_all = false;    ///< so do the loops and the other locks that are engaged
    double mobility = 0;        ///< acceleration of the coordinate for a force of 1 along it, of the tree without loops
};

/// The context named in errors of these equations and their integration.
inline constexpr const char* in_integration = "time integration";

/// A coordinate and the motion that is imposed on it.
struct Drive {
    int coordinate = -1;  ///< index in the model
    Motion motion = Motion::constant(0);
};

/// Rates of work at a state, W.
struct Powers {
    double forces = 0;       ///< Q . qd of all force elements
    double dissipation = 0;  ///< power dissipated by the dampers of the linear laws, >= 0
    double drives = 0;  ///< of the drives and of constraints that move by themselves, positive if they supply energy
    StateEnergy states = {};  ///< of elements with states that tell it
};

/// The free coordinates f and the states s beside them are the unknowns, x = (q_f, qd_f, s); the driven coordinates
/// follow from the time. Coordinates are driven by a motion or, if only their role says "driven", at their constant
/// initial rate.
///
/// Two forms of the same equations: rates xdd = (qdd_f, ds/dt) of the second part of x for first-order methods, and the
/// residual
///
///     r_f = g qdd + Gamma qd qd - Q,   r_s = ds/dt - f
///
/// for second-order methods. With loops phi_i(q, t) = 0 their forces phi_ia lambda_i are among the rates; the residual
/// does not know them. Nothing allocates after construction except force elements and motions. Keeps a reference to
/// the system; one object per thread.
class EquationsOfMotion {
public:
    /// @param q, qd  size n: initial values, for the coordinates that are driven without a motion
    /// @throws InputError: wrong sizes or coordinates, two motions for one coordinate, values not finite
    EquationsOfMotion(const System& system, std::vector<Drive> drives, double time, const Vector& q, const Vector& qd);
    EquationsOfMotion(System&&, std::vector<Drive>, double, const Vector&, const Vector&) = delete;  // must live longer
    ~EquationsOfMotion();
    EquationsOfMotion(const EquationsOfMotion&) = delete;
    EquationsOfMotion& operator=(const EquationsOfMotion&) = delete;

    const Model& model() const { return system_->model; }
    /// Indices of the unknown coordinates, and their number.
    const std::vector<int>& unknowns() const { return free_; }
    int size() const { return static_cast<int>(free_.size()); }
    /// Number of states.
    int states() const { return static_cast<int>(now_.s.size()); }
    /// Lengths of x and of its second part, of which xdd are the rates.
    int length() const { return 2 * size() + states(); }
    int rates() const { return size() + states(); }
    const StateTable& state_table() const { return system_->forces.states(); }
    const std::vector<Drive>& drives() const { return drives_; }
    bool is_driven(int coordinate) const { return entry(driven_, coordinate); }
    /// Replaces the motion of a driven coordinate from now on.
    /// @throws InputError if the coordinate is not driven, or if its position or rate would jump at `time`
    void set_motion(int coordinate, Motion motion, double time);
    /// Sets a motion that jumps.
    void set_jump(int coordinate, Motion motion);
    /// Replaces the forces from now on (nullptr: those of the system); they must outlive their use.
    /// @throws InputError for forces with other states or inputs
    void set_forces(const Forces* forces);
    const Forces& forces() const { return *forces_; }

    /// Values of the inputs, Forces::inputs(), from now on.
    const Vector& inputs() const { return now_.u; }
    void set_inputs(const Vector& u);

    /// Breaks of all motions and loads, ascending, without duplicates.
    std::vector<double> breaks() const;
    /// Motions are evaluated on the smooth piece that is active at this time, until the next call.
    void set_piece(double inside) { inside_ = inside; }

    /// Accelerations of the unknowns and rates of the states.
    /// @param x    length(): positions, rates, states
    /// @param xdd  out, rates()
    /// @return false if a number in the state or in the result is not finite; problem() says which
    bool accelerations(double time, const double* x, double* xdd);
    /// Residual of the unknowns at given accelerations and rates.
    /// @param x, xdd  as above;  @param r  out, rates()
    bool residual(double time, const double* x, const double* xdd, double* r);
    /// Residual where the driven coordinates are in this state, whatever their motions are now.
    /// @param driven  driven_state()
    bool residual(double time, const double* x, const double* xdd, const double* driven, double* r);

    /// Exact derivatives of the residual at a state and its accelerations: dr/dqdd = g, dr/dqd = C, dr/dq = S, kept
    /// until the next call. Those of the accelerations are -g^-1 S and -g^-1 C.
    /// @return false if the metric is not positive definite at the state; problem() says where
    bool linearise(double time, const double* x);
    /// Linearises where the driven coordinates are in this state, whatever their motions are now.
    /// @param driven  driven_state()
    bool linearise(double time, const double* x, const double* driven);
    /// Position, rate and acceleration of each drive at the last state that was evaluated.
    /// @param out  3 drives().size()
    void driven_state(double* out) const;
    /// Linearises at the last residual(), which must be the preceding call; its metric need not be positive definite.
    void linearise_residual();
    /// K = c_qdd g + c_qd C + c_q S.
    /// @param K  out, size() x size().  Cost O(n^2)
    void tangent(double c_qdd, double c_qd, double c_q, MatrixOut K) const;
    /// Tangent matrix on the branches of the tree, ones on the diagonal for driven coordinates.
    /// @param K  out, of all coordinates
    /// @return false, K being undefined, if forces couple coordinates that are not on one branch.  Cost O(n d)
    bool tangent_on_branches(double c_qdd, double c_qd, double c_q, BranchMatrix& K) const;
    /// Gradients of the loops' independent equations there, by unknowns. Empty without loops.
    auto loop_gradients() const { return loop_gradients_.topRows(loop_rank_); }
    /// y = g v and y -= c S v; v and y by unknowns.
    void multiply_metric(const Vector& v, Vector& y);
    void subtract_stiffness(double c, const Vector& v, Vector& y);
    const std::vector<StateGroup>& state_groups() const { return forces_->state_groups(); }
    /// Derivatives of the states' part at the last linearise...(), by all coordinates.
    const StateDerivatives& state_derivatives() const { return force_derivatives_.states; }
    /// Spreads the unknowns to all coordinates, zero for the driven ones; gather() goes back.
    void spread(VectorIn unknowns, Vector& all) const;
    void gather(const Vector& all, VectorOut unknowns) const;

    /// Moves a state onto the constraints of the loops, if there are any.
    /// @return false if they stay open; problem() says which
    bool project(double time, double* x);
    /// @throws InputError where projected rates still open a loop: prescribed motions contradict each other
    void require_closed_rates(double time, const double* x);
    /// Motion under the loops' constraints; nullptr: there are none.
    const ConstrainedMotion* loops() const { return loops_.get(); }
    const Loops& system_loops() const { return system_->loops; }
    /// Load that an engaged lock has to hold, at the state evaluated last.  Allocates.
    /// @param equation  of the lock, Loops::first_of()
    LockHold hold(int equation);

    /// All coordinates, accelerations and drive forces at a state. @return false, with `out` unchanged, if a number is
    /// not finite; problem() says which
    bool complete(double time, const double* x, DynamicState& out);
    /// Time, positions and rates alone.
    void positions(double time, const double* x, DynamicState& out);
    bool powers(double time, const double* x, Powers& out);
    double kinetic_energy(const DynamicState& at);
    double potential_energy(const DynamicState& at);
    /// Stored in elements with states, J.
    double stored_energy(const DynamicState& at);
    /// Evaluates a user function at a state.
    double evaluate(const std::function<double(const StateView&)>& function, double time, const double* x);

    /// Message of what went wrong when a function returned false.
    const std::string& problem() const { return problem_; }
    void clear_problem() { problem_.clear(); }
    /// "position of 'name'", "rate of 'name'" or "state 'name'" of an entry of x.
    std::string name_of(int index) const;

private:
    void drive_at(double time);
    StateView view() const { return {now_, *kin_}; }
    void evaluate_forces();
    void expand(double time, const double* x);
    void require_closed();
    void set_driven(const double* driven);
    bool residual_there(const double* xdd, double* r);
    bool solve(double time, const double* x);
    bool solve();
    bool derive();
    void differentiate();
    bool all_finite(const Vector& values, const char* quantity);
    bool states_finite(const Vector& values, const char* quantity);
    bool motion_finite();

    const System* system_;
    const Forces* forces_;
    std::vector<Drive> drives_;
    std::vector<bool> driven_;
    std::vector<int> free_;
    Workspace workspace_;
    std::optional<Kinematics> kin_;  ///< at the last state
    ForwardDynamics forward_;
    std::unique_ptr<ConstrainedMotion> loops_;
    MetricFactor factor_;
    ForceDerivatives force_derivatives_;
    BranchMatrix g_, tau_q_, tau_qd_;   ///< of the inertial forces
    BranchMatrix stiffness_, damping_;  ///< with what the forces add on the branches
    Matrix loop_stiffness_, loop_gradients_;
    Eigen::Index loop_rank_ = 0;
    bool on_branches_ = true;  ///< and that is all of it
    double inside_;
    DynamicState now_;  ///< at which everything was evaluated last; multipliers: loops_
    Vector Q_, tau_, all_, product_;
    std::string problem_;
};

}  // namespace cardan::solvers
