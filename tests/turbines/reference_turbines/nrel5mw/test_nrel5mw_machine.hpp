/// @file
/// What the tests of the whole NREL 5 MW machine share.
#pragma once

#include "mbs/base/units.hpp"
#include "solvers/campbell/diagram.hpp"
#include "turbines/reference_turbines/nrel5mw.hpp"
#include "turbines/tables/csv.hpp"
#include "turbines/tables/detail/embedded_data.hpp"

namespace cardan::testing {

using units::rpm;

/// "tower" or "blade".
inline const turbines::CsvTable& table(const char* name) {
    static const auto tower = turbines::CsvTable::parse(turbines::embedded_data("nrel5mw_tower.csv"), "tower"),
                      blade = turbines::CsvTable::parse(turbines::embedded_data("nrel5mw_blade.csv"), "blade");
    return std::string_view(name) == "tower" ? tower : blade;
}

/// Elements of a variant without any damping.
inline turbines::AssemblyOptions undamped(turbines::Nrel5mwVariant variant, int blade_elements, int tower_elements) {
    turbines::AssemblyOptions options = turbines::nrel5mw_assembly(variant, blade_elements, tower_elements);
    options.structural_damping = options.joint_damping = false;
    return options;
}

/// One rotor speed or several; generator locked unless stated.
inline solvers::Campbell diagram(const turbines::Turbine& machine, std::initializer_list<double> speeds,
                                 solvers::RotorSpin spin = solvers::RotorSpin::prescribed) {
    solvers::CampbellOptions options;
    options.spin = spin;
    options.keep_shapes = false;
    return solvers::campbell(machine.system(), machine.rotor(), std::vector<double>(speeds), options);
}

inline double hz(const solvers::Campbell& d, std::string_view mode, std::size_t point = 0) {
    return d.natural_hz(d.branch(mode), point);
}

/// Mass matrix at q = 0.
inline Matrix metric_at_rest(const System& system) {
    Workspace workspace(system.model);
    Matrix g(system.model.size(), system.model.size());
    metric(kinematics(system.model, Vector::Zero(system.model.size()), workspace), g);
    return g;
}

/// The machine with tower and blades that hardly bend, their sections lines of mass.
inline turbines::TurbineDescription almost_rigid(turbines::TurbineDescription d) {
    for (BeamLine* line : {&d.tower.line, &d.blade.line})
        line->section = [own = line->section](double x) {
            BeamSection s = own(x);
            s.compliance *= 1e-6;
            s.J.setZero();
            return s;
        };
    return d;
}

}  // namespace cardan::testing
