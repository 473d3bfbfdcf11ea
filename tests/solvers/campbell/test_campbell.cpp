// Campbell diagrams of a rotor on a rigid hub, whose frequencies are known in closed form; input that is refused.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>

namespace cardan::testing::hinged_rotors {

using namespace solvers;

namespace {

// Point masses m at the distance l from hinges at the distance e from the axis of a hub. About the hinge
//   flap: w^2 = k / (m l^2) + Omega^2 (1 + e / l),    lag: w^2 = k / (m l^2) + Omega^2 e / l
// with the spin prescribed; flap and the lag patterns that do not pull at the hub know nothing of a free spin.
constexpr double m = 3, l = 4, e = 0.5, hub_inertia = 40;

double flap_frequency(double Omega, double k = 2000) {
    return std::sqrt(k / (m * l * l) + Omega * Omega * (1 + e / l));
}
double lag_frequency(double Omega, double k = 2000) {
    return std::sqrt(k / (m * l * l) + Omega * Omega * e / l);
}

SmallRotor make_rotor(SmallRotorSpec spec = {}) {
    spec.hub.J = hub_inertia * Mat3::Identity();
    return small_rotor(spec);
}

}  // namespace

TEST_CASE("rpm_range: counts from first to last in rad/s and keeps the last", "[analytic]") {
    const std::vector<double> speeds = rpm_range(0, 40, 10);
    REQUIRE(speeds.size() == 5);
    for (std::size_t i = 0; i < 5; ++i) CHECK(speeds[i] == Approx(10.0 * static_cast<double>(i) * 2 * pi / 60));
    CHECK(rpm_range(0, 1, 0.1).size() == 11);  // 0.1 is no binary fraction
    CHECK(rpm_range(0, 10, 3).size() == 4);
    CHECK(rpm_range(0, 10, 3).back() == Approx(9 * units::rpm));
    CHECK(rpm_range(5, 5, 1) == std::vector<double>{5 * units::rpm});
    CHECK(rpm_range(5, 6, 100).size() == 1);
}

TEST_CASE("rpm_range: a bad range is refused with the range as given", "[property]") {
    check_refused([] { (void)rpm_range(0, 10, 0); }, {"0:10:0", "STEP > 0"});
    check_refused([] { (void)rpm_range(0, 10, -1); }, {"0:10:-1", "STEP > 0"});
    check_refused([] { (void)rpm_range(10, 0, 1); }, {"10:0:1", "FIRST <= LAST"});
    check_refused([] { (void)rpm_range(not_a_number, 10, 1); }, {"nan:10:1", "finite"});
    check_refused([] { (void)rpm_range(0, infinite, 1); }, {"0:inf:1", "finite"});
    check_refused([] { (void)rpm_range(0, 10, not_a_number); }, {"0:10:nan", "finite"});
}

TEST_CASE("campbell: flap of a hinged rotor is collective at w, backward at w - Omega and forward at w + Omega",
          "[analytic]") {
    const double damping = 6, decay = damping / (2 * m * l * l);
    const std::vector<double> speeds = rpm_range(5, 40, 5);
    int done = 0;
    CampbellOptions options;
    options.progress = [&](int now, int total) {
        CHECK(now == ++done);
        CHECK(total == 8);
    };
    const Campbell d = diagram_of(make_rotor({.damping = damping}), speeds, options);
    CHECK(done == 8);
    CHECK(d.complete);
    CHECK(d.warning.empty());
    CHECK(d.machine == "small rotor");
    CHECK(d.blades == 3);
    CHECK(d.rotor_speeds() == speeds);
    REQUIRE(d.branches.size() == 3);
    CHECK(d.rows == std::vector<std::string>{"spin", "flap 1 (collective)", "flap 1 (cosine 1)", "flap 1 (sine 1)"});
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        CAPTURE(i);
        const double Omega = speeds[i], w = flap_frequency(Omega), damped = std::sqrt(w * w - decay * decay);
        for (const auto& [name, shift] : {std::pair{"blade flap (backward)", -1.0},
                                          {"blade flap (collective)", 0.0},
                                          {"blade flap (forward)", 1.0}}) {
            const Branch& branch = d.branch(name);
            const double f = damped + shift * Omega;
            CHECK(branch.family == "blade flap");
            CHECK_FALSE(branch.doubtful[i]);
            CHECK(d.damped_hz(branch, i) == Approx(f / (2 * pi)).epsilon(1e-11));
            CHECK(d.natural_hz(branch, i) == Approx(std::hypot(f, decay) / (2 * pi)).epsilon(1e-11));
            CHECK(d.damping_ratio(branch, i) == Approx(decay / std::hypot(f, decay)).epsilon(1e-9));
        }
    }
}

