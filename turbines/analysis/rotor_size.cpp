#include "turbines/analysis/rotor_size.hpp"

#include "mbs/base/error.hpp"
#include "turbines/model/assembly.hpp"

namespace cardan::turbines {

RotorSize rotor_size(const Machine& machine) {
    const TurbineDescription& d = machine.description;
    const double diameter = 2 * (d.hub.radius + d.blade.line.length);
    if (d.blades < 1 || !(diameter > 0)) throw InputError(d.name, "blades", d.blades, "a machine with blades");
    AssemblyOptions options;
    options.tower_elements = options.blade_elements = 2;  // where the rotor is does not depend on them
    return {.hub_height = still_wind(assemble(d, options), machine, machine.site.density).reference_height,
            .diameter = diameter};
}

}  // namespace cardan::turbines
