// What the assembly of a turbine may be asked for: elements, blades, generator, damping, gravity.
#include "mbs/base/entry.hpp"
#include "mbs/base/units.hpp"
#include "mbs/model/summary.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

turbines::Turbine with_blades(int blades) {
    turbines::TurbineDescription d = turbines::wt600_description();
    d.blades = blades;
    return turbines::assemble(d, undamped());
}

solvers::SecondOrderSystem in_fixed_frame(const turbines::Turbine& machine, double azimuth, double rotor_speed) {
    solvers::SteadyOptions options;
    options.rotor_speed = rotor_speed;
    DynamicState at = solvers::steady_state(machine.system(), machine.rotor().spin, options).at;
    at.q(machine.rotor().spin) = azimuth;
    const std::vector<int> free = machine.system().model.coordinates().free();
    const solvers::ColemanTransform coleman(machine.rotor(), free);
    return coleman.transform(solvers::restrict_to(solvers::linearise(machine.system(), at), free), azimuth,
                             rotor_speed);
}

}  // namespace

TEST_CASE("assembly: the number of elements of tower and blades is free, and more of them converge", "[property]") {
    for (int tower : {1, 2, 5})
        for (int blade : {1, 4}) {
            turbines::AssemblyOptions options = undamped();
            options.tower_elements = tower;
            options.blade_elements = blade;
            const turbines::Turbine machine = turbines::wt600(options);
            CHECK(machine.system().model.size() == 5 * tower + 7 + 3 * (1 + 5 * blade));
        }
    const std::vector<double> fine = frequencies(turbines::wt600(undamped(12)), 0);
    const auto error = [&](int elements) {
        const std::vector<double> f = frequencies(turbines::wt600(undamped(elements)), 0);
        double largest = 0;  // of the ten lowest modes
        for (std::size_t i = 0; i < 10; ++i) largest = std::max(largest, std::abs(f.at(i) / fine[i] - 1));
        return largest;
    };
    const double e2 = error(2), e3 = error(3), e4 = error(4), e6 = error(6);
    CHECK(e3 < e2 / 4);
    CHECK(e4 < e3 / 2);
    CHECK(e6 < e4 / 3);
    CHECK(e6 < 1e-3);
}

TEST_CASE(
    "assembly: mass and centre of mass do not depend on the number of elements, delta or the partition's segments",
    "[property]") {
    const auto moments = [](const turbines::AssemblyOptions& options) {
        const turbines::Turbine machine = turbines::wt600(options);
        const Model& model = machine.system().model;
        Workspace workspace(model);
        const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
        Eigen::Vector4d sum = Eigen::Vector4d::Zero();
        for (const Tree::Piece& piece : machine.tree().pieces()) {
            const FrameId frame = piece.body < 0 ? Tree::base() : machine.tree().frame_of(BodyId{piece.body});
            const Pose<double> at = pose(kin, frame);
            sum(0) += piece.inertia.mass;
            sum.tail<3>() += piece.inertia.mass * (at.R * piece.inertia.com + at.p);
        }
        return sum;
    };
    const Eigen::Vector4d expected = moments(undamped());
    CHECK(expected(0) == Approx(60492.2 + 26000 + 7500 + 3 * 1970).epsilon(1e-5));
    for (int elements : {1, 2, 7}) {
        turbines::AssemblyOptions options = undamped(elements);
        options.delta = 0.17;
        CHECK((moments(options) - expected).norm() < 1e-11 * expected.norm());
    }
}

TEST_CASE("assembly: blades have corresponding coordinates, one blade after the other", "[property]") {
    const turbines::Turbine machine = with_blades(4);
    const CoordinateTable& table = machine.system().model.coordinates();
    REQUIRE(machine.rotor().blades.size() == 4);
    for (int k = 0; k < 4; ++k)
        for (std::size_t i = 0; i < machine.rotor().blades[0].size(); ++i) {
            const std::string first = table[machine.rotor().blades[0][i]].name,
                              own = table[entry(machine.rotor().blades, k)[i]].name;
            CHECK(own == text("blade ", k + 1, first.substr(std::string("blade 1").size())));
        }
}

TEST_CASE("assembly: with 3, 4 and 5 blades the Coleman-transformed matrices are the same at every azimuth",
          "[property]") {
    for (int blades : {3, 4, 5}) {
        INFO(blades << " blades");
        const turbines::Turbine machine = with_blades(blades);
        const auto a = in_fixed_frame(machine, 0.3, 27 * rpm), b = in_fixed_frame(machine, 1.7, 27 * rpm);
        CHECK((a.M - b.M).norm() < 1e-9 * a.M.norm());
        CHECK((a.C - b.C).norm() < 1e-9 * a.C.norm());
        CHECK((a.K - b.K).norm() < 1e-9 * a.K.norm());
        CHECK((a.K_elastic - b.K_elastic).norm() < 1e-9 * a.K.norm());
        // Not so the blade coordinates themselves.
        const std::vector<int> free = machine.system().model.coordinates().free();
        const solvers::ColemanTransform coleman(machine.rotor(), free);
        const Matrix T = coleman.matrix(0.3), U = coleman.matrix(1.7);
        CHECK((T * a.M * T.transpose() - U * b.M * U.transpose()).norm() > 1e-3 * a.M.norm());
    }
}

