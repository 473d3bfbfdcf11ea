#include "elements/machine_elements/friction.hpp"

#include "elements/machine_elements/coordinate_force.hpp"
#include "mbs/base/error.hpp"

#include <cmath>
#include <utility>

namespace cardan {

void StribeckFriction::check(const std::string& where) const {
    require_not_negative(where, "Coulomb friction", coulomb_force);
    if (!(static_force >= coulomb_force) || std::isinf(static_force))
        throw InputError(where, "static friction", static_force, text("finite, at least Coulomb's, ", coulomb_force));
    require_not_negative(where, "Stribeck's speed", stribeck_speed);
    require_not_negative(where, "viscous friction", viscous);
    require_positive(where, "regularisation", regularisation);
}

StribeckFriction::Force StribeckFriction::at(double speed) const {
    const Force ahead = sliding(std::abs(speed), 1);
    const double dry = ahead.force - viscous * std::abs(speed), side = std::tanh(speed / regularisation);
    const double dry_slope = (ahead.by_speed - viscous) * (speed < 0 ? -1 : 1);
    return {dry * side + viscous * speed, dry_slope * side + dry * (1 - side * side) / regularisation + viscous};
}

StribeckFriction::Force StribeckFriction::sliding(double speed, int direction) const {
    if (stribeck_speed == 0) return {direction * coulomb_force + viscous * speed, viscous};
    const double drop = (static_force - coulomb_force) * std::exp(-direction * speed / stribeck_speed);
    return {direction * (coulomb_force + drop) + viscous * speed, viscous - drop / stribeck_speed};
}

namespace {

// On a coordinate, by the force of friction at a speed against the surface.
template <class Friction>
ForceElement against_surface(std::string name, BodyId coordinate, const StribeckFriction& law, double surface_speed,
                             const Friction& friction) {
    const std::string where = text("friction '", name, "'");
    law.check(where);
    if (!std::isfinite(surface_speed)) throw InputError(where, "speed of the surface", surface_speed, "finite");
    const auto along = [=](double, double, double rate) -> CoordinateLaw {
        const StribeckFriction::Force force = friction(rate - surface_speed);
        return {-force.force, 0, -force.by_speed, 0};
    };
    return coordinate_force(std::move(name), coordinate, along, false);
}

}  // namespace

ForceElement friction_force(std::string name, BodyId coordinate, const StribeckFriction& law, double surface_speed) {
    return against_surface(std::move(name), coordinate, law, surface_speed,
                           [law](double speed) { return law.at(speed); });
}

DryFriction add_dry_friction(ForceSet& forces, LoopSet& loops, const std::string& name, BodyId coordinate,
                             const StribeckFriction& law, double surface_speed) {
    DryFriction friction{name, coordinate, law.static_force, surface_speed, 1e-6 * law.regularisation};
    const auto at_present = [law, state = friction.state](double speed) {
        if (state->engaged) return StribeckFriction::Force{};
        return state->direction == 0 ? law.at(speed) : law.sliding(speed, state->direction);
    };
    forces.add_element(against_surface(name, coordinate, law, surface_speed, at_present));
    loops.add_lock({name, coordinate, friction.state});
    return friction;
}

}  // namespace cardan
