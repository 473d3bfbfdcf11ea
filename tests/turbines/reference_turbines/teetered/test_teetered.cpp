// The two-bladed teetered machine of Lee, Hodges and Patil (2002), Table I: masses, frames, joint axes, symmetry, what
// its assembly may be asked for.
#include "mbs/base/entry.hpp"
#include "mbs/kernels/dynamics.hpp"
#include "mbs/model/summary.hpp"
#include "solvers/equilibrium/steady_state.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_floquet.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_machine.hpp"

#include <Eigen/Geometry>

using namespace cardan;
using namespace cardan::testing;
using Catch::Matchers::Contains;
using test::message_of;
using turbines::assemble;
using turbines::AssemblyOptions;
using turbines::teetered_description;
using turbines::Turbine;
using turbines::TurbineDescription;

namespace {

AssemblyOptions general_options() {
    AssemblyOptions options = turbines::teetered_paper_assembly(2);
    options.gravity = {0.3, -0.2, -9.81};
    return options;
}

// Undeformed but for yaw, azimuth and teeter.
Vector rigid_state(const Model& model, double yaw, double azimuth, double teeter) {
    Vector q = Vector::Zero(model.size());
    q(model.index("yaw")) = yaw;
    q(model.index("generator azimuth")) = azimuth;
    q(model.index("teeter")) = teeter;
    return q;
}

Vec3 position(const Kinematics& kin, const char* frame) {
    return pose(kin, kin.model().frame(frame)).p;
}

}  // namespace

TEST_CASE("teetered machine: masses and places are those of Table I", "[published]") {
    const Turbine machine = assemble(teetered_description(), turbines::teetered_paper_assembly());
    const auto parts = masses_by_part(machine.tree());
    const auto part = [&](const std::string& name) {
        const auto found = std::find_if(parts.begin(), parts.end(), [&](const PartMass& p) { return p.part == name; });
        CAPTURE(name);
        REQUIRE(found != parts.end());
        return *found;
    };
    CHECK(part("tower").mass == Approx(27 * 67.5772).epsilon(1e-13));
    CHECK((part("tower").centre - Vec3(0, 0, 13.5)).norm() < 1e-12);
    CHECK(part("nacelle").mass == 6900);
    CHECK(part("nacelle").reduced);
    CHECK(part("hub").mass == 0);
    CHECK(parts.size() == 5);  // a shaft has no mass, and is no part
    for (const char* blade : {"blade 1", "blade 2"}) CHECK(part(blade).mass == Approx(8.42 * 67.5772).epsilon(1e-13));
    CHECK((part("blade 1").centre - Vec3(2.388, 0, 27 + 1.8 + 4.21)).norm() < 1e-12);
    CHECK((part("blade 2").centre - Vec3(2.388, 0, 27 - 1.8 - 4.21)).norm() < 1e-12);
    CHECK_FALSE(part("blade 1").reduced);
    CHECK(machine.warnings().empty());
    CHECK_THAT(machine.summary(), Contains("teetered") && Contains("reduced inertia") && Contains("yaw"));
    CHECK_THAT(machine.rotor().description, Contains("6 elements") && Contains("hub_inertia_teeter_shaft_spanwise"));
    CHECK(teetered_description().rotor_speed == 6.02);
}

TEST_CASE("teetered machine: results keep the machine that was computed, not only what it was read from",
          "[property]") {
    turbines::TurbineDescription d = teetered_description();
    d.hub.teeter->bearing = {12345};
    change_section(d.blade.line, [](EngineeringSection& s) { s.EI_flap *= 2; });
    d.name = "stiffer";
    const std::string kept = assemble(d, turbines::teetered_paper_assembly()).rotor().description;
    const std::size_t at = kept.find("the machine that was computed\n");
    REQUIRE(at != std::string::npos);
    CHECK_THAT(kept.substr(at), Contains("name: \"stiffer\"\n") && Contains("rotor_speed: 6.02\n") &&
                                    Contains("bearing: {stiffness: 12345, damping: ") &&
                                    Contains("EI_flap: [2e+07, 2e+07]\n"));
}

