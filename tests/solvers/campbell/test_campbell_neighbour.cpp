// Names of modes that are continued from the Campbell diagram of a neighbouring variant; what is marked doubtful.
#include "mbs/base/entry.hpp"
#include "mbs/base/error.hpp"
#include "solvers/campbell/diagram.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>
#include <cmath>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

// Flap hinges of stiffness k, lag hinges of 3000 N m/rad outboard of them: at zero angles the two do not couple.
SmallRotor flap_and_lag_variant(double k, std::size_t blades = 3) {
    SmallRotorSpec spec;
    spec.stiffness = std::vector<double>(blades, k);
    spec.hinges = testing::BladeHinges::flap_and_lag;
    spec.lag_to_flap = 3000 / k;
    spec.lag_damping = 0;
    return small_rotor(spec);
}

Campbell variant_diagram(const SmallRotor& rotor, const Campbell* neighbour = nullptr,
                         std::vector<double> speeds = {0.5, 1, 2}, CampbellOptions options = {}) {
    options.spin = RotorSpin::prescribed;
    options.neighbour = neighbour;
    return campbell(rotor.system, rotor.map, speeds, options);
}

// 2 pi times the collective flap frequency, sqrt(k / (m l^2) + Omega^2 (1 + e / l)).
double collective_flap(double k, double Omega) {
    return std::sqrt(k / 48 + Omega * Omega * (1 + 0.5 / 4));
}

bool always_doubtful(const Branch& branch) {
    for (std::size_t i = 0; i < branch.mode.size(); ++i)
        if (branch.mode[i] >= 0 && !branch.doubtful[i]) return false;
    return true;
}
bool never_doubtful(const Branch& branch) {
    return std::none_of(branch.doubtful.begin(), branch.doubtful.end(), [](bool doubt) { return doubt; });
}

void exchange_names(Branch& a, Branch& b) {
    std::swap(a.name, b.name);
    std::swap(a.family, b.family);
    std::swap(a.component, b.component);
    std::swap(a.pattern, b.pattern);
}

}  // namespace

TEST_CASE("campbell neighbour: names are those of the same modes there, whatever the order of the components",
          "[analytic]") {
    // With everything else clamped lag is the higher one before 3000 N m/rad and the lower one after.
    for (const CampbellMethod method : {CampbellMethod::coleman, CampbellMethod::floquet}) {
        CampbellOptions options;
        options.method = method;
        const Campbell before = variant_diagram(flap_and_lag_variant(2900), nullptr, {0.5, 1, 2}, options);
        const Campbell now = variant_diagram(flap_and_lag_variant(3100), &before, {0.5, 1, 2}, options);
        REQUIRE(before.components[0].family != now.components[0].family);
        REQUIRE(now.branches.size() == 6);
        for (const Branch& branch : now.branches) {
            CAPTURE(now.method, branch.name);
            CHECK(before.branch(branch.name).family == branch.family);
            CHECK(entry(now.components, branch.component).family == branch.family);
            CHECK(never_doubtful(branch));
        }
        const Branch& flap = now.branch("blade flap (collective)");
        for (std::size_t i = 0; i < now.points.size(); ++i)
            CHECK(2 * pi * now.natural_hz(flap, i) ==
                  Approx(collective_flap(3100, now.points[i].rotor_speed)).epsilon(1e-9));
    }
}

TEST_CASE("campbell neighbour: a name is continued against the energy, and then it is doubtful", "[property]") {
    const SmallRotor rotor = flap_and_lag_variant(2000);
    Campbell before = variant_diagram(rotor);
    const auto find = [&](const char* name) {
        return std::find_if(before.branches.begin(), before.branches.end(),
                            [&](const Branch& b) { return b.name == name; });
    };
    exchange_names(*find("blade flap (collective)"), *find("blade lag (collective)"));
    const Campbell now = variant_diagram(flap_and_lag_variant(2010), &before);
    const Branch& flap = now.branch("blade lag (collective)");
    CHECK(2 * pi * now.natural_hz(flap, 1) == Approx(collective_flap(2010, 1)).epsilon(1e-9));
    CHECK(flap.family == "blade lag");
    CHECK(flap.mostly[1] == "blade flap (collective)");
    CHECK(always_doubtful(flap));
    CHECK(never_doubtful(now.branch("blade flap (backward)")));
}

