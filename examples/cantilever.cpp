// A steel cantilever of cardanic joint beam elements: natural frequencies beside Euler and Bernoulli's.
#include <cardan/elements/cardan_beam/single_beam.hpp>
#include <cardan/solvers/equilibrium/natural_modes.hpp>

#include <array>
#include <cstdio>

int main() {
    using namespace cardan;
    // 4 m of a square tube, 100 x 100 x 5 mm, that bends about y only.
    constexpr double length = 4, E = 210e9, density = 7850;                              // m, Pa, kg/m^3
    constexpr double area = 0.1 * 0.1 - 0.09 * 0.09;                                     // m^2
    constexpr double second = (0.1 * 0.1 * 0.1 * 0.1 - 0.09 * 0.09 * 0.09 * 0.09) / 12;  // m^4
    const BeamLine line = uniform_beam(length, {.mass = density * area, .EI_flap = E * second, .EI_edge = E * second});

    const SingleBeam beam = clamped_beam(line, {.elements = 16, .torsion = false, .locked_z = true});
    const std::vector<solvers::Mode> modes = solvers::natural_modes(beam.system).modes;

    std::printf("mode   computed   closed form   (Hz)   difference\n");
    const std::array roots{1.8751040687, 4.6940911330, 7.8547574382};  // of cosh x cos x = -1
    for (std::size_t i = 0; i < roots.size(); ++i) {
        const double closed =
            roots[i] * roots[i] / (2 * pi * length * length) * std::sqrt(E * second / (density * area));
        std::printf("%4zu %10.4f %13.4f %17.3f %%\n", i + 1, modes[i].natural_hz(), closed,
                    100 * (modes[i].natural_hz() / closed - 1));
    }
}
