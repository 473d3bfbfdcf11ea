/// @file
/// Options such as --pitch mean=0,amplitude=5,period=10,phase=0: prescribed motions on the command line.
#pragma once

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/command_line.hpp"
#include "programs/shared/named_values.hpp"
#include "solvers/time/motion.hpp"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cardan::program {

/// mean + velocity t + amplitude sin(2 pi t / period + phase), in the units of the command line.
struct MotionOption {
    double mean = 0;       ///< m or deg
    double velocity = 0;   ///< m/s or deg/s
    double amplitude = 0;  ///< m or deg
    double period = 0;     ///< s; 0: none
    double phase = 0;      ///< deg

    bool oscillates() const { return amplitude != 0; }
    /// @param unit  one metre or one degree in SI
    solvers::Motion motion(double unit) const;
};

/// Common part of the options of motions, for the help of a program.
inline constexpr auto motion_help =
    "A motion is mean + velocity t + amplitude sin(2 pi t / period + phase), written as\n"
    "  --pitch mean=0,amplitude=5,period=9.9,phase=0     or     --heave velocity=1\n"
    "with m or deg, s, deg; what is left out is zero.";

/// Options --surge, --sway ..., one for each name.
/// @param given  out: what stands behind them
template <std::size_t N>
std::vector<Option> add_motion_options(CommandLine& app, const std::array<const char*, N>& names,
                                       const std::array<const char*, N>& directions,
                                       std::array<std::string, N>& given) {
    std::vector<Option> options;
    for (std::size_t i = 0; i < N; ++i)
        options.push_back(app.add_option(text("--", names[i]), given[i], directions[i]).type_name("KEY=NUMBER,..."));
    return options;
}

namespace detail {

inline constexpr auto motion_allowed =
    "mean=M,velocity=V,amplitude=A,period=SECONDS,phase=DEG or some of them, each once; revolutions=N instead of "
    "period";

inline std::map<std::string, double> values_by_key(const std::string& option, const std::string& given) {
    std::map<std::string, double> values;
    for (std::size_t at = 0; at <= given.size();) {
        const std::size_t comma = std::min(given.find(',', at), given.size());
        const std::string word = given.substr(at, comma - at);
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos) throw InputError(option, "value", given, motion_allowed);
        const double value = number(option.c_str(), given, word.substr(equals + 1), motion_allowed);
        if (!values.emplace(word.substr(0, equals), value).second)
            throw InputError(option, "value", given, motion_allowed);
        at = comma + 1;
    }
    return values;
}

}  // namespace detail

/// @param given       KEY=NUMBER,KEY=NUMBER ... with the keys mean, velocity, amplitude, period (s) or revolutions
///                    (period in revolutions of the rotor), phase
/// @param revolution  of the rotor, s; none: it stands still, or its speed changes
/// @throws InputError naming the option
inline MotionOption motion_option(const std::string& option, const std::string& given,
                                  std::optional<double> revolution) {
    std::map<std::string, double> values = detail::values_by_key(option, given);
    const auto take = [&](const char* key) {
        const auto node = values.extract(key);
        return node.empty() ? std::optional<double>() : std::optional<double>(node.mapped());
    };
    MotionOption motion;
    motion.mean = take("mean").value_or(0);
    motion.velocity = take("velocity").value_or(0);
    motion.amplitude = take("amplitude").value_or(0);
    motion.phase = take("phase").value_or(0);
    const auto period = take("period"), revolutions = take("revolutions");
    if (!values.empty() || (period && revolutions)) throw InputError(option, "value", given, detail::motion_allowed);
    if (period) require_positive(option, "period [s]", *period);
    if (revolutions) require_positive(option, "period [revolutions]", *revolutions);
    if (revolutions && !revolution)
        throw InputError(option, "revolutions of a rotor at", "0 rpm or at changing speed", "period=SECONDS");
    motion.period = period ? *period : revolutions ? *revolutions * *revolution : 0;
    if (motion.oscillates() && motion.period == 0)
        throw InputError(option, "amplitude without", "a period", detail::motion_allowed);
    return motion;
}

inline solvers::Motion MotionOption::motion(double unit) const {
    const double start = unit * mean, rate = unit * velocity, size = unit * amplitude, angle = units::degree * phase;
    if (!oscillates()) return solvers::Motion::constant_rate(start, rate);
    if (velocity == 0) return solvers::Motion::harmonic(start, size, period, angle);
    const double omega = 2 * pi / period;
    return solvers::Motion::function([=](double t) {
        const double s = size * std::sin(omega * t + angle), c = size * std::cos(omega * t + angle);
        return solvers::MotionState{start + rate * t + s, rate + omega * c, -omega * omega * s};
    });
}

}  // namespace cardan::program
