#include "turbines/aerodynamics/nrel5mw_air.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/stations.hpp"
#include "mbs/base/units.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

#include <span>

namespace cardan::turbines {

namespace {

CsvTable table(const char* name) {
    return CsvTable::parse(embedded_data(name), name);
}

std::vector<Polar> polars() {
    const CsvTable t = table("nrel5mw_polars.csv");
    const auto number = t.column("airfoil"), angle = t.column("angle_of_attack", "deg"),
               lift = t.column("lift_coefficient"), drag = t.column("drag_coefficient"),
               moment = t.column("moment_coefficient");
    std::vector<Polar> out;
    for (std::size_t i = 0, next = 0; i < t.rows(); i = next) {
        std::vector<double> a, l, d, m;
        for (next = i; next < t.rows() && number[next] == number[i]; ++next) {
            a.push_back(angle[next] * units::degree);
            l.push_back(lift[next]);
            d.push_back(drag[next]);
            m.push_back(moment[next]);
        }
        out.emplace_back(text("airfoil ", number[i]), std::move(a), std::move(l), std::move(d), std::move(m));
    }
    return out;
}

}  // namespace

std::vector<UnsteadyAirfoil> nrel5mw_unsteady_airfoils() {
    const CsvTable t = table("nrel5mw_unsteady.csv");
    const auto slope = t.column("slope", "1/rad"), zero = t.column("zero_lift", "deg"),
               upper = t.column("upper", "deg"), lower = t.column("lower", "deg"), drag = t.column("zero_lift_drag");
    std::vector<UnsteadyAirfoil> out;
    for (const Polar& polar : polars()) {
        const std::size_t i = out.size();
        out.emplace_back(polar, AttachedFlow{.slope = slope[i],
                                             .zero_lift = zero[i] * units::degree,
                                             .upper = upper[i] * units::degree,
                                             .lower = lower[i] * units::degree,
                                             .zero_lift_drag = drag[i]});
    }
    return out;
}

namespace {

// From the pitch axis toward the trailing edge, m. The table counts from the leading edge of a section whose pitch axis
// lies at a quarter of the chord [FAST user's guide, 2005].
std::vector<double> centres_of_report(const AeroBlade& blade) {
    const CsvTable t = table("nrel5mw_blade.csv");
    const auto list = [](std::span<const double> values) { return std::vector<double>(values.begin(), values.end()); };
    const std::vector<double> radius = list(t.column("radius_from_rotor_apex", "m")),
                              centre = list(t.column("aero_centre_param"));
    std::vector<double> out;
    out.reserve(blade.sections());
    for (std::size_t i = 0; i < blade.sections(); ++i)
        out.push_back((place_among(radius, blade.position[i]).of(centre) - 0.25) * blade.chord[i]);
    return out;
}

}  // namespace

AeroBlade nrel5mw_aero_blade(Nrel5mwCentres centres) {
    const CsvTable t = table("nrel5mw_aero_blade.csv");
    const auto radius = t.column("radius", "m"), chord = t.column("chord", "m"), twist = t.column("twist", "deg"),
               airfoil = t.column("airfoil");
    AeroBlade blade;
    blade.polars = polars();
    for (std::size_t i = 0; i < t.rows(); ++i) {
        blade.position.push_back(radius[i]);
        blade.chord.push_back(chord[i]);
        blade.twist.push_back(twist[i] * units::degree);
        blade.airfoil.push_back(static_cast<std::size_t>(airfoil[i]) - 1);
    }
    if (centres == Nrel5mwCentres::report) {
        blade.prebend.assign(blade.sections(), 0);
        blade.sweep = centres_of_report(blade);
    }
    return blade;
}

}  // namespace cardan::turbines
