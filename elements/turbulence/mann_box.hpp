/// @file
/// Boxes of turbulence with Mann's spectral tensor.
#pragma once

#include "elements/turbulence/mann_tensor.hpp"
#include "elements/turbulence/turbulence_box.hpp"

#include <cstdint>
#include <functional>

namespace cardan {

/// Aims that a box is scaled to: one factor for all of it, so that it stays without divergence and keeps the model's
/// ratios.
enum class MannScaling : std::uint8_t {
    none,      ///< nothing: the dissipation stands, less the variance of eddies that the box has no wave numbers for
    expected,  ///< the deviation of u expected of all seeds: single boxes scatter about it, as the wind does
    centre,    ///< the deviation of u at the centre of the grid (centre_row(), centre_column())
    points     ///< the root of the mean variance of u over all points
};

/// Meanings of the amplitudes of large eddies, k L < 6.
enum class LargeEddies : std::uint8_t {
    averaged,  ///< for the cells between wave numbers across, over which the tensor is averaged: spectra are right
    pointwise  ///< for the tensor at the wave number itself: no divergence, but u lacks variance and w has too much
};

struct MannOptions {
    BoxGrid grid;      ///< `lowest` has no influence
    double speed = 0;  ///< with which the air passes the grid, m/s: planes lie speed time_step apart
    MannParameters parameters;
    std::uint64_t seed = 1;
    /// Periods across, m: the turbulence is made wider and higher than the grid and cut. 0: those of mann_domain().
    double width = 0, height = 0;
    LargeEddies eddies = LargeEddies::averaged;
    MannScaling scaling = MannScaling::none;
    double sigma = 0;  ///< what to scale to, m/s
    PlaneOrder order = PlaneOrder::last_first;
    int threads = 1;  ///< 0: one per processor; the box is the same with any number
    /// Called now and then by the calling thread; true ends the work.
    std::function<bool()> cancelled = {};
    /// Called likewise; the work is done when done equals total.
    std::function<void(int done, int total)> progress = {};
};

/// The domain that a box is cut from: periodic in all directions.
struct MannDomain {
    int rows = 0, columns = 0;     ///< even, without prime factors above 5
    double width = 0, height = 0;  ///< periods, m
};

/// Domain of a box: with periods as asked or, where that is 0, of twice the grid and of 8 L at least, rounded up to a
/// number of points that is fast to transform.
///
/// Twice the grid, as what is a period apart is the same: a rotor as wide as the period would see one eddy on both
/// sides. 8 L for the coherence of large eddies, for which there are few wave numbers: with 8 L, that of points up to
/// 2 L apart is off by up to 0.002 at k_1 L = 4, 0.02 at 1 and, at 0.1, 0.09 (u), 0.26 (v) and 0.03 (w); with 12 L by
/// 0.04, 0.15 and 0.02 there. Cost is in proportion to the domain's area, here mostly four times that of the grid.
/// @throws InputError for anything in the options that is out of range
MannDomain mann_domain(const MannOptions& options);

/// A box and what is known of it; realised() says what the one at hand holds.
struct MannBox : TurbulenceBox {
    MannDomain domain;
    /// Covariances of u, v, w expected of all seeds, the sum of the tensor over the wave numbers of the domain, times
    /// the square of the factor if that is the same for all seeds, m^2/s^2. To compare with: mann_covariance().
    Mat3 expected = Mat3::Zero();
    double factor = 1;  ///< by which the box was scaled
};

/// Makes a box of turbulence with Mann's tensor: periodic in time, Gaussian, without a mean at any point [J. Mann,
/// Prob. Eng. Mech. 13 (1998) 269-282].
///
///     u(x) = sum_k A(k) n(k) exp(i k.x),      A A^T = Phi(k) dk_1 dk_2 dk_3,      n(-k) = conj n(k)
///
/// with complex normal numbers n, E|n_j|^2 = 1, over the wave numbers of the domain without those of k_1 = 0 and
/// without those at half a sampling rate, which have no mirror image. The tensor has peaks at wave numbers across of
/// the size of k_1, which fall between those of the domain when k_1 is small. Large eddies (k L < 6) are therefore
/// those of the mean of the tensor over the cells around wave numbers across, in the spirit of the correction in the
/// cited paper; the spectra at a point then are the tensor's. Of these eddies the divergence is not quite zero.
/// LargeEddies::pointwise takes the tensor as it is; then a domain of 8 L, 8 km long, has 0.67 of the variance of u
/// and 1.35 of that of w, the latter the larger the longer the box.
///
/// What no option can hold are eddies longer than the box or smaller than twice a spacing: `expected` says what there
/// is. Of L = 33.6 m, 5 m across and 600 s at 10 m/s it is 0.84, 0.88 and 0.83 of the variances of u, v and w.
///
/// A number n depends on the seed and on its wave number's three indices only: the same options make the same box on
/// every machine, to 1e-6 of the standard deviation, and to the last bit with any number of threads; a finer grid in
/// the same domain and time has the same large eddies.
///
/// Cost: 12 000 steps of 31 x 31 points, from a domain of 60 x 60, take 5.4 s on one processor of 2.6 GHz, 8192 of
/// 32 x 32 from 72 x 72 5.2 s: in proportion to steps, rows and columns of the domain. Memory: the box, four bytes a
/// number (138 MB), and some planes per thread.
/// @return no steps and no numbers if it was cancelled
/// @throws InputError for a grid, parameters, periods out of range, such as steps with a prime factor above 100
/// @throws MemoryError for a box that is too large
MannBox mann_box(const MannOptions& options);

}  // namespace cardan
