// The whole NREL 5 MW machine: masses and places, what is in it and what is not, hand computations.
#include "tests/turbines/reference_turbines/nrel5mw/test_nrel5mw_machine.hpp"

#include "mbs/base/decompositions.hpp"
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/reference_turbines/nrel5mw_shapes.hpp"
#include "turbines/reference_turbines/wt600.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

#include <fstream>

using namespace cardan;
using namespace cardan::testing;
using turbines::Nrel5mwVariant;

namespace {

// int mu r^n dr of the blade's table, exact for a piecewise linear mass: Gauss-Legendre with 3 points.
double blade_moment(int n) {
    const auto r = table("blade").column("radius_from_rotor_apex", "m"), mu = table("blade").column("mass_per_length");
    const double g = std::sqrt(0.6);
    double sum = 0;
    for (std::size_t i = 1; i < r.size(); ++i)
        for (const auto& [at, weight] : {std::pair(-g, 5.0 / 18), std::pair(0.0, 8.0 / 18), std::pair(g, 5.0 / 18)}) {
            const double t = (1 + at) / 2;
            sum += weight * (r[i] - r[i - 1]) * (mu[i - 1] + t * (mu[i] - mu[i - 1])) *
                   std::pow(r[i - 1] + t * (r[i] - r[i - 1]), n);
        }
    return 1.04536 * sum;
}

}  // namespace

TEST_CASE("NREL 5 MW machine: masses are those of the report", "[published]") {
    const turbines::Turbine machine = turbines::nrel5mw();
    // Published: tower 347460 kg with its centre at 38.234 m [Table 6-1 and its text]; rotor 110000 kg [Table 1-1]. The
    // piecewise linear blades have 17608.83 kg instead of 17740 kg each.
    CHECK(machine.layout().tower->mass == Approx(347460).margin(0.5));
    for (const CardanBeam& blade : machine.layout().blades) CHECK(blade.mass == Approx(17608.83).margin(0.005));
    CHECK(3 * 17608.83 + 56780 == Approx(110000).epsilon(0.004));
    double sum = 0;
    for (const Tree::Piece& piece : machine.tree().pieces()) sum += piece.inertia.mass;
    CHECK(sum == Approx(347460.23 + 240000 + 56780 + 3 * 17608.83).margin(0.03));
    const auto h = table("tower").column("height_above_ground", "m"), mu = table("tower").column("mass_per_length");
    double moment = 0;
    for (std::size_t i = 1; i < h.size(); ++i)
        moment += (h[i] - h[i - 1]) * (mu[i - 1] * (2 * h[i - 1] + h[i]) + mu[i] * (h[i - 1] + 2 * h[i])) / 6;
    // The report's value stands 0.15 % above the integral of its piecewise linear table.
    CHECK(moment / machine.layout().tower->mass == Approx(38.234).epsilon(0.002));
}

TEST_CASE("NREL 5 MW machine: inertia and mass of the rotor are those of OpenFAST's ElastoDyn", "[discrete]") {
    // 38677040.613 kg m^2, 109389.842 kg with its 17 stations per blade: summary file of 5MW_Land_DLL_WTurb, r-test.
    const turbines::Turbine machine = turbines::nrel5mw(Nrel5mwVariant::fast);
    const int twist = machine.system().model.index("main shaft twist");
    CHECK(metric_at_rest(machine.system())(twist, twist) == Approx(38677040.613).epsilon(0.004));
    CHECK(56780 + 3 * machine.layout().blades[0].mass == Approx(109389.842).epsilon(0.003));
}

namespace {

// The clamped blade in ElastoDyn's three shapes: integrals over the length are sums over elements of equal length with
// the values at their middles, shapes are summed up from the curvatures there in the same way.
struct ElastodynBlade {
    double mass = 0, inertia = 0;  // about the apex
    Eigen::Matrix3d M = Eigen::Matrix3d::Zero(), K = M;

