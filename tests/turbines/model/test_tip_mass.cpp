// A mass at the tip of a blade: the frequencies of a uniform cantilever that carries one, its weight in the machine,
// files.
#include "elements/sections/beam_line.hpp"
#include "mbs/base/units.hpp"
#include "mbs/model/summary.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/refusal.hpp"
#include "turbines/reference_turbines/wt600.hpp"
#include "turbines/yaml/description.hpp"

#include <cmath>

namespace cardan::testing::tip_masses {

using namespace turbines;

namespace {

constexpr double length = 20, mass = 100, EI = 4e6;  // m, kg/m, N m^2

TurbineDescription with_uniform_blade(double tip_mass) {
    TurbineDescription d = wt600_description();
    BeamTable table;
    table.stations = {0, length};
    EngineeringSection section;
    section.mass = mass;
    section.EI_flap = EI;
    section.EI_edge = 1e3 * EI;
    section.GJ = section.EA = section.GA_y = section.GA_z = std::numeric_limits<double>::infinity();
    section.j_flap = section.j_edge = 1e-3;
    table.sections = {section, section};
    d.blade.line = beam_line(table);
    d.blade.damping = {};
    d.blade.first_flap_damping = 0;
    d.blade.tip_mass = tip_mass;
    return d;
}

// 1 + cos x cosh x + m x (cos x sinh x - sin x cosh x) = 0, m the tip mass over that of the beam, x^4 = mu L^4 w^2 / EI
//                                                        [Karnovsky and Lebed, Formulas for Structural Dynamics, 5.2].
double wave_number(double ratio) {
    const auto f = [&](double x) {
        return 1 + std::cos(x) * std::cosh(x) + ratio * x * (std::cos(x) * std::sinh(x) - std::sin(x) * std::cosh(x));
    };
    double low = 0.1, high = 1.9;  // the first root is below that of the bare beam, 1.875
    for (int i = 0; i < 60; ++i) (f((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    return low;
}

double first_flap(const TurbineDescription& d) {
    AssemblyOptions options;
    options.blade_beam = {.elements = 12, .partition = Partition::mean_difference, .torsion = false};
    return clamped_blade_hz(d, options).front();
}

}  // namespace

TEST_CASE("tip mass: the first flap frequency is that of a cantilever with a mass at its end", "[analytic]") {
    for (const double ratio : {0.0, 0.1, 1.0, 5.0}) {
        const double x = wave_number(ratio), w = x * x * std::sqrt(EI / (mass * std::pow(length, 4)));
        CAPTURE(ratio);
        CHECK(first_flap(with_uniform_blade(ratio * mass * length)) == Approx(w / (2 * pi)).epsilon(2e-3));
    }
}

TEST_CASE("tip mass: it counts as the blade's, is kept in YAML and refused if negative", "[property]") {
    const auto blades = [](const TurbineDescription& d) {
        double sum = 0;
        for (const PartMass& part : masses_by_part(assemble(d, wt600_paper_assembly()).tree()))
            if (part.part.starts_with("blade")) sum += part.mass;
        return sum;
    };
    TurbineDescription d = wt600_description();
    const double before = blades(d);
    d.blade.tip_mass = 12.5;
    CHECK(blades(d) == Approx(before + 3 * 12.5).epsilon(1e-12));
    CHECK(parse_description(description_text(d), "own").blade.tip_mass == 12.5);
    d.blade.tip_mass = -1;
    check_refused([&] { d.check(); }, {"blade.tip_mass [kg] = -1", ">= 0"});
}

}  // namespace cardan::testing::tip_masses
