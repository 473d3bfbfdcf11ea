// Floquet diagram of a machine with two blades on a teetered hub: modes about its periodic state at four rotor speeds,
// each named after the harmonic of the revolution that holds most of its energy.
#include <cardan/mbs/base/error.hpp>
#include <cardan/mbs/base/units.hpp>
#include <cardan/solvers/hdf5/campbell.hpp>
#include <cardan/solvers/pictures/campbell.hpp>
#include <cardan/turbines/machines/teetered.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    const turbines::Turbine turbine =
        turbines::assemble(turbines::teetered_description(), turbines::teetered_assembly(3));
    solvers::CampbellOptions options;
    options.method = solvers::CampbellMethod::floquet;
    options.max_frequency_hz = 6;
    const solvers::Campbell diagram =
        solvers::campbell(turbine.system(), turbine.rotor(), solvers::rpm_range(15, 60, 15), options);

    std::cout << solvers::table(diagram) << "\nshares of the harmonics at the last speed, energy\n";
    const std::size_t last = diagram.points.size() - 1;
    for (const solvers::Branch& branch : diagram.branches) {
        const solvers::CampbellMode* mode = diagram.mode(branch, last);
        if (mode == nullptr || !mode->floquet) continue;
        std::printf("%-36s", branch.name.c_str());
        for (int j = -2; j <= 2; ++j) {
            const Eigen::Index at = j - mode->floquet->first_harmonic;
            const bool there = at >= 0 && at < mode->floquet->participation.size();
            std::printf("  %+d: %6.4f", j, there ? mode->floquet->participation(at) : 0.0);
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
