#include "elements/wind/iec_wind.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cardan {

namespace {

struct IecWindWord {
    std::string_view word;
    bool sign, speed;  // has them
};

// In the order of IecWindKind.
constexpr std::array iec_words{
    IecWindWord{"nwp", false, true},   IecWindWord{"eog", false, true},    IecWindWord{"edc", true, true},
    IecWindWord{"ecd", true, true},    IecWindWord{"ewsv", true, true},    IecWindWord{"ewsh", true, true},
    IecWindWord{"ewm1", false, false}, IecWindWord{"ewm50", false, false},
};

constexpr std::string_view iec_source = "IEC 61400-1";

// How a wind may be named: "edc+:V or edc-:V".
std::string iec_forms(const IecWindWord& of, std::string_view speed, std::string_view between) {
    const std::string end = of.speed ? text(":", speed) : std::string();
    return of.sign ? text(of.word, "+", end, between, of.word, "-", end) : text(of.word, end);
}

std::string all_iec_forms() {
    std::string out;
    for (const IecWindWord& one : iec_words) out += iec_forms(one, "V", ", ") + ", ";
    return out + "with V the speed at the hub in m/s";
}

// Within what all gusts are defined for.
void check_gust(const IecMachine& machine, double speed, std::string_view what) {
    machine.check();
    if (!(speed > 0 && speed <= machine.wind_class.reference_speed))
        throw InputError(text(iec_source, ", ", what), "speed at the hub [m/s]", speed,
                         text("> 0 and at most V_ref of the class, ", machine.wind_class.reference_speed));
}

// D / Lambda_1
double iec_size(const IecMachine& machine) {
    return machine.rotor_diameter / iec_turbulence_scale(machine.hub_height);
}

}  // namespace

IecWindName iec_wind_name(std::string_view name) {
    const auto refuse = [&](std::string_view allowed) {
        return InputError(iec_source, "wind", text("'", name, "'"), allowed);
    };
    const std::size_t colon = name.find(':');
    const bool has_speed = colon != std::string_view::npos;
    const std::string_view number = has_speed ? name.substr(colon + 1) : std::string_view();
    std::string word = lower_case(name.substr(0, colon));
    const bool has_sign = word.ends_with('+') || word.ends_with('-');
    IecWindName out;
    if (has_sign) {
        out.sign = word.ends_with('+') ? 1 : -1;
        word.pop_back();
    }
    const auto found = std::ranges::find(iec_words, word, &IecWindWord::word);
    if (found == iec_words.end()) throw refuse(all_iec_forms());
    out.kind = static_cast<IecWindKind>(found - iec_words.begin());
    const std::string forms = iec_forms(*found, number.empty() ? "V" : number, " or ");
    if (found->sign && !has_sign) throw refuse(text(forms, ": there are both signs"));
    if (!found->sign && has_sign) throw refuse(text(forms, ", without a sign"));
    if (!found->speed && has_speed) throw refuse(text(forms, ", without a speed, which its class has"));
    if (!found->speed) return out;
    const ReadNumber speed = read_number(number);
    if (!speed.good() || !(speed.value > 0 && speed.value <= 1000))
        throw refuse(text(iec_forms(*found, "V", " or "),
                          " with the speed at the hub in m/s, > 0 and at most 1000, such as ", word,
                          has_sign ? out.sign > 0 ? "+" : "-" : "", ":12"));
    out.speed = speed.value;
    return out;
}

std::string name_of(const IecWindName& wind) {
    const IecWindWord& has = entry(iec_words, wind.kind);
    return text(has.word, !has.sign ? "" : wind.sign > 0 ? "+" : "-", has.speed ? text(":", digits(wind.speed)) : "");
}

void IecMachine::check() const {
    wind_class.check();
    require_positive(iec_source, "hub height [m]", hub_height);
    require_positive(iec_source, "diameter of the rotor [m]", rotor_diameter);
    if (!(exponent >= 0 && exponent <= 1))
        throw InputError(iec_source, "exponent of the normal wind profile", exponent, "0 ... 1");
}

double iec_eog_speed(const IecMachine& machine, double speed) {
    check_gust(machine, speed, "EOG");
    const double sigma = iec_normal_turbulence(machine.wind_class, speed);
    const double extreme = iec_steady_extreme_speed(machine.wind_class, IecRecurrence::one_year);
    return std::min(1.35 * (extreme - speed), 3.3 * sigma / (1 + 0.1 * iec_size(machine)));
}

double iec_edc_angle(const IecMachine& machine, double speed) {
    check_gust(machine, speed, "EDC");
    const double sigma = iec_normal_turbulence(machine.wind_class, speed);
    return std::min(4 * std::atan(sigma / (speed * (1 + 0.1 * iec_size(machine)))), pi);
}

double iec_ecd_angle(const IecMachine& machine, double speed) {
    check_gust(machine, speed, "ECD");
    return speed < 4 ? pi : 4 * pi / speed;
}

double iec_ews_speed(const IecMachine& machine, double speed) {
    check_gust(machine, speed, "EWS");
    constexpr double beta = 6.4;
    return 2.5 + 0.2 * beta * iec_normal_turbulence(machine.wind_class, speed) * std::pow(iec_size(machine), 0.25);
}

Gust iec_gust(const IecMachine& machine, const IecWindName& wind, double start) {
    machine.check();
    const IecWindWord& has = entry(iec_words, wind.kind);
    if (wind.sign != 1 && !(has.sign && wind.sign == -1))
        throw InputError(text(iec_source, ", ", has.word), "sign", wind.sign, has.sign ? "1, -1" : "1");
    Gust out{.start = start, .hub_height = machine.hub_height};
    switch (wind.kind) {
        case IecWindKind::nwp:
        case IecWindKind::ewm1:
        case IecWindKind::ewm50:
            return {};
        case IecWindKind::eog:
            out.kind = GustKind::eog;
            out.duration = iec_eog_duration;
            out.speed = iec_eog_speed(machine, wind.speed);
            break;
        case IecWindKind::edc:
            out.kind = GustKind::edc;
            out.duration = iec_edc_duration;
            out.angle = wind.sign * iec_edc_angle(machine, wind.speed);
            break;
        case IecWindKind::ecd:
            out.kind = GustKind::ecd;
            out.duration = iec_ecd_duration;
            out.speed = iec_ecd_speed;
            out.angle = wind.sign * iec_ecd_angle(machine, wind.speed);
            break;
        case IecWindKind::ews_vertical:
        case IecWindKind::ews_horizontal:
            out.kind = wind.kind == IecWindKind::ews_vertical ? GustKind::ews_vertical : GustKind::ews_horizontal;
            out.duration = iec_ews_duration;
            out.gradient = wind.sign * 2 * iec_ews_speed(machine, wind.speed) / machine.rotor_diameter;
            break;
    }
    out.check();
    return out;
}

SteadyWind iec_wind(const IecMachine& machine, const IecWindName& wind) {
    machine.check();
    SteadyWind out{.speed = wind.speed,
                   .reference_height = machine.hub_height,
                   .shear = Shear::power,
                   .exponent = machine.exponent};
    if (wind.kind == IecWindKind::ewm1 || wind.kind == IecWindKind::ewm50) {
        out.exponent = iec_extreme_exponent;
        out.speed = iec_steady_extreme_speed(
            machine.wind_class, wind.kind == IecWindKind::ewm1 ? IecRecurrence::one_year : IecRecurrence::fifty_years);
    }
    require_positive(iec_source, "speed at the hub [m/s]", out.speed);
    out.check();
    return out;
}

}  // namespace cardan