TEST_CASE("teetered machine: the metric of yaw and teeter is that of the rigid machine by hand", "[analytic]") {
    // Slender blades from 1.8 to 10.22 m with 4.9999 (about the shaft), 1e-4 (teeter), 5 (spanwise) kg m.
    const Turbine machine = assemble(teetered_description(), turbines::teetered_paper_assembly());
    const Model& model = machine.system().model;
    const double slender = 2 * 67.5772 * (std::pow(10.22, 3) - std::pow(1.8, 3)) / 3, both = 2 * 8.42;
    const double span = 50 + both * 5, teeter = 50 + slender + both * 1e-4, shaft = 5 + slender + both * 4.9999;
    const double fixed = 16599 + both * 67.5772 * 2.388 * 2.388;
    const int y = model.index("yaw"), b = model.index("teeter"), spin = model.index("generator azimuth");
    for (double psi : {0.0, 0.6, pi / 2}) {
        Workspace workspace(model);
        Matrix g(model.size(), model.size());
        metric(kinematics(model, rigid_state(model, 0, psi, 0), workspace), g);
        const double c = std::cos(psi), s = std::sin(psi);
        CHECK(g(y, y) == Approx(fixed + span * c * c + teeter * s * s).epsilon(1e-12));
        CHECK(g(y, b) == Approx(-teeter * s).epsilon(1e-12).margin(1e-6));
        CHECK(g(b, b) == Approx(teeter).epsilon(1e-12));
        CHECK(g(spin, spin) == Approx(shaft).epsilon(1e-12));
    }
}

TEST_CASE("teetered machine: coordinates in order, spin prescribed, two blades in corresponding order", "[property]") {
    const Turbine machine = assemble(teetered_description(), turbines::teetered_paper_assembly());
    const CoordinateTable& table = machine.system().model.coordinates();
    REQUIRE(table.size() == 30 + 3 + 2 * 30);
    CHECK(table[0].name == "tower element 1 bending y1");
    CHECK(table[30].name == "yaw");
    CHECK(table[31].name == "generator azimuth");
    CHECK(table[32].name == "teeter");
    CHECK(table[33].name == "blade 1 element 1 bending y1");
    const RotorMap& rotor = machine.rotor();
    CHECK(rotor.spin == 31);
    CHECK(table[31].role == CoordinateRole::prescribed);
    CHECK(table.free().size() == 92);
    CHECK(machine.rotor().odd_coordinates == std::vector<int>{32});
    REQUIRE(rotor.blades.size() == 2);
    for (std::size_t i = 0; i < 30; ++i) {
        const std::string first = table[rotor.blades[0][i]].name, second = table[rotor.blades[1][i]].name;
        CHECK(first.substr(7) == second.substr(7));
        CHECK(table[rotor.blades[0][i]].blade == 1);
        CHECK(table[rotor.blades[1][i]].blade == 2);
    }
    AssemblyOptions free_spin = turbines::teetered_paper_assembly();
    free_spin.spin = CoordinateRole::free;
    CHECK(assemble(teetered_description(), free_spin).system().model.coordinates().free().size() == 93);
}

