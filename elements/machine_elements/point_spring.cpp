#include "elements/machine_elements/point_spring.hpp"

#include "elements/machine_elements/pair_law.hpp"
#include "mbs/base/error.hpp"

#include <utility>

namespace cardan {

void add_point_spring(ForceSet& forces, const PointSpring& spring) {
    const std::string where = text("spring '", spring.name, "'");
    require_not_negative(where, "stiffness [N/m]", spring.stiffness);
    require_not_negative(where, "damping [N s/m]", spring.damping);
    require_not_negative(where, "length [m]", spring.length);
    if (spring.stiffness == 0 && spring.damping == 0)
        throw InputError(where, "stiffness and damping", 0, "one of them > 0");
    PairLaw pair{spring.name, spring.a, spring.b, {PairMeasure::distance()}, {}};
    pair.law = [spring](double /*time*/, const Vector& x, const Vector& v, PairForces& out) {
        const double stretch = x(0) - spring.length, tension = spring.stiffness * stretch + spring.damping * v(0);
        if (spring.cable && stretch > 0) out.energy = spring.stiffness * stretch * stretch / 2;
        if (spring.cable && (stretch <= 0 || tension <= 0)) return;
        out.f(0) = -tension;
        out.by_x(0, 0) = -spring.stiffness;
        out.by_v(0, 0) = -spring.damping;
        out.energy = spring.stiffness * stretch * stretch / 2;
    };
    forces.add_element(pair_force(pair));
}

}  // namespace cardan
