// What a machine whose source lacks masses shows, and what it refuses.
//
// References: uniform cantilevers (Euler and Bernoulli; in rotation R. V. Southwell's bounds); a machine with all
// masses.
#include "mbs/base/units.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/analysis/campbell.hpp"
#include "turbines/analysis/linear_model.hpp"
#include "turbines/analysis/part_modes.hpp"
#include "turbines/analysis/simulation.hpp"
#include "turbines/analysis/wind_run.hpp"
#include "turbines/machine/machine_text.hpp"
#include "turbines/machine/read_machine.hpp"

using namespace cardan;
using namespace cardan::turbines;
using test::message_of;

namespace cardan::testing::part_modes_of_machine {

namespace {

Machine bare() {
    return read_machine(test::data_file("windio/bare_v2.yaml"));
}

double cantilever_hz(double EI, double mass, double length) {
    return std::pow(1.87510407 / length, 2) * std::sqrt(EI / mass) / (2 * pi);
}

}  // namespace

TEST_CASE("part modes: of a machine without masses, those of uniform cantilevers", "[analytic]") {
    const PartModes parts = part_modes(bare());
    REQUIRE(parts.blade);
    REQUIRE(parts.tower);
    const solvers::Campbell &blade = *parts.blade, &tower = *parts.tower;
    // At rest and at 2 rad/s, the machine's speed.
    REQUIRE(blade.rotor_speeds().size() == 2);
    CHECK(blade.rotor_speeds()[1] == Approx(2).epsilon(1e-12));
    const solvers::Branch &flap = blade.branch("1st blade flap"), &edge = blade.branch("1st blade edge");
    const double flap_hz = cantilever_hz(3e8, 180, 38.5), edge_hz = cantilever_hz(1.2e9, 180, 38.5);
    CHECK(blade.natural_hz(flap, 0) == Approx(flap_hz).epsilon(3e-3));
    CHECK(blade.natural_hz(edge, 0) == Approx(edge_hz).epsilon(3e-3));
    // Southwell: f^2 = f0^2 + k (speed / 2 pi)^2 with k = 1.17 ... 1.2 at no hub, and more with one; edgewise less
    // by 1.
    const double speed = 2 / (2 * pi);
    const auto southwell = [&](const solvers::Branch& b) {
        return (std::pow(blade.natural_hz(b, 1), 2) - std::pow(blade.natural_hz(b, 0), 2)) / (speed * speed);
    };
    CHECK(southwell(flap) > 1.17);
    CHECK(southwell(flap) < 1.4);
    CHECK(southwell(edge) == Approx(southwell(flap) - 1).margin(0.03));
    for (const char* name : {"1st tower fore-aft", "1st tower side-side"})
        CHECK(tower.natural_hz(tower.branch(name), 0) == Approx(cantilever_hz(9e10, 2500, 78)).epsilon(3e-3));
}

TEST_CASE("part modes: those of a machine do not depend on the masses that it lacks", "[property]") {
    Machine whole = bare();
    whole.description.missing.clear();
    whole.description.hub.inertia.mass = 18000;
    whole.description.nacelle.inertia.mass = 80000;
    const PartModesSettings settings{.rotor_speeds = {0, 1}, .machine = {.blade_elements = 3, .tower_elements = 2}};
    const PartModes a = part_modes(bare(), settings), b = part_modes(whole, settings);
    REQUIRE(a.blade->branches.size() == b.blade->branches.size());
    for (std::size_t i = 0; i < a.blade->branches.size(); ++i)
        CHECK(a.blade->natural_hz(a.blade->branches[i], 1) == b.blade->natural_hz(b.blade->branches[i], 1));
    CHECK(a.tower->natural_hz(a.tower->branches[0], 0) == b.tower->natural_hz(b.tower->branches[0], 0));
    // What was computed is kept with what it lacks.
    const std::size_t at = a.tower->source.rfind("cardan_turbine:");
    REQUIRE(at != std::string::npos);
    CHECK(in_words(parse_machine(a.tower->source.substr(at), "tower").description.missing) ==
          in_words(bare().description.missing));
    CHECK(part_modes(whole, {.machine = {.blades = BladeDof::rigid}}).blade == std::nullopt);
}

TEST_CASE("analyses of a machine that lacks masses refuse it in the same words", "[property]") {
    const Machine machine = bare();
    const std::string refusal =
        text(test::data_file("windio/bare_v2.yaml"), ": ") +
        "fictitious machine without masses: the model lacks: mass of the hub; mass of nacelle and drive train; remedy: "
        "--set components.hub.elastic_properties.mass=MASS_kg --set "
        "components.drivetrain.elastic_properties.mass=MASS_kg";
    CHECK(message_of([&] { (void)campbell(machine, {.rotor_speeds = {0}}); }) == refusal);
    CHECK(message_of([&] { (void)campbell(machine, {.winds = {8}}); }) == refusal);
    CHECK(message_of([&] { (void)linear_model(machine, {.rotor_speed = 1}); }) == refusal);
    CHECK(message_of([&] { (void)wind_run(machine, {.winds = {8}, .max_frequency_hz = 2}); }) == refusal);
    CHECK(message_of([&] { (void)Simulation(machine, {.rotor_speed = 1}); }) == refusal);
    CHECK(message_of([&] { (void)to_yaml(machine); }) == refusal);
}

}  // namespace cardan::testing::part_modes_of_machine
