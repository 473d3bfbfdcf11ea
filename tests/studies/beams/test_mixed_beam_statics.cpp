// Statics, derivatives and refusals of the mixed beam of Lee, Hodges and Patil (2002).
#include "examples/studies/beams/mixed_beam.hpp"
#include "tests/elements/cardan_beam/cantilever.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/random_tree.hpp"
#include "tests/support/refusal.hpp"

using namespace cardan;
using namespace cardan::testing;

namespace {

struct Tip {
    Vec3 u, theta;
    double angle() const { return 2 * std::atan(theta.norm() / 2); }
};

Tip tip_of(const BeamLine& line, int elements, const MixedSetting& setting) {
    const MixedBeam beam(line, elements);
    const Vector x = mixed_steady_state(beam, setting).x;
    return {x.segment<3>(beam.tip() + MixedField::u), x.segment<3>(beam.tip() + MixedField::theta)};
}

Mat6 random_definite(Random& random, double floor) {
    const Mat6 A = Mat6::NullaryExpr([&] { return uniform(random, -1, 1); });
    return A * A.transpose() + floor * Mat6::Identity();
}

// Any positive definite section, linear in x, mass centre off the line.
BeamLine random_line(Random& random, double length) {
    const Mat6 root = random_definite(random, 0.1), tip = random_definite(random, 0.1);
    return {length,
            {},
            [root, tip, length](double x) {
                BeamSection s;
                s.compliance = root + x / length * (tip - root);
                s.mass = 2 - x / length;
                s.centre = {0, 0.1, -0.2};
                s.J = Vec3(0.5, 0.2, 0.3).asDiagonal();
                return s;
            },
            "random"};
}

RigidInertia lopsided_body() {
    RigidInertia body;
    body.mass = 1.5;
    body.com = {0.1, -0.2, 0.3};
    body.J = Vec3(0.4, 0.5, 0.6).asDiagonal();
    return body;
}

MixedSetting everything() {
    MixedSetting setting;
    setting.omega = {0.3, -0.5, 0.9};
    setting.root_position = {0.7, 0.2, -0.4};
    setting.g = {1.1, -2.3, 0.8};
    setting.pin = MixedPin{{1, 2, -0.5}, {-0.3, 0.1, 0.2}, lopsided_body()};
    setting.force = {0.4, 0.2, -0.6};
    setting.moment = {-0.1, 0.5, 0.3};
    setting.follower_force = {0.2, -0.7, 0.1};
    setting.follower_moment = {0.6, 0.1, -0.2};
    setting.tip_body = lopsided_body();
    return setting;
}

}  // namespace

TEST_CASE("mixed beam: elastica under a dead tip force, order 2", "[elements][mixed][analytic]") {
    // Clamped elastica by elliptic integrals (Bisshopp and Drucker, Q. Appl. Math. 3 (1945) 272-275).
    struct Exact {
        double load, shortening, deflection, angle;
    };
    for (const Exact& e : {Exact{1, .056433236, .301720774, .461351950},
                           {5, .387628361, .713791524, 1.215368118},
                           {10, .554995598, .810609025, 1.430285539}}) {
        MixedSetting setting;
        setting.force = {0, 0, e.load};
        const Tip n8 = tip_of(uniform_beam(1, slender(1, 1)), 8, setting);
        const Tip n16 = tip_of(uniform_beam(1, slender(1, 1)), 16, setting);
        CHECK(order(n8.u.x(), n16.u.x(), -e.shortening) == Approx(2).margin(0.1));
        // Under the largest load 1.88 here and 1.97 between 16 and 32 elements.
        CHECK(order(n8.u.z(), n16.u.z(), e.deflection) == Approx(2).margin(0.15));
        CHECK(order(n8.angle(), n16.angle(), e.angle) == Approx(2).margin(0.1));
        CHECK(n16.u.z() == Approx(e.deflection).epsilon(5e-3));
        CHECK(n16.theta.y() < 0);  // upward is a negative turn about y
        CHECK(std::abs(n16.u.y()) < 1e-12);
    }
}

