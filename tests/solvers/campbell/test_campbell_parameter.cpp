// Modes over another parameter than the rotor speed: branches against closed forms, machines that change the order of
// their component modes, input that is refused, what is kept of a sweep that was ended.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "mbs/base/text.hpp"
#include "solvers/campbell/diagram.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardan::testing::campbell_parameters {

using namespace solvers;

namespace {

constexpr double mass = 3, arm = 4, offset = 0.5, inertia = mass * arm * arm;

// One rotor for several values of a parameter.
struct Machines {
    std::vector<SmallRotor> rotors;
    std::vector<double> parameters;
    double speed = 2;

    std::vector<CampbellCase> cases() const {
        std::vector<CampbellCase> list;
        for (std::size_t i = 0; i < rotors.size(); ++i)
            list.push_back({&rotors[i].system, &rotors[i].map, speed, parameters[i]});
        return list;
    }
    Campbell diagram(const CampbellOptions& options) const { return campbell(cases(), "stiffness, N m/rad", options); }
};

// Flap hinges of stiffness k, lag hinges of 3000 N m/rad outboard of them, no damping, no gravity: at zero angles the
// two do not couple.
constexpr double k_lag = 3000;
Machines hinged(std::size_t blades, const std::vector<double>& stiffness, double speed = 2) {
    Machines machines;
    machines.speed = speed;
    for (const double k : stiffness) {
        SmallRotorSpec spec;
        spec.stiffness = std::vector<double>(blades, k);
        spec.hinges = BladeHinges::flap_and_lag;
        spec.lag_to_flap = k_lag / k;
        spec.lag_damping = 0;
        machines.rotors.push_back(small_rotor(spec));
        machines.parameters.push_back(k);
    }
    return machines;
}

// In the rotating frame, rad/s: w^2 = k / (m l^2) + Omega^2 (1 + e / l) of flap, + Omega^2 e / l of lag.
double flap(double k, double Omega) {
    return std::sqrt(k / inertia + Omega * Omega * (1 + offset / arm));
}
double lag(double Omega) {
    return std::sqrt(k_lag / inertia + Omega * Omega * offset / arm);
}

CampbellOptions by(CampbellMethod method) {
    CampbellOptions options;
    options.method = method;
    options.spin = RotorSpin::prescribed;
    return options;
}

// EnergyFraction of the elastic energy in all components of a family.
double share_of(const Campbell& d, const CampbellMode& mode, const std::string& family) {
    double sum = 0;
    for (std::size_t c = 0; c < d.components.size(); ++c)
        if (d.components[c].family == family) sum += mode.shares[c].total();
    return sum;
}

}  // namespace

TEST_CASE("campbell over a parameter: flap crosses lag, and every branch keeps its name and its closed form",
          "[analytic]") {
    // Flap meets lag at k = 3000 - m l^2 Omega^2 = 2808 N m/rad.
    const Machines machines = hinged(2, {2500, 2700, 2790, 2830, 3000, 3400});
    const Campbell d = machines.diagram(by(CampbellMethod::floquet));
    CHECK(d.parameter == "stiffness, N m/rad");
    CHECK(d.parameters == machines.parameters);
    CHECK(d.complete);
    CHECK(d.crossings.empty());
    REQUIRE(d.points.size() == machines.parameters.size());
    REQUIRE(d.branches.size() == 4);
    for (const char* pattern : {" (symmetric)", " (antisymmetric)"})
        for (const bool flaps : {true, false}) {
            const Branch& branch = d.branch(std::string(flaps ? "blade flap" : "blade lag") + pattern);
            for (std::size_t i = 0; i < d.points.size(); ++i) {
                CAPTURE(branch.name, d.parameters[i]);
                const double expected = flaps ? flap(d.parameters[i], machines.speed) : lag(machines.speed);
                CHECK(d.points[i].rotor_speed == machines.speed);
                CHECK(2 * pi * d.natural_hz(branch, i) == Approx(expected).epsilon(1e-9));
                CHECK(branch.mac[i] > 0.98);
                CHECK_FALSE(branch.doubtful[i]);
                CHECK(branch.mostly[i] == branch.name);
            }
        }
}

