#include "turbines/reference_turbines/nrel5mw_geometry.hpp"

#include "mbs/base/units.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

namespace cardan::turbines {

namespace {

// FAST counts tilt and overhang negative for an upwind rotor, the cone like this library.
Nrel5mwGeometry read_geometry() {
    constexpr auto table = "nrel5mw_turbine.csv";
    const CsvQuantities q = CsvQuantities::parse(embedded_data(table), table);
    return {.tower_height = q.number("tower_height", "m"),
            .shaft_above_tower = q.number("tower_top_to_shaft_vertical", "m"),
            .overhang = -q.number("overhang", "m"),
            .tilt = -q.number("shaft_tilt", "deg") * units::degree,
            .cone = q.number("precone", "deg") * units::degree,
            .hub_radius = q.number("hub_radius", "m"),
            .rated_speed = q.number("rated_rotor_speed", "rpm") * units::rpm};
}

}  // namespace

const Nrel5mwGeometry& nrel5mw_geometry() {
    static const Nrel5mwGeometry geometry = read_geometry();
    return geometry;
}

}  // namespace cardan::turbines
