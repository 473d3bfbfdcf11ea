// Curves in space by arc length, and the frames carried along them.
#include "elements/cardan_beam/element_line.hpp"
#include "elements/sections/beam_line.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/tree_tools.hpp"

#include <Eigen/Geometry>

using namespace cardan;
using namespace cardan::testing;

namespace {

struct Helix {  // about the z axis
    double a = 2, b = 0.7;
    double c() const { return std::hypot(a, b); }
    double torsion() const { return b / (c() * c()); }
    Vec3 position(double t) const { return {a * std::cos(t), a * std::sin(t), b * t}; }
    Vec3 derivative(double t) const { return {-a * std::sin(t), a * std::cos(t), b}; }
    Vec3 normal(double t) const { return {-std::cos(t), -std::sin(t), 0}; }
    Vec3 binormal(double t) const { return Vec3(b * std::sin(t), -b * std::cos(t), a) / c(); }
    ReferenceLine line(double first, double last) const {
        return ReferenceLine::curve([h = *this](double t) { return h.position(t); },
                                    [h = *this](double t) { return h.derivative(t); }, first, last);
    }
};

// A swept and pre-bent blade axis; its arc length has no closed form.
Vec3 blade_axis(double x) {
    return {x, -0.004 * x * x, -0.02 * x + 0.0002 * x * x * x};
}
Vec3 blade_slope(double x) {
    return {1, -0.008 * x, -0.02 + 0.0006 * x * x};
}

// Length by Gauss' rule of 5 points on many pieces, apart from the library's.
double length_to(double x) {
    const double u = std::sqrt(5 - 2 * std::sqrt(10. / 7)) / 3, v = std::sqrt(5 + 2 * std::sqrt(10. / 7)) / 3;
    const double wu = (322 + 13 * std::sqrt(70.0)) / 900, wv = (322 - 13 * std::sqrt(70.0)) / 900;
    double sum = 0;
    constexpr int pieces = 200;
    for (int i = 0; i < pieces; ++i) {
        const double m = x * (i + 0.5) / pieces, h = x / (2.0 * pieces);
        sum += h * (128. / 225 * blade_slope(m).norm() +
                    wu * (blade_slope(m - u * h).norm() + blade_slope(m + u * h).norm()) +
                    wv * (blade_slope(m - v * h).norm() + blade_slope(m + v * h).norm()));
    }
    return sum;
}

// Points of the blade axis, unevenly spaced.
std::vector<Vec3> blade_points(int n) {
    std::vector<Vec3> points;
    for (int i = 0; i <= n; ++i) {
        const double t = static_cast<double>(i) / n;
        points.push_back(blade_axis(30 * t * (0.8 + 0.2 * t)));
    }
    return points;
}

}  // namespace

TEST_CASE("reference line: a circle has its arc length and the frames of a plane curve", "[analytic]") {
    constexpr double R = 3;
    const ReferenceLine circle = ReferenceLine::curve(
        [](double t) { return Vec3(R * std::sin(t * t), R * (1 - std::cos(t * t)), 0); },
        [](double t) { return Vec3(2 * t * R * std::cos(t * t), 2 * t * R * std::sin(t * t), 0); }, 0.1, 1.9);
    const double first = 0.1 * 0.1, last = 1.9 * 1.9;
    CHECK(circle.length() == Approx(R * (last - first)).epsilon(1e-13));
    CHECK(circle.stations().size() == 2);
    for (double s : {0.0, 0.3, 2.0, 7.77, circle.length()}) {
        const double angle = first + s / R;
        const Placement at = circle.pose(s);
        CHECK((at.p - Vec3(R * std::sin(angle), R * (1 - std::cos(angle)), 0)).norm() < 1e-12);
        CHECK((at.R - rot_z(angle)).norm() < 1e-12);
        CHECK(at.is_valid());
    }
}

