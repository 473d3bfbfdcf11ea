/// @file
/// The three-phase grid that a machine feeds: a stiff voltage, undisturbed or disturbed.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace cardan {

/// Symmetrical voltage of an infinite bus, as its components in axes d, q that turn with the nominal frequency and have
/// phase a at its positive peak at time 0 (amplitude-invariant):
///
///     v_a(t) = v_d cos(w t) - v_q sin(w t),   v_d + i v_q = peak() amplitude(t) exp(i angle(t)).
struct Grid {
    double line_voltage = 0;  ///< nominal, V, root mean square between two lines
    double frequency = 50;    ///< nominal, Hz
    /// Voltage over the nominal one; empty: 1.
    std::function<double(double time)> amplitude = {};
    /// Angle ahead of the nominal axes, rad, and its rate, rad/s; empty: 0.
    struct Angle {
        double value = 0, rate = 0;
    };
    std::function<Angle(double time)> angle = {};
    /// Times, s, from which to which the machine is cut off.
    struct Interruption {
        double from = 0, to = 0;
    };
    std::vector<Interruption> interruptions = {};
    std::vector<double> breaks = {};  ///< times, s, at which amplitude or angle are not smooth; interruptions are known

    double omega() const;  ///< nominal, rad/s
    double peak() const;   ///< of the phase voltage, nominal, V
    std::array<double, 2> voltage(double time) const;
    Angle angle_at(double time) const { return angle ? angle(time) : Angle{}; }
    bool connected(double time) const;
    /// All times across which something jumps, ascending.
    std::vector<double> all_breaks() const;

    /// The grid with a disturbance more; they multiply and add up.
    /// Voltage lower by `depth` (0.5: half is left) from `start` for `duration`.
    Grid with_sag(double depth, double start, double duration) const;
    Grid with_phase_jump(double jump, double at) const;
    /// Frequency other by `hertz` from `start` on, for `duration`.
    Grid with_frequency_change(double hertz, double start, double duration) const;
    Grid with_interruption(double start, double duration) const;

    /// @throws InputError for a voltage or a frequency that is not positive, and interruptions that end before they
    /// begin
    void check(const std::string& where) const;
};

}  // namespace cardan
