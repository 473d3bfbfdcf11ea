// Differences of two Campbell diagrams of one machine: by hand-made diagrams, by a law of perturbation, as text, as
// pictures; input that is refused.
#include "mbs/base/error.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell_data/difference.hpp"
#include "solvers/pictures/campbell.hpp"
#include "tests/solvers/small_rotor.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/files.hpp"
#include "tests/support/refusal.hpp"

#include <cmath>
#include <sstream>

using namespace cardan;
using namespace cardan::solvers;
using namespace cardan::testing;

namespace {

using units::rpm;

// Oscillations by name, at every point as (damped frequency in Hz, growth in 1/s); frequency 0: no mode there.
struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> values;
};

Campbell by_hand(const std::vector<double>& speeds, const std::vector<Curve>& curves) {
    Campbell d;
    d.machine = "machine_made by 'hand'";
    d.method = "method of the title";
    d.blades = 3;
    for (const double speed : speeds) d.points.emplace_back().rotor_speed = speed * rpm;
    for (const Curve& curve : curves) {
        Branch& branch = d.branches.emplace_back();
        branch.name = curve.name;
        branch.family = "family of " + curve.name;
        branch.component = 0;
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            const auto [f, growth] = curve.values[i];
            branch.mode.push_back(f == 0 ? -1 : static_cast<int>(d.points[i].modes.size()));
            branch.mac.push_back(1);
            branch.doubtful.push_back(false);
            branch.mostly.push_back(branch.name);
            if (f == 0) continue;
            CampbellMode& mode = d.points[i].modes.emplace_back();
            mode.mode = {Complex(growth, 2 * pi * f), ComplexVector::Ones(1)};
        }
    }
    return d;
}

double ratio(double f, double growth) {
    return -growth / std::hypot(growth, 2 * pi * f);
}

const BranchDifference& of(const std::vector<BranchDifference>& list, const std::string& name) {
    for (const BranchDifference& one : list)
        if (one.name == name) return one;
    FAIL("no difference of '" << name << "'");
    return list.front();
}

// Flaps and lags on a nacelle that tilts and yaws.
SmallRotor whirling(double gravity) {
    SmallRotorSpec spec;
    spec.damping = 40;
    spec.hinges = BladeHinges::flap_and_lag;
    spec.lag_damping = 60;
    spec.elastic_support = true;
    spec.gravity = {0, -gravity, 0};
    return small_rotor(spec);
}

std::pair<Campbell, Campbell> floquet_and_mean(double gravity, const std::vector<double>& speeds) {
    const SmallRotor rotor = whirling(gravity);
    CampbellOptions options;
    options.spin = RotorSpin::prescribed;
    options.max_frequency_hz = 15;
    options.floquet.harmonics = 10;
    options.floquet.tolerance = 1e-12;
    options.method = CampbellMethod::floquet;
    Campbell floquet = campbell(rotor.system, rotor.map, speeds, options);
    options.method = CampbellMethod::averaged;
    return {std::move(floquet), campbell(rotor.system, rotor.map, speeds, options)};
}

// Words of the line that begins with a name.
std::vector<std::string> words_of(const std::string& table, const std::string& name) {
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(name)) {
            for (char& c : line)
                if (c == '(' || c == ';' || c == ')') c = ' ';
            std::istringstream rest(line.substr(name.size()));
            std::vector<std::string> words;
            for (std::string word; rest >> word;) words.push_back(word);
            return words;
        }
    return {};
}

}  // namespace

TEST_CASE("campbell difference: branches of one name are subtracted point by point", "[analytic]") {
    const Campbell a = by_hand({0, 10, 20}, {{"tower", {{0.5, -0.1}, {0.51, -0.2}, {0.52, 0.3}}},
                                             {"lag", {{2, -1}, {0, 0}, {2.2, -1}}},
                                             {"only here", {{3, 0}, {3, 0}, {3, 0}}}}),
                   b = by_hand({0, 10, 20}, {{"only there", {{1, 0}, {1, 0}, {1, 0}}},
                                             {"lag", {{2.1, -1}, {2.1, -1}, {2.1, -1.5}}},
                                             {"tower", {{0.5, -0.1}, {0.54, -0.2}, {0.5, 0}}}});
    const std::vector<BranchDifference> list = differences(a, b);
    REQUIRE(list.size() == 2);
    CHECK(list[0].name == "tower");  // in the order of the first
    CHECK(list[0].family == "family of tower");
    const BranchDifference &tower = of(list, "tower"), &lag = of(list, "lag");
    const double expected[] = {0, -0.03, 0.02};
    for (std::size_t i = 0; i < 3; ++i) CHECK(tower.frequency_hz[i] == Approx(expected[i]).margin(1e-15));
    CHECK(tower.damping_ratio[0] == 0);
    CHECK(tower.damping_ratio[1] == Approx(ratio(0.51, -0.2) - ratio(0.54, -0.2)).epsilon(1e-12));
    CHECK(tower.damping_ratio[2] == Approx(ratio(0.52, 0.3)).epsilon(1e-12));  // negative: it grows more
    CHECK(tower.damping_ratio[2] < 0);
    CHECK(tower.largest_hz == Approx(0.03));
    CHECK(lag.frequency_hz[0] == Approx(-0.1));
    CHECK(std::isnan(lag.frequency_hz[1]));
    CHECK(std::isnan(lag.damping_ratio[1]));
    CHECK(lag.damping_ratio[2] == Approx(ratio(2.2, -1) - ratio(2.1, -1.5)).epsilon(1e-12));
    CHECK(lag.largest_hz == Approx(0.1));
    // Exchanged: the other sign.
    const std::vector<BranchDifference> back = differences(b, a);
    REQUIRE(back.size() == 2);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(of(back, "tower").frequency_hz[i] == Approx(-tower.frequency_hz[i]).margin(1e-15));
}