TEST_CASE("reference line: on a helix the frame turns about the tangent at minus the torsion", "[analytic]") {
    // Against Frenet's frame: y = n cos v + b sin v with v' = -torsion.   [Bishop, Am. Math. Monthly 82 (1975) 246-251]
    const Helix helix;
    for (const double first : {0.0, -2.0}) {
        const ReferenceLine line = helix.line(first, first + 9);
        CHECK(line.length() == Approx(9 * helix.c()).epsilon(1e-13));
        const auto angle = [&](double s) {
            const double t = first + s / helix.c();
            const Placement at = line.pose(s);
            CHECK((at.p - helix.position(t)).norm() < 1e-12);
            CHECK((at.R.col(0) - helix.derivative(t) / helix.c()).norm() < 1e-12);
            return std::atan2(at.R.col(1).dot(helix.binormal(t)), at.R.col(1).dot(helix.normal(t)));
        };
        const double start = angle(0);
        for (double s : {0.05, 1.0, 6.1, 18.9}) {
            const double miss = std::remainder(angle(s) - start + helix.torsion() * s, 2 * pi);
            CAPTURE(s, miss);
            CHECK(std::abs(miss) < 2e-8);
        }
    }
}

TEST_CASE("reference line: the first frame is the beam axes turned by the shortest way", "[analytic]") {
    const Helix helix;
    const Vec3 tangent = helix.derivative(0.4) / helix.c();
    const Mat3 expected = shortest_turn(Vec3::UnitX(), tangent);
    CHECK((helix.line(0.4, 2).pose(0).R - expected).norm() < 1e-14);
    const Vec3 along(1, 2, -0.5);
    const ReferenceLine straight = ReferenceLine::through({Vec3::Zero(), along}, LineShape::polyline);
    CHECK(straight.length() == Approx(along.norm()).epsilon(1e-15));
    CHECK((straight.pose(0.7).R - shortest_turn(Vec3::UnitX(), along)).norm() < 1e-14);
}

TEST_CASE("reference line: a polyline is straight between its points and turns at them by the shortest way",
          "[analytic]") {
    const ReferenceLine line =
        ReferenceLine::through({Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(2, 1, 1.5)}, LineShape::polyline);
    CHECK(line.length() == Approx(4.5).epsilon(1e-15));
    REQUIRE(line.stations() == std::vector<double>{0, 2, 3, 4.5});
    const auto check = [&](double s, const Vec3& p, const Mat3& R) {
        CAPTURE(s);
        CHECK((line.pose(s).p - p).norm() < 1e-14);
        CHECK((line.pose(s).R - R).norm() < 1e-14);
    };
    const Mat3 one = Mat3::Identity(), two = rot_z(pi / 2), three = rot_x(pi / 2) * two;
    check(0, Vec3(0, 0, 0), one);
    check(1.2, Vec3(1.2, 0, 0), one);
    check(2, Vec3(2, 0, 0), two);  // at a kink: the piece outboard of it
    check(2.4, Vec3(2, 0.4, 0), two);
    check(3, Vec3(2, 1, 0), three);
    check(4, Vec3(2, 1, 1), three);
    check(4.5, Vec3(2, 1, 1.5), three);
}

TEST_CASE("reference line: a spline passes through its points and converges to the curve that they lie on",
          "[analytic]") {
    const double exact = length_to(30);
    const ReferenceLine reference = ReferenceLine::curve(blade_axis, blade_slope, 0, 30);
    CHECK(reference.length() == Approx(exact).epsilon(1e-13));
    std::vector<double> length_error, position_error, frame_error;
    for (int n : {8, 16, 32, 64}) {
        const std::vector<Vec3> points = blade_points(n);
        const ReferenceLine line = ReferenceLine::through(points, LineShape::spline);
        REQUIRE(line.stations().size() == points.size());
        double position = 0, frame = 0;
        for (std::size_t i = 0; i < points.size(); ++i)
            CHECK((line.pose(line.stations()[i]).p - points[i]).norm() < 1e-12 * exact);
        for (int i = 0; i <= 100; ++i) {
            const Placement at = line.pose(line.length() * i / 100), on = reference.pose(reference.length() * i / 100);
            position = std::max(position, (at.p - on.p).norm());
            frame = std::max(frame, (at.R - on.R).norm());
        }
        length_error.push_back(std::abs(line.length() - exact));
        position_error.push_back(position);
        frame_error.push_back(frame);
    }
    const auto order = [](const std::vector<double>& e) { return std::log2(e[1] / e[3]) / 2; };
    CAPTURE(length_error, position_error, frame_error, order(length_error), order(position_error), order(frame_error));
    // A cubic with continuous curvature: values O(h^4), slopes O(h^3).
    CHECK(position_error[3] < 1e-6);
    CHECK(frame_error[3] < 1e-5);
    CHECK(order(length_error) > 3.8);
    CHECK(order(position_error) > 3.8);
    CHECK(order(frame_error) > 2.8);
}

