// A uniform blade that rotates: the centrifugal force stiffens it, in flap more than in lag; flap^2 - lag^2 = speed^2.
#include <cardan/elements/cardan_beam/single_beam.hpp>
#include <cardan/solvers/equilibrium/natural_modes.hpp>

#include <cstdio>
#include <utility>

using namespace cardan;

int main() {
    constexpr double length = 20, mass = 50, EI = 2e7;  // m, kg/m, N m^2
    // The literature has speeds and frequencies in multiples of this, rad/s.
    const double unit = std::sqrt(EI / (mass * length * length * length * length));
    const BeamLine line = uniform_beam(length, {.mass = mass, .EI_flap = EI, .EI_edge = EI});

    // z is the axis of the rotor: flap is bending about y, lag about z; a blade in which the other one is locked.
    const auto lowest = [&](double speed, bool flap) {
        const SingleBeam blade =
            spinning_beam(line, {.elements = 16, .torsion = false, .locked_y = !flap, .locked_z = flap});
        return std::abs(solvers::natural_modes(blade.system, blade.spin, speed).modes.front().eigenvalue);
    };

    std::printf("speed/unit    flap computed   published   lag computed   sqrt(flap^2 - speed^2)   (rad/s)\n");
    // Wright, Smith, Thresher and Wang, J. Appl. Mech. 49 (1982): first flap, by power series.
    for (const auto& [speed, published] : {std::pair{0., 3.5160}, {3., 4.7973}, {12., 13.1702}}) {
        const double flap = lowest(speed * unit, true), lag = lowest(speed * unit, false);
        std::printf("%10.0f %16.4f %11.4f %14.4f %24.4f\n", speed, flap, published * unit, lag,
                    std::sqrt(flap * flap - speed * speed * unit * unit));
    }
}
