// Frequencies and damping in the wind against ElastoDyn with AeroDyn; what the limits of a dynamic wake are.
#include "examples/studies/nrel5mw_campbell/assumed_shapes.hpp"
#include "mbs/base/units.hpp"
#include "solvers/campbell/point.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/operation/level_machine.hpp"
#include "turbines/aerodynamics/nrel5mw_air.hpp"
#include "turbines/operation/aeroelastic.hpp"
#include "turbines/tables/csv.hpp"

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
    // Found once: wakes and airfoils share it.
    const WindOperatingPoint& at(const Operation& operation) {
        const auto [entry, is_new] = points_.try_emplace({operation.wind, operation.rotor_speed, operation.pitch});
        if (is_new) entry->second = machine_.at(operation);
        CAPTURE(entry->second.message);
        REQUIRE(entry->second.converged);
        return entry->second;
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
    std::map<std::array<double, 3>, WindOperatingPoint> points_;  // of wind, rotor speed and pitch
};

LevelMachine& shared_machine() {
    static LevelMachine machine;
    return machine;
}

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
void check_modes(const std::string& file, const std::vector<UnsteadyAirfoil>& airfoils,
                 const std::vector<std::string>& left_out) {
    const CsvTable table = CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/turbines/operation/" + file);
    std::map<double, Frequencies> vacuo;
    std::map<std::pair<double, bool>, Frequencies> windy;
    LevelMachine& machine = shared_machine();
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        const bool frozen = at("frozen") != 0;
        const std::pair key(at("wind"), frozen);
        if (!windy.contains(key)) {
            const Operation operation{at("wind"), at("speed") * units::rpm, at("pitch") * units::degree};
            vacuo[at("wind")] = machine.in_vacuo(operation.rotor_speed);  // pitch zero, as the table's
            windy[key] =
                machine.modes(operation, {.wake = frozen ? Wake::frozen : Wake::equilibrium, .airfoils = airfoils});
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

// Modes of the machine whose tower and blades are limited to ElastoDyn's shapes, averaged over the azimuth.
std::vector<solvers::Mode> modes_in_shapes(const AeroelasticPoint& point, double rotor_speed) {
    const Turbine& machine = point.machine;
    solvers::CampbellOptions options = low_modes();
    options.method = solvers::CampbellMethod::averaged;
    const auto method = solvers::point_solver(machine.system(), machine.rotor(), options);
    method->start_from(point.start, point.state_start);
    solvers::CampbellPoint found;
    method->solve(rotor_speed, found);
    solvers::AzimuthAverage mean;
    mean.system = method->system();
    mean.rows = method->coleman()->rows();
    const Matrix R = nrel5mw_campbell::shapes_left(machine, mean, nrel5mw_campbell::Limited::tower_and_blades);
    solvers::SecondOrderSystem left = mean.system;
    for (Matrix* m : {&left.M, &left.C, &left.K, &left.K_elastic}) *m = (R.transpose() * *m * R).eval();
    if (left.states.size() > 0) {
        left.states.Q_s = (R.transpose() * left.states.Q_s).eval();
        left.states.f_q = (left.states.f_q * R).eval();
        left.states.f_qd = (left.states.f_qd * R).eval();
    }
    return solvers::modes(left);
}

// Every mode of the table beside the one whose eigenvalue is next to it.
void check_modes_in_shapes(const std::string& file, const std::vector<UnsteadyAirfoil>& airfoils) {
    const CsvTable table = CsvTable::read(std::string(CARDAN_SOURCE_DIR) + "/tests/turbines/operation/" + file);
    LevelMachine& machine = shared_machine();
    std::map<std::pair<double, bool>, std::vector<solvers::Mode>> known;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const auto at = [&](const char* name) { return table.column(name)[i]; };
        const bool frozen = at("frozen") != 0;
        std::vector<solvers::Mode>& modes = known[{at("wind"), frozen}];
        if (modes.empty()) {
            const WindOperatingPoint point =
                machine.at({at("wind"), at("speed") * units::rpm, at("pitch") * units::degree});
            const AeroelasticOptions air{.wake = frozen ? Wake::frozen : Wake::equilibrium, .airfoils = airfoils};
            modes = modes_in_shapes(aeroelastic(machine.operation(), point, air), at("speed") * units::rpm);
        }
        const double zeta = at("damping"), omega = 2 * pi * at("frequency");
        const Complex expected(-zeta * omega, omega * std::sqrt(1 - zeta * zeta));
        const auto own = std::ranges::min_element(modes, {}, [&](const solvers::Mode& mode) {
            return mode.is_state_motion() ? 1e9 : std::abs(mode.eigenvalue - expected);
        });
        const std::string name = mode_names.at(static_cast<std::size_t>(at("mode")) - 1);
        CAPTURE(at("wind"), frozen, name, own->natural_hz(), at("frequency"), own->damping_ratio(), zeta);
        CHECK(own->natural_hz() == Approx(at("frequency")).epsilon(zeta > 0.2 ? 0.05 : 0.02));
        CHECK(std::abs(own->damping_ratio() - zeta) < 0.1 * zeta + 0.001);
    }
    CHECK(known.size() > 5);
}

}  // namespace

