// Machines of all kinds from one description: bearings of every hold, blades that differ or are missing, hubs alone,
// downwind rotors, teetered hubs on elastic drive trains; and descriptions that look wrong.
#include "mbs/base/units.hpp"
#include "mbs/kernels/metric.hpp"
#include "solvers/time/recorder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"
#include "turbines/model/channels.hpp"

namespace cardan::testing::machine_variants {

using turbines::free_joint;
using turbines::JointSupport;
using turbines::rigid_joint;
using turbines::Turbine;
using D = turbines::TurbineDescription;

namespace {

template <class Change>
Turbine machine(const Change& change, int elements = 2) {
    D d = turbines::wt600_description();
    change(d);
    return turbines::assemble(d, undamped(elements));
}

template <class Change>
void check_description_refused(const Change& change, std::initializer_list<std::string> parts) {
    D d = turbines::wt600_description();
    change(d);
    check_refused([&] { d.check(); }, parts);
}

void check_close(const std::vector<double>& a, const std::vector<double>& b, double tolerance, std::size_t count = 12) {
    REQUIRE(a.size() >= count);
    REQUIRE(b.size() >= count);
    for (std::size_t i = 0; i < count; ++i) CHECK(a[i] == Approx(b[i]).epsilon(tolerance));
}

// Inertia about the shaft with everything else at rest.
double inertia_about_shaft(const Turbine& turbine) {
    const Model& model = turbine.system().model;
    Workspace workspace(model);
    Matrix g(model.size(), model.size());
    metric(kinematics(model, Vector::Zero(model.size()), workspace), g);
    return g(turbine.rotor().spin, turbine.rotor().spin);
}

BeamLine heavier(const BeamLine& line, double factor) {
    BeamLine out = line;
    out.section = [own = line.section, factor](double x) {
        BeamSection s = own(x);
        s.mass *= factor;
        s.J *= factor;
        return s;
    };
    return out;
}

// Mirrored in the plane across z of the blade: y stays, z turns round. Forces are polar vectors, moments axial ones.
BeamLine mirrored(const BeamLine& line) {
    BeamLine out = line;
    out.section = [own = line.section](double x) {
        BeamSection s = own(x);
        const Vec3 across(1, 1, -1);
        const Vec6 signs = (Vec6() << 1, 1, -1, -1, -1, 1).finished();
        s.compliance = (signs.asDiagonal() * s.compliance * signs.asDiagonal()).eval();
        s.centre.z() *= -1;
        s.J = (across.asDiagonal() * s.J * across.asDiagonal()).eval();
        s.beta *= -1;
        return s;
    };
    return out;
}

}  // namespace

TEST_CASE("machine variants: a bearing that was not given is refused with its name", "[property]") {
    check_description_refused([](D& d) { d.yaw.rotation = {}; }, {"yaw.rotation.stiffness [N m/rad] = not given",
                                                                  "free_joint, rigid_joint, driven_joint"});
    check_description_refused([](D& d) { d.blade.pitch = {}; }, {"blade.pitch.stiffness", "not given"});
    check_description_refused([](D& d) { d.drive_train.main_shaft = {}; }, {"main_shaft.stiffness", "not given"});
    check_description_refused([](D& d) { d.hub.teeter.emplace(); }, {"hub.teeter.stiffness", "not given"});
    check_description_refused([](D& d) { d.individual_blades[2].emplace(); }, {"own_blades[2].pitch", "not given"});
    check_description_refused([](D& d) { d.yaw.rotation.stiffness = 0; }, {"yaw.rotation", "= 0", "free_joint"});
    check_description_refused([](D& d) { d.yaw.rotation.kind = JointSupport::Kind::free; },
                              {"yaw.rotation.stiffness", "only JointSupport::Kind::spring"});
    check_description_refused(
        [](D& d) {
            d.yaw.translation = {0, 3, JointSupport::Kind::rigid};
        },
        {"yaw.translation.damping [N s/m] = 3", "rigid or prescribed"});
    check_description_refused([](D& d) { d.drive_train.main_shaft = turbines::prescribed_joint; },
                              {"main_shaft = driven", "drive_train.spin"});
}

TEST_CASE("machine variants: degrees for radians and per cent for ratios are noticed, unless they are meant",
          "[property]") {
    check_description_refused([](D& d) { d.nacelle.tilt = 5; }, {"nacelle.tilt [rad] = 5", "in degrees?", "`unusual`"});
    check_description_refused([](D& d) { d.blade.cone = -2.5; }, {"blade.cone [rad] = -2.5", "in degrees?"});
    check_description_refused([](D& d) { d.blade.pitch_setting = 20; }, {"blade.pitch_setting", "in degrees?"});
    check_description_refused([](D& d) { d.blade.first_flap_damping = 0.5; },
                              {"blade.first_flap_damping = 0.5", "in per cent?"});
    D d = turbines::wt600_description();
    d.blade.cone = 0.6;
    d.tower.first_mode_damping = 0.5;
    CHECK(refusal([&] { d.check(); }) != "(accepted)");
    d.unusual = true;
    CHECK(refusal([&] { d.check(); }) == "(accepted)");
    d.blade.cone = 1.6;  // more than a quarter of a turn is no cone
    check_refused([&] { d.check(); }, {"blade.cone [rad] = 1.6"});
}

TEST_CASE("machine variants: a driven joint that rests is as good as none; it keeps its coordinate", "[property]") {
    const Turbine none = machine([](D&d) { d.yaw.rotation = d.blade.pitch = rigid_joint; }),
                  driven = machine([](D&d) { d.yaw.rotation = d.blade.pitch = turbines::prescribed_joint; });
    CHECK(driven.system().model.size() == none.system().model.size() + 4);
    CHECK(driven.system().model.coordinates().free().size() == none.system().model.coordinates().free().size());
    check_close(frequencies(driven, 27 * rpm), frequencies(none, 27 * rpm), 1e-9);
}

TEST_CASE("machine variants: a free joint is the limit of a weak spring", "[property]") {
    const Turbine free = machine([](D&d) { d.yaw.rotation = free_joint; }),
                  weak = machine([](D&d) { d.yaw.rotation = {100.0}; });  // weaker ones drown in rounding
    const std::vector<double> f = frequencies(free, 0), g = frequencies(weak, 0);
    REQUIRE(g.size() == f.size() + 1);  // the free yaw itself is left out
    CHECK(g[0] < 3e-3);
    check_close(f, {g.begin() + 1, g.end()}, 1e-6);
}

TEST_CASE("machine variants: a blade of its own that is like the others changes nothing", "[property]") {
    const Turbine common = machine([](D&) {}), own = machine([](D&d) { d.individual_blades[2] = d.blade; });
    CHECK(frequencies(common, 27 * rpm) == frequencies(own, 27 * rpm));
}

TEST_CASE("machine variants: each blade has its own mass, stiffness, cone and pitch", "[analytic]") {
    D d = turbines::wt600_description();
    d.individual_blades[3] = d.blade;
    d.individual_blades[3]->line = heavier(d.blade.line, 1.21);
    d.individual_blades[3]->cone = 0.03;
    d.individual_blades[3]->pitch_setting = 0.1;
    const Turbine unequal = turbines::assemble(d, undamped(2)), equal = machine([](D&) {});
    const double blade = equal.layout().blades[0].mass;
    CHECK(unequal.system().model.mass() - equal.system().model.mass() == Approx(0.21 * blade).epsilon(1e-9));
    CHECK(unequal.layout().pitch_settings == std::vector<double>{0, 0, 0.1});
    const Model& model = unequal.system().model;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
    const Mat3 hub = pose(kin, unequal.rotor().hub).R;
    CHECK(hub.col(2).dot(pose(kin, model.frame("blade 3 root")).R.col(0)) == Approx(std::sin(0.03)).epsilon(1e-12));
    CHECK(hub.col(2).dot(pose(kin, model.frame("blade 1 root")).R.col(0)) == Approx(0).margin(1e-12));
    // At rest, alone: frequencies with the root of the mass.
    const auto alone = [&](int number) { return frequencies(turbines::isolated_blade(d, undamped(2), number), 0); };
    const std::vector<double> first = alone(1), third = alone(3);
    for (std::size_t i = 0; i < 4; ++i) CHECK(first.at(i) / third.at(i) == Approx(1.1).epsilon(1e-9));
}

TEST_CASE("machine variants: of three places one may be empty, and a hub may have no blades", "[analytic]") {
    const Turbine three = machine([](D&) {}), two = machine([](D&d) { d.individual_blades[2] = std::nullopt; }),
                  none = machine([](D&d) { d.blades = 0; });
    CHECK(two.layout().blade_numbers == std::vector<int>{1, 3});
    CHECK(two.rotor().blades.size() == 2);
    CHECK_FALSE(two.system().model.coordinates().of_part("blade").empty());
    CHECK(none.system().model.coordinates().of_part("blade").empty());
    const double blades = three.system().model.mass() - none.system().model.mass();
    CHECK(two.system().model.mass() - none.system().model.mass() == Approx(2 * blades / 3).epsilon(1e-9));
    const double about = inertia_about_shaft(three) - inertia_about_shaft(none);
    CHECK(inertia_about_shaft(two) - inertia_about_shaft(none) == Approx(2 * about / 3).epsilon(1e-9));
    std::vector<std::string> names;
    for (const ChannelGroup& group : turbines::channels(two))
        for (const Channel& channel : group.channels) names.push_back(channel.alias);
    CHECK(std::count(names.begin(), names.end(), "RootMyb3") == 1);
    CHECK(std::count(names.begin(), names.end(), "RootMyb2") == 0);
    D d = turbines::wt600_description();
    d.individual_blades[2] = std::nullopt;
    check_refused([&] { (void)turbines::isolated_blade(d, undamped(2), 2); }, {"number of the blade = 2"});
    check_refused([&] { (void)turbines::isolated_blade(d, undamped(2), 4); }, {"number of the blade = 4"});
    check_description_refused([](D& own) { own.individual_blades[4] = own.blade; },
                              {"blade of its own = 4", "1 ... 3"});
    CHECK(frequencies(none, 27 * rpm).size() > 5);
}

TEST_CASE("machine variants: the mirror image of a machine, its rotor downwind, has the same frequencies",
          "[analytic]") {
    const auto original = [](D& d) {
        d.blade.cone = 0.05;
        d.nacelle.inertia.com.x() = -0.7;
        d.hub.inertia.com.z() = 0.2;
    };
    const Turbine upwind = machine(original), downwind = machine([&](D&d) {
                                                  original(d);
                                                  d.nacelle.overhang *= -1;
                                                  d.nacelle.tilt *= -1;
                                                  d.nacelle.inertia.com.x() *= -1;
                                                  d.hub.inertia.com.z() *= -1;
                                                  d.blade.cone *= -1;
                                                  d.blade.line = mirrored(d.blade.line);
                                              });
    for (double speed : {0.0, 27 * rpm})
        check_close(frequencies(upwind, speed), frequencies(downwind, speed), 1e-8, 18);
}

TEST_CASE("machine variants: a teetered rotor of real blades on an elastic drive train keeps its energy in motion",
          "[property]") {
    D d = turbines::wt600_description();
    d.blades = 2;
    d.hub.teeter = {.bearing = {2e5}, .undersling = 0.3, .delta3 = 0.2};
    d.yaw.rotation = free_joint;
    turbines::AssemblyOptions options = undamped(1);
    options.gravity = {0, 0, -units::standard_gravity};
    const Turbine turbine = turbines::assemble(d, options);
    const Model& model = turbine.system().model;
    CHECK(turbine.rotor().odd_coordinates == std::vector<int>{model.index("teeter")});
    Vector q = Vector::Zero(model.size()), qd = q;
    q(model.index("teeter")) = 0.04;
    qd(turbine.rotor().spin) = 27 * rpm;
    solvers::IntegrationOptions integration;
    integration.tolerances = {1e-7, 1e-9, 1e-9, 1e-8, 1e-8};
    solvers::Integrator integrator(turbine.system(), {}, 0, q, qd, integration);
    solvers::Recorder recorder(integrator, turbines::channels(turbine));
    solvers::History history;
    REQUIRE(solvers::record(integrator, recorder, solvers::sample_times(0, 2, 0.05), history).reached());
    const std::vector<double>&teeter = history["teeter angle"], &kinetic = history["kinetic energy"],
          &error = history["energy error"];
    CHECK(teeter.front() == Approx(-0.04));  // positive moves blade 1 downwind
    CHECK(*std::max_element(teeter.begin(), teeter.end()) > 0.02);
    CHECK(std::abs(error.back()) < 1e-6 * kinetic.front());
    // Blade 1 downwind of its place, seen from the rotor centre, where the angle is positive.
    CHECK(history["blade 1 tip out-of-plane deflection"].size() == teeter.size());
}

TEST_CASE("machine variants: the method of a Campbell diagram follows from the machine", "[property]") {
    const auto diagram = [](const Turbine& turbine) {
        return solvers::campbell(turbine.system(), turbine.rotor(), {27 * rpm}, {.max_frequency_hz = 3});
    };
    const auto method = [&](const Turbine& turbine) { return diagram(turbine).method; };
    const auto reason = [&](const Turbine& turbine) { return diagram(turbine).method_reason; };
    CHECK(method(machine([](D&) {}, 1)) == "Coleman (fixed frame)");
    CHECK(reason(machine([](D&) {}, 1)).empty());
    const solvers::Campbell unequal =
        diagram(machine([](D& d) { (d.individual_blades[3] = d.blade)->line = heavier(d.blade.line, 1.1); }, 1));
    CHECK(unequal.method.find("Floquet") == 0);
    CHECK(unequal.method_reason == "the blades differ");
    CHECK(reason(machine([](D& d) { d.blades = 2; }, 1)) == "two blades");
    // One blade on a tower that moves is periodic; one on a hub that does not is constant in its own frame.
    CHECK(reason(machine([](D& d) { d.blades = 1; }, 1)).find("one blade") == 0);
    CHECK(method(turbines::isolated_blade(turbines::wt600_description(), undamped(1))) ==
          "rotating frame of the blade");
    // A hub alone whose inertia is that of a bar is balanced, and yet what the tower feels changes with the azimuth.
    const Turbine bar = machine(
        [](D& d) {
            d.blades = 0;
            d.hub.inertia.J(0, 0) = 0.5 * d.hub.inertia.J(1, 1);
        },
        1);
    CHECK(reason(bar).find("the equations are not constant") == 0);
    const solvers::Campbell at_one_azimuth = solvers::campbell(
        bar.system(), bar.rotor(), {27 * rpm}, {.method = solvers::CampbellMethod::coleman, .max_frequency_hz = 3});
    CHECK(at_one_azimuth.warning.find("Take CampbellMethod::floquet") != std::string::npos);
    CHECK(method(machine([](D& d) { d.blades = 0; }, 1)).find("fixed frame") == 0);
}

TEST_CASE("machine variants: a platform is part of the description and of its check", "[property]") {
    using turbines::PlatformDescription;
    const auto refused = [](auto change, std::initializer_list<std::string> parts) {
        check_description_refused([&](D& d) { change(d.platform.emplace()); }, parts);
    };
    refused([](PlatformDescription& p) { p.inertia.mass = -1; }, {"600 kW", "platform", "mass [kg] = -1"});
    refused([](PlatformDescription& p) { p.name = "raft", p.buoyancy = -2; }, {"600 kW", "raft", "buoyancy [N] = -2"});
    refused([](PlatformDescription& p) { p.mooring_stiffness(0, 1) = 1; },
            {"600 kW", "mooring, surge by sway = 1", "symmetric"});
    refused([](PlatformDescription& p) { p.coordinates.rotations[0] = BaseCoordinate::surge; },
            {"600 kW", "number of rotations called yaw = 0", "1"});
    D d = turbines::wt600_description();
    d.platform.emplace();
    CHECK(refusal([&] { d.check(); }) == "(accepted)");
    CHECK(turbines::assemble(d, undamped(1)).layout().platform);
}

TEST_CASE("machine variants: a rigid tower needs neither stiffness nor damping, and has no use for them",
          "[property]") {
    const auto rigid = [](auto change) {
        return machine([&](D& d) {
            d.tower.rigid = true;
            change(d);
        });
    };
    const Turbine plain = rigid([](D&) {}), damped = rigid([](D&d) { d.tower.first_mode_damping = 0.02; }),
                  soft = rigid([](D&d) {
                      d.tower.line.section = [own = d.tower.line.section](double x) {
                          BeamSection s = own(x);
                          s.compliance *= 1e3;
                          return s;
                      };
                  });
    CHECK(plain.system().model.coordinates().of_part("tower").empty());
    CHECK(plain.rotor().description.find("tower rigid") != std::string::npos);
    for (const Turbine* other : {&damped, &soft}) {
        CHECK(frequencies(*other, 0) == frequencies(plain, 0));
        CHECK(other->system().model.mass() == plain.system().model.mass());
    }
    // A line alone, without sections: a massless stand.
    const Turbine stand = rigid([](D& d) { d.tower.line.section = {}; });
    check_close(frequencies(stand, 0), frequencies(plain, 0), 1e-12);
    check_description_refused([](D& d) { d.tower.rigid = true, d.tower.first_mode_damping = -1; },
                              {"tower.first_mode_damping = -1"});
    D d = turbines::wt600_description();
    d.tower.rigid = true;
    check_refused([&] { (void)turbines::isolated_tower(d); }, {"600 kW", "tower.rigid", "could not move"});
}

TEST_CASE("machine variants: whether the rotor is driven is part of the description, and an analysis may decide anew",
          "[property]") {
    D d = turbines::wt600_description();
    turbines::AssemblyOptions options = undamped(1);
    const auto role = [&] {
        const Turbine turbine = turbines::assemble(d, options);
        return turbine.system().model.coordinates()[turbine.rotor().spin].role;
    };
    CHECK(role() == CoordinateRole::free);
    d.drive_train.spin = CoordinateRole::prescribed;
    CHECK(role() == CoordinateRole::prescribed);
    const Turbine blade = turbines::isolated_blade(d, options);
    CHECK(blade.system().model.coordinates()[blade.rotor().spin].role == CoordinateRole::prescribed);
    options.spin = CoordinateRole::free;
    CHECK(role() == CoordinateRole::free);
}

TEST_CASE("machine variants: a blade or the tower alone needs nothing of the rest, and leaves a platform out",
          "[property]") {
    const D whole = turbines::wt600_description();
    D one;  // no bearings, no hub, no tower
    one.name = "a blade";
    one.blade.line = whole.blade.line;
    one.hub.radius = whole.hub.radius;
    one.blade.first_flap_damping = whole.blade.first_flap_damping;
    one.platform.emplace();
    check_refused([&] { one.check(); }, {"a blade"});
    const Turbine blade = turbines::isolated_blade(one, {}, 2), same = turbines::isolated_blade(whole, {}, 2);
    CHECK_FALSE(blade.layout().platform);
    CHECK(frequencies(blade, 27 * rpm) == frequencies(same, 27 * rpm));
    one.blade = {};
    one.individual_blades[2].emplace().line = whole.blade.line;  // the others lack everything
    one.individual_blades[3] = std::nullopt;
    one.individual_blades[2]->first_flap_damping = whole.blade.first_flap_damping;
    CHECK(frequencies(turbines::isolated_blade(one, {}, 2), 0) == frequencies(same, 0));
    check_refused([&] { (void)turbines::isolated_blade(one, {}, 3); }, {"a blade", "number of the blade = 3"});

    D stump;
    stump.name = "a tower";
    stump.tower.line = whole.tower.line;
    stump.platform.emplace().inertia.mass = 1e6;
    D undamped_tower = whole;
    undamped_tower.tower.first_mode_damping = 0;
    const Turbine tower = turbines::isolated_tower(stump), full = turbines::isolated_tower(undamped_tower);
    CHECK_FALSE(tower.layout().platform);
    CHECK(frequencies(tower, 0) == frequencies(full, 0));
    // A ratio of the first mode is that of the tower with its top.
    stump.tower.first_mode_damping = 0.01;
    check_refused([&] { (void)turbines::isolated_tower(stump); }, {"length [m] = 0"});
    stump.blades = 0;
    CHECK(refusal([&] { (void)turbines::isolated_tower(stump); }) == "(accepted)");

    // Masses on top count, whatever holds them.
    D loose = undamped_tower;
    loose.yaw.rotation = loose.drive_train.main_shaft = loose.blade.pitch = loose.nacelle.tilt_bearing = {};
    loose.platform.emplace().inertia.mass = 1e6;
    check_close(frequencies(turbines::isolated_tower(loose, {}, true), 0),
                frequencies(turbines::isolated_tower(undamped_tower, {}, true), 0), 1e-9, 4);
}

}  // namespace cardan::testing::machine_variants
