// A platform alone in the water, its added mass and stiffness by hand; what is refused.
#include "mbs/base/units.hpp"
#include "solvers/linear/linearise.hpp"
#include "solvers/linear/modes.hpp"
#include "solvers/time/integrate.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/floating.hpp"

using namespace cardan;
using namespace cardan::testing;
using namespace cardan::turbines;

namespace {

// Without a machine.
struct Afloat {
    Tree tree;
    ForceSet forces;
    PlatformFrames frames;
    std::vector<std::string> warnings;

    explicit Afloat(const PlatformDescription& platform, const Vec3& gravity = earth_gravity) {
        forces.set_gravity(gravity);
        frames = add_platform(tree, platform);
        add_water_forces(forces, tree, frames.base, platform, warnings);
    }
    System system() const { return {tree, forces}; }
};

PlatformDescription neutrally_buoyant() {
    PlatformDescription p = floating_freely(some_platform());
    p.buoyancy = units::standard_gravity * p.inertia.mass;
    return p;
}

solvers::SecondOrderSystem linear(const System& system) {
    const Vector zero = Vector::Zero(6);
    return solvers::restrict_to(solvers::linearise(system, at_rest(zero)), {0, 1, 2, 5, 4, 3});
}

}  // namespace

TEST_CASE("platform alone: mass, damping and stiffness are those put together by hand", "[analytic]") {
    const PlatformDescription p = neutrally_buoyant();
    const Afloat afloat(p);
    CHECK(afloat.warnings.empty());
    const solvers::SecondOrderSystem found = linear(afloat.system());
    const RigidInertia& body = p.inertia;
    const Mat3 c = skew(body.com);
    Mat6 M = p.added_mass;
    M.topLeftCorner<3, 3>() += body.mass * Mat3::Identity();
    M.topRightCorner<3, 3>() -= body.mass * c;
    M.bottomLeftCorner<3, 3>() += body.mass * c;
    M.bottomRightCorner<3, 3>() += body.J - body.mass * c * c;
    Mat6 K = p.hydrostatic_stiffness + p.mooring_stiffness;
    // Metacentre: weight at its centre, buoyancy at its own.
    const double righting = units::standard_gravity * body.mass * (-body.com.z() + p.buoyancy_centre.z());
    K(3, 3) += righting;
    K(4, 4) += righting;
    const Vec6 scale = M.diagonal().cwiseSqrt(), k = K.diagonal().cwiseSqrt();
    for (Eigen::Index i = 0; i < 6; ++i)
        for (Eigen::Index j = 0; j < 6; ++j) {
            CAPTURE(i, j);
            CHECK(std::abs(found.M(i, j) - M(i, j)) < 1e-13 * scale(i) * scale(j));
            CHECK(std::abs(found.K(i, j) - K(i, j)) < 1e-12 * k(i) * k(j));
            CHECK(std::abs(found.K_elastic(i, j) - K(i, j)) < 1e-12 * k(i) * k(j));
            CHECK(found.C(i, j) == p.damping(i, j));
        }
    // And so are the modes.
    const std::vector<std::complex<double>> expected = oscillations(M, p.damping, K);
    const std::vector<solvers::Mode> modes = solvers::modes(found);
    REQUIRE(modes.size() == 6);
    REQUIRE(expected.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) {
        CAPTURE(expected[i], modes[i].eigenvalue);
        CHECK(std::abs(modes[i].eigenvalue - expected[i]) < 1e-10 * std::abs(expected[i]));
    }
}

