#include "programs/shared/built_in_machines.hpp"

#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "turbines/machines/nrel5mw.hpp"
#include "turbines/machines/oc3_hywind.hpp"
#include "turbines/machines/teetered.hpp"
#include "turbines/machines/wt600_operation.hpp"
#include "turbines/model/beam_table.hpp"

#include <array>
#include <limits>

namespace cardan::program {

namespace {

// Directions that stay free in a machine as its own programs have it.
enum class Beams : std::uint8_t { as_they_are, without_torsion };

// As a table, so that the file of a result holds what was computed.
BeamLine as_table(const BeamLine& line, Beams beams) {
    const turbines::BeamTable* own = turbines::table_of(line);
    turbines::BeamTable table = own != nullptr ? *own : turbines::sampled(line);
    if (beams == Beams::without_torsion)
        for (EngineeringSection& section : table.sections)
            section.GJ = section.EA = std::numeric_limits<double>::infinity();
    return turbines::beam_line(table);
}

MachineFile built_in(turbines::TurbineDescription d, double rotor_speed, Beams blades = Beams::as_they_are,
                     Beams tower = Beams::as_they_are) {
    d.blade.line = as_table(d.blade.line, blades);
    d.tower.line = as_table(d.tower.line, tower);
    MachineFile machine = machine_of(std::move(d), MachineKind::built_in);
    machine.file.rotor_speed = rotor_speed;
    return machine;
}

MachineFile wt600_machine() {
    return built_in(turbines::wt600_description(), turbines::wt600_rated_speed());
}

MachineFile teetered_machine() {
    const turbines::TurbineDescription description = turbines::teetered_description();
    return built_in(description, description.rotor_speed);
}

// Tables 1-1 and 5-1 of the report: 5 MW with the losses of the generator; cut-in speed.
turbines::FileOperation nrel5mw_operation() {
    return {.rated_power = 5e6 / 0.944, .least_speed = 6.9 * units::rpm, .source = "the report"};
}

MachineFile nrel5mw_as(turbines::Nrel5mwVariant variant) {
    constexpr double rated = 12.1;  // rpm, Table 1-1 of the report
    using turbines::Nrel5mwVariant;
    MachineFile machine =
        built_in(turbines::nrel5mw_description(turbines::nrel5mw_options(variant)), rated * units::rpm,
                 variant == Nrel5mwVariant::fast ? Beams::without_torsion : Beams::as_they_are,
                 variant == Nrel5mwVariant::report ? Beams::as_they_are : Beams::without_torsion);
    machine.file.operation = nrel5mw_operation();
    return machine;
}

MachineFile nrel5mw_spar() {
    const turbines::TurbineDescription description = turbines::nrel5mw_oc3_hywind_description();
    MachineFile machine = built_in(description, description.rotor_speed);
    machine.file.operation = nrel5mw_operation();
    return machine;
}

struct BuiltIn {
    const char *name, *about;
    MachineFile (*machine)();
};

using turbines::Nrel5mwVariant;
constexpr std::array machines{
    BuiltIn{"wt600", "600 kW, three blades", wt600_machine},
    BuiltIn{"teetered", "two blades on a teetered hub, downwind, free to yaw", teetered_machine},
    BuiltIn{"nrel5mw", "NREL 5 MW, three blades, as in its report", [] { return nrel5mw_as(Nrel5mwVariant::report); }},
    BuiltIn{"nrel5mw-fast", "likewise, as modelled in ElastoDyn", [] { return nrel5mw_as(Nrel5mwVariant::fast); }},
    BuiltIn{"nrel5mw-beamdyn", "likewise, with the blades of BeamDyn",
            [] { return nrel5mw_as(Nrel5mwVariant::beamdyn); }},
    BuiltIn{"nrel5mw-spar", "likewise, afloat on the OC3-Hywind spar; with --gravity", nrel5mw_spar}};

}  // namespace

std::optional<MachineFile> built_in_machine(const std::string& name) {
    for (const BuiltIn& one : machines)
        if (name == one.name) return one.machine();
    return std::nullopt;
}

std::string built_in_names() {
    std::string all;
    for (const BuiltIn& one : machines) all += text(all.empty() ? "" : ", ", one.name);
    return all;
}

std::string built_in_help() {
    std::string help;
    for (const BuiltIn& one : machines)
        help += text("  ", one.name, std::string(18 - std::string(one.name).size(), ' '), one.about, "\n");
    return help;
}

}  // namespace cardan::program
