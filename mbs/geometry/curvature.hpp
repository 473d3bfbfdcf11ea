/// @file
/// Levi-Civita connection and Riemann curvature of the configuration space.
#pragma once

#include "mbs/geometry/embedding.hpp"
#include "mbs/kernels/metric_factor.hpp"

namespace cardan {

/// Covariant derivative and curvature of the metric g at one q.
///
/// Signs follow Misner, Thorne and Wheeler (1973) and agree with do Carmo's sectional curvature (positive on a sphere):
///
///     R^a_bcd = d_c Gamma^a_bd - d_d Gamma^a_bc + Gamma^a_ce Gamma^e_bd - Gamma^a_de Gamma^e_bc
///     R_abcd = g_ae R^e_bcd
///     D^2 xi^a/dt^2 = -R^a_bcd qd^b xi^c qd^d                             for neighbouring geodesics
///     K(x, y) = R_abcd x^a y^b x^c y^d / (|x|^2 |y|^2 - <x, y>^2)
///
/// No derivative of a Christoffel symbol is formed. The configuration space lies in the flat space of the positions of
/// all mass points (see Embedding); with the normal part of the second derivatives, the second fundamental form
/// II_ab = r_ab - r_e Gamma^e_ab, Gauss' equation is
///
///     R_abcd = <II_ac, II_bd> - <II_ad, II_bc> .                                       [do Carmo 1992, chapter 6]
///
/// Driven coordinates are held fixed: the space is that of the free ones, with the metric g_ff. Entries of driven
/// coordinates count as zero in arguments and are zero in results.
///
/// Nothing allocates after construction. The object is bound to the q of the last update() and serves one thread.
class Curvature {
public:
    /// Driven are the coordinates that have this role in the coordinate table.
    explicit Curvature(const Model& model);
    explicit Curvature(Model&&) = delete;  // the model must live longer
    /// @param driven  size n; true: held fixed
    /// @throws InputError if `driven` has another size.
    Curvature(const Model& model, std::vector<bool> driven);

    /// Must be called first at a new q. After a failure nothing else may be called. Cost O(n d^2).
    PivotStatus update(const Kinematics& kin);

    /// h_a = Gamma_abc x^b y^c without any table. Cost O(n).
    /// @param h  out, size n; must not alias x and y
    void christoffel(VectorIn x, VectorIn y, VectorOut h);
    /// DV^a/dt = dV^a/dt + Gamma^a_bc qd^b V^c of a vector V given along a motion. Cost O(n d).
    /// @param V, Vdot  components and their rates, size n
    /// @param DV       out, size n; may alias Vdot
    void covariant_derivative(VectorIn qd, VectorIn V, VectorIn Vdot, VectorOut DV);
    /// qdd^a = -Gamma^a_bc qd^b qd^c, motion without forces. Cost O(n d).
    void geodesic(VectorIn qd, VectorOut qdd);

    /// out_a = R_abcd y^b z^c w^d. Cost O(n d): O(n) and two solutions with the factor.
    /// @param out  size n; must not alias the arguments
    void contract(VectorIn y, VectorIn z, VectorIn w, VectorOut out) { gauss(y, z, w, out); }
    /// Curvature force f_a = R_abcd qd^b xi^c qd^d, N m or N for coordinates xi. Cost O(n d).
    void force(VectorIn qd, VectorIn xi, VectorOut f) { gauss(qd, xi, qd, f); }
    /// Geodesic deviation D^2 xi^a/dt^2 = -R^a_bcd qd^b xi^c qd^d. Cost O(n d).
    void deviation(VectorIn qd, VectorIn xi, VectorOut acceleration);
    /// R_ac = R_abcd qd^b qd^d, the matrix of force() in xi: symmetric, R qd = 0. Computed from composite bodies in O(n
    /// d) and one product of n x n matrices:
    ///
    ///     R_ac = <r_ac, II_bd qd^b qd^d> - <d/dt r_a, d/dt r_c> + C_ea g^ef C_fc,      C_ac = Gamma_abc qd^b.
    ///
    /// @param R  out, n x n, overwritten
    void matrix(VectorIn qd, MatrixOut R);

    /// R_abcd x^a y^b z^c w^d. Cost O(n d).
    double riemann(VectorIn x, VectorIn y, VectorIn z, VectorIn w);
    /// Sectional curvature of the plane of x and y, 1/(kg m^2); lengths of x and y and the angle between them do not
    /// matter. NaN if they are parallel. Cost O(n d).
    double sectional(VectorIn x, VectorIn y);

    /// g_ff = L^T L at the last update.
    MetricFactor& factor() { return factor_; }

private:
    struct Direction {
        Vector x;
        VelocityField field;
    };
    void load(VectorIn x, Direction& direction) const;
    void normal(const Direction& x, const Direction& y, AccelerationField& II);
    template <class X>
    void zero_driven(X& x) const;
    void gauss(VectorIn y, VectorIn z, VectorIn w, VectorOut& out);
    void gather_composites(const VelocityField& v, const AccelerationField& a);
    void fill_row(int m, const VelocityField& v, MatrixOut R);

    const Model* model_;
    MetricFactor factor_;
    Embedding embedding_;
    Direction x_, y_, z_, w_;
    AccelerationField first_, second_;
    Vector zero_, beta_, other_;
    Matrix C_;  ///< Coriolis matrix, then L^-T C

    /// Mass, centre and mean velocity of a subtree, its central moments of velocity and position (the last is Binet's
    /// tensor), force and virial int rho (x - o) a^T dV of an acceleration field about the joint origin.
    struct Composite {
        double M = 0;
        Vec3 C, V, F;
        Mat3 vv, vx, xx, virial;
    };
    std::vector<Composite> composites_;
};

}  // namespace cardan