TEST_CASE("campbell: crossings lie where a branch meets a multiple of the rotor speed", "[analytic]") {
    // In the rotating frame w = s Omega with s^2 = n^2 (collective), (n + 1)^2 (backward), (n - 1)^2 (forward):
    // Omega^2 = k / (m l^2) / (s^2 - 1 - e / l). Linear interpolation between speeds h apart errs by order h^2.
    const double w0 = flap_frequency(0), step = 0.25;
    const Campbell d = diagram_of(make_rotor(), rpm_range(10, 40, step));
    std::vector<std::pair<std::string, int>> expected;
    for (const auto& [pattern, shift] : {std::pair{"backward", 1}, {"collective", 0}, {"forward", -1}})
        for (int n : {1, 2, 3, 6, 9, 12}) {  // drawn and listed for three blades
            const double square = (n + shift) * (n + shift) - 1 - e / l;
            const double Omega = square > 0 ? w0 / std::sqrt(square) : 0;
            if (Omega < 10 * units::rpm || Omega > 40 * units::rpm) continue;
            const std::string name = text("blade flap (", pattern, ")");
            expected.emplace_back(name, n);
            CAPTURE(name, n);
            const auto found = std::find_if(d.crossings.begin(), d.crossings.end(), [&](const Crossing& c) {
                return c.multiple == n && entry(d.branches, c.branch).name == name;
            });
            REQUIRE(found != d.crossings.end());
            CHECK(found->rotor_speed == Approx(Omega).epsilon(1e-5));
            CHECK(found->frequency_hz == Approx(n * Omega / (2 * pi)).epsilon(1e-5));
        }
    CHECK(expected.size() >= 5);
    CHECK(d.crossings.size() == expected.size());
    CHECK(std::is_sorted(d.crossings.begin(), d.crossings.end(),
                         [](const Crossing& a, const Crossing& b) { return a.rotor_speed < b.rotor_speed; }));
}

TEST_CASE("campbell: a free spin raises the collective lag frequency, a prescribed one does not", "[analytic]") {
    // Free: the hub turns against the blades, w^2 grows by (J + 3 m r^2) / J with r = e + l.
    const SmallRotor rotor = make_rotor({.hinges = BladeHinges::lag});
    const double Omega = 3, r = e + l, free = std::sqrt((hub_inertia + 3 * m * r * r) / hub_inertia);
    CampbellOptions options;
    options.max_frequency_hz = 100;
    const Campbell with_free = diagram_of(rotor, {Omega}, options);
    options.spin = RotorSpin::prescribed;
    const Campbell prescribed = diagram_of(rotor, {Omega}, options);
    CHECK(with_free.unknowns.size() == 4);
    CHECK(prescribed.unknowns.size() == 3);
    const double w = lag_frequency(Omega) / (2 * pi);
    const auto hz = [](const Campbell& d, const char* name) { return d.natural_hz(d.branch(name), 0); };
    CHECK(hz(with_free, "blade lag (collective)") == Approx(free * w).epsilon(1e-11));
    CHECK(hz(prescribed, "blade lag (collective)") == Approx(w).epsilon(1e-11));
    for (const Campbell* d : {&with_free, &prescribed}) {
        CHECK(d->branches.size() == 3);  // the zero pair of the free spin is left out
        CHECK(hz(*d, "blade lag (backward)") == Approx(std::abs(w - Omega / (2 * pi))).epsilon(1e-11));
        CHECK(hz(*d, "blade lag (forward)") == Approx(w + Omega / (2 * pi)).epsilon(1e-11));
    }
}

TEST_CASE("campbell: modes above the largest frequency are left out", "[analytic]") {
    CampbellOptions options;
    options.max_frequency_hz = (flap_frequency(3) + 1.5) / (2 * pi);  // between collective and forward
    const Campbell d = diagram_of(make_rotor(), {3.0}, options);
    CHECK(d.points[0].modes.size() == 2);
    CHECK(d.branches.size() == 2);
}