TEST_CASE("platform alone: heave is the damped oscillation of mass and added mass on the water plane, exactly",
          "[analytic]") {
    PlatformDescription p = neutrally_buoyant();
    p.inertia.com.head<2>().setZero();
    p.added_mass(2, 5) = p.added_mass(5, 2) = 0;  // of a hull that is a screw
    const Afloat afloat(p);
    const System system = afloat.system();
    const double m = p.inertia.mass + p.added_mass(2, 2), k = p.hydrostatic_stiffness(2, 2) + p.mooring_stiffness(2, 2),
                 b = p.damping(2, 2), delta = b / (2 * m), omega = std::sqrt(k / m - delta * delta);
    Vector q = Vector::Zero(6);
    const int heave = system.model.index(afloat.frames.base.coordinate(BaseCoordinate::heave));
    q(heave) = 2;
    solvers::IntegrationOptions options;
    options.tolerances = {1e-10, 1e-11, 1e-11, 1e-11, 1e-11};
    solvers::Integrator integrator(system, {}, 0, q, Vector::Zero(6), options);
    double largest = 0;
    for (double t = 1; t < 80; t += 1) {
        REQUIRE(integrator.advance(t).reached());
        const double expected = 2 * std::exp(-delta * t) * (std::cos(omega * t) + delta / omega * std::sin(omega * t));
        largest = std::max(largest, std::abs(integrator.state().q(heave) - expected));
    }
    CAPTURE(largest, 2 * pi / omega);
    CHECK(largest < 1e-7);
    CHECK(std::abs(integrator.state().q(0)) < 1e-9);
    const solvers::EnergyBalance energy = integrator.energy();
    CHECK(std::abs(energy.error) < 1e-7 * (k * 2 * 2 / 2));
    // All that the spring has lost is heat.
    const double left = energy.kinetic + energy.potential;
    const Afloat still(p);
    const System rest = still.system();
    Workspace workspace(rest.model);
    const Vector zero = Vector::Zero(6);
    const double lowest =
        rest.forces.potential_energy({{.q = zero, .qd = zero}, kinematics(rest.model, zero, workspace)});
    CHECK(left - lowest + energy.dissipated == Approx(k * 2 * 2 / 2).epsilon(1e-7));
}

TEST_CASE("platform alone: a body without stiffness keeps its momentum, added mass and all", "[analytic]") {
    // Constant added mass in the coordinates: g_ab x'^b of the translations is constant, whatever the body turns.
    PlatformDescription p = floating_freely(some_platform());
    p.hydrostatic_stiffness.setZero();
    p.mooring_stiffness.setZero();
    p.damping.setZero();
    const Afloat afloat(p, Vec3::Zero());
    const System system = afloat.system();
    Vector q(6), qd(6);
    q << 0, 0, 0, 0.3, -0.2, 0.1;
    qd << 1, -0.5, 0.3, 0.02, 0.03, -0.01;
    const auto momentum = [&](const Vector& at, const Vector& rate) {
        Workspace workspace(system.model);
        Matrix g(6, 6);
        metric(kinematics(system.model, at, workspace), g);
        return Vec3((g * rate).head<3>());
    };
    const Vec3 before = momentum(q, qd);
    solvers::IntegrationOptions options;
    options.tolerances = {1e-11, 1e-12, 1e-12, 1e-12, 1e-12};
    solvers::Integrator integrator(system, {}, 0, q, qd, options);
    REQUIRE(integrator.advance(30).reached());
    const Vec3 after = momentum(integrator.state().q, integrator.state().qd);
    CAPTURE(before.transpose(), after.transpose());
    CHECK((after - before).norm() < 1e-8 * before.norm());
    CHECK((integrator.state().qd - qd).norm() > 1e-3);
    CHECK(std::abs(integrator.energy().error) < 1e-8 * integrator.energy().kinetic);
}

TEST_CASE("platform alone: without any stiffness there are no vibrations", "[property]") {
    PlatformDescription p = floating_freely(some_platform());
    p.hydrostatic_stiffness.setZero();
    p.mooring_stiffness.setZero();
    p.damping.setZero();
    const solvers::SecondOrderSystem free = linear(Afloat(p, Vec3::Zero()).system());
    CHECK(free.K.isZero(0));
}

