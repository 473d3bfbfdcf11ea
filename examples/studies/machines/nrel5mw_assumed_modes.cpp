#include "examples/studies/machines/nrel5mw_assumed_modes.hpp"

#include "turbines/reference_turbines/nrel5mw_geometry.hpp"

namespace cardan::turbines {

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
    return HubMotion{.A = {0, 0, rotor_speed}}.moved({nrel5mw_geometry().hub_radius, 0, 0});
}

// Every joint turns the axes X (up, later along the blade), Y, Z (downwind) as in docs/nrel5mw_platform.md.
HubMotion nrel5mw_blade_root(const Nrel5mwMotion& m, double gravity) {
    const Nrel5mwGeometry& g = nrel5mw_geometry();
    const Vec3 X = Vec3::UnitX(), Y = Vec3::UnitY(), Z = Vec3::UnitZ();
    const auto three = [&](double PrescribedCoordinate::*of) { return Vec3(m.heave.*of, m.sway.*of, m.surge.*of); };
    return HubMotion{.gravity = -gravity * X}
        .moved(three(&PrescribedCoordinate::q), three(&PrescribedCoordinate::qd), three(&PrescribedCoordinate::qdd))
        .turned(Z, m.roll)
        .turned(Y, m.pitch)
        .turned(X, m.yaw)
        .moved((g.tower_height + g.shaft_above_tower) * X)
        .turned(X, m.nacelle_yaw)
        .turned(Y, {.q = -g.tilt})
        .moved(-g.overhang * Z)
        .turned(Z, m.azimuth)
        .turned(Y, {.q = -g.cone})
        .moved(g.hub_radius * X);
}

}  // namespace cardan::turbines