TEST_CASE("campbell neighbour: what the neighbour does not have is doubtful, at all speeds", "[property]") {
    // Flap is lower than lag; the limit lies between them.
    const SmallRotor rotor = flap_and_lag_variant(500);
    CampbellOptions low;
    low.max_frequency_hz = 0.8;
    const Campbell before = variant_diagram(rotor, nullptr, {0.5, 1}, low);
    REQUIRE(before.branches.size() == 3);
    // 0.7 rad/s and 2 rad/s are not in the neighbour: there the branch is followed from the other speeds.
    const Campbell now = variant_diagram(flap_and_lag_variant(505), &before, {0.5, 0.7, 1, 2});
    REQUIRE(now.branches.size() == 6);
    for (const Branch& branch : now.branches) {
        CAPTURE(branch.name);
        CHECK(branch.family == (branch.name.starts_with("blade flap") ? "blade flap" : "blade lag"));
        if (branch.family == "blade flap")
            CHECK(never_doubtful(branch));
        else
            CHECK(always_doubtful(branch));
    }
}

TEST_CASE("campbell neighbour: two candidates for a name are doubtful both", "[analytic]") {
    // The neighbour's collective shapes turned by 45 degrees in the energy: flap + lag and flap - lag have a MAC of 1/2
    // with each.
    const SmallRotor rotor = flap_and_lag_variant(2900);
    Campbell before = variant_diagram(rotor);
    const Branch &flap = before.branch("blade flap (collective)"), &lag = before.branch("blade lag (collective)");
    for (std::size_t i = 0; i < before.points.size(); ++i) {
        Mode& a = entry(before.points[i].modes, flap.mode[i]).mode;
        Mode& b = entry(before.points[i].modes, lag.mode[i]).mode;
        const ComplexVector x = a.shape, y = b.shape;
        a.shape = (x + y) / std::sqrt(2.0);
        b.shape = (x - y) / std::sqrt(2.0);
    }
    const Campbell now = variant_diagram(rotor, &before);
    for (const Branch& branch : now.branches) {
        CAPTURE(branch.name);
        if (branch.pattern == RotorPattern::collective)
            CHECK(always_doubtful(branch));
        else
            CHECK(never_doubtful(branch));
    }
}

TEST_CASE("campbell names: what belongs to no part of the map is not named after other parts, continued or not",
          "[property]") {
    // The support that tilts and yaws.
    const auto supported = [](double k) { return small_rotor({.stiffness = {k, k, k}, .elastic_support = true}); };
    const Campbell before = variant_diagram(supported(2000));
    const Campbell now = variant_diagram(supported(2020), &before);
    for (const Campbell* d : {&before, &now}) {
        REQUIRE(d->branches.size() == 5);
        for (const Branch& branch : d->branches) {
            CAPTURE(branch.name);
            CHECK(branch.name.find("another") == std::string::npos);
        }
        CHECK(std::ranges::count_if(d->branches, [](const Branch& b) { return b.family == "blade flap"; }) == 3);
    }
    for (std::size_t b = 0; b < now.branches.size(); ++b) CHECK(now.branches[b].name == before.branches[b].name);
}

TEST_CASE("campbell neighbour: a diagram of another kind is refused", "[property]") {
    const SmallRotor rotor = flap_and_lag_variant(2000);
    const Campbell before = variant_diagram(rotor);
    const auto refused = [&](const Campbell& neighbour, const SmallRotor& machine,
                             std::initializer_list<std::string> parts, const std::vector<double>& speeds = {1}) {
        check_refused([&] { (void)variant_diagram(machine, &neighbour, speeds); }, parts);
    };
    CampbellOptions floquet;
    floquet.method = CampbellMethod::floquet;
    refused(variant_diagram(rotor, nullptr, {1}, floquet), rotor,
            {"neighbouring Campbell diagram", "method = Floquet", "Coleman (fixed frame)"});
    refused(before, flap_and_lag_variant(2000, 4), {"number of blades = 3", "4, as the other"});
    Campbell without_motions = before;
    without_motions.motions.clear();
    refused(without_motions, small_rotor(), {"row 2 of the modes", "as the other; else both with lines"});
    refused(before, rotor, {"number of rotor speeds that both diagrams have = 0", "at least one"}, {0.75, 1.5});
    Campbell over_stiffness = before;
    over_stiffness.parameter = "stiffness";
    refused(over_stiffness, rotor, {"parameter = stiffness", "over the rotor speed"});
    const CampbellCase one{&rotor.system, &rotor.map, 1, 2000};
    CampbellOptions options;
    options.neighbour = &before;
    check_refused([&] { (void)campbell(std::span(&one, 1), "stiffness", options); },
                  {"neighbour of a diagram over stiffness", "from one machine to the next"});
}
