#include "turbines/aerodynamics/machine_air.hpp"

#include "mbs/base/borrowed.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "turbines/aerodynamics/detail/machine_air_parts.hpp"

#include <algorithm>
#include <utility>

namespace cardan::turbines {

namespace {

std::string in_words(const Wind& wind) {
    if (wind.is_steady()) return text("wind ", wind.rows().front().speed, " m/s");
    if (wind.box() != nullptr) return text("turbulent wind, ", wind.mean().speed, " m/s");
    const auto [min, max] = std::ranges::minmax(wind.rows(), {}, &SteadyWind::speed);
    return text("wind of ", min.speed, " to ", max.speed, " m/s over time");
}

void write_wrenches(const AirParts& parts, const AirEvaluation& air, std::span<Wrench> out) {
    std::size_t next = 0;
    for (std::size_t k = 0; k < parts.blades.size(); ++k)
        for (const AirPoint& point : parts.blades[k].points) out[next++] = air.wrench(k, point);
}

}  // namespace

MachineAir::MachineAir(const Turbine& turbine, AeroBlade blade, const Wind& wind, const RotorAirOptions& options,
                       const TowerNacelleAero& support) {
    blade.check();
    const MachineLayout& layout = turbine.layout();
    if (layout.blades.empty()) throw InputError("air on a machine", "number of blades", 0, "at least 1");
    const Model& model = turbine.system().model;
    const auto parts = std::make_shared<Parts>(TowerAir(turbine, support, wind));
    parts->airfoil = std::make_shared<const AeroBlade>(std::move(blade));
    parts->blade_numbers = layout.blade_numbers;
    parts->body_ids.resize(static_cast<std::size_t>(model.size()));
    for (int i = 0; i < model.size(); ++i) entry(parts->body_ids, model.index(BodyId{i})) = BodyId{i};
    parts->wind = wind;
    parts->options = options;
    const Model::Frame& hub = model.frame(layout.hub);
    parts->hub_body = hub.body;
    parts->shaft_body = model.frame(layout.shaft).body;
    parts->hub_place = hub.in_body.p;
    parts->hub_axis = hub.in_body.R.col(2);
    for (std::size_t k = 0; k < layout.blades.size(); ++k) {
        parts->blades.push_back(air_blade(turbine, k, *parts->airfoil));
        const AirBlade& own = parts->blades.back();
        const double coned = std::sqrt(std::max(0.0, 1 - std::pow(own.axis.dot(parts->hub_axis), 2)));
        parts->radius = std::max(parts->radius, parts->airfoil->position.back() * coned);
        parts->bodies.insert(parts->bodies.end(), own.path.begin(), own.path.end());
    }
    if (support.tower.has_influence()) parts->influence = influence_parts(turbine, support.tower);
    parts->trunk = path_to(model, hub.body);
    std::sort(parts->bodies.begin(), parts->bodies.end());
    parts->bodies.erase(std::unique(parts->bodies.begin(), parts->bodies.end()), parts->bodies.end());
    parts_ = parts;
}

MachineAir MachineAir::in(const Wind& wind) const {
    const auto parts = std::make_shared<Parts>(*parts_);
    parts->wind = wind;
    parts->support = parts->support.in(wind);
    return MachineAir(parts);
}

ForceElement MachineAir::element() const {
    ForceElement element{.name = name_of_air, .breaks = parts_->wind.breaks()};
    if (!parts_->wind_input.empty()) element.inputs = {parts_->wind_input};
    for (const AirBlade& blade : parts_->blades)
        for (const AirPoint& point : blade.points) element.points.push_back(point.at);
    if (states() > 0) {
        element.states = states_of(*parts_, parts_->blade_numbers);
        element.groups = groups_of(*parts_, parts_->body_ids);
    }
    element.evaluate = [parts = parts_](const ElementView& at, ElementForces& out) {
        Borrowed<AirScratch> scratch;
        const AirEvaluation air(*parts, at, *scratch);
        write_wrenches(*parts, air, out.wrenches);
        if (out.f.size() > 0) air.rates(out.f);
    };
    element.jacobian = [parts = parts_](const ElementView& at, ElementJacobian& out) {
        Borrowed<AirScratch> scratch;
        AirEvaluation(*parts, at, *scratch).add_derivatives(out);
    };
    element.differences_by_inputs = !element.inputs.empty();
    return element;
}

Turbine MachineAir::on(const Turbine& turbine) const {
    ForceSet forces = turbine.forces();
    if (!parts_->wind_input.empty()) forces.add_input({.name = parts_->wind_input, .unit = "m/s", .scale = 1});
    forces.add_element(element());
    if (!parts_->support.is_empty()) forces.add_element(parts_->support.element());
    return turbine.with_forces(forces, text("in the air, ", in_words(parts_->wind)));
}

std::vector<std::vector<SectionAir>> MachineAir::sections(const ElementView& at) const {
    Borrowed<AirScratch> scratch;
    const AirEvaluation air(*parts_, at, *scratch);
    std::vector<std::vector<SectionAir>> out(parts_->blades.size());
    for (std::size_t k = 0; k < out.size(); ++k)
        for (const SectionState& s : air.sections(k)) out[k].push_back(s.air);
    return out;
}

MachineAir::Rotor MachineAir::rotor(const ElementView& at) const {
    Borrowed<AirScratch> scratch;
    const AirEvaluation air(*parts_, at, *scratch);
    Wrench sum;
    double work_rate = 0;
    for (std::size_t k = 0; k < parts_->blades.size(); ++k)
        for (const AirPoint& point : parts_->blades[k].points) {
            const Wrench wrench = air.wrench(k, point);
            const Vec3 place = place_of(at.system.kinematics, point.at);
            add_moved(sum, wrench, place, air.hub());
            work_rate += air.power(wrench, point.body, place);
        }
    // Axes of the shaft that do not turn: y is level.
    const Vec3 &x = air.shaft(), y = cross<double>(Vec3(Vec3::UnitZ()), x).normalized();
    const Mat3 axes = (Mat3() << x, y, cross<double>(x, y)).finished();
    return {axes.transpose() * sum.force, axes.transpose() * sum.moment, air.speed(), work_rate, air.hub()};
}

ChannelGroup MachineAir::channels() const {
    const char* const axes = "shaft, not turning";
    ChannelGroup group;
    group.channels = {{.name = "wind speed",
                       .units = "m/s",
                       .long_name = "horizontal, at the rotor's centre, undisturbed",
                       .frame = "ground",
                       .alias = "HorWindV"},
                      {.name = "aerodynamic thrust",
                       .units = "N",
                       .long_name = "force of the air on the blades along the shaft, downwind",
                       .frame = axes,
                       .alias = "RtAeroFxh"},
                      {.name = "aerodynamic torque",
                       .units = "N m",
                       .long_name = "moment of the air on the blades about the shaft, driving",
                       .frame = axes,
                       .alias = "RtAeroMxh"},
                      {.name = "aerodynamic power",
                       .units = "W",
                       .long_name = "this moment times the rotor's speed",
                       .frame = axes,
                       .alias = "RtAeroPwr"},
                      {.name = "work rate of the air",
                       .units = "W",
                       .long_name = "on blades, tower and nacelle, all their motion",
                       .frame = "ground"}};
    group.sample = [air = *this](const DynamicView& in, double* values) {
        const ElementValues own = air.values(in, in.forces);
        const ElementView& at = own.view();
        const Rotor now = air.rotor(at);
        values[0] = air.wind().at(in.time).at(now.centre).head<2>().norm();
        values[1] = now.force.x();
        values[2] = now.moment.x();
        values[3] = now.power();
        values[4] = now.work_rate + air.support().work_rate(in);
    };
    return group;
}

Vec3 place_at_rest(const Turbine& turbine, FrameId frame) {
    const Model& model = turbine.system().model;
    Workspace workspace(model);
    const Vector q = Vector::Zero(model.size());
    return pose(kinematics(model, q, workspace), frame).p;
}

Vec3 hub_at_rest(const Turbine& turbine) {
    if (turbine.layout().hub == FrameId{}) throw InputError("air on a machine", "rotor", "none", "one");
    return place_at_rest(turbine, turbine.layout().hub);
}

double MachineAir::radius() const {
    return parts_->radius;
}
const AeroBlade& MachineAir::blade() const {
    return *parts_->airfoil;
}
const Wind& MachineAir::wind() const {
    return parts_->wind;
}
const TowerAir& MachineAir::support() const {
    return parts_->support;
}
bool MachineAir::has_induction() const {
    return parts_->options.induction;
}
bool MachineAir::has_tower_influence() const {
    return parts_->influence.has_value();
}
int MachineAir::min_azimuths() const {
    return has_tower_influence() ? 144 : 1;
}

}  // namespace cardan::turbines