TEST_CASE("teetered machine: frames lie where the description puts them, for all angles at once", "[analytic]") {
    const TurbineDescription d = general_description();
    const Turbine machine = assemble(d, general_options());
    const Model& model = machine.system().model;
    Workspace workspace(model);
    using Turn = Eigen::AngleAxisd;
    for (const auto& [yaw, psi, teeter] : {std::array{0.0, 0.0, 0.0}, {0.0, pi / 2, 0.0}, {0.4, 2.0, -0.07}}) {
        const Kinematics kin = kinematics(model, rigid_state(model, yaw, psi, teeter), workspace);
        const Mat3 yawing = Turn(yaw, Vec3::UnitZ()).toRotationMatrix();
        const Vec3 shaft = yawing * Vec3(std::cos(d.nacelle.tilt), 0, -std::sin(d.nacelle.tilt));  // downwind
        const Vec3 up = yawing * Vec3(std::sin(d.nacelle.tilt), 0, std::cos(d.nacelle.tilt));
        const Vec3 centre = Vec3(0, 0, 27) + yawing * Vec3(0, 0, 0.7) - 2.1 * shaft;
        const Vec3 along = Turn(psi, shaft) * up, across = shaft.cross(along);
        const Vec3 axis = std::cos(0.5) * across + std::sin(0.5) * along;
        const Mat3 teetering = Turn(teeter, axis).toRotationMatrix();
        CHECK((position(kin, "rotor centre") - centre).norm() < 1e-12);
        CHECK((position(kin, "hub") - centre).norm() < 1e-12);
        CHECK((kin.axis(model.index("generator azimuth")) - shaft).norm() < 1e-12);
        CHECK((kin.axis(model.index("teeter")) - axis).norm() < 1e-12);
        CHECK((kin.axis(model.index("yaw")) - Vec3::UnitZ()).norm() < 1e-12);
        for (int blade : {1, 2}) {
            const double side = blade == 1 ? 1 : -1;
            const Vec3 out = teetering * (side * std::cos(-0.1) * along + std::sin(-0.1) * shaft);
            const Vec3 leading = teetering * (side * across);
            const Vec3 root = centre + teetering * (-0.3 * shaft) + 1.8 * out;
            const std::string name = text("blade ", blade);
            const Pose<double> found = pose(kin, model.frame(name + " root"));
            CHECK((found.p - root).norm() < 1e-12);
            CHECK((found.R.col(0) - out).norm() < 1e-12);
            CHECK((found.R.col(1) - leading).norm() < 1e-12);
            CHECK((pose(kin, model.frame(name + " node 2")).p - root - 8.42 * out).norm() < 1e-12);
        }
        const Mat3 hub_axes = pose(kin, machine.rotor().hub).R;  // spins, does not teeter
        CHECK((hub_axes.col(2) - shaft).norm() < 1e-12);
        CHECK((hub_axes.col(0) - along).norm() < 1e-12);
    }
}

TEST_CASE("teetered machine: with positive delta-3 the blade that teeters downwind turns its leading edge upwind",
          "[analytic]") {
    TurbineDescription d = teetered_description();
    d.hub.teeter->delta3 = 0.6;
    const Turbine machine = assemble(d, turbines::teetered_paper_assembly(1));
    const Model& model = machine.system().model;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, rigid_state(model, 0, 1.0, 1e-5), workspace);
    for (const char* root : {"blade 1 root", "blade 2 root"}) {
        const Mat3 R = pose(kin, model.frame(root)).R;
        const double flap = R(0, 0), leading_edge = R(0, 1);  // along ground x, the shaft
        CHECK(std::abs(flap) == Approx(1e-5 * std::cos(0.6)).epsilon(1e-6));
        CHECK(leading_edge / flap == Approx(-std::tan(0.6)).epsilon(1e-6));
    }
}

TEST_CASE("teetered machine: half a revolution on, blades exchanged and teeter reversed, the equations are the same",
          "[property]") {
    const Turbine machine = assemble(general_description(), general_options());
    const System& system = machine.system();
    const int n = system.model.size();
    Workspace workspace(system.model);
    const auto half_turn = [&](const Vector& x) {
        Vector y = x;
        const auto& blades = machine.rotor().blades;
        for (std::size_t i = 0; i < blades[0].size(); ++i) std::swap(y(blades[0][i]), y(blades[1][i]));
        for (int odd : machine.rotor().odd_coordinates) y(odd) *= -1;
        return y;
    };
    const auto left_side = [&](const Vector& q, const Vector& qd, const Vector& qdd) {
        const Kinematics kin = kinematics(system.model, q, workspace);
        Vector tau(n), Q(n);
        inverse_dynamics<double>(kin, qd, qdd, tau);
        system.forces.generalised_forces({{.q = q, .qd = qd}, kin}, Q);
        return Vector(tau - Q);
    };
    Random random(11);
    for (int i = 0; i < 5; ++i) {
        const Vector q = random_state(random, n, 0.3);
        const Vector qd = random_state(random, n);
        const Vector qdd = random_state(random, n);
        Vector turned = half_turn(q);
        turned(machine.rotor().spin) += pi;
        const Vector here = left_side(q, qd, qdd), there = left_side(turned, half_turn(qd), half_turn(qdd));
        CHECK((half_turn(here) - there).cwiseAbs().maxCoeff() < 1e-11 * here.cwiseAbs().maxCoeff());
    }
}

