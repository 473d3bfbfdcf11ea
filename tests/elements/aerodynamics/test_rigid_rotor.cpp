// Blade-element momentum on the rigid rotor of the NREL 5 MW machine, against AeroDyn's numbers.
#include "elements/aerodynamics/rigid_rotor.hpp"
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"
#include "turbines/tables/csv.hpp"

#include <cmath>
#include <map>
#include <random>

namespace cardan::testing::rigid_rotor_tests {

namespace {

using turbines::CsvTable;

CsvTable reference(const std::string& name) {
    return CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/elements/aerodynamics/" + name);
}

}  // namespace

TEST_CASE("blade-element momentum: power and thrust coefficients", "[discrete]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    const CsvTable table = reference("aerodyn_rotor.csv");
    const double R = blade.position.back();
    REQUIRE(table.rows() > 60);
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        RotorAirOptions options;
        options.momentum = {at("tip_loss") != 0, at("hub_loss") != 0, at("drag") != 0, at("rotation") != 0,
                            at("drag") != 0};
        options.induction = at("induction") != 0;
        const double speed = at("speed") * units::rpm, wind = at("wind");
        const RotorAir air =
            rigid_rotor_air(blade, {}, {.speed = wind}, speed, 0, at("pitch") * units::degree, options);
        const double disc = 1.225 / 2 * pi * R * R;
        CAPTURE(i, wind, at("speed"), at("pitch"));
        CHECK(std::abs(air.moment.x() * speed / (disc * wind * wind * wind) - at("power_coefficient")) < 1e-5);
        CHECK(std::abs(air.force.x() / (disc * wind * wind) - at("thrust_coefficient")) < 1e-5);
        CHECK(air.force.tail<2>().norm() < 1e-9 * air.force.norm());  // three equal blades
    }
}

TEST_CASE("blade-element momentum: inductions and loads of the sections", "[discrete]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    const CsvTable table = reference("aerodyn_nodes.csv");
    std::map<double, RotorAir> cases;  // by wind and speed
    double largest = 0;
    for (const double normal : table.column("normal", "N/m")) largest = std::max(largest, std::abs(normal));
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        const double key = at("wind") + 100 * at("speed");
        if (!cases.contains(key))
            cases[key] = rigid_rotor_air(blade, {}, {.speed = at("wind")}, at("speed") * units::rpm, 0,
                                         at("pitch") * units::degree);
        const SectionAir& own = cases[key].sections[0][static_cast<std::size_t>(at("node")) - 1];
        CAPTURE(at("wind"), at("node"));
        CHECK(own.induction.axial == Approx(at("axial")).margin(2e-6));
        CHECK(own.induction.tangential == Approx(at("tangential")).margin(2e-6));
        CHECK(own.induction.phi * units::to_degrees == Approx(at("phi")).margin(2e-4));
        CHECK(std::abs(own.force.normal - at("normal")) < 1e-5 * largest);
        CHECK(std::abs(own.force.driving - at("driving")) < 1e-5 * largest);
    }
}

TEST_CASE("blade-element momentum: a rotor at rest and a slow one, without induction", "[discrete]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    const CsvTable table = reference("aerodyn_standstill.csv");
    RotorAirOptions options;
    options.induction = false;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        const RotorAir air = rigid_rotor_air(blade, {}, {.speed = at("wind")}, at("speed") * units::rpm, 0,
                                             at("pitch") * units::degree, options);
        const SectionForce& own = air.sections[0][static_cast<std::size_t>(at("node")) - 1].force;
        CAPTURE(at("pitch"), at("node"));
        CHECK(own.attack * units::to_degrees == Approx(at("attack")).margin(1e-6));
        CHECK(own.normal == Approx(at("normal")).epsilon(1e-8).margin(1e-6));
        CHECK(own.driving == Approx(at("driving")).epsilon(1e-8).margin(1e-6));
        CHECK(air.force.x() == Approx(at("thrust")).epsilon(1e-8));
        CHECK(air.moment.x() == Approx(at("torque")).epsilon(1e-8));
    }
}

TEST_CASE("blade-element momentum: tilt, cone, yaw and shear over the azimuth, with and without skewed wake",
          "[discrete]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    const CsvTable table = reference("aerodyn_azimuth.csv");
    REQUIRE(table.rows() > 200);
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        const RotorPose pose{
            .tilt = at("tilt") * units::degree, .cone = at("cone") * units::degree, .yaw = at("yaw") * units::degree};
        const SteadyWind wind{.speed = at("wind"), .shear = Shear::power, .exponent = at("exponent")};
        RotorAirOptions options;
        options.skew = at("skew") != 0 ? Skew::pitt_peters : Skew::none;
        const RotorAir air = rigid_rotor_air(blade, pose, wind, at("speed") * units::rpm, at("azimuth") * units::degree,
                                             at("pitch") * units::degree, options);
        CAPTURE(i, at("yaw"), at("azimuth"));
        CHECK(air.force.x() == Approx(at("thrust")).epsilon(1e-5));
        CHECK(air.moment.x() == Approx(at("torque")).epsilon(1e-5));
        const RotorAir::Root& root = air.roots[0];
        const double force = std::abs(at("root_force_x")), moment = std::abs(at("root_moment_y"));
        CHECK(std::abs(root.force.x() - at("root_force_x")) < 1e-5 * force);
        CHECK(std::abs(root.force.y() - at("root_force_y")) < 1e-5 * force);
        CHECK(std::abs(root.moment.x() - at("root_moment_x")) < 1e-5 * moment);
        CHECK(std::abs(root.moment.y() - at("root_moment_y")) < 1e-5 * moment);
        CHECK(std::abs(root.moment.z() - at("root_moment_z")) < 1e-5 * moment);
    }
}

