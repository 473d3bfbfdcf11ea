// Modes of the NREL 5 MW blade: names by content, shapes over the radius, their table and picture.
#include "mbs/base/error.hpp"
#include "mbs/model/spatial.hpp"
#include "solvers/campbell_data/blade_shapes.hpp"
#include "solvers/pictures/blade_shapes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/reference_turbines/nrel5mw/test_nrel5mw_blade.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::testing;
using turbines::nrel5mw_blade;
using turbines::nrel5mw_blade_elements;

namespace {

// The blade with every section changed.
template <class Change>
turbines::Nrel5mwBlade changed(Change change) {
    turbines::Nrel5mwBlade blade = nrel5mw_blade();
    blade.line.section = [section = blade.line.section, change](double x) {
        BeamSection s = section(x);
        change(s);
        return s;
    };
    return blade;
}

std::vector<std::string> by_frequency(const solvers::Campbell& d, std::size_t count) {
    std::vector<std::pair<double, std::string>> all;
    for (const solvers::Branch& branch : d.branches) all.emplace_back(d.natural_hz(branch, 0), branch.name);
    std::sort(all.begin(), all.end());
    std::vector<std::string> first;
    for (std::size_t i = 0; i < count; ++i) first.push_back(all.at(i).second);
    return first;
}

}  // namespace

TEST_CASE("NREL 5 MW blade: modes are named by what moves, not by their place in the list", "[property]") {
    const double speed[] = {0};
    const CardanBeamOptions n8 = nrel5mw_blade_elements(8);
    CHECK(by_frequency(diagram(n8, speed), 6) ==
          std::vector<std::string>(blade_mode_names.begin(), blade_mode_names.end()));
    // A third of the torsional stiffness brings the torsion below the second edge mode.
    const solvers::Campbell soft = diagram(n8, speed, changed([](BeamSection& s) { s.compliance(3, 3) *= 3; }));
    CHECK(by_frequency(soft, 4) ==
          std::vector<std::string>{blade_mode_names[0], blade_mode_names[1], blade_mode_names[2], blade_mode_names[5]});
    CHECK(hz(soft, 5, 0) == Approx(5.33 / std::sqrt(3)).epsilon(0.05));
    // Turned by 90 degrees the soft direction lies in the rotor plane.
    const solvers::Campbell turned = diagram(n8, speed, changed([](BeamSection& s) {
                                                 const Mat3 R = rot_x(pi / 2);
                                                 Mat6 both = Mat6::Zero();
                                                 both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = R;
                                                 s.compliance = Mat6(both * s.compliance * both.transpose());
                                                 s.centre = Vec3(R * s.centre);
                                                 s.J = Mat3(R * s.J * R.transpose());
                                             }));
    CHECK(by_frequency(turned, 3) ==
          std::vector<std::string>{blade_mode_names[1], blade_mode_names[0], "2nd blade edge"});
    CHECK(hz(turned, 1, 0) == Approx(0.67656).margin(1e-5));
}