TEST_CASE("campbell difference: as many points as both have; other rotor speeds are refused", "[property]") {
    const Campbell whole = by_hand({5, 10, 15}, {{"tower", {{1, 0}, {2, 0}, {3, 0}}}}),
                   ended = by_hand({5, 10}, {{"tower", {{1.5, 0}, {2.5, 0}}}}),
                   other = by_hand({5, 11, 15}, {{"tower", {{1, 0}, {2, 0}, {3, 0}}}});
    for (const bool exchanged : {false, true}) {
        const std::vector<BranchDifference> list = exchanged ? differences(ended, whole) : differences(whole, ended);
        REQUIRE(list.size() == 1);
        CHECK(list[0].frequency_hz.size() == 2);
        CHECK(list[0].damping_ratio.size() == 2);
        CHECK(list[0].largest_hz == Approx(0.5));
    }
    CHECK(differences(whole, Campbell{}).empty());
    check_refused([&] { (void)differences(whole, other); },
                  {"difference of Campbell diagrams", "rotor speed number 2 [rad/s] = 1.047", "1.15"});
    check_refused([&] { (void)difference_table(whole, other); }, {"rotor speed number 2"});
    Campbell soft = whole;
    soft.parameter = "stiffness [N m]";
    soft.parameters = {1, 2, 3};
    check_refused([&] { (void)differences(whole, soft); }, {"parameter = ''", "'stiffness [N m]'"});
    Campbell stiff = soft;
    stiff.parameters[1] = 2.5;
    check_refused([&] { (void)differences(soft, stiff); }, {"stiffness [N m], number 2 = 2", "2.5"});
}

TEST_CASE("campbell difference: motions named after a coordinate are left out", "[property]") {
    Campbell a = by_hand({5}, {{"yaw (rigid)", {{1e-9, 0}}}, {"tower", {{1, 0}}}});
    const Campbell b = a;
    a.branches[0].row = 3;
    a.branches[0].component = -1;
    const std::vector<BranchDifference> list = differences(a, b);
    REQUIRE(list.size() == 1);
    CHECK(list[0].name == "tower");
}

TEST_CASE("campbell difference: Floquet's theory and the mean over the azimuth differ by the square of gravity",
          "[analytic]") {
    // The periodic part of the matrices is of first order in gravity and has no mean: exponents differ by its square.
    // Without gravity the system is constant.
    const std::vector<double> speeds{1.5, 2.3};
    const auto [f0, a0] = floquet_and_mean(0, speeds);
    const std::vector<BranchDifference> none = differences(f0, a0);
    REQUIRE(none.size() == 8);
    for (const BranchDifference& one : none) CHECK(one.largest_hz < 1e-10);
    const auto [f1, a1] = floquet_and_mean(0.5, speeds);
    const auto [f2, a2] = floquet_and_mean(1.0, speeds);
    const std::vector<BranchDifference> small = differences(f1, a1), large = differences(f2, a2);
    REQUIRE(small.size() == 8);
    REQUIRE(large.size() == 8);
    double most = 0;
    for (const BranchDifference& one : large) most = std::max(most, one.largest_hz);
    CHECK(most > 1e-6);
    int compared = 0;
    for (const BranchDifference& one : large)
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            if (std::abs(one.frequency_hz[i]) < 0.02 * most) continue;
            CAPTURE(one.name, speeds[i]);
            // Terms of fourth order in gravity: some per cent.
            CHECK(one.frequency_hz[i] / of(small, one.name).frequency_hz[i] == Approx(4).epsilon(0.05));
            ++compared;
        }
    CHECK(compared >= 4);
}

