/// @file
/// Common parts of the programs about the two-bladed teetered machine: the machine and its periodic system.
#pragma once

#include "mbs/base/units.hpp"
#include "programs/shared/campbell_program.hpp"
#include "turbines/reference_turbines/teetered.hpp"

#include <optional>

namespace cardan::program {

struct TeeteredArguments {
    std::optional<double> tower_ratio;
    int tower_elements = 6, blade_elements = 6, harmonics = 8;
    bool rigid_tower = false, no_teeter = false, gravity = false, summary = false;
    std::string data;
};

inline void add_options(CommandLine& app, TeeteredArguments& a) {
    const Option ratio =
        app.add_option("--tower-ratio", a.tower_ratio,
                       "rigidity of the tower over that of the blades (default: 100, or as --data says)");
    app.add_flag("--rigid-tower", a.rigid_tower, "no tower coordinates").excludes(ratio);
    app.add_option("--blade-elements", a.blade_elements, "beam elements per blade");
    app.add_option("--tower-elements", a.tower_elements, "beam elements of the tower");
    app.add_flag("--no-teeter", a.no_teeter, "teeter locked");
    app.add_flag("--gravity", a.gravity, "with gravity: about a steady state that changes with the azimuth");
    app.add_option("--harmonics", a.harmonics, "of the revolution in that steady state");
    app.add_option("--data", a.data, "folder with teetered.csv (default: built in)");
    app.add_flag("--summary", a.summary, "print bodies, coordinates and masses first");
}

inline turbines::Turbine machine(const TeeteredArguments& a) {
    turbines::TurbineDescription description = a.data.empty()
                                                   ? turbines::teetered_description()
                                                   : turbines::teetered_description(std::filesystem::path(a.data));
    if (a.tower_ratio) description = turbines::with_tower_rigidity(description, *a.tower_ratio);
    if (a.no_teeter) description.hub.teeter->bearing = turbines::rigid_joint;
    description.tower.rigid = a.rigid_tower;
    turbines::AssemblyOptions options = turbines::teetered_paper_assembly();
    options.blade_beam->elements = a.blade_elements;
    options.tower_beam->elements = a.tower_elements;
    options.blade_beam->torsion_armature = options.tower_beam->torsion_armature = -1. / 12;  // of fourth order
    if (a.gravity) options.gravity = {0, 0, -units::standard_gravity};
    return turbines::assemble(description, options);
}

/// Adds the elements to a diagram's description, for tables and titles.
inline void tell_elements(solvers::Campbell& diagram, const turbines::Turbine& machine) {
    diagram.accuracy = turbines::in_words(machine.mesh());
    diagram.remark += text(diagram.remark.empty() ? "" : "; ", "elements of the paper");
}

/// Options of a diagram by Floquet's theory, up to a frequency in Hz.
inline solvers::CampbellOptions campbell_options(const TeeteredArguments& a, const turbines::Turbine& machine,
                                                 double max_frequency_hz) {
    solvers::CampbellOptions options = campbell_options(max_frequency_hz);
    options.method = solvers::CampbellMethod::floquet;
    options.floquet.harmonics = a.harmonics;
    if (a.gravity) options.floquet.fixed_means = {machine.system().model.index("yaw")};  // nothing holds it
    return options;
}

}  // namespace cardan::program