TEST_CASE("teetered machine: springs, dampers and gravity are where the description says", "[analytic]") {
    TurbineDescription d = general_description();
    AssemblyOptions options = general_options();
    options.gravity = {0, 0, -9.81};
    const auto derivatives = [&](const Turbine& machine) {
        const Model& model = machine.system().model;
        const Vector zero = Vector::Zero(model.size());
        Workspace workspace(model);
        ForceDerivatives out;
        machine.system().forces.derivatives({{.q = zero, .qd = zero}, kinematics(model, zero, workspace)}, out);
        return out;
    };
    const Turbine machine = assemble(d, options);
    const Model& model = machine.system().model;
    const int yaw = model.index("yaw"), teeter = model.index("teeter");
    const ForceDerivatives by = derivatives(machine);
    CHECK(by.elastic(yaw, yaw) == 5e6);
    CHECK(by.damping(yaw, yaw) == 7e3);
    CHECK(by.elastic(teeter, teeter) == 3e4);
    CHECK(by.damping(teeter, teeter) == 200);
    options.joint_damping = false;
    CHECK(derivatives(assemble(d, options)).damping.isZero(0));

    // What stands on the ground has no energy: the tower is made rigid.
    d.tower.rigid = true;
    const Turbine on_ground = assemble(d, options);
    Workspace workspace(on_ground.system().model);
    const Vector zero = Vector::Zero(on_ground.system().model.size());
    double moment = 0;  // mass times height
    for (const PartMass& part : masses_by_part(on_ground.tree()))
        if (part.part != "tower") moment += part.mass * part.centre.z();
    const Kinematics kin = kinematics(on_ground.system().model, zero, workspace);
    CHECK(on_ground.system().forces.potential_energy({{.q = zero, .qd = zero}, kin}) ==
          Approx(9.81 * moment).epsilon(1e-12));
}

TEST_CASE("teetered machine: a rigid tower has no coordinates, its mass stays in the summary", "[property]") {
    turbines::TurbineDescription d = teetered_description();
    d.tower.rigid = true;
    d.tower.first_mode_damping = 0.01;  // not used
    const Turbine machine = assemble(d, turbines::teetered_paper_assembly());
    CHECK(machine.system().model.size() == 3 + 2 * 30);
    CHECK(machine.system().model.coordinates().of_part("tower").empty());
    const Vec3 top = entry(machine.tree().frames(), machine.tree().frame("tower top").index).in_body.p;
    CHECK(top == Vec3(0, 0, 27));
    const auto parts = masses_by_part(machine.tree());
    CHECK(parts.front().part == "tower");
    CHECK(parts.front().mass == Approx(27 * 67.5772).epsilon(1e-13));
    CHECK_THAT(machine.rotor().description, Contains("tower rigid"));
}

TEST_CASE("teetered machine: elements, extension and torsion of tower and blades are free to choose", "[property]") {
    TurbineDescription d = teetered_description();
    change_section(d.blade.line, [](EngineeringSection& s) { s.EA = 1e9; });
    AssemblyOptions options = turbines::teetered_paper_assembly();
    options.tower_beam->elements = 2;
    options.tower_beam->torsion = false;
    options.blade_beam->elements = 3;
    options.blade_beam->extension = true;
    const Turbine machine = assemble(d, options);
    CHECK(machine.system().model.size() == 2 * 4 + 3 + 2 * 3 * 6);
    CHECK(machine.rotor().blades[1].size() == 18);
    const auto blade = turbines::isolated_blade(d, options);
    CHECK(blade.system().model.size() == 1 + 18);
    CHECK(blade.rotor().blades.size() == 1);
    CHECK(blade.rotor().odd_coordinates.empty());
}

