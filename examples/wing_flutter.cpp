// Flutter of the wing of M. Goland, J. Appl. Mech. 12 (1945) A197, in strip theory with R. T. Jones' lags.
#include <cardan/mbs/base/error.hpp>
#include <cardan/solvers/stability/stability_limits.hpp>
#include <cardan/turbines/aerodynamics/machine_air.hpp>

#include <iostream>
#include <optional>

using namespace cardan;

constexpr double span = 6.096, chord = 1.8288, b = chord / 2, density = 1.225;
constexpr double axis = 0.33 * chord, mass_centre = 0.43 * chord;  // behind the leading edge, m
constexpr std::size_t elements = 12, sections = elements + 1;

// With the air that moves with the wing, pi rho b^2 at the middle of the chord.
EngineeringSection wing_section() {
    constexpr double mass = 35.71, inertia = 8.64, air = pi * density * b * b, middle = b - axis;  // kg/m, kg m
    EngineeringSection s{.mass = mass + air, .GJ = 0.987e6, .EI_flap = 9.77e6, .EI_edge = 9.77e8};
    s.mass_centre.y = -(mass * (mass_centre - axis) + air * middle) / s.mass;
    s.j_edge = inertia + air * (b * b / 8 + middle * middle) - s.mass * s.mass_centre.y * s.mass_centre.y;
    return s;
}

int main() try {
    // The blade of a parked machine, feathered into the wind.
    turbines::TurbineDescription machine;
    machine.blades = 1;
    machine.hub.radius = 1;
    machine.blade.line = uniform_beam(span, wing_section(), "wing");
    turbines::AssemblyOptions assembly{.pitch = pi / 2};
    assembly.blade_beam = {.elements = elements, .locked_z = true};
    const turbines::Turbine wing = turbines::isolated_blade(machine, assembly);
    const Polar plate("plate", {-pi, -0.7, 0.7, pi}, {0, -1.4 * pi, 1.4 * pi, 0}, {0, 0, 0, 0}, {0, 0, 0, 0});
    const UnsteadyAirfoil airfoil(plate, {.slope = 2 * pi, .upper = 0.7, .lower = -0.7},
                                  {.A1 = 0.165, .A2 = 0.335, .b1 = 0.0455, .b2 = 0.3});
    AeroBlade strips;
    strips.chord.assign(sections, chord);
    strips.sweep.assign(sections, 0.25 * chord - axis);
    for (auto* list : {&strips.twist, &strips.prebend}) list->assign(sections, 0);
    strips.airfoil.assign(sections, 0);
    strips.polars = {plate};
    for (std::size_t i = 0; i < sections; ++i) strips.position.push_back(1 + span * static_cast<double>(i) / elements);
    const turbines::MachineAir still(wing, strips, SteadyWind{}, {.skew = Skew::none, .induction = false});
    const turbines::MachineAir air = still.lagging({.airfoils = {airfoil}});
    std::optional<turbines::Turbine> windy;
    const auto at_wind = [&](double speed) {
        windy = air.in(SteadyWind{.speed = speed, .density = density}).on(wing);
        return solvers::CampbellCase{.system = &windy->system(), .rotor = &windy->rotor()};
    };
    const auto found = solvers::stability_limits(at_wind, "wind, m/s", 20, 300, {.modes = {.max_frequency_hz = 24}});
    for (const solvers::StabilityLimit& limit : found.limits)
        std::printf("%-10s from %7.3f m/s on, %6.3f rad/s: %s\n",
                    limit.kind == solvers::Instability::flutter ? "flutter" : "divergence", limit.parameter,
                    limit.eigenvalue.imag(), limit.name.c_str());
    std::printf("continuous wing: flutter 137.335 m/s, 69.346 rad/s; divergence 252.278 m/s\n");
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
