#include "examples/studies/nrel5mw_controlled/wind.hpp"

#include "elements/controllers/variable_speed_controller.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "programs/shared/words.hpp"
#include "turbines/reference_turbines/nrel5mw_controller.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cardan::controlled {

namespace {

constexpr double radius = 63, best_tip_speed_ratio = 7.55;

struct Row {
    double wind, degrees, megawatts;  // m/s, deg, MW/rad
};
constexpr std::array table{Row{11.4, 0, -28.24},    Row{12, 3.83, -43.73},   Row{13, 6.60, -51.66},
                           Row{14, 8.70, -58.44},   Row{15, 10.45, -64.44},  Row{16, 12.06, -70.46},
                           Row{17, 13.54, -76.53},  Row{18, 14.92, -83.94},  Row{19, 16.23, -90.67},
                           Row{20, 17.47, -94.71},  Row{21, 18.70, -99.04},  Row{22, 19.94, -105.90},
                           Row{23, 21.18, -114.30}, Row{24, 22.35, -120.20}, Row{25, 23.47, -125.30}};

// On the rotor's side.
double controller_torque(double rotor_speed) {
    static const VariableSpeedController controller(turbines::nrel5mw_controller());
    return gear_ratio * controller.torque(gear_ratio * rotor_speed, 0);
}

double torque_in_trim(double wind) {
    const double max = rated_power / rated_speed;
    if (wind >= rated_wind) return max;
    const double speed = best_tip_speed_ratio * wind / radius;
    return std::min(max, turbines::nrel5mw_controller().optimal_gain * std::pow(gear_ratio, 3) * speed * speed);
}

}  // namespace

TrimPoint trim_point(double wind) {
    if (!(wind >= 3 && wind <= 25)) throw InputError("wind", "speed [m/s]", wind, "3 ... 25");
    std::size_t i = 0;
    while (i + 2 < table.size() && wind > table.at(i + 1).wind) ++i;
    const Row &a = table.at(i), &b = table.at(i + 1);
    const double t = std::max(0.0, (wind - a.wind) / (b.wind - a.wind));
    return {wind, (a.degrees + t * (b.degrees - a.degrees)) * units::degree,
            (a.megawatts + t * (b.megawatts - a.megawatts)) * 1e6};
}

RotorCurve::Value rotor_torque(double wind, double pitch) {
    const TrimPoint trim = trim_point(wind);
    const double slope = trim.sensitivity / rated_speed;
    RotorCurve::Value value;
    value.torque = torque_in_trim(wind) + slope * (pitch - trim.pitch);
    value.torque_by = {0, 0, slope};
    return value;
}

SteadyPoint steady_point(double wind) {
    const double wanted = torque_in_trim(wind), pitch = trim_point(wind).pitch;
    if (wind >= rated_wind) return {wind, rated_speed, pitch, wanted, wanted / gear_ratio};
    double slow = 0.5, fast = rated_speed;
    for (int i = 0; i < 60; ++i) {
        const double middle = (slow + fast) / 2;
        (controller_torque(middle) < wanted ? slow : fast) = middle;
    }
    return {wind, fast, 0, wanted, wanted / gear_ratio};
}

double WindSteps::at(double time) const {
    const auto i =
        std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::floor(time / every)), 0, std::ssize(winds) - 1);
    const double now = winds[static_cast<std::size_t>(i)],
                 before = winds[static_cast<std::size_t>(std::max<std::ptrdiff_t>(i - 1, 0))];
    const double t = std::min(1.0, (time - static_cast<double>(i) * every) / rise);
    return before + t * (now - before);
}

std::vector<double> WindSteps::breaks() const {
    std::vector<double> times;
    for (std::size_t i = 1; i < winds.size(); ++i)
        for (const double after : {0.0, rise}) times.push_back(every * static_cast<double>(i) + after);
    return times;
}

std::vector<double> winds(const char* option, const std::string& given) {
    std::vector<double> all = program::numbers(option, given, "wind speeds separated by commas, m/s");
    for (const double wind : all)
        if (!(wind >= 7 && wind <= 25)) throw InputError(option, "wind speed [m/s]", wind, "7 ... 25");
    return all;
}

std::vector<double> winds_above_rated(const char* option, const std::string& given) {
    std::vector<double> all = winds(option, given);
    for (const double wind : all)
        if (wind <= rated_wind)
            throw InputError(option, "wind speed [m/s]", wind,
                             text("> ", rated_wind, ", where the pitch is controlled"));
    return all;
}

}  // namespace cardan::controlled
