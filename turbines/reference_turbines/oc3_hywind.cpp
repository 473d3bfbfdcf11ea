#include "turbines/reference_turbines/oc3_hywind.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/text_file.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

#include <cmath>

namespace cardan::turbines {

namespace {

constexpr auto spar_table = "oc3_hywind_platform.csv";

void set_pair(Mat6& A, Eigen::Index i, Eigen::Index j, double value) {
    A(i, j) = A(j, i) = value;
}

Mat6 diagonal(double surge_sway, double heave, double roll_pitch, double yaw) {
    return (Vec6() << surge_sway, surge_sway, heave, roll_pitch, roll_pitch, yaw).finished().asDiagonal();
}

Mat6 mooring(const CsvQuantities& q) {
    Mat6 K = diagonal(q.number("mooring_surge_and_sway", "N/m"), q.number("mooring_heave", "N/m"),
                      q.number("mooring_roll_and_pitch", "N m/rad"),
                      q.number("mooring_yaw", "N m/rad") + q.number("additional_yaw_stiffness", "N m/rad"));
    const std::vector<double> given = q.numbers("mooring_surge_by_pitch", "N/rad");
    double mean = 0;
    for (double k : given) mean += k / static_cast<double>(given.size());
    set_pair(K, 0, 4, mean);
    set_pair(K, 1, 3, -mean);
    return K;
}

std::vector<HullStation> hull(const CsvQuantities& q) {
    const std::vector<double> depth = q.numbers("hull_depth", "m"), diameter = q.numbers("hull_diameter", "m");
    if (depth.size() != diameter.size())
        throw InputError(q.file(), "number of hull_diameter", diameter.size(),
                         text("that of hull_depth, ", depth.size()));
    std::vector<HullStation> stations;
    for (std::size_t i = 0; i < depth.size(); ++i) stations.push_back({depth[i], diameter[i]});
    return stations;
}

// Volume and hull are both published: one of them is wrong if they differ by more than their digits.
void check_volume(const CsvQuantities& q, const std::vector<HullStation>& stations) {
    const double given = q.number("displaced_volume", "m^3"), of_hull = displaced_volume(stations);
    if (!(std::abs(given - of_hull) <= 1e-4 * of_hull))
        throw InputError(q.file(), "displaced_volume [m^3]", given,
                         text("that of the hull, ", of_hull, ", within 1e-4"));
}

PlatformDescription describe_spar(const CsvQuantities& q) {
    PlatformDescription p;
    const std::vector<HullStation> stations = hull(q);
    p.name = "OC3-Hywind spar";
    p.inertia.mass = q.number("platform_mass", "kg");
    p.inertia.com.z() = -q.number("platform_cm_below_still_water", "m");
    const double lateral = q.number("platform_roll_and_pitch_inertia", "kg m^2");
    p.inertia.J = Vec3(lateral, lateral, q.number("platform_yaw_inertia", "kg m^2")).asDiagonal();
    p.tower_base.z() = q.number("tower_foot_above_still_water", "m");
    p.added_mass =
        strip_theory_added_mass(stations, q.number("added_mass_coefficient", "-"),
                                q.number("end_added_mass_coefficient", "-"), q.number("water_density", "kg/m^3"));
    check_volume(q, stations);
    p.hydrostatic_stiffness =
        diagonal(0, q.number("hydrostatic_heave", "N/m"), q.number("hydrostatic_roll_and_pitch", "N m/rad"), 0);
    p.mooring_stiffness = mooring(q);
    p.damping = diagonal(q.number("damping_surge_and_sway", "N s/m"), q.number("damping_heave", "N s/m"), 0,
                         q.number("damping_yaw", "N m s/rad"));
    p.buoyancy = q.number("buoyancy", "N");
    p.mooring_preload.z() = q.number("mooring_pull_heave", "N");
    p.coordinates.role = CoordinateRole::free;
    return p;
}

}  // namespace

PlatformDescription oc3_hywind() {
    PlatformDescription p = describe_spar(CsvQuantities::parse(embedded_data(spar_table), spar_table));
    p.source = embedded_data(spar_table);
    return p;
}

PlatformDescription oc3_hywind(const std::filesystem::path& folder) {
    const auto path = folder / spar_table;
    PlatformDescription p = describe_spar(CsvQuantities::read(path));
    p.source = text_file(path);
    return p;
}

TurbineDescription nrel5mw_oc3_hywind_description(Nrel5mwOptions options) {
    options.tower = Nrel5mwTower::oc3_hywind;
    TurbineDescription d = nrel5mw_description(options);
    d.platform = oc3_hywind();
    return d;
}

TurbineDescription nrel5mw_oc3_hywind_description(const std::filesystem::path& folder, Nrel5mwOptions options) {
    const PlatformDescription spar = oc3_hywind(folder);
    options.tower = Nrel5mwTower::oc3_hywind;
    TurbineDescription d = nrel5mw_description(folder, options);
    d.platform = spar;
    return d;
}

Turbine nrel5mw_on_oc3_hywind(CoordinateRole role, Nrel5mwVariant variant, int blade_elements, int tower_elements,
                              const Vec3& gravity) {
    TurbineDescription d = nrel5mw_oc3_hywind_description(nrel5mw_options(variant));
    d.platform->coordinates.role = role;
    AssemblyOptions options = nrel5mw_assembly(variant, blade_elements, tower_elements);
    options.gravity = gravity;
    return assemble(d, options);
}

}  // namespace cardan::turbines