TEST_CASE("teetered machine: straight it is its own steady state; coned, both blades flap alike and it does not teeter",
          "[property]") {
    TurbineDescription d = teetered_description();
    d.yaw.rotation = {1e7};  // free, yaw would have no definite place
    for (double cone : {0.0, 0.05}) {
        d.blade.cone = cone;
        const Turbine machine = assemble(d, turbines::teetered_paper_assembly(2));
        const RotorMap& rotor = machine.rotor();
        solvers::SteadyOptions options;
        options.rotor_speed = 6.02;
        options.azimuth = 0.7;
        const auto steady = solvers::steady_state(machine.system(), rotor.spin, options);
        REQUIRE(steady.converged);
        Vector q = steady.at.q;
        CHECK(q(rotor.spin) == 0.7);
        CHECK(std::abs(q(machine.system().model.index("teeter"))) < 1e-10);
        for (std::size_t i = 0; i < rotor.blades[0].size(); ++i)
            CHECK(q(rotor.blades[0][i]) == Approx(q(rotor.blades[1][i])).margin(1e-12));
        // The centrifugal force straightens the coned blades: rotation about y, tips upwind, is positive.
        CHECK((cone == 0 ? q(rotor.blades[0][0]) == Approx(0).margin(1e-12) : q(rotor.blades[0][0]) > 1e-3));
    }
}

TEST_CASE("teetered machine: the ratio of tower to blade rigidity is Table III's", "[published]") {
    CHECK(section_of(turbines::with_tower_rigidity(teetered_description(), 100).tower.line).GJ == 1e9);
    const auto d = turbines::with_tower_rigidity(teetered_description(), 10);
    CHECK(section_of(d.tower.line).EI_flap == 1e8);
    CHECK(section_of(d.tower.line).EI_edge == 1e8);
    CHECK(section_of(d.tower.line).GJ == 1e8);
    CHECK(section_of(d.blade.line).GJ == 1e7);
    check_refused([] { (void)turbines::with_tower_rigidity(teetered_description(), 0); }, {"rigidity = 0", "> 0"});
}

namespace {

// The data set in a folder of its own, with one piece of text replaced.
std::string message_with(const std::string& old_text, const std::string& new_text) {
    const test::Folder folder;
    std::string all = test::bytes_of(std::string(CARDAN_SOURCE_DIR) + "/turbines/data/teetered.csv");
    const std::size_t at = all.find(old_text);
    REQUIRE(at != std::string::npos);
    all.replace(at, old_text.size(), new_text);
    std::ofstream(folder / "teetered.csv", std::ios::binary) << all;
    return message_of([&] { (void)assemble(teetered_description(folder.path), turbines::teetered_paper_assembly(1)); });
}

template <class Change>
void check_machine_refused(Change change, std::initializer_list<std::string> parts) {
    check_refused(
        [&] {
            TurbineDescription d = teetered_description();
            AssemblyOptions options = turbines::teetered_paper_assembly(1);
            change(d, options);
            (void)assemble(d, options);
        },
        parts);
}
using D = TurbineDescription;
using O = AssemblyOptions;

}  // namespace