TEST_CASE("mixed beam: a tip moment bends the beam to a circular arc, order 2", "[elements][mixed][analytic]") {
    const double angle = 2;  // M L / EI
    for (const bool follower : {false, true}) {
        MixedSetting setting;
        (follower ? setting.follower_moment : setting.moment) = {0, 0, angle};
        const Tip n8 = tip_of(uniform_beam(1, slender(1, 1)), 8, setting);
        const Tip n16 = tip_of(uniform_beam(1, slender(1, 1)), 16, setting);
        CHECK(order(n8.u.x(), n16.u.x(), std::sin(angle) / angle - 1) == Approx(2).margin(0.1));
        CHECK(order(n8.u.y(), n16.u.y(), (1 - std::cos(angle)) / angle) == Approx(2).margin(0.1));
        CHECK(order(n8.angle(), n16.angle(), angle) == Approx(2).margin(0.1));
    }
}

TEST_CASE("mixed beam: a follower force is the dead force in the axes of the turned tip",
          "[elements][mixed][property]") {
    const MixedBeam beam(uniform_beam(1, slender(1, 1)), 6);
    MixedSetting dead, follower;
    dead.force = {0.2, 0, 2};
    const Vector x = mixed_steady_state(beam, dead).x;
    follower.follower_force = x.segment<3>(beam.tip() + MixedField::F);
    CHECK((mixed_steady_state(beam, follower).x - x).norm() < 1e-9);
}

TEST_CASE("mixed beam: sag under its own weight, order 2, and the root carries the whole load",
          "[elements][mixed][analytic]") {
    // mu g L^4 / (8 EI), small.
    MixedSetting setting;
    setting.g = {0, 0, -1e-6};
    setting.tip_body.mass = 0.5;
    const BeamLine line = uniform_beam(2, slender(3, 1.5));
    const double exact = -1e-6 * (1.5 * 16 / 8 + 0.5 * 8 / 3) / 3;
    const double n4 = tip_of(line, 4, setting).u.z(), n8 = tip_of(line, 8, setting).u.z();
    CHECK(order(n4, n8, exact) == Approx(2).margin(0.05));
    const MixedBeam beam(line, 4);
    const Vector x = mixed_steady_state(beam, setting).x;
    CHECK(x(MixedBeam::root() + MixedField::F + 2) == Approx(-1e-6 * (2 * 1.5 + 0.5)).epsilon(1e-9));
    CHECK(x(MixedBeam::root() + MixedField::M + 1) == Approx(1e-6 * (2 * 1.5 * 1 + 0.5 * 2)).epsilon(1e-9));
}

TEST_CASE("mixed beam: coupled sections bend by the midpoint sum of the continuum's compliance",
          "[elements][mixed][analytic]") {
    // Small loads: int X^T S X dx with X the section forces by tip loads. The box scheme takes X at the element's
    // centre and the mean of S, so the sum holds to the last digit and the integral with order 2.
    Random random(7);
    for (int trial = 0; trial < 3; ++trial) {
        const BeamLine line = random_line(random, 1.7);
        const auto sum = [&](int n) {
            Mat6 total = Mat6::Zero();
            for (int i = 0; i < n; ++i) {
                const double h = line.length / n, centre = (i + 0.5) * h, arm = line.length - centre;
                Mat6 X = Mat6::Identity();
                X(4, 2) = -arm;
                X(5, 1) = arm;
                total += h * X.transpose() * line.section(centre).compliance * X;  // S is linear: mean = middle
            }
            return total;
        };
        const auto discrete = [&](int n) {
            const MixedBeam beam(line, n);
            Mat6 compliance;
            for (int load = 0; load < 6; ++load) {
                MixedSetting setting;
                (load < 3 ? setting.force : setting.moment)(load % 3) = 1e-7;
                compliance.col(load) = mixed_steady_state(beam, setting).x.segment<6>(beam.tip()) / 1e-7;
            }
            return compliance;
        };
        const Mat6 exact = sum(2000);
        CHECK((discrete(3) - sum(3)).norm() < 1e-5 * exact.norm());
        CHECK(std::log2((discrete(4) - exact).norm() / (discrete(8) - exact).norm()) == Approx(2).margin(0.1));
    }
}