TEST_CASE("reference line: a spline through points of a cubic is that cubic, ends included", "[analytic]") {
    // Points at unequal distances on a straight line by a cubic law: only the parameter could bend the curve, so the
    // cubic is taken along z over x so flat that the distance is x to 1e-10.
    constexpr double flat = 1e-5;
    std::vector<Vec3> points;
    const auto z = [](double x) { return flat * (0.3 + x - 2 * x * x + 0.7 * x * x * x); };
    for (double x : {0.0, 0.4, 1.0, 1.3, 2.2, 3.0}) points.emplace_back(x, 0, z(x));
    const ReferenceLine line = ReferenceLine::through(points, LineShape::spline);
    for (int i = 0; i <= 30; ++i) {
        const Vec3 p = line.pose(line.length() * i / 30).p;
        CHECK(std::abs(p.z() - z(p.x())) < 1e-8 * flat);
    }
}

TEST_CASE("reference line: prebend and sweep tilt the section axes as the slopes say", "[analytic]") {
    const ReferenceLine line = ReferenceLine::curve(blade_axis, blade_slope, 0, 30);
    for (double x : {0.0, 4.0, 17.0, 30.0}) {
        const Placement at = line.pose(length_to(x));
        const Vec3 slope = blade_slope(x);
        CAPTURE(x);
        CHECK((at.p - blade_axis(x)).norm() < 1e-11);
        CHECK((at.R.col(0) - slope.normalized()).norm() < 1e-12);
        // Small slopes turn the section about z by the sweep and about -y by the prebend, not about x.
        const double size = slope.tail<2>().norm();
        CHECK(std::abs(at.R(0, 1) + slope(1)) < std::pow(size, 3));
        CHECK(std::abs(at.R(0, 2) + slope(2)) < std::pow(size, 3));
        CHECK(std::abs(at.R(1, 2) - at.R(2, 1)) < size * size);
    }
    CHECK(line.pose(30).p.y() < 0);  // swept toward -y
}

TEST_CASE("reference line: sections laid along a line get its stations as breaks and its frames as axes",
          "[property]") {
    EngineeringSection s;
    s.mass = 1, s.EI_flap = s.EI_edge = 1;
    BeamLine sections = uniform_beam(4.5, s);
    sections.breaks = {1, 2 + 1e-12};
    const ReferenceLine line =
        ReferenceLine::through({Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(2, 1, 1.5)}, LineShape::polyline);
    const BeamLine bent = along(sections, line);
    CHECK_FALSE(bent.is_straight());
    CHECK(sections.is_straight());
    REQUIRE(bent.breaks.size() == 3);  // 1, 2 (given twice) and 3
    CHECK(bent.breaks[1] == Approx(2).margin(1e-11));
    CHECK(bent.breaks[2] == Approx(3).margin(1e-11));
    CHECK_NOTHROW(bent.check());
    CHECK((bent.pose(2.4).p - Vec3(2, 0.4, 0)).norm() < 1e-14);
    CHECK((sections.pose(2.4).p - Vec3(2.4, 0, 0)).norm() == 0);
}

