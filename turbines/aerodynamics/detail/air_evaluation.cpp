#include "turbines/aerodynamics/detail/air_evaluation.hpp"

#include "mbs/base/entry.hpp"
#include "mbs/kernels/path_twists.hpp"

#include <cmath>

namespace cardan::turbines {

namespace {

Vec3 across(const Vec3& v, const Vec3& axis) {
    return v - v.dot(axis) * axis;
}

}  // namespace

AirEvaluation::AirEvaluation(const AirParts& parts, const ForceInput& at, AirScratch& scratch)
    : parts_(parts), at_(at), kin_(at.kinematics), scratch_(scratch), wind_(parts.wind.at(at.time)) {
    const Mat3 R = kin_.rotation(parts.hub_body);
    shaft_ = R * parts.hub_axis;
    hub_ = kin_.origin(parts.hub_body) + R * parts.hub_place;
    find_rates();
    place_sections();
    find_mean_wind();
    find_loads();
}

std::span<const SectionState> AirEvaluation::sections(std::size_t blade) const {
    const std::size_t count = parts_.profile->sections();
    return std::span(scratch_.sections).subspan(blade * count, count);
}

// Angular velocities and velocities of the joints' origins, from the base out.
void AirEvaluation::find_rates() {
    const Workspace& ws = kin_.workspace();
    const auto n = kin_.model().links().size();
    scratch_.rates.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
        const Model::Link& link = kin_.model().links()[k];
        const Vec3 axis = ws.frame[k].E[2].vector(), turn = at_.qd(static_cast<Eigen::Index>(k)) * axis;
        BodyRate& own = scratch_.rates[k];
        own = {Vec3::Zero(), Vec3::Zero()};
        if (link.parent >= 0) {
            own.angular = entry(scratch_.rates, link.parent).angular;
            own.origin = velocity(link.parent, ws.frame[k].o.vector());
        }
        (link.revolute ? own.angular : own.origin) += turn;
    }
}

Vec3 AirEvaluation::velocity(int body, const Vec3& place) const {
    const BodyRate& rate = entry(scratch_.rates, body);
    return rate.origin + cross<double>(rate.angular, place - entry(kin_.workspace().frame, body).o.vector());
}

double AirEvaluation::power(const Wrench& wrench, int body, const Vec3& place) const {
    return wrench.force.dot(velocity(body, place)) + wrench.moment.dot(entry(scratch_.rates, body).angular);
}

double AirEvaluation::speed() const {
    Vec3 turning = entry(scratch_.rates, parts_.hub_body).angular;
    if (parts_.shaft_body >= 0) turning -= entry(scratch_.rates, parts_.shaft_body).angular;
    return turning.dot(shaft_);
}

void AirEvaluation::place_sections() {
    const std::size_t count = parts_.profile->sections();
    scratch_.sections.resize(parts_.blades.size() * count);
    for (std::size_t i = 0; i < scratch_.sections.size(); ++i) {
        const AirSection& own = parts_.blades[i / count].sections[i % count];
        SectionState& s = scratch_.sections[i];
        const auto& frame = entry(kin_.workspace().frame, own.body);
        const Mat3 R = frame.E.matrix();
        s.place = frame.o.vector() + R * own.place;
        s.span = R * own.span;
        s.y = cross<double>(s.span, shaft_).normalized();
        s.x = cross<double>(s.y, s.span);
        s.velocity = velocity(own.body, s.place);
        s.relative = wind_.at(s.place) - s.velocity;
        s.wind_gradient = wind_.gradient_at(s.place);
        s.radial = across(s.place - hub_, shaft_);
        s.annulus = own.annulus;
        s.annulus.radius = s.radial.norm();
        s.radial /= s.annulus.radius;
        const Vec3 chord = R * own.chord;
        s.annulus.angle = std::atan2(chord.dot(s.x), chord.dot(s.y));
    }
}

// Of the wind at the sections, less the velocity of the hub.
void AirEvaluation::find_mean_wind() {
    Vec3 sum = Vec3::Zero();
    for (const SectionState& s : scratch_.sections) sum += s.relative + s.velocity;
    mean_.velocity = sum / static_cast<double>(scratch_.sections.size()) - velocity(parts_.hub_body, hub_);
    mean_.normal = mean_.velocity.dot(shaft_);
    mean_.speed = mean_.velocity.norm();
    mean_.angle = std::atan2(across(mean_.velocity, shaft_).norm(), mean_.normal);
}

Vec3 AirEvaluation::blade_direction(std::size_t blade) const {
    return across(kin_.rotation(parts_.hub_body) * parts_.blades[blade].axis, shaft_).normalized();
}

double AirEvaluation::sine(std::size_t blade) const {
    return mean_.speed > 0 ? blade_direction(blade).dot(mean_.velocity) / mean_.speed : 0;
}

void AirEvaluation::find_loads() {
    const std::size_t count = parts_.profile->sections();
    for (std::size_t blade = 0; blade < parts_.blades.size(); ++blade) {
        const double along = parts_.options.skew == Skew::none ? 0 : sine(blade);
        for (std::size_t i = blade * count; i < (blade + 1) * count; ++i) {
            SectionState& s = scratch_.sections[i];
            s.wake = {mean_.angle, s.annulus.radius / parts_.radius * along};
            s.air =
                section_air(s.annulus, s.relative.dot(s.x), s.relative.dot(s.y), s.wake, parts_.options, wind_.density);
            s.force = s.air.force.normal * s.x - s.air.force.driving * s.y;
            s.moment = s.air.force.moment * s.span;
        }
    }
}

Wrench AirEvaluation::wrench(std::size_t blade, const AirPoint& point) const {
    const SectionState& s = scratch_.sections[blade * parts_.profile->sections() + point.section];
    return {point.length * s.force, point.length * s.moment};
}

}  // namespace cardan::turbines
