/// @file
/// Linear periodic systems of which few combinations of the coordinates see that they are periodic.
#pragma once

#include "solvers/algebra/radau.hpp"
#include "solvers/periodic/detail/transition_step.hpp"
#include "solvers/periodic/periodic_system.hpp"

#include <optional>

namespace cardan::solvers {

/// Each matrix is its mean and a part that varies in few directions, the same for all,
///
///     A(t) = A_0 + B a(t) B^T,      A = M, C, K;  B [n x r], r < n.
///
/// A rotor on a tower is one: the tower's own equations are constant in the fixed frame, those of the blades in the
/// rotating one, and what the two have in common are resultant forces and moments of the blades and motions of the hub.
class VaryingPart {
public:
    /// Number of azimuths at which the matrices are taken.
    static constexpr int azimuths = 24;

    /// @param system     of period 2 pi
    /// @param frequency  largest one of interest, per period: what of M and C does to it is compared with K
    /// @param tolerance  of error()
    /// @returns none for a system of first order or with states beside the coordinates, if more than half of the
    /// directions vary, or more than 8 harmonics, or if the form does not hold to the tolerance at other times as well
    ///
    /// Cost: the matrices at 27 times, and 100 n^2 r.
    static std::optional<VaryingPart> find(const PeriodicSystem& system, double frequency, double tolerance);

    const SecondOrderSystem& mean() const { return mean_; }
    /// B
    const Matrix& directions() const { return B_; }
    /// m, c and k side by side, r x 3 r.
    Matrix at(double time) const;
    /// Largest entry that is left of K, f C and f^2 M with the frequency f, over the roots of the diagonals of K_0 +
    /// M_0, K_0 + f M_0 and K_0 + f^2 M_0: twice the relative error of frequencies of one per period and more.
    double error() const { return error_; }

private:
    VaryingPart() = default;
    double remainder(const PeriodicSystem& system, double time, double frequency) const;

    SecondOrderSystem mean_;
    Matrix B_;
    Matrix series_;  // of at(): Fourier coefficients by column
    double error_ = 0;
};

/// A step by Radau's method that costs the elimination of its varying part only: with the accelerations of the system
/// of the mean from unit states and from forces p along B at the stages, which depend on the length of the step alone,
///
///     p_i = -(m_i B^T q''_i + c_i B^T q'_i + k_i B^T q_i)
///
/// are s r equations. Cost for s stages: 8/3 (s r)^3 + 8 (s r)^2 n + 8 s r n^2; for a new length that of all equations.
class VaryingPartStep : public TransitionStep {
public:
    VaryingPartStep(const VaryingPart& part, int stages) : part_(part), method_(stages) {}
    void set(double t, double h, Matrix& Phi) override;

private:
    void set_length(double h);
    Matrix at_end(const Matrix& accelerations) const;

    const VaryingPart& part_;
    RadauIIA method_;
    double h_ = 0;
    Matrix free_, forced_;  // B^T q'' at the stages from states and from forces
    Matrix Phi_0_, Phi_p_;  // of the system of the mean, and what forces change at the end
    Matrix delta_, left_, forces_;
};

}  // namespace cardan::solvers
