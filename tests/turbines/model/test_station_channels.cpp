// Channels at stations of blades and tower: against the ends of the beams, statics and rotation by hand.
#include "elements/cardan_beam/beam_station.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/sampled_channels.hpp"
#include "turbines/model/station_channels.hpp"
#include "turbines/reference_turbines/wt600_operation.hpp"

#include <set>

namespace cardan::testing::station_channels_tests {

using namespace turbines;

namespace {

constexpr double g = units::standard_gravity, tilt = 5 * units::degree, hub_radius = 1.5, blade_length = 20;

// In all four segments of all three elements, nodes and ends.
const std::vector<double> places{0, 1.2, 2.5, 4.7, 20. / 3, 9, 11.5, 17, 20};

AssemblyOptions heavy() {
    AssemblyOptions options = wt600_paper_assembly();
    options.gravity = {0, 0, -g};
    return options;
}

double& at(const Turbine& turbine, Vector& v, const std::string& coordinate) {
    return v(turbine.system().model.index(coordinate));
}

std::vector<ChannelGroup> both(const Turbine& turbine, const Stations& stations) {
    std::vector<ChannelGroup> groups = channels(turbine);
    for (ChannelGroup& group : turbines::station_channels(turbine, stations)) groups.push_back(std::move(group));
    return groups;
}

Sampled sampled(const Turbine& turbine, const Stations& stations, const MachineState& state) {
    return {turbine.system(), both(turbine, stations), state};
}

// x, y of a blade's axes in those of the section, which its twist turns: leading edge upwind, that is about minus z.
Vec3 turned(const Turbine& turbine, double place, const Vec3& v) {
    const double twist = -turbine.layout().blades[0].line.section(place).beta;
    const double c = std::cos(twist), s = std::sin(twist);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

std::string gauge(std::size_t i, const char* kind) {
    return text("Spn", i + 1, kind);
}

}  // namespace

TEST_CASE("stations: those at the ends of blade and tower are what the channels of root, tip, foot and top are",
          "[crosscheck]") {
    const Turbine turbine = wt600(heavy());
    const double height = turbine.layout().tower->line.length;
    for (unsigned seed : {1u, 2u}) {
        const MachineState state = in_motion(turbine, seed);
        const Sampled now = sampled(turbine, {.blades = {blade_length, 0}, .tower = {0, height}}, state);
        for (const std::string b : {"b1", "b2", "b3"}) {
            const Vec3 force = now.vector("RootF", b), moment = now.vector("RootM", b);
            CHECK((now.vector("Spn2FL", b) - turned(turbine, 0, force)).norm() < 1e-9 * force.norm());
            CHECK((now.vector("Spn2ML", b) - turned(turbine, 0, moment)).norm() < 1e-9 * moment.norm());
            CHECK(now.vector("Spn2TD", b).norm() < 1e-12);
            CHECK(now.vector("Spn2RD", b).norm() < 1e-12);
            const std::string k = b.substr(1);
            for (const char* axis : {"x", "y", "z"})
                CHECK(now[text("Spn1TD", axis, b)] == Approx(now[text("TipD", axis, b)]).margin(1e-12));
            CHECK(now.vector("Spn1FL", b).norm() < 1e-9 * force.norm());  // nothing is beyond the tip
            CHECK(now.vector("Spn1ML", b).norm() < 1e-9 * moment.norm());
        }
        const Vec3 foot = now.vector("TwrBsM", "t"), top = now.vector("YawBrM", "p");
        CHECK((now.vector("TwHt1FL", "t") - now.vector("TwrBsF", "t")).norm() < 1e-6);
        CHECK((now.vector("TwHt1ML", "t") - foot).norm() < 1e-9 * foot.norm());
        CHECK((now.vector("TwHt2FL", "t") - now.vector("YawBrF", "p")).norm() < 1e-6);
        CHECK((now.vector("TwHt2ML", "t") - top).norm() < 1e-9 * foot.norm());
        CHECK(now.vector("TwHt1TD", "t").norm() < 1e-12);
        CHECK(now.vector("TwHt1AL", "t").norm() == 0);
        CHECK(now["TwHt2TDxt"] == Approx(now["TTDspFA"]).margin(1e-12));
        CHECK(now["TwHt2TDyt"] == Approx(now["TTDspSS"]).margin(1e-12));
        CHECK(now["TwHt2ALxt"] == Approx(now["YawBrTAxp"]).epsilon(1e-10));
        CHECK(now["TwHt2ALyt"] == Approx(now["YawBrTAyp"]).epsilon(1e-10));
    }
}

TEST_CASE("stations: a parked blade carries at each the weight and first moment of what is beyond it", "[analytic]") {
    const Turbine turbine = wt600(heavy());
    const BeamLine& line = turbine.layout().blades[0].line;
    for (double azimuth : {0.0, pi / 2, 2.5})
        for (double pitch : {0.0, 0.4}) {
            MachineState state(turbine);
            at(turbine, state.q, "generator azimuth") = azimuth;
            at(turbine, state.q, "blade 1 pitch") = -pitch;
            const Sampled now = sampled(turbine, {.blades = places}, state);
            const Vec3 weight = blade_axes(tilt, azimuth, pitch).transpose() * Vec3(0, 0, -g);
            for (std::size_t i = 0; i < places.size(); ++i) {
                const BladeMoments beyond(line, places[i]);
                const Vec3 force = turned(turbine, places[i], beyond.mass * weight),
                           moment = turned(turbine, places[i], beyond.first.cross(weight));
                CAPTURE(azimuth, pitch, places[i]);
                CHECK((now.vector(gauge(i, "FL"), "b1") - force).norm() < 1e-6 * 1970 * g);
                CHECK((now.vector(gauge(i, "ML"), "b1") - moment).norm() < 1e-6 * 1970 * g * blade_length);
                CHECK(now.vector(gauge(i, "AL"), "b1").norm() == 0);
                CHECK((now.vector(gauge(i, "ALg"), "b1") + turned(turbine, places[i], weight)).norm() < 1e-12);
            }
        }
    // In words: up and unpitched, an accelerometer shows g toward the tip.
    const Sampled upright = sampled(turbine, {.blades = {10}, .tower = {25}}, MachineState(turbine));
    CHECK(upright["Spn1ALgzb1"] == Approx(g * std::cos(tilt)));
    CHECK(upright["TwHt1ALgzt"] == Approx(g));
    CHECK(upright["Spn1FLzb1"] < 0);  // pressed down
}

TEST_CASE("stations: the tower carries at each the weight of what is above it", "[analytic]") {
    const Turbine turbine = wt600(heavy());
    const BeamLine& line = turbine.layout().tower->line;
    const Sampled now = sampled(turbine, {.tower = {0, 10, 20, 31.7, 44, line.length}}, MachineState(turbine));
    for (int i = 1; i <= 6; ++i) {
        const double height = std::array{0.0, 10.0, 20.0, 31.7, 44.0, line.length}.at(static_cast<std::size_t>(i - 1));
        const double above = 26000 + 7500 + 3 * 1970.0, weight = (above + BladeMoments(line, height).mass) * g;
        CAPTURE(height);
        CHECK(now[text("TwHt", i, "FLzt")] == Approx(-weight).epsilon(1e-4));
        CHECK(std::abs(now[text("TwHt", i, "FLxt")]) < 1e-6);
        // What hangs over the axis does so at every height.
        CHECK(now[text("TwHt", i, "MLyt")] == Approx(now["YawBrMyp"]).epsilon(1e-9));
    }
}

TEST_CASE("stations: a force at the tip bends each with its lever, about the axes of its twist", "[analytic]") {
    const Turbine bare = wt600(wt600_paper_assembly());
    const Vec3 F(1000, -300, 50);  // blade axes: downwind, toward the trailing edge, to the tip
    ForceSet forces = bare.forces();
    forces.add_wrench(
        {"tip", bare.layout().blades[0].tip(), {Vec3(F.z(), -F.y(), F.x()), Vec3::Zero()}, WrenchAxes::frame});
    const Turbine turbine = bare.with_forces(forces);
    const Sampled now = sampled(turbine, {.blades = places, .tower = {20}}, MachineState(turbine));
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Vec3 moment = Vec3(0, 0, blade_length - places[i]).cross(F);
        CAPTURE(places[i]);
        CHECK((now.vector(gauge(i, "FL"), "b1") - turned(turbine, places[i], F)).norm() < 1e-9 * F.norm());
        CHECK((now.vector(gauge(i, "ML"), "b1") - turned(turbine, places[i], moment)).norm() < 1e-6);
        CHECK(now.vector(gauge(i, "ML"), "b2").norm() < 1e-6);
    }
    CHECK(std::abs(now["Spn1MLyb1"]) > 1e4);
    CHECK(now["TwHt1FLxt"] > 0.9 * F.x());
}

TEST_CASE("stations: a rotating blade pulls with the centrifugal force of what is beyond, and is accelerated inward",
          "[analytic]") {
    const Turbine turbine = wt600(wt600_paper_assembly());
    const double Omega = 2.8;
    MachineState state(turbine);
    at(turbine, state.q, "generator azimuth") = 1;
    state.qd(turbine.rotor().spin) = Omega;
    const Sampled now = sampled(turbine, {.blades = places, .tower = {30}}, state);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double radius = hub_radius + places[i];
        const BladeMoments beyond(turbine.layout().blades[0].line, places[i]);
        const double pull = Omega * Omega * (beyond.first.z() + beyond.mass * radius);
        CAPTURE(places[i]);
        for (const char* b : {"b1", "b3"}) {
            CHECK(now.vector(gauge(i, "FL"), b).z() == Approx(pull).epsilon(1e-6).margin(1e-3));
            const Vec3 inward = Omega * Omega * radius * -Vec3::UnitZ();
            CHECK((now.vector(gauge(i, "AL"), b) - inward).norm() < 1e-12 * inward.norm());
            CHECK(now.vector(gauge(i, "ALg"), b) == now.vector(gauge(i, "AL"), b));  // without gravity
        }
    }
    CHECK(now.vector("TwHt1AL", "t").norm() == 0);
    CHECK(now.vector("TwHt1FL", "t").norm() < 1e-6);  // three blades are in balance
}

