/// @file
/// Input file of a ROSCO controller (DISCON.IN): values before "! keyword". Internal to the readers: not installed.
#pragma once

#include "turbines/readers/turbine_file.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cardan::turbines {

class ControllerFile {
public:
    explicit ControllerFile(std::string text) : text_(std::move(text)) {}

    /// None: another controller's file, which may be anything.
    std::optional<double> number(std::string_view keyword) const;
    /// All numbers of the line; empty: none.
    std::vector<double> numbers(std::string_view keyword) const;

private:
    std::string text_;
};

/// Where the blades stand below rated power, over the rotor speed: at their least pitch for the wind at which a rotor
/// of this radius turns so fast at the tip speed ratio, not slower than `least` and not faster than `most`, rad/s. Of
/// winds with the same speed of the rotor the one next to those in between counts.
/// @param winds  ascending
std::vector<PitchAt> pitch_over_speed(const std::vector<PitchAtWind>& winds, double tip_speed_ratio, double radius,
                                      double least, double most);

/// The least pitch over rotor speed (PS_BldPitchMin over PS_WindSpeeds), by pitch_over_speed(). The
/// rotor turns at the tip speed ratio VS_TSRopt, not slower than VS_MinOMSpd and not faster than PC_RefSpd. Empty: the
/// file has no such schedule (PS_Mode), or not all that it takes.
std::vector<PitchAt> minimum_pitch(const ControllerFile& file);

/// VS_RtPwr over VS_GenEff, VS_MinOMSpd, VS_TSRopt, PS_BldPitchMin over PS_WindSpeeds.
FileOperation operation_of(const ControllerFile& file);

/// Gains and limits of pitch and torque. Gains that lower the pitch as the speed rises, as ROSCO has them, are positive
/// here.
ControllerGains gains_of(const ControllerFile& file);

}  // namespace cardan::turbines