TEST_CASE("strip theory: cylinder and cone have the added mass of the displaced water about the water line",
          "[analytic]") {
    constexpr double rho = 1025, C = 0.9, L = 50, D = 6, section = pi / 4 * D * D;
    const std::vector<HullStation> cylinder{{0, D}, {20, D}, {L, D}};
    const Mat6 A = strip_theory_added_mass(cylinder, C, 0.5, rho);
    CHECK(displaced_volume(cylinder) == Approx(section * L).epsilon(1e-14));
    CHECK(A(0, 0) == Approx(C * rho * section * L).epsilon(1e-14));
    CHECK(A(1, 1) == A(0, 0));
    CHECK(A(0, 4) == Approx(-C * rho * section * L * L / 2).epsilon(1e-14));
    CHECK(A(1, 3) == -A(0, 4));
    CHECK(A(4, 4) == Approx(C * rho * section * L * L * L / 3).epsilon(1e-14));
    CHECK(A(3, 3) == A(4, 4));
    CHECK(A(2, 2) == Approx(0.5 * rho * 2 * pi / 3 * D * D * D / 8).epsilon(1e-14));
    CHECK(A(5, 5) == 0);
    CHECK((A - A.transpose()).isZero(0));
    // A cone with its tip on the water line: volume, centroid and second moment of the text book.
    const std::vector<HullStation> cone{{0, 0}, {L, D}};
    const Mat6 B = strip_theory_added_mass(cone, 1, 0, rho);
    CHECK(B(0, 0) == Approx(rho * section * L / 3).epsilon(1e-14));
    CHECK(B(0, 4) == Approx(-rho * section * L / 3 * L * 3 / 4).epsilon(1e-14));
    CHECK(B(4, 4) == Approx(rho * section * L / 3 * L * L * 3 / 5).epsilon(1e-14));
}

TEST_CASE("strip theory: bad hulls are refused", "[property]") {
    const auto added = [](std::vector<HullStation> hull, double c = 1, double end = 1, double rho = 1000) {
        return [=] { (void)strip_theory_added_mass(hull, c, end, rho); };
    };
    check_refused(added({{0, 1}}), {"hull", "stations = 1", ">= 2"});
    check_refused(added({{0, 1}, {0, 2}}), {"depth of station 2", "rising"});
    check_refused(added({{0, 1}, {5, -2}}), {"diameter of station 2", "-2"});
    check_refused(added({{-1, 1}, {5, 2}}), {"depth of station 1", "-1"});
    check_refused(added({{0, 1}, {NAN, 2}}), {"depth of station 2", "nan"});
    check_refused(added({{0, 1}, {5, 2}}, -1), {"coefficient of added mass = -1"});
    check_refused(added({{0, 1}, {5, 2}}, 1, NAN), {"of the end = nan"});
    check_refused(added({{0, 1}, {5, 2}}, 1, 1, -3), {"density", "-3"});
    check_refused([] { (void)displaced_volume({}); }, {"stations = 0"});
}

TEST_CASE("platform: single coordinates are free or driven, and only free ones have a stiffness that counts as elastic",
          "[property]") {
    PlatformDescription p = neutrally_buoyant();
    p.coordinates.roles[0] = p.coordinates.roles[5] = CoordinateRole::prescribed;
    const Afloat afloat(p);
    const System system = afloat.system();
    const CoordinateTable& table = system.model.coordinates();
    for (const char* name : {"surge", "yaw"})
        CHECK(table[table.index(text("platform ", name))].role == CoordinateRole::prescribed);
    for (const char* name : {"sway", "heave", "roll", "pitch"})
        CHECK(table[table.index(text("platform ", name))].role == CoordinateRole::free);
    const solvers::SecondOrderSystem all = linear(Afloat(neutrally_buoyant()).system()), some = linear(system);
    CHECK((all.K - some.K).cwiseAbs().maxCoeff() < 1e-12 * all.K.cwiseAbs().maxCoeff());
    CHECK(some.K_elastic.row(0).isZero(0));
    CHECK(some.K_elastic.row(5).isZero(0));
    CHECK(some.K_elastic(1, 1) == all.K_elastic(1, 1));
}