TEST_CASE("assembly: in the differential modes of four blades the hub stands still: they are those of the single blade",
          "[analytic]") {
    const turbines::Turbine machine = with_blades(4);
    // On the same pitch spring: the hub's other degrees of freedom are out of reach of a pattern + - + -.
    turbines::TurbineDescription d = turbines::wt600_description();
    d.blade.pitch.stiffness *= 1e6;
    const turbines::Turbine clamped = turbines::isolated_blade(d, undamped());
    for (double speed : {0.0, 27 * rpm}) {
        const double one[] = {speed};
        const auto diagram = solvers::campbell(machine.system(), machine.rotor(), one);
        const std::vector<double> blade = frequencies(clamped, speed);
        const auto found = [&](const char* name) { return diagram.natural_hz(diagram.branch(name), 0); };
        // The pitch spring (60 Hz on a rigid blade) makes a difference of 1e-5.
        CHECK(found("1st blade flap (differential)") == Approx(blade.at(0)).epsilon(1e-5));
        CHECK(found("1st blade edge (differential)") == Approx(blade.at(1)).epsilon(1e-5));
        CHECK(found("2nd blade flap (differential)") == Approx(blade.at(2)).epsilon(5e-5));
    }
}

TEST_CASE(
    "assembly: the patterns of five blades that leave the hub at rest come out 2 Omega above and below the blade's",
    "[analytic]") {
    const turbines::Turbine machine = with_blades(5);
    const turbines::Turbine blade = turbines::isolated_blade(turbines::wt600_description(), undamped());
    const double own = frequencies(blade, 27 * rpm).at(0), shift = 2 * 27 / units::minute;
    const std::vector<double> f = frequencies(machine, 27 * rpm);
    for (double expected : {own - shift, own + shift})
        CHECK(std::any_of(f.begin(), f.end(), [&](double x) { return std::abs(x - expected) < 2e-5; }));
}

TEST_CASE("assembly: locking the generator takes one unknown away; frequencies at rest interlace with the free ones",
          "[property]") {
    const turbines::Turbine machine = turbines::wt600(undamped());
    solvers::CampbellOptions locked;
    locked.spin = solvers::RotorSpin::prescribed;
    const double at_rest[] = {0};
    const auto with_free = solvers::campbell(machine.system(), machine.rotor(), at_rest);
    const auto with_locked = solvers::campbell(machine.system(), machine.rotor(), at_rest, locked);
    CHECK(with_free.unknowns.size() == 70);
    CHECK(with_locked.unknowns.size() == 69);
    // One constraint (Rayleigh): 0 = f_0 <= l_1 <= f_1 <= l_2 ...
    const std::vector<double> f = frequencies(machine, 0), l = frequencies(machine, 0, locked);
    for (std::size_t i = 0; i < f.size(); ++i) {
        CHECK(l.at(i) <= f[i] * (1 + 1e-9));
        if (i > 0) CHECK(l.at(i) >= f[i - 1] * (1 - 1e-9));
    }
    CHECK(f[2] - l[3] < -0.01);  // a mode of the locked machine between the free one's: drive train against the rotor
    CHECK(l[3] < f[3] - 0.03);
}

