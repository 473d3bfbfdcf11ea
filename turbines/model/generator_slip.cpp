#include "turbines/model/generator_slip.hpp"

#include "mbs/base/error.hpp"

#include <cmath>

namespace cardan::turbines {

double slip_damping(const KlossCurve& law, double gear_ratio, double torque) {
    constexpr const char* place = "generator slip";
    law.check(place);
    const double part = torque / law.breakdown_torque;
    if (!(std::abs(part) < 1))
        throw InputError(place, "torque [N m]", torque,
                         text("within +-", law.breakdown_torque, ", the breakdown torque"));
    // Kloss' formula solved for the slip over that of breakdown, 2 r / (1 + r^2) = part, on the stable branch |r| < 1.
    const double r = part / (1 + std::sqrt(1 - part * part));
    return gear_ratio * gear_ratio * law.slope(law.synchronous_speed * (1 + r * law.breakdown_slip));
}

Turbine with_generator_slip(const Turbine& turbine, const KlossCurve& law, double torque) {
    const MachineLayout& layout = turbine.layout();
    if (!layout.generator) throw InputError(turbine.rotor().machine, "generator", "none", "one that slips");
    ForceSet forces = turbine.forces();
    const double damping = slip_damping(law, layout.gear_ratio, torque);
    forces.add_spring("generator slip", *layout.generator, 0, damping);
    return turbine.with_forces(forces, text("slip of the generator: ", damping, " N m s/rad on the slow side, at ",
                                            torque, " N m of its torque"));
}

}  // namespace cardan::turbines
