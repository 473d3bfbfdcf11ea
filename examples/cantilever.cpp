// A steel cantilever of cardanic joint beam elements: natural frequencies beside Euler and Bernoulli's.
#include "elements/cardan_beam/cardan_beam.hpp"
#include "solvers/linear/modes.hpp"

#include <array>
#include <cstdio>

int main() {
    using namespace cardan;
    // 4 m of a square tube, 100 x 100 x 5 mm, that bends about y only.
    constexpr double length = 4, E = 210e9, density = 7850;                              // m, Pa, kg/m^3
    constexpr double area = 0.1 * 0.1 - 0.09 * 0.09;                                     // m^2
    constexpr double second = (0.1 * 0.1 * 0.1 * 0.1 - 0.09 * 0.09 * 0.09 * 0.09) / 12;  // m^4
    const BeamLine line = uniform_beam(length, {.mass = density * area, .EI_flap = E * second, .EI_edge = E * second});

    Tree tree;
    ForceSet forces;
    add_cardan_beam(tree, forces, Tree::base(), line, "beam", {"beam"},
                    {.elements = 16, .torsion = false, .held_z = true});
    const System system(tree, forces);

    // Small vibrations about the straight beam at rest.
    const Vector zero = Vector::Zero(system.model.size());
    const solvers::Linearisation linear = solvers::linearise(system, {zero, zero, zero});
    const std::vector<solvers::Mode> modes =
        solvers::modes(solvers::restrict_to(linear, system.model.coordinates().free()));

    std::printf("mode   computed   closed form   (Hz)   difference\n");
    const std::array roots{1.8751040687, 4.6940911330, 7.8547574382};  // of cosh x cos x = -1
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const double closed =
            roots[i] * roots[i] / (2 * pi * length * length) * std::sqrt(E * second / (density * area));
        std::printf("%4zu %10.4f %13.4f %17.3f %%\n", i + 1, modes[i].natural_hz(), closed,
                    100 * (modes[i].natural_hz() / closed - 1));
    }
}
