#include "elements/machine_elements/coordinate_force.hpp"

#include "mbs/base/error.hpp"

#include <utility>

namespace cardan {

ForceElement coordinate_force(std::string name, BodyId coordinate,
                              std::function<CoordinateLaw(double, double, double)> law, bool elastic) {
    if (!law) throw InputError(text("force '", name, "'"), "law", "empty function", "a callable one");
    ForceElement force{.name = std::move(name), .coordinates = {coordinate}, .elastic = elastic};
    const auto at = [law = std::move(law)](const ElementView& in) { return law(in.time, in.q(0), in.qd(0)); };
    force.evaluate = [at](const ElementView& in, ElementForces& out) { out.Q(0) = at(in).force; };
    force.jacobian = [at](const ElementView& in, ElementJacobian& d) {
        const CoordinateLaw now = at(in);
        d.Q_q(0, 0) = now.by_position;
        d.Q_qd(0, 0) = now.by_rate;
    };
    if (elastic) force.potential = [at](const ElementView& in) { return at(in).energy; };
    return force;
}

}  // namespace cardan