TEST_CASE("platform: bad descriptions are refused with their name, the quantity, the value and what is allowed",
          "[property]") {
    const auto with = [](auto change) {
        PlatformDescription p = neutrally_buoyant();
        change(p);
        return [p] { Afloat{p}; };
    };
    check_refused(with([](auto& p) { p.inertia.mass = -1; }), {"test spar", "mass", "-1"});
    check_refused(with([](auto& p) { p.inertia.mass = NAN; }), {"test spar", "mass", "nan"});
    check_refused(with([](auto& p) { p.inertia.J(0, 0) = -1; }), {"test spar", "moment"});
    check_refused(with([](auto& p) { p.tower_base.x() = NAN; }), {"test spar", "foot of the tower", "nan"});
    check_refused(with([](auto& p) { p.added_mass(0, 4) = 1; }), {"added mass, surge by pitch", "symmetric"});
    check_refused(with([](auto& p) { p.added_mass(2, 2) = -5; }), {"added mass, heave = -5", ">= 0"});
    check_refused(with([](auto& p) { p.added_mass(0, 4) = p.added_mass(4, 0) = 1e8; }),
                  {"lowest eigenvalue (unit diagonal) of the added mass", ">= 0"});
    check_refused(with([](auto& p) { p.added_mass(3, 3) = INFINITY; }), {"added mass", "finite"});
    check_refused(with([](auto& p) { p.damping(5, 5) = -1; }), {"damping, yaw = -1"});
    check_refused(with([](auto& p) { p.damping(1, 2) = NAN; }), {"damping", "finite"});
    check_refused(with([](auto& p) { p.damping(1, 2) = 7; }), {"damping, sway by heave", "symmetric"});
    check_refused(with([](auto& p) { p.hydrostatic_stiffness(3, 4) = 1e6; }), {"hydrostatic stiffness, roll by pitch"});
    check_refused(with([](auto& p) { p.hydrostatic_stiffness(3, 3) = NAN; }), {"hydrostatic stiffness", "finite"});
    check_refused(with([](auto& p) { p.mooring_stiffness(0, 1) = 1e5; }), {"stiffness of the mooring, surge by sway"});
    check_refused(with([](auto& p) { p.mooring_stiffness(0, 1) = INFINITY; }), {"stiffness of the mooring", "finite"});
    check_refused(with([](auto& p) { p.buoyancy = -1; }), {"buoyancy [N] = -1"});
    check_refused(with([](auto& p) { p.buoyancy_centre.z() = NAN; }), {"centre of buoyancy", "nan"});
    check_refused(with([](auto& p) { p.mooring_preload.y() = NAN; }), {"pull of the mooring lines", "nan"});
    check_refused(with([](auto& p) { p.buoyancy_centre.z() = -60; }), {"test spar", "capsizes", "unit diagonal"});
    // Driven it may do that, since it cannot.
    PlatformDescription driven = neutrally_buoyant();
    driven.coordinates.role = CoordinateRole::prescribed;
    driven.buoyancy_centre.z() = -60;
    CHECK_NOTHROW(Afloat(driven));
}

TEST_CASE("platform: a lift that does not carry the weight gives a warning", "[property]") {
    PlatformDescription p = neutrally_buoyant();
    CHECK(Afloat(p).warnings.empty());
    p.buoyancy *= 1.5;
    REQUIRE(Afloat(p).warnings.size() == 1);
    CHECK(Afloat(p).warnings.front().find("test spar: a weight of") != std::string::npos);
    p.buoyancy = 0;  // no water at all: a shaking table, a vehicle
    p.buoyancy_centre.setZero();
    CHECK(Afloat(p).warnings.empty());
}