TEST_CASE("campbell over a parameter: whirling branches in the fixed frame lie one rotor speed apart", "[analytic]") {
    const Machines machines = hinged(3, {2000, 2500, 2790, 2830, 3500});
    const double Omega = machines.speed;
    for (const CampbellMethod method : {CampbellMethod::coleman, CampbellMethod::averaged, CampbellMethod::floquet}) {
        const Campbell d = machines.diagram(by(method));
        REQUIRE(d.branches.size() == 6);
        for (const auto& [pattern, shift] :
             {std::pair{"collective", 0.0}, std::pair{"backward", -1.0}, std::pair{"forward", 1.0}})
            for (std::size_t i = 0; i < d.points.size(); ++i) {
                CAPTURE(d.method, pattern, d.parameters[i]);
                const double w = flap(d.parameters[i], Omega) + shift * Omega, v = lag(Omega) + shift * Omega;
                CHECK(2 * pi * d.natural_hz(d.branch(text("blade flap (", pattern, ")")), i) ==
                      Approx(w).epsilon(1e-9));
                CHECK(2 * pi * d.natural_hz(d.branch(text("blade lag (", pattern, ")")), i) == Approx(v).epsilon(1e-9));
            }
    }
}

TEST_CASE("campbell over a parameter: shares belong to the components of the first machine, whatever their order",
          "[analytic]") {
    // With everything else clamped lag is the higher one at first and the lower one at last.
    for (const bool rising : {true, false}) {
        Machines machines = hinged(2, {2000, 2900, 3100, 6000}, 0.5);
        if (!rising) {  // the other way round, over the softness
            std::reverse(machines.rotors.begin(), machines.rotors.end());
            for (double& p : machines.parameters) p = 1 / p;
            std::reverse(machines.parameters.begin(), machines.parameters.end());
        }
        const Campbell d = machines.diagram(by(CampbellMethod::floquet));
        REQUIRE(d.components.size() == 2);
        CHECK(d.components[0].family == (rising ? "blade flap" : "blade lag"));
        for (const std::string family : {"blade flap", "blade lag"})
            for (const char* pattern : {" (symmetric)", " (antisymmetric)"}) {
                const Branch& branch = d.branch(family + pattern);
                CHECK(entry(d.components, branch.component).family == family);
                for (std::size_t i = 0; i < d.points.size(); ++i) {
                    CAPTURE(rising, branch.name, d.parameters[i]);
                    CHECK(share_of(d, *d.mode(branch, i), family) == Approx(1).epsilon(1e-9));
                    for (std::size_t c = 0; c < 2; ++c)
                        CHECK(d.mode(branch, i)->shares[c].component == static_cast<int>(c));
                }
            }
    }
}

TEST_CASE("campbell over a parameter: the same points as sweeps over the rotor speed, one machine at a time",
          "[crosscheck]") {
    const Machines machines = hinged(2, {2100, 2600, 3300});
    std::vector<CampbellCase> cases = machines.cases();
    for (std::size_t i = 0; i < cases.size(); ++i) cases[i].rotor_speed = 1.0 + static_cast<double>(i);
    const CampbellOptions options = by(CampbellMethod::floquet);
    const Campbell all = campbell(cases, "case", options);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double speed[] = {cases[i].rotor_speed};
        const Campbell one = campbell(*cases[i].system, *cases[i].rotor, speed, options);
        CHECK(all.points[i].rotor_speed == speed[0]);
        REQUIRE(one.branches.size() == all.branches.size());
        for (const Branch& branch : one.branches) {
            CAPTURE(i, branch.name);
            CHECK(std::abs(one.mode(branch, 0)->mode.eigenvalue -
                           all.mode(all.branch(branch.name), i)->mode.eigenvalue) < 1e-9);
        }
        CHECK(one.parameter.empty());
        CHECK(one.parameters.empty());
    }
}

