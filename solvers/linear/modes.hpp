/// @file
/// Complex modes of a second-order system.
#pragma once

#include "solvers/algebra/dense.hpp"
#include "solvers/algebra/real_eigen.hpp"
#include "solvers/linear/linearise.hpp"
#include "solvers/linear/state_shares.hpp"

#include <limits>

namespace cardan::solvers {

/// x(t) = Re(shape exp(eigenvalue t)); for oscillations the member of the conjugate pair with Im(eigenvalue) > 0.
struct Mode {
    Complex eigenvalue;   ///< 1/s
    ComplexVector shape;  ///< over the rows of the system, unit modal energy x^H K_e x + |lambda|^2 x^H M x = 2 (J)
    /// Over the states of first order; empty without.
    ComplexVector states = {};
    /// Fraction of the mode that is motion of these states, 0 ... 1: their share in the product of left and right
    /// eigenvector, |w^H s| : |y^H (2 lambda M + C) x - w^H f_qd x|, which does not depend on units and scales. From
    /// 1/2 on it is the states' motion (a lag, a current, an inflow) rather than a vibration, whether it oscillates or
    /// not; energy is not of the essence there, and `shape` and `states` are normalised together to a largest scaled
    /// state of 1.
    double state_share = 0;

    bool is_state_motion() const { return state_share >= 0.5; }
    bool oscillates() const { return eigenvalue.imag() > 0; }
    double natural_hz() const { return std::abs(eigenvalue) / (2 * pi); }
    double damped_hz() const { return eigenvalue.imag() / (2 * pi); }
    /// Fraction of critical damping, -Re(lambda) / |lambda|.
    double damping_ratio() const { return -eigenvalue.real() / std::abs(eigenvalue); }
};

/// Ratio to the lowest frequency above which a mode is dominated by rounding error: see ModeSolver.
inline constexpr double max_reliable_ratio = 1e7;

/// All oscillating modes by natural frequency, then the aperiodic ones (real eigenvalues). Rigid-body modes (|lambda|
/// below 1e-4 of the lowest single-coordinate frequency, such as the zero pair of a free rotor) are left out. Low modes
/// are computed to working precision however stiff the others are; a mode at r times the lowest frequency has an error
/// of about 1e-16 r^2. Above 1e6 times the lowest frequency (a coordinate with almost no mass) a mode that does not
/// satisfy the equations to one per cent is regarded as rounding and left out.
///
/// With states of first order the problem is that of twice the rows and the states, solved densely unless
/// has_many_states(); zero eigenvalues are then left out only where they are rigid-body motions, not integrators.
///
/// Made once for a number of rows and states: only the memory is kept from one system to the next. One per thread.
class ModeSolver {
public:
    explicit ModeSolver(Eigen::Index rows, Eigen::Index states = 0);

    /// Results are valid until the next call. Cost of one real eigenvalue problem of twice the size; nothing is
    /// allocated.
    ///
    /// Where only the modes up to a frequency are wanted, they come from shift-invert Arnoldi with the same shift
    /// (dominant_eigenvalues(), which allocates), as exactly as all of them; from the dense solver if the system is
    /// small, or if a Krylov space of half of all states does not suffice. NREL 5 MW with 176 unknowns: 7 ms instead of
    /// 47 for the 16 modes below 4 Hz.
    /// Of systems with many states (has_many_states()) they are those that the modes without lags become, one after
    /// another, the states eliminated group by group (GroupedMatrix): all with a damping ratio below 0.4 without lags,
    /// and most of the others. Motions of states are not looked for, but the argument principle tells that none grows
    /// (by more than 1e-5 of `largest`). Where one does, or a mode is lost, the solver is
    /// the dense one.
    /// @param largest  of the |eigenvalue| wanted, rad/s; > 0
    /// @returns the number of modes
    /// @throws NumericalError if a matrix is not finite, the mass matrix is not positive definite or the eigenvalue
    /// iteration fails; the solver can be used again
    std::size_t solve(const SecondOrderSystem& system, double largest = std::numeric_limits<double>::infinity());

    /// Mode::state_share of a mode.
    double state_share(std::size_t mode) const;
    /// @param out  overwritten; nothing is allocated if its shape has the right size already
    void copy(std::size_t mode, Mode& out) const;
    /// See the free function of the same name.
    void energy_by_row(std::size_t mode, Vector& out) const;

private:
    struct Found {
        Complex eigenvalue;
        Eigen::Index column;  // of shapes_: real part, with the imaginary part in the next column
        double state_share = 0;
    };
    void set_units(const SecondOrderSystem& system, double scale);
    void shift(const SecondOrderSystem& system, double scale);
    void shift_states(const StateTerms& states, double scale);
    double share_by_iteration(const SecondOrderSystem& system, const Found& found) const;
    void solve_all(const SecondOrderSystem& system, double scale);
    void balance();
    bool solve_few(double scale, double largest);
    bool solve_motions(const SecondOrderSystem& system, double scale, double largest);
    void add(Complex mu, double scale);
    bool moves_no_state(const Found& found) const;
    void normalise(const SecondOrderSystem& system);

    RealEigen eigen_;
    StateShares shares_;
    Eigen::Index rows_, states_;
    Vector d_;                            // inverse roots of the diagonal of the mass matrix, then scales of the states
    LuFactors K_s_;                       // shifted stiffness
    Matrix mass_;                         // scratch of the check
    Matrix right_, S_;                    // right sides, inverse of the shifted state matrix
    Vector balance_;                      // with states: vectors of S over those of the balanced matrix
    Matrix shapes_, elastic_, inertial_;  // of all modes side by side; K_e x, M x
    Eigen::Index columns_ = 0;            // of these that are in use
    std::vector<Found> found_;
    /// Up to here there were more modes than is worth it once, rad/s: the next system, one of a sweep, is like it.
    double too_many_ = std::numeric_limits<double>::infinity();
};

/// Whether there are more states than rows, and so many of both (300 numbers) that a dense solver takes long.
bool has_many_states(const SecondOrderSystem& system);

/// The modes, with a temporary ModeSolver.
std::vector<Mode> modes(const SecondOrderSystem& system, double largest = std::numeric_limits<double>::infinity());

/// Energy products x^H K_e y + conj(lambda_x) lambda_y x^H M y of many modes x with one mode y.
class EnergyProduct {
public:
    EnergyProduct(const SecondOrderSystem& system, const Mode& y);
    Complex with(const Mode& x) const;

private:
    ComplexVector elastic_, momentum_;  // K_e y, lambda_y M y
};

/// Energy product of two modes; complex MAC = |xy|^2 / (xx yy).
Complex energy_product(const SecondOrderSystem& system, const Mode& x, const Mode& y);

/// EnergyFraction of every row in the elastic energy of a mode, Re conj(x_i) (K_e x)_i over the total: sums to one.
/// Entries of coupled rows (the six coordinates of a beam element) may be negative.
Vector energy_by_row(const SecondOrderSystem& system, const Mode& mode);

}  // namespace cardan::solvers
