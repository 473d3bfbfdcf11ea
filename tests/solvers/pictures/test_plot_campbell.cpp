#include "solvers/pictures/campbell.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;
using cardan::test::bytes_of;
using cardan::test::Folder;
using Catch::Matchers::Contains;

namespace {

Campbell without_doubt() {
    Campbell diagram = diagram_of(small_rotor({.stiffness = {2000, 2000, 2000}, .damping = 3}), {0, 1, 2, 3});
    for (Branch& branch : diagram.branches) std::fill(branch.doubtful.begin(), branch.doubtful.end(), false);
    return diagram;
}

std::string drawn(const Campbell& diagram, const CampbellPlotOptions& options = {}) {
    const Folder folder;
    plot(diagram, folder.path / "a.svg", options);
    return bytes_of(folder / "a.svg");
}

int count(const std::string& text, const std::string& part) {
    int found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

const std::string hollow = "#gpPt5' transform";  // an open circle in gnuplot's SVG

}  // namespace

TEST_CASE("Campbell pictures: axes with units, multiples of the rotor speed, every branch by name", "[property]") {
    const Campbell diagram = without_doubt();
    const std::string svg = drawn(diagram, {.title = "a small_rotor"});
    for (const char* expected :
         {"a small_rotor", "rotor speed, rev/min", "damped frequency, Hz", "damping ratio, %", ">1P<", ">3P<", ">6P<"})
        CHECK_THAT(svg, Contains(expected));
    REQUIRE(diagram.branches.size() >= 3);
    for (const Branch& branch : diagram.branches) CHECK_THAT(svg, Contains(branch.name));
    CHECK(count(svg, "damping ratio") == 1);
    CHECK(count(drawn(diagram, {.damping_panel = false}), "damping ratio") == 0);
}

TEST_CASE("Campbell pictures: a doubtful name is a hollow point in both panels, and the legend says what it is",
          "[property]") {
    Campbell diagram = without_doubt();
    const std::string sure = drawn(diagram);
    CHECK(sure.find("in doubt") == std::string::npos);
    CHECK(count(sure, hollow) == 0);
    diagram.branches[0].doubtful[1] = diagram.branches[1].doubtful[2] = diagram.branches[1].doubtful[3] = true;
    const std::string doubtful = drawn(diagram);
    CHECK_THAT(doubtful, Contains(">name or frequency in doubt<"));
    CHECK(count(doubtful, hollow) == 2 * 3 + 1);
    CHECK(count(drawn(diagram, {.damping_panel = false}), hollow) == 3 + 1);
}

// Where the label of a multiple stands, in pixels from the top.
static double label_height(const std::string& svg, const std::string& label) {
    const std::size_t at = svg.rfind("translate(", svg.find(">" + label + "<")), comma = svg.find(',', at);
    return std::stod(svg.substr(comma + 1));
}

TEST_CASE("Campbell pictures: multiples of the rotor speed follow it over another parameter", "[analytic]") {
    const SmallRotor rotor = small_rotor({.stiffness = {2000, 2000, 2000}, .damping = 3});
    const auto distance = [&](double last) {  // of 3P and 1P at the end
        std::vector<CampbellCase> cases;
        for (const auto& [wind, speed] : {std::pair(4.0, 1.0), std::pair(8.0, 1.5), std::pair(12.0, last)})
            cases.push_back({.system = &rotor.system, .rotor = &rotor.map, .rotor_speed = speed, .parameter = wind});
        const std::string svg = drawn(campbell(cases, "wind speed, m/s"), {.max_frequency_hz = 4});
        return label_height(svg, "1P") - label_height(svg, "3P");
    };
    const double slow = distance(1), fast = distance(2);
    CHECK(slow > 10);
    CHECK(fast == Approx(2 * slow).margin(0.3));  // a pixel has one decimal
}

TEST_CASE("Campbell pictures: diagrams over each other, the others as points, with all names", "[property]") {
    const Campbell diagram = without_doubt();
    Campbell fast = diagram_of(small_rotor({.stiffness = {4000, 4000, 4000}, .damping = 3}), {1, 2, 5});
    const std::string cross = "#gpPt0' transform";  // +
    CHECK(count(drawn(diagram), cross) == 0);
    const CampbellPlotOptions both{.others = {{"stiff", &fast}}, .name = "soft"};
    const std::string svg = drawn(diagram, both);
    CHECK_THAT(svg, Contains("lines: soft") && Contains(">stiff<"));
    // In both panels a point for each frequency and damping, and one in the legend.
    std::size_t points = 0;
    for (const Branch& branch : fast.branches)
        for (std::size_t i = 0; i < fast.points.size(); ++i) {
            const CampbellMode* mode = fast.mode(branch, i);
            if (!mode) continue;
            points += mode->kind() != FloquetKind::aperiodic && std::isfinite(fast.damping_ratio(branch, i)) ? 2 : 1;
        }
    CHECK(count(svg, cross) == static_cast<int>(points) + 1);
    CHECK_THAT(svg, Contains(">45<"));  // rev/min, to the last speed of both
    fast.parameter = "wind speed, m/s";
    testing::check_refused([&] { drawn(diagram, both); }, {"axis of stiff", "wind speed", "rotor speed, rev/min"});
    const CampbellPlotOptions many{.others = std::vector<OtherDiagram>(5, {"another", &diagram}), .name = "a"};
    testing::check_refused([&] { drawn(diagram, many); }, {"others = 5", "at most 4"});
}
