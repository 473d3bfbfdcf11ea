// What the element library refuses, and how it says so.
#include "elements/cardan_beam.hpp"
#include "mbs/error.hpp"
#include "tests/elements/cantilever.hpp"
#include "tests/support/catch.hpp"

#include <limits>

using namespace cardan;
using namespace cardan::testing;
using Catch::Contains;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

void add(const BeamLine& line, const CardanBeamOptions& options = {}) {
    Tree tree;
    ForceSet forces;
    add_cardan_beam(tree, forces, Tree::base(), line, "blade 2", {"blade", 2}, options);
}

BeamLine good() {
    return uniform_beam(2, slender(1, 1));
}

}  // namespace

TEST_CASE("beam: delta must lie between 0 and 0.5") {
    for (const double delta : {0.0, 0.5, -0.1, 0.7, not_a_number})
        CHECK_THROWS_WITH(add(good(), bending_only(2, delta)),
                          Contains("blade 2: delta = ") && Contains("0 < delta < 0.5"));
}

TEST_CASE("beam: elements and boundaries") {
    CHECK_THROWS_WITH(add(good(), bending_only(0)), Contains("number of elements = 0"));
    CardanBeamOptions options = bending_only(2);
    options.boundaries = {0, 1.5, 1.0, 2};
    CHECK_THROWS_WITH(add(good(), options), Contains("element boundary 3") && Contains("increasing"));
    options.boundaries = {0, 1};
    CHECK_THROWS_WITH(add(good(), options), Contains("from 0 to the length 2"));
    options.boundaries = {0, not_a_number, 2};
    CHECK_THROWS_AS(add(good(), options), InputError);
    options.boundaries = {0, 0.3, 2};
    CHECK_NOTHROW(add(good(), options));
    options.damping = {-0.1, 1};
    CHECK_THROWS_WITH(add(good(), options), Contains("damping ratio"));
}

TEST_CASE("beam: length") {
    for (const double length : {0.0, -1.0, not_a_number, std::numeric_limits<double>::infinity()})
        CHECK_THROWS_WITH(uniform_beam(length, slender(1, 1), "tower"), Contains("tower: length [m] = "));
    CHECK_THROWS_WITH(add(BeamLine{1, {}, {}, "empty"}), Contains("section function is missing"));
    CHECK_THROWS_WITH(add(BeamLine{1, {0.5, 0.2}, good().section, "line"}),
                      Contains("station 2") && Contains("increasing"));
}

TEST_CASE("beam: a rigid direction that is left free is named") {
    CardanBeamOptions options = bending_only(1);
    options.extension = true;  // EA is infinite
    CHECK_THROWS_WITH(add(good(), options), Contains("blade 2 element 1") && Contains("must be locked"));
}

TEST_CASE("beam: torsion without polar inertia is a singular metric that names the coordinate") {
    EngineeringSection s = slender(1, 1);
    s.GJ = 1;
    Tree tree;
    ForceSet forces;
    add_cardan_beam(tree, forces, Tree::base(), uniform_beam(1, s), "rod", {"rod"}, {.elements = 1});
    CHECK_THROWS_WITH(Model(tree), Contains("rod element 1") && Contains("singular metric"));
}

TEST_CASE("section: every bad value is refused with its name") {
    const auto refuse = [](auto change, const char* quantity) {
        EngineeringSection s = slender(1, 1);
        change(s);
        CHECK_THROWS_WITH(uniform_beam(1, s, "tower"), Contains("tower: ") && Contains(quantity));
    };
    for (const double bad : {-1.0, not_a_number}) {
        refuse([bad](auto& s) { s.mass = bad; }, "mass per length [kg/m]");
        refuse([bad](auto& s) { s.EI_flap = bad; }, "EI flap");
        refuse([bad](auto& s) { s.EI_edge = bad; }, "EI edge");
        refuse([bad](auto& s) { s.GJ = bad; }, "GJ");
        refuse([bad](auto& s) { s.EA = bad; }, "EA");
        refuse([bad](auto& s) { s.GA_y = bad; }, "GA y");
        refuse([bad](auto& s) { s.j_edge = bad; }, "edge inertia");
    }
    refuse([](auto& s) { s.EI_flap = 0; }, "EI flap");
    refuse([](auto& s) { s.beta = not_a_number; }, "twist");
    refuse([](auto& s) { s.mass_centre.y = not_a_number; }, "offset");
}

TEST_CASE("section table: stations increase, one section each, the bad station is named") {
    const auto s = slender(1, 1);
    auto bad = s;
    bad.mass = -2;
    using T = Interpolation;
    CHECK_THROWS_WITH(SectionTable("blade", {0, 1, 1}, {s, s, s}, T::linear), Contains("station 3 [m] = 1"));
    CHECK_THROWS_WITH(SectionTable("blade", {0, not_a_number}, {s, s}, T::linear), Contains("station 2"));
    CHECK_THROWS_WITH(SectionTable("blade", {0}, {s}, T::linear), Contains("at least 2"));
    CHECK_THROWS_WITH(SectionTable("blade", {0, 1}, {s}, T::linear), Contains("one per station"));
    CHECK_THROWS_WITH(SectionTable("blade", {0, 4}, {s, bad}, T::linear),
                      Contains("station 2 (x = 4 m)") && Contains("= -2"));
}

TEST_CASE("section table: linear and log-linear interpolation between stations") {
    EngineeringSection a = slender(1, 2), b = slender(16, 4);
    a.beta = 0.1, b.beta = 0.3;
    const SectionTable log("blade", {1, 3}, {a, b}, Interpolation::log_linear_stiffness);
    CHECK(log.at(2).EI_flap == Approx(4));
    CHECK(log.at(2).mass == Approx(3));
    CHECK(log.at(2).beta == Approx(0.2));
    CHECK(SectionTable("blade", {1, 3}, {a, b}, Interpolation::linear).at(2).EI_flap == Approx(8.5));
    CHECK(log.line().length == Approx(2));
}

TEST_CASE("tube: wall, diameters and material") {
    TubeSpec t{10, 2, 1, {0.02, 0.01}, 2.1e11, 8e10, 7850, 0.5};
    // mass of a truncated cone of constant wall: pi rho t L (mean diameter - t)
    const BeamLine line = tube(t, "tower");
    const double half = pi * 7850 * 5;
    const ElementInertia whole = partition_element(line, 0, 10, 0.2, Partition::segment_masses);
    CHECK(whole.mass == Approx(half * (0.02 * (1.75 - 0.02) + 0.01 * (1.25 - 0.01))).epsilon(1e-12));
    t.wall_thickness = {0.02, 0.6};
    CHECK_THROWS_WITH(tube(t, "tower"), Contains("tower: wall thickness [m] = 0.6"));
    t.wall_thickness = {};
    CHECK_THROWS_AS(tube(t), InputError);
    t.wall_thickness = {0.01};
    t.density = -1;
    CHECK_THROWS_WITH(tube(t, "tower"), Contains("density"));
}
