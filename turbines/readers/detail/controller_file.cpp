#include "turbines/readers/detail/controller_file.hpp"

#include "mbs/base/text.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

std::vector<double> ControllerFile::numbers(std::string_view keyword) const {
    std::istringstream lines = text_reader(text_);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t mark = line.find('!');
        if (mark == std::string::npos) continue;
        std::string word;
        if (!(text_reader(line.substr(mark + 1)) >> word) || word != keyword) continue;
        std::vector<double> values;
        std::istringstream before = text_reader(line.substr(0, mark));
        for (double value = 0; before >> value && std::isfinite(value);) values.push_back(value);
        return values;
    }
    return {};
}

std::optional<double> ControllerFile::number(std::string_view keyword) const {
    const std::vector<double> values = numbers(keyword);
    if (values.empty()) return std::nullopt;
    return values.front();
}

namespace {

// Empty: there is none that counts.
std::vector<PitchAtWind> least_pitch(const ControllerFile& file) {
    const std::vector<double> winds = file.numbers("PS_WindSpeeds"), pitch = file.numbers("PS_BldPitchMin");
    if (file.number("PS_Mode").value_or(0) == 0 || winds.size() != pitch.size()) return {};
    std::vector<PitchAtWind> out;
    out.reserve(winds.size());
    for (std::size_t i = 0; i < winds.size(); ++i) {
        if (i > 0 && !(winds[i] > winds[i - 1])) return {};
        out.push_back({winds[i], pitch[i]});
    }
    return out;
}

}  // namespace

FileOperation operation_of(const ControllerFile& file) {
    const auto of = [&](const char* keyword) { return file.number(keyword).value_or(0); };
    FileOperation out;
    const double efficiency = of("VS_GenEff") / 100, gears = of("WE_GearboxRatio");
    if (efficiency > 0 && efficiency <= 1 && of("VS_RtPwr") > 0) out.rated_power = of("VS_RtPwr") / efficiency;
    if (gears > 0 && of("VS_MinOMSpd") > 0) out.least_speed = of("VS_MinOMSpd") / gears;
    if (of("VS_TSRopt") > 0) out.tip_speed_ratio = of("VS_TSRopt");
    out.least_pitch = least_pitch(file);
    return out;
}

ControllerGains gains_of(const ControllerFile& file) {
    const auto of = [&](const char* keyword) { return std::max(0.0, file.number(keyword).value_or(0)); };
    ControllerGains out;
    out.corner_frequency = of("F_LPFCornerFreq");
    out.min_speed = of("VS_MinOMSpd");
    out.rated_speed = of("PC_RefSpd");
    out.optimal_gain = of("VS_Rgn2K");
    out.rated_torque = of("VS_RtTq");
    out.max_torque = of("VS_MaxTq");
    out.max_torque_rate = of("VS_MaxRat");
    out.constant_power = file.number("VS_ConstPower").value_or(1) != 0;
    out.min_pitch = file.number("PC_MinPit").value_or(0);
    out.max_pitch = of("PC_MaxPit");
    out.max_pitch_rate = of("PC_MaxRat");
    const std::vector<double> pitch = file.numbers("PC_GS_angles"), proportional = file.numbers("PC_GS_KP"),
                              integral = file.numbers("PC_GS_KI");
    if (pitch.size() != proportional.size() || pitch.size() != integral.size()) return out;
    for (std::size_t i = 0; i < pitch.size(); ++i)
        out.pitch_gains.push_back({pitch[i], -proportional[i], -integral[i]});
    return out;
}

std::vector<PitchAt> pitch_over_speed(const std::vector<PitchAtWind>& winds, double tip_speed_ratio, double radius,
                                      double least, double most) {
    std::vector<PitchAt> schedule;
    for (const PitchAtWind& one : winds) {
        const double speed = std::clamp(tip_speed_ratio * one.wind / radius, std::min(least, most), most);
        if (!schedule.empty() && speed == schedule.back().rotor_speed) {
            if (speed == most) break;
            schedule.pop_back();
        }
        schedule.push_back({speed, one.pitch});
    }
    return schedule;
}

std::vector<PitchAt> minimum_pitch(const ControllerFile& file) {
    const auto of = [&](const char* keyword) { return file.number(keyword).value_or(0); };
    const double ratio = of("VS_TSRopt"), radius = of("WE_BladeRadius"), gears = of("WE_GearboxRatio");
    if (!(ratio > 0) || !(radius > 0) || !(gears > 0)) return {};
    return pitch_over_speed(least_pitch(file), ratio, radius, of("VS_MinOMSpd") / gears, of("PC_RefSpd") / gears);
}

}  // namespace cardan::turbines