TEST_CASE("stations: an angular acceleration adds its tangential part", "[analytic]") {
    const Turbine turbine = wt600(wt600_paper_assembly());
    MachineState state(turbine);
    state.qdd(turbine.rotor().spin) = 0.4;
    const Sampled now = sampled(turbine, {.blades = {12}}, state);
    // Positive spin takes a blade toward its leading edge, against y.
    const Vec3 expected = turned(turbine, 12, Vec3(0, -0.4 * (hub_radius + 12), 0));
    CHECK((now.vector("Spn1AL", "b2") - expected).norm() < 1e-12);
}

TEST_CASE("stations: a hinge moves and turns what is beyond it and nothing before; turning the blade does neither",
          "[analytic]") {
    const Turbine turbine = wt600(wt600_paper_assembly());
    MachineState state(turbine);
    for (const char* name : {"generator azimuth", "main shaft twist", "yaw", "tilt", "blade 1 pitch", "yaw bearing x",
                             "tower element 2 bending y1"})
        at(turbine, state.q, name) = 0.3;
    const double element = blade_length / 3, hinge = delta_gauss * element;
    const Stations stations{.blades = {0.9 * hinge, 1.1 * hinge, 10, 20}};
    const Sampled whole = sampled(turbine, stations, state);
    for (std::size_t i = 0; i < 4; ++i)
        for (const char* kind : {"TD", "RD"}) CHECK(whole.vector(gauge(i, kind), "b1").norm() < 1e-12);
    at(turbine, state.q, "blade 1 element 1 bending y1") = 0.05;  // about the leading edge's axis: tip upwind
    const Sampled bent = sampled(turbine, stations, state);
    CHECK(bent.vector("Spn1TD", "b1").norm() < 1e-12);
    CHECK(bent.vector("Spn1RD", "b1").norm() < 1e-12);
    for (std::size_t i = 1; i < 4; ++i) {
        const double arm = stations.blades[i] - hinge;
        const Vec3 d(-arm * std::sin(0.05), 0, arm * (std::cos(0.05) - 1));
        CHECK((bent.vector(gauge(i, "TD"), "b1") - d).norm() < 1e-12);
        CHECK((bent.vector(gauge(i, "RD"), "b1") - Vec3(0, -0.05, 0)).norm() < 1e-12);
    }
    at(turbine, state.q, "blade 1 element 1 bending y1") = 0;
    at(turbine, state.q, "blade 1 element 2 bending z1") = 0.04;  // toward the leading edge
    const Sampled edge = sampled(turbine, stations, state);
    CHECK(edge.vector("Spn2TD", "b1").norm() < 1e-12);
    CHECK(edge["Spn4TDyb1"] == Approx(-(20 - element - hinge) * std::sin(0.04)).epsilon(1e-12));
    CHECK((edge.vector("Spn4RD", "b1") - Vec3(0.04, 0, 0)).norm() < 1e-12);
    CHECK(edge.vector("Spn4TD", "b2").norm() < 1e-12);
}

