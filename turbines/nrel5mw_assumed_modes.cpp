#include "turbines/nrel5mw_assumed_modes.hpp"

#include "turbines/csv.hpp"
#include "turbines/embedded_data.hpp"

namespace cardan::turbines {

namespace {

constexpr double degree = pi / 180;

// FAST counts overhang and tilt negative for an upwind rotor.
struct Geometry {
    double shaft_height, overhang, tilt, cone, hub_radius;
};

Geometry read_geometry() {
    constexpr auto table = "nrel5mw_turbine.csv";
    const CsvQuantities q = CsvQuantities::parse(embedded_data(table), table);
    return {q.number("tower_height", "m") + q.number("tower_top_to_shaft_vertical", "m"), -q.number("overhang", "m"),
            -q.number("shaft_tilt", "deg") * degree, -q.number("precone", "deg") * degree, q.number("hub_radius", "m")};
}

const Geometry& geometry() {
    static const Geometry read = read_geometry();
    return read;
}

}  // namespace

AssumedModesBlade nrel5mw_blade_of_2018(TensionIntegral tension, const BeamLine& line) {
    return nrel5mw_blade_of_2018(AssumedModesBasis::paper2018(line.length), tension, line);
}

AssumedModesBlade nrel5mw_blade_of_2018(const AssumedModesBasis& basis, TensionIntegral tension, const BeamLine& line) {
    return AssumedModesBlade(line, {.basis = basis, .rotary_inertia = false, .tension = tension});
}

AssumedModesBlade nrel5mw_blade_converged(const BeamLine& line) {
    return AssumedModesBlade(line);
}

HubMotion nrel5mw_spinning_hub(double rotor_speed) {
    return HubMotion{.A = {0, 0, rotor_speed}}.moved({geometry().hub_radius, 0, 0});
}

// Every joint turns the axes X (up, later along the blade), Y, Z (downwind) as in docs/nrel5mw_platform.md.
HubMotion nrel5mw_blade_root(const Nrel5mwMotion& m, double gravity) {
    const Geometry& g = geometry();
    const Vec3 X = Vec3::UnitX(), Y = Vec3::UnitY(), Z = Vec3::UnitZ();
    const auto three = [&](double PrescribedCoordinate::*of) { return Vec3(m.heave.*of, m.sway.*of, m.surge.*of); };
    return HubMotion{.gravity = -gravity * X}
        .moved(three(&PrescribedCoordinate::q), three(&PrescribedCoordinate::qd), three(&PrescribedCoordinate::qdd))
        .turned(Z, m.roll)
        .turned(Y, m.pitch)
        .turned(X, m.yaw)
        .moved(g.shaft_height * X)
        .turned(X, m.nacelle_yaw)
        .turned(Y, {.q = -g.tilt})
        .moved(-g.overhang * Z)
        .turned(Z, m.azimuth)
        .turned(Y, {.q = g.cone})
        .moved(g.hub_radius * X);
}

}  // namespace cardan::turbines
