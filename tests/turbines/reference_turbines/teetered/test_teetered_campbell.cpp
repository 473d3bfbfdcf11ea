// Campbell diagrams of the two-bladed teetered machine: names and frequencies at its nominal speed against converged
// values, branches over the rotor speed.
#include "solvers/campbell/diagram.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_floquet.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_machine.hpp"
#include "tests/turbines/reference_turbines/teetered/teetered_table.hpp"

using namespace cardan;
using namespace cardan::testing;
using solvers::Branch;
using solvers::Campbell;
using solvers::FloquetKind;
using turbines::AssemblyOptions;
using turbines::Turbine;

namespace {

constexpr const char* growing = "teeter (locked at 1 per rev and growing)";
constexpr const char* decaying = "teeter (locked at 1 per rev and decaying)";

// Modes up to a number per revolution at the nominal speed.
Campbell diagram_of(const Turbine& machine, const std::vector<double>& speeds, double per_rev) {
    solvers::CampbellOptions options;
    options.method = solvers::CampbellMethod::floquet;
    options.max_frequency_hz = per_rev * teetered_speed / (2 * pi);
    return solvers::campbell(machine.system(), machine.rotor(), speeds, options);
}

// "symmetric flap", 1 -> "1st blade flap (symmetric)"; "tower lateral", 2 -> "2nd tower side-side".
std::string mode_name(const TeeteredRow& row) {
    const std::string family = row.family, ordinal = row.ordinal == 1 ? "1st " : "2nd ";
    if (family == "tower lateral") return ordinal + "tower side-side";
    if (contains(family, "tower")) return ordinal + family;
    const std::size_t space = family.find(' ');
    const std::string of_blade = family.substr(space + 1);
    return ordinal + "blade " + (of_blade == "lag" ? "edge" : of_blade) + " (" + family.substr(0, space) + ")";
}

double per_rev(const Campbell& d, const Branch& branch, std::size_t point = 0) {
    return d.damped_hz(branch, point) * 2 * pi / d.points[point].rotor_speed;
}

// Rows up to a frequency: within parts of the frequency of first and second modes, undamped.
int check_rows(const Campbell& d, const std::vector<TeeteredRow>& rows, double limit, double first, double second) {
    int checked = 0;
    for (const TeeteredRow& row : rows) {
        if (row.exact > limit) continue;
        const std::string name = mode_name(row);
        CAPTURE(name, row.exact);
        const Branch& branch = d.branch(name);
        CHECK(std::abs(per_rev(d, branch) - row.exact) < (row.ordinal == 1 ? first : second) * row.exact + row.unit);
        CHECK(std::abs(d.damping_ratio(branch, 0)) < 1e-8);
        CHECK(branch.mostly[0] == name);
        CHECK_FALSE(branch.doubtful[0]);
        ++checked;
    }
    return checked;
}

// Free yaw, and the growing and decaying motion of teeter and yaw.
void check_rigid_motions(const Campbell& d, double growth_per_rev) {
    for (const char* name : {"yaw (rigid)", "yaw (2nd rigid)"}) {
        const Branch& branch = d.branch(name);
        CHECK(branch.family == "yaw");
        CHECK(std::abs(d.mode(branch, 0)->mode.eigenvalue) < 1e-4);
    }
    for (const auto& [name, sign] : {std::pair{growing, 1}, std::pair{decaying, -1}}) {
        const Branch& branch = d.branch(name);
        CHECK(per_rev(d, branch) == Approx(1).epsilon(1e-12));
        CHECK(sign * d.mode(branch, 0)->mode.eigenvalue.real() / teetered_speed == Approx(growth_per_rev).margin(1e-5));
    }
    CHECK(d.points[0].stability_margin / teetered_speed == Approx(-growth_per_rev).margin(1e-5));
    CHECK_THAT(d.warning, Catch::Contains("unstable at 57.4"));
}

}  // namespace

TEST_CASE("campbell of the teetered machine: three elements per part give names and first frequencies within 1 %",
          "[discrete]") {
    const Campbell d = diagram_of(teetered_machine(3), {teetered_speed}, 11);
    CHECK(check_rows(d, teetered_ratio_100, 11, 1e-2, 1e-2) == 6);
    check_rigid_motions(d, 0.04525);
    CHECK(d.branches.size() == 10);
    CHECK(d.blades == 2);
}