// ElastoDyn's shapes make tower and blades stiffer than the same beams (docs/aerodynamics.md), so frequencies are
// compared over those in vacuo. The second modes of tower and blades have up to a fifth more damping here, most of it
// because of these shapes: below.
TEST_CASE("aeroelastic modes: what the air makes of frequencies and damping, wake frozen and in equilibrium",
          "[discrete]") {
    check_modes("elastodyn_modes.csv", {}, {"2nd tower"});
}

TEST_CASE("aeroelastic modes: likewise with unsteady airfoils, but for the second modes", "[discrete]") {
    check_modes("elastodyn_modes_unsteady.csv", nrel5mw_unsteady_airfoils(), {"2nd tower", "2nd blade flap"});
}

// The experiment that shows where the rest comes from: tower and blades held to the shapes that ElastoDyn allows them.
// Then frequencies themselves agree, and damping of all modes.
TEST_CASE("aeroelastic modes: all of them in ElastoDyn's shapes", "[discrete]") {
    check_modes_in_shapes("elastodyn_modes.csv", {});
    check_modes_in_shapes("elastodyn_modes_unsteady.csv", nrel5mw_unsteady_airfoils());
}

// Without losses: where Prandtl's factor vanishes, in the last and the first section, a dynamic wake does not lag (no
// load is there whatever the motion), while with a frozen one the induced velocity stays and a motion makes a load.
TEST_CASE("aeroelastic modes: a dynamic wake is frozen if its time is long, and in equilibrium if it is short",
          "[property]") {
    LevelMachine machine(3, 2, false);
    const Operation operation{8, 9.156 * units::rpm, 0};
    const WindOperatingPoint point = machine.at(operation);
    const Turbine& still = machine.operation().machine_without_air();
    const AeroelasticPoint start = aeroelastic(machine.operation(), point, {.wake = Wake::oye});
    const auto with_time = [&](double time) {
        const MachineAir air =
            machine.operation().air_at(operation).lagging({.dynamic_inflow = true, .inflow_time_constant = time});
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
    check_alike(machine.modes(operation, {.wake = Wake::equilibrium}), with_time(1e-5), 1e-3);
    CHECK(start.inflow_time_constant > 1);
    CHECK(start.inflow_time_constant < 100);
}

TEST_CASE("aeroelastic modes: names of wakes, points without a state", "[validation]") {
    for (const Wake wake : {Wake::none, Wake::frozen, Wake::equilibrium, Wake::oye})
        CHECK(wake_named(name_of(wake), "--wake") == wake);
    check_refused([] { wake_named("frosty", "--wake"); }, {"--wake", "frosty", "none, frozen, equilibrium or oye"});
    check_refused([] { wake_named("quasi-steady", "--wake"); }, {"--wake", "quasi-steady", "equilibrium"});
    check_refused([] { wake_named("dynamic", "--wake"); }, {"--wake", "dynamic", "oye"});
    for (const Airfoils airfoils : {Airfoils::steady, Airfoils::unsteady})
        CHECK(airfoils_named(name_of(airfoils), "--airfoils") == airfoils);
    check_refused([] { airfoils_named("lagging", "--airfoils"); }, {"--airfoils", "lagging", "steady or unsteady"});
    const LevelMachine machine(2, 1);
    check_refused([&] { aeroelastic(machine.operation(), {}, {}); }, {"states of a revolution", "not converged"});
    check_refused([&] { aeroelastic_campbell(machine.operation(), {}, {}, {}); }, {"operating points"});
}

}  // namespace cardan::testing::aeroelastic_tests