    Vec3 hz() const {
        const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> found(Matrix(K), Matrix(M), Eigen::EigenvaluesOnly);
        return found.eigenvalues().cwiseSqrt() / (2 * pi);
    }
};
ElastodynBlade elastodyn_blade(int elements) {
    const auto r = table("blade").column("radius_from_rotor_apex", "m"), mu = table("blade").column("mass_per_length"),
               flap = table("blade").column("flap_stiffness"), edge = table("blade").column("edge_stiffness"),
               twist = table("blade").column("structural_twist", "deg");
    const double L = 61.5, h = L / elements;
    ElastodynBlade b;
    Eigen::Matrix<double, 2, 3> slope_sum = Eigen::Matrix<double, 2, 3>::Zero(), sum = slope_sum;
    for (int k = 0; k < elements; ++k) {
        const double x = (k + 0.5) * h;
        std::size_t i = 1;
        while (i + 1 < r.size() && x > r[i] - 1.5) ++i;
        const double t = (x + 1.5 - r[i - 1]) / (r[i] - r[i - 1]);
        const auto here = [&](std::span<const double> y) { return y[i - 1] + t * (y[i] - y[i - 1]); };
        const double m = 1.04536 * here(mu) * h, angle = here(twist) * units::degree;
        Eigen::Matrix<double, 2, 3> curvature;  // out of and in the plane of rotation
        Vec3 own;                               // across the chord, across it, along it
        for (int s = 0; s < 3; ++s) {
            const auto& p = entry(turbines::elastodyn_blade_polynomials, s);
            own(s) = 0;
            for (std::size_t j = 0; j < p.size(); ++j) {
                const auto n = static_cast<double>(j + 2);
                own(s) += p.at(j) * n * (n - 1) * std::pow(x / L, n - 2) / (L * L);
            }
            const double c = std::cos(angle), d = std::sin(angle);
            curvature.col(s) = own(s) * (s < 2 ? Eigen::Vector2d(c, -d) : Eigen::Vector2d(d, c));
        }
        const Eigen::Matrix<double, 2, 3> slope = slope_sum + h / 2 * curvature, shape = sum + h / 2 * slope;
        slope_sum += h * curvature;
        sum += h * slope;
        b.mass += m;
        b.inertia += m * (x + 1.5) * (x + 1.5);
        b.M += m * shape.transpose() * shape;
        const Eigen::Vector2d across = own.head<2>();
        b.K.topLeftCorner<2, 2>() += here(flap) * h * across * across.transpose();
        b.K(2, 2) += here(edge) * h * own(2) * own(2);
    }
    return b;
}

solvers::SecondOrderSystem linearised_at_rest(const System& system) {
    const Vector zero = Vector::Zero(system.model.size());
    return solvers::restrict_to(solvers::linearise(system, at_rest(zero)), system.model.coordinates().free());
}

// Those three shapes on Cardan's elements.
Vec3 limited_blade(int elements) {
    const turbines::TurbineDescription d =
        turbines::nrel5mw_description(turbines::nrel5mw_options(Nrel5mwVariant::fast));
    const turbines::Turbine blade = turbines::isolated_blade(d, undamped(Nrel5mwVariant::fast, elements, 1));
    const Model& model = blade.system().model;
    const solvers::SecondOrderSystem whole = linearised_at_rest(blade.system());
    const CardanBeam& beam = blade.layout().blades[0];
    const Matrix shapes = turbines::elastodyn_blade_shapes(beam);
    REQUIRE(whole.M.rows() == model.size());
    Matrix R = Matrix::Zero(model.size(), 3);
    Eigen::Index at = 0;
    for (const CardanBeam::Element& element : beam.elements)
        for (const BodyId body : element.bodies) R.row(model.index(body)) = shapes.row(at++);
    ElastodynBlade b;
    b.M = R.transpose() * whole.M * R, b.K = R.transpose() * whole.K * R;
    return b.hz();
}

}  // namespace

