// Numbers of elements: converged frequencies by a finer mesh, closed forms of uniform beams.
#include "mbs/base/units.hpp"
#include "solvers/equilibrium/natural_modes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "tests/turbines/readers/model_files.hpp"
#include "turbines/mesh/mesh.hpp"

using namespace cardan;
using namespace cardan::turbines;

namespace {

AssemblyOptions beams(int blade, int tower) {
    AssemblyOptions options;
    options.blade_beam = {.elements = blade, .partition = Partition::mean_difference, .torsion = false};
    options.tower_beam = {.elements = tower, .partition = Partition::mean_difference, .torsion = false};
    options.spin = CoordinateRole::free;
    return options;
}

TurbineDescription machine() {
    return read_openfast(test::data_file("openfast/small.fst")).description;
}

std::vector<double> at_rest(const TurbineDescription& description, int blade, int tower) {
    std::vector<double> hz;
    for (const solvers::Mode& mode : solvers::natural_modes(assemble(description, beams(blade, tower)).system()).modes)
        if (mode.oscillates()) hz.push_back(mode.natural_hz());
    return hz;
}

}  // namespace

TEST_CASE("mesh: the frequencies asked for are within the tolerance of those of a much finer one", "[discrete]") {
    const TurbineDescription description = machine();
    for (const double tolerance : {2e-2, 2e-3, 2e-4}) {
        const Mesh mesh = converged_mesh(description, beams, {.tolerance = tolerance, .largest_hz = 12});
        REQUIRE(mesh.converged);
        CHECK(mesh.change <= tolerance);
        const std::vector<double> found = at_rest(description, mesh.blade_elements, mesh.tower_elements),
                                  finer = at_rest(description, 4 * mesh.blade_elements, 4 * mesh.tower_elements);
        double largest = 0;
        std::size_t count = 0;
        for (; finer[count] <= 12; ++count) largest = std::max(largest, std::abs(found[count] / finer[count] - 1));
        CHECK(static_cast<int>(count) == mesh.modes);
        CHECK(largest <=
              1.4 * tolerance);  // second order: 4/3 of the change to twice as many, and a quarter of that ...
    }
}

TEST_CASE("mesh: more elements for a smaller tolerance and for higher frequencies", "[property]") {
    const TurbineDescription description = machine();
    const Mesh coarse = converged_mesh(description, beams, {.tolerance = 2e-2, .largest_hz = 6}),
               fine = converged_mesh(description, beams, {.tolerance = 2e-4, .largest_hz = 6}),
               high = converged_mesh(description, beams, {.tolerance = 2e-2, .largest_hz = 25});
    CHECK(fine.blade_elements > coarse.blade_elements);
    CHECK(high.blade_elements > coarse.blade_elements);
    CHECK(high.modes > coarse.modes);
}

TEST_CASE("mesh: what is given stays, and what cannot be reached is said", "[property]") {
    const TurbineDescription description = machine();
    const Mesh given = converged_mesh(description, beams, {.largest_hz = 12, .blade_elements = 2, .tower_elements = 5});
    CHECK(given.blade_elements == 2);
    CHECK(given.tower_elements == 5);
    CHECK_FALSE(given.converged);
    CHECK(given.change > 2e-3);
    const Mesh few = converged_mesh(description, beams, {.tolerance = 1e-9, .largest_hz = 12, .most = 3});
    CHECK(few.blade_elements == 3);
    CHECK_FALSE(few.converged);
}

TEST_CASE("mesh: blades that turn fast have more elements than their frequencies need", "[property]") {
    const TurbineDescription description = machine();
    const MeshOptions still{.tolerance = 0.1, .largest_hz = 3};
    MeshOptions fast = still;
    fast.rotor_speed = 60;  // rad/s
    CHECK(converged_mesh(description, beams, fast).blade_elements >
          converged_mesh(description, beams, still).blade_elements);
}

TEST_CASE("mesh: frequencies of a clamped blade are those of the cantilever", "[analytic]") {
    TurbineDescription description = machine();
    EngineeringSection section;
    section.mass = 10;
    section.EI_flap = 1e6;
    section.EI_edge = 4e6;
    description.blade.line = uniform_beam(10, section, "blade");
    description.blade.damping = {};
    const std::vector<double> hz = clamped_blade_hz(description, beams(16, 1), 60);
    // (beta L)^2 / L^2 sqrt(EI / m) / 2 pi
    const double scale = std::sqrt(1e6 / 10) / (2 * pi * 100);
    const double a = 1.8751040687, b = 4.6940911330;
    REQUIRE(hz.size() >= 3);
    CHECK(hz[0] == Approx(a * a * scale).epsilon(1e-5));
    CHECK(hz[1] == Approx(2 * a * a * scale).epsilon(1e-5));
    CHECK(hz[2] == Approx(b * b * scale).epsilon(1e-5));
}

TEST_CASE("mesh: bad options are refused", "[property]") {
    const TurbineDescription description = machine();
    testing::check_refused([&] { (void)converged_mesh(description, beams, {}); },
                           {"largest frequency [Hz] = 0", "> 0"});
    testing::check_refused([&] { (void)converged_mesh(description, beams, {.tolerance = 0, .largest_hz = 1}); },
                           {"tolerance = 0"});
    testing::check_refused([&] { (void)converged_mesh(description, beams, {.largest_hz = 1, .most = 0}); },
                           {"most elements = 0"});
}
