#include "elements/wind/gust.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace cardan {

namespace {

// What a kind of gust has.
struct GustParts {
    const char* name;
    bool speed, angle, gradient;
};

// In the order of GustKind.
constexpr std::array gust_parts{
    GustParts{"none", false, false, false},        GustParts{"EOG", true, false, false},
    GustParts{"EDC", false, true, false},          GustParts{"ECD", true, true, false},
    GustParts{"vertical EWS", false, false, true}, GustParts{"horizontal EWS", false, false, true},
};

constexpr double steepest = 1e3;  // 1/m, of a SteadyWind's gradients

}  // namespace

const char* name_of(GustKind kind) {
    return entry(gust_parts, kind).name;
}

SteadyWind Gust::applied(const SteadyWind& wind, double time) const {
    if (kind == GustKind::none || time <= start) return wind;
    const double s = std::min((time - start) / duration, 1.0);
    const double lasting = (1 - std::cos(pi * s)) / 2, passing = (1 - std::cos(2 * pi * s)) / 2;
    SteadyWind out = wind;
    switch (kind) {
        case GustKind::none:
            break;
        case GustKind::eog:
            out.gust -= 0.37 * speed * std::sin(3 * pi * s) * 2 * passing;
            break;
        case GustKind::ecd:
            out.gust += speed * lasting;
            [[fallthrough]];
        case GustKind::edc:
            out.direction += angle * lasting;
            break;
        case GustKind::ews_vertical:
        case GustKind::ews_horizontal: {
            const double change = gradient * passing;
            if (change == 0) break;
            if (!(wind.speed > std::abs(gradient) / steepest))
                throw InputError(
                    text("gust (", name_of(kind), ")"), "speed of the wind [m/s]", wind.speed,
                    text("> ", std::abs(gradient) / steepest, ", since the shear of a wind is a factor of its speed"));
            if (kind == GustKind::ews_vertical) {
                out.gradient += change / wind.speed;
                out.gust += change * (wind.reference_height - hub_height);
            } else {
                out.lateral += change / wind.speed;
            }
            break;
        }
    }
    return out;
}

std::vector<double> Gust::breaks() const {
    if (kind == GustKind::none) return {};
    return {start, end()};
}

void Gust::check() const {
    if (kind == GustKind::none) return;
    const GustParts& has = entry(gust_parts, kind);
    const auto where = text("gust (", has.name, ")");
    for (const auto& [name, value, min, max, used] :
         {std::tuple("start [s]", start, -1e9, 1e9, true),
          {"duration [s]", duration, 1e-3, 1e9, true},
          {"hub height [m]", hub_height, 1e-3, 1e5, true},
          {"speed [m/s]", speed, 0.0, 1e3, has.speed},
          {"angle [rad]", angle, -pi, pi, has.angle},
          {"gradient [m/s per m]", gradient, -steepest, steepest, has.gradient}}) {
        if (!used && value != 0) throw InputError(where, name, value, "0: this kind of gust has none");
        if (used && !(value >= min && value <= max)) throw InputError(where, name, value, text(min, " ... ", max));
    }
}

}  // namespace cardan
