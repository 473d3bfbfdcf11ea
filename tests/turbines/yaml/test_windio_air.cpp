// The air on blades from windIO files: both versions, airfoils between airfoils, places of aerodynamic centres, what is
// refused, and a public model against its AeroDyn files.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/readers/aerodyn.hpp"
#include "turbines/yaml/windio_air.hpp"

#include <cstdlib>

namespace cardan::testing::windio_air_tests {

namespace {

using namespace turbines;
using Catch::Matchers::Contains;
using units::degree;

constexpr double hub = 0.5;

WindioAir small(const char* version) {
    return read_windio_air(test::data_file(std::string("windio/small_") + version + ".yaml"), hub);
}

WindioAir changed(const char* file, const std::string& from, const std::string& to) {
    const test::ModelFolder model("windio");
    model.replace(file, from, to);
    return read_windio_air(model / file, hub);
}
std::string refusal(const char* file, const std::string& from, const std::string& to) {
    return test::message_of([&] { static_cast<void>(changed(file, from, to)); });
}

const Polar& polar_at(const AeroBlade& blade, std::size_t section) {
    return blade.polars[blade.airfoil[section]];
}

std::size_t section_at(const AeroBlade& blade, double fraction) {
    std::size_t i = 0;
    while (i + 1 < blade.sections() && blade.position[i] < hub + 10 * fraction - 1e-9) ++i;
    return i;
}

}  // namespace

TEST_CASE("windio air: both versions of one blade are read as the same", "[crosscheck]") {
    const WindioAir one = small("v1"), two = small("v2");
    const AeroBlade &a = one.blade, &b = two.blade;
    REQUIRE(a.sections() == 7);
    REQUIRE(b.sections() == 7);
    for (std::size_t i = 0; i < a.sections(); ++i) {
        CAPTURE(i);
        CHECK(a.position[i] == Approx(b.position[i]).epsilon(1e-14));
        CHECK(a.chord[i] == Approx(b.chord[i]).epsilon(1e-14));
        CHECK(a.twist[i] == Approx(b.twist[i]).margin(1e-14));
        CHECK(a.prebend[i] == Approx(b.prebend[i]).margin(1e-14));
        CHECK(a.sweep[i] == Approx(b.sweep[i]).margin(1e-14));
        for (const double angle : {-2.5, -0.2, 0.0, 0.1, 0.3, 1.0}) {
            const Polar::Point left = polar_at(a, i).at(angle, 2e6), right = polar_at(b, i).at(angle, 2e6);
            // Version 1 has 3.14 for pi in one table.
            CHECK(left.lift == Approx(right.lift).margin(1e-12));
            CHECK(left.drag == Approx(right.drag).margin(1e-12));
            CHECK(left.moment == Approx(right.moment).margin(1e-12));
        }
    }
    CHECK(one.density == 1.225);
    CHECK(a.viscosity == Approx(1.81e-5 / 1.225));
    CHECK(two.density == 1.225);
    CHECK(b.viscosity == standard_viscosity);
    CHECK(one.source.find("labels: [round") != std::string::npos);
}

TEST_CASE("windio air: sections, centres and airfoils", "[analytic]") {
    const AeroBlade blade = small("v2").blade;
    CHECK(blade.position.front() == hub);
    CHECK(blade.position.back() == Approx(hub + 10));
    // At half the length: thickness 0.4 - 0.2 (0.5 - 0.3) / 0.7, so 2/7 of the thin airfoil.
    const std::size_t i = section_at(blade, 0.5);
    CHECK(blade.chord[i] == Approx(0.65));
    CHECK(blade.twist[i] == Approx(4 * degree));
    const double share = 2.0 / 7, centre = (1 - share) * 0.3 + share * 0.25, along = (centre - 0.35) * 0.65;
    CHECK(along < 0);  // upwind and toward the leading edge of the reference axis, at -0.08 m
    CHECK(blade.prebend[i] == Approx(-0.08 + along * std::sin(4 * degree)).epsilon(1e-13));
    CHECK(blade.sweep[i] == Approx(along * std::cos(4 * degree)).epsilon(1e-13));
    const Polar& polar = polar_at(blade, i);
    CHECK(polar.reynolds() == std::vector<double>{1e6, 4e6});
    CHECK(polar.at(0).lift == Approx((1 - share) * 0.3 + share * 0.4).epsilon(1e-13));
    CHECK(polar.at(-10 * degree, 1e6).lift == Approx((1 - share) * (0.3 - 1.0 * 10 / 15) - share * 0.6).epsilon(1e-13));
    CHECK(polar.at(-10 * degree, 4e6).lift ==
          Approx((1 - share) * (0.3 - 1.0 * 10 / 15) - share * 0.65).epsilon(1e-13));
    CHECK(polar.at(10 * degree, 2e6).lift ==
          Approx((1 - share) * (0.3 + 0.9 * 10 / 12) + share * (1.3 + 0.4 + 1.2 * 10 / 13) / 2).epsilon(1e-13));
    // A round section has the drag of a cylinder and its centre in the middle.
    CHECK(polar_at(blade, 0).at(1).drag == 0.5);
    CHECK(blade.sweep[0] == Approx(0.15 * std::cos(14 * degree)));
    CHECK(blade.prebend[0] == Approx(0.15 * std::sin(14 * degree)));
    CHECK(polar_at(blade, 6).name() == "thin");
}

TEST_CASE("windio air: unsteady airfoils from the polars alone", "[analytic]") {
    const WindioAir air = small("v2");
    REQUIRE(air.airfoils.size() == air.blade.polars.size());
    CHECK(!air.airfoils[air.blade.airfoil.front()].is_unsteady());
    // Of the first table: the lift rises by 0.1, then by 0.09 per degree, its zero is at -4 deg.
    const UnsteadyAirfoil& thin = air.airfoils[air.blade.airfoil.back()];
    CHECK(thin.polar().name() == "thin");
    CHECK(thin.flow().slope == Approx(0.09 / degree));
    CHECK(thin.flow().zero_lift == Approx(-4 * degree));
    CHECK(thin.flow().upper == Approx(5 * degree));
    CHECK(thin.flow().lower == Approx(-5 * degree));
    CHECK(thin.flow().zero_lift_drag == Approx(0.011));
}

TEST_CASE("windio air: an offset across the chord goes to the suction side, downwind", "[analytic]") {
    const AeroBlade before = small("v2").blade,
                    after =
                        changed("small_v2.yaml", "      section_offset_y",
                                "      section_offset_x: {grid: [0, 1], values: [0.1, 0.1]}\n      section_offset_y")
                            .blade;
    for (std::size_t i = 0; i < before.sections(); ++i) {
        CHECK(after.prebend[i] - before.prebend[i] == Approx(0.1 * std::cos(before.twist[i])));
        CHECK(after.sweep[i] - before.sweep[i] == Approx(-0.1 * std::sin(before.twist[i])).margin(1e-14));
    }
}

TEST_CASE("windio air: without rthick the thickness is a monotone cubic; rthick dominates over places", "[analytic]") {
    const std::string rthick = "      rthick: {grid: [0.0, 0.05, 0.3, 1.0], values: [1.0, 1.0, 0.4, 0.2]}\n";
    const AeroBlade cubic = changed("small_v2.yaml", rthick, "").blade;
    const double lift = polar_at(cubic, section_at(cubic, 0.25)).at(0).lift;
    const double share = lift / 0.3;  // of the thick airfoil; a linear thickness makes it 0.8
    CHECK(share > 0.8);
    CHECK(share < 1);
    CHECK(polar_at(cubic, section_at(cubic, 0.3)).at(0).lift == Approx(0.3));
    // Thinner than the airfoils around the section: between those further out.
    const AeroBlade thin =
        changed("small_v2.yaml", rthick, "      rthick: {grid: [0.0, 0.05, 0.25, 1.0], values: [1, 1, 0.3, 0.2]}\n")
            .blade;
    CHECK(polar_at(thin, section_at(thin, 0.25)).at(0).lift == Approx(0.35));
    // Airfoils without a place are where the blade has their thickness.
    const test::ModelFolder model("windio");
    for (const char* place : {"spanwise_position: 0.0, ", "spanwise_position: 0.3, ", "spanwise_position: 1.0, "})
        model.replace("small_v2.yaml", place, "");
    const AeroBlade free = read_windio_air(model / "small_v2.yaml", hub).blade;
    CHECK(polar_at(free, section_at(free, 0.5)).at(0).lift == Approx(0.3 * 5 / 7 + 0.4 * 2 / 7));
}

TEST_CASE("windio air: configurations are mixed by their weights; a second surface is not a Reynolds number",
          "[analytic]") {
    const test::ModelFolder model("windio");
    model.replace("small_v2.yaml", "spanwise_position: 1.0, configuration: [default], weight: [1.0]",
                  "spanwise_position: 1.0, configuration: [default, rough], weight: [0.25, 0.75]");
    std::string all = test::bytes_of(model / "small_v2.yaml");
    all +=
        "      - configuration: rough\n        re_sets:\n          - re: 2.0e+6\n"
        "            cl: {grid: [-180, 0, 180], values: [0, 0.2, 0]}\n"
        "            cd: {grid: [-180, 180], values: [0.03, 0.03]}\n"
        "            cm: {grid: [-180, 180], values: [0, 0]}\n";
    model.write("small_v2.yaml", all);
    const AeroBlade blade = read_windio_air(model / "small_v2.yaml", hub).blade;
    CHECK(polar_at(blade, blade.sections() - 1).at(0).lift == Approx(0.25 * 0.4 + 0.75 * 0.2));
    const WindioAir rough = changed("small_v1.yaml", "re: 4.0e+6", "re: 1.0e+6");
    CHECK(!polar_at(rough.blade, rough.blade.sections() - 1).over_reynolds());
    CHECK(test::has_note(rough.notes, "airfoils[2].polars", "the first one is taken"));
}

TEST_CASE("windio air: additions, and a model without structure", "[property]") {
    const std::string shape = test::bytes_of(test::data_file("windio/small_v2.yaml"));
    const WindioAir cold = parse_windio_air(shape, "m.yaml", hub, {{"environment: {air_density: 1.3}\n", "cold.yaml"}});
    CHECK(cold.density == 1.3);
    CHECK(cold.source.find("# cold.yaml") != std::string::npos);
    const std::size_t begin = shape.find("    structure:\n      webs"), end = shape.find("  hub:");
    const WindioAir bare = parse_windio_air(shape.substr(0, begin) + shape.substr(end), "m.yaml", hub);
    CHECK(bare.blade.sections() == 7);
}

TEST_CASE("windio air: bad files are refused with file, line, value and what is allowed", "[validation]") {
    const char *one = "small_v1.yaml", *two = "small_v2.yaml";
    CHECK_THAT(refusal(two, "name: thick, span", "name: fat, span"),
               Contains("small_v2.yaml:15") && Contains("no airfoil 'fat'; there are: round, thick, thin"));
    CHECK_THAT(refusal(two, "values: [1.0, 0.3]}", "values: [1.0, 0.0]}"),
               Contains("small_v2.yaml:19") && Contains("chord of 0 m; allowed: > 0"));
    CHECK_THAT(refusal(two, "spanwise_position: 0.3", "spanwise_position: 0.04"),
               Contains("small_v2.yaml:15") && Contains("spanwise position 0.04 after 0.05; allowed: larger"));
    CHECK_THAT(refusal(two, "spanwise_position: 0.3", "spanwise_position: 1.3"), Contains("1.3; allowed: 0 ... 1"));
    CHECK_THAT(refusal(two, "[default], weight: [1.0]", "[default], weight: [0.5]"),
               Contains("small_v2.yaml:13") && Contains("weights with the sum 0.5; allowed: 1"));
    CHECK_THAT(refusal(two, "[default], weight", "[rough], weight"),
               Contains("no configuration 'rough'; there are: 'default'"));
    CHECK_THAT(refusal(two, "rthick: 0.4", "rthick: 40"), Contains("airfoils[1].rthick: 40; allowed: 0 ... 1"));
    CHECK_THAT(refusal(two, "aerodynamic_center: 0.3\n", "\n"), Contains("no 'aerodynamic_center'"));
    CHECK_THAT(refusal(two, "[-180.0, -90.0, -15.0", "[-180.0, -90.0, -95.0"),
               Contains("airfoils[1].polars[0].re_sets[0].cl.grid: -95 after -90; allowed: larger"));
    CHECK_THAT(refusal(two, "30.0, 90.0, 180.0]", "30.0, 90.0, 170.0]"),
               Contains("angles -180 ... 170; allowed: -180 ... 180 deg"));
    CHECK_THAT(refusal(two, "0.9, 0.0, 0.0]", "0.9, 0.0]"), Contains("8 angles for 7 values"));
    CHECK_THAT(refusal(two, "re: 2.0e+6", "re: -2"), Contains("re: -2; allowed: >= 0"));
    CHECK_THAT(refusal(two, "re_sets:\n          - re: 1.0e+6\n            cl",
                       "re_sets: []\n        a:\n          - re: 1.0e+6\n            cl"),
               Contains("number of tables = 0"));
    CHECK_THAT(refusal(two, "      section_offset_y: {grid: [0.0, 1.0], values: [0.35, 0.105]}\n", ""),
               Contains("no components.blade.outer_shape.section_offset_y"));
    CHECK_THAT(refusal(one, "labels: [round, round, thick, thin]", "labels: [round, round, thick]"),
               Contains("small_v1.yaml:7") && Contains("4 places for 3 values"));
    CHECK_THAT(refusal(one, "air_density: 1.225", "air_density: -1"),
               Contains("environment.air_density: -1; allowed: > 0"));
    // Degrees in a file that counts in rad.
    CHECK_THAT(refusal(one, "c_l: {grid: [-3.14, ", "c_l: {grid: [-180, "), Contains("version 1 counts in rad"));
}

// WISDEM made the AeroDyn files of this machine from its windIO file, with corrections of stalled airfoils for the
// rotation. The models are not part of these sources: CARDAN_MODELS names a folder that holds them.
TEST_CASE("windio air: IEA 3.4 MW machine against its AeroDyn files", "[discrete][.models]") {
    const char* const models = std::getenv("CARDAN_MODELS");
    if (models == nullptr) return;
    const std::filesystem::path folder(models);
    const AeroBlade expected = read_aerodyn(folder / "IEA-3.4-130-RWT" / "IEA-3.4-130-RWT_AeroDyn15.dat", 2).blade;
    const AeroBlade blade = read_windio_air(folder / "windIO" / "IEA-3p4-130-RWT_v2.yaml", 2).blade;
    const auto fraction = [](const AeroBlade& of, std::size_t i) {
        return (of.position[i] - of.position.front()) / (of.position.back() - of.position.front());
    };
    for (std::size_t i = 0; i < expected.sections(); ++i) {
        const double at = fraction(expected, i);
        std::size_t k = 1;
        while (k + 1 < blade.sections() && fraction(blade, k) < at) ++k;
        const double t = (at - fraction(blade, k - 1)) / (fraction(blade, k) - fraction(blade, k - 1));
        const auto mean = [&](const std::vector<double>& of) { return (1 - t) * of[k - 1] + t * of[k]; };
        CAPTURE(at);
        CHECK(mean(blade.chord) == Approx(expected.chord[i]).margin(0.01));
        CHECK(mean(blade.twist) == Approx(expected.twist[i]).margin(0.03 * degree));
        CHECK(mean(blade.prebend) == Approx(expected.prebend[i]).margin(0.02));
        CHECK(mean(blade.sweep) == Approx(expected.sweep[i]).margin(0.06));
    }
    const double ratio = 7.85;
    const RotorCoefficients a = rotor_coefficients(blade, 3, -3 * degree, ratio, 0),
                            b = rotor_coefficients(expected, 3, -3 * degree, ratio, 0);
    CHECK(a.power == Approx(b.power).epsilon(1e-3));
    CHECK(a.thrust == Approx(b.thrust).epsilon(1e-3));
}

}  // namespace cardan::testing::windio_air_tests
