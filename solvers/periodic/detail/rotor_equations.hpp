/// @file
/// Equations of motion of a system whose spin coordinate turns at constant speed, at one azimuth after another.
#pragma once

#include "solvers/algebra/azimuth_series.hpp"
#include "solvers/linear/linearise.hpp"
#include "solvers/periodic/steady_state.hpp"

namespace cardan::solvers {

/// Residual g qdd + Gamma qd qd - Q - phi_a lambda and its derivatives on the free coordinates without the spin, the
/// unknowns, and, in further rows, k phi of the loops, whose multipliers are unknowns in units of a stiffness k, and
/// s' - f of the states, which are unknowns in units of their scales.
class RotorEquations {
public:
    /// @throws InputError for a wrong spin, rotor speed or start; `place` names the caller
    RotorEquations(const System& system, int spin, const PeriodicOptions& options, std::string_view place);

    const std::vector<int>& unknowns() const { return unknowns_; }
    const StateTable& states() const { return system_.forces.states(); }
    Eigen::Index coordinates() const { return std::ssize(unknowns_); }                 ///< the first rows
    Eigen::Index states_from() const { return coordinates() + system_.loops.size(); }  ///< first row of a state
    Eigen::Index size() const { return states_from() + states().size(); }
    /// Rows of states of kind `angle`: their means grow for ever.
    std::vector<Eigen::Index> growing() const;
    const System& system() const { return system_; }
    int spin() const { return spin_; }
    double rotor_speed() const { return rotor_speed_; }
    /// Row of a coordinate; -1: not an unknown.
    Eigen::Index row_of(int coordinate) const;
    const std::string& name(Eigen::Index row) const;
    bool is_multiplier(Eigen::Index row) const { return row >= coordinates() && row < states_from(); }

    /// Spin and driven coordinates at an azimuth.
    void set_azimuth(double psi);
    /// Unknowns, their rates and accelerations.
    void set(VectorIn q, VectorIn qd, VectorIn qdd);
    /// Sets all of this from a series of the unknowns.
    void set_on(const Matrix& own, double psi);
    void residual(VectorOut r);
    /// M, C, K of the coordinates: derivatives of the residual by accelerations, rates and positions, and those of
    /// states in SecondOrderSystem::states.
    void linearise(SecondOrderSystem& out);
    /// Linearises with loops and states as further rows of M, C and K (append_states()).
    void linearise_all(SecondOrderSystem& out);

    /// Coefficients of the unknowns at the start, with the wanted number of harmonics; and, conversely, those of all
    /// coordinates, prescribed rows included, and of all states.
    Matrix start(int harmonics) const;
    /// Closes the loops along a series from `azimuths` on a revolution, one position after another from that before,
    /// and finds how often coordinates turn meanwhile. Changes nothing where they cannot be closed all around.
    void close(Matrix& own, int azimuths);
    void finish(const Matrix& own, PeriodicSteadyState& result) const;
    /// Scale of a residual: for each unknown the larger of its stiffness and its inertia at the rotor speed (of a state
    /// the larger of 1 / its time constant and the rotor speed), averaged over a revolution of the series; at least a
    /// small part of the largest.
    Vector scale(const Matrix& own);
    /// Remainders of the result: largest scaled residuals of the series at `count` azimuths half way between
    /// equidistant ones; NaN if they cannot be evaluated.
    void set_remainders(const Matrix& own, int count, const Vector& scale, PeriodicSteadyState& result);

private:
    void append_loops(SecondOrderSystem& out) const;

    const System& system_;
    int spin_;
    double rotor_speed_;
    Matrix given_;         // coefficients of all coordinates as given
    Matrix given_states_;  // likewise
    std::vector<int> unknowns_;
    DynamicState at_;
    Workspace workspace_;
    Lineariser lineariser_;
    Linearisation lin_;
    Vector tau_, Q_, f_;
    double stiffness_ = 1;  // N/m, k
    double psi_ = 0;
    Vector turns_;  // see PeriodicSteadyState; empty without loops
    Matrix G_;      // gradients of loops
    Vector phi_;
};

}  // namespace cardan::solvers