TEST_CASE("mixed beam: the pencil is the complex-step derivative of all equations", "[elements][mixed][property]") {
    Random random(11);
    const MixedBeam beam(random_line(random, 1.3), 3);
    for (const bool pinned : {false, true}) {
        MixedSetting setting = everything();
        if (!pinned) setting.pin.reset();
        const Vector x = Vector::NullaryExpr(beam.unknowns(), [&] { return uniform(random, -1, 1); });
        const Vector xdot = Vector::NullaryExpr(beam.unknowns(), [&] { return uniform(random, -1, 1); });
        const DescriptorPencil pencil = mixed_pencil(beam, setting, x);
        constexpr double step = 1e-40;
        for (Eigen::Index j = 0; j < beam.unknowns(); ++j) {
            ComplexVector at = x.cast<Complex>(), rate = xdot.cast<Complex>();
            at(j) += Complex(0, step);
            const Vector by_state = mixed_residual<Complex>(beam, setting, at, rate).imag() / step;
            CHECK((by_state - pencil.A.col(j)).norm() < 1e-13 * (1 + pencil.A.col(j).norm()));
            at(j) = x(j);
            rate(j) += Complex(0, step);
            const Vector by_rate = mixed_residual<Complex>(beam, setting, at, rate).imag() / step;
            CHECK((by_rate - pencil.E.col(j)).norm() < 1e-13 * (1 + pencil.E.col(j).norm()));
        }
    }
}

TEST_CASE("mixed beam: derivatives by the motion of the root equal the complex step", "[elements][mixed][property]") {
    Random random(13);
    const MixedBeam beam(random_line(random, 1.3), 3);
    const Vector x = Vector::NullaryExpr(beam.unknowns(), [&] { return uniform(random, -1, 1); });
    const Vector motion = Vector::NullaryExpr(9, [&] { return uniform(random, -1, 1); });
    const Matrix exact = beam.jacobian(x, {motion.head<3>(), motion.segment<3>(3), motion.tail<3>()}).motion;
    for (Eigen::Index j = 0; j < 9; ++j) {
        ComplexVector at = motion.cast<Complex>();
        at(j) += Complex(0, 1e-40);
        const Vector by = beam.residual<Complex>(x.cast<Complex>(), ComplexVector::Zero(beam.unknowns()),
                                                 {at.head<3>(), at.segment<3>(3), at.tail<3>()})
                              .imag() /
                          1e-40;
        CHECK((by - exact.col(j)).norm() < 1e-13);
    }
}

TEST_CASE("mixed beam: a spinning beam solves the equations at any angle to root axes at rest",
          "[elements][mixed][property]") {
    // That motion seen from axes that do not turn: now the rates of u and theta carry it.
    EngineeringSection s = slender(1, 1);
    s.EA = 5;
    const MixedBeam beam(uniform_beam(1, s), 4);
    MixedSetting setting;
    const double spin = 0.7;
    setting.omega = {0, 0, spin};
    const Vector stretched = mixed_steady_state(beam, setting).x;
    for (const double psi : {0.0, 0.8, 2.5}) {
        Vector x = stretched, xdot = Vector::Zero(beam.unknowns());
        for (int k = 0; k < beam.elements() + 2; ++k) {
            const Eigen::Index at = MixedBeam::station(k);
            const Vec3 place = beam.position(k) * Vec3::UnitX();
            const Vec3 turned = rot_z(psi) * (place + stretched.segment<3>(at + MixedField::u));
            const double tangent = 2 * std::tan(psi / 2);
            x.segment<3>(at + MixedField::u) = turned - place;
            x(at + MixedField::theta + 2) = tangent;
            xdot.segment<3>(at + MixedField::u) = cross<double>(setting.omega, turned);
            xdot(at + MixedField::theta + 2) = (1 + tangent * tangent / 4) * spin;
        }
        CHECK(beam.residual<double>(x, xdot, {}).norm() < 1e-12);
    }
}

TEST_CASE("mixed beam: every flexible direction with inertia gives one pair of modes", "[elements][mixed][property]") {
    Random random(17);
    const MixedBeam beam(random_line(random, 1), 3);
    const auto modes = mixed_modes(beam, {}, Vector::Zero(beam.unknowns()));
    const DescriptorPencil pencil = mixed_pencil(beam, {}, Vector::Zero(beam.unknowns()));
    CHECK(modes.size() == 18);
    for (const DescriptorMode& mode : modes) {
        CHECK(std::abs(mode.eigenvalue.real()) < 1e-8 * std::abs(mode.eigenvalue));
        const ComplexVector left = (mode.eigenvalue * pencil.E.cast<Complex>() + pencil.A.cast<Complex>()) * mode.shape;
        CHECK(left.norm() < 1e-8 * mode.shape.norm());
    }
}