TEST_CASE(
    "NREL 5 MW machine: ElastoDyn's sums over 17 elements make its blades softer than integrals of the same shapes",
    "[discrete]") {
    const ElastodynBlade sums = elastodyn_blade(17);
    // 109389.842 kg and 38677040.613 kg m^2 in its summary file, hub included, cone 2.5 deg: these are its elements.
    CHECK(56780 + 3 * sums.mass == Approx(109389.842).margin(1e-3));
    CHECK(115926 + 3 * sums.inertia * std::pow(std::cos(2.5 * units::degree), 2) == Approx(38677040.613).margin(1e-3));
    const Vec3 integrals = elastodyn_blade(20000).hz();
    const Vec3 change = 100 * (sums.hz().cwiseQuotient(integrals).array() - 1);
    CAPTURE(integrals.transpose(), change.transpose());
    CHECK(change(0) == Approx(-1.62).margin(0.01));  // first flap, first edge, second flap; %
    CHECK(change(1) == Approx(-1.23).margin(0.01));
    CHECK(change(2) == Approx(-0.62).margin(0.01));
    // Against the same shapes on 16 elements, which docs/nrel5mw.md has beside ElastoDyn.
    const Vec3 of_limited = 100 * (sums.hz().cwiseQuotient(limited_blade(16)).array() - 1);
    CAPTURE(of_limited.transpose());
    CHECK(of_limited(0) == Approx(-1.39).margin(0.01));
    CHECK(of_limited(1) == Approx(-0.81).margin(0.01));
    CHECK(of_limited(2) == Approx(-0.53).margin(0.01));
}

TEST_CASE("NREL 5 MW machine: hub 90 m above ground and 5 m upwind, tips upwind of the rotor plane", "[published]") {
    // NREL/TP-500-38060, table 1-1.
    const turbines::Turbine machine = turbines::nrel5mw();
    const Model& model = machine.system().model;
    Workspace workspace(model);
    const Kinematics kin = kinematics(model, Vector::Zero(model.size()), workspace);
    const Pose<double> hub = pose(kin, machine.layout().hub);
    CHECK(hub.p.x() == Approx(-5).margin(2e-4));
    CHECK(std::abs(hub.p.y()) < 1e-12);
    CHECK(hub.p.z() == Approx(90).margin(1e-4));
    // 5 degrees of tilt, blade 1 up: leaning back by 5, forward by 2.5 degrees of cone.
    const double lean = (5 - 2.5) * units::degree;
    const Vec3 tip = pose(kin, machine.layout().blades[0].tip()).p - hub.p;
    CHECK((tip - 63 * Vec3(std::sin(lean), 0, std::cos(lean))).norm() < 1e-12 * 63);
    for (const CardanBeam& blade : machine.layout().blades) {
        const Vec3 in_hub = hub.R.transpose() * (pose(kin, blade.tip()).p - hub.p);
        CHECK(in_hub.z() == Approx(-63 * std::sin(2.5 * units::degree)).epsilon(1e-12));
    }
}

TEST_CASE("NREL 5 MW machine: coordinates that it does not have are left out", "[property]") {
    const turbines::Turbine report = turbines::nrel5mw(Nrel5mwVariant::report, 8, 6);
    // Tower 6 x 5, yaw, generator, shaft, blades 3 x 8 x 6.
    CHECK(report.system().model.size() == 30 + 3 + 144);
    CHECK(turbines::nrel5mw(Nrel5mwVariant::fast, 8, 6).system().model.size() == 24 + 3 + 96);
    CHECK(turbines::nrel5mw(Nrel5mwVariant::beamdyn, 8, 6).system().model.size() == 24 + 3 + 144);
    const auto joints = report.system().model.coordinates().of_part("drive train");
    CHECK(joints.size() == 2);
    CHECK(report.system().model.coordinates().of_part("tilt").empty());
    CHECK(report.system().model.coordinates().of_part("pitch").empty());
    CHECK(report.layout().pitch.empty());
    turbines::Nrel5mwOptions with_actuator;
    with_actuator.pitch_actuator = true;
    const turbines::Turbine soft =
        turbines::assemble(turbines::nrel5mw_description(with_actuator), turbines::nrel5mw_assembly());
    CHECK(soft.layout().pitch.size() == 3);
    CHECK(soft.system().model.size() == report.system().model.size() + 3);
    for (const char* said : {"blades of 8 elements", "extension free", "tower of 6 elements", "FAST"})
        CHECK(report.rotor().description.find(said) != std::string::npos);
}

