/// @file
/// Christoffel symbols of the first kind, Gamma_abc = (d_b g_ac + d_c g_ab - d_a g_bc) / 2.
#pragma once

#include "mbs/kinematics.hpp"

#include <span>

namespace cardan {

/// All Gamma_abc of a tree, packed by branch.
///
/// Gamma_abc is zero unless a, b and c lie on one path from the base. For every body m (the distal one) with the path
/// of d_m bodies down to the base the table holds the d_m x d_m numbers
///   K_m(a, b) = Gamma_abm = Gamma_amb   for a, b on the path of m,
/// and Gamma_mba = Gamma_mab = -K_m(a, b) for b <= a < m. Everything else is zero.
class Christoffel {
public:
    explicit Christoffel(const Model& model);

    /// Gamma_abc, any indices.
    double operator()(int a, int b, int c) const;
    /// The table of the distal body m: K_m(a, b) in row depth(a) - 1 and column depth(b) - 1; row-major, rows
    /// stride(m) apart: whole registers, what follows the depth(m) numbers of a row has no meaning.
    std::span<const double> table(int m) const;
    std::size_t stride(int m) const;
    /// The path of body m from the base to m itself.
    std::span<const int> path(int m) const;
    /// Number of stored symbols.
    std::size_t stored() const { return stored_; }

    /// h_a = Gamma_abc qd^b qd^c from the table (the recursion inertial_forces() is O(n) and faster).
    void contract(VectorIn qd, VectorOut h) const;
    /// Coriolis matrix C_ac = Gamma_abc qd^b; gdot - 2 C is skew and gdot = C + C^T.
    void coriolis(VectorIn qd, MatrixOut C) const;

private:
    friend void christoffel_first_kind(const Kinematics&, Christoffel&);
    const Model* model_;
    std::vector<std::size_t> value_offset_, path_offset_;
    std::vector<int> paths_;
    std::vector<Packed3<double>> values_;
    std::size_t stored_ = 0;
};

/// Fills the table at the q of `kin`. Cost O(n d^2) = the number of symbols; no allocation.
///
///   Gamma_abc = (1 - s_b) sum_k { m_k u_ka . (Omega_kb x u_kc) + (P_k Omega_kb) . (Omega_kc x Omega_ka) },  b <= c,
///
/// collapses over k to the composite body of the more distal of a and c, referred to its centre of mass.
///                                                   [Zhao et al. 2007, eq. 9, corrected: see docs/theory.md]
void christoffel_first_kind(const Kinematics& kin, Christoffel& gamma);

}  // namespace cardan