TEST_CASE("NREL 5 MW blade: mode shapes have their signs, nodes and slopes", "[property]") {
    const solvers::Campbell d = diagram(nrel5mw_blade_elements(16));
    for (std::size_t point : {0, 2}) {
        const solvers::BladeShapes shapes = solvers::blade_shapes(d, blade_mode_names, point, Vec3::UnitX());
        REQUIRE(shapes.modes.size() == blade_mode_names.size());
        CHECK(shapes.rotor_speed == blade_speeds.at(point));
        for (std::size_t k = 0; k < blade_mode_names.size(); ++k) {
            const solvers::BladeShape& s = shapes.modes.at(k);
            CAPTURE(point, s.name);
            CHECK(s.name == blade_mode_names.at(k));
            CHECK_FALSE(s.doubtful);
            CHECK(s.natural_hz == hz(d, k, point));
            REQUIRE(s.radius.size() == 17);
            CHECK(s.radius.front() == Approx(1.5));
            CHECK(s.radius.back() == Approx(63));
            CHECK(s.displacement.front().norm() == 0.0);
            CHECK(s.rotation.front().norm() == 0.0);
            double largest = 0, imaginary = 0;
            int flap_changes = 0, edge_changes = 0, twist_changes = 0;
            for (std::size_t i = 1; i < s.radius.size(); ++i) {
                const Vec3 u = s.displacement[i].real(), v = s.displacement[i - 1].real();
                largest = std::max({largest, std::abs(s.displacement[i].y()), std::abs(s.displacement[i].z())});
                imaginary = std::max(imaginary, s.displacement[i].imag().cwiseAbs().maxCoeff());
                flap_changes += u.z() * v.z() < 0;
                edge_changes += u.y() * v.y() < 0;
                twist_changes += s.rotation[i].x().real() * s.rotation[i - 1].x().real() < 0;
                if (k > 1) continue;
                // Trapezoidal rule on the slopes w' = -theta_y, v' = theta_z: enough for the first two shapes.
                const double h = s.radius[i] - s.radius[i - 1];
                const Vec3 slope = (s.rotation[i] + s.rotation[i - 1]).real() / 2;
                CHECK(u.z() - v.z() == Approx(-h * slope.y()).margin(0.012));
                CHECK(u.y() - v.y() == Approx(h * slope.z()).margin(0.012));
            }
            CHECK(largest == Approx(1).epsilon(1e-12));
            CHECK(imaginary < (point == 0 ? 1e-9 : 5e-3));
            if (k == 0 || k == 2 || k == 4) {
                CHECK(s.displacement.back().z().real() == Approx(1));
                CHECK(flap_changes == static_cast<int>(k) / 2);
            }
            if (k == 1 || k == 3) {
                CHECK(s.displacement.back().y().real() == Approx(1));
                CHECK(edge_changes == static_cast<int>(k) / 2);
            }
            if (k == 5) CHECK(twist_changes == 0);
        }
        // The leading edge is turned upwind: edgewise motion along the chord goes upwind, flap goes toward the leading
        // edge.
        CHECK(shapes.modes[0].displacement.back().y().real() > 0.1);
        CHECK(shapes.modes[1].displacement.back().z().real() < -0.1);
    }
}

TEST_CASE("NREL 5 MW blade: shapes as table and picture", "[property]") {
    const test::Folder folder;
    const double speed[] = {0, 12.1 * rpm};
    const solvers::Campbell d = diagram(nrel5mw_blade_elements(4), speed);
    const std::array<std::string, 2> two{blade_mode_names[0], "9th blade flap"};  // what is not there is left out
    const std::vector<solvers::BladeShapes> shapes{solvers::blade_shapes(d, two, 0, Vec3::UnitX()),
                                                   solvers::blade_shapes(d, two, 1, Vec3::UnitX())};
    solvers::write_csv(shapes, folder / "shapes.csv");
    const std::string table = test::bytes_of(folder / "shapes.csv");
    CHECK(std::count(table.begin(), table.end(), '\n') == 2 + 1 + 2 * 5);
    CHECK(
        table.find("rotor_speed[rpm],mode[-],natural_frequency[Hz],radius[m],flap[-],edge[-],radial[-],twist[deg/m]") !=
        std::string::npos);
    CHECK(table.find("\n12.1,1st blade flap,") != std::string::npos);
    solvers::plot(shapes.back(), folder / "shapes.svg");
    const std::string picture = test::bytes_of(folder / "shapes.svg");
    for (const char* words :
         {"1st blade flap", "12.1 rpm", "radius, m", "displacement, largest = 1", "twist, deg per m"})
        CHECK(picture.find(words) != std::string::npos);
    CHECK(folder.files() == 2);
    check_refused([&] { solvers::plot({"nothing", 0, {}}, folder / "none.svg"); }, {"nothing", "number of modes"});
    CHECK(test::message_of([&] { solvers::write_csv(shapes, folder / "no/x.csv"); }).find("does not exist") !=
          std::string::npos);
    solvers::Campbell without = d;
    without.motions.clear();
    check_refused([&] { (void)solvers::blade_shapes(without, two, 0, Vec3::UnitX()); }, {"mode shape", "keep_shapes"});
    without.lines.clear();
    check_refused([&] { (void)solvers::blade_shapes(without, two, 0, Vec3::UnitX()); }, {"no line of blade 1"});
}