TEST_CASE("NREL 5 MW machine: inertia of the rotor about its shaft, torsion of the drive train and yaw, by hand",
          "[analytic]") {
    turbines::TurbineDescription d =
        almost_rigid(turbines::nrel5mw_description(turbines::nrel5mw_options(Nrel5mwVariant::fast)));
    const turbines::Turbine machine = turbines::assemble(d, undamped(Nrel5mwVariant::fast, 2, 2));
    const double cone = 2.5 * units::degree, tilt = 5 * units::degree;
    const double m1 = blade_moment(1), m2 = blade_moment(2), m0 = blade_moment(0);
    // Blade k: points apex + r u_k. Kinetic energy of yaw rate a and shaft rate b, velocities a ez x p + b es x (r u).
    const Vec3 shaft(std::cos(tilt), 0, -std::sin(tilt)), up(std::sin(tilt), 0, std::cos(tilt));
    const Vec3 apex = Vec3(0, 0, 1.96256) - 5.0191 * shaft, lateral = cross<double>(shaft, up), z = Vec3::UnitZ();
    double yaw = 2607890 + 56780 * apex.x() * apex.x() + 115926 * std::pow(z.dot(shaft), 2),
           both = 115926 * z.dot(shaft), spin = 115926;
    for (int k = 0; k < 3; ++k) {
        const double psi = 2 * pi * k / 3;
        const Vec3 u = std::cos(cone) * (std::cos(psi) * up + std::sin(psi) * lateral) - std::sin(cone) * shaft;
        const Vec3 a0 = cross<double>(z, apex), a1 = cross<double>(z, u), b1 = cross<double>(shaft, u);
        yaw += m0 * a0.dot(a0) + 2 * m1 * a0.dot(a1) + m2 * a1.dot(a1);
        both += m1 * a0.dot(b1) + m2 * a1.dot(b1);
        spin += m2 * b1.dot(b1);
    }
    const Matrix g = metric_at_rest(machine.system());
    const int yaw_at = machine.system().model.index("yaw"), twist = machine.system().model.index("main shaft twist");
    CHECK(g(yaw_at, yaw_at) == Approx(yaw).epsilon(1e-12));
    CHECK(g(twist, twist) == Approx(spin).epsilon(1e-12));
    CHECK(g(yaw_at, twist) == Approx(both).epsilon(1e-10));
    const double generator = 534.116 * 97 * 97;
    CHECK(g(twist - 1, twist - 1) == Approx(spin + generator).epsilon(1e-12));

    // Two coordinates on springs; tower and blades at a millionth of their flexibility take 1e-5 off.
    const double k_yaw = 9028320000, k_shaft = 867637000;
    const auto pair = [&](double J_spin, double J_both) {
        const double a = k_yaw * J_spin + k_shaft * yaw, det = yaw * J_spin - J_both * J_both;
        const double root = std::sqrt(a * a - 4 * det * k_yaw * k_shaft);
        return std::array{std::sqrt((a - root) / (2 * det)) / (2 * pi), std::sqrt((a + root) / (2 * det)) / (2 * pi)};
    };
    const solvers::Campbell locked = diagram(machine, {0});
    CHECK(hz(locked, "drive-train torsion") == Approx(pair(spin, both)[0]).epsilon(2e-5));
    CHECK(hz(locked, "rotor yaw") == Approx(pair(spin, both)[1]).epsilon(1e-4));
    // Free: generator against rotor. The rigid rotation takes out J J^T / J.
    const double J = spin + generator, r = spin - spin * spin / J, b = both - both * spin / J,
                 yaw_left = yaw - both * both / J;
    const double a = k_yaw * r + k_shaft * yaw_left, det = yaw_left * r - b * b;
    const double expected = std::sqrt((a + std::sqrt(a * a - 4 * det * k_yaw * k_shaft)) / (2 * det)) / (2 * pi);
    const solvers::Campbell free = diagram(machine, {0}, solvers::RotorSpin::free);
    const double found = std::max(hz(free, "drive-train torsion"), hz(free, "rotor yaw"));
    CHECK(found == Approx(expected).epsilon(1e-4));
}