TEST_CASE("reference line: bad points are refused with their number and value", "[property]") {
    const auto refused = [](std::vector<Vec3> points, LineShape shape, std::initializer_list<std::string> said) {
        check_refused([&] { (void)ReferenceLine::through(points, shape); }, said);
    };
    const Vec3 o = Vec3::Zero(), x = Vec3::UnitX();
    refused({}, LineShape::polyline, {"reference line: number of points = 0; allowed: at least 2"});
    refused({o}, LineShape::polyline, {"number of points = 1; allowed: at least 2"});
    refused({o, x, 2 * x}, LineShape::spline, {"number of points = 3; allowed: at least 4"});
    refused({o, x, x, 2 * x}, LineShape::polyline, {"reference line: point 3 [m] = 1 0 0", "apart from the point"});
    refused({o, x, x, 2 * x}, LineShape::spline, {"point 3 [m]"});
    refused({o, Vec3(not_a_number, 0, 0)}, LineShape::polyline, {"point 2 [m] = nan", "finite"});
    refused({Vec3(0, not_a_number, 0), x, 2 * x, 3 * x}, LineShape::spline, {"point 1 [m]", "nan"});
    refused({o, 1e20 * x, 1e20 * x + Vec3(0, 1, 0), 2e20 * x}, LineShape::spline, {"point 3 [m] = 1", "must show"});
    refused({o, 1e308 * x, -1e308 * x, x}, LineShape::spline, {"point 2 [m] = 1e+308", "finite"});
    refused({o, x, Vec3(0.5, 0, 0)}, LineShape::polyline,
            {"reference line, point 2: turn of the reference line [deg] = 180; allowed: less than 180"});
    refused({o, -x}, LineShape::polyline, {"turn of the reference line [deg] = 180"});
    CHECK_NOTHROW(ReferenceLine::through({o, x, Vec3(0.5, 1e-3, 0)}, LineShape::polyline));
    CHECK_NOTHROW(ReferenceLine::through({o, x, Vec3(1, 1, 0), o}, LineShape::polyline));  // back at the start
}

TEST_CASE("reference line: a curve without speed or extent and sections of another length are refused", "[property]") {
    const auto position = [](double t) { return Vec3(t * t, 0, 0); };
    const auto speed = [](double t) { return Vec3(2 * t, 0, 0); };
    check_refused([&] { (void)ReferenceLine::curve(position, speed, 1, 1); },
                  {"reference line: end of the parameter = 1; allowed: > 1"});
    check_refused([&] { (void)ReferenceLine::curve(position, speed, 1, not_a_number); }, {"= nan"});
    check_refused([&] { (void)ReferenceLine::curve(position, speed, 0, 1); },
                  {"reference line: position and derivative at an end", "finite, not zero"});
    check_refused([&] { (void)ReferenceLine::curve(position, {}, 1, 2); }, {"must be given"});
    const auto hole = [](double t) { return Vec3(t > 1.4 ? not_a_number : 2 * t, 0, 0); };
    check_refused([&] { (void)ReferenceLine::curve(position, hole, 1, 2); }, {"reference line: ", "nan", "finite"});
    EngineeringSection s;
    s.mass = 1, s.EI_flap = s.EI_edge = 1;
    const auto slower = [](double) { return Vec3(1, 0, 0); };
    const BeamLine shorter = along(uniform_beam(1, s, "spar"), ReferenceLine::curve(position, slower, 1, 2));
    check_refused([&] { ElementLine(shorter, 0, 1); },
                  {"spar, element from 0", "distance of its ends [m] = 3", "<= 1"});
    const ReferenceLine line = ReferenceLine::through({Vec3::Zero(), Vec3(3, 4, 0)}, LineShape::polyline);
    check_refused([&] { (void)along(uniform_beam(5.1, s, "spar"), line); },
                  {"spar: length of the sections [m] = 5.1; allowed: 5, the length of the reference line"});
    CHECK_NOTHROW(along(uniform_beam(5, s, "spar"), line));
}