TEST_CASE("stations: torsion turns about z, the leading edge downwind where it is positive", "[analytic]") {
    TurbineDescription d = wt600_description();
    EngineeringSection section;
    section.mass = 100, section.GJ = 1e7, section.EI_flap = section.EI_edge = 1e8, section.j_flap = section.j_edge = 10;
    d.blade.line = uniform_beam(blade_length, section);
    const Turbine turbine = assemble(d, wt600_paper_assembly());
    MachineState state(turbine);
    at(turbine, state.q, "blade 1 element 2 torsion") = 0.1;
    const Sampled now = sampled(turbine, {.blades = {9, 11, 20}}, state);
    CHECK(now.vector("Spn1RD", "b1").norm() < 1e-12);
    for (const char* station : {"Spn2", "Spn3"}) {
        CHECK((now.vector(text(station, "RD"), "b1") - Vec3(0, 0, 0.1)).norm() < 1e-12);
        CHECK(now.vector(text(station, "TD"), "b1").norm() < 1e-12);
    }
}

TEST_CASE("stations: accelerations are the second derivatives of positions in motion", "[property]") {
    const Turbine turbine = wt600(heavy());
    const MachineState state = in_motion(turbine, 7);
    const Model& model = turbine.system().model;
    Workspace workspace(model);
    const BeamStation blade(turbine.layout().blades[1], 13.7), tower(*turbine.layout().tower, 21.2);
    const Sampled now = sampled(turbine, {.blades = {13.7}, .tower = {21.2}}, state);
    const auto there = [&](const BeamStation& station, double t) {
        const Vector q = state.q + t * state.qd + t * t / 2 * state.qdd;
        return station.pose(kinematics(model, q, workspace));
    };
    constexpr double h = 2e-4;
    for (const bool up : {false, true}) {
        const BeamStation& s = up ? tower : blade;
        const Vec3 a =
            (-there(s, 2 * h).p + 16 * there(s, h).p - 30 * there(s, 0).p + 16 * there(s, -h).p - there(s, -2 * h).p) /
            (12 * h * h);
        const Mat3 R = there(s, 0).R;
        const Vec3 in_tower(R.col(1).dot(a), R.col(2).dot(a), R.col(0).dot(a)),
            in_blade = turned(turbine, 13.7, {R.col(2).dot(a), -R.col(1).dot(a), R.col(0).dot(a)});
        const Vec3 found = up ? now.vector("TwHt1AL", "t") : now.vector("Spn1AL", "b2");
        CHECK((found - (up ? in_tower : in_blade)).norm() < 1e-5 * a.norm());
    }
}