TEST_CASE("NREL 5 MW machine: damping ratios of the clamped blade and the bare tower are those of the report",
          "[analytic]") {
    const turbines::TurbineDescription d = turbines::nrel5mw_description();
    const turbines::Turbine blade = turbines::isolated_blade(d, turbines::nrel5mw_assembly());
    const solvers::Campbell alone = diagram(blade, {0});
    REQUIRE(alone.points[0].modes.size() > 6);
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(alone.points[0].modes[i].mode.damping_ratio() == Approx(0.00477465).epsilon(1e-8));
    CHECK(alone.points[0].modes[6].mode.damping_ratio() > 0.00477466);
    const turbines::Turbine tower = turbines::isolated_tower(d, turbines::nrel5mw_assembly());
    solvers::CampbellOptions options;
    options.max_frequency_hz = 13;
    const std::array standstill{0.0};
    const solvers::Campbell bare = solvers::campbell(tower.system(), tower.rotor(), standstill, options);
    for (const char* mode : {"1st tower fore-aft", "2nd tower fore-aft", "1st tower side-side", "2nd tower side-side",
                             "1st tower torsion"})
        CHECK(bare.damping_ratio(bare.branch(mode), 0) == Approx(0.01).epsilon(1e-6));
    // In the machine the tower moves slower and takes its share of the damping along: zeta = 1 % f / f_bare nearly.
    const solvers::Campbell whole = diagram(turbines::nrel5mw(), {0});
    const double ratio = whole.damping_ratio(whole.branch("1st tower fore-aft"), 0);
    CHECK(ratio == Approx(0.01 * hz(whole, "1st tower fore-aft") / 0.8837).epsilon(0.1));
}

TEST_CASE(
    "NREL 5 MW machine: damping of the tower's torsion is that of the report alone, other variants do not know it",
    "[property]") {
    for (const Nrel5mwVariant variant : {Nrel5mwVariant::report, Nrel5mwVariant::fast}) {
        turbines::TurbineDescription d = turbines::nrel5mw_description(turbines::nrel5mw_options(variant));
        const turbines::AssemblyOptions elements = turbines::nrel5mw_assembly(variant, 1, 3);
        const auto damping = [&] {
            const turbines::Turbine tower = turbines::isolated_tower(d, elements, true);
            return linearised_at_rest(tower.system()).C;
        };
        const Matrix with = damping();
        d.tower.damping.modal.torsion.clear();
        if (variant == Nrel5mwVariant::fast)
            CHECK(with == damping());
        else
            CHECK((with - damping()).norm() > 1e-4 * with.norm());
    }
}

TEST_CASE("NREL 5 MW machine: multi-blade matrices are the same at every azimuth", "[property]") {
    const turbines::Turbine machine =
        turbines::assemble(turbines::nrel5mw_description(), undamped(Nrel5mwVariant::report, 2, 2));
    const double speed = 12.1 * rpm;
    solvers::SteadyOptions options;
    options.rotor_speed = speed;
    DynamicState at = solvers::steady_state(machine.system(), machine.rotor().spin, options).at;
    const std::vector<int> free = machine.system().model.coordinates().free();
    const solvers::ColemanTransform coleman(machine.rotor(), free);
    const auto transformed = [&](double azimuth) {
        at.q(machine.rotor().spin) = azimuth;
        return coleman.transform(solvers::restrict_to(solvers::linearise(machine.system(), at), free), azimuth, speed);
    };
    const auto a = transformed(0.3), b = transformed(1.7);
    CHECK((a.M - b.M).norm() < 1e-9 * a.M.norm());
    CHECK((a.C - b.C).norm() < 1e-9 * a.C.norm());
    CHECK((a.K - b.K).norm() < 1e-9 * a.K.norm());
}

