#include "turbines/aerodynamics/detail/air_evaluation.hpp"

#include "mbs/base/elementary.hpp"
#include "mbs/base/registers/packed.hpp"
#include "mbs/base/registers/vectorised.hpp"

#include <algorithm>
#include <cmath>

namespace cardan::turbines {

namespace {

using Packed = Packed3<double>;

// Places, axes and velocities of sections, and their chords' components; a vector fills a register.
CARDAN_VECTORISED void place_blade(std::size_t count, const AirSection* __restrict sections,
                                   const KernelArrays::Frame* frames, const BodyRate* rates, const Vec3& shaft,
                                   const Vec3& hub, SectionState* __restrict out, double* __restrict along_x,
                                   double* __restrict along_y) {
    const Packed e = Packed::of(shaft), h = Packed::of(hub);
    for (std::size_t i = 0; i < count; ++i) {
        const AirSection& own = sections[i];
        const KernelArrays::Frame& frame = frames[own.body];
        const BodyRate& rate = rates[own.body];
        const Packed arm = frame.E * Packed::of(own.place), place = frame.o + arm,
                     span = frame.E * Packed::of(own.span), chord = frame.E * Packed::of(own.chord),
                     side = cross(span, e), y = (1 / std::sqrt(dot(side, side))) * side, x = cross(y, span),
                     velocity = Packed::of(rate.origin) + cross(Packed::of(rate.angular), arm), from_hub = place - h,
                     radial = from_hub - dot(from_hub, e) * e;
        const double radius = std::sqrt(dot(radial, radial));
        SectionState& s = out[i];
        s.place = place.vector();
        s.span = span.vector();
        s.x = x.vector();
        s.y = y.vector();
        s.velocity = velocity.vector();
        s.radial = ((1 / radius) * radial).vector();
        s.annulus = own.annulus;
        s.annulus.radius = radius;
        along_x[i] = dot(chord, x);
        along_y[i] = dot(chord, y);
    }
}

}  // namespace

AirEvaluation::AirEvaluation(const AirParts& parts, const ElementView& at, AirScratch& scratch)
    : parts_(parts),
      kin_(at.system.kinematics),
      states_(at.s),
      scratch_(scratch),
      motion_(at.system, parts.bodies, scratch.rates),
      wind_(parts.wind, at.time, at.u.size() > 0 ? at.u(0) : 0) {
    shaft_ = motion_.rotation(parts.hub_body) * parts.hub_axis;
    hub_ = motion_.place(parts.hub_body, parts.hub_place);
    place_sections();
    if (parts.influence) disturb_wind();
    find_mean_wind();
    find_loads();
}

double AirEvaluation::power(const Wrench& wrench, int body, const Vec3& place) const {
    return wrench.force.dot(motion_.velocity(body, place)) + wrench.moment.dot(motion_.angular(body));
}

double AirEvaluation::speed() const {
    return (motion_.angular(parts_.hub_body) - motion_.angular(parts_.shaft_body)).dot(shaft_);
}

void AirEvaluation::place_sections() {
    const std::size_t count = parts_.airfoil->sections(), all = parts_.blades.size() * count;
    scratch_.sections.resize(all);
    for (std::vector<Vec3>* places : {&scratch_.places, &scratch_.winds}) places->resize(all);
    for (std::vector<double>* numbers : {&scratch_.along_x, &scratch_.along_y, &scratch_.angles}) numbers->resize(all);
    for (std::size_t k = 0; k < parts_.blades.size(); ++k)
        place_blade(count, parts_.blades[k].sections.data(), kin_.arrays().frame.data(), scratch_.rates.data(), shaft_,
                    hub_, scratch_.sections.data() + k * count, scratch_.along_x.data() + k * count,
                    scratch_.along_y.data() + k * count);
    for (std::size_t i = 0; i < all; ++i) scratch_.places[i] = scratch_.sections[i].place;
    wind_.at(scratch_.places, scratch_.winds);
    arc_tangents(scratch_.along_x, scratch_.along_y, scratch_.angles);
    for (std::size_t i = 0; i < all; ++i) {
        SectionState& s = scratch_.sections[i];
        s.relative = scratch_.winds[i] - s.velocity;
        s.annulus.angle = scratch_.angles[i];
    }
}

void AirEvaluation::disturb_wind() {
    scratch_.influence.resize(scratch_.sections.size());
    for (std::size_t i = 0; i < scratch_.sections.size(); ++i) {
        SectionState& s = scratch_.sections[i];
        scratch_.influence[i] = influence_at(*parts_.influence, motion_, wind_, s.place);
        if (scratch_.influence[i].acts) s.relative += scratch_.influence[i].disturbance;
    }
}

// Of the wind at the sections, less the velocity of the hub.
void AirEvaluation::find_mean_wind() {
    Vec3 sum = Vec3::Zero();
    for (const SectionState& s : scratch_.sections) sum += s.relative + s.velocity;
    mean_.velocity = sum / static_cast<double>(scratch_.sections.size()) - motion_.velocity(parts_.hub_body, hub_);
    mean_.normal = mean_.velocity.dot(shaft_);
    mean_.speed = mean_.velocity.norm();
    mean_.angle = skew_angle(mean_.normal, across(mean_.velocity, shaft_).norm());
    mean_.share = induction_share(speed() * parts_.radius, mean_.speed);
}

Vec3 AirEvaluation::blade_direction(std::size_t blade) const {
    return across(kin_.rotation(parts_.hub_body) * parts_.blades[blade].axis, shaft_).normalized();
}

double AirEvaluation::sine(std::size_t blade) const {
    return mean_.speed > 0 ? blade_direction(blade).dot(mean_.velocity) / mean_.speed : 0;
}

SectionMotion AirEvaluation::motion_of(std::size_t section) const {
    const std::size_t count = parts_.airfoil->sections();
    const SectionState& s = scratch_.sections[section];
    const int body = parts_.blades[section / count].sections[section % count].body;
    const SectionInflow& inflow = scratch_.inflows[section];
    return {inflow.V_x, inflow.V_y, motion_.angular(body).dot(s.span), s.wake};
}

SectionStates AirEvaluation::states_of(std::size_t section) const {
    SectionStates out = SectionStates::Zero();
    const int count = parts_.lags->sections[section].states();
    out.head(count) = states_.segment(parts_.lags->first[section], count);
    return out;
}

void AirEvaluation::rates(VectorOut out) const {
    if (!parts_.lags) return;
    for (std::size_t i = 0; i < scratch_.lagging.size(); ++i) {
        const int count = parts_.lags->sections[i].states();
        out.segment(parts_.lags->first[i], count) = scratch_.lagging[i].rates.head(count);
    }
}

void AirEvaluation::steady_states(VectorOut out) const {
    if (!parts_.lags) return;
    for (std::size_t i = 0; i < scratch_.lagging.size(); ++i) {
        const UnsteadySection& lags = parts_.lags->sections[i];
        out.segment(parts_.lags->first[i], lags.states()) =
            cardan::steady_states(scratch_.sections[i].annulus, motion_of(i), parts_.options, lags).head(lags.states());
    }
}

// In equilibrium with the loads.
void AirEvaluation::find_inductions() {
    const std::size_t count = scratch_.sections.size();
    scratch_.inflows.resize(count);
    scratch_.inductions.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const SectionState& s = scratch_.sections[i];
        scratch_.inflows[i] = {&s.annulus, s.relative.dot(s.x), s.relative.dot(s.y)};
    }
    const auto is_frozen = [](const UnsteadySection& lags) { return lags.wake == Wake::frozen; };
    if (!parts_.options.induction || mean_.share.value == 0 ||
        (parts_.lags && std::ranges::all_of(parts_.lags->sections, is_frozen))) {
        for (std::size_t i = 0; i < count; ++i)
            scratch_.inductions[i] = {.phi = std::atan2(scratch_.inflows[i].V_x, scratch_.inflows[i].V_y)};
        return;
    }
    solve_inductions(scratch_.inflows, parts_.options.momentum, scratch_.inductions);
}