TEST_CASE("stations: an element counts inboard of the point where it acts, as a wrench of the force set does",
          "[property]") {
    const Turbine bare = wt600(heavy());
    const CardanBeam& blade = bare.layout().blades[0];
    const MachineState state = in_motion(bare, 3);
    const Wrench load{Vec3(300, -500, 200), Vec3(1000, 200, -700)};
    // A node, three of the rigid segments, hub, pitch bearing, nacelle.
    std::vector<FrameId> frames{blade.nodes[1], bare.layout().hub, bare.layout().blade_roots[0],
                                bare.tree().frame("nacelle")};
    for (std::size_t i : {0u, 1u, 3u}) frames.push_back(blade.elements[1].segments[i].carrier);
    for (const FrameId frame : frames) {
        ForceSet forces = bare.forces();
        forces.add_wrench({"load", frame, load, WrenchAxes::base});
        ForceSet elements = bare.forces();
        elements.add_element({.name = "load",
                              .points = {{frame}},
                              .evaluate = [&](const ElementView&, ElementForces& out) { out.wrenches[0] = load; }});
        const Stations stations{.blades = places, .tower = {0, 15, 34}};
        const Sampled known = sampled(bare.with_forces(forces), stations, state),
                      given = sampled(bare.with_forces(elements), stations, state),
                      without = sampled(bare, stations, state);
        CAPTURE(bare.tree().frames()[static_cast<std::size_t>(frame.index)].name);
        CHECK(std::abs(known["TwHt1MLxt"] - without["TwHt1MLxt"]) > 1e3);
        for (const auto& [name, value] : known.values) {
            if (name.find(" m force") == name.npos && name.find(" m moment") == name.npos) continue;
            CAPTURE(name);
            CHECK(given[name] == Approx(value).epsilon(1e-9).margin(1e-4));
        }
    }
}

