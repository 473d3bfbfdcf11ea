// Frequencies and damping in the wind against ElastoDyn with AeroDyn; what the limits of a dynamic wake are.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/operation/level_machine.hpp"
#include "turbines/machines/nrel5mw_air.hpp"
#include "turbines/operation/aeroelastic.hpp"
#include "turbines/readers/csv.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace cardan::testing::aeroelastic_tests {

namespace {

using namespace turbines;

constexpr std::array mode_names{"1st tower side-side",         "1st tower fore-aft",       "1st blade flap (backward)",
                                "1st blade flap (collective)", "1st blade flap (forward)", "1st blade edge (backward)",
                                "1st blade edge (collective)", "1st blade edge (forward)", "2nd blade flap (backward)",
                                "2nd blade flap (collective)", "2nd blade flap (forward)", "2nd tower fore-aft",
                                "2nd tower side-side"};

struct Frequencies {
    std::map<std::string, double> natural, damping;  // Hz
};

Frequencies frequencies(const solvers::Campbell& diagram) {
    Frequencies out;
    for (const solvers::Branch& branch : diagram.branches) {
        if (diagram.mode(branch, 0) == nullptr) continue;
        out.natural[branch.name] = diagram.natural_hz(branch, 0);
        out.damping[branch.name] = diagram.damping_ratio(branch, 0);
    }
    return out;
}

solvers::CampbellOptions low_modes() {
    solvers::CampbellOptions options;
    options.spin = solvers::RotorSpin::prescribed;
    options.max_frequency_hz = 3.5;
    options.keep_shapes = false;
    options.floquet.harmonics = 2;
    return options;
}

// The machine of the reference: level, no gravity, speed and pitch prescribed. Its tower bends, which tilts the rotor a
// little: states have two harmonics.
class LevelMachine {
public:
    explicit LevelMachine(int blade_elements = 8, int tower_elements = 4, bool losses = true)
        : machine_(level_machine(), nrel5mw_assembly(Nrel5mwVariant::fast, blade_elements, tower_elements),
                   nrel5mw_aero_blade(), options(losses)) {}

    const WindOperation& operation() const { return machine_; }
    WindPoint at(const Operation& operation) {
        WindPoint point = machine_.at(operation);
        CAPTURE(point.message);
        REQUIRE(point.converged);
        return point;
    }
    Frequencies modes(const Operation& operation, const AeroelasticOptions& air) {
        const std::array points{at(operation)};
        return frequencies(aeroelastic_campbell(machine_, points, air, low_modes()));
    }
    Frequencies in_vacuo(double speed) const {
        solvers::CampbellOptions options = low_modes();
        options.method = solvers::CampbellMethod::averaged;
        const Turbine& machine = machine_.machine_without_air();
        return frequencies(solvers::campbell(machine.system(), machine.rotor(), {speed}, options));
    }

private:
    static WindOperationOptions options(bool losses) {
        WindOperationOptions options;
        options.air.momentum.tip_loss = options.air.momentum.hub_loss = losses;
        options.air.skew = Skew::none;
        options.harmonics = 2;
        return options;
    }

    WindOperation machine_;
};

// The same modes, to a part of their eigenvalues.
void check_alike(const Frequencies& a, const Frequencies& b, double tolerance) {
    REQUIRE(a.natural.size() > 10);
    for (const auto& [name, hz] : a.natural) {
        CAPTURE(name, hz);
        REQUIRE(b.natural.contains(name));
        CHECK(b.natural.at(name) == Approx(hz).epsilon(tolerance));
        CHECK(std::abs(b.damping.at(name) - a.damping.at(name)) < tolerance);
    }
}

// Against a table of ElastoDyn and AeroDyn. Damping is compared but of modes whose names begin so.
void check_modes(const std::string& file, const std::vector<UnsteadyProfile>& profiles,
                 const std::vector<std::string>& left_out) {
    const CsvTable table = CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/turbines/operation/" + file);
    std::map<double, Frequencies> vacuo;
    std::map<std::pair<double, bool>, Frequencies> windy;
    LevelMachine machine;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        const bool frozen = at("frozen") != 0;
        const std::pair key(at("wind"), frozen);
        if (!windy.contains(key)) {
            const Operation operation{at("wind"), at("speed") * units::rpm, at("pitch") * units::degree};
            vacuo[at("wind")] = machine.in_vacuo(operation.rotor_speed);  // pitch zero, as the table's
            windy[key] =
                machine.modes(operation, {.wake = frozen ? Wake::frozen : Wake::quasi_steady, .profiles = profiles});
        }
        const std::string name = mode_names.at(static_cast<std::size_t>(at("mode")) - 1);
        const double own = windy[key].natural.at(name) / vacuo[at("wind")].natural.at(name),
                     expected = at("frequency") / at("frequency_in_vacuo"), damping = windy[key].damping.at(name);
        const bool heavily_damped = at("damping") > 0.2;
        CAPTURE(at("wind"), frozen, name, own, expected, damping, at("damping"));
        CHECK(std::abs(own / expected - 1) < (heavily_damped ? 0.05 : 0.02));
        if (std::ranges::any_of(left_out, [&](const std::string& word) { return name.starts_with(word); })) continue;
        CHECK(std::abs(damping - at("damping")) < 0.1 * at("damping") + 0.001);
    }
    CHECK(windy.size() > 5);
}

}  // namespace

