/// @file
/// One point of a Campbell diagram: everything at one rotor speed.
#pragma once

#include "solvers/campbell/diagram.hpp"
#include "solvers/campbell/mode_range.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "solvers/mode_names/energy_shares.hpp"

#include <memory>
#include <optional>

namespace cardan::solvers {

/// PointSolver::periodic_remainder() that counts as none: rounding.
inline constexpr double negligible_remainder = 1e-9;

/// Sets CampbellPoint::stability_margin from the modes, rigid ones excluded. Growth or decay at rounding level counts
/// as zero: 1e-8 of the eigenvalue, or of the lowest frequency if that is larger. Eigenvalues above max_reliable_ratio
/// times the lowest are ignored.
void set_stability_margin(CampbellPoint& point);

/// A mode that is a motion of states, with the state that moves most.
/// @param scales  of the states
StateMotion state_motion(Mode mode, const Vector& scales);

/// Steady state, linearisation, Coleman transformation, modes and their energy shares at one rotor speed after another.
/// Its memory, some twenty matrices over the coordinates, is allocated with the first point. Keeps references to system
/// and machine; one per thread. What Floquet's theory and the mean over the azimuth do differently where the rotor
/// turns is virtual: point_solver() makes the one for the method.
class PointSolver {
public:
    /// @throws InputError for a rotor of two blades, or without multi-blade coordinates, unless the method is Floquet's
    /// (then standstill only)
    PointSolver(const System& system, const RotorMap& rotor, const CampbellOptions& options = {});
    PointSolver(System&&, const RotorMap&, const CampbellOptions& = {}) = delete;  // the system must live longer
    PointSolver(const System&, RotorMap&&, const CampbellOptions& = {}) = delete;  // likewise the map
    PointSolver(const PointSolver&) = delete;
    PointSolver& operator=(const PointSolver&) = delete;
    virtual ~PointSolver() = default;

    /// Sets the start of the next point: CampbellCase::start and state_start. Empty ones change nothing.
    virtual void start_from(const Matrix& coordinates, const Matrix& states);
    /// All points that will be solved, in this order: what is cheap and may fail is done before anything else.
    /// @throws as solve()
    virtual void prepare(std::span<const double> /*rotor_speeds*/) {}
    /// The steady-state iteration starts from the previous point. From the second call on with the same `point` nothing
    /// is allocated, but for the shares of blades that differ at standstill and where few of many modes are wanted
    /// (ModeSolver).
    /// @param rotor_speed  rad/s
    /// @param point  overwritten
    /// @throws NumericalError where no constant steady state exists or is found, and as ModeSolver; the solver can be
    /// used again
    virtual void solve(double rotor_speed, CampbellPoint& point);

    /// Model index of every row of the modes' shapes.
    const std::vector<int>& unknowns() const { return unknowns_; }
    /// Names of the rows; blade coordinates are named after blade 1, with the pattern that the row stands for.
    std::vector<std::string> row_names() const;
    /// Names of the states of first order, likewise.
    std::vector<std::string> state_names() const;
    /// The (transformed) system of the last point, averaged over the azimuth.
    const SecondOrderSystem& system() const { return current_; }
    /// Made at the first point; null before.
    const EnergyFractions* energy_shares() const { return energy_shares_ ? &*energy_shares_ : nullptr; }
    /// Blade coordinates at azimuth 0 from the rows of a mode's shape.
    Matrix rotating_coordinates() const;
    /// Says of machines with loops how all coordinates of the model move with the unknowns in blade coordinates; empty
    /// without.
    Matrix followers(const DynamicState& at) const;
    /// Null without multi-blade rows.
    const ColemanTransform* coleman() const { return coleman_ ? &*coleman_ : nullptr; }
    /// A warning about the results so far; usually empty.
    const std::string& warning() const { return warning_; }
    /// Range of the modes of the next point, where the equations are constant.
    ModeRange& mode_range() { return range_; }

    /// Coordinates that may move: the unknowns, and with loops those that follow them.
    const std::vector<int>& moving() const { return moving_.empty() ? unknowns_ : moving_; }
    /// About a point where loops may be in motion, without constraints: condense_loops().
    Linearisation linearised_at(const DynamicState& at) const;
    /// Largest part of the (multi-blade) matrices that changes with the azimuth, relative to them. Steady state as in
    /// solve().
    double periodic_remainder(double rotor_speed);
    /// x^H K_elastic x of the own coordinates of each blade; allocates.
    /// @param shape  in blade coordinates, by unknown
    Vector blade_energies(const Linearisation& lin, const ComplexVector& shape) const;
    /// One of the blades may move alone: they differ, or are not evenly spaced. From the first point on, or after
    /// define_components().
    bool blades_stand_out() const;
    /// Defines the components from this linearisation instead of that of the first point; call before the first point.
    void define_components(const Linearisation& lin);

protected:
    void warn(const std::string& what);

    const System& system_;
    const RotorMap& rotor_;
    CampbellOptions options_;
    ModeRange range_;
    SecondOrderSystem current_;  ///< of the last point

private:
    const std::vector<MultiBladeRow>& rows() const { return coleman_ ? coleman_->rows() : plain_rows_; }
    void find_steady_state(double rotor_speed);
    void linearise(const DynamicState& at);
    void reduce_unknowns();
    void start();
    void note_rigid_springs();
    void set_margin(CampbellPoint& point) const;
    void set_blade_shares(CampbellPoint& point) const;
    void set_system(double rotor_speed);
    void set_at_azimuth(double psi, double rotor_speed, SecondOrderSystem& out);
    double remainder(double rotor_speed);
    void take_mean(double rotor_speed, double remainder);
    // Checked before the text of a warning is built: later points allocate nothing.
    bool warned_of(std::string_view what) const;
    void set_count(std::vector<CampbellMode>& modes, std::size_t count);
    void set_modes(std::size_t count, CampbellPoint& point);

    std::vector<int> unknowns_;
    std::vector<int> moving_;  ///< with loops: these, and the coordinates that follow them; empty without
    std::optional<ColemanTransform> coleman_;
    std::vector<MultiBladeRow> plain_rows_;
    std::optional<EnergyFractions> energy_shares_;
    std::string warning_;

    SteadySolver steady_solver_;
    Lineariser lineariser_;
    std::optional<ModeSolver> mode_solver_;
    SteadyOptions steady_options_;
    SteadyState steady_;
    DynamicState turned_;
    Linearisation lin_;
    SecondOrderSystem other_;
    std::vector<CampbellMode> spare_;  // memory for modes beyond those of the last point
};

/// Smallest |eigenvalue| of the oscillating modes, rigid ones excluded; infinite without any. Eigenvalues above
/// max_reliable_ratio times as much have growth rates at rounding level.
double lowest_vibration(const std::vector<CampbellMode>& modes);

/// The solver for the method of the options.
/// @throws InputError as the solvers
std::unique_ptr<PointSolver> point_solver(const System& system, const RotorMap& rotor, const CampbellOptions& options);

}  // namespace cardan::solvers
