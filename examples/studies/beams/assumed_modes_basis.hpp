/// @file
/// Assumed functions for the deflections of a clamped beam: Galerkin's method over its length.
#pragma once

#include "mbs/base/types.hpp"

#include <vector>

namespace cardan {

/// Choice of functions. Deflections v, w: polynomials on every piece, with continuous slope; torsion and extension:
/// polynomials on every piece, continuous, or sines over the whole length. All satisfy the conditions at the clamped
/// end. With one piece the bending functions span (x/L)^2 ... (x/L)^(terms + 1).
struct AssumedModesBasis {
    std::vector<double> breaks = {};  ///< ends of the pieces, m, from 0 to L; empty: all stations of the beam
    int bending = 2;                  ///< functions per piece for v, and for w, 2 ... 9 (degree + 1)
    int torsion = 2;                  ///< per piece, 0 (rigid) ... 9 (degree); or number of sines, 0 ... 40
    int extension = 2;                ///< per piece, 0 (inextensible) ... 9 (degree)
    bool sines = false;               ///< torsion: sin((2j - 1) pi x / 2L), j = 1 ...

    /// The basis of the 2018 paper (docs/nrel5mw_paper2018.md): v and w (x/L)^(j+1), j = 1 ... 5; torsion three sines;
    /// inextensible.
    static AssumedModesBasis paper2018(double length);
};

/// The functions that are nonzero at a position, and their derivatives.
struct ShapeValues {
    std::vector<Eigen::Index> column;
    std::vector<double> value, slope, curvature;  ///< f, f', f''
    void add(Eigen::Index at, double f, double d, double dd);
};

/// One family of functions over the length.
class ShapeFunctions {
public:
    enum class Kind : std::uint8_t {
        clamped,     ///< value and slope continuous and zero at x = 0: cubics of Hermite and higher polynomials
        continuous,  ///< value continuous and zero at x = 0: hats and higher polynomials
        sines        ///< sin((2j - 1) pi x / 2L)
    };
    /// @param breaks  ascending from 0; for sines the last one is L
    /// @param terms   functions per piece, or number of sines
    ShapeFunctions(Kind kind, std::vector<double> breaks, int terms);

    Eigen::Index size() const;
    /// Column indices ascend. Derivatives at a break are those of the piece on its left.
    ShapeValues at(double x) const;

private:
    ShapeValues sines(double x) const;
    void clamped(Eigen::Index piece, double xi, double half, ShapeValues& out) const;
    void continuous(Eigen::Index piece, double xi, double half, ShapeValues& out) const;

    Kind kind_;
    std::vector<double> breaks_;
    int terms_;
};

}  // namespace cardan