// ElastoDyn's shapes make tower and blades stiffer than the same beams (docs/aerodynamics.md), so frequencies are
// compared over those in vacuo; the damping bounds are those of a different structural model. Damping of the second
// tower modes is left out: it is up to a fifth larger here, without an explanation so far; their shapes there are
// polynomials of the bare tower.
TEST_CASE("aeroelastic modes: what the air makes of frequencies and damping, wake frozen and in equilibrium",
          "[discrete]") {
    check_modes("elastodyn_modes.csv", {}, {"2nd tower"});
}

TEST_CASE("aeroelastic modes: likewise with unsteady profiles, without the second flap modes", "[discrete]") {
    check_modes("elastodyn_modes_unsteady.csv", nrel5mw_unsteady_profiles(), {"2nd tower", "2nd blade flap"});
}

// Their damping is 8 to 13 per cent larger here (6 to 9 with steady profiles), with 20 elements as with 8: the lags
// take 28 per cent of it here, 31 there. Shapes with more motion near the tip, where the air is faster, might explain
// both; it has not been shown. When the bound is met, this test says so by failing.
TEST_CASE("aeroelastic modes: likewise with unsteady profiles, the second flap modes too", "[discrete][!shouldfail]") {
    check_modes("elastodyn_modes_unsteady.csv", nrel5mw_unsteady_profiles(), {"2nd tower"});
}

// Without losses: where Prandtl's factor vanishes, in the last and the first section, a dynamic wake does not lag (no
// load is there whatever the motion), while with a frozen one the induced velocity stays and a motion makes a load.
TEST_CASE("aeroelastic modes: a dynamic wake is frozen if its time is long, and quasi-steady if it is short",
          "[property]") {
    LevelMachine machine(3, 2, false);
    const Operation operation{8, 9.156 * units::rpm, 0};
    const WindPoint point = machine.at(operation);
    const Turbine& still = machine.operation().machine_without_air();
    const AeroelasticPoint start = aeroelastic(machine.operation(), point, {.wake = Wake::dynamic});
    const auto with_time = [&](double time) {
        const MachineAir air = machine.operation().air_at(operation).lagging({.dynamic_wake = true, .wake_time = time});
        const Turbine turbine = air.on(still);
        solvers::CampbellOptions options = low_modes();
        options.method = solvers::CampbellMethod::averaged;
        const std::array one{solvers::CampbellCase{.system = &turbine.system(),
                                                   .rotor = &turbine.rotor(),
                                                   .rotor_speed = operation.rotor_speed,
                                                   .parameter = 1,
                                                   .start = start.start,
                                                   .state_start = start.state_start}};
        return frequencies(solvers::campbell(one, "case", options));
    };
    check_alike(machine.modes(operation, {.wake = Wake::frozen}), with_time(1e5), 1e-3);
    check_alike(machine.modes(operation, {.wake = Wake::quasi_steady}), with_time(1e-5), 1e-3);
    CHECK(start.wake_time > 1);
    CHECK(start.wake_time < 100);
}

TEST_CASE("aeroelastic modes: names of wakes, points without a state", "[validation]") {
    for (const Wake wake : {Wake::frozen, Wake::quasi_steady, Wake::dynamic})
        CHECK(wake_named(name_of(wake), "--wake") == wake);
    check_refused([] { wake_named("frosty", "--wake"); }, {"--wake", "frosty", "quasi-steady"});
    const LevelMachine machine(2, 1);
    check_refused([&] { aeroelastic(machine.operation(), {}, {}); }, {"states of a revolution", "not converged"});
    check_refused([&] { aeroelastic_campbell(machine.operation(), {}, {}, {}); }, {"operating points"});
}

}  // namespace cardan::testing::aeroelastic_tests
