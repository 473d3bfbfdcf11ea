// Numbers of elements: converged frequencies by a finer mesh, closed forms of uniform beams, invariance under scale.
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/natural_modes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/model/assembly.hpp"
#include "turbines/model/scaling.hpp"

using namespace cardan;
using namespace cardan::turbines;

namespace {

TurbineDescription machine() {
    return read_openfast(test::data_file("openfast/small.fst")).description;
}

AssemblyOptions with(const MeshOptions& mesh) {
    return {.mesh = mesh};
}

std::vector<double> frequencies_at_rest(const Turbine& turbine) {
    std::vector<double> hz;
    for (const solvers::Mode& mode : solvers::natural_modes(turbine.system()).modes)
        if (mode.oscillates()) hz.push_back(mode.natural_hz());
    return hz;
}
std::vector<double> frequencies_at_rest(const TurbineDescription& description, int blade, int tower) {
    return frequencies_at_rest(assemble(
        description,
        {.tower_elements = tower, .blade_elements = blade, .structural_damping = false, .joint_damping = false}));
}

}  // namespace

TEST_CASE("mesh: the frequencies asked for are within the tolerance of those of a much finer one", "[discrete]") {
    const TurbineDescription description = machine();
    for (const double tolerance : {2e-2, 2e-3, 2e-4}) {
        const Mesh mesh = converged_mesh(description, with({.tolerance = tolerance, .max_hz = 12}));
        REQUIRE(mesh.converged);
        CHECK(mesh.change <= tolerance);
        CHECK(mesh.max_hz == 12);
        const std::vector<double> found = frequencies_at_rest(description, mesh.blade_elements, mesh.tower_elements),
                                  finer = frequencies_at_rest(description, 4 * mesh.blade_elements,
                                                              4 * mesh.tower_elements);
        double largest = 0;
        std::size_t count = 0;
        for (; finer[count] <= 12; ++count) largest = std::max(largest, std::abs(found[count] / finer[count] - 1));
        CHECK(static_cast<int>(count) == mesh.modes);
        CHECK(largest <=
              1.4 * tolerance);  // second order: 4/3 of the change to twice as many, and a quarter of that ...
    }
}

TEST_CASE("mesh: elements that are sought do not make up for those that were given; none is no number", "[property]") {
    const TurbineDescription description = machine();
    const Mesh free = converged_mesh(description), coarse = converged_mesh(description, {.blade_elements = 1});
    CHECK(coarse.blade_elements == 1);
    CHECK(coarse.tower_elements <= 2 * free.tower_elements);
    CHECK_FALSE(coarse.converged);
    CHECK(coarse.change > 10 * free.change);
    for (const AssemblyOptions& options : {AssemblyOptions{.blade_elements = 0}, AssemblyOptions{.tower_elements = 0},
                                           AssemblyOptions{.tower_elements = 1001, .blade_elements = 2}})
        CHECK_THROWS_WITH(assemble(description, options), Catch::Matchers::Contains("allowed: 1 ... 1000"));
}

TEST_CASE("mesh: more elements for a smaller tolerance and for higher frequencies", "[property]") {
    const TurbineDescription description = machine();
    const Mesh coarse = converged_mesh(description, with({.tolerance = 2e-2, .max_hz = 6})),
               fine = converged_mesh(description, with({.tolerance = 2e-4, .max_hz = 6})),
               high = converged_mesh(description, with({.tolerance = 2e-2, .max_hz = 25}));
    CHECK(fine.blade_elements > coarse.blade_elements);
    CHECK(high.blade_elements > coarse.blade_elements);
    CHECK(high.modes > coarse.modes);
}

TEST_CASE("mesh: what is given stays, and what cannot be reached is said", "[property]") {
    const TurbineDescription description = machine();
    AssemblyOptions both = with({.max_hz = 12});
    both.blade_elements = 2;
    both.tower_elements = 5;
    const Mesh given = converged_mesh(description, both);
    CHECK(given.blade_elements == 2);
    CHECK(given.tower_elements == 5);
    CHECK_FALSE(given.converged);
    CHECK(given.change > 2e-3);
    const Mesh few = converged_mesh(description, with({.tolerance = 1e-9, .max_hz = 12, .max_elements = 3}));
    CHECK(few.blade_elements == 3);
    CHECK_FALSE(few.converged);
}

TEST_CASE("mesh: a largest frequency far above the machine's own compares all of its modes", "[property]") {
    const TurbineDescription description = machine();
    MeshOptions high{.max_hz = 1e9, .max_elements = 3};
    const Mesh all = converged_mesh(description, with(high));
    CHECK(all.modes > 50);
    CHECK_FALSE(all.converged);
    // Its lowest modes do not count as motions without stiffness.
    high.max_hz = 2e4;
    CHECK(converged_mesh(description, with(high)).modes > 20);
}

TEST_CASE("mesh: elements too many for a comparison are taken as they are, and that is said", "[property]") {
    const TurbineDescription description = machine();
    for (const std::optional<int> tower : {std::optional<int>(3), std::optional<int>()}) {
        const Mesh many = converged_mesh(description, {.tower_elements = tower, .blade_elements = 1000});
        CHECK(many.blade_elements == 1000);
        CHECK(many.tower_elements >= 2);
        CHECK_FALSE(many.converged);
        CHECK_THAT(in_words(many), Catch::Contains("1000 elements per blade") &&
                                       Catch::Contains("too many to be compared with twice as many"));
    }
}