TEST_CASE("campbell over a parameter: a sweep that is ended keeps points and parameters alike", "[property]") {
    const Machines machines = hinged(2, {2000, 2500, 3000});
    CampbellOptions options = by(CampbellMethod::floquet);
    std::vector<std::pair<int, int>> told;
    options.progress = [&](int done, int total) { told.emplace_back(done, total); };
    options.cancelled = [&] { return told.size() == 2; };
    const Campbell d = machines.diagram(options);
    CHECK_FALSE(d.complete);
    CHECK(told == std::vector<std::pair<int, int>>{{1, 3}, {2, 3}});
    CHECK(d.points.size() == 2);
    CHECK(d.parameters == std::vector<double>{2000, 2500});
    for (const Branch& branch : d.branches) CHECK(branch.mode.size() == 2);
    CHECK_THAT(table(d), Catch::Contains("over stiffness, N m/rad") && Catch::Contains("2500") &&
                             Catch::Contains("interrupted") && !Catch::Contains("rpm"));
    options.cancelled = [] { return true; };
    const Campbell none = machines.diagram(options);
    CHECK_FALSE(none.complete);
    CHECK(none.points.empty());
    CHECK(none.parameters.empty());
    CHECK(table(none) == "no rotor speeds computed\n");
}

TEST_CASE("campbell over a parameter: machines that are made one by one are those given at once", "[property]") {
    const Machines machines = hinged(2, {2000, 2500, 3000});
    const std::vector<CampbellCase> cases = machines.cases();
    const CampbellOptions options = by(CampbellMethod::floquet);
    std::vector<std::string> order;
    CampbellOptions told = options;
    told.progress = [&](int done, int) { order.push_back(text("modes ", done)); };
    const NextCampbellCase next = [&, i = std::size_t(0)]() mutable -> std::optional<CampbellCase> {
        if (i == cases.size()) return std::nullopt;
        order.push_back(text("machine ", i + 1));
        return cases[i++];
    };
    const Campbell one_by_one = campbell(next, cases.size(), "stiffness, N m/rad", told);
    const Campbell at_once = machines.diagram(options);
    CHECK(order == std::vector<std::string>{"machine 1", "modes 1", "machine 2", "modes 2", "machine 3", "modes 3"});
    CHECK(table(one_by_one) == table(at_once));
    CHECK(one_by_one.parameters == at_once.parameters);
    CHECK(one_by_one.complete);
    const Campbell none = campbell([]() -> std::optional<CampbellCase> { return std::nullopt; }, 0, "x", options);
    CHECK(none.points.empty());
    CHECK_FALSE(none.complete);
    check_refused([&] { campbell(next, 3, "x", {}); }, {"method", "automatic"});
}

TEST_CASE("campbell over a parameter: an instability is told with its place on the axis", "[property]") {
    // Flaps that are driven by their own rates; coordinates: spin, flaps.
    SmallRotorSpec spec{.stiffness = {2000, 2000}};
    spec.more = [](ForceSet& forces, const std::vector<std::vector<BodyId>>&) {
        forces.add_element({.name = "push",
                            .points = {{Tree::base()}},
                            .evaluate =
                                [](const ElementView& at, ElementForces& out) {
                                    for (const int i : {1, 2}) out.Q(i) += 20 * at.qd(i);
                                },
                            .jacobian =
                                [](const ElementView&, ElementJacobian& d) {
                                    for (const int i : {1, 2}) d.Q_qd(i, i) += 20;
                                }});
    };
    const SmallRotor rotor = small_rotor(spec);
    const std::vector<CampbellCase> cases{{&rotor.system, &rotor.map, 2, 7}};
    const Campbell d = campbell(cases, "wind speed, m/s", by(CampbellMethod::floquet));
    CHECK_THAT(d.warning, Catch::Contains("unstable at wind speed 7 m/s, 19.1 rpm: a motion at"));
}

