#include "turbines/aerodynamics/detail/air_tower.hpp"

#include "mbs/base/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cardan::turbines {

namespace {

constexpr double min_clearance = 0.01;  // of the diameter

// A line that holds the pieces of a tower, and its own length.
struct TowerPieces {
    BeamLine line;
    std::vector<RigidPiece> pieces;
};

TowerPieces rigid_tower(const Model& model, const MachineLayout& layout) {
    const Model::Frame &foot = model.frame(layout.tower_base), &top = model.frame(layout.tower_top);
    TowerPieces out;
    out.line.length = (top.in_body.p - foot.in_body.p).norm();
    const auto along = [axes = foot.in_body](double s) { return axes * Placement::translation({s, 0, 0}); };
    out.pieces.push_back({0, out.line.length, layout.tower_base, foot.body, foot.in_body, along});
    return out;
}

TowerPieces tower_pieces(const Turbine& turbine) {
    const MachineLayout& layout = turbine.layout();
    const Model& model = turbine.system().model;
    if (layout.tower_base == FrameId{}) throw InputError("air on the tower", "tower", "none", "a machine that has one");
    if (!layout.tower) return rigid_tower(model, layout);
    return {layout.tower->line, pieces_of(*layout.tower, model)};
}

double linear(double t, double from, double to) {
    return (1 - t) * from + t * to;
}

// The point of a segment next to a place: distance along it, and how far away.
struct Nearest {
    const InfluenceSegment* segment;
    Vec3 from, axis;  // base axes
    double along, free_along, distance;
};
Nearest nearest(const InfluenceParts& parts, const BodyMotion& motion, const Vec3& place) {
    Nearest best{nullptr, Vec3::Zero(), Vec3::Zero(), 0, 0, std::numeric_limits<double>::infinity()};
    for (const InfluenceSegment& one : parts.segments) {
        const Vec3 from = motion.place(one.body, one.from), axis = motion.rotation(one.body) * one.axis;
        const double free = axis.dot(place - from), along = std::clamp(free, 0.0, one.length),
                     distance = (place - from - along * axis).norm();
        if (distance < best.distance) best = {&one, from, axis, along, free, distance};
    }
    return best;
}

// A column of the table where the foot is, and its slope along the tower.
struct Row {
    std::size_t below;
    double share, width;  // of the way to the next row; m

    double value(const std::vector<double>& column) const { return linear(share, column[below], column[below + 1]); }
    double slope(const std::vector<double>& column) const { return (column[below + 1] - column[below]) / width; }
};

void take_row(const InfluenceParts& parts, double s, InfluenceState& out) {
    const auto next = std::upper_bound(parts.place.begin() + 1, parts.place.end() - 1, s);
    const auto i = static_cast<std::size_t>(next - parts.place.begin() - 1);
    const double width = parts.place[i + 1] - parts.place[i];
    const Row row{i, (s - parts.place[i]) / width, width};
    out.radius = row.value(parts.diameter) / 2;
    out.radius_slope = row.slope(parts.diameter) / 2;
    out.drag = row.value(parts.drag);
    out.drag_slope = row.slope(parts.drag);
    if (parts.turbulence.empty()) return;
    out.turbulence = row.value(parts.turbulence);
    out.turbulence_slope = row.slope(parts.turbulence);
}

// What the flow around the tower and its wake add to the wind.
Vec3 disturbance(const InfluenceParts& parts, const InfluenceState& at) {
    Vec3 flow = tower_influence(parts.influence, at.wind, at.across, at.drag);
    if (parts.shadow != TowerShadow::none)
        flow += tower_shadow(parts.shadow, at.wind, at.across, at.drag, at.turbulence);
    return flow;
}
TowerInfluenceSlopes disturbance_slopes(const InfluenceParts& parts, const InfluenceState& at) {
    TowerInfluenceSlopes out = tower_influence_slopes(parts.influence, at.wind, at.across, at.drag);
    if (parts.shadow != TowerShadow::none)
        out += tower_shadow_slopes(parts.shadow, at.wind, at.across, at.drag, at.turbulence);
    return out;
}

}  // namespace

AirLine air_tower(const Turbine& turbine, const AeroTower& tower) {
    tower.check();
    TowerPieces on = tower_pieces(turbine);
    std::vector<double> places;
    places.reserve(tower.height.size());
    for (std::size_t i = 0; i < tower.height.size(); ++i) {
        constexpr const char* quantity = "height above the tower's foot [m]";
        const std::string row = text("air on the tower, row ", i + 1);
        const double x = tower.height[i] - tower.foot;
        places.push_back(arc_at(on.line, x, row, quantity));
        // Rows that the rounding of an end has brought together.
        if (i > 0 && !(places[i] > places[i - 1]))
            throw InputError(row, quantity, x, text("one row at the end of the tower, ", places[i]));
    }
    std::vector<Vec3> offsets(places.size(), Vec3::Zero());
    return {std::move(on.pieces), std::move(on.line.breaks), std::move(places), std::move(offsets)};
}

