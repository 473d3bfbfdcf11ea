// Branches that exchange their characters; machines of different meshes compared by their lines.
//
// Reference: exchanges written by hand; motions whose MAC is known.
#include "mbs/base/entry.hpp"
#include "solvers/mode_names/detail/hand_over.hpp"
#include "solvers/mode_names/detail/line_likeness.hpp"
#include "tests/support/catch.hpp"

#include <cmath>

using namespace cardan;
using namespace cardan::solvers;

namespace cardan::testing::hand_over {

namespace {

// Modes 0 and 1 at every point, tracked as branches 0 and 1.
struct Exchange {
    std::vector<CampbellPoint> points;
    std::vector<Branch> branches;
    std::vector<Naming> namings;

    explicit Exchange(std::size_t count) : points(count), branches(2), namings{{{0}}, {{1}}} {
        for (CampbellPoint& point : points) {
            point.rotor_speed = 1;
            for (int c = 0; c < 2; ++c) point.modes.emplace_back().shares = {{0, 0.5}, {1, 0.5}, {2, 0.0}};
        }
        for (int b = 0; b < 2; ++b) {
            entry(branches, b).mode.assign(count, b);
            entry(branches, b).mac.assign(count, 1);
        }
    }

    // Label of a mode at a point, -1: none is certain.
    void run(const std::vector<std::vector<int>>& certain, bool more = true) {
        static const std::vector<Label> labels{{0}, {1}, {2}};
        const auto name = [&](std::size_t point, int mode) -> HandOver::Name {
            const int label = entry(certain[point], mode);
            return {label < 0 ? nullptr : &entry(labels, label)};
        };
        const auto mac = [](std::size_t, int before, std::size_t, int now) { return before == now ? 0.9 : 0.1; };
        HandOver(points, name, mac).run(branches, namings, more);
    }
};

using List = std::vector<int>;

// A line of frames along z, from 0 to `length`, that moves as u(z / length) in x.
template <class F>
Campbell line(double length, int frames, F u) {
    Campbell d;
    Polyline& own = d.lines.emplace_back(Polyline{"tower", 0, {}});
    std::vector<FrameMotion>& motion = d.motions.emplace_back().emplace_back();
    for (int i = 0; i < frames; ++i) {
        const double s = static_cast<double>(i) / (frames - 1);
        own.points.push_back(FrameId{i});
        d.frame_positions.emplace_back(0, 0, s * length);
        motion.emplace_back().motion.setZero();
        motion.back().motion(3) = u(s);
    }
    return d;
}

double mac(const Campbell& a, const Campbell& b) {
    return LineLikeness(a, b).mac({&a.motions[0][0]}, b.motions[0])(0, 0);
}

}  // namespace

TEST_CASE("hand over: certain names cross where curves exchange their characters, what is open stays on its curve",
          "[property]") {
    Exchange veering(5);
    veering.run({{0, 1}, {0, 1}, {-1, -1}, {1, 0}, {1, -1}});
    CHECK(veering.branches[0].mode == List{0, 0, 0, 1, 1});
    CHECK(veering.branches[1].mode == List{1, 1, 1, 0, 0});
    CHECK(veering.branches[0].mac == std::vector{1.0, 0.9, 0.9, 0.1, 0.9});
    REQUIRE(veering.branches.size() == 2);
}

TEST_CASE("hand over: nothing changes where names are those of the curves, or are open", "[property]") {
    for (const List& certain : {List{0, 1}, List{-1, -1}, List{0, -1}, List{0, 0}}) {
        Exchange same(3);
        same.run({certain, certain, certain});
        CHECK(same.branches[0].mode == List{0, 0, 0});
        CHECK(same.branches[1].mode == List{1, 1, 1});
    }
}

TEST_CASE("hand over: a name that no branch has gets one, unless names come from elsewhere", "[property]") {
    Exchange three(3);
    three.run({{0, 1}, {0, 1}, {0, 2}});
    REQUIRE(three.branches.size() == 3);
    CHECK(three.branches[1].mode == List{1, 1, -1});
    CHECK(three.branches[2].mode == List{-1, -1, 1});
    CHECK(three.branches[2].mac == std::vector{0.0, 0.0, 1.0});
    Exchange two(3);
    two.run({{0, 1}, {0, 1}, {0, 2}}, false);
    REQUIRE(two.branches.size() == 2);
    CHECK(two.branches[1].mode == List{1, 1, 1});
}

TEST_CASE("line likeness: one motion is alike whatever frames are on the line, and on a longer one", "[analytic]") {
    const auto linear = [](double s) { return s; };
    CHECK(mac(line(50, 3, linear), line(50, 8, linear)) == Approx(1).epsilon(1e-12));
    CHECK(mac(line(50, 3, linear), line(60, 8, linear)) == Approx(1).epsilon(1e-12));
    // Between frames the motion is linear: the error of the second order goes with 1/n^2, that of the MAC with 1/n^4.
    const auto parabola = [](double s) { return s * s; };
    const auto error = [&](int n) { return 1 - mac(line(50, n + 1, parabola), line(50, 65, parabola)); };
    CHECK(error(4) < 1e-3);
    CHECK(std::log2(error(4) / error(8)) == Approx(4).margin(0.5));
    // (int s s^2 ds)^2 / (int s^2 ds int s^4 ds) = (1/16) 15, by the midpoint rule over 40 parts.
    CHECK(mac(line(50, 65, linear), line(50, 65, parabola)) == Approx(15.0 / 16).epsilon(1e-3));
}

}  // namespace cardan::testing::hand_over
