#include "examples/nrel5mw_platform/motion_option.hpp"

#include "mbs/error.hpp"

#include "examples/named_values.hpp"
#include <cmath>
#include <map>

namespace cardan::platform {

namespace {

constexpr auto allowed =
    "mean=M,velocity=V,amplitude=A,period=SECONDS,phase=DEG or some of them, each once; revolutions=N instead of "
    "period";

std::map<std::string, double> values_by_key(const std::string& option, const std::string& given) {
    std::map<std::string, double> values;
    for (std::size_t at = 0; at <= given.size();) {
        const std::size_t comma = std::min(given.find(',', at), given.size());
        const std::string word = given.substr(at, comma - at);
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos) throw InputError(option, "value", given, allowed);
        const double value = program::number(option.c_str(), given, word.substr(equals + 1), allowed);
        if (!values.emplace(word.substr(0, equals), value).second) throw InputError(option, "value", given, allowed);
        at = comma + 1;
    }
    return values;
}

}  // namespace

MotionOption motion_option(const std::string& option, const std::string& given, std::optional<double> revolution) {
    std::map<std::string, double> values = values_by_key(option, given);
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
    if (!values.empty() || (period && revolutions)) throw InputError(option, "value", given, allowed);
    if (period) require_positive(option, "period [s]", *period);
    if (revolutions) require_positive(option, "period [revolutions]", *revolutions);
    if (revolutions && !revolution) throw InputError(option, "revolutions of a rotor at", "0 rpm", "period=SECONDS");
    motion.period = period ? *period : revolutions ? *revolutions * *revolution : 0;
    if (motion.oscillates() && motion.period == 0) throw InputError(option, "amplitude without", "a period", allowed);
    return motion;
}

solvers::Motion MotionOption::motion(double unit) const {
    constexpr double degree = pi / 180;
    const double start = unit * mean, rate = unit * velocity, size = unit * amplitude, angle = degree * phase;
    if (!oscillates()) return solvers::Motion::constant_rate(start, rate);
    if (velocity == 0) return solvers::Motion::harmonic(start, size, period, angle);
    const double omega = 2 * pi / period;
    return solvers::Motion::function([=](double t) {
        const double s = size * std::sin(omega * t + angle), c = size * std::cos(omega * t + angle);
        return solvers::MotionState{start + rate * t + s, rate + omega * c, -omega * omega * s};
    });
}

}  // namespace cardan::platform
