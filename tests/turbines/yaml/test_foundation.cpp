// Foundations as matrices at the tower's foot: a rigid machine on springs by hand, held directions, what is refused.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "mbs/model/summary.hpp"
#include "solvers/equilibrium/natural_modes.hpp"
#include "tests/support/catch.hpp"
#include "turbines/model/description_text.hpp"
#include "turbines/reference_turbines/wt600.hpp"
#include "turbines/yaml/description.hpp"
#include "turbines/yaml/foundation.hpp"

#include <algorithm>

namespace cardan::testing::foundations {

using namespace turbines;

namespace {

constexpr auto vertical_only =
    "stiffness:\n- [.inf, 0, 0, 0, 0, 0]\n- [0, .inf, 0, 0, 0, 0]\n- [0, 0, 4.0e8, 0, 0, 0]\n"
    "- [0, 0, 0, .inf, 0, 0]\n- [0, 0, 0, 0, .inf, 0]\n- [0, 0, 0, 0, 0, .inf]\n";

std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

std::string mass(double vertical) {
    std::string text = "mass:\n";
    for (int i = 0; i < 6; ++i) {
        text += "- [";
        for (int j = 0; j < 6; ++j) text += cardan::text(j > 0 ? ", " : "", i == 2 && j == 2 ? vertical : 0.0);
        text += "]\n";
    }
    return text;
}

// Heave, far below the first frequency of the tower.
double lowest_hz(const PlatformDescription& foundation) {
    TurbineDescription d = wt600_description();
    d.platform = foundation;
    double lowest = 1e9;
    for (const solvers::Mode& mode :
         solvers::natural_modes(assemble(d, {.tower_elements = 2, .blade_elements = 2}).system()).modes)
        if (mode.oscillates()) lowest = std::min(lowest, mode.natural_hz());
    return lowest;
}

}  // namespace

TEST_CASE("foundation: a soft vertical spring carries the machine and its own mass as a rigid body", "[analytic]") {
    const Turbine alone = assemble(wt600_description(), {.tower_elements = 2, .blade_elements = 2});
    double total = 0;
    for (const PartMass& part : masses_by_part(alone.tree())) total += part.mass;
    // Far below the first frequencies of tower and blades; the machine's own flexibility lowers it by little.
    const std::string soft = with(vertical_only, "4.0e8", "2.0e4");
    CHECK(2 * pi * lowest_hz(parse_foundation(soft, "soft")) == Approx(std::sqrt(2e4 / total)).epsilon(1e-3));
    const std::string heavy = soft + mass(3 * total);
    CHECK(2 * pi * lowest_hz(parse_foundation(heavy, "heavy")) == Approx(std::sqrt(2e4 / (4 * total))).epsilon(1e-3));
}

TEST_CASE("foundation: directions without end of stiffness are held", "[property]") {
    const PlatformDescription foundation = parse_foundation(vertical_only, "f");
    CHECK(foundation.hydrostatic_stiffness(2, 2) == 4e8);
    CHECK(foundation.hydrostatic_stiffness(0, 0) == 0);
    for (const std::size_t i : {0u, 1u, 3u, 4u, 5u})
        CHECK(foundation.coordinates.roles.at(i) == CoordinateRole::prescribed);
    CHECK_FALSE(foundation.coordinates.roles.at(2));
}

TEST_CASE("foundation: other keys, sizes and matrices that are not symmetric are refused", "[property]") {
    const auto refused = [](const std::string& text, std::initializer_list<std::string> parts) {
        std::string message;
        try {
            (void)parse_foundation(text, "f.yaml");
        } catch (const Error& error) {
            message = error.what();
        }
        for (const std::string& part : parts) CHECK_THAT(message, Catch::Contains(part));
    };
    refused("mass: 1\n", {"f.yaml", "stiffness"});
    refused(std::string(vertical_only) + "springs: 1\n", {"f.yaml:8", "unknown key", "stiffness, mass and damping"});
    refused(with(vertical_only, "[0, 0, 4.0e8, 0, 0, 0]", "[0, 0, 4.0e8, 0, 0]"),
            {"f.yaml:4", "5 numbers; allowed: 6"});
    refused(with(vertical_only, "4.0e8", "-4.0e8"), {"f.yaml", "entry 3, 3 = -400000000; allowed: > 0, or .inf"});
    const std::string two = with(vertical_only, "[0, .inf, 0, 0, 0, 0]", "[0, 1.0e8, 0, 0, 0, 0]");
    CHECK_NOTHROW(parse_foundation(two, "f.yaml"));
    refused(with(two, "[0, 0, 4.0e8, 0, 0, 0]", "[0, 1.0e7, 4.0e8, 0, 0, 0]"), {"f.yaml", "symmetric"});
    const std::string coupled = with(two, "[0, 0, 4.0e8, 0, 0, 0]", "[0, 3.0e8, 4.0e8, 0, 0, 0]");
    refused(with(coupled, "[0, 1.0e8, 0, 0", "[0, 1.0e8, 3.0e8, 0"), {"lowest eigenvalue", "> 0"});
    refused("stiffness:\n- [1, 2]\n", {"f.yaml", "1 rows; allowed: 6"});
}

TEST_CASE("foundation: one that a description does not hold is known by its name in YAML too", "[property]") {
    TurbineDescription d = wt600_description();
    CHECK_THAT(description_text(d), !Catch::Contains("missing_foundation"));
    d.missing_foundation = {"floating platform", "10 m above the still water"};
    const TurbineDescription again = parse_description(description_text(d), "own");
    CHECK(again.missing_foundation.name == d.missing_foundation.name);
    CHECK(again.missing_foundation.where == d.missing_foundation.where);
}

}  // namespace cardan::testing::foundations