TEST_CASE("campbell of the teetered machine: over the rotor speed every branch keeps its name", "[property]") {
    std::vector<double> speeds;
    for (double speed = 1; speed < 8.1; speed += 0.5) speeds.push_back(speed);
    const Campbell d = diagram_of(teetered_machine(1), speeds, 11);
    REQUIRE(d.points.size() == 15);
    for (const char* name : {"yaw (rigid)", "yaw (2nd rigid)", growing, decaying, "1st blade flap (symmetric)",
                             "1st blade flap (antisymmetric)", "1st blade edge (symmetric)",
                             "1st blade edge (antisymmetric)", "1st tower fore-aft", "1st tower side-side"}) {
        const Branch& branch = d.branch(name);
        for (std::size_t i = 0; i < speeds.size(); ++i) {
            CAPTURE(name, speeds[i]);
            REQUIRE(branch.mode[i] >= 0);
            // At 1.9 rad/s the lag modes are one per rev apart and exchange a harmonic; the branches go on.
            const bool exchange = branch.family == "blade edge" && speeds[i] == 2;
            CHECK(branch.doubtful[i] == exchange);
            if (!exchange) CHECK(branch.mac[i] > 0.6);
            // No leap by a multiple of the rotor speed.
            if (i > 0) CHECK(std::abs(d.damped_hz(branch, i) - d.damped_hz(branch, i - 1)) < 0.25);
            if (branch.row < 0) CHECK(branch.mostly[i] == name);
        }
    }
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        CHECK(d.points[i].stability_margin < 0);
        CHECK(d.mode(d.branch(growing), i)->mode.eigenvalue.real() == Approx(-d.points[i].stability_margin));
        CHECK(d.mode(d.branch(growing), i)->kind() == FloquetKind::synchronous);
    }
}

TEST_CASE("campbell of the teetered machine: without the half-turn symmetry the same, over the whole revolution",
          "[crosscheck]") {
    const Turbine machine = teetered_machine(1);
    const Campbell half = diagram_of(machine, {teetered_speed}, 11);
    solvers::CampbellOptions options;
    options.method = solvers::CampbellMethod::floquet;
    options.max_frequency_hz = 11 * teetered_speed / (2 * pi);
    const double speed[] = {teetered_speed};
    const Campbell whole = solvers::campbell(machine.system(), machine.rotor(), speed, options);
    REQUIRE(whole.branches.size() == half.branches.size());
    for (const Branch& branch : half.branches) {
        CAPTURE(branch.name);
        if (branch.row >= 0 && branch.family == "yaw") continue;  // split by rounding
        const Complex a = half.mode(branch, 0)->mode.eigenvalue,
                      b = whole.mode(whole.branch(branch.name), 0)->mode.eigenvalue;
        CHECK(std::abs(a - b) < 1e-8);
    }
}

TEST_CASE("campbell of the teetered machine: locked teeter is no unknown, and in gravity the state is periodic",
          "[property]") {
    turbines::TurbineDescription description = general_description();
    AssemblyOptions options = turbines::teetered_paper_assembly(1);
    options.gravity = {0, 0, -9.81};
    for (const bool locked : {false, true}) {
        if (locked) description.hub.teeter->bearing = turbines::rigid_joint;
        const Turbine machine = turbines::assemble(description, options);
        CHECK(machine.rotor().odd_coordinates.size() == (locked ? 0U : 1U));
        const Campbell d = diagram_of(machine, {5.0, teetered_speed}, 8);
        CHECK(std::count(d.rows.begin(), d.rows.end(), "teeter") == (locked ? 0 : 1));
        for (const solvers::CampbellPoint& point : d.points) {
            REQUIRE(point.periodic.has_value());
            CHECK(point.periodic->amplitude(2) > 1e-4);
            CHECK(std::isfinite(point.stability_margin));
        }
        if (!locked) CHECK(d.points[1].stability_margin > 0);  // yaw and teeter have dampers
        CHECK(d.branch("1st blade flap (symmetric)").mode[1] >= 0);
    }
}

TEST_CASE("campbell of the teetered machine: six elements per part, all modes of the table", "[discrete][slow]") {
    for (const bool rigid : {true, false}) {
        const Campbell d = diagram_of(teetered_machine(6, rigid), {teetered_speed}, 140);
        const auto& rows = rigid ? teetered_rigid : teetered_ratio_100;
        CHECK(check_rows(d, rows, 140, 3e-3, 1e-2) == static_cast<int>(rows.size()) - (rigid ? 0 : 1));
        check_rigid_motions(d, 0.04525);
    }
}
