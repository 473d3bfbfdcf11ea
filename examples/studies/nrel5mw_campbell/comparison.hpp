/// @file
/// Frequencies of the NREL 5 MW machine beside those of OpenFAST.
#pragma once

#include "examples/studies/nrel5mw_campbell/assumed_shapes.hpp"
#include "solvers/mode_names/community_names.hpp"

#include <array>
#include <optional>
#include <span>

namespace cardan::nrel5mw_campbell {

/// OpenFAST 5.0.0: linearisation with multi-blade transformation, gravity on, no aerodynamics, generator and yaw
/// bearing locked (GenDOF, YawDOF = False); Hz. BeamDyn's are corrected for terms of the rotating frame that this
/// version lacks, confirmed by nonlinear decay.
struct OpenFast {
    double rpm;
    std::array<double, 11> elastodyn, beamdyn;  ///< in the order of compared_modes
};
extern const std::array<std::string, 11> compared_modes;
extern const std::array<OpenFast, 3> openfast;

/// Frequencies of the modes of a diagram at one of its points, under gravity.
struct UnderGravity {
    std::size_t point = 0;
    std::vector<double> hz;   ///< per branch of the diagram; NaN: none
    std::vector<double> mac;  ///< energy MAC of the mode with the one without gravity
    double remainder = 0;     ///< see AzimuthAverage
};

/// @param heavy    the machine with gravity
/// @param diagram  of the same machine without, generator prescribed
/// @param limited  to ElastoDyn's shapes
/// @param azimuth  of blade 1 where the rotor stands still, rad
UnderGravity under_gravity(const turbines::Turbine& heavy, const solvers::Campbell& diagram, std::size_t point,
                           Limited limited, double azimuth);

/// The point of a diagram with the rotor speed of a reference, if there is one.
std::optional<std::size_t> point_at(const solvers::Campbell& diagram, double rpm);

/// Prints computed frequencies, OpenFAST's, and the differences in per cent, for every reference speed in the diagram.
/// @param gravity  as far as it was computed: these frequencies are compared then
/// @param yaw_locked  in the diagram, as it is in OpenFAST's figures; else the difference is said
void print_comparison(const solvers::Campbell& diagram, std::span<const UnderGravity> gravity, solvers::NameStyle style,
                      bool yaw_locked);

}  // namespace cardan::nrel5mw_campbell
