/// @file
/// A system with prescribed motions of some coordinates, as seen by the integration methods.
#pragma once

#include "mbs/base/entry.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "mbs/system/forward_derivatives.hpp"
#include "mbs/system/system.hpp"
#include "solvers/time/motion.hpp"

#include <optional>
#include <string>

namespace cardan::solvers {

/// The context named in errors of these equations and their integration.
inline constexpr const char* in_integration = "time integration";

/// A coordinate and the motion that is imposed on it.
struct Drive {
    int coordinate = -1;  ///< index in the model
    Motion motion = Motion::constant(0);
};

/// All coordinates at a time, with the forces of the drives.
struct DynamicState {
    double time = 0;
    Vector q, qd, qdd;
    Vector actuator;  ///< generalised force of the drive on its coordinate, N m or N; zero on free ones
};

/// Rates of work at a state, W.
struct Powers {
    double forces = 0;       ///< Q . qd of all force elements
    double dissipation = 0;  ///< power dissipated by the dampers of the linear laws, >= 0
    double drives = 0;       ///< power of the drives, positive if they supply energy
};

/// The free coordinates f are the unknowns, x = (q_f, qd_f); the driven ones follow from the time. Coordinates are
/// driven by a motion or, if only their role says "driven", at their constant initial rate.
///
/// Two forms of the same equations: accelerations for first-order methods, and the residual
///
///     r_f = g qdd + Gamma qd qd - Q
///
/// for second-order methods. Nothing allocates after construction except user forces and motions. Keeps a reference to
/// the system; one object per thread.
class EquationsOfMotion {
public:
    /// @param q, qd  size n: initial values, for the coordinates that are driven without a motion
    /// @throws InputError: wrong sizes or coordinates, two motions for one coordinate, values not finite
    EquationsOfMotion(const System& system, std::vector<Drive> drives, double time, const Vector& q, const Vector& qd);

    const Model& model() const { return system_->model; }
    /// Indices of the unknown coordinates, and their number.
    const std::vector<int>& unknowns() const { return free_; }
    int size() const { return static_cast<int>(free_.size()); }
    const std::vector<Drive>& drives() const { return drives_; }
    bool is_driven(int coordinate) const { return entry(driven_, coordinate); }
    /// Replaces the motion of a driven coordinate from now on.
    /// @throws InputError if the coordinate is not driven, or if its position or rate would jump at `time`
    void set_motion(int coordinate, Motion motion, double time);
    /// Replaces the forces from now on (nullptr: those of the system); they must outlive their use.
    void set_forces(const Forces* forces);
    const Forces& forces() const { return *forces_; }

    /// Breaks of all motions, ascending, without duplicates.
    std::vector<double> breaks() const;
    /// Motions are evaluated on the smooth piece that is active at this time, until the next call.
    void set_piece(double inside) { inside_ = inside; }

    /// Accelerations of the unknowns.
    /// @param x    2 size(): positions, rates
    /// @param qdd  out, size()
    /// @return false if a number in the state or in the result is not finite; problem() says which
    bool accelerations(double time, const double* x, double* qdd);
    /// Exact derivatives of the accelerations by positions and rates. Results in by_q(), by_qd(), size() x size().
    /// @return false if the metric is not positive definite at the state; problem() says where
    bool jacobian(double time, const double* x);
    const Matrix& by_q() const { return by_q_; }
    const Matrix& by_qd() const { return by_qd_; }

    /// Residual of the unknowns at given accelerations.
    /// @param x, qdd  as above;  @param r  out, size()
    bool residual(double time, const double* x, const double* qdd, double* r);
    /// Tangent at the last residual(), which must be the preceding call: c_qdd dr/dqdd + c_qd dr/dqd + c_q dr/dq,
    /// exact.
    /// @param K  out, size() x size()
    void tangent(double c_qdd, double c_qd, double c_q, MatrixOut K);

    /// All coordinates, accelerations and drive forces at a state. @return false, with `out` unchanged, if a number is
    /// not finite; problem() says which
    bool complete(double time, const double* x, DynamicState& out);
    /// Time, positions and rates alone.
    void positions(double time, const double* x, DynamicState& out);
    bool powers(double time, const double* x, Powers& out);
    double kinetic_energy(const DynamicState& at);
    double potential_energy(const DynamicState& at);
    /// Evaluates a user function at a state.
    double evaluate(const std::function<double(const ForceInput&)>& function, double time, const double* x);

    /// What went wrong when a function returned false.
    const std::string& problem() const { return problem_; }
    void clear_problem() { problem_.clear(); }
    /// "position of 'name'" or "rate of 'name'" of an entry of x.
    std::string name_of(int index) const;

private:
    void drive_at(double time);
    void expand(double time, const double* x);
    bool solve(double time, const double* x);
    bool all_finite(const Vector& values, const char* quantity);

    const System* system_;
    const Forces* forces_;
    std::vector<Drive> drives_;
    std::vector<bool> driven_;
    std::vector<int> free_;
    Workspace workspace_;
    std::optional<Kinematics> kin_;  ///< at the last state
    ForwardDynamics forward_;
    ForwardDynamicsDerivatives derivatives_;
    ForceDerivatives force_derivatives_;
    double inside_, time_ = 0;
    Vector q_, qd_, qdd_, Q_, tau_, actuator_;
    Matrix by_q_, by_qd_, g_, tau_q_, tau_qd_;
    std::string problem_;
};

}  // namespace cardan::solvers
