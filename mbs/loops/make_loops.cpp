// What loops are made of: equations from joints, rods, surfaces, couplings, functions and locks.
#include "mbs/base/error.hpp"
#include "mbs/loops/loops.hpp"

#include <array>
#include <utility>

namespace cardan {

namespace {

constexpr const char* in_making_loops = "loops";
constexpr std::array<char, 3> axis_names = {'x', 'y', 'z'};

const char* name_of(CutKind kind) {
    switch (kind) {
        case CutKind::revolute:
            return "revolute";
        case CutKind::prismatic:
            return "prismatic";
        case CutKind::cylindrical:
            return "cylindrical";
        case CutKind::cardan:
            return "cardan";
        case CutKind::spherical:
            return "spherical";
        case CutKind::planar:
            return "planar";
        case CutKind::weld:
            break;
    }
    return "weld";
}

}  // namespace

using Kind = RelativeMeasure::Kind;

Loops::Loops(const LoopSet& set, const Model& model) : model_(model.serial()), coordinates_(model.size()) {
    involved_.assign(static_cast<std::size_t>(model.size()), false);
    for (const CutJoint& joint : set.joints()) {
        const bool aligned = joint.kind != CutKind::spherical && joint.kind != CutKind::cardan;
        const bool fixed = joint.kind == CutKind::weld || joint.kind == CutKind::prismatic;
        std::vector<RelativeMeasure> equations;
        if (joint.kind != CutKind::planar) equations = {{Kind::along, 0}, {Kind::along, 1}};
        if (joint.kind != CutKind::prismatic && joint.kind != CutKind::cylindrical)
            equations.push_back({Kind::along, 2});
        if (aligned) equations.insert(equations.end(), {{Kind::square, 0, 2}, {Kind::square, 1, 2}});
        if (fixed) equations.push_back({Kind::square, 0, 1});
        if (joint.kind == CutKind::cardan) equations.push_back({Kind::square, 0, 1});
        add_loop(joint.name, model, {joint.a, joint.b, -1, -1, 0, -1, aligned, fixed, {}, equations, size()});
        places_.back() = text(name_of(joint.kind), " joint ", places_.back());
    }
    for (const FixedDistance& rod : set.distances()) {
        add_loop(rod.name, model, {rod.a, rod.b, -1, -1, rod.length, -1, false, false, {}, {{Kind::distance}}, size()});
        places_.back() = text("rod ", places_.back());
    }
    for (const PointOnSurface& contact : set.surfaces()) {
        const int index = static_cast<int>(surfaces_.size());
        surfaces_.push_back(contact);
        add_loop(contact.name, model,
                 {contact.surface, contact.point, -1, -1, 0, index, false, false, {}, {{}}, size()});
        places_.back() = text("surface ", places_.back());
    }
    for (const Coupling& coupling : set.couplings()) {
        Linear linear{{}, coupling.offset, size()};
        std::string place = "coupling of";
        for (const auto& [body, factor] : coupling.factors) {
            const int at = model.index(body);
            linear.factors.emplace_back(at, factor);
            place += text(" '", model.coordinates()[at].name, "'");
        }
        couplings_.push_back(std::move(linear));
        add_single(coupling.name, coupling.unit, std::move(place));
    }
    for (const UserConstraint& user : set.users()) {
        users_.push_back({user, size()});
        involved_.assign(involved_.size(), true);
        add_single(user.name, user.unit, "constraint of one's own");
    }
    for (const Lock& lock : set.locks()) {
        const int at = model.index(lock.coordinate);
        locks_.push_back({lock.state, at, size()});
        add_single(lock.name, model.coordinates()[at].unit, text("lock of '", model.coordinates()[at].name, "'"));
    }
}

void Loops::add_single(const std::string& name, const std::string& unit, std::string place) {
    names_.push_back(name);
    places_.push_back(std::move(place));
    equations_.push_back({name, unit, static_cast<int>(names_.size()) - 1});
    first_.push_back(size());
}

void Loops::add_loop(const std::string& name, const Model& model, Loop loop) {
    loop.body_a = model.frame(loop.a).body;
    loop.body_b = model.frame(loop.b).body;
    const auto body_name = [&](int body) { return body < 0 ? std::string("base") : model.body(body).name; };
    const std::string bodies = text("between '", body_name(loop.body_a), "' and '", body_name(loop.body_b), "'");
    path_between(model, loop.body_a, loop.body_b, loop.path);
    if (loop.path.empty())
        throw InputError(text("loop '", name, "' ", bodies), "number of coordinates that move it", 0,
                         ">= 1: frames of two bodies");
    for (const PathStep& step : loop.path) involved_[static_cast<std::size_t>(step.coordinate)] = true;
    for (const RelativeMeasure& equation : loop.equations) {
        const char i = entry(axis_names, equation.i), j = entry(axis_names, equation.j);
        if (loop.surface >= 0)
            add_equation(text(name, ": on the surface"), "m");
        else if (equation.kind == Kind::along)
            add_equation(text(name, ": ", i, " together"), "m");
        else if (equation.kind == Kind::square)
            add_equation(text(name, ": ", i, " square to ", j), "1");
        else
            add_equation(text(name, ": length"), "m");
    }
    names_.push_back(name);
    places_.push_back(bodies);
    loops_.push_back(std::move(loop));
    first_.push_back(size());
}

void Loops::add_equation(const std::string& name, std::string unit) {
    equations_.push_back({name, std::move(unit), static_cast<int>(names_.size())});
}

const std::string& Loops::name(int loop) const {
    require_index(in_making_loops, "loop", loop, std::ssize(names_));
    return entry(names_, loop);
}

std::string Loops::describe(int loop) const {
    return text("'", name(loop), "' (", entry(places_, loop), ")");
}

}  // namespace cardan
