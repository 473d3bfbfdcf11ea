/// @file
/// Random numbers on a grid across the wind with an exponential correlation: one line of the spectrum of a box.
#pragma once

#include "elements/turbulence/detail/fourier.hpp"
#include "elements/turbulence/random_numbers.hpp"
#include "mbs/base/decompositions.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cardan::detail {

/// The points of a grid across the wind.
struct PlaneGrid {
    int rows = 0, columns = 0;
    double row_spacing = 0, column_spacing = 0;  ///< m

    int points() const { return rows * columns; }
    double distance(int rows_apart, int columns_apart) const;  ///< m
};

/// Ways to make numbers that correlate.
enum class PlaneMethod : std::uint8_t {
    independent,  ///< they do not
    cholesky,     ///< a triangular factor of the matrix of all pairs of points, points^3/3 operations
    fourier       ///< a Fourier transform on a torus around the grid [Dietrich, Newsam, SIAM J. Sci. Comput. 18 (1997)]
};

/// Complex normal numbers z_i at the points of a grid, in rows, E z_i conj(z_j) = exp(-rate d_ij), E z_i z_j = 0.
///
/// On a torus of R x C points, with the distance the short way round, the correlation is a circulant matrix, the
/// eigenvalues of which are its own Fourier transform. They need not be positive, as the correlation has a kink half
/// way round: those that are not become zero. With s the share of what is taken away in the sum of all, no correlation
/// between two points changes by more than 2 s. Tori are taken larger until 2 s is at most `cut_off`, and at most
/// `cut_off_of_difference` of what neighbours lack of a correlation of 1. A torus may be shorter than twice the grid:
/// the short way round is then too short for the points furthest apart, which correlate by less than `neglected` either
/// way. In all the error stays below largest_error().
class CorrelatedPlane {
public:
    static constexpr double cut_off = 1e-4, neglected = 1e-4, cut_off_of_difference = 1e-2;
    static constexpr double largest_error() { return cut_off + neglected; }

    /// @param fields  how many sets of numbers are drawn per rate: what is cheaper depends on it
    CorrelatedPlane(const PlaneGrid& grid, int fields);

    /// Prepares a rate, 1/m, by the cheapest method that keeps the error.
    void prepare(double rate);
    /// Prepares a rate by that method; by `fourier` only if a torus of at most 2^26 points is large enough.
    /// @throws NumericalError if none is, or points are so close that their matrix is singular
    void prepare(double rate, PlaneMethod method);
    PlaneMethod method() const { return method_; }
    int torus_rows() const { return torus_rows_; }
    int torus_columns() const { return torus_columns_; }

    /// out = scale z as real and imaginary parts, at all points.
    void draw(const NormalNumbers& numbers, double scale, std::span<float> re, std::span<float> im);
    /// E z_i conj(z_j) of what draw() makes, as computed from its factors; slow.
    Matrix covariance();

private:
    bool find_torus(double rate, double allowed_cost);
    double negative_share(double rate);  // of the present torus, the roots of which it makes
    void factorise(double rate);
    double torus_cost() const;
    double cholesky_cost() const;

    PlaneGrid grid_;
    int fields_;
    PlaneMethod method_ = PlaneMethod::independent;
    int torus_rows_ = 0, torus_columns_ = 0;
    Fourier fourier_;
    std::vector<double> roots_;  // of the eigenvalues over their number, [row][column] of the torus
    std::vector<Complex> line_, waves_, half_;
    Matrix matrix_, z_, product_;
    Eigen::LLT<Matrix> llt_;
};

}  // namespace cardan::detail
