// The slip of the induction generator in linearised machines: the slope of its law, and drive-train torsion against a
// chain of three inertias written by hand, with the generator free, slipping and locked.
#include "mbs/base/decompositions.hpp"
#include "solvers/campbell/diagram.hpp"
#include "solvers/linear_models/model_reduction.hpp"
#include "solvers/linear_models/multi_blade_model.hpp"
#include "tests/oracles/root_finding.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"
#include "turbines/analysis/linear_model.hpp"
#include "turbines/model/generator_slip.hpp"
#include "turbines/reference_turbines/wt600_operation.hpp"

using namespace cardan;
using namespace cardan::testing;
using solvers::RotorSpin;

namespace {

constexpr double gear_ratio = 50;

// Generator - high-speed shaft - gearbox - main shaft - rigid rotor about the shaft, all on the slow side; numbers of
// wt600_turbine.csv. J x'' + C x' + K x = 0.
struct ThreeInertias {
    double rotor = 0, slip = 0;  // kg m^2; N m s/rad on the generator

    // Slowest oscillation: natural frequency in Hz and damping ratio. Locked: the generator stands.
    std::array<double, 2> torsion(bool locked) const {
        constexpr double squared = gear_ratio * gear_ratio;
        constexpr double k1 = 1.2e5 * squared, c1 = 50 * squared, k2 = 6e7, c2 = 1e5;
        Eigen::Matrix3d K, C;
        K << k1, -k1, 0, -k1, k1 + k2, -k2, 0, -k2, k2;
        C << c1 + slip, -c1, 0, -c1, c1 + c2, -c2, 0, -c2, c2;
        const Eigen::Vector3d J(20 * squared, 1500, rotor);
        const Eigen::Index first = locked ? 1 : 0, n = 3 - first;
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n);
        A.topRightCorner(n, n).setIdentity();
        const Eigen::MatrixXd inverse = J.tail(n).cwiseInverse().asDiagonal();
        A.bottomLeftCorner(n, n) = -inverse * K.bottomRightCorner(n, n);
        A.bottomRightCorner(n, n) = -inverse * C.bottomRightCorner(n, n);
        std::complex<double> slowest = 1e9;
        const Eigen::VectorXcd all = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
        for (const std::complex<double>& z : all)
            if (z.imag() > 1e-6 && std::abs(z) < std::abs(slowest)) slowest = z;
        return {std::abs(slowest) / (2 * pi), -slowest.real() / std::abs(slowest)};
    }
};

// The machine with nothing elastic but its shafts; and the inertia of its rotor about the shaft.
turbines::TurbineDescription stiff() {
    turbines::TurbineDescription d = turbines::wt600_description();
    for (BeamLine* line : {&d.tower.line, &d.blade.line})
        line->section = [own = line->section](double x) {
            BeamSection s = own(x);
            s.compliance /= 1e6;
            return s;
        };
    d.yaw.rotation = d.yaw.translation = d.nacelle.tilt_bearing = d.blade.pitch = turbines::rigid_joint;
    return d;
}
double rotor_inertia(const turbines::Turbine& machine) {
    const Model& model = machine.system().model;
    Workspace workspace(model);
    Matrix g(model.size(), model.size());
    metric(kinematics(model, Vector::Zero(model.size()), workspace), g);
    const int spin = machine.rotor().spin;
    return g(spin, spin) - 20 * gear_ratio * gear_ratio - 1500;
}

std::array<double, 2> slowest(const turbines::Turbine& machine, RotorSpin spin, double rotor_speed) {
    solvers::CampbellOptions options;
    options.spin = spin;
    const double speed[] = {rotor_speed};
    const auto diagram = solvers::campbell(machine.system(), machine.rotor(), speed, options);
    const solvers::Mode& mode = diagram.points[0].modes.at(0).mode;
    return {mode.natural_hz(), mode.damping_ratio()};
}

// Frequency and damping of the mode with most elastic energy in the shafts.
std::array<double, 2> torsion(const turbines::Turbine& machine, RotorSpin spin, double rotor_speed) {
    solvers::CampbellOptions options;
    options.spin = spin;
    const double speed[] = {rotor_speed};
    const auto d = solvers::campbell(machine.system(), machine.rotor(), speed, options);
    const solvers::CampbellMode* most = nullptr;
    double energy = 0;
    for (const solvers::CampbellMode& mode : d.points[0].modes) {
        const double here = share(d, mode, "drive-train torsion").collective;
        if (mode.mode.natural_hz() < 7 && here > energy) most = &mode, energy = here;
    }
    REQUIRE(most != nullptr);
    return {most->mode.natural_hz(), most->mode.damping_ratio()};
}

}  // namespace