TEST_CASE("campbell: of an anisotropic rotor the mean over the azimuth is taken, with a warning", "[analytic]") {
    // On a rigid hub the mean multi-blade system is that of a rotor with the mean hinge stiffness.
    const CampbellOptions coleman{.method = CampbellMethod::coleman};
    const Campbell unequal = diagram_of(make_rotor({.stiffness = {1700, 2300, 2600}}), {3.0}, coleman);
    CHECK(unequal.warning.find("not isotropic") != std::string::npos);
    CHECK(unequal.warning.find("mean over the azimuth") != std::string::npos);
    const double w = flap_frequency(3, 2200);
    CHECK(unequal.natural_hz(unequal.branch("blade flap (backward)"), 0) == Approx((w - 3) / (2 * pi)).epsilon(1e-10));
    CHECK(unequal.natural_hz(unequal.branch("blade flap (collective)"), 0) == Approx(w / (2 * pi)).epsilon(1e-10));
    CHECK(unequal.natural_hz(unequal.branch("blade flap (forward)"), 0) == Approx((w + 3) / (2 * pi)).epsilon(1e-10));
    // At standstill nothing is averaged: every blade has its own frequency.
    const Campbell still = diagram_of(make_rotor({.stiffness = {1700, 2300, 2600}}), {0.0});
    CHECK(still.warning.empty());
    // Unless Coleman's method is asked for, Floquet's is taken, and every blade has its frequency in rotation as well.
    const Campbell chosen = diagram_of(make_rotor({.stiffness = {1700, 2300, 2600}}), {3.0});
    CHECK(chosen.method.find("Floquet") == 0);
    CHECK(chosen.method_reason == "the blades differ");
    const double stiffness[] = {1700, 2300, 2600};
    for (int k = 1; k <= 3; ++k) {
        const double own = flap_frequency(3, stiffness[k - 1]),
                     found = 2 * pi * chosen.damped_hz(chosen.branch(text("blade flap (blade ", k, ")")), 0);
        CHECK(std::abs(std::remainder(found - own, 3.0)) < 1e-6);
    }
    REQUIRE(still.points[0].modes.size() == 3);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(still.points[0].modes[i].mode.natural_hz() ==
              Approx(flap_frequency(0, stiffness[i]) / (2 * pi)).epsilon(1e-11));
}

TEST_CASE("campbell: a frozen azimuth shows the rotating-frame frequency, with a warning", "[analytic]") {
    CampbellOptions options;
    options.method = CampbellMethod::frozen_azimuth;
    const Campbell d = diagram_of(make_rotor(), {3.0}, options);
    CHECK(d.warning.find("frozen azimuth") != std::string::npos);
    CHECK(d.method.find("frozen azimuth") != std::string::npos);
    REQUIRE(d.points[0].modes.size() == 3);
    for (const CampbellMode& mode : d.points[0].modes)
        CHECK(mode.mode.natural_hz() == Approx(flap_frequency(3) / (2 * pi)).epsilon(1e-10));
    for (const Branch& branch : d.branches) {
        CHECK(branch.pattern != RotorPattern::backward);
        CHECK(branch.pattern != RotorPattern::forward);
    }
}

TEST_CASE("campbell: a single blade is taken in its rotating frame", "[analytic]") {
    const Campbell d = diagram_of(make_rotor({.stiffness = {2000}}), {0.0, 3.0, 6.0});
    CHECK(d.method.find("rotating frame") != std::string::npos);
    REQUIRE(d.branches.size() == 1);
    CHECK(d.branches[0].name == "blade flap");
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(d.natural_hz(d.branches[0], i) == Approx(flap_frequency(3.0 * static_cast<double>(i)) / (2 * pi)));
}

TEST_CASE("campbell: four blades have a differential pattern at the rotating-frame frequency", "[analytic]") {
    const Campbell d = diagram_of(make_rotor({.stiffness = {2000, 2000, 2000, 2000}}), {3.0});
    REQUIRE(d.points[0].modes.size() == 4);
    const double w = flap_frequency(3);
    CHECK(d.natural_hz(d.branch("blade flap (backward)"), 0) == Approx((w - 3) / (2 * pi)).epsilon(1e-11));
    CHECK(d.natural_hz(d.branch("blade flap (forward)"), 0) == Approx((w + 3) / (2 * pi)).epsilon(1e-11));
    CHECK(d.natural_hz(d.branch("blade flap (differential)"), 0) == Approx(w / (2 * pi)).epsilon(1e-11));
    CHECK(d.natural_hz(d.branch("blade flap (collective)"), 0) == Approx(w / (2 * pi)).epsilon(1e-11));
}

