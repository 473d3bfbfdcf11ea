/// @file
/// The two-bladed teetered machine for Floquet's theory: its linearisation over the azimuth, its families.
#pragma once

#include "tests/support/contains.hpp"
#include "tests/turbines/reference_turbines/teetered/periodic_modes.hpp"
#include "turbines/reference_turbines/teetered.hpp"

namespace cardan::testing {

/// The machine of Table I with nothing zero that can be other than zero, rotor upwind.
inline turbines::TurbineDescription general_description() {
    turbines::TurbineDescription d = turbines::teetered_description();
    d.nacelle.tilt = 0.08;
    d.nacelle.shaft_height = 0.7;
    d.nacelle.overhang = 2.1;
    d.drive_train.shaft.mass = 300;
    d.drive_train.shaft.com = {0.4, 0, 0};
    d.drive_train.shaft.J = Vec3(20, 30, 30).asDiagonal();
    d.hub.inertia.mass = 500;
    d.hub.inertia.com = {0, 0, -0.1};
    d.hub.teeter->undersling = 0.3;
    d.hub.teeter->delta3 = 0.5;
    d.blade.cone = -0.1;
    d.hub.teeter->bearing = {3e4, 200};
    d.yaw.rotation = {5e6, 7e3};
    return d;
}

/// "tower lateral", "symmetric flap", "antisymmetric torsion", "yaw", "teeter" ...; rows of z: what does not belong to
/// the blades, sums, differences.
inline HalfTurnCoordinates half_turn_coordinates(const turbines::Turbine& machine, const std::vector<int>& unknowns) {
    const CoordinateTable& table = machine.system().model.coordinates();
    const auto n = std::ssize(unknowns);
    const auto column = [&](int coordinate) {
        return std::find(unknowns.begin(), unknowns.end(), coordinate) - unknowns.begin();
    };
    HalfTurnCoordinates z{Matrix::Zero(n, n), {}, {}};
    Eigen::Index row = 0;
    for (int i : unknowns) {
        const CoordinateInfo& info = table[i];
        if (info.blade > 0) continue;
        z.T(row++, column(i)) = 1;
        const auto& odd = machine.rotor().odd_coordinates;
        z.odd.push_back(std::find(odd.begin(), odd.end(), i) != odd.end());
        z.family.push_back(info.part != "tower"               ? info.part
                           : contains(info.name, "bending y") ? "tower lateral"
                           : contains(info.name, "bending z") ? "tower fore-aft"
                                                              : "tower torsion");
    }
    for (bool odd : {false, true})
        for (std::size_t i = 0; i < machine.rotor().blades[0].size(); ++i) {
            const int first = machine.rotor().blades[0][i], second = machine.rotor().blades[1][i];
            z.T(row, column(first)) = std::sqrt(0.5);
            z.T(row++, column(second)) = odd ? -std::sqrt(0.5) : std::sqrt(0.5);
            z.odd.push_back(odd);
            const std::string& name = table[first].name;
            z.family.push_back(std::string(odd ? "antisymmetric " : "symmetric ") +
                               (contains(name, "bending y")   ? "flap"
                                : contains(name, "bending z") ? "lag"
                                                              : "torsion"));
        }
    return z;
}

/// Linearised about the undeformed machine, which is its steady state without gravity and cone, or about another.
inline HalfTurnFloquet floquet(const turbines::Turbine& machine, double rotor_speed, int steps, double weakest = 0.5,
                               const Vector& steady_state = {}) {
    const System& system = machine.system();
    const int spin = machine.rotor().spin;
    const auto n = system.model.size();
    std::vector<int> unknowns;
    for (int i = 0; i < n; ++i)
        if (i != spin) unknowns.push_back(i);
    DynamicState point = at_rest(n);
    if (steady_state.size() > 0) point.q = steady_state;
    point.qd(spin) = rotor_speed;
    solvers::Lineariser lineariser(system);
    solvers::Linearisation linear;
    const PeriodicSystem at = [&](double azimuth) {
        point.q(spin) = azimuth;
        lineariser.linearise(point, linear);
        return solvers::restrict_to(linear, unknowns);
    };
    return half_turn_floquet(at, rotor_speed, half_turn_coordinates(machine, unknowns), steps, weakest);
}

}  // namespace cardan::testing
