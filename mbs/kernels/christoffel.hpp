/// @file
/// Christoffel symbols of the first kind, Gamma_abc = (d_b g_ac + d_c g_ab - d_a g_bc) / 2.
#pragma once

#include "mbs/base/aligned_numbers.hpp"
#include "mbs/kernels/kinematics.hpp"

#include <span>

namespace cardan {

class ChristoffelSymbols;

/// All Gamma_abc of a tree, packed by branch.
///
/// Gamma_abc is zero unless a, b and c lie on one path from the base. For every body m (the distal one) with the path
/// of d_m bodies down to the base the table holds the d_m x d_m numbers
///
///     K_m(a, b) = Gamma_abm = Gamma_amb   for a, b on the path of m,
///
/// and Gamma_mba = Gamma_mab = -K_m(a, b) for b <= a < m. Everything else is zero.
class Christoffel {
public:
    explicit Christoffel(const Model& model);
    explicit Christoffel(Model&&) = delete;  // the model must live longer

    /// Gamma_abc, any indices.
    double operator()(int a, int b, int c) const;
    /// The table of the distal body m: K_m(a, b) in row depth(a) - 1 and column depth(b) - 1; row-major, rows stride(m)
    /// apart. Rows are padded to whole registers; the padding after the depth(m) numbers has no meaning.
    std::span<const double> table(int m) const;
    std::size_t stride(int m) const;
    /// The path of body m from the base to m itself.
    std::span<const int> path(int m) const;
    /// Number of stored symbols.
    std::size_t stored() const { return stored_; }
    /// Every symbol once, b <= c:  for (auto [a, b, c, value] : gamma.symbols()) ...
    ChristoffelSymbols symbols() const;
    const Model& model() const { return *model_; }

    /// h_a = Gamma_abc qd^b qd^c from the table (the recursion inertial_forces() is O(n) and faster).
    void contract(VectorIn qd, VectorOut h) const { fill_contraction(qd, qd, h); }
    /// h_a = Gamma_abc x^b y^c, symmetric in x and y.
    /// @param h  out, size n, overwritten; must not alias x and y. Cost O(n d^2), no allocation.
    void contract(VectorIn x, VectorIn y, VectorOut h) const { fill_contraction(x, y, h); }
    /// X_ab = Gamma_abc x^c.
    /// @param X  out, n x n, overwritten. Cost O(n d^2), no allocation.
    void along(VectorIn x, MatrixOut X) const { fill_along(x, X); }
    /// Coriolis matrix C_ac = Gamma_abc qd^b, which is along(qd); gdot - 2 C is skew and gdot = C + C^T. (Without the
    /// table, in O(n d): half of dtau_dqd of inverse_dynamics_derivatives().)
    void coriolis(VectorIn qd, MatrixOut C) const { fill_along(qd, C); }

private:
    friend void christoffel_first_kind(const Kinematics&, Christoffel&);
    void fill_contraction(VectorIn x, VectorIn y, VectorOut& h) const;
    void fill_along(VectorIn x, MatrixOut& X) const;

    const Model* model_;
    std::vector<std::size_t> value_offset_, path_offset_;
    std::vector<int> paths_;
    AlignedNumbers values_;
    std::size_t stored_ = 0;
};

/// Fills the table at the q of `kin`. Cost O(n d^2) = the number of symbols; no allocation.
///
///     Gamma_abc = (1 - s_b) sum_k { m_k u_ka . (Omega_kb x u_kc) + (P_k Omega_kb) . (Omega_kc x Omega_ka) },  b <= c,
///
/// collapses over k to the composite body of the more distal of a and c, referred to its centre of mass. Added mass
/// adds (S_a . (S_m x* I S_b) + S_a . I (S_b x S_m) + S_a . (S_b x* I S_m)) / 2 to K_m(a, b), S being twists.
///                                                   [Zhao et al. 2007, eq. 9, corrected: see docs/theory.md]
void christoffel_first_kind(const Kinematics& kin, Christoffel& gamma);

/// X_ab = Gamma_abs for one coordinate s and all a, b, without the table of all symbols.
/// @param X  out, n x n, overwritten
///
/// Cost O(n d) (and n^2 zeros), no allocation. It needs the table of s itself and, from the table of every body m that
/// s carries, the column K_m(a, s) and the row K_m(s, b).
template <class S>
void christoffel_along(const KinematicsT<S>& kin, int s, MatrixOutT<S> X);

/// Gyroscopic matrix of a coordinate that spins steadily, qd = omega e_s (a rotor):
///
///     G_ab = omega (Gamma_abs - Gamma_bas) = omega (d_b g_as - d_a g_bs),   skew: it does no work.
///
/// The inertial forces h = Gamma qd qd have the derivative dh_a/dqd^b = 2 omega Gamma_abs = G_ab + omega d_s g_ab. The
/// symmetric rest is the rate of the metric: zero among the coordinates that the spinning joint carries, and among
/// those inboard of it if the rotor as a whole is isotropic, but not between the two groups.
/// @param omega  rad/s or m/s
/// @param G      out, n x n, overwritten, N m s (or the corresponding unit of translations). Cost O(n d) (and n^2
///               differences), no allocation.
void gyroscopic_matrix(const Kinematics& kin, int s, double omega, MatrixOut G);

}  // namespace cardan

#include "mbs/kernels/christoffel_symbols.hpp"
