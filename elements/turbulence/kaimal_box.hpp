/// @file
/// Boxes of Kaimal turbulence.
#pragma once

#include "elements/turbulence/box_statistics.hpp"
#include "elements/turbulence/kaimal.hpp"
#include "elements/turbulence/turbulence_box.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace cardan {

/// Ways to make points coherent at a line of the spectrum.
enum class Synthesis : std::uint8_t {
    automatic,  ///< by whichever of the others is cheaper, line by line
    /// By a factor of the matrix of all points [P. S. Veers, SAND88-0152 (1988)]: exact, points^3/3 operations a line.
    cholesky,
    /// By Fourier transforms across the grid [C. R. Dietrich, G. N. Newsam, SIAM J. Sci. Comput. 18 (1997) 1088]: the
    /// coherence is that of the model within 2e-4, at most lines to the last digits.
    fourier
};

/// Options by which a box is made of a model: which one of all boxes, by what method, on how many threads.
struct KaimalOptions {
    std::uint64_t seed = 1;  ///< another seed is an independent box
    DeviationScaling scaling = DeviationScaling::none;
    Synthesis synthesis = Synthesis::automatic;
    int threads = 1;  ///< 0: one per processor; the box is the same with any number
    /// Called now and then by the calling thread; true ends the work.
    std::function<bool()> cancelled = {};
    /// Called likewise; the work is done when done equals total.
    std::function<void(int done, int total)> progress = {};
};

/// Makes a box of Kaimal turbulence, periodic in time.
///
/// At every line f_k = k/T, T = steps time_step, k = 1 ... steps/2, the amplitudes of all points are complex normal
/// numbers with the coherence of the model: the box is a Gaussian process that has the model's spectra at its lines
/// and its coherence, and nothing else, by whatever method it is made. (Amplitudes of fixed size with random phases, as
/// in TurbSim, have the same spectra and coherence, but depend on the method and the order of the points in everything
/// else, and a point of v or w has the same variance for every seed.) Variances are therefore those of
/// Kaimal::variance_of_lines(), and scatter about them; realised() says what they are. Nothing is at f = 0: the mean of
/// every point is zero. The line at half the sampling rate, of an even number of steps, is real and holds S/T as all
/// others.
///
/// The same options make the same box on every machine, to 1e-6 of the standard deviation, and to the last bit with
/// any number of threads; another grid, time or method is another box. A box of 31 x 31 points and 12 000 steps takes
/// 1.9 s on one core of 2.6 GHz (bench/turbulence.cpp), and 140 MB.
/// @param grid  `lowest` is carried over and has no influence; spacings may differ
/// @return no steps and no numbers if it was cancelled
/// @throws InputError for a model or a grid out of range, such as steps with a prime factor above 100
/// @throws MemoryError for a box that is too large
/// @throws NumericalError for points so close that they move as one
TurbulenceBox kaimal_box(const Kaimal& model, const BoxGrid& grid, const KaimalOptions& options = {});

/// One line that says what a box is made of, for files: "Cardan: Kaimal, V 14 m/s, sigma 2.254 1.8032 1.127 m/s, ...,
/// seed 1".
std::string description(const Kaimal& model, const KaimalOptions& options);

}  // namespace cardan
