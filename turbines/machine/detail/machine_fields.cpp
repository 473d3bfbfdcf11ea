#include "turbines/machine/detail/machine_fields.hpp"

#include "mbs/base/error.hpp"

#include <cmath>
#include <utility>

namespace cardan::turbines {

AirFields fields_of(const Aerodynamics& air) {
    AirFields fields{air, {}, {}};
    for (const std::size_t index : air.blade.airfoil) fields.airfoil.push_back(static_cast<double>(index) + 1);
    for (std::size_t i = 0; i < air.blade.polars.size(); ++i) {
        const Polar& polar = air.blade.polars[i];
        AirfoilFields& airfoil = fields.airfoils.emplace_back(AirfoilFields{polar.name(), {}});
        for (std::size_t k = 0; k < polar.tables(); ++k) airfoil.tables.push_back(polar.table(k));
        if (air.unsteady_airfoils.empty()) continue;
        airfoil.unsteady = {air.unsteady_airfoils[i].flow(), air.unsteady_airfoils[i].lags()};
    }
    fields.air.blade.airfoil.clear();
    fields.air.blade.polars.clear();
    fields.air.unsteady_airfoils.clear();
    return fields;
}

namespace {

void add_airfoil(Aerodynamics& air, AirfoilFields airfoil) {
    air.blade.polars.emplace_back(std::move(airfoil.name), std::move(airfoil.tables));
    if (airfoil.unsteady)
        air.unsteady_airfoils.emplace_back(air.blade.polars.back(), airfoil.unsteady->flow, airfoil.unsteady->lags);
}

}  // namespace

Aerodynamics aerodynamics_of(AirFields fields) {
    Aerodynamics air = std::move(fields.air);
    for (AirfoilFields& airfoil : fields.airfoils) add_airfoil(air, std::move(airfoil));
    const std::size_t airfoils = air.blade.polars.size();
    if (!air.unsteady_airfoils.empty() && air.unsteady_airfoils.size() != airfoils)
        throw InputError("airfoils", "those with 'unsteady'", air.unsteady_airfoils.size(),
                         text("none, or all ", airfoils, "; one that does not lag has the lift_slope 0"));
    for (const double number : fields.airfoil) {
        if (number != std::round(number) || number < 1 || number > static_cast<double>(airfoils))
            throw InputError("blade", "airfoil", number, text("1 ... ", airfoils));
        air.blade.airfoil.push_back(static_cast<std::size_t>(number) - 1);
    }
    air.blade.check();
    require_positive("all", "density [kg/m^3]", air.density);
    require_not_negative("all", "inflow_time_constant [s]", air.model.inflow_time_constant);
    if (!air.options.induction) air.model.wake = Wake::none;
    air.options.induction = air.model.wake != Wake::none;
    if (!air.torsion_sweep.empty() && air.torsion_sweep.size() != air.blade.sections())
        throw InputError("blade", "values of torsion_sweep", air.torsion_sweep.size(),
                         text(air.blade.sections(), ", one per section"));
    air.support.tower.check();
    air.support.nacelle.check();
    return air;
}

}  // namespace cardan::turbines