TEST_CASE("assembly: tower and blades are damped to the ratio given for their first mode, more the higher the mode",
          "[analytic]") {
    // Stiffness proportional: ratio zeta f / f_1.
    const turbines::TurbineDescription d = turbines::wt600_description();
    const turbines::Turbine blade = turbines::isolated_blade(d, turbines::wt600_paper_assembly());
    const double at_rest[] = {0};
    const auto diagram = solvers::campbell(blade.system(), blade.rotor(), at_rest);
    const double f1 = diagram.points[0].modes[0].mode.natural_hz();
    for (const solvers::CampbellMode& mode : diagram.points[0].modes)
        CHECK(mode.mode.damping_ratio() == Approx(0.005 * mode.mode.natural_hz() / f1).epsilon(1e-9));
    // The tower with everything on it but rigid joints and blades: a ratio of 0.005 again.
    turbines::TurbineDescription rigid = d;
    for (turbines::JointSupport* spring : {&rigid.yaw.rotation, &rigid.nacelle.tilt_bearing, &rigid.blade.pitch,
                                           &rigid.drive_train.main_shaft, &rigid.drive_train.high_speed_shaft})
        *spring = {1e4 * spring->stiffness, 0};
    rigid.yaw.translation = {1e4 * rigid.yaw.translation.stiffness, 0};
    rigid.blade.line.section = [own = d.blade.line.section](double x) {
        BeamSection s = own(x);
        s.compliance /= 1e4;
        return s;
    };
    const turbines::Turbine on_tower = turbines::assemble(rigid, turbines::wt600_paper_assembly());
    solvers::CampbellOptions locked;
    locked.spin = solvers::RotorSpin::prescribed;
    const auto tower = solvers::campbell(on_tower.system(), on_tower.rotor(), at_rest, locked);
    CHECK(tower.points[0].modes[0].mode.damping_ratio() == Approx(0.005).epsilon(1e-3));
    CHECK(tower.points[0].modes[1].mode.damping_ratio() == Approx(0.005).epsilon(0.01));
}

TEST_CASE("assembly: without structural and joint damping there is none", "[property]") {
    const turbines::Turbine machine = turbines::wt600(undamped());
    const Vector zero = Vector::Zero(machine.system().model.size());
    CHECK(solvers::linearise(machine.system(), at_rest(zero)).damping.norm() == 0);
    turbines::AssemblyOptions joints = undamped(), structure = undamped();
    joints.joint_damping = true;
    structure.structural_damping = true;
    const auto damped = [&](const turbines::AssemblyOptions& options, const char* coordinate) {
        const turbines::Turbine own = turbines::wt600(options);
        const Matrix D = solvers::linearise(own.system(), at_rest(zero)).damping;
        const int i = own.system().model.index(coordinate);
        return D(i, i);
    };
    CHECK(damped(joints, "yaw") == 2e4);
    CHECK(damped(joints, "high-speed shaft twist") == 50 * 50 * 50);  // gear ratio squared
    CHECK(damped(joints, "blade 3 element 2 bending y1") == 0);
    CHECK(damped(structure, "yaw") == 0);
    CHECK(damped(structure, "blade 3 element 2 bending y1") > 0);
}

TEST_CASE("assembly: weight on the tower lowers its first frequencies, weight that pulls upward raises them",
          "[property]") {
    turbines::AssemblyOptions down = undamped(), up = undamped();
    down.gravity = Vec3(0, 0, -units::standard_gravity);
    up.gravity = Vec3(0, 0, units::standard_gravity);
    // Generator locked: blades that sag leave the free rotor a little stiffness (a motion at 2e-4 Hz).
    solvers::CampbellOptions locked;
    locked.spin = solvers::RotorSpin::prescribed;
    const std::vector<double> without = frequencies(turbines::wt600(undamped()), 0, locked),
                              hanging = frequencies(turbines::wt600(up), 0, locked),
                              standing = frequencies(turbines::wt600(down), 0, locked);
    for (std::size_t i : {0u, 1u}) {
        CHECK(standing.at(i) < 0.995 * without[i]);
        CHECK(hanging.at(i) > 1.005 * without[i]);
        CHECK(hanging.at(i) + standing.at(i) == Approx(2 * without[i]).epsilon(1e-3));
    }
}

TEST_CASE("assembly: a positive cone puts the blade tips downwind of the hub", "[analytic]") {
    turbines::TurbineDescription d = turbines::wt600_description();
    d.blade.cone = 0.04;
    const turbines::Turbine machine = turbines::assemble(d, undamped());
    const Model& model = machine.system().model;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
    const Pose<double> hub = pose(kin, machine.rotor().hub);
    for (int k : {1, 2, 3}) {
        const Vec3 tip = hub.R.transpose() * (pose(kin, model.frame(text("blade ", k, " node 3"))).p - hub.p);
        CHECK(tip.z() == Approx(21.5 * std::sin(0.04)).epsilon(1e-12));
        CHECK(tip.head<2>().norm() == Approx(21.5 * std::cos(0.04)).epsilon(1e-12));
    }
}

TEST_CASE("assembly: a turbine keeps the text of its data and gives its masses by part", "[property]") {
    const turbines::Turbine machine = turbines::wt600(turbines::wt600_paper_assembly());
    CHECK_THAT(machine.source(),
               Catch::Matchers::Contains("quantity,unit,value") && Catch::Matchers::Contains("span_fraction[-]"));
    for (const char* part : {"tower  ", "nacelle  ", "hub  ", "blade 3  ", "gearbox", "generator azimuth"})
        CHECK_THAT(machine.summary(), Catch::Matchers::Contains(part));
    CHECK(machine.warnings().empty());
}
