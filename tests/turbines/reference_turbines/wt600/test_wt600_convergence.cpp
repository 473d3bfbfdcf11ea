// The whole machine converges with the number of elements.
#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "tests/support/catch.hpp"
#include "turbines/reference_turbines/wt600.hpp"

#include <algorithm>

using namespace cardan;
using namespace cardan::solvers;

TEST_CASE("600 kW machine: frequencies converge to those of 24 elements per part, at second order or to 1e-4",
          "[property][slow]") {
    const auto frequencies = [](int elements) {
        turbines::AssemblyOptions assembly = turbines::wt600_paper_assembly(elements);
        assembly.structural_damping = assembly.joint_damping = false;
        const turbines::Turbine machine = turbines::wt600(assembly);
        CampbellOptions options;
        options.keep_shapes = false;
        const std::vector<double> speed{27 * units::rpm};
        const Campbell d = campbell(machine.system(), machine.rotor(), speed, options);
        std::vector<double> hz;
        for (std::size_t i = 0; i < 14; ++i) hz.push_back(d.points[0].modes[i].mode.natural_hz());
        return hz;
    };
    const auto coarse = frequencies(6), middle = frequencies(12), fine = frequencies(24);
    for (std::size_t i = 0; i < fine.size(); ++i) {
        CAPTURE(i, coarse[i], middle[i], fine[i]);
        CHECK(std::abs(middle[i] - fine[i]) < 2e-3 * fine[i]);
        // Second order: (1/4 - 1/16) / (1 - 1/16) = 0.2. Rotor tilt passes its limit on the way (errors of bending and
        // of geometric stiffness have opposite signs) and is within 1e-4 already.
        CHECK(std::abs(middle[i] - fine[i]) < std::max(0.3 * std::abs(coarse[i] - fine[i]), 1e-4 * fine[i]));
    }
}
