#include "elements/wind/iec_class.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace cardan {

namespace {

struct NumberByName {
    std::string_view name;
    double number;
};

// Longer names first.
constexpr std::array reference_speeds{NumberByName{"III", 37.5}, NumberByName{"II", 42.5}, NumberByName{"I", 50}};
constexpr std::array reference_intensities{NumberByName{"A+", 0.18}, NumberByName{"A", 0.16}, NumberByName{"B", 0.14},
                                           NumberByName{"C", 0.12}};

// The name of a number, empty for none of them.
std::string_view name_in(const auto& list, double number) {
    const auto found = std::ranges::find(list, number, &NumberByName::number);
    return found == list.end() ? std::string_view() : found->name;
}

}  // namespace

void IecClass::check() const {
    for (const auto& [name, value, min, max] : {std::tuple("reference speed V_ref [m/s]", reference_speed, 1.0, 200.0),
                                                {"reference turbulence intensity I_ref", reference_intensity, 0.0, 1.0},
                                                {"mean speed V_ave [m/s]", mean_speed, 0.0, reference_speed}})
        if (!(value >= min && value <= max))
            throw InputError("class of the wind", name, value, text(min, " ... ", max));
}

IecClass iec_class(std::string_view name) {
    std::string word;
    for (const char c : name)
        if (c != ' ') word += upper_case(c);
    std::string_view left = word;
    const auto unknown = [&] {
        return InputError("class of the wind", "name", text("'", name, "'"),
                          "I, II or III, or S and V_ref in m/s, then A+, A, B or C, such as IB, II A+ or S 45 B");
    };
    const auto category =
        std::ranges::find_if(reference_intensities, [&](const NumberByName& one) { return left.ends_with(one.name); });
    if (category == reference_intensities.end()) throw unknown();
    left.remove_suffix(category->name.size());
    IecClass out;
    if (left.starts_with('S')) {
        const ReadNumber own = read_number(left.substr(1));
        if (!own.good()) throw unknown();
        out.reference_speed = own.value;
    } else {
        const auto speed = std::ranges::find(reference_speeds, left, &NumberByName::name);
        if (speed == reference_speeds.end()) throw unknown();
        out.reference_speed = speed->number;
    }
    out.reference_intensity = category->number;
    out.mean_speed = 0.2 * out.reference_speed;
    out.check();
    return out;
}

std::string name_of(const IecClass& wind_class) {
    const std::string_view speed = name_in(reference_speeds, wind_class.reference_speed),
                           category = name_in(reference_intensities, wind_class.reference_intensity);
    if (category.empty() || wind_class.mean_speed != 0.2 * wind_class.reference_speed)
        return text("S (V_ref ", digits(wind_class.reference_speed), " m/s, I_ref ",
                    digits(wind_class.reference_intensity), ", V_ave ", digits(wind_class.mean_speed), " m/s)");
    if (speed.empty()) return text("S ", digits(wind_class.reference_speed), " ", category);
    return text(speed, " ", category);
}

double iec_turbulence_scale(double hub_height) {
    require_positive("IEC 61400-1", "hub height [m]", hub_height);
    return 0.7 * std::min(hub_height, 60.0);
}

double iec_normal_turbulence(const IecClass& wind_class, double speed) {
    wind_class.check();
    require_not_negative("IEC 61400-1, NTM", "speed at the hub [m/s]", speed);
    return wind_class.reference_intensity * (0.75 * speed + 5.6);
}

double iec_extreme_turbulence(const IecClass& wind_class, double speed) {
    wind_class.check();
    require_not_negative("IEC 61400-1, ETM", "speed at the hub [m/s]", speed);
    constexpr double c = 2;
    return c * wind_class.reference_intensity * (0.072 * (wind_class.mean_speed / c + 3) * (speed / c - 4) + 10);
}

double iec_steady_extreme_speed(const IecClass& wind_class, IecRecurrence recurrence) {
    return 1.4 * iec_turbulent_extreme_speed(wind_class, recurrence);
}

double iec_turbulent_extreme_speed(const IecClass& wind_class, IecRecurrence recurrence) {
    wind_class.check();
    return (recurrence == IecRecurrence::fifty_years ? 1 : 0.8) * wind_class.reference_speed;
}

}  // namespace cardan