TEST_CASE("mesh: blades that turn fast have more elements than their frequencies need", "[property]") {
    const TurbineDescription description = machine();
    const MeshOptions still{.tolerance = 0.1, .max_hz = 3};
    MeshOptions fast = still;
    fast.rotor_speed = 60;  // rad/s
    CHECK(converged_mesh(description, with(fast)).blade_elements >
          converged_mesh(description, with(still)).blade_elements);
}

TEST_CASE("mesh: a machine is assembled with as many elements as it takes, and says how good they are", "[property]") {
    const TurbineDescription description = machine();
    const Turbine turbine = assemble(description);
    const Mesh& mesh = turbine.mesh();
    CHECK(mesh.converged);
    CHECK(mesh.modes > 5);
    CHECK(mesh.max_hz == usual_frequency(description));
    CHECK(turbine.layout().blades.front().elements.size() == static_cast<std::size_t>(mesh.blade_elements));
    CHECK(turbine.layout().tower->elements.size() == static_cast<std::size_t>(mesh.tower_elements));
    for (const std::string& said : {turbine.summary(), turbine.rotor().description})
        CHECK_THAT(said, Catch::Contains(in_words(mesh)) && Catch::Contains("no frequency at rest up to"));

    // The same numbers, given: the same machine, and nothing is sought.
    const Turbine again = assemble(description, with_elements({}, mesh));
    CHECK(frequencies_at_rest(again) == frequencies_at_rest(turbine));
    CHECK(again.mesh().modes == 0);
    CHECK_THAT(again.summary(), Catch::Contains("in the tower, as given"));
    const Turbine blade = isolated_blade(description, {});
    CHECK(blade.mesh().blade_elements == mesh.blade_elements);
    CHECK(blade.mesh().converged);
    const Turbine tower = isolated_tower(description, {}, true);
    CHECK(tower.mesh().converged);
    CHECK(tower.mesh().blade_elements == 1);
}

TEST_CASE("mesh: elements that are given in full are not sought, those of the other part are", "[property]") {
    const TurbineDescription description = machine();
    AssemblyOptions options;
    options.blade_beam = {.elements = 2, .torsion = false};
    const Turbine turbine = assemble(description, options);
    CHECK(turbine.mesh().blade_elements == 1);
    CHECK(turbine.layout().blades.front().elements.size() == 2);
    CHECK(turbine.mesh().tower_elements > 1);
    CHECK(turbine.mesh().modes > 0);
    options.tower_elements = 3;
    CHECK(assemble(description, options).mesh().modes == 0);
}

TEST_CASE("mesh: a machine of another size needs the same numbers, and they are as good", "[analytic]") {
    constexpr double ratio = 1.75;  // of lengths; frequencies are those of the smaller one over it
    const TurbineDescription small = machine(), large = scaled(small, ratio);
    const Mesh a = converged_mesh(small, with({.max_hz = 12})), b = converged_mesh(large, with({.max_hz = 12 / ratio}));
    CHECK(a.blade_elements == b.blade_elements);
    CHECK(a.tower_elements == b.tower_elements);
    CHECK(a.modes == b.modes);
    CHECK(a.change == Approx(b.change).epsilon(1e-6));
    CHECK(a.at_hz == Approx(ratio * b.at_hz).epsilon(1e-9));
}

TEST_CASE("mesh: frequencies of a clamped blade are those of the cantilever", "[analytic]") {
    TurbineDescription description = machine();
    EngineeringSection section;
    section.mass = 10;
    section.EI_flap = 1e6;
    section.EI_edge = 4e6;
    description.blade.line = uniform_beam(10, section, "blade");
    description.blade.damping = {};
    const std::vector<double> hz = clamped_blade_hz(description, {.blade_elements = 16});
    // (beta L)^2 / L^2 sqrt(EI / m) / 2 pi
    const double scale = std::sqrt(1e6 / 10) / (2 * pi * 100);
    const double a = 1.8751040687, b = 4.6940911330;
    REQUIRE(hz.size() >= 3);
    CHECK(hz[0] == Approx(a * a * scale).epsilon(1e-5));
    CHECK(hz[1] == Approx(2 * a * a * scale).epsilon(1e-5));
    CHECK(hz[2] == Approx(b * b * scale).epsilon(1e-5));
    // 1.3 times the third, to two digits upward: 1.3 x 11.089 Hz.
    CHECK(usual_frequency(description) == Approx(15));
    description.blade.rigid = true;
    CHECK(usual_frequency(description) == 5);
}

TEST_CASE("mesh: where blade 1 is missing, the others count", "[property]") {
    TurbineDescription description = machine();
    const Mesh whole = converged_mesh(description, with({.tolerance = 1e-3, .max_hz = 12}));
    description.individual_blades[1] = std::nullopt;
    description.unusual = true;
    const Mesh without = converged_mesh(description, with({.tolerance = 1e-3, .max_hz = 12}));
    CHECK(without.blade_elements == whole.blade_elements);
    CHECK(without.converged);
}

TEST_CASE("mesh: bad options are refused", "[property]") {
    const TurbineDescription description = machine();
    testing::check_refused([&] { (void)converged_mesh(description, with({.max_hz = -1})); },
                           {"mesh", "largest frequency [Hz] = -1", ">= 0"});
    testing::check_refused([&] { (void)assemble(description, with({.tolerance = 0})); }, {"mesh", "tolerance = 0"});
    testing::check_refused([&] { (void)converged_mesh(description, with({.rotor_speed = -2})); },
                           {"mesh", "rotor speed [rad/s] = -2"});
    testing::check_refused([&] { (void)converged_mesh(description, with({.max_elements = 0})); },
                           {"maximum number of elements = 0"});
}
