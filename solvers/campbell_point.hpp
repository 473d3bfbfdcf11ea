/// @file
/// One point of a Campbell diagram: everything at one rotor speed.
#pragma once

#include "solvers/campbell.hpp"

#include <optional>

namespace cardan::solvers {

/// Steady state, linearisation, Coleman transformation, modes and their shares of energy at one rotor speed after the
/// other. Its memory, some twenty matrices over the coordinates, is made with the first point. Keeps references to
/// system and machine; one per thread.
class PointSolver {
public:
    /// @throws InputError for two blades, and as ColemanTransform
    PointSolver(const System& system, const RotorMap& rotor, const CampbellOptions& options = {});

    /// The steady state is sought from that of the point before.
    /// @param rotor_speed  rad/s
    /// @param point  overwritten; from the second call on with the same `point` nothing is allocated
    /// @throws NumericalError where no constant steady state exists or is found, and as ModeSolver; the solver can be
    /// used again
    void solve(double rotor_speed, CampbellPoint& point);

    /// Model index of every row of the modes' shapes.
    const std::vector<int>& unknowns() const { return unknowns_; }
    /// Their names; blade coordinates are named after blade 1, with the pattern that their row stands for.
    std::vector<std::string> row_names() const;
    /// Of the last point: the (transformed) system.
    const SecondOrderSystem& system() const { return current_; }
    /// By the first point; null before.
    const Identification* identification() const { return identification_ ? &*identification_ : nullptr; }
    /// Blade coordinates at azimuth 0 from the rows of a mode's shape.
    Matrix rotating_coordinates() const;
    /// What has to be said about the results so far; mostly empty.
    const std::string& warning() const { return warning_; }

private:
    const std::vector<MultiBladeRow>& rows() const { return coleman_ ? coleman_->rows() : plain_rows_; }
    void find_steady_state(double rotor_speed);
    void start();
    void set_system(double rotor_speed);
    void set_other_azimuth(double psi, double rotor_speed);
    void average_if_periodic(double rotor_speed);
    void set_count(std::vector<CampbellMode>& modes, std::size_t count);

    const System& system_;
    const RotorMap& rotor_;
    CampbellMethod method_;
    std::vector<int> unknowns_;
    std::optional<ColemanTransform> coleman_;
    std::vector<MultiBladeRow> plain_rows_;
    std::optional<Identification> identification_;
    std::string warning_;

    SteadySolver steady_solver_;
    Lineariser lineariser_;
    ModeSolver mode_solver_;
    SteadyOptions steady_options_;
    SteadyState steady_;
    OperatingPoint turned_;
    Linearisation lin_;
    SecondOrderSystem current_, other_;
    std::vector<CampbellMode> spare_;  // memory for modes beyond those of the last point
};

}  // namespace cardan::solvers
