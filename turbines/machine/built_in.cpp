#include "turbines/machine/built_in.hpp"

#include "elements/sections/beam_line.hpp"
#include "mbs/base/units.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"
#include "turbines/reference_turbines/oc3_hywind.hpp"
#include "turbines/reference_turbines/teetered.hpp"
#include "turbines/reference_turbines/wt600_operation.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <utility>

namespace cardan::turbines {

namespace {

// Directions that stay free in a machine as its own programs have it.
enum class Beams : std::uint8_t { as_they_are, without_torsion };

BeamLine as_table(const BeamLine& line, Beams beams) {
    const BeamTable* own = line.section.table();
    BeamTable table = own != nullptr ? *own : sampled(line);
    if (beams == Beams::without_torsion)
        for (EngineeringSection& section : table.sections)
            section.GJ = section.EA = std::numeric_limits<double>::infinity();
    return beam_line(table);
}

Machine with_tables(TurbineDescription d, Beams blades = Beams::as_they_are, Beams tower = Beams::as_they_are) {
    d.blade.line = as_table(d.blade.line, blades);
    d.tower.line = as_table(d.tower.line, tower);
    return machine_of(std::move(d));
}

Machine wt600_machine() {
    constexpr auto file = "wt600_turbine.csv";
    const CsvQuantities table = CsvQuantities::parse(embedded_data(file), file);
    Machine machine = with_tables(wt600_description());
    machine.operation.rotor_speed = wt600_rated_speed();
    machine.operation.rated_power = table.number("rated_power", "W");
    machine.operation.min_speed = table.number("rotor_speed_min", "rpm") * units::rpm;
    machine.operation.tip_speed_ratio = table.number("tip_speed_ratio", "-");
    machine.operation.source = "Table 1 of the paper";
    return machine;
}

Machine teetered_machine() {
    return with_tables(teetered_description());
}

// Tables 1-1 and 5-1 of the report: 5 MW with the losses of the generator; cut-in speed. Centres of the airfoils on the
// pitch axis as in AeroDyn's files, and where the report has them, which torsion feels.
Machine nrel5mw_machine(TurbineDescription description, Beams blades, Beams tower) {
    constexpr double efficiency = 0.944;
    Machine machine = with_tables(std::move(description), blades, tower);
    machine.operation.rotor_speed = 12.1 * units::rpm;
    machine.operation.rated_power = 5e6 / efficiency;
    machine.operation.min_speed = 6.9 * units::rpm;
    machine.operation.source = "the report";
    machine.controller.generator_efficiency = efficiency;
    Aerodynamics& air = machine.air.emplace();
    air.blade = nrel5mw_aero_blade();
    air.unsteady_airfoils = nrel5mw_unsteady_airfoils();
    air.torsion_sweep = nrel5mw_aero_blade(Nrel5mwCentres::report).sweep;
    machine.no_air.clear();
    return machine;
}

Machine nrel5mw_as(Nrel5mwVariant variant) {
    return nrel5mw_machine(nrel5mw_description(nrel5mw_options(variant)),
                           variant == Nrel5mwVariant::fast ? Beams::without_torsion : Beams::as_they_are,
                           variant == Nrel5mwVariant::report ? Beams::as_they_are : Beams::without_torsion);
}

Machine nrel5mw_spar() {
    return nrel5mw_machine(nrel5mw_oc3_hywind_description(), Beams::as_they_are, Beams::as_they_are);
}

struct Named {
    const char *name, *about;
    Machine (*machine)();
};

constexpr std::array named_machines{
    Named{"wt600", "600 kW, three blades", wt600_machine},
    Named{"teetered", "two blades on a teetered hub, downwind, free to yaw", teetered_machine},
    Named{"nrel5mw", "NREL 5 MW, three blades, as in its report", [] { return nrel5mw_as(Nrel5mwVariant::report); }},
    Named{"nrel5mw-fast", "likewise, as modelled in ElastoDyn", [] { return nrel5mw_as(Nrel5mwVariant::fast); }},
    Named{"nrel5mw-beamdyn", "likewise, with the blades of BeamDyn",
          [] { return nrel5mw_as(Nrel5mwVariant::beamdyn); }},
    Named{"nrel5mw-spar", "likewise, afloat on the OC3-Hywind spar; with --gravity", nrel5mw_spar}};

}  // namespace

std::vector<BuiltInMachine> built_in_machines() {
    std::vector<BuiltInMachine> machines;
    machines.reserve(named_machines.size());
    for (const Named& one : named_machines) machines.push_back({one.name, one.about});
    return machines;
}

std::optional<Machine> built_in_machine(const std::string& name) {
    for (const Named& one : named_machines)
        if (name == one.name) return one.machine();
    return std::nullopt;
}

}  // namespace cardan::turbines