TEST_CASE("stations: sampling allocates nothing", "[property]") {
    const Turbine turbine = wt600(heavy());
    const MachineState state = in_motion(turbine, 2);
    const System& system = turbine.system();
    Workspace workspace(system.model);
    const DynamicView input(state, kinematics(system.model, state.q, workspace), system.forces, system.loops);
    input.loads();
    for (const ChannelGroup& group : turbines::station_channels(turbine, {.blades = places, .tower = {3, 30}})) {
        std::vector<double> values(group.channels.size());
        CHECK(allocations([&] { group.sample(input, values.data()); }) == 0);
    }
}

TEST_CASE("stations: names are unique, aliases OpenFAST's, frames given; none for a fourth blade", "[property]") {
    TurbineDescription d = wt600_description();
    d.blades = 4;
    const Turbine turbine = assemble(d, wt600_paper_assembly());
    std::set<std::string> names, aliases;
    for (const ChannelGroup& group : both(turbine, {.blades = {15, 2.25}, .tower = {40}}))
        for (const Channel& channel : group.channels) {
            CHECK(names.insert(channel.name).second);
            if (!channel.alias.empty()) CHECK(aliases.insert(channel.alias).second);
            CHECK_FALSE(channel.frame.empty());
            CHECK_FALSE(channel.long_name.empty());
        }
    for (const char* name : {"blade 1 at 15 m moment y", "blade 4 at 2.25 m force z", "tower at 40 m deflection x",
                             "blade 2 at 15 m rotation z", "blade 3 at 15 m accelerometer x"})
        CHECK(names.contains(name));
    for (const char* alias : {"Spn1FLxb1", "Spn2MLyb3", "Spn1TDzb2", "Spn2RDxb1", "Spn1ALyb1", "Spn1ALgyb1",
                              "TwHt1FLxt", "TwHt1MLyt", "TwHt1TDxt", "TwHt1RDyt", "TwHt1ALzt", "TwHt1ALgzt"})
        CHECK(aliases.contains(alias));
    CHECK_FALSE(aliases.contains("Spn1FLxb4"));
    CHECK(turbines::station_channels(turbine, {}).empty());
}

TEST_CASE("stations: those that a machine does not have are refused", "[property]") {
    const Turbine turbine = wt600(wt600_paper_assembly());
    const auto refused = [&](const Turbine& machine, const Stations& stations, std::initializer_list<std::string> say) {
        check_refused([&] { (void)turbines::station_channels(machine, stations); }, say);
    };
    refused(turbine, {.blades = {5, -0.1}}, {"stations of blade 1", "place of station 2 [m] = -0.1", "0 ... 20"});
    refused(turbine, {.blades = {20.001}}, {"stations of blade 1", "20.001"});
    refused(turbine, {.blades = {not_a_number}}, {"station 1", "nan"});
    refused(turbine, {.tower = {infinite}}, {"stations of tower", "inf"});
    refused(turbine, {.tower = {51}}, {"stations of tower", "51", "0 ... 50.7"});
    refused(turbine, {.blades = {3, 7, 3}}, {"blade 1", "stations 1 and 3", "3", "each place once"});
    refused(turbine, {.tower = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}}, {"stations of tower", "number = 10", "at most 9"});
    refused(isolated_blade(wt600_description(), wt600_paper_assembly()), {.tower = {1}},
            {"stations of tower", "no tower"});
    refused(isolated_tower(wt600_description(), wt600_paper_assembly()), {.blades = {1}},
            {"stations of blades", "no blades"});
    TurbineDescription rigid = wt600_description();
    rigid.tower.rigid = true;
    refused(assemble(rigid, wt600_paper_assembly()), {.tower = {1}}, {"stations of tower", "rigid"});
    TurbineDescription unequal = wt600_description();
    unequal.individual_blades[2] = unequal.blade;
    unequal.individual_blades[2]->line =
        uniform_beam(15, {.mass = 100, .GJ = 1e7, .EI_flap = 1e8, .EI_edge = 1e8, .j_flap = 1, .j_edge = 1});
    refused(assemble(unequal, wt600_paper_assembly()), {.blades = {17}}, {"stations of blade 2", "17", "0 ... 15"});
}

}  // namespace cardan::testing::station_channels_tests
