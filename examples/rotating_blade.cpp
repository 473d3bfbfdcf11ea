// A uniform blade that rotates: the centrifugal force stiffens it, in flap more than in lag; flap^2 - lag^2 = speed^2.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "solvers/linear/modes.hpp"

#include <cstdio>
#include <utility>

using namespace cardan;

int main() {
    constexpr double length = 20, mass = 50, EI = 2e7;  // m, kg/m, N m^2
    // The literature has speeds and frequencies in multiples of this, rad/s.
    const double unit = std::sqrt(EI / (mass * length * length * length * length));
    Tree tree;
    ForceSet forces;
    const JointedFrame hub = add_joint(tree, Tree::base(), JointKind::revolute, Axis::z, "spin", {"hub"});
    add_cardan_beam(tree, forces, hub.frame, uniform_beam(length, {.mass = mass, .EI_flap = EI, .EI_edge = EI}),
                    "blade", {"blade"}, {.elements = 16, .torsion = false});
    const System system(tree, forces);

    // Over the coordinates of the blade: its rotation is prescribed. z is the axis of the rotor.
    const int spin = system.model.index("spin");
    const auto lowest = [&](double speed, const char* direction) {
        std::vector<int> rows;
        for (int i = 0; i < system.model.size(); ++i)
            if (system.model.coordinates()[i].name.find(direction) != std::string::npos) rows.push_back(i);
        const Vector zero = Vector::Zero(system.model.size());
        solvers::OperatingPoint at{zero, zero, zero};  // straight and radial: the steady state
        at.qd(spin) = speed;
        return std::abs(solvers::modes(solvers::restrict_to(solvers::linearise(system, at), rows)).front().eigenvalue);
    };

    std::printf("speed/unit    flap computed   published   lag computed   sqrt(flap^2 - speed^2)   (rad/s)\n");
    // Wright, Smith, Thresher and Wang, J. Appl. Mech. 49 (1982): first flap, by power series.
    for (const auto& [speed, published] : {std::pair{0., 3.5160}, {3., 4.7973}, {12., 13.1702}}) {
        const double flap = lowest(speed * unit, "bending y"), lag = lowest(speed * unit, "bending z");
        std::printf("%10.0f %16.4f %11.4f %14.4f %24.4f\n", speed, flap, published * unit, lag,
                    std::sqrt(flap * flap - speed * speed * unit * unit));
    }
}
