// Your own turbine from a YAML file: examples/data/own_turbine.yaml, or the file named on the command line.
#include <cardan/mbs/base/error.hpp>
#include <cardan/solvers/campbell/diagram.hpp>
#include <cardan/turbines/model/assembly.hpp>
#include <cardan/turbines/yaml/description.hpp>

#include <cstdio>
#include <iostream>

using namespace cardan;

// First bending of the uniform tower, Hz: a spring under all that it carries, in one point, and 33/140 of its own mass.
double estimate(const turbines::TurbineDescription& machine, const turbines::Turbine& turbine) {
    const double length = machine.tower.line.length, tower = turbine.layout().tower->mass;
    const double flexibility = machine.tower.line.section(0).compliance(4, 4);  // 1/EI
    const double mass = turbine.system().model.mass() - tower + 33. / 140 * tower;
    return std::sqrt(3 / (flexibility * mass * length * length * length)) / (2 * pi);
}

int main(int argc, char** argv) try {
    const turbines::TurbineDescription machine =
        turbines::read_description(argc > 1 ? argv[1] : CARDAN_EXAMPLE_DATA "/own_turbine.yaml");
    const turbines::Turbine turbine = turbines::assemble(machine);
    for (const std::string& warning : turbine.warnings()) std::cerr << "warning: " << warning << "\n";
    std::printf("%s: %.0f kg, %d coordinates\n%s\n", machine.name.c_str(), turbine.system().model.mass(),
                turbine.system().model.size(), in_words(turbine.mesh()).c_str());

    const solvers::Campbell diagram =
        solvers::campbell(turbine.system(), turbine.rotor(), solvers::rpm_range(0, 40, 10));
    if (const solvers::Branch* const bending = diagram.find_branch("1st tower fore-aft"))
        std::printf("%s at rest: %.3f Hz; with all that it carries in one point: %.3f Hz\n\n", bending->name.c_str(),
                    diagram.natural_hz(*bending, 0), estimate(machine, turbine));
    std::cout << solvers::table(diagram);
    return 0;
} catch (const Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
}