TEST_CASE("teetered machine: data in a folder are read, and errors say where and what", "[property]") {
    CHECK(message_with("l_b", "L_b") == "nothing was thrown");
    CHECK_THAT(message_with("blade_length,m,8.42", "blade_length,m,long"),
               Contains("teetered.csv:") && Contains("'long' is not a number"));
    CHECK_THAT(message_with("undersling,", "under_sling,"), Contains("'undersling'"));
    CHECK_THAT(message_with("nacelle_mass,kg", "nacelle_mass,t"), Contains("unit kg expected, t found"));
    CHECK_THAT(message_with("50/5/50", "50/5"), Contains("hub_inertia_teeter_shaft_spanwise") &&
                                                    Contains("number of values = 2; allowed: 3, separated by /"));
    CHECK_THAT(message_with("blade_torsion_stiffness,N m^2,1.0e7", "blade_torsion_stiffness,N m^2,0"),
               Contains("blade, station 1 (x = 0 m): GJ [N m^2] = 0; allowed: > 0"));
    CHECK_THROWS_AS(teetered_description("no/such/folder"), FileError);
}

TEST_CASE("teetered machine: bad descriptions and options are refused with the value and what is allowed",
          "[property]") {
    check_machine_refused([](D& d, O&) { d.rotor_speed = not_a_number; }, {"teetered", "rotor speed [rad/s] = nan"});
    check_machine_refused([](D& d, O&) { d.nacelle.overhang = not_a_number; }, {"overhang [m] = nan"});
    check_machine_refused([](D& d, O&) { d.nacelle.shaft_height = not_a_number; }, {"shaft height [m] = nan"});
    check_machine_refused([](D& d, O&) { d.hub.teeter->undersling = not_a_number; }, {"undersling [m] = nan"});
    check_machine_refused([](D& d, O&) { d.hub.radius = -1; }, {"hub radius [m] = -1", ">= 0"});
    check_machine_refused([](D& d, O&) { d.hub.teeter->delta3 = 30; }, {"hub.teeter.delta3 [rad] = 30", "degrees?"});
    check_machine_refused([](D& d, O&) { d.blade.cone = 2; }, {"blade.cone [rad] = 2", "`unusual`"});
    check_machine_refused([](D& d, O&) { d.nacelle.tilt = not_a_number; }, {"nacelle.tilt [rad] = nan"});
    check_machine_refused([](D& d, O&) { d.hub.teeter->bearing = {-1}; },
                          {"hub.teeter.stiffness [N m/rad] = -1", "free_joint"});
    check_machine_refused([](D& d, O&) { d.yaw.rotation.damping = -1; }, {"yaw.rotation.damping [N m s/rad] = -1"});
    check_machine_refused([](D& d, O&) { d.nacelle.inertia.mass = -6900; }, {"nacelle", "mass [kg] = -6900"});
    check_machine_refused([](D& d, O&) { d.hub.inertia.J = Vec3(1, 1, 5).asDiagonal(); }, {"hub", "inertia"});
    check_machine_refused([](D& d, O&) { d.tower.line.length = 0; }, {"tower", "length [m] = 0"});
    check_machine_refused([](D& d, O&) { d.tower.line.length = -27, d.tower.rigid = true; },
                          {"tower", "length [m] = -27"});
    check_machine_refused([](D& d, O&) { change_section(d.blade.line, [](EngineeringSection& s) { s.EI_flap = 0; }); },
                          {"blade", "EI flap [N m^2] = 0"});
    check_machine_refused([](D&, O& o) { o.blade_beam->extension = true; }, {"blade", "extension"});
    check_machine_refused([](D&, O& o) { o.tower_beam->elements = 0; }, {"tower", "number of elements = 0", ">= 1"});
    check_machine_refused([](D&, O& o) { o.blade_beam->elements = 2000; }, {"blade", "number of elements = 2000"});
    check_machine_refused([](D&, O& o) { o.blade_beam->delta = 0.5; }, {"blade", "delta = 0.5"});
    check_machine_refused([](D&, O& o) { o.gravity = Vec3(not_a_number, 0, 0); }, {"gravity", "nan"});
    check_machine_refused(
        [](D& d, O&) {
            d.nacelle.inertia.J.setZero(), d.nacelle.inertia.mass = 0;
            change_section(d.blade.line, [](EngineeringSection& s) { s.mass = 0; });
        },
        {"metric"});
}
