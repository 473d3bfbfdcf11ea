/// @file
/// The usual controller of a turbine with variable speed and pitch: torque over filtered generator speed below rated
/// power, constant power and a PI controller of the pitch above.
#pragma once

#include "elements/controllers/torque_law.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace cardan {

/// Gains of a PI controller from the speed of the generator to the pitch, at a pitch.
struct PitchGains {
    double pitch = 0;         ///< rad
    double proportional = 0;  ///< s (rad per rad/s)
    double integral = 0;      ///< 1 (rad per rad)
};

/// A row of minimum pitches.
struct PitchAtSpeed {
    double speed = 0;  ///< of the generator, rad/s
    double pitch = 0;  ///< rad
};

/// Parameters, SI, of the generator's side of the gearbox.
///                    [J. Jonkman, S. Butterfield, W. Musial, G. Scott 2009, NREL/TP-500-38060, section 7]
struct VariableSpeedParameters {
    std::string name = "variable-speed controller";
    double period = 0;            ///< s, between two samples
    double corner_frequency = 0;  ///< of the filter of the generator speed, rad/s

    /// Below `region_1_5_speed` no torque, up to `region_2_speed` linear, then optimal_gain speed^2, until that meets
    /// the line of an induction machine with this slip at rated power, which ends at `rated_speed`.
    double region_1_5_speed = 0, region_2_speed = 0, rated_speed = 0;  ///< rad/s
    double optimal_gain = 0;                                           ///< N m / (rad/s)^2
    double slip = 0;             ///< rated speed over the synchronous one, minus 1
    double rated_power = 0;      ///< mechanical, W, above rated speed
    bool constant_power = true;  ///< false: the torque is constant above rated speed
    double max_torque = 0;       ///< N m
    double max_torque_rate = 0;  ///< N m/s
    /// Above this pitch angle torque or power are constant whatever the speed, rad.
    double constant_power_pitch = 0;

    double reference_speed = 0;  ///< of the pitch controller, rad/s
    double proportional = 0;     ///< at zero pitch, s (rad per rad/s)
    double integral = 0;         ///< at zero pitch, 1 (rad per rad)
    double doubling_pitch = 0;   ///< pitch angle at which the gain is halved, rad
    /// Gains over the pitch in the place of those three, linear between the rows, constant beyond the ends.
    std::vector<PitchGains> gains = {};
    double min_pitch = 0, max_pitch = 0;  ///< rad
    /// Minimum pitch, in the place of min_pitch, over the filtered speed of the generator; linear between the rows,
    /// constant beyond.
    std::vector<PitchAtSpeed> min_pitches = {};
    double max_pitch_rate = 0;  ///< rad/s

    /// Torque law from region_2_speed up to the rated speed.
    TorqueLaw torque_law() const { return {rated_speed, rated_power / rated_speed, optimal_gain, slip}; }
    /// Minimum pitch at a filtered speed of the generator, rad.
    double min_pitch_at(double speed) const;
    /// @throws InputError naming the parameter
    void check() const;
};

/// The controller as a program that is called once per period.
class VariableSpeedController {
public:
    struct Measured {
        double generator_speed = 0;  ///< rad/s
        double pitch = 0;            ///< of the blades, towards feather, rad
    };
    struct Demand {
        double torque = 0;  ///< of the generator, N m
        double pitch = 0;   ///< rad
    };

    /// @throws InputError as VariableSpeedParameters::check()
    explicit VariableSpeedController(VariableSpeedParameters parameters);

    /// The next sample; the first one starts filter and integral from what is measured. Rates are limited from one
    /// demand to the next, however far behind the actuators are.
    Demand step(const Measured& now);

    /// Torque at a filtered speed and pitch, without limits of rate, N m.
    double torque(double speed, double pitch) const;
    /// Gain, without VariableSpeedParameters::gains, of the pitch controller at a pitch, relative to that at zero.
    double gain(double pitch) const { return 1 / (1 + pitch / own_.doubling_pitch); }

    /// Memory of the controller, for restore().
    std::vector<double> save() const { return {memory_.begin(), memory_.end()}; }
    /// @throws InputError for another number of values
    void restore(std::span<const double> from);

    const VariableSpeedParameters& parameters() const { return own_; }

private:
    enum Memory : std::size_t { started, filtered_speed, pitch_integral, torque_before, pitch_before, count };

    // The sum of the PI controller, in its limits; begins at a pitch or goes on by an error of the speed.
    void begin_integral(double pitch);
    double demanded_pitch(double error, double pitch, double min);
    PitchGains gains_at(double pitch) const;

    VariableSpeedParameters own_;
    std::array<double, count> memory_{};
};

}  // namespace cardan
