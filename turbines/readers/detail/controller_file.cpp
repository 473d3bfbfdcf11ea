#include "turbines/readers/detail/controller_file.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text.hpp"
#include "mbs/base/units.hpp"
#include "turbines/readers/detail/openfast_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cardan::turbines {

namespace {

constexpr auto rosco_keywords = std::to_array<std::string_view>(
    {"f_lpfcornerfreq", "pc_finepit",     "pc_gs_angles",     "pc_gs_ki",       "pc_gs_kp",
     "pc_gs_n",         "pc_maxpit",      "pc_maxrat",        "pc_minpit",      "pc_refspd",
     "vs_constpower",   "vs_geneff",      "vs_maxrat",        "vs_maxtq",       "vs_minomspd",
     "vs_rgn2k",        "vs_rtpwr",       "vs_rttq",          "vs_tsropt",      "ps_mode",
     "ps_windspeeds",   "ps_bldpitchmin", "ps_bldpitchmin_n", "we_bladeradius", "we_gearboxratio"});

// Empty: no entry.
std::string keyword_of(std::string_view remark) {
    const std::vector<std::string_view> words = words_of(remark);
    if (words.empty()) return {};
    const std::string word = lower_case(words.front().substr(0, words.front().find_first_of(":(=")));
    return std::ranges::find(rosco_keywords, word) == rosco_keywords.end() ? std::string() : word;
}

}  // namespace

ControllerFile::ControllerFile(std::string_view text, std::string name) : name_(std::move(name)) {
    for (int number = 1; !text.empty(); ++number) {
        lines_ = number;
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::size_t mark = line.find('!');
        if (mark == std::string_view::npos) continue;
        const std::string keyword = keyword_of(line.substr(mark + 1));
        const std::vector<std::string_view> words = words_of(line.substr(0, mark));
        if (keyword.empty() || words.empty()) continue;
        const auto [at, is_new] = entries_.try_emplace(keyword, Entry{{words.begin(), words.end()}, number});
        if (!is_new)
            throw ParseError(name_, number, 0, cardan::text(keyword, " is there already, in line ", at->second.line));
    }
}

void ControllerFile::fail(std::string_view keyword, std::string_view what) const {
    throw ParseError(name_, entry_of(keyword).line, 0, text(keyword, ": ", what));
}

const ControllerFile::Entry& ControllerFile::entry_of(std::string_view keyword) const {
    const auto found = entries_.find(lower_case(keyword));
    if (found == entries_.end())
        throw ParseError(
            name_, lines_, 0,
            text("no line with the keyword ", keyword, ", behind its value and a !, up to the end of the file"));
    return found->second;
}

double ControllerFile::number_in(std::string_view keyword, const Entry& entry, std::size_t i) const {
    const std::optional<double> value = fortran_number(entry.words[i]);
    if (!value)
        throw ParseError(name_, entry.line, 0, text(keyword, ": '", entry.words[i], "' is not a finite number"));
    return *value;
}

// "90,000" is two numbers.
void ControllerFile::check_end(std::string_view keyword, const Entry& entry, std::size_t count) const {
    if (entry.words.size() > count && fortran_number(entry.words[count]))
        throw ParseError(name_, entry.line, 0,
                         text(keyword, ": ", count, count == 1 ? " number" : " numbers", " expected, then '",
                              entry.words[count], "'"));
}

bool ControllerFile::has(std::string_view keyword) const {
    return entries_.contains(lower_case(keyword));
}

std::optional<double> ControllerFile::number(std::string_view keyword) const {
    return has(keyword) ? std::optional(required(keyword)) : std::nullopt;
}

double ControllerFile::required(std::string_view keyword) const {
    const Entry& entry = entry_of(keyword);
    check_end(keyword, entry, 1);
    return number_in(keyword, entry, 0);
}

std::vector<double> ControllerFile::numbers(std::string_view keyword, std::size_t count) const {
    const Entry& entry = entry_of(keyword);
    if (entry.words.size() < count) fail(keyword, text(count, " numbers expected, found ", entry.words.size()));
    std::vector<double> values;
    values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) values.push_back(number_in(keyword, entry, i));
    check_end(keyword, entry, count);
    return values;
}

