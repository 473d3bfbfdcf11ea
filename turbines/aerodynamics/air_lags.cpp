// Air that lags behind the motion of a machine: which states there are, and where they come to rest.
#include "mbs/base/borrowed.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "turbines/aerodynamics/detail/machine_air_parts.hpp"

#include <array>
#include <numeric>
#include <span>

namespace cardan::turbines {

namespace {

// Has a section a balance of momentum? Root and tip have none where losses count.
bool has_balance(const Annulus& annulus, const RotorAirOptions& options) {
    const MomentumOptions& momentum = options.momentum;
    return options.induction && !(momentum.tip_loss && annulus.tip <= 0) && !(momentum.hub_loss && annulus.hub <= 0);
}

struct StateKindOfAir {
    const char *name, *unit;
    double scale;
};
constexpr std::array<StateKindOfAir, DynamicInflow::states> inflow_states{{{"early axial inflow", "m/s", 1},
                                                                           {"early tangential inflow", "m/s", 1},
                                                                           {"axial inflow", "m/s", 1},
                                                                           {"tangential inflow", "m/s", 1}}};
constexpr std::array<StateKindOfAir, UnsteadyAirfoil::states> airfoil_states{{{"fast wake of the airfoil", "rad", 0.1},
                                                                              {"slow wake of the airfoil", "rad", 0.1},
                                                                              {"lagging lift", "1", 1},
                                                                              {"point of separation", "1", 1}}};

void find_first_states(AirLags& lags) {
    lags.first.clear();
    lags.states = 0;
    for (const UnsteadySection& section : lags.sections) {
        lags.first.push_back(lags.states);
        lags.states += section.states();
    }
}

// Of a machine without lags: nothing lags in any section.
AirLags lags_of(const AirParts& parts) {
    if (parts.lags) return *parts.lags;
    AirLags out;
    out.sections.resize(parts.blades.size() * parts.airfoil->sections());
    return out;
}

// inflow_weights() of all sections.
std::vector<double> weights_of(const AirParts& parts) {
    const std::vector<double>& position = parts.airfoil->position;
    std::vector<double> shares;
    for (std::size_t k = 0; k < parts.blades.size(); ++k)
        for (const double at : position) shares.push_back(at / position.back());
    return inflow_weights(shares);
}

}  // namespace

std::vector<StateInfo> states_of(const AirParts& parts, const std::vector<int>& blade_numbers) {
    std::vector<StateInfo> all;
    const std::size_t count = parts.airfoil->sections();
    for (std::size_t i = 0; i < parts.lags->sections.size(); ++i) {
        const UnsteadySection& lags = parts.lags->sections[i];
        const int number = blade_numbers[i / count];
        const auto add = [&](const StateKindOfAir& kind, const char* part) {
            all.push_back({.name = text("blade ", number, " section ", i % count + 1, " ", kind.name),
                           .unit = kind.unit,
                           .scale = kind.scale,
                           .part = part,
                           .blade = number});
        };
        if (lags.inflow_states() > 0)
            for (const StateKindOfAir& kind : inflow_states) add(kind, "wake");
        for (const StateKindOfAir& kind :
             std::span(airfoil_states).last(static_cast<std::size_t>(lags.airfoil_states())))
            add(kind, "airfoil lag");
    }
    return all;
}

// Through the wake of the rotor a section sees the mean wind at all blades.
std::vector<ElementGroup> groups_of(const AirParts& parts, const std::vector<BodyId>& body_ids) {
    std::vector<ElementGroup> all;
    const std::size_t count = parts.airfoil->sections();
    for (std::size_t i = 0; i < parts.lags->sections.size(); ++i) {
        const int states = parts.lags->sections[i].states();
        if (states == 0) continue;
        ElementGroup& group = all.emplace_back();
        group.states.resize(static_cast<std::size_t>(states));
        std::iota(group.states.begin(), group.states.end(), parts.lags->first[i]);
        const bool has_wake = parts.options.induction && parts.lags->sections[i].wake != Wake::frozen;
        const std::vector<int>& seen = has_wake ? parts.bodies : parts.blades[i / count].path;
        group.coordinates.reserve(seen.size());
        for (const int body : seen) group.coordinates.push_back(entry(body_ids, body));
    }
    return all;
}

MachineAir MachineAir::with(AirLags lags) const {
    find_first_states(lags);
    const auto parts = std::make_shared<Parts>(*parts_);
    parts->lags = std::move(lags);
    return MachineAir(parts);
}

MachineAir MachineAir::lagging(UnsteadyAeroOptions options) const {
    const AeroBlade& blade = *parts_->airfoil;
    if (!options.airfoils.empty() && options.airfoils.size() != blade.polars.size())
        throw InputError("air that lags", "number of airfoils", options.airfoils.size(),
                         text(blade.polars.size(), ", that of the blade's polars, or none"));
    require_not_negative("air that lags", "time of the wake [s]", options.inflow_time_constant);
    AirLags lags;
    lags.airfoils = std::make_shared<const std::vector<UnsteadyAirfoil>>(std::move(options.airfoils));
    const double tip = blade.position.back();
    for (const AirBlade& own : parts_->blades)
        for (std::size_t i = 0; i < blade.sections(); ++i) {
            UnsteadySection& section = lags.sections.emplace_back();
            if (!lags.airfoils->empty()) section.airfoil = &(*lags.airfoils)[blade.airfoil[i]];
            section.at_rest = options.airfoils_at_rest;
            section.share = blade.position[i] / tip;
            if (options.dynamic_inflow && has_balance(own.sections[i].annulus, parts_->options))
                section.wake = Wake::oye;
        }
    if (options.dynamic_inflow) {
        lags.inflow_time = options.inflow_time_constant;
        lags.inflow_weights = weights_of(*parts_);
    }
    return with(std::move(lags));
}

MachineAir MachineAir::with_frozen_wake(const ElementView& at) const {
    const std::array now{sections(at)};
    return with_frozen_wake(now);
}

MachineAir MachineAir::with_frozen_wake(std::span<const std::vector<std::vector<SectionAir>>> states) const {
    if (states.empty()) throw InputError("frozen wake", "number of states", 0, "at least 1");
    AirLags lags = lags_of(*parts_);
    const std::size_t count = parts_->airfoil->sections();
    const double share = 1 / static_cast<double>(states.size());
    lags.inflow_weights.clear();
    for (UnsteadySection& section : lags.sections) {
        section.wake = Wake::frozen;
        section.velocity.setZero();
    }
    for (const std::vector<std::vector<SectionAir>>& state : states) {
        if (state.size() * count != lags.sections.size())
            throw InputError("frozen wake", "number of blades", state.size(), text(lags.sections.size() / count));
        for (std::size_t i = 0; i < lags.sections.size(); ++i) {
            const SectionAir& air = state[i / count].at(i % count);
            lags.sections[i].velocity += share * DynamicInflow::velocity(air.induction, air.V_x, air.V_y);
        }
    }
    return with(std::move(lags));
}

int MachineAir::states() const {
    return parts_->lags ? parts_->lags->states : 0;
}

ElementValues MachineAir::values(const StateView& at, const Forces& forces) const {
    return {forces.elements(), name_of_air, at};
}

MachineAir MachineAir::with_wind_input(const std::string& name) const {
    if (name.empty()) throw InputError("air on a machine", "name of the wind's input", "''", "not empty");
    const auto parts = std::make_shared<Parts>(*parts_);
    parts->wind_input = name;
    return MachineAir(parts);
}

Vector MachineAir::steady_states(const ElementView& at) const {
    Vector out = Vector::Zero(states());
    const Vector any = Vector::Zero(states());
    Borrowed<AirScratch> scratch;
    const ElementView still(at.time, at.q, at.qd, any, at.others, at.u, at.system);
    AirEvaluation(*parts_, still, *scratch).steady_states(out);
    return out;
}

Vector MachineAir::with_states(const Vector& own, const Forces& forces) const {
    const BoundElements& elements = forces.elements();
    const std::vector<StateInfo>& infos = elements[elements.index(name_of_air)].states;
    Vector all = forces.states().initial();
    for (std::size_t i = 0; i < infos.size(); ++i)
        all(forces.states().index(infos[i].name)) = own(static_cast<Eigen::Index>(i));
    return all;
}

double MachineAir::inflow_time_constant(const ElementView& at) const {
    const MachineAir varying = lagging({.dynamic_inflow = true});
    const Vector any = Vector::Zero(varying.states());
    Borrowed<AirScratch> scratch;
    const ElementView with_states(at.time, at.q, at.qd, any, at.others, at.u, at.system);
    return AirEvaluation(*varying.parts_, with_states, *scratch).inflow_time();
}

}  // namespace cardan::turbines
