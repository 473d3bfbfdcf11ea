// Campbell diagram of the 600 kW machine of Zhao, Maisser and Wu, Renewable Energy 32 (2007) 532-546, with as many beam
// elements as it takes, beside the three per blade and tower of the comparison with the paper.
#include <cardan/mbs/base/error.hpp>
#include <cardan/solvers/campbell/diagram.hpp>
#include <cardan/solvers/campbell_data/csv.hpp>
#include <cardan/solvers/hdf5/campbell.hpp>
#include <cardan/solvers/pictures/campbell.hpp>
#include <cardan/turbines/reference_turbines/wt600.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

int main() try {
    const turbines::TurbineDescription machine = turbines::wt600_description();
    const turbines::Turbine turbine = turbines::assemble(machine);
    const std::vector<double> speeds = solvers::rpm_range(0, 40, 1);
    solvers::Campbell diagram = solvers::campbell(turbine.system(), turbine.rotor(), speeds);
    diagram.accuracy = in_words(turbine.mesh());
    std::cout << solvers::table(diagram);

    const turbines::Turbine coarse = turbines::assemble(machine, turbines::wt600_paper_assembly());
    const solvers::Campbell paper = solvers::campbell(coarse.system(), coarse.rotor(), {0.0});
    std::printf("\nat rest, Hz                     converged   elements of the paper\n");
    for (const solvers::Branch& branch : diagram.branches)
        if (const solvers::Branch* same = paper.find_branch(branch.name))
            std::printf("%-30s %10.4f  %10.4f\n", branch.name.c_str(), diagram.natural_hz(branch, 0),
                        paper.natural_hz(*same, 0));

    solvers::write_hdf5(diagram, "campbell_diagram.h5");
    solvers::write_csv(diagram, "campbell_diagram.csv");
    solvers::plot(diagram, "campbell_diagram.svg", {.max_frequency_hz = 10});
    // In the arrangement of the paper's Figs. 8 and 9, with one blade by itself.
    const turbines::Turbine blade = turbines::isolated_blade(machine);
    const solvers::Campbell alone = solvers::campbell(blade.system(), blade.rotor(), speeds);
    solvers::plot_panels(
        diagram, "campbell_diagram_panels.svg",
        {{.families = {"tower side-side"}, .title = "tower, lateral (side-side)", .max_frequency_hz = 6},
         {.families = {"tower fore-aft"}, .title = "tower, longitudinal (fore-aft)", .max_frequency_hz = 6},
         {.families = {"rotor yaw", "rotor tilt"}, .title = "rotor yaw and tilt", .max_frequency_hz = 2.5},
         {.families = {"drive-train torsion"}, .title = "drive train", .max_frequency_hz = 6},
         {.families = {"blade flap"}, .title = "flap", .max_frequency_hz = 8, .isolated_blade = &alone},
         {.families = {"blade edge"}, .title = "lag (edge)", .max_frequency_hz = 10, .isolated_blade = &alone}});
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