void AirEvaluation::find_inflow_time() {
    if (!parts_.lags || parts_.lags->inflow_weights.empty()) return;
    inflow_time_ = parts_.lags->inflow_time;
    if (inflow_time_ > 0) return;
    double induction = 0, wind = 0;
    const std::size_t count = scratch_.inflows.size();
    for (std::size_t i = 0; i < count; ++i) {
        induction += parts_.lags->inflow_weights[i] * mean_.share.value * scratch_.inductions[i].axial;
        wind += scratch_.inflows[i].V_x / static_cast<double>(count);
    }
    inflow_time_ = cardan::inflow_time(parts_.radius, induction, wind);
}

void AirEvaluation::find_loads() {
    find_inductions();
    find_inflow_time();
    const std::size_t count = parts_.airfoil->sections();
    for (std::size_t blade = 0; blade < parts_.blades.size(); ++blade) {
        const double along = parts_.options.skew == Skew::none ? 0 : sine(blade);
        for (std::size_t i = blade * count; i < (blade + 1) * count; ++i) {
            SectionState& s = scratch_.sections[i];
            s.wake = {mean_.angle, s.annulus.radius / parts_.radius * along, mean_.share.value, inflow_time_};
        }
    }
    if (parts_.lags)
        find_lagging_air();
    else
        find_steady_air();
    for (SectionState& s : scratch_.sections) {
        s.force = s.air.force.normal * s.x - s.air.force.driving * s.y;
        s.moment = s.air.force.moment * s.span;
    }
}

void AirEvaluation::find_lagging_air() {
    scratch_.lagging.resize(scratch_.sections.size());
    for (std::size_t i = 0; i < scratch_.sections.size(); ++i) {
        SectionState& s = scratch_.sections[i];
        scratch_.lagging[i] = lagging_air(scratch_.inductions[i], s.annulus, motion_of(i), states_of(i),
                                          wind_.density(), parts_.lags->sections[i]);
        s.air = scratch_.lagging[i].air;
    }
}

void AirEvaluation::find_steady_air() {
    scratch_.levers.clear();
    for (const SectionState& s : scratch_.sections) scratch_.levers.push_back(s.wake.lever);
    const double angle = parts_.options.skew == Skew::none ? 0 : mean_.angle;
    add_wake(scratch_.inductions, scratch_.inflows, angle, scratch_.levers, mean_.share.value);
    for (std::size_t i = 0; i < scratch_.sections.size(); ++i) {
        SectionState& s = scratch_.sections[i];
        const auto& [annulus, V_x, V_y] = scratch_.inflows[i];
        const Induction& found = scratch_.inductions[i];
        s.air = {V_x, V_y, found, section_force(*annulus, V_x, V_y, found, wind_.density())};
    }
}

}  // namespace cardan::turbines