TEST_CASE("generator slip: the damping is the slope of Kloss' curve on the slow side", "[analytic]") {
    const KlossCurve law = turbines::wt600_kloss_curve();
    // Synchronous: 2 T_b / (s_b w_s) times 50^2.
    CHECK(turbines::slip_damping(law, gear_ratio) == Approx(2500 * 2 * 9000 / (0.06 * 50 * pi)).epsilon(1e-13));
    CHECK(turbines::slip_damping(law, gear_ratio) == Approx(4.77e6).epsilon(2e-3));
    for (double torque : {-3000.0, 1000.0, 3820.0, 8000.0}) {
        const double synchronous = law.synchronous_speed;
        const double speed = oracles::bisect([&](double w) { return law.torque(w) - torque; }, 0.94001 * synchronous,
                                             1.05999 * synchronous);
        const double h = 1e-4, slope = (law.torque(speed + h) - law.torque(speed - h)) / (2 * h);
        CHECK(turbines::slip_damping(law, gear_ratio, torque) == Approx(2500 * slope).epsilon(1e-7));
    }
}

TEST_CASE("generator slip: drive-train torsion of an otherwise stiff machine is that of three inertias by hand",
          "[analytic]") {
    const turbines::Turbine free = turbines::assemble(stiff(), turbines::wt600_paper_assembly());
    const turbines::Turbine slipping = turbines::with_generator_slip(free, turbines::wt600_kloss_curve());
    ThreeInertias chain{rotor_inertia(free), 0};
    const double speed = turbines::wt600_rated_speed();
    const auto same = [](const std::array<double, 2>& a, const std::array<double, 2>& b) {
        CHECK(a[0] == Approx(b[0]).epsilon(1e-4));
        CHECK(a[1] == Approx(b[1]).epsilon(1e-3));
    };
    for (double rotor_speed : {0.0, speed}) {
        same(slowest(free, RotorSpin::free, rotor_speed), chain.torsion(false));
        same(slowest(free, RotorSpin::prescribed, rotor_speed), chain.torsion(true));
        same(slowest(slipping, RotorSpin::prescribed, rotor_speed), chain.torsion(true));
        ThreeInertias with = chain;
        with.slip = turbines::slip_damping(turbines::wt600_kloss_curve(), gear_ratio);
        same(slowest(slipping, RotorSpin::free, rotor_speed), with.torsion(false));
        CHECK(with.torsion(false)[1] > 0.4);
    }
}

TEST_CASE("generator slip: drive-train torsion of the machine falls from 4.51 to 1.44 Hz with 52 % of damping",
          "[discrete]") {
    // Numbers of another implementation, without other damping.
    const turbines::Turbine machine = turbines::wt600(undamped());
    const turbines::Turbine slipping = turbines::with_generator_slip(machine, turbines::wt600_kloss_curve());
    const auto free = torsion(machine, RotorSpin::free, 27 * rpm), slip = torsion(slipping, RotorSpin::free, 27 * rpm);
    CHECK(free[0] == Approx(4.51).margin(5e-3));
    CHECK(std::abs(free[1]) < 1e-9);
    CHECK(slip[0] == Approx(1.44).margin(5e-3));
    CHECK(slip[1] == Approx(0.52).margin(5e-3));
    CHECK_THAT(slipping.rotor().description, Catch::Matchers::StartsWith("slip of the generator: 4774648"));
}

TEST_CASE(
    "generator slip: the linear model has the torsion of the Campbell diagram, and of the states that are not stable "
    "the azimuth remains",
    "[crosscheck]") {
    const turbines::Turbine free = turbines::wt600(turbines::wt600_paper_assembly());
    const turbines::Turbine slipping = turbines::with_generator_slip(free, turbines::wt600_kloss_curve());
    const auto model = [](const turbines::Turbine& machine) {
        return solvers::multi_blade(
            turbines::linearised(machine, {.rotor_speed = 27 * rpm, .outputs = {"GenSpeed"}, .azimuths = 5},
                                 RotorSpin::free),
            machine.rotor());
    };
    const solvers::MultiBladeModel slips = model(slipping);
    const auto found = torsion(slipping, RotorSpin::free, 27 * rpm);
    CHECK(found[1] == Approx(0.515).margin(0.015));
    const std::vector<Complex> poles = slips.poles();
    CHECK(std::ranges::any_of(poles, [&](const Complex& pole) {
        return std::abs(std::abs(pole) / (2 * pi) - found[0]) < 1e-6 * found[0] &&
               std::abs(-pole.real() / std::abs(pole) - found[1]) < 1e-6;
    }));
    CHECK(solvers::balanced_truncation(slips, {.order = 16}).kept_as_is == 1);
    CHECK(solvers::balanced_truncation(model(free), {.order = 16}).kept_as_is == 2);
}

TEST_CASE("generator slip: bad input is refused", "[property]") {
    KlossCurve law = turbines::wt600_kloss_curve();
    check_refused([&] { (void)turbines::slip_damping(law, gear_ratio, 9000); },
                  {"generator slip: torque [N m] = 9000; allowed: within +-9000, the breakdown torque"});
    law.breakdown_slip = 0;
    check_refused([&] { (void)turbines::slip_damping(law, gear_ratio); }, {"breakdown slip = 0"});
    const turbines::Turbine blade = turbines::isolated_blade(turbines::wt600_description(), {});
    check_refused([&] { (void)turbines::with_generator_slip(blade, turbines::wt600_kloss_curve()); },
                  {"generator = none; allowed: one that slips"});
}
