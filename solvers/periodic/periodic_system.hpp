/// @file
/// Linear systems with periodic coefficients.
#pragma once

#include "solvers/linear/coleman.hpp"
#include "solvers/periodic/steady_state.hpp"

#include <functional>

namespace cardan::solvers {

/// M(t) q'' + C(t) q' + K(t) q = Q_s(t) s with states s of first order beside it (StateTerms), or in general E(t) x' =
/// A(t) x, with coefficients of period T that can be evaluated at any time. E may be singular if the system has index
/// one (algebraic rows 0 = D x + E_y y, solvable for y); then the multipliers of the algebraic states are zero.
class PeriodicSystem {
public:
    /// Fills in M, C, K, the elastic part K_elastic of K, which weighs energies (empty or zero: none), and the states.
    using SecondOrder = std::function<void(double time, SecondOrderSystem& out)>;
    using FirstOrder = std::function<void(double time, Matrix& E, Matrix& A)>;

    /// @param period  s
    /// @param beside  number of states of first order beside the coordinates, SecondOrderSystem::states
    /// @throws InputError unless the period is finite and positive, or without coordinates
    static PeriodicSystem second_order(double period, Eigen::Index coordinates, SecondOrder at,
                                       Eigen::Index beside = 0);
    static PeriodicSystem first_order(double period, Eigen::Index states, FirstOrder at);

    double period() const { return period_; }
    /// 2 pi / T, rad/s; for a rotor, the magnitude of the rotor speed.
    double frequency() const { return 2 * pi / period_; }
    bool is_second_order() const { return static_cast<bool>(second_); }
    /// Rows of the matrices: coordinates of a system of second order, states of one of first order.
    Eigen::Index rows() const { return rows_; }
    /// States of first order beside the coordinates of a system of second order.
    Eigen::Index states_beside() const { return beside_; }
    /// Size of x: 2 rows() + states_beside(), or rows().
    Eigen::Index states() const { return is_second_order() ? 2 * rows_ + beside_ : rows_; }

    /// Second-order systems only. @throws NumericalError if a matrix has the wrong size or is not finite
    void at(double time, SecondOrderSystem& out) const;
    /// Matrices of both kinds of system; x = (q, q', s) for second-order systems.  @throws as above
    void at(double time, Matrix& E, Matrix& A) const;

private:
    PeriodicSystem(double period, Eigen::Index rows);

    double period_;
    Eigen::Index rows_, beside_ = 0;
    SecondOrder second_;
    FirstOrder first_;
};

/// Coordinates among some that are independent where loops are closed, the same over the whole period: those that the
/// others follow best where they follow worst. The spin is one if it is among them. All without loops.
/// @throws InputError as linearised(); NumericalError where no choice passes every dead point on the way
std::vector<int> independent_coordinates(const System& system, const PeriodicSteadyState& about,
                                         const std::vector<int>& unknowns);

/// A system linearised about its periodic (or constant) steady state, over some of its coordinates and with all states.
/// @param unknowns     coordinates, in the order of the rows; may include the spin: its drive then keeps the
/// steady-state
///                     torque whatever the disturbance. The result keeps a reference to `system`, and copies share
///                     memory: use it in one thread. With loops the rows are those that are independent.
/// @param independent  these; empty: independent_coordinates()
/// @throws InputError for a steady state that did not converge or belongs to another system, and for coordinates that
/// do not exist; as independent_coordinates()
PeriodicSystem linearised(const System& system, const PeriodicSteadyState& about, std::vector<int> unknowns,
                          std::vector<int> independent = {});
/// The linearised system over all free coordinates but the spin.
PeriodicSystem linearised(const System& system, const PeriodicSteadyState& about);
PeriodicSystem linearised(System&&, const PeriodicSteadyState&, std::vector<int>,
                          std::vector<int> = {}) = delete;                 // the system must live longer
PeriodicSystem linearised(System&&, const PeriodicSteadyState&) = delete;  // likewise

/// The system in multi-blade rows, rotating with psi = rotor_speed * t from psi = 0.
PeriodicSystem in_multi_blade_rows(PeriodicSystem system, ColemanTransform transform, double rotor_speed);

/// Mean of the matrices at `samples` equidistant azimuths or times of a period: exact for harmonics below that
/// number. Allocates nothing once both systems have their size.
/// @param at  `at(i, out)` fills in the matrices of sample i, i = 1 ... samples - 1
/// @param mean  holds the matrices of sample 0; overwritten
/// @param scratch  overwritten
template <class At>
void average(int samples, const At& at, SecondOrderSystem& mean, SecondOrderSystem& scratch) {
    for (int i = 1; i < samples; ++i) {
        at(i, scratch);
        mean.M += scratch.M, mean.C += scratch.C, mean.K += scratch.K, mean.K_elastic += scratch.K_elastic;
        if (mean.states.size() > 0) mean.states += scratch.states;
    }
    for_each_matrix(mean, [&](auto& m) { m /= samples; });
}

/// Q identical parts that take each other's places after a Q-th of the period: if x(t) is a solution, P x(t + T/Q) is
/// one. P is orthogonal, P^Q = 1, and acts on positions and on rates (on states in a system of first order).
struct BladeSymmetry {
    int parts = 1;
    Matrix P = {};         ///< empty: none
    Matrix P_beside = {};  ///< of the states beside the coordinates; empty: there are none

    /// P of x = (q, q', s), or of the states of a system of first order.
    Matrix of_states(const PeriodicSystem& system) const;
};

/// average() over the period of a system.
/// @param samples  of the whole period, rounded up to a multiple of the number of parts
/// @param symmetry  of the system: only the samples of one part are evaluated
/// @throws InputError for a system of first order or fewer than one sample
SecondOrderSystem mean_over_period(const PeriodicSystem& system, int samples, const BladeSymmetry& symmetry = {});

/// Blade k + 1 takes the place of blade k (the other way round if the rotor turns backward); rotating pairs turn by 2
/// pi / Q; the `odd` coordinates change sign, as the teeter angle of a two-bladed rotor does. States that belong to
/// blades change places like these, the others stay.
/// @param coordinates  of the rows of the system
/// @param states       beside them
/// @throws InputError if there are fewer than two blades, if they are not evenly spaced or differ in their number of
/// coordinates or states or have only some of them among `coordinates`, or if an odd coordinate does not exist or there
/// are more than two blades
BladeSymmetry blade_symmetry(const RotorMap& rotor, const std::vector<int>& coordinates, double rotor_speed,
                             const std::vector<int>& odd = {}, const StateTable& states = {});

/// Largest difference between the matrices at t + T/Q, transformed by P, and those at t, over a few times t, relative
/// to the diagonals: of order two at the frequency 2 pi / T, |K_ii| + omega |C_ii| + omega^2 |M_ii|; of the states'
/// matrices, in the same units, relative to their largest entries. Zero up to rounding if the symmetry holds.
/// @throws InputError for a P of the wrong size, or if P^Q is not the unit matrix
double asymmetry(const PeriodicSystem& system, const BladeSymmetry& symmetry);

}  // namespace cardan::solvers