namespace {

// How many rows there are.
std::size_t whole(const ControllerFile& file, const char* keyword, double announced) {
    if (!(announced >= 1 && announced <= 1e6 && announced == std::floor(announced)))
        file.fail(keyword, text(announced, "; allowed: whole numbers, 1 ... 1e6"));
    return static_cast<std::size_t>(announced);
}

// Over the wind; empty: there is none.
std::vector<PitchAtWind> min_pitch(const ControllerFile& file) {
    constexpr auto winds_of = "PS_WindSpeeds", pitch_of = "PS_BldPitchMin", count_of = "PS_BldPitchMin_N";
    if (file.number("PS_Mode").value_or(0) == 0) return {};
    const auto given = file.number(count_of);
    if (!given && file.count(winds_of) != file.count(pitch_of))
        file.fail(pitch_of, text(file.count(pitch_of), " numbers for ", file.count(winds_of), " wind speeds"));
    const double announced = given.value_or(static_cast<double>(file.count(winds_of)));
    const std::size_t count = whole(file, count_of, announced);
    const std::vector<double> winds = file.numbers(winds_of, count), pitch = file.numbers(pitch_of, count);
    std::vector<PitchAtWind> out;
    out.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0 && !(winds[i] > winds[i - 1]))
            file.fail(winds_of, text(winds[i], " m/s after ", winds[i - 1], "; allowed: ascending"));
        out.push_back({winds[i], pitch[i]});
    }
    return out;
}

// What lies beyond is in another unit.
void check_units(const ControllerFile& file) {
    constexpr double turn = 2 * pi, whole_per_cent = 1;
    for (const char* keyword : {"PC_FinePit", "PC_MinPit", "PC_MaxPit"})
        if (const double angle = file.number(keyword).value_or(0); std::abs(angle) > turn)
            file.fail(keyword, text(angle, " rad; allowed: at most a turn either way"));
    if (const double efficiency = file.number("VS_GenEff").value_or(0);
        efficiency < 0 || (efficiency > 0 && efficiency <= whole_per_cent) || efficiency > 100)
        file.fail("VS_GenEff", text(efficiency, " per cent; allowed: above ", whole_per_cent, " and at most 100"));
}

}  // namespace

FileOperation operation_of(const ControllerFile& file) {
    check_units(file);
    const auto of = [&](const char* keyword) { return file.number(keyword).value_or(0); };
    FileOperation out;
    const double efficiency = of("VS_GenEff") / 100, gears = of("WE_GearboxRatio"), electrical = of("VS_RtPwr"),
                 on_shaft = of("VS_RtTq") * of("PC_RefSpd");
    if (efficiency > 0 && efficiency <= 1 && electrical > 0)
        out.rated_power = electrical / efficiency;
    else if (on_shaft > 0)
        out.rated_power = on_shaft;
    out.gear_ratio = gears;
    if (gears > 0 && of("VS_MinOMSpd") > 0) out.min_rotor_speed = of("VS_MinOMSpd") / gears;
    if (of("VS_TSRopt") > 0) out.tip_speed_ratio = of("VS_TSRopt");
    out.min_pitch = min_pitch(file);
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
    constexpr auto angles = "PC_GS_angles";
    if (!file.has(angles) || !file.has("PC_GS_KP") || !file.has("PC_GS_KI")) return out;
    const double announced = file.number("PC_GS_n").value_or(static_cast<double>(file.count(angles)));
    const std::size_t count = whole(file, "PC_GS_n", announced);
    const std::vector<double> pitch = file.numbers(angles, count), proportional = file.numbers("PC_GS_KP", count),
                              integral = file.numbers("PC_GS_KI", count);
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0 && !(pitch[i] > pitch[i - 1]))
            file.fail(angles, text(pitch[i], " rad after ", pitch[i - 1], "; allowed: ascending"));
        out.pitch_gains.push_back({pitch[i], -proportional[i], -integral[i]});
    }
    return out;
}

std::vector<PitchAt> pitch_over_speed(const std::vector<PitchAtWind>& winds, double tip_speed_ratio, double radius,
                                      double min, double max) {
    std::vector<PitchAt> schedule;
    for (const PitchAtWind& one : winds) {
        const double speed = std::clamp(tip_speed_ratio * one.wind / radius, std::min(min, max), max);
        if (!schedule.empty() && speed == schedule.back().rotor_speed) {
            if (speed == max) break;
            schedule.pop_back();
        }
        schedule.push_back({speed, one.pitch});
    }
    return schedule;
}

std::vector<PitchAt> minimum_pitch(const ControllerFile& file) {
    const std::vector<PitchAtWind> over_wind = min_pitch(file);
    if (over_wind.empty()) return {};
    const auto positive = [&](const char* keyword) {
        const double value = file.required(keyword);
        if (!(value > 0)) file.fail(keyword, text(value, "; allowed: > 0"));
        return value;
    };
    const double ratio = positive("VS_TSRopt"), radius = positive("WE_BladeRadius"),
                 gears = positive("WE_GearboxRatio");
    return pitch_over_speed(over_wind, ratio, radius, file.number("VS_MinOMSpd").value_or(0) / gears,
                            positive("PC_RefSpd") / gears);
}

}  // namespace cardan::turbines
