/// @file
/// Input file of a ROSCO controller (DISCON.IN): values before "! keyword". Internal to the readers: not installed.
#pragma once

#include "turbines/readers/turbine_file.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cardan::turbines {

/// Commas, tabs and blanks separate, numbers are Fortran's, keywords count in any case. Readers take the numbers they
/// expect; words behind them are a remark, a further number is an error.
class ControllerFile {
public:
    /// Parses any text: entries are the lines with something before the "!" and one of the keywords that are read here
    /// as the first word behind it. A file without such lines is another controller's, which may be anything.
    /// @param name  for messages
    /// @throws ParseError for a keyword that occurs twice
    ControllerFile(std::string_view text, std::string name);

    [[nodiscard]] bool is_rosco() const { return !entries_.empty(); }
    [[nodiscard]] bool has(std::string_view keyword) const;
    /// None: there is no such entry.  @throws ParseError with file and line unless it is one number
    [[nodiscard]] std::optional<double> number(std::string_view keyword) const;
    /// @throws ParseError unless there is one
    [[nodiscard]] double required(std::string_view keyword) const;
    /// @throws ParseError unless the entry has so many
    [[nodiscard]] std::vector<double> numbers(std::string_view keyword, std::size_t count) const;
    /// Number of the numbers or words of an entry.  @throws ParseError unless there is such an entry
    [[nodiscard]] std::size_t count(std::string_view keyword) const { return entry_of(keyword).words.size(); }
    [[noreturn]] void fail(std::string_view keyword, std::string_view what) const;

private:
    struct Entry {
        std::vector<std::string> words;
        int line;
    };
    [[nodiscard]] const Entry& entry_of(std::string_view keyword) const;
    void check_end(std::string_view keyword, const Entry& entry, std::size_t count) const;
    [[nodiscard]] double number_in(std::string_view keyword, const Entry& entry, std::size_t i) const;

    std::string name_;
    int lines_ = 0;
    std::map<std::string, Entry> entries_;  // by keyword in lower case
};

/// Pitch of the blades below rated power, over the rotor speed: at their minimum pitch for the wind at which a rotor of
/// this radius turns so fast at the tip speed ratio, not slower than `min` and not faster than `max`, rad/s. Of
/// winds with the same speed of the rotor the one next to those in between counts.
/// @param winds  ascending
std::vector<PitchAt> pitch_over_speed(const std::vector<PitchAtWind>& winds, double tip_speed_ratio, double radius,
                                      double min, double max);

/// The minimum pitch over rotor speed (PS_BldPitchMin over PS_WindSpeeds), by pitch_over_speed(). The rotor turns at
/// the tip speed ratio VS_TSRopt, not slower than VS_MinOMSpd and not faster than PC_RefSpd. Empty: the file has no
/// such schedule (PS_Mode).
/// @throws ParseError for a schedule that is not whole (fewer numbers than PS_BldPitchMin_N, winds that do not ascend,
/// no VS_TSRopt ...)
std::vector<PitchAt> minimum_pitch(const ControllerFile& file);

/// VS_RtPwr over VS_GenEff, or VS_RtTq at PC_RefSpd; VS_MinOMSpd, VS_TSRopt, WE_GearboxRatio, PS_BldPitchMin over
/// PS_WindSpeeds.
/// @throws ParseError as minimum_pitch(), and for angles and an efficiency that are in another unit
FileOperation operation_of(const ControllerFile& file);

/// Gains and limits of pitch and torque. Gains that lower the pitch as the speed rises, as ROSCO has them, are positive
/// here.
ControllerGains gains_of(const ControllerFile& file);

}  // namespace cardan::turbines