TEST_CASE("NREL 5 MW machine: with its blades twisted the other way it is its mirror image, at rest the same",
          "[property]") {
    const turbines::Turbine machine =
        turbines::assemble(turbines::nrel5mw_description(), undamped(Nrel5mwVariant::report, 2, 2));
    turbines::TurbineDescription d = turbines::nrel5mw_description();
    const Mat6 flip = (Vec6() << 1, -1, 1, -1, 1, -1).finished().asDiagonal();
    d.blade.line.section = [own = d.blade.line.section, flip](double x) {
        BeamSection s = own(x);
        s.compliance = flip * s.compliance * flip;
        s.centre.y() *= -1;
        s.J(1, 2) = s.J(2, 1) *= -1;
        s.beta *= -1;
        return s;
    };
    const turbines::Turbine mirrored = turbines::assemble(d, undamped(Nrel5mwVariant::report, 2, 2));
    const solvers::Campbell one = diagram(machine, {0}), other = diagram(mirrored, {0});
    REQUIRE(one.points[0].modes.size() == other.points[0].modes.size());
    for (std::size_t i = 0; i < one.points[0].modes.size(); ++i)
        CHECK(one.points[0].modes[i].mode.natural_hz() ==
              Approx(other.points[0].modes[i].mode.natural_hz()).epsilon(1e-9));
}

TEST_CASE("NREL 5 MW machine: data in a folder give the same machine, bad data are named", "[property]") {
    const test::Folder folder;
    for (const char* name : {"nrel5mw_blade.csv", "nrel5mw_tower.csv", "nrel5mw_turbine.csv"})
        std::filesystem::copy_file(std::string(CARDAN_SOURCE_DIR) + "/turbines/data/" + name, folder / name);
    const auto options = undamped(Nrel5mwVariant::report, 1, 1);
    const auto copy = turbines::nrel5mw_description(folder.path);
    CHECK(copy.source == turbines::nrel5mw_description().source);
    CHECK(metric_at_rest(turbines::assemble(copy, options).system()) ==
          metric_at_rest(turbines::assemble(turbines::nrel5mw_description(), options).system()));
    std::filesystem::remove(folder / "nrel5mw_tower.csv");
    CHECK_THROWS_AS(turbines::nrel5mw_description(folder.path), FileError);
    check_refused([] { (void)turbines::nrel5mw_assembly(Nrel5mwVariant::report, 0); },
                  {"NREL 5 MW blade", "number of elements = 0", "1 ... 1000"});
    check_refused([] { (void)turbines::nrel5mw_assembly(Nrel5mwVariant::report, 1001); }, {"1001"});
    turbines::Nrel5mwOptions bad;
    bad.blade.mass_factor = -1;
    check_refused([&] { (void)turbines::nrel5mw_description(bad); }, {"mass factor = -1"});
}

TEST_CASE("NREL 5 MW blade: element ends of any number lie between those of the refined eight", "[property]") {
    CHECK(turbines::nrel5mw_blade_ends(8) == turbines::nrel5mw_blade_refined().boundaries);
    for (int n : {1, 3, 16, 50}) {
        const auto ends = turbines::nrel5mw_blade_ends(n);
        REQUIRE(ends.size() == static_cast<std::size_t>(n) + 1);
        CHECK(ends.front() == 0);
        CHECK(ends.back() == 61.5);
        CHECK(std::is_sorted(ends.begin(), ends.end(), std::less_equal<>()));
    }
}
