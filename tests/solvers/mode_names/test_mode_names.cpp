// Names of modes in the style of reports and tools around OpenFAST.
#include "solvers/mode_names/community_names.hpp"
#include "tests/support/catch.hpp"

using namespace cardan;
using solvers::community_name;

TEST_CASE("mode names: families and whirl in the words of the wind energy community", "[property]") {
    CHECK(community_name("1st tower fore-aft") == "1st Tower FA");
    CHECK(community_name("2nd tower side-side") == "2nd Tower SS");
    CHECK(community_name("1st blade flap (backward)") == "1st Blade Flap (Regressive)");
    CHECK(community_name("1st blade flap (collective)") == "1st Blade Flap (Collective)");
    CHECK(community_name("2nd blade edge (forward)") == "2nd Blade Edge (Progressive)");
    CHECK(community_name("4th blade flap (sine)") == "4th Blade Flap (Sine)");
    CHECK(community_name("1st drive-train torsion") == "1st Drivetrain Torsion");
}

TEST_CASE("mode names: a family with a single member becomes the first of its kind", "[property]") {
    CHECK(community_name("drive-train torsion") == "1st Drivetrain Torsion");
    CHECK(community_name("rotor yaw") == "1st Nacelle Yaw");
    CHECK(community_name("blade pitch (collective)") == "1st Blade Pitch (Collective)");
}

TEST_CASE("mode names: those of a platform are not counted, unless there are several alike", "[property]") {
    CHECK(community_name("platform surge") == "Platform Surge");
    CHECK(community_name("platform yaw") == "Platform Yaw");
    CHECK(community_name("2nd platform pitch") == "2nd Platform Pitch");
}

TEST_CASE("mode names: families without a usual name keep theirs, higher harmonics their number", "[property]") {
    CHECK(community_name("12th yaw bearing fore-aft") == "12th Yaw Bearing Fore-aft");
    CHECK(community_name("1st blade flap (backward, 2)") == "1st Blade Flap (Regressive, 2)");
    CHECK(community_name("").empty());
    CHECK(community_name("3rd") == "3rd ");
}

TEST_CASE("mode names: a renamed diagram has them everywhere but in its families, and the other style changes nothing",
          "[property]") {
    solvers::Campbell diagram;
    solvers::Branch branch;
    branch.name = "1st tower fore-aft";
    branch.family = "tower fore-aft";
    branch.mode = {-1, 0};
    branch.mostly = {"", "1st tower side-side"};
    branch.doubt = {"hardly whirls", "mostly 1st tower side-side"};
    diagram.branches.push_back(branch);
    const solvers::Campbell named = solvers::renamed(diagram, solvers::NameStyle::community);
    CHECK(&named.branch("1st Tower FA") == &named.branches.front());
    CHECK(named.branches.front().family == "tower fore-aft");
    CHECK(named.branches.front().mostly == std::vector<std::string>{"", "1st Tower SS"});
    CHECK(named.branches.front().doubt == std::vector<std::string>{"hardly whirls", "mostly 1st Tower SS"});
    CHECK(solvers::renamed(diagram, solvers::NameStyle::descriptive).branches.front().name == branch.name);
}
