/// @file
/// Steps toward a periodic steady state with a Jacobian that is constant over the revolution.
#pragma once

#include "solvers/linear/coleman.hpp"
#include "solvers/linear/detail/shifted_states.hpp"
#include "solvers/periodic/detail/rotor_equations.hpp"

#include <map>
#include <memory>
#include <optional>

namespace cardan::solvers {

/// Newton's step for harmonic balance with M, C and K replaced by their means over the revolution in multi-blade
/// coordinates z. Where three or more blades are alike, these matrices hardly depend on the azimuth, so the step is
/// nearly the exact one, and the linear system of n (2 harmonics + 1) rows falls apart into one of n complex rows per
/// harmonic, which the states, further rows behind those of the coordinates, are eliminated from (ShiftedStates):
///
///     (K - (j Omega)^2 M + i j Omega C) dz_j = -(T^T r)_j,    dx = T dz.
class MeanJacobian {
public:
    /// None where that is no use: without multi-blade coordinates, and for two blades, whose equations change with the
    /// azimuth in any coordinates.
    static std::optional<MeanJacobian> make(const RotorMap& rotor, const RotorEquations& equations, int harmonics);

    /// Sets the number of harmonics of the series.
    void set_harmonics(int harmonics);
    /// No step changes the mean of this unknown. @returns false for a blade's coordinate, of which there is none
    bool hold(Eigen::Index row);
    /// Takes the means on the series x, a row per unknown.  Cost O(n^2) at every azimuth
    void set(RotorEquations& equations, const Matrix& x);
    /// The step that cancels the harmonics R of the residual, as far as they matter: those that are a thousandth of the
    /// largest, or smaller than `negligible`, are left for the next step. Most are, and the factors of a harmonic are
    /// computed when they are first needed.
    /// @param negligible  residual / stiffness
    /// @param all  nothing is left for the next step: the step is a linear function of R
    /// @returns false if a matrix is singular (a harmonic in resonance, a blade that nothing holds) or not finite
    bool step(const Matrix& R, double negligible, Matrix& dx, bool all = false);
    /// Unknowns whose mean nothing holds: no step changes it.
    const std::vector<Eigen::Index>& open() const { return open_; }

private:
    MeanJacobian(const ColemanTransform& transform, int parts, double rotor_speed, int harmonics);
    struct Entry {
        Eigen::Index row, column;
        double value;
    };
    void append_states();
    void add_at_zero(const Matrix& block, Eigen::Index first);
    void turn(Matrix& values, double sense) const;
    Matrix to_multi_blade(const Matrix& R) const;
    Matrix from_multi_blade(const Matrix& z) const;
    Vector scale(int harmonic) const;
    const ShiftedStates* factors(int harmonic);
    bool hold_open(const Matrix& stiffness);

    ColemanTransform transform_;
    int parts_;  ///< blades, which take one another's places; 1: none
    double rotor_speed_;
    int harmonics_ = 0, z_harmonics_ = 0;  ///< multi-blade coordinates have more
    std::vector<ColemanTransform::TurningPair> pairs_;
    std::vector<Entry> at_zero_;  ///< T(0), which is sparse
    std::vector<double> azimuths_;
    Matrix basis_, z_basis_;                 ///< at the azimuths, by column
    std::vector<Eigen::Index> held_, open_;  ///< open ones are held, too
    SecondOrderSystem mean_, at_;
    std::unique_ptr<FirstOrderWithStates> moving_, fixed_mean_;  ///< the mean system; as the harmonic 0 has it
    std::map<int, ShiftedStates> factors_;                       ///< by harmonic
};

}  // namespace cardan::solvers
