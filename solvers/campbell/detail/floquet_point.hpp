/// @file
/// One point of a Campbell diagram by Floquet theory.
#pragma once

#include "solvers/campbell/point.hpp"
#include "solvers/periodic/floquet.hpp"

#include <map>

namespace cardan::solvers {

/// For one rotor speed after another: periodic steady state (harmonic balance, started from the previous one),
/// linearisation about it in multi-blade rows, and Floquet modes with their energy shares or the modes of the azimuthal
/// average. At standstill as PointSolver. Keeps references to system and machine; one per thread.
class PeriodicPointSolver : public PointSolver {
public:
    /// @throws InputError without a rotor, for two blades unless the method is Floquet's, and as ColemanTransform
    PeriodicPointSolver(const System& system, const RotorMap& rotor, const CampbellOptions& options);

    void start_from(const Matrix& coordinates, const Matrix& states) override;
    /// Finds the steady states.
    void prepare(std::span<const double> rotor_speeds) override;
    /// @throws InputError for options out of range; NumericalError where no periodic steady state is found (for example
    /// if a mean load acts on an unrestrained coordinate), and as floquet(); the solver can be used again
    void solve(double rotor_speed, CampbellPoint& point) override;

private:
    void find_steady_state(double rotor_speed);
    PeriodicSystem multi_blade_system() const;
    void set_mean(const PeriodicSystem& periodic);
    BladeSymmetry renumbering() const;
    void set_symmetry(const PeriodicSystem& periodic);
    void warn_of_differing_blades();
    FloquetOptions floquet_options() const;
    void set_floquet_modes(const PeriodicSystem& periodic, CampbellPoint& point);
    void move_state_motions(std::vector<FloquetMode>& modes, CampbellPoint& point) const;
    void set_mean_modes(CampbellPoint& point);
    void leave_out_free_spin(double scale, CampbellPoint& point) const;
    CampbellMode make(FloquetMode&& found) const;
    void set_blade_shares(CampbellPoint& point) const;
    Eigen::Index spin_row() const;
    void warn_once(const std::string& what);

    Matrix start_, state_start_;                      // of the first point
    std::map<double, PeriodicSteadyState> prepared_;  // by rotor speed
    std::optional<PeriodicSteadyState> state_;        // the last one
    BladeSymmetry symmetry_;                          // of the last point; none if the blades differ
    double difference_ = 0;                           // of the blades
    bool structure_differs_ = false;
    bool warned_ = false;
};

/// Row with most kinetic energy if the mode has (almost) no elastic energy, else -1; for modes of constant systems.
int naming_row(const SecondOrderSystem& system, const Mode& mode);

}  // namespace cardan::solvers
