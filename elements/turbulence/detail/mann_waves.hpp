/// @file
/// The waves of a box of Mann's turbulence, one plane of wave numbers at a time.
#pragma once

#include "elements/turbulence/detail/fourier.hpp"
#include "elements/turbulence/detail/shear_table.hpp"
#include "elements/turbulence/mann_box.hpp"

#include <array>
#include <span>
#include <vector>

namespace cardan::detail {

/// The numbers that all planes have in common.
struct MannLattice {
    explicit MannLattice(const MannOptions& options);

    MannParameters parameters;
    std::uint64_t seed;
    BoxGrid grid;
    MannDomain domain;
    double dk1, dk2, dk3;  ///< rad/m
    /// Largest indices: those of half a sampling rate are left out.
    int last1, last2, last3;
    double amplitude;       ///< root of alpha epsilon^(2/3) L^(17/3) dk_1 dk_2 dk_3/(4 pi)
    double averaged_below;  ///< (k L)^2
    ShearTable shear;

    /// A of a wave number with k_1 > 0, m/s; those of -k_2 differ by signs (MannPlane).
    Mat3 root(const Vec3& k) const;
};

/// One plane of wave numbers of k_1 = index dk_1 > 0; holds the memory for it. Allocates nothing after the first plane.
class MannPlane {
public:
    explicit MannPlane(const MannLattice& lattice);

    /// Draws the waves A(k) n(k) of all k_2 and k_3.
    void draw(int index);
    /// Transforms a component of what was drawn, sum over k_2, k_3 of waves exp(i(k_2 y + k_3 z)), at the points of the
    /// grid.
    /// @param re, im  rows times columns, by rows
    void transform(int component, std::span<float> re, std::span<float> im);
    /// Sum of A A^T over k_2 and k_3 of what was drawn.
    const Mat3& covariance() const { return covariance_; }
    /// The amplitudes that were drawn: A(k) n(k) of k_2 = index2 dk_2 and k_3 = index3 dk_3.
    const std::array<Complex, 3>& wave(int index2, int index3) const { return waves_[place(index2, index3)]; }

private:
    std::size_t place(int index2, int index3) const;
    void draw_normals(int index1, int index2);
    void draw_line(int index2, bool mirrored);

    const MannLattice* lattice_;
    Fourier fourier_;
    std::array<std::vector<Complex>, 3> normals_;  // of index3, the negative ones behind the others
    std::vector<Mat3> roots_;                      // of index3, likewise
    std::vector<std::array<Complex, 3>> waves_;    // [index2][index3], likewise
    std::vector<Complex> line_, transformed_;
    std::vector<Complex> half_;  // [row][index2], transformed in k_3
    Mat3 covariance_ = Mat3::Zero();
};

}  // namespace cardan::detail