TEST_CASE("campbell difference: the table has the frequencies in Hz and the differences in mHz and 1e-3 %",
          "[analytic]") {
    const Campbell a = by_hand({0, 6, 12, 18, 24}, {{"tower", {{9, 0}, {1.5, -0.1}, {9, 0}, {1.7, -0.3}, {9, 0}}},
                                                    {"lag", {{9, 0}, {2, 0}, {2, 0}, {0, 0}, {2, 0}}}});
    Campbell b = by_hand({0, 6, 12, 18, 24}, {{"tower", {{8, 0}, {1.4, 0}, {8, 0}, {1.75, -0.3}, {8, 0}}},
                                              {"lag", {{9, 0}, {2, 0}, {2, 0}, {2, 0}, {2, 0}}}});
    b.method = "method of the reference";
    const std::string table = difference_table(a, b);
    // First above zero, middle, last.
    CHECK_THAT(table, Catch::Contains("method of the title\nagainst method of the reference") &&
                          Catch::Contains("6.0 rpm") && Catch::Contains("24.0 rpm") && !Catch::Contains(" 0.0 rpm"));
    CHECK_THAT(table, Catch::Contains("Hz (difference, mHz; of the damping ratio, 1e-3 %)"));
    const std::vector<std::string> tower = words_of(table, "tower");
    REQUIRE(tower.size() >= 3);
    CHECK(tower[0] == "1.5000");
    CHECK(tower[1] == "100.000");
    std::ostringstream damping;
    damping.precision(2);
    damping << std::fixed << 1e5 * ratio(1.5, -0.1);
    CHECK(tower[2] == damping.str());
    const std::vector<std::string> lag = words_of(table, "lag");
    CHECK(lag ==
          std::vector<std::string>{"2.0000", "0.000", "0.00", "2.0000", "0.000", "0.00", "2.0000", "0.000", "0.00"});
    CHECK(difference_table(a, Campbell{}) == "no modes to compare\n");
    CHECK(difference_table(a, by_hand({0, 6}, {{"other", {{1, 0}, {1, 0}}}})) == "no modes to compare\n");
    const Campbell still = by_hand({0}, {{"tower", {{1, 0}}}});
    CHECK_THAT(difference_table(still, still), Catch::Contains("0.0 rpm") && Catch::Contains("1.0000"));
}

TEST_CASE("campbell difference: pictures have both panels, units, and the modes that differ", "[property]") {
    const test::Folder folder;
    const Campbell a = by_hand({5, 10}, {{"1st tower", {{1, -0.01}, {1.1, -0.02}}},
                                         {"2nd tower", {{2, 0}, {2.001, 0}}},
                                         {"hardly different", {{3, 0}, {3.0005, 0}}}}),
                   b = by_hand({5, 10}, {{"1st tower", {{1, 0}, {1, 0}}},
                                         {"2nd tower", {{2, 0}, {2.0025, 0}}},
                                         {"hardly different", {{3, 0}, {3, 0}}}});
    plot_differences(a, b, folder.path / "d.svg");
    const std::string svg = test::bytes_of(folder / "d.svg");
    for (const char* expected : {"difference of frequency, mHz", "difference of damping ratio, %",
                                 "rotor speed, rev/min", "1st tower", "2nd tower", "machine_made by"})
        CHECK(svg.find(expected) != std::string::npos);
    CHECK(svg.find("hardly different") == std::string::npos);  // less than a hundredth
    plot_differences(a, b, folder.path / "d.png");
    CHECK(test::bytes_of(folder / "d.png").substr(1, 3) == "PNG");
    // One speed, no difference at all: still a picture.
    const Campbell one = by_hand({5}, {{"1st tower", {{1, 0}}}});
    plot_differences(one, one, folder.path / "one.svg");
    CHECK(test::bytes_of(folder / "one.svg").find("1st tower") != std::string::npos);
}

TEST_CASE("campbell difference: pictures of nothing and unwritable paths are clear errors", "[property]") {
    const test::Folder folder;
    const Campbell a = by_hand({5}, {{"tower", {{1, 0}}}}), b = by_hand({5}, {{"lag", {{1, 0}}}});
    check_refused([&] { plot_differences(a, b, folder.path / "d.svg"); },
                  {"machine_made", "modes that both diagrams have = 0"});
    CHECK_FALSE(std::filesystem::exists(folder.path / "d.svg"));
    CHECK_THROWS_AS(plot_differences(a, a, "/no/such/folder/d.svg"), FileError);
    CHECK_THROWS_AS(plot_differences(a, a, folder.path / "d.bmp"), FileError);
    check_refused(
        [&] {
            plot_differences(a, by_hand({6}, {{"tower", {{1, 0}}}}), folder.path / "d.svg");
        },
        {"rotor speed number 1"});
}