TEST_CASE("campbell: the tip of blade 1 moves as the mode's shape says", "[analytic]") {
    const Campbell d = diagram_of(make_rotor(), {3.0});
    // the frames on the lines, then those of the bodies
    REQUIRE(d.frames == std::vector<std::string>{"root 1", "tip", "spin", "flap 1", "flap 2", "flap 3"});
    CHECK((d.frame_positions[1] - Vec3(e + l, 0, 0)).norm() < 1e-12);
    const Branch& branch = d.branch("blade flap (collective)");
    const std::vector<FrameMotion> motion = d.motion(branch, 0);
    const ComplexVector& shape = entry(d.points[0].modes, branch.mode[0]).mode.shape;
    REQUIRE(motion.size() == 6);
    // Flap by angle beta lifts the tip by l beta; at azimuth 0 beta = collective / sqrt 3.
    CHECK(std::abs(motion[1].motion(5) - l * shape(1) / std::sqrt(3.0)) < 1e-12 * std::abs(shape(1)));
    CHECK(std::abs(motion[1].motion(5)) > 0);
    CHECK(motion[0].motion.norm() < 1e-12 * std::abs(shape(1)));

    CampbellOptions options;
    options.keep_shapes = false;
    const Campbell bare = diagram_of(make_rotor(), {3.0}, options);
    CHECK(bare.motions.empty());
    check_refused([&] { (void)bare.motion(bare.branches[0], 0); }, {"small rotor", "keep_shapes"});
    check_refused([&] { (void)d.motion(branch, 1); }, {"blade flap (collective)", "point 1"});
}

TEST_CASE("campbell: a cancelled sweep keeps what was computed and says so", "[property]") {
    const SmallRotor rotor = make_rotor();
    const std::vector<double> speeds{1.0, 2.0, 3.0, 4.0};
    CampbellOptions options;
    int asked = 0, done = 0;
    options.cancelled = [&] { return ++asked > 2; };
    options.progress = [&](int now, int) { done = now; };
    const Campbell d = diagram_of(rotor, speeds, options);
    CHECK_FALSE(d.complete);
    CHECK(done == 2);
    REQUIRE(d.points.size() == 2);
    REQUIRE(d.branches.size() == 3);
    CHECK(d.motions.size() == 2);
    for (const Branch& branch : d.branches) {
        CHECK(branch.mode.size() == 2);
        CHECK(branch.doubtful.size() == 2);
    }
    CHECK(d.natural_hz(d.branch("blade flap (collective)"), 1) == Approx(flap_frequency(2) / (2 * pi)));
    CHECK(table(d).find("interrupted") != std::string::npos);

    options.cancelled = [] { return true; };
    const Campbell nothing = diagram_of(rotor, speeds, options);
    CHECK_FALSE(nothing.complete);
    CHECK(nothing.points.empty());
    CHECK(nothing.branches.empty());
    CHECK(nothing.crossings.empty());
    CHECK(table(nothing) == "no rotor speeds computed\n");
}

TEST_CASE("campbell: what has no diagram is refused", "[property]") {
    const SmallRotor rotor = make_rotor();
    check_refused([&] { (void)diagram_of(rotor, {}); }, {"number of rotor speeds = 0", "at least one"});
    check_refused([&] { (void)diagram_of(rotor, {1.0, not_a_number}); }, {"rotor speed number 2", "nan", "finite"});
    check_refused([&] { (void)diagram_of(rotor, {infinite}); }, {"rotor speed number 1", "inf"});
    check_refused(
        [&] {
            (void)diagram_of(make_rotor({.stiffness = {2000, 2000}}), {1.0}, {.method = CampbellMethod::coleman});
        },
        {"small rotor", "number of blades = 2", "two blades"});
    const Campbell d = diagram_of(rotor, {1.0});
    check_refused([&] { (void)d.branch("blade flop"); },
                  {"unknown mode 'blade flop'", "'blade flap (backward)'", "'blade flap (forward)'"});
    SmallRotor spinless = make_rotor();
    spinless.map.spin = -1;
    check_refused([&] { (void)diagram_of(spinless, {1.0}); }, {"rotor speed", "without rotor"});
}

TEST_CASE("campbell: without a constant steady state Coleman's method has no diagram", "[property]") {
    // Gravity in the rotor plane pulls at the lag hinges once per revolution.
    const SmallRotor rotor = make_rotor({.hinges = BladeHinges::lag, .gravity = {0, -units::standard_gravity, 0}});
    std::string message;
    try {
        (void)diagram_of(rotor, {2.0}, {.method = CampbellMethod::coleman});
    } catch (const NumericalError& error) {
        message = error.what();
    }
    CHECK(message.find("periodic") != std::string::npos);
    CHECK(diagram_of(rotor, {2.0}).method_reason == "there is no constant steady state");
}

}  // namespace cardan::testing::hinged_rotors