TEST_CASE("blade-element momentum: of several solutions all solvers take that of the smallest attack", "[crosscheck]") {
    const AeroBlade blade = turbines::nrel5mw_aero_blade();
    std::mt19937 random(4);
    const auto number = [&](double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random);
    };
    constexpr std::size_t count = 4000;
    int solved = 0, others = 0;
    std::vector<Annulus> annuli;
    std::vector<SectionInflow> inflows;
    annuli.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Annulus& annulus =
            annuli.emplace_back(Annulus{.radius = number(2, 60),
                                        .chord = number(0.5, 5),
                                        .angle = number(-0.3, 1.6),
                                        .tip = std::pow(10.0, number(-3, 2)),
                                        .hub = std::pow(10.0, number(-3, 2)),
                                        .polar = &blade.polars[static_cast<std::size_t>(number(0, 8))]});
        inflows.push_back({&annulus, number(-5, 25), number(-20, 90)});
    }
    std::vector<Induction> many(count);
    solve_inductions(inflows, {}, many);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& [annulus, V_x, V_y] = inflows[i];
        const Induction one = solve_induction(*annulus, V_x, V_y), plain = solve_induction_plainly(*annulus, V_x, V_y);
        CAPTURE(i, V_x, V_y, annulus->angle, annulus->chord, annulus->radius, annulus->tip, annulus->hub,
                annulus->polar->name(), many[i].root, one.root, plain.root);
        CHECK(one.solved == plain.solved);
        CHECK(many[i].solved == plain.solved);
        solved += one.solved;
        for (const Induction& fast : {one, many[i]}) {
            CHECK(std::abs(fast.axial) <= 1.5);
            CHECK(std::abs(fast.tangential) <= 1);
            // Next to a fold two solutions are nearer to each other than what tells them apart.
            if (std::abs(fast.root - plain.root) > 1e-9) {
                ++others;
                continue;
            }
            CHECK(fast.axial == Approx(plain.axial).margin(1e-9));
            CHECK(fast.tangential == Approx(plain.tangential).margin(1e-9));
            CHECK(fast.phi == Approx(plain.phi).margin(1e-9));
        }
    }
    CHECK(solved > 3800);
    CHECK(others <= 4);
}

TEST_CASE("polar: interpolation around the circle, its slopes, what is refused", "[property]") {
    const auto d = [](std::vector<double> degrees) {
        for (double& x : degrees) x *= units::degree;
        return degrees;
    };
    const Polar polar("P", d({-180, -90, 0, 10, 180}), {0, 1, -1, 3, 0}, {0, 1, 2, 3, 0}, {0, 0, 1, 0, 0});
    CHECK(polar.at(5 * units::degree).lift == Approx(1));
    CHECK(polar.at(5 * units::degree).lift_slope == Approx(4 / (10 * units::degree)));
    CHECK(polar.at(5 * units::degree + 4 * pi).drag == Approx(2.5));
    CHECK(polar.at(-100 * units::degree).lift == Approx(80.0 / 90));
    CHECK(polar.at(pi).lift == Approx(0).margin(1e-12));
    for (double angle = -3.5; angle < 3.5; angle += 0.0137) {
        const double h = 1e-7;
        const Polar::Point at = polar.at(angle), after = polar.at(angle + h), before = polar.at(angle - h);
        if (std::abs((after.lift - at.lift) - (at.lift - before.lift)) > 1e-12) continue;  // at a point of the table
        CHECK((after.lift - before.lift) / (2 * h) == Approx(at.lift_slope).margin(1e-6));
        CHECK((after.moment - before.moment) / (2 * h) == Approx(at.moment_slope).margin(1e-6));
    }
    const std::vector<double> three{1, 2, 3};
    check_refused(
        [&] {
            Polar("DU40", d({-180, 20, 10, 180}), {1, 2, 3, 4}, {1, 2, 3, 4}, {1, 2, 3, 4});
        },
        {"DU40", "point 3", "angle of attack [deg] = 10", "above that of the point before, 20"});
    check_refused(
        [&] {
            Polar("DU40", d({-180, 0, 170}), three, three, three);
        },
        {"DU40", "-180 ... 170", "-180 ... 180"});
    check_refused([&] { Polar("DU40", d({-180, 0, 180}), {1, 2}, three, three); }, {"DU40", "values in a column = 2"});
    check_refused([&] { Polar("DU40", d({-180, 0, 180}), {1, std::nan(""), 2}, three, three); }, {"point 2", "finite"});
    check_refused(
        [&] {
            Polar("DU40", d({-180, 0, 180}), three, {1, -1e308, 2}, three);
        },
        {"DU40", "point 2", "coefficient = -1e+308", "-1000 ... 1000"});
}

