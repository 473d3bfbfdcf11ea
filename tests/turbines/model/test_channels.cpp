// Channels of a turbine: loads against weights, first moments and springs by hand, deflections, names.
#include "mbs/base/units.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/sampled_channels.hpp"
#include "turbines/reference_turbines/wt600_operation.hpp"

#include <set>

namespace cardan::testing::machine_channels_tests {

using namespace turbines;

namespace {

constexpr double g = units::standard_gravity, tilt = 5 * units::degree;

AssemblyOptions heavy() {
    AssemblyOptions options = wt600_paper_assembly();
    options.gravity = {0, 0, -g};
    return options;
}

double& at(const Turbine& turbine, Vector& v, const char* coordinate) {
    return v(turbine.system().model.index(coordinate));
}

// Sum of r x (m g) over everything that is not on the base's side of a height, by the inertias as they were given.
struct Weight {
    double mass = 0;
    Vec3 moment = Vec3::Zero();

    Weight(const Turbine& turbine, const std::set<std::string>& left_out) {
        const Model& model = turbine.system().model;
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
        for (const Tree::Piece& piece : turbine.tree().pieces()) {
            if (left_out.contains(piece.part)) continue;
            const FrameId frame = piece.body < 0 ? Tree::base() : turbine.tree().frame_of(BodyId{piece.body});
            const Pose<double> own = pose(kin, frame);
            mass += piece.inertia.mass;
            moment += (own.R * piece.inertia.com + own.p).cross(Vec3(0, 0, -g * piece.inertia.mass));
        }
    }
};

}  // namespace

TEST_CASE(
    "channels: at standstill the tower's foot carries the weight of the machine, its top that of nacelle and rotor",
    "[analytic]") {
    TurbineDescription elastic = wt600_description(), rigid = elastic;
    rigid.tower.rigid = true;
    TurbineDescription stiff = rigid;
    stiff.yaw = {rigid_joint, rigid_joint};
    stiff.nacelle.tilt_bearing = rigid_joint;
    for (const TurbineDescription& d : {elastic, rigid, stiff}) {
        const Turbine turbine = assemble(d, heavy());
        const Sampled now(turbine, MachineState(turbine));
        const Weight all(turbine, {}), above(turbine, {"tower"});
        CHECK(above.mass == Approx(26000 + 7500 + 3 * 1970.0).epsilon(1e-4));
        CHECK((now.vector("TwrBsF", "t") - Vec3(0, 0, -all.mass * g)).norm() < 1e-9 * all.mass * g);
        CHECK((now.vector("TwrBsM", "t") - all.moment).norm() < 1e-9 * all.mass * g);
        CHECK((now.vector("YawBrF", "p") - Vec3(0, 0, -above.mass * g)).norm() < 1e-9 * all.mass * g);
        // All of it hangs over the tower axis, so the height of the cut makes no difference to the moment.
        CHECK((now.vector("YawBrM", "p") - above.moment).norm() < 1e-9 * all.mass * g);
        CHECK(now["YawBrMyp"] < 0);  // the rotor's weight pulls the upwind side down
        CHECK(now["TTDspFA"] == 0);
        CHECK(now["YawBrTAxp"] == 0);
    }
}

TEST_CASE("channels: a parked blade carries its weight and the moment of its first moment, at every azimuth and pitch",
          "[analytic]") {
    const Turbine turbine = wt600(heavy());
    const BladeMoments blade(turbine.layout().blades[0].line);
    CHECK(blade.mass == Approx(1970.0).epsilon(1e-4));
    for (double azimuth : {0.0, pi / 2, 2.5, 4.0})
        for (double pitch : {0.0, 0.4, pi / 2}) {
            MachineState state(turbine);
            at(turbine, state.q, "generator azimuth") = azimuth;
            at(turbine, state.q, "blade 1 pitch") = -pitch;
            const Sampled now(turbine, state);
            const Mat3 b = blade_axes(tilt, azimuth, pitch), c = blade_axes(tilt, azimuth, 0);
            const Vec3 weight = b.transpose() * Vec3(0, 0, -g);
            CAPTURE(azimuth, pitch);
            CHECK((now.vector("RootF", "b1") - blade.mass * weight).norm() < 1e-7 * blade.mass * g);
            CHECK((now.vector("RootM", "b1") - blade.first.cross(weight)).norm() < 1e-7 * blade.first.norm() * g);
            const Vec3 coned = c.transpose() * b * blade.first.cross(weight);
            CHECK(now["RootMxc1"] == Approx(coned.x()).margin(1e-7 * blade.first.norm() * g));
            CHECK(now["RootMyc1"] == Approx(coned.y()).margin(1e-7 * blade.first.norm() * g));
            CHECK(now["RootFxc1"] == Approx(blade.mass * c.col(0).z() * -g).margin(1e-3));
            CHECK(now["RootFyc1"] == Approx(blade.mass * c.col(1).z() * -g).margin(1e-3));
            CHECK(now["BldPitch1"] == Approx(pitch));
            CHECK(now["Azimuth"] == Approx(azimuth).margin(1e-12));
        }
    // In words: horizontal and going down, the weight acts toward the leading edge, against y.
    MachineState horizontal(turbine);
    at(turbine, horizontal.q, "generator azimuth") = pi / 2;
    const Sampled now(turbine, horizontal);
    CHECK(now["RootFyb1"] < -0.99 * blade.mass * g);
    CHECK(now["RootMxb1"] > 0.99 * blade.first.z() * g);
}

TEST_CASE("channels: a rotating blade pulls with its first moment about the axis times the square of the speed",
          "[analytic]") {
    const Turbine turbine = wt600(wt600_paper_assembly());
    const double Omega = 2.8, hub_radius = 1.5;
    MachineState state(turbine);
    at(turbine, state.q, "generator azimuth") = 1;
    state.qd(turbine.rotor().spin) = Omega;
    const Sampled now(turbine, state);
    const BladeMoments blade(turbine.layout().blades[0].line);
    const Vec3 pull = Omega * Omega * (blade.first + blade.mass * hub_radius * Vec3::UnitZ());
    for (const char* number : {"1", "2", "3"}) {
        const Vec3 force = now.vector("RootF", std::string("b") + number);
        CHECK(force.z() == Approx(pull.z()).epsilon(1e-8));
        CHECK(force.y() == Approx(pull.y()).epsilon(1e-6));
        CHECK(std::abs(force.x()) < 1e-9 * pull.z());
        CHECK(now[std::string("RootMxb") + number] ==
              Approx(Omega * Omega * hub_radius * blade.first.y()).epsilon(1e-6));
    }
    CHECK(now["RotSpeed"] == Approx(Omega));
    CHECK(now["GenSpeed"] == Approx(50 * Omega));
    CHECK(std::abs(now["RotTorq"]) < 1e-6);
    CHECK(now.vector("TwrBsF", "t").norm() < 1e-6 * pull.z());  // three blades are in balance

    const Turbine single = isolated_blade(wt600_description(), wt600_paper_assembly());
    MachineState alone(single);
    alone.q(0) = 1;
    alone.qd(0) = Omega;
    const Sampled of_one(single, alone);
    CHECK(of_one["RootFzb1"] == Approx(pull.z()).epsilon(1e-8));
    CHECK(of_one["RotSpeed"] == Omega);
    CHECK(of_one["Azimuth"] == Approx(1));
}

TEST_CASE("channels: a force at a blade's tip comes down to root, tower top and foot with its lever", "[analytic]") {
    const Turbine bare = wt600(wt600_paper_assembly());
    const Vec3 F = 1000 * Vec3(std::cos(tilt), 0, -std::sin(tilt));  // along the shaft, downwind
    ForceSet forces = bare.forces();
    forces.add_wrench({"tip", bare.layout().blades[0].tip(), {F, Vec3::Zero()}, WrenchAxes::base});
    const Turbine turbine = bare.with_forces(forces);
    const Sampled now(turbine, MachineState(turbine));
    CHECK(now["RootFxb1"] == Approx(1000));
    CHECK(now["RootMyb1"] == Approx(1000 * 20.0));
    CHECK(now["RootMxb1"] == Approx(0).margin(1e-6));
    CHECK(now["RootFxb2"] == Approx(0).margin(1e-9));
    const Vec3 top(0, 0, 50.7), axis = F.normalized(), up(std::sin(tilt), 0, std::cos(tilt));
    const Vec3 tip = top + Vec3(0, 0, 1.5) - 2.8 * axis + 21.5 * up;
    CHECK((now.vector("TwrBsM", "t") - tip.cross(F)).norm() < 1e-6);
    CHECK((now.vector("YawBrM", "p") - (tip - top).cross(F)).norm() < 1e-6);
    CHECK((now.vector("TwrBsF", "t") - F).norm() < 1e-9);
    CHECK(now["TwrBsMyt"] > 0);
}

TEST_CASE("channels: a force on a nacelle that is fixed to a rigid tower comes down to its top and foot",
          "[analytic]") {
    TurbineDescription d = wt600_description();
    d.tower.rigid = true;
    d.yaw = {rigid_joint, rigid_joint};
    const Vec3 F(300, -200, 100), arm(0, 0, 50.7);
    for (const bool afloat : {false, true}) {
        if (afloat) d.platform.emplace().mooring_preload = Vec3(7e5, 3e5, 0);  // on the platform, not on the tower
        const Turbine bare = assemble(d, wt600_paper_assembly());
        const FrameId nacelle = bare.tree().frame("nacelle");
        ForceSet forces = bare.forces();
        forces.add_wrench({"wind", nacelle, {F, Vec3::Zero()}, WrenchAxes::base});
        const Turbine loaded = bare.with_forces(forces);
        const Sampled known(loaded, MachineState(loaded));
        CHECK((known.vector("YawBrF", "p") - F).norm() < 1e-9);
        CHECK(known.vector("YawBrM", "p").norm() < 1e-9);
        CHECK((known.vector("TwrBsF", "t") - F).norm() < 1e-9);
        CHECK((known.vector("TwrBsM", "t") - arm.cross(F)).norm() < 1e-8);
        ForceSet elements = bare.forces();
        elements.add_element({.name = "wind",
                              .points = {{nacelle}},
                              .evaluate = [F](const ElementView&, ElementForces& out) { out.wrenches[0].force = F; }});
        const Turbine pushed = bare.with_forces(elements);
        const Sampled given(pushed, MachineState(pushed));
        for (const char* end : {"TwrBsMxt", "TwrBsMyt", "YawBrFxp", "TwrBsFzt"})
            CHECK(given[end] == Approx(known[end]).margin(1e-9));
    }
}

TEST_CASE("channels: in any motion the loads along the axes of joints are the forces of their springs and drives",
          "[property]") {
    const Wt600Operation machine = wt600_operation({.assembly = heavy(), .at_grid = false});
    const Turbine& turbine = machine.turbine;
    for (unsigned seed : {1u, 2u, 3u}) {
        const MachineState state = in_motion(turbine, seed);
        const Sampled now(turbine.system(), machine.channels, state);
        const auto spring = [&](const char* name, double k, double d) {
            const int i = turbine.system().model.index(name);
            return k * state.q(i) + d * state.qd(i);
        };
        const double torque = spring("main shaft twist", 6e7, 1e5);
        CHECK(now["RotTorq"] == Approx(torque).epsilon(1e-9));
        CHECK(std::abs(now["rotor load torque"]) > 1e5);  // which is a user force
        const Vector& q = state.q;
        const int x = turbine.system().model.index("yaw bearing x"), y = turbine.system().model.index("yaw bearing y");
        // About the tower top, from which the yaw axis has moved.
        const Vec3 force = now.vector("YawBrF", "p");
        CHECK(now["YawBrMzp"] == Approx(spring("yaw", 6e7, 2e4) + q(x) * force.y() - q(y) * force.x()).epsilon(1e-8));
        CHECK(force.x() == Approx(spring("yaw bearing x", 2e9, 5e4)).epsilon(1e-8));
        CHECK(force.y() == Approx(spring("yaw bearing y", 2e9, 5e4)).epsilon(1e-8));
        for (int k = 1; k <= 3; ++k)
            CHECK(now[text("RootMzb", k)] == Approx(-now[text("blade ", k, " pitch drive force")]).epsilon(1e-8));
        CHECK(now["GenTq"] == 0);
    }
}

TEST_CASE("channels: the load of a rotor counts as a wrench of the force set does", "[property]") {
    const Wt600Operation machine = wt600_operation({.assembly = heavy()});
    const Turbine bare = assemble(wt600_description(), heavy());
    const MachineState state = in_motion(machine.turbine, 4);
    Workspace workspace(bare.system().model);
    const Wrench load = machine.rotor.wrench({state, kinematics(bare.system().model, state.q, workspace)});
    ForceSet forces = bare.forces();
    forces.add_wrench({"load", bare.layout().hub, load, WrenchAxes::base});
    const Turbine known = bare.with_forces(forces);
    const Sampled expected(known, state), now(machine.turbine.system(), machine.channels, state), without(bare, state);
    CHECK(std::abs(now["TwrBsMyt"] - without["TwrBsMyt"]) > 1e6);
    CHECK(std::abs(now["RotTorq"] - without["RotTorq"]) > 1e5);
    CHECK(now["RootMyb1"] == Approx(without["RootMyb1"]).epsilon(1e-12));
    for (const auto& [name, value] : expected.values) {
        CAPTURE(name);
        CHECK(now[name] == Approx(value).epsilon(1e-9).margin(1e-4));
    }
}

TEST_CASE("channels: a hinge angle deflects the tip by its lever; turning the blade as a whole does not",
          "[analytic]") {
    const Turbine turbine = wt600(wt600_paper_assembly());
    MachineState rigid(turbine);
    for (const char* name : {"generator azimuth", "main shaft twist", "yaw", "tilt", "blade 1 pitch",
                             "tower element 2 bending y1", "yaw bearing x"})
        at(turbine, rigid.q, name) = 0.3;
    const Sampled whole(turbine, rigid);
    for (const char* alias : {"OoPDefl1", "IPDefl1", "TipDxb1", "TipDyb1", "TipDzb1", "OoPDefl2"})
        CHECK(std::abs(whole[alias]) < 1e-12);
    CHECK(whole["BldPitch1"] == -0.3);
    CHECK(whole["NacYaw"] == 0.3);
    CHECK(whole["Azimuth"] == Approx(0.6).epsilon(1e-12));
    MachineState bent = rigid;
    const double angle = 0.05, arm = 20 - delta_gauss * 20 / 3;
    at(turbine, bent.q, "blade 1 element 1 bending y1") = angle;  // about the leading edge's axis: tip upwind
    const Sampled now(turbine, bent);
    const Vec3 d(-arm * std::sin(angle), 0, arm * (std::cos(angle) - 1));
    CHECK(now["TipDxb1"] == Approx(d.x()).epsilon(1e-12));
    CHECK(now["TipDyb1"] == Approx(0).margin(1e-12));
    CHECK(now["TipDzb1"] == Approx(d.z()).epsilon(1e-10));
    const Vec3 coned = Eigen::AngleAxisd(0.3, Vec3::UnitZ()) * d;  // pitched away from feather
    CHECK(now["OoPDefl1"] == Approx(coned.x()).epsilon(1e-12));
    CHECK(now["IPDefl1"] == Approx(coned.y()).epsilon(1e-12));
    CHECK(std::abs(now["blade 1 tip twist"]) < 1e-12);
    // Behind the bend the torsion joint turns the tip about its span.
    at(turbine, bent.q, "blade 1 element 2 torsion") = -0.02;
    CHECK(Sampled(turbine, bent)["blade 1 tip twist"] == Approx(-0.02).epsilon(1e-12));
}

TEST_CASE("channels: displacement, acceleration and speeds are those of frames and coordinates in motion",
          "[property]") {
    const Turbine turbine = wt600(heavy());
    const MachineState state = in_motion(turbine, 7);
    const Model& model = turbine.system().model;
    Workspace workspace(model);
    const auto top = [&](double t) {  // on the parabola through the state
        const Vector q = state.q + t * state.qd + t * t / 2 * state.qdd;
        return pose(kinematics(model, q, workspace), turbine.layout().tower_top);
    };
    const Sampled now(turbine, state);
    constexpr double h = 2e-4;
    const Vec3 a = (-top(2 * h).p + 16 * top(h).p - 30 * top(0).p + 16 * top(-h).p - top(-2 * h).p) / (12 * h * h);
    const Vec3 own = top(0).R.transpose() * a, moved = top(0).p - Vec3(0, 0, 50.7),
               along = top(0).R.transpose() * moved;
    CHECK(now["YawBrTAxp"] == Approx(own.x()).epsilon(1e-6));
    CHECK(now["YawBrTAyp"] == Approx(own.y()).epsilon(1e-6));
    CHECK(now["TTDspFA"] == Approx(moved.x()).epsilon(1e-10));
    CHECK(now["TTDspSS"] == Approx(moved.y()).epsilon(1e-10));
    CHECK(now["YawBrTDxp"] == Approx(along.x()).epsilon(1e-10));
    CHECK(now["YawBrTDyp"] == Approx(along.y()).epsilon(1e-10));
    double speed = 0, azimuth = 0;
    for (const char* name : {"generator azimuth", "high-speed shaft twist", "main shaft twist"}) {
        speed += state.qd(model.index(name));
        azimuth += state.q(model.index(name));
    }
    CHECK(now["RotSpeed"] == Approx(speed).epsilon(1e-12));
    CHECK(now["Azimuth"] == Approx(std::fmod(azimuth, 2 * pi)).epsilon(1e-12));
}

TEST_CASE("channels: with the shaft as a beam its torsion counts in azimuth and torque", "[property]") {
    AssemblyOptions options = heavy();
    options.shaft_beam = ShaftBeam{1e12};
    const Turbine turbine = wt600(options);
    const std::string shaft = "main shaft element 1 ";
    const MachineState state =
        in_motion(turbine, 1, {shaft + "bending y1", shaft + "bending z1", shaft + "bending y2", shaft + "bending z2"});
    const Model& model = turbine.system().model;
    const int twist = model.index(shaft + "torsion");
    const Sampled now(turbine, state);
    double azimuth = 0, speed = 0;
    for (const auto& [body, factor] : turbine.layout().azimuth) {
        azimuth += factor * state.q(model.index(body));
        speed += factor * state.qd(model.index(body));
    }
    CHECK(std::abs(state.q(twist)) > 1e-4);
    CHECK(now["Azimuth"] == Approx(std::fmod(azimuth, 2 * pi)).epsilon(1e-9));
    CHECK(now["RotSpeed"] == Approx(speed).epsilon(1e-9));
    // The shaft itself has next to no inertia: the torque at the hub is that of the spring.
    const double torque = -(6e7 * state.q(twist) + 1e5 * state.qd(twist));
    CHECK(now["RotTorq"] == Approx(torque).epsilon(1e-3));
}

namespace {

solvers::Integrator integrator_at_rest(const System& system) {
    const Vector zero = Vector::Zero(system.model.size());
    return {system, {}, 0, zero, zero};
}

}  // namespace

TEST_CASE("channels: names and aliases are unique and complete, and a recorder gets them with units", "[property]") {
    for (int blades : {3, 4}) {
        TurbineDescription d = wt600_description();
        d.blades = blades;
        const Turbine turbine = assemble(d, wt600_paper_assembly());
        const solvers::Integrator integrator = integrator_at_rest(turbine.system());
        const solvers::Recorder recorder(integrator, channels(turbine));  // throws for names that come twice
        std::set<std::string> aliases;
        for (const Channel& channel : recorder.channels())
            if (!channel.alias.empty()) CHECK(aliases.insert(channel.alias).second);
        for (const char* expected :
             {"RotSpeed", "GenSpeed", "Azimuth",  "RotTorq",  "YawBrTDxp", "TTDspFA",  "TTDspSS",
              "NacYaw",   "TwrBsFxt", "TwrBsMxt", "TwrBsMyt", "YawBrMzp",  "RootMxb1", "RootMyb1",
              "RootFzb3", "RootMxc2", "TipDxb1",  "OoPDefl1", "IPDefl3",   "BldPitch2"})
            CHECK(aliases.contains(expected));
        CHECK_FALSE(aliases.contains("RootMxb4"));
    }
    const Wt600Operation machine = wt600_operation({.assembly = heavy()});
    const solvers::Integrator running = integrator_at_rest(machine.turbine.system());
    CHECK_NOTHROW(solvers::Recorder(running, machine.channels));
    const Turbine blade = isolated_blade(wt600_description(), wt600_paper_assembly());
    const solvers::Integrator alone = integrator_at_rest(blade.system());
    const solvers::Recorder recorder(alone, channels(blade));
    for (const Channel& channel : recorder.channels()) CHECK(channel.alias != "TwrBsMxt");
}

TEST_CASE("channels: each says along or about which axes it is, unless it has no direction", "[property]") {
    const Turbine turbine = wt600({.tower_elements = 1, .blade_elements = 1});
    const auto nowhere = [](const std::string& units) {
        return units == "J" || units == "W" || units == "1" || units == "s";
    };
    std::size_t count = 0;
    for (const ChannelGroup& group : channels(turbine))
        for (const Channel& channel : group.channels) {
            INFO(channel.name);
            CHECK(channel.frame.empty() == nowhere(channel.units));
            ++count;
        }
    CHECK(count > 60);
    const Model& model = turbine.system().model;
    const solvers::Integrator integrator(turbine.system(), {}, 0, Vector::Zero(model.size()),
                                         Vector::Zero(model.size()));
    const solvers::Recorder recorder(integrator, {}, {.accelerations = true});
    for (const Channel& channel : recorder.channels()) {
        INFO(channel.name);
        CHECK(channel.frame.empty() == nowhere(channel.units));
    }
    CHECK(recorder.channels().front().frame == "axis of " + model.coordinates()[0].name);
}

}  // namespace cardan::testing::machine_channels_tests