InfluenceParts influence_parts(const Turbine& turbine, const AeroTower& tower) {
    const AirLine line = air_tower(turbine, tower);
    InfluenceParts out{tower.influence, tower.shadow, {}, tower.diameter, tower.drag, {}, {}};
    if (tower.shadow == TowerShadow::eames) out.turbulence = tower.turbulence;
    out.place.reserve(tower.height.size());
    for (std::size_t i = 0; i < tower.height.size(); ++i) out.place.push_back(line.place(i));
    out.segments.reserve(line.pieces().size());
    for (const RigidPiece& piece : line.pieces()) {
        const double from = std::max(piece.from, out.place.front()), to = std::min(piece.to, out.place.back());
        if (!(to > from)) continue;
        const Vec3 low = piece.pose(from).p, rise = piece.pose(to).p - low;
        out.segments.push_back({piece.body, low, rise.normalized(), from, rise.norm()});
    }
    return out;
}

InfluenceState influence_at(const InfluenceParts& parts, const BodyMotion& motion, const WindAtTime& wind,
                            const Vec3& place) {
    const Nearest next = nearest(parts, motion, place);
    InfluenceState out{};
    out.body = next.segment->body;
    out.axis = next.axis;
    out.foot = next.from + next.along * next.axis;
    take_row(parts, next.segment->start + next.along, out);
    if (next.distance - out.radius <= 2 * min_clearance * out.radius) return out;
    const double beyond = next.free_along - next.along, z = beyond / out.radius;
    const bool outside = (beyond < 0 && next.segment == &parts.segments.front()) ||
                         (beyond > 0 && next.segment == &parts.segments.back());
    if (outside && std::abs(z) >= 1) return out;
    out.acts = true;
    out.slides = beyond == 0;
    out.stretch = outside ? 1 / std::cos(pi / 2 * z) : 1;
    out.height_slope = outside ? pi / 2 * std::tan(pi / 2 * z) / out.radius : 0;
    out.velocity = motion.velocity(out.body, out.foot);
    out.relative = wind.at(out.foot) - out.velocity;
    out.wind = across(out.relative, out.axis);
    out.across = out.stretch / out.radius * across(place - out.foot, out.axis);
    out.disturbance = disturbance(parts, out);
    return out;
}

// In the segment's axes, with the foot C on the axis t, P the place, r its radius there, f the stretch:
//
//     dX = f/r (I - t t') dP - X (r'/r) dh + X (d ln f/dz) dz,    dh = t . dP where the foot slides, else dz = t . dP,
//     dC = t dh,    d(wind at C) = G t dh,    d(velocity at C) = omega x t dh.
InfluenceSlopes::InfluenceSlopes(const InfluenceParts& parts, const BodyMotion& motion, const WindAtTime& wind,
                                 const InfluenceState& state) {
    if (!state.acts) return;
    const TowerInfluenceSlopes slopes = disturbance_slopes(parts, state);
    const Vec3& t = state.axis;
    const Mat3 plane = Mat3::Identity() - t * t.transpose();
    gradient_ = wind.gradient_at(state.foot);
    by_wind_ = slopes.by_wind * plane;
    by_place_ = state.stretch / state.radius * slopes.by_place * plane;
    Vec3 along = state.height_slope * slopes.by_place * state.across;
    if (state.slides)
        along = -state.radius_slope / state.radius * slopes.by_place * state.across +
                state.drag_slope * slopes.by_drag + state.turbulence_slope * slopes.by_turbulence +
                by_wind_ * (gradient_ * t - cross<double>(motion.angular(state.body), t));
    by_place_ += along * t.transpose();
}

Vec3 InfluenceSlopes::by_q(const InfluenceState& state, const Mover& by, const Vec3& v, bool moves_tower) const {
    if (!state.acts) return Vec3::Zero();
    if (!moves_tower) return by_place_ * v;
    // The place turns with the segment: in its axes only the wind changes.
    const Vec3 change = gradient_ * by.at(state.foot) - by.change_of_velocity(state.foot, state.velocity);
    return cross<double>(by.w, state.disturbance) + by_wind_ * (change - cross<double>(by.w, state.relative));
}

Vec3 InfluenceSlopes::by_qd(const InfluenceState& state, const Mover& by, bool moves_tower) const {
    if (!state.acts || !moves_tower) return Vec3::Zero();
    return -(by_wind_ * by.at(state.foot));
}

}  // namespace cardan::turbines