TEST_CASE("wind: laws of shear, direction, veer, upflow", "[analytic]") {
    const Vec3 at(0, 0, 45);
    CHECK(SteadyWind{.speed = 10}.at(at).isApprox(Vec3(10, 0, 0)));
    CHECK(SteadyWind{.speed = 10, .shear = Shear::power, .exponent = 0.2}.at(at).x() ==
          Approx(10 * std::pow(0.5, 0.2)));
    CHECK(SteadyWind{.speed = 10, .shear = Shear::logarithmic, .roughness = 0.03}.at(at).x() ==
          Approx(10 * std::log(45 / 0.03) / std::log(90 / 0.03)));
    CHECK(SteadyWind{.speed = 10, .gradient = 0.001}.at(at).x() == Approx(10 * (1 - 0.045)));
    const Vec3 turned = SteadyWind{.speed = 10, .direction = 0.3, .veer = 0.002, .upflow = 0.1}.at(at);
    CHECK(turned.norm() == Approx(10));
    CHECK(std::atan2(turned.y(), turned.x()) == Approx(0.3 - 0.09));
    CHECK(turned.z() == Approx(10 * std::sin(0.1)));
    const SteadyWind across{.speed = 10, .direction = 0.3, .lateral = 0.001, .gust = 2, .vertical = 0.5};
    const Vec3 left = 20 * Vec3(-std::sin(0.3), std::cos(0.3), 0) + 7 * Vec3(std::cos(0.3), std::sin(0.3), 0);
    CHECK(across.at(left).isApprox(Vec3(12.2 * std::cos(0.3), 12.2 * std::sin(0.3), 0.5)));
    check_refused([] { SteadyWind{.speed = -1}.check(); }, {"speed", "-1"});
    check_refused([] { SteadyWind{.shear = Shear::logarithmic}.check(); }, {"roughness [m] = 0"});
    check_refused([] { SteadyWind{.density = 0}.check(); }, {"density"});
    check_refused([] { SteadyWind{.exponent = 1e5}.check(); }, {"exponent of the shear = 1", "-10 ... 10"});
    check_refused([] { SteadyWind{.reference_height = 4.2e-71}.check(); },
                  {"reference height [m] = 4.2e-71", "at least 0.001"});
    check_refused([] { SteadyWind{.speed = 1e308}.check(); }, {"speed [m/s] = 1e+308", "-1000 ... 1000"});
    check_refused([] { SteadyWind{.speed = 8, .direction = 1e300}.check(); }, {"direction [rad] = 1e+300"});
}

TEST_CASE("wind over time: linear between its rows, steps between two of the same time", "[analytic]") {
    const auto row = [](double speed, double direction) { return SteadyWind{.speed = speed, .direction = direction}; };
    const Wind wind({1, 2, 2, 4}, {row(8, 0), row(10, 0.1), row(14, 0.1), row(12, 0.3)});
    for (const auto& [time, speed, direction] :
         {std::array{0.0, 8.0, 0.0}, {1.5, 9.0, 0.05}, {2.0, 14.0, 0.1}, {3.0, 13.0, 0.2}, {9.0, 12.0, 0.3}}) {
        CHECK(wind.without_box(time).speed == Approx(speed));
        CHECK(wind.without_box(time).direction == Approx(direction));
    }
    CHECK(wind.breaks() == std::vector<double>{1, 2, 4});
    const SteadyWind low{.speed = 10, .shear = Shear::power, .exponent = 0.2, .ground = -15};
    CHECK(Wind(low).over(0).at(0).at({0, 0, 75}).isApprox(low.at({0, 0, 60})));
    CHECK(Wind(row(9, 0)).is_steady());
    CHECK(Wind(row(9, 0)).breaks().empty());
    check_refused([&] { Wind({1, 0}, {row(8, 0), row(8, 0)}); }, {"row 2", "time [s] = 0"});
    check_refused([&] { Wind({1}, {}); }, {"rows = 0"});
    check_refused([&] { Wind({0, 1}, {row(8, 0), row(-8, 0)}); }, {"row 2", "speed [m/s] = -8"});
    check_refused([&] { Wind({0, 1}, {row(8, 0), {.speed = 8, .shear = Shear::power}}); }, {"row 2", "law"});
}

}  // namespace cardan::testing::rigid_rotor_tests
