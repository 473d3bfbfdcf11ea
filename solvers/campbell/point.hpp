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

/// Interface of the methods that compute modes at one rotor speed after another.
class PointMethod {
public:
    PointMethod() = default;
    PointMethod(const PointMethod&) = delete;
    PointMethod& operator=(const PointMethod&) = delete;
    virtual ~PointMethod() = default;

    /// Of the next point: CampbellCase::start and state_start. Empty ones change nothing.
    virtual void start_from(const Matrix& coordinates, const Matrix& states) = 0;
    /// All points that will be solved, in this order: what is cheap and may fail is done before anything else.
    /// @throws as solve()
    virtual void prepare(std::span<const double> /*rotor_speeds*/) {}
    /// @param rotor_speed  rad/s
    /// @param point  overwritten
    virtual void solve(double rotor_speed, CampbellPoint& point) = 0;
    /// Model index of every row of the modes' shapes.
    virtual const std::vector<int>& unknowns() const = 0;
    /// Names of the rows; blade coordinates are named after blade 1, with the pattern that the row stands for.
    virtual std::vector<std::string> row_names() const = 0;
    /// Names of the states of first order, likewise.
    virtual std::vector<std::string> state_names() const { return {}; }
    /// The (transformed) system of the last point, averaged over the azimuth.
    virtual const SecondOrderSystem& system() const = 0;
    /// Made at the first point; null before.
    virtual const EnergyShares* energy_shares() const = 0;
    /// Blade coordinates at azimuth 0 from the rows of a mode's shape.
    virtual Matrix rotating_coordinates() const = 0;
    /// With loops, how all coordinates of the model move with the unknowns in blade coordinates; empty without.
    virtual Matrix followers(const DynamicState& /*at*/) const { return {}; }
    /// Null without multi-blade rows.
    virtual const ColemanTransform* coleman() const = 0;
    /// A warning about the results so far; usually empty.
    virtual const std::string& warning() const = 0;
    /// Which modes the next point has, where the equations are constant.
    virtual ModeRange& mode_range() = 0;
};

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
/// and machine; one per thread.
class PointSolver : public PointMethod {
public:
    /// @throws InputError for a rotor of two blades, or without multi-blade coordinates, unless the method is Floquet's
    /// (then standstill only)
    PointSolver(const System& system, const RotorMap& rotor, const CampbellOptions& options = {});
    PointSolver(System&&, const RotorMap&, const CampbellOptions& = {}) = delete;  // the system must live longer
    PointSolver(const System&, RotorMap&&, const CampbellOptions& = {}) = delete;  // likewise the map

    void start_from(const Matrix& coordinates, const Matrix& states) override;
    /// The steady-state iteration starts from the previous point. From the second call on with the same `point` nothing
    /// is allocated, but for the shares of blades that differ at standstill and where few of many modes are wanted
    /// (ModeSolver).
    /// @throws NumericalError where no constant steady state exists or is found, and as ModeSolver; the solver can be
    /// used again
    void solve(double rotor_speed, CampbellPoint& point) override;

    const std::vector<int>& unknowns() const override { return unknowns_; }
    std::vector<std::string> row_names() const override;
    std::vector<std::string> state_names() const override;
    const SecondOrderSystem& system() const override { return current_; }
    const EnergyShares* energy_shares() const override { return energy_shares_ ? &*energy_shares_ : nullptr; }
    Matrix rotating_coordinates() const override;
    const std::string& warning() const override { return warning_; }
    Matrix followers(const DynamicState& at) const override;

    /// Coordinates that may move: the unknowns, and with loops those that follow them.
    const std::vector<int>& moving() const { return moving_.empty() ? unknowns_ : moving_; }
    /// About a point where loops may be in motion, without constraints: condense_loops().
    Linearisation linearised_at(const DynamicState& at) const;
    /// Largest part of the (multi-blade) matrices that changes with the azimuth, relative to them. Steady state as in
    /// solve().
    double periodic_remainder(double rotor_speed);
    const ColemanTransform* coleman() const override { return coleman_ ? &*coleman_ : nullptr; }
    /// Of each blade, x^H K_elastic x of its own coordinates; allocates.
    /// @param shape  in blade coordinates, by unknown
    Vector blade_energies(const Linearisation& lin, const ComplexVector& shape) const;
    /// One of the blades may move alone: they differ, or are not evenly spaced. From the first point on, or after
    /// define_components().
    bool blades_stand_out() const;
    /// Defines the components from this linearisation instead of that of the first point; call before the first point.
    void define_components(const Linearisation& lin);
    ModeRange& mode_range() override { return range_; }

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
    void warn(const std::string& what);
    void set_count(std::vector<CampbellMode>& modes, std::size_t count);
    void set_modes(std::size_t count, CampbellPoint& point);

    const System& system_;
    const RotorMap& rotor_;
    CampbellOptions options_;
    ModeRange range_;
    std::vector<int> unknowns_;
    std::vector<int> moving_;  ///< with loops: these, and the coordinates that follow them; empty without
    std::optional<ColemanTransform> coleman_;
    std::vector<MultiBladeRow> plain_rows_;
    std::optional<EnergyShares> energy_shares_;
    std::string warning_;

    SteadySolver steady_solver_;
    Lineariser lineariser_;
    std::optional<ModeSolver> mode_solver_;
    SteadyOptions steady_options_;
    SteadyState steady_;
    DynamicState turned_;
    Linearisation lin_;
    SecondOrderSystem current_, other_;
    std::vector<CampbellMode> spare_;  // memory for modes beyond those of the last point
};

/// Smallest |eigenvalue| of the oscillating modes, rigid ones excluded; infinite without any. Eigenvalues above
/// max_reliable_ratio times as much have growth rates at rounding level.
double lowest_vibration(const std::vector<CampbellMode>& modes);

/// The solver for the method of the options.
/// @throws InputError as the solvers
std::unique_ptr<PointMethod> point_method(const System& system, const RotorMap& rotor, const CampbellOptions& options);

}  // namespace cardan::solvers
