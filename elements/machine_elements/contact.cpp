#include "elements/machine_elements/contact.hpp"

#include "elements/machine_elements/coordinate_force.hpp"
#include "elements/machine_elements/pair_law.hpp"
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

}  // namespace cardan