TEST_CASE("pencil: infinite eigenvalues of index 3 are taken out, a singular pencil is refused",
          "[elements][mixed][property]") {
    // x' = v, v' = -f, x = 0 (index 3, no finite eigenvalue) beside p' = -2 q, q' = 2 p.
    DescriptorPencil pencil{Matrix::Zero(5, 5), Matrix::Zero(5, 5)};
    pencil.E(0, 0) = pencil.E(1, 1) = pencil.E(3, 3) = pencil.E(4, 4) = 1;
    pencil.A(0, 1) = -1;
    pencil.A(1, 2) = 1;
    pencil.A(2, 0) = 1;
    pencil.A(3, 4) = 2;
    pencil.A(4, 3) = -2;
    const auto modes = finite_modes(pencil);
    REQUIRE(modes.size() == 1);
    CHECK(std::abs(modes[0].eigenvalue - Complex(0, 2)) < 1e-13);
    pencil.A(2, 0) = 0;
    CHECK_THROWS_AS(finite_modes(pencil), NumericalError);
}

TEST_CASE("mixed beam: bad input is refused with the name of the beam", "[elements][mixed][property]") {
    const auto line = [](const EngineeringSection& s) { return uniform_beam(10, s, "spar"); };
    check_refused([&] { MixedBeam(line(slender(2, 3)), 0); }, {"spar: number of elements = 0; allowed: >= 1"});
    check_refused([&] { MixedBeam(line(slender(2, 3)), -3); }, {"spar: number of elements = -3"});
    BeamLine bad = line(slender(2, 3));
    bad.length = not_a_number;
    check_refused([&] { MixedBeam(bad, 2); }, {"spar: length [m] = nan"});
    const auto refuse_section = [&](auto change, std::initializer_list<std::string> parts) {
        BeamSection s = slender(2, 3).section();
        change(s);
        BeamLine changed = line(slender(2, 3));
        changed.section = [s](double) { return s; };
        check_refused([&] { MixedBeam(changed, 2); }, parts);
    };
    refuse_section([](BeamSection& s) { s.compliance(4, 4) = not_a_number; }, {"spar element 1: compliance = nan"});
    refuse_section([](BeamSection& s) { s.compliance(4, 4) = -1; }, {"spar element 1: compliance = -1", ">= 0"});
    refuse_section([](BeamSection& s) { s.compliance.setZero(); }, {"spar: largest compliance = 0; allowed: > 0"});
    refuse_section([](BeamSection& s) { s.mass = not_a_number; }, {"spar element 1: inertia = nan; allowed: finite"});
    refuse_section([](BeamSection& s) { s.mass = -1; }, {"spar element 1: mass or inertia per length = -1"});

    const MixedBeam beam(line(slender(2, 3)), 2);
    const auto refuse = [&](auto change, std::initializer_list<std::string> parts) {
        MixedSetting setting;
        change(setting);
        check_refused([&] { (void)mixed_steady_state(beam, setting); }, parts);
    };
    using S = MixedSetting;
    refuse([](S& s) { s.omega.z() = not_a_number; }, {"spar: angular velocity of the root [rad/s] =", "nan"});
    refuse([](S& s) { s.root_position.x() = not_a_number; }, {"spar: position of the root [m] =", "nan"});
    refuse([](S& s) { s.force.y() = not_a_number; }, {"spar: tip force [N] =", "nan"});
    refuse([](S& s) { s.pin = MixedPin{Vec3::Zero(), Vec3::Zero(), {}}; }, {"spar: length of the hinge axis"});
    refuse([](S& s) { s.tip_body.mass = -1; }, {"spar: tip body", "-1"});
}

TEST_CASE("mixed beam: a moment about a free hinge has no steady state", "[elements][mixed][property]") {
    const MixedBeam beam(uniform_beam(1, slender(1, 1), "spar"), 2);
    MixedSetting setting;
    setting.pin = MixedPin{};
    setting.moment = {0, 0.1, 0};
    std::string message;
    try {
        (void)mixed_steady_state(beam, setting);
    } catch (const NumericalError& error) {
        message = error.what();
    }
    CHECK(message.find("spar: no steady state of the mixed beam") == 0);
    CHECK(message.find("residual") != std::string::npos);
}
