// What a description holds rigid: blades, and a tower in one direction. Rigid bodies by a fine mesh of true segments;
// beams ten thousand times as stiff.
#include "mbs/kernels/metric.hpp"
#include "tests/support/catch.hpp"
#include "tests/turbines/reference_turbines/wt600/test_wt600.hpp"
#include "turbines/yaml/description.hpp"

using namespace cardan;
using namespace cardan::testing;
using turbines::Turbine;
using turbines::TurbineDescription;

namespace {

// Of the machine at rest about the generator's azimuth, kg m^2.
double inertia_of_rotor(const Turbine& machine) {
    const Model& model = machine.system().model;
    Workspace workspace(model);
    Matrix g(model.size(), model.size());
    metric(kinematics(model, Vector::Zero(model.size()), workspace), g);
    return g(machine.rotor().spin, machine.rotor().spin);
}

// The same beam, a ten-thousandth as flexible in bending about its axes y and z, with the shear that goes with it, and
// in torsion.
BeamLine stiffened(BeamLine line, bool y, bool z, bool x) {
    line.section = [own = line.section, y, z, x](double at) {
        BeamSection s = own(at);
        Vec6 scale = Vec6::Ones();
        if (x) scale(3) = 0.01;
        if (y) scale(2) = scale(4) = 0.01;
        if (z) scale(1) = scale(5) = 0.01;
        s.compliance = (scale.asDiagonal() * s.compliance * scale.asDiagonal()).eval();
        return s;
    };
    return line;
}

void check_lowest(const std::vector<double>& held, const std::vector<double>& expected, std::size_t count) {
    REQUIRE(held.size() >= count);
    for (std::size_t i = 0; i < count; ++i) CHECK(held[i] == Approx(expected.at(i)).epsilon(1e-3));
}

}  // namespace

TEST_CASE("held beams: rigid blades are one element of the true mass, and nothing of them moves", "[analytic]") {
    TurbineDescription d = turbines::wt600_description(), stiff = d;
    d.blade.rigid = true;
    CHECK(turbines::assemble(d).mesh().blade_elements == 1);
    CHECK(turbines::assemble(d).mesh().tower_elements > 1);
    turbines::AssemblyOptions options = undamped(12);
    const Turbine fine = turbines::wt600(options);
    options.blade_elements.reset();
    const Turbine rigid = turbines::assemble(d, options);
    CHECK(rigid.system().model.mass() == Approx(fine.system().model.mass()).epsilon(1e-12));
    CHECK(inertia_of_rotor(rigid) == Approx(inertia_of_rotor(fine)).epsilon(1e-10));
    const CoordinateTable& table = rigid.system().model.coordinates();
    for (int k = 1; k <= 3; ++k)
        for (const int i : table.of_part("blade", k)) CHECK(table[i].role == CoordinateRole::prescribed);
    stiff.blade.line = stiffened(d.blade.line, true, true, true);
    check_lowest(frequencies(turbines::assemble(d, undamped()), 27 * rpm),
                 frequencies(turbines::assemble(stiff, undamped()), 27 * rpm), 4);
}

TEST_CASE("held beams: a tower that is held in one direction moves as one that is stiff in it", "[crosscheck]") {
    for (const bool fore_aft : {true, false}) {
        TurbineDescription held = turbines::wt600_description(), stiff = held;
        (fore_aft ? held.tower.locked_fore_aft : held.tower.locked_side_side) = true;
        stiff.tower.line = stiffened(stiff.tower.line, !fore_aft, fore_aft, false);
        check_lowest(frequencies(turbines::assemble(held, undamped()), 0),
                     frequencies(turbines::assemble(stiff, undamped()), 0), 5);
        // The same through the options in full.
        turbines::AssemblyOptions options = undamped();
        options.tower_beam = CardanBeamOptions{.locked_y = !fore_aft, .locked_z = fore_aft};
        CHECK(frequencies(turbines::assemble(turbines::wt600_description(), options), 0) ==
              frequencies(turbines::assemble(held, undamped()), 0));
    }
}

TEST_CASE("held beams: they are kept in YAML", "[property]") {
    TurbineDescription d = turbines::wt600_description();
    const auto read = [&] { return turbines::parse_description(turbines::description_text(d), "own"); };
    CHECK_FALSE(read().blade.rigid);
    d.blade.rigid = d.tower.locked_fore_aft = true;
    d.individual_blades[2] = d.blade;
    d.individual_blades[2]->rigid = false;
    CHECK(read().blade.rigid);
    CHECK_FALSE(read().individual_blades[2]->rigid);
    CHECK(read().tower.locked_fore_aft);
    CHECK_FALSE(read().tower.locked_side_side);
    d.tower.locked_fore_aft = false;
    d.tower.locked_side_side = true;
    CHECK_FALSE(read().tower.locked_fore_aft);
    CHECK(read().tower.locked_side_side);
}
