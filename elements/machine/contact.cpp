#include "elements/machine/contact.hpp"

#include "elements/machine/coordinate_force.hpp"
#include "elements/machine/pair_law.hpp"
#include "mbs/base/error.hpp"

#include <cmath>
#include <utility>

namespace cardan {

void HuntCrossley::check(const std::string& where) const {
    require_positive(where, "stiffness", stiffness);
    if (!(exponent >= 1) || std::isinf(exponent)) throw InputError(where, "exponent", exponent, "finite and >= 1");
    require_not_negative(where, "dissipation", dissipation);
}

HuntCrossley::Force HuntCrossley::at(double depth, double speed) const {
    if (!(depth > 0)) return {};
    const double elastic = stiffness * std::pow(depth, exponent), losses = 1 + dissipation * speed;
    const double energy = elastic * depth / (exponent + 1);
    if (losses <= 0) return {0, 0, 0, energy};
    return {elastic * losses, exponent * elastic / depth * losses, elastic * dissipation, energy};
}

void add_plane_contact(ForceSet& forces, const PlaneContact& contact) {
    contact.law.check(text("contact '", contact.name, "'"));
    PairLaw pair{contact.name, contact.plane, contact.point, {PairMeasure::along(2)}, {}};
    pair.law = [law = contact.law](double /*time*/, const Vector& x, const Vector& v, PairForces& out) {
        const HuntCrossley::Force force = law.at(-x(0), -v(0));
        out.f(0) = force.force;
        out.by_x(0, 0) = -force.by_depth;
        out.by_v(0, 0) = -force.by_speed;
        out.energy = force.energy;
    };
    forces.add_element(pair_force(pair));
}

ForceElement contact_stop(std::string name, BodyId coordinate, double limit, bool upper, const HuntCrossley& law) {
    const std::string where = text("stop '", name, "'");
    if (!std::isfinite(limit)) throw InputError(where, "limit", limit, "finite");
    law.check(where);
    const double sense = upper ? 1 : -1;
    const auto along = [=](double, double position, double rate) -> CoordinateLaw {
        const HuntCrossley::Force force = law.at(sense * (position - limit), sense * rate);
        return {-sense * force.force, -force.by_depth, -force.by_speed, force.energy};
    };
    return coordinate_force(std::move(name), coordinate, along, true);
}

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