TEST_CASE("campbell over the rotor speed of machines that differ: closed forms, and one machine is a plain sweep",
          "[analytic]") {
    const CampbellOptions options = by(CampbellMethod::floquet);
    Machines machines = hinged(2, {2000, 2500, 3000});
    std::vector<CampbellCase> cases = machines.cases();
    const std::vector<double> speeds{1, 2, 4};
    for (std::size_t i = 0; i < speeds.size(); ++i) cases[i].rotor_speed = speeds[i];
    const Campbell differ = campbell(cases, "", options);
    CHECK(differ.parameter.empty());
    CHECK(differ.parameters.empty());
    CHECK(differ.rotor_speeds() == speeds);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        double nearest = 1e9;
        for (const Branch& branch : differ.branches)
            nearest = std::min(
                nearest, std::abs(2 * pi * differ.natural_hz(branch, i) - flap(machines.parameters[i], speeds[i])));
        CHECK(nearest < 1e-6 * flap(machines.parameters[i], speeds[i]));
    }
    for (CampbellCase& one : cases) one.system = cases[0].system, one.rotor = cases[0].rotor;
    const Campbell same = campbell(cases, "", options),
                   plain = campbell(*cases[0].system, *cases[0].rotor, speeds, options);
    REQUIRE(same.branches.size() == plain.branches.size());
    REQUIRE(same.crossings.size() == plain.crossings.size());
    for (std::size_t b = 0; b < plain.branches.size(); ++b) {
        CHECK(same.branches[b].name == plain.branches[b].name);
        for (std::size_t i = 0; i < speeds.size(); ++i)
            CHECK(same.natural_hz(same.branches[b], i) == Approx(plain.natural_hz(plain.branches[b], i)).epsilon(1e-9));
    }
}

TEST_CASE("campbell over a parameter: what cannot be computed is refused", "[property]") {
    const Machines machines = hinged(2, {2000, 2500, 3000});
    const CampbellOptions options = by(CampbellMethod::floquet);
    const std::vector<CampbellCase> good = machines.cases();
    const auto refused = [&](const std::vector<CampbellCase>& cases, std::initializer_list<std::string> parts) {
        check_refused([&] { (void)campbell(cases, "stiffness", options); }, parts);
    };
    refused({}, {"Campbell diagram", "number of points = 0", "at least one"});
    // All turn at one speed: over the rotor speed they are one point.
    check_refused([&] { (void)campbell(good, "", options); }, {"rotor speed [rad/s] = 2", "increasing"});
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    for (const auto& [value, shown] :
         {std::pair{nan, "nan"}, std::pair{inf, "inf"}, std::pair{2000.0, "2000"}, std::pair{1000.0, "1000"}}) {
        std::vector<CampbellCase> cases = good;
        cases[1].parameter = value;
        refused(cases, {text("stiffness = ", shown), "finite and increasing"});
    }
    for (const auto& [value, shown] : {std::pair{nan, "nan"}, std::pair{inf, "inf"}, std::pair{-1.0, "-1"}}) {
        std::vector<CampbellCase> cases = good;
        cases[2].rotor_speed = value;
        refused(cases, {text("rotor speed [rad/s] = ", shown), "finite and >= 0"});
    }
    // Other coordinates; then the same rows whose springs make another set of component modes.
    const SmallRotor flaps_only = small_rotor({.stiffness = {2000, 2000}});
    std::vector<CampbellCase> cases = good;
    cases[1] = {&flaps_only.system, &flaps_only.map, 2, 2500};
    refused(cases, {"small rotor", "rows at stiffness 2500 = 2", "those of the first machine"});
    const Machines free_lag = [] {
        Machines m = hinged(2, {2000});
        SmallRotorSpec spec;
        spec.stiffness = {2000, 2000};
        spec.hinges = BladeHinges::flap_and_lag;
        spec.lag_to_flap = 0;
        m.rotors = {small_rotor(spec)};
        return m;
    }();
    cases = good;
    cases[1] = free_lag.cases()[0];
    cases[1].parameter = 2500;
    refused(cases, {"small rotor", "component modes at point 2 = 1", "2, of every part as many"});
    // All are looked at before the first is computed.
    int computed = 0;
    cases = good;
    cases[2].rotor = nullptr;
    CampbellOptions counted = options;
    counted.progress = [&](int, int) { ++computed; };
    check_refused([&] { (void)campbell(cases, "stiffness", counted); },
                  {"system and rotor at stiffness 3000 = none", "both"});
    CHECK(computed == 0);
    // Two blades have no constant multi-blade system.
    check_refused([&] { (void)campbell(good, "stiffness", by(CampbellMethod::coleman)); },
                  {"number of blades = 2", "floquet"});
}

}  // namespace cardan::testing::campbell_parameters
