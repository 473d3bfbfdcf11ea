/// @file
/// Equations of a circuit over its loops, evaluated without allocation.
#pragma once

#include "elements/controllers/control_signal.hpp"
#include "elements/electric/inductance.hpp"
#include "mbs/base/decompositions.hpp"

#include <string>
#include <vector>

namespace cardan::detail {

/// Equations of a circuit: with the currents j of the links that are windings, i = A_j j + A_s v - A_c u of all
/// branches, v of the sources and u of the capacitors, and d lambda/dt = F_j j + F_s v - F_c u - dphi/dq qd.
class CircuitEquations {
public:
    static constexpr int max_size = 24;  ///< links that are windings, capacitors, sources, coordinates
    using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_size, 1>;
    using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_size, max_size>;

    /// A term of the inductances, over the links.
    struct Term {
        Matrix shape;
        Eigen::Index coordinate;
        CurveOf factor;
    };
    /// Flux of permanent magnets through the loops.
    struct Magnet {
        Vector shape;
        Eigen::Index coordinate;
        CurveOf flux;
    };
    struct Source {
        std::function<double(double)> over_time;
        ControlWire signal;
    };

    std::string name;
    Matrix A_j, A_s, A_c, F_j, F_s, F_c;
    Vector resistance;  ///< of all branches
    Vector capacitance;
    std::vector<Eigen::Index> capacitors, source_branches;  ///< rows of A
    Matrix constant;                                        ///< of the inductances, over the links
    std::vector<Term> terms;
    std::vector<Magnet> magnets;
    std::vector<Source> sources;
    Eigen::Index coordinates = 0;  ///< of terms and magnets: the first ones of the element

    void rates(const ElementView& in, VectorOut& Q, VectorOut& f) const;
    void jacobian(const ElementView& in, ElementJacobian& d) const;
    ElementPower power(const ElementView& in) const;
    /// Currents of all branches, A.
    Vector branch_currents(const ElementView& in) const;
    /// Forces on the coordinates.
    Column forces(const ElementView& in) const;
    /// @throws InputError unless the inductance matrix of the loops is positive definite
    void check(const Column& q) const { static_cast<void>(factorised(q)); }
    /// Inductances of the loops, H, with all coordinates zero.
    Vector inductance_at_zero() const { return inductance(Column::Zero(coordinates)).diagonal(); }

    Eigen::Index links() const { return constant.rows(); }

private:
    Square inductance(const Column& q) const;
    Eigen::LLT<Square> factorised(const Column& q) const;
    Column source_voltages(const ElementView& in) const;
    Column link_currents(const ElementView& in) const;
    Column forces(const ElementView& in, const Column& j) const;
    void refuse(const Column& q) const;
};

}  // namespace cardan::detail
