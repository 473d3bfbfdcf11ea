/// @file
/// Frequencies at which a turning machine under gravity answers to motions of its base, and the amplitudes there.
#pragma once

#include "mbs/base/types.hpp"

#include <string>
#include <vector>

namespace cardan::floating {

/// Frequencies, each once.
std::vector<double> distinct_frequencies(const std::vector<double>& hz);

/// Sums of sines in a stretch of time: of the motions first, then what they and the rotor's turns combine to.
struct Lines {
    std::vector<double> hz;
    std::size_t own = 0;  ///< the first ones are those of the motions, each frequency once
};

/// Blades feel a motion of frequency f at f and, as their directions turn, at |f +- Omega|; the fixed parts see f and,
/// where blades do not bend alike, |f +- n Omega|. Gravity alone has n Omega, and what is of second order 2 f. What the
/// stretch cannot tell from a line before it is left out.
/// @param rotor_hz  0: standstill
/// @param window    s
Lines response_lines(const std::vector<double>& motions_hz, double rotor_hz, double window);

/// The shortest stretch that tells the motions' frequencies from one another and from n Omega and |f +- n Omega|; those
/// that coincide (a period of two revolutions, f = Omega - f) are one.
struct Resolution {
    double window = 0;   ///< s
    double hz = 0;       ///< of the motion that asks for it
    double beside = 0;   ///< Hz, the frequency next to it
    std::string nature;  ///< of that: "the difference to the rotor's"
};
Resolution needed_resolution(const std::vector<double>& motions_hz, double rotor_hz);

/// Mean and all lines together by least squares: none of them hides in another.
class LineFit {
public:
    /// @param time  s, more samples than twice the lines
    LineFit(const std::vector<double>& time, Lines lines);
    struct Amplitudes {
        std::vector<double> own;  ///< of the motions' frequencies
        double rest = 0;          ///< quadratic mean of what no line explains: transients, other frequencies
    };
    /// @param values  at the times
    Amplitudes operator()(const std::vector<double>& values) const;

private:
    Lines lines_;
    Matrix basis_, normal_;
};

}  // namespace cardan::floating
