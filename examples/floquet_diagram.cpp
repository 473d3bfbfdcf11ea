// Floquet diagram of a machine with two blades on a teetered hub: modes about its periodic state at four rotor speeds,
// and at the last, 6.02 rad/s, their frequencies per revolution and the shares of the harmonics of the revolution.
#include <cardan/mbs/base/error.hpp>
#include <cardan/solvers/campbell/diagram.hpp>
#include <cardan/solvers/hdf5/campbell.hpp>
#include <cardan/solvers/pictures/campbell.hpp>
#include <cardan/turbines/reference_turbines/teetered.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    const turbines::Turbine turbine = turbines::assemble(turbines::teetered_description());
    solvers::CampbellOptions options;
    options.method = solvers::CampbellMethod::floquet;
    options.max_frequency_hz = 4;
    const solvers::Campbell diagram =
        solvers::campbell(turbine.system(), turbine.rotor(), std::vector<double>{1.5, 3, 4.5, 6.02}, options);

    std::cout << solvers::table(diagram)
              << "\nat the last speed                          per rev   share of the energy by harmonic, -2 ... 2\n";
    const std::size_t last = diagram.points.size() - 1;
    for (const solvers::Branch& branch : diagram.branches) {
        const solvers::CampbellMode* mode = diagram.mode(branch, last);
        if (mode == nullptr || !mode->floquet) continue;
        std::printf("%-42s %7.4f  ", branch.name.c_str(), mode->floquet->per_period());
        for (int j = -2; j <= 2; ++j) {
            const Eigen::Index at = j - mode->floquet->first_harmonic;
            const bool there = at >= 0 && at < mode->floquet->participation.size();
            std::printf(" %7.4f", there ? mode->floquet->participation(at) : 0.0);
        }
        std::printf("\n");
    }
    solvers::write_hdf5(diagram, "floquet_diagram.h5");
    solvers::plot(diagram, "floquet_diagram.svg");
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
