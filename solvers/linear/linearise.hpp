/// @file
/// Exact linearisation about an operating point, with its contributions kept separate.
#pragma once

#include "mbs/kernels/workspace.hpp"
#include "mbs/loops/gradient_rates.hpp"
#include "mbs/system/system.hpp"
#include "solvers/algebra/grouped_matrix.hpp"

#include <optional>
#include <string>

namespace cardan::solvers {

/// M dq'' + (damping + gyroscopic) dq' + (elastic + gravity + loads + inertial) dq = 0 over all coordinates.
/// `gyroscopic` is the whole velocity matrix of the inertial forces, 2 Omega Gamma_{a c spin} for a steady spin; at one
/// azimuth its symmetric part is Mdot (G = 2 C_coriolis and C + C^T = Mdot), so it is skew only after a multi-blade
/// transformation.
struct Linearisation {
    Matrix mass;        ///< g_ab
    Matrix damping;     ///< -dQ/dqd
    Matrix gyroscopic;  ///< d(Gamma qd qd)/dqd
    Matrix elastic;     ///< -dQ/dq of the linear laws
    Matrix gravity;     ///< -dQ/dq of gravity
    Matrix loads;       ///< -dQ/dq of wrenches and force elements that are not elastic
    Matrix inertial;    ///< d(g qdd + Gamma qd qd)/dq
    DynamicState at;
    CoordinateTable coordinates;
    /// Derivatives by states s: Q_s ds stands on the right, and ds' = f_q dq + f_qd dq' + f_s ds. Inputs are held.
    StateDerivatives state_derivatives = {};
    StateTable states = {};
    /// Constraints of loops: the equations hold for motions with constraints dx = 0 (reduce_loops()); `reactions` is
    /// the stiffness that the loops' forces have as they turn, -lambda_i phi_i,ab. Empty without.
    Matrix constraints = {}, reactions = {};
    /// Derivatives of `constraints` by time along the motion, of LoopState::in_motion; else empty.
    Matrix constraint_rates = {}, constraint_accelerations = {};

    Matrix velocity() const { return damping + gyroscopic; }
    Matrix geometric() const {
        Matrix sum = gravity + loads + inertial;
        if (reactions.size() > 0) sum += reactions;
        return sum;
    }
    Matrix stiffness() const { return elastic + geometric(); }
};

/// State of the loops at an operating point.
enum class LoopState : std::uint8_t {
    at_rest,    ///< closed, their coordinates stand still: a constant linearisation
    in_motion,  ///< closed; the linearisation holds at that instant only
    open        ///< anything: derivatives of the equations with multipliers, in the course of an iteration
};

/// Linearises a system about one operating point after another. Exact: analytic derivatives of the recursions and of
/// the force elements (force elements without a Jacobian are differenced). Keeps a reference to the system; one per
/// thread.
class Lineariser {
public:
    explicit Lineariser(const System& system, LoopState loops = LoopState::at_rest);
    explicit Lineariser(System&&, LoopState = LoopState::at_rest) = delete;  // the system must live longer

    /// @param out  overwritten; from the second call on with the same `out` nothing is allocated, unless a force
    ///             element allocates or is differenced.  Cost O(n^2).
    /// @throws InputError for vectors of the wrong size, and for values that are not finite, with the coordinate's
    /// name; for loops that are open or in motion where they may not be
    void linearise(const DynamicState& at, Linearisation& out);

private:
    void check_loops(const Kinematics& kin, const Linearisation& out) const;
    void add_loops(const Kinematics& kin, Linearisation& out);

    const System& system_;
    Workspace workspace_;
    ForceDerivatives forces_;
    LoopState loops_;
    std::optional<GradientRates> gradient_rates_;  ///< where loops may be in motion
};

/// A single linearisation with a temporary Lineariser. @throws also MemoryError
Linearisation linearise(const System& system, const DynamicState& at, LoopState loops = LoopState::at_rest);

/// Coupling of states s of first order to the rows x of a system of second order:
///
///     M x'' + C x' + K x = Q_s s,   s' = f_q x + f_qd x' + f_s s.
struct StateTerms {
    Matrix Q_s, f_q, f_qd;
    GroupedMatrix f_s;
    Vector scales;  ///< StateInfo::scale

    Eigen::Index size() const { return f_s.rows(); }
    /// Adds the matrices.
    StateTerms& operator+=(const StateTerms& other) {
        Q_s += other.Q_s, f_q += other.f_q, f_qd += other.f_qd, f_s.add(other.f_s);
        return *this;
    }
};

/// Rescales the terms to other units: equations multiplied by `rows`, x = rows x', s = states s'. The scales of the
/// states stay.
void rescale(StateTerms& terms, const Vector& rows, const Vector& states);

/// Distance of terms from others, relative to these, states over their scales; 0 without states.
/// @param rate  1/s, > 0, that makes rates and positions alike: the rotor speed
double relative_change(const StateTerms& now, const StateTerms& reference, double rate);

/// Mass, velocity, stiffness and elastic stiffness over a subset of the coordinates, possibly transformed.
struct SecondOrderSystem {
    Matrix M, C, K, K_elastic;
    std::vector<int> coordinates;  ///< model index of every row
    int cyclic = -1;               ///< row of a coordinate on which nothing depends (a free spin), -1: none
    StateTerms states = {};
};

/// Calls `f` with every matrix of a system.
template <class System, class F>
void for_each_matrix(System& system, const F& f) {
    f(system.M), f(system.C), f(system.K), f(system.K_elastic);
    if (system.states.size() == 0) return;
    f(system.states.Q_s), f(system.states.f_q), f(system.states.f_qd), f(system.states.f_s);
}

/// The states as further rows behind those of the coordinates, x = (q, s), so that the whole reads as a system of
/// second order whose mass matrix is zero there:
///
///     M = [M 0; 0 0],  C = [C 0; -f_qd 1],  K = [K -Q_s; -f_q -f_s].
///
/// @param system  overwritten; unchanged if it has no states
void append_states(SecondOrderSystem& system);

/// "inputs held (open loop): 'pitch demand', 'torque demand'": what a linearisation does with the inputs of a system.
/// Empty: there are none.
/// @param free  names of those that it does not hold
std::string held_inputs(const Forces& forces, const std::vector<std::string>& free = {});

/// Stiffness against a motion so slow that the states follow: K + Q_s f_s^-1 f_q.
/// @throws NumericalError if there is a state that settles nowhere by itself, such as an integrator
Matrix static_stiffness(const SecondOrderSystem& system);

/// The rows and columns of `coordinates`, with all states. The spin is cyclic if it is among them and no force depends
/// on it.
/// @param out  overwritten; allocates nothing if it has the right size already.  Cost O(n^2).
/// @throws InputError for coordinates out of range, matrices of different sizes, and loops: reduce_loops()
void restrict_to(const Linearisation& lin, const std::vector<int>& coordinates, int spin, SecondOrderSystem& out);
SecondOrderSystem restrict_to(const Linearisation& lin, const std::vector<int>& coordinates, int spin = -1);

}  // namespace cardan::solvers
